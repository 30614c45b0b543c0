//! The four-node quadrilateral with one integration point: one step of one part of a chunk.

use super::end::{End, Frequency, hourglass_vector};
use super::exact::{self, Start, power_of_stress, rate_row};
use super::fluid;
use super::kinematics::{self, Flat, Motion};
use super::rows;
use super::sections::{Corners, Operator, Section};
use crate::lanes::{Lanes, Sym3, array};
use crate::material::{Kernel, Step};
use crate::model::{BulkViscosity, Hourglass};
use crate::solver::elements::ahead::Ahead;
use crate::solver::elements::bulk_viscosity::{damped_step, damping, softened};
use crate::solver::elements::pass::{Given, Outcome, StepKernel};
use crate::solver::elements::solids::answer::Answer;
use crate::solver::elements::solids::exact::Steps;
use crate::solver::elements::solids::fluid::{gentle_step, jump};
use crate::solver::elements::state_rows::{accumulate, store};

/// Numbers that hold for a whole block and step.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// Time step Δt that led to the present positions.
    pub time_step: f64,
    /// Mean of that step and the one before it.
    pub kick: f64,
    /// Time of the present positions.
    pub time: f64,
    /// Initial mass density.
    pub density: f64,
    /// Elastic dilatational modulus λ + 2μ.
    pub dilatational: f64,
    /// Shear modulus μ.
    pub mu: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Bulk viscosity.
    pub viscosity: BulkViscosity,
    /// Whether the stable step follows the moduli of the last increment instead of the elastic ones.
    pub effective_moduli: bool,
    /// Hourglass control.
    pub control: Hourglass,
}

impl Settings {
    /// The step that is booked.
    pub fn steps(&self) -> Steps {
        Steps { time_step: self.time_step, kick: self.kick }
    }
}

/// What holds for a whole block: numbers and law.
#[derive(Debug, Clone, Copy)]
pub struct Physics<'a, K> {
    /// Numbers.
    pub settings: Settings,
    /// Constitutive law.
    pub law: &'a K,
    /// Plane strain or axisymmetry. Asked at run time: kernels of each would take twice as long to compile.
    pub section: Section,
}

#[inline(always)]
pub(super) fn load<V: Lanes>(state: &[V::Row], first: usize, part: usize) -> [V; 4] {
    array![i in 4 => V::load(&state[first + i], part)]
}

#[inline(always)]
pub(super) fn dot<V: Lanes>(a: &Corners<V>, b: &Corners<V>) -> V {
    (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])
}

/// Γ · a with Γ = (1, −1, 1, −1).
#[inline(always)]
pub(super) fn mode<V: Lanes>(a: &Corners<V>) -> V {
    (a[0] - a[1]) + (a[2] - a[3])
}

/// A tensor of the plane as one of space.
#[inline(always)]
pub fn solid<V: Lanes>([xx, yy, zz, xy]: Flat<V>) -> Sym3<V> {
    let zero = V::splat(0.0);
    Sym3 { xx, yy, zz, xy, yz: zero, zx: zero }
}

impl<K: Kernel> StepKernel<4> for Physics<'_, K> {
    const NEIGHBOURS: bool = K::FLUID;

    #[inline(always)]
    fn about_axis(&self) -> bool {
        self.section.about_axis()
    }

    #[inline(always)]
    fn step<V: Lanes>(
        &self,
        positions: &[Corners<V>; 3],
        velocities: &[Corners<V>; 3],
        state: &mut [V::Row],
        part: usize,
        given: Given<V, 4>,
        _: &mut Ahead<V::Row>,
    ) -> Outcome<V, 4> {
        step([[positions[0], positions[1]], [velocities[0], velocities[1]]], state, part, given, self)
    }
}

