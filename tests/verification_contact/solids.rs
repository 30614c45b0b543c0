//! Contact of solid bodies: Hertz' balls, the patch test, an oblique impact, and what must not change results.
//!
//! `cargo test --test verification_contact solids:: -- --nocapture` prints the numbers of docs/verification.md. Tests that are
//! ignored are the same at full size: `make verify` runs them.

use crate::support::bodies::{angular_momentum, kinetic_energy, length, mean_velocity, minus, momentum, nodes_of};
use crate::support::meshes::recipe;
use crate::support::run::{Run, State, run, run_on};
use crate::support::{between, close};
use urto::mesh::Mesh;

const HERTZ: &str = include_str!("../../decks/hertz.i");
const HERTZ_MESH: &str = include_str!("../../meshes/hertz.mesh");
const PATCH: &str = include_str!("../../decks/contact_patch.i");
const PATCH_MESH: &str = include_str!("../../meshes/contact_patch.mesh");

/// Radius of the balls.
const RADIUS: f64 = 10e-3;

/// Hertz' answers for one collision.
struct Hertz {
    force: f64,
    approach: f64,
    radius: f64,
    duration: f64,
}

/// Draws the nodes of a ball towards the pole where it will be touched by a Möbius map of the ball onto itself, which
/// keeps the shape of small elements: those at the pole become `grading` times smaller.
fn draw_to_pole(mesh: &mut Mesh, block: i64, centre: f64, grading: f64) {
    let pole = -centre.signum();
    let a = -pole * (grading - 1.0) / (grading + 1.0);
    for n in nodes_of(mesh, block) {
        let x = mesh.coordinates[n];
        let (u, v, w) = (x[0] / RADIUS, x[1] / RADIUS, (x[2] - centre) / RADIUS);
        let (square, below) = (u * u + v * v + (w - a) * (w - a), 1.0 - 2.0 * a * w + a * a * (u * u + v * v + w * w));
        let along = |d: f64| (1.0 - a * a) * d / below;
        let z = (1.0 - a * a) * (w - a) / below - square * a / below;
        mesh.coordinates[n] = [RADIUS * along(u), RADIUS * along(v), centre + RADIUS * z];
    }
}

/// The deck's balls with so many elements, drawn to their poles.
fn balls(cells: [usize; 2], grading: f64) -> Mesh {
    let text = HERTZ_MESH
        .replace("SPHERE, 1, 10.E-3, 16", &format!("SPHERE, 1, 10.E-3, {}", cells[0]))
        .replace("SPHERE, 2, 10.E-3, 16", &format!("SPHERE, 2, 10.E-3, {}", cells[1]));
    let mut mesh = recipe(&text);
    draw_to_pole(&mut mesh, 1, RADIUS, grading);
    draw_to_pole(&mut mesh, 2, -RADIUS, grading);
    mesh
}

/// One ball on a rigid plane.
fn ball(cells: usize, grading: f64) -> Mesh {
    let kept: Vec<&str> =
        HERTZ_MESH.lines().filter(|line| !line.starts_with("SPHERE, 2") && !line.contains(", 2,  ")).collect();
    let text = kept
        .join("\n")
        .replace("TRANSLATE, 2, 0., 0., -10.E-3\n", "")
        .replace("10.E-3, 16", &format!("10.E-3, {cells}"));
    let mut mesh = recipe(&format!("{text}\nSIDE SET FACE, 100, 1, OUTER\n"));
    draw_to_pole(&mut mesh, 1, RADIUS, grading);
    mesh
}

/// Force on the first ball at a state: four quarters.
fn force(state: &State, first: &[usize], name: &str) -> f64 {
    4.0 * first.iter().map(|&n| state.nodal(name)[n]).sum::<f64>()
}

