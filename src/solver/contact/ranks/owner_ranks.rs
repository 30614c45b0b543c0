//! Which rank owns which point: two decompositions, one of the points that are busy and one of all others.
//!
//! Contact happens in a small part of most bodies. A cut that shares out all points evenly would leave that part to one rank,
//! for which all others wait in every step; one that shares out what is busy evenly would leave nearly all others to one rank, for
//! which all wait in every search. Each kind is shared out by itself instead. A kind that the decomposition of the elements shares
//! out well enough stays with the owners of its nodes, where nobody need send its motion.

use super::node_ranks::NodeRanks;
use crate::comm::Communicator;
use crate::model::ContactDecomposition;
use crate::partition::dynamic::{self, Axes, Bisection, Earlier, Parcels};
use crate::solver::contact::nodes::ContactNodes;

/// A cut stays where it is while it shares out its points to within this part. Where contact happens is not spread as
/// evenly as points are, so that exact cuts would gain little, and to find them anew takes many rounds.
const SLACK: f64 = 0.1;

/// Points of a kind stay with the owners of their nodes while none of these has more than this part of its share
/// too much. To send motion in every step and faces in every search costs about as much as to wait for a rank that has more.
const UNEVEN: f64 = 0.25;

/// How points are shared out, and the cuts of the last time.
pub struct OwnerRanks {
    method: ContactDecomposition,
    /// Cuts of the points that are busy, and of all others.
    cuts: [Option<Bisection>; 2],
}

impl OwnerRanks {
    /// By a method of the deck.
    pub fn new(method: ContactDecomposition) -> OwnerRanks {
        OwnerRanks { method, cuts: [None, None] }
    }

    /// The new owner rank of every contact node of this rank. `costs` are the points that have been busy in the last step, and what
    /// each has cost; a point may be named on many ranks, and more than once. All ranks call it.
    pub fn find(
        &mut self,
        contact_nodes: &ContactNodes,
        node_ranks: &NodeRanks,
        costs: &[(u32, u32)],
        comm: &mut dyn Communicator,
    ) -> Vec<u32> {
        let list = &contact_nodes.list;
        let mut owners: Vec<u32> = list.iter().map(|contact_node| node_ranks.owner(contact_node.point)).collect();
        let axes = match self.method {
            ContactDecomposition::Bisection => Axes::Widest,
            ContactDecomposition::Slices => Axes::One,
            ContactDecomposition::Static => return owners,
        };
        let busy = weights(contact_nodes, node_ranks, costs, comm);
        let others = busy.iter().map(|&weight| u32::from(weight == 0)).collect();
        let weights = [busy, others];
        let even = are_even(contact_nodes, &weights, comm);
        for (kind, _) in even.into_iter().enumerate().filter(|(_, is_even)| !is_even) {
            self.share_out(kind, axes, contact_nodes, &weights[kind], &mut owners, comm);
        }
        owners
    }

    /// Gives the contact nodes of one kind, whose weights are above zero, the owner ranks of cuts that share them out.
    fn share_out(
        &mut self,
        kind: usize,
        axes: Axes,
        contact_nodes: &ContactNodes,
        weights: &[u32],
        owners: &mut [u32],
        comm: &mut dyn Communicator,
    ) {
        let (mut places, mut ids, mut own_weights) = (Vec::new(), Vec::new(), Vec::new());
        for ((i, contact_node), &weight) in (0..).zip(&contact_nodes.list).zip(weights) {
            if contact_node.owned && weight > 0 {
                places.push(contact_nodes.motion.start(i));
                ids.push(contact_node.point);
                own_weights.push(weight);
            }
        }
        let earlier = self.cuts[kind].as_ref().map(|cuts| Earlier { cuts, slack: SLACK });
        let balanced = dynamic::balance(&places, &ids, &own_weights, axes, earlier, comm);
        let cuts = self.cuts[kind].insert(balanced.bisection);
        for ((i, contact_node), owner) in (0..).zip(&contact_nodes.list).zip(owners) {
            if weights[i as usize] > 0 {
                *owner = cuts.owner(contact_nodes.motion.start(i), contact_node.point);
            }
        }
    }
}

