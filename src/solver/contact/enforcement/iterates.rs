//! Forces in the course of the iterations, with what these read again and again: side by side in memory, so that many constraints
//! stay in the caches of a core.

use super::constraint::{Constraint, ConstraintState, MEMBERS};
use crate::common::vector::{add, scaled};
use crate::model::Friction;

/// Normal force of a constraint in the course of the iterations: three lines of the cache, of which the sums at the nodes need two.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Iterate {
    /// Weights of the members, without dimension.
    pub weights: [f64; MEMBERS],
    /// Members, of which the first `count` count.
    pub members: [u32; MEMBERS],
    /// Number of members.
    pub count: u8,
    /// Whether it pushes or overlaps.
    pub active: bool,
    /// Whether it did so at any time in this step.
    pub touched: bool,
    /// Whether this rank has made it.
    pub own: bool,
    /// Whether it leaves its nodes to another one at first, see `node_pairs`.
    pub yields: bool,
    /// Unit normal.
    pub normal: [f64; 3],
    /// Normal force with which the next iteration begins.
    pub normal_force: f64,
    /// Normal force that the last iteration found.
    pub last: f64,
    /// Reduced mass times the share, a mass; 0 where nothing can be moved.
    pub strength: f64,
    /// How far it would stay behind its target without contact forces, a length.
    pub closing: f64,
    /// Length that the gap is small against.
    pub size: f64,
    /// For each member, |w| times what a unit force along the normal does to it.
    pub softness: [f64; MEMBERS],
    /// How far it gives way under a unit force, an inverse mass; 0 where it does not.
    pub compliance: f64,
}

/// Friction force of a constraint in the course of the iterations.
#[derive(Debug, Clone, Copy)]
pub struct FrictionIterate {
    /// Coulomb friction; none at all where the constraint has none.
    pub friction: Friction,
    /// Velocity of sliding without contact forces.
    pub slip: [f64; 3],
    /// Force with which the next iteration begins.
    pub tangential_force: [f64; 3],
    /// Force that the last iteration found.
    pub last: [f64; 3],
    /// For each member, |w| times what a unit force along any direction does to it at most.
    pub softness: [f64; MEMBERS],
    /// Whether the force was ever as large as it can be.
    pub slid: bool,
}

/// All constraints in the course of the iterations.
#[derive(Debug, Clone, Default)]
pub struct Iterates {
    /// Normal forces, in the order of the constraints.
    pub normal: Vec<Iterate>,
    /// Friction forces in the same order; empty where no constraint has friction.
    pub friction: Vec<FrictionIterate>,
}

impl Iterates {
    /// Begins with the forces that the constraints carry.
    pub fn begin(&mut self, constraints: &[Constraint], states: &[ConstraintState]) {
        self.normal.clear();
        self.friction.clear();
        let has_friction = constraints.iter().any(|c| c.friction.is_some());
        for (c, state) in constraints.iter().zip(states) {
            let normal_force = c.carried.normal_force;
            let active = state.strength > 0.0 && !c.yields && (normal_force > 0.0 || state.closing < 0.0);
            self.normal.push(Iterate {
                weights: c.weights,
                members: c.members,
                count: c.count as u8,
                active,
                // What nothing can move overlaps all the same.
                touched: active || state.strength <= 0.0 && c.gap < 0.0,
                own: state.own,
                yields: c.yields,
                normal: c.normal,
                normal_force,
                last: normal_force,
                strength: state.strength,
                closing: state.closing,
                size: c.size,
                softness: state.softness.map(|[along, _]| along),
                compliance: 0.0,
            });
            if has_friction {
                self.friction.push(FrictionIterate {
                    friction: c.friction,
                    slip: state.slip,
                    tangential_force: c.carried.tangential_force,
                    last: c.carried.tangential_force,
                    softness: state.softness.map(|[_, most]| most),
                    slid: false,
                });
            }
        }
    }

    /// The same after a first attempt, where what has a thickness gives way now; see `giving_way`.
    pub fn begin_anew(&mut self, constraints: &[Constraint], states: &[ConstraintState]) {
        self.begin(constraints, states);
        for (own, state) in self.normal.iter_mut().zip(states) {
            (own.compliance, own.touched) = (state.compliance, own.touched || state.touched);
        }
        self.friction.iter_mut().zip(states).for_each(|(own, state)| own.slid |= state.slid);
    }

    /// Whether a constraint has a gap to close.
    pub fn are_wanted(&self) -> bool {
        self.normal.iter().any(|iterate| iterate.closing < 0.0)
    }

    /// Leaves the forces of the last iteration to the constraints, or what they carried where there was none.
    pub fn end(&mut self, constraints: &mut [Constraint], states: &mut [ConstraintState]) {
        for (i, (c, state)) in constraints.iter_mut().zip(states).enumerate() {
            let own = &mut self.normal[i];
            own.normal_force = own.last;
            (c.carried.normal_force, state.touched) = (own.last, own.touched);
            if let Some(own) = self.friction.get_mut(i) {
                own.tangential_force = own.last;
                (c.carried.tangential_force, state.slid) = (own.last, own.slid);
            }
        }
    }

    /// Force on a member of weight 1 of the `i`-th constraint.
    #[inline(always)]
    pub fn force(&self, i: usize) -> [f64; 3] {
        let Iterate { normal, normal_force, .. } = self.normal[i];
        let force = scaled(normal, normal_force);
        self.friction.get(i).map_or(force, |own| add(force, own.tangential_force))
    }
}
