//! A run that is continued from a restart has the same bits as one that never stopped, on any number of ranks.

use crate::support::collapsed::{pyramids, wedges};
use crate::support::continued::{Case, Part, assert_same};
use crate::support::meshes::{add_side_set, recipe};
use std::path::{Path, PathBuf};
use urto::deck::Source;
use urto::material::MATERIALS;
use urto::mesher::make_with_warnings;
use urto::model::Deletion;

/// Numbers of ranks that write and read.
const RANKS: [usize; 3] = [1, 2, 5];

const PLATE: &str = "YOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 400.E6\nHARDENING MODULUS = 1.E9\n";

/// A small rod that goes through a clamped plate: contact of faces and edges with friction, erosion with free nodes,
/// plasticity, a rigid floor, and every load there is.
fn punch() -> Case {
    let mesh = recipe(
        "TITLE\n punch\nTOLERANCE, 1.E-6\n\
         BOX, 1, -0.012, -0.012, -0.002, 0.024, 0.024, 0.002, 12, 12, 2\n\
         BOX, 2, -0.004, -0.004, 1.E-5, 0.008, 0.008, 0.012, 4, 4, 4\nROTATE, 2, Z, 20.\n\
         NODE SET FACE, 1, 1, LEFT\nNODE SET FACE, 2, 2, TOP\nNODE SET FACE, 3, 1, RIGHT\n\
         SIDE SET FACE, 100, 1, BOTTOM\nSIDE SET FACE, 200, 2, TOP\nSIDE SET FACE, 300, 1, FRONT\n",
    );
    let material = |block: usize| format!("MATERIAL, {block}, ELASTIC PLASTIC, 7850.\n{PLATE}BETA = 0.5\nEND\n");
    let deck = format!(
        "TITLE\n punch\nTERMINATION TIME, 1.E-3\nPLOT TIME, 1.E-5\n\
         PLOT NODAL, VELOCITY, ACCELERATION, REACTION, CONTACT\nPLOT ELEMENT, STRESS, STRAIN, ENERGY\nPLOT STATE, EQPS\n\
         {}{}FUNCTION, 1\n0., 1.\n1., 1.\nEND\n\
         INITIAL VELOCITY MATERIAL, 2, 10., 0., -300.\nPRESCRIBED VELOCITY, Z, 2, 1, -300.\n\
         NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n\
         PRESCRIBED FORCE, Y, 3, 1, 100.\nPRESCRIBED FORCE, Y, 3, 1, 50.\n\
         PRESSURE, 200, 1, 1.E7\nPRESSURE, 100, 1, 1.E6\nPRESSURE, 100, 1, 2.E6\n\
         GRAVITY, 0., 0., -9.81, 1\nSILENT BC, 300\n\
         RIGID SURFACE, 100, 0., 0., -0.004, 0., 0., 1., 0.2\n\
         CONTACT MATERIAL\nCONTACT DATA, 1, 2, 0.2\nCONTACT DATA, 1, 1, 0.2\n\
         DEATH, 1, EQPS, MAX, 0.25\nDEATH, 1, VOLUME, MIN, 0.2\nDEATH, 2, EQPS, MAX, 0.2, DROP\nEXIT\n",
        material(1),
        material(2)
    );
    Case::new(&deck, mesh)
}

/// The same, and a block that is deleted in the middle of it, with the debris that it has left.
fn punch_with_deletion(time: f64) -> Case {
    let Case { mesh, mut model, body } = punch();
    model.deletions.push(Deletion { block: 1, time });
    Case { mesh, model, body }
}

/// Two cubes that meet on crossing edges, and are pressed together.
fn crossing_edges() -> Case {
    let half = 0.01 / 2f64.sqrt();
    let cube = |block: usize, axis: &str, z: f64| {
        format!(
            "BOX, {block}, -0.005, -0.005, -0.005, 0.01, 0.01, 0.01, 3, 3, 3\nROTATE, {block}, {axis}, 45.\n\
             TRANSLATE, {block}, 0., 0., {z}\nNODE SET BLOCK, {block}, {block}\n"
        )
    };
    let mesh = recipe(&format!("TITLE\n cubes\n{}{}", cube(1, "X", -half - 1e-6), cube(2, "Y", half + 1e-6)));
    let material = |block: usize| format!("MATERIAL, {block}, ELASTIC PLASTIC, 7850.\n{PLATE}END\n");
    let deck = format!(
        "TITLE\n cubes\nTERMINATION TIME, 1.E-3\nPLOT TIME, 1.E-5\nPLOT NODAL, VELOCITY, CONTACT\n{}{}\
         FUNCTION, 1\n0., 1.\n1., 1.\nEND\nPRESCRIBED FORCE, Z, 1, 1, 100.\nPRESCRIBED FORCE, Z, 2, 1, -100.\n\
         INITIAL VELOCITY MATERIAL, 1, 3., 0., 20.\nCONTACT MATERIAL\nCONTACT DATA, 1, 2, 0.3\nEXIT\n",
        material(1),
        material(2)
    );
    Case::new(&deck, mesh)
}

