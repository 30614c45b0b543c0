//! Trusses: B4, a ring that is thrown outwards, and the same bits wherever they are computed.

use crate::support::meshes::recipe;
use crate::support::run::{Run, run, run_on};
use crate::support::steel::{E, RHO, bar_speed};
use crate::support::{between, close};

fn text(path: &str) -> String {
    std::fs::read_to_string(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a file")
}

/// Times at which the ball turns back on its own side: its velocity along x passes zero from above.
fn returns(run: &Run) -> Vec<f64> {
    let speed = |state: &crate::support::run::State| state.nodal("VELX")[1];
    let pairs = run.states.windows(2).filter(|pair| speed(&pair[0]) > 0.0 && speed(&pair[1]) <= 0.0);
    pairs
        .map(|pair| {
            let (a, b) = (speed(&pair[0]), speed(&pair[1]));
            pair[0].time + (pair[1].time - pair[0].time) * a / (a - b)
        })
        .collect()
}

/// B4: the period of a pendulum of 1 m that swings by 60 degrees, 4 √(l/g) K(sin 30°) = 2.1529 s, and the energy.
#[test]
fn b4_truss_pendulum() {
    let mesh = recipe(&text("meshes/truss_pendulum.mesh"));
    let swing = run(&text("decks/truss_pendulum.i"), &mesh);
    let returns = returns(&swing);
    assert_eq!(returns.len(), 2, "{returns:?}");
    close("B4", "first period [s]", returns[0], 2.1529, 1e-3);
    close("B4", "second period [s]", returns[1] - returns[0], 2.1529, 1e-3);
    // Over the largest kinetic energy: at the turning points all accounts are nearly empty. What is left comes from steps that
    // change as the truss is stretched, by parts in 10⁵.
    let most = swing.lines.iter().map(|line| line.totals.kinetic).fold(0.0, f64::max);
    let worst = swing.lines.iter().map(|line| (line.totals.imbalance(0.0) / most).abs()).fold(0.0, f64::max);
    between("B4", "worst imbalance over the largest kinetic energy", worst, 0.0, 1e-5);
    let x = swing.end().positions(&mesh);
    let length = (0..3).map(|i| (x[1][i] - x[0][i]).powi(2)).sum::<f64>().sqrt();
    close("B4", "length [m]", length, 1.0, 1e-3);
}

/// Radius of a ring of trusses, length.
const RADIUS: f64 = 0.05;

/// A ring of so many trusses of steel that is thrown outwards, with a state at every step.
fn thrown_ring(count: usize, speed: f64, law: &str, scale: f64, end: f64) -> (Run, Vec<[f64; 2]>) {
    let at = |i: usize| {
        let angle = std::f64::consts::TAU * (i % count) as f64 / count as f64;
        format!("{:?}, {:?}, 0.", RADIUS * angle.cos(), RADIUS * angle.sin())
    };
    let pieces: String = (0..count).map(|i| format!("LINE, 1, {}, {}, 1\n", at(i), at(i + 1))).collect();
    let mesh = recipe(&format!("TITLE\n ring\n{pieces}MERGE\n"));
    let deck = format!(
        "TITLE\n ring\nTERMINATION TIME, {end:?}\nTIME STEP SCALE, {scale:?}\nPLOT TIME, 1.E-9\nPLOT NODAL, DISPLACEMENT\n\
         TRUSS AREA, 1, 1.E-6\nINITIAL VELOCITY RADIAL, 1, {speed:?}\nMATERIAL, 1, {law}, {RHO:?}\nYOUNGS MODULUS = {E:?}\n\
         POISSONS RATIO = 0.3\n{}END\n",
        if law == "ELASTIC" { String::new() } else { format!("YIELD STRESS = {YIELD:?}\nHARDENING MODULUS = 0.\n") }
    );
    let run = run(&deck, &mesh);
    let growth = run.states.iter().map(|state| [state.time, state.nodal("DISPLX")[0]]).collect();
    (run, growth)
}

const YIELD: f64 = 3e8;

/// An elastic ring swings at ω = c/R whatever the number of trusses, and would grow by v/ω. Central differences that take the speed at
/// the start for that of the middle of the first step swing at sin(½ω'Δt) = ½ωΔt by v/(ω √(1 − ¼ω²Δt²)), which is 0.5 % more with 30
/// trusses: all of it is the step's, and falls with its square.
#[test]
fn an_elastic_ring_that_is_thrown_grows_as_central_differences_do() {
    let omega = bar_speed() / RADIUS;
    for (count, scale) in [(15, 1.0), (30, 1.0), (30, 0.5), (60, 1.0)] {
        let (run, growth) = thrown_ring(count, 0.1, "ELASTIC", scale, 1.9e-5);
        let [[before, a], [now, b]] = [growth[4], growth[5]];
        let half = 0.5 * omega * (now - before);
        let turn = 2.0 * half.asin();
        let found = (a * a + b * b - 2.0 * a * b * turn.cos()).sqrt() / turn.sin();
        let case = format!("ring of {count}, scale {scale}");
        close(&case, "growth over v/ω", found * omega / 0.1, 1.0 / (1.0 - half * half).sqrt(), 1e-4);
        between(&case, "worst energy balance", run.worst_balance(), 0.0, 1e-4);
    }
}

/// A ring that flows turns its kinetic energy into work, ½ρv² = Y (ε − ½ε_Y). Its nodes feel no force before the end of the first step:
/// of what a step longer than the elastic rise flows, ½ (vΔt/R − ε_Y) is without resistance, and comes on top.
#[test]
fn a_plastic_ring_that_is_thrown_flows_half_a_step_without_resistance() {
    let (speed, rise) = (100.0, YIELD / E);
    for (scale, tolerance) in [(1.0, 1e-3), (0.5, 1e-3), (0.25, 1e-3)] {
        let (_, growth) = thrown_ring(30, speed, "ELASTIC PLASTIC", scale, 2e-4);
        let first = speed * growth[1][0] / RADIUS;
        let strain = 0.5 * RHO * speed * speed / YIELD + 0.5 * rise + 0.5 * (first - rise).max(0.0);
        let found = growth.iter().map(|[_, growth]| *growth).fold(0.0, f64::max);
        close(&format!("plastic ring, scale {scale}"), "growth [m]", found, RADIUS * strain.exp_m1(), tolerance);
    }
}

/// A net of trusses between two posts of hexahedra, pulled sideways: one rank, three ranks.
#[test]
fn trusses_and_hexahedra_have_the_same_bits_on_any_ranks() {
    let mut mesh = String::from(
        "TITLE\n posts\nBOX, 1, 0., 0., 0., 1., 1., 4., 1, 1, 4\nBOX, 1, 6., 0., 0., 1., 1., 4., 1, 1, 4\n\
         NODE SET PLANE, 1, Z, 0.\nNODE SET PLANE, 2, Z, 4.\n",
    );
    for level in 1..=4 {
        mesh += &format!(
            "LINE, 2, 1., 0., {level}., 6., 0., {level}., 1\nLINE, 2, 1., 1., {level}., 6., 1., {}., 1\n",
            level - 1
        );
    }
    mesh += "MERGE\n";
    let mesh = recipe(&mesh);
    let deck = "TITLE\n posts\nTERMINATION TIME, 2.E-2\nPLOT TIME, 5.E-3\nPLOT NODAL, DISPLACEMENT, VELOCITY\n\
                PLOT ELEMENT, STRESS, ENERGY\nPLOT STATE, EQPS\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\n\
                NO DISPLACEMENT, Z, 1\nFUNCTION, 1\n0., 0.\n1.E-2, 1.\n1., 1.\nEND\nPRESCRIBED FORCE, X, 2, 1, 2.E6\n\
                TRUSS AREA, 2, 1.E-2\nMATERIAL, 1, ELASTIC, 2000.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.2\nEND\n\
                MATERIAL, 2, ELASTIC PLASTIC, 8000.\nYOUNGS MODULUS = 2.E10\nPOISSONS RATIO = 0.3\nYIELD STRESS = 2.E7\nEND\n";
    let runs = [1, 3].map(|ranks| run_on(ranks, deck, &mesh).whole());
    let most = runs[0].end().element("EQPS").iter().fold(0.0f64, |m, x| m.max(*x));
    assert!(most > 1e-4, "trusses flow: {most}");
    between("trusses on posts", "worst energy balance", runs[0].worst_balance(), 0.0, 1e-4);
    let [one, three] = &runs;
    for (a, b) in one.states.iter().zip(&three.states) {
        for name in ["DISPLX", "DISPLY", "DISPLZ", "VELX", "VELY", "VELZ"] {
            assert!(a.nodal(name).iter().zip(b.nodal(name)).all(|(x, y)| x.to_bits() == y.to_bits()), "{name}");
        }
        for name in ["SIGXX", "SIGYY", "TAUXY", "ENERGY", "EQPS"] {
            assert!(a.element(name).iter().zip(b.element(name)).all(|(x, y)| x.to_bits() == y.to_bits()), "{name}");
        }
    }
}
