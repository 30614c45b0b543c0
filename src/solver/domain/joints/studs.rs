//! Beams that stand on shells, which carry their torque too softly.

use super::{Kind, Scene};
use crate::common::vector::{cross, dot, normalized, subtract};
use crate::mesh::{Block, Dimension, Mesh, Shape};
use crate::model::Model;
use std::collections::BTreeMap;

/// Cosine of the angle to the normal of a shell below which a beam rather lies in the shell than stands on it.
const STANDS: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// How many nodes there are at which beams stand on shells and nothing else carries the torque of the beams, and the first of them.
pub fn studs(mesh: &Mesh, model: &Model) -> Option<(usize, String)> {
    if mesh.dimension != Dimension::Three || !mesh.blocks.iter().any(|block| block.shape == Shape::Bar) {
        return None;
    }
    let scene = Scene::of(mesh, model);
    let of = |bar: bool| scene.blocks(Kind::Turns).filter(move |block| (block.shape == Shape::Bar) == bar);
    let position = |node: u32| mesh.coordinates[node as usize];
    // Directions of beams at each node, and then whether all of them stand on all of its shells.
    let mut beams: BTreeMap<u32, (Vec<[f64; 3]>, Option<bool>)> = BTreeMap::new();
    for ends in of(true).flat_map(Block::elements) {
        let along = normalized(subtract(position(ends[1]), position(ends[0])));
        let free = ends.iter().filter(|&&node| !scene.at(node).rotation && !scene.at(node).solid);
        free.for_each(|&node| beams.entry(node).or_default().0.extend(along));
    }
    for corners in of(false).flat_map(Block::elements) {
        // Of a triangle its last corner stands for the fourth.
        let [a, b, c, d] = [0, 1, 2, corners.len() - 1].map(|corner| position(corners[corner]));
        let across = if corners.len() == 4 { subtract(d, b) } else { subtract(c, b) };
        let Some(normal) = normalized(cross(subtract(c, a), across)) else { continue };
        for node in corners {
            if let Some((along, stand)) = beams.get_mut(node) {
                let all = along.iter().all(|along| dot(*along, normal).abs() > STANDS);
                *stand = Some(stand.unwrap_or(true) && all);
            }
        }
    }
    let mut stand = beams.iter().filter(|(_, (_, stand))| *stand == Some(true)).map(|(node, _)| *node);
    let first = stand.next()?;
    Some((1 + stand.count(), scene.told(first)))
}
