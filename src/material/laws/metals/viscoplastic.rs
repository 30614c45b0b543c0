//! VISCOPLASTIC: von Mises plasticity that flows at a finite rate, by a power of the overstress (Perzyna 1966).
//!
//! The keywords are recalled.

use super::elastic::{Hooke, POISSONS_RATIO, YOUNGS_MODULUS};
use super::elastic_plastic::{HARDENING_MODULUS, YIELD_STRESS};
use super::plastic::{Flow, compose, radial_return, raised_by_rate};
use super::{Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Property, Range, Response, StateVariable, Step};
use crate::lanes::{Lanes, Matrix3, Sym3};

parameters! {
    /// ε̄̇ᵖ = γ ⟨σ̄/Y − 1⟩ᵖ with Y = Y₀ + H ε̄ᵖ.
    #[derive(Debug, Clone, PartialEq)]
    pub struct Viscoplastic {
        /// Young's modulus E, force/length².
        pub young: f64 = [YOUNGS_MODULUS],
        /// Poisson's ratio ν.
        pub poisson: f64 = [POISSONS_RATIO],
        /// Yield stress at rest Y₀, force/length².
        pub yield_stress: f64 = [Property { range: Range::Positive, ..YIELD_STRESS }],
        /// Hardening modulus H, force/length².
        pub hardening: f64 = [HARDENING_MODULUS],
        /// Fluidity γ, 1/time.
        pub gamma: f64 = [
            Property::required(
                "GAMMA", "gamma", "1/time", Range::Positive,
                "Plastic strain rate at twice the yield stress.",
            ),
        ],
        /// Exponent p.
        pub exponent: f64 = [
            Property::required(
                "P", "p", "-", Range::Between { low: (1.0, true), high: (100.0, true) },
                "Exponent of the overstress.",
            )
            .or(1.0),
        ],
    }
}

pub(in crate::material) static ENTRY: Entry = Entry {
    name: "VISCOPLASTIC",
    aliases: &[],
    summary: "Von Mises plasticity with linear hardening that flows at a finite rate, by a power of the overstress.",
    properties: Viscoplastic::PROPERTIES,
    state: &[
        StateVariable { name: "EQPS", meaning: "Equivalent plastic strain." },
        StateVariable { name: "EQPSDOT", meaning: "Rate of the equivalent plastic strain in the last step." },
    ],
    origin: Origin::Recalled,
    build: |given| Ok(Law::Viscoplastic(Viscoplastic::read(given)?)),
};

impl Viscoplastic {
    pub(in crate::material) fn moduli(&self) -> Moduli {
        Moduli::from_young(self.young, self.poisson)
    }

    pub(in crate::material) fn state(&self, stored: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        stored.to_vec()
    }

    pub(in crate::material) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        visitor.visit(ViscoplasticKernel { law: self, elastic: self.moduli().into() })
    }
}

/// The stress that drives an increment Δ through a step: (Y₀ + H (ε̄ᵖ + Δ))(1 + (Δ/γΔt)^(1/p)).
struct Overstress<'a, V> {
    law: &'a Viscoplastic,
    eqps: V,
    /// 1/(γ Δt)
    rate: V,
}

impl<V: Lanes> Flow<V> for Overstress<'_, V> {
    #[inline(always)]
    fn stress(&self, increment: V) -> (V, V) {
        let hardening = V::splat(self.law.hardening);
        let rest = V::splat(self.law.yield_stress) + hardening * (self.eqps + increment);
        raised_by_rate([rest, hardening], increment, self.rate, self.law.exponent)
    }
}

#[derive(Clone, Copy)]
struct ViscoplasticKernel<'a> {
    law: &'a Viscoplastic,
    elastic: Hooke,
}

