//! Results in pieces: what `urto join` makes of them is the file that an unsplit run writes, byte for byte; and pieces
//! that do not make a whole are refused with a reason.

use crate::program::{Desk, box_mesh};
use std::collections::BTreeMap;
use std::fs;
use urto::exodus::{self, Tolerance};
use urto::mesh::{Mesh, Shape};

/// Two blocks that fly apart from a floor, with contact, friction and elements that go.
const DECK: &str = "TITLE\n  two blocks  \nTERMINATION TIME, 2.E-5\nPLOT TIME, 2.E-6\n\
    PLOT NODAL, VELOCITY, ACCELERATION, REACTION, MASS, CONTACT\nPLOT ELEMENT, STRESS, STRAIN, ENERGY\nPLOT STATE, EQPS\n\
    MATERIAL, 1, ELASTIC PLASTIC, 7800.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 100.E6\n\
    HARDENING MODULUS = 1.E9\nBETA = 1.\nEND\nMATERIAL, 2, ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9\n\
    POISSONS RATIO = 0.33\nEND\nNO DISPLACEMENT, X, 1\nRIGID SURFACE, 100, 0., 0., 0., 0., 0., 1., 0.1\n\
    CONTACT MATERIAL\nDEATH, 1, EQPS, MAX, 0.02\n\
    INITIAL VELOCITY MATERIAL, 1, 1., -2., -300.\nINITIAL VELOCITY MATERIAL, 2, 3., 0.5, -300.\nEXIT\n";

fn two_blocks() -> Mesh {
    box_mesh([2, 3, 4], [0.02, 0.03, 0.05], true)
}

/// The same in the plane, about an axis or of unit thickness.
fn plane_deck(analysis: &str) -> String {
    DECK.replace("100, 0., 0., 0., 0., 0., 1., 0.1", "100, 0., 0., 0., 1., 0.1")
        .replace("1., -2., -300.", "0., -300.")
        .replace("3., 0.5, -300.", "3., -300.")
        .replace("EXIT", &format!("{analysis}\nEXIT"))
}

/// Two rectangles above each other and a triangle beside them, with a node of no element.
fn two_rectangles() -> Mesh {
    let recipe = "TITLE\n two\nRECTANGLE, 1, 0., 0., 0.02, 0.02, 4, 4\nRECTANGLE, 2, 0., 0.02, 0.02, 0.03, 3, 5\n\
                  NODE SET PLANE, 1, X, 0.\nNODE SET BLOCK, 7, 2\nSIDE SET FACE, 100, 1, FRONT\nSIDE SET FACE, 200, 2, RIGHT\n";
    let mut mesh = urto::mesher::make(recipe, "two.mesh", 1).unwrap_or_else(|found| panic!("{}", found.render(false)));
    let last = mesh.coordinates.len() as u32;
    mesh.coordinates.extend([[0.03, 0.0, 0.0], [0.04, 0.0, 0.0], [0.03, 0.01, 0.0], [1.0, 1.0, 0.0]]);
    mesh.node_ids.extend((1..=4).map(|n| i64::from(last) + n));
    // Behind the elements of the second block, so that sides keep their elements.
    mesh.blocks[1].nodes.extend([last, last + 1, last + 2, last + 2]);
    mesh.element_ids.push(mesh.element_ids.len() as i64 + 1);
    mesh
}

/// A desk with the deck and a mesh, and the results of an unsplit run, `whole.e`.
fn desk(mesh: &Mesh) -> Desk {
    desk_of(DECK, mesh)
}

fn desk_of(deck: &str, mesh: &Mesh) -> Desk {
    let desk = Desk::new();
    desk.put("two.i", deck);
    desk.put_mesh("two.g", mesh);
    desk.urto(&["two.i", "-q", "--ranks", "2", "-o", "whole"]).with(0);
    desk
}

fn split(desk: &Desk, ranks: usize, base: &str) {
    desk.urto(&["two.i", "-q", "--split", "--ranks", &ranks.to_string(), "-o", base]).with(0);
    assert!(!desk.has(&format!("{base}.e")), "there is no whole before it is joined");
}

