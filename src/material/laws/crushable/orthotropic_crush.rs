//! ORTHOTROPIC CRUSH: honeycomb and wood, crushing along their own axes until they are compact.
//!
//! After the published metallic honeycomb model of Whirley, Engelmann and Hallquist, with the keywords of later Sandia codes:
//! six stresses that do not know of each other, each with a modulus and a crush curve, over the smallest volume so far.

use super::elastic::{Hooke, POISSONS_RATIO, YOUNGS_MODULUS};
use super::elastic_plastic::YIELD_STRESS;
use super::property::STRESS;
use super::soil::interpolate;
use super::{
    Curve, Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Property, Range, Refusal, Response, Start, StateVariable,
    Step,
};
use crate::lanes::{Lanes, Matrix3, Sym3, array};

const fn modulus(keyword: &'static str, meaning: &'static str) -> Property {
    Property::required(keyword, keyword, STRESS, Range::Positive, meaning)
}

const fn crush(keyword: &'static str) -> Property {
    Property::required(
        keyword,
        "f",
        "-",
        Range::Function,
        "Function that gives the size of this stress while crushing, over 1 - V/V0 at its largest.",
    )
}

/// Keywords of the crush functions.
const CRUSH: [&str; 6] = ["CRUSH XX", "CRUSH YY", "CRUSH ZZ", "CRUSH XY", "CRUSH YZ", "CRUSH ZX"];

parameters! {
    /// Six decoupled stresses along the space axes of the initial state; isotropic perfect plasticity once V/V₀ has been below
    /// `compact`.
    #[derive(Debug, Clone, PartialEq)]
    pub struct OrthotropicCrush {
        /// Young's modulus of the compact material E, force/length².
        pub young: f64 = [YOUNGS_MODULUS],
        /// Poisson's ratio of the compact material ν.
        pub poisson: f64 = [POISSONS_RATIO],
        /// Yield stress of the compact material, force/length².
        pub yield_stress: f64 = [YIELD_STRESS],
        /// Moduli at the start: EX, EY, EZ, then shear moduli GXY, GYZ, GZX, force/length².
        pub moduli: [f64; 6] = [
            modulus("EX", "Young's modulus in x before crushing."),
            modulus("EY", "Young's modulus in y before crushing."),
            modulus("EZ", "Young's modulus in z before crushing."),
            modulus("GXY", "Shear modulus in xy before crushing."),
            modulus("GYZ", "Shear modulus in yz before crushing."),
            modulus("GZX", "Shear modulus in zx before crushing."),
        ],
        /// Strengths over 1 − V/V₀: XX, YY, ZZ, XY, YZ, ZX.
        pub crush: [Curve; 6] = [
            crush(CRUSH[0]),
            crush(CRUSH[1]),
            crush(CRUSH[2]),
            crush(CRUSH[3]),
            crush(CRUSH[4]),
            crush(CRUSH[5]),
        ],
        /// Relative volume at which it is compact.
        pub compact: f64 = [
            Property::required(
                "VMIN", "vmin", "-", Range::Between { low: (0.0, false), high: (1.0, false) },
                "Relative volume V/V0 at which the material is compact.",
            ),
        ],
    }
}

pub(in crate::material) static ENTRY: Entry = Entry {
    name: "ORTHOTROPIC CRUSH",
    aliases: &["WOOD", "HONEYCOMB"],
    summary: "Honeycomb or wood: crushes along the space axes of its initial state, each by a function, until compact.",
    properties: OrthotropicCrush::PROPERTIES,
    state: &[StateVariable { name: "CRUSH", meaning: "Smallest relative volume so far." }],
    origin: Origin::Recalled,
    build: |given| Ok(Law::OrthotropicCrush(checked(OrthotropicCrush::read(given)?)?)),
};

/// A law none of whose strengths is negative.
fn checked(law: OrthotropicCrush) -> Result<OrthotropicCrush, Refusal> {
    for (curve, keyword) in law.crush.iter().zip(CRUSH) {
        if let Some(point) = curve.points.iter().find(|point| point.1 < 0.0) {
            let reason = format!("is {}, a function that is {} at {}", curve.id, point.1, point.0);
            return Err(Refusal { keyword, reason });
        }
    }
    Ok(law)
}

