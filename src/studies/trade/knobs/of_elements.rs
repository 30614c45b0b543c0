//! Knobs of elements: their formulation, their points, their hourglass control, and the time step that they allow.

use super::{Knob, Variant};
use crate::mesh::{Block, Mesh, Shape};
use crate::model::{Hourglass, Model, Section, Spin, StepEstimate};
use crate::solver::elements::Element;
use crate::solver::elements::shell::{MOST_POINTS, points_of};

/// Work of hexahedra with eight points over that of the same with one.
const WORK_OF_EIGHT: f64 = 4.0;
/// Work with a spin of second order over that with one of first order.
const WORK_OF_SECOND_ORDER: f64 = 1.02;

/// All knobs that the elements of a scene have.
pub fn variants(model: &Model, mesh: &Mesh) -> Vec<Variant> {
    let blocks: Vec<&Block> =
        mesh.blocks.iter().filter(|block| !block.is_empty() && !model.is_rigid(block.id)).collect();
    let mut all: Vec<Variant> = estimate(model, &blocks).into_iter().collect();
    all.extend(formulation(model, &blocks));
    all.extend(hourglass(model, &blocks));
    all.extend(spin(model, &blocks));
    all.extend(thickness_points(model, &blocks));
    all
}

/// The step of the mesh as a whole, where elements have a part in it.
fn estimate(model: &Model, blocks: &[&Block]) -> Option<Variant> {
    let takes_part = |block: &&Block| {
        let law = model.materials.iter().find(|material| material.block == block.id).map(|material| &material.law);
        let element = Element::of_block(block, model).ok();
        law.zip(element).is_some_and(|(law, element)| element.vibrates(law))
    };
    let (name, word) = match model.step_estimate {
        StepEstimate::Element => ("global-estimate", "GLOBAL"),
        StepEstimate::Global => ("element-estimate", "ELEMENT"),
    };
    let line = format!("TIME STEP ESTIMATE, {word}");
    blocks.iter().any(takes_part).then(|| Variant::of(Knob::Estimate, name, &["TIME STEP ESTIMATE"], line, 1.0))
}

/// Eight points in all blocks that can have them, and one point in all.
fn formulation(model: &Model, blocks: &[&Block]) -> Vec<Variant> {
    let asked = |block: i64| Section {
        command: "ELEMENT".into(),
        block,
        numbers: Vec::new(),
        words: vec![("formulation".into(), "EIGHT POINTS".into())],
    };
    let mut other = model.clone();
    other.sections.extend(blocks.iter().map(|block| asked(block.id)));
    let able = |block: &&&Block| block.shape == Shape::Hexahedron && Element::of_block(block, &other).is_ok();
    let able: Vec<i64> = blocks.iter().filter(able).map(|block| block.id).collect();
    let has: Vec<i64> = blocks.iter().filter(|block| model.has_eight_points(block.id)).map(|block| block.id).collect();
    let mut all = Vec::new();
    if able.iter().any(|id| !has.contains(id)) {
        let lines = able.iter().map(|id| format!("ELEMENT, {id}, EIGHT POINTS")).collect();
        all.push(Variant::with(Knob::Formulation, "eight-points", &["ELEMENT"], lines, WORK_OF_EIGHT));
    }
    if !has.is_empty() {
        all.push(Variant::with(Knob::Formulation, "one-point", &["ELEMENT"], Vec::new(), 1.0));
    }
    all
}

fn hourglass(model: &Model, blocks: &[&Block]) -> Option<Variant> {
    let has = |block: &&Block| model.has_hourglass_modes(block);
    let (name, line) = match model.hourglass {
        Hourglass::AssumedStrain { .. } => ("flanagan-belytschko", "HOURGLASS CONTROL, FLANAGAN BELYTSCHKO"),
        Hourglass::FlanaganBelytschko { .. } => ("assumed-strain", "HOURGLASS CONTROL, ASSUMED STRAIN"),
    };
    let without = &["HOURGLASS CONTROL", "HOURGLASS STIFFENING"];
    blocks.iter().any(has).then(|| Variant::of(Knob::Hourglass, name, without, line.into(), 1.0))
}

/// The other order of the spin, where elements with one point have a stress that turns: a pressure alone does not.
fn spin(model: &Model, blocks: &[&Block]) -> Option<Variant> {
    let is_fluid = |id: i64| model.materials.iter().any(|material| material.block == id && material.law.is_fluid());
    let one_point = |block: &&Block| model.has_one_point_hexahedra(block);
    let has = |block: &&Block| one_point(block) && !is_fluid(block.id);
    let (name, order, work) = match model.spin {
        Spin::FirstOrder => ("second-order-spin", "SECOND ORDER", WORK_OF_SECOND_ORDER),
        Spin::SecondOrder => ("first-order-spin", "FIRST ORDER", 1.0 / WORK_OF_SECOND_ORDER),
    };
    blocks.iter().any(has).then(|| Variant::of(Knob::Spin, name, &["SPIN"], format!("SPIN, {order}"), work))
}

/// More and fewer points through the thickness of shells; a membrane stays one.
fn thickness_points(model: &Model, blocks: &[&Block]) -> Vec<Variant> {
    let shells = blocks.iter().filter(|block| matches!(block.shape, Shape::Quadrilateral | Shape::Triangle));
    let now: Vec<(i64, usize, &str)> = shells
        .map(|block| {
            let (points, rule) = points_of(block.id, model);
            (block.id, points, rule)
        })
        .filter(|(_, points, _)| *points > 1)
        .collect();
    let of = |name: &str, work: f64, other: fn(usize, &str) -> usize| {
        let changes = now.iter().any(|(_, points, rule)| other(*points, rule) != *points);
        let line = |(id, points, rule): &(i64, usize, &str)| {
            format!("INTEGRATION POINTS, {id}, {}, {rule}", other(*points, rule))
        };
        let lines = now.iter().map(line).collect();
        changes.then(|| Variant::with(Knob::Points, name, &["INTEGRATION POINTS"], lines, work))
    };
    let more = of("more-points", 1.6, |points, _| (2 * points - 1).min(MOST_POINTS));
    let fewer = of("fewer-points", 0.8, |points, rule| match (points, rule) {
        (4.., _) => 3,
        (3, "GAUSS") => 2,
        _ => points,
    });
    more.into_iter().chain(fewer).collect()
}
