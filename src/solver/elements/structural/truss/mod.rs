//! The truss: two nodes, a force along the line between them, by any law in uniaxial stress.
//!
//! Strain increment Δε = Δt v₂₁·x/x² with x₂₁ of mid-step, so that a chord that turns is not strained. The area follows from
//! the strain across, A = A₀ exp(2ε_t), and the force at the ends is N = σA along the present line. Work is that of the end
//! forces over the step, ½ (Nⁿe₁ⁿ + Nⁿ⁺¹e₁ⁿ⁺¹)·Δx₂₁, which closes the balance to round-off while the step does not change.

use super::{BAR_STEP, uniaxial};
use crate::common::vector::{cross, dot, normalized, scaled, subtract};
use crate::lanes::{Lanes, Matrix3, Sym3, array, exp};
use crate::material::{Kernel, KernelVisitor, Law, Moduli, Start};
use crate::mesh::{Block, Shape};
use crate::model::Model;
use crate::solver::body::centroid;
use crate::solver::elements::ahead::Ahead;
use crate::solver::elements::{
    Energies, Entry, Formulation, Given, Group, NewElement, Outcome, Pass, PassOutcome, PassSettings, Sample,
    StepKernel, StoredRow, Touch, Unfit,
};
use crate::solver::nodes::Nodes;

/// Rows of a truss's state; the law's own rows follow.
mod rows {
    /// Stress along the truss.
    pub const STRESS: usize = 0;
    /// What is left of the stress across it.
    pub const ACROSS: usize = 1;
    /// Logarithmic strain across it.
    pub const LATERAL: usize = 2;
    /// Area at the start.
    pub const AREA: usize = 3;
    /// Length at the start.
    pub const LENGTH: usize = 4;
    /// Internal energy since the start.
    pub const INTERNAL_ENERGY: usize = 5;
    /// First row of the law.
    pub const LAW: usize = 6;
}

const ROWS: [StoredRow; rows::LAW] = [
    StoredRow { name: "TRUSIG", dimension: "force/length^2" },
    StoredRow { name: "TRUACROS", dimension: "force/length^2" },
    StoredRow { name: "TRULATER", dimension: "-" },
    StoredRow { name: "TRUAREA", dimension: "length^2" },
    StoredRow { name: "TRULENG", dimension: "length" },
    StoredRow { name: "EINTERN", dimension: "energy" },
];

pub(in crate::solver::elements) static ENTRY: Entry = Entry {
    name: "TRUSS",
    summary: "Two nodes; carries tension and compression along itself.",
    shape: Shape::Bar,
    rotations: false,
    rows: &ROWS,
    points: None,
    energies: Energies { internal: rows::INTERNAL_ENERGY, hourglass: None, viscous: None },
    viscous_stress: None,
};

/// What holds for all trusses of a block.
#[derive(Debug, Clone)]
pub struct Truss {
    /// Cross section that the deck gives; without it each element has its own.
    area: Option<f64>,
}

impl Formulation for Truss {
    fn of_block(block: &Block, model: &Model) -> Result<Self, Unfit> {
        let unfit = |reason: &str, help: &str| Unfit { reason: reason.into(), help: help.into() };
        let law = model.materials.iter().find(|material| material.block == block.id).map(|material| &material.law);
        if law.is_some_and(|law| law.equation_of_state().is_some() || law.moduli().two_mu <= 0.0) {
            return Err(unfit(
                "its material has no strength in tension",
                "give it a material for solids, such as ELASTIC",
            ));
        }
        let area = model.section("TRUSS AREA", block.id).map(|section| section.number("area"));
        let own = (0..block.len()).map(|element| block.attributes_of(element).first().copied().unwrap_or(0.0));
        if area.is_none() && !own.into_iter().all(|area| area > 0.0 && area.is_finite()) {
            return Err(unfit(
                "its trusses have no area",
                "give it with TRUSS AREA, or as the first attribute in the mesh",
            ));
        }
        Ok(Truss { area })
    }

    fn weigh(&self, element: &Sample, density: f64, shares: &mut [f64]) -> f64 {
        let along = subtract(element.corners[1], element.corners[0]);
        let area = self.area.or(element.attributes.first().copied()).unwrap_or(0.0);
        shares.fill(0.5);
        density * area * dot(along, along).sqrt()
    }