impl OrthotropicCrush {
    /// The stiffest that the material can be: compact or not, in any direction.
    pub(in crate::material) fn moduli(&self) -> Moduli {
        let compact = Moduli::from_young(self.young, self.poisson);
        let normal = self.moduli[..3].iter().fold(compact.dilatational(), |m, e| m.max(*e));
        let shear = self.moduli[3..].iter().fold(compact.two_mu, |m, g| m.max(2.0 * g));
        // An uncoupled shear modulus G needs no more than λ + 2μ ≥ 2G.
        let dilatational = normal.max(shear);
        Moduli { lambda: dilatational - shear, two_mu: shear }
    }

    pub(in crate::material) fn state(&self, stored: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        vec![stored[0]]
    }

    pub(in crate::material) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        visitor.visit(Honeycomb { law: self, elastic: Moduli::from_young(self.young, self.poisson).into() })
    }
}

#[derive(Clone, Copy)]
struct Honeycomb<'a> {
    law: &'a OrthotropicCrush,
    elastic: Hooke,
}

impl Honeycomb<'_> {
    /// How far it is compacted: 0 at the start, 1 when it is compact.
    #[inline(always)]
    fn share<V: Lanes>(&self, smallest: V) -> V {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        ((one - smallest) * V::splat(1.0 / (1.0 - self.law.compact))).min(one).max(zero)
    }

    /// Stress before compaction, along the material's axes: each component by its own modulus, cut off by its own curve.
    #[inline(always)]
    fn crushing<V: Lanes>(&self, strain: &Sym3<V>, stress: &Sym3<V>, smallest: V) -> Sym3<V> {
        let law = self.law;
        // Moduli go over to those of the compact material.
        let (crushed, share) = (V::splat(1.0) - smallest, self.share(smallest));
        let (strains, stresses) = (strain.to_array(), stress.to_array());
        let compact = [self.law.young, 0.5 * self.elastic.two_mu];
        let c: [V; 6] = array![i in 6 => {
            let (start, end) = (law.moduli[i], compact[i / 3]);
            let modulus = V::splat(start) + share * V::splat(end - start);
            // Shear moduli act on engineering strains, twice the components.
            let factor = if i < 3 { 1.0 } else { 2.0 };
            let trial = stresses[i] + modulus * V::splat(factor) * strains[i];
            let limit = interpolate(&law.crush[i].points, crushed);
            (-limit).max(limit.min(trial))
        }];
        Sym3 { xx: c[0], yy: c[1], zz: c[2], xy: c[3], yz: c[4], zx: c[5] }
    }

    /// Modulus that viscosity goes by: the one with which the stress has answered to the strain, Δσ:Δε/Δε:Δε, which is that of its
    /// direction while it is elastic and the slope of the curve while it crushes; at least the compact one times the eighth power of
    /// how far it is compacted. With a lower power coarse elements resist in all of their crush by what only the metal has, with none
    /// they strike it with all the speed that they close at, and ring.
    #[inline(always)]
    fn answering<V: Lanes>(&self, strain: &Sym3<V>, [old, new]: [&Sym3<V>; 2], smallest: V) -> V {
        let compact = V::splat(self.elastic.lambda + self.elastic.two_mu);
        let square = self.share(smallest) * self.share(smallest);
        let fourth = square * square;
        let change = new.zip(*old, |a, b| a - b);
        let modulus = change.contract(*strain) / strain.contract(*strain).max(V::splat(V::TINY));
        // Where the strain is as good as none the quotient is round-off.
        modulus.max(fourth * fourth * compact).min(compact)
    }

    /// Stress of the compact material: isotropic, perfectly plastic.
    #[inline(always)]
    fn compact<V: Lanes>(&self, strain: &Sym3<V>, stress: &Sym3<V>) -> Sym3<V> {
        let trial = self.elastic.trial(strain, stress);
        let deviator = trial.deviator();
        let von_mises = (V::splat(1.5) * deviator.contract(deviator)).sqrt();
        let allowed = V::splat(self.law.yield_stress) / von_mises.max(V::splat(V::TINY));
        let lost = V::splat(1.0) - V::splat(1.0).min(allowed);
        trial.zip(deviator, |t, d| t - lost * d)
    }
}

