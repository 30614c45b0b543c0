//! Free flight of a block of elements through the whole solver: what may not change does not, and the stress is that
//! of a spinning body (V-04, extreme 1).

use urto::comm::Serial;
use urto::material::{Elastic, Law};
use urto::mesh::{Block, Mesh};
use urto::model::{
    BlockMaterial, BulkViscosity, Hourglass, InitialVelocity, Model, PlotSchedule, StepModuli, TimeStepControl,
};
use urto::partition::Decomposition;
use urto::solver::elements::hexahedron::rows;
use urto::solver::{Body, Request, Solver, Stop};

const EDGE: f64 = 0.1;
const DENSITY: f64 = 7850.0;
const ASSUMED: Hourglass = Hourglass::AssumedStrain { factor: 1.0 };
const FLANAGAN_BELYTSCHKO: Hourglass = Hourglass::FlanaganBelytschko { stiffness: 0.05, viscosity: 0.0 };

/// A cube of n × n × n elements centred on the origin.
fn cube(n: usize) -> Mesh {
    let side = n + 1;
    let at = |i: usize| EDGE * (i as f64 / n as f64 - 0.5);
    let coordinates = (0..side.pow(3)).map(|k| [at(k % side), at(k / side % side), at(k / side / side)]).collect();
    let node = |i: usize, j: usize, k: usize| (i + side * (j + side * k)) as u32;
    let connectivity: Vec<[u32; 8]> = (0..n.pow(3))
        .map(|e| {
            let (i, j, k) = (e % n, e / n % n, e / n / n);
            [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
                .map(|(a, b, c)| node(i + a, j + b, k + c))
        })
        .collect();
    Mesh {
        node_ids: (1..=side.pow(3) as i64).collect(),
        element_ids: (1..=n.pow(3) as i64).collect(),
        blocks: vec![Block::hexahedra_of(1, connectivity)],
        coordinates,
        ..Mesh::default()
    }
}

/// Steel that flies and spins.
fn model(hourglass: Hourglass, scale: f64, velocity: [f64; 3], omega: f64) -> Model {
    Model {
        termination_time: 1.0,
        output_interval: 1.0,
        plot: PlotSchedule { interval: None, start: 0.0, stop: 1.0 },
        time_step: TimeStepControl {
            scale,
            softening: 1.0,
            growth: 1.05,
            moduli: StepModuli::Elastic,
            longest: f64::INFINITY,
        },
        bulk_viscosity: BulkViscosity { linear: 0.0, quadratic: 0.0 },
        hourglass,
        materials: vec![BlockMaterial {
            block: 1,
            density: DENSITY,
            law: Law::Elastic(Elastic { young: 200e9, poisson: 0.3 }),
        }],
        initial_velocities: vec![
            InitialVelocity::Material { block: 1, velocity },
            InitialVelocity::Angular { block: 1, omega, point: [0.0; 3], axis: [0.0, 0.0, 1.0] },
        ],
        ..Model::default()
    }
}

fn solver(mesh: &Mesh, model: &Model) -> Solver {
    let body = Body::new(mesh, model).expect("materials");
    let cut = body.cut(1);
    let contributors = body.contributors(&cut);
    let share = Decomposition::new(&contributors, mesh.coordinates.len(), 1).share(0);
    Solver::new(mesh, model, &body, &share, &mut Serial)
}

/// Linear momentum and the angular momentum Σ m x × v about the origin, with v half a step before x: both are
/// invariants of central differences.
fn momenta(solver: &Solver) -> ([f64; 3], [f64; 3]) {
    let nodes = &solver.domain.nodes;
    let (mut linear, mut angular) = ([0.0; 3], [0.0; 3]);
    for n in 0..nodes.len() as u32 {
        let (x, v, m) = (nodes.position(n), nodes.velocity(n), nodes.mass(n));
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            linear[i] += m * v[i];
            angular[i] += m * (x[j] * v[k] - x[k] * v[j]);
        }
    }
    (linear, angular)
}

/// Largest normal stress in the plane of the spin over the elements.
fn largest_stress(solver: &Solver) -> f64 {
    let groups = solver.domain.blocks.iter().flat_map(|block| block.groups());
    groups.fold(0.0, |largest: f64, group| {
        (0..group.len()).fold(largest, |m, i| m.max(group.value(i, rows::STRESS)).max(group.value(i, rows::STRESS + 1)))
    })
}

