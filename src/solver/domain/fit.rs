//! Whether a mesh can be computed as the model has it.

use crate::mesh::{Mesh, Shape};
use crate::model::{Death, DeathVariable, ElementField, Model, Precision, Unknown};
use crate::solver::elements;
use std::collections::BTreeSet;

/// Why blocks of a mesh cannot be computed as the model has them, each with the number of the block.
pub fn unfit_blocks(mesh: &Mesh, model: &Model) -> Vec<(i64, elements::Unfit)> {
    let unfit = |block: &crate::mesh::Block| Some((block.id, elements::Element::of_block(block, model).err()?));
    let all = mesh.blocks.iter().filter_map(unfit);
    let of_blocks = all.chain(without_eight_points(mesh, model)).chain(beyond_single(mesh, model));
    of_blocks.chain(beams_along_their_vector(mesh, model)).collect()
}

/// Blocks of beams whose vector does not say how the section lies.
fn beams_along_their_vector(mesh: &Mesh, model: &Model) -> Vec<(i64, elements::Unfit)> {
    let mut numbers = &mesh.element_ids[..];
    let unfit = |block: &crate::mesh::Block| {
        let (own, others) = numbers.split_at_checked(block.len())?;
        numbers = others;
        Some((block.id, elements::beam::unfit_direction(mesh, block, own, model)?))
    };
    mesh.blocks.iter().filter_map(unfit).collect()
}

/// Blocks whose numbers single precision cannot hold.
fn beyond_single(mesh: &Mesh, model: &Model) -> Vec<(i64, elements::Unfit)> {
    let asked =
        |block: &&crate::mesh::Block| model.has_one_point_hexahedra(block) && model.precision == Precision::Single;
    let unfit = |block: &crate::mesh::Block| {
        let material = model.materials.iter().find(|material| material.block == block.id)?;
        let body = (material.density, material.law.moduli());
        Some((block.id, elements::hexahedron::single_precision::range::beyond(block, &mesh.coordinates, body)?))
    };
    mesh.blocks.iter().filter(asked).filter_map(unfit).collect()
}

/// Blocks that are to have eight points and whose elements have not eight corners.
fn without_eight_points(mesh: &Mesh, model: &Model) -> Vec<(i64, elements::Unfit)> {
    let asked = |block: &&crate::mesh::Block| model.has_eight_points(block.id);
    let others = mesh.blocks.iter().filter(|block| block.shape != Shape::Hexahedron).filter(asked);
    let unfit = |block: &crate::mesh::Block| {
        let [_, shapes] = block.shape.names();
        let reason = format!("ELEMENT, EIGHT POINTS is for hexahedra, and these are {shapes}");
        (block.id, elements::Unfit { reason, help: "take the line out".to_string() })
    };
    others.map(unfit).collect()
}

/// Blocks whose DEATH watches a hourglass energy that their elements do not have, ascending.
pub fn idle_deaths(mesh: &Mesh, model: &Model) -> BTreeSet<i64> {
    let hourglass = |death: &&Death| matches!(death.variable, DeathVariable::Field(ElementField::HourglassEnergy, _));
    let has_none = |id: &i64| {
        let block = mesh.blocks.iter().find(|block| block.id == *id);
        let element = block.and_then(|block| elements::Element::of_block(block, model).ok());
        element.is_some_and(|element| element.entry().energies.hourglass.is_none())
    };
    model.deaths.iter().filter(hourglass).map(|death| death.block).filter(has_none).collect()
}

/// Node sets of whose rotations the model speaks, or that it gives a rotary inertia, though none of their nodes can turn, ascending.
pub fn idle_rotations(mesh: &Mesh, model: &Model) -> Vec<i64> {
    let turns = |block: &&crate::mesh::Block| {
        elements::Element::of_block(block, model).is_ok_and(|element| element.entry().rotations)
    };
    let turning: BTreeSet<u32> = mesh.blocks.iter().filter(turns).flat_map(|block| &block.nodes).copied().collect();
    // A rigid body turns with any of its nodes.
    let is_rigid = |block: &&crate::mesh::Block| model.is_rigid(block.id);
    let rigid: BTreeSet<u32> = mesh.blocks.iter().filter(is_rigid).flat_map(|block| &block.nodes).copied().collect();
    let can_turn = |node: &u32| turning.contains(node) || rigid.contains(node);
    let idle = |set: &&i64| mesh.node_set(**set).is_some_and(|own| !own.nodes.iter().any(can_turn));
    let held = model.no_displacements.iter().map(|held| (held.of, held.node_set));
    let driven = model.prescribed_motions.iter().map(|motion| (motion.of, motion.node_set));
    let loaded = model.prescribed_forces.iter().map(|force| (force.of, force.node_set));
    let told = held.chain(driven).chain(loaded).filter(|(of, _)| *of == Unknown::Rotation).map(|(_, set)| set);
    let inert = model.point_masses.iter().filter(|point| point.inertia > 0.0).map(|point| point.node_set);
    told.chain(inert).collect::<BTreeSet<i64>>().iter().filter(idle).copied().collect()
}
