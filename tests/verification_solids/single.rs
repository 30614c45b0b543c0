//! PRECISION, SINGLE beside double: what it still holds, and by how much it differs.
//!
//! `cargo test --test verification_solids single:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::program::Desk;
use crate::support::continued::{Case, assert_same};
use crate::support::flow::alone;
use crate::support::meshes::{add_node_set, brick, nodes_where, recipe};
use crate::support::run::{Run, model, run, run_on};
use crate::support::{between, close, steel};
use urto::comm::Serial;
use urto::mesh::Mesh;
use urto::solver::Request;

const BEAM: &str = include_str!("../../decks/bending_beam_4.i");
const BAR: &str = include_str!("../../decks/bar_wave.i");
const TAYLOR: &str = include_str!("../../decks/taylor_bar.i");
const TAYLOR_MESH: &str = include_str!("../../meshes/taylor_bar.mesh");
const MATERIALS: &str = include_str!("../../decks/materials.i");
const STEEL: &str = "MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";

fn in_single(deck: &str) -> String {
    let single = deck.replacen("TITLE", "PRECISION, SINGLE\nTITLE", 1);
    if single == deck { format!("PRECISION, SINGLE\n{deck}") } else { single }
}

/// A run in double and one in single precision.
fn both(deck: &str, mesh: &Mesh) -> [Run; 2] {
    [run(deck, mesh).whole(), run(&in_single(deck), mesh).whole()]
}

fn deviation(name: &str, [double, single]: &[Run; 2]) -> f64 {
    let (a, b) = (double.end().nodal(name), single.end().nodal(name));
    let size = a.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    a.iter().zip(b).fold(0.0f64, |most, (a, b)| most.max((a - b).abs())) / size
}

/// V-01: the plateau behind an elastic wave.
#[test]
fn v01_bar_wave() {
    let runs = both(BAR, &recipe(include_str!("../../meshes/bar_wave.mesh")));
    let plateau = -steel::RHO * steel::bar_speed();
    let stress = runs[1].at(150e-6).element("SIGXX");
    let behind = &stress[stress.len() / 50..stress.len() * 13 / 20];
    close("V-01 single", "plateau [Pa]", behind.iter().sum::<f64>() / behind.len() as f64, plateau, 0.005);
    between("V-01 single", "deviation of displacement", deviation("DISPLX", &runs), 0.0, 1e-5);
    between("V-01 single", "worst energy balance", runs[1].worst_balance(), 0.0, 1e-3);
}

/// V-11: the vibrating beam, two elements through its depth.
#[test]
fn v11_vibrating_beam() {
    let mesh = recipe(include_str!("../../meshes/bending_beam_2.mesh"));
    let middle = nodes_where(&mesh, |p| p[0] == 0.0 && (p[2] - 0.5).abs() < 1e-9)[0] as usize;
    let runs = both(BEAM, &mesh);
    let peak = |run: &Run| run.states.iter().map(|s| -s.nodal("DISPLZ")[middle]).fold(0.0, f64::max);
    let peaks = [peak(&runs[0]), peak(&runs[1])];
    close("V-11 single", "peak over that of double", peaks[1] / peaks[0], 1.0, 1e-5);
    close("V-11 single", "peak [in]", peaks[1], 4.722e-3, 0.01);
    between("V-11 single", "worst energy balance", runs[1].worst_balance(), 0.0, 1e-3);
    let difference = (runs[1].worst_balance() - runs[0].worst_balance()).abs();
    between("V-11 single", "difference of the balances", difference, 0.0, 1e-5);
}

