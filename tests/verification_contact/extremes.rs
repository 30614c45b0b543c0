//! Contact at its extremes: mass ratios, vertices, corners, stacks, sheets, and faces of very different size.
//!
//! `cargo test --test verification_contact extremes:: -- --nocapture` prints the numbers of docs/verification.md. Tests that
//! are ignored are the same at full size: `make verify` runs them.

use crate::support::bodies::{kinetic_energy, mean_velocity, nodes_of};
use crate::support::meshes::recipe;
use crate::support::run::{Run, run};
use crate::support::{between, close};
use urto::mesh::Mesh;

/// Everything that the decks here have in common.
fn deck(end: &str, lines: &str) -> String {
    format!(
        "TERMINATION TIME, {end}\nOUTPUT TIME, 1.E-9\nPLOT NODAL, DISPLACEMENT, VELOCITY, MASS, CONTACT\n\
         PLOT ELEMENT, STRESS, VONMISES\nCONTACT MATERIAL\n{lines}\n"
    )
}

fn material(block: usize, density: f64, modulus: f64, poisson: f64) -> String {
    format!(
        "MATERIAL, {block}, ELASTIC, {density:?}\nYOUNGS MODULUS = {modulus:?}\nPOISSONS RATIO = {poisson:?}\nEND\n"
    )
}

fn steel(block: usize) -> String {
    material(block, 7850.0, 200e9, 0.3)
}

/// Largest change of linear momentum, over the sum of the absolute momenta at the start.
fn momentum_error(run: &Run, size: f64) -> f64 {
    let start = run.lines[0].totals.momentum;
    let off = |p: [f64; 3]| (0..3).fold(0.0f64, |m, i| m.max((p[i] - start[i]).abs()));
    run.lines.iter().fold(0.0f64, |m, line| m.max(off(line.totals.momentum))) / size
}

/// A block that is ten thousand times denser and stiffer than what it strikes goes through with its velocity; the light one
/// is thrown ahead by no more than twice that velocity, and follows without chatter. Both ways round.
#[test]
fn extreme_8_jump_of_ten_thousand() {
    let mesh =
        recipe("BOX, 1, 0., 0., 0., 0.1, 0.1, 0.1, 4, 4, 4\nBOX, 2, 0.1, 0.02, 0.02, 0.05, 0.06, 0.06, 3, 3, 3\n");
    for (case, heavy, light) in [("heavy strikes light", 1, 2), ("light strikes heavy", 2, 1)] {
        let text = deck(
            "400.E-6",
            &format!(
                "PLOT TIME, 1.E-6\nINITIAL VELOCITY MATERIAL, 1, 10., 0., 0.\n{}{}",
                material(heavy, 78500.0, 2e12, 0.3),
                material(light, 7.85, 2e8, 0.3)
            ),
        );
        let run = run(&text, &mesh);
        let mass = if heavy == 1 { 78.5 } else { 7.85e-3 };
        between("extreme 8", &format!("{case}, momentum error"), momentum_error(&run, 10.0 * mass), 0.0, 1e-12);
        let found = [1, 2].map(|block| mean_velocity(run.end(), &nodes_of(&mesh, block))[0]);
        println!(
            "extreme 8 {case}: {found:.4?} m/s, contact work {:.1e} of the energy, balance {:.1e}",
            run.last().totals.contact / run.initial_energy,
            run.worst_balance()
        );
        if heavy == 1 {
            close("extreme 8", "velocity of the heavy block", found[0], 10.0, 1e-4);
            between("extreme 8", "velocity of the light block", found[1], 10.0, 20.0);
        } else {
            between("extreme 8", "velocity of the light block", found[0], -10.0, 0.0);
        }
        // Chatter: contact made and broken again and again. Forces come in a few spells.
        let touching: Vec<bool> = run.states.iter().map(|s| s.nodal("CONTSTAT").iter().any(|s| *s > 0.0)).collect();
        let spells = touching.windows(2).filter(|w| !w[0] && w[1]).count() + usize::from(touching[0]);
        println!("extreme 8 {case}: {spells} spells of contact in {} states", touching.len());
        between("extreme 8", "worst energy balance", run.worst_balance(), 0.0, 1e-3);
    }
}

