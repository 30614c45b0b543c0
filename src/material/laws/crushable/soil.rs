//! SOIL N FOAMS: crushable volume, strength that depends on pressure.
//!
//! The model of Krieg (SC-DR-72-0883). Keywords and the form of the yield surface, von Mises stress against a quadratic
//! of the pressure, are recalled.

use super::plastic::compose;
use super::property::STRESS;
use super::strength;
use super::{
    Curve, Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Property, Range, Refusal, Response, StateVariable, Step,
};
use crate::lanes::{Lanes, Matrix3, Sym3, ln_one_plus};

parameters! {
    /// Pressure from a function of the largest compression so far, unloading with a constant bulk modulus; deviator returned
    /// at that pressure to σ̄ = A₀ + A₁p + A₂p².
    #[derive(Debug, Clone, PartialEq)]
    pub struct Soil {
        /// Twice the shear modulus 2μ, force/length².
        pub two_mu: f64 = [
            Property::required("TWO MU", "2mu", STRESS, Range::Positive, "Twice the shear modulus."),
        ],
        /// Bulk modulus of unloading K, force/length².
        pub bulk: f64 = [
            Property::required("BULK MODULUS", "K", STRESS, Range::Positive, "Bulk modulus of unloading and reloading."),
        ],
        /// A₀, force/length².
        pub a0: f64 = [
            Property::required("A0", "A0", STRESS, Range::Any, "Von Mises stress at yield without pressure."),
        ],
        /// A₁
        pub a1: f64 = [
            Property::required("A1", "A1", "-", Range::Any, "Von Mises stress at yield: factor of the pressure.").or(0.0),
        ],
        /// A₂, length²/force.
        pub a2: f64 = [
            Property::required(
                "A2", "A2", "length^2/force", Range::Any,
                "Von Mises stress at yield: factor of the square of the pressure.",
            )
            .or(0.0),
        ],
        /// Largest tension, as a positive number, force/length².
        pub tension: f64 = [
            Property::required(
                "PRESSURE CUTOFF", "pc", STRESS, Range::Any,
                "Largest tension that the material bears, with either sign.",
            ),
        ],
        /// Pressure over compression −ln(V/V₀) when it grows for the first time.
        pub curve: Curve = [
            Property::required(
                "FUNCTION ID", "f", "-", Range::Function,
                "Function that gives the pressure over the compression -ln(V/V0) of virgin material.",
            ),
        ],
    }
}

pub(in crate::material) static ENTRY: Entry = Entry {
    name: "SOIL N FOAMS",
    aliases: &["SOILS N FOAMS", "SOILS AND FOAMS", "SOIL AND FOAMS", "SOIL AND CRUSHABLE FOAM"],
    summary: "Soil or crushable foam: pressure from a function of compression, strength that depends on pressure.",
    properties: Soil::PROPERTIES,
    state: &[
        StateVariable { name: "EVMAX", meaning: "Largest compression -ln(V/V0) so far." },
        StateVariable { name: "EVFRAC", meaning: "Compression below which the largest tension acts." },
        StateVariable { name: "EV", meaning: "Compression -ln(V/V0)." },
        StateVariable { name: "NUM", meaning: "Number of the function's segment that the largest compression is in." },
    ],
    origin: Origin::Recalled,
    build: |given| {
        let law = checked(Soil::read(given)?)?;
        strength::check(&law, given)?;
        Ok(Law::Soil(law))
    },
};

/// A soil whose function is one of pressure over compression.
fn checked(law: Soil) -> Result<Soil, Refusal> {
    let curve = &law.curve;
    let refusal = |reason: String| Refusal { keyword: "FUNCTION ID", reason };
    let id = curve.id;
    let start = interpolate(&curve.points, 0.0);
    if start != 0.0 {
        return Err(refusal(format!("is {id}, a function that is {start} and not 0 without compression")));
    }
    for pair in curve.points.windows(2) {
        let slope = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
        if slope < 0.0 {
            return Err(refusal(format!("is {id}, a function that falls after {}", pair[0].0)));
        }
        if slope > law.bulk * (1.0 + 1e-9) {
            return Err(refusal(format!(
                "is {id}, a function that rises by {slope:e} after {}, steeper than the BULK MODULUS",
                pair[0].0
            )));
        }
    }
    Ok(Soil { tension: law.tension.abs(), ..law })
}

/// A function at x: linear between its points, constant outside.
#[inline(always)]
pub(in crate::material) fn interpolate<V: Lanes>(points: &[(f64, f64)], x: V) -> V {
    let mut y = V::splat(points.first().map_or(0.0, |p| p.1));
    for pair in points.windows(2) {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let inside = V::splat(y0) + (x - V::splat(x0)) * V::splat((y1 - y0) / (x1 - x0));
        y = V::select_less(V::splat(x0), x, inside, y);
    }
    match points.last() {
        Some(&(x1, y1)) => V::select_less(V::splat(x1), x, V::splat(y1), y),
        None => y,
    }
}

impl Soil {
    pub(in crate::material) fn moduli(&self) -> Moduli {
        Moduli::from_bulk(self.bulk, self.two_mu)
    }

    /// The compression 1 − V/V₀ at the last point of the function, beyond which the pressure does not grow.
    pub(in crate::material) fn end_of_data(&self) -> Option<f64> {
        self.curve.points.last().map(|(compression, _)| -(-compression).exp_m1())
    }

    pub(in crate::material) fn state(&self, stored: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        let (largest, now) = (stored[0], stored[1]);
        let fracture = largest - (interpolate(&self.curve.points, largest) + self.tension) / self.bulk;
        let segment = self.curve.points.iter().filter(|p| p.0 <= largest).count();
        vec![largest, fracture, now, segment as f64]
    }

