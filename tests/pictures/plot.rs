//! Curves: what is plotted is what the files hold, whether whole, continued or in pieces, and stands where its numbers
//! put it.

use crate::program::Desk;
use tiny_skia::Pixmap;
use urto::exodus::{ResultsHeader, ResultsWriter};
use urto::mesh::{Block, Mesh};

/// A unit cube whose nodes are numbered 11 to 18 and whose element is 5.
pub fn cube() -> Mesh {
    let corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
    Mesh {
        title: "A cube".to_owned(),
        coordinates: corners.map(|corner| corner.map(f64::from)).to_vec().into(),
        node_ids: (11..=18).collect(),
        element_ids: vec![5],
        blocks: vec![Block::hexahedra_of(1, [[0, 1, 2, 3, 4, 5, 6, 7]])],
        ..Mesh::default()
    }
}

/// Results at some times: KE = t, BAD = NaN or -t, VELX = t at the first node, VELY = 2t, VELZ = 2t; EQPS = t².
pub fn results(desk: &Desk, name: &str, times: &[f64]) {
    results_of(desk, name, times, "00:00:00");
}

/// The same of a run that began at this time of the day.
fn results_of(desk: &Desk, name: &str, times: &[f64], begun: &str) {
    let names = |list: &str| list.split(' ').map(str::to_owned).collect::<Vec<_>>();
    let header = ResultsHeader {
        mesh: &cube(),
        title: "A cube & <its> \"curves\"".to_owned(),
        global: names("KE BAD ONE"),
        nodal: names("VELX VELY VELZ"),
        element: names("EQPS"),
        qa: ["urto", "0", "01/01/26", begun].map(str::to_owned),
        info: Vec::new(),
    };
    let mut writer = ResultsWriter::create(&desk.path(name), &header).expect("a file");
    for (state, &t) in times.iter().enumerate() {
        let bad = if state % 3 == 1 { f64::NAN } else { -t };
        let at = |factor: f64| (0..8).map(|node| if node == 0 { factor * t } else { 0.5 }).collect::<Vec<f64>>();
        writer.write_state(t, &[t, bad, 1.0], &[at(1.0), at(2.0), at(2.0)], &[vec![t * t]]).expect("a state");
    }
}

pub fn csv_text(desk: &Desk, arguments: &[&str]) -> String {
    let all = [&["plot"], arguments, &["--csv", "-o", "out.csv"]].concat();
    desk.urto(&all).with(0);
    desk.text("out.csv")
}

pub fn csv(desk: &Desk, arguments: &[&str]) -> Vec<Vec<f64>> {
    let text = csv_text(desk, arguments);
    let number = |field: &str| if field.is_empty() { f64::NAN } else { field.parse().expect("a number") };
    text.lines().skip(1).map(|line| line.split(',').map(number).collect()).collect()
}

#[test]
fn globals_nodes_elements_and_lengths_of_vectors() {
    let desk = Desk::new();
    results(&desk, "run.e", &[0.0, 0.5, 2.0]);
    let found = csv(&desk, &["run.e", "-v", "ke,VEL,eqps", "--node", "11", "--element", "5"]);
    assert_eq!(found, [[0.0, 0.0, 0.0, 0.0], [0.5, 0.5, 1.5, 0.25], [2.0, 2.0, 6.0, 4.0]]);
    assert_eq!(desk.text("out.csv").lines().next(), Some("time,KE,|VEL| at node 11,EQPS in element 5"));
    let over = csv(&desk, &["run.e", "-v", "EQPS", "--element", "5", "-x", "KE"]);
    assert_eq!(over, [[0.0, 0.0], [0.5, 0.25], [2.0, 4.0]]);
}

#[test]
fn continued_runs_are_one_and_replace_what_they_went_back_behind() {
    let desk = Desk::new();
    results(&desk, "run.e", &[0.0, 1.0, 2.0, 3.0]);
    results(&desk, "run.e-s0002", &[2.0, 2.5, 3.5, 4.5]);
    results(&desk, "run.e-s0003", &[4.0, 5.0]);
    let times: Vec<f64> = csv(&desk, &["run.e", "-v", "KE"]).iter().map(|row| row[0]).collect();
    assert_eq!(times, [0.0, 1.0, 2.0, 2.5, 3.5, 4.0, 5.0]);
    assert_eq!(csv(&desk, &["run.e-s0002", "-v", "KE"]).len(), 4);
}

