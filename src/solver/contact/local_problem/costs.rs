//! What the points of a local problem cost in a step: the next decomposition shares that out.

use super::LocalProblem;
use crate::solver::contact::check::node_face::NONE;

/// What a slave node costs that is awake, in tenths of a microsecond or so.
const AWAKE: u32 = 4;

/// The same of each face that holds it: its check, and its constraint in the iterations.
const HELD: u32 = 10;

/// The same of a pair of edges that is looked at; its first edge answers for it.
const PAIR: u32 = 1;

impl LocalProblem {
    /// Points that were busy in the last step, by numbers of the layout, and what each cost: slave nodes that are awake and
    /// ends of edges that are due, and, for nothing, what they may meet, so that constraints act on points of one rank. A
    /// point may be named more than once.
    pub(super) fn costs(&self) -> Vec<(u32, u32)> {
        let LocalProblem { locator, numbering, edges, faces, .. } = self;
        let number = |point: u32| numbering.points[point as usize];
        let (mut costs, mut is_met) = (Vec::new(), vec![false; numbering.points.len()]);
        for (i, &point) in locator.slave_nodes().iter().enumerate().filter(|(i, _)| !locator.is_quiet(*i)) {
            let held = self.history[point as usize].iter().filter(|past| past.face != NONE).count() as u32;
            costs.push((number(point), AWAKE + HELD * held));
            for face in locator.awake(i).map(|candidate| candidate.face) {
                faces.corners[face as usize].iter().for_each(|&corner| is_met[corner as usize] = true);
            }
        }
        let due = locator.edge_pairs().iter().enumerate().filter(|(place, _)| locator.is_pair_due(*place));
        let due = due.map(|(_, pair)| (pair, PAIR));
        for ([first, second], cost) in due.chain(self.edge_history.iter().map(|past| (&past.pair, HELD))) {
            let ends = edges[*first as usize].ends;
            costs.push((number(ends[0]), cost));
            is_met[ends[1] as usize] = true;
            edges[*second as usize].points(faces).iter().for_each(|&point| is_met[point as usize] = true);
        }
        costs.extend((0..).zip(is_met).filter(|(_, is_met)| *is_met).map(|(point, _)| (number(point), 0)));
        costs
    }
}
