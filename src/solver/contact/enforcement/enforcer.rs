//! Enforcement: equal and opposite forces that take the overlaps out of the coming step.
//!
//! Every contact is a constraint on the points that take part, with weights that add up to zero: +1 for a point and
//! −N for the corners of its face; four weights for two edges; +1 alone against a rigid plane. A force λ ≥ 0 along the
//! normal acts on each point times its weight, so linear momentum is kept to round-off whatever λ is, and angular
//! momentum too where the points meet along the normal.
//!
//! λ is found in passes. Within a pass a point that takes part in several constraints gives each a share of its mass,
//! and every constraint closes its gap as if it were alone with these shares (mass splitting: Tonge, Benevolenski and
//! Voroshilov 2012); the shares add up to the whole, so passes cannot overshoot. For points of equal overlap on a flat
//! face this is the partitioned kinematic method of Attaway et al. (1996), eqs. 15–27, with eq. 25 solved for the
//! acceleration of the face: λ = m_s δ/Δτ · m_I/(m_I + Σ N m_s), and one pass closes the gap.
//!
//! Passes begin with a part of the forces of the last step, and each goes on a little in the direction of the one
//! before (Nesterov 1983, the sequence of Beck and Teboulle 2009), but not where a force would turn back (O'Donoghue
//! and Candès 2015, for each force by itself).

use super::carried::Carried;
use super::certificate::{Bank, Granted, Sums, Target, Terms, sunk, tangential};
use crate::model::Friction;
use crate::solver::constraints::StepTimes;
use crate::solver::contact::geometry::motion::Points;
use crate::vector::{add, dot, scaled, subtract};

/// Part of the last step's force with which the passes begin. Where they end early, force follows overlap with the lag
/// of this filter: a point on a spring of any stiffness that passes can make would gain energy from 1/2 on (the roots of
/// z³ − (2 + β) z² + (1 + 2β) z − β + 2α z² − α z with β = `BEGINNING` (1 − α)). The certificate would not grant it, but
/// what it cuts off shakes the bodies: at 0.9 the energy balance of the patch test V-27 was off by a hundredth.
const BEGINNING: f64 = 0.4;

/// Least share of its members' masses that a constraint claims. With partitions by impedance a heavy node on a light face
/// would have next to none: where light nodes answer for themselves, too, the others between them would follow in thousands
/// of passes.
const LEAST_SHARE: f64 = 0.25;

/// Passes go on until they move nothing by more than this part of the farthest motion of a contact in the step. What sinks in while
/// loads are small can be lifted only at the price of the loads that come.
const SETTLED: f64 = 0.002;

/// A constraint that its members can follow only by less than this part of how far they can move at all is held: a tilt of
/// a thousandth between a normal and the directions that are held. Round-off would move it.
const HELD: f64 = 1e-6;

/// Points that one constraint can join: a point and four corners.
pub const MEMBERS: usize = 5;

/// A gap to be closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraint {
    /// Points that take part; the first `count` count.
    pub members: [u32; MEMBERS],
    /// Their weights.
    pub weights: [f64; MEMBERS],
    /// Number of members.
    pub count: usize,
    /// Unit normal along which the first member is pushed.
    pub normal: [f64; 3],
    /// Gap at the end of the step without contact.
    pub gap: f64,
    /// Whether it was there in the step before; else its members meet anew.
    pub held: bool,
    /// Length that the gap is small against.
    pub size: f64,
    /// Weight of this constraint where points share their mass among several: the slave share of the partition.
    pub share: f64,
    /// Coulomb friction.
    pub friction: Friction,
    /// Forces of the last step, until [`Enforcer::solve`] finds the new ones: the normal force λ and the friction force on
    /// the first member.
    pub carried: Carried,
    /// What has made it. Constraints are in the order of their origins.
    pub origin: Origin,
}

/// What a constraint comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// A point and the place among the faces that it touches.
    Face(u32, u32),
    /// Two edges.
    Edges(u32, u32),
    /// One of the points that rigid planes watch.
    Plane(u32),
}

impl Constraint {
    /// Members with their weights.
    pub fn parts(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.members.iter().zip(&self.weights).take(self.count).map(|(&point, &weight)| (point as usize, weight))
    }

    /// Relative velocity of its members: Σ w v, over the step without contact, and over the step before.
    fn velocities(&self, points: &Points) -> [[f64; 3]; 2] {
        let of = |velocity: fn(&Points, u32) -> [f64; 3]| {
            self.parts().fold([0.0; 3], |sum, (point, weight)| add(sum, scaled(velocity(points, point as u32), weight)))
        };
        [of(Points::velocity), of(Points::velocity_before)]
    }

