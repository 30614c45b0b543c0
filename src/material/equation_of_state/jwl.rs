//! JWL: detonation products by Jones, Wilkins and Lee, with programmed burn.

use super::super::property::STRESS;
use super::super::{Entry, Given, Origin, Property, Range};
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
                "Speed at which the burn front leaves the detonation points: that of Chapman and Jouguet; one a tenth off is warned of.",
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
    build: |given| {
        let jwl = Jwl::read(given)?;
        jwl.warn_of_velocity(given);
        stiff(EquationOfState::Jwl(jwl), "A")
    },
};

/// A detonation velocity that is off by a larger part of that of Chapman and Jouguet is warned of. Published constants keep within
/// some per cent, and an explosive that is packed more loosely is off by a few more.
const VELOCITY_OFF: f64 = 0.1;

/// Relative volumes at which the velocity of Chapman and Jouguet is looked for. It is a minimum, so that they need not be dense.
const VOLUMES: u32 = 10_000;

impl Jwl {
    /// Velocity of Chapman and Jouguet of an explosive of this density: the least with which a front may run into its products.
    /// Momentum says D² = p/ρ₀(1 − v), energy E = E₀ + ½ p (1 − v), and so p = (a + b E₀)/(1 − ½ b (1 − v)). `None` where constants
    /// have no such point.
    pub fn chapman_jouguet(&self, density: f64) -> Option<f64> {
        let square = |volume: f64| {
            let Terms { a, b, .. } = self.terms(volume);
            let shrunk = 1.0 - volume;
            // Nothing is compressed beyond the volume at which this vanishes.
            let resists = 1.0 - 0.5 * b * shrunk;
            (resists > 0.0).then(|| (a + b * self.initial_energy) / (resists * density * shrunk))
        };
        let volumes = (1..VOLUMES).map(|i| 1.0 - f64::from(i) / f64::from(VOLUMES));
        let least = volumes.map_while(square).fold(f64::INFINITY, f64::min);
        (least > 0.0 && least.is_finite()).then(|| least.sqrt())
    }

    fn warn_of_velocity(&self, given: &Given) {
        let Some(theirs) = self.chapman_jouguet(given.density) else { return };
        let ratio = self.velocity / theirs;
        if (ratio - 1.0).abs() <= VELOCITY_OFF {
            return;
        }
        given.warn(
            "DETONATION VELOCITY",
            format!(
                "{:.4e} is {ratio:.2} times the velocity of Chapman and Jouguet, {theirs:.4e}, that A, B, R1, R2, OMEGA, \
                 INITIAL ENERGY and the density {:.4e} give",
                self.velocity, given.density
            ),
            "the front moves as fast as the deck says, and has another pressure behind it than the explosive; look at units and density",
        );
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
