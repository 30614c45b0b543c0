//! What an earlier run of the same name has left: it is not taken for the new run's own.

use crate::program::{Desk, Left, box_mesh};

/// A bar that flies, with these lines more.
fn deck(more: &str) -> String {
    format!(
        "TITLE\n flies\nTERMINATION TIME, 2.E-4\nPLOT TIME, 5.E-5\nMATERIAL, 1, ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9\n\
         POISSONS RATIO = 0.3\nEND\n{more}EXIT\n"
    )
}

const VELOCITY: &str = "INITIAL VELOCITY MATERIAL, 1, 3., 0., 0.\n";
const FASTER: &str = "INITIAL VELOCITY MATERIAL, 1, 5., 0., 0.\n";

fn desk() -> Desk {
    let desk = Desk::new();
    desk.put_mesh("m.g", &box_mesh([3, 2, 2], [0.3, 0.1, 0.1], false));
    desk.put("one.i", &deck(&format!("{VELOCITY}WRITE RESTART, 5.E-5, 3\nHISTORY BLOCK, 1\nHISTORY TIME, 1.E-5\n")));
    desk.put("two.i", &deck(FASTER));
    desk.put("on.i", &deck(&format!("{FASTER}READ RESTART\n")).replace("2.E-4", "4.E-4"));
    desk
}

fn run(desk: &Desk, deck: &str, arguments: &[&str]) -> Left {
    desk.urto(&[&[deck, "-m", "m.g", "-r", "1"], arguments].concat())
}

#[test]
fn histories_and_states_of_an_earlier_run_do_not_stay_where_they_would_be_read() {
    let desk = desk();
    let first = run(&desk, "one.i", &["-o", "x"]).with(0);
    assert!(!first.out.contains("earlier run"), "{}", first.out);
    let states = ["x.rsout", "x.rsout.1"].map(|name| std::fs::read(desk.path(name)).expect("a state"));
    run(&desk, "two.i", &["-o", "x"]).with(0).says(&[
        "results of an earlier run of this name are removed: x.h\n",
        "x.rsout of an earlier run of this name is kept as x.rsout.old\n",
    ]);
    assert!(!desk.has("x.h") && !desk.has("x.rsout") && !desk.has("x.rsout.1"));
    let kept = ["x.rsout.old", "x.rsout.old.1"].map(|name| std::fs::read(desk.path(name)).ok());
    assert!(kept == states.map(Some));
    run(&desk, "on.i", &["-o", "x"]).with(2).says(&["there is neither x.rsin nor x.rsout"]);
    // What a run writes itself needs no word.
    run(&desk, "one.i", &["-o", "y"]).with(0);
    let again = run(&desk, "one.i", &["-o", "y"]).with(0);
    assert!(!again.out.contains("removed") && desk.has("y.h") && desk.has("y.rsout"), "{}", again.out);
}

#[test]
fn a_state_is_joined_only_with_results_of_its_own_run() {
    let desk = desk();
    run(&desk, "one.i", &["-o", "x", "-q"]).with(0);
    // The clock of the records ticks in seconds.
    std::thread::sleep(std::time::Duration::from_millis(1100));
    run(&desk, "two.i", &["-o", "y", "-q"]).with(0);
    let strange = ["-o", "y", "-q", "--restart", "x.rsout"];
    run(&desk, "on.i", &strange)
        .with(2)
        .says(&["x.rsout is no state of the run that wrote y.e", "another base with -o"]);
    run(&desk, "on.i", &["-o", "z", "-q", "--restart", "x.rsout"]).with(0);
    // Once more from the same state: the same run goes on beside what it wrote before.
    run(&desk, "on.i", &["-o", "z", "-q", "--restart", "x.rsout"]).with(0);
    assert!(desk.has("z.e-s0002"));
    run(&desk, "on.i", &["-o", "x", "-q"]).with(0);
    assert!(desk.has("x.e-s0002"));
}