/// V-15: the Taylor bar on a coarse mesh.
#[test]
fn v15_taylor_bar_coarse() {
    let text = TAYLOR_MESH.replace("8, 160, QUARTER", "3, 30, QUARTER");
    assert!(text != TAYLOR_MESH, "the recipe has changed");
    let mesh = recipe(&text);
    let runs = both(TAYLOR, &mesh);
    let shape = |run: &Run| {
        let positions = run.end().positions(&mesh);
        let foot = positions.iter().zip(&mesh.coordinates).filter(|(_, x)| x[2] == 0.0);
        let radius = foot.fold(0.0f64, |m, (p, _)| m.max(p[0].hypot(p[1])));
        let eqps = run.end().element("EQPS").iter().fold(0.0f64, |m, e| m.max(*e));
        [positions.iter().fold(0.0f64, |m, p| m.max(p[2])), radius, eqps]
    };
    let [double, single] = [shape(&runs[0]), shape(&runs[1])];
    for (what, i) in [("length", 0), ("foot radius", 1), ("largest plastic strain", 2)] {
        close("V-15 single, n=3", &format!("{what} over that of double"), single[i] / double[i], 1.0, 1e-4);
    }
    close("V-15 single, n=3", "length [mm]", 1e3 * single[0], 21.42, 0.01);
    close("V-15 single, n=3", "foot radius [mm]", 1e3 * single[1], 7.22, 0.03);
    between("V-15 single, n=3", "worst energy balance", runs[1].worst_balance(), 0.0, 1e-3);
}

/// A cube spins freely for so many steps; what of it has drifted.
fn spin(steps: usize) -> [f64; 5] {
    let omega = 1e4;
    let mesh = brick([1, 1, 1], [1e-3; 3]);
    let deck = format!(
        "PRECISION, SINGLE\nTERMINATION TIME, 1.\nTIME STEP SCALE, 0.9\nBULK VISCOSITY, 0., 0.\n\
         INITIAL VELOCITY ANGULAR, 1, {omega}, 5.E-4, 5.E-4, 0., 0., 0., 1.\n{STEEL}"
    );
    let mut solver = alone(&mesh, &model(&deck, &mesh));
    solver.prepare(Request::Continue, &mut Serial).expect("stable");
    let begun = solver.totals(&mut Serial);
    for _ in 0..steps {
        solver.advance();
        solver.prepare(Request::Continue, &mut Serial).expect("stable");
    }
    let totals = solver.totals(&mut Serial);
    let block = &solver.domain.blocks[0];
    let group = block.groups().into_iter().find(|group| group.len() == 1).expect("the element");
    let length = block.element.frame(group, 0, &solver.domain.nodes)[0].iter().map(|c| c * c).sum::<f64>().sqrt() - 1.0;
    let u = block.element.stretch(group, 0, &solver.domain.nodes);
    let volume =
        u.xx * (u.yy * u.zz - u.yz * u.yz) - u.xy * (u.xy * u.zz - u.yz * u.zx) + u.zx * (u.xy * u.yz - u.yy * u.zx);
    let strain = volume - block.element.volume(group, 0, &solver.domain.nodes) / 1e-9;
    let size = solver.initial_energy / (omega * 1e-3);
    let linear = (0..3).map(|i| (totals.momentum[i] - begun.momentum[i]).abs()).fold(0.0, f64::max) / size;
    let energy = (totals.kinetic + totals.internal + totals.hourglass) / solver.initial_energy - 1.0;
    let turns = omega * solver.time / std::f64::consts::TAU;
    println!(
        "single, {steps} steps, {turns:.1} revolutions: frame {length:.1e}, det U - V/V0 {strain:.1e}, energy {energy:.1e}, \
         linear momentum {linear:.1e}"
    );
    [length.abs(), strain.abs(), energy.abs(), linear, turns]
}

/// Extreme 21 with fewer steps.
#[test]
fn ten_thousand_steps_of_spin() {
    let [frame, strain, energy, momentum, _] = spin(10_000);
    assert!(frame < 5e-7 && strain < 1e-6 && energy < 1e-5 && momentum < 1e-10);
}

