//! Any three-dimensional law in uniaxial stress: the strain across is found such that the stress across vanishes.

use crate::lanes::{Lanes, Sym3};
use crate::material::{Kernel, Moduli, Response, Step};

/// State variables of a law at most.
const MOST: usize = 32;

/// Calls of the law per step. The first takes Poisson's contraction, the second corrects it by what radial return leaves, the others
/// are secant steps; what is left across is corrected in the next step.
const CALLS: usize = 4;

/// What the law answers to a step along the bar.
pub struct Answer<V> {
    /// Stress along the bar, force/length².
    pub along: V,
    /// What is left of the stress across.
    pub across: V,
    /// Increment of the strain across.
    pub lateral: V,
    /// What the law says of its step.
    pub response: Response<V>,
}

/// Advances the law by a strain increment `along` with the stress across held at zero, from the stress `old` along and what is left
/// across. The stretches are those along the bar at the end of the step and across it before, `time` and time step are of the step,
/// `law_state` begins with the law's own rows.
#[inline(always)]
pub fn update<V: Lanes, K: Kernel>(
    law: &K,
    moduli: Moduli,
    [along, stretch_along, stretch_across]: [V; 3],
    old: [V; 2],
    [time, time_step]: [f64; 2],
    law_state: &mut [V::Row],
    part: usize,
) -> Answer<V> {
    let (zero, two) = (V::splat(0.0), V::splat(2.0));
    const { assert!(K::STATE.len() <= MOST, "a law with more state variables than are put back between calls") }
    let mut saved = [zero; MOST];
    for (saved, row) in saved.iter_mut().zip(law_state.iter()) {
        *saved = V::load(row, part);
    }
    // Derivative of the stress across by the strain across, both ways at once: 2λ + 2μ while elastic.
    let elastic = V::splat(2.0 * moduli.lambda + moduli.two_mu);
    let bulk = V::splat(2.0 * moduli.bulk());
    let mut lateral = along * V::splat(-moduli.poisson()) - old[1] / elastic;
    let (mut before, mut across) = ([zero; 2], zero);
    let mut answer = None;
    for call in 0..CALLS {
        for (saved, row) in saved.iter().zip(law_state.iter_mut()) {
            saved.store(row, part);
        }
        let wide = stretch_across * (V::splat(1.0) + lateral);
        let step = Step {
            strain: Sym3 { xx: along, yy: lateral, zz: lateral, xy: zero, yz: zero, zx: zero },
            biot_strain: Sym3 { xx: stretch_along, yy: wide, zz: wide, xy: zero, yz: zero, zx: zero }
                .add_diagonal(V::splat(-1.0)),
            volume: stretch_along * wide * wide,
            middle_volume: stretch_along * wide * wide,
            energy: zero,
            swept: zero,
            time,
            time_step,
        };
        let mut stress = Sym3 { xx: old[0], yy: old[1], zz: old[1], xy: zero, yz: zero, zx: zero };
        let response = law.update(&step, &mut stress, law_state, part);
        across = (stress.yy + stress.zz) / two;
        answer = Some((stress.xx, lateral, response));
        if call + 1 == CALLS {
            break;
        }
        let returned = bulk + (elastic - bulk) * response.returned;
        let [last_lateral, last_across] = before;
        before = [lateral, across];
        let last_step = lateral - last_lateral;
        // Where nothing has moved there is no secant.
        let moved = V::select_less(last_step * last_step, V::splat(V::TINY), V::splat(1.0), last_step);
        let secant = ((across - last_across) / moved).max(bulk * V::splat(0.9)).min(elastic);
        let slope = if call == 0 {
            returned
        } else {
            V::select_less(last_step * last_step, V::splat(V::TINY), elastic, secant)
        };
        lateral = lateral - across / slope;
    }
    let nothing = (old[0], zero, Response::returned(V::splat(1.0)));
    let (along, lateral, response) = answer.unwrap_or(nothing);
    Answer { along, across, lateral, response }
}
