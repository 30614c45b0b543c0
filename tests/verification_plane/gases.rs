//! Gases in two dimensions: blasts and implosions keep their energy to round-off, turn no corner inside out and stay round.

use crate::support::continued::{Case, assert_same};
use crate::support::meshes::recipe;
use crate::support::run::{Run, run};
use crate::support::{between, close};
use urto::mesh::{Block, Dimension, Mesh, NodeSet, Shape, SideSet, plane};

/// A square of n × n elements from the origin with its lower left element as block 2, and what holds its lower and left sides.
fn quarter(n: usize, size: f64) -> Mesh {
    let mut mesh = recipe(&format!(
        "TITLE\n quarter\nRECTANGLE, 1, 0., 0., {size:?}, {size:?}, {n}, {n}\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, Y, 0.\n"
    ));
    let corner: Vec<u32> = mesh.blocks[0].nodes.drain(..4).collect();
    mesh.blocks.insert(0, Block { id: 2, nodes: corner, ..mesh.blocks[0].clone() });
    mesh
}

/// Cards of a gas in a block.
fn gas(block: i64, gamma: f64, energy: f64) -> String {
    format!(
        "MATERIAL, {block}, HYDRODYNAMIC, 1.\nPRESSURE CUTOFF = 0.\nEND\n\
         EQUATION OF STATE, {block}, IDEAL GAS\nGAMMA = {gamma:?}\nINITIAL ENERGY = {energy:e}\nEND\n"
    )
}

/// Where an element began: distance from the origin, angle in degrees, and volume of the plane (1 thick) or of the whole turn.
fn place(mesh: &Mesh, about_axis: bool) -> Vec<(f64, f64, f64)> {
    let elements = mesh.blocks.iter().flat_map(|block| block.nodes.chunks(4));
    let of = |nodes: &[u32]| {
        let corners: plane::Corners = std::array::from_fn(|i| mesh.coordinates[nodes[i] as usize]);
        let [x, y] = [0, 1].map(|k: usize| corners.iter().map(|corner| corner[k]).sum::<f64>() / 4.0);
        let volume = if about_axis { std::f64::consts::TAU * plane::swept(&corners) } else { plane::area(&corners) };
        (x.hypot(y), y.atan2(x).to_degrees(), volume)
    };
    elements.map(of).collect()
}

/// What every run must hold to: energy in balance, and no corner inside out in any plot state.
#[track_caller]
fn check_sound(case: &str, gas: &Run) {
    between(case, "worst energy balance", gas.worst_balance(), 0.0, 1e-9);
    let least = gas.states.iter().flat_map(|state| state.element("CORNER")).fold(f64::INFINITY, |a, b| a.min(*b));
    between(case, "least corner in any state", least, 1e-3, 1.0);
    println!("{case} steps: {}", gas.last().step);
}

/// Volume in which a gas has been heated beyond `hot` of a sector between two angles, by the volumes of the start.
fn heated(gas: &Run, places: &[(f64, f64, f64)], hot: f64, sector: [f64; 2]) -> f64 {
    let energies = gas.end().element("EINT");
    let inside = |angle: f64| angle >= sector[0] && angle < sector[1];
    let own = |(energy, (_, angle, volume)): (&f64, &(f64, f64, f64))| {
        if *energy > hot && inside(*angle) { *volume } else { 0.0 }
    };
    energies.iter().zip(places).map(own).sum()
}

/// The blast of a point to time 1 in a gas of density 1, its energy in the corner element. `energy` is that of the part of the
/// plane or of the half space that is modelled.
fn blast(analysis: &str, n: usize, gamma: f64, energy: f64) -> (Run, Vec<(f64, f64, f64)>) {
    let mesh = quarter(n, 1.2);
    let places = place(&mesh, analysis == "AXISYMMETRIC");
    let deck = format!(
        "TITLE\n blast\n{analysis}\nTERMINATION TIME, 1.\nOUTPUT TIME, 0.01\nPLOT TIME, 0.05\nPLOT ELEMENT, EINT, CORNERS\n\
         NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 2\n{}{}",
        gas(1, gamma, 1e-6),
        gas(2, gamma, energy / places[0].2)
    );
    (run(&deck, &mesh).whole(), places)
}

/// Radii of the shock in three sectors of 30 degrees: of the circle, or of the sphere, that held the heated gas at the start.
fn radii(gas: &Run, places: &[(f64, f64, f64)], hot: f64, about_axis: bool) -> [f64; 3] {
    [[0.0, 30.0], [30.0, 60.0], [60.0, 90.1]].map(|sector| {
        let volume = heated(gas, places, hot, sector);
        if about_axis {
            // A sector is a part of the sphere between two parallels: 2π/3 R³ (sin b − sin a).
            let [a, b] = sector.map(|angle| angle.to_radians().sin());
            (1.5 * volume / (std::f64::consts::PI * (b - a))).cbrt()
        } else {
            (12.0 * volume / std::f64::consts::PI).sqrt()
        }
    })
}

