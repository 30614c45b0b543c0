//! Bodies of revolution that close upon their axis, and free masses that fly to it: nothing passes the axis.

use crate::support::continued::{Case, assert_same};
use crate::support::meshes::recipe;
use crate::support::run::{Run, run, run_on};
use crate::support::{between, close};
use urto::mesh::Mesh;

/// The least radius of any node in any plot state.
fn least_radius(run: &Run, mesh: &Mesh) -> f64 {
    let radii = run.states.iter().flat_map(|state| state.positions(mesh)).map(|[r, ..]| r);
    radii.fold(f64::INFINITY, f64::min)
}

/// A ring from radius 1 to 2, held along the axis, that is thrown inwards.
const RING: &str = "RECTANGLE, 1, 1., 0., 1., 0.5, 8, 4\nNODE SET PLANE, 1, Y, 0.\nNODE SET PLANE, 1, Y, 0.5\n\
                    SIDE SET FACE, 100, 1, LEFT\n";

fn ring(more: &str) -> String {
    format!(
        "TITLE\n ring\nAXISYMMETRIC\nTERMINATION TIME, 0.02\nOUTPUT TIME, 1.E-3\nPLOT TIME, 2.E-4\nPLOT NODAL, DISPLACEMENT, VELOCITY\n\
         NO DISPLACEMENT, Y, 1\nINITIAL VELOCITY MATERIAL, 1, -300., 0.\n{more}\
         MATERIAL, 1, ELASTIC PLASTIC, 0.00785\nYOUNGS MODULUS = 210.E3\nPOISSONS RATIO = 0.3\n\
         YIELD STRESS = 100.\nHARDENING MODULUS = 0.\nBETA = 1.\nEND\n"
    )
}

/// What flows plastically keeps its volume: of 1 < r < 2 a rod is left whose radius is √(4 − 1). The volume that elastic strain
/// leaves is a part of 1E-4; the rest of the tolerance is what a corner that stays off the axis by a part of an element leaves open.
#[test]
fn a_ring_closes_to_a_rod_of_its_volume() {
    let mesh = recipe(RING);
    let closed = run(&ring(""), &mesh);
    assert!(closed.stop.is_none(), "{:?}", closed.stop);
    // Round-off of a step from a radius of 0.01; nodes that have come to the axis quiver there.
    between("axis", "least radius", least_radius(&closed, &mesh), -1e-15, 1e-3);
    let end = closed.end().positions(&mesh);
    let at = |x: f64| mesh.coordinates.iter().zip(&end).filter(move |(from, _)| from[0] == x).map(|(_, to)| to[0]);
    let mean = |x: f64| at(x).sum::<f64>() / at(x).count() as f64;
    close("axis", "outer radius of the rod", mean(2.0), 3f64.sqrt(), 5e-3);
    between("axis", "where the bore was", at(1.0).fold(0.0, f64::max), 0.0, 0.02);
    between("axis", "energy balance", closed.worst_balance(), 0.0, 2e-3);
    // A rigid plane along the axis, for the nodes of the bore, is another way to the same; both have the same forces but for
    // rounding.
    let planed = run(&ring("RIGID SURFACE, 100, 0., 0., 1., 0.\n"), &mesh);
    let taken = |run: &Run| -run.last().totals.contact / run.initial_energy;
    between("axis", "taken by the axis, part of the energy", taken(&closed), 0.3, 0.9);
    close("axis", "the same beside a rigid plane's", taken(&closed), taken(&planed), 1e-6);
    let flowed = |run: &Run| run.last().totals.internal / run.initial_energy;
    close("axis", "what flowed beside the same", flowed(&closed), flowed(&planed), 1e-6);
}

/// The same bits on any number of ranks, and of a run that was stopped while the axis held the bore.
#[test]
fn a_ring_that_closes_has_the_same_bits() {
    let mesh = recipe(RING);
    let one = run(&ring(""), &mesh);
    for ranks in [2, 3] {
        let many = run_on(ranks, &ring(""), &mesh).whole();
        assert_eq!(one.last().totals, many.last().totals, "{ranks} ranks");
        assert_eq!(one.end().nodal("DISPLX"), many.end().nodal("DISPLX"), "{ranks} ranks");
    }
    let case = Case::new(&ring(""), mesh);
    let whole = case.part(1, None, 500);
    let first = case.part(2, None, 420);
    let continued = case.part(3, Some(&first.end), 80);
    assert_same("ring", &whole, &continued);
}

