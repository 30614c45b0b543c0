//! What a law has answered an element with one point, and the moduli that follow from it.

use super::step_modulus::step_modulus;
use crate::lanes::{Lanes, Sym3};
use crate::material::{Kernel, Response};

/// What a law has answered.
pub struct Answer<V> {
    /// Stress at the start of the step, in the frame.
    pub old: Sym3<V>,
    /// The same at its end.
    pub stress: Sym3<V>,
    /// Return and stiffness.
    pub response: Response<V>,
}

/// Moduli of the stable step, force/length².
pub struct Moduli<V> {
    /// The dilatational one.
    pub elastic: V,
    /// The shear modulus.
    pub shear: V,
    /// The dilatational one by which the step goes.
    pub step: V,
}

impl<V: Lanes> Answer<V> {
    /// Work of the mean stress on a strain increment, per volume.
    #[inline(always)]
    pub fn work_on(&self, strain: Sym3<V>) -> V {
        self.old.zip(self.stress, |a, b| a + b).contract(strain) * V::splat(0.5)
    }

    /// Those that the law tells; of one that tells none the elastic ones, dilatational and shear, with the step by
    /// [`step_modulus`] where it may follow the `effective` one.
    #[inline(always)]
    pub fn moduli<K: Kernel>(&self, strain: &Sym3<V>, [dilatational, mu]: [f64; 2], effective: bool) -> Moduli<V> {
        if K::STIFFNESS {
            let stiffness = &self.response.stiffness;
            return Moduli { elastic: stiffness.dilatational, shear: stiffness.shear, step: stiffness.dilatational };
        }
        let step = step_modulus([dilatational, mu], effective, [&self.old, &self.stress], strain);
        Moduli { elastic: V::splat(dilatational), shear: V::splat(mu), step }
    }
}
