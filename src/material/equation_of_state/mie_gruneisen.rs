//! MG US-UP and MG POWER SERIES: solids around their Hugoniot, p = p_H(η)(1 − ½Γη) + Γ E with η = 1 − v.
//!
//! Γ is the Grüneisen parameter at ρ₀; the product of parameter and density is taken to be constant.

use super::super::property::STRESS;
use super::super::{Entry, Given, Origin, Property, Range};
use super::{EquationOfState, Terms, stiff};
use crate::lanes::Lanes;

const GAMMA: Property =
    Property::required("GAMMA", "Gamma", "-", Range::NotNegative, "Grueneisen parameter at the initial density.");

const INITIAL_ENERGY: Property =
    Property::required("INITIAL ENERGY", "E0", STRESS, Range::Any, "Internal energy per initial volume at the start.")
        .or(0.0);

const fn coefficient(keyword: &'static str) -> Property {
    Property::required(keyword, keyword, STRESS, Range::Any, "Factor of this power of the compression.").or(0.0)
}

parameters! {
    /// p_H = ρ₀c₀² η/(1 − sη)²: the shock speed is c₀ + s times the particle speed. In tension p_H = ρ₀c₀² η, beyond sη = 0.95
    /// its tangent there.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct UsUp {
        /// Bulk sound speed c₀.
        pub speed: f64 = [
            Property::required("C0", "c0", "length/time", Range::Positive, "Shock speed of a weak shock."),
        ],
        /// Slope s of shock speed over particle speed.
        pub slope: f64 = [
            Property::required("S", "s", "-", Range::NotNegative, "Slope of shock speed over particle speed."),
        ],
        /// Grüneisen parameter Γ at the initial density.
        pub gamma: f64 = [GAMMA],
        /// Internal energy per initial volume at the start.
        pub initial_energy: f64 = [INITIAL_ENERGY],
    }
    with(given) {
        /// Initial mass density ρ₀.
        pub density: f64 = given.density,
    }
}

pub(super) static US_UP: Entry<EquationOfState> = Entry {
    name: "MG US-UP",
    aliases: &["MG US UP", "MIE GRUNEISEN US-UP"],
    summary: "Mie and Grueneisen, with a shock speed linear in the particle speed.",
    properties: UsUp::PROPERTIES,
    state: &[],
    origin: Origin::Recalled,
    build: |given| stiff(EquationOfState::UsUp(UsUp::read(given)?), "INITIAL ENERGY"),
};

parameters! {
    /// p_H = K₁η + K₂η² + K₃η³ + K₄η⁴ + K₅η⁵. In tension p_H = K₁ η.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct PowerSeries {
        /// Coefficients K₁ to K₅, force/length².
        pub coefficients: [f64; 5] = [
            Property::required("K1", "K1", STRESS, Range::Positive, "Initial bulk modulus: factor of the compression."),
            coefficient("K2"),
            coefficient("K3"),
            coefficient("K4"),
            coefficient("K5"),
        ],
        /// Grüneisen parameter Γ at the initial density.
        pub gamma: f64 = [GAMMA],
        /// Internal energy per initial volume at the start.
        pub initial_energy: f64 = [INITIAL_ENERGY],
    }
}

pub(super) static POWER_SERIES: Entry<EquationOfState> = Entry {
    name: "MG POWER SERIES",
    aliases: &["MIE GRUNEISEN POWER SERIES"],
    summary: "Mie and Grueneisen, with a Hugoniot that is a polynomial of the compression 1 - V/V0.",
    properties: PowerSeries::PROPERTIES,
    state: &[],
    origin: Origin::Recalled,
    build: |given| {
        let equation = PowerSeries::read(given)?;
        equation.warn_where_it_turns_over(given);
        stiff(EquationOfState::PowerSeries(equation), "INITIAL ENERGY")
    },
};

/// 1 − sη is not below this: the pole of the Hugoniot is near, and pressures are hundreds of times the bulk modulus. From there on
/// it goes along its tangent, so that what has locked does not become softer.
const LIMIT: f64 = 0.05;

