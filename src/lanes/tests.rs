//! Every vector type does to its lanes what `f64` does to one number, to the bit.

// Formulas run over indices of several arrays at once.
#![allow(clippy::needless_range_loop)]

use super::*;

/// Numbers at which implementations like to differ, and ordinary ones.
fn numbers() -> Vec<f64> {
    let special = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        f64::MIN_POSITIVE,
        5e-324,
        -5e-324,
        f64::MAX,
        f64::MIN,
        f64::EPSILON,
        1.0 / 3.0,
    ];
    let mut seed = 1u64;
    let random = (0..50).map(|_| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        // Any sign, exponents from −30 to 31.
        f64::from_bits((seed & 0x800f_ffff_ffff_ffff) | ((993 + ((seed >> 52) & 63)) << 52))
    });
    special.into_iter().chain(random).collect()
}

/// Bits, with one pattern for all NaN: which of them comes out is the processor's business.
fn bits(x: f64) -> u64 {
    if x.is_nan() { u64::MAX } else { x.to_bits() }
}

/// Result of every operation on all lanes of rows a, b, c: what the vector type stores, part after part.
#[inline(always)]
fn operate<V: Lanes<Row = Row>>(a: &Row, b: &Row, c: &Row) -> Vec<Row> {
    let mut out = vec![Row::default(); 18];
    for part in 0..CHUNK / V::COUNT {
        let (x, y, z) = (V::load(a, part), V::load(b, part), V::load(c, part));
        let results = [
            x + y,
            x - y,
            x * y,
            x / y,
            -x,
            x.sqrt(),
            Lanes::min(x, y),
            Lanes::max(x, y),
            V::select_less(x, y, z, x),
            // Fused, this would differ in the last place.
            x * y + z,
            V::splat(0.1) * x - y * z,
            exp(x),
            ln(x),
            power(y, 0.26),
            x.max(V::splat(f64::MIN_POSITIVE)).split_exponent().0,
            x.max(V::splat(f64::MIN_POSITIVE)).split_exponent().1,
            ((z.max(V::splat(-100.0)).min(V::splat(100.0)) + V::splat(1e16)) - V::splat(1e16)).power_of_two(),
            V::splat(f64::from(u8::from(V::any_less(V::splat(f64::NAN), x) || V::any_less(x, x)))),
        ];
        for (row, result) in out.iter_mut().zip(results) {
            result.store(row, part);
        }
    }
    out
}

/// Rows gathered, turned and spread again: components 0 to 2 come back as forces.
#[inline(always)]
fn turn<V: Lanes<Row = Row>>(rows: &[Row], index: &[u32; CHUNK]) -> (Vec<Row>, Box<CornerForces>) {
    let mut components = vec![Row::default(); 8];
    let mut forces = Box::new([[Force([f64::NAN; 4]); 8]; MOST_LANES]);
    for part in 0..CHUNK / V::COUNT {
        let gathered = V::gather(rows, [index, index], part);
        for (row, component) in components.iter_mut().zip(gathered) {
            component.store(row, part);
        }
        for corner in 0..8 {
            V::spread(
                [gathered[corner], gathered[(corner + 1) % 8], gathered[(corner + 2) % 8]],
                &mut forces,
                corner,
                part,
            );
        }
    }
    (components, forces)
}

/// Whether any lane of any part of a is less than that of b.
#[inline(always)]
fn any<V: Lanes<Row = Row>>(a: &Row, b: &Row) -> bool {
    (0..CHUNK / V::COUNT).any(|part| V::any_less(V::load(a, part), V::load(b, part)))
}

#[cfg(target_arch = "x86_64")]
mod wide {
    use super::*;

    // SAFETY of the calls: `InstructionSet::widest` has found the features.
    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    pub unsafe fn operate512(a: &Row, b: &Row, c: &Row) -> Vec<Row> {
        operate::<F64x8>(a, b, c)
    }
    #[target_feature(enable = "avx2")]
    pub unsafe fn operate256(a: &Row, b: &Row, c: &Row) -> Vec<Row> {
        operate::<F64x4>(a, b, c)
    }
    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    pub unsafe fn any512(a: &Row, b: &Row) -> bool {
        any::<F64x8>(a, b)
    }
    #[target_feature(enable = "avx2")]
    pub unsafe fn any256(a: &Row, b: &Row) -> bool {
        any::<F64x4>(a, b)
    }
    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    pub unsafe fn turn512(rows: &[Row], index: &[u32; CHUNK]) -> (Vec<Row>, Box<CornerForces>) {
        turn::<F64x8>(rows, index)
    }
    #[target_feature(enable = "avx2")]
    pub unsafe fn turn256(rows: &[Row], index: &[u32; CHUNK]) -> (Vec<Row>, Box<CornerForces>) {
        turn::<F64x4>(rows, index)
    }
}

