//! Blocks that are taken away at a time.

use crate::support::meshes::recipe;
use crate::support::run::{run, run_on};
use crate::support::{between, close};

fn text(path: &str) -> String {
    std::fs::read_to_string(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a file")
}

/// A bar under the pressure of an impact is cut in two: relief reaches the wall after the time of a wave.
#[test]
fn v33_a_cut_bar_leaves_the_wall_early() {
    let mesh = recipe(&text("meshes/wall_bar_cut.mesh"));
    let bar = run(&text("decks/wall_bar_cut.i"), &mesh);
    let force = |state: &crate::support::run::State| state.nodal("RX").iter().sum::<f64>();
    let plateau = 7850.0 * crate::support::steel::bar_speed() * 5.0 * 1e-4;
    let touching = bar.states.iter().filter(|state| force(state) > 0.5 * plateau);
    let left = touching.map(|state| state.time).fold(0.0, f64::max);
    // Fronts are as wide as some elements, each of 4 microseconds.
    close("V-33", "time of leaving the wall", left, 1.5 / crate::support::steel::bar_speed(), 0.02);
    let (before, after) = (bar.at(197e-6), bar.at(200e-6));
    assert!(before.element("STATUS").iter().all(|alive| *alive == 1.0));
    assert_eq!(after.element("STATUS"), [[1.0; 25], [0.0; 25]].concat());
    between("V-33", "energy balance", bar.worst_balance(), 0.0, 1e-3);
}

/// A bar in free flight: what is left flies on with its own momentum, that of the shared nodes whole.
#[test]
fn what_is_left_flies_on() {
    let mesh = recipe(&text("meshes/wall_bar_cut.mesh"));
    let deck = text("decks/wall_bar_cut.i")
        .replace("RIGID SURFACE", "$ RIGID SURFACE")
        .replace("MATERIAL, 1, -5.", "MATERIAL, 1, 5.");
    let deck = deck.replace("MATERIAL, 2, -5.", "MATERIAL, 2, 5.");
    for ranks in [1, 3] {
        let bar = run_on(ranks, &deck, &mesh).whole();
        // 25 elements and half of the one beyond the cut, of 50 in a bar of 0.785 kg.
        let momentum = bar.last().totals.momentum[0];
        close("free flight", "momentum", momentum, 0.785 * 25.5 / 50.0 * 5.0, 1e-12);
        close("free flight", "energy of what went", bar.last().totals.eroded, 0.5 * 0.785 * 24.5 / 50.0 * 25.0, 1e-12);
        assert!(bar.worst_balance() < 1e-12, "{}", bar.worst_balance());
    }
}

/// Debris that DEATH has left goes with its block; what another block has left stays. A third block keeps the steps small.
#[test]
fn free_masses_go_with_their_block() {
    let mesh = recipe(
        "TITLE\n cubes\nBOX, 1, 0., 0., 0., 1., 1., 1., 1, 1, 1\nBOX, 2, 3., 0., 0., 1., 1., 1., 1, 1, 1\nBOX, 3, 9., 0., 0., 0.1, 0.1, 0.1, 1, 1, 1\n",
    );
    let material =
        |block: usize| format!("MATERIAL, {block}, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.\nEND\n");
    let deck = format!(
        "TITLE\n cubes\nTERMINATION TIME, 1.E-2\nPLOT TIME, 1.E-3\nCONTACT MATERIAL\n\
         INITIAL VELOCITY MATERIAL, 1, 2., 0., 0.\nINITIAL VELOCITY MATERIAL, 2, 3., 0., 0.\n\
         DEATH, 1, VOLUME, MAX, 0.5\nDEATH, 2, VOLUME, MAX, 0.5\nDELETE MATERIAL, 1, 5.E-3\n{}{}{}",
        material(1),
        material(2),
        material(3)
    );
    let left = run(&deck, &mesh);
    let momentum = |time: f64| left.lines.iter().rfind(|line| line.time < time).expect("a line").totals.momentum[0];
    assert_eq!([momentum(4e-3), momentum(f64::INFINITY)], [5000.0, 3000.0]);
    assert_eq!(left.last().totals.eroded, 0.5 * 1000.0 * 4.0);
}

/// DEATH watches the step that the log prints. A bar of two bricks, one of them half as long; the log's first step is that of
/// the short one, with everything that shortens it. A limit just above takes it away as soon as it is known, just below none.
#[test]
fn time_step_is_what_the_log_prints() {
    let mesh = recipe(
        "TITLE\n bar\nBOX, 1, 0., 0., 0., 1., 1., 1., 1, 1, 1\nBOX, 1, 1., 0., 0., 0.5, 1., 1., 1, 1, 1\nMERGE\n",
    );
    let deck = |rule: &str| {
        format!(
            "TITLE\n bar\nTERMINATION TIME, 5.E-3\nOUTPUT TIME, 1.E-5\nPLOT TIME, 1.E-3\nTIME STEP SCALE, 0.8\n{rule}\
             MATERIAL, 1, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.3\nEND\n"
        )
    };
    let step = run(&deck(""), &mesh).lines[0].time_step;
    let alive = |ranks: usize, limit: f64| {
        let left = run_on(ranks, &deck(&format!("PLOT ELEMENT, STATUS\nDEATH, 1, TMSTEP, MIN, {limit:e}\n")), &mesh);
        left.whole().end().element("STATUS").to_vec()
    };
    for ranks in [1, 2] {
        assert_eq!(alive(ranks, step * (1.0 - 1e-6)), [1.0, 1.0]);
        assert_eq!(alive(ranks, step * (1.0 + 1e-6)), [1.0, 0.0]);
    }
}
