//! How long a step is: what all ranks agree on, of the bounds of all, and how the last steps meet the end. Beside it, what
//! makes steps longer than each element alone would have them.

mod frequency;
mod heights;
mod mass_scaling;
mod slivers;

pub(super) use frequency::GlobalStep;
pub use mass_scaling::{AddedMass, BlockMass};
pub use slivers::Slivers;

use super::{Request, RigidBodies, Section, Solver, Stop};
use crate::comm::Communicator;
use frequency::Votes;

/// Part of a step within which a time counts as reached.
pub(super) const REACHED: f64 = 1e-6;

/// So many steps at the end are made alike, and shorter by a twentieth at most, so that the last one reaches the end. Where the step
/// that can be taken shrinks meanwhile, one more of them may be needed, and the very last are then shorter by more.
const LAST_STEPS: f64 = 20.0;

/// Where so many times as many steps are left as are made alike, because they have become shorter, the end is no longer near.
const RECEDES: f64 = 1.25;

impl Solver {
    /// Lets the last steps be shorter, so that they reach this time. Without it, steps are as long as they can be.
    pub fn end_at(&mut self, time: f64) {
        self.end = Some(time);
    }

    /// Whether the present, prepared state is the one at the end.
    pub fn is_at_end(&self) -> bool {
        self.ends_within(REACHED * self.whole_step)
    }

    /// Whether the end is no farther away than this time.
    fn ends_within(&self, time: f64) -> bool {
        self.end.is_some_and(|end| end - self.time <= time)
    }

    /// Whether the step from the present, prepared state, or one before it, is shorter than it could be, so that the run ends
    /// where it shall; no longer where so many more steps have become necessary that the end is far.
    pub fn is_ending(&self) -> bool {
        self.ending
    }

    /// Whether the next step may be shorter than it could be: what is left is no more than so many of the largest that may
    /// follow.
    pub fn nears_end(&self) -> bool {
        let longest = if self.step == 0 { f64::INFINITY } else { self.control.growth * self.time_step };
        self.ends_within(LAST_STEPS * longest)
    }

    /// How often what is left until the end would fit into the step that could be taken, where it is there to be reached.
    pub(in crate::solver) fn steps_too_long(&self) -> Option<f64> {
        self.end.map(|end| self.whole_step / (end - self.time)).filter(|ratio| *ratio > 0.0)
    }

    /// The step that all ranks take, the wish that all ranks follow, and whether any element has failed.
    pub(super) fn agree(&mut self, request: Request, comm: &mut dyn Communicator) -> Result<Request, Stop> {
        let failed = self.local.failed.map_or(f64::INFINITY, |place| self.canonical(place));
        let mut votes =
            [self.local.stable_step, failed, -request.to_number(), f64::INFINITY, 1.0, f64::INFINITY, f64::INFINITY];
        self.clock.start();
        let of_mesh = self.global_step.as_ref().map(|global| global.votes(self.step, &self.domain, &self.local));
        let cast = match of_mesh {
            Some(Votes { rest, ratio, height, motion }) => {
                (votes[3], votes[4], votes[5], votes[6]) = (rest, ratio, height, motion);
                7
            }
            None => 3,
        };
        comm.all_min(&mut votes[..cast]);
        self.clock.stop(Section::Communication);
        let [stable_step, failed, wish, rest, ratio, height, motion] = votes;
        (self.stable_step, self.own_step) = (stable_step, stable_step);
        if failed.is_finite() {
            let place = self.locate(failed, comm);
            // Positions may be sound while velocities are not; a volume that is not finite says nothing of inversion.
            let inverted = place.volume.is_finite() && place.centre.iter().all(|x| x.is_finite());
            return Err(if inverted { Stop::Inverted(place) } else { Stop::NotFinite(place) });
        }
        self.estimate(Votes { rest, ratio, height, motion }, comm);
        self.stable_step *= self.domain.ties.as_ref().map_or(1.0, |ties| ties.step_part);
        let [of_deck, of_bodies] = self.bounds_beside_elements();
        self.stable_step = self.stable_step.min(of_bodies).min(of_deck);
        self.check_step(comm)?;
        let last = self.time_step;
        let wanted = self.control.scale * self.stable_step;
        self.whole_step = if self.step == 0 { wanted } else { wanted.min(self.control.growth * self.whole_step) };
        let agreed = Request::from_number(-wish);
        // A run that is stopped before its end goes on with the step that it would have taken.
        self.time_step = if agreed == Request::Continue { self.up_to_the_end(last) } else { self.whole_step };
        let is_near = self.ends_within(RECEDES * LAST_STEPS * self.whole_step);
        self.ending = self.time_step < self.whole_step || self.ending && is_near;
        self.kick = 0.5 * (if self.step == 0 { 0.0 } else { last } + self.time_step);
        Ok(agreed)
    }

    /// The step that is taken after one of length `last`. The last ones share what is left: the error of the energy balance,
    /// prescribed displacements and contact all feel a step that suddenly is another.
    fn up_to_the_end(&self, last: f64) -> f64 {
        let Some(end) = self.end else { return self.whole_step };
        let left = end - self.time;
        match (left / self.whole_step - REACHED).ceil() {
            // Nothing follows; energies are those of steps that are alike.
            steps if steps < 1.0 => {
                if self.ending {
                    last
                } else {
                    self.whole_step
                }
            }
            steps if steps > LAST_STEPS => self.whole_step,
            // What whole steps bring within reach is of the run without an end, to the bit.
            steps => (left / steps).min(self.whole_step),
        }
    }

    /// The longest stable steps that TIME STEP MAXIMUM and the spin of rigid bodies allow, whatever elements do.
    pub(super) fn bounds_beside_elements(&self) -> [f64; 2] {
        let bodies = self.domain.rigid.as_ref().map_or(f64::INFINITY, RigidBodies::longest_step);
        [self.control.longest / self.control.scale, bodies]
    }

    /// Lets the mesh as a whole bound the step, where the deck asks for it.
    fn estimate(&mut self, votes: Votes, comm: &mut dyn Communicator) {
        let Some(global) = &mut self.global_step else { return };
        self.clock.start();
        let own = self.stable_step;
        if global.is_due(self.step, votes) {
            global.estimate(&mut self.domain, self.step, own, &self.pass, comm);
        }
        self.stable_step = global.step(own, votes);
        self.clock.stop(Section::Elements);
    }
}