/// Extreme 21 as it is.
#[test]
#[ignore = "takes long"]
fn a_million_steps_of_spin() {
    let [frame, strain, energy, momentum, _] = spin(1_000_000);
    assert!(frame < 5e-7 && strain < 1e-5 && energy < 1e-4 && momentum < 1e-9);
}

/// A cube is drawn out by a strain of a thousandth in so many equal steps: without what is carried along, additions of
/// 10⁻⁸ to a stretch of one would all be lost.
fn drawn_slowly(steps: f64) -> [f64; 2] {
    let mut mesh = brick([1, 1, 1], [1.0; 3]);
    add_node_set(&mut mesh, 31, |x| x[0] == 0.0);
    add_node_set(&mut mesh, 32, |x| x[0] == 1.0);
    add_node_set(&mut mesh, 33, |_| true);
    let time = steps * 1e-4;
    let deck = format!(
        "PRECISION, SINGLE\nTERMINATION TIME, {time:e}\nTIME STEP MAXIMUM, 1.E-4\nPLOT ELEMENT, STRESS, STRAIN\nBULK VISCOSITY, 0., 0.\n\
         NO DISPLACEMENT, X, 31\nNO DISPLACEMENT, Y, 33\nNO DISPLACEMENT, Z, 33\nFUNCTION, 1\n0., 1.\n1., 1.\n1.E9, 1.\nEND\n\
         PRESCRIBED VELOCITY, X, 32, 1, {:e}\n\
         MATERIAL, 1, ELASTIC, 1.E3\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.\nEND\n",
        1e-3 / time
    );
    let run = run(&deck, &mesh).whole();
    let strain = run.end().element("EPSXX")[0] / 1.001f64.ln() - 1.0;
    let stress = run.end().element("SIGXX")[0] / (1e9 * 1.001f64.ln()) - 1.0;
    println!("single, strain of 1e-3 in {steps} steps: strain off by {strain:.1e}, stress by {stress:.1e}");
    [strain.abs(), stress.abs()]
}

#[test]
fn small_additions_are_not_lost() {
    let [strain, stress] = drawn_slowly(1e5);
    assert!(strain < 1e-4 && stress < 1e-4);
}

/// Far from the origin and fast, a block vibrates as it does there at rest.
#[test]
fn far_from_the_origin() {
    let deck = |speed: f64| {
        format!(
            "PRECISION, SINGLE\nTERMINATION TIME, 1.E-3\nPLOT ELEMENT, STRESS\nPLOT NODAL, VELOCITY\nBULK VISCOSITY, 0., 0.\n\
             INITIAL VELOCITY MATERIAL, 1, {speed}, 0., 0.\nINITIAL VELOCITY NODESET, 44, {}, 0., 0.\n{STEEL}",
            speed + 1.0
        )
    };
    let mut here = brick([2, 2, 2], [0.25; 3]);
    add_node_set(&mut here, 44, |x| x[0] == 0.0);
    let mut there = here.clone();
    there.coordinates.iter_mut().for_each(|x| *x = x.map(|c| c + 1048576.0));
    let [a, b] = [run(&deck(0.0), &here).whole(), run(&deck(1024.0), &there).whole()];
    let (a, b) = (a.end().element("SIGXX"), b.end().element("SIGXX"));
    let size = a.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let worst = a.iter().zip(b).fold(0.0f64, |most, (a, b)| most.max((a - b).abs())) / size;
    between("single far away", "deviation of stress", worst, 0.0, 1e-4);
}

