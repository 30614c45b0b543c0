//! What every kind of element says of itself. The rest of the solver asks by these roles and knows no element by name.

use super::block::{Group, NewElement};
use super::pass::{Pass, PassOutcome, PassSettings};
use super::solids::exact::Steps;
use crate::lanes::{Matrix3, Sym3};
use crate::material::{Law, Start};
use crate::mesh::{Block, Shape};
use crate::model::{Model, Precision};
use crate::solver::nodes::{Nodes, dot};

/// What the deck, the manual, restart files and the energy balance need to know of a kind of element.
pub struct Entry {
    /// Name in messages and the manual.
    pub name: &'static str,
    /// One sentence for the manual.
    pub summary: &'static str,
    /// Shape of the blocks that it computes.
    pub shape: Shape,
    /// Whether its nodes have rotations.
    pub rotations: bool,
    /// What it stores per element beside its law's state variables, in this order.
    pub rows: &'static [StoredRow],
    /// Points of integration, for elements with more than one.
    pub points: Option<PointEntry>,
    /// Which of the rows are energies.
    pub energies: Energies,
    /// Which row is the bulk viscosity of the last step as a mean stress, if it has any.
    pub viscous_stress: Option<usize>,
}

impl Entry {
    /// Nodes of an element, and their rotations if it has any.
    pub fn unknowns(&self) -> usize {
        self.shape.corners() * if self.rotations { 2 } else { 1 }
    }
}

/// What is to be known of the points of integration of an element that has several, each with a state of its law. Behind the
/// rows of the element come those of its points, one point after the other: its own rows, then those of the law.
pub struct PointEntry {
    /// What each point stores beside its law's state variables.
    pub rows: &'static [StoredRow],
    /// Which of these rows is 1 at a point that DEATH has made to carry nothing any more, and 0 before.
    pub lost: usize,
    /// Whether the points lie one above the other, from the bottom of a surface to its top, and are plotted so.
    pub layered: bool,
}

/// What the search for the largest frequency of a mesh asks of a pass over elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Probe {
    /// Forces of the elastic stiffness, with displacements in the place of velocities.
    Stiffness,
    /// In the place of the forces along x, the masses that the corners have at least of the element.
    Mass,
}

/// One number that an element stores.
pub struct StoredRow {
    /// Name in restart files.
    pub name: &'static str,
    /// Its dimension, `-` for a plain number.
    pub dimension: &'static str,
}

/// Places of energies among the rows of an element; all are sums since the start, in the deck's unit of energy.
pub struct Energies {
    /// Internal energy.
    pub internal: usize,
    /// Energy of hourglass resistance, for elements that have any.
    pub hourglass: Option<usize>,
    /// Energy taken up by bulk viscosity, for elements that have any.
    pub viscous: Option<usize>,
}

/// An element of the mesh that is to be weighed.
pub struct Sample<'a> {
    /// Nodes in the mesh.
    pub nodes: &'a [u32],
    /// Corner positions, length.
    pub corners: &'a [[f64; 3]],
    /// Attributes that the mesh gives it.
    pub attributes: &'a [f64],
}

/// Which parts of an element may touch others, and at what distance from where the mesh has them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Touch {
    /// Faces that belong to no other element, where they are.
    Outside,
    /// Both sides of a surface, at this distance from it: half of its thickness, a length.
    BothSides(f64),
    /// Its nodes, each a ball of this radius, a length; they meet faces, not each other.
    Nodes(f64),
}

/// Why a block cannot be computed with an element, as the end of a sentence that begins with the block.
#[derive(Debug, Clone, PartialEq)]
pub struct Unfit {
    /// What is wrong.
    pub reason: String,
    /// What may be done, or an empty string.
    pub help: String,
}

/// A kind of element, with what holds for all elements of a block. One file or folder implements it, and one line in
/// `elements!` makes it known.
pub trait Formulation: Sized {
    /// Whether a block of its shape is one of its own; others go to the next element of that shape.
    fn takes(_block: &Block, _model: &Model) -> bool {
        true
    }

    /// Takes over a block of its shape.
    ///
    /// # Errors
    /// Why it cannot, for instance because a thickness or an area is missing.
    fn of_block(block: &Block, model: &Model) -> Result<Self, Unfit>;

    /// The precision of its state and of its kernel.
    fn precision(&self) -> Precision {
        Precision::Double
    }

