//! Beyond one run: what it did not need, what a knob costs and gains, combinations of values, many ranks.

pub mod advice;
pub mod scale;
pub mod sweep;
pub mod trade;
