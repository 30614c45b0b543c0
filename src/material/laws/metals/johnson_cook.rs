//! JOHNSON COOK: plasticity that hardens with strain and strain rate, softens with temperature, and fails by damage.
//!
//! Johnson and Cook (1983; 1985 for the damage). The keywords are those of later Sandia codes, as far as known.

use super::elastic::{Hooke, POISSONS_RATIO, YOUNGS_MODULUS};
use super::elastic_plastic::YIELD_STRESS;
use super::fracture;
use super::plastic::{Flow, compose, radial_return, weakened_tension};
use super::property::STRESS;
use super::{
    Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Property, Range, Refusal, Response, StateVariable, Step,
};
use crate::lanes::{Lanes, Matrix3, Sym3, exp, ln, power};

const fn damage(keyword: &'static str, symbol: &'static str, meaning: &'static str) -> Property {
    Property::required(keyword, symbol, "-", Range::Any, meaning).or(0.0)
}

parameters! {
    /// Y = (A + B ε̄ᵖⁿ)(1 + C ln ε̇*)(1 − T*ᵐ), with ε̇* = max(1, ε̄̇ᵖ/ε̇₀) and T* = (T − T_r)/(T_m − T_r) between 0 and 1.
    #[derive(Debug, Clone, PartialEq)]
    pub struct JohnsonCook {
        /// Young's modulus E, force/length².
        pub young: f64 = [YOUNGS_MODULUS],
        /// Poisson's ratio ν.
        pub poisson: f64 = [POISSONS_RATIO],
        /// A, force/length².
        pub yield_stress: f64 = [YIELD_STRESS],
        /// B, force/length².
        pub constant: f64 = [
            Property::required("HARDENING CONSTANT", "B", STRESS, Range::NotNegative, "Factor of strain hardening."),
        ],
        /// n
        pub exponent: f64 = [
            Property::required("HARDENING EXPONENT", "n", "-", Range::Positive, "Exponent of strain hardening."),
        ],
        /// C
        pub rate_constant: f64 = [
            Property::required("RATE CONSTANT", "C", "-", Range::NotNegative, "Factor on the logarithm of the strain rate.")
                .or(0.0),
        ],
        /// ε̇₀, 1/time.
        pub reference_rate: f64 = [
            Property::required("REFERENCE RATE", "rate0", "1/time", Range::Positive, "Plastic strain rate of no effect.")
                .or(1.0),
        ],
        /// m
        pub thermal_exponent: f64 = [
            Property::required("THERMAL EXPONENT", "m", "-", Range::Positive, "Exponent of thermal softening.").or(1.0),
        ],
        /// T_r, at which the material starts.
        pub reference_temperature: f64 = [
            Property::required(
                "REFERENCE TEMPERATURE", "Tr", "temperature", Range::Any,
                "Temperature of no effect, with which the material starts.",
            )
            .or(0.0),
        ],
        /// T_m; no softening unless it is above the reference temperature.
        pub melt_temperature: f64 = [
            Property::required(
                "MELT TEMPERATURE", "Tm", "temperature", Range::Any,
                "Temperature at which no strength is left; no softening if it is the reference temperature.",
            )
            .or(0.0),
        ],
        /// c_p, energy/(mass temperature); no heating where it is 0.
        pub specific_heat: f64 = [
            Property::required(
                "SPECIFIC HEAT", "cp", "energy/(mass temperature)", Range::NotNegative,
                "Heat capacity of a unit of mass; 0 for no heating.",
            )
            .or(0.0),
        ],
        /// χ, the part of plastic work that turns into heat.
        pub heat_fraction: f64 = [
            Property::required(
                "HEAT FRACTION", "chi", "-", Range::Between { low: (0.0, true), high: (1.0, true) },
                "Part of the plastic work that turns into heat.",
            )
            .or(0.9),
        ],
        /// D₁ to D₅; no damage where D₁ and D₂ are 0.
        pub damage: [f64; 5] = [
            damage("D1", "D1", "Strain at fracture: constant part."),
            damage("D2", "D2", "Strain at fracture: factor of the exponential of triaxiality."),
            damage("D3", "D3", "Strain at fracture: factor on mean stress over von Mises stress in the exponent."),
            damage("D4", "D4", "Strain at fracture: factor on the logarithm of the strain rate."),
            damage("D5", "D5", "Strain at fracture: factor on the homologous temperature."),
        ],
    }
    with(given) {
        /// Mass density ρ₀ at the start, which heat is stored in.
        pub density: f64 = given.density,
    }
}

