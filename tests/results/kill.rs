//! Nothing is lost: a run killed at any instant leaves a file that can be read and whose states are whole.

use crate::program::{Desk, put_bar};
use std::time::Duration;
use urto::exodus::{self, Tolerance};

/// Kills; enough to hit the writing of states, which is most of what this run does, many times.
const KILLS: u64 = 30;

#[test]
fn every_state_written_before_a_kill_can_be_read() {
    let desk = Desk::new();
    put_bar(
        &desk,
        1e-4,
        "PLOT TIME, 1.E-12\nRIGID SURFACE, 100, 0., 0., 0., 0., 0., 1.\nPLOT ELEMENT, STRESS, STRAIN, ENERGY\n",
    );
    let begun = std::time::Instant::now();
    desk.urto(&["bar.i", "-q", "-o", "whole"]).with(0);
    let whole = begun.elapsed().as_micros() as u64;
    let expected = desk.results("whole.e").times().to_vec();
    let mut cut_short = 0;
    for kill in 0..KILLS {
        let mut child = desk.start(&["bar.i", "-q"]);
        // Instants spread over the run by the golden ratio.
        std::thread::sleep(Duration::from_micros((kill * 618_034) % 1_000_000 * whole / 1_000_000));
        child.kill().expect("it can be killed");
        child.wait().expect("it ends");
        if !desk.has("bar.e") {
            continue;
        }
        let times = desk.results("bar.e").times().to_vec();
        assert!(expected.starts_with(&times), "the times are those of the whole run");
        cut_short += usize::from(!times.is_empty() && times.len() < expected.len());
        let comparison =
            exodus::compare(&desk.path("bar.e"), &desk.path("whole.e"), &Tolerance::EXACT).expect("both can be read");
        assert!(comparison.differences.is_empty(), "{comparison}");
        std::fs::remove_file(desk.path("bar.e")).expect("it can be removed");
    }
    assert!(cut_short > 3, "only {cut_short} of {KILLS} kills came while states were written");
}
