//! The cost of a whole step per element: laws, hourglass controls, instruction sets, sizes, ranks; beside it the
//! machine's bandwidth measured in the same run. `cargo bench --bench step`; a word as argument picks sections.

use std::hint::black_box;
use std::time::Instant;
use urto::comm::{Communicator, Serial, run_threads};
use urto::lanes::InstructionSet;
use urto::material::{Elastic, ElasticPlastic, Law};
use urto::mesh::{Block, Dimension, Mesh, NodeSet, Shape};
use urto::model::*;
use urto::solver::{Body, Request, Solver};

/// A box of n³ cubes of edge 1; node set 1 is the side x = 0.
fn cubes(n: usize) -> Mesh {
    let m = n + 1;
    let at = |i: usize, j: usize, k: usize| ((k * m + j) * m + i) as u32;
    let range = |n: usize| (0..n).flat_map(move |k| (0..n).flat_map(move |j| (0..n).map(move |i| (i, j, k))));
    let corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)];
    let connectivity: Vec<[u32; 8]> =
        range(n).map(|(i, j, k)| corners.map(|(a, b, c)| at(i + a, j + b, k + c))).collect();
    Mesh {
        coordinates: range(m).map(|(i, j, k)| [i as f64, j as f64, k as f64]).collect(),
        node_sets: vec![NodeSet {
            id: 1,
            nodes: range(m).filter(|p| p.0 == 0).map(|(i, j, k)| at(i, j, k)).collect(),
            ..Default::default()
        }],
        node_ids: (1..=(m * m * m) as i64).collect(),
        element_ids: (1..=connectivity.len() as i64).collect(),
        blocks: vec![Block::hexahedra_of(1, connectivity)],
        ..Default::default()
    }
}

/// A flat sheet of about as many squares of edge 1 as [`cubes`] has cubes; node set 1 is the side x = 0.
fn squares(n: usize) -> Mesh {
    let n = ((n * n * n) as f64).sqrt().round() as usize;
    let m = n + 1;
    let at = |i: usize, j: usize| (j * m + i) as u32;
    let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
    let all = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let nodes: Vec<u32> = all.flat_map(|(i, j)| corners.map(|(a, b)| at(i + a, j + b))).collect();
    Mesh {
        coordinates: (0..m * m).map(|place| [(place % m) as f64, (place / m) as f64, 0.0]).collect(),
        node_sets: vec![NodeSet { id: 1, nodes: (0..m).map(|j| at(0, j)).collect(), ..Default::default() }],
        node_ids: (1..=(m * m) as i64).collect(),
        element_ids: (1..=(n * n) as i64).collect(),
        blocks: vec![Block { id: 1, shape: Shape::Quadrilateral, nodes, ..Block::default() }],
        ..Default::default()
    }
}

/// The model of a sheet with so many points through a thickness of a tenth.
fn sheet(law: Law, points: usize) -> Model {
    let section = |command: &str, (field, value): (&str, f64)| Section {
        command: command.into(),
        block: 1,
        numbers: vec![(field.into(), value)],
        words: Vec::new(),
    };
    let sections =
        vec![section("SHELL THICKNESS", ("thickness", 0.1)), section("INTEGRATION POINTS", ("points", points as f64))];
    // Stretched and bent, so that all points yield.
    let velocity = [1e-2, 3e-3, 1e-3];
    Model { sections, initial_velocities: vec![InitialVelocity::Material { block: 1, velocity }], ..model(law, FB) }
}

/// A square of n² squares of edge 1 in the plane, away from an axis; node set 1 is the side where x is least.
fn plane_squares(n: usize) -> Mesh {
    let m = n + 1;
    let at = |i: usize, j: usize| (j * m + i) as u32;
    let range = |n: usize| (0..n).flat_map(move |j| (0..n).map(move |i| (i, j)));
    let nodes = range(n).flat_map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]).collect();
    let block = Block { id: 1, name: String::new(), shape: Shape::Plane, nodes, attributes: Vec::new() };
    let left = NodeSet { id: 1, nodes: (0..m).map(|j| at(0, j)).collect(), ..Default::default() };
    Mesh {
        dimension: Dimension::Two,
        coordinates: range(m).map(|(i, j)| [1.0 + i as f64, j as f64, 0.0]).collect(),
        node_sets: vec![left],
        node_ids: (1..=(m * m) as i64).collect(),
        element_ids: (1..=block.len() as i64).collect(),
        blocks: vec![block],
        ..Default::default()
    }
}