pub(in crate::material) static ENTRY: Entry = Entry {
    name: "JOHNSON COOK",
    aliases: &["JOHNSON-COOK"],
    summary: "Plasticity with strain hardening, strain rate, adiabatic heating and damage by Johnson and Cook.",
    properties: JohnsonCook::PROPERTIES,
    state: &[
        StateVariable { name: "EQPS", meaning: "Equivalent plastic strain." },
        StateVariable { name: "TEMP", meaning: "Temperature." },
        StateVariable { name: "DAMAGE", meaning: "Damage, up to 1; there is then neither shear strength nor tension." },
        StateVariable { name: "EQPSDOT", meaning: "Rate of the equivalent plastic strain in the last step." },
    ],
    origin: Origin::Recalled,
    build: |given| {
        let law = JohnsonCook::read(given)?;
        let (melt, reference) = (law.melt_temperature, law.reference_temperature);
        if melt < reference {
            let reason = format!("is {melt}, below the reference temperature {reference}");
            return Err(Refusal { keyword: "MELT TEMPERATURE", reason });
        }
        fracture::check(&law, given)?;
        Ok(Law::JohnsonCook(law))
    },
};

impl JohnsonCook {
    /// Whether plastic work raises a temperature that matters.
    pub(super) fn heats(&self) -> bool {
        self.melt_temperature > self.reference_temperature && self.heat_fraction > 0.0 && self.specific_heat > 0.0
    }

    pub(in crate::material) fn moduli(&self) -> Moduli {
        Moduli::from_young(self.young, self.poisson)
    }

    pub(in crate::material) fn state(&self, stored: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        vec![stored[0], self.reference_temperature + stored[1], stored[2], stored[3]]
    }

    pub(in crate::material) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        let reciprocal = |x: f64| if x > 0.0 { 1.0 / x } else { 0.0 };
        visitor.visit(JohnsonCookKernel {
            law: self,
            elastic: self.moduli().into(),
            homologous: reciprocal(self.melt_temperature - self.reference_temperature),
            heating: self.heat_fraction * reciprocal(self.density * self.specific_heat),
            compliance: reciprocal(self.moduli().bulk()),
            damaged: self.damage[0] != 0.0 || self.damage[1] != 0.0,
        })
    }
}

#[derive(Clone, Copy)]
struct JohnsonCookKernel<'a> {
    law: &'a JohnsonCook,
    elastic: Hooke,
    /// 1/(T_m − T_r), or 0 for no softening.
    homologous: f64,
    /// χ/(ρ₀ c_p), or 0 for no heating.
    heating: f64,
    /// One over the bulk modulus, area/force.
    compliance: f64,
    /// Whether damage is computed at all.
    damaged: bool,
}

/// Y(Δ) within a step; the temperature is that of its start.
struct Strength<'a, V> {
    law: &'a JohnsonCook,
    eqps: V,
    /// 1/(ε̇₀ Δt): strain increments times this are strain rates over the reference.
    rate: V,
    /// 1 − T*ᵐ, or 0 after failure.
    left: V,
}

impl<V: Lanes> Flow<V> for Strength<'_, V> {
    #[inline(always)]
    fn stress(&self, increment: V) -> (V, V) {
        let (law, one) = (self.law, V::splat(1.0));
        let strain = (self.eqps + increment).max(V::splat(SMALLEST_STRAIN));
        let hardening = V::splat(law.constant) * power(strain, law.exponent);
        let cold = V::splat(law.yield_stress) + hardening;
        let slope = V::splat(law.exponent) * hardening / strain;
        if law.rate_constant == 0.0 {
            return (cold * self.left, slope * self.left);
        }
        let c = V::splat(law.rate_constant);
        let rate = increment * self.rate;
        let factor = one + c * ln(rate.max(one));
        let by_rate = V::select_less(one, rate, cold * c / increment.max(V::splat(SMALLEST_STRAIN)), V::splat(0.0));
        (cold * factor * self.left, (slope * factor + by_rate) * self.left)
    }
}

