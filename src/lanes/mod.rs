//! Many elements at once: the small vector vocabulary in which the element and material kernels are written.
//!
//! A kernel is written once against [`Lanes`]; thin newtypes per instruction set carry it out. Which one runs is
//! decided when the program starts ([`InstructionSet::detect`]). None of them fuses a multiplication with an
//! addition, and division and square root are correctly rounded, so that all give the same bits.

/// An array of 2, 3, 4, 6, 7 or 8 entries, each given by an expression in its index, written out at compile time.
///
/// Kernels use it instead of `std::array::from_fn`, whose closure is compiled without the caller's vector
/// instructions and then stays a call.
macro_rules! array {
    (@at $i:ident $n:literal $entry:expr) => {{ let $i: usize = $n; $entry }};
    ($i:ident in 2 => $entry:expr) => {
        [array!(@at $i 0 $entry), array!(@at $i 1 $entry)]
    };
    ($i:ident in 3 => $entry:expr) => {
        [array!(@at $i 0 $entry), array!(@at $i 1 $entry), array!(@at $i 2 $entry)]
    };
    ($i:ident in 4 => $entry:expr) => {
        [array!(@at $i 0 $entry), array!(@at $i 1 $entry), array!(@at $i 2 $entry), array!(@at $i 3 $entry)]
    };
    ($i:ident in 6 => $entry:expr) => {
        [array!(@at $i 0 $entry), array!(@at $i 1 $entry), array!(@at $i 2 $entry),
         array!(@at $i 3 $entry), array!(@at $i 4 $entry), array!(@at $i 5 $entry)]
    };
    ($i:ident in 7 => $entry:expr) => {
        [array!(@at $i 0 $entry), array!(@at $i 1 $entry), array!(@at $i 2 $entry), array!(@at $i 3 $entry),
         array!(@at $i 4 $entry), array!(@at $i 5 $entry), array!(@at $i 6 $entry)]
    };
    ($i:ident in 8 => $entry:expr) => {
        [array!(@at $i 0 $entry), array!(@at $i 1 $entry), array!(@at $i 2 $entry), array!(@at $i 3 $entry),
         array!(@at $i 4 $entry), array!(@at $i 5 $entry), array!(@at $i 6 $entry), array!(@at $i 7 $entry)]
    };
}

pub(crate) use array;

/// The arithmetic of a register's newtype, lane by lane: intrinsics of the four operations, and of the change of sign.
///
/// SAFETY: values of a newtype are only made where the instructions of its register were found (the file of each says where).
#[cfg(target_arch = "x86_64")]
macro_rules! lane_by_lane {
    ($register:ident: $add:ident, $sub:ident, $mul:ident, $div:ident; sign $xor:ident, $splat:ident) => {
        lane_by_lane!(@binary $register: Add add $add, Sub sub $sub, Mul mul $mul, Div div $div);
        impl std::ops::Neg for $register {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self { Self(unsafe { $xor(self.0, $splat(-0.0)) }) }
        }
    };
    (@binary $register:ident: $($trait:ident $method:ident $intrinsic:ident),+) => { $(
        impl std::ops::$trait for $register {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self { Self(unsafe { $intrinsic(self.0, other.0) }) }
        }
    )+ };
}

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod functions;
mod portable;
mod single;
#[cfg(target_arch = "x86_64")]
mod sse2;
mod tensor;
#[cfg(test)]
mod tests;

pub use functions::{exp, ln, ln_one_plus, power};
pub use portable::Pair;
pub use tensor::{Matrix3, Sym3, multiply, multiply_transposed};

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Elements per chunk. Element data is stored as rows of this many values, one per element; rows of single precision hold the
/// values of two chunks.
pub const CHUNK: usize = 8;

/// Elements of a row at most.
pub const MOST_LANES: usize = 16;

/// Corners of an element at most.
pub const MOST_CORNERS: usize = 8;

/// One quantity of the eight elements of a chunk, or the eight numbers of a node; one cache line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(C, align(64))]
pub struct Row(pub [f64; CHUNK]);

/// One quantity of the sixteen elements of two chunks in single precision; one cache line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(C, align(64))]
pub struct SingleRow(pub [f32; MOST_LANES]);

