//! JWL: detonation products by Jones, Wilkins and Lee, with programmed burn.

use super::super::property::STRESS;
use super::super::{Entry, Origin, Property, Range};
use super::{EquationOfState, Terms, stiff};
use crate::lanes::{Lanes, exp};

/// Burn front width that keeps the front smooth.
const WIDTH: f64 = 2.5;

parameters! {
    /// p = A (1 − ω/(R₁v)) e^(−R₁v) + B (1 − ω/(R₂v)) e^(−R₂v) + ω E/v.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Jwl {
        /// A, force/length².
        pub a: f64 = [
            Property::required("A", "A", STRESS, Range::NotNegative, "Factor of the first exponential."),
        ],
        /// B, force/length².
        pub b: f64 = [
            Property::required("B", "B", STRESS, Range::Any, "Factor of the second exponential."),
        ],
        /// R₁
        pub r1: f64 = [
            Property::required("R1", "R1", "-", Range::Positive, "Decay of the first exponential with relative volume."),
        ],
        /// R₂
        pub r2: f64 = [
            Property::required("R2", "R2", "-", Range::Positive, "Decay of the second exponential."),
        ],
        /// ω
        pub omega: f64 = [
            Property::required("OMEGA", "omega", "-", Range::Positive, "Grueneisen parameter of the expanded products."),
        ],
        /// Internal energy per initial volume at the start, which the detonation sets free.
        pub initial_energy: f64 = [
            Property::required(
                "INITIAL ENERGY", "E0", STRESS, Range::Positive,
                "Energy that the detonation sets free, per initial volume.",
            ),
        ],
        /// Detonation velocity D.
        pub velocity: f64 = [
            Property::required(
                "DETONATION VELOCITY", "D", "length/time", Range::Positive,
                "Speed at which the burn front leaves the detonation points.",
            ),
        ],
        /// Width of the burn front in element lengths.
        pub width: f64 = [
            Property::required(
                "BURN WIDTH", "w", "-", Range::Positive,
                "Width of the burn front in lengths of the element it passes: cube roots of its volume, in the plane roots of its area.",
            )
            .or(WIDTH),
        ],
    }
}

pub(super) static ENTRY: Entry<EquationOfState> = Entry {
    name: "JWL",
    aliases: &[],
    summary: "Products of an explosive by Jones, Wilkins and Lee; DETONATION POINT lights it.",
    properties: Jwl::PROPERTIES,
    state: &[],
    origin: Origin::Recalled,
    build: |given| stiff(EquationOfState::Jwl(Jwl::read(given)?), "A"),
};

impl Jwl {
    #[inline(always)]
    pub(super) fn terms<V: Lanes>(&self, volume: V) -> Terms<V> {
        let inverse = V::splat(1.0) / volume;
        let omega = V::splat(self.omega) * inverse;
        let (first, second) = (exponential(self.a, self.r1, volume), exponential(self.b, self.r2, volume));
        let [over1, over2] = [omega * V::splat(1.0 / self.r1), omega * V::splat(1.0 / self.r2)];
        let one = V::splat(1.0);
        // d/dv of (1 − ω/(Rv)) e^(−Rv) is (ω/(Rv²) + ω/v − R) e^(−Rv).
        let slope1 = over1 * inverse + omega - V::splat(self.r1);
        let slope2 = over2 * inverse + omega - V::splat(self.r2);
        Terms {
            a: first * (one - over1) + second * (one - over2),
            b: omega,
            a_slope: first * slope1 + second * slope2,
            b_slope: -(omega * inverse),
        }
    }
}

/// factor · e^(−r v)
#[inline(always)]
fn exponential<V: Lanes>(factor: f64, r: f64, volume: V) -> V {
    V::splat(factor) * exp(volume * V::splat(-r))
}
