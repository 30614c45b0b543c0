//! MASS SCALING: steps as long as they were asked for, masses by their formula, momentum and weight with what was added.
//!
//! `cargo test --test verification_solids mass_scaling:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::program::{Desk, bar_deck, put_bar};
use crate::support::close;
use crate::support::continued::{Case, assert_same};
use crate::support::meshes::{brick, recipe};
use crate::support::run::{Run, run, run_on};
use urto::mesh::Mesh;

const SIZE: [f64; 3] = [0.08, 0.02, 0.02];
const DENSITY: f64 = 7850.0;

/// A bar of 8 layers of which the fourth has a tenth of the others' thickness.
fn bar_with_a_thin_layer() -> Mesh {
    let mut mesh = brick([8, 2, 2], SIZE);
    for x in &mut mesh.coordinates {
        if (x[0] - 0.04).abs() < 1e-9 {
            x[0] = 0.031;
        }
    }
    mesh
}

/// Steel that flies at 10 m/s along x and falls along z.
fn deck(end: f64, more: &str) -> String {
    format!(
        "TITLE\n a bar that falls\nTERMINATION TIME, {end:e}\nOUTPUT TIME, {end:e}\nPLOT TIME, {end:e}\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY\nINITIAL VELOCITY MATERIAL, 1, 10., 0., 0.\nGRAVITY, 0., 0., -9.81\n{more}\n\
         MATERIAL, 1, ELASTIC, {DENSITY:?}\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\nEXIT\n"
    )
}

/// Mass from the momentum of the first state, in which all moves at 10 m/s.
fn mass(run: &Run) -> f64 {
    run.lines[0].totals.momentum[0] / 10.0
}

#[test]
fn a_step_that_is_asked_for_is_taken_and_costs_the_mass_of_the_formula() {
    let mesh = bar_with_a_thin_layer();
    let own = SIZE.iter().product::<f64>() * DENSITY;
    let plain = run(&deck(1e-5, "TIME STEP SCALE, 0.9"), &mesh);
    close("mass scaling", "mass without it [kg]", mass(&plain), own, 1e-12);
    let wanted = 1.2 * plain.lines[0].time_step;
    let scaled = run(&deck(1e-5, &format!("TIME STEP SCALE, 0.9\nMASS SCALING, 1, STEP, {wanted:e}, 1.")), &mesh);
    close("mass scaling", "first step over the one asked for", scaled.lines[0].time_step, wanted, 1e-14);
    // Only the thin layer, one tenth of eight: its masses grow with the square of the step.
    let thin = own / 80.0;
    close("mass scaling", "added mass [kg]", mass(&scaled) - mass(&plain), (1.2f64.powi(2) - 1.0) * thin, 1e-10);
    let kinetic = 0.5 * 100.0 * (mass(&scaled) - mass(&plain));
    close("mass scaling", "its kinetic energy [J]", scaled.lines[0].totals.added_kinetic, kinetic, 1e-10);
}

#[test]
fn what_is_added_falls_and_flies_with_the_rest() {
    let end = 2e-4;
    let run = run(&deck(end, "MASS SCALING, ALL, STEP, 1.E-6, 10."), &bar_with_a_thin_layer());
    let last = run.last();
    // The last state is where the next would be farther from the end: its own time counts.
    let weight = mass(&run) * 9.81;
    close("mass scaling", "momentum along, kept", last.totals.momentum[0], run.lines[0].totals.momentum[0], 1e-12);
    close("mass scaling", "momentum of the fall [kg m/s]", last.totals.momentum[2], -weight * last.time, 1e-10);
    for speed in run.end().nodal("VELZ") {
        assert!((speed / (-9.81 * last.time) - 1.0).abs() < 1e-9, "a node falls at {speed}");
    }
    assert!(run.worst_balance() < 1e-10, "the energies do not balance: {}", run.worst_balance());
}

