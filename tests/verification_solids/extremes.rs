//! Numerical extremes: steps beyond the stable one, incompressibility, the ends of a run, symmetry on any partition.
//!
//! `cargo test --test verification_solids extremes:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::support::flow::alone;
use crate::support::meshes::{add_node_set, brick};
use crate::support::run::{Run, model, run, run_on};
use crate::support::{between, close, steel};
use urto::comm::Serial;
use urto::mesh::Mesh;
use urto::solver::{Request, Stop};

const COLUMN: &str = include_str!("../../decks/uniaxial_wave.i");
const TWO_WAVES: &str = include_str!("../../decks/two_waves.i");

const STEEL: &str = "MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";

/// The column of cubes of V-02, at so many stable steps per step, without viscosity. It has 100 cubes here.
fn column(scale: f64) -> Run {
    let mesh = brick([100, 1, 1], [0.025, 0.25e-3, 0.25e-3]);
    let extra = format!("BULK VISCOSITY, 0., 0.\nTIME STEP SCALE, {scale}\nTITLE");
    run_on(1, &COLUMN.replace("TITLE", &extra).replace("12.E-6", "60.E-6"), &mesh)
}

/// A free cube of 1 element, set into motion by a single corner.
fn free_cube(scale: f64) -> Run {
    let mut mesh = brick([1, 1, 1], [0.01, 0.01, 0.01]);
    mesh.node_sets[0].nodes.truncate(1);
    let deck = format!(
        "TERMINATION TIME, 2.E-3\nTIME STEP SCALE, {scale}\nBULK VISCOSITY, 0., 0.\nPLOT NODAL, VELOCITY\n\
         INITIAL VELOCITY NODESET, 1, 1., 0.5, 0.3\n{STEEL}"
    );
    run_on(1, &deck, &mesh)
}

/// Everything that would be written is a number.
fn assert_finite(run: &Run, names: &[&str]) {
    for name in names {
        assert!(run.end().nodal(name).iter().all(|v| v.is_finite()), "{name} is not finite");
    }
    assert!(run.lines.iter().all(|l| l.totals.kinetic.is_finite() && l.totals.internal.is_finite()));
}

fn blown_up(run: &Run) -> bool {
    let event = run.stop.as_ref().map(Stop::event);
    matches!(
        event,
        Some(
            Stop::Energy { .. } | Stop::Balance { .. } | Stop::Inverted(_) | Stop::NotFinite(_) | Stop::MotionNotFinite
        )
    )
}

/// The element bound is conservative by √3 for a laterally fixed column of cubes, where waves have one dimension:
/// Δt = h/c_L there against h/(√3 c_L).
#[test]
fn extreme_1_steps_beyond_the_bound_on_a_column() {
    for scale in [1.05, 1.2, 1.6, 1.72] {
        let run = column(scale).whole();
        between("extreme 1", &format!("column, worst energy balance at scale {scale}"), run.worst_balance(), 0.0, 1e-3);
    }
    for scale in [1.75, 1.8] {
        let run = column(scale);
        println!("extreme 1 column at scale {scale}: {:?}", run.stop);
        assert!(blown_up(&run), "scale {scale} runs on");
        assert_finite(&run, &["DISPLX"]);
    }
}

/// A free cube's highest mode is volumetric: it is stable below h √(ρ/3K), for ν = 0.3 at c_L √(ρ/K) = 1.271 times the
/// bound. (Just below, energy goes to and fro by 1/(1 - (Δt/Δt_crit)²), which looks like running away.)
#[test]
fn extreme_1_steps_beyond_the_bound_on_a_free_cube() {
    for scale in [1.05, 1.2] {
        let run = free_cube(scale).whole();
        between(
            "extreme 1",
            &format!("free cube, worst energy balance at scale {scale}"),
            run.worst_balance(),
            0.0,
            1e-3,
        );
    }
    for scale in [1.28, 1.6, 1.8] {
        let run = free_cube(scale);
        println!("extreme 1 free cube at scale {scale}: {:?}", run.stop);
        assert!(blown_up(&run), "scale {scale} runs on");
        assert_finite(&run, &["VELX"]);
    }
}

/// Δt = h/(√3 c_L) with c_L² ∝ (1 - ν)/(1 - 2ν): small but finite as ν goes to one half, and the run is sound.
#[test]
fn extreme_4_almost_incompressible() {
    for nu in [0.499, 0.4999] {
        let material = STEEL.replace("0.3", &nu.to_string());
        let deck = format!(
            "TERMINATION TIME, 200.E-6\nOUTPUT TIME, 1.E-6\nBULK VISCOSITY, 0., 0.\nINITIAL VELOCITY NODESET, 2, 10., 0., 0.\n{material}"
        );
        let run = run(&deck, &brick([4, 4, 4], [0.1, 0.1, 0.1]));
        let modulus = steel::E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
        let step = 0.025 / (3.0 * modulus / steel::RHO).sqrt();
        close("extreme 4", &format!("first time step, nu={nu} [s]"), run.lines[0].time_step, step, 1e-12);
        between("extreme 4", &format!("worst energy balance, nu={nu}"), run.worst_balance(), 0.0, 1e-3);
    }
}

