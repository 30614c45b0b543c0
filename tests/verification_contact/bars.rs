//! Contact of bars: collisions with answers from one-dimensional waves.
//!
//! `cargo test --test verification_contact bars:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::support::bodies::{mean_velocity, nodes_of};
use crate::support::meshes::recipe;
use crate::support::run::{Run, run};
use crate::support::{between, close, steel};
use urto::mesh::Mesh;

const TWO_BARS: &str = include_str!("../../decks/two_bars.i");
const TWO_BARS_MESH: &str = include_str!("../../meshes/two_bars.mesh");
const CRADLE: &str = include_str!("../../decks/newtons_cradle.i");
const CRADLE_MESH: &str = include_str!("../../meshes/newtons_cradle.mesh");

/// Two bars end to end, of so many elements and so long.
fn bars(cells: [usize; 2], lengths: [f64; 2]) -> Mesh {
    let bar = |x: f64, length: f64, cells: usize| format!("{x:?}, 0., 0.,  {length:?}, 0.01, 0.01,  {cells}, 1, 1");
    let text = TWO_BARS_MESH
        .replace("0., 0., 0.,  1., 0.01, 0.01,  50, 1, 1", &bar(0.0, lengths[0], cells[0]))
        .replace("1., 0., 0.,  1., 0.01, 0.01,  50, 1, 1", &bar(lengths[0], lengths[1], cells[1]));
    recipe(&text)
}

/// The deck with these lines before its title.
fn with(deck: &str, lines: &str) -> String {
    deck.replacen("TITLE", &format!("{lines}\nTITLE"), 1)
}

/// Mean velocities of the blocks at the end, over that of the first at the start.
fn velocities(mesh: &Mesh, run: &Run) -> Vec<f64> {
    let start = mean_velocity(&run.states[0], &nodes_of(mesh, 1))[0];
    mesh.blocks.iter().map(|block| mean_velocity(run.end(), &nodes_of(mesh, block.id))[0] / start).collect()
}

/// Largest change of linear momentum over its size at the start.
fn momentum_error(run: &Run) -> f64 {
    let start = run.lines[0].totals.momentum;
    let size = start.iter().fold(0.0f64, |m, p| m.max(p.abs()));
    let off = |line: &crate::support::run::Line| {
        (0..3).fold(0.0f64, |m, i| m.max((line.totals.momentum[i] - start[i]).abs()))
    };
    run.lines.iter().fold(0.0f64, |m, line| m.max(off(line))) / size
}

/// The deck's bars on another mesh, with these lines added.
fn collide(mesh: &Mesh, lines: &str, end: &str) -> Run {
    run(&with(TWO_BARS, lines).replace("TERMINATION TIME, 600.E-6", &format!("TERMINATION TIME, {end}")), mesh)
}

/// Energy that contact took, over the initial energy.
fn loss(run: &Run) -> f64 {
    -run.last().totals.contact / run.initial_energy
}

/// The bars change velocities; when they meet, the nodal masses of both ends stick together as in a plastic impact, which
/// takes 1/(4N) of the energy where both ends are equal: ½ m₁m₂/(m₁ + m₂) v².
#[test]
fn v21_equal_bars() {
    for n in [10, 50, 200] {
        let run = collide(&bars([n, n], [1.0, 1.0]), "", "600.E-6");
        close("V-21", &format!("N = {n}, contact loss of the initial energy"), loss(&run), 0.25 / n as f64, 1e-6);
        between("V-21", &format!("N = {n}, momentum error"), momentum_error(&run), 0.0, 1e-12);
        between("V-21", &format!("N = {n}, worst energy balance"), run.worst_balance(), 0.0, 1e-5);
    }
    let mesh = bars([50, 20], [1.0, 1.0]);
    for (first, second) in [(50, 20), (20, 50)] {
        let mesh = if first == 50 { mesh.clone() } else { bars([20, 50], [1.0, 1.0]) };
        let run = collide(&mesh, "", "600.E-6");
        close("V-21", &format!("N = {first}/{second}, contact loss"), loss(&run), 1.0 / 140.0, 1e-6);
        between("V-21", &format!("N = {first}/{second}, momentum error"), momentum_error(&run), 0.0, 1e-12);
        let found = velocities(&mesh, &run);
        between("V-21", "velocity of the first bar over v", found[0], -0.02, 0.02);
        close("V-21", "velocity of the second bar over v", found[1], 1.0, 0.02);
    }
}

