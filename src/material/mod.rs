//! Constitutive laws: here what a law is, and what it is told and answers; each law is one file in the room `laws`. The deck
//! parser, the manual, plot names and the solver's dispatch follow from their tables.

use crate::lanes::{Lanes, Matrix3, Sym3};

#[macro_use]
mod parameters;

mod equation_of_state;
mod laws;
#[cfg(test)]
mod point;
mod property;
pub mod response;

pub use crate::common::vocabulary::{Description, Models, Origin, Property, Range, StateVariable};
pub use equation_of_state::{DetonationPoint, EQUATIONS_OF_STATE, EquationOfState, IdealGas, Jwl, PowerSeries, UsUp};
pub use laws::{
    Elastic, ElasticPlastic, ElasticPlasticHydrodynamic, Hydrodynamic, JohnsonCook, Law, LowDensityFoam, MATERIALS,
    MooneyRivlin, OrthotropicCrush, PiecewisePlastic, PowerHardening, Soil, Viscoplastic,
};
pub use property::{Caution, Curve, Given, Refusal};

/// Everything the deck, the manual and the plot file need to know of a law, or of another thing with properties.
pub struct Entry<T = Law> {
    /// Name as spelled in the deck, e.g. `ELASTIC PLASTIC`.
    pub name: &'static str,
    /// Other spellings that are understood.
    pub aliases: &'static [&'static str],
    /// One sentence for the manual.
    pub summary: &'static str,
    /// Its parameters in the order the print log lists them.
    pub properties: &'static [Property],
    /// Its state variables as PLOT STATE names them.
    pub state: &'static [StateVariable],
    /// Where the deck form comes from.
    pub origin: Origin,
    /// Makes the law from its parameter values, in the order of `properties`, and whatever else the deck gives it.
    pub build: fn(&Given) -> Result<T, Refusal>,
}

impl<T> Entry<T> {
    /// What there is to tell of it.
    pub fn description(&self) -> Description {
        let Entry { name, aliases, summary, properties, state, origin, .. } = *self;
        Description { name, aliases, summary, properties, state, origin }
    }
}

/// Laws and equations of state, as messages, manual and `urto explain` tell of them.
pub fn models() -> [Models; 2] {
    let laws = Models {
        command: "MATERIAL",
        heading: "material models",
        form: ["MATERIAL, block, ", ", density"],
        see: "MATERIAL, PLOT STATE",
        models: MATERIALS.iter().map(|law| law.description()).collect(),
    };
    let equations = Models {
        command: "EQUATION OF STATE",
        heading: "equations of state",
        form: ["EQUATION OF STATE, block, ", ""],
        see: "EQUATION OF STATE",
        models: EQUATIONS_OF_STATE.iter().map(|equation| equation.description()).collect(),
    };
    [laws, equations]
}

/// Isotropic elastic constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moduli {
    /// Lamé's first constant λ, force/length².
    pub lambda: f64,
    /// Twice the shear modulus 2μ, force/length².
    pub two_mu: f64,
}

impl Moduli {
    /// From Young's modulus E and Poisson's ratio ν.
    pub fn from_young(young: f64, poisson: f64) -> Moduli {
        let two_mu = young / (1.0 + poisson);
        Moduli { lambda: two_mu * poisson / (1.0 - 2.0 * poisson), two_mu }
    }

    /// From the bulk modulus K and twice the shear modulus 2μ: λ = K − 2μ/3.
    pub fn from_bulk(bulk: f64, two_mu: f64) -> Moduli {
        Moduli { lambda: bulk - two_mu / 3.0, two_mu }
    }

    /// Bulk modulus K = λ + 2μ/3.
    pub fn bulk(self) -> f64 {
        self.lambda + self.two_mu / 3.0
    }

    /// Dilatational modulus λ + 2μ.
    pub fn dilatational(self) -> f64 {
        self.lambda + self.two_mu
    }

    /// Poisson's ratio.
    pub fn poisson(self) -> f64 {
        self.lambda / (2.0 * self.lambda + self.two_mu)
    }
}

/// An element as a law may look at it before the first step.
#[derive(Debug, Clone, Copy)]
pub struct Start {
    /// Mean of its corners.
    pub centre: [f64; 3],
    /// Its length: the cube root of its volume, in the plane and of shells the root of its area, of bars how long they are.
    pub length: f64,
    /// Its frame; columns are its axes.
    pub frame: Matrix3<f64>,
}

/// What happened to a material point in a step. A law that does not look at a quantity does not pay for it.
#[derive(Debug, Clone, Copy)]
pub struct Step<V> {
    /// Strain increment Δt d, seen in the frame.
    pub strain: Sym3<V>,
    /// Biot strain U − I of the right stretch U at the end of the step, seen in the frame: without the one a small strain has all digits.
    pub biot_strain: Sym3<V>,
    /// V/V₀ at the end of the step; 1 for laws without [`Kernel::VOLUME`].
    pub volume: V,
    /// V/V₀ in the middle of the step.
    pub middle_volume: V,
    /// For laws with [`Kernel::EQUATION`]: what has been done on the material since the start, per initial volume, but for the
    /// work of the stress at the end of the step. With [`Kernel::FLUID`] hourglass resistance counts, too.
    pub energy: V,
    /// Volume over the initial one that the element sweeps at its speed at the end of the step, Δt v·B/V₀: against pressure p'
    /// there it does the work ½ p' `swept`.
    pub swept: V,
    /// Time at the end of the step.
    pub time: f64,
    /// Δt; zero in the evaluation of the initial state.
    pub time_step: f64,
}

/// What V/V₀ may be off by in single precision, as it is made of rounded positions: some last digits of one.
const ROUNDED_VOLUME: f64 = 4.0 * f32::EPSILON as f64;

