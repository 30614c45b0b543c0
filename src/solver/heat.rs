//! Artificial heat of fluids (Noh 1987): energy that goes over from element to element in shocks, and nowhere else.
//!
//! In a front that bulk viscosity has smeared speed rises as f from 0 to 1, energy as f²: without heat a front lacks the part f(1 − f)
//! of its energy, the gas behind it has that too much, and a blast runs ahead. At a node each element has the weight w = (1 − ψ) M/n,
//! 1 − ψ the part of bulk viscosity that acts in it, and in each step gives w φ (e − ē) of its energy, ē the mean there. What all give
//! adds up to nothing.

use super::elements::{ElementBlock, Group};
use super::nodes::Nodes;
use crate::mesh::Mesh;
use crate::model::Model;
use crate::partition::Share;
use super::domain::Body;

/// φ over the part of the volume by which the elements at a node shrink in a step; at most 1.
const STRENGTH: f64 = 16.0;
fn knob(name: &str, otherwise: f64) -> f64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(otherwise)
}

/// The weight of a corner at its node, and that times the element's energy per mass.
pub type Weighed = [f64; 2];

/// What goes over at the nodes of a rank.
pub struct Heat {
    /// Whether elements of one block alone meet at a node: energies of others are measured from elsewhere.
    open: Vec<bool>,
    /// φ of each node in this step.
    parts: Vec<f64>,
    /// Sums over the corners at each node; zero between steps.
    sums: Vec<Weighed>,
    /// Elements at nodes where something goes over.
    givers: Vec<Giver>,
}

/// An element that gives and takes.
struct Giver {
    block: u32,
    at_border: bool,
    place: u32,
    weighed: Weighed,
}

impl Heat {
    /// `None` where no fluid is.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body, share: &Share) -> Option<Heat> {
        if !model.has_fluids() {
            return None;
        }
        const NOBODY: u32 = u32::MAX;
        const SEVERAL: u32 = u32::MAX - 1;
        let mut owner = vec![NOBODY; mesh.coordinates.len()];
        for (nodes, &block) in body.element_nodes.iter().zip(&*body.element_block) {
            if body.is_fluid(model, block as usize) {
                for &node in nodes {
                    let owner = &mut owner[node as usize];
                    *owner = if *owner == NOBODY || *owner == block { block } else { SEVERAL };
                }
            }
        }
        let open = share.nodes.iter().map_while(|&node| owner.get(node as usize).map(|&owner| owner < SEVERAL));
        let open: Vec<bool> = open.collect();
        let parts = vec![0.0; open.len()];
        Some(Heat { sums: vec![[0.0; 2]; open.len()], open, parts, givers: Vec::new() })
    }

    /// Lets energy go over after a pass over the elements, in which the step `time_step` has ended; `shared` are the sums at nodes that
    /// ranks share.
    pub fn exchange(&mut self, blocks: &mut [ElementBlock], nodes: &Nodes, time_step: f64, shared: &[(u32, Weighed)]) {
        let (strength, most) = (knob("HEAT", STRENGTH), knob("MOST", 1.0));
        let of_nodes = self.parts.iter_mut().zip(&self.open).zip(&nodes.rates.means);
        for ((part, open), rate) in of_nodes {
            // A rate that is no number moves nothing.
            *part = if *open { (strength * time_step * (-rate).max(0.0)).min(most) } else { 0.0 };
        }
        self.gather(blocks);
        for &(node, sum) in shared {
            if let Some(own) = self.sums.get_mut(node as usize) {
                *own = sum;
            }
        }
        self.give(blocks);
        self.sums.fill([0.0; 2]);
    }

    /// Sums in canonical order what the elements have at nodes where something goes over.
    fn gather(&mut self, blocks: &[ElementBlock]) {
        self.givers.clear();
        for (number, block) in (0..).zip(blocks) {
            let Some(rows) = Rows::of(block) else { continue };
            for (at_border, place) in in_order(block) {
                let group = if at_border { &block.border } else { &block.interior };
                let moves = |node: u32| self.parts.get(node as usize).is_some_and(|part| *part > 0.0);
                if !group.nodes(place).any(moves) || !group.is_alive(place) {
                    continue;
                }
                let weighed = rows.weighed(group, place);
                for node in group.nodes(place) {
                    let sum = &mut self.sums[node as usize];
                    *sum = [sum[0] + weighed[0], sum[1] + weighed[1]];
                }
                self.givers.push(Giver { block: number, at_border, place: place as u32, weighed });
            }
        }
    }

    fn give(&self, blocks: &mut [ElementBlock]) {
        for giver in self.givers.iter().filter(|giver| giver.weighed[0] > 0.0) {
            let block = &mut blocks[giver.block as usize];
            let place = giver.place as usize;
            let [weight, weighed] = giver.weighed;
            let mut taken = 0.0;
            for node in block.at(giver.at_border).nodes(place) {
                let [weights, sum] = self.sums[node as usize];
                let part = self.parts[node as usize];
                if part > 0.0 {
                    taken += part * (weight * (sum / weights) - weighed);
                }
            }
            block.heat(giver.at_border, place, taken);
        }
    }
}

/// Tells what the elements of a block's border have at their corners, one for each in group order.
pub fn tell(block: &ElementBlock, corners: &mut [Weighed]) {
    let Some(rows) = Rows::of(block) else { return };
    for (place, own) in corners.chunks_exact_mut(block.border.corners).enumerate() {
        let alive = block.border.is_alive(place);
        own.fill(if alive { rows.weighed(&block.border, place) } else { [0.0; 2] });
    }
}

/// Elements of a block in canonical order: whether they are at the border, and their place in their group.
fn in_order(block: &ElementBlock) -> impl Iterator<Item = (bool, usize)> + '_ {
    let [border, interior] = block.groups().map(|group| &group.places[..]);
    let (mut next, mut inside) = (0, 0);
    std::iter::from_fn(move || {
        let at_border = match (border.get(next), interior.get(inside)) {
            (Some(border), Some(interior)) => border < interior,
            (border, None) => border.is_some(),
            (None, Some(_)) => false,
        };
        let from = if at_border { &mut next } else { &mut inside };
        let own = *from;
        *from += 1;
        (own < if at_border { border.len() } else { interior.len() }).then_some((at_border, own))
    })
}

/// Where elements of a fluid keep what counts here.
struct Rows {
    acting: usize,
    energies: [Option<usize>; 3],
    share: f64,
}

impl Rows {
    fn of(block: &ElementBlock) -> Option<Rows> {
        if block.rigid {
            return None;
        }
        let energies = &block.element.entry().energies;
        let energies = [Some(energies.internal), energies.viscous, energies.hourglass];
        Some(Rows { acting: block.acting()?, energies, share: 1.0 / block.border.corners as f64 })
    }

    fn weighed(&self, group: &Group, place: usize) -> Weighed {
        let share = self.share * group.value(place, self.acting);
        let energy: f64 = self.energies.iter().flatten().map(|&row| group.value(place, row)).sum();
        [share * group.element_mass(place), share * energy]
    }
}