fn check_round(case: &str, radii: [f64; 3], reference: f64, [near, spread]: [f64; 2]) {
    let mean = radii.iter().sum::<f64>() / 3.0;
    println!("{case}: radii by 30 degrees {radii:.4?}");
    close(case, "radius of the shock", mean, reference, near);
    let width = radii.iter().fold(0.0, |most: f64, r| most.max((r - mean).abs()));
    between(case, "largest departure of a third from round", width / mean, 0.0, spread);
}

/// Cylindrical, in plane strain: E = α ρ R⁴/t² with α = 0.98404 for γ = 1.4 (Kamm and Timmes 2007: 0.311357 for R = 0.75).
#[test]
fn blast_of_a_line() {
    for n in [30, 45] {
        // E = α for R = 1; a quarter of it. Behind the shock the speed is u = 2/(γ+1) R/2t, the energy u²/2.
        let hot = 0.25 * (2.0 / 2.4 * 0.5f64).powi(2);
        let (gas, places) = blast("PLANE STRAIN", n, 1.4, 0.25 * 0.311_357 / 0.75f64.powi(4));
        let case = format!("blast of a line, {n}");
        check_sound(&case, &gas);
        check_round(&case, radii(&gas, &places, hot, false), 1.0, [0.01, 0.03]);
    }
}

/// Spherical, about an axis: α = 0.851072.
#[test]
fn blast_of_a_point_about_an_axis() {
    for n in [30, 45] {
        let hot = 0.25 * (2.0 / 2.4 * 0.4f64).powi(2);
        let (gas, places) = blast("AXISYMMETRIC", n, 1.4, 0.5 * 0.851_072);
        let case = format!("blast of a point, {n}");
        check_sound(&case, &gas);
        check_round(&case, radii(&gas, &places, hot, true), 1.0, [0.01, 0.03]);
    }
}

/// Noh's implosion of a cylinder: the shock is at t/3, and has met what began at 4t/3; 16 times the density behind it.
#[test]
fn implosion_of_a_cylinder() {
    let mesh = quarter(60, 1.0);
    let places = place(&mesh, false);
    let deck = format!(
        "TITLE\n implosion\nPLANE STRAIN\nTERMINATION TIME, 0.6\nOUTPUT TIME, 0.01\nPLOT TIME, 0.05\n\
         PLOT ELEMENT, EINT, CORNERS, DENSITY\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 2\n\
         INITIAL VELOCITY RADIAL, 1, -1.\nINITIAL VELOCITY RADIAL, 2, -1.\n{}{}",
        gas(1, 5.0 / 3.0, 1e-6),
        gas(2, 5.0 / 3.0, 1e-6)
    );
    let gas = run(&deck, &mesh).whole();
    check_sound("implosion", &gas);
    // What has passed the shock has an energy of 1/2.
    check_round("implosion", radii(&gas, &places, 0.25, false), 0.8, [0.02, 0.03]);
    let density = gas.end().element("DENSITY");
    let behind: Vec<f64> = (density.iter().zip(&places))
        .filter(|(_, (radius, ..))| (0.35..0.7).contains(radius))
        .map(|(density, _)| *density)
        .collect();
    close("implosion", "density behind the shock", behind.iter().sum::<f64>() / behind.len() as f64, 16.0, 0.05);
}

/// A quarter of a disc of radius 1 in rays of equal angles, with triangles about its centre; sets as of [`quarter`], side set 3 is
/// the rim, block 2 the triangles.
fn rays(through: usize, around: usize) -> Mesh {
    let at = |ring: usize, ray: usize| if ring == 0 { 0 } else { (1 + (ring - 1) * (around + 1) + ray) as u32 };
    let place = |ring: usize, ray: usize| {
        let (radius, turn) = (ring as f64 / through as f64, 0.5 * std::f64::consts::PI * ray as f64 / around as f64);
        // What is on an axis is on it.
        let [x, y] = [if ray == around { 0.0 } else { turn.cos() }, if ray == 0 { 0.0 } else { turn.sin() }];
        [radius * x, radius * y, 0.0]
    };
    let mut coordinates = vec![[0.0; 3]];
    coordinates.extend((1..=through).flat_map(|ring| (0..=around).map(move |ray| place(ring, ray))));
    let of = |ring: usize| {
        (0..around).flat_map(move |ray| [at(ring, ray), at(ring + 1, ray), at(ring + 1, ray + 1), at(ring, ray + 1)])
    };
    let block = |id, nodes| Block { id, name: String::new(), shape: Shape::Plane, nodes, attributes: Vec::new() };
    let blocks = vec![block(2, of(0).collect()), block(1, (1..through).flat_map(of).collect())];
    let set = |id, axis: usize| NodeSet {
        id,
        nodes: (0..coordinates.len() as u32).filter(|&n| coordinates[n as usize][axis] == 0.0).collect(),
        ..NodeSet::default()
    };
    let rim = (0..around).map(|ray| (((through - 1) * around + ray) as u32, 1)).collect();
    Mesh {
        dimension: Dimension::Two,
        node_sets: vec![set(1, 0), set(2, 1)],
        side_sets: vec![SideSet { id: 3, sides: rim, ..SideSet::default() }],
        node_ids: (1..=coordinates.len() as i64).collect(),
        element_ids: (1..=(through * around) as i64).collect(),
        coordinates: coordinates.into(),
        blocks,
        ..Mesh::default()
    }
}