/// Velocities after the collision, as an independent one-dimensional program has them for steps near h/c. Bars as thick
/// as here have almost that step; of a thin bar the stable step is a third of it, and waves spread more. The remaining
/// velocity of the first bar depends on the step without viscosity, which leaves half of it; with it, a twentieth.
#[test]
fn v21_velocities_after_the_collision() {
    let cases = [
        (50, "0.", 0.0067, 0.0034),
        (200, "0.", 0.0025, 0.0014),
        (50, "0.06", 0.0198, 0.001),
        (200, "0.06", 0.0098, 0.0005),
    ];
    for (n, b1, expected, tolerance) in cases {
        let text = TWO_BARS_MESH.replace("0.01, 0.01", "0.1, 0.1").replace("50, 1, 1", &format!("{n}, 1, 1"));
        let mesh = recipe(&text);
        let run = collide(&mesh, &format!("BULK VISCOSITY, {b1}, 1.2"), "600.E-6");
        let [first, second] = velocities(&mesh, &run)[..] else { panic!("two bars") };
        let step = run.lines[1].time_step * steel::bar_speed() * n as f64;
        println!("V-21 N = {n}, b1 = {b1}, step {step:.3} h/c: velocities over v {first:.4} and {second:.4}");
        between("V-21", "velocity of the first bar over v", first, expected - tolerance, expected + tolerance);
        assert!((first + second - 1.0).abs() < 1e-12, "momentum");
    }
}

/// Bars that meet in mid-step: the first step takes the overlap only, the next the rest of the closing velocity. The
/// sum is that of bars that touch, but for what the waves do in the time between; it vanishes with N all the same.
#[test]
fn v21_bars_that_come_from_apart() {
    for (n, apart) in [(50, 1e-4), (50, 1.3e-4), (200, 1e-4)] {
        let text = TWO_BARS_MESH
            .replace("BOX, 2,  1.,", &format!("BOX, 2,  {},", 1.0 + apart))
            .replace("50, 1, 1", &format!("{n}, 1, 1"));
        let mesh = recipe(&text);
        let run = collide(&mesh, "", "640.E-6");
        let part = loss(&run) * 4.0 * n as f64;
        between("V-21", &format!("N = {n}, apart {apart} m, contact loss times 4N"), part, 1.0, 1.5);
        between("V-21", "momentum error", momentum_error(&run), 0.0, 1e-12);
        close("V-21", "velocity of the second bar over v", velocities(&mesh, &run)[1], 1.0, 0.02);
    }
}

/// A short bar on a long one: it stops when the wave comes back through it, after 2 L₁/c, and the long one goes on with
/// L₁/L₂ of the velocity. A ringing remainder of the wave's front keeps the short one from complete rest.
#[test]
fn v22_bars_of_unequal_length() {
    for (ratio, n) in [(2.0, 50), (3.0, 50), (2.0, 200)] {
        let mesh = bars([n, (n as f64 * ratio) as usize], [1.0, ratio]);
        let run = collide(&mesh, "", "1.E-3");
        let [short, long] = velocities(&mesh, &run)[..] else { panic!("two bars") };
        let case = format!("V-22 1:{ratio} N = {n}");
        // The front is a few elements wide, and so is what the reflections leave: it falls with the element's size.
        between(&case, "velocity of the short bar over v", short, -0.2 / n as f64, 0.2 / n as f64);
        close(&case, "velocity of the long bar over v", long, 1.0 / ratio, 0.005);
        between(&case, "momentum error", momentum_error(&run), 0.0, 1e-12);
    }
}