/// Operations of every type this processor can run, the scalar one first.
fn all_operate(a: &Row, b: &Row, c: &Row) -> Vec<Vec<Row>> {
    let mut all = vec![operate::<f64>(a, b, c), operate::<Pair>(a, b, c)];
    #[cfg(target_arch = "x86_64")]
    {
        if InstructionSet::widest().vectors() != Vectors::Portable {
            // SAFETY: detected.
            all.push(unsafe { wide::operate256(a, b, c) });
        }
        if InstructionSet::widest().vectors() == Vectors::Avx512 {
            // SAFETY: detected.
            all.push(unsafe { wide::operate512(a, b, c) });
        }
    }
    all
}

fn all_any(a: &Row, b: &Row) -> Vec<bool> {
    let mut all = vec![any::<f64>(a, b), any::<Pair>(a, b)];
    #[cfg(target_arch = "x86_64")]
    {
        if InstructionSet::widest().vectors() != Vectors::Portable {
            // SAFETY: detected.
            all.push(unsafe { wide::any256(a, b) });
        }
        if InstructionSet::widest().vectors() == Vectors::Avx512 {
            // SAFETY: detected.
            all.push(unsafe { wide::any512(a, b) });
        }
    }
    all
}

fn all_turn(rows: &[Row], index: &[u32; CHUNK]) -> Vec<(Vec<Row>, Box<CornerForces>)> {
    let mut all = vec![turn::<f64>(rows, index), turn::<Pair>(rows, index)];
    #[cfg(target_arch = "x86_64")]
    {
        if InstructionSet::widest().vectors() != Vectors::Portable {
            // SAFETY: detected.
            all.push(unsafe { wide::turn256(rows, index) });
        }
        if InstructionSet::widest().vectors() == Vectors::Avx512 {
            // SAFETY: detected.
            all.push(unsafe { wide::turn512(rows, index) });
        }
    }
    all
}

#[test]
fn all_vector_types_agree() {
    let numbers = numbers();
    for i in 0..numbers.len() {
        for j in 0..numbers.len() {
            let pick = |first: usize, stride: usize| {
                Row(std::array::from_fn(|lane| numbers[(first + stride * lane) % numbers.len()]))
            };
            let (a, b, c) = (pick(i, 1), pick(j, 3), pick(i + j, 5));
            let results = all_operate(&a, &b, &c);
            for other in &results[1..] {
                for (operation, (x, y)) in results[0].iter().zip(other).enumerate() {
                    assert_eq!(x.0.map(bits), y.0.map(bits), "operation {operation} on {a:?}, {b:?}, {c:?}");
                }
            }
        }
    }
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
#[test]
fn any_lane_counts() {
    for lane in 0..CHUNK {
        let mut row = Row([2.0; CHUNK]);
        row.0[lane] = 0.5;
        let (one, two) = (Row([1.0; CHUNK]), Row([2.0; CHUNK]));
        for (a, any) in [(&row, true), (&two, false)] {
            let found: Vec<bool> = all_any(a, &one);
            assert!(found.iter().all(|&f| f == any), "{found:?} in lane {lane}");
        }
    }
}

#[test]
fn gathering_and_spreading_turn_rows() {
    let rows: Vec<Row> = (0..20).map(|r| Row(std::array::from_fn(|c| f64::from(100 * r) + c as f64))).collect();
    let index = [7, 0, 19, 3, 3, 12, 1, 18];
    for (components, forces) in all_turn(&rows, &index) {
        for (lane, &row) in index.iter().enumerate() {
            for c in 0..8 {
                assert_eq!(components[c].0[lane], rows[row as usize].0[c]);
                let expected = [0, 1, 2].map(|i| rows[row as usize].0[(c + i) % 8]);
                assert_eq!(forces[lane][c].0, [expected[0], expected[1], expected[2], 0.0]);
            }
        }
    }
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