/// One step of the elements of one part of a chunk, from corner positions and mid-step velocities.
#[inline(always)]
fn step<V: Lanes, K: Kernel>(
    [x, v]: [[Corners<V>; 2]; 2],
    state: &mut [V::Row],
    part: usize,
    given: Given<V, 4>,
    Physics { settings, law, section }: &Physics<K>,
) -> Outcome<V, 4> {
    let zero = V::splat(0.0);
    let compatible = K::EQUATION && *section == Section::Compatible;
    // (o) what the forces of the step's start have done, where that is heat
    let start =
        if K::EQUATION { Some(exact::start::<V, K>(*section, [&x, &v], state, part, settings.steps())) } else { None };

    // (i) velocity gradient and hourglass rates at mid-step, (ii) frame, stretch and strain increment
    let middle = Middle::of(*section, compatible, [&x, &v], settings);
    let turned = middle.turn(state, part, settings);

    // (iii) stress
    let operator = section.operator(&x);
    let inverse_volume = V::splat(settings.density) / given.material;
    let volumes = [operator.volume * V::splat(section.turn()), middle.volume, inverse_volume];
    let answer = answer(*law, seen_by_law(&start, volumes, &turned, settings), state, part);
    if !K::EQUATION {
        let power = answer.work_on(turned.strain);
        accumulate(power * middle.volume, &mut state[rows::INTERNAL_ENERGY], part);
    }

    // (iv) stable step 2/ω and bulk viscosity in the new configuration
    let mut masses: Corners<V> = load(state, rows::INVERSE_MASS, part);
    let end = End::of((*section, compatible), [&x, &v], operator, &turned.frames[1], &mut masses);
    let moduli = answer.moduli::<K>(&turned.strain, [settings.dilatational, settings.mu], settings.effective_moduli);
    let frequency = end.frequency(&moduli, &masses, given.moving, settings);
    let slowed = bulk_viscosity::<V, K>(
        (&frequency, answer.response.answering),
        (&end, &middle),
        &given.rates,
        state,
        part,
        settings,
    );
    if !K::EQUATION {
        let power = slowed.mean_stress * turned.strain.trace();
        accumulate(power * middle.volume, &mut state[rows::VISCOUS_ENERGY], part);
    }

    // (v) hourglass resistance in the frame, or of a fluid; with an equation of state the accounts are closed
    let total = rotated(&answer.stress, &turned.frames[1], zero);
    let mut powers = [zero; 3];
    if let Some(start) = &start {
        powers = [power_of_stress(&total, &start.flow), slowed.stress * start.growth, zero];
    }
    let (resistance, lever, held) = if let (true, Some(start)) = (K::FLUID, &start) {
        let (resistance, held) = end.resist_as_fluid::<K>((start, &slowed), state, part, settings);
        powers[2] = fluid::power_of_modes(&resistance, &start.flow.hourglass) + held.power;
        (resistance, V::splat(1.0), held)
    } else {
        let returned = [moduli.shear, answer.response.returned, slowed.stable_step];
        let (resistance, stable_step) = end.resist_as_solid((&middle, &turned), returned, state, part, settings);
        (resistance, end.thickness, fluid::Held::nothing(stable_step))
    };
    let mut stable_step = held.stable_step;
    if let Some(start) = &start {
        start.finish::<K>(powers, state, part, settings.steps());
        let shorter = if compatible { stable_step * frequency.shorter() } else { stable_step };
        let gentle = gentle_step(start.growth / end.volume, shorter);
        stable_step = law.longest_step(settings.time, &state[rows::LAW..], part, gentle);
    }
    // An element that passed through itself within the step has failed, even if it looks sound at the end.
    let least = middle.volume.min(end.volume).min(end.operator.area);
    let stable_step = V::select_less(zero, least, stable_step, zero);

    // (vi) corner forces from the rotated stress
    let [xx, yy, zz, xy] = total;
    let total = [xx + slowed.stress, yy + slowed.stress, zz + slowed.stress, xy];
    let mut force = end.forces(&total, &resistance, lever);
    if K::FLUID {
        for i in 0..2 {
            force[i] = array![n in 4 => force[i][n] + held.force[i][n]];
        }
    }
    Outcome { force, stable_step, motion_step: stable_step, rate: if K::FLUID { slowed.rate } else { zero } }
}

/// What is known of the middle of the step.
pub(super) struct Middle<V> {
    rates: Rates<V>,
    /// Rates of the modes that the resistance works on; they differ only where forces are not the operator's of rates.
    pub(super) worked_rate: [V; 2],
    /// Volume of the whole turn, or of a unit of thickness.
    volume: V,
    /// Volume over area.
    pub(super) thickness: V,
}

