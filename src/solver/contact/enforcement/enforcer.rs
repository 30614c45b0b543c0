//! Enforcement: equal and opposite forces that take the overlaps out of the coming step.
//!
//! Every contact is a constraint on the points that take part, with weights that add up to zero: +1 for a point and
//! −N for the corners of its face; four weights for two edges; +1 alone against a rigid plane. A force λ ≥ 0 along the
//! normal acts on each point times its weight, so linear momentum is kept to round-off whatever λ is, and angular
//! momentum too where the points meet along the normal.
//!
//! λ is found in iterations. Within an iteration a point that takes part in several constraints gives each a share of its mass,
//! and every constraint closes its gap as if it were alone with these shares (mass splitting: Tonge, Benevolenski and
//! Voroshilov 2012); the shares add up to the whole, so iterations cannot overshoot. For points of equal overlap on a flat
//! face this is the partitioned kinematic method of Attaway et al. (1996), eqs. 15–27, with eq. 25 solved for the
//! acceleration of the face: λ = m_s δ/Δτ · m_I/(m_I + Σ N m_s), and one iteration closes the gap.
//!
//! Iterations begin with a part of the forces of the last step, and each goes on a little in the direction of the one
//! before (Nesterov 1983, the sequence of Beck and Teboulle 2009), but not where a force would turn back (O'Donoghue
//! and Candès 2015, for each force by itself).

use super::accounts::certificate::{Sums, Target, Terms, tangential};
use super::accounts::ledger::Ledger;
use super::carried::Carried;
use super::constraint::{Constraint, ConstraintState, MEMBERS, Response};
use super::giving_way;
use super::iterates::Iterates;
use super::iterations::{Limits, Outcome, Times};
use super::joints::JointSums;
use super::mobility::{self, BodySums};
use super::other_ranks::OtherRanks;
use super::pinned;
use super::pinned_bodies::{self, Among};
use super::sweep;
use crate::common::vector::{add, dot, scaled};
use crate::lanes::InstructionSet;
use crate::solver::constraints::StepTimes;
use crate::solver::contact::geometry::motion::NodeMotion;

/// Part of the last step's force with which the iterations begin. Where they end early, force follows overlap with the lag
/// of this filter: a point on a spring of any stiffness that iterations can make would gain energy from 1/2 on (the roots of
/// z³ − (2 + β) z² + (1 + 2β) z − β + 2α z² − α z with β = `BEGINNING` (1 − α)). The certificate would not grant it, but
/// what it cuts off shakes the bodies: at 0.9 the energy balance of the patch test V-27 was off by a hundredth.
const BEGINNING: f64 = 0.4;

/// Least share of its members' masses that a constraint claims. With partitions by impedance a heavy node on a light face
/// would have next to none: where light nodes answer for themselves, too, the others between them would follow in thousands
/// of iterations.
const LEAST_SHARE: f64 = 0.25;

/// A constraint that its members can follow only by less than this part of how far they can move at all is held: a tilt of
/// a thousandth between a normal and the directions that are held. Round-off would move it.
pub(super) const HELD: f64 = 1e-6;

/// What a constraint claims of its members' masses grows the less these can follow it, where they are held nearly along its normal, and no more
/// from this part of how far they can move at all on: others would be left with a hundred thousandth of a common member, and sink in by
/// motion after motion.
const LEAST_FREE: f64 = 0.1;

/// Constraints ahead whose members' velocities before the step are asked of the memory: their nodes are scattered among all.
const SOON: usize = 4;

/// What nothing can move out of a face is told once it is deeper than this part of the face's size.
const DEEP: f64 = 0.05;

/// The same of rigid bodies that are pinned: what leaves them no room goes into them, whatever the iterations do. What iterations that have
/// not settled leave between bodies that can give way is not of this kind.
const DEEP_IN_RIGID: f64 = 0.002;

