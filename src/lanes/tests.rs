//! Every vector type does to its lanes what a single number of its precision does, to the bit.

// Formulas run over indices of several arrays at once.
#![allow(clippy::needless_range_loop)]

use super::*;

/// A precision: its single number, and how its tests pick numbers.
trait Precision: Widths {
    /// Its portable vectors on processors of which nothing is known.
    type Elsewhere: Lanes<Row = Self::Row>;
    /// Numbers at which implementations like to differ.
    fn special() -> Vec<f64>;
    /// An ordinary number of any sign, from 64 random bits.
    fn ordinary(bits: u64) -> f64;
}

const ALWAYS_SPECIAL: [f64; 8] = [0.0, -0.0, 1.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1.0 / 3.0];

impl Precision for f64 {
    type Elsewhere = Pair<f64>;
    fn special() -> Vec<f64> {
        [&ALWAYS_SPECIAL[..], &[f64::MIN_POSITIVE, 5e-324, -5e-324, f64::MAX, f64::MIN, f64::EPSILON]].concat()
    }
    /// Exponents from −30 to 31.
    fn ordinary(bits: u64) -> f64 {
        f64::from_bits((bits & 0x800f_ffff_ffff_ffff) | ((993 + ((bits >> 52) & 63)) << 52))
    }
}

impl Precision for f32 {
    type Elsewhere = Pair<Pair<f32>>;
    fn special() -> Vec<f64> {
        let own = [f32::MIN_POSITIVE, 1e-45, -1e-45, f32::MAX, f32::MIN, f32::EPSILON].map(f64::from);
        [&ALWAYS_SPECIAL[..], &own].concat()
    }
    /// Exponents from −16 to 15.
    fn ordinary(bits: u64) -> f64 {
        let bits = (bits >> 32) as u32;
        f64::from(f32::from_bits((bits & 0x807f_ffff) | ((111 + ((bits >> 23) & 31)) << 23)))
    }
}

fn numbers<P: Precision>() -> Vec<f64> {
    let mut seed = 1u64;
    let random = (0..50).map(|_| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        P::ordinary(seed)
    });
    P::special().into_iter().chain(random).collect()
}

/// A row of numbers that are known by their lanes.
fn row<R: Numbers>(number: impl Fn(usize) -> f64) -> R {
    let mut row = R::default();
    (0..R::LANES).for_each(|lane| row.set(lane, number(lane)));
    row
}

/// Bits of a row, with one pattern for all NaN: which of them comes out is the processor's business.
fn bits<R: Numbers>(row: &R) -> Vec<u64> {
    let of = |x: f64| if x.is_nan() { u64::MAX } else { x.to_bits() };
    (0..R::LANES).map(|lane| of(row.number(lane))).collect()
}

/// Result of every operation on all lanes of rows a, b, c: what the vector type stores, part after part.
#[inline(always)]
fn operate<V: Lanes>([a, b, c]: &[V::Row; 3]) -> Vec<V::Row> {
    let mut out = vec![V::Row::default(); 23];
    for part in 0..V::Row::LANES / V::COUNT {
        let (x, y, z) = (V::load(a, part), V::load(b, part), V::load(c, part));
        let positive = x.max(V::splat(V::TINY));
        let mut double = [Row::default(); MOST_LANES / CHUNK];
        x.store_double(&mut double, part);
        let packed = V::of_halves(y, z);
        // Added and taken away again, it leaves a whole number.
        let whole = V::either(1e16, 12_582_912.0);
        let results = [
            x + y,
            x - y,
            x * y,
            x / y,
            -x,
            x.sqrt(),
            x.abs(),
            Lanes::min(x, y),
            Lanes::max(x, y),
            V::select_less(x, y, z, x),
            // Fused, this would differ in the last place.
            x * y + z,
            V::splat(0.1) * x - y * z,
            exp(x),
            ln(x),
            power(y, 0.26),
            positive.split_exponent().0,
            positive.split_exponent().1,
            ((z.max(V::splat(-100.0)).min(V::splat(100.0)) + whole) - whole).power_of_two(),
            V::splat(f64::from(u8::from(V::any_less(V::splat(f64::NAN), x) || V::any_less(x, x)))),
            V::load_double(&double, part),
            packed.halves().0,
            packed.halves().1,
            y - packed.halves().0,
        ];
        for (row, result) in out.iter_mut().zip(results) {
            result.store(row, part);
        }
    }
    out
}