/// Every law on one, two and three ranks, and beside double precision.
#[test]
fn every_law_with_the_same_bits_on_any_ranks() {
    let mesh = recipe(include_str!("../../meshes/materials.mesh"));
    // Steps of the same length: states at other times would differ as much as crushing foam does in a millionth of the run.
    let steady = MATERIALS.replacen("TERMINATION TIME", "TIME STEP MAXIMUM, 6.E-8\nTERMINATION TIME", 1);
    let deck = in_single(&steady);
    let runs = [1, 2, 3].map(|ranks| run_on(ranks, &deck, &mesh).whole());
    let bits = |run: &Run| -> Vec<u64> {
        let of = |name: &str| run.states.iter().flat_map(|state| state.element(name)).map(|x| x.to_bits()).collect();
        ["SIGXX", "SIGZZ", "PRESSURE", "ENERGY", "EQPS"].into_iter().flat_map(|name| -> Vec<u64> { of(name) }).collect()
    };
    assert!(runs[1..].iter().all(|other| bits(other) == bits(&runs[0])), "bits depend on ranks");
    let double = run(&steady, &mesh).whole();
    for block in 0..14 {
        let history = |run: &Run| -> Vec<f64> {
            run.states.iter().flat_map(|state| state.element("SIGZZ")[8 * block..8 * block + 8].to_vec()).collect()
        };
        let (a, b) = (history(&double), history(&runs[0]));
        let size = a.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let worst = a.iter().zip(b).fold(0.0f64, |most, (a, b)| most.max((a - b).abs())) / size;
        let law = runs[0].model.materials[block].law.entry().name;
        between("single, every law", &format!("deviation of {law}"), worst, 0.0, 1e-5);
    }
    between("single, every law", "worst energy balance", runs[0].worst_balance(), 0.0, 1e-5);
}

/// One element at a last state of SIGXX and SIGYY, drawn along x by a strain, along y by another, and held along z.
fn drawn([along_x, along_y]: [f64; 2], law: &str) -> [f64; 2] {
    let mesh = recipe(
        "TITLE\n ELEMENT\nBOX, 1, 0., 0., 0., 0.7, 1.1, 0.9, 1, 1, 1\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 0.7\n\
         NODE SET PLANE, 3, Y, 0.\nNODE SET PLANE, 4, Y, 1.1\nNODE SET PLANE, 5, Z, 0.\nNODE SET PLANE, 5, Z, 0.9\n",
    );
    let deck = format!(
        "TERMINATION TIME, 1.\nTIME STEP MAXIMUM, 5.E-3\nPLOT TIME, 1.\nPLOT ELEMENT, STRESS\nBULK VISCOSITY, 0., 0.\n\
         FUNCTION, 1\n0., 0.\n1., 1.\nEND\nFUNCTION, 7\n0., 0.\n0.4, 20.\nEND\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 3\n\
         NO DISPLACEMENT, Z, 5\nPRESCRIBED DISPLACEMENT, X, 2, 1, {:e}\nPRESCRIBED DISPLACEMENT, Y, 4, 1, {:e}\n{law}",
        0.7 * along_x,
        1.1 * along_y
    );
    let end = run(&in_single(&deck), &mesh).whole();
    ["SIGXX", "SIGYY"].map(|name| end.end().element(name)[0])
}

/// Rubber with K = 1000 μ in pure shear at constant volume, λ and 1/λ: the deviator of 2 (C₁₀ + C₀₁ I₁) b − 2 C₀₁ b² and no pressure.
#[test]
fn small_strains_of_rubber() {
    let (c10, c01) = (0.4, 0.1);
    let law = "MATERIAL, 1, MOONEY RIVLIN, 1.E8\nC10 = 0.4\nC01 = 0.1\nBULK MODULUS = 1000.\nEND\n";
    for strain in [1e-5, 1e-4, 1e-3, 1e-2] {
        let l = 1.0 + strain;
        let b = [l * l, 1.0 / (l * l), 1.0];
        let first: f64 = b.iter().sum();
        let full = b.map(|b| 2.0 * ((c10 + c01 * first) * b - c01 * b * b));
        let mean = full.iter().sum::<f64>() / 3.0;
        let found = drawn([strain, 1.0 / l - 1.0], law);
        for i in 0..2 {
            close("small strains of rubber, single", &format!("stress at {strain:e}"), found[i], full[i] - mean, 1e-4);
        }
    }
}

