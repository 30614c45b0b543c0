//! `urto check`: what it foretells of a deck, and what it says may not be meant.

use crate::program::{Desk, put_bar};

#[test]
fn check_says_what_each_block_costs() {
    let desk = Desk::new();
    let deck = concat!(env!("CARGO_MANIFEST_DIR"), "/decks/frame.i");
    let told = desk.urto(&["check", deck]).with(0);
    told.says(&["block 1: step ", "ns per element and cycle, ", "% of the time of all elements", "block 2: step "]);
}

/// Beams of four diameters turn with 1.39 times the inertia of their rod, such of one with that itself.
#[test]
fn check_says_where_beams_turn_with_more_than_their_section() {
    let desk = Desk::new();
    desk.put("rod.mesh", "TITLE\n rod\nLINE, 1, 0., 0., 0., 1., 0., 0., {n = 4}\n");
    let deck = "TITLE\n rod\nTERMINATION TIME, 1.E-3\nBEAM SECTION, 1, ROD, 0.03\nMATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.E4\n\
                POISSONS RATIO = 0.3\nEND\nEXIT\n";
    desk.put("rod.i", deck);
    let told = "block 1: beams turn with up to 1.39 times rho (Iy + Iz), torsional frequencies come out up to 15 % low";
    desk.urto(&["check", "rod.i"]).with(0).says(&[told]);
    let fine = desk.urto(&["check", "rod.i", "-D", "n=16"]).with(0);
    assert!(!fine.out.contains("beams turn"), "{}", fine.out);
}

/// A box of 0.2 over a beam whose nodes are 0.25 apart goes through it; with nodes 0.125 apart it does not.
#[test]
fn check_says_what_may_go_through_between_the_nodes_of_bars() {
    let desk = Desk::new();
    let mesh =
        "TITLE\n beam\nLINE, 1, 0., 0., 0., 1., 0., 0., {n = 4}\nBOX, 2, 0.4, -0.1, 0.1, 0.2, 0.2, 0.2, 2, 2, 2\n";
    desk.put("beam.mesh", mesh);
    let law = "ELASTIC, 1.\nYOUNGS MODULUS = 1.E4\nPOISSONS RATIO = 0.3\nEND";
    let deck = format!(
        "TITLE\n beam\nTERMINATION TIME, 1.E-3\nBEAM SECTION, 1, ROD, 0.03\nMATERIAL, 1, {law}\nMATERIAL, 2, {law}\nCONTACT MATERIAL\nEXIT\n"
    );
    desk.put("beam.i", &deck);
    let told = "block 1: bars touch with their nodes only, which are up to 2.500e-01 apart: block 2, 2.000e-01 wide, may go through between them";
    desk.urto(&["check", "beam.i"]).with(0).says(&[told]);
    let fine = desk.urto(&["check", "beam.i", "-D", "n=8"]).with(0);
    assert!(!fine.out.contains("bars touch"), "{}", fine.out);
}

/// A beam that stands on a plate, and not one that lies in it or whose end is held.
#[test]
fn check_says_where_beams_stand_on_shells() {
    let desk = Desk::new();
    let plate = "SHEET, 1, -0.5, -0.5, 0., 1., 1., 0., 4, 4\n";
    let law = "ELASTIC, 1.\nYOUNGS MODULUS = 1.E4\nPOISSONS RATIO = 0.3\nEND";
    let told = |end: &str, more: &str| {
        desk.put(
            "stud.mesh",
            &format!("TITLE\n stud\n{plate}LINE, 2, 0., 0., 0., {end}, 4\nMERGE\nNODE SET POINT, 1, 0., 0., 0.\n"),
        );
        desk.put("stud.i", &format!(
            "TITLE\n stud\nTERMINATION TIME, 1.E-3\nSHELL THICKNESS, 1, 0.02\nBEAM SECTION, 2, ROD, 0.03\n{more}MATERIAL, 1, {law}\n\
             MATERIAL, 2, {law}\nEXIT\n"
        ));
        let left = desk.urto(&["check", "stud.i", "--strict"]).with(0);
        left.out
            .contains("beams stand on shells at node 13 at (0.0000e0, 0.0000e0, 0.0000e0): a torque about the normal")
    };
    assert!(told("0., 0., 0.5", ""));
    assert!(told("0.2, 0., 0.5", ""));
    assert!(!told("0.5, 0., 0.2", ""));
    assert!(!told("0., 0., 0.5", "NO ROTATION, Z, 1\n"));
}

