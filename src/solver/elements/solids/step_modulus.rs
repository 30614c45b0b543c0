//! The modulus that the stable step of solid elements goes by.

use crate::lanes::{Lanes, Sym3};

/// Dilatational modulus for the stable step, force/length²: the elastic one, or where it may be `effective` PRONTO's estimate from
/// the last increment, M̂ = K + ⅔ 2μ̂ with the elastic bulk modulus and 2μ̂ = Δs:Δe/Δe:Δe, kept between a tenth and the whole
/// of the elastic one. `stresses` are those before and after the step in the element's frame, `strain` its increment there.
#[inline(always)]
pub fn step_modulus<V: Lanes>(
    [dilatational, mu]: [f64; 2],
    effective: bool,
    [old, new]: [&Sym3<V>; 2],
    strain: &Sym3<V>,
) -> V {
    let elastic = V::splat(dilatational);
    if !effective {
        return elastic;
    }
    let change = new.zip(*old, |a, b| a - b).deviator();
    let e = strain.deviator();
    let square = e.contract(e);
    let two_mu = V::splat(2.0 * mu);
    // In single precision the change of a stress is no better than its last digit, 6e-10 of the modulus at a strain of 0.01.
    let floor = V::either(1e-24, 1e-12);
    let shear = V::select_less(floor, square, change.contract(e) / square.max(floor), two_mu).min(two_mu);
    let bulk = elastic - two_mu * V::splat(2.0 / 3.0);
    (bulk + shear * V::splat(2.0 / 3.0)).min(elastic).max(elastic * V::splat(0.1))
}
