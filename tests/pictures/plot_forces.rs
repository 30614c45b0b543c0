//! Curves of forces, accelerations and energies against what is known of them.

use super::plot::{csv, cube, results};
use crate::program::Desk;
use urto::exodus::{ResultsHeader, ResultsWriter};

/// The floor's force times the interval that it is the mean of is what the body's momentum gains, and so is what holds the nodes of
/// its side set, as far as samples of it tell; and contact that there is none of cannot be watched.
#[test]
fn the_force_of_a_rigid_surface_is_what_its_nodes_feel() {
    let desk = Desk::new();
    let more = "HISTORY TIME, 1.E-7\nRIGID SURFACE, 100, 0., 0., 0., 0., 0., 1.\nHISTORY, RIGID SURFACE, 100\nHISTORY, NODE SET, 3\n\
                MATERIAL POINT NODE, 1\nHISTORY BLOCK, 1\n";
    crate::program::put_bar(&desk, 1e-5, more);
    desk.urto(&["bar.i", "-q", "--ranks", "2"]).with(0);
    let found = csv(&desk, &["bar.h", "-v", "FZ_WALL100,RZ_SET3,ZMOM_BLOCK1,RZ_NODE1"]);
    let gained = found.last().expect("states")[3] - found[0][3];
    let impulse: f64 = found.windows(2).map(|pair| pair[1][1] * (pair[1][0] - pair[0][0])).sum();
    // Round-off of a hundred states.
    assert!((impulse / gained - 1.0).abs() < 1e-11, "{impulse} {gained}");
    let sampled: f64 = found.windows(2).map(|pair| 0.5 * (pair[0][2] + pair[1][2]) * (pair[1][0] - pair[0][0])).sum();
    // The force jumps at the impact, within a state.
    assert!((sampled / gained - 1.0).abs() < 0.05, "{sampled} {gained}");
    desk.put("wrong.i", &crate::program::bar_deck(1e-5, "HISTORY, RIGID SURFACE, 100\n"));
    desk.urto(&["check", "wrong.i", "-m", "bar.g"]).with(2).says(&["side set 100 meets no rigid surface"]);
    desk.put("wrong.i", &crate::program::bar_deck(1e-5, "HISTORY, CONTACT, 1\n"));
    desk.urto(&["check", "wrong.i", "-m", "bar.g"]).with(2).says(&["the deck has no contact between blocks"]);
}

/// Impulses of contact are the changes of momentum of rigid bodies and of blocks that are tied to others too, and works on
/// what is rigid the change of its kinetic energy.
#[test]
fn contact_tells_what_it_does_to_rigid_and_tied_bodies() {
    let law = |block: i32, density: f64| {
        format!("MATERIAL, {block}, ELASTIC, {density}\nYOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.3\nEND\n")
    };
    let desk = Desk::new();
    // A ball strikes a block aslant, both free; the same on a block that another one is tied to.
    desk.put(
        "ball.mesh",
        "TITLE\n BALL\nBOX, 1, 0., 0., -0.02, 0.04, 0.04, 0.02, 6, 6, 3\nBOX, 3, 0., 0., -0.03, 0.04, 0.04, 0.01, 4, 4, 2\n\
         SPHERE, 2, 0.01, 2, FULL, 1\nTRANSLATE, 2, 0.022, 0.019, 0.0101\nSIDE SET FACE, 100, 1, BOTTOM\nSIDE SET FACE, 300, 3, TOP\n",
    );
    let deck = |more: &str| {
        format!(
            "TITLE\n BALL\nTERMINATION TIME, 4.E-5\nOUTPUT TIME, 1.E-6\nPLOT TIME, 1.E-5\nHISTORY TIME, 7.E-7\nHISTORY BLOCK, 1, 2, 3\n\
             HISTORY CONTACT, 2\nHISTORY CONTACT, 1, 2\nCONTACT MATERIAL, 1, 2\nCONTACT DATA, 1, 2, 0.3\n\
             INITIAL VELOCITY MATERIAL, 2, 20., -30., -60.\n{more}{}{}{}EXIT\n",
            law(1, 2700.0),
            law(2, 7800.0),
            law(3, 2700.0)
        )
    };
    let spin = "INITIAL VELOCITY ANGULAR, 2, 2000., 0.022, 0.019, 0.0101, 1., 0.3, 0.\n";
    for (name, more) in [
        ("rigid", format!("RIGID BODY, 2\n{spin}")),
        ("tied", "TIED CONTACT, 100, 300\n".to_owned()),
        ("both", format!("RIGID BODY, 2\nTIED CONTACT, 100, 300\n{spin}")),
    ] {
        desk.put("ball.i", &deck(&more));
        desk.urto(&["ball.i", "-q", "--ranks", "2", "-m", "ball.mesh"]).with(0);
        for axis in ["X", "Y", "Z"] {
            let forces = format!("F{axis}_CONTACT2,F{axis}_CONTACT1_2");
            let impulses = csv(&desk, &["ball.h", "-v", &forces, "--integrate"]);
            let momenta = csv(&desk, &["ball.h", "-v", &format!("{axis}MOM_*")]);
            let size = momenta[0][2].abs();
            println!("{name} {axis} {:?}", impulses.last());
            for (impulse, now) in impulses.iter().zip(&momenta) {
                let gained: Vec<f64> = (1..=3).map(|k| now[k] - momenta[0][k]).collect();
                let others = gained[0] + gained[2];
                let errors = [impulse[1] - gained[1], impulse[2] - others, impulse[1] + impulse[2]];
                assert!(errors.iter().all(|error| error.abs() < 1e-11 * size), "{name} {axis}: {impulse:?} {gained:?}");
            }
            assert!(axis != "Z" || impulses[impulses.len() - 1][1].abs() > 0.5 * size, "{name}: nothing happened");
        }
        let energies = csv(&desk, &["ball.h", "-v", "KE_BLOCK2,WORK1_CONTACT2,WORK2_CONTACT1_2"]);
        if name != "tied" {
            for now in &energies {
                let (gained, first) = (now[1] - energies[0][1], energies[0][1]);
                assert!((gained - now[2]).abs() < 1e-11 * first && now[2] == now[3], "{name}: {gained} {now:?}");
            }
        }
    }
}