/// Buffers of the iterations, kept from step to step.
#[derive(Debug, Clone, Default)]
pub struct Enforcer {
    /// Normal forces on the points.
    pub normal_force: Vec<[f64; 3]>,
    /// Friction forces on the points.
    pub friction_force: Vec<[f64; 3]>,
    pub(super) responses: Vec<Response>,
    /// Forces and loads while they are summed.
    sums: Vec<Response>,
    pub(super) states: Vec<ConstraintState>,
    /// Forces in the course of the iterations.
    pub(super) iterates: Iterates,
    /// What pushes the leaders of joints.
    joints: JointSums,
    /// Rays of single points, where the ledger is theirs.
    rays: Vec<Terms>,
    /// Of which constraints only the first member can be moved.
    lone: Vec<bool>,
    /// Points of the constraints, ascending.
    members: Vec<u32>,
    is_member: Vec<bool>,
    /// Constraints of nodes that lie on nodes, and the first of these at each point while partners are looked for.
    pub(super) on_nodes: Vec<u32>,
    pub(super) first_of_node: Vec<u32>,
    /// Deepest penetration before the step between members that nothing can move or of rigid bodies that are pinned, or what is missing of the room
    /// of a node between faces that nothing can move, as a part of the face's size, with a member; and on any rank. 0 where it is small.
    pub held: (f64, u32),
    pub(super) held_anywhere: f64,
    pub(super) instructions: InstructionSet,
}

/// 1/m along a direction.
fn along(inverse_mass: [f64; 3], n: [f64; 3]) -> f64 {
    inverse_mass[0] * n[0] * n[0] + inverse_mass[1] * n[1] * n[1] + inverse_mass[2] * n[2] * n[2]
}

/// What a unit force along the normal of a constraint does to it, and what such forces could do in any direction at most, if members
/// that are held along all axes were as light as the others: inverse masses; and what each member has of both.
fn weigh(c: &Constraint, motion: &NodeMotion, softness: &mut [[f64; 2]; MEMBERS]) -> [f64; 2] {
    let (mut inverse, mut isotropic) = (0.0, 0.0);
    // Sums of squared weights. A member that can move, but has a weight of round-off, is not to be measured by itself.
    let (mut of_all, mut of_movable) = (0.0, 0.0);
    for (i, (point, w)) in c.parts().enumerate() {
        of_all += w * w;
        if let Some(body) = motion.mobility.of(point) {
            of_movable += if motion.mobility.bodies[body].is_movable() { w * w } else { 0.0 };
            continue;
        }
        let m = motion.inverse_mass[point];
        let one = along(m, c.normal);
        inverse += w * w * one;
        let most = m[0].max(m[1]).max(m[2]);
        isotropic += w * w * most;
        of_movable += if most > 0.0 { w * w } else { 0.0 };
        softness[i] = [w.abs() * one, w.abs() * most];
    }
    if !motion.mobility.bodies.is_empty() {
        mobility::weigh(c, motion, softness, [&mut inverse, &mut isotropic]);
    }
    // Exactly as it is where all can move.
    if of_movable > 0.0 && of_movable < of_all {
        isotropic *= of_all / of_movable;
    }
    [inverse, isotropic]
}

impl Enforcer {
    /// Buffers for so many points.
    pub fn new(points: usize) -> Enforcer {
        Enforcer {
            normal_force: vec![[0.0; 3]; points],
            friction_force: vec![[0.0; 3]; points],
            responses: vec![Response::default(); points],
            sums: vec![Response::default(); points],
            is_member: vec![false; points],
            instructions: InstructionSet::detect(),
            ..Default::default()
        }
    }