/// Decks in which every kind of element moves, with the density and a command to be filled in.
fn kinds() -> Vec<(&'static str, String, Mesh)> {
    let head = "TITLE\n all kinds\nTERMINATION TIME, 1.E-4\nOUTPUT TIME, 2.E-5\nPLOT TIME, 1.E-4\n\
                PLOT NODAL, DISPLACEMENT, VELOCITY\nFUNCTION, 1\n0., 0.\n2.E-5, 1.\nEND\n";
    let elastic = "ELASTIC, {density}\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";
    let solid =
        format!("{head}PRESSURE, 200, 1, 1.E8\nNO DISPLACEMENT, X, 1\n{{scaling}}\nMATERIAL, 1, {elastic}EXIT\n");
    let shell = format!(
        "{head}SHELL THICKNESS, 1, 2.E-3\nPRESCRIBED FORCE, Z, 2, 1, 50.\nNO DISPLACEMENT, Z, 1\n{{scaling}}\n\
         MATERIAL, 1, {elastic}EXIT\n"
    );
    let beam = format!(
        "{head}BEAM SECTION, 1, RECTANGLE, 0.01, 0.01\nPRESCRIBED FORCE, Y, 2, 1, 50.\nNO DISPLACEMENT, Y, 1\n\
         NO ROTATION, Z, 1\n{{scaling}}\nMATERIAL, 1, {elastic}EXIT\n"
    );
    let plane = format!(
        "{head}AXISYMMETRIC\nPRESCRIBED FORCE, Y, 2, 1, 50.\nNO DISPLACEMENT, Y, 1\n{{scaling}}\nMATERIAL, 1, {elastic}EXIT\n"
    );
    let sheet = recipe(
        "TITLE\n a sheet\nSHEET, 1, 0., 0., 0., 0.1, 0.05, 0., 4, 2\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 0.1\n",
    );
    let line = recipe(
        "TITLE\n a line\nLINE, 1, 0., 0., 0., 0.1, 0., 0., 5\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 0.1\n",
    );
    let section = recipe(
        "TITLE\n a section\nRECTANGLE, 1, 0., 0., 0.02, 0.05, 3, 6\nNODE SET PLANE, 1, Y, 0.\nNODE SET PLANE, 2, Y, 0.05\n",
    );
    vec![
        ("hexahedra", solid, bar_with_a_thin_layer()),
        ("shells", shell, sheet),
        ("beams", beam, line),
        ("quadrilaterals", plane, section),
    ]
}

#[test]
fn four_times_the_mass_is_four_times_the_density_of_an_elastic_body() {
    for (kind, deck, mesh) in kinds() {
        let with = |density: &str, scaling: &str| {
            run(&deck.replace("{density}", density).replace("{scaling}", scaling), &mesh)
        };
        let scaled = with("7850.", "MASS SCALING, ALL, FACTOR, 4., 3.");
        let dense = with("31400.", "");
        let plain = with("7850.", "");
        assert_eq!(scaled.last().step, dense.last().step, "{kind}");
        close(
            "mass scaling",
            &format!("steps of {kind}"),
            plain.last().step as f64,
            2.0 * scaled.last().step as f64,
            0.1,
        );
        for name in ["DISPLX", "DISPLY", "VELX", "VELY"] {
            let [one, other] = [&scaled, &dense].map(|run| run.end().nodal(name));
            let largest = other.iter().fold(0.0f64, |most, value| value.abs().max(most));
            let apart = one.iter().zip(other).fold(0.0f64, |most, (a, b)| (a - b).abs().max(most));
            // Masses are summed in another order: round-off.
            assert!(apart <= 1e-9 * largest, "{name} of {kind}: {apart} of {largest}");
        }
    }
}

#[test]
fn scaled_runs_have_the_same_bits_on_any_ranks_and_after_restarts() {
    let scaled = deck(1e-4, "MASS SCALING, 1, STEP, 1.E-6, 10.");
    let lines = |ranks| {
        let run = run_on(ranks, &scaled, &bar_with_a_thin_layer()).whole();
        run.lines.iter().map(|line| (line.step, line.totals)).collect::<Vec<_>>()
    };
    assert_eq!(lines(1), lines(3));
    let case = Case::new(&scaled, bar_with_a_thin_layer());
    let first = case.part(1, None, 20);
    assert_same("mass scaling", &case.part(2, None, 40), &case.part(3, Some(&first.end), 20));
}

#[test]
fn more_than_the_limit_is_refused_with_what_it_would_be() {
    let desk = Desk::new();
    put_bar(&desk, 1e-5, "");
    desk.put("bar.i", &bar_deck(1e-5, "MASS SCALING, ALL, FACTOR, 1.06\n"));
    for arguments in [&["check", "bar"][..], &["bar"]] {
        let left = desk.urto(arguments).with(2);
        left.says(&[
            "block 1: MASS SCALING: it would gain 0.060 of its mass",
            "0.050 is the most",
            "MASS SCALING, ALL, FACTOR, 1.06",
        ]);
    }
    assert!(!desk.has("bar.e"), "a run that is refused leaves no results");
    desk.put("bar.i", &bar_deck(1e-5, "MASS SCALING, ALL, FACTOR, 1.06, 0.1\n"));
    desk.urto(&["check", "bar"]).with(0).says(&["MASS SCALING adds"]);
    desk.urto(&["bar"]).with(0);
    assert!(desk.text("bar.o").contains("LARGEST FACTOR"));
    let results = desk.results("bar.e");
    assert!(results.global_names().iter().any(|name| name == "ADDMASS"));
}