/// The bytes of a results file without its date and time of day.
fn lasting(desk: &Desk, name: &str) -> Vec<u8> {
    let mut bytes = fs::read(desk.path(name)).expect("a results file");
    let qa = desk.results(name).qa();
    let own = qa.last().expect("the record of the run");
    for text in &own[2..] {
        let place = bytes.windows(text.len()).position(|part| part == text.as_bytes()).expect("it stands in the file");
        bytes[place..place + text.len()].fill(b'0');
    }
    bytes
}

fn assert_joined(desk: &Desk, base: &str) {
    desk.urto(&["join", &format!("{base}.e")]).with(0).says(&["11 states from"]);
    let paths = ["whole.e".to_string(), format!("{base}.e")].map(|name| desk.path(&name));
    let comparison = exodus::compare(&paths[0], &paths[1], &Tolerance::EXACT).expect("both can be read");
    assert!(comparison.is_same(), "{comparison}");
    assert!(lasting(desk, "whole.e") == lasting(desk, &format!("{base}.e")), "{base}: other bytes");
}

#[test]
fn joined_pieces_are_the_unsplit_file() {
    let desk = desk(&two_blocks());
    for ranks in [1, 3, 8] {
        let base = format!("split{ranks}");
        split(&desk, ranks, &base);
        assert_joined(&desk, &base);
    }
}

/// Distribution factors of node sets, of which a piece may have but zeros or ones.
#[test]
fn joined_pieces_have_the_factors_of_node_sets() {
    let mut mesh = two_blocks();
    let factor = |set: usize, n: usize| if set == 0 { [0.0, 1.0, 0.25][n * 3 / 30 % 3] } else { 1.0 + n as f64 };
    for (set, nodes) in mesh.node_sets.iter().enumerate().take(2) {
        mesh.node_factors.insert(nodes.id, (0..nodes.nodes.len()).map(|n| factor(set, n)).collect());
    }
    let desk = desk(&mesh);
    assert_eq!(desk.results("whole.e").mesh().expect("a mesh").node_factors, mesh.node_factors);
    for ranks in [1, 3, 8] {
        let base = format!("split{ranks}");
        split(&desk, ranks, &base);
        let first = netcdf::open(desk.path(&format!("{base}.e.{ranks}.0"))).expect("a piece");
        let counts: Vec<i64> = mesh
            .node_sets
            .iter()
            .map(|set| if mesh.node_factors.contains_key(&set.id) { set.nodes.len() as i64 } else { 0 })
            .collect();
        assert_eq!(list(&first, "ns_df_cnt_global"), counts);
        assert_joined(&desk, &base);
    }
}

/// A join that is killed leaves what was there under the name, and never a part of the whole.
#[test]
fn a_killed_join_leaves_no_short_file() {
    let desk = Desk::new();
    let deck = DECK.replace("PLOT TIME, 2.E-6", "PLOT TIME, 1.E-9");
    desk.put("two.i", &deck);
    desk.put_mesh("two.g", &two_blocks());
    split(&desk, 3, "split");
    let begun = std::time::Instant::now();
    desk.urto(&["join", "split.e", "-o", "all.e"]).with(0);
    let (whole, expected) = (begun.elapsed().as_micros() as u64, fs::read(desk.path("all.e")).expect("the whole"));
    for kill in 1..20 {
        let _ = fs::remove_file(desk.path("split.e"));
        let mut child = desk.start(&["join", "split.e"]);
        std::thread::sleep(std::time::Duration::from_micros(whole * kill / 20));
        child.kill().and_then(|()| child.wait()).expect("it ends");
        if let Ok(there) = fs::read(desk.path("split.e")) {
            assert!(there == expected, "kill {kill}: {} of {} bytes", there.len(), expected.len());
        }
    }
}

/// In two dimensions, with two coordinates, sides that are edges, and a triangle.
#[test]
fn joined_pieces_of_the_plane_are_the_unsplit_file() {
    for analysis in ["AXISYMMETRIC", "PLANE STRAIN"] {
        let desk = desk_of(&plane_deck(analysis), &two_rectangles());
        assert!(
            !desk.results("whole.e").nodal_names().iter().any(|name| name == "VELZ"),
            "the plane has two directions"
        );
        for ranks in [1, 3, 8] {
            let base = format!("split{ranks}");
            split(&desk, ranks, &base);
            assert_joined(&desk, &base);
        }
    }
}