/// A short blow of impulse J gives a filtered peak of J h(0), whose h(0) = ∫ df / (1 + (f/f_c)⁴) = f_c π/√2 is that of both passes of
/// the filter, f_c 2.0775 times the class. When the run begins does not matter: at the wall, or 2 ms before it.
#[test]
fn a_blow_that_begins_with_the_run_is_filtered_as_one_that_comes_later() {
    let desk = Desk::new();
    desk.put("bar.mesh", "TITLE\n BAR\nBOX, 1, 0., 0., 0., .02, .02, .1, 1, 1, 10\nSIDE SET FACE, 100, 1, BOTTOM\n");
    let corner = 2.0775 * 180.0;
    for gap in [0.0, 0.01] {
        let deck = format!(
            "TITLE\n BAR ON A WALL\nTERMINATION TIME, 0.01\nHISTORY TIME, 2.E-5\nHISTORY RIGID SURFACE, 100\nHISTORY BLOCK, 1\n\
             INITIAL VELOCITY MATERIAL, 1, 0., 0., -5.\nRIGID SURFACE, 100, 0., 0., -{gap:?}, 0., 0., 1.\n\
             MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.\nEND\n"
        );
        desk.put("bar.i", &deck);
        desk.urto(&["run", "bar.i", "-q"]).with(0);
        let last = |rows: &[Vec<f64>]| rows.last().map_or(f64::NAN, |row| row[1]);
        let peak = |rows: &[Vec<f64>]| rows.iter().map(|row| row[1]).fold(f64::NEG_INFINITY, f64::max);
        for variable in ["FZ_WALL100", "ACCLZ_BLOCK1"] {
            let blow = last(&csv(&desk, &["bar.h", "-v", variable, "--integrate"]));
            let found = peak(&csv(&desk, &["bar.h", "-v", variable, "--filter", "CFC180"]));
            let expected = blow * corner * std::f64::consts::PI / std::f64::consts::SQRT_2;
            assert!(
                blow > 0.0 && (found / expected - 1.0).abs() < 0.01,
                "{variable}, {gap}: {found} is not {expected}"
            );
        }
        let derived = peak(&csv(&desk, &["bar.h", "-v", "VELZ_BLOCK1", "--derive", "--filter", "CFC180"]));
        let own = peak(&csv(&desk, &["bar.h", "-v", "ACCLZ_BLOCK1", "--filter", "CFC180"]));
        assert!((derived / own - 1.0).abs() < 0.01, "{derived} {own}");
    }
}

#[test]
fn what_falls_freely_has_its_weight_from_the_beginning() {
    let desk = Desk::new();
    desk.put("bar.mesh", "TITLE\n BAR\nBOX, 1, 0., 0., 0., .02, .02, .1, 1, 1, 5\n");
    let deck = "TITLE\n FREE FALL\nTERMINATION TIME, 0.01\nHISTORY TIME, 1.E-4\nHISTORY BLOCK, 1\nGRAVITY, 0., 0., -9.81\n\
                INITIAL VELOCITY MATERIAL, 1, 0., 0., -5.\n\
                MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";
    desk.put("bar.i", deck);
    desk.urto(&["run", "bar.i", "-q"]).with(0);
    let found = csv(&desk, &["bar.h", "-v", "ACCLZ_BLOCK1", "--filter", "CFC180"]);
    assert!(found.len() > 90 && found.iter().all(|row| (row[1] + 9.81).abs() < 1e-6), "{found:?}");
}

/// What README shows: a plot file and its history, of which only one has energies.
#[test]
fn the_energies_of_a_plot_file_are_drawn_beside_a_history_without() {
    let desk = Desk::new();
    results(&desk, "run.e", &[0.0, 0.5, 2.0]);
    let header = ResultsHeader {
        mesh: &cube(),
        title: "A cube".to_owned(),
        global: vec!["VELX_1".to_owned()],
        nodal: Vec::new(),
        element: Vec::new(),
        qa: ["urto", "0", "01/01/26", "00:00:00"].map(str::to_owned),
        info: Vec::new(),
    };
    let mut writer = ResultsWriter::create(&desk.path("run.h"), &header).expect("a file");
    [0.0, 1.0].into_iter().for_each(|t| writer.write_state(t, &[3.0], &[], &[]).expect("a state"));
    for files in [["run.e", "run.h"], ["run.h", "run.e"]] {
        assert_eq!(csv(&desk, &files), [[0.0, 0.0], [0.5, 0.5], [2.0, 2.0]]);
        assert_eq!(desk.text("out.csv").lines().next(), Some("time,run.e: KE"));
    }
    desk.urto(&["plot", "run.h", "-o", "h.png"]).with(2).says(&["VELX_1"]);
}
