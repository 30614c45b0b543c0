//! Broken meshes, each with the message an analyst gets.
//!
//! The messages stand in `expected/`; run with URTO_BLESS=1 to write them anew after a change, and read the diff.

mod fuzz;
mod raw;

use std::fs;
use std::path::{Path, PathBuf};

use raw::{Raw, Values};
use urto::exodus::read_mesh;

/// A way to spoil the good mesh of [`Raw::cubes`], by name.
type Case = (&'static str, fn(&mut Raw));

/// What is wrong inside an otherwise sound netCDF file.
const SPOILT: &[Case] = &[
    ("not_exodus", |m| {
        m.attributes.clear();
        m.remove(&["eb_prop1"]);
    }),
    ("two_dimensional", |m| {
        m.remove(&["num_dim", "coordz"]);
        m.dimension("num_dim", 2);
    }),
    ("no_blocks", |m| {
        m.remove(&["num_el_blk", "num_elem", "eb_status", "eb_prop1", "connect1", "connect2", "elem_num_map"]);
        m.remove(&["num_side_sets", "ss_status", "ss_prop1"]);
    }),
    ("only_null_blocks", |m| {
        m.remove(&["num_elem", "connect1", "connect2", "elem_num_map", "num_side_sets", "ss_status", "ss_prop1"]);
        *m.integers("eb_status") = vec![0, 0];
    }),
    ("coordinates_missing", |m| m.remove(&["coordx", "coordy", "coordz"])),
    ("coordz_missing", |m| m.remove(&["coordz"])),
    ("coordinates_of_text", |m| {
        let coordx = m.get("coordx");
        coordx.values = Values::Text("0123456789abcdef");
    }),
    ("coordinates_too_few", |m| {
        m.dimension("fifteen", 15);
        m.get("coordy").dimensions = vec!["fifteen".into()];
        m.reals("coordy").pop();
    }),
    ("packed_coordinates_turned", |m| {
        m.remove(&["coordx", "coordy", "coordz"]);
        m.array("coord", &["num_nodes", "num_dim"], Values::Reals(vec![0.0; 48]));
    }),
    ("connectivity_missing", |m| m.remove(&["connect2"])),
    ("connectivity_of_reals", |m| m.get("connect2").values = Values::Reals((9..=16).map(f64::from).collect())),
    ("connectivity_flat_array", |m| {
        m.remove(&["num_nod_per_el2"]);
        m.dimension("eight", 8);
        m.get("connect2").dimensions = vec!["eight".into()];
    }),
    ("connectivity_zero", |m| m.integers("connect1")[3] = 0),
    ("connectivity_negative", |m| m.integers("connect1")[3] = -5),
    ("connectivity_beyond", |m| m.integers("connect2")[7] = 17),
    ("connectivity_all_beyond", |m| m.integers("connect1").iter_mut().for_each(|n| *n += 100)),
    ("element_count_disagrees", |m| {
        m.remove(&["num_elem", "elem_num_map"]);
        m.dimension("num_elem", 4);
    }),
    ("nan_coordinate", |m| m.reals("coordy")[6] = f64::NAN),
    ("infinite_coordinate", |m| m.reals("coordz")[2] = f64::NEG_INFINITY),
    ("inverted_element", |m| m.integers("connect2").rotate_left(4)),
    ("mirrored_mesh", |m| m.reals("coordx").iter_mut().for_each(|x| *x = -*x)),
    ("flat_element", |m| m.reals("coordx")[12..].fill(2.0)),
    ("repeated_node", |m| {
        let nodes = m.integers("connect2");
        nodes.copy_within(0..4, 4);
    }),
    ("twisted_element", |m| m.integers("connect2").swap(5, 7)),
    ("block_number_twice", |m| *m.integers("eb_prop1") = vec![4, 4]),
    ("block_numbers_too_few", |m| {
        m.dimension("one", 1);
        m.get("eb_prop1").dimensions = vec!["one".into()];
        m.integers("eb_prop1").pop();
    }),
    ("node_number_twice", |m| m.integers("node_num_map")[1] = 116),
    ("element_number_twice", |m| m.integers("elem_num_map")[2] = 1001),
    ("element_map_short", |m| {
        m.dimension("two", 2);
        m.get("elem_num_map").dimensions = vec!["two".into()];
        m.integers("elem_num_map").pop();
    }),
    ("node_set_number_twice", |m| *m.integers("ns_prop1") = vec![31, 31]),
    ("node_set_beyond", |m| m.integers("node_ns1")[2] = 99),
    ("node_set_zero", |m| m.integers("node_ns2")[0] = 0),
    ("node_set_list_missing", |m| m.remove(&["node_ns2"])),
    ("side_set_number_twice", |m| *m.integers("ss_prop1") = vec![300, 300]),
    ("side_set_element_beyond", |m| m.integers("elem_ss1")[1] = 4),
    ("side_set_side_seven", |m| *m.integers("side_ss1") = vec![7, 0]),
    ("side_set_sides_missing", |m| m.remove(&["side_ss2"])),
    ("side_set_lengths_differ", |m| {
        m.get("side_ss1").dimensions = vec!["num_side_ss2".into()];
        m.integers("side_ss1").pop();
    }),
    ("type_tetra", |m| m.other_type("TETRA", 4)),
    ("type_tet4", |m| m.other_type("tet4", 4)),
    ("type_wedge15", |m| m.other_type("WEDGE15", 15)),
    ("type_pyramid13", |m| m.other_type("PYRAMID", 13)),
    ("wedge_has_no_side_six", |m| m.other_type("WEDGE", 6)),
    ("pyramid_inside_out", |m| {
        m.other_type("PYRAMID5", 5);
        *m.integers("connect2") = vec![9, 12, 11, 10, 13];
        m.integers("side_ss1")[1] = 5;
    }),
    ("pinched_element", |m| m.integers("connect2")[6] = 9),
    ("dented_pyramid", |m| {
        // A pyramid whose base is dented at a corner.
        *m.integers("connect2") = vec![9, 10, 11, 12, 13, 13, 13, 13];
        m.reals("coordy")[10] = 0.2;
        m.reals("coordz")[10] = 0.2;
    }),
    ("block_of_tetrahedra", |m| *m.integers("connect2") = vec![9, 10, 11, 11, 13, 13, 13, 13]),
    ("type_hex20", |m| m.other_type("HEX20", 20)),
    ("type_hex27", |m| m.other_type("HEX", 27)),
    ("type_shell", |m| m.other_type("SHELL9", 9)),
    ("type_quad", |m| m.other_type("QUAD8", 8)),
    ("type_beam", |m| m.other_type("BEAM3", 3)),
    ("type_sphere", |m| m.other_type("SPHERE", 1)),
    ("type_unknown_with_eight_nodes", |m| m.other_type("SHELL8", 8)),
    ("several_at_once", |m| {
        m.integers("connect1")[0] = 40;
        m.integers("node_num_map")[1] = 101;
        m.integers("side_ss2")[0] = 9;
        *m.integers("eb_prop1") = vec![7, 7];
    }),
    ("more_than_can_be_told", |m| {
        for node in 1..16 {
            m.integers("node_num_map")[node] = 101 + node as i32 / 2;
        }
        for set in 3..=20 {
            m.dimension(&format!("num_nod_ns{set}"), 1);
            m.array(&format!("node_ns{set}"), &[&format!("num_nod_ns{set}")], Values::Integers(vec![0]));
        }
        m.remove(&["num_node_sets", "ns_status", "ns_prop1"]);
        m.dimension("num_node_sets", 20);
    }),
];

#[test]
fn the_good_mesh_is_good() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("can.g");
    Raw::cubes().write(&path);
    assert_eq!(read_mesh(&path).unwrap().element_count(), 3);
}

