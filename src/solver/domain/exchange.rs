//! Swap and add: force sums at nodes that several ranks share, in the canonical order of the whole body.
//!
//! Every rank sends its elements' contributions at a shared node apart, not summed, so that each sharer can add
//! all of them in canonical order and gets the bits that a single rank would have got.

use crate::comm::{Communicator, Peer};
use crate::lanes::Force;
use crate::partition::{LocalGroup, Share};
use std::borrow::Cow;

/// Buffers and plan of the exchange.
pub struct Exchange {
    /// Contributions kept apart, to be subtracted from the nodes: one per corner of the border elements in canonical order,
    /// then one per corner of the loaded faces.
    pub slots: Vec<Force>,
    /// Place of the first corner of the first loaded face among them.
    pub first_face: usize,
    peers: Vec<Peer>,
    /// Whether the fourth numbers travel, too: they say something where there are fluids.
    rates: bool,
    /// Messages and sums, their slots numbered as in `slots`.
    plan: Share,
}

impl Exchange {
    /// From a rank's share of the body: its elements and its loaded faces. With `rates` the fourth numbers travel, too.
    pub fn new(share: &Share, rates: bool) -> Exchange {
        let share = match share.has_border_alone() {
            true => Cow::Borrowed(share),
            false => Cow::Owned(share.clone().with_border_alone()),
        };
        let corners = |group: &LocalGroup| group.nodes.nodes().len();
        Exchange {
            slots: vec![Force::default(); share.groups.iter().map(corners).sum()],
            first_face: corners(&share.groups[0]),
            peers: share.peers(if rates { 4 } else { 3 }),
            rates,
            plan: share.plan(),
        }
    }

    /// Packs and sends this rank's contributions.
    pub fn start(&mut self, comm: &mut dyn Communicator) {
        if self.peers.is_empty() {
            return;
        }
        let own = |slot: u32| negative(&self.slots[slot as usize]);
        if self.rates {
            self.plan.pack(&mut self.peers, own);
        } else {
            self.plan.pack(&mut self.peers, |slot| without_rate(own(slot)));
        }
        comm.start_exchange(&mut self.peers);
    }

    /// Waits for the others' contributions and replaces the sums at shared nodes.
    pub fn finish(&mut self, comm: &mut dyn Communicator, forces: &mut [Force]) {
        if self.peers.is_empty() {
            return;
        }
        comm.finish_exchange(&mut self.peers);
        let own = |slot: u32| negative(&self.slots[slot as usize]);
        if self.rates {
            self.plan.sum(&self.peers, own, |node, sum| forces[node as usize] = Force(sum));
        } else {
            let own = |slot: u32| without_rate(own(slot));
            self.plan.sum(&self.peers, own, |node, [x, y, z]| forces[node as usize] = Force([x, y, z, 0.0]));
        }
    }
}

/// What subtracting a contribution adds: the same bits as the subtraction itself.
fn negative(force: &Force) -> [f64; 4] {
    force.0.map(|number| -number)
}

fn without_rate([x, y, z, _]: [f64; 4]) -> [f64; 3] {
    [x, y, z]
}
