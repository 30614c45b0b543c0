//! Runs go on from states in which elements have gone: the surface that is left is another than that of the mesh.

use super::restart_files::assert_tail;
use crate::program::Desk;

/// Bodies of odd shapes that are pushed into each other. A corner element goes with three faces and lays bare three: there
/// are as many faces as before, of fewer nodes.
const MESH: &str = "TITLE\n ERODED\nCYLINDER, 1, 1., 2., 1, 2\nTRANSLATE, 1, 0., 0., 1.03\n\
     HEXAHEDRON, 2, 2, 2, 2\n-1.5, -1.5, 0.\n1.5, -1.5, 0.\n1.5, 1.5, 0.2\n-1.5, 1.5, 0.\n-1.2, -1.4, 1.\n1.3, -1.5, 1.\n1.5, 1.6, 1.\n\
     -1.5, 1.5, 1.\nEND\nBOX, 3, -1.5, -1.5, -1.01, 3., 3., 1., 1, 2, 1\nBOX, 4, -0.5, -0.5, 3.04, 1., 1., 0.6, 2, 2, 1\n\
     BOX, 5, 0.7, -0.5, 3.05, 1., 1., 0.6, 1, 2, 1\nPERTURB, 0.2\nNODE SET POINT, 5, 1.5, -1.5, 0.\n";

fn deck(more: &str) -> String {
    let laws: String = (1..=5)
        .map(|block| (block, if block == 2 { 0.3 } else { 0. }))
        .map(|(block, poisson)| {
            format!("MATERIAL, {block}, ELASTIC, 1.\nYOUNGS MODULUS = 1.E5\nPOISSONS RATIO = {poisson:?}\nEND\n")
        })
        .collect();
    format!(
        "TITLE\n ERODED\nTERMINATION TIME, 0.08\nPLOT TIME, 0.01\nPLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT\nFUNCTION, 2\n0., 1.\n1., 1.\nEND\n{laws}\
         PRESCRIBED ACCELERATION, Z, 5, 2, 2660.\nCONTACT MATERIAL, ALL\nDEATH, 2, VONMISES, MAX, 1000.\n{more}EXIT\n"
    )
}

/// The same last state, and advice at the end, which looks at the surface that is left.
#[test]
fn what_has_eroded_stays_away() {
    let desk = Desk::new();
    let mesh = urto::mesher::make(MESH, "case.mesh", 1).unwrap_or_else(|found| panic!("{}", found.render(false)));
    desk.put_mesh("case.g", &mesh);
    desk.put("whole.i", &deck("WRITE RESTART, 0.02, 9\n"));
    desk.put("again.i", &deck("READ RESTART, 0.04\n"));
    desk.urto(&["whole.i", "-m", "case.g", "-q", "--ranks", "1"]).with(0);
    for ranks in ["1", "2"] {
        desk.urto(&["again.i", "-m", "case.g", "-q", "--ranks", ranks, "--restart", "whole.rsout", "-o", "go"]).with(0);
        let name = if ranks == "1" { "go.e" } else { "go.e-s0002" };
        assert_tail(&desk.path("whole.e"), &desk.path(name));
    }
}
