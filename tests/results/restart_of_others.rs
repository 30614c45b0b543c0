//! Decks that ask for something else than the state holds are refused with the reason; what only a start asks for is told to
//! have no effect.

use crate::program::Desk;

/// A deck from parts: what the second one changes, and whether it reads.
fn put(desk: &Desk, end: &str, body: &str) {
    desk.put("m.i", &format!("TITLE\n others\nTERMINATION TIME, {end}\n{body}EXIT\n"));
}

/// The state of a first run, and then what a second one with these changes says.
fn first(desk: &Desk, mesh: &str, body: &str) {
    desk.put("m.mesh", mesh);
    put(desk, "2.E-4", &format!("{body}WRITE RESTART, 1.E-4\n"));
    desk.urto(&["m.i", "-q", "-r", "1", "-o", "first"]).with(0);
}

/// What a second run says, in which `then` is `now`.
#[track_caller]
fn second(desk: &Desk, body: &str, (then, now): (&str, &str), code: i32) -> String {
    assert!(body.contains(then), "{then} is not in the deck");
    put(desk, "4.E-4", &body.replace(then, now));
    let _ = std::fs::remove_file(desk.path("second.e"));
    desk.urto(&["m.i", "-q", "-r", "1", "--restart", "first.rsout", "-o", "second"]).with(code).err
}

#[track_caller]
fn refused(desk: &Desk, body: &str, change: (&str, &str), reason: &str) {
    let said = second(desk, body, change, 2);
    assert!(said.contains("is the state of another problem") && said.contains(reason), "{said}");
}

/// Neither refused nor told to have no effect.
#[track_caller]
fn taken(desk: &Desk, body: &str, change: (&str, &str)) {
    let said = second(desk, body, change, 0);
    assert!(!said.contains("has no effect"), "{said}");
}

const METAL: &str = "ELASTIC, 7800.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";

#[test]
fn layers_of_shells_and_sections_of_beams_stay() {
    let desk = Desk::new();
    let mesh = "TITLE\n others\nSHEET, 1, 0., 0., 0., 1., 1., 0., 2, 2\nLINE, 2, 2., 0., 0., 3., 0., 0., 4\n";
    let body = format!(
        "SHELL THICKNESS, 1, 0.02\nINTEGRATION POINTS, 1, 5\nBEAM SECTION, 2, RECTANGLE, 0.02, 0.04, , , 0., 1., 0.\n\
         INITIAL VELOCITY MATERIAL, 1, 0., 0., 3.\nMATERIAL, 1, {METAL}MATERIAL, 2, {METAL}"
    );
    first(&desk, mesh, &body);
    taken(&desk, &body, ("1, 5", "1, 5, GAUSS"));
    refused(&desk, &body, ("1, 5", "1, 3"), "INTEGRATION POINTS 1: it was 5 by GAUSS, it is 3 by GAUSS");
    refused(&desk, &body, ("1, 5", "1, 5, TRAPEZOID"), "it is 5 by TRAPEZOID");
    let reason = "BEAM SECTION 2: it was RECTANGLE of 0.02 0.04, it is RECTANGLE of 0.04 0.02";
    refused(&desk, &body, ("0.02, 0.04", "0.04, 0.02"), reason);
    let said = second(&desk, &body, ("0., 1., 0.", "0., 0., 1."), 0);
    assert!(said.contains("warning: the vector of BEAM SECTION 2 has no effect after a restart"), "{said}");
    let said = second(&desk, &body, ("0., 0., 3.", "0., 0., 4."), 0);
    assert!(said.contains("warning: INITIAL VELOCITY has no effect after a restart"), "{said}");
    // What is not asked for any more is not missed.
    taken(&desk, &body, ("INITIAL VELOCITY MATERIAL, 1, 0., 0., 3.\n", ""));
}

#[test]
fn equations_of_state_and_their_initial_energy_stay() {
    let desk = Desk::new();
    let body = "MATERIAL, 1, HYDRODYNAMIC, 1.\nPRESSURE CUTOFF = 0.\nEND\nEQUATION OF STATE, 1, IDEAL GAS\nGAMMA = 1.4\n\
                INITIAL ENERGY = 2.5E5\nEND\n";
    first(&desk, "TITLE\n gas\nBOX, 1, 0., 0., 0., 1., 1., 1., 2, 2, 2\n", body);
    taken(&desk, body, ("GAMMA = 1.4", "GAMMA = 1.5"));
    let reason =
        "EQUATION OF STATE 1: it was IDEAL GAS with INITIAL ENERGY 250000, it is IDEAL GAS with INITIAL ENERGY 500000";
    refused(&desk, body, ("2.5E5", "5.E5"), reason);
    let other = "MG US-UP\nC0 = 340.\nS = 1.5\nGAMMA = 2.";
    refused(&desk, body, ("IDEAL GAS\nGAMMA = 1.4", other), "it is MG US-UP with INITIAL ENERGY 250000");
}

#[test]
fn explosives_are_lit_by_their_first_run() {
    let desk = Desk::new();
    let body = "DETONATION POINT, 0., 0., 0.\nMATERIAL, 1, HYDRODYNAMIC, 1630.\nPRESSURE CUTOFF = 0.\nEND\n\
                EQUATION OF STATE, 1, JWL\nA = 371.2E9\nB = 3.231E9\nR1 = 4.15\nR2 = 0.95\nOMEGA = 0.30\n\
                INITIAL ENERGY = 7.0E9\nDETONATION VELOCITY = 6930.\nEND\n";
    first(&desk, "TITLE\n TNT\nBOX, 1, 0., 0., 0., 0.2, 0.02, 0.02, 10, 1, 1\n", body);
    taken(&desk, body, ("0., 0., 0.", "0., 0., 0., 0."));
    let body = format!("{body}READ RESTART\n");
    let said = second(&desk, &body, ("0., 0., 0.", "5., 5., 5., 1."), 0);
    assert!(said.contains("warning: DETONATION POINT has no effect after a restart"), "{said}");
    assert!(!said.contains("is not lit before the run ends"), "{said}");
    let said = second(&desk, &body, ("6930.", "6900."), 0);
    assert!(said.contains("DETONATION VELOCITY and BURN WIDTH of block 1 has no effect after a restart"), "{said}");
}

#[test]
fn what_is_in_contact_stays() {
    let desk = Desk::new();
    let mesh = "TITLE\n two\nBOX, 3, 0., 0., 0., 1., 1., 1., 2, 2, 2\nBOX, 7, 0., 0., 1.01, 1., 1., 1., 2, 2, 2\n";
    let body = format!(
        "CONTACT MATERIAL, 3, 7\nCONTACT DATA, 3, 7, 0.2\nINITIAL VELOCITY MATERIAL, 7, 0., 0., -3.\nMATERIAL, 3, {METAL}MATERIAL, 7, {METAL}"
    );
    first(&desk, mesh, &body);
    // Friction and the order of blocks may change.
    taken(&desk, &body, ("3, 7\nCONTACT DATA, 3, 7, 0.2", "7, 3\nCONTACT DATA, 3, 7, 0.1"));
    let excluded = ("CONTACT DATA, 3, 7, 0.2\n", "CONTACT EXCLUSION, 7, 3\n");
    refused(&desk, &body, excluded, "CONTACT EXCLUSION: it was none, it is 3 from 7");
    assert!(!desk.has("second.e"), "nothing is written");
}