    /// Relative velocity that forces give its members.
    fn change(&self, moved: &[Moved]) -> [f64; 3] {
        self.parts().fold([0.0; 3], |sum, (point, w)| add(sum, scaled(moved[point].change, w)))
    }

    /// Goes only a part of the way along the ray of the forces, which give it the velocity `change` in all.
    fn shorten(&mut self, state: &State, change: [f64; 3], ray: f64, drift: f64) {
        let Carried { sunk: before, push, drag } = self.carried;
        let along = ray * dot(change, self.normal);
        let sunk = sunk(before, self.gap + drift * along, state.free + along, drift);
        self.carried = Carried { sunk, push: ray * push, drag: scaled(drag, ray) };
    }
}

/// Who pays for what contact gives back.
pub enum Ledger<'a> {
    /// All contacts of all ranks draw on one bank.
    Bank(&'a mut Bank),
    /// The constraints of each point are for themselves: rigid planes alone. What motion has made of an overlap is lifted without a
    /// bank; there is no other side that could drive it.
    Points,
    /// Nobody: nodes are moved before the run, without velocities.
    Nobody,
}

impl Ledger<'_> {
    /// What is granted when forces are sought.
    fn granted(&self) -> Granted {
        match self {
            Ledger::Bank(bank) => bank.granted(),
            Ledger::Points => [1.0; 2],
            Ledger::Nobody => [1.0; 2],
        }
    }
}

/// How far the passes go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest number of passes.
    pub passes: u32,
    /// Overlap that is left alone, as a part of the face's size.
    pub tolerance: f64,
}

/// What became of a step's constraints.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// Passes made.
    pub passes: u32,
    /// How much the last pass still moved, as a part of the face's size: about the largest overlap left.
    pub left: f64,
    /// Deepest overlap that motion had made before the step, as a part of the face's size.
    pub deepest: f64,
    /// The deepest one as a length.
    pub depth: f64,
    /// Farthest that a constraint would move along its normal in the step without contact, a length.
    pub motion: f64,
}

/// Numbers of which all ranks learn the largest in a pass: how much it moved, whether anybody wants it, and of the overlaps
/// that motion has made so far the deepest in face sizes, the deepest, and the farthest motion of the step.
pub const VOTES: usize = 6;

/// What ranks tell each other in the course of the passes; nothing on one rank.
pub trait Others {
    /// Appends the constraints of others that act on points which this rank answers for, and sends them those that act on
    /// theirs.
    fn copy(&mut self, constraints: &mut Vec<Constraint>, states: &mut Vec<State>);
    /// Brings what others know of points that are theirs: how far forces move them, and what constraints weigh there.
    fn share(&mut self, moved: &mut [Moved]);
    /// The largest of all ranks' values, of each kind.
    fn largest(&mut self, values: [f64; VOTES]) -> [f64; VOTES];
    /// Replaces sums by those over all ranks.
    fn sum(&mut self, sums: &mut Sums);
    /// Whether there are any.
    fn are_there(&self) -> bool;
}

/// There are no others.
pub struct Alone;

impl Others for Alone {
    fn copy(&mut self, _: &mut Vec<Constraint>, _: &mut Vec<State>) {}

    fn share(&mut self, _: &mut [Moved]) {}

    fn largest(&mut self, values: [f64; VOTES]) -> [f64; VOTES] {
        values
    }

    fn sum(&mut self, _: &mut Sums) {}

    fn are_there(&self) -> bool {
        false
    }
}

/// A point in the course of the passes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moved {
    /// Change of velocity that the forces make.
    pub change: [f64; 3],
    /// Sum of what the active constraints weigh at the point.
    pub load: f64,
}

/// A constraint in the course of the passes.
#[derive(Debug, Clone, Copy, Default)]
pub struct State {
    /// Reduced mass of the constraint alone, times its share; 0 where nothing can be moved.
    pub strength: f64,
    /// For each member, |w| times what a unit force along the normal does to it, and to what slides.
    pub softness: [[f64; 2]; MEMBERS],
    /// Velocity of sliding without contact forces.
    pub slip: [f64; 3],
    /// The same over the step before.
    pub slip_before: [f64; 3],
    /// Velocity along the normal without contact forces, u*.
    pub free: f64,
    /// The same over the step before, u⁻.
    pub before: f64,
    /// Velocity along the normal that it is to have at least after the step.
    pub target: Target,
    /// How far the constraint would stay behind that velocity over the step without contact forces: a length, negative
    /// where it would.
    pub closing: f64,
    /// Whether this rank has made it.
    pub own: bool,
    /// Normal and friction force of the last pass.
    pub last: (f64, [f64; 3]),
    /// Whether it pushes or overlaps.
    pub active: bool,
}