/// The largest difference of a velocity from its image in the planes x = 0 and y = 0, of all nodes and states.
fn departure_from_symmetry(run: &Run, mesh: &Mesh) -> f64 {
    let first = nodes_of(mesh, 1);
    let is_first = |n: usize| first.binary_search(&n).is_ok();
    let image = |n: usize, axis: usize| {
        let mut x = mesh.coordinates[n];
        x[axis] = -x[axis];
        let same = |y: &[f64; 3]| (0..3).all(|i| (x[i] - y[i]).abs() < 1e-9);
        let is_image = |m: &usize| same(&mesh.coordinates[*m]) && is_first(*m) == is_first(n);
        (0..mesh.coordinates.len()).find(is_image).expect("an image")
    };
    let mut worst = 0.0f64;
    for axis in 0..2 {
        for n in 0..mesh.coordinates.len() {
            let m = image(n, axis);
            for state in &run.states {
                for (i, name) in ["VELX", "VELY", "VELZ"].iter().enumerate() {
                    let sign = if i == axis { -1.0 } else { 1.0 };
                    worst = worst.max((state.nodal(name)[n] - sign * state.nodal(name)[m]).abs());
                }
            }
        }
    }
    worst
}

/// The tip of a small cube comes down exactly on the vertex of four faces: one interaction, and what is symmetric about
/// both planes stays so.
#[test]
fn extreme_10_node_on_the_vertex_of_four_faces() {
    let mesh =
        recipe("BOX, 1, -0.1, -0.1, -0.1, 0.2, 0.2, 0.1, 4, 4, 2\nBOX, 2, -0.05, -0.05, 0., 0.1, 0.1, 0.05, 2, 2, 1\n");
    let text = deck(
        "200.E-6",
        &format!("PLOT TIME, 10.E-6\nINITIAL VELOCITY MATERIAL, 2, 0., 0., -20.\n{}{}", steel(1), steel(2)),
    );
    let run = run(&text, &mesh);
    let worst = departure_from_symmetry(&run, &mesh);
    between("extreme 10", "departure from symmetry over the velocity", worst / 20.0, 0.0, 1e-10);
    between("extreme 10", "momentum error", momentum_error(&run, 20.0 * 7850.0 * 0.1 * 0.1 * 0.05), 0.0, 1e-12);
    let up = mean_velocity(run.end(), &nodes_of(&mesh, 2))[2];
    println!("extreme 10: the cube leaves with {up:.2} m/s");
    assert!(up > 0.0, "it bounces");
}

/// A ball falls so fast with its pole on the middle node of a plate that they go through each other by a thousandth of a face in the step in which they
/// meet. The foot at the end of that step is beside the node, where one of the four faces was chosen: the ball flew off to the side.
#[test]
fn extreme_10_a_fast_ball_on_a_node() {
    let mesh = recipe("SPHERE, 1, .5, 2\nTRANSLATE, 1, 0., 0., .501\nBOX, 2, -1., -1., -.2, 2., 2., .2, 2, 2, 1\n");
    for partition in [0.0, 0.5, 1.0] {
        let lines = format!(
            "PLOT TIME, 4.E-5\nCONTACT DATA, 1, 2, 0., {partition:?}\nINITIAL VELOCITY MATERIAL, 1, 0., 0., -50.\n{}{}",
            steel(1),
            steel(2)
        );
        let run = run(&deck("400.E-6", &lines), &mesh);
        let worst = departure_from_symmetry(&run, &mesh);
        // Round-off; up to 1.6 before.
        between(
            "extreme 10",
            &format!("fast ball, partition {partition}: departure over the velocity"),
            worst / 50.0,
            0.0,
            1e-10,
        );
    }
}