/// A block in free flight: nothing but steps.
fn flight(termination: f64) -> Run {
    let deck = format!(
        "TERMINATION TIME, {termination:e}\nBULK VISCOSITY, 0., 0.\nOUTPUT TIME, 1.E-12\nINITIAL VELOCITY MATERIAL, 1, 1., 0., 0.\n{STEEL}"
    );
    run(&deck, &brick([1, 1, 1], [0.01, 0.01, 0.01]))
}

/// The last state is at the termination time, after as many steps as are needed to get there, which are alike.
#[test]
fn extreme_27_runs_end_at_their_time() {
    let mesh = brick([1, 1, 1], [0.01, 0.01, 0.01]);
    let step = flight(1e-5).lines[0].time_step;
    for (termination, steps) in
        [(10.0, 10), (10.4, 11), (10.6, 11), (1.0, 1), (0.4, 1), (1e-3, 1), (1e-9, 0), (33.3, 34)]
    {
        let deck =
            format!("TERMINATION TIME, 1.\nINITIAL VELOCITY MATERIAL, 1, 1., 0., 0.\nBULK VISCOSITY, 0., 0.\n{STEEL}");
        let model = model(&deck, &mesh);
        let mut solver = alone(&mesh, &model);
        let end = termination * step;
        solver.end_at(end);
        let mut shortest = f64::INFINITY;
        loop {
            solver.prepare(Request::Continue, &mut Serial).expect("a state that makes sense");
            if solver.is_at_end() {
                break;
            }
            shortest = shortest.min(solver.time_step);
            solver.advance();
        }
        assert_eq!(solver.step, steps, "{termination} steps asked");
        assert!((solver.time - end).abs() <= 1e-6 * step);
        // The last twenty share what is left.
        let twentieth = 1.0 - 1.0 / 20.0;
        assert!(
            shortest
                >= step
                    * (1.0 - 1e-9)
                    * if termination > 20.0 { twentieth } else { termination / f64::from(steps as u32) }
        );
    }
}

/// Steps grow by no more than TIME STEP GROWTH, even when a shock has made them small and has passed.
#[test]
fn extreme_27_steps_grow_no_faster_than_asked() {
    let mesh = brick([100, 1, 1], [0.025, 0.25e-3, 0.25e-3]);
    // A piston that starts at a third of the wave speed and stops: quadratic viscosity cuts the step, then lets go.
    let deck =
        TWO_WAVES.replace("12.E-6", "5.E-6").replace("0.1E-6", "1.E-12").replace("X, 1, 1, 100.", "X, 1, 1, 1500.");
    let deck = deck
        .replace("0.,      1.\n", "0., 1.\n0.2E-6, 1.\n0.3E-6, 0.\n")
        .replace("TITLE", "TIME STEP GROWTH, 1.02\nTITLE");
    let run = run(&deck, &mesh);
    let ratios: Vec<f64> = run.lines.windows(2).map(|w| w[1].time_step / w[0].time_step).collect();
    let fastest = ratios.iter().fold(0.0f64, |m, r| m.max(*r));
    close("extreme 27", "fastest growth of the step", fastest, 1.02, 1e-12);
    assert!(run.lines.iter().all(|l| l.time_step > 0.0 && l.time_step <= l.stable_step));
    // The step is cut by a fifth, so that there is something to grow from.
    let smallest = run.lines.iter().map(|l| l.time_step).fold(f64::INFINITY, f64::min);
    between("extreme 27", "smallest step over the last", smallest / run.last().time_step, 0.0, 0.9);
    // The first step is a blow, and its balance some per cent off; what follows closes.
    between("extreme 27", "energy balance at the end", run.last().balance.abs(), 0.0, 1e-3);
}

/// A block that strikes a wall and flows plastically, symmetric in x and y, cut by ranks that are not.
fn block_on_wall() -> (Mesh, String) {
    let mut mesh = brick([6, 6, 9], [0.012, 0.012, 0.018]);
    mesh.coordinates.iter_mut().for_each(|p| (p[0], p[1]) = (p[0] - 0.006, p[1] - 0.006));
    let deck = "TERMINATION TIME, 30.E-6\nPLOT ELEMENT, STRESS\nPLOT STATE, EQPS\nRIGID SURFACE, 500, 0., 0., 0., 0., 0., 1., 0.1\n\
                INITIAL VELOCITY MATERIAL, 1, 0., 0., -200.\n\
                MATERIAL, 1, ELASTIC PLASTIC, 8930.\nYOUNGS MODULUS = 117.E9\nPOISSONS RATIO = 0.35\n\
                YIELD STRESS = 400.E6\nHARDENING MODULUS = 100.E6\nEND\n";
    (mesh, deck.into())
}