/// Buffers of the passes, kept from step to step.
#[derive(Debug, Clone, Default)]
pub struct Enforcer {
    /// Normal forces on the points.
    pub normal_force: Vec<[f64; 3]>,
    /// Friction forces on the points.
    pub friction_force: Vec<[f64; 3]>,
    moved: Vec<Moved>,
    /// Forces and loads while they are summed.
    sums: Vec<Moved>,
    states: Vec<State>,
    /// Rays of single points, where the ledger is theirs.
    rays: Vec<Terms>,
    /// Points of the constraints, ascending.
    members: Vec<u32>,
    is_member: Vec<bool>,
}

/// 1/m along a direction.
fn along(inverse_mass: [f64; 3], n: [f64; 3]) -> f64 {
    inverse_mass[0] * n[0] * n[0] + inverse_mass[1] * n[1] * n[1] + inverse_mass[2] * n[2] * n[2]
}

/// Times that turn velocities into ways and forces into velocities.
#[derive(Clone, Copy)]
struct Times {
    drift: f64,
    kick: f64,
    both: f64,
}

impl Enforcer {
    /// Buffers for so many points.
    pub fn new(points: usize) -> Enforcer {
        Enforcer {
            normal_force: vec![[0.0; 3]; points],
            friction_force: vec![[0.0; 3]; points],
            moved: vec![Moved::default(); points],
            sums: vec![Moved::default(); points],
            is_member: vec![false; points],
            ..Default::default()
        }
    }

    /// Finds the forces of all constraints that were prepared, and their sums at the points. The order of the constraints
    /// is that of the sums and must not depend on the decomposition.
    pub fn solve(
        &mut self,
        constraints: &mut [Constraint],
        points: &Points,
        step: &StepTimes,
        limits: Limits,
        (ledger, others): (Ledger, &mut dyn Others),
    ) -> Outcome {
        let times = Times { drift: step.drift, kick: step.kick, both: step.drift * step.kick };
        self.list_members(constraints);
        for (c, state) in constraints.iter().zip(&mut self.states) {
            state.last = (c.carried.push, c.carried.drag);
            state.active = state.strength > 0.0 && (c.carried.push > 0.0 || state.closing < 0.0);
        }
        // Where nothing overlaps there is nothing to do. One pass is made for the smallest overlap:
        // under small loads a step's overlap is far below any tolerance; left alone until it has grown, it would come
        // out as a row of blows instead of a steady force.
        let wanted = self.states.iter().any(|state| state.closing < 0.0);
        let outcome = if wanted || others.are_there() {
            self.passes(constraints, points, times, limits, wanted, others)
        } else {
            None
        };
        if outcome.is_some() {
            for (c, state) in constraints.iter_mut().zip(&self.states) {
                (c.carried.push, c.carried.drag) = state.last;
            }
            self.settle(constraints, points, times, ledger, others);
        } else {
            for (c, state) in constraints.iter_mut().zip(&self.states) {
                c.shorten(state, [0.0; 3], 0.0, times.drift);
            }
        }
        self.sum_forces(constraints);
        outcome.unwrap_or_default()
    }