/// What an earlier run of the same name was continued into is older than the fresh run beside which it lies.
#[test]
fn what_an_earlier_run_left_is_no_part_of_a_fresh_one() {
    let desk = Desk::new();
    results_of(&desk, "run.e-s0002", &[2.0, 3.0], "08:00:00");
    results_of(&desk, "run.e", &[0.0, 1.0, 2.5], "09:00:00");
    let times = |desk: &Desk| -> Vec<f64> { csv(desk, &["run.e", "-v", "KE"]).iter().map(|row| row[0]).collect() };
    assert_eq!(times(&desk), [0.0, 1.0, 2.5]);
    // The fresh run goes on: its part takes the place of the old one.
    results_of(&desk, "run.e-s0002", &[2.0, 4.0], "10:00:00");
    assert_eq!(times(&desk), [0.0, 1.0, 2.0, 4.0]);
}

#[test]
fn differences_derivatives_and_integrals() {
    let desk = Desk::new();
    results(&desk, "a.e", &[0.0, 1.0, 2.0, 3.0]);
    results(&desk, "b.e", &[0.5, 1.5, 2.5]);
    assert_eq!(csv(&desk, &["a.e", "-v", "KE", "--minus", "ONE"])[3], [3.0, 2.0]);
    // Both are KE = t: the difference is zero where both are, and nowhere else.
    assert_eq!(csv(&desk, &["a.e", "-v", "KE", "--minus", "b.e"]), [[1.0, 0.0], [2.0, 0.0]]);
    let slope = csv(&desk, &["a.e", "-v", "EQPS", "--element", "5", "--derive"]);
    assert_eq!(slope.iter().map(|row| row[1]).collect::<Vec<_>>(), [1.0, 2.0, 4.0, 5.0]);
    let area = csv(&desk, &["a.e", "-v", "KE", "--integrate", "--scale", "2"]);
    assert_eq!(area.iter().map(|row| row[1]).collect::<Vec<_>>(), [0.0, 1.0, 4.0, 9.0]);
}

#[test]
fn a_filter_on_too_few_states_is_told() {
    let desk = Desk::new();
    let times: Vec<f64> = (0..400).map(|i| f64::from(i) * 1e-3).collect();
    results(&desk, "run.e", &times);
    let plot = |class: &str, more: &[&str]| {
        desk.urto(&[&["plot", "run.e", "-v", "ONE", "--filter", class, "-o", "f.png"], more].concat())
    };
    assert!(!plot("CFC60", &[]).with(0).err.contains("warning"));
    let told = plot("CFC180", &[]).with(0).err;
    assert!(told.contains("warning: CFC180 on 5.6 states a period") && told.contains("HISTORY TIME"), "{told}");
    assert!(plot("CFC1000", &[]).with(2).err.contains("too far apart"));
    // The same file in milliseconds.
    assert!(!plot("CFC0.06", &["--second", "1"]).with(0).err.contains("warning"));
    assert!(plot("butter", &[]).with(2).err.contains("CFC60"));
}

/// KE = t from 0 to 1 alone on the paper is a straight line from the lower left to near the upper right.
#[test]
fn curves_stand_where_their_numbers_put_them() {
    let desk = Desk::new();
    let times: Vec<f64> = (0..=100_000).map(|i| f64::from(i) / 1e5).collect();
    results(&desk, "run.e", &times);
    desk.urto(&["plot", "run.e", "-v", "KE", "-o", "k.png", "--y-range", "0,1"]).with(0);
    let picture = Pixmap::load_png(desk.path("k.png")).expect("a picture");
    let blue = |x: u32, y: u32| picture.pixel(x, y).is_some_and(|p| p.red() < 60 && p.green() < 140 && p.blue() > 150);
    let spots: Vec<(f64, f64)> = (0..picture.height())
        .flat_map(|y| (0..picture.width()).map(move |x| (x, y)))
        .filter(|&(x, y)| blue(x, y))
        .map(|(x, y)| (f64::from(x), f64::from(y)))
        .collect();
    let left = spots.iter().copied().min_by(|a, b| a.0.total_cmp(&b.0)).expect("a curve");
    let right = spots.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0)).expect("a curve");
    assert!(right.0 - left.0 > 900.0 && left.1 - right.1 > 500.0, "{left:?} {right:?}");
    for (x, y) in spots {
        let on = left.1 + (x - left.0) / (right.0 - left.0) * (right.1 - left.1);
        assert!((y - on).abs() < 3.0, "{x} {y} {on}");
    }
}

