//! The stiffness matrix of a mesh, measured through the solver's own element forces, and static solutions with it.

use super::meshes::nodes_where;
use super::run::model;
use nalgebra::{DMatrix, DVector};
use urto::comm::Serial;
use urto::mesh::Mesh;
use urto::partition::Decomposition;
use urto::solver::{Body, Request, Solver};

/// Displacement that every degree of freedom gets in turn, relative to the unit of length: strains come from
/// velocities, so it may be far below round-off of the coordinates, and nothing is left of geometric non-linearity.
const NUDGE: f64 = 1e-14;

/// K, three rows and columns per node in the mesh's order. The deck says which material and which hourglass control;
/// it must ask for no bulk viscosity, no loads and no constraints.
pub fn stiffness(deck: &str, mesh: &Mesh) -> DMatrix<f64> {
    let model = model(deck, mesh);
    let body = Body::new(mesh, &model).expect("materials");
    let cut = body.cut(1);
    let contributors = body.contributors(&cut);
    let decomposition = Decomposition::new(&contributors, mesh.coordinates.len(), 1);
    let size = 3 * mesh.coordinates.len();
    let mut matrix = DMatrix::zeros(size, size);
    for column in 0..size {
        let mut solver = Solver::new(mesh, &model, &body, &decomposition.share(0), &mut Serial);
        solver.prepare(Request::Continue, &mut Serial).expect("the body at rest is sound");
        let local = |file: usize, s: &Solver| s.domain.nodes.file.iter().position(|&f| f as usize == file);
        let node = local(column / 3, &solver).expect("every node is used");
        solver.domain.nodes.rows[node].0[4 + column % 3] = NUDGE / solver.time_step;
        solver.advance();
        solver.prepare(Request::Continue, &mut Serial).expect("a tiny displacement is harmless");
        let nodes = &solver.domain.nodes;
        for (force, &file) in nodes.forces.iter().zip(&nodes.file) {
            for i in 0..3 {
                matrix[(3 * file as usize + i, column)] = -force.0[i] / NUDGE;
            }
        }
    }
    matrix
}

/// u of K u = f with the degrees of freedom that `held` names kept at zero.
pub fn solve(matrix: &DMatrix<f64>, force: &DVector<f64>, held: impl Fn(usize, usize) -> bool) -> DVector<f64> {
    let free: Vec<usize> = (0..force.len()).filter(|&dof| !held(dof / 3, dof % 3)).collect();
    let small = matrix.select_rows(&free).select_columns(&free);
    let solution = small.cholesky().expect("K is positive definite").solve(&force.select_rows(&free));
    let mut u = DVector::zeros(force.len());
    for (&dof, value) in free.iter().zip(solution.iter()) {
        u[dof] = *value;
    }
    u
}

/// Forces of a unit shear in y on the end x = `length` of a bar of unit width and depth: at each node its share of the area.
pub fn end_shear(mesh: &Mesh, length: f64, cells: [usize; 3]) -> DVector<f64> {
    let mut force = DVector::zeros(3 * mesh.coordinates.len());
    for n in nodes_where(mesh, |p| p[0] == length) {
        let p = mesh.coordinates[n as usize];
        let share = |x: f64, cells: usize| (if x == 0.0 || x == 1.0 { 0.5 } else { 1.0 }) / cells as f64;
        force[3 * n as usize + 1] = share(p[1], cells[1]) * share(p[2], cells[2]);
    }
    force
}

/// Whether the root x = 0 of such a bar holds a node in a direction: as little as bending theory does, so that the root may
/// grow thinner where it is stretched.
pub fn held_at_root(mesh: &Mesh, node: usize, axis: usize) -> bool {
    let [x, y, z] = mesh.coordinates[node];
    x == 0.0 && (axis == 0 || (axis == 1 && y == 0.0) || (axis == 2 && y == 0.0 && z == 0.0))
}