    pub(in crate::material) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        visitor.visit(SoilKernel { law: self })
    }
}

#[derive(Clone, Copy)]
struct SoilKernel<'a> {
    law: &'a Soil,
}

impl Kernel for SoilKernel<'_> {
    const STATE: &'static [&'static str] = &["EVMAX", "EV"];
    const VOLUME: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        let (law, zero, one) = (self.law, V::splat(0.0), V::splat(1.0));
        // (i) pressure: on the virgin curve where the compression is the largest so far, else unloaded from it
        let now = -ln_one_plus(step.dilatation());
        let largest = V::load(&state[0], part).max(now);
        let virgin = interpolate(&law.curve.points, largest);
        let unloaded = virgin - V::splat(law.bulk) * (largest - now);
        let pressure = V::splat(-law.tension).max(unloaded);
        largest.store(&mut state[0], part);
        now.store(&mut state[1], part);
        // (ii) elastic predictor of the deviator
        let two_mu = V::splat(law.two_mu);
        let deviator = stress.deviator().zip(step.strain.deviator(), |s, e| s + two_mu * e);
        // (iii) return at this pressure
        let strength = V::splat(law.a0) + pressure * (V::splat(law.a1) + pressure * V::splat(law.a2));
        let von_mises = (V::splat(1.5) * deviator.contract(deviator)).sqrt();
        let allowed = strength.max(zero) / von_mises.max(V::splat(V::TINY));
        let factor = one.min(allowed);
        *stress = compose(&deviator, factor, -pressure);
        Response::returned(factor)
    }
}

#[cfg(test)]
mod tests {
    use crate::material::point::{Point, close, made};

    /// Toe, crush plateau, lock-up; compressions are exact numbers of steps of 0.001.
    const POINTS: &[(f64, f64)] = &[(0.0, 0.0), (0.01, 1e6), (0.4, 3e6), (0.5, 20e6)];

    fn foam(a0: f64, a1: f64, a2: f64) -> Point {
        let given = [
            ("TWO MU", 1e8),
            ("BULK MODULUS", 2e8),
            ("A0", a0),
            ("A1", a1),
            ("A2", a2),
            ("PRESSURE CUTOFF", -0.2e6),
            ("FUNCTION ID", 3.0),
        ];
        Point::new(made("SOIL N FOAMS", 300.0, &given, &[(3, POINTS)]))
    }

    fn squeeze(point: &mut Point, compression: f64) {
        let third = -compression / 3.0;
        point.strain([third, third, third, 0.0, 0.0, 0.0]);
    }

    /// Down the virgin curve, back along the bulk modulus to the largest tension, and down again.
    #[test]
    fn pressure_follows_the_function_and_unloads_elastically() {
        let mut point = foam(1e9, 0.0, 0.0);
        squeeze(&mut point, 0.005);
        close("toe", -point.mean(), 0.5e6, 1e-9);
        squeeze(&mut point, 0.2);
        close("plateau", -point.mean(), 1e6 + 2e6 * 0.195 / 0.39, 1e-9);
        squeeze(&mut point, -0.005);
        close("unloading", -point.mean(), 2e6 - 2e8 * 0.005, 1e-9);
        squeeze(&mut point, 0.005);
        close("reloading", -point.mean(), 2e6, 1e-9);
        squeeze(&mut point, -0.1);
        close("fractured", point.mean(), 0.2e6, 1e-9);
        close("largest", point.state("EVMAX"), 0.205, 1e-9);
        close("at fracture", point.state("EVFRAC"), 0.205 - 2.2e6 / 2e8, 1e-9);
        close("now", point.state("EV"), 0.105, 1e-9);
        assert_eq!(point.state("NUM"), 2.0);
        squeeze(&mut point, 0.1);
        close("rejoined", -point.mean(), 2e6, 1e-8);
        squeeze(&mut point, 0.245);
        close("locked", -point.mean(), 3e6 + 17e6 * 0.5, 1e-8);
    }

    /// Shear at constant volume: von Mises stress of the quadratic at the pressure, whatever the path.
    #[test]
    fn strength_is_a_quadratic_of_the_pressure() {
        let (a0, a1, a2) = (0.3e6, 0.6, 1e-8);
        for compression in [0.0, 0.005, 0.3] {
            let mut point = foam(a0, a1, a2);
            squeeze(&mut point, compression);
            let p = -point.mean();
            point.strain_in(50, [0.0, 0.0, 0.0, 0.05, 0.02, -0.03]);
            close("strength", point.von_mises(), a0 + a1 * p + a2 * p * p, 1e-9);
            assert!((p + point.mean()).abs() < 1e-6 * 1e6);
        }
        // In tension the quadratic may be negative: then there is no strength.
        let mut dry = foam(0.0, 1.0, 0.0);
        squeeze(&mut dry, -0.01);
        dry.strain([0.0, 0.0, 0.0, 0.1, 0.0, 0.0]);
        assert_eq!(dry.von_mises(), 0.0);
        close("tension", dry.mean(), 0.2e6, 1e-9);
    }

    #[test]
    fn safe_at_the_limits() {
        for size in [0.0, 1e-320, 1e-160, 1e-12, 1e-3, 1.0, 20.0] {
            for sign in [-1.0, 1.0] {
                let mut point = foam(0.0, 0.5, 0.0);
                for _ in 0..3 {
                    point.strain([sign * size, -0.3 * size, 0.1 * size, 0.5 * size, 0.0, -size]);
                    point.assert_finite();
                }
            }
        }
    }
}
