//! MOONEY RIVLIN: rubber, from a stored energy; NEO HOOKEAN is the same with C01 = 0.

use super::property::STRESS;
use super::{
    Entry, Given, Kernel, KernelVisitor, Law, Moduli, Origin, Property, Range, Refusal, Response, Step, Stiffness,
};
use crate::lanes::{Lanes, Matrix3, Sym3, power};

parameters! {
    /// W = C₁₀ (Ī₁ − 3) + C₀₁ (Ī₂ − 3) + ½ K (J − 1)², with the invariants of b̄ = J^(−2/3) F Fᵀ.
    #[derive(Debug, Clone, PartialEq)]
    pub struct MooneyRivlin {
        /// C₁₀, force/length².
        pub c10: f64 = [
            Property::required("C10", "C10", STRESS, Range::Any, "Factor of the first invariant in the stored energy."),
        ],
        /// C₀₁, force/length².
        pub c01: f64 = [
            Property::required("C01", "C01", STRESS, Range::Any, "Factor of the second invariant.").or(0.0),
        ],
        /// Bulk modulus K, force/length².
        pub bulk: f64 = [Property::required("BULK MODULUS", "K", STRESS, Range::Positive, "Bulk modulus.")],
    }
}

pub(super) static ENTRY: Entry = Entry {
    name: "MOONEY RIVLIN",
    aliases: &["MOONEY", "NEO HOOKEAN"],
    summary: "Rubber after Mooney and Rivlin, nearly incompressible; neo-Hookean without C01.",
    properties: MooneyRivlin::PROPERTIES,
    state: &[],
    origin: Origin::Recalled,
    build: |given| {
        let law = MooneyRivlin::read(given)?;
        let MooneyRivlin { c10, c01, .. } = law;
        if c10 + c01 <= 0.0 {
            let reason = format!("is {c10}, which with C01 = {c01} makes a shear modulus that is not positive");
            return Err(Refusal { keyword: "C10", reason });
        }
        warn_of_unbounded_energy(&law, given);
        Ok(Law::MooneyRivlin(law))
    },
};

/// With a negative constant W falls without end: Ī₁ ~ λ² leads in uniaxial tension, Ī₂ ~ λ⁴ in equibiaxial. What is free at its
/// sides changes the sign of its stress where C₁₀ + C₀₁/λ, or C₁₀ + C₀₁λ², is 0.
fn warn_of_unbounded_energy(law: &MooneyRivlin, given: &Given) {
    let MooneyRivlin { c10, c01, .. } = *law;
    let (keyword, value, motion, stretch) = match (c10 < 0.0, c01 < 0.0) {
        (true, _) => ("C10", c10, "uniaxial", -c01 / c10),
        (_, true) => ("C01", c01, "equibiaxial", (-c10 / c01).sqrt()),
        _ => return,
    };
    let reason = format!(
        "is {value}, with which the stored energy is not bounded below: in {motion} tension the stress changes its sign at a \
         stretch of {stretch:.4}"
    );
    let help = "C10 >= 0 and C01 >= 0 are safe at every stretch (Drucker, Ball); others only within those that they were \
                fitted to";
    given.warn(keyword, reason, help);
}

impl MooneyRivlin {
    /// Of small strains: μ = 2 (C₁₀ + C₀₁).
    pub(super) fn moduli(&self) -> Moduli {
        let two_mu = 4.0 * (self.c10 + self.c01);
        Moduli::from_bulk(self.bulk, two_mu)
    }

    pub(super) fn state(&self, _: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        Vec::new()
    }

    pub(super) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        visitor.visit(Rubber { law: self })
    }
}

#[derive(Clone, Copy)]
struct Rubber<'a> {
    law: &'a MooneyRivlin,
}

/// a · a of a symmetric tensor.
#[inline(always)]
fn square<V: Lanes>(a: &Sym3<V>) -> Sym3<V> {
    Sym3 {
        xx: a.xx * a.xx + a.xy * a.xy + a.zx * a.zx,
        yy: a.xy * a.xy + a.yy * a.yy + a.yz * a.yz,
        zz: a.zx * a.zx + a.yz * a.yz + a.zz * a.zz,
        xy: a.xx * a.xy + a.xy * a.yy + a.zx * a.yz,
        yz: a.xy * a.zx + a.yy * a.yz + a.yz * a.zz,
        zx: a.xx * a.zx + a.xy * a.yz + a.zx * a.zz,
    }
}

