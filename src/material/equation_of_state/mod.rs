//! Equations of state: pressure from relative volume v = V/V₀ and internal energy E per initial volume.
//!
//! All of them are linear in the energy, p = a(v) + b(v) E, so that the energy equation of a step is solved in closed
//! form. An equation is one file here and one line in `equations!` below.

use super::{Entry, Refusal, Step};
use crate::lanes::Lanes;

mod ideal_gas;
mod jwl;
mod mie_gruneisen;
#[cfg(test)]
mod tests;

pub use ideal_gas::IdealGas;
pub use jwl::Jwl;
pub use mie_gruneisen::{PowerSeries, UsUp};

/// p = a(v) + b(v) E with the derivatives of a and b by v.
#[derive(Debug, Clone, Copy)]
pub(super) struct Terms<V> {
    pub a: V,
    pub b: V,
    pub a_slope: V,
    pub b_slope: V,
}

macro_rules! equations {
    ($($module:ident :: $equation:ident = $entry:ident),+ $(,)?) => {
        /// Any equation of state with its parameters.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum EquationOfState { $(#[doc = stringify!($equation)] $equation($equation),)+ }

        /// Every equation of state there is.
        pub static EQUATIONS_OF_STATE: &[&Entry<EquationOfState>] = &[$(&$module::$entry),+];

        impl EquationOfState {
            /// The table entry of this equation.
            pub fn entry(&self) -> &'static Entry<EquationOfState> {
                match self { $(EquationOfState::$equation(_) => &$module::$entry,)+ }
            }
            /// Parameter values in the order of the entry's properties.
            pub fn values(&self) -> Vec<f64> {
                match self { $(EquationOfState::$equation(equation) => equation.values(),)+ }
            }
            /// Internal energy per initial volume at the start.
            pub fn initial_energy(&self) -> f64 {
                match self { $(EquationOfState::$equation(equation) => equation.initial_energy,)+ }
            }
            #[inline(always)]
            pub(super) fn terms<V: Lanes>(&self, volume: V) -> Terms<V> {
                match self { $(EquationOfState::$equation(equation) => equation.terms(volume),)+ }
            }
        }
    };
}

equations! {
    mie_gruneisen::UsUp = US_UP,
    mie_gruneisen::PowerSeries = POWER_SERIES,
    jwl::Jwl = ENTRY,
    ideal_gas::IdealGas = ENTRY,
}

/// Pressure and isentropic bulk modulus −v dp/dv of a state.
#[derive(Debug, Clone, Copy)]
pub(super) struct State<V> {
    pub pressure: V,
    pub bulk: V,
}

impl EquationOfState {
    /// Pressure and bulk modulus at relative volume v and energy E per initial volume.
    #[inline(always)]
    pub(super) fn state<V: Lanes>(&self, volume: V, energy: V) -> State<V> {
        let Terms { a, b, a_slope, b_slope } = self.terms(volume);
        let pressure = a + b * energy;
        // Along an isentrope dE = −p dv.
        State { pressure, bulk: volume * (pressure * b - a_slope - b_slope * energy) }
    }

    /// The compression 1 − V/V₀ beyond which the pressure is no longer that of the formula but its tangent there, if there is such.
    pub fn end_of_formula(&self) -> Option<f64> {
        match self {
            EquationOfState::UsUp(equation) => Some(equation.end()).filter(|end| *end < 1.0),
            _ => None,
        }
    }

    /// Pressure and bulk modulus of the initial state.
    pub(super) fn initial(&self) -> State<f64> {
        self.state(1.0, self.initial_energy())
    }

    /// State at the end of a step. `deviatoric` is the work of the deviatoric stress at the end of the step, per initial volume;
    /// `burnt` the part of the pressure that acts.
    ///
    /// The energy is the one that the element books: E' = E + deviatoric − ½ p' Δv with the E and Δv of the step, into which
    /// p' = burnt (a + b E') is put. The work of viscosities at the end of the step counts in E as it was at its start; what is
    /// missing comes with the next step.
    #[inline(always)]
    pub(super) fn advance<V: Lanes>(&self, step: &Step<V>, deviatoric: V, burnt: V) -> State<V> {
        let (half, one) = (V::splat(0.5), V::splat(1.0));
        let energy = V::splat(self.initial_energy()) + step.energy + deviatoric;
        let Terms { a, b, a_slope, b_slope } = self.terms(step.volume);
        let divisor = (one + half * burnt * b * step.swept).max(V::splat(0.1));
        let pressure = burnt * (a + b * energy) / divisor;
        let energy = energy - half * pressure * step.swept;
        let full = a + b * energy;
        let bulk = step.volume * (full * b - a_slope - b_slope * energy);
        // Where the equation has no stiffness left there still has to be a time step.
        let floor = V::splat(SOFTEST * self.initial().bulk);
        State { pressure, bulk: floor.max(bulk) }
    }
}

/// The bulk modulus is not below this part of the initial one.
const SOFTEST: f64 = 1e-4;

/// Where and when an explosive is lit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DetonationPoint {
    /// Its place.
    pub position: [f64; 3],
    /// The time.
    pub time: f64,
}

impl DetonationPoint {
    /// When a front from here at this speed reaches a place.
    pub fn reaches(&self, place: [f64; 3], velocity: f64) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|i| place[i] - self.position[i]);
        self.time + (x * x + y * y + z * z).sqrt() / velocity
    }
}

/// Refuses equations whose initial state has no stiffness.
fn stiff(equation: EquationOfState, keyword: &'static str) -> Result<EquationOfState, Refusal> {
    let bulk = equation.initial().bulk;
    if bulk > 0.0 {
        return Ok(equation);
    }
    let reason = format!("makes the initial bulk modulus {bulk:e}, which must be positive");
    Err(Refusal { keyword, reason })
}
