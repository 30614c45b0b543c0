//! EP POWER HARD: von Mises plasticity with power law hardening after a Lüders plateau, and ductile failure by the
//! tearing parameter.
//!
//! Stone, Wellman and Krieg (SAND90-0153) for the hardening; the tearing parameter is that of Wellman. The form of the
//! keywords is recalled.

use super::elastic::{Hooke, POISSONS_RATIO, YOUNGS_MODULUS};
use super::elastic_plastic::YIELD_STRESS;
use super::plastic::{Flow, compose, largest_principal, radial_return, weakened_tension};
use super::property::STRESS;
use super::{
    Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Property, ROOT_TWO_THIRDS, Range, Response, StateVariable, Step,
};
use crate::lanes::{Lanes, Matrix3, Sym3, power};

/// Exponents for which hardening is steepest at its start.
const EXPONENT: Range = Range::Between { low: (0.0, false), high: (1.0, true) };

parameters! {
    /// Y = Y₀ + A ⟨ε̄ᵖ − ε_L⟩ⁿ.
    #[derive(Debug, Clone, PartialEq)]
    pub struct PowerHardening {
        /// Young's modulus E, force/length².
        pub young: f64 = [YOUNGS_MODULUS],
        /// Poisson's ratio ν.
        pub poisson: f64 = [POISSONS_RATIO],
        /// Initial yield stress in uniaxial tension Y₀, force/length².
        pub yield_stress: f64 = [YIELD_STRESS],
        /// Hardening constant A, force/length².
        pub constant: f64 = [
            Property::required("HARDENING CONSTANT", "A", STRESS, Range::NotNegative, "Factor of the power law."),
        ],
        /// Hardening exponent n.
        pub exponent: f64 = [
            Property::required("HARDENING EXPONENT", "n", "-", EXPONENT, "Exponent of the power law."),
        ],
        /// Lüders strain ε_L: plastic strain at the end of the yield plateau.
        pub luders: f64 = [
            Property::required("LUDERS STRAIN", "eL", "-", Range::NotNegative, "Plastic strain at which hardening begins.")
                .or(0.0),
        ],
        /// Tearing parameter at which the material begins to fail; 0 if it never does.
        pub critical_tearing: f64 = [
            Property::required(
                "CRITICAL TEARING PARAMETER", "tp", "-", Range::NotNegative,
                "Tearing parameter at which the material begins to fail; 0 for one that does not.",
            )
            .or(0.0),
        ],
        /// Strain across the crack over which the strength is lost.
        pub opening: f64 = [
            Property::required(
                "CRITICAL CRACK OPENING STRAIN", "ec", "-", Range::Positive,
                "Strain across the crack over which the strength falls to nothing.",
            )
            .or(0.01),
        ],
    }
}

pub(in crate::material) static ENTRY: Entry = Entry {
    name: "EP POWER HARD",
    aliases: &["EP POWER HARDENING"],
    summary: "Von Mises plasticity with power law hardening after a Lueders plateau, and failure by tearing.",
    properties: PowerHardening::PROPERTIES,
    state: &[
        StateVariable { name: "EQPS", meaning: "Equivalent plastic strain." },
        StateVariable { name: "RADIUS", meaning: "Radius of the yield surface in deviatoric stress space." },
        StateVariable { name: "TEARING", meaning: "Tearing parameter." },
        StateVariable { name: "DECAY", meaning: "Part of the strength that is lost, from 0 to 1." },
    ],
    origin: Origin::Recalled,
    build: |given| Ok(Law::PowerHardening(PowerHardening::read(given)?)),
};

/// Bound on σ₁ over ⅔(σ₁ − σ_m), which has none where there is tension without shear strength.
const LARGEST_RATIO: f64 = 1e6;

impl PowerHardening {
    pub(in crate::material) fn moduli(&self) -> Moduli {
        Moduli::from_young(self.young, self.poisson)
    }

    pub(in crate::material) fn state(&self, stored: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        let strength = Hardening { law: self, eqps: stored[0], left: 1.0 - stored[2] };
        vec![stored[0], ROOT_TWO_THIRDS * strength.stress(0.0).0, stored[1], stored[2]]
    }

    pub(in crate::material) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        visitor.visit(PowerKernel { law: self, elastic: self.moduli().into() })
    }
}

/// Y(Δ) within a step that begins with the plastic strain `eqps` and the part `left` of its strength.
struct Hardening<'a, V> {
    law: &'a PowerHardening,
    eqps: V,
    left: V,
}