fn elastic() -> Law {
    Law::Elastic(Elastic { young: 1.0, poisson: 0.3 })
}

/// Yields in the first steps, so that the return really works.
fn plastic() -> Law {
    Law::ElasticPlastic(ElasticPlastic { young: 1.0, poisson: 0.3, yield_stress: 1e-4, hardening: 0.01, beta: 1.0 })
}

const FB: Hourglass = Hourglass::FlanaganBelytschko { stiffness: 0.05, viscosity: 0.0 };
const ASSUMED: Hourglass = Hourglass::AssumedStrain { factor: 1.0 };

fn model(law: Law, hourglass: Hourglass) -> Model {
    Model {
        termination_time: 1e9,
        output_interval: 1e9,
        plot: PlotSchedule { interval: None, start: 0.0, stop: 0.0 },
        time_step: TimeStepControl {
            scale: 0.9,
            softening: 1.0,
            growth: 1.1,
            moduli: StepModuli::Elastic,
            longest: f64::INFINITY,
        },
        bulk_viscosity: BulkViscosity { linear: 0.06, quadratic: 1.2 },
        hourglass,
        materials: vec![BlockMaterial { block: 1, density: 1.0, law }],
        no_displacements: vec![NoDisplacement { of: Unknown::Position, direction: Direction::X, node_set: 1 }],
        initial_velocities: vec![InitialVelocity::Material { block: 1, velocity: [1e-2, 3e-3, 0.0] }],
        ..Model::default()
    }
}

fn take_steps(solver: &mut Solver, comm: &mut dyn Communicator, steps: usize) {
    for _ in 0..steps {
        if let Err(stop) = solver.prepare(Request::Continue, comm) {
            panic!("the benchmark's problem failed: {stop}");
        }
        solver.advance();
    }
}

/// Nanoseconds per element and step: the best of several bursts, on `ranks` ranks.
fn grind(n: usize, law: Law, hourglass: Hourglass, instructions: InstructionSet, ranks: usize) -> f64 {
    grind_of(&cubes(n), &model(law, hourglass), instructions, ranks)
}

/// The same of any mesh and model.
fn grind_of(mesh: &Mesh, model: &Model, instructions: InstructionSet, ranks: usize) -> f64 {
    let count = mesh.element_count();
    let body = Body::new(mesh, model).expect("materials");
    let cut = body.cut(ranks);
    let contributors = body.contributors(&cut);
    let decomposition = body.decomposition(&contributors, ranks);
    let burst = (4_000_000 / count).clamp(3, 200);
    let run = |comm: &mut dyn Communicator| {
        let mut solver = Solver::new(mesh, model, &body, &decomposition.share(comm.rank()), comm);
        solver.use_instructions(instructions);
        take_steps(&mut solver, comm, burst);
        let mut best = f64::INFINITY;
        for _ in 0..6 {
            comm.barrier();
            let begun = Instant::now();
            take_steps(&mut solver, comm, burst);
            comm.barrier();
            best = best.min(begun.elapsed().as_secs_f64());
        }
        best
    };
    let seconds = if ranks == 1 {
        run(&mut Serial)
    } else {
        match run_threads(ranks, |comm| Ok::<f64, ()>(run(comm))) {
            Ok(times) => times.into_iter().fold(0.0, f64::max),
            Err(_) => f64::NAN,
        }
    };
    seconds * 1e9 / (burst * count) as f64
}