/// Holds a collision against Hertz' theory. `closing` is how far the centres come together for each unit that the first
/// one moves.
fn compare(case: &str, run: &Run, mesh: &Mesh, name: &str, closing: f64, expected: &Hertz) {
    let first = nodes_of(mesh, 1);
    let (mass, mut largest, mut approach, mut last) = (run.states[0].nodal("NODMASS"), 0.0f64, 0.0f64, 0.0);
    let total: f64 = first.iter().map(|&n| mass[n]).sum();
    let mut radius = 0.0f64;
    for state in &run.states {
        let push = force(state, &first, name);
        last = if push > 0.0 { state.time } else { last };
        largest = largest.max(push);
        let moved: f64 = first.iter().map(|&n| mass[n] * state.nodal("DISPLZ")[n]).sum::<f64>() / total;
        approach = approach.max(-moved * closing);
        for (n, x) in state.positions(mesh).iter().enumerate() {
            if state.nodal(name)[n] != 0.0 {
                radius = radius.max(x[0].hypot(x[1]));
            }
        }
    }
    close(case, "largest force [N]", largest, expected.force, 0.05);
    close(case, "approach [m]", approach, expected.approach, 0.05);
    close(case, "duration of contact [s]", last, expected.duration, 0.05);
    println!("{case} outermost node in contact: {radius:.3e} m, reference {:.3e} m", expected.radius);
    let out = mean_velocity(run.end(), &first)[2];
    let start = mean_velocity(&run.states[0], &first)[2];
    // Balls take some of the energy along as vibrations; nodes that meet lose some.
    between(case, "restitution", -out / start, 0.97, 1.0);
    println!("{case} contact loss {:.2e} of the energy", -run.last().totals.contact / run.initial_energy);
    between(case, "worst energy balance", run.worst_balance(), 0.0, 1e-3);
}

/// The deck with what the comparison needs, and with other states.
fn hertz_deck(interval: &str, end: &str) -> String {
    HERTZ
        .replace("PLOT TIME, 5.E-6", &format!("PLOT TIME, {interval}"))
        .replace("250.E-6", end)
        .replace("VELOCITY, CONTACT", "VELOCITY, CONTACT, MASS, REACTION")
}

fn on_plane(deck: &str) -> String {
    let (before, after) = deck.split_at(deck.find("MATERIAL, 2, ELASTIC").expect("a second material"));
    let rest = &after[after.find("EXIT").expect("an end")..];
    format!("{before}{rest}")
        .replace("CONTACT MATERIAL, 1, 2", "RIGID SURFACE, 100, 0., 0., 0., 0., 0., 1.")
        .replace("INITIAL VELOCITY MATERIAL, 2, 0., 0., 1.\n", "")
}

const SOFT: Hertz = Hertz { force: 88.16, approach: 71.3e-6, radius: 0.844e-3, duration: 209.8e-6 };

/// An elastic ball on a rigid plane, and two such balls, which by symmetry is the same. Their meshes differ, so nodes meet
/// faces anywhere.
#[test]
fn v24_hertz() {
    let mesh = ball(8, 5.0);
    let deck = hertz_deck("1.E-6", "250.E-6");
    let on_plane = run_on(2, &on_plane(&deck), &mesh).whole();
    compare("V-24 on a plane, 8 cells", &on_plane, &mesh, "RZ", 1.0, &SOFT);
    let mesh = balls([8, 7], 5.0);
    let both = run_on(2, &deck, &mesh).whole();
    compare("V-24 two balls, 8 and 7 cells", &both, &mesh, "CONTZ", 1.0, &SOFT);
}

/// The same on fine meshes, and balls of steel.
#[test]
#[ignore = "half a minute of two cores in the release build: make verify"]
fn v24_hertz_full_size() {
    let deck = hertz_deck("1.E-6", "250.E-6");
    let mesh = ball(16, 6.0);
    let one = run_on(2, &on_plane(&deck), &mesh).whole();
    compare("V-24 on a plane, 16 cells", &one, &mesh, "RZ", 1.0, &SOFT);
    let mesh = balls([16, 14], 6.0);
    let both = run_on(2, &deck, &mesh).whole();
    compare("V-24 two balls, 16 and 14 cells", &both, &mesh, "CONTZ", 1.0, &SOFT);
}

