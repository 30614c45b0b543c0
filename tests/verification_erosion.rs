//! Edges against edges, overlaps of the mesh, and erosion.

mod support;

use support::meshes::recipe;
use support::run::{run, run_on};
use urto::mesh::Mesh;

/// Two steel cubes of edge 1 cm, 3 elements along an edge, standing on edges that cross at right angles: extreme 9.
fn cubes_on_edge(gap: f64) -> Mesh {
    let half = 0.01 / 2f64.sqrt();
    recipe(&format!(
        "TITLE\n two cubes\n\
         BOX, 1, -0.005, -0.005, -0.005, 0.01, 0.01, 0.01, 3, 3, 3\nROTATE, 1, X, 45.\nTRANSLATE, 1, 0., 0., {}\n\
         BOX, 2, -0.005, -0.005, -0.005, 0.01, 0.01, 0.01, 3, 3, 3\nROTATE, 2, Y, 45.\nTRANSLATE, 2, 0., 0., {}\n",
        -half - 0.5 * gap,
        half + 0.5 * gap
    ))
}

fn colliding(edges: &str, time: f64) -> String {
    format!(
        "TITLE\n cubes\nTERMINATION TIME, {time}\nOUTPUT TIME, 1.E-6\nPLOT TIME, 1.E-5\nPLOT NODAL, VELOCITY, CONTACT\n\
         INITIAL VELOCITY MATERIAL, 1, 0., 0., 20.\nINITIAL VELOCITY MATERIAL, 2, 0., 0., -20.\n\
         CONTACT MATERIAL\nCONTACT EDGES, {edges}\n\
         MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n\
         MATERIAL, 2, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n"
    )
}

/// Mean z velocity of a block's nodes, with equal weights.
fn mean_velocity(mesh: &Mesh, velocities: &[f64], block: usize) -> f64 {
    let mut nodes: Vec<u32> = mesh.blocks[block].connectivity.iter().flatten().copied().collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes.iter().map(|&n| velocities[n as usize]).sum::<f64>() / nodes.len() as f64
}

#[test]
fn crossing_edges_collide() {
    let mesh = cubes_on_edge(1e-5);
    let bounced = run(&colliding("ON", 4e-5), &mesh);
    let v = bounced.end().nodal("VELZ");
    let (lower, upper) = (mean_velocity(&mesh, v, 0), mean_velocity(&mesh, v, 1));
    println!("edges: {lower} {upper}, balance {}", bounced.worst_balance());
    // They part again; impact excites vibrations, so less than 20 m/s is left for the flight.
    assert!(lower < -10.0 && upper > 10.0, "{lower} {upper}");
    assert!((lower + upper).abs() < 1e-9 * upper, "not mirror images: {lower} {upper}");
    // Extreme 9: no energy is made; stopping nodal masses dead may take a little out. The balance itself is exact for a
    // constant step only, and the step follows the strain of 1e-3 here.
    assert!(bounced.worst_balance() < 1e-4, "{}", bounced.worst_balance());
    let contact = bounced.last().totals.contact / bounced.initial_energy;
    println!("contact work {contact}");
    assert!((-0.05..0.01).contains(&contact), "{contact}");
    // Without the check they pass through each other, as in PRONTO: that is what the check is for.
    let passed = run(&colliding("OFF", 4e-5), &mesh);
    let v = passed.end().nodal("VELZ");
    println!("without: {} {}", mean_velocity(&mesh, v, 0), mean_velocity(&mesh, v, 1));
}