/// Seconds per byte of reading and writing an array of so many bytes, counting both directions.
fn seconds_per_byte(bytes: usize) -> f64 {
    let mut array = vec![1.0f64; bytes / 8];
    let mut best = f64::INFINITY;
    for _ in 0..8 {
        let begun = Instant::now();
        for x in &mut array {
            *x *= 1.000_000_1;
        }
        black_box(&mut array);
        best = best.min(begun.elapsed().as_secs_f64());
    }
    best / (2 * bytes) as f64
}

/// Bytes that a step must move per element when nothing is fetched twice: state and nodes both ways in the element
/// pass, nodes and forces both ways in the update; connectivity and mass in.
fn bytes_per_element(law_rows: usize) -> f64 {
    let state = 2 * 8 * (32 + law_rows);
    let element_pass = state + 8 + 32 + 64 + 2 * 32;
    let update = 2 * 64 + 2 * 32;
    (element_pass + update) as f64
}

fn laws() {
    let n = 64;
    println!("{n}³ elements, one rank, no output: ns per element and step");
    let per_byte = seconds_per_byte(n * n * n * 600);
    println!("  bandwidth, read and write: {:.1} GB/s", 1e-9 / per_byte);
    println!("  {:<34}{:>10}{:>10}{:>10}{:>14}{:>10}", "", "AVX-512", "AVX2", "portable", "streaming", "ratio");
    for (name, law, rows, hourglass) in [
        ("elastic, Flanagan-Belytschko", elastic(), 0, FB),
        ("elastic, assumed strain", elastic(), 0, ASSUMED),
        ("elastic plastic, F.-B.", plastic(), 1, FB),
        ("elastic plastic, assumed strain", plastic(), 1, ASSUMED),
    ] {
        let sets: Vec<InstructionSet> = InstructionSet::available().collect();
        let time = |place: usize| sets.get(place).map_or(f64::NAN, |set| grind(n, law.clone(), hourglass, *set, 1));
        let [wide, half, portable] = [2, 1, 0].map(time);
        let streaming = bytes_per_element(rows) * per_byte * 1e9;
        let best = wide.min(half).min(portable);
        println!("  {name:<34}{wide:>10.1}{half:>10.1}{portable:>10.1}{streaming:>14.1}{:>10.2}", best / streaming);
    }
}

/// Bytes that a step of a shell must move: its rows and those of its points both ways, corners and their rotations.
fn bytes_per_shell(points: usize, law_rows: usize) -> f64 {
    let state = 2 * 8 * (40 + points * (7 + law_rows));
    let nodes = 2 * (64 + 2 * 32 + 2 * 64);
    (state + 8 + 16 + nodes) as f64
}

fn shells() {
    let n = 40;
    let per_byte = seconds_per_byte(n * n * n * 600);
    println!("{} shells beside {n}³ one-point hexahedra, one rank, no output: ns per element and step", 253 * 253);
    println!("  bandwidth, read and write: {:.1} GB/s", 1e-9 / per_byte);
    println!("  {:<34}{:>10}{:>10}{:>10}{:>14}{:>14}", "", "AVX-512", "AVX2", "portable", "streaming", "per point");
    let sets: Vec<InstructionSet> = InstructionSet::available().collect();
    let squares = squares(n);
    for (name, law, rows) in [("elastic", elastic as fn() -> Law, 0), ("elastic plastic", plastic, 1)] {
        let time = |mesh: &Mesh, model: &Model| {
            [2, 1, 0].map(|place| sets.get(place).map_or(f64::NAN, |set| grind_of(mesh, model, *set, 1)))
        };
        let hexahedra = time(&cubes(n), &model(law(), FB));
        let line = |what: String, [wide, half, portable]: [f64; 3], bytes: f64, per_point: f64| {
            let streaming = bytes * per_byte * 1e9;
            println!("  {what:<34}{wide:>10.1}{half:>10.1}{portable:>10.1}{streaming:>14.1}{per_point:>14.1}");
        };
        line(format!("hexahedron, {name}"), hexahedra, bytes_per_element(rows), hexahedra[0]);
        for points in [1, 2, 3, 5, 9] {
            let shell = time(&squares, &sheet(law(), points));
            let what = format!("{points} points, {name}");
            line(what, shell, bytes_per_shell(points, rows), shell[0] / points as f64);
            let ratios = [0, 1, 2].map(|i| shell[i] / hexahedra[i]);
            line("  in hexahedra".into(), ratios, 0.0, ratios[0] / points as f64);
        }
    }
}