#[test]
#[ignore = "a minute of two cores in the release build: make verify"]
fn v24_hertz_of_steel() {
    let steel = |deck: &str| deck.replace("1.E9", "200.E9").replace("1200.", "7850.");
    let deck = steel(&hertz_deck("0.25E-6", "65.E-6"));
    let mesh = ball(12, 6.0);
    let one = run_on(2, &on_plane(&deck), &mesh).whole();
    let expected = Hertz { force: 2265.0, approach: 18.15e-6, radius: 0.4260e-3, duration: 53.41e-6 };
    compare("V-24 steel on a plane", &one, &mesh, "RZ", 1.0, &expected);
    let deck = steel(&hertz_deck("0.25E-6", "75.E-6"))
        .replace("0., 0., -1.", "0., 0., -0.5")
        .replace("0., 0., 1.\n", "0., 0., 0.5\n");
    let mesh = balls([12, 11], 6.0);
    let both = run_on(2, &deck, &mesh).whole();
    // Each ball's centre moves half of the approach of both.
    let expected = Hertz { force: 986.0, approach: 20.84e-6, radius: 0.3228e-3, duration: 61.35e-6 };
    compare("V-24 two balls of steel", &both, &mesh, "CONTZ", 2.0, &expected);
}

/// The deck's cubes with so many elements along an edge, the lower and the upper.
fn patch_mesh(below: usize, above: usize, more: &str) -> Mesh {
    let text = PATCH_MESH
        .replace(
            "BOX, 1,  0., 0., 0.,   0.1, 0.1, 0.1,  3, 3, 3\n",
            &format!("BOX, 1,  0., 0., 0.,   0.1, 0.1, 0.1,  {below}, {below}, {below}\n"),
        )
        .replace(
            "BOX, 2,  0., 0., 0.1,  0.1, 0.1, 0.1,  4, 4, 4\n",
            &format!("BOX, 2,  0., 0., 0.1,  0.1, 0.1, 0.1,  {above}, {above}, {above}\n{more}\n"),
        );
    recipe(&text)
}

const STRESSES: [(&str, f64); 6] =
    [("SIGXX", 0.0), ("SIGYY", 0.0), ("SIGZZ", -100e6), ("TAUXY", 0.0), ("TAUYZ", 0.0), ("TAUZX", 0.0)];

/// Largest error of a stress component beside the contact and away from it, over the pressure. The mean of the last
/// millisecond, six periods of the blocks, stands for the static stress.
fn patch_error(run: &Run, mesh: &Mesh) -> [f64; 2] {
    let states: Vec<&State> = run.states.iter().filter(|state| state.time > 3e-3).collect();
    let mut worst = [0.0f64; 2];
    for (name, expected) in STRESSES {
        for (e, nodes) in mesh.hexahedra().enumerate() {
            let mean = states.iter().map(|state| state.element(name)[e]).sum::<f64>() / states.len() as f64;
            let error = (mean - expected).abs() / 100e6;
            let beside = nodes.iter().any(|&n| (mesh.coordinates[n as usize][2] - 0.1).abs() < 1e-9);
            worst[usize::from(!beside)] = worst[usize::from(!beside)].max(error);
        }
    }
    worst
}

/// The deck with other passes and partition.
fn patch(mesh: &Mesh, lines: &str) -> Run {
    run(&PATCH.replacen("TITLE", &format!("{lines}\nTITLE"), 1), mesh)
}

/// Nodes of one side alone on the faces of the other cannot pass; both ways with converged passes do. What is left then,
/// 10⁻⁴, are the vibrations of the blocks, which matching meshes have as well.
#[test]
fn v27_patch_test() {
    let both_ways = [
        ("CONTACT PASSES, 1", 0.15),
        ("CONTACT PASSES, 3", 0.15),
        ("CONTACT PASSES, 20", 0.15),
        ("CONTACT PASSES, 20, 1.E-6", 0.15),
        ("CONTACT PASSES, 100, 1.E-6", 0.02),
        ("CONTACT PASSES, 1000, 1.E-12", 2e-4),
    ];
    let mesh = patch_mesh(3, 4, "");
    for (lines, most) in both_ways {
        let run = patch(&mesh, lines);
        let [beside, away] = patch_error(&run, &mesh);
        between("V-27", &format!("4 x 4 on 3 x 3, {lines}: stress error beside the contact"), beside, 0.0, most);
        between("V-27", &format!("4 x 4 on 3 x 3, {lines}: elsewhere"), away, 0.0, most);
        between("V-27", "worst energy balance", run.worst_balance(), 0.0, 5e-3);
    }
    for partition in ["0.", "1."] {
        let run = patch(&mesh, &format!("CONTACT DATA, 1, 2, 0., {partition}"));
        let [beside, away] = patch_error(&run, &mesh);
        println!(
            "V-27 one way, partition {partition}: stress error {beside:.3} beside the contact, {away:.3} elsewhere"
        );
        assert!(beside < 0.3 && beside > 0.1, "one-way contact does not pass: {beside}");
    }
}

