//! ELASTIC: isotropic hypoelasticity in the unrotated frame.

use super::property::STRESS;
use super::{Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Property, Range, Response, Step};
use crate::lanes::{Lanes, Matrix3, Sym3};

/// Poisson's ratios for which λ and μ are finite and positive definite.
const POISSON_RANGE: Range = Range::Between { low: (-1.0, false), high: (0.5, false) };

/// Young's modulus, for every law with elastic constants.
pub(super) const YOUNGS_MODULUS: Property =
    Property::required("YOUNGS MODULUS", "E", STRESS, Range::Positive, "Young's modulus.");

/// Poisson's ratio, for every law with elastic constants.
pub(super) const POISSONS_RATIO: Property =
    Property::required("POISSONS RATIO", "nu", "-", POISSON_RANGE, "Poisson's ratio.");

parameters! {
    /// Isotropic linear elasticity, σ̇ = λ tr(d) I + 2μ d in the unrotated frame.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Elastic {
        /// Young's modulus E, force/length².
        pub young: f64 = [YOUNGS_MODULUS],
        /// Poisson's ratio ν.
        pub poisson: f64 = [POISSONS_RATIO],
    }
}

pub(super) static ENTRY: Entry = Entry {
    name: "ELASTIC",
    aliases: &[],
    summary: "Isotropic linear elasticity in rate form, objective under any rotation.",
    properties: Elastic::PROPERTIES,
    state: &[],
    origin: Origin::Recalled,
    build: |given| Ok(Law::Elastic(Elastic::read(given)?)),
};

impl Elastic {
    pub(super) fn moduli(&self) -> Moduli {
        Moduli::from_young(self.young, self.poisson)
    }

    pub(super) fn state(&self, _: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        Vec::new()
    }

    pub(super) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        visitor.visit(Hooke::from(self.moduli()))
    }
}

/// The elastic kernel, also the trial step of every law built on it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hooke {
    pub lambda: f64,
    pub two_mu: f64,
}

impl From<Moduli> for Hooke {
    fn from(moduli: Moduli) -> Hooke {
        Hooke { lambda: moduli.lambda, two_mu: moduli.two_mu }
    }
}

impl Hooke {
    /// σ + λ tr(Δε) I + 2μ Δε
    #[inline(always)]
    pub fn trial<V: Lanes>(&self, strain: &Sym3<V>, stress: &Sym3<V>) -> Sym3<V> {
        let two_mu = V::splat(self.two_mu);
        let volumetric = V::splat(self.lambda) * strain.trace();
        stress.zip(*strain, |s, e| s + two_mu * e).add_diagonal(volumetric)
    }
}

impl Kernel for Hooke {
    const STATE: &'static [&'static str] = &[];
    const HYPOELASTIC: bool = true;
    const FREQUENT: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, _: &mut [V::Row], _: usize) -> Response<V> {
        *stress = self.trial(&step.strain, stress);
        Response::returned(V::splat(1.0))
    }
}
