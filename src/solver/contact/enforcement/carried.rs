//! What a contact carries from step to step.

use crate::common::vector::scaled;

/// Numbers of [`Carried`] in files and messages.
pub const WIDTH: usize = 5;

/// What a contact carries from step to step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Carried {
    /// Overlap that motion has made, a length of at least 0. Only so much may be taken out by a force: to lift out
    /// what jumped in otherwise, as when a normal turns, would make energy.
    pub penetration: f64,
    /// Normal force of the last step.
    pub normal_force: f64,
    /// Friction force of the last step on the first member.
    pub tangential_force: [f64; 3],
}

impl Carried {
    /// Of a contact that is new.
    pub const NOTHING: Carried = Carried { penetration: 0.0, normal_force: 0.0, tangential_force: [0.0; 3] };

    /// As numbers; zeros have no sign, which would tell in a restart file on how many ranks a force had been summed.
    pub fn to_array(self) -> [f64; WIDTH] {
        let [x, y, z] = self.tangential_force.map(|force| force + 0.0);
        [self.penetration, self.normal_force, x, y, z]
    }

    /// From these numbers.
    pub fn from_array([penetration, normal_force, x, y, z]: [f64; WIDTH]) -> Carried {
        Carried { penetration, normal_force, tangential_force: [x, y, z] }
    }

    /// The same contact seen from the other side.
    pub fn reversed(self) -> Carried {
        Carried { tangential_force: scaled(self.tangential_force, -1.0), ..self }
    }
}
