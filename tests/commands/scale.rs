//! `urto scale`, and what the log says of ranks: counts against those of a cut that can be done by hand.

use crate::program::{Desk, project, put_bar};

/// One column of a table of comma-separated values.
fn column(table: &str, name: &str) -> Vec<f64> {
    let mut lines = table.lines();
    let place = lines.next().unwrap_or("").split(',').position(|own| own == name).expect(name);
    let number = |line: &str| line.split(',').nth(place).and_then(|cell| cell.parse().ok()).expect("a number");
    lines.map(number).collect()
}

/// The bar has 8 layers of 2 x 2 elements. Each cut shares one layer of nodes, to which 4 elements on either side
/// contribute 4 corners of 3 numbers of 8 bytes.
const SECTION: f64 = 4.0 * 4.0 * 3.0 * 8.0;

#[test]
fn a_bar_in_slices_sends_what_its_sections_need() {
    let desk = Desk::new();
    put_bar(&desk, 1.0, "");
    let left = desk.urto(&["scale", "bar.i", "--ranks", "1,2,4", "--steps", "3", "--csv", "bar.csv"]).with(0);
    left.says(&["the first 3 steps", "machine cluster", "effi-"]);
    assert!(!desk.has("bar.e") && !desk.has("bar.o"), "no results are written");
    let table = desk.text("bar.csv");
    assert_eq!(column(&table, "elements_max"), [32.0, 16.0, 8.0]);
    assert_eq!(column(&table, "messages_min"), [0.0, 1.0, 1.0]);
    assert_eq!(column(&table, "messages_mean"), [0.0, 1.0, 1.5]);
    assert_eq!(column(&table, "messages_max"), [0.0, 1.0, 2.0]);
    assert_eq!(column(&table, "bytes_max"), [0.0, SECTION, 2.0 * SECTION]);
    assert_eq!(column(&table, "collectives"), [0.0, 1.0, 1.0]);
}

#[test]
fn costs_are_those_that_were_given() {
    let desk = Desk::new();
    put_bar(&desk, 1.0, "");
    let costs = ["--element-cost", "10", "--latency", "3", "--bandwidth", "1", "--machine", "paragon"];
    let study = ["scale", "bar.i", "--ranks", "1,4", "--steps", "2", "--csv", "bar.csv"];
    desk.urto(&[&study[..], &costs].concat()).with(0);
    let seconds = column(&desk.text("bar.csv"), "seconds_step");
    // 8 elements of 10 us, two messages of 3 us and a byte a microsecond, and a call of two rounds of 3 us and 24 bytes.
    let expected = [320e-6, 80e-6 + 6e-6 + 2e-6 * SECTION + 6e-6 + 48e-6];
    assert!(seconds.iter().zip(expected).all(|(found, right)| (found - right).abs() < 1e-12), "{seconds:?}");
    let efficiency = column(&desk.text("bar.csv"), "efficiency");
    assert!((efficiency[1] - expected[0] / (4.0 * expected[1])).abs() < 1e-12);
}

#[test]
fn a_thousand_ranks_fit_into_one_process() {
    let desk = Desk::new();
    put_bar(&desk, 1.0, "CONTACT MATERIAL, 1\n");
    desk.urto(&["scale", "bar.i", "--ranks", "1024", "--steps", "2", "--csv", "bar.csv"]).with(0);
    let table = desk.text("bar.csv");
    assert_eq!((column(&table, "elements_min"), column(&table, "elements_max")), (vec![0.0], vec![1.0]));
}

