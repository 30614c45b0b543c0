//! What an element is seen to have: the values that the plot file shows and DEATH watches.

use super::hex8::rows;
use super::kinematics::rotation_matrix;
use super::{ElementBlock, Group, logarithm};
use crate::lanes::{Matrix3, Sym3};
use crate::mesh::check::hexahedron_volume;
use crate::mesh::corners::least_corner;
use crate::model::ElementField;
use crate::solver::nodes::Nodes;

/// Most components of a field.
const MOST: usize = 9;

/// The components of a field at the `i`-th element of a group, as [`ElementField::components`] names them; zeros follow.
/// `rank` is the one that computes the element.
pub fn field_values(
    field: ElementField,
    block: &ElementBlock,
    group: &Group,
    i: usize,
    nodes: &Nodes,
    rank: usize,
) -> [f64; MOST] {
    let in_space = |own: Sym3<f64>| own.rotate(&frame(group, i)).to_array();
    let initial_volume = group.element_mass(i) / block.density;
    match field {
        ElementField::Stress => filled(&in_space(stress(group, i))),
        ElementField::Strain => filled(&in_space(logarithm(tensor(group, i, rows::STRETCH)))),
        ElementField::Pressure => filled(&[-stress(group, i).trace() / 3.0]),
        ElementField::VonMises => {
            let s = stress(group, i).deviator();
            filled(&[(1.5 * s.contract(s)).sqrt()])
        }
        ElementField::Energy => filled(&[group.value(i, rows::INTERNAL_ENERGY) / initial_volume]),
        ElementField::HourglassEnergy => filled(&[group.value(i, rows::HOURGLASS_ENERGY) / initial_volume]),
        ElementField::Density => filled(&[group.element_mass(i) / volume(group, i, nodes)]),
        ElementField::Stretch => filled(&in_space(tensor(group, i, rows::STRETCH))),
        ElementField::Rotation => filled(frame(group, i).as_flattened()),
        ElementField::BulkViscosity => filled(&[-group.value(i, rows::VISCOUS_STRESS)]),
        ElementField::Corners => filled(&[least_corner(&group.nodes(i), &positions(group, i, nodes))]),
        ElementField::Status => filled(&[1.0]),
        ElementField::Rank => filled(&[rank as f64]),
    }
}

/// The state variables of an element's law, in the order in which the law lists them.
pub fn state_values(block: &ElementBlock, group: &Group, i: usize) -> Vec<f64> {
    let stored: Vec<f64> = (0..block.state_names.len()).map(|k| group.value(i, rows::LAW + k)).collect();
    block.law.state(&stored, &frame(group, i))
}

/// Cauchy stress without bulk viscosity, in the frame of the element.
pub fn stress(group: &Group, i: usize) -> Sym3<f64> {
    tensor(group, i, rows::STRESS)
}

/// Positions of an element's nodes.
pub fn positions(group: &Group, i: usize, nodes: &Nodes) -> [[f64; 3]; 8] {
    group.nodes(i).map(|node| nodes.position(node))
}

/// Volume of an element.
pub fn volume(group: &Group, i: usize, nodes: &Nodes) -> f64 {
    hexahedron_volume(&positions(group, i, nodes))
}

/// The rotation from an element's frame into space.
pub fn frame(group: &Group, i: usize) -> Matrix3<f64> {
    rotation_matrix(&group.values::<4>(i, rows::FRAME))
}

fn tensor(group: &Group, i: usize, first: usize) -> Sym3<f64> {
    let [xx, yy, zz, xy, yz, zx] = group.values::<6>(i, first);
    Sym3 { xx, yy, zz, xy, yz, zx }
}

fn filled(values: &[f64]) -> [f64; MOST] {
    let mut all = [0.0; MOST];
    all[..values.len()].copy_from_slice(values);
    all
}
