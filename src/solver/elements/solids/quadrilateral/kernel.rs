//! The four-node quadrilateral with one integration point: one step of one part of a chunk.

use super::exact::{Start, corner_rows, power_of_stress, rate_row};
use super::fluid;
use super::hourglass;
use super::kinematics::{self, Flat, Motion};
use super::rows;
use super::sections::{Corners, Operator, Section};
use crate::lanes::{Lanes, Sym3, array};
use crate::material::{Kernel, Step};
use crate::model::{BulkViscosity, Hourglass};
use crate::solver::elements::bulk_viscosity::{damped_step, damping};
use crate::solver::elements::pass::{Given, Outcome, StepKernel};
use crate::solver::elements::solids::exact::Steps;
use crate::solver::elements::solids::fluid::{acting_step, gentle_step, jump};
use crate::solver::elements::solids::step_modulus::step_modulus;
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
fn mode<V: Lanes>(a: &Corners<V>) -> V {
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
    ) -> Outcome<V, 4> {
        let Physics { settings, law, section } = self;
        let (about_axis, turn) = (section.about_axis(), section.turn());
        let compatible = K::EQUATION && *section == Section::Compatible;
        let (zero, half, one) = (V::splat(0.0), V::splat(0.5), V::splat(1.0));
        let (time_step, half_step) = (V::splat(settings.time_step), V::splat(0.5 * settings.time_step));
        let x = [positions[0], positions[1]];
        let v = [velocities[0], velocities[1]];

        // (o) what the forces of the step's start have done, where that is heat
        let start =
            if K::EQUATION { Some(Start::of::<K>(*section, [&x, &v], state, part, settings.steps())) } else { None };

        // (i) velocity gradient and hourglass rates at mid-step
        let middle: [Corners<V>; 2] =
            [array![i in 4 => x[0][i] - half_step * v[0][i]], array![i in 4 => x[1][i] - half_step * v[1][i]]];
        let operator = section.operator(&middle);
        let inverses = section.inverses(&operator);
        let Rates { gradient, hoop, hourglass: hourglass_rate } = rates(about_axis, &operator, &v, &middle, inverses);
        let middle_volume = operator.volume * V::splat(turn);
        let mut middle_thickness = if about_axis { middle_volume * inverses[1] } else { one };
        // What the resistance of a mode works on; it differs only where forces are not the operator's of rates.
        let mut worked_rate = hourglass_rate;
        if let (true, Some((weights, mean))) = (compatible, section.weights(&middle)) {
            worked_rate = weighted_modes(&operator, [&middle, &v], inverses[1], &weights);
            middle_thickness = mean * V::splat(turn);
        }

        // (ii) frame, stretch and strain increment
        let frame = [V::load(&state[rows::FRAME], part), V::load(&state[rows::FRAME + 1], part)];
        let mut stretch: Flat<V> = load(state, rows::STRETCH, part);
        let Motion { strain, frame, middle: frame_middle } =
            kinematics::advance(&gradient, hoop, frame, &mut stretch, time_step);
        store(frame, state, rows::FRAME, part);
        store(stretch, state, rows::STRETCH, part);

        // (iii) stress
        let old = solid(load(state, rows::STRESS, part));
        let strain = solid(strain);
        let mut stress = old;
        let operator = section.operator(&x);
        let volume = operator.volume * V::splat(turn);
        let (own, law_state) = state.split_at_mut(rows::LAW);
        let inverse_volume = V::splat(settings.density) / given.material;
        let (energy, swept) = match &start {
            Some(start) => (start.energy * inverse_volume, start.swept * inverse_volume),
            None => (zero, zero),
        };
        let motion = Step {
            strain,
            stretch: solid(stretch),
            volume: volume * inverse_volume,
            middle_volume: middle_volume * inverse_volume,
            energy,
            swept,
            time: settings.time,
            time_step: settings.time_step,
        };
        let response = law.update(&motion, &mut stress, law_state, part);
        store([stress.xx, stress.yy, stress.zz, stress.xy], own, rows::STRESS, part);
        if !K::EQUATION {
            let power = old.zip(stress, |a, b| a + b).contract(strain) * half;
            accumulate(power * middle_volume, &mut own[rows::INTERNAL_ENERGY], part);
        }

        // (iv) stable step 2/ω and bulk viscosity in the new configuration
        let stiffness = response.stiffness;
        let elastic = if K::STIFFNESS { stiffness.dilatational } else { V::splat(settings.dilatational) };
        let mu = if K::STIFFNESS { stiffness.shear } else { V::splat(settings.mu) };
        let mut inverse_corners: Corners<V> = load(own, rows::INVERSE_MASS, part);
        let weights = if compatible { section.weights(&x) } else { None };
        if let Some((weights, _)) = &weights {
            inverse_corners = array![i in 4 => inverse_corners[i] * weights[i]];
        }
        // One over the mass of the lightest corner.
        let lightest = inverse_corners[0].max(inverse_corners[1]).max(inverse_corners[2].max(inverse_corners[3]));
        let [inverse_measure, inverse_area] = section.inverses(&operator);
        let mut thickness = if about_axis { volume * inverse_area } else { one };
        if let Some((_, mean)) = &weights {
            thickness = *mean * V::splat(turn);
        }
        let b_squared = dot(&operator.plane[0], &operator.plane[0]) + dot(&operator.plane[1], &operator.plane[1]);
        let (measure, proportions) = (b_squared * inverse_area, proportions(&x, &frame));
        let gamma = hourglass_vector(&operator, &x, inverse_area);
        let mut square = frequency_square(*section, &operator, &inverse_corners, [elastic, mu]) * inverse_measure;
        let mut of_hoop = zero;
        if compatible {
            square = square * thickness;
            // It shortens the step alone: a viscosity that knew of it would be another at every angle of a sphere.
            let hoop = operator.hoop[0] * operator.hoop[0] * inverse_area * thickness;
            of_hoop = elastic
                * hoop
                * ((inverse_corners[0] + inverse_corners[1]) + (inverse_corners[2] + inverse_corners[3]));
        }
        // Hourglass and strain modes are orthogonal only where corners weigh alike and the element is a parallelogram: near the
        // axis the whole resistance counts, and in warped elements what the hourglass vector has across (1, −1, 1, −1).
        let stiffness = hourglass::stiffness(settings.control, mu, settings.poisson, &proportions, measure) * thickness;
        let across = (dot(&gamma, &gamma) - V::splat(4.0)).max(zero);
        square = square + stiffness * (across + V::splat(2.0) * across.sqrt()) * lightest;
        if about_axis {
            // Three times what the heaviest quarter has beyond the lightest corner.
            let uneven = (lightest * given.moving * V::splat(0.75) - V::splat(3.0)).max(zero).min(one);
            let squares: Corners<V> = array![i in 4 => gamma[i] * gamma[i]];
            square = square + uneven * stiffness * dot(&squares, &inverse_corners);
        }
        let modulus = if K::STIFFNESS {
            elastic
        } else {
            step_modulus([settings.dilatational, settings.mu], settings.effective_moduli, [&old, &stress], &strain)
        };
        let bound = (V::splat(4.0) * elastic / (square * modulus)).sqrt();
        // Where viscosity rules the step, it falls with the square of the frequency.
        let shorter = if compatible { square / (square + of_hoop) } else { one };
        let rate = gradient[0][0] + gradient[1][1] + hoop;
        let whole = damping(settings.viscosity, bound, rate);
        let mut damping = whole;
        if K::FLUID {
            let row = &mut law_state[rate_row::<K>() - rows::LAW];
            let acts = jump([V::load(row, part), rate], &fluid::across(&given.rates));
            // Elements along the axis of Galerkin's form need all of it: without, they are squeezed flat behind a shock.
            damping = if compatible || !about_axis { whole * acts } else { whole };
            rate.store(row, part);
        }
        let viscous = damping * modulus * bound * rate;
        let last = V::load(&own[rows::VISCOUS_STRESS], part);
        viscous.store(&mut own[rows::VISCOUS_STRESS], part);
        if !K::EQUATION {
            accumulate((last + viscous) * half * strain.trace() * middle_volume, &mut own[rows::VISCOUS_ENERGY], part);
        }
        let stable_step = damped_step(bound, damping);

        // (v) hourglass resistance in the frame, or of a fluid; with an equation of state the accounts are closed
        let total = rotated(&stress, &frame, zero);
        let mut held = fluid::Held::nothing(stable_step);
        let (resistance, lever) = if let (true, Some(start)) = (K::FLUID, &start) {
            let heavy = V::splat(4.0) / lightest;
            // What slows the modes of the plane works on weighted ones.
            let rates = if compatible { [dot(&gamma, &v[0]), dot(&gamma, &v[1])] } else { start.flow.hourglass };
            // As strongly as where all of the viscosity acts: a limiter sees no modes.
            let step = acting_step(damped_step(bound, whole), time_step);
            let resistance = fluid::resistance(&rates, hourglass::of_fluids(settings.control), heavy, step);
            store(resistance, own, rows::HOURGLASS, part);
            let sizes = [operator.area, heavy, stable_step, time_step, b_squared];
            let taken = start.taken(&*state, part);
            held = fluid::hold([&x, &v], &mut state[corner_rows::<K>()], part, sizes, taken, weights.as_ref());
            let of_modes = fluid::power_of_modes(&resistance, &start.flow.hourglass) + held.power;
            let powers = [power_of_stress(&total, &start.flow), viscous * start.growth, of_modes];
            start.finish::<K>(powers, state, part, settings);
            (resistance, one)
        } else {
            let modes = hourglass::State {
                proportions,
                stiffness_measure: measure,
                lightest: [lightest, thickness],
                mu,
                poisson: settings.poisson,
                returned: response.returned,
                time_step,
            };
            let turned = [frame_middle, frame];
            let rates = [&hourglass_rate, &worked_rate];
            let resistance = resist(settings.control, rates, turned, (own, part), middle_thickness, &modes);
            held.stable_step = hourglass::stable_step(settings.control, stable_step, &modes);
            if let Some(start) = &start {
                let powers = [power_of_stress(&total, &start.flow), viscous * start.growth, zero];
                start.finish::<K>(powers, state, part, settings);
            }
            (resistance, thickness)
        };
        let stable_step = match &start {
            Some(start) if compatible => gentle_step(start.growth / volume, held.stable_step * shorter),
            Some(start) => gentle_step(start.growth / volume, held.stable_step),
            None => held.stable_step,
        };
        // An element that passed through itself within the step has failed, even if it looks sound at the end.
        let least = middle_volume.min(volume).min(operator.area);
        let stable_step = V::select_less(zero, least, stable_step, zero);

        // (vi) corner forces from the rotated stress
        let [xx, yy, zz, xy] = total;
        let total = [xx + viscous, yy + viscous, zz + viscous, xy];
        let gamma = match &weights {
            Some((weights, _)) => array![i in 4 => gamma[i] * weights[i]],
            None => gamma,
        };
        let operator = section.of_forces(operator, &x);
        let mut force = forces(*section, &total, &resistance, &operator, &gamma, lever);
        if K::FLUID {
            for i in 0..2 {
                force[i] = array![n in 4 => force[i][n] + held.force[i][n]];
            }
        }
        Outcome { force, stable_step, motion_step: stable_step, rate: if K::FLUID { rate } else { zero } }
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

/// A bound of ω² times the measure of rates: the trace of the corners' scaled stiffness,
/// Σ_I [λ (V_x² + V_y²) + 2μ (G² + H² + V_y²)]_I/m_I; of the others, and per thickness in the compatible form,
/// (λ + 2μ) Σ_I (B_x² + B_y²)_I/m_I.
#[inline(always)]
fn frequency_square<V: Lanes>(
    section: Section,
    operator: &Operator<V>,
    inverse_mass: &Corners<V>,
    [dilatational, mu]: [V; 2],
) -> V {
    let two_mu = mu + mu;
    let Operator { radial, axial, hoop, .. } = operator;
    if section != Section::Axisymmetric {
        let squares: Corners<V> = array![i in 4 => radial[i] * radial[i] + axial[i] * axial[i]];
        return dilatational * dot(&squares, inverse_mass);
    }
    let lambda = (dilatational - two_mu).max(V::splat(0.0));
    let terms: Corners<V> = array![i in 4 => {
        let (whole, axial2) = (radial[i] + hoop[i], axial[i] * axial[i]);
        lambda * (whole * whole + axial2) + two_mu * ((radial[i] * radial[i] + hoop[i] * hoop[i]) + axial2)
    }];
    dot(&terms, inverse_mass) * V::splat(section.turn())
}

/// Λ₁ · x with Λ₁ = (−1, 1, 1, −1).
#[inline(always)]
fn xi<V: Lanes>(x: &Corners<V>) -> V {
    (x[1] - x[0]) + (x[2] - x[3])
}

/// Λ₂ · x with Λ₂ = (−1, −1, 1, 1).
#[inline(always)]
fn eta<V: Lanes>(x: &Corners<V>) -> V {
    (x[3] - x[0]) + (x[2] - x[1])
}

/// L₂/L₁ and L₁/L₂ of the element's lengths L_i = Λ_i · x̂_i along its frame, kept positive in elements that have folded over.
#[inline(always)]
fn proportions<V: Lanes>(x: &[Corners<V>; 2], [c, s]: &[V; 2]) -> [V; 2] {
    let [xi, eta] = [[xi(&x[0]), xi(&x[1])], [eta(&x[0]), eta(&x[1])]];
    let (l1, l2) = (xi[0] * *c + xi[1] * *s, eta[1] * *c - eta[0] * *s);
    let floor = l1.max(l2) * V::splat(1e-3);
    let (l1, l2) = (l1.max(floor), l2.max(floor));
    let inverse = V::splat(1.0) / (l1 * l2);
    [l2 * l2 * inverse, l1 * l1 * inverse]
}

/// Turns the rates, and those on which the resistance works, into the frame of the middle, lets the control act, books the energy,
/// and turns the resistance back by the frame of the end.
#[inline(always)]
fn resist<V: Lanes>(
    control: Hourglass,
    [rate, worked]: [&[V; 2]; 2],
    [[cm, sm], [c, s]]: [[V; 2]; 2],
    (own, part): (&mut [V::Row], usize),
    thickness: V,
    state: &hourglass::State<V>,
) -> [V; 2] {
    let local = [cm * rate[0] + sm * rate[1], cm * rate[1] - sm * rate[0]];
    let worked = [cm * worked[0] + sm * worked[1], cm * worked[1] - sm * worked[0]];
    let old = [V::load(&own[rows::HOURGLASS], part), V::load(&own[rows::HOURGLASS + 1], part)];
    let mut q = old;
    let total = hourglass::resist(control, &local, &mut q, state);
    store(q, own, rows::HOURGLASS, part);
    let half = V::splat(0.5);
    // Stored resistance by the trapezoidal rule, a viscous rest as it acts now.
    let work = (total[0] + (old[0] - q[0]) * half) * worked[0] + (total[1] + (old[1] - q[1]) * half) * worked[1];
    accumulate(work * state.time_step * thickness, &mut own[rows::HOURGLASS_ENERGY], part);
    [c * total[0] - s * total[1], s * total[0] + c * total[1]]
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

/// γ = Γ − B_j (x_j·Γ)/A: the hourglass mode made orthogonal to linear fields.
#[inline(always)]
fn hourglass_vector<V: Lanes>(operator: &Operator<V>, x: &[Corners<V>; 2], inverse_area: V) -> Corners<V> {
    let [bx, by] = &operator.plane;
    let (hx, hy) = (mode(&x[0]) * inverse_area, mode(&x[1]) * inverse_area);
    array![i in 4 => {
        let one = V::splat(if i.is_multiple_of(2) { 1.0 } else { -1.0 });
        one - (bx[i] * hx + by[i] * hy)
    }]
}

/// f_x = σ_r G + τ V_y + σ_θ H, f_y = τ G + σ_z V_y, and Q_i γ times the thickness.
#[inline(always)]
fn forces<V: Lanes>(
    section: Section,
    [xx, yy, zz, xy]: &Flat<V>,
    q: &[V; 2],
    operator: &Operator<V>,
    gamma: &Corners<V>,
    thickness: V,
) -> [Corners<V>; 3] {
    let turn = V::splat(section.turn());
    let (xx, yy, zz, xy) = (*xx * turn, *yy * turn, *zz * turn, *xy * turn);
    let q = [q[0] * thickness, q[1] * thickness];
    let Operator { radial, axial, hoop, .. } = operator;
    [
        array![i in 4 => {
            let f = xx * radial[i] + xy * axial[i] + q[0] * gamma[i];
            if section.about_axis() { f + zz * hoop[i] } else { f }
        }],
        array![i in 4 => xy * radial[i] + yy * axial[i] + q[1] * gamma[i]],
        [V::splat(0.0); 4],
    ]
}