#[inline(always)]
fn transposed<V: Lanes>(m: &Matrix3<V>) -> Matrix3<V> {
    array![i in 3 => array![j in 3 => m[j][i]]]
}

impl Kernel for Honeycomb<'_> {
    const STATE: &'static [&'static str] =
        &["CRUSH", "AXIS11", "AXIS12", "AXIS13", "AXIS21", "AXIS22", "AXIS23", "AXIS31", "AXIS32", "AXIS33"];
    const VOLUME: bool = true;
    const CRUSHES: bool = true;

    /// The element's own axes at the start, seen from space: rows are space axes.
    fn start(&self, element: &Start, state: &mut [f64]) {
        state[0] = 1.0;
        for (value, axis) in state[1..].iter_mut().zip(element.frame.as_flattened()) {
            *value = *axis;
        }
    }

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        let smallest = V::load(&state[0], part).min(step.volume);
        smallest.store(&mut state[0], part);
        // The frame turns with the element; in it the material's axes stay what they were at the start.
        let axes: Matrix3<V> = array![i in 3 => array![j in 3 => V::load(&state[1 + 3 * i + j], part)]];
        let (strain, old) = (step.strain.rotate(&axes), stress.rotate(&axes));
        let crushing = self.crushing(&strain, &old, smallest).rotate(&transposed(&axes));
        let compact = self.compact(&step.strain, stress);
        let limit = V::splat(self.law.compact);
        let new = crushing.zip(compact, |a, b| V::select_less(limit, smallest, a, b));
        // How much the cut-off took, as seen by the hourglass resistance.
        let young = V::splat(self.law.young);
        let trial = stress.zip(step.strain, |s, e| s + young * e);
        let (before, after) = (trial.contract(trial), new.contract(new));
        let share = (after / before.max(V::splat(V::TINY))).sqrt();
        let answering = self.answering(&step.strain, [stress, &new], smallest);
        *stress = new;
        Response { answering, ..Response::returned(V::splat(1.0).min(share)) }
    }
}

#[cfg(test)]
mod tests {
    use crate::material::Start;
    use crate::material::point::{Point, close, flat, full, made};
    use nalgebra::Rotation3;

    const FUNCTIONS: &[(i64, &[(f64, f64)])] =
        &[(1, &[(0.0, 2e6), (0.6, 3e6), (0.7, 50e6)]), (2, &[(0.0, 1e6), (0.7, 1e6)]), (3, &[(0.0, 0.5e6)])];

    fn honeycomb() -> Point {
        let given = [
            ("YOUNGS MODULUS", 70e9),
            ("POISSONS RATIO", 0.33),
            ("YIELD STRESS", 200e6),
            ("EX", 1e9),
            ("EY", 0.3e9),
            ("EZ", 0.2e9),
            ("GXY", 0.4e9),
            ("GYZ", 0.1e9),
            ("GZX", 0.2e9),
            ("CRUSH XX", 1.0),
            ("CRUSH YY", 2.0),
            ("CRUSH ZZ", 2.0),
            ("CRUSH XY", 3.0),
            ("CRUSH YZ", 3.0),
            ("CRUSH ZX", 3.0),
            ("VMIN", 0.3),
        ];
        Point::new(made("ORTHOTROPIC CRUSH", 100.0, &given, FUNCTIONS))
    }

