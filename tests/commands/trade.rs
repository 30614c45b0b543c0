//! The trade of decks: its text, with times masked, and its recommendation, which is run.

use crate::program::{Desk, project};
use serde_json::Value;

/// A text without what depends on the machine: seconds, memory, the front, the variant that puts fast ones together, and what is
/// the cheapest.
fn lasting(table: &str) -> String {
    let mut of_variants = true;
    let mut out = String::new();
    for line in table.trim_end().lines() {
        let cells: Vec<&str> = line.split_whitespace().collect();
        of_variants &= !cells.is_empty();
        if ["together", "The cheapest", "Nothing that was run"].iter().any(|words| line.starts_with(words)) {
            continue;
        }
        // Seconds are the first cell with a point; steps stand behind them, then megabytes.
        let seconds = cells.iter().position(|cell| cell.contains('.') && cell.parse::<f64>().is_ok());
        let machine = |place: usize| {
            seconds.is_some_and(|seconds| place == seconds || place == seconds + 2) || cells[place] == "front"
        };
        let kept: Vec<&str> =
            (0..cells.len()).filter(|&place| !of_variants || !machine(place)).map(|place| cells[place]).collect();
        out += &(kept.join(" ") + "\n");
    }
    out
}

fn golden(name: &str, table: &str) {
    let path = project(&format!("tests/commands/trade_expected/{name}.txt"));
    let text = lasting(table);
    if std::env::var_os("URTO_BLESS").is_some() {
        std::fs::create_dir_all(project("tests/trade")).expect("a folder");
        return std::fs::write(path, text).expect("it can be written");
    }
    let kept = std::fs::read_to_string(path).unwrap_or_default();
    assert_eq!(kept, text, "URTO_BLESS=1 cargo test --test commands trade:: accepts this");
}

/// A bar that strikes a wall and flows, in few elements.
fn put_bar(desk: &Desk) {
    desk.put("bar.mesh", "TITLE\n BAR\nBOX, 1, 0., 0., 0., 0.004, 0.004, 0.02, 2, 2, 8\nNODE SET FACE, 1, 1, LEFT\nNODE SET FACE, 2, 1, FRONT\nNODE SET FACE, 3, 1, BOTTOM\n");
    desk.put(
        "bar.i",
        "TITLE\n A BAR STRIKES\nTERMINATION TIME, 30.E-6\nPLOT TIME, 3.E-6\nHISTORY NODE SET, 3\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 2\n\
         NO DISPLACEMENT, Z, 3\nINITIAL VELOCITY MATERIAL, 1, 0., 0., {speed = -200.}\nMATERIAL, 1, ELASTIC PLASTIC, 8930.\n\
         YOUNGS MODULUS = 117.E9\nPOISSONS RATIO = 0.35\nYIELD STRESS = 400.E6\nHARDENING MODULUS = 100.E6\nEND\nEXIT\n",
    );
}

#[test]
fn a_bar_is_traded_and_the_recommendation_holds() {
    let desk = Desk::new();
    put_bar(&desk);
    let arguments = [
        "trade",
        "bar.i",
        "-D",
        "speed=-150",
        "--levels",
        "2,3",
        "--within",
        "20",
        "--quantity",
        "DISPLACEMENT,IE,RZ_SET3:peak",
        "--write",
        "best.i",
    ];
    let first = desk.urto(&arguments).with(0);
    golden("bar", &desk.text("bar_trade/table.txt"));
    assert!(first.out.contains("The cheapest within 20 %"), "{}", first.out);
    for name in ["front.png", "front.csv", "refinement.png", "table.txt"] {
        assert!(desk.has(&format!("bar_trade/{name}")), "{name}");
    }
    // What is done is not run again, and says the same.
    let again = desk.urto(&arguments).with(0);
    assert!(again.out.contains("deck: done before") && again.out.contains("mesh-3: done before"), "{}", again.out);
    assert_eq!(
        lasting(&desk.text("bar_trade/table.txt")),
        lasting(
            &first.out[first.out.find("VARIANT").expect("a table")..]
                .split("bar_trade")
                .next()
                .map(rows_only)
                .unwrap_or_default()
        )
    );
    // The deck that was written has the values that its variant was judged by.
    let line = first.out.lines().find(|line| line.starts_with("best.i is ")).expect("the deck is told");
    let (variant, mesh) = line["best.i is ".len()..].split_once("; its mesh is ").expect("its mesh is told");
    desk.urto(&["run", "best.i", "-m", mesh, "-q", "--ranks", "2", "--summary", "best.json"]).with(0);
    let read = |name: &str| -> Value { serde_json::from_str(&desk.text(name)).expect("JSON") };
    let [own, judged] = ["best.json".to_string(), format!("bar_trade/{variant}/summary.json")].map(|name| read(&name));
    assert_eq!(own["globals"], judged["globals"], "{variant}");
    assert_eq!(own["steps"], judged["steps"]);
}