/// Blocks with matching faces against one block, struck at once by the full pressure. All nodes are held sideways: nothing
/// slides then, and every bit of difference is contact's.
#[test]
fn v27_matching_meshes() {
    let deck = PATCH
        .replace("TERMINATION TIME, 4.E-3", "TERMINATION TIME, 60.E-6")
        .replace("0.,       0.\n0.2E-3,   0.02447", "0.,       1.\n0.2E-3,   1.")
        .replace("DISPLACEMENT, X, 1", "DISPLACEMENT, X, 4")
        .replace("DISPLACEMENT, Y, 2", "DISPLACEMENT, Y, 4");
    let mesh = |more: &str| patch_mesh(4, 4, &format!("NODE SET BLOCK, 4, 1\nNODE SET BLOCK, 4, 2\n{more}"));
    let whole = run(&deck, &mesh("MERGE, 1, 2"));
    for lines in ["CONTACT PASSES, 1", "CONTACT PASSES, 20", "CONTACT DATA, 1, 2, 0., 1."] {
        let two = run(&deck.replacen("TITLE", &format!("{lines}\nTITLE"), 1), &mesh(""));
        assert_eq!(two.states.len(), whole.states.len());
        let mut worst = 0.0f64;
        for (a, b) in two.states.iter().zip(&whole.states) {
            for (name, _) in STRESSES {
                for (x, y) in a.element(name).iter().zip(b.element(name)) {
                    worst = worst.max((x - y).abs() / 100e6);
                }
            }
        }
        between(
            "V-27",
            &format!("matching meshes, {lines}: stress off that of one block, over the pressure"),
            worst,
            0.0,
            1e-8,
        );
    }
}

/// Two blocks of different meshes that fly at each other obliquely and off centre, with friction.
const OBLIQUE: &str = "\
TERMINATION TIME, 1.E-3
OUTPUT TIME, 1.E-6
PLOT TIME, 2.E-5
PLOT NODAL, DISPLACEMENT, VELOCITY, MASS, CONTACT
CONTACT MATERIAL
CONTACT DATA, 1, 2, 0.2
INITIAL VELOCITY MATERIAL, 1, 40., 12., -5.
INITIAL VELOCITY MATERIAL, 2, -25., 0., 8.
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
END
MATERIAL, 2, ELASTIC, 2700.
YOUNGS MODULUS = 70.E9
POISSONS RATIO = 0.33
END
";

fn oblique_mesh() -> Mesh {
    recipe(
        "BOX, 1, 0., 0., 0., 0.05, 0.04, 0.06, 4, 3, 5\nBOX, 2, 0.052, 0.013, -0.011, 0.06, 0.05, 0.04, 5, 4, 3\n\
         ROTATE, 2, Z, 7., 0.052, 0.013\n",
    )
}

/// Relative drift of linear and angular momentum, and what the collision was like.
fn drift(case: &str, run: &Run, mesh: &Mesh) -> [f64; 2] {
    let (first, last) = (&run.states[0], run.end());
    let all: Vec<usize> = (0..mesh.coordinates.len()).collect();
    let linear = length(minus(momentum(last), momentum(first))) / length(momentum(first));
    let turning = length(minus(angular_momentum(last, mesh), angular_momentum(first, mesh)))
        / length(angular_momentum(first, mesh));
    println!(
        "{case}: drift of momentum {linear:.1e}, of angular momentum {turning:.1e}; friction {:.2e}, contact loss {:.2e}, kinetic {:.3} of the energy, balance {:.1e}",
        run.last().totals.friction / run.initial_energy,
        -run.last().totals.contact / run.initial_energy,
        kinetic_energy(last, &all) / kinetic_energy(first, &all),
        run.worst_balance()
    );
    [linear, turning]
}

