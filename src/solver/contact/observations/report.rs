//! What contact tells others: values at the nodes, works, numbers for the log, and what it costs, to price it on other
//! machines.

use crate::comm::Communicator;
use crate::common::vector::add;
use crate::solver::contact::Contact;
use crate::solver::contact::Seen;
use crate::solver::contact::nodes::ContactNodes;
use crate::solver::contact::nodes::result::{Details, NodeResult, Status};

/// Contact in numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Points of contact.
    pub points: usize,
    /// Faces that they may touch.
    pub faces: usize,
    /// Edges that stand out.
    pub edges: usize,
    /// Points that the last search found near faces.
    pub watched: usize,
    /// Pairs of these points and faces.
    pub pairs: usize,
    /// Searches so far.
    pub searches: u64,
    /// Enforcement.
    pub tally: Tally,
}

/// Counts for the log.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tally {
    /// Steps in which anything was enforced.
    pub steps: u64,
    /// Iterations in all of them.
    pub iterations: u64,
    /// Steps in which the iterations ran out, see
    /// [`Outcome::ran_out`](crate::solver::contact::enforcement::iterations::Outcome::ran_out).
    pub capped: u64,
    /// Steps in a row, up to now, in which they did not settle within the usual number.
    pub unsettled: u64,
    /// Largest overlap that was left, as a part of the face's size.
    pub left: f64,
    /// Deepest penetration that motion has made, as a part of the face's size.
    pub deepest: f64,
    /// Deepest penetration of more than a ten-thousandth of a face in motions of a step, the farthest of those so far; without
    /// dimension.
    pub motions: f64,
    /// Farthest motion of a contact along its normal in a step so far, a length.
    pub farthest: f64,
    /// Deepest penetration so far between nodes that nothing can move, as a part of the face's size.
    pub held: f64,
}

/// Contact of one rank.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Points that this rank knows the motion of: those it looks after, and the corners of faces that these may meet.
    pub points: u64,
    /// Pairs of these points and faces that the last search left to be checked in detail.
    pub candidates: u64,
    /// Constraints of the last step.
    pub constraints: u64,
    /// Iterations over the constraints of each step, in all steps so far.
    pub iterations: u64,
}

impl Contact {
    /// Work of normal and of friction forces so far, at every point that this rank owns, and of points now gone.
    pub fn works(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let owned = self
            .contact_nodes
            .list
            .iter()
            .zip(&self.contact_nodes.works)
            .filter(|(contact_node, _)| contact_node.owned);
        owned.map(|(_, work)| *work).chain(self.lost_work.iter().copied())
    }

    /// Forces of rigid planes at local nodes.
    pub fn plane_forces(&self) -> impl Iterator<Item = (u32, [f64; 3])> + '_ {
        let forces = self.results().map(|(node, result)| (node, result.details.plane_force));
        forces.filter(|(_, force)| *force != [0.0; 3])
    }

    fn results(&self) -> impl Iterator<Item = (u32, &NodeResult)> + '_ {
        let ContactNodes { loaded, list, .. } = &self.contact_nodes;
        loaded.iter().map(|(i, result)| (list[*i as usize].node, result))
    }

    /// At each local node on which contact forces act: contact force, overlap that contact closes in the coming step, status
    /// (0 free, 1 loaded, 2 loaded by its own contact with a face), and the place in the mesh file, from 1, of the element
    /// whose face it meets.
    pub fn node_values(&self) -> Vec<(u32, [f64; 6])> {
        let value = |(node, result): (u32, &NodeResult)| {
            let Details { gap, status, face, .. } = result.details;
            let element = if status == Status::OnFace { self.skin.file_number(face) } else { 0.0 };
            let [x, y, z] = add(result.normal_force, result.tangential_force);
            (node, [x, y, z, gap, status.code(), element])
        };
        self.results().map(value).collect()
    }

    /// Deepest penetration so far between nodes that nothing can move, of contacts of this rank: as a part of the face's size, and the
    /// number of a node in the mesh.
    pub fn held_deepest(&self) -> Option<(f64, u32)> {
        self.held_deepest
    }

    /// Local nodes on the surface, and the ranks that compute their contact.
    pub fn owner_ranks(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        let owner_ranks = self.contact_nodes.owner_ranks.iter().copied().chain(std::iter::repeat(0));
        self.contact_nodes.list.iter().map(|contact_node| contact_node.node).zip(owner_ranks)
    }

    /// What the log tells at the end; nothing of planes alone, of which each rank knows its own only.
    pub fn report(&self) -> Option<Report> {
        let [watched, pairs] = self.counts.map(|count| count as usize);
        (!self.layout.interfaces.is_empty()).then_some(Report {
            points: self.layout.nodes.len(),
            faces: self.layout.faces.len(),
            edges: self.layout.edges.iter().filter(|edge| edge.stands_out()).count(),
            watched,
            pairs,
            searches: self.searches,
            tally: self.tally,
        })
    }

    /// What contact has met so far, on all ranks; all ranks call it.
    pub fn seen(&self, comm: &mut dyn Communicator) -> Seen {
        self.seen.merged(comm)
    }

    /// Whether there are surfaces that touch surfaces, beside rigid planes.
    pub fn has_surfaces(&self) -> bool {
        !self.layout.interfaces.is_empty()
    }

    /// Whether edges may touch edges.
    pub fn has_edges(&self) -> bool {
        !self.layout.edges.is_empty()
    }

    /// What contact has asked of this rank.
    pub fn work(&self) -> Work {
        let [_, candidates] = self.problem.locator.counts();
        Work {
            points: self.problem.numbering.points.len() as u64,
            candidates: candidates as u64,
            constraints: self.problem.constraints.len() as u64,
            iterations: self.tally.iterations,
        }
    }
}