/// How far from round a flow on rays is: the largest departure of an element's density from the mean of its ring, over it; and the
/// means.
fn of_rings(values: &[f64], around: usize) -> (f64, Vec<f64>) {
    let means: Vec<f64> = values.chunks(around).map(|ring| ring.iter().sum::<f64>() / around as f64).collect();
    let off =
        values.chunks(around).zip(&means).flat_map(|(ring, mean)| ring.iter().map(move |v| (v / mean - 1.0).abs()));
    (off.fold(0.0, f64::max), means)
}

/// Noh's sphere in the compatible form, about an axis: what meets the shock at 0.6 began at 0.8, and is 64 times as dense behind it.
/// The first elements stay too hot and thin, which the density shows to first order in the element's size: the reference is that of
/// two meshes together. Round-off that is too small for the limiter of viscosity to notice is not damped, and grows from step to step:
/// by what five thousand of them leave, the finer mesh may be less round.
#[test]
fn implosion_of_a_sphere_in_the_compatible_form() {
    let around = 6;
    let behind = [(100, 1e-7), (200, 1e-6)].map(|(through, round): (usize, f64)| {
        let mesh = rays(through, around);
        let deck = format!(
            "TITLE\n implosion\nAXISYMMETRIC, COMPATIBLE\nTERMINATION TIME, 0.6\nOUTPUT TIME, 0.01\nPLOT TIME, 0.1\n\
             PLOT ELEMENT, EINT, CORNERS, DENSITY\nNO DISPLACEMENT, Y, 2\n\
             INITIAL VELOCITY RADIAL, 1, -1.\nINITIAL VELOCITY RADIAL, 2, -1.\n{}{}",
            gas(1, 5.0 / 3.0, 1e-6),
            gas(2, 5.0 / 3.0, 1e-6)
        );
        let case = format!("sphere, compatible, {through}");
        let gas = run(&deck, &mesh).whole();
        println!("{case} steps: {}", gas.last().step);
        // After 34 steps of 100 rays what slows modes and holds corners has given back 9e-9 more than it took so far, which
        // counts as an error; the accounts close to round-off.
        between(&case, "worst energy balance", gas.worst_balance(), 0.0, 1e-8);
        let (off, density) = of_rings(gas.end().element("DENSITY"), around);
        between(&case, "largest departure from round", off, 0.0, round);
        let (_, energy) = of_rings(gas.end().element("EINT"), around);
        let met = energy.iter().rposition(|e| *e > 0.25).expect("a shock");
        close(
            &case,
            "where began what meets the shock",
            (met as f64 + 1.0) / through as f64,
            0.8,
            3.0 / through as f64,
        );
        let ring = |radius: f64| (radius * through as f64) as usize;
        let inside = &density[ring(0.35)..ring(0.7)];
        inside.iter().sum::<f64>() / inside.len() as f64
    });
    println!("densities of the sphere behind the shock: {behind:.2?}");
    close("sphere, compatible", "density for elements of no size", 2.0 * behind[1] - behind[0], 64.0, 0.02);
}

/// The exact account of energies of gas in the compatible form goes over ranks and restarts too.
#[test]
fn the_compatible_form_has_the_same_bits() {
    let deck = format!(
        "TITLE\n implosion\nAXISYMMETRIC, COMPATIBLE\nTERMINATION TIME, 0.6\nOUTPUT TIME, 0.01\nPLOT TIME, 0.1\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, ACCELERATION, REACTION, MASS\nPLOT ELEMENT, EINT, CORNERS, DENSITY, PRESSURE\n\
         NO DISPLACEMENT, Y, 2\nINITIAL VELOCITY RADIAL, 1, -1.\nINITIAL VELOCITY RADIAL, 2, -1.\n{}{}",
        gas(1, 5.0 / 3.0, 1e-6),
        gas(2, 5.0 / 3.0, 1e-6)
    );
    let case = Case::new(&deck, rays(24, 5));
    let whole = case.part(1, None, 120);
    for ranks in 2..=5 {
        assert_same(&format!("{ranks} ranks"), &whole, &case.part(ranks, None, 120));
    }
    let first = case.part(4, None, 50);
    assert_same("restart", &whole, &case.part(3, Some(&first.end), 70));
}

