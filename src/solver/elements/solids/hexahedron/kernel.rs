//! The eight-node hexahedron with one integration point (Flanagan and Belytschko 1981): one step of one chunk.

use super::barrier::shared_step;
use super::end::End;
use super::exact::{self, Start};
use super::fluid;
use super::geometry::{self, Corners, Gradient, HOURGLASS, Modes, dot, earlier, gradient, modes};
use super::hourglass::{self, Resistance};
use super::kinematics::{self, Motion};
use super::rows;
use super::single_precision::carried;
use crate::lanes::{Lanes, Matrix3, Sym3, array};
use crate::material::{Kernel, Step};
use crate::model::BulkViscosity;
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
    /// Elastic dilatational modulus λ + 2μ, force/length².
    pub dilatational: f64,
    /// Shear modulus μ, force/length².
    pub mu: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Bulk viscosity.
    pub viscosity: BulkViscosity,
    /// Whether the stable step follows the moduli of the last increment instead of the elastic ones.
    pub effective_moduli: bool,
    /// Whether the spin of the frame takes the stretch in the middle of the step instead of that at its start.
    pub second_order_spin: bool,
}

impl Settings {
    /// Mode of the corners' velocities, the sum of four differences, below which single precision takes it for none.
    pub fn least_velocity(&self) -> f64 {
        STILL * (self.dilatational / self.density).sqrt()
    }

    /// The step that is booked.
    pub fn steps(&self) -> Steps {
        Steps { time_step: self.time_step, kick: self.kick }
    }
}

/// The bound of the step is rigorous, and must stay so when it is made of rounded numbers: a step beyond it by 10⁻⁷ lets a mode
/// grow by 10⁻³.
const ROUNDED_BOUND: f64 = 1.0 - 4e-6;

/// Modes of velocities below this part of the speed of sound count as none in single precision: the squares of most of
/// them, and third powers and lost digits of all, would be smaller than its normal numbers, and some processors take a
/// hundred times as long for each of those. A strain that grows by as little in each of 10⁶ steps as long as a wave takes
/// through an element comes to less than 10⁻⁹.
const STILL: f64 = 1.0 / (1u64 << 50) as f64;

/// Modes of velocities, in single precision without those too slow to matter: bodies ahead of a wave are full of them.
#[inline(always)]
fn without_the_slowest<V: Lanes>(velocities: Modes<V>, settings: &Settings) -> Modes<V> {
    if !V::SINGLE {
        return velocities;
    }
    let (least, zero) = (V::splat(settings.least_velocity()), V::splat(0.0));
    array![k in 7 => V::select_less(velocities[k].abs(), least, zero, velocities[k])]
}

/// What holds for a whole block: numbers, law and hourglass control.
#[derive(Debug, Clone, Copy)]
pub struct Physics<'a, K, H> {
    /// Numbers.
    pub settings: Settings,
    /// Constitutive law.
    pub law: &'a K,
    /// Hourglass control.
    pub control: &'a H,
}

impl<K: Kernel, H: hourglass::Control> StepKernel<8> for Physics<'_, K, H> {
    const NEIGHBOURS: bool = K::FLUID;
    const MOVES_FAR: bool = K::HYPOELASTIC;
    const PAUSES: usize = 3;

    #[inline(always)]
    fn step<V: Lanes>(
        &self,
        positions: &[Corners<V>; 3],
        velocities: &[Corners<V>; 3],
        state: &mut [V::Row],
        part: usize,
        given: Given<V, 8>,
        ahead: &mut Ahead<V::Row>,
    ) -> Outcome<V, 8> {
        step(positions, velocities, state, part, given, self, ahead)
    }
}

