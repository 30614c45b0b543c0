//! Trusses: B4, and the same bits wherever they are computed.

use crate::support::meshes::recipe;
use crate::support::run::{Run, run, run_on};
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
