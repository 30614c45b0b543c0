//! What came of a step's constraints: told to the nodes, to histories that watch blocks, and to what the run has seen so far.

use super::LocalProblem;
use crate::common::vector::dot;
use crate::model::RigidSurface;
use crate::solver::constraints::StepTimes;
use crate::solver::contact::check::node_face::NONE;
use crate::solver::contact::enforcement::accounts::resultants::{Resultants, Share, Side};
use crate::solver::contact::enforcement::carried::Carried;
use crate::solver::contact::enforcement::constraint::{Constraint, Origin};
use crate::solver::contact::geometry::projection::area_normal;
use crate::solver::contact::nodes::result::{Details, Status};
use crate::solver::contact::observations::arcs::{Arcs, OPPOSED};
use crate::solver::contact::observations::meetings::Meetings;
use crate::solver::contact::observations::seen::Seen;

impl LocalProblem {
    /// Records in `seen` what the contacts of this step did; `when` is its time, and the number of steps before it.
    pub fn record(&self, seen: &mut Seen, when: (f64, u64)) {
        for (c, state) in self.enforcer.touched(&self.constraints) {
            seen.slid |= state.slid;
            if c.carried.normal_force > 0.0 {
                seen.touch(c, when);
            }
            if let Origin::Plane(number) = c.origin {
                let node = self.planes.binary_search_by_key(&number, |node| node.number);
                node.into_iter().for_each(|node| seen.push(self.planes[node].plane));
            }
        }
    }

    /// Records in `arcs` which nodes are pushed in this step, the `look`-th at which it looks.
    pub fn record_arcs(&self, arcs: &mut Arcs, look: u32) {
        let LocalProblem { faces, numbering, motion, .. } = self;
        for (c, _) in self.enforcer.pushing(&self.constraints).filter(|(c, _)| !matches!(c.origin, Origin::Edges(..))) {
            let point = c.members[0];
            let Some(&number) = numbering.points.get(point as usize) else { continue };
            arcs.touch(number, look);
            for &face in faces.around(point) {
                let number = numbering.faces[face as usize];
                let normal = || area_normal(&faces.end(face, motion));
                let looks = |normal: [f64; 3]| dot(normal, c.normal) < OPPOSED * dot(normal, normal).sqrt();
                if arcs.waits(number) && looks(normal()) {
                    arcs.meet(number);
                }
            }
        }
    }

    /// Counts the candidates of the last search by the blocks of node and face.
    pub fn count_candidates(&self, met: &mut Meetings) {
        for (point, candidates) in self.locator.candidates() {
            let block = self.point_block[point as usize];
            candidates.iter().for_each(|candidate| met.count(block, self.faces.block[candidate.face as usize]));
        }
    }

    /// Books what the contacts of this step do to whom the deck watches. `mine` says for which points this rank answers, `ids` are
    /// the numbers of the blocks.
    pub fn book(
        &self,
        resultants: &mut Resultants,
        (planes, ids): (&[RigidSurface], &[i64]),
        step: &StepTimes,
        mine: impl Fn(usize) -> bool,
    ) {
        let id = |block: u32| Side::Block(ids.get(block as usize).copied().unwrap_or_default());
        resultants.begin_step();
        for (c, state) in self.enforcer.pushing(&self.constraints) {
            let Some((sides, others)) = self.sides(c, planes, id).filter(|_| mine(c.members[0] as usize)) else {
                continue;
            };
            let mut shares = [Share::default(); 2];
            for (place, (point, weight)) in c.parts().enumerate() {
                let before = self.motion.velocity_before(point as u32);
                let after = self.enforcer.velocity_after(point, state, &self.motion);
                shares[usize::from(place >= others)].add(c, weight, [before, after], step.kick);
            }
            resultants.book(sides, &shares, step);
        }
    }

    /// Whose members a constraint joins, and the place of the first member of the second side.
    fn sides(&self, c: &Constraint, planes: &[RigidSurface], id: impl Fn(u32) -> Side) -> Option<([Side; 2], usize)> {
        let LocalProblem { faces, edges, history, numbering, point_block, .. } = self;
        let point = c.members[0] as usize;
        match c.origin {
            Origin::Face(_, place) => {
                let face = history.get(point)?.get(place as usize)?.face;
                Some(([id(*point_block.get(point)?), id(*faces.block.get(face as usize)?)], 1))
            }
            Origin::Edges(first, second) => {
                let block = |edge: u32| {
                    let edge = &edges[numbering.edges.binary_search(&edge).ok()?];
                    faces.block.get(edge.faces[0] as usize).copied()
                };
                Some(([id(block(first)?), id(block(second)?)], 2))
            }
            Origin::Plane(number) => {
                let node = self.planes.binary_search_by_key(&number, |node| node.number).ok()?;
                let wall = planes.get(self.planes[node].plane as usize)?.side_set;
                Some(([id(*point_block.get(point)?), Side::Wall(wall)], 1))
            }
        }
    }

    /// Says what contact does to each node.
    pub(super) fn tell_nodes(&mut self) {
        self.loaded.drain(..).for_each(|point| self.results.reset(point as usize));
        for c in self.constraints.iter().filter(|c| c.carried.normal_force > 0.0) {
            for (point, _) in c.parts() {
                let result = self.results.own(point);
                if result.details.status == Status::Free {
                    self.loaded.push(point as u32);
                    result.normal_force = self.enforcer.normal_force[point];
                    result.tangential_force = self.enforcer.friction_force[point];
                    result.details.status = Status::Loaded;
                }
            }
            let on_face = self.on_face(c);
            let Details { gap, status, face, plane_force } = &mut self.results.own(c.members[0] as usize).details;
            *gap = gap.min(c.gap);
            match c.origin {
                Origin::Face(..) if *status != Status::OnFace => (*status, *face) = on_face.unwrap_or((*status, *face)),
                Origin::Plane(_) => {
                    let Carried { normal_force, tangential_force, .. } = c.carried;
                    (0..3).for_each(|i| plane_force[i] += normal_force * c.normal[i] + tangential_force[i])
                }
                Origin::Face(..) | Origin::Edges(..) => (),
            }
        }
        // What yields has no force of its own, but it is on its face as much as the node that pushes it.
        for c in self.constraints.iter().filter(|c| c.yields) {
            let point = c.members[0] as usize;
            let (on_face, is_loaded) = (self.on_face(c), self.results[point].details.status == Status::Loaded);
            if let Some((status, face)) = on_face.filter(|_| is_loaded) {
                let details = &mut self.results.own(point).details;
                *details = Details { gap: details.gap.min(c.gap), status, face, ..*details };
            }
        }
        self.loaded.sort_unstable();
    }

    /// What is told of a node that touches the face of a constraint; `None` where that is of no face.
    fn on_face(&self, c: &Constraint) -> Option<(Status, u32)> {
        let Origin::Face(_, place) = c.origin else { return None };
        let touched = self.history.get(c.members[0] as usize)?.get(place as usize)?.face;
        (touched != NONE).then(|| (Status::OnFace, self.faces.number[touched as usize]))
    }
}
