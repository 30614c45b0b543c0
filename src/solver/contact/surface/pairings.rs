//! What holds where a point touches a face: friction, and how the two share the roles of slave and master.

use crate::mesh::Mesh;
use crate::model::{Friction, Model};
use crate::solver::Body;
use crate::solver::contact::search::locate::Rule;

/// What holds where a point of one kind touches a face of another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pairing {
    /// Coulomb friction.
    pub friction: Friction,
    /// Share of the slave role of the point, that of the master role of the face.
    pub share: f64,
}

/// Pairings by the blocks of point and face, and by interface.
#[derive(Debug, Clone, Default)]
pub struct Pairings {
    blocks: Vec<Pairing>,
    count: usize,
    pairs: Vec<Pairing>,
    /// Whether there is friction anywhere.
    pub have_friction: bool,
}

impl Pairings {
    /// What holds where a point of block `point` touches a face of block `face` through an interface.
    pub fn of(&self, rule: Rule, point: u32, face: u32) -> Pairing {
        match rule {
            Rule::Blocks => self.blocks[point as usize * self.count + face as usize],
            Rule::Pair(number) => self.pairs[number as usize],
        }
    }

    /// Pairings of all blocks and of all pairs of side sets.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body) -> Pairings {
        let count = mesh.blocks.len();
        let impedance = |block: usize| {
            let material = &model.materials[body.block_material[block]];
            (material.density * material.law.moduli().dilatational()).sqrt()
        };
        let pairing = |point: usize, face: usize| {
            let ids = [mesh.blocks[point].id, mesh.blocks[face].id];
            let by_impedance = if point == face { 0.5 } else { impedance(face) / (impedance(point) + impedance(face)) };
            // The last command about two blocks holds, whichever it names first.
            let data = model.contact.data.iter().rev().find_map(|data| match data.materials {
                [a, b] if [b, a] == ids => Some((data, data.partition)),
                [a, b] if [a, b] == ids => Some((data, data.partition.map(|partition| 1.0 - partition))),
                _ => None,
            });
            match data {
                // A material is neither master nor slave of itself.
                Some((data, _)) if point == face => Pairing { friction: data.friction, share: 0.5 },
                Some((data, share)) => Pairing { friction: data.friction, share: share.unwrap_or(by_impedance) },
                None => Pairing { friction: Friction::default(), share: by_impedance },
            }
        };
        let blocks: Vec<Pairing> = (0..count * count).map(|i| pairing(i / count, i % count)).collect();
        let pairs = model.contact.surfaces.iter().flat_map(|pair| {
            // Points of the first set on faces of the second, then the other way round.
            let partition = if pair.side_sets[0] == pair.side_sets[1] { 0.5 } else { pair.partition };
            [1.0 - partition, partition].map(|share| Pairing { friction: pair.friction, share })
        });
        let pairs: Vec<Pairing> = pairs.collect();
        let have_friction = blocks.iter().chain(&pairs).any(|pairing| pairing.friction != Friction::default());
        Pairings { blocks, count, pairs, have_friction }
    }
}
