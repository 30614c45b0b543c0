//! Press fits of which a run that goes on says something else: a fit ends at another time, or is told why not.

use crate::program::{Desk, Left};

/// A rod along z in two parts that overlap by a thousandth of the first, both held at their far ends.
fn desk(overlap: f64) -> Desk {
    let desk = Desk::new();
    desk.put(
        "case.mesh",
        &format!(
            "TITLE\n rods\nBOX, 1, 0., 0., 0., 1., 1., 10., 1, 1, 10\nBOX, 2, 0., 0., {}, 1., 1., 10., 1, 1, 10\n\
             NODE SET PLANE, 1, Z, 0.\nNODE SET PLANE, 1, Z, {}\n",
            10.0 - overlap,
            20.0 - overlap
        ),
    );
    desk
}

fn go(desk: &Desk, (end, treatment): (f64, &str), more: &[&str]) -> Left {
    let steel = "ELASTIC, 7.85E-3\nYOUNGS MODULUS = 210.E3\nPOISSONS RATIO = 0.\nEND\n";
    desk.put(
        "case.i",
        &format!(
            "TITLE\n rods\nTERMINATION TIME, {end}\nPLOT TIME, 1.\nPLOT ELEMENT, STRESS\nNO DISPLACEMENT, Z, 1\nWRITE RESTART, 0.04, 1\n\
             CONTACT MATERIAL\n{treatment}MATERIAL, 1, {steel}MATERIAL, 2, {steel}EXIT\n"
        ),
    );
    desk.urto(&[&["case.i", "-q"], more].concat())
}

/// Mean stress along the rods in the last state.
fn stress(desk: &Desk, results: &str) -> f64 {
    let results = desk.results(results);
    let last = results.times().len() - 1;
    let values = results.element("SIGZZ", last).expect("stress");
    values.iter().sum::<f64>() / values.len() as f64
}

/// Rods of 20 in all that are shortened by 0.01 carry E 0.01/20 = 105, whenever the fit ends. What still swings after a fit of
/// forty transits of a wave, and the shorter one that goes on, is less than a hundredth.
#[test]
fn a_fit_may_end_at_another_time_to_come() {
    let desk = desk(0.01);
    go(&desk, (0.05, "CONTACT OVERLAP, STRESS, 0.16\n"), &["-o", "first"]).with(0);
    for (treatment, name) in [("STRESS, 0.16", "same"), ("STRESS, 0.12", "sooner")] {
        let deck = format!("CONTACT OVERLAP, {treatment}\n");
        go(&desk, (0.2, &deck), &["--restart", "first.rsout", "-o", name]).with(0);
        let found = stress(&desk, &format!("{name}.e"));
        assert!((found / -105.0 - 1.0).abs() < 0.01, "{treatment}: {found}");
    }
    // At 0.04 the fit is not half done: what is left would stay.
    let refused =
        go(&desk, (0.2, "CONTACT OVERLAP, STRESS, 0.03\n"), &["--restart", "first.rsout", "-o", "again"]).with(2);
    refused.says(&["CONTACT OVERLAP, STRESS: its time, 3.0", "is past at 4.", "was to end at 1.6", "ends the fit"]);
    assert!(!desk.has("again.e") && !desk.has("again.o"), "nothing is written");
    // Once it has ended, the same deck goes on.
    go(&desk, (0.05, "CONTACT OVERLAP, STRESS, 0.03\n"), &["-o", "ended"]).with(0);
    let left = go(&desk, (0.06, "CONTACT OVERLAP, STRESS, 0.03\n"), &["--restart", "ended.rsout", "-o", "ended_on"]);
    assert!(!left.with(0).err.contains("CONTACT OVERLAP"), "nothing is told");
    let left =
        go(&desk, (0.06, "CONTACT OVERLAP, STRESS, 0.055\n"), &["--restart", "ended.rsout", "-o", "ended_again"]);
    left.with(0).says(&["CONTACT OVERLAP, STRESS has no effect after a restart: the fit had ended before"]);
}

/// Where nothing overlaps, or overlaps were taken out of the mesh, a fit that a run begins as it goes on has nothing to press.
#[test]
fn a_fit_without_an_overlap_is_told() {
    let touching = desk(0.0);
    go(&touching, (0.05, ""), &["-o", "first"]).with(0);
    let left =
        go(&touching, (0.06, "CONTACT OVERLAP, STRESS, 0.06\n"), &["--restart", "first.rsout", "-o", "on"]).with(0);
    left.says(&["CONTACT OVERLAP, STRESS has no effect after a restart: overlaps had been taken out"]);
    let moved = desk(0.01);
    go(&moved, (0.05, ""), &["-o", "first"]).with(0);
    let left = go(&moved, (0.06, "CONTACT OVERLAP, STRESS, 0.06\n"), &["--restart", "first.rsout", "-o", "on"]).with(2);
    left.says(&["CONTACT OVERLAP takes overlaps out of the mesh in another way now", "CONTACT MATERIAL", "may not"]);
}