    /// Finds the forces of all constraints that were prepared, and their sums at the points. The order of the constraints
    /// is that of the sums and must not depend on the decomposition.
    pub fn solve(
        &mut self,
        constraints: &mut [Constraint],
        motion: &NodeMotion,
        step: &StepTimes,
        limits: Limits,
        (ledger, others): (Ledger, &mut dyn OtherRanks),
    ) -> Outcome {
        let times = Times { drift: step.drift, kick: step.kick, both: step.drift * step.kick };
        self.list_members(constraints);
        self.iterates.begin(constraints, &self.states);
        self.note_pinned(constraints);
        self.held_anywhere = self.held.0;
        if motion.mobility.joints.are_there() {
            self.joints.begin(&self.iterates, motion, others);
        }
        // Where nothing overlaps there is nothing to do. One iteration is made for the smallest overlap:
        // under small loads a step's overlap is far below any tolerance; left alone until it has grown, it would come
        // out as a row of blows instead of a steady force.
        let wanted = self.iterates.are_wanted();
        let mut outcome = None;
        if wanted || others.are_there() {
            outcome = self.iterate(constraints, motion, times, limits, wanted, others);
            let has_run_out = outcome.is_some_and(|outcome| outcome.ran_out) && !motion.mobility.bodies.is_empty();
            if has_run_out && pinned_bodies::share_room(constraints, &mut self.states, motion, (Among::All, others)) {
                self.note_pinned(constraints);
                self.iterates.begin(constraints, &self.states);
                outcome = self.iterate(constraints, motion, times, limits, true, others);
            }
        }
        self.iterates.end(constraints, &mut self.states);
        outcome = match outcome.filter(|outcome| outcome.lacks_room) {
            Some(first) => Some(self.give_way(constraints, motion, (times, limits), first, others)),
            None => outcome,
        };
        if outcome.is_some() {
            self.settle(constraints, motion, times, ledger, others);
            let travel = outcome.map_or(0.0, |outcome| outcome.travel);
            if limits.let_some_yield() {
                self.find_yielding(constraints, times.drift, |size| limits.left(size, travel));
            }
        } else {
            for (c, state) in constraints.iter_mut().zip(&self.states) {
                c.scale_along_ray(state, [0.0; 3], 0.0, times.drift);
            }
        }
        self.sum_forces(constraints);
        Outcome { held: self.held_anywhere, ..outcome.unwrap_or_default() }
    }

    /// Goes along the ray of the forces only so far that they give no energy which the ledger does not pay.
    fn settle(
        &mut self,
        constraints: &mut [Constraint],
        motion: &NodeMotion,
        times: Times,
        ledger: Ledger,
        others: &mut dyn OtherRanks,
    ) {
        if let Ledger::Unlimited = ledger {
            return;
        }
        self.scatter(motion, times, &mut [], others);
        self.lower_targets(constraints, times.drift);
        let granted = ledger.granted();
        let mut all = Sums::default();
        self.rays.clear();
        if let Ledger::EachNode = ledger {
            self.rays.resize(self.responses.len(), Terms::default());
        }
        for (c, state) in constraints.iter().zip(&self.states).filter(|(c, _)| c.carried.normal_force > 0.0) {
            match ledger {
                Ledger::EachNode => {
                    self.rays[c.members[0] as usize].add(&Terms::of(c, state, c.velocity_change(&self.responses)))
                }
                _ if state.own => all.add(&Terms::of(c, state, c.velocity_change(&self.responses))),
                _ => (),
            }
        }
        let ray = match ledger {
            Ledger::Bank(bank) => {
                others.sum(&mut all);
                all.terms().settle(granted, times.kick, bank)
            }
            _ => 1.0,
        };
        for (c, state) in constraints.iter_mut().zip(&mut self.states) {
            let ray = self.rays.get(c.members[0] as usize).map_or(ray, |terms| terms.ray(granted).min(1.0));
            state.ray = ray;
            c.scale_along_ray(state, c.velocity_change(&self.responses), ray, times.drift);
        }
    }

    /// Change of velocity that the forces make at a point.
    pub fn velocity_change(&self, point: usize, motion: &NodeMotion, kick: f64) -> [f64; 3] {
        let (force, m) = (add(self.normal_force[point], self.friction_force[point]), motion.inverse_mass[point]);
        [0, 1, 2].map(|i| kick * (force[i] * m[i]))
    }