#[test]
fn check_foretells_and_runs_nothing() {
    let desk = Desk::new();
    put_bar(&desk, 1e-3, "NO DISPLACEMENT, X, 1\n");
    desk.urto(&["check", "bar.i"]).with(0).says(&[
        "block 1: 32 elements of ELASTIC, mass 1.0800e-02, dilatational wave speed 6.1978e+03",
        "nodes held still",
        "NO DISPLACEMENT",
        "first time step",
        "set by element",
        "at least",
        "the step shrinks",
        "ns per element and cycle",
        "of memory",
        "deck and mesh are sound",
    ]);
    assert_eq!(std::fs::read_dir(desk.path(".")).expect("the folder").count(), 2);
    put_bar(&desk, 1e-3, "PLO TIM, 1.E-4\nPLO NOD, DIS, VEL, REAC\nPLO ELE, STRE, STRA, PRESS, VON\n");
    let left = desk.urto(&["check", "bar.i"]).with(0);
    assert!(left.out.starts_with("A bar\nmesh bar.g"), "what is modelled comes first:\n{}", left.out);
    left.says(&["assumed: PLOT TIME for `PLO TIM`, ", " and 6 more, which the log of a run lists\n"]);
    put_bar(&desk, 1e-3, "NO DISPLACEMENT, X, 1\n");
    desk.urto(&["check", "bar.i", "--strict"]).with(0);
    put_bar(&desk, 1e-3, "SHELL THICKNESS, 1, 0.1\n");
    desk.urto(&["check", "bar.i"]).with(0).says(&["so that nothing follows from this"]);
    desk.urto(&["check", "bar.i", "--strict"]).with(1).says(&["deck and mesh can be run, but see the warnings"]);
    desk.put("wrong.i", "TITLE\n x\n");
    desk.urto(&["check", "wrong.i", "-m", "bar.g"]).with(2).says(&["TERMINATION TIME", "MATERIAL"]);
}

/// A point in the thickness of a shell is that shell: its history is what the plot file says of it, layer by layer.
#[test]
fn a_material_point_may_lie_in_a_shell() {
    let desk = Desk::new();
    desk.put("sheet.mesh", "TITLE\n sheet\nSHEET, 1, 0., 0., 0., 0.3, 0.3, 0., 3, 3\nNODE SET PLANE, 1, X, 0.\n");
    let deck = "TITLE\n sheet\nTERMINATION TIME, 2.E-4\nPLOT TIME, 1.E-4\nHISTORY TIME, 1.E-4\nPLOT ELEMENT, STRESS\n\
                SHELL THICKNESS, 1, 0.01\nMATERIAL POINT, 0.12, 0.23, 0.004\nMATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\n\
                POISSONS RATIO = 0.3\nEND\nINITIAL VELOCITY MATERIAL, 1, 1., 0., 10.\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Z, 1\n\
                NO ROTATION, Y, 1\nEXIT\n";
    desk.put("sheet.i", deck);
    let left = desk.urto(&["sheet.i", "--quiet"]).with(0);
    assert!(!left.err.contains("no element"), "{}", left.err);
    let (history, plot) = (desk.results("sheet.h"), desk.results("sheet.e"));
    for name in ["SIGXX_B", "SIGXX_M", "SIGXX_T"] {
        let of_point = history.global_history(&format!("{name}_1")).expect("its history");
        // The eighth of nine shells.
        let of_shell = plot.element_history(name, 7).expect("the shell's");
        assert_eq!(of_point.last(), of_shell.last(), "{name}");
        assert!(of_point.last().is_some_and(|stress| *stress != 0.0), "{name} is {of_point:?}");
    }
}
