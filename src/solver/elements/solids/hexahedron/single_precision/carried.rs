//! Sums over many steps in single precision.
//!
//! What is added in a step is often smaller than the last digit of the sum: 10⁵ steps of 10⁻⁷ would vanish. So each of these
//! sums keeps what its additions have lost and gives it to the next (Kahan 1965), in rows behind those of the law: eight bits
//! of it are enough for frame, stretch, stress and hourglass resistance, two to a number; energies keep all. A stress is not
//! summed here, but in its law; there the lost part goes into the strain of the next step.

use crate::lanes::{Lanes, Matrix3, Sym3, array};
use crate::material::Kernel;
use crate::solver::elements::hexahedron::hourglass::{self, Resistance};
use crate::solver::elements::hexahedron::kernel::Settings;
use crate::solver::elements::hexahedron::kinematics::{self, Motion};
use crate::solver::elements::hexahedron::rows;
use crate::solver::elements::state_rows::{accumulate_carried, carried_sum};

/// Rows of what is carried, behind those of the law: of the stretch, which is kept without its one so that small strains have
/// all digits, of the frame, of the strain, of the hourglass resistance, two numbers each, and of the three energies.
pub const NAMES: [&str; 17] = [
    "CARRY01", "CARRY02", "CARRY03", "CARRY04", "CARRY05", "CARRY06", "CARRY07", "CARRY08", "CARRY09", "CARRY10",
    "CARRY11", "CARRY12", "CARRY13", "CARRY14", "CARRY15", "CARRY16", "CARRY17",
];
const STRETCH: usize = 0;
const FRAME: usize = 3;
const STRAIN: usize = 5;
const HOURGLASS: usize = 8;
/// Where those of the energies are, in the order of the energies.
pub const ENERGIES: usize = 14;

/// Largest part of the stress that an addition loses, in units of its last digit, and some for those of the law.
const LOST: f64 = 4.0 * f32::EPSILON as f64;

/// First row of what is carried.
const fn first<K: Kernel>() -> usize {
    rows::LAW + K::STATE.len()
}

/// The carried parts of N numbers, N even and at most 12.
#[inline(always)]
fn load<V: Lanes, const N: usize>(state: &[V::Row], first: usize, part: usize) -> [V; N] {
    let mut carried = [V::splat(0.0); N];
    for k in 0..N / 2 {
        (carried[2 * k], carried[2 * k + 1]) = V::load(&state[first + k], part).halves();
    }
    carried
}

#[inline(always)]
fn store<V: Lanes, const N: usize>(carried: &[V; N], state: &mut [V::Row], first: usize, part: usize) {
    for k in 0..N / 2 {
        V::of_halves(carried[2 * k], carried[2 * k + 1]).store(&mut state[first + k], part);
    }
}

/// Adds to N consecutive numbers.
#[inline(always)]
fn add<V: Lanes, const N: usize>(
    numbers: &mut [V; N],
    additions: &[V; N],
    [own, behind]: [usize; 2],
    state: &mut [V::Row],
    part: usize,
) {
    let mut carried: [V; N] = load(state, behind, part);
    for k in 0..N {
        (numbers[k], carried[k]) = carried_sum(numbers[k], additions[k], carried[k]);
        numbers[k].store(&mut state[own + k], part);
    }
    store(&carried, state, behind, part);
}

/// See [`kinematics::advance`]: carries frame and stretch over a step; the motion, and the Biot strain at its end.
#[inline(always)]
pub fn advance<V: Lanes, K: Kernel>(
    velocity_gradient: &Matrix3<V>,
    state: &mut [V::Row],
    part: usize,
    settings: &Settings,
) -> (Motion<V>, Sym3<V>) {
    let one = V::splat(1.0);
    let mut frame: [V; 4] = array![i in 4 => V::load(&state[rows::FRAME + i], part)];
    let beyond_one = Sym3::load(&state[rows::STRETCH..], part);
    let stretch = beyond_one.add_diagonal(one);
    let old = kinematics::rotation_matrix(&frame);
    let (time_step, second_order) = (V::splat(settings.time_step), settings.second_order_spin);
    let (strain, turn, growth) = kinematics::parts(velocity_gradient, &frame, &stretch, time_step, second_order);
    let behind = first::<K>();
    add(&mut frame, &turn, [rows::FRAME, behind + FRAME], state, part);
    let mut numbers = beyond_one.to_array();
    add(&mut numbers, &growth.to_array(), [rows::STRETCH, behind + STRETCH], state, part);
    let [xx, yy, zz, xy, yz, zx] = numbers;
    (kinematics::motion(strain, &old, &frame), Sym3 { xx, yy, zz, xy, yz, zx })
}