/// What rows of numbers of either precision have in common.
pub trait Numbers: Copy + Default + Send + Sync {
    /// Numbers in a row: elements that a kernel sees as one chunk.
    const LANES: usize;
    /// The same number for every element, rounded to the precision of the row.
    fn filled(value: f64) -> Self;
    /// The number of an element.
    fn number(&self, lane: usize) -> f64;
    /// Sets the number of an element, rounded to the precision of the row.
    fn set(&mut self, lane: usize, value: f64);
    /// Those of two stores that have rows of this precision.
    fn among<'a>(double: &'a mut [Row], single: &'a mut [SingleRow]) -> &'a mut [Self];
}

impl Numbers for Row {
    const LANES: usize = CHUNK;
    #[inline(always)]
    fn filled(value: f64) -> Self {
        Row([value; CHUNK])
    }
    #[inline(always)]
    fn number(&self, lane: usize) -> f64 {
        self.0[lane]
    }
    #[inline(always)]
    fn set(&mut self, lane: usize, value: f64) {
        self.0[lane] = value;
    }
    #[inline(always)]
    fn among<'a>(double: &'a mut [Row], _: &'a mut [SingleRow]) -> &'a mut [Self] {
        double
    }
}

impl Numbers for SingleRow {
    const LANES: usize = MOST_LANES;
    #[inline(always)]
    fn filled(value: f64) -> Self {
        SingleRow([value as f32; MOST_LANES])
    }
    #[inline(always)]
    fn number(&self, lane: usize) -> f64 {
        f64::from(self.0[lane])
    }
    #[inline(always)]
    fn set(&mut self, lane: usize, value: f64) {
        self.0[lane] = value as f32;
    }
    #[inline(always)]
    fn among<'a>(_: &'a mut [Row], single: &'a mut [SingleRow]) -> &'a mut [Self] {
        single
    }
}

/// Asks the memory for the lines of two values that will be needed later, into the first cache: asked for into the second one, they cost two blocks whose nodes
/// lie scattered up to a sixth more contact on Zen 5, in some runs and not in others.
#[inline(always)]
pub fn prefetch_later<A, B>(one: &A, other: &B) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a prefetch reads nothing that the program sees, and every x86-64 processor has the instruction.
        unsafe {
            _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(one).cast());
            _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(other).cast());
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (one, other);
}

/// Asks the memory for rows that will be needed soon. Hardware does this too, but not across the border of a page.
#[inline(always)]
pub fn prefetch<R: Numbers>(rows: &[R]) {
    for row in rows {
        prefetch_line(row);
    }
}

/// Asks the memory for some of many values, by their places. It gains a twelfth of a step of 64³ hexahedra: 75 ns without it, 69 with it (Zen 4).
#[inline(always)]
pub fn prefetch_named<T>(all: &[T], places: &[u32]) {
    for &place in places {
        // Found without a promise that there is a value, which would have to be checked.
        prefetch_line(all.as_ptr().wrapping_add(place as usize));
    }
}

/// Asks the memory for the line of an address, into the first cache.
#[inline(always)]
fn prefetch_line<T>(address: *const T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a prefetch reads nothing that the program sees, whatever the address, and every x86-64 processor has the instruction.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(address.cast()) }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = address;
}

/// What an element adds to a node, `[x, y, z, s]`: a force, and a number of its own that neighbours are to hear of (0 where there is
/// none); four numbers so that it moves as one vector.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(C, align(32))]
pub struct Force(pub [f64; 4]);

/// Local nodes at a corner of the elements of a row: those of its first chunk, and of its second in single precision, which
/// is the first again in double.
pub type Corner<'a> = [&'a [u32; CHUNK]; 2];

/// Forces on the corners of the elements of a row.
pub type CornerForces = [[Force; MOST_CORNERS]; MOST_LANES];