/// Rows of a list at the end of a part.
fn rows(part: &Part, name: &str) -> usize {
    part.end.lists.iter().find(|list| list.name == name).map_or(0, |list| list.values.len() / list.width)
}

/// Writes after some steps on some numbers of ranks and reads on others; `lists` is what there must be to write.
fn matrix(case: &Case, steps: [usize; 2], lists: &[&str]) {
    let whole = case.part(1, None, steps[0] + steps[1]);
    for writing in RANKS {
        let first = case.part(writing, None, steps[0]);
        for name in lists {
            assert!(rows(&first, name) > 0, "{name}: the case is meant to have some");
        }
        for reading in RANKS {
            let second = case.part(reading, Some(&first.end), steps[1]);
            assert_same(&format!("written by {writing} ranks, read by {reading}"), &whole, &second);
        }
    }
}

#[test]
fn contact_erosion_and_all_loads_on_any_number_of_ranks() {
    let lists = [
        "DEAD",
        "DEADE",
        "CONTTOUCH",
        "CONTFREE",
        "CONTWORK",
        "CONTLOST",
        "PRESSUREW",
        "FORCEW",
        "MOTIONW",
        "GRAVITYW",
        "SILENTW",
    ];
    matrix(&punch(), [91, 66], &lists);
}

#[test]
fn a_block_that_is_deleted_before_or_after_the_restart() {
    let time = |steps: usize| punch().part(1, None, steps).end.time();
    matrix(&punch_with_deletion(time(110)), [91, 60], &["CONTFREE"]);
    matrix(&punch_with_deletion(time(80)), [91, 30], &["DELETED", "DEAD"]);
}

#[test]
fn edges_that_touch_on_any_number_of_ranks() {
    matrix(&crossing_edges(), [60, 40], &["CONTEDGES"]);
}

/// All that contact is about has gone before the restart, or goes after it; the bar stays on its rough wall.
#[test]
fn a_wall_alone_on_any_number_of_ranks() {
    let deck = format!(
        "TITLE\n plate and bar\nTERMINATION TIME, 1.E-3\nPLOT TIME, 1.E-5\nPLOT NODAL, VELOCITY, CONTACT\n\
         CONTACT MATERIAL, 1\nDELETE MATERIAL, 1, 20.E-6\nINITIAL VELOCITY MATERIAL, 2, 10., 5., -100.\n\
         RIGID SURFACE, 100, 0., 0., 0., 0., 0., 1., 0.2\n\
         MATERIAL, 1, ELASTIC PLASTIC, 7850.\n{PLATE}END\nMATERIAL, 2, ELASTIC PLASTIC, 7850.\n{PLATE}END\nEXIT\n"
    );
    let mesh = || {
        recipe(
            "TITLE\n plate and bar\nBOX, 1, 0.02, 0., 0.005, 0.01, 0.01, 0.01, 2, 2, 2\n\
             BOX, 2, 0., 0., 0., 0.01, 0.01, 0.04, 2, 2, 8\nSIDE SET FACE, 100, 2, BOTTOM\n",
        )
    };
    for steps in [[15, 40], [40, 20]] {
        matrix(&Case::new(&deck, mesh()), steps, &["CONTWORK"]);
    }
}

