//! One step of a chunk of shells.

use super::facet::{Corners, Facet, Kind, Rates, Resultants, Stiffnesses};
use super::plane_stress;
use super::rule::MOST_POINTS;
use super::stable_step::{self, CHANGE, Stiffness};
use super::{point_rows, rows};
use crate::lanes::{Lanes, Numbers, Sym3, array};
use crate::material::{Kernel, Moduli};
use crate::model::BulkViscosity;
use crate::solver::elements::ahead::Ahead;
use crate::solver::elements::bulk_viscosity::{damped_step, damping};
use crate::solver::elements::pass::{Given, Outcome, StepKernel};
use crate::solver::elements::state_rows::accumulate;
use std::marker::PhantomData;

/// The step is made for this much linear bulk viscosity at least. Undamped, at the very limit, the highest modes take energy from the
/// changes that others make of their frequencies: docs/verification.md has how much, and that half the step ends it.
const LEAST_DAMPING: f64 = 0.06;

/// What holds for all shells of a block in a step. N is the number of corners and their rotations, W that of all rates.
#[derive(Debug, Clone, Copy)]
pub struct ShellStep<K, S, const C: usize, const R: usize, const N: usize, const W: usize> {
    /// The kind of shell.
    pub kind: PhantomData<S>,
    /// The law.
    pub law: K,
    /// Its elastic constants.
    pub moduli: Moduli,
    /// Time of the present positions, and the step that led there.
    pub times: [f64; 2],
    /// Bulk viscosity, of the membrane.
    pub viscosity: BulkViscosity,
    /// Number of points through the thickness.
    pub points: usize,
    /// Their places and weights, of which there are as many.
    pub rule: [[f64; 2]; MOST_POINTS],
    /// What the stable step is found from.
    pub stiffness: Stiffness,
}

impl<K: Kernel, S: Kind<C, R>, const C: usize, const R: usize, const N: usize, const W: usize> StepKernel<N>
    for ShellStep<K, S, C, R, N, W>
{
    const ROTATIONS: usize = C;

    #[inline(always)]
    fn step<V: Lanes>(
        &self,
        positions: &[[V; N]; 3],
        velocities: &[[V; N]; 3],
        state: &mut [V::Row],
        part: usize,
        given: Given<V, N>,
        _: &mut Ahead<V::Row>,
    ) -> Outcome<V, N> {
        let half_step = V::splat(0.5 * self.times[1]);
        let zero = V::splat(0.0);
        let [mut x, mut v, mut omega, mut middle]: [Corners<V, C>; 4] = [[[zero; 3]; C]; 4];
        for c in 0..C {
            x[c] = array![i in 3 => positions[i][c]];
            v[c] = array![i in 3 => velocities[i][c]];
            omega[c] = array![i in 3 => velocities[i][c + C]];
            middle[c] = array![i in 3 => x[c][i] - half_step * v[c][i]];
        }
        // (i) rates at mid-step
        let before = S::Facet::<V>::new(&middle, V::load(&state[rows::THICKNESS], part));
        let rates = before.rates(&v, &omega);
        let reference: [V; 3] = array![i in 3 => V::load(&state[rows::REFERENCE + i], part)];
        let (turn, _) = before.turn(&reference);
        // (ii) stress at the points, in the axes of the material
        let motion = turned_rates::<V, S::Facet<V>, C, R>(&before, &rates, turn);
        let found = self.points(&motion, &before, state, part);
        // (iii) hourglass and drill resistance, and bulk viscosity
        let resisted = self.resist(&rates, &before, &found, state, part);
        let viscous = self.viscous(&rates, before.area(), &found, state, part);
        // (iv) forces in the new configuration
        let now = S::Facet::<V>::new(&x, found.thickness);
        let (turn, _) = now.turn(&reference);
        let [forces, moments] = now.forces(&resultants(&found, resisted, viscous, turn, now.area()));
        // (v) stable step
        let stable_step = self.stable_step(&x, &rates, &found, state, part, given.moving);
        let stable_step = V::select_less(zero, now.area(), stable_step, zero);
        let mut force = [[zero; N]; 3];
        for i in 0..3 {
            for c in 0..C {
                force[i][c] = forces[c][i];
                force[i][c + C] = moments[c][i];
            }
        }
        Outcome { force, stable_step, motion_step: stable_step, rate: V::splat(0.0) }
    }
}

