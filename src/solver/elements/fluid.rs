//! What elements of fluids share in the plane and in space: how strongly hourglass modes are slowed and closing corners are held,
//! and how far a volume may change in a step.

use crate::lanes::{Lanes, Row};

/// Part α by which an hourglass mode is slowed in a stable step of its element.
pub const SLOWED: f64 = 0.9;

/// A volume may grow, and shrink, by this part of itself in a step.
const LARGEST_GROWTH: f64 = 0.1;
const LARGEST_SHRINKAGE: f64 = 0.2;

/// A corner is held when its Jacobian is below this part of the volume.
pub const CLOSE: f64 = 0.3;

/// Strength of the brake on a closing corner, and of what brings one back, at a Jacobian of zero. They are those of an
/// element alone; its neighbours make nodes eight times as heavy.
pub const BRAKE: f64 = 20.0;
/// See [`BRAKE`].
pub const BACK: f64 = 100.0;

/// By how much the stable step is shortened by them.
const SHORTER: f64 = 12.0;

/// A corner may close by this part of its Jacobian in a step, or of a tenth of the volume where it is less.
const LARGEST_CLOSING: f64 = 0.5;
/// See [`LARGEST_CLOSING`].
pub const LEAST_ROOM: f64 = 0.1;

/// The areas of a corner do not count as less than this part of B:B, that a flat corner is not given a boundless force.
pub const LEAST_REACH: f64 = 0.05;

/// The largest step in which a volume that grows at `rate` times itself does so by no more than it may; `otherwise` where that
/// is smaller, or no number.
#[inline(always)]
pub fn gentle_step<V: Lanes>(rate: V, otherwise: V) -> V {
    let tiny = V::splat(f64::MIN_POSITIVE);
    let growing = V::splat(LARGEST_GROWTH) / rate.max(tiny);
    let shrinking = V::splat(LARGEST_SHRINKAGE) / (-rate).max(tiny);
    // In this order a NaN stays.
    growing.min(shrinking).min(otherwise)
}

/// The stable step of an element whose corners are held with a weight of at most `most`, 0 where none is, while one closes by the part
/// `closing` of its room in a unit of time.
#[inline(always)]
pub fn held_step<V: Lanes>(stable_step: V, most: V, closing: V) -> V {
    let limit = V::splat(LARGEST_CLOSING) / closing.max(V::splat(f64::MIN_POSITIVE));
    let slower = stable_step / (V::splat(1.0) + V::splat(SHORTER) * most);
    // In this order a NaN of the element's own step stays.
    V::select_less(V::splat(0.0), most, limit.min(slower), stable_step)
}

/// Whether a row has a number below the start of the resistance in this part.
#[inline(always)]
pub fn any_close<V: Lanes>(row: &Row, part: usize) -> bool {
    row.0[part * V::COUNT..(part + 1) * V::COUNT].iter().any(|least| *least < CLOSE)
}
