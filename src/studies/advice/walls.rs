//! Walls of one element that bend: one point of integration has no stiffness in bending but the hourglass resistance.

use super::{Advice, Scene};
use crate::comm::Communicator;
use crate::mesh::exterior::{SIDES, exterior};
use crate::mesh::{Block, Mesh, Shape};
use crate::model::{Model, Precision};
use crate::output::block_energies;
use crate::solver::Finding;

/// Hourglass energy over internal energy from which a wall bends.
const BENDS: f64 = 0.02;
/// Part of a block's elements that must reach through it.
const MOST: f64 = 0.5;

pub fn advice(scene: &Scene, comm: &mut dyn Communicator) -> Vec<Advice> {
    let energies = block_energies(scene.mesh.blocks.len(), scene.solver, comm);
    let share = |index: usize| energies[4 * index + 2] / energies[4 * index + 1].abs();
    let bends = |index: usize| share(index) >= BENDS;
    let thin = if (0..scene.mesh.blocks.len()).any(bends) { thin_blocks(scene.mesh, scene.model) } else { Vec::new() };
    let thin: Vec<usize> = thin.into_iter().filter(|index| bends(*index)).collect();
    let words = |index: &usize| {
        let (id, percent) = (scene.mesh.blocks[*index].id, 100.0 * share(*index));
        format!(
            "block {id} is a wall of one element that bends: its hourglass energy is {percent:.0} % of its internal energy"
        )
    };
    let mut list: Vec<Advice> = thin
        .iter()
        .map(|index| Advice::lack(words(index), "two elements through the wall, or shells".into()))
        .collect();
    list.extend(coarse(scene, &thin));
    list
}

/// Blocks whose hourglass energy has passed a tenth of their internal energy, but for those that are walls.
fn coarse(scene: &Scene, walls: &[usize]) -> Vec<Advice> {
    let found = scene.solver.findings().iter().filter_map(Finding::of_hourglass);
    let of_block = |(id, worst): (i64, f64)| {
        let index = scene.mesh.block_index(id).filter(|index| !walls.contains(index))?;
        let words = format!("the hourglass energy of block {id} came to {:.0} % of its internal energy", 100.0 * worst);
        let instead = match scene.mesh.blocks[index].shape {
            Shape::Hexahedron if scene.model.precision == Precision::Double => {
                format!("a finer mesh there, or ELEMENT, {id}, EIGHT POINTS")
            }
            _ => "a finer mesh there".to_string(),
        };
        Some(Advice::lack(words, instead))
    };
    found.filter_map(of_block).collect()
}

/// Indices of the blocks of hexahedra most of whose elements reach from one side of the body to the other, and are less thick
/// than wide; without rigid bodies, which do not bend, and elements of eight points, which have stiffness in bending.
pub fn thin_blocks(mesh: &Mesh, model: &Model) -> Vec<usize> {
    let resists = |block: &Block| model.is_rigid(block.id) || model.has_eight_points(block.id);
    // A bit for each side.
    let mut outside = vec![0u8; mesh.element_count()];
    for face in exterior(mesh.shaped(), mesh.coordinates.len(), |_| true) {
        outside[face as usize / SIDES] |= 1 << (face as usize % SIDES);
    }
    let mut first = 0;
    let mut thin = Vec::new();
    for (index, block) in mesh.blocks.iter().enumerate() {
        let own = first..first + block.len();
        first = own.end;
        if block.shape != Shape::Hexahedron || block.is_empty() || resists(block) {
            continue;
        }
        let through =
            own.clone().zip(block.hexahedra()).filter(|(element, nodes)| reaches(mesh, nodes, outside[*element]));
        if through.count() as f64 > MOST * block.len() as f64 {
            thin.push(index);
        }
    }
    thin
}

/// Whether two faces that are opposite to each other are outside and nearer than the faces are wide.
fn reaches(mesh: &Mesh, nodes: &[u32; 8], sides: u8) -> bool {
    let outside = |side: usize| sides & 1 << side != 0;
    let centre = |face: [u32; 4]| -> [f64; 3] {
        std::array::from_fn(|i| 0.25 * face.iter().map(|&node| mesh.coordinates[node as usize][i]).sum::<f64>())
    };
    let distance = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>().sqrt();
    let face = |side: usize| Shape::Hexahedron.face(nodes, side as u8);
    let apart = |a: usize| -> Option<(usize, f64)> {
        let own = face(a)?;
        let b = (0..SIDES).find(|&b| face(b).is_some_and(|other| other.iter().all(|node| !own.contains(node))))?;
        Some((b, distance(centre(own), centre(face(b)?))))
    };
    let lengths: Vec<(usize, usize, f64)> =
        (0..SIDES).filter_map(|a| apart(a).map(|(b, length)| (a, b, length))).filter(|(a, b, _)| a < b).collect();
    let others = |a: usize| lengths.iter().filter(move |(c, ..)| *c != a).map(|(.., length)| *length);
    lengths.iter().any(|(a, b, length)| outside(*a) && outside(*b) && others(*a).all(|other| other > *length))
}