/// What the points have answered.
struct Found<V> {
    /// Membrane force 11, 22, 12 per length, in the axes of the material.
    force: [V; 3],
    /// Moment.
    moment: [V; 3],
    /// Shear force 1, 2.
    shear: [V; 2],
    /// Thickness at the end of the step.
    thickness: V,
    /// What this step has added to the sum of both normal stresses, a mean over the thickness.
    added: V,
    /// Part that plastic return has left of the stress: mean over the thickness, and mean as bending sees it.
    returned: [V; 2],
    /// Largest stiffness over the elastic one of the points.
    stiffest: V,
}

/// Strain, curvature and shear rates in the axes of the material.
struct Motion<V> {
    strain: [V; 3],
    curvature: [V; 3],
    shear: [V; 2],
}

#[inline(always)]
fn turned<V: Lanes>([xx, yy, xy]: [V; 3], [c, s]: [V; 2]) -> [V; 3] {
    let (cc, ss, cs) = (c * c, s * s, c * s);
    let twice = cs * (xy + xy);
    [cc * xx + twice + ss * yy, ss * xx - twice + cc * yy, (cc - ss) * xy + cs * (yy - xx)]
}

#[inline(always)]
fn turned_rates<V: Lanes, F: Facet<V, C, R>, const C: usize, const R: usize>(
    facet: &F,
    rates: &Rates<V, R>,
    turn: [V; 2],
) -> Motion<V> {
    let [c, s] = turn;
    let [g1, g2] = [facet.reduced(rates.shear[0]), facet.reduced(rates.shear[1])];
    Motion {
        strain: turned(rates.strain, turn),
        curvature: turned(rates.curvature, turn),
        shear: [c * g1 + s * g2, c * g2 - s * g1],
    }
}