impl<V: Lanes> Flow<V> for Hardening<'_, V> {
    #[inline(always)]
    fn stress(&self, increment: V) -> (V, V) {
        let law = self.law;
        let strain = (self.eqps + increment - V::splat(law.luders)).max(V::splat(0.0));
        let base = strain.max(V::splat(V::TINY));
        let hardening = V::splat(law.constant) * power(base, law.exponent);
        // Zero to a small power is not small in a double.
        let hardening = V::select_less(V::splat(0.0), strain, hardening, V::splat(0.0));
        let slope = V::splat(law.exponent) * hardening / base;
        ((V::splat(law.yield_stress) + hardening) * self.left, slope * self.left)
    }
}

#[derive(Clone, Copy)]
struct PowerKernel<'a> {
    law: &'a PowerHardening,
    elastic: Hooke,
}

impl PowerKernel<'_> {
    /// Part of the strength that is lost, after a step in which a crack that has begun opened by the largest principal
    /// strain increment.
    #[inline(always)]
    fn decay<V: Lanes>(&self, before: V, tearing: V, strain: &Sym3<V>) -> V {
        if self.law.critical_tearing == 0.0 {
            return before;
        }
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let largest = strain.trace() * V::splat(1.0 / 3.0) + largest_principal(&strain.deviator());
        let opened = (before + largest.max(zero) * V::splat(1.0 / self.law.opening)).min(one);
        V::select_less(tearing, V::splat(self.law.critical_tearing), before, opened)
    }
}

impl Kernel for PowerKernel<'_> {
    const STATE: &'static [&'static str] = &["EQPS", "TEARING", "DECAY"];
    const HYPOELASTIC: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        let [eqps, tearing, before] = [V::load(&state[0], part), V::load(&state[1], part), V::load(&state[2], part)];
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        // (i) elastic predictor, with the tension that a growing crack still bears
        let trial = self.elastic.trial(&step.strain, stress);
        let deviator = trial.deviator();
        let decay = self.decay(before, tearing, &step.strain);
        let mean = weakened_tension(trial.trace() * V::splat(1.0 / 3.0), one - before, one - decay);
        // (ii) return to Y(ε̄ᵖ) of the strength that is left
        let flow = Hardening { law: self.law, eqps, left: one - decay };
        let back = radial_return(&deviator, 1.5 * self.elastic.two_mu, &flow);
        *stress = compose(&deviator, back.factor, mean);
        // (iii) tearing parameter Σ ⟨2σ₁/(3(σ₁ − σ_m))⟩⁴ Δε̄ᵖ
        let above = largest_principal(&deviator) * back.factor;
        let ratio = (above + mean).max(zero) / (above * V::splat(1.5)).max(V::splat(V::TINY));
        let ratio = ratio.min(V::splat(LARGEST_RATIO));
        let square = ratio * ratio;
        let torn = V::select_less(zero, back.increment, square * square * back.increment, zero);
        (eqps + back.increment).store(&mut state[0], part);
        (tearing + torn).store(&mut state[1], part);
        decay.store(&mut state[2], part);
        Response::returned(back.factor)
    }
}

#[cfg(test)]
mod tests {
    use crate::material::point::{Point, close, made};

    const STEEL: [(&str, f64); 6] = [
        ("YOUNGS MODULUS", 200e9),
        ("POISSONS RATIO", 0.3),
        ("YIELD STRESS", 300e6),
        ("HARDENING CONSTANT", 700e6),
        ("HARDENING EXPONENT", 0.4),
        ("LUDERS STRAIN", 0.01),
    ];

    fn flow(eqps: f64) -> f64 {
        300e6 + 700e6 * (eqps - 0.01f64).max(0.0).powf(0.4)
    }

    fn steel(more: &[(&str, f64)]) -> Point {
        Point::new(made("EP POWER HARD", 7850.0, &[&STEEL[..], more].concat(), &[]))
    }

    /// Uniaxial tension: σ = Y(ε − σ/E), on the plateau and beyond; the tearing parameter of uniaxial stress is the
    /// plastic strain, since 2σ/(3(σ − σ/3)) = 1.
    #[test]
    fn uniaxial_tension_follows_the_power_law() {
        let mut point = steel(&[]);
        for step in 1..=600 {
            point.stretch_freely(2.5e-4);
            let eqps = point.eqps();
            close("stress", point.stress[0], flow(eqps).min(200e9 * 2.5e-4 * f64::from(step)), 1e-8);
            close("total strain", eqps + point.stress[0] / 200e9, 2.5e-4 * f64::from(step), 1e-7);
        }
        assert!(point.eqps() > 0.14);
        close("tearing", point.state("TEARING"), point.eqps(), 1e-6);
        close("radius", point.state("RADIUS"), (2.0f64 / 3.0).sqrt() * flow(point.eqps()), 1e-12);
    }