/// A shell of copper that falls in on itself, in both forms: the compatible one keeps it round to
/// round-off.
#[test]
fn a_liner_collapses_round_in_the_compatible_form() {
    let mesh = recipe("RING, 1, 0.05, 0.06, 6, 30, 0., 90.\nNODE SET PLANE, 2, Y, 0.\n");
    let spread = |form: &str| {
        let deck = format!(
            "TITLE\n liner\nAXISYMMETRIC{form}\nTERMINATION TIME, 50.E-6\nOUTPUT TIME, 1.E-6\nPLOT TIME, 10.E-6\n\
             PLOT ELEMENT, CORNERS\nPLOT STATE, EQPS\nNO DISPLACEMENT, Y, 2\nINITIAL VELOCITY RADIAL, 1, -500.\n\
             MATERIAL, 1, EP HYDRODYNAMIC, 8930.\nYOUNGS MODULUS = 117.E9\nPOISSONS RATIO = 0.35\nYIELD STRESS = 100.E6\n\
             HARDENING MODULUS = 200.E6\nPRESSURE CUTOFF = -5.E9\nEND\nEQUATION OF STATE, 1, MG US-UP\nC0 = 3940.\n\
             S = 1.489\nGAMMA = 2.0\nEND\n"
        );
        let liner = run(&deck, &mesh).whole();
        between("liner", "worst energy balance", liner.worst_balance(), 0.0, 1e-4);
        let (off, _) = of_rings(liner.end().element("EQPS"), 30);
        let last = liner.last().totals;
        println!("liner{form}: departure of plastic strain from round {off:e}, hourglass energy {:e}", last.hourglass);
        off
    };
    let (compatible, galerkin) = (spread(", COMPATIBLE"), spread(""));
    between("liner", "departure from round", compatible, 0.0, 1e-9);
    between("liner, Galerkin", "departure from round", galerkin, 0.0, 0.05);
}

/// The cylinder test: a copper tube filled with TNT. When its wall has moved by 6 and 19 mm it flies at about 1.18 and 1.40
/// mm/µs: values of handbooks as remembered, to which the equation of state was fitted. What needs no memory: were all the
/// energy that the gas gives off while it grows to its present volume, E₀ − e(V) along the isentrope of detonation, in the
/// motion across the axis, with a velocity of the gas in proportion to the radius (Gurney 1943), the wall would fly at √(2
/// (E₀ − e)/(ρ (M/C + ½))). Plastic work and motion along the axis leave a little less.
#[test]
fn cylinder_test() {
    let text = |path: &str| {
        std::fs::read_to_string(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a file")
    };
    let mesh = recipe(&text("meshes/cylinder_test.mesh"));
    let tube = run(&text("decks/cylinder_test.i").replace("PLOT TIME, 2.E-6", "PLOT TIME, 0.2E-6"), &mesh).whole();
    let node = mesh.node_sets.iter().find(|set| set.id == 1).expect("a set").nodes[0] as usize;
    for (way, speed) in [(6e-3, 1.18e3), (19e-3, 1.40e3)] {
        let state = tube.states.iter().find(|state| state.nodal("DISPLX")[node] >= way).expect("it goes as far");
        let found = state.nodal("VELX")[node];
        close("cylinder test", &format!("speed of the wall at {way} m [m/s]"), found, speed, 0.05);
        between("cylinder test", "over that of all the energy", found / speed_of_all_the_energy(way), 0.88, 0.97);
    }
    between("cylinder test", "energy balance", tube.worst_balance(), 0.0, 1e-6);
}

/// Speed of the wall when it has gone this way, from energy alone. C of the isentrope follows from the JWL numbers of the deck and a
/// detonation velocity of 6930 m/s by the conditions of Chapman and Jouguet, at p = 21 GPa.
fn speed_of_all_the_energy(way: f64) -> f64 {
    let (a, b, c, r1, r2, omega, energy): (f64, f64, f64, f64, f64, f64, f64) =
        (371.2e9, 3.231e9, 1.045e9, 4.15, 0.95, 0.30, 7.0e9);
    let (inside, outside, density, copper) = (12.7e-3f64, 15.3e-3f64, 1630.0, 8930.0);
    let wall = outside * outside - inside * inside;
    let volume = ((outside + way).powi(2) - wall) / (inside * inside);
    let left = a / r1 * (-r1 * volume).exp() + b / r2 * (-r2 * volume).exp() + c / omega * volume.powf(-omega);
    let masses = copper * wall / (density * inside * inside);
    (2.0 * (energy - left) / (density * (masses + 0.5))).sqrt()
}
