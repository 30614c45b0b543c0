//! The eight-node hexahedron with one integration point (Flanagan and Belytschko 1981): one step of one chunk.

use super::barrier::{self, Solid, shared_step};
use super::bounded;
use super::carried;
use super::exact::{self, Start};
use super::fluid;
use super::geometry::{self, Corners, Gradient, HOURGLASS, dot, earlier, gradient, modes};
use super::hourglass::{self, Resistance};
use super::kinematics::{self, Motion};
use super::rows;
use crate::lanes::{Lanes, Matrix3, Sym3, array};
use crate::material::{Kernel, Step};
use crate::model::BulkViscosity;
use crate::solver::elements::bulk_viscosity::{damped_step, damping};
use crate::solver::elements::exact::Steps;
use crate::solver::elements::fluid::{acting_step, gentle_step, jump};
use crate::solver::elements::pass::{Given, Outcome, StepKernel};
use crate::solver::elements::state_rows::{accumulate, store};
use crate::solver::elements::step_modulus::step_modulus;

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
    /// Least part of an eighth of its mass that any node has of an element; 1 where no corners coincide.
    pub least_share: f64,
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
    /// The step that is booked.
    pub fn steps(&self) -> Steps {
        Steps { time_step: self.time_step, kick: self.kick }
    }
}

