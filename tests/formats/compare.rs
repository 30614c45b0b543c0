//! Two results files set against each other.

use std::path::{Path, PathBuf};

use crate::support::{State, results_header, two_block_mesh, written_state};
use urto::exodus::{Comparison, ResultsError, ResultsWriter, Tolerance, compare, write_mesh};
use urto::mesh::Mesh;

/// A file of three states, each changed by `change` before it is written.
fn written(folder: &Path, name: &str, states: usize, change: impl Fn(usize, &mut State)) -> PathBuf {
    let path = folder.join(name);
    let mesh = two_block_mesh();
    let mut writer = ResultsWriter::create(&path, &results_header(&mesh)).unwrap();
    for number in 0..states {
        let mut state = written_state(&mesh, number);
        change(number, &mut state);
        writer.write_state(state.0, &state.1, &state.2, &state.3).unwrap();
    }
    path
}

/// The comparison of an unchanged file with a changed one, and its text without the folder.
fn compared(tolerance: Tolerance, states: usize, change: impl Fn(usize, &mut State)) -> (Comparison, String) {
    let folder = tempfile::tempdir().unwrap();
    let a = written(folder.path(), "a.e", 3, |_, _| ());
    let b = written(folder.path(), "b.e", states, change);
    let comparison = compare(&a, &b, &tolerance).unwrap();
    let text = comparison.to_string().replace(&format!("{}/", folder.path().display()), "");
    (comparison, text)
}

#[test]
fn equal_files_are_the_same() {
    let (comparison, text) = compared(Tolerance::EXACT, 3, |_, _| ());
    assert!(comparison.is_same());
    assert_eq!(text, "a.e and b.e are the same (3 states)");
}

#[test]
fn the_largest_difference_of_each_variable_is_told() {
    let (comparison, text) = compared(Tolerance::EXACT, 3, |number, (time, globals, nodal, element)| {
        if number == 1 {
            nodal[1][4] += 0.25;
            nodal[1][5] += 0.5;
            element[0][2] = f64::NAN;
        }
        if number == 2 {
            nodal[1][6] -= 0.125;
            globals[1] *= 2.0;
            *time = 4e-3;
        }
    });
    assert!(!comparison.is_same());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "a.e and b.e differ");
    assert_eq!(
        lines[1],
        "  time: 1 of 3 values differ, most in state 3 (time 2e-3): 2e-3 and 4e-3, difference 2.000e-3, relative 5.000e-1"
    );
    for (line, start) in lines[2..].iter().zip([
        "  global variable IE: 1 of 3 values differ, most in state 3 (time 2e-3): ",
        "  nodal variable DISPLY: 3 of 48 values differ, most in state 2 (time 1e-3) at node 95: ",
        "  element variable EQPS: 1 of 9 values differ, most in state 2 (time 1e-3) at element 9 of block 4: ",
    ]) {
        assert!(line.starts_with(start), "{line}");
    }
    assert_eq!(lines.len(), 5);
    assert_eq!(comparison.differences[2].largest.absolute(), 0.5);
}

#[test]
fn a_sign_of_zero_is_a_difference_only_without_tolerance() {
    let change = |_: usize, state: &mut State| state.2[0][0] = 0.0;
    let folder = tempfile::tempdir().unwrap();
    let a = written(folder.path(), "a.e", 1, change);
    let b = written(folder.path(), "b.e", 1, |_, state| state.2[0][0] = -0.0);
    assert!(!compare(&a, &b, &Tolerance::EXACT).unwrap().is_same());
    assert!(compare(&a, &b, &Tolerance::relative(1e-15)).unwrap().is_same());
}

#[test]
fn tolerance_is_relative_to_the_larger_value_and_may_have_a_floor() {
    let change = |_: usize, (_, globals, ..): &mut State| globals[0] *= 1.001;
    assert!(!compared(Tolerance::relative(0.9e-3), 3, change).0.is_same());
    assert!(compared(Tolerance::relative(1e-3), 3, change).0.is_same());
    // KE is at most 2.11 in the last state.
    assert!(compared(Tolerance { relative: 0.0, floor: 2.2 }, 3, change).0.is_same());
    assert!(!compared(Tolerance { relative: 0.0, floor: 2.0 }, 3, change).0.is_same());
}

#[test]
fn missing_states_and_variables_are_differences() {
    let (comparison, text) = compared(Tolerance::EXACT, 2, |_, _| ());
    assert!(!comparison.is_same());
    assert_eq!(text, "a.e and b.e differ\n  3 and 2 states; the first 2 are compared");

    let folder = tempfile::tempdir().unwrap();
    let a = written(folder.path(), "a.e", 0, |_, _| ());
    let b = folder.path().join("b.e");
    let mesh = two_block_mesh();
    let mut header = results_header(&mesh);
    header.nodal[2] = "VELX".into();
    header.element.truncate(1);
    ResultsWriter::create(&b, &header).unwrap();
    let comparison = compare(&a, &b, &Tolerance::EXACT).unwrap();
    assert_eq!(comparison.missing[0], ["nodal variable DISPLZ", "element variable SIGXX"]);
    assert_eq!(comparison.missing[1], ["nodal variable VELX"]);
}