#[test]
fn distribution_factors_that_say_something_are_noted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("can.g");
    for (factors, weighted) in
        [([1.0; 4], &[][..]), ([0.0; 4], &[]), ([1.0, 1.0, 0.5, 1.0], &[31]), ([0.0, 2.0, 0.0, 0.0], &[31])]
    {
        let mut raw = Raw::cubes();
        raw.array("dist_fact_ns1", &["num_nod_ns1"], Values::Reals(factors.to_vec()));
        raw.write(&path);
        assert_eq!(read_mesh(&path).unwrap().weighted, [weighted.to_vec(), Vec::new()], "{factors:?}");
    }
}

#[test]
fn spoilt_meshes_are_refused_with_their_message() {
    let mut failures = Vec::new();
    for (name, spoil) in SPOILT {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("can.g");
        let mut raw = Raw::cubes();
        spoil(&mut raw);
        raw.write(&path);
        check(name, &path, &mut failures);
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
}

/// Files that are spoilt as bytes.
#[test]
fn files_that_are_no_meshes_are_refused_with_their_message() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("can.g");
    let mut failures = Vec::new();
    check("file_missing", &path, &mut failures);
    fs::create_dir(&path).unwrap();
    check("folder", &path, &mut failures);
    fs::remove_dir(&path).unwrap();

    let good = folder.path().join("good.g");
    Raw::cubes().write(&good);
    let good = fs::read(good).unwrap();
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    let hdf5 = fs::read(fixtures.join("netcdf4_compressed.g")).unwrap();
    let mut wrong_tag = good.clone();
    wrong_tag[11] = 0x0D;
    let mut large_name = good.clone();
    large_name[16..20].fill(0x7F);
    let old = fs::read(fixtures.join("genesis_big_4.g")).unwrap();
    // The nodes of the first face of side set 200 stand before the factors and the closing records.
    let face = old.windows(16).position(|w| w == [0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 3]).unwrap();
    let mut no_face = old.clone();
    no_face[face + 3] = 9;
    let mut mark_behind = old.clone();
    mark_behind[4 + 80 + 4 + 4 + 36 + 3] = 35;
    let mut negative = old.clone();
    negative[4 + 80 + 4 + 4..][..4].fill(0xFF);
    let files: [(&str, &[u8]); 16] = [
        ("empty_file", b""),
        ("a_deck", b"TITLE\n  can crush\n"),
        ("exodus_one_big_endian", &[0, 0, 0, 80, b' ', b' ']),
        ("exodus_one_little_endian", &[80, 0, 0, 0, b' ', b' ']),
        ("exodus_one_cut_in_coordinates", &old[..200]),
        ("exodus_one_cut_between_records", &old[..4 + 80 + 4]),
        ("exodus_one_cut_in_closing_records", &old[..old.len() - 3]),
        ("exodus_one_no_face", &no_face),
        ("exodus_one_mark_behind", &mark_behind),
        ("exodus_one_negative_count", &negative),
        ("cut_in_data", &good[..good.len() - 40]),
        ("cut_in_header", &good[..300]),
        ("header_wrong_tag", &wrong_tag),
        ("header_large_name", &large_name),
        ("hdf5_cut", &hdf5[..hdf5.len() / 2]),
        ("hdf5_magic_only", &hdf5[..8]),
    ];
    for (name, bytes) in files {
        fs::write(&path, bytes).unwrap();
        check(name, &path, &mut failures);
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
}

/// Reads the mesh at `path` and compares the message with the golden one.
fn check(name: &str, path: &Path, failures: &mut Vec<String>) {
    let golden: PathBuf = [env!("CARGO_MANIFEST_DIR"), "tests/broken_meshes/expected"].iter().collect();
    let golden = golden.join(format!("{name}.txt"));
    let folder = format!("{}/", path.parent().unwrap().display());
    let message = match read_mesh(path) {
        Ok(_) => "the mesh was accepted\n".to_string(),
        Err(error) => format!("{error}\n").replace(&folder, ""),
    };
    if std::env::var_os("URTO_BLESS").is_some() {
        fs::write(&golden, &message).unwrap();
    }
    let expected = fs::read_to_string(&golden).unwrap_or_default();
    if message != expected {
        failures.push(format!("{name}: expected\n{expected}found\n{message}"));
    }
}

/// A block of one wedge or one pyramid in the place of the third cube.
#[test]
fn wedges_and_pyramids_are_read_as_collapsed_hexahedra() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("shapes.g");
    for (element_type, nodes, side, corners, hex_side) in [
        ("WEDGE", vec![9, 10, 11, 13, 14, 15], 3, [8, 9, 10, 10, 12, 13, 14, 14], 3),
        ("wedge6", vec![9, 10, 11, 13, 14, 15], 5, [8, 9, 10, 10, 12, 13, 14, 14], 5),
        ("PYRAMID5", vec![9, 10, 11, 12, 13], 5, [8, 9, 10, 11, 12, 12, 12, 12], 4),
        ("pyr", vec![9, 10, 11, 12, 13], 4, [8, 9, 10, 11, 12, 12, 12, 12], 3),
    ] {
        let mut raw = Raw::cubes();
        raw.other_type(element_type, nodes.len());
        *raw.integers("connect2") = nodes;
        raw.integers("side_ss1")[1] = side;
        raw.write(&path);
        let mesh = read_mesh(&path).unwrap_or_else(|e| panic!("{element_type}: {e}"));
        assert_eq!(mesh.blocks[1].hexahedra(), [corners], "{element_type}");
        assert_eq!(mesh.side_sets[0].sides, [(0, 4), (2, hex_side)], "{element_type}");
    }
}