/// Soil with a modulus of 50 in p = f(−ln V/V₀) and 2μ = 60, pressed with held sides: σ = −(50 + 40) ε, and −(50 − 20) ε across.
#[test]
fn small_strains_of_soil() {
    let law = "MATERIAL, 1, SOIL N FOAMS, 1.E8\nTWO MU = 60.\nBULK MODULUS = 100.\nA0 = 5.\nPRESSURE CUTOFF = 0.2\nFUNCTION ID = 7\nEND\n";
    for strain in [1e-6, 1e-5, 1e-4, 1e-2] {
        let found = drawn([-strain, 0.0], law);
        let logarithmic = -libm::log1p(-strain);
        close("small strains of soil, single", &format!("stress at {strain:e}"), found[0], -90.0 * logarithmic, 2e-5);
        close(
            "small strains of soil, single",
            &format!("stress across at {strain:e}"),
            found[1],
            -30.0 * logarithmic,
            2e-5,
        );
    }
}

/// A run that goes on from a state is the one that never stopped, to the bit.
#[test]
fn restarts_keep_what_is_carried() {
    let case = Case::new(&in_single(MATERIALS), recipe(include_str!("../../meshes/materials.mesh")));
    let begun = case.part(1, None, 120);
    let whole = case.part(2, None, 200);
    let continued = case.part(3, Some(&begun.end), 80);
    assert_same("single precision", &whole, &continued);
}

/// A state of one precision is no state of the other.
#[test]
fn a_restart_in_another_precision_is_refused() {
    let desk = Desk::new();
    desk.put("b.mesh", "TITLE\n B\nBOX, 1, 0., 0., 0., 1., 1., 1., 2, 2, 2\n");
    let deck = |more: &str| {
        format!(
            "TITLE\n B\n{more}TERMINATION TIME, 1.E-4\nWRITE RESTART, 1.E-4\nINITIAL VELOCITY MATERIAL, 1, 1., 0., 0.\n{STEEL}EXIT\n"
        )
    };
    desk.put("b.i", &deck("PRECISION, SINGLE\n"));
    assert_eq!(desk.urto(&["b.i"]).code, Some(0));
    desk.put("c.i", &deck(""));
    desk.put("c.mesh", "TITLE\n B\nBOX, 1, 0., 0., 0., 1., 1., 1., 2, 2, 2\n");
    let refused = desk.urto(&["run", "c.i", "--restart", "b.rsout"]);
    println!("{}", refused.err);
    assert_eq!(refused.code, Some(2));
    assert!(refused.err.contains("PRECISION"), "{}", refused.err);
}

/// Extreme 4 in single precision: almost incompressible.
#[test]
fn extreme_4_almost_incompressible() {
    for nu in [0.499, 0.4999] {
        let material = STEEL.replace("0.3", &nu.to_string());
        let deck = format!(
            "TERMINATION TIME, 200.E-6\nOUTPUT TIME, 1.E-6\nPLOT NODAL, DISPLACEMENT\nBULK VISCOSITY, 0., 0.\nINITIAL VELOCITY NODESET, 2, 10., 0., 0.\n{material}"
        );
        let runs = both(&deck, &brick([4, 4, 4], [0.1, 0.1, 0.1]));
        let case = format!("extreme 4 single, nu={nu}");
        between(&case, "worst energy balance", runs[1].worst_balance(), 0.0, 1e-3);
        between(&case, "deviation of displacement", deviation("DISPLX", &runs), 0.0, 1e-3);
    }
}