/// The table and the words as they stand on the terminal, without the names of what was made.
fn rows_only(text: &str) -> String {
    text.lines().filter(|line| !line.starts_with("best.i")).map(|line| format!("{line}\n")).collect()
}

/// What can be turned in a deck of ours.
fn knobs_of(deck: &str, mesh: &str, change: &[(&str, &str)]) -> Vec<(String, String)> {
    let read = |path: String| std::fs::read_to_string(project(&path)).expect("a file of ours");
    let mut deck = read(format!("decks/{deck}.i"));
    for (old, new) in change {
        assert!(deck.contains(old), "{old}");
        deck = deck.replace(old, new);
    }
    let mesh = crate::support::meshes::recipe(&read(format!("meshes/{mesh}.mesh")));
    let model = crate::support::run::model(&deck, &mesh);
    urto::studies::trade::knobs::variants(&model, &mesh, &[2]).into_iter().map(|v| (v.name, v.words)).collect()
}

#[test]
fn a_scene_has_the_knobs_that_it_needs_and_no_others() {
    let told =
        |knobs: &[(String, String)], name: &str| knobs.iter().find(|knob| knob.0 == name).map(|knob| knob.1.clone());
    let of_plug = knobs_of("perforation", "perforation", &[]);
    let later = "DEATH, 1, EQPS, MAX, 1.250e+00, FREE; DEATH, 1, VOLUME, MIN, 1.600e-01, FREE";
    assert_eq!(told(&of_plug, "later-erosion").as_deref(), Some(later), "{of_plug:?}");
    assert!(told(&of_plug, "sooner-erosion").is_some_and(|words| words.contains("EQPS, MAX, 8.000e-01")));
    let eight = "ELEMENT, 1, EIGHT POINTS; ELEMENT, 2, EIGHT POINTS; ELEMENT, 3, EIGHT POINTS";
    assert_eq!(told(&of_plug, "eight-points").as_deref(), Some(eight));
    assert_eq!(told(&of_plug, "second-order-spin").as_deref(), Some("SPIN, SECOND ORDER"));
    assert_eq!(told(&of_plug, "global-estimate").as_deref(), Some("TIME STEP ESTIMATE, GLOBAL"));
    assert!(told(&of_plug, "search-tree").is_some() && told(&of_plug, "more-points").is_none());
    // What was turned already is turned back.
    let turned = [(
        "CONTACT MATERIAL, 1, 2\n",
        "CONTACT MATERIAL, 1, 2\nTIME STEP ESTIMATE, GLOBAL\nSPIN, SECOND ORDER\nELEMENT, 1, EIGHT POINTS\n",
    )];
    let of_turned = knobs_of("perforation", "perforation", &turned);
    assert_eq!(told(&of_turned, "element-estimate").as_deref(), Some("TIME STEP ESTIMATE, ELEMENT"));
    assert_eq!(told(&of_turned, "first-order-spin").as_deref(), Some("SPIN, FIRST ORDER"));
    assert_eq!(told(&of_turned, "one-point").as_deref(), Some("without ELEMENT"));
    assert_eq!(told(&of_turned, "eight-points").as_deref(), Some(eight));
    // The can is of shells, the plate of hexahedra.
    let of_can = knobs_of("can_crush_shell", "can_crush_shell", &[]);
    assert_eq!(told(&of_can, "more-points").as_deref(), Some("INTEGRATION POINTS, 1, 9, GAUSS"), "{of_can:?}");
    assert_eq!(told(&of_can, "fewer-points").as_deref(), Some("INTEGRATION POINTS, 1, 3, GAUSS"));
    assert!(told(&of_can, "later-erosion").is_none());
    assert_eq!(told(&of_can, "second-order-spin").as_deref(), Some("SPIN, SECOND ORDER"));
    // A gas takes no eight points, has no moduli to bound a step with, no stress that turns, and no contact.
    let of_gas = knobs_of("sedov", "sedov", &[]);
    let names: Vec<&str> = of_gas.iter().map(|knob| &knob.0[..]).collect();
    let expected = [
        "deck",
        "round-off",
        "mesh-2",
        "half-steps",
        "flanagan-belytschko",
        "half-viscosity",
        "no-linear-viscosity",
        "single",
    ];
    assert_eq!(names, expected);
    assert_eq!(told(&of_gas, "half-viscosity").as_deref(), Some("BULK VISCOSITY, 0.03, 0.6"));
}