/// Below this plastic strain there is none.
const SMALLEST_STRAIN: f64 = 1e-30;

/// Strains at fracture are not below this, so that damage stays a number; see `fracture` for what makes them so small.
const SMALLEST_FRACTURE_STRAIN: f64 = 1e-6;

/// Damage goes no farther than this: 1, and so little more that DEATH, block, DAMAGE, MAX, 1. takes the element.
const FAILED: f64 = 1.000_001;

impl JohnsonCookKernel<'_> {
    /// 1/ε_f, ε_f = (D₁ + D₂ exp(D₃ σ_m/σ̄))(1 + D₄ ln ε̇*)(1 + D₅ T*).
    #[inline(always)]
    fn inverse_fracture_strain<V: Lanes>(&self, mean: V, von_mises: V, rate: V, hot: V) -> V {
        let d = &self.law.damage;
        let [d1, d2, d3] = [V::splat(d[0]), V::splat(d[1]), V::splat(d[2])];
        let [d4, d5] = [V::splat(d[3]), V::splat(d[4])];
        let one = V::splat(1.0);
        let triaxiality = mean / von_mises.max(V::splat(V::TINY));
        let by_rate = one + d4 * ln(rate.max(one));
        let strain = (d1 + d2 * exp(d3 * triaxiality)) * by_rate * (one + d5 * hot);
        one / strain.max(V::splat(SMALLEST_FRACTURE_STRAIN))
    }
}

impl Kernel for JohnsonCookKernel<'_> {
    const STATE: &'static [&'static str] = &["EQPS", "HEAT", "DAMAGE", "EQPSDOT"];
    const HYPOELASTIC: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        let (law, zero, one) = (self.law, V::splat(0.0), V::splat(1.0));
        let [eqps, heat, damage] = [V::load(&state[0], part), V::load(&state[1], part), V::load(&state[2], part)];
        let frequency = if step.time_step > 0.0 { 1.0 / step.time_step } else { 0.0 };
        // (i) elastic predictor
        let trial = self.elastic.trial(&step.strain, stress);
        let deviator = trial.deviator();
        // (ii) strength at the temperature and damage of the start
        let hot = (heat * V::splat(self.homologous)).max(zero).min(one);
        let cold = if self.homologous > 0.0 { one - power(hot, law.thermal_exponent) } else { one };
        let sound = V::select_less(damage, one, one, zero);
        let rate = V::splat(frequency / law.reference_rate);
        let flow = Strength { law, eqps, rate, left: cold * sound };
        // (iii) return
        let back = radial_return(&deviator, 1.5 * self.elastic.two_mu, &flow);
        let mean = weakened_tension(trial.trace() * V::splat(1.0 / 3.0), one, sound);
        *stress = compose(&deviator, back.factor, mean);
        // (iv) heat and damage
        let von_mises = (V::splat(1.5) * deviator.contract(deviator)).sqrt() * back.factor;
        (eqps + back.increment).store(&mut state[0], part);
        if self.heating > 0.0 {
            // Plastic work is of the present volume, ρ₀ of that at the start. As plastic flow keeps the volume, σ_m = K ln V/V₀.
            let volume = exp(mean * V::splat(self.compliance));
            (heat + V::splat(self.heating) * volume * von_mises * back.increment).store(&mut state[1], part);
        }
        if self.damaged && V::any_less(zero, back.increment) {
            let inverse = self.inverse_fracture_strain(mean, von_mises, back.increment * rate, hot);
            (damage + back.increment * inverse).min(V::splat(FAILED)).store(&mut state[2], part);
        }
        (back.increment * V::splat(frequency)).store(&mut state[3], part);
        Response::returned(back.factor)
    }
}

#[cfg(test)]
mod tests {
    use crate::material::point::{Point, close, made};

