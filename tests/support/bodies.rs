//! Momenta and energies of bodies, from plot states that show VELOCITY and MASS.

use super::run::State;
use urto::mesh::Mesh;

/// Nodes of a block, ascending.
pub fn nodes_of(mesh: &Mesh, block: i64) -> Vec<usize> {
    let block = mesh.blocks.iter().find(|known| known.id == block).expect("a block of the mesh");
    let mut nodes: Vec<usize> = block.nodes.iter().map(|&node| node as usize).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Velocities of all nodes.
pub fn velocities(state: &State) -> Vec<[f64; 3]> {
    let v = ["VELX", "VELY", "VELZ"].map(|name| state.nodal(name));
    (0..v[0].len()).map(|n| [v[0][n], v[1][n], v[2][n]]).collect()
}

/// Velocity of the centre of mass of some nodes.
pub fn mean_velocity(state: &State, nodes: &[usize]) -> [f64; 3] {
    let (mass, velocity) = (state.nodal("NODMASS"), velocities(state));
    let total: f64 = nodes.iter().map(|&n| mass[n]).sum();
    [0, 1, 2].map(|i| nodes.iter().map(|&n| mass[n] * velocity[n][i]).sum::<f64>() / total)
}

/// Linear momentum of all nodes.
pub fn momentum(state: &State) -> [f64; 3] {
    let (mass, velocity) = (state.nodal("NODMASS"), velocities(state));
    [0, 1, 2].map(|i| mass.iter().zip(&velocity).map(|(m, v)| m * v[i]).sum())
}

/// Angular momentum of all nodes about the origin. Velocities of a state are the mean of those half a step before and
/// after; with either of them, central differences keep it to round-off when forces have no moment.
pub fn angular_momentum(state: &State, mesh: &Mesh) -> [f64; 3] {
    let (mass, velocity, x) = (state.nodal("NODMASS"), velocities(state), state.positions(mesh));
    let mut sum = [0.0; 3];
    for n in 0..x.len() {
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            sum[i] += mass[n] * (x[n][j] * velocity[n][k] - x[n][k] * velocity[n][j]);
        }
    }
    sum
}

/// Kinetic energy of some nodes from the velocities of the state.
pub fn kinetic_energy(state: &State, nodes: &[usize]) -> f64 {
    let (mass, velocity) = (state.nodal("NODMASS"), velocities(state));
    nodes.iter().map(|&n| 0.5 * mass[n] * velocity[n].iter().map(|v| v * v).sum::<f64>()).sum()
}

/// Length of a vector.
pub fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Difference of two vectors.
pub fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] - b[i])
}