/// Of each kind, whether no rank has much more than its share of the nodes that it owns. All ranks call it.
fn are_even(contact_nodes: &ContactNodes, weights: &[Vec<u32>; 2], comm: &mut dyn Communicator) -> [bool; 2] {
    let sum = |weights: &Vec<u32>| -> u64 {
        let owned = contact_nodes.list.iter().zip(weights).filter(|(contact_node, _)| contact_node.owned);
        owned.map(|(_, &weight)| u64::from(weight)).sum()
    };
    let mut all = weights.each_ref().map(sum);
    let mut most = all.map(|own| -(own as f64));
    comm.all_sum(&mut all);
    comm.all_min(&mut most);
    [0, 1].map(|kind| -most[kind] * comm.size() as f64 <= (1.0 + UNEVEN) * all[kind] as f64)
}

/// What each contact node has cost, and at least one where it has been busy; else 0. Every rank that has the node knows it.
fn weights(
    contact_nodes: &ContactNodes,
    node_ranks: &NodeRanks,
    costs: &[(u32, u32)],
    comm: &mut dyn Communicator,
) -> Vec<u32> {
    let mut parcels = Parcels::new(&*comm, 1);
    for &(point, cost) in costs {
        node_ranks.holders(point).iter().for_each(|&holder| parcels.add(holder, point, &[f64::from(cost)]));
    }
    let mut weights = vec![0; contact_nodes.list.len()];
    for (point, [cost]) in parcels.exchange(comm).rows() {
        if let Some(contact_node) = contact_nodes.of(point) {
            weights[contact_node] = weights[contact_node].max(1) + cost as u32;
        }
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::run_threads;
    use crate::solver::contact::geometry::motion::NodeMotion;

    const POINTS: u32 = 100;

    /// A hundred points in a row, on two ranks of which each owns the nodes of one half. Both ranks say of each
    /// that `is_busy` names that it has cost two.
    fn shared_out(method: ContactDecomposition, is_busy: impl Fn(u32) -> bool + Sync) -> Vec<u32> {
        let results = run_threads(2, |comm| {
            let rank = comm.rank() as u32;
            let mut motion = NodeMotion::new(POINTS as usize, [0.0; 3]);
            (0..POINTS).for_each(|point| motion.receive(point, [point.into(), 0., 0., 0., 0., 0., 0., 0., 0.]));
            let mut contact_nodes = ContactNodes::still(&motion);
            contact_nodes.list.iter_mut().for_each(|of| of.owned = of.point / (POINTS / 2) == rank);
            let node_ranks = NodeRanks::gather(POINTS as usize, &contact_nodes, comm);
            let costs: Vec<(u32, u32)> = (0..POINTS).filter(|&point| is_busy(point)).map(|point| (point, 2)).collect();
            Ok::<_, ()>(OwnerRanks::new(method).find(&contact_nodes, &node_ranks, &costs, comm))
        });
        let results = results.unwrap_or_else(|_| panic!("a rank failed"));
        assert_eq!(results[0], results[1]);
        results[0].clone()
    }

    fn on_second(owners: &[u32], points: std::ops::Range<usize>) -> usize {
        owners[points].iter().filter(|&&owner| owner == 1).count()
    }

    /// What is busy in the half of one rank goes to both alike, and so does all else, of which that rank has little.
    #[test]
    fn each_kind_is_shared_out_by_itself() {
        let owners = shared_out(ContactDecomposition::Bisection, |point| point < 40);
        assert_eq!((on_second(&owners, 0..40), on_second(&owners, 40..100)), (20, 30));
        // A kind that is nearly even stays: of what is busy 12 and 10, of all else 38 and 40.
        let owners = shared_out(ContactDecomposition::Bisection, |point| (38..60).contains(&point));
        assert!((0..POINTS).zip(&owners).all(|(point, &owner)| owner == point / 50));
    }

    #[test]
    fn owner_ranks_are_those_of_nodes_if_the_deck_says_so() {
        let owners = shared_out(ContactDecomposition::Static, |point| point < 40);
        assert!((0..POINTS).zip(&owners).all(|(point, &owner)| owner == point / 50));
    }
}