/// A mesh in a file of a folder.
fn mesh_file(folder: &Path, name: &str, mesh: &Mesh) -> PathBuf {
    let path = folder.join(name);
    write_mesh(&path, mesh).unwrap();
    path
}

#[test]
fn moved_nodes_are_a_difference_and_other_meshes_cannot_be_compared() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, mesh: &Mesh| mesh_file(folder.path(), name, mesh);
    let mut mesh = two_block_mesh();
    let a = write("a.g", &mesh);
    mesh.coordinates[2][1] = 1.5;
    let b = write("b.g", &mesh);
    let text = compare(&a, &b, &Tolerance::EXACT).unwrap().differences[0].to_string();
    assert_eq!(
        text,
        "coordinate y: 1 of 16 values differ, most at node 98: 1e0 and 1.5e0, difference 5.000e-1, relative 3.333e-1"
    );
    mesh.blocks[1].id = 5;
    let c = write("c.g", &mesh);
    let error = compare(&a, &c, &Tolerance::EXACT).unwrap_err();
    assert!(matches!(&error, ResultsError::DifferentMeshes { reason, .. } if reason == "block 4 is not the same"));
    let error = compare(&a, &folder.path().join("none.g"), &Tolerance::EXACT).unwrap_err();
    assert!(error.to_string().contains("none.g: cannot be read: No such file"), "{error}");
}

#[test]
fn attributes_and_distribution_factors_are_compared() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, mesh: &Mesh| mesh_file(folder.path(), name, mesh);
    let mut mesh = two_block_mesh();
    let set = mesh.node_sets[0].clone();
    mesh.blocks[0].attributes = vec![0.1; mesh.blocks[0].len()];
    mesh.node_factors.insert(set.id, (0..set.nodes.len()).map(|n| 0.5 + n as f64).collect());
    let a = write("a.g", &mesh);
    assert!(compare(&a, &a, &Tolerance::EXACT).unwrap().is_same());
    mesh.blocks[0].attributes[0] = 0.5;
    mesh.node_factors.get_mut(&set.id).unwrap()[1] = 7.0;
    let b = write("b.g", &mesh);
    let comparison = compare(&a, &b, &Tolerance::EXACT).unwrap();
    let told: Vec<String> = comparison.differences.iter().map(|difference| difference.to_string()).collect();
    let block = mesh.blocks[0].id;
    assert!(told[0].starts_with(&format!("attribute 1 of block {block}: 1 of ")), "{told:#?}");
    assert!(told[1].starts_with(&format!("distribution factors of node set {}: 1 of ", set.id)), "{told:#?}");
    assert!(told[1].contains(": 1.5e0 and 7e0") && told.len() == 2, "{told:#?}");
    mesh.blocks[0].attributes.clear();
    mesh.node_factors.clear();
    let c = write("c.g", &mesh);
    let expected = [format!("attribute 1 of block {block}"), format!("distribution factors of node set {}", set.id)];
    assert_eq!(compare(&a, &c, &Tolerance::EXACT).unwrap().missing, [expected.to_vec(), Vec::new()]);
    assert_eq!(compare(&c, &a, &Tolerance::EXACT).unwrap().missing, [Vec::new(), expected.to_vec()]);
}

/// Histories of blocks have variables of the whole body and no mesh.
#[test]
fn histories_without_a_mesh_are_compared() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, value: f64| {
        let path = folder.path().join(name);
        let none = Mesh::default();
        let mut header = results_header(&none);
        (header.nodal, header.element, header.global) = (Vec::new(), Vec::new(), vec!["KE_BLOCK1".into()]);
        let mut writer = ResultsWriter::create(&path, &header).unwrap();
        writer.write_state(0.0, &[1.0], &[], &[]).unwrap();
        writer.write_state(0.5, &[value], &[], &[]).unwrap();
        path
    };
    let [a, b, c] = [("a.h", 2.0), ("b.h", 2.0), ("c.h", 3.0)].map(|(name, value)| write(name, value));
    assert!(compare(&a, &b, &Tolerance::EXACT).unwrap().is_same());
    let found = compare(&a, &c, &Tolerance::EXACT).unwrap();
    assert_eq!(
        found.differences[0].to_string(),
        "global variable KE_BLOCK1: 1 of 2 values differ, most in state 2 (time 5e-1): 2e0 and 3e0, difference 1.000e0, relative 3.333e-1"
    );
    let with_mesh = written(folder.path(), "a.e", 1, |_, _| ());
    assert!(matches!(compare(&a, &with_mesh, &Tolerance::EXACT), Err(ResultsError::DifferentMeshes { .. })));
}

#[test]
fn what_is_no_finite_number_equals_nothing_else() {
    let tolerance = Tolerance { relative: 1e-2, floor: 1e300 };
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (comparison, text) = compared(tolerance, 3, |number, (_, _, nodal, _)| {
            if number == 1 {
                nodal[0][2] = value;
            }
        });
        assert!(!comparison.is_same() && text.contains("relative inf"), "{text}");
    }
    // But itself.
    let folder = tempfile::tempdir().unwrap();
    for value in [f64::NAN, f64::INFINITY] {
        let [a, b] =
            ["a.e", "b.e"].map(|name| written(folder.path(), name, 1, |_, (_, _, nodal, _)| nodal[0][2] = value));
        assert!(compare(&a, &b, &tolerance).unwrap().is_same());
    }
}
