//! MG US-UP and MG POWER SERIES: solids around their Hugoniot, p = p_H(η)(1 − ½Γη) + Γ E with η = 1 − v.
//!
//! Γ stands for Γ₀ ρ₀/ρ · ρ/ρ₀: the product of Grüneisen parameter and density is constant.

use super::super::property::STRESS;
use super::super::{Entry, Origin, Property, Range};
use super::{EquationOfState, Terms, stiff};
use crate::lanes::Lanes;

/// p_H = ρ₀c₀² η/(1 − sη)²: the shock speed is c₀ + s times the particle speed. In tension p_H = ρ₀c₀² η.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UsUp {
    /// Bulk sound speed c₀.
    pub speed: f64,
    /// Slope s of shock speed over particle speed.
    pub slope: f64,
    /// Grüneisen parameter Γ at the initial density.
    pub gamma: f64,
    /// Internal energy per initial volume at the start.
    pub initial_energy: f64,
    /// Initial mass density ρ₀.
    pub density: f64,
}

/// p_H = K₁η + K₂η² + K₃η³ + K₄η⁴ + K₅η⁵. In tension p_H = K₁ η.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerSeries {
    /// Coefficients K₁ to K₅, force/length².
    pub coefficients: [f64; 5],
    /// Grüneisen parameter Γ at the initial density.
    pub gamma: f64,
    /// Internal energy per initial volume at the start.
    pub initial_energy: f64,
}

const GAMMA: Property =
    Property::required("GAMMA", "Gamma", "-", Range::NotNegative, "Grueneisen parameter at the initial density.");

const INITIAL_ENERGY: Property =
    Property::required("INITIAL ENERGY", "E0", STRESS, Range::Any, "Internal energy per initial volume at the start.")
        .or(0.0);

const fn coefficient(keyword: &'static str) -> Property {
    Property::required(keyword, keyword, STRESS, Range::Any, "Factor of this power of the compression.").or(0.0)
}

pub(super) static US_UP: Entry<EquationOfState> = Entry {
    name: "MG US-UP",
    aliases: &["MG US UP", "MIE GRUNEISEN US-UP"],
    summary: "Mie and Grueneisen, with a shock speed linear in the particle speed.",
    properties: &[
        Property::required("C0", "c0", "length/time", Range::Positive, "Shock speed of a weak shock."),
        Property::required("S", "s", "-", Range::NotNegative, "Slope of shock speed over particle speed."),
        GAMMA,
        INITIAL_ENERGY,
    ],
    state: &[],
    origin: Origin::Recalled,
    build: |v| {
        let (speed, slope, gamma, initial_energy) = (v[0], v[1], v[2], v[3]);
        stiff(EquationOfState::UsUp(UsUp { speed, slope, gamma, initial_energy, density: v.density }), "INITIAL ENERGY")
    },
};

pub(super) static POWER_SERIES: Entry<EquationOfState> = Entry {
    name: "MG POWER SERIES",
    aliases: &["MIE GRUNEISEN POWER SERIES"],
    summary: "Mie and Grueneisen, with a Hugoniot that is a polynomial of the compression 1 - V/V0.",
    properties: &[
        Property::required("K1", "K1", STRESS, Range::Positive, "Initial bulk modulus: factor of the compression."),
        coefficient("K2"),
        coefficient("K3"),
        coefficient("K4"),
        coefficient("K5"),
        GAMMA,
        INITIAL_ENERGY,
    ],
    state: &[],
    origin: Origin::Recalled,
    build: |v| {
        let coefficients = [v[0], v[1], v[2], v[3], v[4]];
        stiff(
            EquationOfState::PowerSeries(PowerSeries { coefficients, gamma: v[5], initial_energy: v[6] }),
            "INITIAL ENERGY",
        )
    },
};

/// 1 − sη is not below this: there, at many times the bulk modulus, the Hugoniot ends.
const LIMIT: f64 = 0.05;

impl UsUp {
    pub(super) fn values(&self) -> Vec<f64> {
        vec![self.speed, self.slope, self.gamma, self.initial_energy]
    }

    #[inline(always)]
    pub(super) fn terms<V: Lanes>(&self, volume: V) -> Terms<V> {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let modulus = V::splat(self.density * self.speed * self.speed);
        let compression = one - volume;
        let pressed = compression.max(zero) * V::splat(self.slope);
        let inverse = one / (one - pressed).max(V::splat(LIMIT));
        let square = inverse * inverse;
        let hugoniot = modulus * compression * square;
        terms(compression, hugoniot, modulus * (one + pressed) * square * inverse, self.gamma)
    }
}

impl PowerSeries {
    pub(super) fn values(&self) -> Vec<f64> {
        self.coefficients.into_iter().chain([self.gamma, self.initial_energy]).collect()
    }

    #[inline(always)]
    pub(super) fn terms<V: Lanes>(&self, volume: V) -> Terms<V> {
        let compression = V::splat(1.0) - volume;
        let pressed = compression.max(V::splat(0.0));
        // Horner's scheme for p_H/η and d(p_H)/dη, which are K₁ in tension.
        let (mut ratio, mut slope) = (V::splat(0.0), V::splat(0.0));
        for (power, coefficient) in (1..6).zip(self.coefficients).rev() {
            ratio = ratio * pressed + V::splat(coefficient);
            slope = slope * pressed + V::splat(f64::from(power) * coefficient);
        }
        terms(compression, ratio * compression, slope, self.gamma)
    }
}

/// Terms from the Hugoniot pressure and its slope by η.
#[inline(always)]
fn terms<V: Lanes>(compression: V, hugoniot: V, slope: V, gamma: f64) -> Terms<V> {
    let half = V::splat(0.5 * gamma);
    // In tension there is no shock to take the energy from.
    let share = V::splat(1.0) - half * compression.max(V::splat(0.0));
    let lost = V::select_less(V::splat(0.0), compression, half * hugoniot, V::splat(0.0));
    Terms { a: hugoniot * share, b: V::splat(gamma), a_slope: lost - slope * share, b_slope: V::splat(0.0) }
}
