//! Energies that mean nothing any more, and a stable step that has collapsed.

use crate::comm::Communicator;
use crate::model::Model;
use crate::solver::rigid::RigidBodies;
use crate::solver::{Body, Solver, Stop, Totals};

/// Steps between checks of the energies; in the first ones, where instability shows, they are checked more often.
const INTERVAL: u64 = 100;

/// An energy balance that is off by this part of the largest account means nothing any more.
const GROSS_IMBALANCE: f64 = 0.5;

/// The run ends when the stable step falls below this part of the first one: it would never finish.
const SMALLEST_STEP_RATIO: f64 = 1e-5;

/// Kinetic or internal energy may exceed what was supplied by this factor before the run is called unstable. In a
/// mode near the stability limit the two swing beyond their sum, by 1/(1 − (Δt/Δt_critical)²), though nothing grows;
/// an unstable mode passes any factor within some dozen steps.
const FACTOR: f64 = 10.0;

/// Whether the energies are checked at a step.
pub fn check_due(step: u64) -> bool {
    step.is_multiple_of(INTERVAL) || (step < INTERVAL && step.is_power_of_two())
}

/// Energy below which nothing is said about balance: uniform strain of 3e-8, far above round-off.
pub fn energy_floor(body: &Body, model: &Model) -> f64 {
    let stiffness: f64 = body
        .element_mass
        .iter()
        .zip(&*body.element_block)
        .map(|(mass, &block)| {
            let material = &model.materials[body.block_material[block as usize]];
            mass / material.density * material.law.moduli().dilatational()
        })
        .sum();
    1e-15 * stiffness
}

/// Internal energy that gases and explosives hold at the start, and may turn into motion.
pub fn stored_energy(body: &Body, model: &Model) -> f64 {
    let elements = body.element_mass.iter().zip(body.element_block.iter());
    elements
        .filter_map(|(mass, &block)| {
            let material = &model.materials[body.block_material[block as usize]];
            let equation = material.law.equation_of_state()?;
            Some(mass / material.density * equation.initial_energy().max(0.0))
        })
        .sum()
}

/// Kinetic energy, and internal energy with that of hourglass modes.
pub fn two_kinds(totals: &Totals) -> [f64; 2] {
    [totals.kinetic, totals.internal + totals.hourglass]
}

/// No energy may outgrow what was put in, and the accounts must close. What contact has made is not a matter of this
/// check: it has a limit of its own, which the deck may raise.
///
/// # Errors
///
/// An energy is larger than what was put in allows, or the balance is off: the run must stop.
pub fn check(totals: &Totals, initial: f64, supplied: f64, floor: f64) -> Result<(), Stop> {
    let [kinetic, internal] = two_kinds(totals);
    if kinetic.is_nan() || internal.is_nan() {
        return Err(Stop::MotionNotFinite);
    }
    if kinetic.abs().max(internal.abs()) > FACTOR * (supplied + totals.contact_gain) + floor {
        return Err(Stop::Energy { kinetic, internal, supplied });
    }
    // What hourglass resistance and viscosity make stands in an account and closes the balance; it is an error all the same.
    let [hourglass, viscosity, _] = totals.given_back();
    let error = totals.relative_gap(initial).abs() + (hourglass + viscosity) / totals.scale(initial);
    if totals.scale(initial) > floor && error > GROSS_IMBALANCE {
        return Err(Stop::Balance { error });
    }
    Ok(())
}

impl Solver {
    /// The stable step must not collapse, and rigid bodies must be where they are told to be.
    ///
    /// # Errors
    ///
    /// What has gone wrong, with its place: the run must stop.
    pub(in crate::solver) fn check_step(&mut self, comm: &mut dyn Communicator) -> Result<(), Stop> {
        let first = *self.first_stable_step.get_or_insert(self.stable_step);
        let ratio = self.stable_step / first;
        if let Some((body, hold)) = self.domain.rigid.as_ref().and_then(RigidBodies::astray) {
            let block = body.shape.blocks.first().copied().unwrap_or(0);
            return Err(Stop::Astray { block, node: hold.id, command: hold.command(), strayed: hold.strayed });
        }
        if ratio < SMALLEST_STEP_RATIO {
            let fastest = self.domain.rigid.as_ref().and_then(RigidBodies::fastest);
            if let Some(body) = fastest.filter(|body| body.longest_step() <= self.stable_step) {
                let block = body.shape.blocks.first().copied().unwrap_or(0);
                return Err(Stop::Spin { block, rate: body.rate(), ratio });
            }
            let place = self.slowest_element(comm);
            return Err(Stop::TimeStep { step: self.stable_step, ratio, place });
        }
        Ok(())
    }
}
