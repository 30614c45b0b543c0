//! JWL: detonation products by Jones, Wilkins and Lee, with programmed burn.

use super::super::property::STRESS;
use super::super::{Entry, Origin, Property, Range};
use super::{EquationOfState, Terms, stiff};
use crate::lanes::{Lanes, exp};

/// p = A (1 − ω/(R₁v)) e^(−R₁v) + B (1 − ω/(R₂v)) e^(−R₂v) + ω E/v.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jwl {
    /// A, force/length².
    pub a: f64,
    /// B, force/length².
    pub b: f64,
    /// R₁
    pub r1: f64,
    /// R₂
    pub r2: f64,
    /// ω
    pub omega: f64,
    /// Internal energy per initial volume at the start, which the detonation sets free.
    pub initial_energy: f64,
    /// Detonation velocity D.
    pub velocity: f64,
    /// Width of the burn front in element lengths.
    pub width: f64,
}

/// Burn front width that keeps the front smooth.
const WIDTH: f64 = 2.5;

pub(super) static ENTRY: Entry<EquationOfState> = Entry {
    name: "JWL",
    aliases: &[],
    summary: "Products of an explosive by Jones, Wilkins and Lee; DETONATION POINT lights it.",
    properties: &[
        Property::required("A", "A", STRESS, Range::NotNegative, "Factor of the first exponential."),
        Property::required("B", "B", STRESS, Range::Any, "Factor of the second exponential."),
        Property::required("R1", "R1", "-", Range::Positive, "Decay of the first exponential with relative volume."),
        Property::required("R2", "R2", "-", Range::Positive, "Decay of the second exponential."),
        Property::required("OMEGA", "omega", "-", Range::Positive, "Grueneisen parameter of the expanded products."),
        Property::required(
            "INITIAL ENERGY",
            "E0",
            STRESS,
            Range::Positive,
            "Energy that the detonation sets free, per initial volume.",
        ),
        Property::required(
            "DETONATION VELOCITY",
            "D",
            "length/time",
            Range::Positive,
            "Speed at which the burn front leaves the detonation points.",
        ),
        Property::required(
            "BURN WIDTH",
            "w",
            "-",
            Range::Positive,
            "Width of the burn front in lengths of the element it passes.",
        )
        .or(WIDTH),
    ],
    state: &[],
    origin: Origin::Recalled,
    build: |v| {
        let (initial_energy, velocity, width) = (v[5], v[6], v[7]);
        let jwl = Jwl { a: v[0], b: v[1], r1: v[2], r2: v[3], omega: v[4], initial_energy, velocity, width };
        stiff(EquationOfState::Jwl(jwl), "A")
    },
};

impl Jwl {
    pub(super) fn values(&self) -> Vec<f64> {
        vec![self.a, self.b, self.r1, self.r2, self.omega, self.initial_energy, self.velocity, self.width]
    }

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