/// One step of the elements of one part of a chunk: from corner positions and mid-step velocities, both relative to
/// the first corner, to stresses, energies, corner forces and the stable step.
#[inline(always)]
fn step<V: Lanes, K: Kernel, H: hourglass::Control>(
    positions: &[Corners<V>; 3],
    velocities: &[Corners<V>; 3],
    state: &mut [V::Row],
    part: usize,
    given: Given<V, 8>,
    Physics { settings, law, control }: &Physics<K, H>,
    ahead: &mut Ahead<V::Row>,
) -> Outcome<V, 8> {
    let zero = V::splat(0.0);
    let x: [Modes<V>; 3] = array![i in 3 => modes(&positions[i])];
    let v: [Modes<V>; 3] = array![i in 3 => without_the_slowest(modes(&velocities[i]), settings)];

    // (o) what the forces of the step's start have done, where that is heat
    let start = if K::EQUATION {
        Some(exact::start::<V, K>([&x, &v], [positions, velocities], state, part, settings.steps()))
    } else {
        None
    };

    // (i) velocity gradient and hourglass rates at mid-step, (ii) frame, stretch and strain increment
    let middle = Middle::of([&x, &v], settings);
    let (motion, biot_strain) = turn::<V, K>(&middle.velocity_gradient, state, part, settings);
    ahead.pause::<V>();

    // (iii) stress
    let volumes = [middle.volume(), V::splat(settings.density) / given.material];
    let seen = seen_by_law::<V, K>(&x, &start, volumes, (motion.strain, biot_strain), settings);
    let answer = answer(*law, seen, state, part, settings);
    let mut work = answer.work_on(motion.strain) * middle.volume();

    // (iv) stable step √(M V / 2(λ+2μ) B:B) and bulk viscosity in the new configuration; the bound holds for an eighth of
    // M at each corner, so M is what eight of the lightest make up
    let end = End::of([&x, &v], given.moving * given.least_share);
    let moduli = answer.moduli::<K>(&motion.strain, [settings.dilatational, settings.mu], settings.effective_moduli);
    let slowed = bulk_viscosity::<V, K>(
        (&middle, &end),
        [moduli.step, answer.response.answering],
        &given.rates,
        state,
        part,
        settings,
    );
    if !K::EQUATION {
        book::<V, K>(slowed.power * motion.strain.trace() * middle.volume(), VISCOUS, state, part);
    }
    ahead.pause::<V>();

    // (v) hourglass resistance in the frame, or of a fluid; with an equation of state the accounts are closed
    let mut held = [[zero; 8]; 3];
    let (resistance, mut stable_step) = if let (true, Some(start)) = (K::FLUID, &start) {
        let (of_modes, rates, corners) =
            end.resist_as_fluid::<K, H>(*control, [positions, velocities], (start, &slowed), state, part, settings);
        held = corners.force;
        let taken = exact::power(&of_modes, &rates) + corners.power;
        let powers = [answer.stress.xx * start.growth, slowed.stress * start.growth, taken];
        start.finish::<K>(powers, state, part, settings.steps());
        (of_modes, corners.stable_step)
    } else {
        let returned = [moduli.shear, answer.response.returned, slowed.stable_step];
        end.resist_as_solid::<K, H>(*control, (&middle.hourglass_rate, &motion), returned, state, part, settings)
    };

    // (vi) the barrier against elements of no volume, and what else bounds the step
    let mut viscous = slowed.stress;
    let mut motion_step = V::splat(f64::MAX);
    let initial192 = V::splat(192.0 / settings.density) * given.material;
    if let Some(barrier) = end.barrier::<K>(middle.volume192, initial192, slowed.rate * stable_step, settings) {
        viscous = viscous + barrier.stress;
        stable_step = shared_step(stable_step, barrier.stiffness, end.light);
        motion_step = barrier.motion_step;
        work = work + barrier.work;
    }
    // Once a step: in single precision nothing more is something, in a sum that keeps what it loses.
    if !K::EQUATION {
        book::<V, K>(work, INTERNAL, state, part);
    }
    let stable_step = match &start {
        Some(start) => {
            let gentle = gentle_step(start.growth * V::splat(192.0) * end.inverse, stable_step);
            law.longest_step(settings.time, &state[rows::LAW..], part, gentle)
        }
        None => stable_step,
    };
    // An element that passed through itself within the step has failed, even if it looks sound at the end.
    let stable_step = V::select_less(zero, middle.volume192, stable_step, zero);
    let stable_step = if V::SINGLE { stable_step * V::splat(ROUNDED_BOUND) } else { stable_step };
    ahead.pause::<V>();

    // (vii) corner forces from the rotated stress
    let turned = answer.stress.rotate(&motion.frame);
    if let (false, Some(start)) = (K::FLUID, &start) {
        let powers = [turned.contract(Sym3::of(&start.flow)), viscous * start.growth, zero];
        start.finish::<K>(powers, state, part, settings.steps());
    }
    let mut force = corner_forces(&turned.add_diagonal(viscous), &resistance, &x, &end.gradient.g24, end.inverse);
    if K::FLUID {
        force = array![i in 3 => array![n in 8 => force[i][n] + held[i][n]]];
    }
    Outcome { force, stable_step, motion_step, rate: if K::FLUID { slowed.rate } else { zero } }
}