/// A block slides over the edge of a table and tips: no kick where its nodes leave the face.
#[test]
fn extreme_11_sliding_across_a_convex_corner() {
    let mesh = recipe(
        "BOX, 1, 0., 0., -0.02, 0.1, 0.1, 0.02, 5, 5, 1\nBOX, 2, 0.031, 0.011, 0., 0.06, 0.08, 0.03, 3, 4, 2\n\
         NODE SET FACE, 1, 1, BOTTOM\n",
    );
    let held = "NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n";
    let gravity = "FUNCTION, 1\n0., 0.\n0.2E-3, 1.\nEND\nGRAVITY, 0., 0., -500., 1\n";
    let text = deck(
        "4.E-3",
        &format!(
            "PLOT TIME, 20.E-6\nHOURGLASS STIFFENING, 0.05, 0.03\n{held}{gravity}INITIAL VELOCITY MATERIAL, 2, 20., 0., 0.\n{}{}",
            steel(1),
            steel(2)
        ),
    );
    let run = run(&text, &mesh);
    let block = nodes_of(&mesh, 2);
    let end = mean_velocity(run.end(), &block);
    let passed = run.end().positions(&mesh)[block[0]][0];
    println!("extreme 11: velocity {end:.4?}, first node at x = {passed:.4} m, the edge at 0.1 m");
    assert!(passed > 0.1, "the block has left the table");
    let initial = run.initial_energy;
    // The whole energy of the sliding block is that at the start and what gravity gave; contact takes and gives nothing.
    let work = run.lines.iter().fold(0.0f64, |m, line| m.max(line.totals.contact.abs())) / initial;
    between("extreme 11", "contact work over the energy", work, 0.0, 0.005);
    let change = (kinetic_energy(run.end(), &block) - run.last().totals.external) / initial - 1.0;
    between("extreme 11", "change of energy but for gravity's", change.abs(), 0.0, 0.005);
    // Frictionless: only the edge's own rounding may push along x.
    close("extreme 11", "velocity along x [m/s]", end[0], 20.0, 0.005);
    between("extreme 11", "worst energy balance", run.worst_balance(), 0.0, 1e-3);
}

/// A column of ten blocks.
fn column() -> Mesh {
    let boxes: String = (0..10)
        .map(|i| format!("BOX, {}, 0., 0., {:?}, 0.1, 0.1, 0.05, {2}, {2}, 2\n", i + 1, 0.05 * i as f64, 2 + i % 2))
        .collect();
    recipe(&format!("{boxes}NODE SET FACE, 1, 1, BOTTOM\nNODE SET FACE, 2, 10, TOP\n"))
}

fn steel_of_ten() -> String {
    (1..=10).map(steel).collect()
}

/// A column at rest under gravity: its end sinks by what statics says, ½ ρ g L²/E of a free column, and not on from there;
/// nothing slides away.
fn creep(passes: &str, end: &str) -> [f64; 2] {
    let mesh = column();
    let held = "NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n";
    let gravity = "FUNCTION, 1\n0., 0.\n1.E-3, 1.\nEND\nGRAVITY, 0., 0., -9.81, 1\n";
    let text = deck(
        end,
        &format!("CONTACT PASSES, {passes}\nHOURGLASS STIFFENING, 0.05, 0.03\n{held}{gravity}{}", steel_of_ten()),
    )
    .replace("OUTPUT TIME, 1.E-9", "OUTPUT TIME, 1.E-3")
    .replace("PLOT NODAL", "PLOT TIME, 50.E-6\nPLOT NODAL");
    let run = run(&text, &mesh);
    let top = nodes_of(&mesh, 10);
    let mean = |name: &str, from: f64, to: f64| {
        let states: Vec<_> = run.states.iter().filter(|s| s.time >= from && s.time <= to).collect();
        states.iter().flat_map(|s| top.iter().map(|&n| s.nodal(name)[n])).sum::<f64>()
            / (states.len() * top.len()) as f64
    };
    let t = run.last().time;
    let [early, late] = [[0.4 * t, 0.6 * t], [0.8 * t, t]].map(|[from, to]| mean("DISPLZ", from, to));
    let sideways =
        run.end().nodal("DISPLX").iter().chain(run.end().nodal("DISPLY")).fold(0.0f64, |m, u| m.max(u.abs()));
    println!(
        "extreme 12, passes {passes}, {} steps: top at {early:.4e} m, later {late:.4e} m (statics {:.4e} m), sideways {sideways:.1e} m, energy balance {:.1e}",
        run.last().step,
        -0.5 * 7850.0 * 9.81 * 0.5 * 0.5 / 200e9,
        run.worst_balance()
    );
    [(late - early).abs().max(sideways), late]
}

/// The edge of an element is 25 mm or more.
#[test]
fn extreme_12_column_at_rest() {
    for passes in ["1", "20", "200, 1.E-12"] {
        let [creep, _] = creep(passes, "15.E-3");
        between(
            "extreme 12",
            &format!("creep with passes {passes} over the edge of an element"),
            creep / 0.025,
            0.0,
            1e-3,
        );
    }
}

