//! LOW DEN FOAM: a skeleton that yields in principal stress, and the air trapped in it.
//!
//! Neilsen, Morgan and Krieg (SAND86-2927). That A counts whole as soon as there is deviatoric strain is inferred from a
//! genuine deck, whose "400 PSI" foam has A = 215 and B = 183.

use super::elastic::YOUNGS_MODULUS;
use super::property::STRESS;
use super::{
    Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Property, Range, Refusal, Response, StateVariable, Step,
    Stiffness,
};
use crate::lanes::{Lanes, Matrix3, Numbers, Sym3};
use nalgebra::{Matrix3 as Dense, SymmetricEigen};

parameters! {
    /// σ = σˢᵏ + σᵃⁱʳ I. The skeleton has E and no Poisson's ratio; its principal stresses are at most f = A ⟨II′⟩ + B (1 + C ε_V)
    /// in size, where ⟨II′⟩ is 1 if the strain has a deviator, else 0. Air: σᵃⁱʳ = p₀ ε_V/(ε_V + 1 − φ). ε_V = V/V₀ − 1.
    #[derive(Debug, Clone, PartialEq)]
    pub struct LowDensityFoam {
        /// Young's modulus of the skeleton E, force/length².
        pub young: f64 = [YOUNGS_MODULUS],
        /// A, force/length².
        pub a: f64 = [
            Property::required(
                "A", "A", STRESS, Range::Any,
                "Strength that the skeleton has beside B where it changes shape.",
            ),
        ],
        /// B, force/length².
        pub b: f64 = [
            Property::required("B", "B", STRESS, Range::Any, "Strength of the skeleton at the initial volume."),
        ],
        /// C; negative where the foam hardens in compression.
        pub c: f64 = [
            Property::required(
                "C", "C", "-", Range::Any,
                "Relative growth of B with the volume strain; < 0 hardens when pressed.",
            ),
        ],
        /// Whether the air is trapped: not 0.
        pub air: f64 = [
            Property::required("NAIR", "NAIR", "-", Range::Any, "0 if air can escape, another number if it is trapped."),
        ],
        /// Pressure of the air at the start p₀, force/length².
        pub pressure: f64 = [
            Property::required("P0", "p0", STRESS, Range::NotNegative, "Pressure of the air at the start."),
        ],
        /// Part of the volume that is solid φ.
        pub solid: f64 = [
            Property::required(
                "PHI", "phi", "-", Range::Between { low: (0.0, true), high: (1.0, false) },
                "Part of the volume that is solid.",
            ),
        ],
    }
}

pub(in crate::material) static ENTRY: Entry = Entry {
    name: "LOW DEN FOAM",
    aliases: &["LOW DENSITY FOAM"],
    summary: "Low density foam: a skeleton that yields in principal stress, and the air trapped in it.",
    properties: LowDensityFoam::PROPERTIES,
    state: &[StateVariable { name: "AIRPRES", meaning: "Pressure of the trapped air above its initial one." }],
    origin: Origin::Verified,
    build: |given| {
        let law = LowDensityFoam::read(given)?;
        let LowDensityFoam { a, b, .. } = law;
        if a + b < 0.0 || b < 0.0 {
            let reason = format!("is {b}, which with A = {a} makes a strength below 0");
            return Err(Refusal { keyword: "B", reason });
        }
        Ok(Law::LowDensityFoam(law))
    },
};

/// A strain has a deviator when that is more than this part of it: round-off is none.
const SHAPE: f64 = 1e-6;

/// Volume that is left to the air at least, as a part of V₀: there the gas law ends.
const LEAST_AIR: f64 = 1e-3;

impl LowDensityFoam {
    pub(in crate::material) fn moduli(&self) -> Moduli {
        Moduli { lambda: self.trapped() / (1.0 - self.solid), two_mu: self.young }
    }

    /// p₀ of the air that matters.
    fn trapped(&self) -> f64 {
        if self.air == 0.0 { 0.0 } else { self.pressure }
    }

    pub(in crate::material) fn state(&self, stored: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        vec![-stored[0]]
    }

    pub(in crate::material) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        visitor.visit(FoamKernel { law: self })
    }
}

#[derive(Clone, Copy)]
struct FoamKernel<'a> {
    law: &'a LowDensityFoam,
}