/// What is known of the middle of the step.
struct Middle<V> {
    /// ∂v_i/∂x_j
    velocity_gradient: Matrix3<V>,
    /// In space.
    hourglass_rate: Resistance<V>,
    /// 192 times the volume.
    volume192: V,
}

impl<V: Lanes> Middle<V> {
    #[inline(always)]
    fn of([x, v]: [&[Modes<V>; 3]; 2], settings: &Settings) -> Self {
        let middle = earlier([x, v], V::splat(0.5 * settings.time_step));
        let Gradient { g24, volume192 } = gradient(&middle);
        let inverse = V::splat(1.0) / volume192;
        let velocity_gradient: Matrix3<V> = array![i in 3 => array![j in 3 => dot(&v[i], &g24[j]) * inverse]];
        let hourglass_rate = hourglass_rates(v, &middle, &velocity_gradient);
        Middle { velocity_gradient, hourglass_rate, volume192 }
    }

    #[inline(always)]
    fn volume(&self) -> V {
        self.volume192 * V::splat(1.0 / 192.0)
    }
}

/// Carries frame and stretch over the step: the motion, and the Biot strain at its end.
#[inline(always)]
fn turn<V: Lanes, K: Kernel>(
    velocity_gradient: &Matrix3<V>,
    state: &mut [V::Row],
    part: usize,
    settings: &Settings,
) -> (Motion<V>, Sym3<V>) {
    if V::SINGLE {
        return carried::advance::<V, K>(velocity_gradient, state, part, settings);
    }
    let time_step = V::splat(settings.time_step);
    let mut frame = array![i in 4 => V::load(&state[rows::FRAME + i], part)];
    let mut stretch = Sym3::load(&state[rows::STRETCH..], part);
    let motion =
        kinematics::advance(velocity_gradient, &mut frame, &mut stretch, time_step, settings.second_order_spin);
    store(frame, state, rows::FRAME, part);
    store(stretch.to_array(), state, rows::STRETCH, part);
    (motion, stretch.add_diagonal(V::splat(-1.0)))
}

/// What a law may look at, given the volume in the middle of the step and one over that at the start of all.
#[inline(always)]
fn seen_by_law<V: Lanes, K: Kernel>(
    x: &[Modes<V>; 3],
    start: &Option<Start<V>>,
    [middle_volume, inverse_volume]: [V; 2],
    (strain, biot_strain): (Sym3<V>, Sym3<V>),
    settings: &Settings,
) -> Step<V> {
    let [energy, swept] = Start::per_volume(start, inverse_volume);
    Step {
        strain,
        biot_strain,
        volume: if K::VOLUME { volume(x) * inverse_volume } else { V::splat(1.0) },
        middle_volume: middle_volume * inverse_volume,
        energy,
        swept,
        time: settings.time,
        time_step: settings.time_step,
    }
}

