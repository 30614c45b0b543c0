//! One step of a chunk of beams.

use super::section::MOST_FIBRES;
use super::{point_rows, rows};
use crate::lanes::{Lanes, array, exp};
use crate::material::{Kernel, Moduli};
use crate::solver::elements::ahead::Ahead;
use crate::solver::elements::pass::{Given, Outcome, StepKernel};
use crate::solver::elements::structural::{BAR_STEP, uniaxial};

/// What holds for all beams of a block in a step.
#[derive(Debug, Clone, Copy)]
pub struct BeamStep<K> {
    /// The law.
    pub law: K,
    /// Its elastic constants.
    pub moduli: Moduli,
    /// Time of the present positions, and the step that led there.
    pub times: [f64; 2],
    /// Area, second moments about y and z, torsion constant at the start.
    pub section: [f64; 4],
    /// Shear corrections along y and z.
    pub shear_corrections: [f64; 2],
    /// Number of fibres.
    pub count: usize,
    /// y, z and area of each at the start.
    pub fibres: [[f64; 3]; MOST_FIBRES],
}

/// Axes of a beam and its length.
pub struct Axes<V> {
    /// Along the beam, and the y and z of its section.
    pub e: [[V; 3]; 3],
    /// Length.
    pub length: V,
}

/// Rates of strain of a beam.
pub struct Rates<V> {
    /// Stretching, twisting, curvature about y and z.
    pub along: [V; 4],
    /// Shear along y and z.
    pub shear: [V; 2],
}

