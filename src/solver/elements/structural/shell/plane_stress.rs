//! Any three-dimensional law in plane stress: the strain through the thickness is found such that the stress there vanishes.

use crate::lanes::{Lanes, Sym3};
use crate::material::{Kernel, Moduli, Response, Step};

/// State variables of a law at most.
const MOST: usize = 32;

/// Calls of the law per step at most. The first takes the elastic strain through the thickness, the second corrects it by what
/// radial return leaves, the others are secant steps. In the worst of random stress states and steps of up to half a
/// per cent 5e-6 of the yield stress is left, which the next step corrects.
const CALLS: usize = 4;

/// Stress through the thickness that is as good as none, over the stress that the strain increment could have made.
const ACCURACY: f64 = 1e-10;

/// What the law answers to a step.
pub struct Answer<V> {
    /// Stress; its zz component is what is left through the thickness.
    pub stress: Sym3<V>,
    /// Increment of the strain through the thickness.
    pub normal: V,
    /// What the law says of its step.
    pub response: Response<V>,
}

/// Advances the law by a strain increment, whose zz component is of no account, from a stress whose zz component is what the last
/// step has left. `time` and time step are of the step.
#[inline(always)]
pub fn update<V: Lanes, K: Kernel>(
    law: &K,
    moduli: Moduli,
    strain: Sym3<V>,
    old: Sym3<V>,
    [time, time_step]: [f64; 2],
    state: &mut [V::Row],
    part: usize,
) -> Answer<V> {
    let (zero, one) = (V::splat(0.0), V::splat(1.0));
    const { assert!(K::STATE.len() <= MOST, "a law with more state variables than are put back between calls") }
    let mut saved = [zero; MOST];
    for (saved, row) in saved.iter_mut().zip(state.iter()) {
        *saved = V::load(row, part);
    }
    // dσ_zz/dε_zz while elastic, and of a fluid of the same bulk modulus.
    let elastic = V::splat(moduli.dilatational());
    let bulk = V::splat(moduli.bulk());
    let contraction = V::splat(-moduli.lambda / moduli.dilatational());
    let mut normal = contraction * (strain.xx + strain.yy) - old.zz / elastic;
    let size = strain.xx * strain.xx + strain.yy * strain.yy + strain.xy * strain.xy;
    let shear = strain.yz * strain.yz + strain.zx * strain.zx;
    let small = V::splat(ACCURACY) * ((size + shear).sqrt() * elastic + V::splat(V::TINY));
    let (mut last_normal, mut last_left) = (zero, zero);
    let mut stress = old;
    let mut response = Response::returned(one);
    for call in 0..CALLS {
        for (saved, row) in saved.iter().zip(state.iter_mut()) {
            saved.store(row, part);
        }
        let step = Step {
            strain: Sym3 { zz: normal, ..strain },
            biot_strain: Sym3 { xx: zero, yy: zero, zz: zero, xy: zero, yz: zero, zx: zero },
            volume: one,
            middle_volume: one,
            energy: zero,
            swept: zero,
            time,
            time_step,
        };
        stress = old;
        response = law.update(&step, &mut stress, state, part);
        let left = stress.zz;
        let magnitude = left.max(zero - left);
        // Lanes that are done do the same again, so that no lane depends on its neighbours.
        if call + 1 == CALLS || !V::any_less(small, magnitude) {
            break;
        }
        let returned = bulk + (elastic - bulk) * response.returned;
        let last_step = normal - last_normal;
        let still = last_step * last_step;
        let moved = V::select_less(still, V::splat(V::TINY), one, last_step);
        let secant = ((left - last_left) / moved).max(bulk * V::splat(0.9)).min(elastic);
        let secant = V::select_less(still, V::splat(V::TINY), elastic, secant);
        let slope = if call == 0 { returned } else { secant };
        let correction = V::select_less(small, magnitude, left / slope, zero);
        // A lane that is done keeps what its secant was drawn through.
        last_normal = normal;
        last_left = left;
        normal = normal - correction;
    }
    Answer { stress, normal, response }
}
