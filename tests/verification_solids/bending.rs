//! Bending of one-point hexahedra, where hourglass control decides: a vibrating beam and a cantilever.
//!
//! `cargo test --test verification_solids bending:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::support::meshes::{box_of_cells, nodes_where, recipe};
use crate::support::run::run;
use crate::support::stiffness::{end_shear, held_at_root, solve, stiffness};
use crate::support::{between, close};

const BEAM: &str = include_str!("../../decks/bending_beam_4.i");

/// First peak of the deflection in the middle and its time, for so many elements through the depth.
fn beam_peak(through: usize, poisson: &str, hourglass: &str) -> (f64, f64) {
    let mesh = recipe(match through {
        2 => include_str!("../../meshes/bending_beam_2.mesh"),
        _ => include_str!("../../meshes/bending_beam_4.mesh"),
    });
    let deck = BEAM.replace("POISSONS RATIO = 0.25", &format!("POISSONS RATIO = {poisson}"));
    let run = run(&deck.replace("TITLE", &format!("{hourglass}\nTITLE")), &mesh);
    between("V-11", "worst energy balance", run.worst_balance(), 0.0, 1e-3);
    let middle = nodes_where(&mesh, |p| p[0] == 0.0 && (p[2] - 0.5).abs() < 1e-9)[0] as usize;
    let history: Vec<(f64, f64)> = run.states.iter().map(|s| (s.time, -s.nodal("DISPLZ")[middle])).collect();
    let peak = history.iter().max_by(|a, b| a.1.total_cmp(&b.1)).expect("states");
    (peak.1, peak.0)
}

/// Timoshenko's series for a pinned beam in plane strain, under a pressure put on at once.
const PEAKS: [(&str, f64, f64); 2] = [("0.25", 4.722e-3, 4.254e-3), ("0.", 5.028e-3, 4.377e-3)];

/// Assumed strain is exact for bending of boxes, so 1 % is the mesh's share: two elements carry the depth.
#[test]
fn v11_vibrating_beam_with_assumed_strain() {
    for (poisson, deflection, time) in PEAKS {
        for through in [2, 4] {
            let (peak, at) = beam_peak(through, poisson, "");
            let case = format!("V-11 assumed strain, {through} elements, nu={poisson}");
            close(&case, "peak [in]", peak, deflection, 0.01);
            close(&case, "time of peak [s]", at, time, 0.01);
        }
    }
}

/// The small elastic stiffness that serves plastic flow is too soft in bending: +4.2 % with four elements, +19 % with
/// two by an independent program (ν = 0.25).
#[test]
fn v11_vibrating_beam_with_elastic_hourglass_stiffness() {
    let soft = |through, poisson| beam_peak(through, poisson, "HOURGLASS STIFFENING, 0.05, 0.").0;
    for (poisson, deflection, _) in PEAKS {
        between(
            &format!("V-11 kappa=0.05, 4 elements, nu={poisson}"),
            "peak over series",
            soft(4, poisson) / deflection,
            1.02,
            1.06,
        );
    }
    close("V-11 kappa=0.05, 2 elements, nu=0.25", "peak over series", soft(2, "0.25") / 4.722e-3, 1.19, 0.02);
}

/// Tip deflection of a cantilever of length 10, height and width 1 under a unit of end shear, over Timoshenko's
/// PL³/3EI + PL/(5/6 GA). The root stays plane but may widen, as in that theory: it is held along the beam, and only
/// its bottom edge across. Also shows that the stiffness has a potential: K is symmetric.
fn cantilever(cells: [usize; 3], poisson: f64, hourglass: &str, plane_strain: bool) -> f64 {
    let (length, young) = (10.0, 1000.0);
    let mesh = box_of_cells(cells, [length, 1.0, 1.0]);
    let deck = format!(
        "TERMINATION TIME, 1.\nBULK VISCOSITY, 0., 0.\n{hourglass}\n\
         MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = {young}\nPOISSONS RATIO = {poisson}\nEND\n"
    );
    let matrix = stiffness(&deck, &mesh);
    let asymmetry = (&matrix - matrix.transpose()).amax() / matrix.amax();
    assert!(asymmetry < 1e-12, "K has no potential: {asymmetry:e}");
    let force = end_shear(&mesh, length, cells);
    let u = solve(&matrix, &force, |node, axis| held_at_root(&mesh, node, axis) || (plane_strain && axis == 2));
    let bending = if plane_strain { young / (1.0 - poisson * poisson) } else { young };
    let timoshenko = length.powi(3) / (3.0 * bending / 12.0) + length / (5.0 / 6.0 * young / (2.0 * (1.0 + poisson)));
    force.dot(&u) / timoshenko
}

