//! PIECEWISE PLASTIC: von Mises plasticity with a tabulated hardening curve, and the rate of Cowper and Symonds: sheet metal.
//!
//! Y = f(ε̄ᵖ) (1 + (ε̄̇ᵖ/C)^(1/p)) with f linear between the points of a FUNCTION and constant after the last (Cowper and
//! Symonds, Brown University 1957).

use super::elastic::{Hooke, POISSONS_RATIO, YOUNGS_MODULUS};
use super::plastic::{Flow, compose, radial_return, raised_by_rate};
use super::property::Curve;
use super::soil::interpolate;
use super::{
    Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Property, Range, Refusal, Response, StateVariable, Step,
};
use crate::lanes::{Lanes, Matrix3, Sym3};

parameters! {
    /// A tabulated curve and its rate.
    #[derive(Debug, Clone, PartialEq)]
    pub struct PiecewisePlastic {
        /// Young's modulus E, force/length².
        pub young: f64 = [YOUNGS_MODULUS],
        /// Poisson's ratio ν.
        pub poisson: f64 = [POISSONS_RATIO],
        /// Yield stress, force/length², over equivalent plastic strain.
        pub curve: Curve = [
            Property::required(
                HARDENING_FUNCTION, "f", "-", Range::Function,
                "Function that gives the yield stress over the equivalent plastic strain; constant after its last point.",
            ),
        ],
        /// C, 1/time; 0 without rate dependence.
        pub rate: f64 = [
            Property::required(
                "RATE COEFFICIENT", "C", "1/time", Range::NotNegative,
                "Cowper and Symonds' C: the rate at which the yield stress has doubled; 0 for a material without rate.",
            )
            .or(0.0),
        ],
        /// p
        pub exponent: f64 = [
            Property::required("RATE EXPONENT", "p", "-", Range::Positive, "Cowper and Symonds' p.").or(5.0),
        ],
    }
}

const HARDENING_FUNCTION: &str = "HARDENING FUNCTION";

pub(in crate::material) static ENTRY: Entry = Entry {
    name: "PIECEWISE PLASTIC",
    aliases: &["PIECEWISE LINEAR PLASTIC"],
    summary: "Von Mises plasticity with a tabulated hardening curve and Cowper and Symonds' rate dependence: sheet metal.",
    properties: PiecewisePlastic::PROPERTIES,
    state: &[
        StateVariable { name: "EQPS", meaning: "Equivalent plastic strain." },
        StateVariable { name: "EQPSDOT", meaning: "Equivalent plastic strain rate." },
    ],
    origin: Origin::Ours,
    build: |given| Ok(Law::PiecewisePlastic(checked(PiecewisePlastic::read(given)?)?)),
};

/// A law whose curve begins above zero and does not fall.
fn checked(law: PiecewisePlastic) -> Result<PiecewisePlastic, Refusal> {
    let (id, points) = (law.curve.id, &law.curve.points);
    let refusal = |reason: String| Refusal { keyword: HARDENING_FUNCTION, reason };
    let start = interpolate(points, 0.0);
    if start <= 0.0 {
        return Err(refusal(format!(
            "is {id}, a function that is {start} without plastic strain; it must be positive"
        )));
    }
    if let Some(pair) = points.windows(2).find(|pair| pair[1].1 < pair[0].1 && pair[1].0 > 0.0) {
        return Err(refusal(format!("is {id}, a function that falls after {}", pair[0].0)));
    }
    Ok(law)
}

impl PiecewisePlastic {
    pub(in crate::material) fn moduli(&self) -> Moduli {
        Moduli::from_young(self.young, self.poisson)
    }

    pub(in crate::material) fn state(&self, stored: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        stored.to_vec()
    }

    pub(in crate::material) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        visitor.visit(PiecewiseKernel { law: self, elastic: self.moduli().into() })
    }
}

/// Y(Δ) within a step; `over` is 1/(C Δt), 0 without rate.
struct Hardening<'a, V> {
    law: &'a PiecewisePlastic,
    eqps: V,
    over: f64,
}

