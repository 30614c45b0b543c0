//! The few elements that set the step of all: what a little more mass in them would buy.

use super::health::elements;
use super::stop::ElementPlace;
use super::{Solver, domain::Domain};
use crate::comm::{Communicator, ExactSum};

/// What mass scaling of the first state would bring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slivers {
    /// How much longer the step becomes when [`Slivers::ADDED`] of all mass is added where it lengthens it most.
    pub gain: f64,
    /// Elements that get some of it.
    pub count: u64,
    /// The one with the shortest step.
    pub place: ElementPlace,
}

impl Slivers {
    /// Mass that is added, as a part of all.
    pub const ADDED: f64 = 1e-4;
    /// The step is not asked to become longer than so many times.
    const MOST: f64 = 1e3;
    /// Halvings of the interval of the gain: three digits of it are told.
    const HALVINGS: usize = 24;
}

/// Steps and masses of the elements of this rank, of which the steps were kept.
fn kept(domain: &Domain) -> Vec<[f64; 2]> {
    elements(domain).filter_map(|(_, group, i)| Some([group.stable_step(i)?, group.element_mass(i)])).collect()
}

impl Solver {
    /// Lets all elements keep their stable steps in the coming pass, and returns which blocks did so before.
    pub(super) fn keep_steps(&mut self) -> Vec<bool> {
        self.domain.blocks.iter_mut().map(|block| std::mem::replace(&mut block.keeps_steps, true)).collect()
    }

    /// Looks at the steps that the last pass has kept, and forgets those that nobody else wants. All ranks call it.
    pub(super) fn weigh_steps(&mut self, kept_before: &[bool], comm: &mut dyn Communicator) {
        let own = kept(&self.domain);
        for (block, kept) in self.domain.blocks.iter_mut().zip(kept_before).filter(|(_, kept)| !**kept) {
            block.keeps_steps = *kept;
            (block.border.steps, block.interior.steps) = (Vec::new(), Vec::new());
        }
        let sum = |terms: &mut dyn Iterator<Item = f64>, comm: &mut dyn Communicator| {
            let mut sum = [ExactSum::new()];
            terms.for_each(|term| sum[0].add(term));
            ExactSum::merge_ranks(&mut sum, comm);
            sum[0].value()
        };
        let least = self.stable_step;
        let all = sum(&mut own.iter().map(|[_, mass]| *mass), comm);
        // Mass that lets every element take a step so many times as long as the shortest: it grows with the square of the step.
        let added = |gain: f64, comm: &mut dyn Communicator| {
            let short = own.iter().filter(|[step, _]| *step < gain * least);
            sum(&mut short.map(|[step, mass]| mass * ((gain * least / step).powi(2) - 1.0)), comm)
        };
        let [mut low, mut high] = [1.0, Slivers::MOST];
        if added(high, comm) > Slivers::ADDED * all {
            for _ in 0..Slivers::HALVINGS {
                let middle = (low * high).sqrt();
                let fits = added(middle, comm) <= Slivers::ADDED * all;
                (low, high) = if fits { (middle, high) } else { (low, middle) };
            }
        } else {
            low = high;
        }
        let mut count = [own.iter().filter(|[step, _]| *step < low * least).count() as u64];
        comm.all_sum(&mut count);
        let place = self.controlling_element(comm);
        self.slivers = Some(Slivers { gain: low, count: count[0], place });
    }
}