/// Curves of a run in pieces are those of the whole, of the body, at nodes at borders and in elements.
#[test]
fn pieces_are_plotted_as_one() {
    let desk = desk(&two_blocks());
    split(&desk, 3, "parts");
    let numbers = |results: &str| {
        let wanted = ["-v", "KE,VELZ,SIGZZ", "--node", "1,20,30,60", "--element", "1,24"];
        desk.urto(&[&["plot", results, "--csv", "-o", "x.csv"], &wanted[..]].concat()).with(0);
        desk.text("x.csv")
    };
    let whole = numbers("whole.e");
    assert_eq!(whole.lines().count(), 12);
    assert!(numbers("parts.e") == whole && numbers("parts.e.3.1") == whole);
}

/// Numbers out of order and too large for 32 bits, sets out of order that name a node twice, names, a node that belongs
/// to no element, and fewer elements than ranks.
#[test]
fn pieces_of_a_mesh_in_disorder() {
    let mut mesh = box_mesh([1, 2, 2], [0.02, 0.03, 0.05], true);
    mesh.coordinates.insert(0, [1.0, 1.0, 1.0]);
    for block in &mut mesh.blocks {
        block.name = format!("block {}", block.id);
        block.nodes.iter_mut().for_each(|node| *node += 1);
    }
    mesh.node_sets.iter_mut().flat_map(|set| &mut set.nodes).for_each(|node| *node += 1);
    for set in &mut mesh.node_sets {
        set.nodes.reverse();
        set.nodes.push(set.nodes[0]);
    }
    mesh.side_sets.iter_mut().for_each(|set| set.sides.reverse());
    let nodes = mesh.coordinates.len() as i64;
    mesh.node_ids = (0..nodes).map(|n| (n * 7) % nodes + 6_000_000_000).collect();
    mesh.element_ids = vec![40, 10, 30, 20];
    let desk = desk(&mesh);
    for ranks in [3, 16] {
        let base = format!("split{ranks}");
        split(&desk, ranks, &base);
        assert_joined(&desk, &base);
    }
}

/// A list of a piece; nothing when it has none.
fn list(piece: &netcdf::File, name: &str) -> Vec<i64> {
    piece.variable(name).map_or(Vec::new(), |variable| variable.get_values(..).expect("integers"))
}

/// Nodes of a side of an element, by their numbers, ascending: of a face, or of an edge in the plane.
fn side(mesh: &Mesh, shape: Shape, nodes: &[u32], side: usize) -> Vec<i64> {
    let mut numbers: Vec<i64> =
        shape.sides()[side].iter().map(|&corner| mesh.node_ids[nodes[corner] as usize]).collect();
    numbers.sort_unstable();
    numbers
}

/// Every element with its shape.
fn shaped(mesh: &Mesh) -> impl Iterator<Item = (Shape, &[u32])> {
    mesh.blocks.iter().flat_map(|block| block.nodes.chunks(block.shape.corners()).map(|nodes| (block.shape, nodes)))
}

/// For each other rank the sides across which a piece says that it has elements.
fn across(path: &std::path::Path) -> BTreeMap<i64, Vec<Vec<i64>>> {
    let piece = netcdf::open(path).expect("a piece");
    let mesh = exodus::Results::open(path).expect("a piece").mesh().expect("its mesh");
    let elements: Vec<(Shape, &[u32])> = shaped(&mesh).collect();
    let [sides, given, ranks] = ["e_comm_sids", "e_comm_eids", "e_comm_proc"].map(|name| list(&piece, name));
    let mut start = 0;
    let mut map = BTreeMap::new();
    for (rank, end) in list(&piece, "e_comm_ids").into_iter().zip(list(&piece, "e_comm_data_idx")) {
        let entries = start..end as usize;
        start = end as usize;
        assert!(ranks[entries.clone()].iter().all(|&told| told == rank), "entries stand under their rank");
        let side = |entry: usize| {
            let (shape, nodes) = elements[given[entry] as usize - 1];
            side(&mesh, shape, nodes, sides[entry] as usize - 1)
        };
        map.insert(rank, entries.map(side).collect());
    }
    assert_eq!(start, given.len(), "every entry belongs to a rank");
    map
}

