//! Boundaries that waves leave through: dashpots on the faces of side sets (Lysmer and Kuhlemeyer 1969).
//!
//! A plane wave that leaves a face along its normal n carries the traction t = -ρ c_L (v·n) n - ρ c_S (v - (v·n) n). This
//! traction on the face, lumped at its corners, is a force F = -C v with a symmetric C per node, of the faces as they are
//! in the mesh; mass that MASS SCALING has added to an element counts in its ρ and c. Velocities live at mid-step; the v of
//! a state is the mean of the two around it, and as the later one depends on F, three equations are solved per node:
//!
//! (1 + ½ Δt̄ C/m) v = v⁻ + ½ Δt̄ f/m.
//!
//! A material whose stresses do not know of each other carries t = -√(ρΓ) v, with Christoffel's tensor Γ of its moduli at the start;
//! of an isotropic one that is the same.
//!
//! So the dashpots never give energy, Δt̄ F·v ≤ 0, and the stable step is that of the body without them.

use super::pressure::area_vectors;
use super::{Account, Key, Load, LoadEntry, Places, Setting, Turn};
use crate::common::vector::{cross, dot, normalized, scaled};
use crate::material::Law;
use crate::model::{Function, Model};
use crate::solver::body::Body;
use crate::solver::constraints::StepTimes;
use crate::solver::domain::ABSENT;
use crate::solver::nodes::Nodes;
use nalgebra::{Matrix3, SymmetricEigen};

pub(super) static ENTRY: LoadEntry = LoadEntry {
    command: "SILENT BC",
    works: "SILENTW",
    key: Key::Node(0),
    turn: Turn::Last,
    echo,
    make: |setting| {
        let dashpots = dashpots(setting);
        (!dashpots.is_empty()).then(|| Box::new(Dashpots(dashpots)) as Box<dyn Load>)
    },
};

fn echo(model: &Model) -> (&'static str, &'static str, Vec<String>) {
    let lines = model.silent_boundaries.iter().map(|side_set| format!("{side_set:>13}"));
    ("SILENT BOUNDARIES", "     SIDE SET", lines.collect())
}

/// All dashpots of a rank.
struct Dashpots(Vec<Dashpot>);

impl Load for Dashpots {
    fn entry(&self) -> &'static LoadEntry {
        &ENTRY
    }

    fn apply(&mut self, nodes: &mut Nodes, _: &[Function], step: &StepTimes) {
        self.0.iter_mut().for_each(|dashpot| dashpot.apply(nodes, step.kick));
    }

    fn book(&mut self, nodes: &Nodes, half_step: f64) {
        self.0.iter_mut().for_each(|dashpot| dashpot.book(nodes, half_step));
    }

    fn accounts(&mut self, places: &Places, visit: &mut dyn FnMut(Account)) {
        for Dashpot { node, work, resistance: _, force: _ } in &mut self.0 {
            visit(Account { key: [places.node(*node), 0.0, 0.0, 0.0], own: places.owns(*node), work });
        }
    }
}

/// What the faces at one node of this rank do to it.
#[derive(Debug, Clone)]
struct Dashpot {
    /// Local node.
    node: u32,
    /// Rows of C, force per velocity.
    resistance: [[f64; 3]; 3],
    /// Force on the node now.
    force: [f64; 3],
    /// Work done so far; it is negative.
    work: f64,
}

impl Dashpot {
    /// Adds the force at the present state; all other forces on the node but those of constraints and contact are known.
    fn apply(&mut self, nodes: &mut Nodes, kick: f64) {
        let row = &nodes.rows[self.node as usize].0;
        let half = 0.5 * kick * row[7];
        let f = &mut nodes.forces[self.node as usize].0;
        let before = [0, 1, 2].map(|i| row[4 + i] + half * f[i]);
        let mut matrix = self.resistance.map(|c| scaled(c, half));
        (0..3).for_each(|i| matrix[i][i] += 1.0);
        let velocity = solve(matrix, before);
        self.force = self.resistance.map(|c| -dot(c, velocity));
        (0..3).for_each(|i| f[i] += self.force[i]);
    }

