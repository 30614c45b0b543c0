//! What tests of single kinds of elements begin with: a block whose nodes are moved by hand.

use super::{Element, ElementBlock, NewElement, PassSettings};
use crate::lanes::{InstructionSet, Row};
use crate::material::Law;
use crate::model::{BulkViscosity, StepModuli};
use crate::solver::domain::state_names;

/// A block of these elements, none of them at a border.
pub fn block(element: &Element, law: &Law, density: f64, elements: &[NewElement]) -> ElementBlock {
    let group = |elements: &[NewElement]| ElementBlock::group(element, law, density, elements);
    ElementBlock {
        index: 0,
        id: 1,
        density,
        state_names: state_names(law),
        keeps_steps: false,
        rigid: false,
        border: group(&[]),
        interior: group(elements),
        element: element.clone(),
        law: law.clone(),
    }
}

/// The only element of a block.
pub fn single(nodes: &[u32], corners: &[[f64; 3]], mass: f64) -> NewElement {
    let (nodes, corners) = (nodes.to_vec(), corners.to_vec());
    NewElement { place: 0, nodes, corners, mass, added: 0.0, attributes: Vec::new() }
}

/// A node at rest.
pub fn at_rest([x, y, z]: [f64; 3]) -> Row {
    Row([x, y, z, 1.0, 0.0, 0.0, 0.0, 1.0])
}

/// What a pass is told before the first step, without bulk viscosity.
pub fn settings() -> PassSettings {
    PassSettings {
        time: 0.0,
        time_step: 0.0,
        kick: 0.0,
        bulk_viscosity: BulkViscosity { linear: 0.0, quadratic: 0.0 },
        moduli: StepModuli::Elastic,
        instructions: InstructionSet::default(),
    }
}