impl FoamKernel<'_> {
    /// Largest principal stress of the skeleton.
    #[inline(always)]
    fn strength<V: Lanes>(&self, volume_strain: V, biot_strain: &Sym3<V>) -> V {
        let law = self.law;
        let shape = biot_strain.deviator();
        let size = V::splat(SHAPE) * (V::splat(1.0) + biot_strain.trace() * V::splat(1.0 / 3.0));
        let has_shape = V::select_less(size * size, shape.contract(shape), V::splat(1.0), V::splat(0.0));
        let strength =
            V::splat(law.b) * (V::splat(1.0) + V::splat(law.c) * volume_strain) + V::splat(law.a) * has_shape;
        strength.max(V::splat(0.0))
    }
}

/// Principal stresses cut off at ± the strength, lane by lane, and by how much that shrinks the deviator. Lanes within their
/// strength are left alone.
#[inline(always)]
fn clip<V: Lanes>(trial: &Sym3<V>, strength: V) -> (Sym3<V>, V) {
    // No principal stress is larger than √(σ:σ).
    if !V::any_less(strength * strength, trial.contract(*trial)) {
        return (*trial, V::splat(1.0));
    }
    let mut rows = [V::Row::default(); 8];
    for (row, value) in rows.iter_mut().zip(trial.to_array()) {
        value.store(row, 0);
    }
    strength.store(&mut rows[6], 0);
    clip_lanes(&mut rows, V::COUNT);
    (Sym3::load(&rows, 0), V::load(&rows[7], 0))
}

/// Rows 0 to 5 hold stresses, row 6 strengths; row 7 takes the factors.
fn clip_lanes<R: Numbers>(rows: &mut [R; 8], count: usize) {
    for lane in 0..count.min(R::LANES) {
        let at = |i: usize| rows[i].number(lane);
        let (stress, strength) = (Sym3 { xx: at(0), yy: at(1), zz: at(2), xy: at(3), yz: at(4), zx: at(5) }, at(6));
        rows[7].set(lane, 1.0);
        if !stress.contract(stress).is_finite() || stress.contract(stress) <= strength * strength {
            continue;
        }
        let m = stress.matrix();
        let eigen = SymmetricEigen::new(Dense::from_fn(|i, j| m[i][j]));
        let clipped = eigen.eigenvalues.map(|s| s.clamp(-strength, strength));
        let c = eigen.eigenvectors * Dense::from_diagonal(&clipped) * eigen.eigenvectors.transpose();
        for (row, (i, j)) in rows.iter_mut().zip([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]) {
            row.set(lane, c[(i, j)]);
        }
        let (before, after) = (stress.contract(stress), clipped.norm_squared());
        rows[7].set(lane, (after / before).sqrt().min(1.0));
    }
}

impl Kernel for FoamKernel<'_> {
    const STATE: &'static [&'static str] = &["AIR"];
    const VOLUME: bool = true;
    const STIFFNESS: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        let law = self.law;
        // (i) the skeleton's own stress, and its trial with ν = 0
        let skeleton = stress.add_diagonal(-V::load(&state[0], part));
        let young = V::splat(law.young);
        let trial = skeleton.zip(step.strain, |s, e| s + young * e);
        // (ii) principal stresses are cut off
        let volume_strain = step.dilatation();
        let (clipped, factor) = clip(&trial, self.strength(volume_strain, &step.biot_strain));
        // (iii) air
        let left = (step.volume - V::splat(law.solid)).max(V::splat(LEAST_AIR));
        let air = V::splat(law.trapped()) * volume_strain / left;
        air.store(&mut state[0], part);
        *stress = clipped.add_diagonal(air);
        // v dσᵃⁱʳ/dv
        let gas = V::splat(law.trapped() * (1.0 - law.solid)) * step.volume / (left * left);
        let stiffness = Stiffness { dilatational: young + gas, shear: young * V::splat(0.5) };
        Response::stiff(factor, stiffness)
    }
}

#[cfg(test)]
mod tests {
    use crate::material::point::{Point, close, flat, full, made};
    use nalgebra::Rotation3;

    /// The "400 PSI" cargo foam of a deck of 1988, in psi; with its air trapped where asked.
    fn foam(air: f64, pressure: f64) -> Point {
        let given = [
            ("YOUNGS MODULUS", 11.96e3),
            ("A", 215.0),
            ("B", 183.0),
            ("C", -3.74),
            ("NAIR", air),
            ("P0", pressure),
            ("PHI", 0.1915),
        ];
        Point::new(made("LOW DEN FOAM", 1.603e-5, &given, &[]))
    }