/// A cube on a cube: contact has knobs.
#[test]
fn contact_has_knobs_and_a_budget_is_kept() {
    let desk = Desk::new();
    desk.put("two.mesh", "TITLE\n TWO\nBOX, 1, 0., 0., 0., 0.01, 0.01, 0.01, 2, 2, 2\nBOX, 2, 0.002, 0.001, 0.0101, 0.006, 0.006, 0.006, 2, 2, 2\nNODE SET FACE, 3, 1, BOTTOM\n");
    desk.put(
        "two.i",
        "TITLE\n TWO CUBES\nTERMINATION TIME, 20.E-6\nPLOT TIME, 2.E-6\nHISTORY BLOCK, 2\nNO DISPLACEMENT, Z, 3\nCONTACT MATERIAL\n\
         INITIAL VELOCITY MATERIAL, 2, 0., 0., -20.\nMATERIAL, 1, ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.3\nEND\n\
         MATERIAL, 2, ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.3\nEND\nEXIT\n",
    );
    let left = desk.urto(&["trade", "two.i", "--levels", "2,3"]).with(0);
    golden("two", &desk.text("two_trade/table.txt"));
    assert!(left.out.contains("no-edges") && left.out.contains("loose-contact"), "{}", left.out);
    // A mesh that no recipe makes is divided; what the budget has no room for is told.
    desk.urto(&["mesh", "two.mesh", "-o", "two.g"]).with(0);
    let brief = desk
        .urto(&[
            "trade",
            "two.i",
            "-m",
            "two.g",
            "-o",
            "brief",
            "--quantity",
            "KE",
            "--levels",
            "2,64",
            "--budget",
            "60s",
        ])
        .with(0);
    assert!(
        brief.out.contains("mesh-2: ") && brief.out.contains("are more than is left of the budget"),
        "{}",
        brief.out
    );
    desk.urto(&["trade", "two.i", "--quantity", "NONE"]).with(2).says(&["the run has no NONE"]);
    desk.urto(&["trade", "two.i", "--budget", "soon"]).with(2).says(&["expected a time such as"]);
    desk.urto(&["trade", "two.i", "--within", "0"]).with(2).says(&["--within is 0"]);
    desk.urto(&["trade", "two.i", "--quantity", "KE:mean"]).with(2).says(&["expected NAME, NAME:last or NAME:peak"]);
}

/// A free bar that 250 N push at each of the four nodes of its end, and whose end carries 20 kg at each: momenta are those of 1000 N and
/// 80 kg on any mesh, made anew or divided, and trade finds nothing to err in.
#[test]
fn forces_and_masses_per_node_keep_their_totals_on_finer_meshes() {
    let desk = Desk::new();
    desk.put("bar.mesh", "TITLE\n BAR\nBOX, 1, 0., 0., 0., 1., 0.1, 0.1, 4, 1, 1\nNODE SET FACE, 2, 1, RIGHT\n");
    desk.put(
        "bar.i",
        "TITLE\n A BAR IS PUSHED\nTERMINATION TIME, 1.E-3\nPLOT TIME, 1.E-3\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\n\
         PRESCRIBED FORCE, X, 2, 1, 250.\nPOINT MASS, 2, 20.\nINITIAL VELOCITY MATERIAL, 1, 0., 0., -1.\n\
         MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.\nEND\nEXIT\n",
    );
    desk.urto(&["mesh", "bar.mesh", "-o", "coarse.g"]).with(0);
    desk.urto(&["refine", "coarse.g", "-o", "fine.g"]).with(0);
    desk.urto(&["refine", "fine.g", "-o", "finest.g"]).with(0);
    desk.urto(&["mesh", "bar.mesh", "--refine", "3", "-o", "three.g"]).with(0);
    for mesh in
        [&["--refine", "2"][..], &["-m", "coarse.g"], &["-m", "fine.g"], &["-m", "finest.g"], &["-m", "three.g"]]
    {
        let said = desk.urto(&[&["run", "bar.i", "-q", "--summary", "s.json"], mesh].concat());
        said.with(0);
        let found: Value = serde_json::from_str(&desk.text("s.json")).expect("JSON");
        let last = |name: &str| found["globals"][name]["last"].as_f64().unwrap_or(f64::NAN);
        assert!((last("XMOM") - 1.0).abs() < 1e-9, "{mesh:?}: {}", last("XMOM"));
        assert!((last("ZMOM") + 158.5).abs() < 1e-9, "{mesh:?}: {}", last("ZMOM"));
    }
    let traded = desk.urto(&["trade", "bar.i", "--levels", "2,4", "--quantity", "XMOM,ZMOM"]).with(0);
    assert!(traded.out.contains("The deck as it is: last XMOM is wrong by"), "{}", traded.out);
    assert!(!traded.out.contains("CONVERGE"), "{}", traded.out);
}
