//! Blocks seen as bodies: where the mass goes, how it turns, what energy it has.
//!
//! Sums run over the elements that are left, each with its corners' shares of its mass, so that blocks that share nodes do
//! not share mass. What a rigid block has beyond the masses at its corners, since it turns as the volume that it is, comes on top.

use super::summed;
use crate::comm::{Communicator, ExactSum};
use crate::mesh::{Block, Mesh};
use crate::solver::Solver;
use crate::solver::elements::{ElementBlock, Group, Sample};
use crate::solver::nodes::{add, cross, dot, scaled, subtract};
use crate::solver::rigid::Turning;
use nalgebra::{Matrix3, Vector3};

/// Sums of a block: mass; mass times displacement, velocity, place, angular momentum; second moments of mass; energies.
const SUMS: usize = 23;
/// Determinant of the inertia, relative to its largest term, below which a body has an axis about which it cannot turn.
const FLAT: f64 = 1e-12;

/// A block's motion as a body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Mean displacement of the mass.
    pub displacement: [f64; 3],
    /// Velocity of the centre of mass.
    pub velocity: [f64; 3],
    /// Angular velocity of the rigid body that has this angular momentum and inertia about the centre of mass.
    pub rotation: [f64; 3],
    /// Momentum.
    pub momentum: [f64; 3],
    /// Mass.
    pub mass: f64,
    /// Kinetic, internal and hourglass energy, and what bulk viscosity has dissipated.
    pub energies: [f64; 4],
}

impl Motion {
    /// Names of [`Motion::values`].
    pub const NAMES: [&str; 20] = [
        "DISPLX", "DISPLY", "DISPLZ", "VELX", "VELY", "VELZ", "ACCLX", "ACCLY", "ACCLZ", "ROTX", "ROTY", "ROTZ",
        "XMOM", "YMOM", "ZMOM", "MASS", "KE", "IE", "HGE", "BVE",
    ];

    /// All of it, with room for the acceleration.
    pub fn values(&self) -> [f64; 20] {
        let vectors = [self.displacement, self.velocity, [0.0; 3], self.rotation, self.momentum];
        let mut all = vectors.into_iter().flatten().chain([self.mass]).chain(self.energies);
        std::array::from_fn(|_| all.next().unwrap_or(0.0))
    }

    fn of(sums: &[f64]) -> Motion {
        let vector = |first: usize| [0, 1, 2].map(|i| sums[first + i]);
        let mass = sums[0];
        let over = if mass > 0.0 { 1.0 / mass } else { 0.0 };
        let (momentum, centre) = (vector(4), scaled(vector(7), over));
        // About the centre of mass: what the mass there would have is taken off.
        let spin = subtract(vector(10), cross(centre, momentum));
        let about = |i: usize, j: usize, moment: f64| moment - mass * centre[i] * centre[j];
        let [xx, yy, zz] = [about(0, 0, sums[13]), about(1, 1, sums[14]), about(2, 2, sums[15])];
        let [xy, yz, zx] = [about(0, 1, sums[16]), about(1, 2, sums[17]), about(2, 0, sums[18])];
        let inertia = Matrix3::new(yy + zz, -xy, -zx, -xy, zz + xx, -yz, -zx, -yz, xx + yy);
        let whole = inertia.determinant() > FLAT * inertia.amax().powi(3);
        let turned = inertia.try_inverse().filter(|_| whole).map(|inverse| inverse * Vector3::from(spin));
        Motion {
            displacement: scaled(vector(1), over),
            velocity: scaled(momentum, over),
            rotation: turned.map_or([0.0; 3], Into::into),
            momentum,
            mass,
            energies: [sums[19], sums[20], sums[21], sums[22]],
        }
    }
}

/// Names of each block's energies among the global variables of the plot file.
pub fn block_energy_names(mesh: &Mesh) -> Vec<String> {
    let of_block = |block: &Block| ["KE", "IE", "HGE", "BVE"].map(|name| format!("{name}_BLOCK{}", block.id));
    mesh.blocks.iter().flat_map(of_block).collect()
}

/// The energies of each block in the order of their names, on all ranks. All ranks call it.
pub fn block_energies(blocks: usize, solver: &Solver, comm: &mut dyn Communicator) -> Vec<f64> {
    let all: Vec<usize> = (0..blocks).collect();
    block_motions(&all, solver, comm).iter().flat_map(|motion| motion.energies).collect()
}