const SOFT: &str = "HOURGLASS STIFFENING, 0.05, 0.";
const MIDDLE: &str = "HOURGLASS STIFFENING, 0.15, 0.";
const HARD: &str = "HOURGLASS STIFFENING, 1.0, 0.";
const ASSUMED_STRAIN: &str = "HOURGLASS CONTROL, ASSUMED STRAIN";

/// Ratios to Timoshenko's 4.0312 that exact linear algebra gives for each control; ± 1 % is for the way the root is held.
#[test]
fn v12_cantilever() {
    let table: [(&str, [f64; 3]); 4] = [
        (SOFT, [2.866, 0.981, 0.995]),
        (MIDDLE, [0.960, 0.648, 0.879]),
        (HARD, [0.149, 0.172, 0.446]),
        (ASSUMED_STRAIN, [0.992, 0.994, 0.998]),
    ];
    for (hourglass, ratios) in table {
        for (cells, ratio) in [[10, 1, 1], [10, 2, 2], [20, 4, 4]].into_iter().zip(ratios) {
            let case = format!("V-12 {cells:?} {hourglass}");
            close(&case, "tip over Timoshenko", cantilever(cells, 0.3, hourglass, false), ratio, 0.01);
        }
    }
}

/// Nothing locks as the material becomes incompressible; full integration would give 0.018 here.
#[test]
fn v12_cantilever_in_plane_strain_almost_incompressible() {
    for (hourglass, ratio) in [(SOFT, 4.38), (MIDDLE, 1.47), (ASSUMED_STRAIN, 0.996)] {
        for poisson in [0.499, 0.4999] {
            let case = format!("V-12 [10, 1, 1] plane strain nu={poisson} {hourglass}");
            close(&case, "tip over Timoshenko", cantilever([10, 1, 1], poisson, hourglass, true), ratio, 0.01);
        }
    }
}

/// Tip deflection of a cantilever of ten cubes that are sheared by `shear` in the plane of bending, over that of thin beams; the
/// numbering of every element begins at a corner `turns` farther on.
fn skewed_cantilever(shear: f64, turns: usize, hourglass: &str) -> f64 {
    let (cells, length) = ([10, 1, 1], 10.0);
    let straight = box_of_cells(cells, [length, 1.0, 1.0]);
    let mut mesh = straight.clone();
    for node in 0..mesh.coordinates.len() {
        mesh.coordinates[node][0] += shear * (mesh.coordinates[node][1] - 0.5);
    }
    for element in mesh.blocks[0].nodes.chunks_exact_mut(8) {
        element[..4].rotate_left(turns);
        element[4..].rotate_left(turns);
    }
    let deck = format!(
        "TERMINATION TIME, 1.\nBULK VISCOSITY, 0., 0.\n{hourglass}\n\
         MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1000.\nPOISSONS RATIO = 0.3\nEND\n"
    );
    let force = end_shear(&straight, length, cells);
    let u = solve(&stiffness(&deck, &mesh), &force, |node, axis| held_at_root(&straight, node, axis));
    force.dot(&u) / (length.powi(3) / (3.0 * 1000.0 / 12.0) + length / (5.0 / 6.0 * 1000.0 / 2.6))
}

/// Elements know nothing of the corner at which they are numbered, up to round-off of the operator that is measured.
#[test]
fn v12_of_skewed_elements_does_not_depend_on_their_numbering() {
    for shear in [0.25, 0.5, 1.0] {
        let ratio = skewed_cantilever(shear, 0, ASSUMED_STRAIN);
        println!("V-12 of cubes sheared by {shear}: {ratio:.4}");
        for turns in 1..4 {
            let case = format!("V-12 sheared by {shear}, numbered {turns} corners on");
            close(
                &case,
                "tip over that of the first numbering",
                skewed_cantilever(shear, turns, ASSUMED_STRAIN),
                ratio,
                1e-9,
            );
        }
    }
}
