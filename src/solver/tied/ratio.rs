//! How much faster than its elements a joint can vibrate: the largest λ with (m + Wᵀ m_s W) x = λ M x over those that are followed.
//!
//! m are their own masses, m_s those of followers, W the weights and M the masses that are computed with. The step of elements is safe for
//! the masses on the left; M equals them for equal velocities, and is not below them for any where no weight is negative (Gershgorin).
//!
//! Power iteration that ends when its quotient settles was deceived: all quotients begin next to 1, since x = 1 is a solution with λ = 1,
//! and where signs happened to go with the mesh two of them agreed at 0.997 with λ = 3.4. Here the number of Lanczos iterations is fixed before.

use super::Follower;
use crate::solver::lanczos::{iterations, largest_eigenvalue, normal};
use std::collections::BTreeMap;

/// Share of λ that the iterations may miss, which is given away.
const MISSED: f64 = 0.02;

/// Chance that they miss more.
const CHANCE: f64 = 1e-12;

/// The masses of a joint.
pub struct Masses {
    /// Of those that are followed, alone.
    own: Vec<f64>,
    /// The same as they are computed with.
    whole: Vec<f64>,
    /// Mass of each follower, and whom it follows with which weights.
    handed: Vec<(f64, Vec<(usize, f64)>)>,
}

impl Masses {
    /// Of followers with these masses; `own` and `whole` are masses by node, before and after they were handed over. `None` where one
    /// that is followed has no mass.
    pub fn of(followers: &[Follower], masses: &[f64], own: &[f64], whole: &[f64]) -> Option<Masses> {
        let mut places: BTreeMap<u32, usize> = BTreeMap::new();
        followers.iter().flat_map(|one| &one.leaders).for_each(|(leader, _)| _ = places.insert(*leader, 0));
        places.values_mut().enumerate().for_each(|(number, place)| *place = number);
        let row = |(one, mass): (&Follower, &f64)| {
            (*mass, one.leaders.iter().map(|(leader, weight)| (places[leader], *weight)).collect())
        };
        let of = |all: &[f64]| -> Vec<f64> { places.keys().map(|&leader| all[leader as usize]).collect() };
        let found = Masses { own: of(own), whole: of(whole), handed: followers.iter().zip(masses).map(row).collect() };
        found.whole.iter().all(|mass| *mass > 0.0).then_some(found)
    }

    /// A bound on λ.
    pub fn largest_ratio(&self) -> f64 {
        let bound = self.gershgorin();
        // Without negative weights it is 1, but for round-off.
        if bound <= 1.0 + 1e-12 { 1.0 } else { bound.min(self.lanczos() / (1.0 - MISSED)).max(1.0) }
    }

    /// The largest sum of sizes in a row of M⁻¹(m + Wᵀ m_s W).
    fn gershgorin(&self) -> f64 {
        let mut rows = self.own.clone();
        for (mass, leaders) in &self.handed {
            let sum: f64 = leaders.iter().map(|(_, weight)| weight.abs()).sum();
            leaders.iter().for_each(|(leader, weight)| rows[*leader] += mass * weight.abs() * sum);
        }
        rows.iter().zip(&self.whole).map(|(row, whole)| row / whole).fold(0.0, f64::max)
    }

    /// What Lanczos iterations find of λ, from below.
    fn lanczos(&self) -> f64 {
        let mut v: Vec<f64> = (0..self.own.len() as u64).map(normal).collect();
        let length = product(&v, &v).sqrt();
        v.iter_mut().for_each(|v| *v /= length);
        let mut before = vec![0.0; v.len()];
        let (mut diagonal, mut beside): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
        for _ in 0..iterations(v.len() as u64, MISSED, CHANCE) {
            let mut image = self.image(&v);
            let along = product(&v, &image);
            let last = beside.last().copied().unwrap_or(0.0);
            for ((image, v), before) in image.iter_mut().zip(&v).zip(&before) {
                *image -= along * v + last * before;
            }
            diagonal.push(along);
            let rest = product(&image, &image).sqrt();
            // What is left is round-off: the whole space has been seen.
            if rest.partial_cmp(&(1e-10 * along.abs())) != Some(std::cmp::Ordering::Greater) {
                break;
            }
            beside.push(rest);
            image.iter_mut().for_each(|image| *image /= rest);
            before = std::mem::replace(&mut v, image);
        }
        largest_eigenvalue(&diagonal, &beside)
    }

    /// M^-½ (m + Wᵀ m_s W) M^-½ v
    fn image(&self, v: &[f64]) -> Vec<f64> {
        let x: Vec<f64> = v.iter().zip(&self.whole).map(|(v, mass)| v / mass.sqrt()).collect();
        let mut y: Vec<f64> = x.iter().zip(&self.own).map(|(x, mass)| mass * x).collect();
        for (mass, leaders) in &self.handed {
            let sum: f64 = leaders.iter().map(|(leader, weight)| weight * x[*leader]).sum();
            leaders.iter().for_each(|(leader, weight)| y[*leader] += weight * mass * sum);
        }
        y.iter_mut().zip(&self.whole).for_each(|(y, mass)| *y /= mass.sqrt());
        y
    }
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::super::{Joint, followers};
    use super::*;

