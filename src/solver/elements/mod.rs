//! Elements: from positions and velocities to corner forces, block by block in chunks of eight.
//!
//! A kind of element is a folder in `solids` or `structural` and a line in the list below: see `docs/adding-an-element.md`.

pub mod ahead;
mod block;
mod bulk_viscosity;
#[cfg(test)]
mod by_hand;
pub mod fields;
mod formulation;
mod pass;
pub mod solids;
mod state_rows;
pub mod structural;

use crate::lanes::{Matrix3, Sym3};
use crate::material::{Law, Start};
use crate::mesh::Block;
use crate::model::{Model, Precision};
use crate::solver::nodes::Nodes;

pub use block::{ElementBlock, Group, NewElement};
pub use formulation::{Energies, Entry, Formulation, PointEntry, Probe, Sample, StoredRow, Touch, Unfit};
pub use pass::{Given, Outcome, Pass, PassOutcome, PassSettings, Sink, StepKernel};
pub use solids::exact::Steps;
pub use solids::{eight_points, hexahedron, quadrilateral};
pub use structural::shell::triangle;
pub use structural::{beam, shell, truss};

macro_rules! elements {
    ($($module:ident :: $element:ident),+ $(,)?) => {
        /// What the elements of a block are, with what holds for all of them.
        #[derive(Debug, Clone)]
        pub enum Element { $(#[doc = stringify!($element)] $element($module::$element),)+ }

        /// Every kind of element there is.
        pub static ELEMENTS: &[&Entry] = &[$(&$module::ENTRY),+];

        impl Element {
            /// The element that computes a block.
            ///
            /// # Errors
            /// Why none can.
            pub fn of_block(block: &Block, model: &Model) -> Result<Element, Unfit> {
                $(if $module::ENTRY.shape == block.shape && $module::$element::takes(block, model) {
                    return $module::$element::of_block(block, model).map(Element::$element);
                })+
                let [_, shapes] = block.shape.names();
                Err(Unfit { reason: format!("there is no element that computes {shapes}"), help: String::new() })
            }

            /// The table entry of this kind.
            pub fn entry(&self) -> &'static Entry { match self { $(Element::$element(_) => &$module::ENTRY,)+ } }

            /// See [`Formulation::precision`].
            pub fn precision(&self) -> Precision {
                match self { $(Element::$element(own) => own.precision(),)+ }
            }

            /// See [`Formulation::carried`].
            pub fn carried(&self) -> &'static [&'static str] {
                match self { $(Element::$element(own) => own.carried(),)+ }
            }

            /// See [`Formulation::weigh`].
            pub fn weigh(&self, element: &Sample, density: f64, shares: &mut [f64]) -> f64 {
                match self { $(Element::$element(own) => own.weigh(element, density, shares),)+ }
            }

            /// See [`Formulation::least_share`].
            pub fn least_share(&self, element: &NewElement) -> f64 {
                match self { $(Element::$element(kind) => kind.least_share(element),)+ }
            }

            /// See [`Formulation::start`].
            pub fn start(&self, element: &NewElement, density: f64, own: &mut [f64]) -> Start {
                match self { $(Element::$element(kind) => kind.start(element, density, own),)+ }
            }

            /// See [`Formulation::run`].
            pub fn run(&self, pass: Pass, law: &Law, density: f64, settings: &PassSettings) -> PassOutcome {
                match self { $(Element::$element(own) => own.run(pass, law, density, settings),)+ }
            }

            /// See [`Formulation::vibrates`].
            pub fn vibrates(&self, law: &Law) -> bool {
                match self { $(Element::$element(own) => own.vibrates(law),)+ }
            }

            /// See [`Formulation::probe`].
            pub fn probe(&self, probe: Probe, pass: Pass, law: (&Law, f64), settings: &PassSettings) {
                match self { $(Element::$element(own) => own.probe(probe, pass, law, settings),)+ }
            }

            /// See [`Formulation::stand_in`].
            pub fn stand_in(&self, density: f64, edge: f64, own: &mut [f64]) -> f64 {
                match self { $(Element::$element(kind) => kind.stand_in(density, edge, own),)+ }
            }

            /// See [`Formulation::volume`].
            pub fn volume(&self, group: &Group, i: usize, nodes: &Nodes) -> f64 {
                match self { $(Element::$element(own) => own.volume(group, i, nodes),)+ }
            }

            /// See [`Formulation::frame`].
            pub fn frame(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64> {
                match self { $(Element::$element(own) => own.frame(group, i, nodes),)+ }
            }

            /// See [`Formulation::rotation`].
            pub fn rotation(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64> {
                match self { $(Element::$element(own) => own.rotation(group, i, nodes),)+ }
            }

            /// See [`Formulation::stress`].
            pub fn stress(&self, group: &Group, i: usize) -> Sym3<f64> {
                match self { $(Element::$element(own) => own.stress(group, i),)+ }
            }

            /// See [`Formulation::governing_stress`].
            pub fn governing_stress(&self, group: &Group, i: usize) -> Sym3<f64> {
                match self { $(Element::$element(own) => own.governing_stress(group, i),)+ }
            }

            /// See [`Formulation::bends`].
            pub fn bends(&self) -> bool {
                match self { $(Element::$element(own) => own.bends(),)+ }
            }

            /// See [`Formulation::points`].
            pub fn points(&self) -> usize {
                match self { $(Element::$element(own) => own.points(),)+ }
            }

            /// See [`Formulation::point_share`].
            pub fn point_share(&self, point: usize) -> f64 {
                match self { $(Element::$element(own) => own.point_share(point),)+ }
            }

            /// See [`Formulation::point_stress`].
            pub fn point_stress(&self, group: &Group, i: usize, point: usize) -> Sym3<f64> {
                match self { $(Element::$element(own) => own.point_stress(group, i, point),)+ }
            }

            /// See [`Formulation::thickness`].
            pub fn thickness(&self, group: &Group, i: usize) -> f64 {
                match self { $(Element::$element(own) => own.thickness(group, i),)+ }
            }

            /// See [`Formulation::resultants`].
            pub fn resultants(&self, group: &Group, i: usize) -> [f64; 8] {
                match self { $(Element::$element(own) => own.resultants(group, i),)+ }
            }

            /// See [`Formulation::touch`].
            pub fn touch(&self, attributes: &[f64]) -> Touch {
                match self { $(Element::$element(own) => own.touch(attributes),)+ }
            }

            /// See [`Formulation::inertia_about_line`].
            pub fn inertia_about_line(&self, corners: &[[f64; 3]]) -> f64 {
                match self { $(Element::$element(own) => own.inertia_about_line(corners),)+ }
            }

            /// See [`Formulation::stretch`].
            pub fn stretch(&self, group: &Group, i: usize, nodes: &Nodes) -> Sym3<f64> {
                match self { $(Element::$element(own) => own.stretch(group, i, nodes),)+ }
            }

            /// See [`Formulation::least_corner`].
            pub fn least_corner(&self, group: &Group, i: usize, nodes: &Nodes) -> f64 {
                match self { $(Element::$element(own) => own.least_corner(group, i, nodes),)+ }
            }

            /// See [`Formulation::corners_are_sound`].
            pub fn corners_are_sound(&self, group: &Group, i: usize, nodes: &Nodes) -> bool {
                match self { $(Element::$element(own) => own.corners_are_sound(group, i, nodes),)+ }
            }

            /// See [`Formulation::last_half_step`].
            pub fn last_half_step(&self, group: &Group, i: usize, nodes: &Nodes, time_step: f64) -> f64 {
                match self { $(Element::$element(own) => own.last_half_step(group, i, nodes, time_step),)+ }
            }

            /// See [`Formulation::last_exact_work`].
            pub fn last_exact_work(
                &self, group: &Group, i: usize, nodes: &Nodes, law: &Law, steps: Steps,
            ) -> Option<f64> {
                match self { $(Element::$element(own) => own.last_exact_work(group, i, nodes, law, steps),)+ }
            }
        }
    };
}

elements! {
    eight_points::EightPoints,
    hexahedron::Hexahedron,
    quadrilateral::Quadrilateral,
    beam::Beam,
    truss::Truss,
    shell::Shell,
    triangle::Triangle,
}

impl Element {
    /// Numbers that each point of integration stores beside those of its law.
    pub fn point_rows(&self) -> usize {
        self.entry().points.as_ref().map_or(0, |points| points.rows.len())
    }

    /// The points of a layered element that are its bottom, its middle and its top; the middle is the mean of two where their
    /// number is even. `None` of elements that have no layers.
    pub fn layers(&self) -> Option<[[usize; 2]; 3]> {
        let last = self.points().saturating_sub(1);
        let layered = self.entry().points.as_ref().is_some_and(|points| points.layered);
        layered.then_some([[0, 0], [last / 2, last - last / 2], [last, last]])
    }
}
