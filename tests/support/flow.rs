//! Fluids on the move: a run whose nodes begin with given velocities, and the cells that it leaves.

use super::meshes::{add_node_set, brick};
use urto::comm::Serial;
use urto::mesh::Mesh;
use urto::mesh::check::hexahedron_volume;
use urto::mesh::corners::least_corner;
use urto::model::Model;
use urto::solver::{Body, Request, Solver, centroid};

/// An element where a run has left it.
#[derive(Debug, Clone, Copy)]
pub struct Cell {
    /// Centre at the start and now.
    pub start: [f64; 3],
    /// Centre now.
    pub centre: [f64; 3],
    /// Volume at the start.
    pub first_volume: f64,
    /// Volume now.
    pub volume: f64,
    /// Density now.
    pub density: f64,
    /// Internal energy per mass that it has taken up since the start.
    pub gained: f64,
    /// Pressure without viscosity.
    pub pressure: f64,
    /// The least Jacobian of its corners over the mean one.
    pub corner: f64,
}

/// What a run leaves.
pub struct Flow {
    /// Elements in the mesh's order.
    pub cells: Vec<Cell>,
    /// Nodes in the mesh's order.
    pub positions: Vec<[f64; 3]>,
    /// Largest error of the energy balance on the way.
    pub balance: f64,
    /// Steps taken.
    pub steps: u64,
    /// Time of the end.
    pub time: f64,
    /// Elements of which a corner was inside out in some state that was looked at.
    pub turned: usize,
}

/// Distance from the origin.
pub fn radius(x: &[f64; 3]) -> f64 {
    (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt()
}

/// A cube of n³ elements from the origin, and cards that hold the planes through it.
pub fn octant(n: usize, size: f64) -> (Mesh, String) {
    let mut mesh = brick([n, n, n], [size; 3]);
    let mut cards = String::new();
    for (axis, id) in (0..3).zip([11, 12, 13]) {
        add_node_set(&mut mesh, id, |x| x[axis] == 0.0);
        cards += &format!("NO DISPLACEMENT, {}, {id}\n", ["X", "Y", "Z"][axis]);
    }
    (mesh, cards)
}

/// A solver of the whole problem.
pub fn alone(mesh: &Mesh, model: &Model) -> Solver {
    let body = Body::new(mesh, model).expect("materials");
    let cut = body.cut(1);
    let contributors = body.contributors(&cut);
    let decomposition = body.decomposition(&contributors, 1);
    Solver::new(mesh, model, &body, &decomposition.share(0), &mut Serial)
}

/// Steps between looks at energies and corners.
const LOOK: u64 = 20;

/// Runs a deck to its end, with nodes that begin at `velocity` of their positions where one is given.
pub fn flow(mesh: &Mesh, deck: &str, velocity: Option<&dyn Fn([f64; 3]) -> [f64; 3]>) -> Flow {
    let model = super::run::model(deck, mesh);
    let mut solver = alone(mesh, &model);
    if let Some(velocity) = velocity {
        for row in &mut solver.domain.nodes.rows {
            let given = velocity([row.0[0], row.0[1], row.0[2]]);
            row.0[4..7].copy_from_slice(&given);
        }
        let kinetic = |row: &urto::lanes::Row| 0.5 * row.0[3] * row.0[4..7].iter().map(|v| v * v).sum::<f64>();
        solver.initial_energy = solver.domain.nodes.rows.iter().map(kinetic).sum();
    }
    let mut balance = 0.0_f64;
    let mut turned = vec![false; mesh.element_count()];
    loop {
        solver.prepare(Request::Continue, &mut Serial).unwrap_or_else(|stop| panic!("{stop}"));
        let last = solver.time + 0.5 * solver.time_step >= model.termination_time;
        if last || solver.step.is_multiple_of(LOOK) {
            let totals = solver.totals(&mut Serial);
            balance = balance.max(totals.relative_error(solver.initial_energy).abs());
            for (cell, turned) in cells(mesh, &positions(mesh, &solver)).iter().zip(&mut turned) {
                *turned |= cell.corner <= 0.0;
            }
        }
        if last {
            break;
        }
        solver.advance();
    }
    let positions = positions(mesh, &solver);
    let mut cells = cells(mesh, &positions);
    of_material(&solver, &mut cells);
    let turned = turned.iter().filter(|turned| **turned).count();
    Flow { cells, positions, balance, steps: solver.step, time: solver.time, turned }
}

fn positions(mesh: &Mesh, solver: &Solver) -> Vec<[f64; 3]> {
    let mut positions = mesh.coordinates.to_vec();
    for (here, &file) in solver.domain.nodes.file.iter().enumerate() {
        positions[file as usize] = solver.domain.nodes.position(here as u32);
    }
    positions
}

fn cells(mesh: &Mesh, positions: &[[f64; 3]]) -> Vec<Cell> {
    let cell = |nodes: &[u32; 8]| {
        let [first, now] = [&mesh.coordinates[..], positions].map(|x| nodes.map(|n| x[n as usize]));
        Cell {
            start: centroid(&first),
            centre: centroid(&now),
            first_volume: hexahedron_volume(&first),
            volume: hexahedron_volume(&now),
            corner: least_corner(nodes, &now),
            density: 0.0,
            gained: 0.0,
            pressure: 0.0,
        }
    };
    mesh.hexahedra().map(cell).collect()
}

fn of_material(solver: &Solver, cells: &mut [Cell]) {
    let domain = &solver.domain;
    for block in &domain.blocks {
        let energies = &block.element.entry().energies;
        let rows = [Some(energies.internal), energies.viscous, energies.hourglass];
        for group in block.groups() {
            for i in 0..group.len() {
                let cell = &mut cells[domain.element_file[group.places[i] as usize] as usize];
                let mass = group.element_mass(i);
                cell.density = mass / cell.volume;
                cell.gained = rows.iter().flatten().map(|&row| group.value(i, row)).sum::<f64>() / mass;
                cell.pressure = -block.element.stress(group, i).trace() / 3.0;
            }
        }
    }
}
