//! Swap and add: force sums at nodes that several ranks share, in the canonical order of the whole body.
//!
//! Every rank sends its elements' contributions at a shared node apart, not summed, so that each sharer can add
//! all of them in canonical order and gets the bits that a single rank would have got.

use crate::comm::{Communicator, Peer};
use crate::lanes::Force;
use crate::mesh::Connectivity;
use crate::partition::{LocalGroup, Share, Source};
use crate::solver::heat::Weighed;

/// Buffers and plan of the exchange.
pub struct Exchange {
    /// Contributions kept apart, to be subtracted from the nodes: one per corner of the border elements in canonical order,
    /// then one per corner of the loaded faces.
    pub slots: Vec<Force>,
    /// What corners of fluids weigh for artificial heat, in the same order; empty where there are none.
    pub weighed: Vec<Weighed>,
    /// Sums of that at the nodes that ranks share.
    pub weights: Vec<(u32, Weighed)>,
    /// Place of the first corner of the first loaded face among them.
    pub first_face: usize,
    peers: Vec<Peer>,
    /// The share's plan of messages and sums, its slots numbered as in `slots`.
    plan: Share,
}

impl Exchange {
    /// From a rank's share of the body: its elements and its loaded faces. With `fluids` the fourth numbers travel, too, and what
    /// corners weigh.
    pub fn new(share: &Share, fluids: bool) -> Exchange {
        let compact = CompactSlots::new(share);
        let faces: usize = share.groups[1..].iter().map(|faces| faces.nodes.nodes().len()).sum();
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
            slots: vec![Force::default(); compact.kept as usize + faces],
            weighed: vec![[0.0; 2]; if fluids { compact.kept as usize + faces } else { 0 }],
            weights: Vec::new(),
            first_face: compact.kept as usize,
            peers: share.peers(if fluids { 6 } else { 3 }),
            plan,
        }
    }

    /// Packs and sends this rank's contributions.
    pub fn start(&mut self, comm: &mut dyn Communicator) {
        if self.peers.is_empty() {
            return;
        }
        let Exchange { slots, weighed, peers, plan, .. } = self;
        if weighed.is_empty() {
            plan.pack(peers, |slot| force_alone(&slots[slot as usize]));
        } else {
            plan.pack(peers, |slot| all(&slots[slot as usize], &weighed[slot as usize]));
        }
        comm.start_exchange(peers);
    }

    /// Waits for the others' contributions and replaces the sums at shared nodes.
    pub fn finish(&mut self, comm: &mut dyn Communicator, forces: &mut [Force]) {
        if self.peers.is_empty() {
            return;
        }
        comm.finish_exchange(&mut self.peers);
        let Exchange { slots, weighed, weights, peers, plan, .. } = self;
        if weighed.is_empty() {
            let own = |slot: u32| force_alone(&slots[slot as usize]);
            plan.sum(peers, own, |node, [x, y, z]| forces[node as usize] = Force([x, y, z, 0.0]));
        } else {
            weights.clear();
            let own = |slot: u32| all(&slots[slot as usize], &weighed[slot as usize]);
            plan.sum(peers, own, |node, [x, y, z, rate, weight, energy]| {
                forces[node as usize] = Force([x, y, z, rate]);
                weights.push((node, [weight, energy]));
            });
        }
    }
}

/// What subtracting a contribution adds: the same bits as the subtraction itself.
fn force_alone(force: &Force) -> [f64; 3] {
    let [x, y, z, _] = force.0;
    [-x, -y, -z]
}

/// The same with the fourth number, and what the corner weighs.
fn all(force: &Force, [weight, energy]: &Weighed) -> [f64; 6] {
    let [x, y, z, rate] = force.0;
    [-x, -y, -z, -rate, *weight, *energy]
}

/// Numbers of the slots that are really kept: those of border elements and of loaded faces.
struct CompactSlots<'a> {
    elements: &'a Connectivity,
    /// The first kept slot of each local element that is at the border.
    first: Vec<u32>,
    /// Slots of border elements.
    kept: u32,
}

impl CompactSlots<'_> {
    fn new(share: &Share) -> CompactSlots<'_> {
        let LocalGroup { nodes: elements, border, .. } = &share.groups[0];
        let mut kept = 0u32;
        let first = (border.iter().zip(elements.iter()))
            .map(|(&border, nodes)| {
                let first = kept;
                kept += if border { nodes.len() as u32 } else { 0 };
                first
            })
            .collect();
        CompactSlots { elements, first, kept }
    }

    fn slot(&self, slot: u32) -> u32 {
        let all = self.elements.nodes().len() as u32;
        if slot < all {
            let (element, corner) = self.elements.corner(slot as usize);
            self.first[element] + corner as u32
        } else {
            self.kept + (slot - all)
        }
    }
}