#[test]
fn pictures_are_made_of_whatever_there_is() {
    let desk = Desk::new();
    results(&desk, "one.e", &[0.0]);
    results(&desk, "run.e", &[0.0, 1e-300, 1.0, 1e30]);
    desk.put("ref.csv", "t,\"a < b\"\n0,1\n1,2\n");
    for arguments in [
        &["one.e", "-v", "KE"][..],
        &["run.e", "-v", "BAD"],
        &["run.e", "-v", "KE,BAD,ONE", "--right", "VEL*", "--node", "11,12,13,14,15,16,17,18"],
        &["run.e", "-v", "*", "--log", "xy", "--size", "300x200"],
        &["run.e", "one.e", "-v", "ONE", "--x-range", "-5,-4"],
        &["run.e", "-v", "EQPS", "--element", "5", "--title", "", "--reference", "ref.csv"],
        &["run.e"],
    ] {
        for picture in ["p.png", "p.svg"] {
            desk.urto(&[&["plot"], arguments, &["-o", picture]].concat()).with(0);
        }
        Pixmap::load_png(desk.path("p.png")).expect("a picture");
        well_formed(&desk.text("p.svg"));
    }
    assert!(desk.urto(&["plot", "run.e", "-v", "BAD", "--log", "y"]).with(2).err.contains("positive"));
    assert!(!desk.urto(&["plot", "run.e", "--list"]).with(0).out.contains("error"));
}

/// Every tag is closed in its order, and texts have no bare signs of the language.
fn well_formed(svg: &str) {
    let mut open = Vec::new();
    for tag in svg.split('<').skip(1) {
        let (tag, text) = tag.split_once('>').expect("a tag ends");
        assert!(!text.contains('&') || text.contains(';'), "{text}");
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name)),
            None if tag.ends_with('/') => {}
            None => open.push(tag.split(' ').next().expect("a name")),
        }
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
    }
    assert!(open.is_empty(), "{open:?}");
}

#[test]
fn what_is_wrong_is_told() {
    let desk = Desk::new();
    results(&desk, "run.e", &[0.0, 1.0]);
    let wrong = |arguments: &[&str]| desk.urto(&[&["plot"], arguments].concat()).with(2).err;
    assert!(wrong(&["none.e"]).contains("none.e: cannot be read"));
    assert!(wrong(&["run.e", "-v", "KEE"]).contains("did you mean KE?"));
    assert!(wrong(&["run.e", "-v", "VELX"]).contains("--node"));
    assert!(wrong(&["run.e", "-v", "VELX", "--node", "1"]).contains("there is no node 1"));
    assert!(wrong(&["run.e", "-v", "KE", "-o", "x.pdf"]).contains(".png, .svg"));
    assert!(wrong(&["run.e", "-v", "KE", "--derive"]).contains("2 states"));
    assert!(wrong(&["run.e", "-v", "KE", "--second", "0"]).contains("positive"));
    assert!(wrong(&["run.e", "-v", "KE", "--reference", "no.csv"]).contains("no.csv: cannot be read"));
    assert!(wrong(&[]).contains("FILES"));
}

/// Accelerations and forces of histories are means over intervals: they add up to the change of velocity and momentum to
/// round-off, also where intervals are unequal and where a run ended between two states and another one went on from before
/// its end.
#[test]
fn means_are_summed_over_their_intervals() {
    let desk = Desk::new();
    let more = |end: f64, more: &str| {
        let watched = "HISTORY TIME, 3.E-6\nRIGID SURFACE, 100, 0., 0., 0., 0., 0., 1.\nHISTORY, RIGID SURFACE, 100\n\
                       HISTORY BLOCK, 1\nMATERIAL POINT, 0.005, 0.005, 0.01\nWRITE RESTART, 7.E-6, 9\n";
        crate::program::put_bar(&desk, end, &format!("{watched}{more}"));
    };
    more(6e-5, "");
    desk.urto(&["bar.i", "-q", "--ranks", "1", "-o", "whole"]).with(0);
    let names = "ACCLZ_BLOCK1,FZ_WALL100,ACCLZ_1,VELZ_BLOCK1,ZMOM_BLOCK1,VELZ_1";
    let changes = |name: &str| {
        let values = csv(&desk, &[name, "-v", names]);
        let sums = csv(&desk, &[name, "-v", "ACCLZ_BLOCK1,FZ_WALL100,ACCLZ_1", "--integrate"]);
        let intervals: Vec<f64> = values.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
        let most = intervals.iter().copied().fold(0.0, f64::max);
        assert!(intervals.iter().any(|dt| *dt < 0.95 * most), "intervals are alike: {intervals:?}");
        for (sum, row) in sums.iter().zip(&values) {
            for k in 1..=3 {
                let (found, gained) = (sum[k], row[3 + k] - values[0][3 + k]);
                let scale = values.iter().map(|row| (row[3 + k] - values[0][3 + k]).abs()).fold(0.0, f64::max);
                assert!((found - gained).abs() < 1e-12 * scale, "{name}, {k}: {found} is not {gained}");
            }
        }
        values
    };
    let whole = changes("whole.h");
    // What is not a mean is integrated by trapezoids: the displacement is that of the velocity but for the curvature between states.
    let path = csv(&desk, &["whole.h", "-v", "VELZ_BLOCK1", "--integrate"]);
    let moved = csv(&desk, &["whole.h", "-v", "DISPLZ_BLOCK1"]);
    let (path, moved) = (path[path.len() - 1][1], moved[moved.len() - 1][1]);
    assert!((path - moved).abs() < 1e-2 * moved.abs() && path != moved, "{path} {moved}");
    more(4.03e-5, "");
    desk.urto(&["bar.i", "-q", "--ranks", "1"]).with(0);
    let first = csv(&desk, &["bar.h", "-v", "ZMOM_BLOCK1"]).len();
    more(6e-5, "");
    desk.urto(&["bar.i", "-q", "--ranks", "2", "--restart", "bar.rsout"]).with(0);
    assert_eq!(changes("bar.h"), whole, "{first} states before");
}