    /// Each direction by itself: no Poisson effect, elastic to its curve, then along it as the volume shrinks.
    #[test]
    fn directions_do_not_know_of_each_other() {
        let mut point = honeycomb();
        point.strain([1e-4, -1e-4, 2e-4, 1e-5, 2e-5, -3e-5]);
        // Volume grows, so the moduli are those of the start.
        let expected = [1e5, -0.3e5, 0.4e5, 0.8e4, 0.4e4, -1.2e4];
        for i in 0..6 {
            close("elastic", point.stress[i], expected[i], 1e-9);
        }
        let mut point = honeycomb();
        point.strain_in(2000, [-0.5, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let crushed = 1.0 - libm::exp(-0.5);
        close("crush in x", -point.stress[0], 2e6 + 1e6 * crushed / 0.6, 1e-9);
        assert_eq!(point.stress[1..], [0.0; 5]);
        close("smallest volume", point.state("CRUSH"), libm::exp(-0.5), 1e-12);
        // Sheared, it slides at its shear strength.
        point.strain_in(100, [0.0, 0.0, 0.0, 0.01, 0.0, 0.0]);
        close("shear", point.stress[3], 0.5e6, 1e-9);
        // Unloading: between the moduli of the start and of the compact material, by how far it has come.
        let before = point.stress[0];
        point.strain([1e-7, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let modulus = 1e9 + (70e9 - 1e9) * crushed / 0.7;
        close("unloading", (point.stress[0] - before) / 1e-7, modulus, 1e-4);
    }

    /// What bulk viscosity goes by: the modulus of the direction while it is elastic, the slope of the curve while it crushes, more and
    /// more of λ + 2μ of the metal as it becomes compact, and the blended modulus as it is let go.
    #[test]
    fn answers_with_its_present_modulus() {
        let mut point = honeycomb();
        point.strain([-1e-6, 0.0, 0.0, 0.0, 0.0, 0.0]);
        close("elastic", point.answering, 1e9 + (70e9 - 1e9) * 1e-6 / 0.7, 1e-6);
        point.strain([0.0, 0.0, 0.0, 1e-6, 0.0, 0.0]);
        close("sheared", point.answering, 2.0 * (0.4e9 + (0.5 * 70e9 / 1.33 - 0.4e9) * 1e-6 / 0.7), 1e-6);
        point.strain_in(2000, [-0.1, 0.0, 0.0, 0.0, 0.0, 0.0]);
        close("crushing", point.answering, 1e6 / 0.6 * libm::exp(-0.1), 1e-3);
        let metal = 70e9 * 0.67 / (1.33 * 0.34);
        point.strain_in(2000, [-0.4, 0.0, 0.0, 0.0, 0.0, 0.0]);
        close("crushed", point.answering, metal * ((1.0 - libm::exp(-0.5)) / 0.7).powi(8), 1e-4);
        point.strain([1e-7, 0.0, 0.0, 0.0, 0.0, 0.0]);
        close("let go", point.answering, 1e9 + (70e9 - 1e9) * (1.0 - libm::exp(-0.5)) / 0.7, 1e-4);
        point.strain_in(4000, [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        close("compact", point.answering, metal, 1e-12);
    }

    /// Below VMIN it is a metal: Hooke's law and von Mises.
    #[test]
    fn compact_material_is_a_metal() {
        let mut point = honeycomb();
        point.strain_in(4000, [-1.25, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert!(point.state("CRUSH") < 0.3);
        close("yield", point.von_mises(), 200e6, 1e-9);
        let bulk = 70e9 / (3.0 * 0.34);
        let before = point.mean();
        point.strain([1e-5, 1e-5, 1e-5, 0.0, 0.0, 0.0]);
        close("bulk modulus", (point.mean() - before) / 3e-5, bulk, 1e-6);
    }

    /// An element whose own axes are turned crushes along the axes of space all the same.
    #[test]
    fn axes_are_those_of_space() {
        let r = Rotation3::from_euler_angles(0.4, -0.9, 0.3).into_inner();
        let path = [-0.2, 0.02, -0.03, 0.01, 0.02, -0.04];
        let mut straight = honeycomb();
        straight.strain_in(200, path);
        let mut turned = honeycomb();
        let frame = std::array::from_fn(|i| std::array::from_fn(|j| r[(i, j)]));
        let start = turned.law.start(&Start { centre: [0.0; 3], length: 1.0, frame });
        turned.stored = start.into_iter().map(|x| crate::lanes::Row([x; 8])).collect();
        turned.strain_in(200, flat(r.transpose() * full(path) * r));
        let back = r * full(turned.stress) * r.transpose();
        assert!((back - full(straight.stress)).amax() < 1e-3, "{back} {}", full(straight.stress));
    }

    #[test]
    fn safe_at_the_limits() {
        for size in [0.0, 1e-320, 1e-160, 1e-12, 1e-3, 0.5, 5.0] {
            for sign in [-1.0, 1.0] {
                let mut point = honeycomb();
                for _ in 0..3 {
                    point.strain([sign * size, -0.3 * size, 0.1 * size, 0.5 * size, 0.0, -size]);
                    point.assert_finite();
                }
            }
        }
    }
}