/// The element maps of Nemesis against all sides of the whole mesh that elements of two pieces have.
fn assert_across(desk: &Desk, mesh: &Mesh) {
    for ranks in [1, 3, 8] {
        split(desk, ranks, "map");
        let paths: Vec<_> = (0..ranks).map(|r| exodus::pieces::piece_path(&desk.path("map.e"), ranks, r)).collect();
        let owners: BTreeMap<i64, i64> = (0..)
            .zip(&paths)
            .flat_map(|(rank, path)| {
                let numbers = list(&netcdf::open(path).expect("a piece"), "elem_num_map");
                numbers.into_iter().map(move |number| (number, rank))
            })
            .collect();
        let mut sharers: BTreeMap<Vec<i64>, Vec<i64>> = BTreeMap::new();
        for ((shape, nodes), number) in shaped(mesh).zip(&mesh.element_ids) {
            for place in 0..shape.sides().len() {
                sharers.entry(side(mesh, shape, nodes, place)).or_default().push(owners[number]);
            }
        }
        let mut expected: BTreeMap<(i64, i64), Vec<Vec<i64>>> = BTreeMap::new();
        for (side, ranks) in sharers {
            if let [a, b] = ranks[..]
                && a != b
            {
                expected.entry((a, b)).or_default().push(side.clone());
                expected.entry((b, a)).or_default().push(side);
            }
        }
        let told: BTreeMap<(i64, i64), Vec<Vec<i64>>> = (0..)
            .zip(&paths)
            .flat_map(|(rank, path)| across(path).into_iter().map(move |(other, sides)| ((rank, other), sides)))
            .collect();
        // Ascending by nodes in the whole, on both sides.
        assert_eq!(told, expected, "on {ranks} ranks");
        assert_eq!(told.is_empty(), ranks == 1);
    }
}

#[test]
fn pieces_know_whose_elements_are_across() {
    assert_across(&desk(&two_blocks()), &two_blocks());
    assert_across(&desk_of(&plane_deck("PLANE STRAIN"), &two_rectangles()), &two_rectangles());
}

#[test]
fn pieces_that_make_no_whole_are_refused() {
    let desk = desk(&two_blocks());
    desk.urto(&["join", "none.e"]).with(2).says(&["there are no pieces of none.e", "--split"]);
    desk.urto(&["join", "whole.e"]).with(2).says(&["there are no pieces of whole.e"]);
    split(&desk, 3, "run");
    fs::rename(desk.path("run.e.3.1"), desk.path("away")).expect("it is there");
    desk.urto(&["join", "run.e.3.0"]).with(2).says(&["of the 3 pieces of run.e one is missing: run.e.3.1", "help:"]);
    fs::rename(desk.path("away"), desk.path("run.e.3.1")).expect("it is there");
    // A run removes pieces of its name; those of another machine may be brought beside them.
    split(&desk, 2, "two");
    for rank in 0..2 {
        let [from, to] = ["two", "run"].map(|name| desk.path(&format!("{name}.e.2.{rank}")));
        fs::rename(from, to).expect("it is there");
    }
    desk.urto(&["join", "run.e"]).with(2).says(&["run.e is there in 2 and in 3 pieces", "such as run.e.2.0"]);
    desk.urto(&["join", "run.e.3.2", "-o", "run.e.3.1"])
        .with(2)
        .says(&["is one of the pieces, and would be written over"]);
    desk.urto(&["join", "run.e.3.2", "-o", "three.e"]).with(0);
    // A piece under another's name.
    fs::copy(desk.path("run.e.3.0"), desk.path("run.e.3.1")).expect("it is there");
    desk.urto(&["join", "run.e.3.0", "-o", "x.e"]).with(2).says(&["run.e.3.1: its element", "given twice"]);
    // A file that is no piece, and a piece of another number.
    fs::copy(desk.path("whole.e"), desk.path("run.e.3.1")).expect("it is there");
    desk.urto(&["join", "run.e.3.0", "-o", "x.e"]).with(2).says(&["run.e.3.1: this is no piece"]);
    fs::copy(desk.path("run.e.2.1"), desk.path("run.e.3.1")).expect("it is there");
    desk.urto(&["join", "run.e.3.0", "-o", "x.e"]).with(2).says(&["one of 2 pieces, not of 3"]);
    assert!(!desk.has("x.e"), "nothing is left of what could not be joined");
}