/// The bound of the step is rigorous, and must stay so when it is made of rounded numbers: a step beyond it by 10⁻⁷ lets a mode
/// grow by 10⁻³.
const ROUNDED_BOUND: f64 = 1.0 - 4e-6;

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

    #[inline(always)]
    fn step<V: Lanes>(
        &self,
        positions: &[Corners<V>; 3],
        velocities: &[Corners<V>; 3],
        state: &mut [V::Row],
        part: usize,
        given: Given<V, 8>,
    ) -> Outcome<V, 8> {
        step(positions, velocities, state, part, given, self)
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
) -> Outcome<V, 8> {
    let time_step = V::splat(settings.time_step);
    let (zero, half) = (V::splat(0.0), V::splat(0.5));
    let x: [geometry::Modes<V>; 3] = array![i in 3 => modes(&positions[i])];
    let v: [geometry::Modes<V>; 3] = array![i in 3 => modes(&velocities[i])];

    // (o) what the forces of the step's start have done, where that is heat
    let start = if K::EQUATION {
        Some(Start::of::<K>([&x, &v], [positions, velocities], state, part, settings.steps()))
    } else {
        None
    };

    // (i) velocity gradient and hourglass rates at mid-step
    let half_step = V::splat(0.5 * settings.time_step);
    let middle = earlier([&x, &v], half_step);
    let Gradient { g24, volume192: middle_volume192 } = gradient(&middle);
    let inverse = V::splat(1.0) / middle_volume192;
    let velocity_gradient: Matrix3<V> = array![i in 3 => array![j in 3 => dot(&v[i], &g24[j]) * inverse]];
    let hourglass_rate = hourglass_rates(&v, &middle, &velocity_gradient);

    // (ii) frame, stretch and strain increment
    let (motion, stretch) = if V::SINGLE {
        carried::advance::<V, K>(&velocity_gradient, state, part, settings)
    } else {
        let mut frame = array![i in 4 => V::load(&state[rows::FRAME + i], part)];
        let mut stretch = Sym3::load(&state[rows::STRETCH..], part);
        let second_order = settings.second_order_spin;
        let motion = kinematics::advance(&velocity_gradient, &mut frame, &mut stretch, time_step, second_order);
        store(frame, state, rows::FRAME, part);
        store(stretch.to_array(), state, rows::STRETCH, part);
        (motion, stretch)
    };
    let Motion { strain, frame: r, middle: r_middle } = motion;

    // (iii) stress
    let old = Sym3::load(&state[rows::STRESS..], part);
    let mut stress = old;
    let middle_volume = middle_volume192 * V::splat(1.0 / 192.0);
    let inverse_volume = V::splat(settings.density) / given.material;
    let (energy, swept) = match &start {
        Some(start) => (start.energy * inverse_volume, start.swept * inverse_volume),
        None => (zero, zero),
    };
    let carries = V::SINGLE && K::HYPOELASTIC;
    let felt = if carries { carried::with_rest::<V, K>(&strain, state, part) } else { strain };
    let motion = Step {
        strain: felt,
        stretch,
        volume: if K::VOLUME { volume(&x) * inverse_volume } else { V::splat(1.0) },
        middle_volume: middle_volume * inverse_volume,
        energy,
        swept,
        time: settings.time,
        time_step: settings.time_step,
    };
    let response = law.update(&motion, &mut stress, &mut state[rows::LAW..], part);
    store(stress.to_array(), state, rows::STRESS, part);
    if carries {
        carried::keep_rest::<V, K>(&felt, [&old, &stress], state, part, settings);
    }
    let power = old.zip(stress, |a, b| a + b).contract(strain) * half;
    let mut work = power * middle_volume;

    // (iv) stable step √(M V / 2(λ+2μ) B:B) and bulk viscosity in the new configuration; the bound holds for an eighth of
    // M at each corner, so M is what eight of the lightest make up
    let light = given.moving * V::splat(settings.least_share);
    let gradient = gradient(&x);
    let inverse = V::splat(1.0) / gradient.volume192;
    let b_squared = gradient.square4608();
    let stiffness = response.stiffness;
    let modulus = if K::STIFFNESS {
        stiffness.dilatational
    } else {
        step_modulus([settings.dilatational, settings.mu], settings.effective_moduli, [&old, &stress], &strain)
    };
    let mu = if K::STIFFNESS { stiffness.shear } else { V::splat(settings.mu) };
    let bound = (light * gradient.volume192 * V::splat(12.0) / (modulus * b_squared)).sqrt();
    let rate = velocity_gradient[0][0] + velocity_gradient[1][1] + velocity_gradient[2][2];
    let whole = damping(settings.viscosity, bound, rate);
    let mut damping = whole;
    if K::FLUID {
        let row = &mut state[exact::rate_row::<K>()];
        damping = whole * jump([V::load(row, part), rate], &fluid::across(&given.rates));
        rate.store(row, part);
    }
    let viscous = damping * modulus * bound * rate;
    let last = V::load(&state[rows::VISCOUS_STRESS], part);
    viscous.store(&mut state[rows::VISCOUS_STRESS], part);
    if !K::EQUATION {
        book::<V, K>((last + viscous) * half * strain.trace() * middle_volume, VISCOUS, state, part);
    }
    let stable_step = damped_step(bound, damping);

    // (v) hourglass resistance in the frame, or of a fluid; with an equation of state the accounts are closed
    let stiffness_measure = b_squared * inverse * V::splat(192.0 / 4608.0);
    let bounded = if !K::FLUID && bounded::any(&x, &gradient) {
        bounded::bounded([&x, &v], &gradient, b_squared, time_step)
    } else {
        None
    };
    let mut hourglass_state = hourglass::State {
        lengths: if H::LENGTHS { lengths(&x, &r, stiffness_measure) } else { [light; 3] },
        stiffness_measure,
        mass: light,
        mu,
        poisson: V::splat(settings.poisson),
        returned: response.returned,
        time_step,
    };
    if let Some(bounded) = &bounded {
        hourglass_state.mu = mu * bounded.factor;
        hourglass_state.mass = light * bounded.factor;
    }
    let mut held = fluid::Held { force: [[zero; 8]; 3], power: zero, stable_step };
    let resistance = if let (true, Some(start)) = (K::FLUID, &start) {
        let sizes = [
            gradient.volume192 * V::splat(1.0 / 192.0),
            light,
            stable_step,
            time_step,
            b_squared * V::splat(1.0 / 4608.0),
        ];
        let rates = exact::rates(&v, &x, &start.flow, gradient.volume192);
        // As strongly as where all of the viscosity acts: a limiter sees no modes.
        let acting = acting_step(damped_step(bound, whole), time_step);
        let resistance = fluid::resistance(&rates, control.of_fluids(), light, acting);
        for i in 0..3 {
            store(resistance[i], state, rows::HOURGLASS + 4 * i, part);
        }
        let taken = start.taken(state, part);
        held = fluid::hold([positions, velocities], &mut state[exact::corner_rows::<K>()], part, sizes, taken);
        let of_modes = exact::power(&resistance, &rates) + held.power;
        start.finish::<K>([stress.xx * start.growth, viscous * start.growth, of_modes], state, part, settings);
        resistance
    } else {
        let kept = bounded.as_ref().map(|bounded| bounded.kept);
        resist::<V, K, H>(control, &hourglass_rate, [&r_middle, &r], state, part, (&hourglass_state, kept))
    };
    let stable_step = match &bounded {
        _ if K::FLUID => held.stable_step,
        None => control.stable_step(stable_step, stiffness_measure, light, mu),
        Some(bounded) => bounded.stable_step::<H>(control, stable_step, [stiffness_measure, light, mu]),
    };
    let initial192 = V::splat(192.0 / settings.density) * given.material;
    let mut viscous = viscous;
    let [mut stable_step, mut motion_step] = [stable_step, V::splat(f64::MAX)];
    let growth = rate * stable_step;
    if K::HYPOELASTIC
        && (barrier::any_near([middle_volume192, gradient.volume192], initial192) || barrier::any_fast(growth))
    {
        let dilatational = V::splat(settings.dilatational);
        let operator = &gradient;
        let solid = Solid {
            motion: [&x, &v],
            operator,
            middle_volume192,
            growth,
            square4608: b_squared,
            initial192,
            dilatational,
        };
        let barrier = solid.held(settings.steps());
        viscous = viscous + barrier.stress;
        stable_step = shared_step(stable_step, barrier.stiffness, light);
        motion_step = barrier.motion_step;
        work = work + barrier.work;
    }
    // Once a step: in single precision nothing more is something, in a sum that keeps what it loses.
    if !K::EQUATION {
        book::<V, K>(work, INTERNAL, state, part);
    }
    let stable_step = match &start {
        Some(start) => gentle_step(start.growth * V::splat(192.0) * inverse, stable_step),
        None => stable_step,
    };
    // An element that passed through itself within the step has failed, even if it looks sound at the end.
    let stable_step = V::select_less(zero, middle_volume192, stable_step, zero);

    let stable_step = if V::SINGLE { stable_step * V::splat(ROUNDED_BOUND) } else { stable_step };

    // (vi) corner forces from the rotated stress
    let turned = stress.rotate(&r);
    if let (false, Some(start)) = (K::FLUID, &start) {
        let powers = [turned.contract(Sym3::of(&start.flow)), viscous * start.growth, zero];
        start.finish::<K>(powers, state, part, settings);
    }
    let total = turned.add_diagonal(viscous);
    let mut force = corner_forces(&total, &resistance, &x, &gradient.g24, inverse);
    if K::FLUID {
        force = array![i in 3 => array![n in 8 => force[i][n] + held.force[i][n]]];
    }
    Outcome { force, stable_step, motion_step, rate: if K::FLUID { rate } else { zero } }
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
fn volume<V: Lanes>(x: &[geometry::Modes<V>; 3]) -> V {
    gradient(x).volume192 * V::splat(1.0 / 192.0)
}

/// Hourglass rates q̇_iα = v_iI γ_αI, in space: γ is the mode made orthogonal to linear fields.
#[inline(always)]
pub(in crate::solver::elements) fn hourglass_rates<V: Lanes>(
    v: &[geometry::Modes<V>; 3],
    x: &[geometry::Modes<V>; 3],
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
fn resist<V: Lanes, K: Kernel, H: hourglass::Control>(
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
    x: &[geometry::Modes<V>; 3],
    r: &Matrix3<V>,
    stiffness_measure: V,
) -> [V; 3] {
    let along: [V; 3] = array![a in 3 => x[0][a] * r[0][a] + x[1][a] * r[1][a] + x[2][a] * r[2][a]];
    let floor = along[0].max(along[1]).max(along[2]) * V::splat(1e-3);
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
    x: &[geometry::Modes<V>; 3],
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