/// Steel strikes aluminium: stress and velocity behind both waves follow from the impedances Z = ρ c,
/// v Z₁/(Z₁ + Z₂) and −v Z₁ Z₂/(Z₁ + Z₂).
#[test]
fn v23_bars_of_unequal_impedance() {
    let (steel, aluminium) = ((7850.0 * 200e9f64).sqrt(), (2700.0 * 70e9f64).sqrt());
    let velocity = 10.0 * steel / (steel + aluminium);
    let deck = TWO_BARS.replace("1, 5., 0.", "1, 10., 0.").replace("600.E-6", "150.E-6").replace(
        "MATERIAL, 2, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9",
        "MATERIAL, 2, ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9",
    );
    // The partition follows from the impedances by itself; any other must give the same.
    for lines in ["", "CONTACT DATA, 1, 2, 0., 0.5", "CONTACT DATA, 1, 2, 0., 1.", "CONTACT DATA, 1, 2, 0., 0."] {
        let mesh = bars([200, 200], [1.0, 1.0]);
        let run = run(&with(&deck, lines), &mesh);
        let end = run.at(150e-6);
        // Between the interface and the fronts, 0.76 m away.
        let between_fronts = |x: f64| (x - 1.0).abs() > 0.1 && (x - 1.0).abs() < 0.5;
        let v: Vec<f64> = (mesh.coordinates.iter().zip(end.nodal("VELX")))
            .filter(|(x, _)| between_fronts(x[0]))
            .map(|(_, v)| *v)
            .collect();
        let centre = |nodes: &[u32]| nodes.iter().map(|&n| mesh.coordinates[n as usize][0]).sum::<f64>() / 8.0;
        let stress: Vec<f64> = (mesh.elements().zip(end.element("SIGXX")))
            .filter(|((_, nodes), _)| between_fronts(centre(nodes)))
            .map(|(_, s)| *s)
            .collect();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        close("V-23", "interface velocity [m/s]", mean(&v), velocity, 0.01);
        close("V-23", "stress [Pa]", mean(&stress), -velocity * aluminium, 0.01);
        between("V-23", "momentum error", momentum_error(&run), 0.0, 1e-12);
    }
}

/// The bars joined to one, without contact. The node where the first two meet begins with the velocity that a plastic impact
/// of its two halves leaves, as contact makes it.
fn joined(deck: &str, recipe_text: &str, contact: &str, end: &str) -> (Mesh, Run) {
    let mesh = recipe(&format!("{recipe_text}\nMERGE\nNODE SET FACE, 9, 1, RIGHT\n"));
    let deck = deck
        .replace(&format!("{contact}\n"), "")
        .replace(", CONTACT", "")
        .replace(
            "INITIAL VELOCITY MATERIAL, 1, 5., 0., 0.",
            "INITIAL VELOCITY MATERIAL, 1, 5., 0., 0.\nINITIAL VELOCITY NODESET, 9, 2.5, 0., 0.",
        )
        .replace("PLOT TIME, 10.E-6", "PLOT TIME, 1.E-6");
    let ends = deck.lines().filter(|line| line.starts_with("TERMINATION TIME")).collect::<String>();
    let run = run(&deck.replace(&ends, &format!("TERMINATION TIME, {end}")), &mesh);
    (mesh, run)
}

/// Mean velocities of the blocks at a time, over v. Of elements and not of nodes, which joined blocks share.
fn velocities_at(mesh: &Mesh, run: &Run, time: f64) -> Vec<f64> {
    let velocity = run.at(time).nodal("VELX");
    let of = |corners: &[u32; 8]| corners.iter().map(|&node| velocity[node as usize]).sum::<f64>() / 8.0;
    let mean = |elements: &[[u32; 8]]| elements.iter().map(of).sum::<f64>() / elements.len() as f64;
    mesh.blocks.iter().map(|block| mean(block.hexahedra()) / 5.0).collect()
}

