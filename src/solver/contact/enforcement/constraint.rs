//! A constraint of contact: the members whose gap is to be closed, and what is known of it in a step.

use super::accounts::certificate::{Target, penetration_after};
use super::carried::Carried;
use crate::common::vector::{add, dot, scaled};
use crate::model::Friction;
use crate::solver::contact::geometry::motion::NodeMotion;

/// Points that one constraint can join: a point and four corners.
pub const MEMBERS: usize = 5;

/// A gap to be closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraint {
    /// Points that take part; the first `count` count.
    pub members: [u32; MEMBERS],
    /// Their weights, without dimension; they add up to 0 unless it is with a plane.
    pub weights: [f64; MEMBERS],
    /// Number of members.
    pub count: usize,
    /// Unit normal along which the first member is pushed.
    pub normal: [f64; 3],
    /// Gap at the end of the step without contact, a length; negative in an overlap.
    pub gap: f64,
    /// Velocity with which the surfaces grow towards each other; from it relative velocities are counted.
    pub growth: f64,
    /// Whether it was there in the step before; else its members meet anew.
    pub persists: bool,
    /// Whether it leaves its nodes to another constraint at first, see `node_pairs`.
    pub yields: bool,
    /// Whether its members touch at a distance, the thickness of one of them: see `giving_way`.
    pub is_thick: bool,
    /// Length that the gap is small against.
    pub size: f64,
    /// Weight of this constraint where points share their mass among several: the slave share of the partition.
    pub share: f64,
    /// Coulomb friction.
    pub friction: Friction,
    /// Forces of the last step, until `Enforcer::solve` finds the new ones: the normal force λ and the friction force on
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
    /// A node of a rigid plane, by its number.
    Plane(u32),
}

impl Origin {
    /// As numbers, for messages.
    pub fn to_array(self) -> [f64; 3] {
        let (kind, a, b) = match self {
            Origin::Face(a, b) => (0, a, b),
            Origin::Edges(a, b) => (1, a, b),
            Origin::Plane(a) => (2, a, 0),
        };
        [kind, a, b].map(f64::from)
    }

    /// From these numbers.
    pub fn from_array(numbers: [f64; 3]) -> Origin {
        match numbers.map(|number| number as u32) {
            [0, a, b] => Origin::Face(a, b),
            [1, a, b] => Origin::Edges(a, b),
            [_, a, _] => Origin::Plane(a),
        }
    }
}

impl Constraint {
    /// Members with their weights.
    pub fn parts(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.members.iter().zip(&self.weights).take(self.count).map(|(&point, &weight)| (point as usize, weight))
    }

    /// Relative velocity of its members: Σ w v, over the step without contact, and over the step before.
    pub fn velocities(&self, motion: &NodeMotion) -> [[f64; 3]; 2] {
        let (mut free, mut before) = ([0.0; 3], [0.0; 3]);
        for (point, weight) in self.parts() {
            free = add(free, scaled(motion.velocity(point as u32), weight));
            before = add(before, scaled(motion.velocity_before(point as u32), weight));
        }
        [free, before]
    }

    /// Relative velocity that forces give its members.
    pub fn velocity_change(&self, responses: &[Response]) -> [f64; 3] {
        self.parts().fold([0.0; 3], |sum, (point, w)| add(sum, scaled(responses[point].velocity_change, w)))
    }

    /// Scales the forces along their ray by the factor `ray`, which may be larger than 1; in full length all forces change the
    /// velocity of the constraint by `change`.
    pub fn scale_along_ray(&mut self, state: &ConstraintState, change: [f64; 3], ray: f64, drift: f64) {
        let Carried { penetration: before, normal_force, tangential_force } = self.carried;
        let along = ray * dot(change, self.normal);
        let penetration = penetration_after(before, self.gap + drift * along, state.free + along, drift);
        self.carried =
            Carried { penetration, normal_force: ray * normal_force, tangential_force: scaled(tangential_force, ray) };
    }
}

/// How a node responds to the forces in the course of the iterations.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(C, align(32))]
pub struct Response {
    /// Change of velocity that the forces make, length per time.
    pub velocity_change: [f64; 3],
    /// Sum of what the active constraints weigh at the node, a mass.
    pub load: f64,
}

impl Response {
    /// As one vector, the load last.
    #[inline(always)]
    pub fn to_array(self) -> [f64; 4] {
        let [x, y, z] = self.velocity_change;
        [x, y, z, self.load]
    }

    /// From this vector.
    #[inline(always)]
    pub fn from_array([x, y, z, load]: [f64; 4]) -> Response {
        Response { velocity_change: [x, y, z], load }
    }
}

/// What is known of a constraint in a step beyond what it is: before the iterations, and after them.
#[derive(Debug, Clone, Copy, Default)]
pub struct ConstraintState {
    /// Reduced mass of the constraint alone, times its share, a mass; 0 where nothing can be moved.
    pub strength: f64,
    /// For each member, |w| times what a unit force along the normal does to it, and to what slides.
    pub softness: [[f64; 2]; MEMBERS],
    /// How far it gives way under a unit force where there is no room, an inverse mass; 0 without a thickness.
    pub compliance: f64,
    /// Velocity of sliding without contact forces, length per time.
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
    /// How far the forces went along their ray, without dimension.
    pub ray: f64,
    /// Whether it asks for less than it should because a rigid body has too little room.
    pub pinned: bool,
    /// Whether this rank has made it.
    pub own: bool,
    /// Whether it pushed or overlapped at any time in this step: else nothing would be another without it.
    pub touched: bool,
    /// Whether it yields in the next step, see `node_pairs`.
    pub yields: bool,
    /// Whether its friction was ever as large as it can be: else a larger coefficient would change nothing.
    pub slid: bool,
}
