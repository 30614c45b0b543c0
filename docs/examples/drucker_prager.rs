//! DRUCKER PRAGER: elasticity with a strength that grows with the pressure.

use super::elastic::{Hooke, POISSONS_RATIO, YOUNGS_MODULUS};
use super::plastic::compose;
use super::property::STRESS;
use super::{Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Property, Range, Response, StateVariable, Step};
use crate::lanes::{Lanes, Matrix3, Row, Sym3};

parameters! {
    /// Von Mises stress at most c + p tan β at the pressure p; flow without change of volume (Drucker and Prager 1952).
    #[derive(Debug, Clone, PartialEq)]
    pub struct DruckerPrager {
        /// Young's modulus E, force/length².
        pub young: f64 = [YOUNGS_MODULUS],
        /// Poisson's ratio ν.
        pub poisson: f64 = [POISSONS_RATIO],
        /// Strength without pressure c, force/length².
        pub cohesion: f64 = [
            Property::required("COHESION", "c", STRESS, Range::NotNegative, "Von Mises stress at yield without pressure."),
        ],
        /// tan β
        pub friction: f64 = [
            Property::required("FRICTION", "tan(beta)", "-", Range::NotNegative, "Growth of that with the pressure.")
                .or(0.0),
        ],
    }
}

pub(super) static ENTRY: Entry = Entry {
    name: "DRUCKER PRAGER",
    aliases: &[],
    summary: "Strength that grows linearly with the pressure.",
    properties: DruckerPrager::PROPERTIES,
    state: &[StateVariable { name: "EQPS", meaning: "Equivalent plastic strain." }],
    origin: Origin::Ours,
    build: |given| Ok(Law::DruckerPrager(DruckerPrager::read(given)?)),
};

impl DruckerPrager {
    pub(super) fn moduli(&self) -> Moduli {
        Moduli::from_young(self.young, self.poisson)
    }

    pub(super) fn state(&self, stored: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        stored.to_vec()
    }

    pub(super) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        visitor.visit(Cone { law: self, elastic: self.moduli().into() })
    }
}

#[derive(Clone, Copy)]
struct Cone<'a> {
    law: &'a DruckerPrager,
    elastic: Hooke,
}

impl Kernel for Cone<'_> {
    const STATE: &'static [&'static str] = &["EQPS"];
    const HYPOELASTIC: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        // (i) elastic predictor
        let trial = self.elastic.trial(&step.strain, stress);
        let deviator = trial.deviator();
        let mean = trial.trace() * V::splat(1.0 / 3.0);
        // (ii) strength at this pressure; none in tension beyond the tip of the cone
        let strength = (V::splat(self.law.cohesion) - V::splat(self.law.friction) * mean).max(V::splat(0.0));
        // (iii) return at constant pressure
        let von_mises = (V::splat(1.5) * deviator.contract(deviator)).sqrt();
        let factor = V::splat(1.0).min(strength / von_mises.max(V::splat(f64::MIN_POSITIVE)));
        *stress = compose(&deviator, factor, mean);
        let plastic = (V::splat(1.0) - factor) * von_mises * V::splat(1.0 / (1.5 * self.elastic.two_mu));
        (V::load(&state[0], part) + plastic).store(&mut state[0], part);
        Response::returned(factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Squeezed by 0.3 % in volume, then sheared far: p = K 0.003, and √3 τ = c + p tan β.
    #[test]
    fn shear_strength_under_pressure() {
        let law = DruckerPrager { young: 30e9, poisson: 0.2, cohesion: 10e6, friction: 1.5 };
        let cone = Cone { law: &law, elastic: law.moduli().into() };
        let (mut stress, mut state) = (Sym3 { xx: 0.0, yy: 0.0, zz: 0.0, xy: 0.0, yz: 0.0, zx: 0.0 }, [Row::default()]);
        for strain in [[-1e-3, -1e-3, -1e-3, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.02, 0.0, 0.0]] {
            cone.update::<f64>(&Step::of(strain), &mut stress, &mut state, 0);
        }
        let pressure = 30e9 / (3.0 * 0.6) * 3e-3;
        assert!((3f64.sqrt() * stress.xy - (10e6 + 1.5 * pressure)).abs() < 1.0, "{stress:?}");
        assert!((stress.xx + pressure).abs() < 1.0);
    }
}
