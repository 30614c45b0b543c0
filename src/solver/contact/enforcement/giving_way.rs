//! What has a thickness gives way where there is no room.
//!
//! Between solids the elements give way. The thickness at which surfaces and bars touch has no element across it: where nodes that the deck drives, or
//! heavy bodies, leave less room for the leaves of a fold than these are thick, no forces meet all constraints. Forces against each other then
//! grow in every iteration, to a hundredfold of what the motion of the step asks for, and act on nodes along normals that turn from step to step:
//! what does not cancel throws leaves through each other. And a contact of two light nodes is left twice as deep as one in which a single node can
//! move. So where the iterations have run out by far they are made anew, and each such constraint stays short in proportion to its force, as a
//! spring would. There is one solution then, with forces no larger than the motion asks for, and leaves that press each other share the room.
//!
//! What gives way in a step is not won back in the next, or contact would give energy: what is pressed for long would creep. So nothing gives way once
//! iterations have not settled for many steps; there they go on longer.

use super::constraint::{Constraint, ConstraintState};
use super::enforcer::Enforcer;
use super::iterations::{Limits, Outcome, Times};
use super::other_ranks::OtherRanks;
use crate::common::vector::dot;
use crate::solver::contact::geometry::motion::NodeMotion;

/// How soft a constraint with a thickness is, as a part of its softest member: by how much more the force of a step moves that than it is left
/// short. With 1 as many folds end crossed as with this.
const SOFT: f64 = 0.1;

/// How far a constraint gives way under a unit force, an inverse mass: a part of what that does to its softest member. What is equally thick gives
/// way alike, whether one side of it can move or both.
pub(super) fn compliance(c: &Constraint, state: &ConstraintState) -> f64 {
    let of_member = c.weights.iter().zip(state.softness).take(c.count).filter(|(w, _)| **w != 0.0);
    SOFT * of_member.fold(0.0, |most: f64, (w, [_, softness])| most.max(softness / w.abs()))
}

impl Enforcer {
    /// Finds the forces anew, with constraints that give way where they have a thickness; `outcome` is that of the first attempt.
    pub(super) fn give_way(
        &mut self,
        constraints: &mut [Constraint],
        motion: &NodeMotion,
        (times, limits): (Times, Limits),
        outcome: Outcome,
        others: &mut dyn OtherRanks,
    ) -> Outcome {
        for (c, _) in constraints.iter_mut().zip(&self.states).filter(|(_, state)| state.compliance > 0.0) {
            (c.carried.normal_force, c.carried.tangential_force) = (0.0, [0.0; 3]);
        }
        self.iterates.begin_anew(constraints, &self.states);
        let anew = self.iterate(constraints, motion, times, limits, true, others).unwrap_or_default();
        self.iterates.end(constraints, &mut self.states);
        Outcome { iterations: outcome.iterations + anew.iterations, ..outcome }
    }

    /// Lets what has given way ask for no more than it has got: along the ray of the forces it would else be sought. The responses are those to the
    /// forces.
    pub(super) fn lower_targets(&mut self, constraints: &[Constraint], drift: f64) {
        let all = constraints.iter().zip(self.states.iter_mut().zip(&self.iterates.normal));
        for (c, (state, own)) in all.filter(|(_, (_, own))| own.compliance > 0.0) {
            let left = own.closing + drift * dot(c.velocity_change(&self.responses), c.normal);
            state.target.least += left.min(0.0) / drift;
        }
    }
}