#[inline(always)]
pub fn product<V: Lanes>(a: &[V; 3], b: &[V; 3]) -> V {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub fn cross<V: Lanes>(a: &[V; 3], b: &[V; 3]) -> [V; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The axes of a beam that lies along a vector, its y axis the part of a direction that is across it.
#[inline(always)]
pub fn axes<V: Lanes>(along: &[V; 3], y: &[V; 3]) -> Axes<V> {
    let length = product(along, along).sqrt();
    let e1: [V; 3] = array![i in 3 => along[i] / length];
    let lean = product(y, &e1);
    let across: [V; 3] = array![i in 3 => y[i] - lean * e1[i]];
    let size = product(&across, &across).max(V::splat(V::TINY)).sqrt();
    let e2: [V; 3] = array![i in 3 => across[i] / size];
    let e3 = cross(&e1, &e2);
    Axes { e: [e1, e2, e3], length }
}

impl<V: Lanes> Axes<V> {
    /// The axes after the beam has come to lie along another vector and has twisted by an angle: the smallest rotation from the
    /// one line to the other, then that about the line, by the tangent of half the angle.
    #[inline(always)]
    pub fn moved(&self, along: &[V; 3], twist: V) -> Axes<V> {
        let one = V::splat(1.0);
        let length = product(along, along).sqrt();
        let e1: [V; 3] = array![i in 3 => along[i] / length];
        let share = product(&self.e[1], &e1) / (one + product(&self.e[0], &e1)).max(V::splat(1e-12));
        let y: [V; 3] = array![i in 3 => self.e[1][i] - share * (self.e[0][i] + e1[i])];
        let z = cross(&e1, &y);
        let half = twist * V::splat(0.5);
        let over = one / (one + half * half);
        let (c, s) = ((one - half * half) * over, (half + half) * over);
        let y: [V; 3] = array![i in 3 => c * y[i] + s * z[i]];
        axes(along, &y)
    }

    /// Rates of strain, from the velocity of the second node relative to the first and both rotation rates.
    #[inline(always)]
    pub fn rates(&self, v: &[V; 3], omega: &[[V; 3]; 2]) -> Rates<V> {
        let (half, over) = (V::splat(0.5), V::splat(1.0) / self.length);
        let mean: [V; 3] = array![i in 3 => half * (omega[0][i] + omega[1][i])];
        let turn: [V; 3] = array![i in 3 => omega[1][i] - omega[0][i]];
        let [e1, e2, e3] = &self.e;
        Rates {
            along: [
                product(e1, v) * over,
                product(e1, &turn) * over,
                product(e2, &turn) * over,
                product(e3, &turn) * over,
            ],
            shear: [product(e2, v) * over - product(e3, &mean), product(e3, v) * over + product(e2, &mean)],
        }
    }
}

impl<K: Kernel> StepKernel<4> for BeamStep<K> {
    const ROTATIONS: usize = 2;

    #[inline(always)]
    fn step<V: Lanes>(
        &self,
        positions: &[[V; 4]; 3],
        velocities: &[[V; 4]; 3],
        state: &mut [V::Row],
        part: usize,
        given: Given<V, 4>,
        _: &mut Ahead<V::Row>,
    ) -> Outcome<V, 4> {
        let (zero, half, dt) = (V::splat(0.0), V::splat(0.5), V::splat(self.times[1]));
        // (i) axes before, in the middle of and after the step; rates in the middle
        let x: [V; 3] = array![i in 3 => positions[i][1]];
        let v: [V; 3] = array![i in 3 => velocities[i][1]];
        let omega = [array![i in 3 => velocities[i][2]], array![i in 3 => velocities[i][3]]];
        let before: [V; 3] = array![i in 3 => x[i] - dt * v[i]];
        let middle: [V; 3] = array![i in 3 => x[i] - half * dt * v[i]];
        let y: [V; 3] = array![i in 3 => V::load(&state[rows::AXIS + i], part)];
        let start = axes(&before, &y);
        let lengthwise = axes(&middle, &y);
        let mean: [V; 3] = array![i in 3 => half * (omega[0][i] + omega[1][i])];
        let twist = product(&lengthwise.e[0], &mean) * dt;
        let between = start.moved(&middle, twist * half);
        let now = start.moved(&x, twist);
        for i in 0..3 {
            now.e[1][i].store(&mut state[rows::AXIS + i], part);
        }
        let rates = between.rates(&v, &omega);
        // (ii) fibres, torsion and shear
        let length = between.length;
        let resultants = self.resultants(&rates, length, state, part);
        // (iii) forces along the present axes
        let [n, t, my, mz, qy, qz] = resultants;
        let [e1, e2, e3] = &now.e;
        let lever = half * now.length;
        let force: [V; 3] = array![i in 3 => n * e1[i] + qy * e2[i] + qz * e3[i]];
        let moment: [V; 3] = array![i in 3 => t * e1[i] + my * e2[i] + mz * e3[i]];
        let couple: [V; 3] = array![i in 3 => lever * (qz * e2[i] - qy * e3[i])];
        let stable_step = self.stable_step(now.length, state, part, given.moving);
        let stable_step = V::select_less(zero, now.length, stable_step, zero);
        Outcome {
            force: array![i in 3 => [zero - force[i], force[i], couple[i] - moment[i], couple[i] + moment[i]]],
            stable_step,
            motion_step: stable_step,
            rate: zero,
        }
    }
}

impl<K: Kernel> BeamStep<K> {
    /// Advances fibres, torsion and shear, books their energy and stores them: N, T, M_y, M_z, Q_y, Q_z. The section keeps its form,
    /// and is as wide as the mean strain across its fibres says: fibres stand at the distances that it had before the step, and
    /// stresses act on what it has after it.
    #[inline(always)]
    fn resultants<V: Lanes>(&self, rates: &Rates<V>, length: V, state: &mut [V::Row], part: usize) -> [V; 6] {
        let (one, half, dt) = (V::splat(1.0), V::splat(0.5), V::splat(self.times[1]));
        let area = self.section[0];
        let [stretching, twisting, about_y, about_z] = array![i in 4 => rates.along[i] * dt];
        let (own, points) = state.split_at_mut(rows::POINTS);
        let old: [V; 6] = array![i in 6 => V::load(&own[rows::RESULTANTS + i], part)];
        let stride = point_rows::LAW + K::STATE.len();
        let [mut n, mut my, mut mz, mut kept] = [V::splat(0.0); 4];
        let mut lateral = V::load(&own[rows::LATERAL], part);
        let old_wide = exp(lateral);
        let (bent_about_y, bent_about_z) = (old_wide * about_y, old_wide * about_z);
        for (point, [y, z, of_fibre]) in points.chunks_exact_mut(stride).zip(self.fibres).take(self.count) {
            let (point_own, law_state) = point.split_at_mut(point_rows::LAW);
            let along = stretching + V::splat(z) * bent_about_y - V::splat(y) * bent_about_z;
            let stress = [V::load(&point_own[point_rows::STRESS], part), V::load(&point_own[point_rows::ACROSS], part)];
            let answer =
                uniaxial::update(&self.law, self.moduli, [along, one, one], stress, self.times, law_state, part);
            let carries = one - V::load(&point_own[point_rows::LOST], part);
            let now = answer.along * carries;
            now.store(&mut point_own[point_rows::STRESS], part);
            (answer.across * carries).store(&mut point_own[point_rows::ACROSS], part);
            let force = now * V::splat(of_fibre);
            n = n + force;
            my = my + force * V::splat(z);
            mz = mz - force * V::splat(y);
            let share = carries * V::splat(of_fibre / area);
            kept = kept + answer.response.returned * share;
            lateral = lateral + answer.lateral * share;
        }
        lateral.store(&mut own[rows::LATERAL], part);
        let wide = exp(lateral);
        let (square, cube) = (wide * wide, wide * wide * wide);
        let elastic = [twisting, rates.shear[0] * dt, rates.shear[1] * dt];
        // Flow takes as much off torsion and shear as off the mean fibre.
        let [t, qy, qz] = self.torsion_and_shear([old[1], old[4], old[5]], elastic, [length, square, wide / old_wide]);
        let now = [n * square, t * kept, my * cube, mz * cube, qy * kept, qz * kept];
        let strain = [stretching, twisting, about_y, about_z, elastic[1], elastic[2]];
        let mut work = V::splat(0.0);
        for i in 0..6 {
            work = work + (old[i] + now[i]) * strain[i];
            now[i].store(&mut own[rows::RESULTANTS + i], part);
        }
        let energy = V::load(&own[rows::INTERNAL_ENERGY], part) + half * work * length;
        energy.store(&mut own[rows::INTERNAL_ENERGY], part);
        now
    }

    /// T, Q_y and Q_z after elastic strains, of a section that has changed its area by a factor `square`, and its width by `wider` in this
    /// step: the stresses that they stand for act on the present section.
    #[inline(always)]
    fn torsion_and_shear<V: Lanes>(
        &self,
        [t, qy, qz]: [V; 3],
        [twist, along_y, along_z]: [V; 3],
        [length, square, wider]: [V; 3],
    ) -> [V; 3] {
        let torsion = self.section[3];
        let twisting = V::splat(0.5 * self.moduli.two_mu * torsion) * square * square;
        let [sy, sz] = self.shear_stiffness(length, square);
        let larger = wider * wider;
        [t * larger * wider + twisting * twist, qy * larger + sy * along_y, qz * larger + sz * along_z]
    }

    /// 1/(1/κGA + L²/12EI) along y, with I about z, and along z, with I about y, of a section that has changed its area by a factor `square`: with what bending
    /// adds, one element is exact under forces at its ends (residual flexibility, MacNeal 1978).
    #[inline(always)]
    fn shear_stiffness<V: Lanes>(&self, length: V, square: V) -> [V; 2] {
        let [area, iy, iz, _] = self.section;
        let [young, mu] = young_and_shear(self.moduli);
        let [along_y, along_z] = self.shear_corrections.map(|correction| V::splat(1.0 / (correction * mu * area)));
        let flexible = length * length / square;
        [
            square / (along_y + flexible * V::splat(1.0 / (12.0 * young * iz))),
            square / (along_z + flexible * V::splat(1.0 / (12.0 * young * iy))),
        ]
    }

    /// 2/ω with the largest ω² of stretching 2EA/Lm, shear 2S/Lm + LS/2I, bending 2EI/LI and torsion 2GJ/LI, m and I those of a node.
    #[inline(always)]
    fn stable_step<V: Lanes>(&self, length: V, state: &[V::Row], part: usize, mass: V) -> V {
        let [area, iy, iz, torsion] = self.section;
        let [young, mu] = young_and_shear(self.moduli);
        let two = V::splat(2.0);
        let node = mass * V::splat(0.5);
        let wide = exp(V::load(&state[rows::LATERAL], part));
        let square = wide * wide;
        let inertia = node * V::load(&state[rows::INERTIA], part);
        let [sy, sz] = self.shear_stiffness(length, square);
        let stretching = two * V::splat(young * area) * square / (length * node);
        let shear = sy.max(sz) * (two / (length * node) + length / (two * inertia));
        let turning = two * V::splat((young * iy.max(iz)).max(mu * torsion)) * square * square / (length * inertia);
        two / stretching.max(shear).max(turning).sqrt() * V::splat(BAR_STEP)
    }
}

/// Young's modulus and the shear modulus.
pub fn young_and_shear(moduli: Moduli) -> [f64; 2] {
    [moduli.two_mu * (1.0 + moduli.poisson()), 0.5 * moduli.two_mu]
}