/// Largest difference between a displacement and its mirror image at x = 0 and y = 0, over the largest displacement.
fn asymmetry(mesh: &Mesh, run: &Run) -> f64 {
    let u = ["DISPLX", "DISPLY", "DISPLZ"].map(|name| run.end().nodal(name));
    let largest = u.iter().flat_map(|v| v.iter()).fold(0.0f64, |m, v| m.max(v.abs()));
    let mut worst = 0.0f64;
    for axis in 0..2 {
        for (n, x) in mesh.coordinates.iter().enumerate() {
            let mut image = *x;
            image[axis] = -image[axis];
            let same = |p: &[f64; 3]| (0..3).all(|i| (p[i] - image[i]).abs() < 1e-9);
            let m = mesh.coordinates.iter().position(same).expect("a mirrored node");
            for (i, u) in u.iter().enumerate() {
                let sign = if i == axis { -1.0 } else { 1.0 };
                worst = worst.max((u[n] - sign * u[m]).abs());
            }
        }
    }
    worst / largest
}

/// Mirror symmetry is kept to 1e-9: round-off of sums in one order, multiplied over some hundred steps of plastic flow.
#[test]
fn extreme_28_symmetry_on_any_partition() {
    let (mesh, deck) = block_on_wall();
    let whole = run(&deck, &mesh);
    assert!(whole.end().element("EQPS").iter().any(|e| *e > 0.1), "the block flows");
    for ranks in [1, 3, 5] {
        let run = run_on(ranks, &deck, &mesh).whole();
        between("extreme 28", &format!("asymmetry on {ranks} ranks"), asymmetry(&mesh, &run), 0.0, 1e-9);
        assert_eq!(run.end().nodal("DISPLX"), whole.end().nodal("DISPLX"), "the same bits on {ranks} ranks");
    }
}

/// Extreme 23: copper strikes copper at 200 m/s, the waves from the free faces meet as far from the back as the striking
/// part is thick, and the material spalls there at its pressure cutoff of −1 GPa. By the acoustic estimate the back runs at
/// 200 m/s from 2.5 to 5.1 microseconds, and is then pulled back by 2σ/(ρc) = 56.8 m/s; waves run at c + s u, 3.8 % faster
/// than c at most. What has opened does not close again and again: the gap grows from state to state, the tension is
/// never beyond the cutoff, and dissipated energy is not won back.
#[test]
fn extreme_23_spall() {
    let (cells, edge) = (300, 50e-6);
    let mut mesh = brick([cells, 1, 1], [cells as f64 * edge, edge, edge]);
    let length = |n: usize| n as f64 * edge;
    crate::support::meshes::add_node_set(&mut mesh, 21, |x| x[0] < length(100) - 0.5 * edge);
    crate::support::meshes::add_node_set(&mut mesh, 22, |x| (x[0] - length(100)).abs() < 0.5 * edge);
    crate::support::meshes::add_node_set(&mut mesh, 23, |_| true);
    let deck = "TERMINATION TIME, 7.E-6\nOUTPUT TIME, 0.05E-6\nPLOT TIME, 0.05E-6\nPLOT NODAL, VELOCITY\n\
                PLOT ELEMENT, PRESSURE, DENSITY\n\
                NO DISPLACEMENT, Y, 23\nNO DISPLACEMENT, Z, 23\n\
                INITIAL VELOCITY NODESET, 21, 200., 0., 0.\nINITIAL VELOCITY NODESET, 22, 100., 0., 0.\n\
                MATERIAL, 1, HYDRODYNAMIC, 8930.\nPRESSURE CUTOFF = -1.E9\nEND\n\
                EQUATION OF STATE, 1, MG US-UP\nC0 = 3940.\nS = 1.489\nGAMMA = 2.02\nEND\n";
    let run = run_on(1, deck, &mesh).whole();
    between("extreme 23", "worst energy balance", run.worst_balance(), 0.0, 1e-3);
    let back = |from: f64, to: f64| {
        let states = run.states.iter().filter(move |state| (from..to).contains(&state.time));
        states.map(|state| state.nodal("VELX")[cells]).collect::<Vec<f64>>()
    };
    let plateau = back(3.2e-6, 4.6e-6);
    let plateau = plateau.iter().sum::<f64>() / plateau.len() as f64;
    close("extreme 23", "velocity of the back", plateau, 200.0, 0.01);
    let low = back(5.0e-6, 6.2e-6).into_iter().fold(f64::INFINITY, f64::min);
    close("extreme 23", "pullback", plateau - low, 2.0 * 1e9 / (8930.0 * 3940.0), 0.04);
    let lowest = run.states.iter().flat_map(|state| state.element("PRESSURE")).copied().fold(0.0, f64::min);
    close("extreme 23", "largest tension", -lowest, 1e9, 1e-6);
    // The element that opened most, from the state in which its density is a tenth down.
    let end = run.end().element("DENSITY");
    let open = (0..cells).min_by(|a, b| end[*a].total_cmp(&end[*b])).unwrap_or(0);
    between("extreme 23", "spall plane, elements from the back", (cells - open) as f64, 90.0, 110.0);
    let gap: Vec<f64> = run.states.iter().map(|state| state.element("DENSITY")[open]).collect();
    let begin = gap.iter().position(|density| *density < 0.9 * 8930.0).expect("it opens");
    assert!(gap[begin..].windows(2).all(|pair| pair[1] < pair[0]), "the gap closes: {:?}", &gap[begin..]);
    let lost: Vec<f64> = run.lines.iter().map(|line| line.totals.bulk_viscosity).collect();
    assert!(lost.windows(2).all(|pair| pair[1] >= pair[0]), "viscosity gives energy back");
}