    /// Names in restart files of the rows behind those of the law in which single precision keeps what its sums would lose. Their
    /// bits are no numbers.
    fn carried(&self) -> &'static [&'static str] {
        &[]
    }

    /// Mass of an element of this density (mass/length³), and in `shares` the part of it that belongs to each corner; behind
    /// these, in elements with rotations, the rotary inertia of each corner over the element's mass, length².
    fn weigh(&self, element: &Sample, density: f64, shares: &mut [f64]) -> f64;

    /// The least part of an even share of its mass that any node of an element has, for kernels that bound their step by even
    /// shares: frequencies are at most 1/√ of it above those.
    fn least_share(&self, _: &NewElement) -> f64 {
        1.0
    }

    /// Fills in the rows of an element at rest, and says what its law may see of it. `own` is zero.
    fn start(&self, element: &NewElement, density: f64, own: &mut [f64]) -> Start;

    /// Advances one group of a block by a step: stresses, energies, corner forces, and the largest stable step.
    fn run(&self, pass: Pass, law: &Law, density: f64, settings: &PassSettings) -> PassOutcome;

    /// Whether [`Formulation::probe`] answers for elements of this law. Of others the elements' own stable steps hold.
    fn vibrates(&self, _law: &Law) -> bool {
        false
    }

    /// Gives forces as [`Formulation::run`] does, but those that a probe asks for, and changes nothing. With the law comes
    /// the density at the start.
    fn probe(&self, _probe: Probe, _pass: Pass, _law: (&Law, f64), _settings: &PassSettings) {}

    /// Fills in the rows of what stands in for an element that is gone, unstressed and at rest between the first corners of a
    /// cube of this edge; returns its mass. `own` is zero.
    fn stand_in(&self, density: f64, edge: f64, own: &mut [f64]) -> f64;

    /// Volume of the `i`-th element now, length³.
    fn volume(&self, group: &Group, i: usize, nodes: &Nodes) -> f64;

    /// The rotation from the frame of the `i`-th element into space; columns are its axes.
    fn frame(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64>;

    /// What [`Formulation::frame`] was at the start: an element lies in the mesh as it likes.
    fn initial_frame(&self, _group: &Group, _i: usize, _nodes: &Nodes) -> Matrix3<f64> {
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    }

    /// How the `i`-th element has turned since the start: the R of F = V R.
    fn rotation(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64> {
        let start = self.initial_frame(group, i, nodes);
        self.frame(group, i, nodes).map(|row| start.map(|other| dot(row, other)))
    }

    /// Cauchy stress without bulk viscosity in the frame of the `i`-th element, force/length².
    fn stress(&self, group: &Group, i: usize) -> Sym3<f64>;

    /// The same where the element is stressed most, if it has no other point for that in the plot file: of a bar that bends, its
    /// mean says little.
    fn governing_stress(&self, group: &Group, i: usize) -> Sym3<f64> {
        self.stress(group, i)
    }

    /// Whether it resists that its nodes turn against each other.
    fn bends(&self) -> bool {
        false
    }

    /// Number of points of integration.
    fn points(&self) -> usize {
        1
    }

    /// Share of a point in the means of an element; they add up to one.
    fn point_share(&self, _point: usize) -> f64 {
        1.0
    }

    /// Cauchy stress at a point of the `i`-th element, as [`Formulation::stress`].
    fn point_stress(&self, group: &Group, i: usize, _point: usize) -> Sym3<f64> {
        self.stress(group, i)
    }

    /// Thickness of the `i`-th element now, length; 0 of elements that have none.
    fn thickness(&self, _group: &Group, _i: usize) -> f64 {
        0.0
    }

    /// Resultants of the `i`-th element in its frame; zeros of elements that have none. Of a surface, per length of the cut:
    /// forces Nxx, Nyy, Nxy, moments Mxx, Myy, Mxy, shear forces Qx, Qy.
    fn resultants(&self, _group: &Group, _i: usize) -> [f64; 8] {
        [0.0; 8]
    }

    /// What of an element with these attributes touches others, and at what distance, by its thickness at the start.
    fn touch(&self, _attributes: &[f64]) -> Touch {
        Touch::Outside
    }

    /// How many times the rotary inertia about its line an element with these corners turns with at the start; 1 where it is exact, and
    /// of elements that have no line.
    fn inertia_about_line(&self, _corners: &[[f64; 3]]) -> f64 {
        1.0
    }

    /// Right stretch in the frame of the `i`-th element.
    fn stretch(&self, group: &Group, i: usize, nodes: &Nodes) -> Sym3<f64>;

    /// The least Jacobian of the `i`-th element's corners over its mean one, 1 in elements that have none.
    fn least_corner(&self, _group: &Group, _i: usize, _nodes: &Nodes) -> f64 {
        1.0
    }

    /// Whether that is positive for sure, told at a part of the price; where this says no, [`Formulation::least_corner`] knows.
    fn corners_are_sound(&self, group: &Group, i: usize, nodes: &Nodes) -> bool {
        self.least_corner(group, i, nodes) > 0.0
    }

    /// Work that the last forces of the `i`-th element have done since the last state. They acted for half of the step that
    /// led here, and no new forces come to be averaged with them when the element goes.
    fn last_half_step(&self, group: &Group, i: usize, nodes: &Nodes, time_step: f64) -> f64;

    /// The same of an element with an equation of state, whose accounts are exact: with hourglass resistance and held corners of
    /// fluids, and with what was owed of the step before. `None` of other laws.
    fn last_exact_work(&self, _group: &Group, _i: usize, _nodes: &Nodes, _law: &Law, _steps: Steps) -> Option<f64> {
        None
    }
}
