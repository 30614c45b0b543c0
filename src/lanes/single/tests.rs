//! Every vector type of single precision does to its lanes what `f32` does to one number, to the bit.

use crate::lanes::*;

/// Numbers at which implementations like to differ, and ordinary ones.
fn numbers() -> Vec<f32> {
    let special = [0.0, -0.0, 1.0, -1.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, f32::MIN_POSITIVE, 1e-45, -1e-45];
    let mut seed = 1u64;
    let random = (0..50).map(|_| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let bits = (seed >> 32) as u32;
        // Any sign, exponents from −16 to 15.
        f32::from_bits((bits & 0x807f_ffff) | ((111 + ((bits >> 23) & 31)) << 23))
    });
    special.into_iter().chain([f32::MAX, f32::MIN, f32::EPSILON, 1.0 / 3.0]).chain(random).collect()
}

/// Bits, with one pattern for all NaN.
fn bits(x: f32) -> u32 {
    if x.is_nan() { u32::MAX } else { x.to_bits() }
}

/// Result of every operation on all lanes of rows a, b, c.
#[inline(always)]
fn operate<V: Lanes<Row = SingleRow>>(a: &SingleRow, b: &SingleRow, c: &SingleRow) -> Vec<SingleRow> {
    let mut out = vec![SingleRow::default(); 22];
    for part in 0..MOST_LANES / V::COUNT {
        let (x, y, z) = (V::load(a, part), V::load(b, part), V::load(c, part));
        let positive = x.max(V::splat(V::TINY));
        let mut double = [Row::default(); 2];
        x.store_double(&mut double, part);
        let packed = V::of_halves(y, z);
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
            positive.split_exponent().0,
            positive.split_exponent().1,
            ((z.max(V::splat(-100.0)).min(V::splat(100.0)) + V::splat(12_582_912.0)) - V::splat(12_582_912.0))
                .power_of_two(),
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

type Turned = (Vec<SingleRow>, Vec<SingleRow>, Box<CornerForces>);

/// Rows gathered, as they are and from others, turned and spread again.
#[inline(always)]
fn turn<V: Lanes<Row = SingleRow>>(rows: &[Row], origin: Corner, index: Corner) -> Turned {
    let (mut own, mut from) = (vec![SingleRow::default(); 8], vec![SingleRow::default(); 8]);
    let mut forces = Box::new([[Force([f64::NAN; 4]); 8]; MOST_LANES]);
    for part in 0..MOST_LANES / V::COUNT {
        let gathered = V::gather(rows, index, part);
        let relative = V::gather_from(rows, origin, index, part);
        for c in 0..8 {
            gathered[c].store(&mut own[c], part);
            relative[c].store(&mut from[c], part);
        }
        for corner in 0..8 {
            let force = [gathered[corner], gathered[(corner + 1) % 8], gathered[(corner + 2) % 8]];
            V::spread(force, &mut forces, corner, part);
        }
    }
    (own, from, forces)
}

#[cfg(target_arch = "x86_64")]
mod wide {
    use super::*;

    // SAFETY of the calls: `InstructionSet::widest` has found the features.
    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    pub unsafe fn operate512(a: &SingleRow, b: &SingleRow, c: &SingleRow) -> Vec<SingleRow> {
        operate::<F32x16>(a, b, c)
    }
    #[target_feature(enable = "avx2")]
    pub unsafe fn operate256(a: &SingleRow, b: &SingleRow, c: &SingleRow) -> Vec<SingleRow> {
        operate::<F32x8>(a, b, c)
    }
    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    pub unsafe fn turn512(rows: &[Row], origin: Corner, index: Corner) -> Turned {
        turn::<F32x16>(rows, origin, index)
    }
    #[target_feature(enable = "avx2")]
    pub unsafe fn turn256(rows: &[Row], origin: Corner, index: Corner) -> Turned {
        turn::<F32x8>(rows, origin, index)
    }
}

fn all_operate(a: &SingleRow, b: &SingleRow, c: &SingleRow) -> Vec<Vec<SingleRow>> {
    let mut all = vec![operate::<f32>(a, b, c), operate::<Quad>(a, b, c)];
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx2") {
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

fn all_turn(rows: &[Row], origin: Corner, index: Corner) -> Vec<Turned> {
    let mut all = vec![turn::<f32>(rows, origin, index), turn::<Quad>(rows, origin, index)];
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx2") {
            // SAFETY: detected.
            all.push(unsafe { wide::turn256(rows, origin, index) });
        }
        if InstructionSet::widest().vectors() == Vectors::Avx512 {
            // SAFETY: detected.
            all.push(unsafe { wide::turn512(rows, origin, index) });
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
                SingleRow(std::array::from_fn(|lane| numbers[(first + stride * lane) % numbers.len()]))
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

/// Differences are those of doubles, far from the origin too.
#[test]
fn gathering_and_spreading_turn_rows() {
    let number = |r: u32, c: usize| 1e9 + f64::from(100 * r) + c as f64 / 3.0;
    let rows: Vec<Row> = (0..20).map(|r| Row(std::array::from_fn(|c| number(r, c)))).collect();
    let (first, second) = ([7, 0, 19, 3, 3, 12, 1, 18], [2, 5, 9, 14, 0, 0, 17, 6]);
    let (index, origin) = ([&first, &second], [&second, &first]);
    for (own, from, forces) in all_turn(&rows, origin, index) {
        for lane in 0..MOST_LANES {
            let row = |of: Corner| &rows[of[lane / CHUNK][lane % CHUNK] as usize].0;
            for c in 0..8 {
                assert_eq!(own[c].0[lane], row(index)[c] as f32);
                assert_eq!(from[c].0[lane], (row(index)[c] - row(origin)[c]) as f32);
                let expected = [0, 1, 2].map(|i| f64::from(row(index)[(c + i) % 8] as f32));
                assert_eq!(forces[lane][c].0, [expected[0], expected[1], expected[2], 0.0]);
            }
        }
    }
}

/// What is kept in half of a number is right to its eight bits.
#[test]
fn halves_keep_eight_bits() {
    for x in numbers().into_iter().filter(|x| x.is_normal() && x.abs() < 1e30) {
        let (upper, lower) = f32::of_halves(x, -0.7 * x).halves();
        assert!((upper - x).abs() <= x.abs() / 256.0 && (lower + 0.7 * x).abs() <= x.abs() / 256.0, "{x}");
    }
}

/// Against libm in double precision.
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