    /// Goes along the ray of the forces only so far that they give no energy which the ledger does not pay.
    fn settle(
        &mut self,
        constraints: &mut [Constraint],
        points: &Points,
        times: Times,
        ledger: Ledger,
        others: &mut dyn Others,
    ) {
        if let Ledger::Nobody = ledger {
            return;
        }
        self.scatter(constraints, points, times, others);
        let granted = ledger.granted();
        let mut all = Sums::default();
        self.rays.clear();
        if let Ledger::Points = ledger {
            self.rays.resize(self.moved.len(), Terms::default());
        }
        for (c, state) in constraints.iter().zip(&self.states).filter(|(c, _)| c.carried.push > 0.0) {
            match ledger {
                Ledger::Points => self.rays[c.members[0] as usize].add(&Terms::of(c, state, c.change(&self.moved))),
                _ if state.own => all.add(&Terms::of(c, state, c.change(&self.moved))),
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
        for (c, state) in constraints.iter_mut().zip(&self.states) {
            let ray = self.rays.get(c.members[0] as usize).map_or(ray, |terms| terms.ray(granted).min(1.0));
            c.shorten(state, c.change(&self.moved), ray, times.drift);
        }
    }

    /// The passes; `None` where nobody wants them. Others are asked with the first: where somebody wants them, and that is
    /// nearly always, it costs nothing.
    fn passes(
        &mut self,
        constraints: &mut [Constraint],
        points: &Points,
        times: Times,
        limits: Limits,
        wanted: bool,
        others: &mut dyn Others,
    ) -> Option<Outcome> {
        let (mut outcome, mut momentum) = (Outcome::default(), Momentum::new());
        let [deepest, depth, motion] = self.extent(constraints, times.drift);
        loop {
            self.scatter(constraints, points, times, others);
            let ahead = momentum.next();
            let (mut worst, mut farthest) = (0.0, 0.0);
            for (c, state) in constraints.iter_mut().zip(&mut self.states).filter(|(_, state)| state.strength > 0.0) {
                let way = correct(c, state, &self.moved, times, ahead);
                (worst, farthest) = (f64::max(worst, way / c.size), f64::max(farthest, way));
            }
            let votes = others.largest([worst, f64::from(u8::from(wanted)), deepest, depth, motion, farthest]);
            let [left, any_wanted, ..] = votes;
            if any_wanted == 0.0 {
                return None;
            }
            let [_, _, deepest, depth, motion, farthest] = votes;
            outcome = Outcome { left, passes: outcome.passes + 1, deepest, depth, motion };
            let settled = outcome.left <= limits.tolerance && farthest <= SETTLED * motion;
            if settled || outcome.passes == limits.passes {
                return Some(outcome);
            }
        }
    }

    /// Deepest overlap that motion has made, in face sizes and as a length, and the farthest that a constraint would move.
    fn extent(&self, constraints: &[Constraint], drift: f64) -> [f64; 3] {
        let own = constraints.iter().zip(&self.states).filter(|(_, state)| state.own && state.strength > 0.0);
        own.fold([0.0; 3], |[deepest, depth, motion], (c, state)| {
            let sunk = c.carried.sunk;
            [(sunk / c.size).max(deepest), sunk.max(depth), (drift * state.free).abs().max(motion)]
        })
    }

    /// Change of velocity that the forces make at a point.
    pub fn change(&self, point: usize, points: &Points, kick: f64) -> [f64; 3] {
        let (force, m) = (add(self.normal_force[point], self.friction_force[point]), points.inverse_mass[point]);
        [0, 1, 2].map(|i| kick * (force[i] * m[i]))
    }

    /// What does not change in the passes, of each constraint.
    pub fn states(&mut self) -> &mut Vec<State> {
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

    /// Finds what does not change in the passes, and the friction of the last step in the new planes; before
    /// [`Enforcer::solve`].
    pub fn prepare(&mut self, constraints: &mut [Constraint], points: &Points, drift: f64, ledger: &Ledger) {
        self.states.clear();
        let granted = ledger.granted();
        for c in constraints {
            let Carried { push, drag, .. } = c.carried;
            (c.carried.push, c.carried.drag) = (BEGINNING * push, scaled(drag, BEGINNING));
            let mut state = State { own: true, ..Default::default() };
            let (mut inverse, mut isotropic) = (0.0, 0.0);
            for (i, (point, w)) in c.parts().enumerate() {
                let m = points.inverse_mass[point];
                let one = along(m, c.normal);
                inverse += w * w * one;
                let most = m[0].max(m[1]).max(m[2]);
                isotropic += w * w * most;
                state.softness[i] = [w.abs() * one, w.abs() * most];
            }
            let [free, before] = c.velocities(points);
            (state.free, state.before) = (dot(free, c.normal), dot(before, c.normal));
            state.target = match ledger {
                Ledger::Nobody => Target { least: state.free - c.gap / drift, ..Default::default() },
                _ => Target::of(c, [state.before, state.free], drift),
            };
            // Where all members are held there is nothing to move.
            if inverse > HELD * isotropic {
                state.strength = c.share.max(LEAST_SHARE) / inverse;
                state.closing = drift * (state.free - state.target.with(granted));
            } else {
                (c.carried.push, c.carried.drag) = (0.0, [0.0; 3]);
            }
            if c.friction.is_some() {
                (state.slip, state.slip_before) = (tangential(free, c.normal), tangential(before, c.normal));
                c.carried.drag = tangential(c.carried.drag, c.normal);
            } else {
                c.carried.drag = [0.0; 3];
            }
            self.states.push(state);
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

    /// Sums forces and loads at the points, in the order of the constraints, and finds how far they move.
    fn scatter(&mut self, constraints: &[Constraint], points: &Points, times: Times, others: &mut dyn Others) {
        for (c, state) in constraints.iter().zip(&self.states).filter(|(_, state)| state.active) {
            let force = add(scaled(c.normal, c.carried.push), c.carried.drag);
            for (point, w) in c.parts() {
                let sum = &mut self.sums[point];
                sum.change = add(sum.change, scaled(force, w));
                sum.load += w.abs() * state.strength;
            }
        }
        for &point in &self.members {
            let p = point as usize;
            let sum = std::mem::take(&mut self.sums[p]);
            // What others answer for comes from them.
            let Some(m) = points.inverse_mass.get(p) else { continue };
            let ([x, y, z], k) = (sum.change, times.kick);
            self.moved[p] = Moved { change: [k * (x * m[0]), k * (y * m[1]), k * (z * m[2])], load: sum.load };
        }
        others.share(&mut self.moved);
    }

    /// Sums the forces that were found, in the order of the constraints.
    fn sum_forces(&mut self, constraints: &[Constraint]) {
        for &point in &self.members {
            (self.normal_force[point as usize], self.friction_force[point as usize]) = ([0.0; 3], [0.0; 3]);
        }
        for c in constraints.iter().filter(|c| c.carried.push > 0.0) {
            for (point, w) in c.parts() {
                self.normal_force[point] = add(self.normal_force[point], scaled(c.normal, w * c.carried.push));
                self.friction_force[point] = add(self.friction_force[point], scaled(c.carried.drag, w));
            }
        }
    }
}

/// How far the next pass goes on in the direction of the one before.
struct Momentum(f64);

impl Momentum {
    fn new() -> Momentum {
        Momentum(1.0)
    }

    fn next(&mut self) -> f64 {
        let before = self.0;
        self.0 = 0.5 * (1.0 + (1.0 + 4.0 * before * before).sqrt());
        (before - 1.0) / self.0
    }
}

/// Closes the gap of one constraint as if it were alone with its shares of the masses, and goes on in this direction by a
/// part `ahead`. How far it moves, a length.
fn correct(c: &mut Constraint, state: &mut State, moved: &[Moved], times: Times, ahead: f64) -> f64 {
    let change = c.change(moved);
    let gap = state.closing + times.drift * dot(change, c.normal);
    let Carried { push: tried, drag: tried_drag, .. } = c.carried;
    if tried == 0.0 && gap >= 0.0 {
        (c.carried.drag, state.last, state.active) = ([0.0; 3], (0.0, [0.0; 3]), false);
        return 0.0;
    }
    let (mut inverse, mut sliding) = (0.0, 0.0);
    for ((point, w), softness) in c.parts().zip(&state.softness) {
        // A constraint that has just become active is not yet in the load.
        let own = if state.active { 0.0 } else { w.abs() };
        let share = moved[point].load / state.strength + own;
        inverse += share * softness[0];
        sliding += share * softness[1];
    }
    let push = (tried - gap / (times.both * inverse)).max(0.0);
    let mut way = (push - tried).abs() * times.both * inverse;
    let push_ahead = further(tried, push, state.last.0, ahead).max(0.0);
    if c.friction.is_some() {
        let slip = add(state.slip, tangential(change, c.normal));
        let wanted = subtract(tried_drag, scaled(slip, 1.0 / (times.kick * sliding)));
        let (size, most) = (dot(wanted, wanted).sqrt(), c.friction.coefficient(slip) * push);
        let drag = if size > most { scaled(wanted, most / size) } else { wanted };
        let turn = subtract(drag, tried_drag);
        way = way.max(dot(turn, turn).sqrt() * times.both * sliding);
        c.carried.drag = [0, 1, 2].map(|i| further(tried_drag[i], drag[i], state.last.1[i], ahead));
        state.last.1 = drag;
    }
    (c.carried.push, state.last.0, state.active) = (push_ahead, push, true);
    way
}

/// From `new`, a part `ahead` of the way from the last pass to this one further, unless the correction goes back.
fn further(tried: f64, new: f64, last: f64, ahead: f64) -> f64 {
    let turns_back = (tried - new) * (new - last) > 0.0;
    if turns_back { new } else { new + ahead * (new - last) }
}