/// What the short bar keeps is not the wave's alone: through bars that are joined to one it goes and leaves rest behind. Bars
/// that touch hand on the pushes of the ringing behind the front and not its pulls. Where steps are near h/c there is hardly any
/// ringing, and the short bar rests.
#[test]
fn v22_the_rest_is_ringing_at_a_joint_that_cannot_pull() {
    for (width, rests) in [("0.01", 0.004), ("0.1", 0.0005)] {
        let text = TWO_BARS_MESH.replace("1., 0.01, 0.01,  50", &format!("1., {width}, {width},  50")).replace(
            &format!("BOX, 2,  1., 0., 0.,  1., {width}, {width},  50"),
            &format!("BOX, 2,  1., 0., 0.,  2., {width}, {width},  100"),
        );
        let mesh = recipe(&text);
        let touching = velocities(&mesh, &collide(&mesh, "", "1.E-3"));
        let (mesh, one) = joined(TWO_BARS, &text, "CONTACT MATERIAL, 1, 2", "700.E-6");
        let through = velocities_at(&mesh, &one, 600e-6);
        println!(
            "V-22 1:2 N = 50, {width} m thick: velocities over v of bars {touching:.5?}, joined to one {through:.5?}"
        );
        between("V-22", "velocity of the short bar over v, joined", through[0].abs(), 0.0, 0.0005);
        between("V-22", "velocity of the short bar over v", touching[0].abs(), 0.0, rests);
    }
}

/// Of what the bars of the cradle keep nearly all is left by the wave itself: through a row that is joined to one, without
/// contact, it goes the same way. At 5 L/c the wave is just being reflected: its two halves are both in the last bar.
#[test]
fn v26_what_stays_behind_is_the_spreading_of_the_wave() {
    let reflected = 5.0 / steel::bar_speed();
    for (n, width, off) in [(50, "0.01", 0.006), (100, "0.01", 0.003), (50, "0.1", 0.001)] {
        let text = CRADLE_MESH.replace("0.01, 0.01,  50", &format!("{width}, {width},  {n}"));
        let mesh = recipe(&text);
        let touching =
            velocities_at(&mesh, &run(&CRADLE.replace("PLOT TIME, 10.E-6", "PLOT TIME, 1.E-6"), &mesh), reflected);
        let (mesh, one) = joined(CRADLE, &text, "CONTACT MATERIAL", "1.E-3");
        let through = velocities_at(&mesh, &one, reflected);
        println!("V-26 N = {n}, {width} m thick, at 5 L/c: touching {touching:.4?}, joined {through:.4?}");
        let worst = touching.iter().zip(&through).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
        between("V-26", &format!("N = {n}, velocities over v against those of one bar"), worst, 0.0, off);
        between("V-26", &format!("N = {n}, last bar, joined"), through[4], 0.965, 1.0);
    }
}

/// What goes in at one end of the row comes out at the other. The wave that passes is smeared over some elements, and its
/// tail stays with the bars it leaves behind: less with smaller elements.
#[test]
fn v26_newtons_cradle() {
    for (n, rest) in [(50, 0.03), (100, 0.02)] {
        let mesh = recipe(&CRADLE_MESH.replace("50, 1, 1", &format!("{n}, 1, 1")));
        let one = run(CRADLE, &mesh);
        let found = velocities(&mesh, &one);
        println!("V-26 N = {n}, one in: {found:.4?}");
        between("V-26", &format!("N = {n}, one in: velocity of the last bar over v"), found[4], 0.97, 1.0);
        assert!(found[..4].iter().all(|v| v.abs() <= rest), "the others rest");
        between("V-26", "momentum error", momentum_error(&one), 0.0, 1e-12);
        let two = run(&with(CRADLE, "INITIAL VELOCITY MATERIAL, 2, 5., 0., 0."), &mesh);
        let found = velocities(&mesh, &two);
        println!("V-26 N = {n}, two in: {found:.4?}");
        assert!(found[3..].iter().all(|v| (v - 1.0).abs() <= 0.03), "two leave");
        assert!(found[..3].iter().all(|v| v.abs() <= rest), "the others rest");
        between("V-26", "momentum error", momentum_error(&two), 0.0, 1e-12);
    }
}

/// One pass is enough in the row, whose joints are far apart; more change nothing but round-off.
#[test]
fn v26_passes_do_not_matter() {
    let mesh = recipe(CRADLE_MESH);
    let of = |passes: &str| velocities(&mesh, &run(&with(CRADLE, &format!("CONTACT PASSES, {passes}")), &mesh));
    let worst = of("1").iter().zip(of("100, 1.E-14")).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
    between("V-26", "change of velocities over v with 100 passes instead of one", worst, 0.0, 1e-6);
}
