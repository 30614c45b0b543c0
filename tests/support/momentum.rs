//! Momenta from the results and the mesh alone.

use super::run::State;
use urto::mesh::Mesh;
use urto::mesh::check::hexahedron_volume;
use urto::model::Model;

/// Mass of every node: an eighth of each of its elements.
pub fn nodal_masses(mesh: &Mesh, model: &Model) -> Vec<f64> {
    let mut masses = vec![0.0; mesh.coordinates.len()];
    for (block, nodes) in mesh.elements() {
        let id = mesh.blocks[block].id;
        let material =
            model.materials.iter().find(|material| material.block == id).expect("every block has a material");
        let mass = material.density
            * hexahedron_volume(
                &[0, 1, 2, 3, 4, 5, 6, 7].map(|corner: usize| mesh.coordinates[nodes[corner] as usize]),
            );
        nodes.iter().for_each(|&n| masses[n as usize] += mass / 8.0);
    }
    masses
}

/// Σ m x × v about the origin.
pub fn angular_momentum(masses: &[f64], state: &State, mesh: &Mesh) -> [f64; 3] {
    let velocity = ["VELX", "VELY", "VELZ"].map(|name| state.nodal(name));
    let mut sum = [0.0; 3];
    for (n, x) in state.positions(mesh).iter().enumerate() {
        let v = velocity.map(|component| component[n]);
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            sum[i] += masses[n] * (x[j] * v[k] - x[k] * v[j]);
        }
    }
    sum
}

/// Length of a vector.
pub fn size(v: [f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}
