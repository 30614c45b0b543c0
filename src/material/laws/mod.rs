//! The laws. A law is one file, here or in a room of its kind, and one line in [`laws!`](self) below.

// Law files take from this room all that a law is made of: the one of `adding` then fits a list of its own as well.
use super::*;

mod crushable;
mod elastic;
mod ep_hydrodynamic;
mod hydrodynamic;
mod metals;
mod mooney_rivlin;
#[cfg(test)]
mod tests;

use crushable::{low_density_foam, orthotropic_crush, soil};
use metals::{elastic_plastic, johnson_cook, piecewise_plastic, plastic, power_hardening, viscoplastic};

pub use elastic::Elastic;
pub use elastic_plastic::ElasticPlastic;
pub use ep_hydrodynamic::ElasticPlasticHydrodynamic;
pub use hydrodynamic::Hydrodynamic;
pub use johnson_cook::JohnsonCook;
pub use low_density_foam::LowDensityFoam;
pub use mooney_rivlin::MooneyRivlin;
pub use orthotropic_crush::OrthotropicCrush;
pub use piecewise_plastic::PiecewisePlastic;
pub use power_hardening::PowerHardening;
pub use soil::Soil;
pub use viscoplastic::Viscoplastic;

macro_rules! laws {
    ($($module:ident :: $law:ident),+ $(,)?) => {
        /// Any constitutive law with its parameters.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Law { $(#[doc = stringify!($law)] $law($law),)+ }

        /// Every law there is.
        pub static MATERIALS: &[&Entry] = &[$(&$module::ENTRY),+];

        impl Law {
            /// The table entry of this law.
            pub fn entry(&self) -> &'static Entry { match self { $(Law::$law(_) => &$module::ENTRY,)+ } }
            /// Elastic constants at the start: Lamé's λ and 2μ.
            pub fn moduli(&self) -> Moduli { match self { $(Law::$law(law) => law.moduli(),)+ } }
            /// State variables as PLOT STATE names them, in the entry's order, from the stored ones; tensors are
            /// turned from the element's frame (columns are its axes) into space.
            pub fn state(&self, stored: &[f64], frame: &Matrix3<f64>) -> Vec<f64> { match self { $(Law::$law(law) => law.state(stored, frame),)+ } }
            /// Hands the law's kernel to a visitor; a law with several kernels picks the cheapest that serves.
            pub fn accept<K: KernelVisitor>(&self, visitor: K) -> K::Output { match self { $(Law::$law(law) => law.accept(visitor),)+ } }
            /// Stored state of an element before the first step, one value per name of the kernel's.
            pub fn start(&self, element: &Start) -> Vec<f64> { self.accept(Starting(element)) }
            /// Parameter values in the order of the entry's properties.
            pub fn values(&self) -> Vec<f64> { match self { $(Law::$law(law) => law.values(),)+ } }
        }
    };
}

laws! {
    elastic::Elastic,
    elastic_plastic::ElasticPlastic,
    power_hardening::PowerHardening,
    viscoplastic::Viscoplastic,
    piecewise_plastic::PiecewisePlastic,
    johnson_cook::JohnsonCook,
    hydrodynamic::Hydrodynamic,
    ep_hydrodynamic::ElasticPlasticHydrodynamic,
    soil::Soil,
    low_density_foam::LowDensityFoam,
    orthotropic_crush::OrthotropicCrush,
    mooney_rivlin::MooneyRivlin,
}

// Here, because the list of laws that it makes needs the macro above.
#[cfg(test)]
mod adding;

impl Law {
    /// Whether hourglass resistance heats the material: see [`Kernel::FLUID`].
    pub fn is_fluid(&self) -> bool {
        matches!(self, Law::Hydrodynamic(_))
    }

    /// Moduli of a law whose six stresses do not know of each other at the start, along the axes of space: EX, EY, EZ, GXY, GYZ, GZX.
    pub fn uncoupled(&self) -> Option<[f64; 6]> {
        match self {
            Law::OrthotropicCrush(law) => Some(law.moduli),
            _ => None,
        }
    }

    /// The equation of state of a law that has one.
    pub fn equation_of_state(&self) -> Option<&EquationOfState> {
        match self {
            Law::Hydrodynamic(law) => Some(&law.equation),
            Law::ElasticPlasticHydrodynamic(law) => Some(&law.equation),
            _ => None,
        }
    }

    /// The compression 1 − V/V₀ beyond which the data of a crushable law tell nothing of how the material stiffens, if there is such.
    pub fn end_of_data(&self) -> Option<f64> {
        match self {
            Law::LowDensityFoam(law) => Some(1.0 - law.solid).filter(|end| *end < 1.0),
            Law::Soil(law) => law.end_of_data(),
            _ => None,
        }
    }
}

struct Starting<'a>(&'a Start);

impl KernelVisitor for Starting<'_> {
    type Output = Vec<f64>;
    fn visit<K: Kernel>(self, kernel: K) -> Vec<f64> {
        let mut state = vec![0.0; K::STATE.len()];
        kernel.start(self.0, &mut state);
        state
    }
}
