//! Energies that no sound run has, put into one by hand.

use super::finding::ROW;
use crate::comm::Serial;
use crate::deck::Source;
use crate::mesh::{Block, Mesh, UNIT_CUBE};
use crate::model::{Model, examine};
use crate::partition::Decomposition;
use crate::restart::Snapshot;
use crate::solver::{Body, Request, Solver, Stop, Totals};

/// A cube of mass 1 that flies with a speed of 2: its energy is 2. `more` are further commands.
fn with_cube(more: &str, test: impl FnOnce(&mut Solver)) {
    let mesh = Mesh {
        coordinates: UNIT_CUBE.to_vec().into(),
        node_ids: (1..=8).collect(),
        element_ids: vec![7],
        blocks: vec![Block::hexahedra_of(1, [[0, 1, 2, 3, 4, 5, 6, 7]])],
        ..Mesh::default()
    };
    let deck = format!(
        "TITLE\n CUBE\nTERMINATION TIME, 1.\nMATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n\
         INITIAL VELOCITY MATERIAL, 1, 2., 0., 0.\n{more}EXIT\n"
    );
    let problem = examine(Source::new("test deck", &deck), Some(&mesh));
    let model: Model = problem.unwrap_or_else(|found| panic!("{}", found.render(false))).model;
    let body = Body::new(&mesh, &model).expect("every block has a material");
    let cut = body.cut(1);
    let contributors = body.contributors(&cut);
    let share = Decomposition::new(&contributors, mesh.coordinates.len(), 1).share(0);
    let mut solver = Solver::new(&mesh, &model, &body, &share, &mut Serial);
    solver.prepare(Request::Continue, &mut Serial).expect("a cube can fly");
    test(&mut solver);
}

/// Lets the solver look at these energies.
fn look_at(solver: &mut Solver, totals: Totals) -> Result<(), Stop> {
    solver.last_totals = Some((solver.step, totals));
    solver.look(&mut Serial)
}

fn labels(solver: &mut Solver) -> Vec<String> {
    solver.new_findings().iter().map(|finding| finding.label()).collect()
}

const SOUND: Totals = Totals {
    kinetic: 2.0,
    internal: 0.0,
    hourglass: 0.0,
    bulk_viscosity: 0.0,
    friction: 0.0,
    eroded: 0.0,
    external: 0.0,
    contact: 0.0,
    contact_gain: 0.0,
    press_fit: 0.0,
    momentum: [0.0; 3],
    added_kinetic: 0.0,
    least_scale: 0.0,
};

#[test]
fn a_sound_run_is_told_nothing() {
    with_cube("", |solver| {
        look_at(solver, SOUND).expect("nothing is wrong");
        assert_eq!(labels(solver), [""; 0]);
        assert_eq!(SOUND.relative_error(2.0), 0.0);
    });
}

#[test]
fn what_contact_makes_counts_as_an_error_is_warned_of_once_and_ends_the_run_at_the_limit() {
    with_cube("", |solver| {
        let made = |energy: f64| Totals { kinetic: 2.0 + energy, contact: energy, contact_gain: energy, ..SOUND };
        assert!(made(0.05).gap(2.0).abs() < 1e-15, "the accounts close");
        assert!((made(0.05).relative_error(2.0) - 0.05 / 2.05).abs() < 1e-15, "but the balance is off");
        look_at(solver, made(0.019)).expect("0.95 per cent");
        assert_eq!(labels(solver), [""; 0]);
        look_at(solver, made(0.03)).expect("1.5 per cent");
        assert_eq!(labels(solver), ["contact makes energy"]);
        look_at(solver, made(0.05)).expect("2.5 per cent");
        assert_eq!(labels(solver), [""; 0], "once");
        let finding = solver.findings()[0];
        assert!((finding.evidence.share - 0.015).abs() < 1e-15 && (finding.worst - 0.025).abs() < 1e-15);
        let stop = look_at(solver, made(0.12)).expect_err("6 per cent");
        assert!(matches!(stop, Stop::Contact { limit: 0.05, .. }), "{stop}");
        let words = stop.to_string();
        assert!(words.contains("1.2000e-1, 6.0 % of the largest supplied, and the limit is 5.0 %"), "{words}");
        assert!(stop.advice().concat().contains("CONTACT ENERGY LIMIT"));
    });
}

#[test]
fn the_deck_may_raise_the_limit_of_contact_beyond_all_other_checks() {
    with_cube("CONTACT ENERGY LIMIT, 100.\n", |solver| {
        let made = Totals { kinetic: 102.0, contact: 100.0, contact_gain: 100.0, ..SOUND };
        look_at(solver, made).expect("50 times the energy, below the limit");
        assert_eq!(labels(solver), ["contact makes energy"]);
    });
}

#[test]
fn resistances_that_give_back_more_than_they_took_are_errors() {
    for (account, label) in [(0, "hourglass stiffness"), (1, "bulk viscosity"), (2, "friction")] {
        with_cube("", |solver| {
            let mut totals = Totals { kinetic: 2.04, ..SOUND };
            *[&mut totals.hourglass, &mut totals.bulk_viscosity, &mut totals.friction][account] = -0.04;
            assert!(totals.gap(2.0).abs() < 1e-15 && (totals.relative_error(2.0) - 0.04 / 2.04).abs() < 1e-15);
            look_at(solver, totals).expect("2 per cent");
            assert_eq!(labels(solver), [format!("{label} makes energy")]);
        });
    }
}

#[test]
fn energy_that_hourglass_stiffness_makes_ends_the_run() {
    with_cube("", |solver| {
        let stop = look_at(solver, Totals { kinetic: 4.5, hourglass: -2.5, ..SOUND }).expect_err("more than was there");
        assert!(matches!(stop.event(), Stop::Balance { .. }), "{stop}");
        let words = stop.to_string();
        assert!(words.starts_with("hourglass stiffness has given back 2.5000e0 more than it took"), "{words}");
    });
}

#[test]
fn what_came_first_is_named_first() {
    with_cube("", |solver| {
        look_at(solver, Totals { kinetic: 2.03, contact: 0.03, contact_gain: 0.03, ..SOUND }).expect("a warning");
        solver.step += 100;
        let stop = look_at(solver, Totals { kinetic: 60.0, internal: -58.0, ..SOUND }).expect_err("it runs away");
        assert!(matches!(stop.event(), Stop::Energy { .. }));
        let words = stop.to_string();
        assert!(words.starts_with("contact has made an energy of 3.0000e-2, 1.5 %"), "{words}");
        assert!(words.contains("came first, at step 0") && words.contains("then: energy is running away"), "{words}");
        assert_eq!(labels(solver), ["contact makes energy", "energy outgrows what was supplied"]);
    });
}

#[test]
fn accounts_that_do_not_close_are_told() {
    with_cube("", |solver| {
        look_at(solver, Totals { kinetic: 1.9, ..SOUND }).expect("5 per cent");
        let finding = solver.new_findings()[0];
        assert!(finding.words().contains("is off by 1.0000e-1, 5.0 %") && finding.words().contains("lost"));
    });
}

#[test]
fn findings_are_part_of_the_state() {
    with_cube("", |solver| {
        look_at(solver, Totals { kinetic: 1.9, ..SOUND }).expect("a warning");
        let before = solver.findings().to_vec();
        let row = before[0].row();
        assert_eq!(row.len(), ROW);
        // A state without them cannot be gone on from.
        let missing = solver.restore(&Snapshot::default(), &mut Serial).expect_err("an empty state");
        assert!(missing.contains(&"FINDINGS".to_string()), "{missing:?}");
    });
}