/// The motions of blocks, by their positions in the mesh, on all ranks. All ranks call it.
pub fn block_motions(blocks: &[usize], solver: &Solver, comm: &mut dyn Communicator) -> Vec<Motion> {
    let mut sums: Vec<ExactSum> = (0..SUMS * blocks.len()).map(|_| ExactSum::new()).collect();
    for block in &solver.domain.blocks {
        let Ok(place) = blocks.binary_search(&block.index) else { continue };
        let own = &mut sums[SUMS * place..SUMS * (place + 1)];
        let [.., internal, hourglass, viscous] = &mut *own else { continue };
        block.add_energies(solver.longer(), [internal, hourglass, viscous]);
        for group in block.groups() {
            for i in (0..group.len()).filter(|&i| group.is_alive(i)) {
                own.iter_mut().zip(element(solver, block, group, i)).for_each(|(sum, part)| sum.add(part));
            }
        }
    }
    let rigid = solver.domain.rigid.iter().filter(|_| comm.rank() == 0);
    for (block, turning) in rigid.flat_map(|rigid| rigid.surplus_of_blocks(solver.step > 0)) {
        let Ok(place) = blocks.binary_search(&block) else { continue };
        let own = &mut sums[SUMS * place..SUMS * (place + 1)];
        own.iter_mut().zip(surplus(&turning)).for_each(|(sum, part)| sum.add(part));
    }
    summed(sums, comm).chunks_exact(SUMS).map(Motion::of).collect()
}

/// The part of the sums that turns with a body, about its centre.
fn surplus(turning: &Turning) -> [f64; SUMS] {
    let mut sums = [0.0; SUMS];
    sums[10..13].copy_from_slice(&turning.momentum);
    // Second moments S of the inertia tr(S) 1 − S.
    let inertia = turning.inertia;
    let half = 0.5 * (inertia[0][0] + inertia[1][1] + inertia[2][2]);
    for (k, (a, b)) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].into_iter().enumerate() {
        sums[13 + k] = if a == b { half - inertia[a][a] } else { -inertia[a][b] };
    }
    sums[19] = turning.energy;
    sums
}

/// An element's part of the sums but for the last three, which its block adds as the balance of energy does. Places are measured from the origin of the mesh.
fn element(solver: &Solver, block: &ElementBlock, group: &Group, i: usize) -> [f64; SUMS] {
    let nodes = &solver.domain.nodes;
    let own: Vec<u32> = (0..group.unknowns).map(|unknown| group.node(i, unknown)).collect();
    let (own, rotations) = own.split_at(group.corners);
    let corners: Vec<[f64; 3]> = own.iter().map(|&node| nodes.initial(node)).collect();
    let mut shares = vec![0.0; group.unknowns];
    let sample = Sample { nodes: own, corners: &corners, attributes: &[] };
    // The mass itself is known.
    block.element.weigh(&sample, 1.0, &mut shares);
    let mut sums = [0.0; SUMS];
    let (shares, inertias) = shares.split_at(group.corners);
    for (&node, share) in own.iter().zip(shares) {
        let mass = share * group.moving_mass(i);
        let (x, velocity) = (nodes.position(node), solver.velocity_now(node));
        let momentum = scaled(velocity, mass);
        let moved = scaled(subtract(x, nodes.initial(node)), mass);
        let vectors = [moved, momentum, scaled(x, mass), cross(x, momentum)];
        sums[0] += mass;
        for (first, vector) in [1, 4, 7, 10].into_iter().zip(vectors) {
            let sum = add([sums[first], sums[first + 1], sums[first + 2]], vector);
            sums[first..first + 3].copy_from_slice(&sum);
        }
        for (k, (a, b)) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].into_iter().enumerate() {
            sums[13 + k] += mass * x[a] * x[b];
        }
        let [before, after] = solver.velocities_around(node);
        sums[19] += 0.5 * mass * (0..3).map(|a| before[a] * after[a]).sum::<f64>();
    }
    for (&rotation, share) in rotations.iter().zip(inertias) {
        let inertia = share * group.moving_mass(i);
        let [before, after] = solver.velocities_around(rotation);
        let rate = scaled(add(before, after), 0.5 * inertia);
        for a in 0..3 {
            sums[10 + a] += rate[a];
            // Of which two make the inertia about an axis.
            sums[13 + a] += 0.5 * inertia;
        }
        sums[19] += 0.5 * inertia * dot(before, after);
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four masses at the corners of a square far from the origin, turning about z and flying off.
    #[test]
    fn a_turning_square_has_its_rate() {
        let (centre, velocity, rate) = ([3.0, -2.0, 5.0], [1.0, 2.0, -4.0], 7.0);
        let mut sums = [0.0; SUMS];
        for [a, b] in [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]] {
            let x = add(centre, [a, b, 0.0]);
            let v = add(velocity, [-rate * b, rate * a, 0.0]);
            let momentum = scaled(v, 2.0);
            sums[0] += 2.0;
            for (first, vector) in [(4, momentum), (7, scaled(x, 2.0)), (10, cross(x, momentum))] {
                (0..3).for_each(|i| sums[first + i] += vector[i]);
            }
            for (k, (i, j)) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].into_iter().enumerate() {
                sums[13 + k] += 2.0 * x[i] * x[j];
            }
        }
        let motion = Motion::of(&sums);
        let near = |found: [f64; 3], value: [f64; 3]| (0..3).all(|i| (found[i] - value[i]).abs() < 1e-12);
        assert!(near(motion.rotation, [0.0, 0.0, rate]) && near(motion.velocity, velocity), "{motion:?}");
        assert_eq!((motion.mass, Motion::of(&[0.0; SUMS])), (8.0, Motion::default()));
    }
}