/// A vector of floating-point lanes. Arithmetic is lane by lane; `COUNT` divides the length of a row, and a row is worked
/// off in parts of `COUNT` lanes: part `p` covers elements `p·COUNT ..`.
pub trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// Rows of its precision.
    type Row: Numbers;
    /// Vectors of double precision that hold its lanes, [`Lanes::PIECES`] of them.
    type Double: DoubleLanes;
    /// How many of those hold its lanes: one or two.
    const PIECES: usize = Self::COUNT / <Self::Double as Lanes>::COUNT;
    /// Whether its numbers are of single precision.
    const SINGLE: bool;
    /// The smallest positive normal number of its precision: a divisor that is at least this gives no infinity.
    const TINY: f64 = if Self::SINGLE { f32::MIN_POSITIVE as f64 } else { f64::MIN_POSITIVE };
    /// Lanes per vector.
    const COUNT: usize;
    /// The same number in every lane, rounded to its precision.
    fn splat(value: f64) -> Self;
    /// One of two numbers, for double or for single precision.
    #[inline(always)]
    fn either(double: f64, single: f64) -> Self {
        Self::splat(if Self::SINGLE { single } else { double })
    }
    /// One part of a row.
    fn load(row: &Self::Row, part: usize) -> Self;
    /// Writes one part of a row.
    fn store(self, row: &mut Self::Row, part: usize);
    /// One of its pieces in double precision.
    fn widened(self, piece: usize) -> Self::Double;
    /// Its pieces rounded to its precision; where there is one, that is the first.
    fn rounded(pieces: [Self::Double; 2]) -> Self;
    /// One part of a row that is kept in double precision, chunk by chunk.
    #[inline(always)]
    fn load_double(rows: &[Row], part: usize) -> Self {
        let first = Self::PIECES * part;
        let last = first + Self::PIECES - 1;
        Self::rounded([Self::Double::load_piece(rows, first), Self::Double::load_piece(rows, last)])
    }
    /// Writes one part of such a row.
    #[inline(always)]
    fn store_double(self, rows: &mut [Row], part: usize) {
        for piece in 0..Self::PIECES {
            self.widened(piece).store_piece(rows, Self::PIECES * part + piece);
        }
    }
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// `self` where it is less than `other`, else `other` (also where one is NaN).
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select_less(self, other, self, other)
    }
    /// `self` where it is greater than `other`, else `other` (also where one is NaN).
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select_less(other, self, self, other)
    }
    /// Without its sign.
    #[inline(always)]
    fn abs(self) -> Self {
        // Zero less a number, not its negative: that is +0 for either zero, and of two equals the second is taken.
        self.max(Self::splat(0.0) - self)
    }
    /// `yes` where `a < b`, else `no` (also where one is NaN).
    fn select_less(a: Self, b: Self, yes: Self, no: Self) -> Self;
    /// Whether `a < b` in any lane. Only to leave out work whose result no lane would take.
    fn any_less(a: Self, b: Self) -> bool;
    /// A positive normal number x as m · 2ⁿ with 1 ≤ m < 2: m and n.
    fn split_exponent(self) -> (Self, Self);
    /// 2ⁿ of a whole number n from −1022 to 1023, in single precision from −126 to 127.
    fn power_of_two(self) -> Self;
    /// In single precision: two numbers of eight bits and an exponent each, which [`Lanes::of_halves`] has put into one.
    #[inline(always)]
    fn halves(self) -> (Self, Self) {
        (self, self)
    }
    /// In single precision: two numbers rounded to eight bits, in the place of one. What comes out is no number to compute with.
    #[inline(always)]
    fn of_halves(upper: Self, _lower: Self) -> Self {
        upper
    }
}

/// Vectors of double precision. Nodes are in it for kernels of either, so these fetch and bring what elements have to do with them.
/// Piece `p` of a row, of one chunk or of two, covers its elements `p·COUNT ..`.
pub trait DoubleLanes: Lanes<Row = Row, Double = Self> {
    /// Fetches the rows named by one piece of `index` and turns them: component `c` of the result holds number `c`
    /// of every fetched row.
    fn gather(rows: &[Row], index: Corner, piece: usize) -> [Self; 8];
    /// Turns four component vectors into what the elements of a piece add to a node: `out[element][corner]`.
    fn spread(force: [Self; 4], out: &mut CornerForces, corner: usize, piece: usize);
    /// One piece of rows of one chunk each.
    #[inline(always)]
    fn load_piece(rows: &[Row], piece: usize) -> Self {
        let first = piece * Self::COUNT;
        Self::load(&rows[first / CHUNK], first % CHUNK / Self::COUNT)
    }
    /// Writes one piece of such rows.
    #[inline(always)]
    fn store_piece(self, rows: &mut [Row], piece: usize) {
        let first = piece * Self::COUNT;
        self.store(&mut rows[first / CHUNK], first % CHUNK / Self::COUNT);
    }
}