    fn start(&self, element: &NewElement, density: f64, own: &mut [f64]) -> Start {
        let along = subtract(element.corners[1], element.corners[0]);
        let length = dot(along, along).sqrt();
        let volume = element.mass / density;
        (own[rows::LENGTH], own[rows::AREA]) = (length, volume / length);
        Start { centre: centroid(&element.corners), length, frame: frame_along(along) }
    }

    fn run(&self, pass: Pass, law: &Law, _: f64, settings: &PassSettings) -> PassOutcome {
        law.accept(OfLaw { pass, moduli: law.moduli(), times: [settings.time, settings.time_step] })
    }

    fn stand_in(&self, density: f64, edge: f64, own: &mut [f64]) -> f64 {
        (own[rows::LENGTH], own[rows::AREA]) = (edge, edge * edge);
        density * edge * edge * edge
    }

    fn volume(&self, group: &Group, i: usize, nodes: &Nodes) -> f64 {
        let along = chord(group, i, nodes);
        area(group, i) * dot(along, along).sqrt()
    }

    fn frame(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64> {
        frame_along(chord(group, i, nodes))
    }

    fn rotation(&self, group: &Group, i: usize, nodes: &Nodes) -> Matrix3<f64> {
        let [a, b] = [0, 1].map(|corner| nodes.initial(group.node(i, corner)));
        smallest_rotation(subtract(b, a), chord(group, i, nodes))
    }

    fn stress(&self, group: &Group, i: usize) -> Sym3<f64> {
        Sym3 { xx: group.value(i, rows::STRESS), yy: 0.0, zz: 0.0, xy: 0.0, yz: 0.0, zx: 0.0 }
    }

    fn touch(&self, attributes: &[f64]) -> Touch {
        let area = self.area.or(attributes.first().copied()).unwrap_or(0.0);
        Touch::Nodes((area / std::f64::consts::PI).sqrt())
    }

    fn stretch(&self, group: &Group, i: usize, nodes: &Nodes) -> Sym3<f64> {
        let along = chord(group, i, nodes);
        let wide = libm::exp(group.value(i, rows::LATERAL));
        let long = dot(along, along).sqrt() / group.value(i, rows::LENGTH);
        Sym3 { xx: long, yy: wide, zz: wide, xy: 0.0, yz: 0.0, zx: 0.0 }
    }

    fn last_half_step(&self, group: &Group, i: usize, nodes: &Nodes, time_step: f64) -> f64 {
        let [a, b]: [[f64; 3]; 2] = group.velocities(i, nodes);
        let displacement = scaled(subtract(b, a), time_step);
        let before = subtract(chord(group, i, nodes), displacement);
        let force = group.value(i, rows::STRESS) * area(group, i);
        let work = normalized(before).map_or(0.0, |e| 0.5 * force * dot(e, displacement));
        if work.is_finite() { work } else { 0.0 }
    }
}

fn chord(group: &Group, i: usize, nodes: &Nodes) -> [f64; 3] {
    let [a, b]: [[f64; 3]; 2] = group.positions(i, nodes);
    subtract(b, a)
}

fn area(group: &Group, i: usize) -> f64 {
    group.value(i, rows::AREA) * libm::exp(2.0 * group.value(i, rows::LATERAL))
}

/// Axes of which the first is along a vector, as columns.
fn frame_along(along: [f64; 3]) -> Matrix3<f64> {
    let e1 = normalized(along).unwrap_or([1.0, 0.0, 0.0]);
    // The axis that it leans to least.
    let least = (0..3).fold(0, |least, axis| if e1[axis].abs() < e1[least].abs() { axis } else { least });
    let mut other = [0.0; 3];
    other[least] = 1.0;
    let e2 = normalized(cross(other, e1)).unwrap_or([0.0, 1.0, 0.0]);
    let e3 = cross(e1, e2);
    [0, 1, 2].map(|i| [e1[i], e2[i], e3[i]])
}

/// The smallest rotation R of one direction a into another b, R = 1 − (a + b)(a + b)ᵀ/(1 + a·b) + 2 b aᵀ: a truss does not say how it
/// twists. Of half a turn, which has no smallest axis, one about an axis across.
fn smallest_rotation(from: [f64; 3], to: [f64; 3]) -> Matrix3<f64> {
    let along = |vector| normalized(vector).unwrap_or([1.0, 0.0, 0.0]);
    let (a, b) = (along(from), along(to));
    let unit = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
    let over = 1.0 + dot(a, b);
    if over < 1e-12 {
        let axis = frame_along(a).map(|row| row[1]);
        return [0, 1, 2].map(|i| [0, 1, 2].map(|j| 2.0 * axis[i] * axis[j] - unit(i, j)));
    }
    let term = |i: usize, j: usize| unit(i, j) - (a[i] + b[i]) * (a[j] + b[j]) / over + 2.0 * b[i] * a[j];
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| term(i, j)))
}