impl Kernel for Rubber<'_> {
    const STATE: &'static [&'static str] = &[];
    const VOLUME: bool = true;
    const STIFFNESS: bool = true;

    /// σ = (2/J) dev[(C₁₀ + C₀₁ Ī₁) b̄ − C₀₁ b̄²] + K (J − 1) I. In the frame F Fᵀ is U²; the deviator is found from U² − I.
    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, _: &mut [V::Row], _: usize) -> Response<V> {
        let law = self.law;
        let (one, zero) = (V::splat(1.0), V::splat(0.0));
        // B = U² − I = 2E + E² with E = U − I: U² itself has lost the digits of a small strain.
        let strain = &step.biot_strain;
        let b = square(strain).zip(*strain, |square, strain| square + (strain + strain));
        // J^(−2/3) gives the shape a volume of 1; det U serves better than V/V₀, which differs by the integration of U.
        let scale = one / power(one + strain.volume_change(), 2.0 / 3.0);
        let first = scale * (V::splat(3.0) + b.trace());
        let (c10, c01) = (V::splat(law.c10), V::splat(law.c01));
        // dev b̄ = J^(−2/3) dev B, dev b̄² = J^(−4/3) dev(2B + B²)
        let inverse = V::splat(2.0) / step.volume;
        let quadratic = c01 * scale;
        let linear = c10 + c01 * first - (quadratic + quadratic);
        let factor = scale * inverse;
        let deviator = b.zip(square(&b), |b, square| (linear * b - quadratic * square) * factor).deviator();
        *stress = deviator.add_diagonal(V::splat(law.bulk) * step.dilatation());
        // A bound on (4/3) μ of the stretched state: moduli grow with the largest principal value of b̄, at most tr b̄, and
        // that of b̄², at most (tr b̄)².
        let stiff = (c10.max(zero) + c01.max(zero) * first) * first * inverse * V::splat(4.0 / 3.0);
        let bulk = V::splat(law.bulk) * step.volume;
        let shear = V::splat(law.c10 + law.c01) * V::splat(2.0);
        let least = V::splat(self.law.moduli().dilatational());
        Response::stiff(one, Stiffness { dilatational: least.max(bulk + stiff), shear })
    }
}

#[cfg(test)]
mod tests {
    use super::super::point::{Point, close, flat, made};
    use super::*;
    use nalgebra::{Matrix3, Rotation3};

    const C10: f64 = 0.4e6;
    const C01: f64 = 0.1e6;

    fn rubber(c01: f64) -> Point {
        Point::new(made("MOONEY RIVLIN", 1100.0, &[("C10", C10), ("C01", c01), ("BULK MODULUS", 2e10)], &[]))
    }

    /// Free of lateral stress, nearly incompressible: σ = 2 (λ² − 1/λ)(C₁₀ + C₀₁/λ).
    #[test]
    fn uniaxial_tension_and_compression() {
        for c01 in [0.0, C01] {
            for (sign, steps) in [(1.0, 120), (-1.0, 80)] {
                let mut point = rubber(c01);
                for _ in 0..steps {
                    point.stretch_freely(sign * 0.01);
                }
                let l = libm::exp(sign * 0.01 * f64::from(steps));
                close("stress", point.stress[0], 2.0 * (l * l - 1.0 / l) * (C10 + c01 / l), 2e-3);
                assert!(point.stress[1].abs() < 1.0);
            }
        }
    }

    /// Equibiaxial tension: σ = 2 (λ² − λ⁻⁴)(C₁₀ + C₀₁ λ²) above the free side.
    #[test]
    fn equibiaxial_tension() {
        let mut point = rubber(C01);
        point.strain_in(100, [0.4, 0.4, -0.8, 0.0, 0.0, 0.0]);
        let l = libm::exp(0.4);
        let expected = 2.0 * (l.powi(2) - l.powi(-4)) * (C10 + C01 * l.powi(2));
        close("stress", point.stress[0] - point.stress[2], expected, 1e-9);
    }

    /// Compression alone is K (J − 1); small strains obey Hooke's law with μ = 2 (C₁₀ + C₀₁).
    #[test]
    fn volume_and_small_strains() {
        let mut point = rubber(C01);
        point.strain_in(10, [-0.01, -0.01, -0.01, 0.0, 0.0, 0.0]);
        close("pressure", point.mean(), 2e10 * (libm::exp(-0.03) - 1.0), 1e-9);
        assert!(point.von_mises() < 1e-3);
        let mut point = rubber(C01);
        point.strain([1e-6, -1e-6, 0.0, 2e-6, 0.0, 0.0]);
        close("shear", point.stress[3], 4.0 * (C10 + C01) * 2e-6, 1e-5);
        close("normal", point.stress[0] - point.stress[1], 4.0 * (C10 + C01) * 2e-6, 1e-5);
    }

