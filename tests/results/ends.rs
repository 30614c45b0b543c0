//! Restart files of runs whose end was near and recedes: the last twenty steps are alike, and may become thousands.

use crate::program::Desk;
use crate::restart_files::assert_tail;

/// A block that is pressed to a hundredth of its length within twelve of its first steps, as many as are left from the start.
fn crushed() -> Desk {
    let desk = Desk::new();
    let elastic = |block: u32, modulus: &str| {
        format!("MATERIAL, {block}, ELASTIC, 7800.\nYOUNGS MODULUS = {modulus}\nPOISSONS RATIO = 0.\nEND\n")
    };
    let deck = "TITLE\n crushed\nTERMINATION TIME, 2.4E-5\nOUTPUT TIME, 1.E-6\nPLOT TIME, 1.E-6\nWRITE RESTART, 2.E-6, 20\n\
                NO DISPLACEMENT, Y, 3\nNO DISPLACEMENT, Z, 3\nNO DISPLACEMENT, X, 1\n\
                PRESCRIBED DISPLACEMENT, X, 2, 1, -0.00198\nFUNCTION, 1\n0., 0.\n4.E-6, 0.\n8.E-6, 1.\nEND\n";
    desk.put("case.i", &format!("{deck}{}{}EXIT\n", elastic(1, "200.E9"), elastic(2, "2.E9")));
    desk.put(
        "case.mesh",
        "TITLE\n crushed\nBOX, 1, 0., 0., 0., 0.1, 0.02, 0.02, 5, 1, 1\nBOX, 2, 0., 0.1, 0., 0.002, 0.002, 0.002, 1, 1, 1\n\
         NODE SET BLOCK, 3\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 0.002, 2\n",
    );
    desk
}

/// States are written at their intervals, although the end was within twenty steps at the start, and go on to the bit.
#[test]
fn states_are_written_while_the_end_recedes() {
    let desk = crushed();
    desk.urto(&["case.i", "-q"]).with(0);
    let log = desk.text("case.o");
    let written = log.lines().filter(|line| line.contains("RESTART FILE WRITTEN"));
    let times: Vec<f64> =
        written.filter_map(|line| line.split_whitespace().nth(5)?.trim_end_matches(',').parse().ok()).collect();
    // From 8 microseconds on the block is short, and each of its intervals thousands of steps.
    for time in [10e-6, 12e-6, 14e-6, 16e-6, 18e-6, 20e-6, 22e-6] {
        assert!(times.iter().any(|written| (written - time).abs() < 5e-8), "{time}: {times:?}");
    }
    let deck = desk.text("case.i");
    desk.put("again.i", &deck.replace("EXIT", "READ RESTART, 16.E-6\nEXIT"));
    desk.urto(&["again.i", "-m", "case.mesh", "-q", "--ranks", "2", "--restart", "case.rsout"]).with(0);
    assert_tail(&desk.path("case.e"), &desk.path("again.e"));
}