fn fly_and_spin(hourglass: Hourglass) {
    let omega = 100.0;
    let mesh = cube(4);
    let model = model(hourglass, 0.9, [50.0, 0.0, 0.0], omega);
    let mut solver = solver(&mesh, &model);
    let end = 10.0 * std::f64::consts::TAU / omega;
    let (mut begun, mut peak_first, mut peak_last) = (None, 0.0f64, 0.0f64);
    while solver.time < end {
        solver.prepare(Request::Continue, &mut Serial).expect("stable");
        begun.get_or_insert_with(|| momenta(&solver));
        if solver.time < 0.1 * end {
            peak_first = peak_first.max(largest_stress(&solver));
        } else if solver.time > 0.9 * end {
            peak_last = peak_last.max(largest_stress(&solver));
        }
        solver.advance();
    }
    solver.prepare(Request::Continue, &mut Serial).expect("stable");
    let (linear, angular) = begun.expect("at least one step");
    let (linear_now, angular_now) = momenta(&solver);
    for i in 0..3 {
        assert!((linear_now[i] - linear[i]).abs() < 1e-10 * linear[0], "linear momentum {i}");
        assert!((angular_now[i] - angular[i]).abs() < 1e-10 * angular[2], "angular momentum {i}: {angular_now:?}");
    }
    let totals = solver.totals(&mut Serial);
    let drift = totals.kinetic + totals.internal + totals.hourglass - solver.initial_energy;
    // Of the energy of the spin alone, not of that of the flight.
    let spin = 0.5 * angular[2] * omega;
    assert!(drift.abs() < 1e-4 * spin, "energy drifts by {:e} of the spin's", drift / spin);
    // Released from rest the stress swings to about twice its mean, ρω²L²/8 = 98 kPa at most, and a little beyond
    // where waves meet.
    let centrifugal = DENSITY * (omega * EDGE).powi(2) / 8.0;
    assert!((1.0..2.6).contains(&(peak_first / centrifugal)), "{peak_first:e}");
    assert!(peak_last < 1.15 * peak_first, "stress grows from {peak_first:e} to {peak_last:e}");
}

#[test]
fn spinning_block_with_assumed_strain() {
    fly_and_spin(ASSUMED);
}

#[test]
fn spinning_block_with_flanagan_belytschko() {
    fly_and_spin(FLANAGAN_BELYTSCHKO);
}

/// Extreme 21: a cube of a millimetre spins at 10⁴ rad/s for 10⁶ steps, some 140 revolutions. Momenta are kept to 10⁻⁸,
/// the frame stays of unit length to round-off, and the stretch that is integrated step by step still has the volume of the
/// nodes; 10⁻⁷ is a fortieth of the strain that the spin causes, ρω²L²/E = 4·10⁻⁶.
#[test]
fn extreme_21_a_million_steps_of_spin() {
    let omega = 1e4;
    let mut mesh = cube(1);
    mesh.coordinates.iter_mut().flatten().for_each(|x| *x *= 1e-3 / EDGE);
    let model = model(ASSUMED, 0.9, [0.0; 3], omega);
    let mut solver = solver(&mesh, &model);
    solver.prepare(Request::Continue, &mut Serial).expect("stable");
    let (_, begun) = momenta(&solver);
    for _ in 0..1_000_000 {
        solver.advance();
        solver.prepare(Request::Continue, &mut Serial).expect("stable");
    }
    let (linear, angular) = momenta(&solver);
    let mass = DENSITY * 1e-9;
    for i in 0..3 {
        assert!(linear[i].abs() < 1e-8 * mass * omega * 1e-3, "linear momentum {i}: {linear:?}");
        assert!((angular[i] - begun[i]).abs() < 1e-8 * begun[2], "angular momentum {i}: {angular:?} from {begun:?}");
    }
    let block = &solver.domain.blocks[0];
    let group = block.groups().into_iter().find(|group| group.len() == 1).expect("the element");
    let frame = group.values::<4>(0, rows::FRAME).iter().map(|c| c * c).sum::<f64>().sqrt() - 1.0;
    let [xx, yy, zz, xy, yz, zx] = group.values::<6>(0, rows::STRETCH);
    let stretch = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
    let volume = block.element.volume(group, 0, &solver.domain.nodes) / 1e-9;
    let turns = omega * solver.time / std::f64::consts::TAU;
    println!("extreme 21: {turns:.0} revolutions, frame {frame:e}, det U - V/V0 {:e}", stretch - volume);
    assert!(frame.abs() < 1e-14, "the frame has grown by {frame:e}");
    assert!((stretch - volume).abs() < 1e-7, "det U = {stretch}, volume {volume}");
    let totals = solver.totals(&mut Serial);
    let drift = (totals.kinetic + totals.internal + totals.hourglass) / solver.initial_energy - 1.0;
    assert!(drift.abs() < 1e-6, "energy drifts by {drift:e}");
}

/// Extreme 1: how a free cube that was struck fares with a step above its bound. Where it is unstable, the run must
/// end by itself, with a cause, and before a NaN is seen.
fn overdriven(scale: f64) -> Result<(), Stop> {
    let mesh = cube(1);
    let mut model = model(ASSUMED, scale, [0.0; 3], 0.0);
    model.initial_velocities = Vec::new();
    let mut solver = solver(&mesh, &model);
    for n in 0..8 {
        let x = solver.domain.nodes.position(n);
        solver.domain.nodes.rows[n as usize].0[4] = 0.1 * x[0].signum() + 0.03 * x[1].signum();
    }
    solver.initial_energy = solver.totals(&mut Serial).kinetic;
    for _ in 0..5000 {
        solver.prepare(Request::Continue, &mut Serial)?;
        let finite = (0..8).all(|n| solver.domain.nodes.position(n).iter().all(|x| x.is_finite()));
        assert!(finite, "NaN at step {}", solver.step);
        solver.advance();
    }
    Ok(())
}

#[test]
fn steps_above_the_bound_end_with_a_cause() {
    // The exact step of a cube is √(3(λ+2μ)/3K) = 1.271 times its bound for ν = 0.3. Just below it the strain energy of
    // the highest mode swings so far that it looks like running away; that is not asked for here.
    for scale in [1.0, 1.05] {
        assert!(overdriven(scale).is_ok(), "scale {scale} is still stable");
    }
    for scale in [1.4, 1.6, 1.8] {
        assert!(overdriven(scale).is_err(), "scale {scale} is not stable");
    }
}