/// Linear momentum is kept to round-off. Angular momentum is kept where a point and its foot lie along the force: the
/// foot is that of the end of the step, the force acts at its beginning, and what a point slides in between is the arm.
#[test]
fn momentum_of_an_oblique_impact() {
    let mesh = oblique_mesh();
    let smooth = OBLIQUE.replace("CONTACT DATA, 1, 2, 0.2\n", "");
    for (case, deck, most) in [("with friction", OBLIQUE, 1e-5), ("without", &smooth, 1e-12)] {
        for scale in ["1.", "0.5", "0.25"] {
            let run = run(&format!("TIME STEP SCALE, {scale}\n{deck}"), &mesh);
            let [linear, turning] = drift(&format!("oblique impact {case}, step scale {scale}"), &run, &mesh);
            assert!(linear < 1e-12 && turning < most, "{linear} {turning}");
        }
    }
}

/// Two touching blocks of different meshes fly together: nothing pushes.
#[test]
fn touching_bodies_that_fly_together_feel_nothing() {
    let mesh = recipe("BOX, 1, 0., 0., 0., 0.1, 0.1, 0.1, 3, 3, 3\nBOX, 2, 0., 0., 0.1, 0.1, 0.1, 0.1, 4, 4, 4\n");
    let deck = OBLIQUE.replace("40., 12., -5.", "40., 12., -50.").replace("-25., 0., 8.", "40., 12., -50.");
    let run = run(&deck, &mesh);
    let velocity = [40.0, 12.0, -50.0];
    let mut worst = 0.0f64;
    for state in &run.states {
        for (n, x) in state.positions(&mesh).iter().enumerate() {
            for i in 0..3 {
                worst = worst.max((x[i] - mesh.coordinates[n][i] - velocity[i] * state.time).abs());
            }
        }
    }
    between("rigid translation", "departure from x + v t [m]", worst, 0.0, 1e-13);
    println!("rigid translation: contact work {:e} of {:e} J", run.last().totals.contact, run.initial_energy);
    assert!(run.last().totals.contact.abs() < 1e-12 * run.initial_energy);
}

/// Every bit of the last state.
fn bits(run: &Run) -> Vec<u64> {
    let names = ["DISPLX", "DISPLY", "DISPLZ", "VELX", "VELY", "VELZ", "CONTX", "CONTY", "CONTZ"];
    names.iter().flat_map(|name| run.end().nodal(name).iter().map(|x| x.to_bits())).collect()
}

/// How the search is made and how long it lasts changes no bit, nor does the number of ranks, many more than bodies.
#[test]
fn extreme_18_search_and_ranks_do_not_change_a_bit() {
    let mesh = oblique_mesh();
    let deck = OBLIQUE.replace("TERMINATION TIME, 1.E-3", "TERMINATION TIME, 3.E-4");
    let expected = bits(&run(&deck, &mesh));
    assert!(run(&deck, &mesh).last().totals.friction > 0.0, "they touch");
    for method in ["GRID", "TREE", "POINT IN BOX"] {
        for reach in ["0., 0.", "1., 0.", "10., 0.05", "100., 0.5"] {
            let run = run(&format!("CONTACT SEARCH, {method}, {reach}\n{deck}"), &mesh);
            assert!(bits(&run) == expected, "{method}, {reach}");
        }
    }
    for ranks in [2, 3, 7, 13, 61] {
        assert!(bits(&run_on(ranks, &deck, &mesh).whole()) == expected, "{ranks} ranks");
    }
}

/// Ranks that hold no contact entity at all: 20 of 24 elements have no face that takes part.
#[test]
fn extreme_18_more_ranks_than_contact_entities() {
    let mesh = recipe(
        "BOX, 1, 0., 0., 0., 0.12, 0.01, 0.01, 12, 1, 1\nBOX, 2, 0.12, 0., 0., 0.12, 0.01, 0.01, 12, 1, 1\n\
         SIDE SET FACE, 100, 1, RIGHT\nSIDE SET FACE, 200, 2, LEFT\n",
    );
    let deck = OBLIQUE
        .replace("CONTACT MATERIAL\nCONTACT DATA, 1, 2, 0.2\n", "CONTACT SURFACE, 100, 200, 0.2\n")
        .replace("12., -5.", "0., 0.")
        .replace("-25., 0., 8.", "0., 0., 0.")
        .replace("1.E-3", "1.E-4");
    let expected = bits(&run(&deck, &mesh));
    for ranks in [7, 13, 24, 31] {
        assert!(bits(&run_on(ranks, &deck, &mesh).whole()) == expected, "{ranks} ranks");
    }
}
