//! Constitutive laws. A law is one file here and one line in [`laws!`](self) below; the deck parser, the manual,
//! plot names and the solver's dispatch follow from its tables.

use crate::lanes::{Lanes, Matrix3, Row, Sym3};

mod elastic;
mod elastic_plastic;
mod property;
#[cfg(test)]
mod tests;

pub use elastic::Elastic;
pub use elastic_plastic::ElasticPlastic;
pub use property::{Origin, Property, Range, Refusal, StateVariable};

/// Everything the deck, the manual and the plot file need to know of a law.
pub struct Entry {
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
    /// Makes the law from its parameter values, in the order of `properties`.
    pub build: fn(&[f64]) -> Result<Law, Refusal>,
}

macro_rules! laws {
    ($($module:ident :: $law:ident),+ $(,)?) => {
        /// Any constitutive law with its parameters.
        #[derive(Debug, Clone, Copy, PartialEq)]
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
            /// Parameter values in the order of the entry's properties.
            pub fn values(&self) -> Vec<f64> { match self { $(Law::$law(law) => law.values(),)+ } }
        }
    };
}

laws! { elastic::Elastic, elastic_plastic::ElasticPlastic }

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

    /// Dilatational modulus λ + 2μ.
    pub fn dilatational(self) -> f64 {
        self.lambda + self.two_mu
    }

    /// Poisson's ratio.
    pub fn poisson(self) -> f64 {
        self.lambda / (2.0 * self.lambda + self.two_mu)
    }
}

/// A law as the element kernel sees it: one material point per lane, in a frame that turns with the material.
///
/// An implementation is compiled into the element loop of its own, so nothing here costs a call.
pub trait Kernel: Copy + Send + Sync {
    /// Names of the stored state variables, one row of eight numbers each per chunk of elements. All start at zero.
    const STATE: &'static [&'static str];

    /// Advances `stress` (force/length²) by the strain increment `strain` = Δt d, both in the unrotated frame, and
    /// the state rows of this part of the chunk with it.
    fn update<V: Lanes>(&self, strain: &Sym3<V>, stress: &mut Sym3<V>, state: &mut [Row], part: usize) -> Response<V>;
}

/// What a law tells the element about its step.
pub struct Response<V> {
    /// Factor by which plastic return scaled the trial deviatoric stress, 1 where the step was elastic.
    pub returned: V,
}

/// Something to be done with the kernel of a law; [`Law::accept`] calls it with the concrete type.
pub trait KernelVisitor {
    /// What it gives back.
    type Output;
    /// Does it.
    fn visit<K: Kernel>(self, kernel: K) -> Self::Output;
}
