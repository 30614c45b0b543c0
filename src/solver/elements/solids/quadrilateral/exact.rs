//! What an element with an equation of state knows of its step before the law has found its stress; its accounts are those of
//! [`AccountRows`].

use super::fluid;
use super::kernel::{Rates, load, rates, rotated, solid, weighted_modes};
use super::kinematics::Flat;
use super::rows;
use super::sections::{Corners, Section};
use crate::lanes::{CHUNK, Lanes, Row, array};
use crate::material::{Kernel, KernelVisitor};
use crate::solver::elements::Group;
use crate::solver::elements::solids::exact::{self, AccountRows, StartPowers, Steps};
use crate::solver::nodes::Nodes;

/// Where the accounts are.
const ROWS: AccountRows = AccountRows {
    accounts: [rows::INTERNAL_ENERGY, rows::VISCOUS_ENERGY, rows::HOURGLASS_ENERGY],
    law: rows::LAW,
    carried: [0; 3],
};

/// Rows of the forces on corners, of fluids: one each, and of the eight that there are the last four stay free.
pub fn corner_rows<K: Kernel>() -> std::ops::Range<usize> {
    ROWS.of_corners::<K>()
}

/// Row of the rate of the volume in the last pass, of fluids.
pub fn rate_row<K: Kernel>() -> usize {
    ROWS.of_rate::<K>()
}

/// What is known of a step's work before the law has found its stress, with the rates of strain times the volume for its flow.
pub type Start<V> = exact::Start<V, Rates<V>>;

/// Power of a stress in space, xx, yy, zz and xy, given the rates of strain times the volume.
#[inline(always)]
pub fn power_of_stress<V: Lanes>([xx, yy, zz, xy]: &Flat<V>, flow: &Rates<V>) -> V {
    let [[rr, rz], [zr, zz_rate]] = flow.gradient;
    (*xx * rr + *yy * zz_rate) + (*zz * flow.hoop + *xy * (rz + zr))
}

/// Rates at a geometry as forces see them, those of strain times the volume of the whole turn.
#[inline(always)]
fn flow<V: Lanes>(section: Section, v: &[Corners<V>; 2], x: &[Corners<V>; 2]) -> Rates<V> {
    let operator = section.operator(x);
    let inverse_area = V::splat(1.0) / operator.area;
    let operator = section.of_forces(operator, x);
    let mut flow = rates(section.about_axis(), &operator, v, x, [V::splat(section.turn()), inverse_area]);
    if let Some((weights, _)) = section.weights(x) {
        flow.hourglass = weighted_modes(&operator, [x, v], inverse_area, &weights);
    }
    flow
}

/// From the positions at the end of a step and the velocities in it, and the element as the step before has left it.
#[inline(always)]
pub fn start<V: Lanes, K: Kernel>(
    section: Section,
    [x, v]: [&[Corners<V>; 2]; 2],
    state: &[V::Row],
    part: usize,
    steps: Steps,
) -> Start<V> {
    let time_step = V::splat(steps.time_step);
    let before: [Corners<V>; 2] =
        [array![i in 4 => x[0][i] - time_step * v[0][i]], array![i in 4 => x[1][i] - time_step * v[1][i]]];
    let flow_before = flow(section, v, &before);
    let flow = flow(section, v, x);
    let growth = trace(&flow);

    let frame = [V::load(&state[rows::FRAME], part), V::load(&state[rows::FRAME + 1], part)];
    let stress = rotated(&solid(load(state, rows::STRESS, part)), &frame, V::splat(0.0));
    let viscous = V::load(&state[rows::VISCOUS_STRESS], part);
    let of_stress = power_of_stress(&stress, &flow_before);
    let mut of_modes = V::splat(0.0);
    if K::FLUID {
        let resistance = [V::load(&state[rows::HOURGLASS], part), V::load(&state[rows::HOURGLASS + 1], part)];
        of_modes = fluid::power_of_modes(&resistance, &flow_before.hourglass)
            + fluid::power([&before, v], &state[corner_rows::<K>()], part, section.weights(&before).as_ref());
    }
    let powers = StartPowers { stress: of_stress, viscous: [viscous, trace(&flow_before)], modes: of_modes };
    Start::new::<K>(&ROWS, &powers, (flow, growth), state, part, steps)
}

#[inline(always)]
fn trace<V: Lanes>(flow: &Rates<V>) -> V {
    (flow.gradient[0][0] + flow.gradient[1][1]) + flow.hoop
}

/// Finds the work that the last forces of an element which goes have done, where it has an equation of state.
pub struct LastWork<'a> {
    /// What the third dimension is.
    pub section: Section,
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
        let LastWork { section, group, i, nodes, steps } = self;
        let state: Vec<Row> = (0..rows::LAW + K::STATE.len()).map(|row| Row([group.value(i, row); CHUNK])).collect();
        let (at, v): ([[f64; 3]; 4], [[f64; 3]; 4]) = (group.positions(i, nodes), group.velocities(i, nodes));
        // The axis stays where it is.
        let x = [at.map(|own| own[0]), at.map(|own| own[1] - at[0][1])];
        let v = [0, 1].map(|k: usize| v.map(|own| own[k]));
        let work = start::<_, K>(section, [&x, &v], &state, 0, steps).work();
        // An element that dies inverted may have moved beyond all measure.
        Some(if work.is_finite() { work } else { 0.0 })
    }
}