/// Rows gathered, less others and rounded, as they are, turned and spread again: four of the components come back as forces.
#[inline(always)]
fn turn<V: Lanes>((rows, [origin, index]): &(&[Row], [Corner; 2])) -> Turned<V::Row> {
    let (mut own, mut from) = (vec![V::Row::default(); 8], vec![V::Row::default(); 8]);
    let mut forces = Box::new([[Force([f64::NAN; 4]); 8]; MOST_LANES]);
    for part in 0..V::Row::LANES / V::COUNT {
        let pieces = [V::PIECES * part, V::PIECES * (part + 1) - 1];
        let gathered = array![h in 2 => V::Double::gather(rows, *index, pieces[h])];
        let origins = array![h in 2 => V::Double::gather(rows, *origin, pieces[h])];
        let rounded: [V; 8] = array![c in 8 => V::rounded(array![h in 2 => gathered[h][c]])];
        for c in 0..8 {
            rounded[c].store(&mut own[c], part);
            V::rounded(array![h in 2 => gathered[h][c] - origins[h][c]]).store(&mut from[c], part);
        }
        for corner in 0..8 {
            for piece in 0..V::PIECES {
                let force = array![i in 4 => rounded[(corner + i) % 8].widened(piece)];
                V::Double::spread(force, &mut forces, corner, pieces[piece]);
            }
        }
    }
    (own, from, forces)
}

type Turned<R> = (Vec<R>, Vec<R>, Box<CornerForces>);

/// Whether any lane of any part of a is less than that of b.
#[inline(always)]
fn any<V: Lanes>([a, b]: &[V::Row; 2]) -> bool {
    (0..V::Row::LANES / V::COUNT).any(|part| V::any_less(V::load(a, part), V::load(b, part)))
}

/// What a function gives of every vector type of a precision that this processor can run, the single number first.
macro_rules! of_all {
    ($function:ident of $precision:ident, $input:expr) => {{
        let input = $input;
        let mut all = vec![
            $function::<$precision>(&input),
            $function::<$precision::Elsewhere>(&input),
            $function::<$precision::Portable>(&input),
        ];
        // SAFETY, wherever these are called: only after the features have been found.
        #[cfg(target_arch = "x86_64")]
        {
            if InstructionSet::widest() >= InstructionSet(Vectors::Avx2) {
                all.push($function::<$precision::Avx2>(&input));
            }
            if InstructionSet::widest() >= InstructionSet(Vectors::Avx512) {
                all.push($function::<$precision::Avx512>(&input));
            }
        }
        all
    }};
}

fn all_vector_types_agree<P: Precision>() {
    let numbers = numbers::<P>();
    for i in 0..numbers.len() {
        for j in 0..numbers.len() {
            let pick = |first: usize, stride: usize| row(|lane| numbers[(first + stride * lane) % numbers.len()]);
            let rows: [P::Row; 3] = [pick(i, 1), pick(j, 3), pick(i + j, 5)];
            let results = of_all!(operate of P, rows);
            for other in &results[1..] {
                for (operation, (x, y)) in results[0].iter().zip(other).enumerate() {
                    assert_eq!(bits(x), bits(y), "operation {operation} on {:?}", rows.map(|row| bits(&row)));
                }
            }
        }
    }
}

#[test]
fn all_vector_types_agree_in_double() {
    all_vector_types_agree::<f64>();
}

#[test]
fn all_vector_types_agree_in_single() {
    all_vector_types_agree::<f32>();
}

/// The rules that the kernels count on: of two equal or incomparable numbers the second comes out.
#[test]
fn selection_takes_the_second_when_in_doubt() {
    let (nan, one) = (f64::NAN, 1.0f64);
    assert_eq!(Lanes::min(nan, one), 1.0);
    assert!(Lanes::min(one, nan).is_nan());
    assert_eq!(Lanes::max(nan, one), 1.0);
    assert!(Lanes::max(one, nan).is_nan());
    assert!(Lanes::min(0.0f64, -0.0).is_sign_negative() && Lanes::min(-0.0f64, 0.0).is_sign_positive());
    assert!(Lanes::max(0.0f64, -0.0).is_sign_negative() && Lanes::max(-0.0f64, 0.0).is_sign_positive());
    for (a, b) in [(nan, one), (one, nan), (one, one), (0.0, -0.0), (-0.0, 0.0)] {
        assert_eq!(f64::select_less(a, b, 5.0, 7.0), 7.0);
    }
    assert_eq!(f64::select_less(f64::NEG_INFINITY, -1e300, 5.0, 7.0), 5.0);
}

/// One lane of a whole vector is enough, wherever it stands.
fn any_lane_counts<P: Precision>() {
    for place in 0..P::Row::LANES {
        let small: P::Row = row(|lane| if lane == place { 0.5 } else { 2.0 });
        for (a, expected) in [(small, true), (row(|_| 2.0), false)] {
            let found = of_all!(any of P, [a, row(|_| 1.0)]);
            assert!(found.iter().all(|&f| f == expected), "{found:?} in lane {place}");
        }
    }
}

#[test]
fn any_lane_counts_in_both() {
    any_lane_counts::<f64>();
    any_lane_counts::<f32>();
}