/// What was asked for only when a run went on has values from there on, and none before.
#[test]
fn a_variable_of_a_later_part_begins_there() {
    let desk = Desk::new();
    let file = |name: &str, names: &[&str], times: &[f64]| {
        let header = ResultsHeader {
            mesh: &Mesh { title: "parts".to_owned(), ..Mesh::default() },
            title: "parts".to_owned(),
            global: names.iter().map(|name| name.to_string()).collect(),
            nodal: Vec::new(),
            element: Vec::new(),
            qa: ["urto", "0", "01/01/26", "00:00:00"].map(str::to_owned),
            info: vec!["$ MEANS OVER INTERVALS: ACCL".to_owned()],
        };
        let mut writer = ResultsWriter::create(&desk.path(name), &header).expect("a file");
        times.iter().for_each(|t| writer.write_state(*t, &vec![*t; names.len()], &[], &[]).expect("a state"));
    };
    file("run.h", &["DISPLX_1"], &[0.0, 1.0]);
    file("run.h-s0002", &["DISPLX_1", "ACCLX_2"], &[2.0, 4.0, 6.0]);
    let text = csv_text(&desk, &["run.h", "-v", "DISPLX_1,ACCLX_2"]);
    assert_eq!(text, "time,DISPLX_1,ACCLX_2\n0,0,\n1,1,\n2,2,2\n4,4,4\n6,6,6\n");
    assert_eq!(csv(&desk, &["run.h", "-v", "ACCLX_2", "--integrate"]), [[2.0, 0.0], [4.0, 8.0], [6.0, 20.0]]);
    assert_eq!(csv(&desk, &["run.h", "-v", "DISPLX_1", "--derive"]).len(), 5);
    desk.urto(&["plot", "run.h", "-v", "ACCLX_2", "-o", "curve.png"]).with(0);
    desk.urto(&["plot", "run.h", "--list"]).with(0).says(&["DISPLX_1, ACCLX_2"]);
    // Histories that the first start had none of.
    file("late.e", &["KE"], &[0.0, 1.0]);
    file("late.e-s0002", &["KE"], &[2.0, 3.0]);
    file("late.h-s0002", &["VELX_1"], &[2.0, 3.0]);
    assert_eq!(csv(&desk, &["late.h", "-v", "VELX_1"]), [[2.0, 2.0], [3.0, 3.0]]);
    desk.urto(&["plot", "none.h", "-v", "VELX_1"]).with(2);
}

