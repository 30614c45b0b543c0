//! Writing parts of the rows in which elements keep their state.

use crate::lanes::Lanes;

/// Writes consecutive rows.
#[inline(always)]
pub fn store<V: Lanes, const N: usize>(values: [V; N], state: &mut [V::Row], first: usize, part: usize) {
    let rows = &mut state[first..first + N];
    for i in 0..N {
        values[i].store(&mut rows[i], part);
    }
}

/// Adds to a row.
#[inline(always)]
pub fn accumulate<V: Lanes>(value: V, row: &mut V::Row, part: usize) {
    (V::load(row, part) + value).store(row, part);
}

/// Adds to the first of two rows in single precision; the second keeps what the first cannot hold (Kahan 1965).
#[inline(always)]
pub fn accumulate_carried<V: Lanes>(value: V, [own, behind]: [usize; 2], state: &mut [V::Row], part: usize) {
    let (sum, carried) = carried_sum(V::load(&state[own], part), value, V::load(&state[behind], part));
    sum.store(&mut state[own], part);
    carried.store(&mut state[behind], part);
}

/// The sum of a number and what is to be added to it with what was lost before, and what is lost now.
#[inline(always)]
pub fn carried_sum<V: Lanes>(number: V, addition: V, carried: V) -> (V, V) {
    let addition = addition + carried;
    let sum = number + addition;
    (sum, addition - (sum - number))
}