#[test]
fn meshes_grow_with_the_ranks() {
    let desk = Desk::new();
    let deck = project("decks/bending_beam_scaled.i").display().to_string();
    desk.urto(&["scale", &deck, "--scaled", "--ranks", "1,2,4", "--steps", "1", "--csv", "beam.csv"]).with(0);
    let table = desk.text("beam.csv");
    assert_eq!(column(&table, "total_elements"), [6480.0, 12960.0, 25920.0]);
    assert_eq!(column(&table, "elements_max"), [6480.0; 3]);
    for (name, elements) in [("bending_beam", 6480), ("brick_wall", 1890), ("can_crush", 1875)] {
        let recipe = project(&format!("meshes/{name}_scaled.mesh")).display().to_string();
        let size = |ranks: usize| format!(" {} elements", ranks * elements);
        desk.urto(&["mesh", &recipe, "-o", "x.g"]).with(0).says(&[&size(1)]);
        for ranks in [1, 2, 4, 8, 16] {
            desk.urto(&["mesh", &recipe, "-o", "x.g", "--ranks", &ranks.to_string()]).with(0).says(&[&size(ranks)]);
        }
    }
}

#[test]
fn wrong_options_are_answered() {
    let desk = Desk::new();
    put_bar(&desk, 1.0, "");
    for (wrong, words) in [
        (&["--ranks", "0"][..], &["--ranks", "1..=1024"][..]),
        (&["--ranks", "1,two"], &["--ranks", "two"]),
        (&["--ranks", "1,2048"], &["2048"]),
        (&["--steps", "0"], &["--steps"]),
        (&["--machine", "cray"], &["cray", "paragon", "cluster"]),
        (&["--latency", "0"], &["--latency", "above 0"]),
        (&["--bandwidth", "inf"], &["--bandwidth", "above 0"]),
        (&["--element-cost", "-1"], &["--element-cost", "above 0"]),
        (&["--scaled", "--ranks", "1,2", "--steps", "1"], &["32 elements for 1 and for 2 ranks", "{18 * ranks}"]),
    ] {
        let arguments = [&["scale", "bar.i"], wrong].concat();
        desk.urto(&arguments).with(2).says(words);
    }
    desk.urto(&["scale", "nothing.i"]).with(2).says(&["there is no deck nothing.i"]);
    let unwritable = ["scale", "bar.i", "--ranks", "1", "--steps", "1", "--csv", "no/such/bar.csv"];
    desk.urto(&unwritable).with(1).says(&["cannot write no/such/bar.csv"]);
    // A deck that cannot go on says where and what to try, as a run of it does.
    let crush = "NO DISPLACEMENT, Z, 3\nFUNCTION, 1\n0., 0.\n1.E-6, 1.\nEND\nPRESCRIBED DISPLACEMENT, Z, 4, 1, -0.03\n";
    put_bar(&desk, 1.0, crush);
    desk.urto(&["scale", "bar.i", "--ranks", "2"]).with(1).says(&["the run would stop", "of block 1", "help:"]);
}

#[test]
fn the_log_tells_what_ranks_say_to_each_other() {
    let desk = Desk::new();
    put_bar(&desk, 1e-5, "");
    let row = |base: &str, name: &str| -> Option<Vec<f64>> {
        let log = desk.text(&format!("{base}.o"));
        let line = log.lines().skip_while(|line| !line.contains("OVER ALL RANKS")).find(|line| line.contains(name))?;
        let numbers = line.split_whitespace().rev().take(3).map(|cell| cell.parse().expect("a number"));
        Some(numbers.collect::<Vec<f64>>().into_iter().rev().collect())
    };
    desk.urto(&["bar.i", "-q", "--ranks", "4", "-o", "four"]).with(0);
    assert_eq!(row("four", " ELEMENTS  "), Some(vec![8.0, 8.0, 8.0]));
    assert_eq!(row("four", "MESSAGES FOR ELEMENTS"), Some(vec![1.0, 1.5, 2.0]));
    assert_eq!(row("four", "BYTES FOR ELEMENTS"), Some(vec![SECTION, 1.5 * SECTION, 2.0 * SECTION]));
    assert_eq!(row("four", "CALLS OF ALL FOR STEP"), Some(vec![1.0; 3]));
    desk.urto(&["bar.i", "-q", "--ranks", "1", "-o", "one"]).with(0);
    assert_eq!(row("one", " ELEMENTS  "), Some(vec![32.0; 3]));
    assert_eq!(row("one", "MESSAGES"), None);
}