/// Differences are those of doubles, far from the origin too.
fn gathering_and_spreading_turn_rows<P: Precision>() {
    let number = |r: u32, c: usize| 1e9 + f64::from(100 * r) + c as f64 / 3.0;
    let rows: Vec<Row> = (0..20).map(|r| row(|c| number(r, c))).collect();
    let (first, mut second) = ([7, 0, 19, 3, 3, 12, 1, 18], [2, 5, 9, 14, 0, 0, 17, 6]);
    let origins = [5, 5, 2, 8, 9, 1, 0, 4];
    if !P::SINGLE {
        // A row is of one chunk only.
        second = first;
    }
    let (index, origin) = ([&first, &second], [&origins, &origins]);
    let rounded = |x: f64| row::<P::Row>(|_| x).number(0);
    for (own, from, forces) in of_all!(turn of P, (&rows[..], [origin, index])) {
        for lane in 0..P::Row::LANES {
            let row = |of: Corner| &rows[of[lane / CHUNK][lane % CHUNK] as usize].0;
            for c in 0..8 {
                assert_eq!(own[c].number(lane), rounded(row(index)[c]));
                assert_eq!(from[c].number(lane), rounded(row(index)[c] - row(origin)[c]));
                let expected = [0, 1, 2, 3].map(|i| rounded(row(index)[(c + i) % 8]));
                assert_eq!(forces[lane][c].0, expected);
            }
        }
    }
}

#[test]
fn gathering_and_spreading_turn_rows_in_both() {
    gathering_and_spreading_turn_rows::<f64>();
    gathering_and_spreading_turn_rows::<f32>();
}

/// What is kept in half of a number is right to its eight bits.
#[test]
fn halves_keep_eight_bits() {
    for x in numbers::<f32>().into_iter().map(|x| x as f32).filter(|x| x.is_normal() && x.abs() < 1e30) {
        let (upper, lower) = f32::of_halves(x, -0.7 * x).halves();
        assert!((upper - x).abs() <= x.abs() / 256.0 && (lower + 0.7 * x).abs() <= x.abs() / 256.0, "{x}");
    }
}

/// In single precision, against libm in double.
#[test]
fn exponential_and_logarithm_are_good_to_three_units() {
    let units = |x: f32, exact: f64| (f64::from(x) - exact).abs() / (exact.abs() * f64::from(f32::EPSILON));
    let mut worst = [0.0f64; 2];
    for i in 0..100_000 {
        let t = i as f32 / 100_000.0;
        for x in [-86.0 + 172.0 * t, 2.0 * t - 1.0] {
            worst[0] = worst[0].max(units(exp(x), libm::exp(f64::from(x))));
        }
        for y in [0.5 + t, 1.0 + 1e-3 * t, 1e30 * t + 1e-30] {
            if y != 1.0 {
                worst[1] = worst[1].max(units(ln(y), libm::log(f64::from(y))));
            }
        }
    }
    println!("exp {:.2}, ln {:.2} units in the last place", worst[0], worst[1]);
    assert!(worst[0] <= 3.0 && worst[1] <= 3.0, "{worst:?}");
    assert_eq!([exp(0.0f32), ln(1.0f32), exp(-1e9f32), exp(1e9f32)], [1.0, 0.0, exp(-87.0f32), exp(87.0f32)]);
    assert!(exp(f32::NAN).is_nan() && ln(f32::NAN).is_nan() && ln(f32::INFINITY).is_nan());
    assert!(ln(0.0f32) < -87.0 && ln(-1.0f32) < -87.0);
}

/// The tensors against full 3 × 3 matrices.
#[test]
fn tensors_are_matrices() {
    let a: Sym3<f64> = Sym3 { xx: 1.0, yy: -2.0, zz: 3.5, xy: 0.25, yz: -0.75, zx: 4.0 };
    let b: Sym3<f64> = Sym3 { xx: 0.5, yy: 1.5, zz: -1.0, xy: 2.0, yz: 0.125, zx: -3.0 };
    let (m, n) = (full(&a), full(&b));
    assert_eq!(a.contract(b), m.component_mul(&n).sum());
    assert_eq!(a.trace(), m.trace());
    assert!(a.deviator().trace().abs() < 1e-15);
    let r = nalgebra::Rotation3::from_euler_angles(0.3, -1.0, 2.0).into_inner();
    let rows: Matrix3<f64> = array![i in 3 => array![j in 3 => r[(i, j)]]];
    assert!((full(&a.rotate(&rows)) - r * m * r.transpose()).amax() < 1e-14);
    let other: Matrix3<f64> = array![i in 3 => array![j in 3 => (3 * i + j * j) as f64]];
    let f = nalgebra::Matrix3::from_fn(|i, j| other[i][j]);
    let (product, transposed) = (multiply(&rows, &other), multiply_transposed(&rows, &other));
    for i in 0..3 {
        for j in 0..3 {
            assert!((product[i][j] - (r * f)[(i, j)]).abs() < 1e-14);
            assert!((transposed[i][j] - (r.transpose() * f)[(i, j)]).abs() < 1e-14);
            assert_eq!(Sym3::of(&other).matrix()[i][j], 0.5 * (other[i][j] + other[j][i]));
        }
    }
}

fn full(s: &Sym3<f64>) -> nalgebra::Matrix3<f64> {
    nalgebra::Matrix3::from_fn(|i, j| s.matrix()[i][j])
}