#[test]
#[ignore = "100,000 steps, some minutes in the release build: make verify"]
fn extreme_12_column_at_rest_full_size() {
    let [creep, _] = creep("20", "300.E-3");
    between("extreme 12", "creep in 100,000 steps over the edge of an element", creep / 0.025, 0.0, 1e-3);
}

/// A column hit at the top: the wave goes through nine joints. More passes change the result little.
#[test]
fn extreme_12_column_hit_at_the_top() {
    let mesh = column();
    let held = "NO DISPLACEMENT, Z, 1\n";
    let mut last: Option<[f64; 2]> = None;
    for passes in ["1", "3", "20", "200, 1.E-12"] {
        let text = deck(
            "300.E-6",
            &format!(
                "PLOT TIME, 1.E-6\nCONTACT PASSES, {passes}\n{held}INITIAL VELOCITY NODESET, 2, 0., 0., -20.\n{}",
                steel_of_ten()
            ),
        );
        let run = run(&text, &mesh);
        let force: Vec<f64> =
            run.states.iter().map(|s| nodes_of(&mesh, 1).iter().map(|&n| -s.nodal("CONTZ")[n]).sum()).collect();
        let peak = force.iter().copied().fold(0.0, f64::max);
        let found = [peak, run.last().totals.kinetic / run.initial_energy];
        println!(
            "extreme 12, hit, passes {passes}: peak force on the lowest joint {peak:.4e} N, kinetic {:.4}, contact work {:.2e}, balance {:.1e}",
            found[1],
            run.last().totals.contact / run.initial_energy,
            run.worst_balance()
        );
        between("extreme 12", "worst energy balance", run.worst_balance(), 0.0, 5e-3);
        last = Some(found);
    }
    assert!(last.is_some());
}

/// Where the energy balance of the struck column is off: at its start, with contact and without. One layer of nodes is
/// suddenly in motion, viscosity acts before anything else does, and after half a step the velocity is another: the first
/// ½ m v² is more than the ½ m v⁻ v⁺ that central differences keep, by ⅛ m (Δt a)². It goes with the square of the step.
#[test]
fn extreme_12_balance_of_the_struck_column() {
    let one = "BOX, 1, 0., 0., 0., 0.1, 0.1, 0.5, 2, 2, 20\nNODE SET FACE, 1, 1, BOTTOM\nNODE SET FACE, 2, 1, TOP\n";
    for (case, mesh, materials, contact) in
        [("ten blocks", column(), steel_of_ten(), true), ("one block, no contact", recipe(one), steel(1), false)]
    {
        let mut worst = Vec::new();
        for scale in ["1.", "0.5"] {
            let text = deck(
                "50.E-6",
                &format!(
                    "PLOT TIME, 1.E-9\nTIME STEP SCALE, {scale}\nNO DISPLACEMENT, Z, 1\nINITIAL VELOCITY NODESET, 2, 0., 0., -20.\n{materials}"
                ),
            )
            .replace("MASS, CONTACT", "MASS, ACCELERATION");
            let run = run(&if contact { text } else { text.replace("CONTACT MATERIAL\n", "") }, &mesh);
            let (start, step) = (&run.states[0], run.lines[0].time_step);
            let square =
                |n: usize| ["ACCLX", "ACCLY", "ACCLZ"].map(|name| start.nodal(name)[n].powi(2)).iter().sum::<f64>();
            let lost = start.nodal("NODMASS").iter().enumerate().map(|(n, m)| 0.125 * m * step * step * square(n));
            let expected = -lost.sum::<f64>() / run.initial_energy;
            close(
                "extreme 12",
                &format!("{case}, step scale {scale}, balance after the first step"),
                run.lines[1].balance,
                expected,
                0.1,
            );
            worst.push(run.worst_balance());
        }
        println!("extreme 12, hit, {case}: worst energy balance {:.2e}, with half the step {:.2e}", worst[0], worst[1]);
        between("extreme 12", "worst balance over that of half the step", worst[0] / worst[1], 3.3, 4.7);
    }
}

