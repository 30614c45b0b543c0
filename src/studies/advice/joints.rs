//! Joints that shorten the step of all elements, whatever mass these were given for a longer one.

use super::{Advice, Promise, Scene};
use crate::comm::Communicator;
use crate::common::numbers::scientific;
use crate::mesh::Mesh;
use crate::model::{Model, ScaleMass};
use crate::solver::Section;

/// Part of the step of the elements from which on its loss is worth words.
const WORTH_WORDS: f64 = 0.85;

pub fn advice(scene: &Scene, _: &mut dyn Communicator) -> Vec<Advice> {
    let part = scene.solver.domain.ties.as_ref().map_or(1.0, |ties| ties.step_part);
    if part > WORTH_WORDS || scene.solver.bound_beside_elements().is_some() {
        return Vec::new();
    }
    let Some([words, instead]) = words(scene.mesh, scene.model, part) else { return Vec::new() };
    vec![Advice::spare(words, instead, Promise::Nothing, Some((Section::Elements, 1.0 - part)))]
}

/// That joints let the run take only this part of the step of its elements, and what to write instead; `None` where they let it take all.
pub fn words(mesh: &Mesh, model: &Model, part: f64) -> Option<[String; 2]> {
    if part >= 1.0 {
        return None;
    }
    let nodes = |set: i64| mesh.side_set_nodes(set).len();
    let coarse = model.ties.iter().map(|tie| tie.side_sets).filter(|[first, second]| nodes(*first) < nodes(*second));
    let coarse: Vec<[i64; 2]> = coarse.collect();
    let list = |swapped: bool| {
        let name = |[first, second]: &[i64; 2]| {
            let [first, second] = if swapped { [second, first] } else { [first, second] };
            format!("TIED CONTACT, {first}, {second}")
        };
        coarse.iter().map(name).collect::<Vec<_>>().join(" and ")
    };
    let place = if coarse.is_empty() { String::new() } else { format!(" in {}", list(false)) };
    let steps = model.mass_scalings.iter().filter_map(|scaling| match scaling.scale {
        ScaleMass::Step(step) => Some(step),
        ScaleMass::Factor(_) => None,
    });
    let asked = steps.fold(0.0, f64::max);
    let scaled = if asked > 0.0 {
        format!(
            "; of the step of {} that MASS SCALING asks and adds mass for, {} is left at most",
            scientific(asked, 3),
            scientific(part * asked, 3)
        )
    } else {
        String::new()
    };
    let words = format!(
        "joints of TIED CONTACT make all steps {part:.2} times those of the elements, as coarse faces follow finer ones{place}{scaled}"
    );
    let other_way =
        if coarse.is_empty() { "TIED CONTACT with the side sets the other way round".into() } else { list(true) };
    Some([words, format!("{other_way}, so that the finer side follows")])
}
