//! What contact carries from step to step, and from one local problem to the next.

use super::{LocalProblem, place};
use crate::solver::contact::check::edge_edge::EdgeContact;
use crate::solver::contact::check::node_face::{FaceContact, MAX_FACES, NO_CONTACT, NONE};
use crate::solver::contact::enforcement::carried::Carried;
use crate::solver::contact::enforcement::constraint::Origin;

/// What contact carries from step to step, by the numbers of the layout.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History {
    /// Points and the faces that they touch.
    pub points: Vec<(u32, [FaceContact; MAX_FACES])>,
    /// Pairs of edges that touch.
    pub edges: Vec<EdgeContact>,
    /// Nodes of planes with contact.
    pub planes: Vec<PlaneHistory>,
    /// Points that have cost more than to sleep in the last step, and how much more; see [`LocalProblem::costs`].
    pub costs: Vec<(u32, u32)>,
}

/// A node of a plane: its number among those of all planes, and what its contact carries.
pub type PlaneHistory = (u32, Carried);

impl LocalProblem {
    /// What is carried from step to step.
    pub fn history(&self) -> History {
        let face = |face: u32| if face == NONE { NONE } else { self.numbering.faces[face as usize] };
        let points = self.numbering.points.iter().enumerate().map(|(here, &point)| (self.history[here], point));
        let touching = points.filter(|(past, _)| *past != NO_CONTACT);
        let points =
            touching.map(|(past, point)| (point, past.map(|past| FaceContact { face: face(past.face), ..past })));
        let edges = self.edge_history.iter();
        let planes = self.planes.iter().filter(|plane_node| plane_node.carried != Carried::NOTHING);
        History {
            points: points.collect(),
            edges: edges
                .map(|past| EdgeContact { pair: past.pair.map(|e| self.numbering.edges[e as usize]), ..*past })
                .collect(),
            planes: planes.map(|plane_node| (plane_node.number, plane_node.carried)).collect(),
            costs: self.costs(),
        }
    }

    /// Puts back what was carried, as far as it concerns what is here.
    pub fn restore(&mut self, mut history: History) {
        for (point, pasts) in history.points {
            let here = place(&self.numbering.points, point) as usize;
            if here < self.history.len() {
                let mine = self.history.own(here);
                *mine = pasts.map(|past| FaceContact { face: place(&self.numbering.faces, past.face), ..past });
                // Those first whose faces are left.
                mine.sort_by_key(|past| past.face == NONE);
            }
        }
        history.edges.sort_by_key(|past| past.pair);
        let edge = |edge: u32| self.numbering.edges.binary_search(&edge).ok().map(|edge| edge as u32);
        let pairs = history.edges.into_iter().filter_map(|past| {
            let [first, second] = past.pair;
            Some(EdgeContact { pair: [edge(first)?, edge(second)?], ..past })
        });
        self.edge_history = pairs.collect();
        for (number, carried) in history.planes {
            if let Ok(plane_node) = self.planes.binary_search_by_key(&number, |plane_node| plane_node.number) {
                self.planes[plane_node].carried = carried;
            }
        }
    }

    /// Forgets what points that others stop might have met, where it has borne no force. From the last place on: those that are left begin at the first.
    pub(super) fn forget_idle(&mut self) {
        for (point, place) in self.stopped.drain(..).rev() {
            let places = &mut self.history.own(point as usize)[place as usize..];
            if places[0].carried.normal_force <= 0.0 {
                places[0] = NO_CONTACT[0];
                places.rotate_left(1);
            }
        }
    }

    /// Keeps the force of a constraint: the iterations of the next step begin with it.
    pub(super) fn remember(&mut self, constraint: usize) {
        let c = self.constraints[constraint];
        match c.origin {
            // What others may push to a face has its turn in the next step.
            Origin::Face(_, place) if self.history[c.members[0] as usize][place as usize].face == NONE => (),
            Origin::Face(_, place) => {
                let past = &mut self.history.own(c.members[0] as usize)[place as usize];
                past.carried = c.carried;
                // What has a thickness touches around its borders, along normals of its own for each of two contacts.
                let is_of_solids = self.faces.distance(c.members[0], past.face) == 0.0;
                past.yields = is_of_solids && self.enforcer.yields(constraint);
            }
            Origin::Edges(first, second) => {
                let pair = [first, second].map(|edge| place(&self.numbering.edges, edge));
                if let Ok(i) = self.edge_history.binary_search_by(|past| past.pair.cmp(&pair)) {
                    self.edge_history[i].carried = c.carried;
                }
            }
            Origin::Plane(number) => {
                if let Ok(plane_node) = self.planes.binary_search_by_key(&number, |plane_node| plane_node.number) {
                    self.planes[plane_node].carried = c.carried;
                }
            }
        }
    }
}
