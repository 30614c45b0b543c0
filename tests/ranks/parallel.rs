//! The same bits on any number of ranks, over threads or MPI, with any vector instructions: every value of the plot
//! file, and every line of the print log but the columns that time the machine.

use crate::program::{Desk, Left, URTO, mpiexec, project};
use urto::exodus::{self, Tolerance};
use urto::mesher;

/// Numbers of thread ranks that are held against one rank.
const RANKS: [usize; 6] = [2, 3, 4, 7, 16, 64];

/// Commands that the short run replaces.
const TIMES: [&str; 3] = ["TERMINATION TIME", "OUTPUT TIME", "PLOT TIME"];

/// Plasticity, a rigid surface with friction and a pressure, on a curved mesh.
fn taylor_bar() -> Desk {
    let deck = text("decks/taylor_bar_wall.i");
    let rest = deck.lines().filter(|line| !TIMES.iter().any(|times| line.starts_with(times)) && *line != "EXIT");
    let mut deck: String = rest.map(|line| format!("{line}\n")).collect();
    assert!(deck.contains("0., 0., 1.\n") && deck.contains("RIGID SURFACE, 100"), "the deck is as this test knows it");
    deck = deck.replace("0., 0., 1.\n", "0., 0., 1., 0.2\n");
    deck += "TERMINATION TIME, 6.E-6\nOUTPUT TIME, 0.5E-6\nPLOT TIME, 1.E-6\n\
             FUNCTION, 1\n0., 0.\n2.E-6, 1.\nEND\nPRESSURE, 200, 1, 50.E6\nEXIT\n";
    desk(&deck, "meshes/taylor_bar_wall.mesh")
}

/// Two blocks, gravity, prescribed motions and forces: every command.
fn commands() -> Desk {
    desk(&text("decks/commands.i"), "meshes/commands.mesh")
}

/// An elastic cantilever that swings with both kinds of hourglass modes awake.
fn cantilever() -> Desk {
    let deck = "TITLE\n cantilever\nTERMINATION TIME, 2.E-4\nOUTPUT TIME, 1.E-5\nPLOT TIME, 2.E-5\n\
                PLOT NODAL, DISPLACEMENT, VELOCITY, ACCELERATION, REACTION\nPLOT ELEMENT, STRESS, STRAIN, ENERGY\n\
                MATERIAL, 1, ELASTIC, 7800.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n\
                NO DISPLACEMENT, X, 3\nNO DISPLACEMENT, Y, 3\nNO DISPLACEMENT, Z, 3\n\
                HOURGLASS CONTROL, FLANAGAN BELYTSCHKO\nHOURGLASS STIFFENING, 0.05, 0.03\n\
                INITIAL VELOCITY MATERIAL, 1, 20., -3., 0.\nEXIT\n";
    let desk = Desk::new();
    desk.put("case.i", deck);
    desk.put_mesh("case.g", &crate::program::box_mesh([3, 4, 24], [0.03, 0.04, 0.24], false));
    desk
}