/// A pass that still has to learn its law.
struct OfLaw<'a> {
    pass: Pass<'a>,
    moduli: Moduli,
    times: [f64; 2],
}

impl KernelVisitor for OfLaw<'_> {
    type Output = PassOutcome;

    fn visit<K: Kernel>(self, law: K) -> PassOutcome {
        self.pass.over(&TrussStep { law, moduli: self.moduli, times: self.times })
    }
}

/// One step of a truss by a law.
struct TrussStep<K> {
    law: K,
    moduli: Moduli,
    /// Time of the present positions, and the step that led there.
    times: [f64; 2],
}

impl<K: Kernel> StepKernel<2> for TrussStep<K> {
    #[inline(always)]
    fn step<V: Lanes>(
        &self,
        positions: &[[V; 2]; 3],
        velocities: &[[V; 2]; 3],
        state: &mut [V::Row],
        part: usize,
        given: Given<V, 2>,
        _: &mut Ahead<V::Row>,
    ) -> Outcome<V, 2> {
        let half = V::splat(0.5);
        // (i) strain increment at mid-step
        let x: [V; 3] = array![i in 3 => positions[i][1] - positions[i][0]];
        let displacement: [V; 3] = array![i in 3 => (velocities[i][1] - velocities[i][0]) * V::splat(self.times[1])];
        let middle: [V; 3] = array![i in 3 => x[i] - displacement[i] * half];
        let before: [V; 3] = array![i in 3 => x[i] - displacement[i]];
        let along = product(&displacement, &middle) / product(&middle, &middle);
        let length = product(&x, &x).sqrt();
        // (ii) stress along, with none across
        let [lateral, area, start] = array![i in 3 => V::load(&state[rows::LATERAL + i], part)];
        let old_stress = V::load(&state[rows::STRESS], part);
        let wide = exp(lateral);
        let old_force = old_stress * area * wide * wide;
        let motion = [along, length / start, wide];
        let old = [old_stress, V::load(&state[rows::ACROSS], part)];
        let of_law = &mut state[rows::LAW..];
        let answer = uniaxial::update(&self.law, self.moduli, motion, old, self.times, of_law, part);
        let lateral = lateral + answer.lateral;
        answer.along.store(&mut state[rows::STRESS], part);
        answer.across.store(&mut state[rows::ACROSS], part);
        lateral.store(&mut state[rows::LATERAL], part);
        // (iii) forces along the present line, and their work with those before
        let wide = exp(lateral);
        let section = area * wide * wide;
        let force = answer.along * section;
        let (now, then) = (force / length, old_force / product(&before, &before).sqrt());
        let end: [V; 3] = array![i in 3 => x[i] * now];
        let pair: [V; 3] = array![i in 3 => end[i] + before[i] * then];
        let energy = V::load(&state[rows::INTERNAL_ENERGY], part) + product(&pair, &displacement) * half;
        energy.store(&mut state[rows::INTERNAL_ENERGY], part);
        // (iv) √(M/k), k the larger of the stiffness along, E A/L, and across, N/L
        let stiffest = self.modulus(&answer.response, answer.along);
        let stable_step = (given.moving * length / (stiffest * section)).sqrt() * V::splat(BAR_STEP);
        let zero = V::splat(0.0);
        // A truss that has no length any more has failed.
        let stable_step = V::select_less(zero, length, stable_step, zero);
        Outcome { force: array![i in 3 => [zero - end[i], end[i]]], stable_step, motion_step: stable_step, rate: zero }
    }
}

impl<K: Kernel> TrussStep<K> {
    /// Young's modulus, or the present dilatational one, which is no less, of a law whose stiffness changes.
    #[inline(always)]
    fn modulus<V: Lanes>(&self, response: &crate::material::Response<V>, stress: V) -> V {
        let Moduli { lambda, two_mu } = self.moduli;
        let young = two_mu * (1.5 * lambda + 0.5 * two_mu) / (lambda + 0.5 * two_mu);
        let stiffest = if K::STIFFNESS { response.stiffness.dilatational } else { V::splat(young) };
        stiffest.max(stress)
    }
}

#[inline(always)]
fn product<V: Lanes>(a: &[V; 3], b: &[V; 3]) -> V {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests;