    const COPPER: [(&str, f64); 5] = [
        ("YOUNGS MODULUS", 124e9),
        ("POISSONS RATIO", 0.34),
        ("YIELD STRESS", 90e6),
        ("HARDENING CONSTANT", 292e6),
        ("HARDENING EXPONENT", 0.31),
    ];
    const RATE: [(&str, f64); 2] = [("RATE CONSTANT", 0.025), ("REFERENCE RATE", 1.0)];
    const HEAT: [(&str, f64); 4] = [
        ("THERMAL EXPONENT", 1.09),
        ("REFERENCE TEMPERATURE", 298.0),
        ("MELT TEMPERATURE", 1356.0),
        ("SPECIFIC HEAT", 383.0),
    ];
    const MU: f64 = 124e9 / (2.0 * 1.34);
    const DENSITY: f64 = 8960.0;

    fn copper(more: &[&[(&str, f64)]]) -> Point {
        let given: Vec<(&str, f64)> = COPPER.iter().chain(more.iter().copied().flatten()).copied().collect();
        Point::new(made("JOHNSON COOK", DENSITY, &given, &[]))
    }

    fn hardening(eqps: f64) -> f64 {
        90e6 + 292e6 * eqps.powf(0.31)
    }

    #[test]
    fn slow_isothermal_tension_is_the_power_law() {
        let mut point = copper(&[&RATE]);
        point.time_step = 1e6;
        for step in 1..=200 {
            point.stretch_freely(1e-3);
            close("stress", point.stress[0], hardening(point.eqps()), 1e-8);
            close("strain", point.eqps() + point.stress[0] / 124e9, 1e-3 * f64::from(step), 1e-7);
        }
        assert_eq!(point.state("TEMP"), 0.0);
    }

    /// Shear at a constant rate: once the stress hardly grows, ε̄̇ᵖ is γ̇/√3, and Y is higher by 1 + C ln of it.
    #[test]
    fn strain_rate_raises_the_strength() {
        for rate in [1e2, 1e4, 1e6] {
            let mut point = copper(&[&RATE]);
            point.time_step = 1e-3 / rate;
            point.strain_in(1000, [0.0, 0.0, 0.0, 0.5, 0.0, 0.0]);
            let plastic = point.state("EQPSDOT");
            close("rate", plastic, rate / 3f64.sqrt(), 0.01);
            close("stress", point.von_mises(), hardening(point.eqps()) * (1.0 + 0.025 * plastic.ln()), 1e-9);
        }
    }

    /// Adiabatic shear against the midpoint rule in a hundred thousand steps for ε̄̇ᵖ = 3μ ė/(3μ + ∂Y/∂ε̄ᵖ + ∂Y/∂T χ Y/ρc).
    #[test]
    fn adiabatic_heating_softens() {
        let mut point = copper(&[&HEAT]);
        let softening = |t: f64| 1.0 - ((t - 298.0) / 1058.0f64).max(0.0).powf(1.09);
        let strength = |e: f64, t: f64| hardening(e) * softening(t);
        let to_heat = 0.9 / (DENSITY * 383.0);
        let slope = |e: f64, t: f64| {
            let h = 1e-7;
            let by_strain = (strength(e + h, t) - strength(e, t)) / h;
            let by_heat = (strength(e, t + h) - strength(e, t)) / h;
            3.0 * MU / (3.0 * MU + by_strain + by_heat * to_heat * strength(e, t))
        };
        // From the onset of flow, where q = 90 MPa and the plastic strain is nothing.
        let (mut e, mut t) = (1e-9, 298.0);
        let total = 1.2 / 3f64.sqrt() - 90e6 / (3.0 * MU);
        let steps = 100_000;
        for _ in 0..steps {
            let d = total / f64::from(steps);
            let rate = |e: f64, t: f64| {
                let de = slope(e, t) * d;
                (de, to_heat * strength(e, t) * de)
            };
            let start = rate(e, t);
            let middle = rate(e + 0.5 * start.0, t + 0.5 * start.1);
            (e, t) = (e + middle.0, t + middle.1);
        }
        point.strain_in(20_000, [0.0, 0.0, 0.0, 0.6, 0.0, 0.0]);
        close("plastic strain", point.eqps(), e, 2e-4);
        close("temperature rise", point.state("TEMP") - 298.0, t - 298.0, 5e-4);
        close("stress", point.von_mises(), strength(e, t), 5e-4);
        assert!(point.state("TEMP") > 330.0);
    }