/// A column whose top block comes down loses what a plastic impact of the two layers that meet would, ½ m/2 v² with the mass m
/// of half an element's height, though their meshes do not match; half with half the element. The balance knows nothing of it.
#[test]
fn extreme_12_loss_of_a_struck_column() {
    for finer in [1, 2] {
        let boxes: String = (0..10)
            .map(|i| {
                let cells = (2 + i % 2) * finer;
                format!(
                    "BOX, {}, 0., 0., {:?}, 0.1, 0.1, 0.05, {cells}, {cells}, {}\n",
                    i + 1,
                    0.05 * i as f64,
                    2 * finer
                )
            })
            .collect();
        let mesh = recipe(&boxes);
        let text = deck("10.E-6", &format!("INITIAL VELOCITY MATERIAL, 10, 0., 0., -20.\n{}", steel_of_ten()));
        let run = run(&text, &mesh);
        let layer = 7850.0 * 0.1 * 0.1 * 0.5 * 0.025 / finer as f64;
        let loss = -run.lines[1].totals.contact;
        close(
            "extreme 12",
            &format!("energy that contact takes, {finer} x 2 layers a block [J]"),
            loss,
            0.25 * layer * 400.0,
            0.002,
        );
        between("extreme 12", "worst energy balance", run.worst_balance(), 0.0, 1e-3);
    }
}

/// A sheet one element thick is struck from both sides at once: nothing sticks to the far side, and by symmetry it stays.
#[test]
fn extreme_14_sheet_struck_from_both_sides() {
    let mesh = recipe(
        "BOX, 1, -0.1, -0.1, -0.001, 0.2, 0.2, 0.002, 10, 10, 1\nBOX, 2, -0.03, -0.03, 0.002, 0.06, 0.06, 0.03, 3, 3, 2\n\
         BOX, 3, -0.03, -0.03, -0.032, 0.06, 0.06, 0.03, 3, 3, 2\n",
    );
    let text = deck(
        "300.E-6",
        &format!(
            "PLOT TIME, 5.E-6\nINITIAL VELOCITY MATERIAL, 2, 0., 0., -30.\nINITIAL VELOCITY MATERIAL, 3, 0., 0., 30.\n{}{}{}",
            material(1, 7850.0, 200e9, 0.3),
            steel(2),
            steel(3)
        ),
    );
    let run = run(&text, &mesh);
    let [above, below] = [2, 3].map(|block| mean_velocity(run.end(), &nodes_of(&mesh, block))[2]);
    let sheet = mean_velocity(run.end(), &nodes_of(&mesh, 1))[2];
    println!(
        "extreme 14: blocks leave with {above:.3} and {below:.3} m/s, the sheet with {sheet:.1e} m/s, contact work {:.2e}, balance {:.1e}",
        run.last().totals.contact / run.initial_energy,
        run.worst_balance()
    );
    assert!(above > 15.0 && below < -15.0, "both bounce");
    assert!((above + below).abs() < 1e-9 * 30.0 && sheet.abs() < 1e-9 * 30.0, "symmetry");
    let (x, mesh_nodes) = (run.end().positions(&mesh), [nodes_of(&mesh, 1), nodes_of(&mesh, 2)]);
    let middle = mesh_nodes[0].iter().map(|&n| x[n][2]).fold(f64::NEG_INFINITY, f64::max);
    assert!(mesh_nodes[1].iter().all(|&n| x[n][2] > middle), "the upper block is above the sheet");
}

/// One element a thousand times larger than those that strike it.
#[test]
fn extreme_16_one_face_a_thousand_times_larger() {
    let mesh = recipe(
        "BOX, 1, -0.5, -0.5, -1., 1., 1., 1., 1, 1, 1\nBOX, 2, 0.1, 0.1, 0.0001, 0.008, 0.008, 0.004, 8, 8, 4\n",
    );
    for search in ["GRID", "TREE", "POINT IN BOX"] {
        let text = deck(
            "20.E-6",
            &format!(
                "CONTACT SEARCH, {search}\nPLOT TIME, 1.E-6\nINITIAL VELOCITY MATERIAL, 2, 0., 0., -50.\n{}{}",
                steel(1),
                steel(2)
            ),
        );
        let clock = std::time::Instant::now();
        let run = run(&text, &mesh);
        let small = nodes_of(&mesh, 2);
        let up = mean_velocity(run.end(), &small)[2];
        println!(
            "extreme 16, {search}: the small block leaves with {up:.2} m/s after {} steps in {:.2} s",
            run.last().step,
            clock.elapsed().as_secs_f64()
        );
        assert!(up > 10.0, "it bounces: {up}");
        let size = 50.0 * 7850.0 * 0.008 * 0.008 * 0.004;
        between("extreme 16", "momentum error", momentum_error(&run, size), 0.0, 1e-9);
        let lowest = small
            .iter()
            .flat_map(|&n| run.states.iter().map(move |s| (s, n)))
            .map(|(s, n)| s.nodal("DISPLZ")[n] + mesh.coordinates[n][2])
            .fold(f64::INFINITY, f64::min);
        println!("extreme 16, {search}: lowest node at {lowest:.2e} m");
        between("extreme 16", "worst energy balance", run.worst_balance(), 0.0, 1e-3);
    }
}