impl UsUp {
    /// The compression η beyond which the tangent stands for the Hugoniot; infinite where there is no pole.
    pub(super) fn end(&self) -> f64 {
        if self.slope > 0.0 { (1.0 - LIMIT) / self.slope } else { f64::INFINITY }
    }

    #[inline(always)]
    pub(super) fn terms<V: Lanes>(&self, volume: V) -> Terms<V> {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let modulus = V::splat(self.density * self.speed * self.speed);
        let compression = one - volume;
        let on_curve = compression.min(V::splat(self.end()));
        let pressed = on_curve.max(zero) * V::splat(self.slope);
        let inverse = one / (one - pressed);
        let square = inverse * inverse;
        let slope = modulus * (one + pressed) * square * inverse;
        let hugoniot = modulus * on_curve * square + slope * (compression - on_curve);
        terms(compression, hugoniot, slope, self.gamma)
    }
}

impl PowerSeries {
    #[inline(always)]
    pub(super) fn terms<V: Lanes>(&self, volume: V) -> Terms<V> {
        let compression = V::splat(1.0) - volume;
        // Both are K₁ in tension.
        let (ratio, slope) = self.hugoniot(compression.max(V::splat(0.0)));
        terms(compression, ratio * compression, slope, self.gamma)
    }

    /// p_H/η and dp_H/dη by Horner's scheme.
    #[inline(always)]
    fn hugoniot<V: Lanes>(&self, pressed: V) -> (V, V) {
        let (mut ratio, mut slope) = (V::splat(0.0), V::splat(0.0));
        for (power, coefficient) in (1..6).zip(self.coefficients).rev() {
            ratio = ratio * pressed + V::splat(coefficient);
            slope = slope * pressed + V::splat(f64::from(power) * coefficient);
        }
        (ratio, slope)
    }

    /// The compression at which dp_H/dη first becomes negative, if it does below [`FARTHEST`].
    fn turns_over(&self) -> Option<f64> {
        const STEPS: u32 = 9000;
        let at = |i: u32| FARTHEST * f64::from(i) / f64::from(STEPS);
        let falls = |eta: f64| self.hugoniot(eta).1 < 0.0;
        let first = (1..=STEPS).find(|&i| falls(at(i)))?;
        let (mut rising, mut falling) = (at(first - 1), at(first));
        for _ in 0..50 {
            let middle = 0.5 * (rising + falling);
            if falls(middle) { falling = middle } else { rising = middle }
        }
        Some(falling)
    }

    /// Beyond the maximum of p_H what is compressed gives way.
    fn warn_where_it_turns_over(&self, given: &Given) {
        const KEYWORDS: [&str; 5] = ["K1", "K2", "K3", "K4", "K5"];
        let Some(eta) = self.turns_over() else { return };
        let pressure = self.hugoniot(eta).0 * eta;
        let negative = KEYWORDS.into_iter().zip(self.coefficients).find(|(_, coefficient)| *coefficient < 0.0);
        let (keyword, value) = negative.unwrap_or((KEYWORDS[0], self.coefficients[0]));
        let reason = format!(
            "is {value:e}, with which the Hugoniot turns over at a compression 1 - V/V0 of {eta:.4}: its pressure is \
             {pressure:.4e} there, and falls beyond"
        );
        given.warn(
            keyword,
            reason,
            "from there on the material gives way to what compresses it; fit K1 to K5 over all compressions that the run reaches",
        );
    }
}

/// Compression up to which a Hugoniot is looked at: far beyond what any shock reaches.
const FARTHEST: f64 = 0.9;

/// Terms from the Hugoniot pressure and its slope by η.
#[inline(always)]
fn terms<V: Lanes>(compression: V, hugoniot: V, slope: V, gamma: f64) -> Terms<V> {
    let half = V::splat(0.5 * gamma);
    // In tension there is no shock to take the energy from.
    let share = V::splat(1.0) - half * compression.max(V::splat(0.0));
    let lost = V::select_less(V::splat(0.0), compression, half * hugoniot, V::splat(0.0));
    Terms { a: hugoniot * share, b: V::splat(gamma), a_slope: lost - slope * share, b_slope: V::splat(0.0) }
}