    /// Constraints of this rank that have ended with a force, with their states; `constraints` are those of the last solution.
    pub fn pushing<'a>(
        &'a self,
        constraints: &'a [Constraint],
    ) -> impl Iterator<Item = (&'a Constraint, &'a ConstraintState)> {
        let all = constraints.iter().zip(&self.states);
        all.filter(|(c, state)| state.own && c.carried.normal_force > 0.0)
    }

    /// Constraints of this rank that were active at any time in the last solution, with their states.
    pub fn touched<'a>(
        &'a self,
        constraints: &'a [Constraint],
    ) -> impl Iterator<Item = (&'a Constraint, &'a ConstraintState)> {
        constraints.iter().zip(&self.states).filter(|(_, state)| state.own && state.touched)
    }

    /// Velocity of a member of a constraint after the step: that without contact, and what all forces along their ray change.
    pub fn velocity_after(&self, point: usize, state: &ConstraintState, motion: &NodeMotion) -> [f64; 3] {
        add(motion.velocity(point as u32), scaled(self.responses[point].velocity_change, state.ray))
    }

    /// Whether a constraint yields in the next step.
    pub fn yields(&self, constraint: usize) -> bool {
        self.states[constraint].yields
    }

    /// What is known of each constraint in the course of the iterations.
    pub fn states(&mut self) -> &mut Vec<ConstraintState> {
        &mut self.states
    }

    /// Puts constraints in the order of their origins, of which only those before `own` are already in order. The place
    /// before of each constraint, or `None` where nothing has changed.
    pub fn merge(&mut self, constraints: &mut Vec<Constraint>, own: usize) -> Option<Vec<u32>> {
        if constraints.len() == own {
            return None;
        }
        let mut order: Vec<u32> = (0..constraints.len() as u32).collect();
        order.sort_by_key(|&i| constraints[i as usize].origin);
        *constraints = order.iter().map(|&i| constraints[i as usize]).collect();
        self.states = order.iter().map(|&i| self.states[i as usize]).collect();
        Some(order)
    }

    /// Finds what does not change in the iterations, and the friction of the last step in the new planes; before
    /// [`Enforcer::solve`].
    pub fn prepare(&mut self, constraints: &mut [Constraint], motion: &NodeMotion, drift: f64, ledger: &Ledger) {
        self.states.clear();
        self.lone.clear();
        self.held = (0.0, 0);
        let granted = ledger.granted();
        for i in 0..constraints.len() {
            if let Some(soon) = constraints.get(i + SOON) {
                motion.ask_for_rows(&soon.members);
            }
            let c = &mut constraints[i];
            let Carried { normal_force, tangential_force, .. } = c.carried;
            (c.carried.normal_force, c.carried.tangential_force) =
                (BEGINNING * normal_force, scaled(tangential_force, BEGINNING));
            let mut state = ConstraintState { own: true, ..Default::default() };
            let [inverse, isotropic] = weigh(c, motion, &mut state.softness);
            let of_first = c.weights[0].abs() * state.softness[0][0];
            self.lone.push(of_first > 0.0 && inverse - of_first <= HELD * isotropic);
            let [free, before] = c.velocities(motion);
            (state.free, state.before) = (dot(free, c.normal) - c.growth, dot(before, c.normal) - c.growth);
            state.target = match ledger {
                Ledger::Unlimited => Target { least: state.free - c.gap / drift, ..Default::default() },
                _ => Target::of(c, [state.before, state.free], drift),
            };
            let sunk = (c.carried.penetration / c.size, c.members[0]);
            if motion.mobility.is_rigid(c.parts(), &motion.inverse_mass) {
                state.target = state.target.without_store(state.before);
            }
            // Where all members are held there is nothing to move.
            if inverse > HELD * isotropic {
                state.strength = c.share.max(LEAST_SHARE) / inverse.max(LEAST_FREE * isotropic);
                state.closing = drift * (state.free - state.target.with(granted));
                state.compliance = if c.is_thick { giving_way::compliance(c, &state) } else { 0.0 };
            } else {
                (c.carried.normal_force, c.carried.tangential_force) = (0.0, [0.0; 3]);
                self.note_held(sunk, DEEP);
            }
            if c.yields {
                (c.carried.normal_force, c.carried.tangential_force) = (0.0, [0.0; 3]);
            }
            if c.friction.is_some() {
                (state.slip, state.slip_before) = (tangential(free, c.normal), tangential(before, c.normal));
                c.carried.tangential_force = tangential(c.carried.tangential_force, c.normal);
            } else {
                c.carried.tangential_force = [0.0; 3];
            }
            self.states.push(state);
        }
        let pinned = pinned::share_room(constraints, &mut self.states, &self.lone);
        self.note_held(pinned, DEEP);
    }

    /// Notes how deep rigid bodies are in what leaves them no room.
    fn note_pinned(&mut self, constraints: &[Constraint]) {
        for (i, c) in constraints.iter().enumerate().take(self.states.len()) {
            if self.states[i].pinned {
                self.note_held((c.carried.penetration / c.size, c.members[0]), DEEP_IN_RIGID);
            }
        }
    }

    /// Notes how deep a member is in, a part of the face's size, that forces cannot bring out; not what is less deep than this part.
    fn note_held(&mut self, (part, member): (f64, u32), least: f64) {
        if part > least.max(self.held.0) {
            self.held = (part, member);
        }
    }

    fn list_members(&mut self, constraints: &[Constraint]) {
        self.members.clear();
        for c in constraints {
            for &point in &c.members[..c.count] {
                if !std::mem::replace(&mut self.is_member[point as usize], true) {
                    self.members.push(point);
                }
            }
        }
        self.members.iter().for_each(|&point| self.is_member[point as usize] = false);
    }

    /// Sums forces and loads at the points, in the order of the constraints, and finds how far they move; and, beside that, the largest
    /// of all ranks' values.
    pub(super) fn scatter(
        &mut self,
        motion: &NodeMotion,
        times: Times,
        largest: &mut [f64],
        others: &mut dyn OtherRanks,
    ) {
        sweep::scatter(self.instructions, &self.iterates, &mut self.sums);
        for &point in &self.members {
            let p = point as usize;
            let sum = std::mem::take(&mut self.sums[p]);
            // What others answer for comes from them.
            let Some(m) = motion.inverse_mass.get(p) else { continue };
            let ([x, y, z], k) = (sum.velocity_change, times.kick);
            self.responses[p] =
                Response { velocity_change: [k * (x * m[0]), k * (y * m[1]), k * (z * m[2])], load: sum.load };
        }
        if !motion.mobility.bodies.is_empty() {
            let mut bodies = BodySums::of(&self.iterates, motion);
            others.merge(bodies.sums());
            bodies.answer(&self.members, motion, times.kick, &mut self.responses);
        }
        if motion.mobility.joints.are_there() {
            let pushing = (&self.members[..], &self.iterates);
            self.joints.answer(pushing, motion, times.kick, &mut self.responses, others);
        }
        others.share(&mut self.responses, largest);
    }

    /// Sums the forces that were found, in the order of the constraints.
    fn sum_forces(&mut self, constraints: &[Constraint]) {
        for &point in &self.members {
            (self.normal_force[point as usize], self.friction_force[point as usize]) = ([0.0; 3], [0.0; 3]);
        }
        for c in constraints.iter().filter(|c| c.carried.normal_force > 0.0) {
            for (point, w) in c.parts() {
                self.normal_force[point] = add(self.normal_force[point], scaled(c.normal, w * c.carried.normal_force));
                self.friction_force[point] = add(self.friction_force[point], scaled(c.carried.tangential_force, w));
            }
        }
    }
}