/// Wedges and pyramids, whose masses and bounds of the step are their own, with some of them gone before the restart.
#[test]
fn collapsed_elements_on_any_number_of_ranks() {
    let deck = format!(
        "TITLE\n cut\nTERMINATION TIME, 1.E-3\nPLOT TIME, 1.E-5\nPLOT NODAL, VELOCITY, MASS\nPLOT ELEMENT, STRESS, ENERGY\n\
         INITIAL VELOCITY MATERIAL, 1, 20., 0., -200.\nRIGID SURFACE, 100, 0., 0., 0., 0., 0., 1., 0.2\n\
         CONTACT MATERIAL\nDEATH, 1, EQPS, MAX, 0.06\nDEATH, 1, TMSTEP, MIN, 1.E-9\n\
         MATERIAL, 1, ELASTIC PLASTIC, 7850.\n{PLATE}END\nEXIT\n"
    );
    for cut in [wedges, pyramids] {
        let mut mesh = cut(&recipe("TITLE\n bar\nBOX, 1, 0., 0., 0., 0.01, 0.01, 0.06, 3, 3, 18\n"));
        add_side_set(&mut mesh, 100, |x| x[2] < 1e-9);
        matrix(&Case::new(&deck, mesh), [40, 40], &["DEAD", "CONTWORK"]);
    }
}

/// Every deck of the project, as far as some steps go: written on 2 ranks, read on 3, against one rank that never stopped.
#[test]
fn every_deck_goes_on_to_the_bit() {
    /// Elements times steps that a deck may take.
    const WORK: usize = 1_000_000;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let decks = std::fs::read_dir(folder.join("decks")).expect("the decks");
    let mut decks: Vec<PathBuf> = decks.map(|entry| entry.expect("an entry").path()).collect();
    decks.retain(|path| path.extension().is_some_and(|suffix| suffix == "i"));
    decks.sort();
    let (mut done, mut listed) = (0, Vec::new());
    for deck in &decks {
        let name = deck.file_stem().expect("a name").to_string_lossy().into_owned();
        let source = Source::open(&folder.join(format!("meshes/{name}.mesh"))).expect("a recipe");
        let (mesh, _) = make_with_warnings(source, 1).unwrap_or_else(|found| panic!("{}", found.render(false)));
        let steps = (WORK / mesh.element_count()).min(300);
        if steps < 10 {
            println!("{name}: {} elements are too many", mesh.element_count());
            continue;
        }
        let begun = std::time::Instant::now();
        let case = Case::new(&std::fs::read_to_string(deck).expect("a deck"), mesh);
        let whole = case.part(1, None, steps);
        let first = case.part(2, None, steps / 2);
        let second = case.part(3, Some(&first.end), steps - steps / 2);
        assert_same(&name, &whole, &second);
        listed.extend(first.end.lists.into_iter().map(|list| list.name));
        done += 1;
        println!("{name}: {steps} steps, {:.1} s", begun.elapsed().as_secs_f64());
    }
    assert!(done > 15, "{done}");
    assert!(["CONTTOUCH", "CONTEDGES", "CONTPLANE"].iter().all(|name| listed.contains(&name.to_string())));
}
/// Every law, with all that it stores at work but the drop of stress in a torn element, which is stored like the rest.
#[test]
fn every_material_on_any_number_of_ranks() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = |path: &str| std::fs::read_to_string(folder.join(path)).expect("a file");
    let case = Case::new(&text("decks/materials.i"), recipe(&text("meshes/materials.mesh")));
    let laws: Vec<&str> = case.model.materials.iter().map(|material| material.law.entry().name).collect();
    let missing: Vec<&str> = MATERIALS.iter().map(|entry| entry.name).filter(|name| !laws.contains(name)).collect();
    assert!(missing.is_empty(), "the deck lacks {missing:?}");
    // Rates of strain vanish later, tearing comes later.
    for (before, resting) in [(400, "TEARING"), (800, "EQPSDOT")] {
        let whole = case.part(1, None, before + 100);
        // No corner of a fluid is bent so far here that it is pushed back.
        let corners: Vec<String> = (1..=8).map(|corner| format!("CORNER{corner}")).collect();
        let mut idle = vec!["AXIS12", "AXIS13", "AXIS21", "AXIS23", "AXIS31", "AXIS32", "DECAY", resting];
        idle.extend(corners.iter().map(String::as_str));
        for writing in RANKS {
            let first = case.part(writing, None, before);
            let zero = |(_, values): &&(String, Vec<f64>)| values.iter().all(|value| *value == 0.0);
            let zeros: Vec<&str> = first.end.element.iter().filter(zero).map(|(name, _)| name.as_str()).collect();
            assert!(zeros.iter().all(|name| idle.contains(name)), "{zeros:?} are not at work");
            for reading in RANKS {
                let second = case.part(reading, Some(&first.end), 100);
                assert_same(&format!("written by {writing} ranks, read by {reading}"), &whole, &second);
            }
        }
    }
}
