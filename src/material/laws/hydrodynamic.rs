//! HYDRODYNAMIC: pressure from an equation of state and no strength; explosives with programmed burn.

use super::equation_of_state::{DetonationPoint, EquationOfState};
use super::property::STRESS;
use super::{
    CORNERS, END_POWER, Entry, Kernel, KernelVisitor, Law, Moduli, Origin, Property, Range, Response, Start,
    StateVariable, Step, Stiffness, VOLUME_RATE,
};
use crate::lanes::{Lanes, Matrix3, Sym3};
use std::sync::Arc;

/// Pressure cutoff, for every law with an equation of state. Decks write it with either sign.
pub(super) const PRESSURE_CUTOFF: Property = Property::required(
    "PRESSURE CUTOFF",
    "pc",
    STRESS,
    Range::Any,
    "Largest tension that the material bears, with either sign.",
);

parameters! {
    /// A fluid.
    #[derive(Debug, Clone, PartialEq)]
    pub struct Hydrodynamic {
        /// Largest tension that it bears, as a positive number, force/length².
        pub tension: f64 = [PRESSURE_CUTOFF],
    }
    with(given) {
        /// Its equation of state.
        pub equation: EquationOfState = given.equation_of_state()?,
        /// Where it is lit, if it is an explosive.
        pub points: Arc<[DetonationPoint]> = given.detonation.into(),
    }
}

pub(super) static ENTRY: Entry = Entry {
    name: "HYDRODYNAMIC",
    aliases: &["HYDRO"],
    summary: "Fluid, gas or explosive: pressure from an EQUATION OF STATE, no strength.",
    properties: Hydrodynamic::PROPERTIES,
    state: &[
        StateVariable { name: "BURN", meaning: "Part of an explosive that has burnt; 0 in other materials." },
        StateVariable { name: "LIGHTING", meaning: "Time at which an explosive begins to burn; 0 in others." },
    ],
    origin: Origin::Recalled,
    build: |given| {
        let law = Hydrodynamic::read(given)?;
        Ok(Law::Hydrodynamic(Hydrodynamic { tension: law.tension.abs(), ..law }))
    },
};

impl Hydrodynamic {
    pub(super) fn moduli(&self) -> Moduli {
        Moduli { lambda: self.equation.initial().bulk, two_mu: 0.0 }
    }

    pub(super) fn state(&self, stored: &[f64], _: &Matrix3<f64>) -> Vec<f64> {
        match stored {
            [lighting, _, burnt, ..] if stored.len() == EXPLOSIVE.len() => vec![*burnt, *lighting],
            _ => vec![0.0; 2],
        }
    }

    pub(super) fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output {
        let fluid = Fluid { equation: &self.equation, lowest: -self.tension };
        match &self.equation {
            EquationOfState::Jwl(jwl) => {
                visitor.visit(Explosive { fluid, points: &self.points, velocity: jwl.velocity, width: jwl.width })
            }
            _ => visitor.visit(fluid),
        }
    }
}

/// Part of an element that may burn in a step. Products that come at once push back what is not yet lit, and the pressure behind the front
/// overshoots: in flat elements, whose step is a longer part of their length, by half and more.
const LARGEST_BURN: f64 = 0.15;

/// What all fluids store.
const FLUID: &[&str] = {
    let [a, b, c, d, e, f, g, h, least] = CORNERS;
    &[VOLUME_RATE, a, b, c, d, e, f, g, h, least, END_POWER]
};

/// What explosives store.
const EXPLOSIVE: &[&str] = {
    let [a, b, c, d, e, f, g, h, least] = CORNERS;
    &["LIGHTING", "BURNRATE", "BURN", VOLUME_RATE, a, b, c, d, e, f, g, h, least, END_POWER]
};

/// What fluids share.
#[derive(Clone, Copy)]
struct Fluid<'a> {
    equation: &'a EquationOfState,
    /// Lowest pressure.
    lowest: f64,
}

impl Fluid<'_> {
    #[inline(always)]
    fn advance<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, burnt: V) -> Response<V> {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let state = self.equation.advance(step, zero, burnt);
        // In this order a NaN passes.
        let pressure = V::splat(self.lowest).max(state.pressure);
        let mean = -pressure;
        *stress = Sym3 { xx: mean, yy: mean, zz: mean, xy: zero, yz: zero, zx: zero };
        Response::stiff(one, Stiffness { dilatational: state.bulk, shear: zero })
    }
}

impl Kernel for Fluid<'_> {
    const STATE: &'static [&'static str] = FLUID;
    const EQUATION: bool = true;
    const VOLUME: bool = true;
    const STIFFNESS: bool = true;
    const FLUID: bool = true;

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, _: &mut [V::Row], _: usize) -> Response<V> {
        self.advance(step, stress, V::splat(1.0))
    }
}

/// Programmed burn: the front leaves the detonation points at time and speed given, and passes through an element while
/// the burnt part F grows linearly, over `width` times its size h: F = (t − t_l) D/(width h), p = F p(v, E).
#[derive(Clone, Copy)]
struct Explosive<'a> {
    fluid: Fluid<'a>,
    points: &'a [DetonationPoint],
    velocity: f64,
    width: f64,
}

impl Kernel for Explosive<'_> {
    const STATE: &'static [&'static str] = EXPLOSIVE;
    const EQUATION: bool = true;
    const VOLUME: bool = true;
    const STIFFNESS: bool = true;
    const FLUID: bool = true;

    fn start(&self, element: &Start, state: &mut [f64]) {
        let lit = |point: &DetonationPoint| point.reaches(element.centre, self.velocity);
        let first = self.points.iter().map(lit).fold(f64::INFINITY, f64::min);
        let rate = self.velocity / (self.width * element.length);
        // Without a point all of it has burnt when the run begins.
        let values = if first.is_finite() { [first, rate, 0.0] } else { [0.0, rate, 1.0] };
        state[..3].copy_from_slice(&values);
    }

    #[inline(always)]
    fn longest_step<V: Lanes>(&self, time: f64, state: &[V::Row], part: usize, otherwise: V) -> V {
        let [lighting, rate, burnt] = [0, 1, 2].map(|row| V::load(&state[row], part));
        let (zero, bound) = (V::splat(0.0), V::splat(LARGEST_BURN) / rate);
        let to_come = lighting - V::splat(time) - bound;
        // In this order a NaN stays.
        let burning = V::select_less(to_come, zero, bound.min(otherwise), otherwise);
        V::select_less(burnt, V::splat(1.0), burning, otherwise)
    }

    #[inline(always)]
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V> {
        let [lighting, rate] = [V::load(&state[0], part), V::load(&state[1], part)];
        let burning = (V::splat(step.time) - lighting) * rate;
        let burnt = V::load(&state[2], part).max(burning).min(V::splat(1.0));
        burnt.store(&mut state[2], part);
        self.fluid.advance(step, stress, burnt)
    }
}
