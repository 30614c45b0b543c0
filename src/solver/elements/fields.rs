//! What an element is seen to have: the values that the plot file shows and DEATH watches.

use super::{ElementBlock, Energies, Group};
use crate::lanes::Sym3;
use crate::model::ElementField;
use crate::solver::nodes::Nodes;
use nalgebra::{Matrix3, SymmetricEigen};

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
    let (element, entry) = (&block.element, block.element.entry());
    let in_space = |own: Sym3<f64>| own.rotate(&element.frame(group, i, nodes)).to_array();
    let per_volume = |energy: Option<usize>| {
        let initial_volume = group.element_mass(i) / block.density;
        energy.map_or(0.0, |row| group.value(i, row) / initial_volume)
    };
    match field {
        ElementField::Stress => filled(&in_space(element.stress(group, i))),
        ElementField::Strain => filled(&in_space(logarithm(element.stretch(group, i, nodes)))),
        ElementField::Pressure => filled(&[pressure(element.stress(group, i))]),
        ElementField::VonMises => filled(&[von_mises(element.governing_stress(group, i))]),
        ElementField::Energy => filled(&[per_volume(Some(entry.energies.internal))]),
        ElementField::SpecificEnergy => filled(&[specific_energy(block, group, i)]),
        ElementField::Temperature => filled(&[temperature(block, group, i, nodes)]),
        ElementField::HourglassEnergy => filled(&[per_volume(entry.energies.hourglass)]),
        ElementField::Density => filled(&[group.element_mass(i) / element.volume(group, i, nodes)]),
        ElementField::Stretch => filled(&in_space(element.stretch(group, i, nodes))),
        ElementField::Rotation => filled(element.rotation(group, i, nodes).as_flattened()),
        ElementField::BulkViscosity => filled(&[entry.viscous_stress.map_or(0.0, |row| -group.value(i, row))]),
        ElementField::Corners => filled(&[element.least_corner(group, i, nodes)]),
        ElementField::Thickness => filled(&[element.thickness(group, i)]),
        ElementField::Resultants => filled(&element.resultants(group, i)),
        ElementField::Status => filled(&[1.0]),
        ElementField::Rank => filled(&[rank as f64]),
    }
}

/// Internal energy per mass: the initial one of the equation of state, and what stress and viscosities have done since. Hourglass
/// resistance counts where the law's pressure knows of it.
pub fn specific_energy(block: &ElementBlock, group: &Group, i: usize) -> f64 {
    let Energies { internal, hourglass, viscous } = block.element.entry().energies;
    let heats = hourglass.filter(|_| block.law.is_fluid());
    let done: f64 = [Some(internal), viscous, heats].into_iter().flatten().map(|row| group.value(i, row)).sum();
    let initial = block.law.equation_of_state().map_or(0.0, |equation| equation.initial_energy());
    initial / block.density + done / group.element_mass(i)
}

/// Temperature, 0 for a law that has none.
fn temperature(block: &ElementBlock, group: &Group, i: usize, nodes: &Nodes) -> f64 {
    let place = block.law.entry().state.iter().position(|variable| variable.name == "TEMP");
    place.map_or(0.0, |place| state_values(block, group, i, nodes).get(place).copied().unwrap_or(0.0))
}

/// The same at a point of integration, of fields that differ between points; see [`ElementField::of_points`].
pub fn point_values(
    field: ElementField,
    block: &ElementBlock,
    group: &Group,
    i: usize,
    point: usize,
    nodes: &Nodes,
) -> [f64; MOST] {
    let stress = block.element.point_stress(group, i, point);
    match field {
        ElementField::Pressure => filled(&[pressure(stress)]),
        ElementField::VonMises => filled(&[von_mises(stress)]),
        _ => filled(&stress.rotate(&block.element.frame(group, i, nodes)).to_array()),
    }
}

fn pressure(stress: Sym3<f64>) -> f64 {
    -stress.trace() / 3.0
}

fn von_mises(stress: Sym3<f64>) -> f64 {
    let s = stress.deviator();
    (1.5 * s.contract(s)).sqrt()
}

/// The state variables of an element's law, in the order in which the law lists them; means over its points of integration.
pub fn state_values(block: &ElementBlock, group: &Group, i: usize, nodes: &Nodes) -> Vec<f64> {
    if block.element.entry().points.is_none() {
        return point_state(block, group, i, 0, nodes);
    }
    let mut mean = vec![0.0; block.law.entry().state.len()];
    for point in 0..block.element.points() {
        let share = block.element.point_share(point);
        let values = point_state(block, group, i, point, nodes);
        mean.iter_mut().zip(values).for_each(|(mean, value)| *mean += share * value);
    }
    mean
}

/// The state variables of the law at a point of integration.
pub fn point_state(block: &ElementBlock, group: &Group, i: usize, point: usize, nodes: &Nodes) -> Vec<f64> {
    let first = block.first_of_law(point);
    let stored: Vec<f64> = (0..block.state_names.len()).map(|k| group.value(i, first + k)).collect();
    block.law.state(&stored, &block.element.frame(group, i, nodes))
}

/// ln U of a stretch, by its eigenvectors: logarithmic strain.
pub fn logarithm(u: Sym3<f64>) -> Sym3<f64> {
    let m = u.matrix();
    let eigen = SymmetricEigen::new(Matrix3::from_fn(|i, j| m[i][j]));
    let logarithms = eigen.eigenvalues.map(libm::log);
    let l = eigen.eigenvectors * Matrix3::from_diagonal(&logarithms) * eigen.eigenvectors.transpose();
    Sym3 { xx: l[(0, 0)], yy: l[(1, 1)], zz: l[(2, 2)], xy: l[(0, 1)], yz: l[(1, 2)], zx: l[(2, 0)] }
}

fn filled(values: &[f64]) -> [f64; MOST] {
    let mut all = [0.0; MOST];
    all[..values.len()].copy_from_slice(values);
    all
}
