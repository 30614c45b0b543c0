//! Checks that end a run before it turns into nonsense, and the search for the element to blame.

use super::body::{Body, centroid};
use super::elements::Group;
use super::stop::{ElementPlace, Stop};
use super::{Domain, Solver};
use crate::comm::Communicator;
use crate::model::Model;

/// Steps between checks of the energies; in the first ones, where instability shows, they are checked more often.
const ENERGY_CHECK_INTERVAL: u64 = 100;

/// An energy balance that is off by this part of the largest account means nothing any more.
const GROSS_IMBALANCE: f64 = 0.5;

/// Whether the energies are checked at a step.
pub(super) fn check_due(step: u64) -> bool {
    step.is_multiple_of(ENERGY_CHECK_INTERVAL) || (step < ENERGY_CHECK_INTERVAL && step.is_power_of_two())
}

/// The run ends when the stable step falls below this part of the first one: it would never finish.
const SMALLEST_STEP_RATIO: f64 = 1e-5;

/// Kinetic or internal energy may exceed what was supplied by this factor before the run is called unstable. In a
/// mode near the stability limit the two swing beyond their sum, by 1/(1 − (Δt/Δt_critical)²), though nothing grows;
/// an unstable mode passes any factor within some dozen steps.
const ENERGY_FACTOR: f64 = 10.0;

/// Energy below which nothing is said about balance: uniform strain of 3e-8, far above round-off.
pub(super) fn energy_floor(body: &Body, model: &Model) -> f64 {
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
pub(super) fn stored_energy(body: &Body, model: &Model) -> f64 {
    let elements = body.element_mass.iter().zip(body.element_block.iter());
    elements
        .filter_map(|(mass, &block)| {
            let material = &model.materials[body.block_material[block as usize]];
            let equation = material.law.equation_of_state()?;
            Some(mass / material.density * equation.initial_energy().max(0.0))
        })
        .sum()
}

impl Solver {
    /// Canonical number of a local place, as a number that ranks can compare.
    pub(super) fn canonical(&self, place: u32) -> f64 {
        f64::from(self.domain.element_canonical[place as usize])
    }

    /// The stable step must not collapse.
    pub(super) fn check_step(&mut self, comm: &mut dyn Communicator) -> Result<(), Stop> {
        let first = *self.first_stable_step.get_or_insert(self.stable_step);
        let ratio = self.stable_step / first;
        if ratio < SMALLEST_STEP_RATIO {
            let place = self.controlling_element(comm);
            return Err(Stop::TimeStep { step: self.stable_step, ratio, place });
        }
        Ok(())
    }

    /// No energy may outgrow what was put in, and the balance must close. All ranks call it, and all get the same.
    pub fn check_energy(&mut self, comm: &mut dyn Communicator) -> Result<(), Stop> {
        let totals = self.totals(comm);
        let supplied = self.initial_energy + self.stored_energy + totals.external.max(0.0);
        self.supplied_peak = self.supplied_peak.max(supplied);
        let (kinetic, internal) = (totals.kinetic, totals.internal + totals.hourglass);
        if kinetic.abs().max(internal.abs()) > ENERGY_FACTOR * self.supplied_peak + self.energy_floor {
            return Err(Stop::Energy { kinetic, internal, supplied: self.supplied_peak });
        }
        let error = totals.relative_error(self.initial_energy);
        if totals.scale(self.initial_energy) > self.energy_floor && error.abs() > GROSS_IMBALANCE {
            return Err(Stop::Balance { error });
        }
        Ok(())
    }

    /// The element that sets the stable step; of several the first in canonical order.
    pub fn controlling_element(&self, comm: &mut dyn Communicator) -> ElementPlace {
        let mine = self.local.controlling.filter(|_| self.local.stable_step == self.stable_step);
        let mut first = [mine.map_or(f64::INFINITY, |place| self.canonical(place))];
        comm.all_min(&mut first);
        self.locate(first[0], comm)
    }

    /// Number, block and centre of an element given by its canonical number, known to all ranks.
    pub(super) fn locate(&self, canonical: f64, comm: &mut dyn Communicator) -> ElementPlace {
        let mut facts = [f64::INFINITY; 6];
        if let Some(place) = find(&self.domain, canonical) {
            let [x, y, z] = place.centre;
            facts = [place.element as f64, place.block as f64, x, y, z, place.volume];
        }
        comm.all_min(&mut facts);
        let [element, block, x, y, z, volume] = facts;
        ElementPlace { element: element as i64, block: block as i64, centre: [x, y, z], volume }
    }
}

/// The element with a canonical number, if this rank has it.
fn find(domain: &Domain, canonical: f64) -> Option<ElementPlace> {
    let place = domain.element_canonical.iter().position(|&c| f64::from(c) == canonical)?;
    let (block, group, i) = domain.blocks.iter().find_map(|block| {
        let at = |group: &Group| group.places.binary_search(&(place as u32)).ok();
        block.groups().into_iter().find_map(|group| Some((block, group, at(group)?)))
    })?;
    let corners: Vec<[f64; 3]> = group.nodes(i).map(|node| domain.nodes.position(node)).collect();
    let volume = block.element.volume(group, i, &domain.nodes);
    Some(ElementPlace { element: domain.element_id[place], block: block.id, centre: centroid(&corners), volume })
}