/// Extreme 13: an overlap of a fifth of an element goes without giving velocity.
#[test]
fn initial_overlap_goes_without_velocity() {
    let mesh = recipe(
        "TITLE\n overlap\nBOX, 1, 0., 0., 0., 0.01, 0.01, 0.01, 3, 3, 3\n\
         BOX, 2, 0.001, 0.002, 0.00933333333, 0.01, 0.01, 0.01, 4, 4, 4\n",
    );
    let deck = "TITLE\n overlap\nTERMINATION TIME, 2.E-5\nPLOT TIME, 1.E-5\nPLOT NODAL, VELOCITY\nCONTACT MATERIAL\n\
         MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n\
         MATERIAL, 2, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";
    let left = run(deck, &mesh);
    let moved: Vec<f64> = left.states[0].nodal("DISPLZ").iter().map(|u| u.abs()).filter(|&u| u > 0.0).collect();
    println!("moved {} nodes by up to {}", moved.len(), moved.iter().fold(0.0f64, |m, &u| m.max(u)));
    // The overlap was 0.667 mm; both sides go a part of it.
    assert!(!moved.is_empty() && moved.iter().all(|&u| u < 0.000667));
    // Scale: the kinetic energy of one body at 1 mm/s is 4e-9 J.
    let last = left.last().totals;
    assert!(last.kinetic < 1e-12 && last.internal < 1e-12, "{} {}", last.kinetic, last.internal);
}

/// A bar pulled apart: the middle fails, both halves fly on. Mass and momentum stay, the balance closes.
fn pulled(keeps: &str) -> (Mesh, String) {
    let mesh = recipe(
        "TITLE\n bar\nBOX, 1, 0., 0., 0., 0.01, 0.01, 0.04, 3, 3, 12\n\
         SPLIT BLOCK, 1, 2, , , , , 0.0166666666, 0.0233333333\n",
    );
    // The ends, pulled at 8 m/s, stay elastic below ρ c v = 315 MPa.
    let material = |block: usize| {
        let yield_stress = if block == 1 { 400e6 } else { 100e6 };
        format!(
            "MATERIAL, {block}, ELASTIC PLASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\n\
             YIELD STRESS = {yield_stress}\nHARDENING MODULUS = 0.\nBETA = 1.\nEND\n"
        )
    };
    let deck = format!(
        "TITLE\n bar\nTERMINATION TIME, 2.E-4\nOUTPUT TIME, 1.E-6\nPLOT TIME, 2.E-5\nPLOT NODAL, VELOCITY\n\
         PLOT STATE, EQPS\nINITIAL VELOCITY MATERIAL, 1, 0., 0., 0.\n\
         FUNCTION, 1\n0., 1.\nEND\nPRESCRIBED VELOCITY, Z, 1, 1, -8.\nPRESCRIBED VELOCITY, Z, 2, 1, 8.\n\
         CONTACT MATERIAL\nDEATH, 2, EQPS, MAX, 0.1, {keeps}\n{}{}",
        material(1),
        material(2)
    );
    let mut mesh = mesh;
    support::meshes::add_node_set(&mut mesh, 1, |p| p[2] < 1e-9);
    support::meshes::add_node_set(&mut mesh, 2, |p| p[2] > 0.04 - 1e-9);
    (mesh, deck)
}

#[test]
fn a_bar_that_tears_keeps_its_books() {
    for keeps in ["FREE", "DROP"] {
        let (mesh, deck) = pulled(keeps);
        let torn = run(&deck, &mesh);
        let gone = torn.end().element("STATUS").iter().filter(|&&status| status == 0.0).count();
        let totals = torn.last().totals;
        println!(
            "{keeps}: {gone} gone, eroded {} of {}, balance {}",
            totals.eroded,
            totals.external,
            torn.worst_balance()
        );
        assert!(gone >= 9, "{gone}");
        assert!(totals.eroded > 0.0);
        // Of the forces of what dies, the hourglass part of the last half step is not booked.
        assert!(torn.worst_balance() < 1e-3, "{}", torn.worst_balance());
    }
}

#[test]
fn erosion_is_the_same_on_any_number_of_ranks() {
    let (mesh, deck) = pulled("FREE");
    let one = run(&deck, &mesh);
    assert!(one.last().totals.eroded > 0.0);
    for ranks in [2, 3, 7] {
        let many = run_on(ranks, &deck, &mesh).whole();
        for name in ["VELX", "VELY", "VELZ"] {
            assert_eq!(one.end().nodal(name), many.end().nodal(name), "{name} on {ranks} ranks");
        }
        assert_eq!(one.end().element("STATUS"), many.end().element("STATUS"));
        assert_eq!(one.last().totals, many.last().totals);
    }
}
