//! The few elements that set the step of all: what a little more mass in them would buy.

use crate::comm::{Communicator, ExactSum};
use crate::solver::ElementPlace;
use crate::solver::health::elements;
use crate::solver::{Solver, domain::Domain};

/// What mass scaling of the first state would bring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slivers {
    /// How much longer the step becomes when [`Slivers::ADDED`] of all mass is added where it lengthens it most.
    pub gain: f64,
    /// Elements that get some of it.
    pub count: u64,
    /// The one with the shortest step.
    pub place: ElementPlace,
    /// The step that all then have, with the factor of the deck.
    pub step: f64,
    /// Largest mass that a block gains, as a part of its own.
    pub block_gain: f64,
}

impl Slivers {
    /// Mass that is added, as a part of all.
    pub const ADDED: f64 = 1e-4;
    /// The step is not asked to become longer than so many times.
    const MOST: f64 = 1e3;
    /// Halvings of the interval of the gain: three digits of it are told.
    const HALVINGS: usize = 24;
}

/// Step, mass and block of each element of this rank of which the step was kept.
fn kept(domain: &Domain) -> Vec<(f64, f64, usize)> {
    let of = elements(domain).map(|(block, group, i)| (group.stable_step(i), group.element_mass(i), block.index));
    of.filter_map(|(step, mass, block)| Some((step?, mass, block))).collect()
}

/// Mass that lets an element take a step so long: it grows with the square of the step.
fn missing(&(step, mass, _): &(f64, f64, usize), wanted: f64) -> f64 {
    if step < wanted { mass * ((wanted / step).powi(2) - 1.0) } else { 0.0 }
}

/// For each block its mass and what it would gain, on all ranks. All ranks call it.
fn of_blocks(own: &[(f64, f64, usize)], wanted: f64, blocks: usize, comm: &mut dyn Communicator) -> Vec<[f64; 2]> {
    let mut sums = vec![ExactSum::new(); 2 * blocks];
    for element in own {
        sums[2 * element.2].add(element.1);
        sums[2 * element.2 + 1].add(missing(element, wanted));
    }
    ExactSum::merge_ranks(&mut sums, comm);
    sums.chunks_exact(2).map(|pair| [pair[0].value(), pair[1].value()]).collect()
}

impl Solver {
    /// Lets all elements keep their stable steps in the coming pass, and returns which blocks did so before.
    pub(in crate::solver) fn keep_steps(&mut self) -> Vec<bool> {
        self.domain.blocks.iter_mut().map(|block| std::mem::replace(&mut block.keeps_steps, true)).collect()
    }

    /// Looks at the steps that the last pass has kept, and forgets those that nobody else wants. All ranks call it.
    pub(in crate::solver) fn weigh_steps(&mut self, kept_before: &[bool], comm: &mut dyn Communicator) {
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
        let least = self.own_step;
        let all = sum(&mut own.iter().map(|(_, mass, _)| *mass), comm);
        let added = |gain: f64, comm: &mut dyn Communicator| {
            sum(&mut own.iter().filter(|(step, ..)| *step < gain * least).map(|one| missing(one, gain * least)), comm)
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
        let mut count = [own.iter().filter(|(step, ..)| *step < low * least).count() as u64];
        comm.all_sum(&mut count);
        let place = self.slowest_element(comm);
        let last = self.domain.blocks.iter().map(|block| block.index as f64).fold(0.0, f64::max);
        let mut last = [-last];
        comm.all_min(&mut last);
        let blocks = of_blocks(&own, low * least, -last[0] as usize + 1, comm);
        let block_gain =
            blocks.iter().filter(|[mass, _]| *mass > 0.0).map(|[mass, gain]| gain / mass).fold(0.0, f64::max);
        let step = self.control.scale * low * least;
        self.slivers = Some(Slivers { gain: low, count: count[0], place, step, block_gain });
    }
}