impl<K: Kernel, S: Kind<C, R>, const C: usize, const R: usize, const N: usize, const W: usize>
    ShellStep<K, S, C, R, N, W>
{
    /// Advances all points and books their energy; stores thickness and resultants.
    #[inline(always)]
    fn points<V: Lanes>(&self, motion: &Motion<V>, facet: &S::Facet<V>, state: &mut [V::Row], part: usize) -> Found<V> {
        let (zero, one, half) = (V::splat(0.0), V::splat(1.0), V::splat(0.5));
        let [time, step] = self.times;
        let step_lanes = V::splat(step);
        let old_thickness = V::load(&state[rows::THICKNESS], part);
        let (own, points) = state.split_at_mut(S::ROWS.points);
        let stride = point_rows::LAW + K::STATE.len();
        let [mut n11, mut n22, mut n12, mut m11, mut m22, mut m12, mut q1, mut q2] = [zero; 8];
        let [mut work, mut thinning, mut added, mut mean, mut bent, mut stiffest] = [zero, zero, zero, zero, zero, one];
        let membrane = self.points == 1;
        let of_bending = if membrane { 0.0 } else { 1.5 / self.stiffness.bending };
        for (point, [place, weight]) in points.chunks_exact_mut(stride).zip(self.rule).take(self.points) {
            let (point_own, law_state) = point.split_at_mut(point_rows::LAW);
            let z = half * old_thickness * V::splat(place);
            let [xx, yy, xy] = array![i in 3 => (motion.strain[i] + z * motion.curvature[i]) * step_lanes];
            let shear = if membrane { zero } else { half * step_lanes };
            let strain = Sym3 { xx, yy, zz: zero, xy, yz: motion.shear[1] * shear, zx: motion.shear[0] * shear };
            let old = Sym3 {
                xx: V::load(&point_own[point_rows::XX], part),
                yy: V::load(&point_own[point_rows::YY], part),
                zz: V::load(&point_own[point_rows::LEFT], part),
                xy: V::load(&point_own[point_rows::XY], part),
                yz: V::load(&point_own[point_rows::YZ], part),
                zx: V::load(&point_own[point_rows::ZX], part),
            };
            let answer = plane_stress::update(&self.law, self.moduli, strain, old, [time, step], law_state, part);
            // A point that is lost carries zero.
            let carries = one - V::load(&point_own[point_rows::LOST], part);
            let stress = Sym3 {
                xx: answer.stress.xx * carries,
                yy: answer.stress.yy * carries,
                zz: answer.stress.zz * carries,
                xy: answer.stress.xy * carries,
                yz: answer.stress.yz * carries,
                zx: answer.stress.zx * carries,
            };
            stress.xx.store(&mut point_own[point_rows::XX], part);
            stress.yy.store(&mut point_own[point_rows::YY], part);
            stress.zz.store(&mut point_own[point_rows::LEFT], part);
            stress.xy.store(&mut point_own[point_rows::XY], part);
            stress.yz.store(&mut point_own[point_rows::YZ], part);
            stress.zx.store(&mut point_own[point_rows::ZX], part);
            let share = V::splat(0.5 * weight);
            let lever = V::splat(0.25 * weight * place);
            n11 = n11 + share * stress.xx;
            n22 = n22 + share * stress.yy;
            n12 = n12 + share * stress.xy;
            q1 = q1 + share * stress.zx;
            q2 = q2 + share * stress.yz;
            m11 = m11 + lever * stress.xx;
            m22 = m22 + lever * stress.yy;
            m12 = m12 + lever * stress.xy;
            added = added + share * ((stress.xx - old.xx) + (stress.yy - old.yy));
            let twice = (old.xy + stress.xy) * strain.xy;
            // Shear counts with its correction, and twice as all shears do.
            let across = (old.yz + stress.yz) * strain.yz + (old.zx + stress.zx) * strain.zx;
            let along = (old.xx + stress.xx) * strain.xx + (old.yy + stress.yy) * strain.yy + (twice + twice);
            work = work + share * (along + V::splat(2.0 * self.stiffness.shear_correction) * across);
            thinning = thinning + share * answer.normal * carries;
            let kept = answer.response.returned * carries;
            mean = mean + share * kept;
            bent = bent + V::splat(of_bending * weight * place * place) * kept;
            if K::STIFFNESS {
                let over = V::splat(1.0 / self.moduli.dilatational());
                stiffest = stiffest.max(answer.response.stiffness.dilatational * over);
            }
        }
        let thickness = old_thickness * (one + thinning);
        thickness.store(&mut own[rows::THICKNESS], part);
        let corrected = thickness * V::splat(self.stiffness.shear_correction);
        let square = thickness * thickness;
        let found = Found {
            force: [n11 * thickness, n22 * thickness, n12 * thickness],
            moment: [m11 * square, m22 * square, m12 * square],
            shear: [facet.reduced(q1 * corrected), facet.reduced(q2 * corrected)],
            thickness,
            added,
            returned: [mean, bent],
            stiffest,
        };
        let volume = facet.area() * half * (old_thickness + thickness);
        accumulate(half * work * volume, &mut own[S::ROWS.internal_energy], part);
        found.store(&mut own[S::ROWS.resultants..], part);
        found
    }

    /// Advances hourglass and drill resistance, and books their energy.
    #[inline(always)]
    fn resist<V: Lanes>(
        &self,
        rates: &Rates<V, R>,
        facet: &S::Facet<V>,
        found: &Found<V>,
        state: &mut [V::Row],
        part: usize,
    ) -> [V; R] {
        let step = V::splat(self.times[1]);
        let (mu, nu) = (0.5 * self.moduli.two_mu, self.moduli.poisson());
        let young = V::splat(2.0 * mu * (1.0 + nu));
        let t = found.thickness;
        let [kept, kept_bending] = found.returned;
        let membrane = young * t;
        let rises = facet.rises(
            &rates.resisted,
            &Stiffnesses {
                poisson: nu,
                membrane,
                bending: membrane * t * t * V::splat(self.stiffness.bending / 12.0),
                shear: V::splat(self.stiffness.shear_correction * mu) * t,
                drill: drill_factor(found, young, mu) * V::splat(mu / C as f64) * t * facet.area(),
            },
        );
        // The damping of the highest mode that bulk viscosity has, of these fields: a resistance that follows rates gives a little
        // energy back where strains are large, of the second order, which would add up in what swings for long.
        let damping = V::splat(self.viscosity.linear) * V::load(&state[rows::STEP], part);
        let mut work = V::splat(0.0);
        let mut now = [V::splat(0.0); R];
        for i in 0..R {
            let row = &mut state[rows::RESISTANCE + i];
            let old = V::load(row, part);
            // Plastic flow takes as much off the resistance as off the stress.
            let factor = if S::Facet::<V>::bends(i) { kept_bending } else { kept };
            let elastic = (old + rises[i] * step) * factor;
            elastic.store(row, part);
            let viscous = rises[i] * damping;
            let row = &mut state[S::ROWS.damping + i];
            let last = V::load(row, part);
            viscous.store(row, part);
            now[i] = elastic + viscous;
            work = work + (old + last + now[i]) * rates.resisted[i];
        }
        accumulate(work * step * V::splat(0.5), &mut state[S::ROWS.hourglass_energy], part);
        now
    }

    /// Bulk viscosity of the membrane as a mean stress, with its energy booked. Its linear term follows what this step changes of the
    /// area elastically.
    #[inline(always)]
    fn viscous<V: Lanes>(
        &self,
        rates: &Rates<V, R>,
        area: V,
        found: &Found<V>,
        state: &mut [V::Row],
        part: usize,
    ) -> V {
        let rate = rates.strain[0] + rates.strain[1];
        let elastic = self.elastic_part(rate, found.added);
        let bound = V::load(&state[rows::STEP], part);
        let linear = V::splat(self.viscosity.linear);
        let quadratic = damping(self.viscosity, bound, rate) - linear;
        let viscous = (linear * elastic + quadratic * rate) * V::splat(self.plane_modulus()) * bound;
        let last = V::load(&state[S::ROWS.viscous_stress], part);
        viscous.store(&mut state[S::ROWS.viscous_stress], part);
        let work = (last + viscous) * rate * V::splat(0.5 * self.times[1]) * area * found.thickness;
        accumulate(work, &mut state[S::ROWS.viscous_energy], part);
        viscous
    }

    /// That part of the rate of area which changes the membrane stress: plastic flow widens a sheet as it thins it, and nothing of
    /// that is a wave to be damped. Elastic sheets have σ̇₁ + σ̇₂ = E/(1 − ν) (ε̇₁ + ε̇₂). No part is against the rate or exceeds it,
    /// so that viscosity always dissipates, and never needs a shorter step than the whole rate does.
    #[inline(always)]
    fn elastic_part<V: Lanes>(&self, rate: V, added: V) -> V {
        let [_, step] = self.times;
        if step <= 0.0 {
            return rate; // Nothing has been strained yet.
        }
        let nu = self.moduli.poisson();
        let biaxial = self.moduli.two_mu * (1.0 + nu) / (1.0 - nu);
        let zero = V::splat(0.0);
        (added * V::splat(1.0 / (biaxial * step))).max(rate.min(zero)).min(rate.max(zero))
    }

    /// E/(1 − ν²).
    fn plane_modulus(&self) -> f64 {
        let nu = self.moduli.poisson();
        self.moduli.two_mu / (1.0 - nu)
    }

    /// The stable step by the bound that was found last, shortened by what has changed since; found again where that is much.
    #[inline(always)]
    fn stable_step<V: Lanes>(
        &self,
        x: &Corners<V, C>,
        rates: &Rates<V, R>,
        found: &Found<V>,
        state: &mut [V::Row],
        part: usize,
        mass: V,
    ) -> V {
        let one = V::splat(1.0);
        let [e11, e22, e12] = rates.strain;
        let [k11, k22, k12] = rates.curvature;
        let sum = magnitude(e11) + magnitude(e22) + magnitude(e12 + e12);
        let bent = (magnitude(k11) + magnitude(k22) + magnitude(k12 + k12)) * found.thickness;
        let side = (V::load(&state[rows::INERTIA], part) * V::splat(8.0)).sqrt();
        let warped = magnitude(rates.warping) / side * V::splat(4.0);
        let changed = V::load(&state[rows::CHANGED], part) + (sum + bent + warped) * V::splat(self.times[1]);
        changed.store(&mut state[rows::CHANGED], part);
        if V::any_less(V::splat(CHANGE), changed) {
            self.find_again(x, found, state, part, mass);
        }
        let changed = V::load(&state[rows::CHANGED], part);
        let bound = V::load(&state[rows::STEP], part) * (one - changed) / found.stiffest.sqrt();
        let damping = damping(self.viscosity, bound, e11 + e22);
        damped_step(bound, damping.max(V::splat(LEAST_DAMPING)))
    }

    /// Finds the steps of those lanes again that have changed much.
    #[inline(always)]
    fn find_again<V: Lanes>(&self, x: &Corners<V, C>, found: &Found<V>, state: &mut [V::Row], part: usize, mass: V) {
        let mut places = [[V::Row::default(); 3]; C];
        for corner in 0..C {
            for i in 0..3 {
                x[corner][i].store(&mut places[corner][i], part);
            }
        }
        let mut body = [V::Row::default(); 3];
        let (mu, nu) = (0.5 * self.moduli.two_mu, self.moduli.poisson());
        mass.store(&mut body[0], part);
        found.thickness.store(&mut body[1], part);
        drill_factor(found, V::splat(2.0 * mu * (1.0 + nu)), mu).store(&mut body[2], part);
        let lanes = part * V::COUNT..(part + 1) * V::COUNT;
        find_lanes::<V::Row, S, C, R, W>(lanes, &places, &body, &self.stiffness, state);
    }
}

