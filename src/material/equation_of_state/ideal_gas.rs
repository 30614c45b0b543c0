//! IDEAL GAS.

use super::super::property::STRESS;
use super::super::{Entry, Origin, Property, Range};
use super::{EquationOfState, Terms};
use crate::lanes::Lanes;

parameters! {
    /// p = (γ − 1) ρ e = (γ − 1) E/v.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct IdealGas {
        /// Ratio of specific heats γ.
        pub gamma: f64 = [
            Property::required(
                "GAMMA", "gamma", "-", Range::Between { low: (1.0, false), high: (100.0, true) },
                "Ratio of specific heats.",
            ),
        ],
        /// Internal energy per initial volume at the start.
        pub initial_energy: f64 = [
            Property::required(
                "INITIAL ENERGY", "E0", STRESS, Range::Positive,
                "Internal energy per initial volume at the start; the pressure is gamma - 1 times it.",
            ),
        ],
    }
}

pub(super) static ENTRY: Entry<EquationOfState> = Entry {
    name: "IDEAL GAS",
    aliases: &[],
    summary: "Ideal gas with constant specific heats.",
    properties: IdealGas::PROPERTIES,
    state: &[],
    origin: Origin::Recalled,
    build: |given| Ok(EquationOfState::IdealGas(IdealGas::read(given)?)),
};

impl IdealGas {
    #[inline(always)]
    pub(super) fn terms<V: Lanes>(&self, volume: V) -> Terms<V> {
        let (zero, inverse) = (V::splat(0.0), V::splat(1.0) / volume);
        let b = V::splat(self.gamma - 1.0) * inverse;
        Terms { a: zero, b, a_slope: zero, b_slope: -(b * inverse) }
    }
}
