//! Vectors of single precision: the same vocabulary, rows of sixteen.
//!
//! Nodes are in double precision for them too: what is fetched is subtracted there and then rounded.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod portable;
#[cfg(target_arch = "x86_64")]
mod sse2;

#[cfg(target_arch = "x86_64")]
pub(crate) use avx2::F32x8;
#[cfg(target_arch = "x86_64")]
pub(crate) use avx512::F32x16;
#[cfg(target_arch = "x86_64")]
pub(crate) use sse2::F32x4;

/// Bits of the part of a number that is not its exponent.
const MANTISSA_BITS: u32 = 0x007f_ffff;

/// 2²³: from here to its double, numbers are the whole ones, with the number in the last bits.
const WHOLE: f32 = 8_388_608.0;

/// Exponent that stands for 2⁰.
const BIAS: f32 = 127.0;

/// Bits of a number that is kept in the upper half of another.
const UPPER_HALF: u32 = 0xffff_0000;

/// Added before the lower half is cut off, it rounds to the nearest.
const ROUNDING: u32 = 0x8000;