/// Extreme 23 in single precision: copper spalls. The pressure has the digits of the volume.
#[test]
fn extreme_23_spall() {
    let (cells, edge) = (150, 100e-6);
    let mut mesh = brick([cells, 1, 1], [cells as f64 * edge, edge, edge]);
    let length = |n: usize| n as f64 * edge;
    add_node_set(&mut mesh, 21, |x| x[0] < length(50) - 0.5 * edge);
    add_node_set(&mut mesh, 22, |x| (x[0] - length(50)).abs() < 0.5 * edge);
    add_node_set(&mut mesh, 23, |_| true);
    let deck = "TERMINATION TIME, 7.E-6\nOUTPUT TIME, 0.05E-6\nPLOT TIME, 0.05E-6\nPLOT NODAL, VELOCITY, DISPLACEMENT\n\
                PLOT ELEMENT, PRESSURE, DENSITY\nNO DISPLACEMENT, Y, 23\nNO DISPLACEMENT, Z, 23\n\
                INITIAL VELOCITY NODESET, 21, 200., 0., 0.\nINITIAL VELOCITY NODESET, 22, 100., 0., 0.\n\
                MATERIAL, 1, HYDRODYNAMIC, 8930.\nPRESSURE CUTOFF = -1.E9\nEND\n\
                EQUATION OF STATE, 1, MG US-UP\nC0 = 3940.\nS = 1.489\nGAMMA = 2.02\nEND\n";
    let runs = both(deck, &mesh);
    between("extreme 23 single", "worst energy balance", runs[1].worst_balance(), 0.0, 1e-3);
    between("extreme 23 single", "deviation of displacement", deviation("DISPLX", &runs), 0.0, 1e-3);
    let lowest = runs[1].states.iter().flat_map(|state| state.element("PRESSURE")).copied().fold(0.0, f64::min);
    close("extreme 23 single", "largest tension", -lowest, 1e9, 1e-5);
}

/// Units in which products of lengths leave the range of single precision are refused, with what to do.
#[test]
fn what_cannot_be_held_is_refused() {
    let desk = Desk::new();
    let deck = format!("TITLE\n B\nPRECISION, SINGLE\nTERMINATION TIME, 1.E-4\n{STEEL}EXIT\n");
    for (size, code) in [("1.E-9", 2), ("1.E-3", 0), ("1.E9", 2)] {
        desk.put("b.mesh", &format!("TITLE\n B\nBOX, 1, 0., 0., 0., {size}, {size}, {size}, 2, 2, 2\n"));
        desk.put("b.i", &deck);
        let checked = desk.urto(&["check", "b.i"]);
        assert_eq!(checked.code, Some(code), "{size}: {}", checked.err);
        assert!(code == 0 || checked.err.contains("PRECISION, SINGLE cannot hold"), "{}", checked.err);
    }
}

/// What stands in for dead elements has to do with the size of elements, not with where the body is: far from the origin its mass times its volume
/// left the range of 32 bits, and the run ended with an element that had died long before "inverted".
#[test]
fn elements_die_far_from_the_origin() {
    let deck = "TERMINATION TIME, 1.E-4\nPLOT TIME, 1.E-4\nPLOT ELEMENT, STATUS\nNO DISPLACEMENT, X, 1\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\n\
         PRESCRIBED VELOCITY, X, 2, 1, 100.\nDEATH, 1, EQPS, MAX, 0.05\nMATERIAL, 1, ELASTIC PLASTIC, 7850.\nYOUNGS MODULUS = 200.E9\n\
         POISSONS RATIO = 0.3\nYIELD STRESS = 300.E6\nHARDENING MODULUS = 1.E9\nBETA = 1.\nEND\n";
    let alive = |offset: f64| {
        let mesh = recipe(&format!(
            "TITLE\n bar\nBOX, 1, {offset:?}, 0., 0., 0.1, 0.02, 0.02, 10, 2, 2\nNODE SET PLANE, 1, X, {offset:?}\n\
             NODE SET PLANE, 2, X, {:?}\n",
            offset + 0.1
        ));
        let run = run(&in_single(deck), &mesh).whole();
        run.end().element("STATUS").iter().filter(|status| **status > 0.0).count()
    };
    let near = alive(0.0);
    assert!(near < 40, "none has died");
    assert_eq!(alive(1e4), near);
}