    /// Books half the step's work with the present velocity.
    fn book(&mut self, nodes: &Nodes, half_step: f64) {
        self.work += half_step * dot(self.force, nodes.velocity(self.node));
    }
}

/// x of A x = b, for a symmetric A with eigenvalues of 1 or more.
fn solve(a: [[f64; 3]; 3], b: [f64; 3]) -> [f64; 3] {
    let determinant = dot(a[0], cross(a[1], a[2]));
    let parts = [dot(b, cross(a[1], a[2])), dot(a[0], cross(b, a[2])), dot(a[0], cross(a[1], b))];
    parts.map(|part| part / determinant)
}

/// The dashpots of a rank's nodes, in the order of its nodes. Every rank that has a node sums all faces there, in the
/// order of the mesh, so that all get the same bits.
fn dashpots(setting: &Setting) -> Vec<Dashpot> {
    let Setting { mesh, model, body, local, nodes: _ } = *setting;
    let sets = model.silent_boundaries.iter().filter_map(|set| mesh.side_set(*set));
    // A face that is named twice lets a wave through once.
    let mut sides: Vec<(u32, u8)> = sets.flat_map(|set| set.sides.iter().copied()).collect();
    if sides.is_empty() {
        return Vec::new();
    }
    sides.sort_unstable();
    sides.dedup();
    let elements: Vec<(usize, &[u32])> = mesh.elements().collect();
    let heavier = mass_factors(body, elements.len());
    let mut sums = vec![[[0.0; 3]; 3]; local.len()];
    for (element, side) in sides {
        let (block, corners) = elements[element as usize];
        let material = &model.materials[body.block_material[block]];
        let factor = heavier.get(element as usize).copied().unwrap_or(1.0);
        let density = factor * material.density;
        let Some(nodes) = mesh.blocks[block].shape.face(corners, side) else { continue };
        let areas = area_vectors(nodes.map(|node| body.positions[node as usize]), model.analysis);
        for (node, area) in nodes.into_iter().zip(areas).filter(|(node, _)| local[*node as usize] != ABSENT) {
            add_face(&mut sums[node as usize], area, &material.law, density);
        }
    }
    let mut found: Vec<Dashpot> = local
        .iter()
        .zip(sums)
        .filter(|(node, sum)| **node != ABSENT && *sum != [[0.0; 3]; 3])
        .map(|(&node, resistance)| Dashpot { node, resistance, force: [0.0; 3], work: 0.0 })
        .collect();
    found.sort_unstable_by_key(|dashpot| dashpot.node);
    found
}

/// For each element in the order of the mesh, its mass over that of its material; none where nothing was added.
fn mass_factors(body: &Body, elements: usize) -> Vec<f64> {
    let added = &body.added_mass;
    let mut factors = vec![1.0; if added.elements() > 0 { elements } else { 0 }];
    for (canonical, (&place, mass)) in body.element_order.iter().zip(body.element_mass.iter()).enumerate() {
        if let Some(factor) = factors.get_mut(place as usize) {
            *factor = 1.0 + added.of_element(canonical) / mass;
        }
    }
    factors
}

/// Adds what a face with the area vector a n resists in a material with this law and density, as it is at the start.
fn add_face(sum: &mut [[f64; 3]; 3], area: [f64; 3], law: &Law, density: f64) {
    let Some(normal) = normalized(area) else { return };
    let size = dot(area, area).sqrt();
    let impedance = match law.uncoupled() {
        Some(moduli) => uncoupled_impedance(normal, moduli, density),
        None => {
            let root = |modulus: f64| (density * modulus).sqrt();
            isotropic_impedance(normal, root(law.moduli().dilatational()), root(0.5 * law.moduli().two_mu))
        }
    };
    for i in 0..3 {
        for j in 0..3 {
            sum[i][j] += size * impedance[i][j];
        }
    }
}