/// See [`ShellStep::find_again`]: one lane after the other, so that nothing here is compiled for vectors.
#[inline(never)]
fn find_lanes<B: Numbers, S: Kind<C, R>, const C: usize, const R: usize, const W: usize>(
    lanes: std::ops::Range<usize>,
    places: &[[B; 3]; C],
    body: &[B; 3],
    stiffness: &Stiffness,
    state: &mut [B],
) {
    for lane in lanes.filter(|&lane| lane < B::LANES) {
        let changed = state[rows::CHANGED].number(lane);
        if changed.is_nan() || changed <= CHANGE {
            continue;
        }
        let corners: Corners<f64, C> = places.map(|place| place.map(|row| row.number(lane)));
        let [mass, thickness, drill] = [0, 1, 2].map(|i: usize| body[i].number(lane));
        let inertia = state[rows::INERTIA].number(lane);
        let body = stable_step::Body { mass, inertia, thickness, drill };
        state[rows::STEP].set(lane, stable_step::stable_step::<S, C, R, W>(&corners, stiffness, &body));
        state[rows::CHANGED].set(lane, 0.0);
    }
}

impl<V: Lanes> Found<V> {
    #[inline(always)]
    fn store(&self, resultants: &mut [V::Row], part: usize) {
        for i in 0..3 {
            self.force[i].store(&mut resultants[i], part);
            self.moment[i].store(&mut resultants[3 + i], part);
        }
        self.shear[0].store(&mut resultants[6], part);
        self.shear[1].store(&mut resultants[7], part);
    }
}

