//! EP HYDRODYNAMIC: pressure from an equation of state, strength of von Mises with linear hardening.

use super::elastic::{POISSONS_RATIO, YOUNGS_MODULUS};
use super::elastic_plastic::{HARDENING_MODULUS, YIELD_STRESS};
use super::equation_of_state::EquationOfState;
use super::hydrodynamic::PRESSURE_CUTOFF;
use super::plastic::{Flow, compose, radial_return};
use super::{
    END_POWER, Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Refusal, Response, StateVariable, Step, Stiffness,
};
use crate::lanes::{Lanes, Matrix3, Sym3};

parameters! {
    /// A solid under high pressure.
    #[derive(Debug, Clone, PartialEq)]
    pub struct ElasticPlasticHydrodynamic {
        /// Young's modulus E, force/length²; with Poisson's ratio it makes the shear modulus.
        pub young: f64 = [YOUNGS_MODULUS],
        /// Poisson's ratio ν.
        pub poisson: f64 = [POISSONS_RATIO],
        /// Initial yield stress in uniaxial tension Y₀, force/length².
        pub yield_stress: f64 = [YIELD_STRESS],
        /// Uniaxial plastic hardening modulus H, force/length².
        pub hardening: f64 = [HARDENING_MODULUS],
        /// Largest tension that it bears, as a positive number, force/length².
        pub tension: f64 = [PRESSURE_CUTOFF],
    }
    with(given) {
        /// Equation of state of the pressure.
        pub equation: EquationOfState = given.equation_of_state()?,
    }
}

pub(super) static ENTRY: Entry = Entry {
    name: "EP HYDRODYNAMIC",
    aliases: &["EP HYDRO", "ELASTIC PLASTIC HYDRODYNAMIC"],
    summary: "Solid with the pressure of an EQUATION OF STATE and the strength of von Mises, hardening linearly.",
    properties: ElasticPlasticHydrodynamic::PROPERTIES,
    state: &[StateVariable { name: "EQPS", meaning: "Equivalent plastic strain." }],
    origin: Origin::Recalled,
    build: |given| {
        let law = ElasticPlasticHydrodynamic::read(given)?;
        if let EquationOfState::Jwl(_) = law.equation {
            let reason = "is for an explosive, which has no strength: make the material HYDRODYNAMIC".to_string();
            return Err(Refusal { keyword: "EQUATION OF STATE", reason });
        }
        let tension = law.tension.abs();
        Ok(Law::ElasticPlasticHydrodynamic(ElasticPlasticHydrodynamic { tension, ..law }))
    },
};

impl ElasticPlasticHydrodynamic {
    /// The bulk modulus of the equation of state, and the shear modulus of E and ν.
    pub(super) fn moduli(&self) -> Moduli {
        let two_mu = Moduli::from_young(self.young, self.poisson).two_mu;
        Moduli::from_bulk(self.equation.initial().bulk, two_mu)
    }

    pub(super) fn state(&self, stored: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        stored[..stored.len().min(1)].to_vec()
    }

    pub(super) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        visitor.visit(Solid { law: self, two_mu: self.moduli().two_mu })
    }
}

/// Y₀ + H ε̄ᵖ
struct Linear<V> {
    start: V,
    slope: V,
}

impl<V: Lanes> Flow<V> for Linear<V> {
    #[inline(always)]
    fn stress(&self, increment: V) -> (V, V) {
        (self.start + self.slope * increment, self.slope)
    }
}

#[derive(Clone, Copy)]
struct Solid<'a> {
    law: &'a ElasticPlasticHydrodynamic,
    two_mu: f64,
}

impl Kernel for Solid<'_> {
    const STATE: &'static [&'static str] = &["EQPS", END_POWER];
    const EQUATION: bool = true;
    const VOLUME: bool = true;
    const STIFFNESS: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        let (law, two_mu) = (self.law, V::splat(self.two_mu));
        // (i) elastic predictor and return of the deviator
        let mean = stress.trace() * V::splat(1.0 / 3.0);
        let old = stress.add_diagonal(-mean);
        let strain = step.strain.deviator();
        let trial = old.zip(strain, |s, e| s + two_mu * e);
        let eqps = V::load(&state[0], part);
        let slope = V::splat(law.hardening);
        let flow = Linear { start: V::splat(law.yield_stress) + slope * eqps, slope };
        let back = radial_return(&trial, 1.5 * self.two_mu, &flow);
        // (ii) pressure, with the deviator's work at the end of the step in the energy
        let new = compose(&trial, back.factor, V::splat(0.0));
        let work = new.contract(strain) * V::splat(0.5) * step.middle_volume;
        let state_after = law.equation.advance(step, work, V::splat(1.0));
        let pressure = V::splat(-law.tension).max(state_after.pressure);
        *stress = new.add_diagonal(-pressure);
        (eqps + back.increment).store(&mut state[0], part);
        let dilatational = state_after.bulk + two_mu * V::splat(2.0 / 3.0);
        let stiffness = Stiffness { dilatational, shear: V::splat(0.5 * self.two_mu) };
        Response::stiff(back.factor, stiffness)
    }
}