/// An elastic ring that is thrown at its axis strikes it, leaves it again and springs back beyond where it began: the axis pushes and
/// does not pull. Strains this large want short steps: the error of the balance is that of the step's square, 3.6E-3 with whole steps,
/// a sixteenth of it with a quarter.
#[test]
fn an_elastic_ring_leaves_the_axis_again() {
    let mesh = recipe("RECTANGLE, 1, 0.1, 0., 0.1, 0.1, 8, 8\nNODE SET PLANE, 1, Y, 0.\nNODE SET PLANE, 1, Y, 0.1\n");
    let deck = "TITLE\n ring\nAXISYMMETRIC\nTERMINATION TIME, 0.65\nTIME STEP SCALE, 0.25\nOUTPUT TIME, 0.05\nPLOT TIME, 0.002\n\
                PLOT NODAL, DISPLACEMENT, VELOCITY, REACTION\nNO DISPLACEMENT, Y, 1\nINITIAL VELOCITY MATERIAL, 1, -1.6, 0.\n\
                MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n";
    let bounced = run(deck, &mesh);
    between("axis", "elastic ring: least radius", least_radius(&bounced, &mesh), -1e-15, 1e-12);
    let bore: Vec<usize> = (0..mesh.coordinates.len()).filter(|&n| mesh.coordinates[n][0] == 0.1).collect();
    let end = bounced.end().positions(&mesh);
    let last = bore.iter().map(|&n| end[n][0]).fold(f64::INFINITY, f64::min);
    between("axis", "elastic ring: bore at the end", last, 0.1, 0.4);
    let forces = bounced.states.iter().flat_map(|state| bore.iter().map(|&n| state.nodal("RX")[n]));
    let (least, most) = forces.fold((0.0, 0.0), |(a, b): (f64, f64), f| (a.min(f), b.max(f)));
    assert!(least == 0.0 && most > 0.0, "forces of the axis from {least} to {most}");
    between("axis", "elastic ring: energy balance", bounced.worst_balance(), 0.0, 5e-4);
}

/// Free masses of elements that are gone fly to the axis and stop there dead: it takes ½ M v² of the radial velocity, whose masses and
/// speeds the deck gives. Along the axis they go on.
#[test]
fn free_masses_stop_at_the_axis() {
    let mesh = recipe("RECTANGLE, 1, 3., 0., 1., 2., 2, 4\nRECTANGLE, 2, 1., 50., 1., 1., 1, 1\n");
    let law = "ELASTIC, 2.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n";
    let deck = format!(
        "TITLE\n debris\nAXISYMMETRIC\nTERMINATION TIME, 3.\nOUTPUT TIME, 0.1\nPLOT TIME, 0.1\nPLOT NODAL, DISPLACEMENT, VELOCITY, MASS\n\
         INITIAL VELOCITY MATERIAL, 1, -2., 0.5\nDEATH, 1, VOLUME, MIN, 1.E9\nMATERIAL, 1, {law}MATERIAL, 2, {law}"
    );
    let flown = run(&deck, &mesh);
    between("axis", "debris: least radius", least_radius(&flown, &mesh), -1e-15, 1e-12);
    let mass = 2.0 * std::f64::consts::PI * (16.0 - 9.0) * 2.0;
    close("axis", "debris: energy that the axis takes", -flown.last().totals.contact, 0.5 * mass * 4.0, 1e-9);
    close("axis", "debris: energy that is left", flown.last().totals.kinetic, 0.5 * mass * 0.25, 1e-9);
    between("axis", "debris: energy balance", flown.worst_balance(), 0.0, 1e-12);
}

/// A ring of metal with an equation of state closes in the compatible form, too, with the balance that it always keeps.
#[test]
fn a_ring_closes_in_the_compatible_form() {
    let mesh = recipe(RING);
    let deck = "TITLE\n ring\nAXISYMMETRIC, COMPATIBLE\nTERMINATION TIME, 0.01\nOUTPUT TIME, 1.E-3\nPLOT TIME, 5.E-4\n\
                PLOT NODAL, DISPLACEMENT\nNO DISPLACEMENT, Y, 1\nINITIAL VELOCITY MATERIAL, 1, -300., 0.\n\
                MATERIAL, 1, EP HYDRODYNAMIC, 8.93E-3\nYOUNGS MODULUS = 117.E3\nPOISSONS RATIO = 0.35\nYIELD STRESS = 100.\n\
                HARDENING MODULUS = 0.\nPRESSURE CUTOFF = -1.E10\nEND\n\
                EQUATION OF STATE, 1, MG US-UP\nC0 = 3940.\nS = 1.489\nGAMMA = 2.02\nINITIAL ENERGY = 0.\nEND\n";
    let closed = run(deck, &mesh);
    assert!(closed.stop.is_none(), "{:?}", closed.stop);
    between("axis", "compatible: least radius", least_radius(&closed, &mesh), -1e-15, 1e-12);
    let end = closed.end().positions(&mesh);
    let outer: Vec<f64> =
        mesh.coordinates.iter().zip(&end).filter(|(from, _)| from[0] == 2.0).map(|(_, to)| to[0]).collect();
    let mean = outer.iter().sum::<f64>() / outer.len() as f64;
    close("axis", "compatible: outer radius of the rod", mean, 3f64.sqrt(), 1e-2);
    between("axis", "compatible: energy balance", closed.worst_balance(), 0.0, 1e-10);
}