impl<V: Lanes> Step<V> {
    /// J − 1, the change of volume over the initial volume.
    ///
    /// V/V₀ − 1 has no more digits than V/V₀, which is few in single precision. There det U − 1 has those of the strain; but U is
    /// integrated, and V/V₀ is not. So what they differ by counts where it is more than V/V₀ may be off by.
    #[inline(always)]
    pub fn dilatation(&self) -> V {
        let of_volume = self.volume - V::splat(1.0);
        if !V::SINGLE {
            return of_volume;
        }
        let of_stretch = self.biot_strain.volume_change();
        let difference = of_volume - of_stretch;
        let rounding = difference.max(V::splat(-ROUNDED_VOLUME)).min(V::splat(ROUNDED_VOLUME));
        of_stretch + (difference - rounding)
    }
}

/// Stored by laws with [`Kernel::EQUATION`], as the last of their rows: power of the corner forces at the end of the step, with
/// the velocities of its middle.
pub const END_POWER: &str = "ENDPOWER";

/// Stored by laws with [`Kernel::FLUID`] before that: forces that keep the element's corners from turning inside out, one each,
/// and the least Jacobian of them over the volume.
pub const CORNERS: [&str; 9] =
    ["CORNER1", "CORNER2", "CORNER3", "CORNER4", "CORNER5", "CORNER6", "CORNER7", "CORNER8", "LEASTCOR"];

/// Stored by laws with [`Kernel::FLUID`] before these: the rate at which the volume grew in the last step, over it, 1/time.
pub const VOLUME_RATE: &str = "VOLRATE";

/// A law as the element kernel sees it: one material point per lane, in a frame that turns with the material.
///
/// An implementation is compiled into the element loop of its own, so nothing here costs a call.
pub trait Kernel: Copy + Send + Sync {
    /// Names of the stored state variables, one row of eight numbers each per chunk of elements. They start at zero
    /// unless [`Kernel::start`] says otherwise.
    const STATE: &'static [&'static str];

    /// Whether [`Step::volume`] is wanted.
    const VOLUME: bool = false;

    /// Whether [`Response::stiffness`] counts; without, the law's [`Law::moduli`] bound the time step.
    const STIFFNESS: bool = false;

    /// Whether the linear bulk viscosity goes by [`Response::answering`]: for laws that are mostly far softer than the stiffest that
    /// they can become, by which their time step must go.
    const CRUSHES: bool = false;

    /// Whether the pressure follows from an equation of state: the work of the corner forces is booked exactly, and is the
    /// energy in [`Step::energy`]. The last name of [`Kernel::STATE`] is then [`END_POWER`], which the element keeps there.
    const EQUATION: bool = false;

    /// Whether the law is a fluid's: its hourglass modes are resisted by viscosity, whose work is heat in [`Step::energy`].
    const FLUID: bool = false;

    /// Whether strain adds elastic stress, with the law's [`Law::moduli`], to what there is, unless the deviator is returned:
    /// single precision then gives strain again that the stress was too large to take in.
    const HYPOELASTIC: bool = false;

    /// Whether the law is used so much that it is compiled for each hourglass control of its own.
    const FREQUENT: bool = false;

    /// Sets the stored state of an element before the first step.
    fn start(&self, _element: &Start, _state: &mut [f64]) {}

    /// The longest step from a time on in which what the law does by itself goes no farther than it may; of fluids. `otherwise` where that
    /// is less, or no number.
    #[inline(always)]
    fn longest_step<V: Lanes>(&self, _time: f64, _state: &[V::Row], _part: usize, otherwise: V) -> V {
        otherwise
    }

    /// Advances `stress` (force/length²) by a step, in the unrotated frame, and the state rows of this part of the
    /// chunk with it.
    fn update<V: Lanes>(&self, step: &Step<V>, stress: &mut Sym3<V>, state: &mut [V::Row], part: usize) -> Response<V>;
}

/// What a law tells the element about its step.
#[derive(Debug, Clone, Copy)]
pub struct Response<V> {
    /// Factor by which plastic return scaled the trial deviatoric stress, 1 where the step was elastic.
    pub returned: V,
    /// Present stiffness, of laws with [`Kernel::STIFFNESS`].
    pub stiffness: Stiffness<V>,
    /// Modulus with which a law with [`Kernel::CRUSHES`] answers to strain such as that of the step, from 0 on a plateau to the
    /// stiffest that it can be.
    pub answering: V,
}

/// The stiffness of a law that is not constant.
#[derive(Debug, Clone, Copy)]
pub struct Stiffness<V> {
    /// Dilatational modulus λ + 2μ = ρ c², which bounds the time step; positive.
    pub dilatational: V,
    /// Shear modulus by which hourglass modes are resisted; a fluid's are resisted by viscosity instead.
    pub shear: V,
}

impl<V: Lanes> Response<V> {
    /// Of a law with constant stiffness, by the factor of its plastic return.
    #[inline(always)]
    pub fn returned(returned: V) -> Response<V> {
        let none = V::splat(0.0);
        Response { returned, stiffness: Stiffness { dilatational: none, shear: none }, answering: none }
    }

    /// Of a law whose stiffness changes, by that and the factor of its plastic return.
    #[inline(always)]
    pub fn stiff(returned: V, stiffness: Stiffness<V>) -> Response<V> {
        Response { returned, stiffness, answering: V::splat(0.0) }
    }
}

/// Something to be done with the kernel of a law; [`Law::accept`] calls it with the concrete type.
pub trait KernelVisitor {
    /// What it gives back.
    type Output;
    /// Does it.
    fn visit<K: Kernel>(self, kernel: K) -> Self::Output;
}