    /// Compressed to exp(−0.2) of its volume without motion across, a unit of mass gets the plastic work on it, not that on a unit of
    /// the present volume, which is a fifth more at the end.
    #[test]
    fn heat_is_stored_by_mass() {
        let mut point = copper(&[&HEAT]);
        let (mut rise, mut before) = (0.0, 0.0);
        for step in 1..=2000 {
            point.strain_in(1, [-1e-4, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let volume = libm::exp(-1e-4 * f64::from(step));
            rise += 0.9 * point.von_mises() * (point.eqps() - before) * volume / (DENSITY * 383.0);
            before = point.eqps();
        }
        close("temperature rise", point.state("TEMP") - 298.0, rise, 1e-9);
        assert!(rise > 5.0, "{rise}");
    }

    /// Uniaxial tension has σ_m/σ̄ = ⅓: damage is ε̄ᵖ over a constant strain at fracture, and from 1 on nothing holds.
    #[test]
    fn damage_of_uniaxial_tension() {
        let fracture = 0.05 + 0.4 * libm::exp(-1.5 / 3.0);
        let mut point = copper(&[&[("D1", 0.05), ("D2", 0.4), ("D3", -1.5)]]);
        while point.state("DAMAGE") < 0.99 {
            point.stretch_freely(1e-3);
            if point.eqps() > 1e-3 {
                close("damage", point.state("DAMAGE"), point.eqps() / fracture, 1e-6);
            }
        }
        while point.state("DAMAGE") < 1.0 {
            point.stretch_freely(1e-3);
        }
        close("strain at fracture", point.eqps(), fracture, 0.01);
        point.strain([1e-3, -2e-4, -2e-4, 1e-3, 0.0, 0.0]);
        assert!(point.stress.iter().all(|s| s.abs() < 1.0), "{:?}", point.stress);
        assert_eq!(point.returned, 0.0);
        point.strain([-2e-3, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert!(point.mean() < 0.0 && point.von_mises() < 1.0);
        // What has failed flows on, and its damage is 1; DEATH with MAX, 1. must still see it above.
        point.strain_in(100, [1.0, -0.5, -0.5, 0.0, 0.0, 0.0]);
        assert!(point.eqps() > 1.0 && point.state("DAMAGE") > 1.0);
        close("damage after failure", point.state("DAMAGE"), 1.0, 1.1e-6);
    }

    /// Extreme 22: heated to the melting point the strength is nothing, and stays a number.
    #[test]
    fn molten_metal_is_a_fluid() {
        let mut point = copper(&[&RATE, &HEAT, &[("SPECIFIC HEAT", 383.0)]]);
        point.time_step = 1e-7;
        for _ in 0..40 {
            point.strain_in(10, [0.0, 0.0, 0.0, 0.5, 0.0, 0.0]);
            point.assert_finite();
        }
        let mut molten = copper(&[&RATE, &HEAT[..3], &[("SPECIFIC HEAT", 1.0)]]);
        molten.time_step = 1e-7;
        molten.strain_in(200, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
        assert!(molten.state("TEMP") > 1355.99 && molten.von_mises() < 1.0, "{}", molten.state("TEMP"));
        molten.strain([-1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0]);
        molten.assert_finite();
        assert!(molten.mean() < -1e7 && molten.von_mises() < 1.0);
    }

    #[test]
    fn safe_at_the_limits() {
        for yield_stress in [0.0, 90e6] {
            for size in [0.0, 1e-320, 1e-160, 1e-12, 1e-3, 1.0, 50.0] {
                let strength = [("YIELD STRESS", yield_stress), ("D1", 0.0), ("D2", 1.0), ("D3", -800.0)];
                let given: Vec<(&str, f64)> =
                    strength.iter().chain(&COPPER).chain(&RATE).chain(&HEAT).copied().collect();
                let mut point = Point::new(made("JOHNSON COOK", DENSITY, &given, &[]));
                point.time_step = 1e-9;
                for _ in 0..4 {
                    point.strain([size, -0.3 * size, 0.1 * size, 0.5 * size, 0.0, -size]);
                    point.assert_finite();
                }
            }
        }
    }
}