impl<V: Lanes> Flow<V> for Hardening<'_, V> {
    #[inline(always)]
    fn stress(&self, increment: V) -> (V, V) {
        let strain = self.eqps + increment;
        let base = interpolate(&self.law.curve.points, strain);
        let rise = slope(&self.law.curve.points, strain);
        if self.over == 0.0 {
            return (base, rise);
        }
        raised_by_rate([base, rise], increment, V::splat(self.over), self.law.exponent)
    }
}

/// Slope of a function at x; 0 outside its points.
#[inline(always)]
fn slope<V: Lanes>(points: &[(f64, f64)], x: V) -> V {
    let zero = V::splat(0.0);
    let mut y = zero;
    for pair in points.windows(2) {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        y = V::select_less(V::splat(x0), x, V::splat((y1 - y0) / (x1 - x0)), y);
    }
    match points.last() {
        Some(&(x1, _)) => V::select_less(V::splat(x1), x, zero, y),
        None => zero,
    }
}

#[derive(Clone, Copy)]
struct PiecewiseKernel<'a> {
    law: &'a PiecewisePlastic,
    elastic: Hooke,
}

impl Kernel for PiecewiseKernel<'_> {
    const STATE: &'static [&'static str] = &["EQPS", "EQPSDOT"];
    const HYPOELASTIC: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        // In no time nothing flows by rate.
        let moves = step.time_step > 0.0;
        let frequency = if moves { 1.0 / step.time_step } else { 0.0 };
        let over = if self.law.rate > 0.0 && moves { frequency / self.law.rate } else { 0.0 };
        // (i) elastic predictor
        let trial = self.elastic.trial(&step.strain, stress);
        let deviator = trial.deviator();
        let eqps = V::load(&state[0], part);
        // (ii) return to Y(ε̄ᵖ + Δ, Δ/Δt), implicit
        let flow = Hardening { law: self.law, eqps, over };
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

    const CURVE: &[(f64, f64)] = &[(0.0, 200e6), (0.05, 260e6), (0.2, 320e6), (0.5, 350e6)];

    fn sheet(rate: f64) -> Point {
        let given = [
            ("YOUNGS MODULUS", 200e9),
            ("POISSONS RATIO", 0.3),
            ("HARDENING FUNCTION", 1.0),
            ("RATE COEFFICIENT", rate),
            ("RATE EXPONENT", 5.0),
        ];
        Point::new(made("PIECEWISE PLASTIC", 7850.0, &given, &[(1, CURVE)]))
    }

    /// The stress stays on the curve, over its kinks and after its end.
    #[test]
    fn the_stress_is_that_of_the_table() {
        let mut point = sheet(0.0);
        for _ in 0..200 {
            point.strain([0.0, 0.0, 0.0, 0.005, 0.0, 0.0]);
            let strain = point.eqps();
            let expected = CURVE.windows(2).find(|pair| strain <= pair[1].0).map_or(350e6, |pair| {
                pair[0].1 + (strain - pair[0].0) * (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0)
            });
            close("stress", point.von_mises(), expected, 1e-9);
        }
        assert!(point.eqps() > 1.0);
    }

    /// Steady flow at the rate C doubles the yield stress; at C/32, with p = 5, it adds a half.
    #[test]
    fn the_rate_is_that_of_cowper_and_symonds() {
        for (part, over) in [(1.0, 2.0), (1.0 / 32.0, 1.5)] {
            let mut point = sheet(40.0);
            let rate = 40.0 * part;
            // ε̄̇ᵖ = 2 ε̇_xy/√3
            point.time_step = 1e-3 / rate;
            point.strain_in(800, [0.0, 0.0, 0.0, 0.8 * 3f64.sqrt() / 2.0, 0.0, 0.0]);
            close("rate", point.state("EQPSDOT"), rate, 1e-6);
            close("stress", point.von_mises(), 350e6 * over, 1e-6);
        }
    }
}
