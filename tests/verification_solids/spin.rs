//! SPIN: simple shear that turns, run from a deck, with a spin of first and of second order.
//!
//! `cargo test --test verification_solids spin:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::program::Desk;
use crate::support::meshes::recipe;
use crate::support::run::run;
use crate::support::{between, close};
use nalgebra::{Matrix3, Rotation3, Vector3};
use urto::mesh::Mesh;

const DECK: &str = include_str!("../../decks/simple_shear.i");
const MESH: &str = include_str!("../../meshes/simple_shear.mesh");
const SECOND: &str = "SPIN, SECOND ORDER";
/// Dienes' solution at γ = 5 over the shear modulus: σ_xx = −σ_yy and σ_xy in axes that turn with the shear.
const EXACT: [f64; 2] = [2.704319, 2.905369];

/// The deck with so many steps and these lines in the place of SPIN, SECOND ORDER.
fn deck(steps: usize, lines: &str) -> String {
    let changed = DECK.replacen("{steps = 400}", &format!("{{steps = {steps}}}"), 1);
    assert!(changed.contains(SECOND) && (steps == 400 || changed != DECK), "the deck has changed");
    changed.replacen(SECOND, lines, 1)
}

/// Largest error of σ_xx and σ_xy at the end of a run, over the largest stress.
fn error(steps: usize, lines: &str, mesh: &Mesh) -> f64 {
    let run = run(&deck(steps, lines), mesh);
    let of = |name: &str| run.end().element(name)[0];
    let (xy, yz, zx) = (of("TAUXY"), of("TAUYZ"), of("TAUZX"));
    let stress = Matrix3::new(of("SIGXX"), xy, zx, xy, of("SIGYY"), yz, zx, yz, of("SIGZZ"));
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 3.0).into_inner();
    let own = turn.transpose() * stress * turn;
    let [xx, xy] = EXACT;
    (own[(0, 0)] - xx).abs().max((own[(0, 1)] - xy).abs()) / xy
}

#[test]
fn a_spin_of_first_order_is_the_default() {
    let mesh = recipe(MESH);
    let [coarse, fine] = [400, 800].map(|steps| error(steps, "", &mesh));
    close("SPIN, none", "order", (coarse / fine).log2(), 1.0, 0.05);
    between("SPIN, none", "error of the stress in 400 steps", coarse, 1e-3, 1e-2);
    let asked = error(400, "SPIN, FIRST ORDER", &mesh);
    assert!(asked == coarse, "{asked:e} is not {coarse:e}");
}

#[test]
fn a_spin_of_second_order_is_second_order() {
    let mesh = recipe(MESH);
    let errors = [100, 200, 400].map(|steps| error(steps, SECOND, &mesh));
    for (pair, steps) in errors.windows(2).zip([100, 200]) {
        let order = (pair[0] / pair[1]).log2();
        close("SPIN, SECOND ORDER", &format!("order from {steps} steps"), order, 2.0, 0.1);
    }
    between("SPIN, SECOND ORDER", "error of the stress in 400 steps", errors[2], 0.0, 1e-4);
    // In single precision the order shows where rounding is far below the error.
    let single = error(100, &format!("{SECOND}\nPRECISION, SINGLE"), &mesh);
    close("SPIN, SECOND ORDER, single", "error in 100 steps over that of double", single / errors[0], 1.0, 0.05);
}

/// Eight points do not follow the command: they have that spin by themselves.
#[test]
fn eight_points_have_it_by_themselves() {
    let mesh = recipe(MESH);
    let eight = |lines: &str| error(100, &format!("ELEMENT, 1, EIGHT POINTS\n{lines}"), &mesh);
    let without = eight("");
    assert!(without == eight(SECOND) && without == eight("SPIN, FIRST ORDER"), "{without:e}");
    // That of one point in as many steps: a mean strain is all there is.
    let one = error(100, SECOND, &mesh);
    close("EIGHT POINTS", "error of the stress in 100 steps over that of one point", without / one, 1.0, 1e-3);
}

/// A run does not go on with another spin than it began with, and the log says which it has.
#[test]
fn a_restart_with_another_spin_is_refused() {
    let desk = Desk::new();
    desk.put("shear.mesh", MESH);
    desk.put("again.mesh", MESH);
    desk.put("shear.i", &deck(100, &format!("{SECOND}\nWRITE RESTART, 0.5")));
    assert_eq!(desk.urto(&["shear.i"]).code, Some(0));
    let log = desk.text("shear.o");
    assert!(log.contains("SPIN OF HEXAHEDRA WITH ONE POINT"), "{log}");
    desk.put("again.i", &deck(100, ""));
    let refused = desk.urto(&["run", "again.i", "--restart", "shear.rsout"]);
    println!("{}", refused.err);
    assert_eq!(refused.code, Some(2));
    assert!(refused.err.contains("SPIN"), "{}", refused.err);
}