    /// The work done on any path is the stored energy, by the trapezoidal rule.
    #[test]
    fn work_is_the_stored_energy() {
        let mut point = rubber(C01);
        let r = Rotation3::from_euler_angles(0.2, 0.5, -0.8).into_inner();
        // Strain and stretch stay coaxial, along axes that are turned.
        for leg in [[0.3, -0.1, -0.21], [-0.1, 0.15, -0.06]] {
            let strain = r * Matrix3::from_diagonal(&leg.into()) * r.transpose();
            point.strain_in(2000, flat(strain));
        }
        let b = point.stretch * point.stretch;
        let j = point.stretch.determinant();
        let unit = b / j.powf(2.0 / 3.0);
        let i1 = unit.trace();
        let i2 = 0.5 * (i1 * i1 - (unit * unit).trace());
        let stored = C10 * (i1 - 3.0) + C01 * (i2 - 3.0) + 0.5 * 2e10 * (j - 1.0).powi(2);
        close("energy", point.energy, stored, 1e-5);
    }

    /// The stresses of the two tests above, 2 (λ² − 1/λ)(C₁₀ + C₀₁/λ) and 2 (λ² − λ⁻⁴)(C₁₀ + C₀₁λ²), vanish where it is told.
    #[test]
    fn an_energy_without_a_bound_is_told() {
        let told = |c10: f64, c01: f64| {
            let values = [c10, c01, 1e-3];
            let given = Given::new(&values, 1.0);
            assert!((ENTRY.build)(&given).is_ok());
            given.cautions.take().iter().map(|c| format!("{} {}", c.keyword, c.reason)).collect::<String>()
        };
        // sqrt(4/3.9) = 1.01274; 0.5/0.4 = 1.25
        let text = told(4.0, -3.9);
        assert!(
            text.starts_with("C01 is -3.9,")
                && text.ends_with("equibiaxial tension the stress changes its sign at a stretch of 1.0127"),
            "{text}"
        );
        let text = told(-0.4, 0.5);
        assert!(
            text.starts_with("C10 is -0.4,")
                && text.ends_with("uniaxial tension the stress changes its sign at a stretch of 1.2500"),
            "{text}"
        );
        assert_eq!(told(0.4, 0.1) + &told(0.0, 0.1) + &told(0.4, 0.0), "");
    }

    /// In single precision small strains keep their digits at a bulk modulus of a thousand shear moduli: Hooke's law, up to squares of
    /// the strain, though V/V₀ is off by a last digit of one.
    #[test]
    fn single_precision_keeps_small_strains() {
        let law = MooneyRivlin { c10: 0.4, c01: 0.1, bulk: 1e3 };
        for strain in [1e-6f32, 1e-5, 1e-4] {
            let none = 0.0f32;
            let biot_strain =
                Sym3 { xx: strain, yy: -0.5 * strain, zz: -0.49 * strain, xy: 0.3 * strain, yz: none, zx: none };
            let [xx, yy, zz, xy, ..] = biot_strain.to_array().map(f64::from);
            let dilatation = Sym3 { xx, yy, zz, xy, yz: 0.0, zx: 0.0 }.volume_change();
            for off in [-2.0, 0.0, 3.0] {
                let volume = (1.0 + dilatation + off * f64::from(f32::EPSILON)) as f32;
                let step = Step {
                    strain: biot_strain,
                    biot_strain,
                    volume,
                    middle_volume: volume,
                    energy: none,
                    swept: none,
                    time: 0.0,
                    time_step: 1.0,
                };
                let mut stress = Sym3 { xx: none, yy: none, zz: none, xy: none, yz: none, zx: none };
                let _ = Rubber { law: &law }.update::<f32>(&step, &mut stress, &mut [], 0);
                let tolerance = 4.0 * f64::from(strain) + 1e-6;
                close("shear", f64::from(stress.xy), 2.0 * 0.3 * f64::from(strain), tolerance);
                close("difference", f64::from(stress.xx - stress.yy), 2.0 * 1.5 * f64::from(strain), tolerance);
                close("pressure", f64::from(stress.trace() / 3.0), 1e3 * dilatation, 1e-4);
            }
        }
    }

    #[test]
    fn safe_at_the_limits() {
        for size in [0.0, 1e-320, 1e-160, 1e-12, 1e-3, 0.5, 3.0] {
            for sign in [-1.0, 1.0] {
                let mut point = rubber(C01);
                for _ in 0..2 {
                    point.strain([sign * size, -0.3 * size, 0.1 * size, 0.0, 0.0, 0.0]);
                    point.assert_finite();
                    assert!(point.dilatational >= 2e10 && point.dilatational.is_finite());
                }
            }
        }
    }
}