fn text(name: &str) -> String {
    std::fs::read_to_string(project(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn desk(deck: &str, recipe: &str) -> Desk {
    desk_of(deck, &text(recipe))
}

/// The same with the text of a recipe.
fn desk_of(deck: &str, recipe: &str) -> Desk {
    let desk = Desk::new();
    desk.put("case.i", deck);
    let mesh = mesher::make(recipe, "case.mesh", 1).unwrap_or_else(|mistakes| panic!("{}", mistakes.render(false)));
    desk.put_mesh("case.g", &mesh);
    desk
}

fn steel(block: u32) -> String {
    format!("MATERIAL, {block}, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n")
}

/// A deck with another end and a coarser mesh: `(from, to)` are words of its recipe.
fn lighter(name: &str, end: f64, words: &[(&str, &str)]) -> Desk {
    let deck = text(&format!("decks/{name}.i"));
    let rest = deck.lines().filter(|line| !TIMES.iter().any(|times| line.starts_with(times)) && *line != "EXIT");
    let mut deck: String = rest.map(|line| format!("{line}\n")).collect();
    deck += &format!("TERMINATION TIME, {end:e}\nOUTPUT TIME, {:e}\nPLOT TIME, {0:e}\nEXIT\n", end / 12.0);
    let mut recipe = text(&format!("meshes/{name}.mesh"));
    for (from, to) in words {
        assert!(recipe.contains(from), "the recipe is as this test knows it");
        recipe = recipe.replace(from, to);
    }
    desk_of(&deck, &recipe)
}

/// Runs the case on one rank: what all others are held against.
fn reference(desk: &Desk) {
    desk.urto(&["case.i", "--ranks", "1", "-q", "-o", "one"]).with(0);
    assert!(desk.results("one.e").times().len() > 4, "several states are compared");
    assert!(physics(desk, "one").len() > 10, "several lines are compared");
}

/// What the print log says of the physics: its step lines without the columns of time, and the final balance.
fn physics(desk: &Desk, base: &str) -> Vec<String> {
    let log = desk.text(&format!("{base}.o"));
    let head = log.lines().position(|line| line.contains("TIME DILATATION")).expect("column heads");
    let end = log.lines().position(|line| line.contains("W H E R E") || line.contains("S C E N E"));
    let end = end.expect("the closing table");
    let lines = log.lines().skip(head + 2).take(end - head - 2);
    lines
        .map(|line| {
            let mut cells: Vec<&str> = line.split_whitespace().collect();
            if cells.len() >= 10 && cells[0].parse::<u64>().is_ok() {
                // Seconds to go are the last but one of a log without STEP LOG.
                for timed in [if cells.len() == 10 { 8 } else { 16 }, 4, 3] {
                    cells.remove(timed);
                }
            }
            cells.join(" ")
        })
        .collect()
}

fn assert_same(desk: &Desk, base: &str) {
    let paths = ["one.e".to_string(), format!("{base}.e")].map(|name| desk.path(&name));
    let comparison = exodus::compare(&paths[0], &paths[1], &Tolerance::EXACT).expect("both can be read");
    assert!(comparison.is_same(), "{base}: {comparison}");
    assert_eq!(physics(desk, "one"), physics(desk, base), "{base}");
}

fn on_any_number_of_ranks(desk: &Desk) {
    reference(desk);
    for ranks in RANKS {
        let base = format!("threads{ranks}");
        desk.urto(&["case.i", "-q", "--ranks", &ranks.to_string(), "-o", &base]).with(0);
        assert_same(desk, &base);
    }
    for instructions in ["portable", "avx2"] {
        for ranks in ["1", "3"] {
            let base = format!("{instructions}{ranks}");
            let mut command = desk.command(&["case.i", "-q", "--ranks", ranks, "-o", &base]);
            Left::of(command.env("URTO_SIMD", instructions).output().expect("it starts")).with(0);
            assert_same(desk, &base);
        }
    }
    for ranks in [2, 4] {
        let base = format!("mpi{ranks}");
        if let Some(left) = over_mpi(desk, ranks, &["case.i", "-q", "-o", &base]) {
            left.with(0);
            assert_same(desk, &base);
        }
    }
}

/// The two ways of sharing out contact that are not the default, held against a reference that is there.
fn however_contact_is_shared_out(desk: &Desk, ranks: &[&str]) {
    let deck = desk.text("case.i");
    for method in ["SLICES", "STATIC"] {
        desk.put("case.i", &deck.replace("\nEXIT", &format!("\nCONTACT DECOMPOSITION, {method}\nEXIT")));
        for ranks in ranks {
            let base = format!("{method}{ranks}");
            desk.urto(&["case.i", "-q", "--ranks", ranks, "-o", &base]).with(0);
            assert!(desk.text(&format!("{base}.o")).contains(&format!("CONTACT DECOMPOSITION, {method}")));
            assert_same(desk, &base);
        }
    }
    desk.put("case.i", &deck);
}

/// The program on MPI processes, when this build and this machine can.
fn over_mpi(desk: &Desk, ranks: usize, arguments: &[&str]) -> Option<Left> {
    let mut command = mpiexec(ranks)?;
    command.arg(URTO).args(arguments).current_dir(desk.path("."));
    Some(Left::of(command.output().expect("mpiexec starts")))
}

#[test]
fn plastic_bar_under_pressure_on_a_rough_wall() {
    on_any_number_of_ranks(&taylor_bar());
}

#[test]
fn every_command() {
    on_any_number_of_ranks(&commands());
}

#[test]
fn every_material() {
    on_any_number_of_ranks(&desk(&text("decks/materials.i"), "meshes/materials.mesh"));
}

#[test]
fn every_material_in_single_precision() {
    let deck = text("decks/materials.i").replacen("TITLE", "PRECISION, SINGLE\nTITLE", 1);
    on_any_number_of_ranks(&desk(&deck, "meshes/materials.mesh"));
}

#[test]
fn swinging_cantilever() {
    on_any_number_of_ranks(&cantilever());
}

/// A block with a skin of shells that turns: a node may belong to a rank that has only hexahedra there, and so knows nothing of the
/// rotation that is plotted.
#[test]
fn rotations_of_a_skin_on_a_solid() {
    let turn = |block: u32| format!("INITIAL VELOCITY ANGULAR, {block}, 20., 0.1, 0., 0., 0.3, 1., 0.2\n");
    let deck = "TITLE\n skin\nTERMINATION TIME, 2.E-5\nOUTPUT TIME, 1.E-6\nPLOT TIME, 5.E-6\n\
                PLOT NODAL, DISPLACEMENT, ROTATION, ROTATION RATE\nSHELL THICKNESS, 5, 0.002\n";
    let deck = format!("{deck}{}{}{}{}EXIT\n", turn(1), turn(5), steel(1), steel(5));
    let recipe = "TITLE\n skin\nBOX, 1, 0., 0., 0., 0.1, 0.04, 0.04, 10, 4, 4\nSHEET, 5, 0., 0., 0.04, 0.1, 0.04, 0., 10, 4\nMERGE\n";
    on_any_number_of_ranks(&desk_of(&deck, recipe));
}

#[test]
fn bricks_scatter() {
    let words = [("6, 35, 6", "3, 15, 3"), ("6, 3, 3", "3, 2, 2"), ("3, 3, 3", "2, 2, 2"), ("38, 4, 42", "10, 2, 12")];
    let desk = lighter("brick_wall", 1e-3, &words);
    on_any_number_of_ranks(&desk);
    however_contact_is_shared_out(&desk, &["2", "3", "7"]);
    // A search at every step: the decomposition follows the points all the time.
    let desk = lighter("brick_wall", 3e-4, &words);
    let deck = desk.text("case.i").replace("CONTACT MATERIAL\n", "CONTACT MATERIAL\nCONTACT SEARCH, GRID, 0., 0.\n");
    desk.put("case.i", &deck);
    reference(&desk);
    for ranks in ["2", "7"] {
        desk.urto(&["case.i", "-q", "--ranks", ranks, "-o", "many"]).with(0);
        assert_same(&desk, "many");
    }
}

#[test]
fn a_can_folds() {
    let words = [("3,       40,     40", "2, 16, 20"), ("28, 28, 3", "10, 8, 2")];
    let desk = lighter("can_crush", 1.2e-3, &words);
    on_any_number_of_ranks(&desk);
    however_contact_is_shared_out(&desk, &["2", "3", "7"]);
}

#[test]
fn a_plate_erodes() {
    let words = [
        ("10, 12, QUARTER", "4, 4, QUARTER"),
        ("24,      20,     12", "6, 8, 4"),
        ("5, 60, QUARTER", "2, 16, QUARTER"),
    ];
    on_any_number_of_ranks(&lighter("perforation", 120e-6, &words));
}

/// In two dimensions, about the axis: contact of side sets with friction, foam, plasticity, histories.
#[test]
fn a_container_drops() {
    let words =
        [("  24, 2\n", "  12, 1\n"), ("2, 58", "1, 29"), ("2, 2", "1, 1"), ("24, 10", "12, 5"), ("6, 38", "3, 19")];
    let desk = lighter("container_drop", 1.2e-3, &words);
    on_any_number_of_ranks(&desk);
    however_contact_is_shared_out(&desk, &["2", "3", "7"]);
}

/// In plane strain: a ring that folds on itself and on a block that stands on a rough line, and erodes.
#[test]
fn a_ring_folds_in_the_plane() {
    let recipe = "TITLE\n ring\nRING, 1, 0.04, 0.05, 3, 48\nTRANSLATE, 1, 0.12, 0.0905\n\
                  RECTANGLE, 2, 0., 0., 0.24, 0.04, 20, 4\nSIDE SET FACE, 300, 2, FRONT\nSIDE SET FACE, 400, 2, RIGHT\n";
    let metal =
        "YOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 1.E8\nHARDENING MODULUS = 2.E8\nBETA = 1.\nEND\n";
    let deck = format!(
        "TITLE\n ring\nPLANE STRAIN\nTERMINATION TIME, 6.E-4\nOUTPUT TIME, 5.E-5\nPLOT TIME, 1.E-4\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, REACTION, CONTACT\nPLOT ELEMENT, STRESS, STRAIN, ENERGY\nPLOT STATE, EQPS\n\
         CONTACT MATERIAL\nCONTACT DATA, ALL, ALL, 0.2\nDEATH, 1, EQPS, MAX, 0.15\nSILENT BC, 400\nHISTORY BLOCK, 1\n\
         INITIAL VELOCITY MATERIAL, 1, 5., -150.\nRIGID SURFACE, 300, 0., 0., 0., 1., 0.1\n\
         MATERIAL, 1, ELASTIC PLASTIC, 2700.\n{metal}MATERIAL, 2, ELASTIC PLASTIC, 2700.\n{metal}EXIT\n"
    );
    let desk = desk_of(&deck, recipe);
    on_any_number_of_ranks(&desk);
    however_contact_is_shared_out(&desk, &["2", "7"]);
}

#[test]
fn more_ranks_than_elements() {
    let desk = Desk::new();
    crate::program::put_bar(&desk, 1e-4, "RIGID SURFACE, 100, 0., 0., 0., 0., 0., 1.\n");
    std::fs::rename(desk.path("bar.i"), desk.path("case.i")).expect("a deck");
    desk.put_mesh("case.g", &crate::program::box_mesh([1, 1, 2], [0.01, 0.01, 0.02], false));
    desk.urto(&["case.i", "--ranks", "1", "-q", "-o", "one"]).with(0);
    for ranks in ["3", "64"] {
        desk.urto(&["case.i", "--ranks", ranks, "-q", "-o", "many"]).with(0);
        assert_same(&desk, "many");
    }
}

/// Two cubes meet far from a long bar: with the elements, all contact is on one rank; and ranks outnumber its 16 points.
#[test]
fn contact_of_few_points_in_one_place() {
    let recipe = "TITLE\n two cubes and a bar\nBOX, 1, 0., 0., 0., 0.01, 0.01, 0.01, 1, 1, 1\n\
                  BOX, 2, 0.0101, 0.002, 0.003, 0.01, 0.01, 0.01, 1, 1, 1\nBOX, 3, 1., 0., 0., 1., 0.01, 0.01, 60, 1, 1\n";
    let deck = format!(
        "TITLE\n two cubes and a bar\nTERMINATION TIME, 60.E-6\nOUTPUT TIME, 2.E-6\nPLOT TIME, 5.E-6\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT\nCONTACT MATERIAL, 1, 2\n\
         INITIAL VELOCITY MATERIAL, 1, 100., 0., 0.\nINITIAL VELOCITY MATERIAL, 3, 0., 5., 0.\n{}{}{}EXIT\n",
        steel(1),
        steel(2),
        steel(3)
    );
    let desk = desk_of(&deck, recipe);
    on_any_number_of_ranks(&desk);
    however_contact_is_shared_out(&desk, &["2", "7", "64"]);
    let results = desk.results("one.e");
    let velocities = results.nodal("VELX", results.times().len() - 1).expect("velocities");
    assert!(velocities[8..16].iter().all(|v| *v > 1.0), "the second cube was struck: {velocities:?}");
}

/// All that contact is about goes, and a bar goes on along a rough wall: the forces there were known where contact was.
#[test]
fn a_wall_alone_is_left() {
    let recipe = "TITLE\n plate and bar\nBOX, 1, 0.02, 0., 0.005, 0.01, 0.01, 0.01, 2, 2, 2\n\
                  BOX, 2, 0., 0., 0., 0.01, 0.01, 0.04, 2, 2, 8\nSIDE SET FACE, 100, 2, BOTTOM\n";
    let deck = format!(
        "TITLE\n plate and bar\nTERMINATION TIME, 60.E-6\nOUTPUT TIME, 2.E-6\nPLOT TIME, 5.E-6\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT\nCONTACT MATERIAL, 1\nDELETE MATERIAL, 1, 20.E-6\n\
         INITIAL VELOCITY MATERIAL, 1, 0., 50., 0.\nINITIAL VELOCITY MATERIAL, 2, 10., 5., -100.\n\
         RIGID SURFACE, 100, 0., 0., 0., 0., 0., 1., 0.2\n{}{}EXIT\n",
        steel(1),
        steel(2)
    );
    let desk = desk_of(&deck, recipe);
    on_any_number_of_ranks(&desk);
}

/// Processes read a mesh of this size in slabs, and a deck without one fails on all of them.
#[test]
fn a_mesh_read_in_slabs_over_mpi() {
    let desk = Desk::new();
    crate::program::put_bar(
        &desk,
        2e-6,
        "PLOT TIME, 5.E-7\nOUTPUT TIME, 1.E-7\nNO DISPLACEMENT, Z, 3\nPRESSURE, 200, 1, 1.E6\nFUNCTION, 1\n0., 1.\nEND\n",
    );
    desk.put_mesh("bar.g", &crate::program::box_mesh([24, 24, 60], [0.01, 0.01, 0.025], false));
    std::fs::rename(desk.path("bar.i"), desk.path("case.i")).expect("a deck");
    std::fs::rename(desk.path("bar.g"), desk.path("case.g")).expect("a mesh");
    if over_mpi(&desk, 1, &["check", "case.i"]).is_none() {
        return;
    }
    reference(&desk);
    over_mpi(&desk, 3, &["case.i", "-q", "-o", "mpi"]).expect("it ran before").with(0);
    assert_same(&desk, "mpi");
    std::fs::remove_file(desk.path("case.g")).expect("a mesh");
    let left = over_mpi(&desk, 3, &["case.i", "-q"]).expect("it ran before").with(2);
    assert_eq!(left.err.matches("error: no mesh for").count(), 1, "{}", left.err);
    std::fs::write(desk.path("case.g"), vec![b'x'; 1 << 20]).expect("a file");
    let left = over_mpi(&desk, 3, &["case.i", "-q"]).expect("it ran before").with(2);
    assert_eq!(left.err.matches("this is no EXODUS file").count(), 1, "{}", left.err);
}

#[test]
fn failures_over_mpi_are_told_once() {
    let desk = Desk::new();
    let crush = "NO DISPLACEMENT, Z, 3\nFUNCTION, 1\n0., 0.\n1.E-6, 1.\nEND\nPRESCRIBED DISPLACEMENT, Z, 4, 1, -0.03\n";
    crate::program::put_bar(&desk, 1e-4, crush);
    let Some(left) = over_mpi(&desk, 3, &["bar.i", "-q"]) else { return };
    left.with(1).says(&["of block 1", "help:"]);
    desk.put("wrong.i", "TITLE\n nothing\nTERMINATION TIM\n");
    let left = over_mpi(&desk, 3, &["wrong.i", "-m", "bar.g"]).expect("it ran before").with(2);
    assert_eq!(left.err.matches("wrong.i:3").count(), 1, "{}", left.err);
    let Some(mut command) = mpiexec(3) else { return };
    let script = format!("trap '' XFSZ; ulimit -f 200; exec '{URTO}' full.i --quiet");
    crate::program::put_bar(&desk, 1e-2, "PLOT TIME, 1.E-9\n");
    std::fs::rename(desk.path("bar.i"), desk.path("full.i")).expect("a deck");
    std::fs::rename(desk.path("bar.g"), desk.path("full.g")).expect("a mesh");
    let left = Left::of(command.args(["sh", "-c", &script]).current_dir(desk.path(".")).output().expect("it starts"));
    let left = left.with(1);
    left.says(&["full.e"]);
    assert_eq!(left.err.matches("error: cannot write").count(), 1, "{}", left.err);
}