#[inline(always)]
fn answer<V: Lanes, K: Kernel>(
    law: &K,
    seen: Step<V>,
    state: &mut [V::Row],
    part: usize,
    settings: &Settings,
) -> Answer<V> {
    let old = Sym3::load(&state[rows::STRESS..], part);
    let mut stress = old;
    let carries = V::SINGLE && K::HYPOELASTIC;
    let felt = if carries { carried::with_rest::<V, K>(&seen.strain, state, part) } else { seen.strain };
    let response = law.update(&Step { strain: felt, ..seen }, &mut stress, &mut state[rows::LAW..], part);
    store(stress.to_array(), state, rows::STRESS, part);
    if carries {
        carried::keep_rest::<V, K>(&felt, [&old, &stress], state, part, settings);
    }
    Answer { old, stress, response }
}

/// Bulk viscosity, and the steps that it leaves.
pub(super) struct Slowed<V> {
    /// Its mean stress at the end of the step.
    stress: V,
    /// Mean of those at start and end.
    power: V,
    /// Rate at which the volume grows, over it.
    rate: V,
    /// The stable step.
    pub(super) stable_step: V,
    /// The one where all of the viscosity acts: a limiter sees no modes.
    pub(super) whole_step: V,
}

#[inline(always)]
fn bulk_viscosity<V: Lanes, K: Kernel>(
    (middle, end): (&Middle<V>, &End<V>),
    [modulus, answering]: [V; 2],
    neighbours: &Corners<V>,
    state: &mut [V::Row],
    part: usize,
    settings: &Settings,
) -> Slowed<V> {
    let bound = (end.light * end.gradient.volume192 * V::splat(12.0) / (modulus * end.b_squared)).sqrt();
    let l = &middle.velocity_gradient;
    let rate = l[0][0] + l[1][1] + l[2][2];
    let whole = damping(settings.viscosity, bound, rate);
    let mut damping = if K::CRUSHES { softened(settings.viscosity, whole, answering / modulus) } else { whole };
    if K::FLUID {
        let row = &mut state[exact::rate_row::<K>()];
        damping = whole * jump([V::load(row, part), rate], &fluid::across(neighbours));
        rate.store(row, part);
    }
    let stress = damping * modulus * bound * rate;
    let last = V::load(&state[rows::VISCOUS_STRESS], part);
    stress.store(&mut state[rows::VISCOUS_STRESS], part);
    Slowed {
        stress,
        power: (last + stress) * V::splat(0.5),
        rate,
        stable_step: damped_step(bound, if K::CRUSHES { whole } else { damping }),
        whole_step: damped_step(bound, whole),
    }
}

/// Accounts of energies, by their place behind the internal one.
const INTERNAL: usize = 0;
const HOURGLASS_WORK: usize = rows::HOURGLASS_ENERGY - rows::INTERNAL_ENERGY;
const VISCOUS: usize = rows::VISCOUS_ENERGY - rows::INTERNAL_ENERGY;

/// Adds to an account.
#[inline(always)]
fn book<V: Lanes, K: Kernel>(energy: V, account: usize, state: &mut [V::Row], part: usize) {
    if V::SINGLE {
        carried::book(energy, [account, K::STATE.len()], state, part);
    } else {
        accumulate(energy, &mut state[rows::INTERNAL_ENERGY + account], part);
    }
}

/// Volume of the element.
#[inline(always)]
fn volume<V: Lanes>(x: &[Modes<V>; 3]) -> V {
    gradient(x).volume192 * V::splat(1.0 / 192.0)
}

/// Hourglass rates q̇_iα = v_iI γ_αI, in space: γ is the mode made orthogonal to linear fields.
#[inline(always)]
pub(in crate::solver::elements) fn hourglass_rates<V: Lanes>(
    v: &[Modes<V>; 3],
    x: &[Modes<V>; 3],
    l: &Matrix3<V>,
) -> Resistance<V> {
    array![i in 3 => array![a in 4 => {
        let k = HOURGLASS + a;
        v[i][k] - (l[i][0] * x[0][k] + l[i][1] * x[1][k] + l[i][2] * x[2][k])
    }]]
}