#[inline(always)]
fn magnitude<V: Lanes>(a: V) -> V {
    a.max(V::splat(0.0) - a)
}

/// Drill resistance over G t A/4. Bending moments destabilise the drill of a strip that rolls up, so that it grows with them:
/// 144 M:M/(E G t⁴), which is 4 E/G times the square of the strain at the surface while that is elastic.
#[inline(always)]
fn drill_factor<V: Lanes>(found: &Found<V>, young: V, mu: f64) -> V {
    let [m11, m22, m12] = found.moment;
    let square = m11 * m11 + m22 * m22 + (m12 * m12 + m12 * m12);
    let t2 = found.thickness * found.thickness;
    (V::splat(144.0 / mu) * square / (young * t2 * t2).max(V::splat(V::TINY))).max(V::splat(0.01))
}

/// Resultants in the axes of the element, times the area.
#[inline(always)]
fn resultants<V: Lanes, const R: usize>(
    found: &Found<V>,
    resisted: [V; R],
    viscous: V,
    [c, s]: [V; 2],
    area: V,
) -> Resultants<V, R> {
    let back = [c, V::splat(0.0) - s];
    let viscous = viscous * found.thickness;
    let [n11, n22, n12] = turned(found.force, back);
    let [m11, m22, m12] = turned(found.moment, back);
    let [q1, q2] = found.shear;
    Resultants {
        force: [(n11 + viscous) * area, (n22 + viscous) * area, n12 * area],
        moment: [m11 * area, m22 * area, m12 * area],
        shear: [(c * q1 - s * q2) * area, (s * q1 + c * q2) * area],
        resisted,
    }
}

/// Power of resultants in the axes of the material, per area.
pub fn power<const R: usize>(rates: &Rates<f64, R>, turn: [f64; 2], resultants: &[f64; 8]) -> f64 {
    let ([c, s], [g1, g2]) = (turn, rates.shear);
    let [n11, n22, n12, m11, m22, m12, q1, q2] = *resultants;
    let plane = |[xx, yy, xy]: [f64; 3], [a, b, c]: [f64; 3]| xx * a + yy * b + 2.0 * xy * c;
    let bent = plane(turned(rates.curvature, turn), [m11, m22, m12]);
    plane(turned(rates.strain, turn), [n11, n22, n12]) + bent + (c * g1 + s * g2) * q1 + (c * g2 - s * g1) * q2
}
