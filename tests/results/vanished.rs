//! Results that are removed or moved away while a run writes them: the run says so at its end, and does not end well.

use crate::program::{Desk, Left, put_bar, wait_for};
use std::path::Path;

/// A run that is disturbed once it has written a few states.
fn disturbed(arguments: &[&str], disturb: impl Fn(&Path)) -> Left {
    let desk = Desk::new();
    put_bar(&desk, 5e-4, "PLOT TIME, 1.E-9\nHISTORY BLOCK, 1\nRIGID SURFACE, 100, 0., 0., 0., 0., 0., 1.\n");
    let child = desk.start(&[&["bar.i", "-o", "out/"], arguments].concat());
    let out = desk.path("out");
    let begun = |name: &str| out.join(name).metadata().is_ok_and(|about| about.len() > 100_000);
    assert!(wait_for(|| begun("bar.e") || begun("bar.e.2.0")), "no states are written");
    disturb(&out);
    Left::of(child.wait_with_output().expect("it ends"))
}

#[test]
fn results_that_nobody_finds_are_no_results() {
    let gone = |name: &'static str| move |out: &Path| std::fs::remove_file(out.join(name)).expect("a file");
    let all = ["cannot keep", "it was removed or moved away while it was written"];
    for name in ["bar.e", "bar.h"] {
        disturbed(&["-r", "2"], gone(name)).with(1).says(&[&all[..], &[name]].concat());
    }
    disturbed(&["-r", "2"], gone("bar.o")).with(1).says(&["bar.o", all[1]]);
    disturbed(&["-r", "2", "--split"], gone("bar.e.2.1")).with(1).says(&[&all[..], &["bar.e.2.1"]].concat());
    let moved = |out: &Path| std::fs::rename(out, out.with_file_name("elsewhere")).expect("a folder");
    disturbed(&["-r", "1"], moved).with(1).says(&[&all[..], &["bar.e"]].concat());
    let replaced = |out: &Path| {
        std::fs::remove_file(out.join("bar.e")).expect("a file");
        std::fs::write(out.join("bar.e"), "another").expect("a file");
    };
    disturbed(&["-r", "1"], replaced).with(1).says(&["bar.e", "another file has taken its name"]);
    disturbed(&["-r", "1"], |_| ()).with(0);
}