    /// Uniaxial strain: on a straight path the return is exact for one increment or many, so both agree, and the
    /// deviator lies on the yield surface.
    #[test]
    fn one_large_increment_equals_many_small_ones() {
        let (mut one, mut many) = (steel(&[]), steel(&[]));
        one.strain([0.05, 0.0, 0.0, 0.0, 0.0, 0.0]);
        many.strain_in(500, [0.05, 0.0, 0.0, 0.0, 0.0, 0.0]);
        for i in 0..2 {
            close("stress", one.stress[i], many.stress[i], 1e-10);
        }
        close("plastic strain", one.eqps(), many.eqps(), 1e-9);
        close("yield", one.von_mises(), flow(one.eqps()), 1e-12);
        // q = 3μ (e − ε̄ᵖ) with e the equivalent deviatoric strain 2/3 ε.
        close("elastic part", one.von_mises(), 3.0 * 200e9 / 2.6 * (2.0 / 3.0 * 0.05 - one.eqps()), 1e-10);
    }

    /// Triaxial tension on a perfectly plastic point: σ_m and σ₁ are known, and so is dTEARING/dε̄ᵖ.
    #[test]
    fn tearing_under_triaxial_tension() {
        let mut point = Point::new(made(
            "EP POWER HARD",
            7850.0,
            &[
                ("YOUNGS MODULUS", 200e9),
                ("POISSONS RATIO", 0.3),
                ("YIELD STRESS", 300e6),
                ("HARDENING CONSTANT", 0.0),
                ("HARDENING EXPONENT", 1.0),
            ],
            &[],
        ));
        point.strain([1e-3, 1e-3, 1e-3, 0.0, 0.0, 0.0]);
        let mean = 200e9 / (3.0 * 0.4) * 3e-3;
        close("mean", point.mean(), mean, 1e-12);
        point.strain_in(100, [0.02, -0.01, -0.01, 0.0, 0.0, 0.0]);
        // Uniaxial deviator: σ₁ − σ_m = ⅔ Y.
        let ratio = (mean + 200e6) / (1.5 * 200e6);
        close("tearing", point.state("TEARING"), ratio.powi(4) * point.eqps(), 1e-9);
        // Compressed, it does not tear.
        let before = point.state("TEARING");
        point.strain([-3e-3, -3e-3, -3e-3, 0.0, 0.0, 0.0]);
        point.strain_in(10, [-0.01, 0.005, 0.005, 0.0, 0.0, 0.0]);
        close("tearing in compression", point.state("TEARING"), before, 1e-12);
    }

    /// After the critical tearing parameter the stress falls linearly over the critical crack opening strain; then
    /// there is neither tension nor shear, but still pressure.
    #[test]
    fn failed_material_bears_pressure_only() {
        let mut point = steel(&[("CRITICAL TEARING PARAMETER", 0.1), ("CRITICAL CRACK OPENING STRAIN", 0.02)]);
        while point.state("TEARING") < 0.1 {
            point.stretch_freely(2.5e-4);
        }
        let peak = point.stress[0];
        for k in 1..=40 {
            point.stretch_freely(2.5e-4);
            close("decay", point.state("DECAY"), f64::from(k) / 80.0, 1e-9);
            let left = 1.0 - f64::from(k) / 80.0;
            close("yield", point.von_mises(), left * flow(point.eqps()), 1e-9);
        }
        assert!(point.stress[0] < 0.55 * peak);
        point.strain_in(200, [0.02, -0.006, -0.006, 0.01, 0.0, 0.0]);
        assert_eq!(point.state("DECAY"), 1.0);
        assert!(point.stress.iter().all(|s| s.abs() < 1e-3), "{:?}", point.stress);
        point.strain([-1e-3, -1e-3, -1e-3, 5e-3, 0.0, 0.0]);
        close("pressure", -point.mean(), 200e9 / 1.2 * 3e-3, 1e-6);
        assert!(point.von_mises() < 1.0);
    }

    #[test]
    fn safe_at_the_limits() {
        for (yield_stress, constant, exponent) in
            [(0.0, 0.0, 1.0), (0.0, 1e9, 0.01), (1e-300, 1e9, 1.0), (3e8, 0.0, 0.5)]
        {
            for size in [0.0, 1e-320, 1e-160, 1e-12, 1e-3, 1.0, 50.0] {
                let mut point = Point::new(made(
                    "EP POWER HARD",
                    7850.0,
                    &[
                        ("YOUNGS MODULUS", 200e9),
                        ("POISSONS RATIO", 0.3),
                        ("YIELD STRESS", yield_stress),
                        ("HARDENING CONSTANT", constant),
                        ("HARDENING EXPONENT", exponent),
                        ("CRITICAL TEARING PARAMETER", 1e-3),
                    ],
                    &[],
                ));
                for _ in 0..4 {
                    point.strain([size, -0.3 * size, 0.1 * size, 0.5 * size, 0.0, -size]);
                    point.assert_finite();
                }
            }
        }
    }
}