/// The strain of a step, and what stresses could not take in of those before.
#[inline(always)]
pub fn with_rest<V: Lanes, K: Kernel>(strain: &Sym3<V>, state: &[V::Row], part: usize) -> Sym3<V> {
    let [xx, yy, zz, xy, yz, zx] = load(state, first::<K>() + STRAIN, part);
    strain.zip(Sym3 { xx, yy, zz, xy, yz, zx }, |a, b| a + b)
}

/// Keeps what a stress has not taken in of `strain`. Where it has changed by something else than elasticity, mean and deviator
/// each for itself, nothing is kept: the difference is then far above what an addition loses.
#[inline(always)]
pub fn keep_rest<V: Lanes, K: Kernel>(
    strain: &Sym3<V>,
    [old, new]: [&Sym3<V>; 2],
    state: &mut [V::Row],
    part: usize,
    settings: &Settings,
) {
    let third = V::splat(1.0 / 3.0);
    let two_mu = 2.0 * settings.mu;
    let compliance = V::splat(1.0 / two_mu);
    let bulk = settings.dilatational - two_mu * (2.0 / 3.0);
    let change = new.zip(*old, |a, b| a - b);
    let mean = (strain.trace() - change.trace() * V::splat(1.0 / (3.0 * bulk))) * third;
    let deviator = strain.deviator().zip(change.deviator(), |e, s| e - s * compliance);
    // No component is larger than the root.
    let size = (new.contract(*new) + old.contract(*old)).sqrt();
    let limits = [size * V::splat(LOST / two_mu), size * V::splat(LOST / bulk)];
    let zero = V::splat(0.0);
    let small = |x: V, limit: V| V::select_less(x * x, limit * limit, x, zero);
    let mean = small(mean, limits[1]);
    let rest = deviator.to_array();
    let largest = deviator.contract(deviator);
    let bound = limits[0] * limits[0] * V::splat(6.0);
    let rest: [V; 6] = array![k in 6 => V::select_less(largest, bound, rest[k], zero)];
    let kept = [rest[0] + mean, rest[1] + mean, rest[2] + mean, rest[3], rest[4], rest[5]];
    store(&kept, state, first::<K>() + STRAIN, part);
}

/// Lets a control act; the stored resistance, and all of it.
#[inline(always)]
pub fn resist<V: Lanes, K: Kernel, H: hourglass::Control>(
    control: &H,
    rate: &Resistance<V>,
    old: &Resistance<V>,
    rows_of: &mut [V::Row],
    part: usize,
    of: &hourglass::State<V>,
) -> [Resistance<V>; 2] {
    let mut added = [[V::splat(0.0); 4]; 3];
    let alone = control.resist(rate, &mut added, of);
    let kept = control.kept(of);
    let behind = first::<K>() + HOURGLASS;
    let mut carried: [V; 12] = load(rows_of, behind, part);
    let mut stored = *old;
    for i in 0..3 {
        for a in 0..4 {
            let place = &mut carried[4 * i + a];
            // What a return scales, it rounds; only what was added is worth to be kept.
            (stored[i][a], *place) = carried_sum(old[i][a] * kept, added[i][a], *place * kept);
        }
    }
    store(&carried, rows_of, behind, part);
    let total = array![i in 3 => array![a in 4 => stored[i][a] + (alone[i][a] - added[i][a])]];
    [stored, total]
}

/// Books energy: the account is the place among internal, hourglass and viscous energy.
#[inline(always)]
pub fn book<V: Lanes>(energy: V, [account, law_rows]: [usize; 2], state: &mut [V::Row], part: usize) {
    let (own, behind) = (rows::INTERNAL_ENERGY + account, rows::LAW + law_rows + ENERGIES + account);
    accumulate_carried(energy, [own, behind], state, part);
}