/// Quadrilaterals beside hexahedra, as many of each, of metal that yields and of none; in cache and far out of it.
fn plane() {
    let sets: Vec<InstructionSet> = InstructionSet::available().collect();
    for (n, side) in [(16, 64), (100, 1000)] {
        let (solid, flat) = (cubes(n), plane_squares(side));
        println!("{} hexahedra and {} quadrilaterals, one rank: ns per element and step", n * n * n, side * side);
        println!("  {:<44}{:>10}{:>10}{:>10}", "", "AVX-512", "AVX2", "portable");
        for (name, law) in [("elastic", elastic as fn() -> Law), ("elastic plastic", plastic)] {
            let cases = [
                ("hexahedra", &solid, Analysis::Solid),
                ("plane strain", &flat, Analysis::PlaneStrain),
                ("axisymmetric", &flat, Analysis::Axisymmetric),
            ];
            let models = cases.map(|(_, _, analysis)| Model { analysis, ..model(law(), ASSUMED) });
            let mut best = [[f64::INFINITY; 3]; 3];
            // In turn, so that what else the machine does is in all of them.
            for _ in 0..3 {
                for ((best, (_, mesh, _)), model) in best.iter_mut().zip(&cases).zip(&models) {
                    for (best, set) in best.iter_mut().zip(&sets) {
                        *best = best.min(grind_of(mesh, model, *set, 1));
                    }
                }
            }
            for ((what, ..), [portable, half, wide]) in cases.iter().zip(best) {
                println!("  {:<44}{wide:>10.1}{half:>10.1}{portable:>10.1}", format!("{name}, {what}"));
            }
        }
    }
}

/// Double and single precision in turn, in a cache and at 64³.
fn precision() {
    println!("double and single precision, assumed strain, one rank: ns per element and step");
    println!("  {:<34}{:>10}{:>10}{:>10}{:>10}", "", "set", "double", "single", "ratio");
    for (name, law) in [("elastic", elastic()), ("elastic plastic", plastic())] {
        for n in [16, 64] {
            let mesh = cubes(n);
            for set in InstructionSet::available().collect::<Vec<_>>().into_iter().rev() {
                let [double, single] = [Precision::Double, Precision::Single].map(|precision| {
                    let model = Model { precision, ..model(law.clone(), ASSUMED) };
                    grind_of(&mesh, &model, set, 1)
                });
                let what = format!("{name}, {n}³");
                println!("  {what:<34}{:>10}{double:>10.1}{single:>10.1}{:>10.2}", set.name(), single / double);
            }
        }
    }
}

fn sizes() {
    println!("elastic, Flanagan-Belytschko, one rank, by size: ns per element and step");
    for n in [22, 32, 64, 100, 159] {
        println!("  {:>9} elements {:>8.1}", n * n * n, grind(n, elastic(), FB, InstructionSet::detect(), 1));
    }
}

fn ranks() {
    println!("elastic, assumed strain, 64³ elements by thread ranks: ns per element and step");
    let one = grind(64, elastic(), ASSUMED, InstructionSet::detect(), 1);
    for ranks in [1, 2] {
        let time = grind(64, elastic(), ASSUMED, InstructionSet::detect(), ranks);
        println!("  {ranks} rank(s) {time:>8.1}   speed-up {:.2}", one / time);
    }
}

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    for (name, section) in [
        ("laws", laws as fn()),
        ("sizes", sizes),
        ("precision", precision),
        ("ranks", ranks),
        ("shells", shells),
        ("plane", plane),
    ] {
        if wanted.is_empty() || wanted.iter().any(|w| w == name) {
            section();
        }
    }
}