    /// Pressed along one axis: E ε to the strength A + B (1 + C ε_V), which grows as the volume shrinks; the sides stay free
    /// of stress because Poisson's ratio is 0.
    #[test]
    fn uniaxial_crush() {
        let mut point = foam(0.0, 14.7);
        point.strain_in(10, [-0.01, 0.0, 0.0, 0.0, 0.0, 0.0]);
        close("elastic", point.stress[0], -11.96e3 * 0.01, 1e-12);
        point.strain_in(500, [-0.5, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let volume_strain = libm::exp(-0.51) - 1.0;
        close("crush", -point.stress[0], 215.0 + 183.0 * (1.0 - 3.74 * volume_strain), 1e-9);
        assert_eq!(point.stress[1..], [0.0; 5]);
        // At the initial volume it is the 400 psi of the deck's remark.
        close("at yield", 215.0 + 183.0, 400.0, 0.01);
        // Unloading is elastic.
        let before = point.stress[0];
        point.strain([1e-3, 0.0, 0.0, 0.0, 0.0, 0.0]);
        close("unloading", point.stress[0] - before, 11.96, 1e-9);
    }

    /// Without a change of shape A does not count.
    #[test]
    fn hydrostatic_crush() {
        let mut point = foam(0.0, 14.7);
        let third = -0.3 / 3.0;
        point.strain_in(300, [third, third, third, 0.0, 0.0, 0.0]);
        close("pressure", -point.mean(), 183.0 * (1.0 - 3.74 * (libm::exp(-0.3) - 1.0)), 1e-9);
    }

    /// The gas law at constant temperature: (p₀ + p)(V − φV₀) stays p₀ (1 − φ) V₀.
    #[test]
    fn trapped_air() {
        for volume_strain in [-0.5f64, -0.2, 0.3] {
            let (mut with, mut without) = (foam(1.0, 14.7), foam(0.0, 14.7));
            for point in [&mut with, &mut without] {
                point.strain_in(400, [(1.0 + volume_strain).ln(), 0.0, 0.0, 0.0, 0.0, 0.0]);
            }
            let pressure = 14.7 * (1.0 - 0.1915) / (1.0 + volume_strain - 0.1915) - 14.7;
            for i in 0..3 {
                assert!((without.stress[i] - with.stress[i] - pressure).abs() < 1e-6, "{i}");
            }
            assert!((with.state("AIRPRES") - pressure).abs() < 1e-6);
            // ρc²: E and V dσ/dV of the air.
            let slope = 14.7 * (1.0 - 0.1915) * (1.0 + volume_strain) / (1.0 + volume_strain - 0.1915).powi(2);
            close("stiffness", with.dilatational, 11.96e3 + slope, 1e-6);
        }
    }

    /// Principal directions are found: a turned path gives the turned stress.
    #[test]
    fn principal_stresses_are_cut_in_any_direction() {
        let r = Rotation3::from_euler_angles(0.5, -0.3, 1.1).into_inner();
        let path = [-0.06, 0.05, -0.01, 0.0, 0.0, 0.0];
        let (mut here, mut turned) = (foam(1.0, 14.7), foam(1.0, 14.7));
        here.strain_in(100, path);
        turned.strain_in(100, flat(r * full(path) * r.transpose()));
        let back = r.transpose() * full(turned.stress) * r;
        assert!((back - full(here.stress)).amax() < 1e-6);
        let strength = 215.0 + 183.0 * (1.0 - 3.74 * (libm::exp(-0.02) - 1.0));
        let air = here.state("AIRPRES");
        close("compression", -here.stress[0], strength + air, 1e-9);
        close("tension", here.stress[1], strength - air, 1e-9);
    }

    #[test]
    fn safe_at_the_limits() {
        for size in [0.0, 1e-320, 1e-160, 1e-12, 1e-3, 0.5, 5.0] {
            for sign in [-1.0, 1.0] {
                let mut point = foam(1.0, 14.7);
                for _ in 0..3 {
                    point.strain([sign * size, -0.3 * size, 0.1 * size, 0.5 * size, 0.0, -size]);
                    point.assert_finite();
                    assert!(point.dilatational > 0.0 && point.dilatational.is_finite());
                }
            }
        }
    }
}