impl Kernel for ViscoplasticKernel<'_> {
    const STATE: &'static [&'static str] = &["EQPS", "EQPSDOT"];
    const HYPOELASTIC: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        // In no time nothing flows.
        let (frequency, rate) = match step.time_step > 0.0 {
            true => (1.0 / step.time_step, V::splat(1.0 / (self.law.gamma * step.time_step))),
            false => (0.0, V::either(f64::MAX.sqrt(), 1e18)),
        };
        // (i) elastic predictor
        let trial = self.elastic.trial(&step.strain, stress);
        let deviator = trial.deviator();
        let eqps = V::load(&state[0], part);
        // (ii) the increment whose overstress is what it leaves: implicit, stable for any step
        let flow = Overstress { law: self.law, eqps, rate };
        let back = radial_return(&deviator, 1.5 * self.elastic.two_mu, &flow);
        *stress = compose(&deviator, back.factor, trial.trace() * V::splat(1.0 / 3.0));
        (eqps + back.increment).store(&mut state[0], part);
        (back.increment * V::splat(frequency)).store(&mut state[1], part);
        Response::returned(back.factor)
    }
}

#[cfg(test)]
mod tests {
    use crate::material::point::{Point, close, made};

    fn metal(hardening: f64, exponent: f64) -> Point {
        let given = [
            ("YOUNGS MODULUS", 200e9),
            ("POISSONS RATIO", 0.3),
            ("YIELD STRESS", 400e6),
            ("HARDENING MODULUS", hardening),
            ("GAMMA", 1e3),
            ("P", exponent),
        ];
        Point::new(made("VISCOPLASTIC", 7850.0, &given, &[]))
    }

    const MU: f64 = 200e9 / 2.6;

    /// Steady shear at ε̄̇ᵖ = γ̇/√3: the stress settles at Y (1 + (ε̄̇ᵖ/γ)^(1/p)).
    #[test]
    fn steady_flow() {
        for exponent in [1.0, 3.0] {
            for rate in [1e1, 1e3, 1e4] {
                let mut point = metal(0.0, exponent);
                point.time_step = 1e-3 / rate;
                point.strain_in(400, [0.0, 0.0, 0.0, 0.2, 0.0, 0.0]);
                let plastic = rate / 3f64.sqrt();
                close("rate", point.state("EQPSDOT"), plastic, 1e-6);
                let over = (plastic / 1e3).powf(1.0 / exponent);
                close("stress", point.von_mises(), 400e6 * (1.0 + over), 1e-6);
            }
        }
    }

    /// Relaxation at a constant strain, p = 1: q − Y falls with exp(−3μ γ t/Y).
    #[test]
    fn relaxation() {
        let mut point = metal(0.0, 1.0);
        point.time_step = 0.0;
        point.strain([0.0, 0.0, 0.0, 0.01, 0.0, 0.0]);
        let start = point.von_mises();
        close("loaded in no time", start, 3f64.sqrt() * 2.0 * MU * 0.01, 1e-9);
        let time = 400e6 / (3.0 * MU * 1e3);
        point.time_step = time / 2000.0;
        for _ in 0..4000 {
            point.strain([0.0; 6]);
        }
        close("after two times", point.von_mises() - 400e6, (start - 400e6) * (-2.0f64).exp(), 2e-3);
    }

    /// Slow straining is plasticity without rate: V-10, uniaxial strain.
    #[test]
    fn slow_straining_is_plastic() {
        let mut point = metal(2e9, 1.0);
        point.time_step = 1e6;
        point.strain_in(10, [0.02, 0.0, 0.0, 0.0, 0.0, 0.0]);
        close("axial stress", point.stress[0], 3615.3e6, 1e-4);
        close("plastic strain", point.eqps(), 0.011_500, 1e-4);
        // Fast straining is elastic.
        let mut fast = metal(2e9, 1.0);
        fast.time_step = 1e-15;
        fast.strain([0.02, 0.0, 0.0, 0.0, 0.0, 0.0]);
        close("elastic", fast.stress[0], 269.230_769e9 * 0.02, 1e-4);
    }

    #[test]
    fn safe_at_the_limits() {
        for time_step in [0.0, 1e-300, 1e-9, 1.0, 1e300] {
            for size in [0.0, 1e-320, 1e-160, 1e-12, 1e-3, 1.0, 50.0] {
                let mut point = metal(0.0, 5.0);
                point.time_step = time_step;
                for _ in 0..3 {
                    point.strain([size, -0.3 * size, 0.1 * size, 0.5 * size, 0.0, -size]);
                    point.assert_finite();
                }
            }
        }
    }
}
