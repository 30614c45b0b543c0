//! What an element with an equation of state knows of its step before the law has found its stress; its accounts are those of
//! [`AccountRows`].

use super::fluid;
use super::geometry::{Corners, Gradient, Modes, dot, earlier, gradient, modes};
use super::hourglass::Resistance;
use super::kernel::hourglass_rates;
use super::kinematics::rotation_matrix;
use super::rows;
use super::single_precision::carried;
use crate::lanes::{CHUNK, Lanes, Matrix3, Row, Sym3, array};
use crate::material::{Kernel, KernelVisitor};
use crate::solver::elements::Group;
use crate::solver::elements::solids::exact::{self, AccountRows, StartPowers, Steps};
use crate::solver::nodes::Nodes;

/// Where the accounts are.
const ROWS: AccountRows = AccountRows {
    accounts: [rows::INTERNAL_ENERGY, rows::VISCOUS_ENERGY, rows::HOURGLASS_ENERGY],
    law: rows::LAW,
    carried: [carried::ENERGIES, carried::ENERGIES + 2, carried::ENERGIES + 1],
};

/// Rows of the forces on corners, of fluids.
pub fn corner_rows<K: Kernel>() -> std::ops::Range<usize> {
    ROWS.of_corners::<K>()
}

/// Row of the rate of the volume in the last pass, of fluids.
pub fn rate_row<K: Kernel>() -> usize {
    ROWS.of_rate::<K>()
}

/// What is known of a step's work before the law has found its stress, with Σ v_iI B_jI for its flow.
pub type Start<V> = exact::Start<V, Matrix3<V>>;

/// Σ v_iI B_jI
#[inline(always)]
fn flow<V: Lanes>(v: &[Modes<V>; 3], gradient: &Gradient<V>) -> Matrix3<V> {
    array![i in 3 => array![j in 3 => dot(&v[i], &gradient.g24[j]) * V::splat(1.0 / 192.0)]]
}

#[inline(always)]
fn trace<V: Lanes>(m: &Matrix3<V>) -> V {
    m[0][0] + m[1][1] + m[2][2]
}

/// Hourglass rates at a geometry, given Σ v_iI B_jI there.
#[inline(always)]
pub fn rates<V: Lanes>(v: &[Modes<V>; 3], x: &[Modes<V>; 3], flow: &Matrix3<V>, volume192: V) -> Resistance<V> {
    let inverse = V::splat(192.0) / volume192;
    hourglass_rates(v, x, &array![i in 3 => array![j in 3 => flow[i][j] * inverse]])
}

/// Σ Q_iα q̇_iα
#[inline(always)]
pub fn power<V: Lanes>(resistance: &Resistance<V>, rates: &Resistance<V>) -> V {
    let mut sum = V::splat(0.0);
    for i in 0..3 {
        for a in 0..4 {
            sum = sum + resistance[i][a] * rates[i][a];
        }
    }
    sum
}

/// From the positions at the end of a step and the velocities in it, and the element as the step before has left it.
#[inline(always)]
pub fn start<V: Lanes, K: Kernel>(
    [x, v]: [&[Modes<V>; 3]; 2],
    [positions, velocities]: [&[Corners<V>; 3]; 2],
    state: &[V::Row],
    part: usize,
    steps: Steps,
) -> Start<V> {
    let time_step = V::splat(steps.time_step);
    let before = earlier([x, v], time_step);
    let gradient_before = gradient(&before);
    let flow_before = flow(v, &gradient_before);
    let flow = flow(v, &gradient(x));
    let growth = trace(&flow);

    let stress = Sym3::load(&state[rows::STRESS..], part);
    let viscous = V::load(&state[rows::VISCOUS_STRESS], part);
    let of_stress = if K::FLUID {
        stress.xx * trace(&flow_before)
    } else {
        let frame = array![i in 4 => V::load(&state[rows::FRAME + i], part)];
        stress.rotate(&rotation_matrix(&frame)).contract(Sym3::of(&flow_before))
    };
    let mut of_modes = V::splat(0.0);
    if K::FLUID {
        let resistance: Resistance<V> =
            array![i in 3 => array![a in 4 => V::load(&state[rows::HOURGLASS + 4 * i + a], part)]];
        of_modes = power(&resistance, &rates(v, &before, &flow_before, gradient_before.volume192));
        let before: [Corners<V>; 3] =
            array![i in 3 => array![n in 8 => positions[i][n] - time_step * velocities[i][n]]];
        of_modes = of_modes + fluid::power(&before, velocities, &state[corner_rows::<K>()], part);
    }
    let powers = StartPowers { stress: of_stress, viscous: [viscous, trace(&flow_before)], modes: of_modes };
    Start::new::<K>(&ROWS, &powers, (flow, growth), state, part, steps)
}

/// Finds the work that the last forces of an element which goes have done, where it has an equation of state.
pub struct LastWork<'a> {
    /// Where it is.
    pub group: &'a Group,
    /// Which it is.
    pub i: usize,
    /// Its nodes.
    pub nodes: &'a Nodes,
    /// The step that led to where they are.
    pub steps: Steps,
}

impl KernelVisitor for LastWork<'_> {
    type Output = Option<f64>;

    fn visit<K: Kernel>(self, _: K) -> Option<f64> {
        if !K::EQUATION {
            return None;
        }
        let LastWork { group, i, nodes, steps } = self;
        let state: Vec<Row> = (0..rows::LAW + K::STATE.len()).map(|row| Row([group.value(i, row); CHUNK])).collect();
        let relative = |of: [[f64; 3]; 8]| [0, 1, 2].map(|k: usize| of.map(|own| own[k] - of[0][k]));
        let (x, v) = (relative(group.positions(i, nodes)), relative(group.velocities(i, nodes)));
        let modes = [&x, &v].map(|of| [0, 1, 2].map(|k: usize| modes(&of[k])));
        let work = start::<_, K>([&modes[0], &modes[1]], [&x, &v], &state, 0, steps).work();
        // An element that dies inverted may have moved beyond all measure.
        Some(if work.is_finite() { work } else { 0.0 })
    }
}