/// Hourglass modes of a spinning body keep their energy. With rates turned by the frame at the end of a step instead
/// of its middle they grew e-fold within a few revolutions, unseen by the momenta.
#[test]
fn hourglass_modes_of_a_spinning_body_do_not_grow() {
    for control in ["ASSUMED STRAIN", "FLANAGAN BELYTSCHKO"] {
        let mut mesh = brick([2, 2, 4], [0.01, 0.01, 0.02]);
        mesh.node_sets[0].nodes.truncate(1);
        // One corner gets a kick beside the spin; without viscosity nothing takes the vibration away.
        let deck = format!(
            "TERMINATION TIME, 0.06\nBULK VISCOSITY, 0., 0.\nHOURGLASS CONTROL, {control}\nTIME STEP SCALE, 0.9\n\
             INITIAL VELOCITY ANGULAR, 1, 3000., 0.005, 0.005, 0., 0., 0., 1.\n\
             INITIAL VELOCITY NODESET, 1, 2., 1., 3.\n{STEEL}"
        );
        let run = run_on(1, &deck, &mesh).whole();
        let hourglass: Vec<f64> = run.lines.iter().map(|line| line.totals.hourglass.abs()).collect();
        let (early, late) = hourglass.split_at(hourglass.len() / 2);
        let most = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
        // Energy wanders between modes; a factor of two is far below the growth it had.
        between("spin", &format!("{control}, hourglass energy late over early"), most(late) / most(early), 0.0, 2.0);
        between("spin", &format!("{control}, worst energy balance"), run.worst_balance(), 0.0, 1e-3);
    }
}

/// Single elements whose corners fly off at random, until all their lengths along the frame are negative: these are kept positive, by the largest of their sizes. With eight points the
/// energy grew to 10²² of itself, and in single precision 7 of 60 such elements became no number.
#[test]
fn elements_that_are_thrown_inside_out_stay_finite() {
    let mut worst: f64 = 0.0;
    for seed in 0..24u64 {
        // A linear congruence (Knuth), for velocities of up to 900 m/s in steps of 100.
        let mut state = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mut speed = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) % 19) as f64 * 100.0 - 900.0
        };
        let mut mesh = brick([1, 1, 1], [1.0, 1.0, 1.0]);
        let corners: Vec<[f64; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
        let thrown: String = (10..)
            .zip(corners)
            .map(|(set, corner)| {
                add_node_set(&mut mesh, set, |at| at == corner);
                format!("INITIAL VELOCITY NODESET, {set}, {:?}, {:?}, {:?}\n", speed(), speed(), speed())
            })
            .collect();
        for kind in ["", "PRECISION, SINGLE\n", "ELEMENT, 1, EIGHT POINTS\n"] {
            let deck = format!(
                "TERMINATION TIME, 1.E-2\nTIME STEP SCALE, 0.3\nPLOT NODAL, DISPLACEMENT, VELOCITY\n{kind}{thrown}\
                 MATERIAL, 1, ELASTIC PLASTIC, 7800.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 1.E6\nEND\n"
            );
            let run = run_on(1, &deck, &mesh).whole();
            assert_finite(&run, &["VELX", "VELY", "VELZ"]);
            worst = worst.max(run.worst_balance());
        }
    }
    // Steps of a corner that goes through the element in ten of them are no more accurate.
    between("thrown", "worst energy balance of 72 thrown elements", worst, 0.0, 0.01);
}