/// Material points are numbered by each start of the program: what lies in another element is a curve of its own.
#[test]
fn a_point_that_has_moved_is_not_drawn_on() {
    let desk = Desk::new();
    let file = |name: &str, element: i64, times: &[f64]| {
        let at = format!(
            "MATERIAL POINT 1 AT 0.123456789012345 0.123456789012345 0.123456789012345: ELEMENT {element} OF BLOCK 7"
        );
        let header = ResultsHeader {
            mesh: &Mesh { title: "parts".to_owned(), ..Mesh::default() },
            title: "parts".to_owned(),
            global: ["EQPS_1", "VELX_BLOCK1"].map(str::to_owned).to_vec(),
            nodal: Vec::new(),
            element: Vec::new(),
            qa: ["urto", "0", "01/01/26", "00:00:00"].map(str::to_owned),
            info: vec![at, "MATERIAL POINT 2 AT 0 0 0: ELEMENT 1 OF BLOCK 1".to_owned()],
        };
        let mut writer = ResultsWriter::create(&desk.path(name), &header).expect("a file");
        times.iter().for_each(|t| writer.write_state(*t, &[*t, -t], &[], &[]).expect("a state"));
    };
    file("run.h", 1204, &[0.0, 1.0]);
    file("run.h-s0002", 87, &[2.0, 3.0]);
    let text = csv_text(&desk, &["run.h", "-v", "EQPS_1,VELX_BLOCK1"]);
    let heads = "time,EQPS_1 in element 1204 of block 7,EQPS_1 in element 87 of block 7,VELX_BLOCK1\n";
    assert_eq!(text, format!("{heads}0,0,,-0\n1,1,,-1\n2,,2,-2\n3,,3,-3\n"));
    let told = desk.urto(&["plot", "run.h", "-v", "EQPS_1", "-o", "curve.png"]).with(0);
    told.says(&["warning: run.h: EQPS_1 is of another element since a run went on: a curve for each element"]);
    // The same element as before is one curve.
    file("run.h-s0002", 1204, &[2.0, 3.0]);
    assert_eq!(csv_text(&desk, &["run.h", "-v", "EQPS_1"]), "time,EQPS_1\n0,0\n1,1\n2,2\n3,3\n");
}

/// A picture, a table or a page that a full disk has no room for leaves what was there.
#[cfg(unix)]
#[test]
fn what_cannot_be_written_whole_leaves_what_was_there() {
    let desk = Desk::new();
    results(&desk, "run.e", &[0.0, 1.0, 2.0]);
    let many: Vec<f64> = (0..4000).map(f64::from).collect();
    results(&desk, "long.e", &many);
    for (verb, name, more) in
        [("plot", "out.png", ""), ("plot", "out.csv", "--csv"), ("view", "view.png", ""), ("report", "out.html", "")]
    {
        let ask = |results: &'static str| {
            let mut arguments = vec![verb, results, "-o", name];
            arguments.extend((!more.is_empty()).then_some(more));
            if verb == "plot" {
                arguments.extend(["-v", "KE,ONE"]);
            }
            arguments
        };
        desk.urto(&ask("run.e")).with(0);
        let before = std::fs::read(desk.path(name)).expect("a file");
        let limited = format!("trap '' XFSZ; ulimit -f 1; exec '{}' {}", crate::program::URTO, ask("long.e").join(" "));
        let mut shell = std::process::Command::new("sh");
        let output = shell.args(["-c", &limited]).current_dir(desk.path(".")).output().expect("a shell");
        crate::program::Left::of(output).with(1).says(&["cannot write", name]);
        assert!(std::fs::read(desk.path(name)).expect("still there") == before, "{verb} {name}");
        assert!(!desk.has(&format!("{name}.part")), "{name}");
    }
}

/// A state that only the end of a run was a reason for lies inside an interval over which the run that goes on has means.
#[test]
fn a_state_inside_an_interval_is_none_of_its_ends() {
    let desk = Desk::new();
    let history = |name: &str, info: &[&str], states: &[[f64; 2]]| {
        let header = ResultsHeader {
            mesh: &Mesh { title: "means".to_owned(), ..Mesh::default() },
            title: "means".to_owned(),
            global: vec!["ACCLX_BLOCK1".to_owned()],
            nodal: Vec::new(),
            element: Vec::new(),
            qa: ["urto", "0", "01/01/26", "00:00:00"].map(str::to_owned),
            info: info.iter().map(|line| line.to_string()).collect(),
        };
        let mut writer = ResultsWriter::create(&desk.path(name), &header).expect("a file");
        states.iter().for_each(|[t, mean]| writer.write_state(*t, &[*mean], &[], &[]).expect("a state"));
    };
    let names = "$ MEANS OVER INTERVALS: ACCL";
    history("run.h", &[names], &[[0.0, 0.0], [1.0, 4.0], [1.5, 6.0]]);
    history("run.h-s0002", &[names, "$ MEANS SINCE: 1e0"], &[[2.0, 8.0], [4.0, 1.0]]);
    let summed = || csv(&desk, &["run.h", "-v", "ACCLX_BLOCK1", "--integrate"]);
    assert_eq!(summed(), [[0.0, 0.0], [1.0, 4.0], [2.0, 12.0], [4.0, 14.0]]);
    // Of a file that does not say so nobody knows; and the derivative of means is none.
    history("run.h-s0002", &[], &[[2.0, 8.0], [4.0, 1.0]]);
    assert_eq!(summed(), [[0.0, 0.0], [1.0, 2.0], [1.5, 4.5], [2.0, 8.0], [4.0, 17.0]]);
}
