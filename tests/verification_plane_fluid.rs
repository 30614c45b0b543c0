//! Gases in two dimensions: blasts and implosions keep their energy to round-off, turn no corner inside out and stay round.

mod support;

use support::meshes::recipe;
use support::run::{Run, run};
use support::{between, close};
use urto::mesh::{Block, Mesh, plane};

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
