//! Writing parts of the rows in which elements keep their state.

use crate::lanes::{Lanes, Row};

/// Writes consecutive rows.
#[inline(always)]
pub fn store<V: Lanes, const N: usize>(values: [V; N], state: &mut [Row], first: usize, part: usize) {
    let rows = &mut state[first..first + N];
    for i in 0..N {
        values[i].store(&mut rows[i], part);
    }
}

/// Adds to a row.
#[inline(always)]
pub fn accumulate<V: Lanes>(value: V, row: &mut Row, part: usize) {
    (V::load(row, part) + value).store(row, part);
}