#[test]
fn a_piece_of_another_run_is_refused() {
    let desk = desk(&two_blocks());
    split(&desk, 3, "run");
    // The same in a run of another deck, which starts in the same second or not.
    desk.put("two.i", &DECK.replace("-300.\nEXIT", "-301.\nEXIT"));
    split(&desk, 3, "other");
    fs::copy(desk.path("other.e.3.2"), desk.path("run.e.3.2")).expect("it is there");
    desk.urto(&["join", "run.e"]).with(2).says(&["run.e.3.0 and run.e.3.2 are not pieces of one run", "run again"]);
}

#[test]
fn pieces_that_are_cut_short_are_refused_and_lost_states_left_out() {
    let desk = desk(&two_blocks());
    split(&desk, 3, "run");
    let good = fs::read(desk.path("run.e.3.2")).expect("a piece");
    for length in [0, 3, 1000, good.len() / 2, good.len() - 8] {
        fs::write(desk.path("run.e.3.2"), &good[..length]).expect("it can be written");
        desk.urto(&["join", "run.e"]).with(2).says(&["run.e.3.2"]);
    }
    // As a kill leaves it: the last state is not counted in the header.
    let mut killed = good.clone();
    assert_eq!(killed[4..8], 11u32.to_be_bytes());
    killed[4..8].copy_from_slice(&10u32.to_be_bytes());
    fs::write(desk.path("run.e.3.2"), &killed).expect("it can be written");
    desk.urto(&["join", "run.e"]).with(0).says(&["warning: some pieces have 11 states, others 10", "10 states from 3"]);
    assert_eq!(desk.results("run.e").times().len(), 10);
}

#[test]
fn damaged_pieces_are_answered() {
    let desk = desk(&two_blocks());
    split(&desk, 3, "run");
    let good = fs::read(desk.path("run.e.3.1")).expect("a piece");
    // Every byte of the header, and some behind it, is spoilt once; all of this must end in an answer.
    for place in (0..good.len().min(24_000)).step_by(97) {
        let mut bytes = good.clone();
        bytes[place] ^= 0x55;
        fs::write(desk.path("run.e.3.1"), &bytes).expect("it can be written");
        let (_, pieces) = exodus::pieces::pieces_of(&desk.path("run.e.3.0")).expect("all are there");
        let _ = exodus::pieces::join(&pieces, &desk.path("x.e"));
    }
}

#[test]
fn over_mpi() {
    if !cfg!(feature = "mpi") || std::process::Command::new("mpiexec").arg("--version").output().is_err() {
        return;
    }
    let desk = desk(&two_blocks());
    let mut command = std::process::Command::new("mpiexec");
    for permission in ["OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe"]
    {
        command.env(permission, "1");
    }
    command.env("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe");
    command.args(["-n", "3", crate::program::URTO, "two.i", "-q", "--split", "-o", "mpi"]).current_dir(desk.path("."));
    crate::program::Left::of(command.output().expect("mpiexec starts")).with(0);
    assert_joined(&desk, "mpi");
}

#[test]
fn a_piece_that_cannot_be_written_ends_the_run_with_its_name() {
    let desk = desk(&two_blocks());
    fs::create_dir(desk.path("run.e.3.2")).expect("a folder");
    let left = desk.urto(&["two.i", "-q", "--split", "--ranks", "3", "-o", "run"]).with(1);
    left.says(&["run.e.3.2"]);
    assert_eq!(left.err.matches("error:").count(), 1, "{}", left.err);
}