/// The vectors in which a kernel of a precision is compiled, named by its single number.
pub trait Widths: Lanes {
    /// Whatever the target guarantees.
    type Portable: Lanes<Row = Self::Row>;
    /// 256 bits.
    #[cfg(target_arch = "x86_64")]
    type Avx2: Lanes<Row = Self::Row>;
    /// 512 bits.
    #[cfg(target_arch = "x86_64")]
    type Avx512: Lanes<Row = Self::Row>;
}

impl Widths for f64 {
    #[cfg(target_arch = "x86_64")]
    type Portable = sse2::F64x2;
    #[cfg(not(target_arch = "x86_64"))]
    type Portable = Pair<f64>;
    #[cfg(target_arch = "x86_64")]
    type Avx2 = avx2::F64x4;
    #[cfg(target_arch = "x86_64")]
    type Avx512 = avx512::F64x8;
}

impl Widths for f32 {
    #[cfg(target_arch = "x86_64")]
    type Portable = single::F32x4;
    #[cfg(not(target_arch = "x86_64"))]
    type Portable = Pair<Pair<f32>>;
    #[cfg(target_arch = "x86_64")]
    type Avx2 = single::F32x8;
    #[cfg(target_arch = "x86_64")]
    type Avx512 = single::F32x16;
}

/// Bits of the part of a double that is not its exponent.
const MANTISSA_BITS: u64 = 0x000f_ffff_ffff_ffff;

/// 2⁵²: from here to its double, doubles are the whole numbers, with the number in the last bits.
const WHOLE: f64 = 4_503_599_627_370_496.0;

/// Exponent that stands for 2⁰.
const BIAS: f64 = 1023.0;

/// A set of vector instructions for which kernels are compiled and which this processor has: there is no other way to get
/// one than to ask what there is, so that no safe call reaches instructions that are missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct InstructionSet(Vectors);

/// The vectors of an [`InstructionSet`], from the narrowest to the widest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) enum Vectors {
    /// Whatever the target guarantees.
    #[default]
    Portable,
    /// 256 bits.
    Avx2,
    /// 512 bits.
    Avx512,
}

impl InstructionSet {
    /// The set to use: the widest this processor has; the environment variable `URTO_SIMD` (`portable`, `avx2`, `avx512`) can
    /// ask for a narrower one.
    pub fn detect() -> InstructionSet {
        let widest = InstructionSet::widest();
        match std::env::var("URTO_SIMD").as_deref() {
            Ok("portable") => InstructionSet(Vectors::Portable),
            Ok("avx2") => widest.min(InstructionSet(Vectors::Avx2)),
            _ => widest,
        }
    }

    /// All sets that this processor has, from the narrowest to the widest.
    pub fn available() -> impl Iterator<Item = InstructionSet> {
        let all = [Vectors::Portable, Vectors::Avx2, Vectors::Avx512].map(InstructionSet);
        all.into_iter().filter(|set| *set <= InstructionSet::widest())
    }

    /// The widest set that this processor has and that the kernels were compiled for.
    pub fn widest() -> InstructionSet {
        #[cfg(target_arch = "x86_64")]
        if !cfg!(one_width) {
            let avx512 = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl");
            if avx512 && is_x86_feature_detected!("avx2") {
                return InstructionSet(Vectors::Avx512);
            }
            if is_x86_feature_detected!("avx2") {
                return InstructionSet(Vectors::Avx2);
            }
        }
        InstructionSet(Vectors::Portable)
    }

    /// The vectors that may be used.
    pub(crate) fn vectors(self) -> Vectors {
        self.0
    }

    /// Name for the print log.
    pub fn name(self) -> &'static str {
        match self.0 {
            Vectors::Portable => "portable",
            Vectors::Avx2 => "AVX2",
            Vectors::Avx512 => "AVX-512",
        }
    }
}
