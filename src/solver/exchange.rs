//! Swap and add: force sums at nodes that several ranks share, in the canonical order of the whole body.
//!
//! Every rank sends its elements' contributions at a shared node apart, not summed, so that each sharer can add
//! all of them in canonical order and gets the bits that a single rank would have got.

use crate::comm::{Communicator, Peer};
use crate::lanes::Force;
use crate::partition::{Share, Source};

/// Buffers and plan of the exchange.
pub struct Exchange {
    /// Contributions kept apart, to be subtracted from the nodes: eight per border element in canonical order, then
    /// four per loaded face.
    pub slots: Vec<Force>,
    /// Number of border elements.
    pub border_elements: usize,
    peers: Vec<Peer>,
    /// The share's plan of messages and sums, its slots numbered as in `slots`.
    plan: Share,
}

impl Exchange {
    /// From a rank's share of the body: its elements and its loaded faces.
    pub fn new(share: &Share) -> Exchange {
        let compact = CompactSlots::new(share);
        let faces: usize = share.groups[1..].iter().map(|faces| faces.nodes.len()).sum();
        let mut plan = Share { groups: Vec::new(), nodes: Vec::new(), owned: Vec::new(), ..share.clone() };
        for slot in plan.neighbours.iter_mut().flat_map(|neighbour| &mut neighbour.send) {
            *slot = compact.slot(*slot);
        }
        for source in &mut plan.sources {
            if let Source::Local(slot) = source {
                *slot = compact.slot(*slot);
            }
        }
        Exchange {
            slots: vec![Force::default(); 8 * compact.border_elements + faces],
            border_elements: compact.border_elements,
            peers: share.peers(3),
            plan,
        }
    }

    /// Packs and sends this rank's contributions.
    pub fn start(&mut self, comm: &mut dyn Communicator) {
        if self.peers.is_empty() {
            return;
        }
        self.plan.pack(&mut self.peers, |slot| negative(&self.slots[slot as usize]));
        comm.start_exchange(&mut self.peers);
    }

    /// Waits for the others' contributions and replaces the sums at shared nodes.
    pub fn finish(&mut self, comm: &mut dyn Communicator, forces: &mut [Force]) {
        if self.peers.is_empty() {
            return;
        }
        comm.finish_exchange(&mut self.peers);
        let own = |slot: u32| negative(&self.slots[slot as usize]);
        self.plan.sum(&self.peers, own, |node, [x, y, z]| forces[node as usize] = Force([x, y, z, 0.0]));
    }
}

/// What subtracting a contribution adds: the same bits as the subtraction itself.
fn negative(force: &Force) -> [f64; 3] {
    [-force.0[0], -force.0[1], -force.0[2]]
}

/// Numbers of the slots that are really kept: those of border elements and of loaded faces.
struct CompactSlots {
    border_elements: usize,
    elements: usize,
    /// Border elements before each local element.
    before: Vec<u32>,
}

impl CompactSlots {
    fn new(share: &Share) -> CompactSlots {
        let border = &share.groups[0].border;
        let mut count = 0u32;
        let before = border
            .iter()
            .map(|&border| {
                let before = count;
                count += u32::from(border);
                before
            })
            .collect();
        CompactSlots { border_elements: count as usize, elements: border.len(), before }
    }

    fn slot(&self, slot: u32) -> u32 {
        let all = 8 * self.elements as u32;
        if slot < all {
            8 * self.before[slot as usize / 8] + slot % 8
        } else {
            8 * self.border_elements as u32 + (slot - all)
        }
    }
}