    /// λ by a solver for dense matrices.
    fn exact(masses: &Masses) -> f64 {
        let n = masses.own.len();
        let unit = |i: usize| -> Vec<f64> { (0..n).map(|j| f64::from(u8::from(i == j))).collect() };
        let columns: Vec<Vec<f64>> = (0..n).map(|i| masses.image(&unit(i))).collect();
        nalgebra::DMatrix::from_fn(n, n, |i, j| 0.5 * (columns[j][i] + columns[i][j])).symmetric_eigenvalues().max()
    }

    /// A bound that is not much above what it bounds.
    fn holds(masses: &Masses, case: &str) -> f64 {
        let (found, exact) = (masses.largest_ratio(), exact(masses));
        assert!(found >= exact * (1.0 - 1e-12) && found <= 1.0205 * exact, "{case}: {found} for {exact}");
        exact
    }

    /// A strip of n faces from 0 to 1 follows one of m faces between two places, both one face wide: their masses by area.
    fn strips(n: u32, m: u32, [from, to]: [f64; 2], thickness: f64) -> Option<Masses> {
        let strip = |n: u32, first: u32, [from, to]: [f64; 2], up: bool| {
            let at = |i: u32| from + (to - from) * f64::from(i) / f64::from(n);
            let places: Vec<[f64; 3]> = (0..2 * (n + 1)).map(|k| [at(k / 2), 0.1 * f64::from(k % 2), 0.0]).collect();
            let faces = (0..n).map(|i| {
                let k = first + 2 * i;
                if up { [k, k + 2, k + 3, k + 1] } else { [k, k + 1, k + 3, k + 2] }
            });
            (places, faces.collect::<Vec<_>>())
        };
        let (mut places, following) = strip(n, 0, [0.0, 1.0], true);
        let (others, leading) = strip(m, 2 * (n + 1), [from, to], false);
        places.extend(others);
        let mut own = vec![0.0; places.len()];
        for (faces, thickness) in [(&following, 1.0), (&leading, thickness)] {
            for face in faces {
                let length = (places[face[2] as usize][0] - places[face[0] as usize][0]).abs();
                face.iter().for_each(|&node| own[node as usize] += 0.25 * thickness * length);
            }
        }
        let joint = Joint { following, leading, tolerance: 0.05 };
        let found = followers(&[joint], |node| places[node as usize]);
        let masses: Vec<f64> = found.iter().map(|one| own[one.node as usize]).collect();
        let mut whole = own.clone();
        for (one, mass) in found.iter().zip(&masses) {
            one.leaders.iter().for_each(|(leader, weight)| whole[*leader as usize] += weight * mass);
        }
        Masses::of(&found, &masses, &own, &whole)
    }

    /// Where coarse nodes follow finer ones that they cover in part, wherever these begin and end; the first case is that in which power
    /// iteration found 1.
    #[test]
    fn it_is_a_bound_for_strips_that_cover_each_other_in_part() {
        let first = strips(10, 3, [0.3, 0.602], 1.0).map(|masses| holds(&masses, "ten on three"));
        assert!(first.is_some_and(|ratio| (ratio - 3.37).abs() < 0.01), "{first:?}");
        let (mut cases, mut most) = (0, 0.0f64);
        for n in [1, 2, 5, 10] {
            for m in [1, 3, 4, 9, 40] {
                for k in 0..60 {
                    let from = 0.013 * f64::from(k);
                    let to = (from + 0.05 + 0.0317 * f64::from(k % 17)).min(1.0);
                    let Some(masses) = strips(n, m, [from, to], 0.1 + f64::from(k % 3)) else { continue };
                    most = most.max(holds(&masses, &format!("{n} on {m} from {from} to {to}")));
                    cases += 1;
                }
            }
        }
        assert!(cases > 400 && most > 3.0, "{cases} {most}");
    }

    #[test]
    fn it_is_a_bound_for_random_weights() {
        let mut seed = 0;
        let mut next = || {
            seed += 1;
            normal(seed)
        };
        let mut cases = 0;
        for case in 0..6000 {
            let n = 2 + case % 40;
            let own: Vec<f64> = (0..n).map(|_| next().abs() + 0.01).collect();
            let handed: Vec<(f64, Vec<(usize, f64)>)> = (0..n + case % 7)
                .map(|s| {
                    let weights: Vec<f64> = (0..4.min(n)).map(|_| 0.4 + next()).collect();
                    let sum: f64 = weights.iter().sum();
                    (next().abs(), weights.iter().enumerate().map(|(k, w)| ((s + k * k) % n, w / sum)).collect())
                })
                .collect();
            let mut whole = own.clone();
            handed.iter().for_each(|(mass, row)| row.iter().for_each(|(leader, w)| whole[*leader] += mass * w));
            if whole.iter().all(|mass| *mass > 0.0) {
                holds(&Masses { own, whole, handed }, &format!("case {case}"));
                cases += 1;
            }
        }
        assert!(cases > 300, "{cases}");
    }
}