/// ρ c_L n nᵀ + ρ c_S (1 - n nᵀ), with `along` = ρ c_L and `across` = ρ c_S.
fn isotropic_impedance(normal: [f64; 3], along: f64, across: f64) -> [[f64; 3]; 3] {
    let mut impedance = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            let unit = if i == j { 1.0 } else { 0.0 };
            impedance[i][j] = across * unit + (along - across) * normal[i] * normal[j];
        }
    }
    impedance
}

/// √(ρΓ) with Γ_ik = C_ijkl n_j n_l, where C has nothing but EX, EY, EZ, GXY, GYZ and GZX: waves along n run at the roots of the
/// eigenvalues of Γ/ρ, along its eigenvectors.
fn uncoupled_impedance([x, y, z]: [f64; 3], [ex, ey, ez, xy, yz, zx]: [f64; 6], density: f64) -> [[f64; 3]; 3] {
    #[rustfmt::skip]
    let christoffel = Matrix3::new(
        ex * x * x + xy * y * y + zx * z * z, xy * x * y, zx * z * x,
        xy * x * y, xy * x * x + ey * y * y + yz * z * z, yz * y * z,
        zx * z * x, yz * y * z, zx * x * x + yz * y * y + ez * z * z,
    );
    let waves = SymmetricEigen::new(christoffel * density);
    let roots = waves.eigenvalues.map(|square| square.max(0.0).sqrt());
    let impedance = waves.eigenvectors * Matrix3::from_diagonal(&roots) * waves.eigenvectors.transpose();
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| impedance[(i, j)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_three_equations() {
        let a = [[2.0, 0.5, -0.25], [0.5, 3.0, 1.0], [-0.25, 1.0, 1.5]];
        let x = [1.0, -2.0, 4.0];
        let b = a.map(|row| dot(row, x));
        let found = solve(a, b);
        assert!((0..3).all(|i| (found[i] - x[i]).abs() < 1e-14), "{found:?}");
    }

    #[test]
    fn a_face_resists_along_and_across_its_normal() {
        let sum = isotropic_impedance([0.0, 0.6, 0.8], 7.0, 2.0).map(|row| scaled(row, 5.0));
        let along = [0.0, 0.6, 0.8];
        let across = [0.0, -0.8, 0.6];
        assert!((0..3).all(|i| (dot(sum[i], along) - 35.0 * along[i]).abs() < 1e-13));
        assert!((0..3).all(|i| (dot(sum[i], across) - 10.0 * across[i]).abs() < 1e-13));
        assert!((dot(sum[0], [1.0, 0.0, 0.0]) - 10.0).abs() < 1e-13);
    }

    /// Along an axis √(ρE) and √(ρG) of it; askew C² = ρΓ.
    #[test]
    fn uncoupled_stresses_resist_each_by_its_own_modulus() {
        let moduli = [4.0, 9.0, 25.0, 1.0, 36.0, 49.0];
        let along_y = uncoupled_impedance([0.0, 1.0, 0.0], moduli, 4.0);
        for (i, root) in [2.0, 6.0, 12.0].into_iter().enumerate() {
            assert!((along_y[i][i] - root).abs() < 1e-12, "{along_y:?}");
            assert!((0..3).all(|j| i == j || along_y[i][j].abs() < 1e-12), "{along_y:?}");
        }
        // Along (1, 1, 0)/√2 the plane of x and y has ρΓ = 4 [(4 + 1)/2, 1/2; 1/2, (1 + 9)/2], and z has 4 (49 + 36)/2.
        let root = 0.5f64.sqrt();
        let askew = uncoupled_impedance([root, root, 0.0], moduli, 4.0);
        let square = |i: usize, j: usize| (0..3).map(|k| askew[i][k] * askew[k][j]).sum::<f64>();
        for (i, j, expected) in [(0, 0, 10.0), (0, 1, 2.0), (1, 1, 20.0), (2, 2, 170.0), (0, 2, 0.0), (1, 2, 0.0)] {
            assert!((square(i, j) - expected).abs() < 1e-11, "{i}{j}: {} {expected}", square(i, j));
        }
    }
}
