//! ELASTIC PLASTIC: von Mises plasticity with combined linear hardening.

use super::elastic::{Hooke, POISSONS_RATIO, YOUNGS_MODULUS};
use super::property::STRESS;
use super::{
    Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Property, ROOT_TWO_THIRDS, Range, Response, StateVariable, Step,
};
use crate::lanes::{Lanes, Matrix3, Sym3};

/// Yield stress, for every law with one.
pub(in crate::material) const YIELD_STRESS: Property =
    Property::required("YIELD STRESS", "Y0", STRESS, Range::NotNegative, "Initial yield stress in uniaxial tension.");

/// Linear hardening, for every law with it.
pub(in crate::material) const HARDENING_MODULUS: Property = Property::required(
    "HARDENING MODULUS",
    "H",
    STRESS,
    Range::NotNegative,
    "Slope of uniaxial stress against plastic strain.",
)
.or(0.0);

/// Kind of hardening.
const BETA: Property = Property::required(
    "BETA",
    "beta",
    "-",
    Range::Between { low: (0.0, true), high: (1.0, true) },
    "1 for isotropic hardening, 0 for kinematic, linear between.",
)
.or(1.0);

parameters! {
    /// J2 flow theory with linear isotropic and kinematic hardening.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct ElasticPlastic {
        /// Young's modulus E, force/length².
        pub young: f64 = [YOUNGS_MODULUS],
        /// Poisson's ratio ν.
        pub poisson: f64 = [POISSONS_RATIO],
        /// Initial yield stress in uniaxial tension Y₀, force/length².
        pub yield_stress: f64 = [YIELD_STRESS],
        /// Uniaxial plastic hardening modulus H = dσ/dε̄ᵖ, force/length².
        pub hardening: f64 = [HARDENING_MODULUS],
        /// β: 1 is isotropic hardening, 0 kinematic, linear between.
        pub beta: f64 = [BETA],
    }
}

pub(in crate::material) static ENTRY: Entry = Entry {
    name: "ELASTIC PLASTIC",
    aliases: &["ELASTIC-PLASTIC"],
    summary: "Von Mises plasticity with linear hardening, isotropic, kinematic or combined.",
    properties: ElasticPlastic::PROPERTIES,
    state: &[
        StateVariable { name: "EQPS", meaning: "Equivalent plastic strain." },
        StateVariable { name: "RADIUS", meaning: "Radius of the yield surface in deviatoric stress space." },
        StateVariable { name: "ALPHA11", meaning: "Back stress, xx component turning with the material." },
        StateVariable { name: "ALPHA22", meaning: "Back stress, yy component turning with the material." },
        StateVariable { name: "ALPHA33", meaning: "Back stress, zz component turning with the material." },
        StateVariable { name: "ALPHA12", meaning: "Back stress, xy component turning with the material." },
        StateVariable { name: "ALPHA23", meaning: "Back stress, yz component turning with the material." },
        StateVariable { name: "ALPHA31", meaning: "Back stress, zx component turning with the material." },
    ],
    origin: Origin::Verified,
    build: |given| Ok(Law::ElasticPlastic(ElasticPlastic::read(given)?)),
};

impl ElasticPlastic {
    pub(in crate::material) fn moduli(&self) -> Moduli {
        Moduli::from_young(self.young, self.poisson)
    }

    /// Equivalent plastic strain, radius of the yield surface, back stress in space.
    pub(in crate::material) fn state(&self, stored: &[f64], frame: &Matrix3<f64>) -> Vec<f64> {
        let radius = ROOT_TWO_THIRDS * (self.yield_stress + self.beta * self.hardening * stored[0]);
        let back_stress = match stored[1..] {
            [xx, yy, zz, xy, yz, zx] => Sym3 { xx, yy, zz, xy, yz, zx }.rotate(frame).to_array(),
            _ => [0.0; 6],
        };
        [stored[0], radius].into_iter().chain(back_stress).collect()
    }

    pub(in crate::material) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        if self.beta == 1.0 {
            visitor.visit(Isotropic(self.constants()))
        } else {
            visitor.visit(Combined { common: self.constants(), beta: self.beta })
        }
    }

    fn constants(&self) -> Constants {
        let moduli = self.moduli();
        Constants {
            elastic: moduli.into(),
            yield_stress: self.yield_stress,
            hardening: self.hardening,
            plastic_share: 1.0 / (1.0 + self.hardening / (1.5 * moduli.two_mu)),
        }
    }
}