/// Turns the rates into the frame, lets the control act, books the energy, and turns the resistance back.
///
/// Rates belong to the middle of the step and are turned by its frame. Turned by the frame at the end, the stiffness
/// would have a skew part, and hourglass modes of a spinning body would grow by a factor per revolution.
#[inline(always)]
pub(super) fn resist<V: Lanes, K: Kernel, H: hourglass::Control>(
    control: &H,
    rate: &Resistance<V>,
    [middle, r]: [&Matrix3<V>; 2],
    own: &mut [V::Row],
    part: usize,
    (state, kept): (&hourglass::State<V>, Option<V>),
) -> Resistance<V> {
    let local: Resistance<V> = array![i in 3 => array![a in 4 => {
        middle[0][i] * rate[0][a] + middle[1][i] * rate[1][a] + middle[2][i] * rate[2][a]
    }]];
    let old: Resistance<V> = array![i in 3 => array![a in 4 => V::load(&own[rows::HOURGLASS + 4 * i + a], part)]];
    let start = match kept {
        Some(kept) => array![i in 3 => array![a in 4 => old[i][a] * kept]],
        None => old,
    };
    let [q, total] = if V::SINGLE {
        carried::resist::<V, K, H>(control, &local, &start, own, part, state)
    } else {
        let mut q = start;
        let total = control.resist(&local, &mut q, state);
        [q, total]
    };
    let mut work = V::splat(0.0);
    for i in 0..3 {
        store(q[i], own, rows::HOURGLASS + 4 * i, part);
        for a in 0..4 {
            // Stored resistance by the trapezoidal rule, a viscous rest as it acts now.
            work = work + (total[i][a] + (old[i][a] - q[i][a]) * V::splat(0.5)) * local[i][a];
        }
    }
    book::<V, K>(work * state.time_step, HOURGLASS_WORK, own, part);
    array![i in 3 => array![a in 4 => r[i][0] * total[0][a] + r[i][1] * total[1][a] + r[i][2] * total[2][a]]]
}

/// Λ_i · x̂_i, the element's lengths along its frame, kept positive in elements that have folded over.
///
/// They are also kept above L_j L_k V/(8 B:B), which every box exceeds. An element drawn out to a needle across its
/// frame would otherwise be stiffer in bending than its own stable step allows.
#[inline(always)]
pub(in crate::solver::elements) fn lengths<V: Lanes>(
    x: &[Modes<V>; 3],
    r: &Matrix3<V>,
    stiffness_measure: V,
) -> [V; 3] {
    let along: [V; 3] = array![a in 3 => x[0][a] * r[0][a] + x[1][a] * r[1][a] + x[2][a] * r[2][a]];
    // All three are negative in an element that is inside out, which is to have lengths as well.
    let floor = along[0].abs().max(along[1].abs()).max(along[2].abs()) * V::splat(1e-3);
    let [l1, l2, l3] = array![i in 3 => along[i].max(floor)];
    let share = V::splat(0.125) / stiffness_measure;
    [l1.max(l2 * l3 * share), l2.max(l3 * l1 * share), l3.max(l1 * l2 * share)]
}

/// f_iI = T_ij B_jI + Q_iα γ_αI at the end of the step. The part of γ that makes it orthogonal to linear fields
/// joins the stress, so the gradient is applied once; corners are seen last.
#[inline(always)]
pub(in crate::solver::elements) fn corner_forces<V: Lanes>(
    stress: &Sym3<V>,
    resistance: &Resistance<V>,
    x: &[Modes<V>; 3],
    g24: &[[V; 6]; 3],
    inverse_volume192: V,
) -> [Corners<V>; 3] {
    let stress = stress.matrix();
    array![i in 3 => {
        let q = &resistance[i];
        let t: [V; 3] = array![j in 3 => {
            let h = &x[j];
            let along = (q[0] * h[3] + q[1] * h[4]) + (q[2] * h[5] + q[3] * h[6]);
            stress[i][j] * V::splat(1.0 / 192.0) - along * inverse_volume192
        }];
        let f: [V; 6] = array![k in 6 => g24[0][k] * t[0] + g24[1][k] * t[1] + g24[2][k] * t[2]];
        geometry::corners(&[f[0], f[1], f[2], f[3] + q[0], f[4] + q[1], f[5] + q[2], q[3]])
    }]
}