impl<V: Lanes> Middle<V> {
    #[inline(always)]
    fn of(section: Section, compatible: bool, [x, v]: [&[Corners<V>; 2]; 2], settings: &Settings) -> Middle<V> {
        let (turn, half_step) = (section.turn(), V::splat(0.5 * settings.time_step));
        let middle: [Corners<V>; 2] =
            [array![i in 4 => x[0][i] - half_step * v[0][i]], array![i in 4 => x[1][i] - half_step * v[1][i]]];
        let operator = section.operator(&middle);
        let inverses = section.inverses(&operator);
        let rates = rates(section.about_axis(), &operator, v, &middle, inverses);
        let volume = operator.volume * V::splat(turn);
        let mut thickness = if section.about_axis() { volume * inverses[1] } else { V::splat(1.0) };
        let mut worked_rate = rates.hourglass;
        if let (true, Some((weights, mean))) = (compatible, section.weights(&middle)) {
            worked_rate = weighted_modes(&operator, [&middle, v], inverses[1], &weights);
            thickness = mean * V::splat(turn);
        }
        Middle { rates, worked_rate, volume, thickness }
    }

    /// Carries frame and stretch over the step.
    #[inline(always)]
    fn turn(&self, state: &mut [V::Row], part: usize, settings: &Settings) -> Turned<V> {
        let Rates { gradient, hoop, .. } = &self.rates;
        let frame = [V::load(&state[rows::FRAME], part), V::load(&state[rows::FRAME + 1], part)];
        let mut stretch: Flat<V> = load(state, rows::STRETCH, part);
        let Motion { strain, frame, middle } =
            kinematics::advance(gradient, *hoop, frame, &mut stretch, V::splat(settings.time_step));
        store(frame, state, rows::FRAME, part);
        store(stretch, state, rows::STRETCH, part);
        Turned { strain: solid(strain), stretch: solid(stretch), frames: [middle, frame] }
    }

    /// Rates of the modes in space.
    pub(super) fn hourglass_rate(&self) -> &[V; 2] {
        &self.rates.hourglass
    }

    /// Rate of the volume, over it.
    #[inline(always)]
    fn growth(&self) -> V {
        self.rates.gradient[0][0] + self.rates.gradient[1][1] + self.rates.hoop
    }
}

/// How the element has turned and stretched.
pub(super) struct Turned<V> {
    /// Strain increment in the frame.
    strain: Sym3<V>,
    stretch: Sym3<V>,
    /// Cosine and sine of the frame's angle in the middle of the step and at its end.
    pub(super) frames: [[V; 2]; 2],
}

/// What a law may look at, given the volumes at the end and in the middle of the step and one over that at the start of all.
#[inline(always)]
fn seen_by_law<V: Lanes>(
    start: &Option<Start<V>>,
    [volume, middle_volume, inverse_volume]: [V; 3],
    turned: &Turned<V>,
    settings: &Settings,
) -> Step<V> {
    let [energy, swept] = Start::per_volume(start, inverse_volume);
    Step {
        strain: turned.strain,
        biot_strain: turned.stretch.add_diagonal(V::splat(-1.0)),
        volume: volume * inverse_volume,
        middle_volume: middle_volume * inverse_volume,
        energy,
        swept,
        time: settings.time,
        time_step: settings.time_step,
    }
}

#[inline(always)]
fn answer<V: Lanes, K: Kernel>(law: &K, seen: Step<V>, state: &mut [V::Row], part: usize) -> Answer<V> {
    let old = solid(load(state, rows::STRESS, part));
    let mut stress = old;
    let response = law.update(&seen, &mut stress, &mut state[rows::LAW..], part);
    store([stress.xx, stress.yy, stress.zz, stress.xy], state, rows::STRESS, part);
    Answer { old, stress, response }
}

/// Bulk viscosity, and the steps that it leaves.
pub(super) struct Slowed<V> {
    /// Its mean stress at the end of the step.
    stress: V,
    /// Mean of those at start and end.
    mean_stress: V,
    /// Rate at which the volume grows, over it.
    rate: V,
    /// The stable step.
    pub(super) stable_step: V,
    /// The same where all of the viscosity acts.
    pub(super) least_step: V,
}