/// What both kernels share.
#[derive(Debug, Clone, Copy)]
struct Constants {
    elastic: Hooke,
    yield_stress: f64,
    hardening: f64,
    /// 1/(1 + H/3μ): the part of the overstress that becomes 2μ Δγ.
    plastic_share: f64,
}

/// How a trial deviator ξ comes back to the yield surface.
struct Return<V> {
    /// 2μ Δγ/|ξ|, to be taken off along ξ.
    share: V,
    /// Δγ
    multiplier: V,
}

impl Constants {
    /// Radial return of the trial deviator `xi` (relative to the back stress) to a surface of radius `radius`:
    /// Δγ = ⟨|ξ| − R⟩ / (2μ (1 + H/3μ)) (Krieg and Krieg 1977). Exact for any increment, and safe at ξ = 0, R = 0.
    #[inline(always)]
    fn radial_return<V: Lanes>(&self, xi: &Sym3<V>, radius: V) -> Return<V> {
        let norm = xi.contract(*xi).sqrt();
        let over = (norm - radius).max(V::splat(0.0)) * V::splat(self.plastic_share);
        Return { share: over / norm.max(V::splat(V::TINY)), multiplier: over * V::splat(1.0 / self.elastic.two_mu) }
    }
}

/// Isotropic hardening (β = 1): one state variable.
#[derive(Debug, Clone, Copy)]
struct Isotropic(Constants);

impl Kernel for Isotropic {
    const STATE: &'static [&'static str] = &["EQPS"];
    const HYPOELASTIC: bool = true;
    const FREQUENT: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        let common = &self.0;
        // (i) elastic predictor
        let trial = common.elastic.trial(&step.strain, stress);
        let deviator = trial.deviator();
        // (ii) radius √⅔ (Y₀ + H ε̄ᵖ)
        let eqps = V::load(&state[0], part);
        let radius =
            V::splat(ROOT_TWO_THIRDS * common.yield_stress) + V::splat(ROOT_TWO_THIRDS * common.hardening) * eqps;
        // (iii) return
        let back = common.radial_return(&deviator, radius);
        *stress = trial.zip(deviator, |t, d| t - back.share * d);
        (eqps + V::splat(ROOT_TWO_THIRDS) * back.multiplier).store(&mut state[0], part);
        Response::returned(V::splat(1.0) - back.share)
    }
}

/// Combined hardening (β < 1): equivalent plastic strain and back stress α.
#[derive(Debug, Clone, Copy)]
struct Combined {
    common: Constants,
    beta: f64,
}

impl Kernel for Combined {
    const STATE: &'static [&'static str] = &["EQPS", "ALPHA11", "ALPHA22", "ALPHA33", "ALPHA12", "ALPHA23", "ALPHA31"];
    const HYPOELASTIC: bool = true;
    const FREQUENT: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        let common = &self.common;
        // (i) elastic predictor, seen from the back stress
        let trial = common.elastic.trial(&step.strain, stress);
        let alpha = Sym3::load(&state[1..], part);
        let xi = trial.deviator().zip(alpha, |s, a| s - a);
        // (ii) radius √⅔ (Y₀ + β H ε̄ᵖ)
        let eqps = V::load(&state[0], part);
        let radius = V::splat(ROOT_TWO_THIRDS * common.yield_stress)
            + V::splat(ROOT_TWO_THIRDS * self.beta * common.hardening) * eqps;
        // (iii) return; the back stress moves by ⅔ (1 − β) H Δγ along the flow
        let back = common.radial_return(&xi, radius);
        let kinematic = V::splat((1.0 - self.beta) * common.hardening / (1.5 * common.elastic.two_mu)) * back.share;
        *stress = trial.zip(xi, |t, x| t - back.share * x);
        let alpha = alpha.zip(xi, |a, x| a + kinematic * x);
        (eqps + V::splat(ROOT_TWO_THIRDS) * back.multiplier).store(&mut state[0], part);
        for (row, value) in state[1..].iter_mut().zip(alpha.to_array()) {
            value.store(row, part);
        }
        Response::returned(V::splat(1.0) - back.share)
    }
}