/// All points of contact in one plane, many at the same x and y: two plates side by side that meet with their rims, and
/// plates that lie on each other.
#[test]
fn extreme_17_all_contact_nodes_on_one_plane() {
    let mesh = recipe(
        "BOX, 1, 0., 0., 0., 0.1, 0.1, 0.01, 8, 8, 1\nBOX, 2, 0., 0., 0.01, 0.1, 0.1, 0.01, 8, 8, 1\n\
         SIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 200, 2, BOTTOM\n",
    );
    let mut expected: Option<Vec<u64>> = None;
    for search in ["GRID", "TREE", "POINT IN BOX"] {
        let text = deck(
            "50.E-6",
            &format!(
                "CONTACT SEARCH, {search}\nPLOT TIME, 5.E-6\nINITIAL VELOCITY MATERIAL, 2, 1., 2., -20.\n{}{}",
                steel(1),
                steel(2)
            ),
        )
        .replace("CONTACT MATERIAL\n", "CONTACT SURFACE, 100, 200\n");
        let run = run(&text, &mesh);
        let bits: Vec<u64> = run.end().nodal("VELZ").iter().map(|v| v.to_bits()).collect();
        assert!(expected.get_or_insert_with(|| bits.clone()) == &bits, "{search}");
        between("extreme 17", "momentum error", momentum_error(&run, 7850.0 * 0.1 * 0.1 * 0.01 * 20.0), 0.0, 1e-12);
        let [lower, upper] = [1, 2].map(|block| mean_velocity(run.end(), &nodes_of(&mesh, block))[2]);
        println!("extreme 17, {search}: velocities {lower:.3} and {upper:.3} m/s");
        assert!(upper > lower, "they part");
    }
}

/// A sheet between two driven tools that leave it 0.98 of its thickness: its nodes stay between the tools, short of room on both sides, and the
/// work of the drive is that of bringing the tools to them, whatever the passes. It had grown with these, from 0.09 with 5 to 233 with 200.
#[test]
fn a_sheet_without_room_is_not_pressed_by_more_with_more_passes() {
    let mesh = recipe(
        "TITLE\n SHEET\nBOX, 1, 0., 0., -2.6, 10., 10., 2., 1, 1, 1\nSHEET, 2, 3., 3., 0., 4., 4., 0., 1, 1\n\
         BOX, 3, 0., 0., 0.6, 10., 10., 2., 1, 1, 1\nNODE SET BLOCK, 1, 1\nNODE SET BLOCK, 2, 3\n",
    );
    let law = "7.85E-3\nYOUNGS MODULUS = 210.E3\nPOISSONS RATIO = 0.3\nEND\n";
    let works = [5, 20, 200].map(|passes| {
        let deck = format!(
            "TERMINATION TIME, 1.\nOUTPUT TIME, 0.05\nPLOT TIME, 1.\nCONTACT MATERIAL\nCONTACT PASSES, {passes}\nSHELL THICKNESS, 2, 1.\n\
             NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\nNO DISPLACEMENT, X, 2\nNO DISPLACEMENT, Y, 2\n\
             FUNCTION, 1\n0., 0.\n0.5, -1.\n1., 0.\nEND\nPRESCRIBED DISPLACEMENT, Z, 2, 1, 0.22\n\
             MATERIAL, 1, ELASTIC, {law}MATERIAL, 2, ELASTIC, {law}MATERIAL, 3, ELASTIC, {law}"
        );
        run(&deck, &mesh).last().totals.external
    });
    for (passes, work) in [5, 20, 200].iter().zip(works) {
        between("sheet without room", &format!("work of the tools with {passes} passes"), work, 0.0, 0.03);
    }
    close("sheet without room", "work with 200 passes over that with 20", works[2], works[1], 1e-3);
}