/// Finds the viscous stress and stores it; `neighbours` are the mean rates of the elements at the corners.
#[inline(always)]
fn bulk_viscosity<V: Lanes, K: Kernel>(
    (frequency, answering): (&Frequency<V>, V),
    (end, middle): (&End<V>, &Middle<V>),
    neighbours: &Corners<V>,
    state: &mut [V::Row],
    part: usize,
    settings: &Settings,
) -> Slowed<V> {
    let (bound, rate) = (frequency.bound, middle.growth());
    let whole = damping(settings.viscosity, bound, rate);
    let mut damping =
        if K::CRUSHES { softened(settings.viscosity, whole, answering / frequency.modulus) } else { whole };
    if K::FLUID {
        let row = &mut state[rate_row::<K>()];
        let acts = jump([V::load(row, part), rate], &fluid::across(neighbours));
        // Elements along the axis of Galerkin's form need all of it: without, they are squeezed flat behind a shock.
        damping = if end.compatible || !end.section.about_axis() { whole * acts } else { whole };
        rate.store(row, part);
    }
    let stress = damping * frequency.modulus * bound * rate;
    let last = V::load(&state[rows::VISCOUS_STRESS], part);
    stress.store(&mut state[rows::VISCOUS_STRESS], part);
    Slowed {
        stress,
        mean_stress: (last + stress) * V::splat(0.5),
        rate,
        stable_step: damped_step(bound, if K::CRUSHES { whole } else { damping }),
        least_step: if K::FLUID { damped_step(bound, whole) } else { bound },
    }
}

/// Rates of an element.
pub(super) struct Rates<V> {
    /// L in the plane.
    pub gradient: [[V; 2]; 2],
    /// Rate across it.
    pub hoop: V,
    /// q̇_i = v_i · γ.
    pub hourglass: [V; 2],
}

/// Rates at a geometry; those of strain come as sums over the corners, per radian where there is an axis, times `inverse`. `scale`
/// is one over the area.
#[inline(always)]
pub(super) fn rates<V: Lanes>(
    about_axis: bool,
    operator: &Operator<V>,
    v: &[Corners<V>; 2],
    x: &[Corners<V>; 2],
    [inverse, scale]: [V; 2],
) -> Rates<V> {
    // Relative to the first corner, so that a ring that grows fast as a whole costs no digits.
    let radial: Corners<V> = if about_axis { array![i in 4 => v[0][i] - v[0][0]] } else { v[0] };
    let Operator { radial: g, axial: h, .. } = operator;
    let gradient =
        [[dot(g, &radial) * inverse, dot(h, &radial) * inverse], [dot(g, &v[1]) * inverse, dot(h, &v[1]) * inverse]];
    let hoop = if about_axis { dot(&operator.hoop, &v[0]) * inverse } else { V::splat(0.0) };
    // γ = Γ − B_j (x_j·Γ)/A is orthogonal to linear fields of the plane.
    let [bx, by] = &operator.plane;
    let (hx, hy) = (mode(&x[0]) * scale, mode(&x[1]) * scale);
    let along = mode(&radial) - (dot(bx, &radial) * hx + dot(by, &radial) * hy);
    let across = mode(&v[1]) - (dot(bx, &v[1]) * hx + dot(by, &v[1]) * hy);
    Rates { gradient, hoop, hourglass: [along, across] }
}

/// Rates of the modes that forces with these weights work on: Σ w_I γ_I v_iI.
#[inline(always)]
pub(super) fn weighted_modes<V: Lanes>(
    operator: &Operator<V>,
    [x, v]: [&[Corners<V>; 2]; 2],
    inverse_area: V,
    weights: &Corners<V>,
) -> [V; 2] {
    let gamma = hourglass_vector(operator, x, inverse_area);
    let gamma: Corners<V> = array![i in 4 => gamma[i] * weights[i]];
    [dot(&gamma, &v[0]), dot(&gamma, &v[1])]
}

/// Cauchy stress in space with bulk viscosity: xx, yy, zz, xy.
#[inline(always)]
pub(super) fn rotated<V: Lanes>(stress: &Sym3<V>, [c, s]: &[V; 2], viscous: V) -> Flat<V> {
    let (cc, ss, cs) = (*c * *c, *s * *s, *c * *s);
    let shear = (stress.xy + stress.xy) * cs;
    [
        cc * stress.xx + ss * stress.yy - shear + viscous,
        ss * stress.xx + cc * stress.yy + shear + viscous,
        stress.zz + viscous,
        (stress.xx - stress.yy) * cs + stress.xy * (cc - ss),
    ]
}
