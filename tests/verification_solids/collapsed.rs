//! Bodies of wedges, pyramids and tetrahedra: hexahedra with coinciding corners.
//!
//! `cargo test --test verification_solids collapsed:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::support::bodies::{mean_velocity, nodes_of};
use crate::support::collapsed::{pyramids, pyramids_here_and_there, tetrahedra, wedges};
use crate::support::continued::{Case, assert_same};
use crate::support::meshes::{box_of_cells, recipe};
use crate::support::run::{run, run_on};
use crate::support::stiffness::{end_shear, held_at_root, solve, stiffness};
use crate::support::{between, close, steel};
use urto::mesh::{Block, HEX_SIDES, Mesh, NodeSet, SideSet};

type Cut = fn(&Mesh) -> Mesh;
const CUTS: [(&str, Cut); 3] = [("wedges", wedges), ("pyramids", pyramids), ("tetrahedra", tetrahedra)];

const STEEL: &str = "MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";

const GLOBAL: &str = "TIME STEP ESTIMATE, GLOBAL\n";

/// A cube of three irregular cells along each axis.
fn irregular() -> Mesh {
    let mut mesh = box_of_cells([3, 3, 3], [0.03, 0.03, 0.03]);
    for (n, x) in mesh.coordinates.iter_mut().enumerate() {
        for (i, x) in x.iter_mut().enumerate() {
            // Faces of wedges and tetrahedra meet wherever the nodes are.
            *x += 0.0015 * ((7 * n + 3 * i) as f64 * 2.4).sin();
        }
    }
    mesh
}

/// Mass, and free fall: all nodes gain g t, so that nothing is stressed, and the body's momentum is M g t.
#[test]
fn v45_mass_and_free_fall() {
    let volume: f64 = {
        let mesh = irregular();
        let corners = |nodes: &[u32; 8]| nodes.map(|n| mesh.coordinates[n as usize]);
        mesh.hexahedra().map(|nodes| urto::mesh::check::hexahedron_volume(&corners(nodes))).sum()
    };
    for (name, cut) in CUTS {
        let mesh = cut(&irregular());
        let deck = format!(
            "TERMINATION TIME, 2.E-5\nPLOT TIME, 1.E-5\nPLOT NODAL, MASS, VELOCITY\nPLOT ELEMENT, STRESS\n\
             GRAVITY, 0., 0., -1.E6\n{STEEL}"
        );
        let run = run(&deck, &mesh);
        let end = run.end();
        let mass: f64 = end.nodal("NODMASS").iter().sum();
        // Curved outer faces are cut into planes by wedges and tetrahedra; pyramids keep them.
        let tolerance = if name == "pyramids" { 1e-12 } else { 0.02 };
        close(&format!("V-45 {name}"), "mass [kg]", mass, 7850.0 * volume, tolerance);
        assert!(end.nodal("NODMASS").iter().all(|m| *m > 0.0));
        for (n, v) in end.nodal("VELZ").iter().enumerate() {
            assert!((v / (-1e6 * end.time) - 1.0).abs() < 1e-12, "{name}: node {n} falls at {v}");
        }
        let largest = end.element("SIGZZ").iter().fold(0.0f64, |m, s| m.max(s.abs()));
        between(&format!("V-45 {name}"), "stress in free fall [Pa]", largest, 0.0, 1.0);
    }
}

/// The wave of V-01 in a bar whose cells are cut: plateau, front and balance.
#[test]
fn v45_wave_in_a_bar() {
    let deck = include_str!("../../decks/bar_wave.i");
    for (name, cut) in CUTS {
        let whole = recipe(include_str!("../../meshes/bar_wave.mesh"));
        let mesh = cut(&whole);
        let run = run(deck, &mesh);
        let plateau = -steel::RHO * steel::bar_speed();
        let state = run.at(150e-6);
        let centres: Vec<f64> = mesh
            .hexahedra()
            .map(|nodes| nodes.iter().map(|&n| mesh.coordinates[n as usize][0]).sum::<f64>() / 8.0)
            .collect();
        let behind: Vec<f64> = (centres.iter().zip(state.element("SIGXX")))
            .filter(|(x, _)| (0.02..0.65).contains(*x))
            .map(|(_, s)| *s)
            .collect();
        let mean = behind.iter().sum::<f64>() / behind.len() as f64;
        close(&format!("V-45 {name}"), "plateau [Pa]", mean, plateau, 0.02);
        between(&format!("V-45 {name}"), "worst energy balance", run.worst_balance(), 0.0, 1e-3);
    }
}

/// Tip deflection of the cantilever of V-12, its cells cut, over Timoshenko's.
fn cantilever(cut: Cut, cells: [usize; 3], poisson: f64) -> f64 {
    let (length, young) = (10.0, 1000.0);
    let mesh = cut(&box_of_cells(cells, [length, 1.0, 1.0]));
    let deck = format!(
        "TERMINATION TIME, 1.\nBULK VISCOSITY, 0., 0.\n\
         MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = {young}\nPOISSONS RATIO = {poisson}\nEND\n"
    );
    let matrix = stiffness(&deck, &mesh);
    let force = end_shear(&mesh, length, cells);
    let u = solve(&matrix, &force, |node, axis| held_at_root(&mesh, node, axis));
    let timoshenko = length.powi(3) / (3.0 * young / 12.0) + length / (5.0 / 6.0 * young / (2.0 * (1.0 + poisson)));
    force.dot(&u) / timoshenko
}

/// Hourglass control makes hexahedra exact in bending (V-12). Wedges bent in the plane of their triangles are as stiff as
/// linear triangles are; pyramids are between, and do not lock when nearly incompressible; tetrahedra do. 1 % is for the
/// way in which the root is held.
#[test]
fn v45_cantilever() {
    let table = [[0.363, 0.689, 0.205], [0.688, 0.896, 0.682], [0.365, 0.684, 0.161]];
    for ((name, cut), ratios) in CUTS.into_iter().zip(table) {
        for ((cells, poisson), ratio) in
            [([10, 2, 2], 0.3), ([20, 4, 4], 0.3), ([10, 2, 2], 0.49)].into_iter().zip(ratios)
        {
            let case = format!("V-45 cantilever of {cells:?} cells in {name}, nu = {poisson}");
            close(&case, "tip over Timoshenko", cantilever(cut, cells, poisson), ratio, 0.01);
        }
    }
}

/// The bar of V-15 on a coarse mesh: in wedges and pyramids its foot flows as that of hexahedra does, in tetrahedra it
/// does not, and that is why blocks of tetrahedra are refused.
#[test]
fn v45_taylor_bar() {
    let deck = include_str!("../../decks/taylor_bar.i").replace("TERMINATION TIME, 80.E-6", "TERMINATION TIME, 40.E-6");
    let whole = recipe(&include_str!("../../meshes/taylor_bar.mesh").replace("8, 160, QUARTER", "2, 40, QUARTER"));
    let radius = |name: &str, mesh: &Mesh| {
        let run = run(&deck, mesh);
        between(&format!("V-45 {name}"), "worst energy balance", run.worst_balance(), 0.0, 1e-3);
        run.end().positions(mesh).iter().fold(0.0f64, |m, p| m.max(p[0].hypot(p[1])))
    };
    let hexahedra = radius("hexahedra", &whole);
    let over = CUTS.map(|(name, cut)| radius(name, &cut(&whole)) / hexahedra);
    // Finer than the cells they are cut from, so that they may flow a little more.
    between("V-45 wedges", "radius of the foot over that of hexahedra", over[0], 0.98, 1.06);
    between("V-45 pyramids", "radius of the foot over that of hexahedra", over[1], 0.98, 1.06);
    between("V-45 tetrahedra", "radius of the foot over that of hexahedra", over[2], 0.6, 0.85);
}

/// Two bars exchange their velocities (V-21) when one of them, or both, is of wedges, whose ends are triangles.
#[test]
fn v45_bars_with_triangles_collide() {
    let deck = include_str!("../../decks/two_bars.i");
    let whole = recipe(include_str!("../../meshes/two_bars.mesh"));
    // Along x, so that the triangles are on the ends.
    let turned = |block: usize, mesh: &Mesh| {
        let mut mesh = mesh.clone();
        let cut = mesh.blocks[block].hexahedra().iter();
        mesh.blocks[block].nodes = cut
            .flat_map(|&[a, b, c, d, e, f, g, h]| [[a, d, h, h, b, c, g, g], [a, h, e, e, b, g, f, f]])
            .flatten()
            .collect();
        mesh.element_ids = (1..=mesh.element_count() as i64).collect();
        mesh
    };
    for mesh in [turned(0, &whole), turned(1, &turned(0, &whole))] {
        let run = run(deck, &mesh);
        let nodes = [1, 2].map(|block| nodes_of(&mesh, block));
        let [first, second] = nodes.map(|nodes| mean_velocity(run.end(), &nodes)[0]);
        between("V-45", "velocity of the first bar over v", first / 5.0, -0.02, 0.02);
        close("V-45", "velocity of the second bar over v", second / 5.0, 1.0, 0.02);
        between("V-45", "worst energy balance", run.worst_balance(), 0.0, 1e-5);
    }
}

/// Pressure on the outside of a free block of wedges moves nothing, and its stress is the pressure: forces on triangles.
#[test]
fn v45_pressure_on_triangles() {
    let mut mesh = wedges(&box_of_cells([3, 3, 3], [0.03, 0.03, 0.03]));
    let mut count = std::collections::BTreeMap::<Vec<u32>, Vec<(u32, u8)>>::new();
    for (element, nodes) in mesh.hexahedra().enumerate() {
        for (side, corners) in HEX_SIDES.iter().enumerate() {
            let mut face = corners.map(|corner| nodes[corner]).to_vec();
            face.sort_unstable();
            face.dedup();
            if face.len() > 2 {
                count.entry(face).or_default().push((element as u32, side as u8));
            }
        }
    }
    let outside = count.into_values().filter(|faces| faces.len() == 1).flatten().collect();
    mesh.side_sets.push(SideSet { id: 1, name: String::new(), sides: outside });
    let deck = format!(
        "TERMINATION TIME, 1.E-3\nPLOT TIME, 1.E-3\nPLOT ELEMENT, PRESSURE, VONMISES\nHOURGLASS STIFFENING, 0.05, 0.03\n\
         FUNCTION, 1\n0., 0.\n8.E-4, 1.\nEND\nPRESSURE, 1, 1, 1.E8\n{STEEL}"
    );
    let run = run(&deck, &mesh);
    for (p, s) in run.end().element("PRESSURE").iter().zip(run.end().element("VONMISES")) {
        // What is left of the ringing: the pressure rises in fifty periods.
        assert!((p / 1e8 - 1.0).abs() < 0.01 && *s < 1e6, "pressure {p}, von Mises stress {s}");
    }
    let totals = &run.last().totals;
    let momentum = totals.momentum.iter().fold(0.0f64, |m, p| m.max(p.abs()));
    between("V-45", "momentum [kg m/s]", momentum, 0.0, 1e-9);
}

/// The same bits on one rank and on three.
#[test]
fn collapsed_elements_on_several_ranks() {
    let deck = format!(
        "TERMINATION TIME, 2.E-5\nPLOT TIME, 1.E-5\nPLOT NODAL, VELOCITY, MASS\nPLOT ELEMENT, STRESS\n\
         RIGID SURFACE, 1, 0., 0., -0.002, 0., 0., 1.\nINITIAL VELOCITY MATERIAL, 1, 1., 2., -50.\n{STEEL}"
    );
    for (name, cut) in CUTS {
        let mut mesh = cut(&irregular());
        mesh.side_sets.push(SideSet { id: 1, name: String::new(), sides: bottom(&mesh) });
        let runs = [1, 3].map(|ranks| run_on(ranks, &deck, &mesh).whole());
        for variable in ["VELX", "VELZ", "NODMASS"] {
            let [a, b] = runs.each_ref().map(|run| run.end().nodal(variable));
            assert!(a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits()), "{name} {variable}");
        }
        let [a, b] = runs.each_ref().map(|run| run.end().element("SIGZZ"));
        assert!(a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits()), "{name}");
        assert!(a.iter().any(|s| s.abs() > 1e6), "{name}: it struck the floor");
    }
}

/// 64 cubes, struck on one side, alone and with a pyramid far away in a block of its own; then with a cube far away in their own block, and
/// with a pyramid in its place. A step that all can take is prescribed: nothing joins them, and no bit of the 64 may tell
/// which it is. (With one more element in their block corners are summed in another order, so that these are two pairs.)
#[test]
fn a_pyramid_changes_no_hexahedron_of_its_block() {
    let mut cubes = box_of_cells([4, 4, 4], [0.04, 0.04, 0.04]);
    let nodes = (0..125).filter(|&n| cubes.coordinates[n as usize][2] == 0.0).collect();
    cubes.node_sets.push(NodeSet { id: 1, name: String::new(), nodes });
    let with = |last: [u32; 8], own: bool| {
        let mut mesh = cubes.clone();
        let base = [[0.0, 0.0], [0.01, 0.0], [0.01, 0.01], [0.0, 0.01]];
        let base = |z: f64| base.map(|[x, y]| [1.0 + x, y, z]);
        let top = if last[7] == 132 { base(0.01).to_vec() } else { vec![[1.005, 0.005, 0.01]] };
        mesh.coordinates.extend(base(0.0).into_iter().chain(top));
        match own {
            true => mesh.blocks.push(Block::hexahedra_of(2, [last])),
            false => mesh.blocks[0].nodes.extend(last),
        }
        mesh.node_ids = (1..=mesh.coordinates.len() as i64).collect();
        mesh.element_ids = (1..=65).collect();
        mesh
    };
    let (cube, pyramid) = ([125, 126, 127, 128, 129, 130, 131, 132], [125, 126, 127, 128, 129, 129, 129, 129]);
    let fields = "PLOT NODAL, VELOCITY\nPLOT ELEMENT, STRESS, BULKQ, HOURGLASS, ENERGY\n";
    for element in ["", "ELEMENT, 1, EIGHT POINTS\n", "PRECISION, SINGLE\n"] {
        let deck = |second: &str| {
            format!(
                "TERMINATION TIME, 1.E-5\nPLOT TIME, 1.E-5\nTIME STEP MAXIMUM, 2.E-7\n{fields}{element}\
                 INITIAL VELOCITY NODESET, 1, 10., 0., 100.\n{STEEL}{second}"
            )
        };
        let second = STEEL.replace("MATERIAL, 1", "MATERIAL, 2");
        let pairs = [
            [run(&deck(""), &cubes), run(&deck(&second), &with(pyramid, true))],
            [run(&deck(""), &with(cube, false)), run(&deck(""), &with(pyramid, false))],
        ];
        for [plain, beside] in &pairs {
            let viscous = plain.end().element("BULKQ")[..64].iter().fold(0.0f64, |most, q| q.abs().max(most));
            assert!(viscous > 1e6, "bulk viscosity acts: {viscous}");
            let same = |name: &str, [a, b]: [&[f64]; 2]| {
                assert!(a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits()), "{element:?}: {name}");
            };
            for name in ["VELX", "VELZ"] {
                same(name, [plain, beside].map(|run| &run.end().nodal(name)[..125]));
            }
            for name in ["SIGXX", "SIGZZ", "TAUZX", "BULKQ", "HGENERGY", "ENERGY"] {
                same(name, [plain, beside].map(|run| &run.end().element(name)[..64]));
            }
        }
    }
}

/// Hexahedra with pyramids among them, some of which DEATH takes: shares of single elements are the same wherever these are computed, and
/// after a restart, in whatever kind of element and with whatever bounds the step.
#[test]
fn pyramids_among_hexahedra_on_ranks_and_after_a_restart() {
    let mesh = pyramids_here_and_there(&irregular(), 4);
    for more in
        ["", "ELEMENT, 1, EIGHT POINTS\n", "PRECISION, SINGLE\n", "MASS SCALING, ALL, STEP, 6.E-7, 1.\n", GLOBAL]
    {
        let deck = format!(
            "TERMINATION TIME, 1.E-3\nPLOT NODAL, VELOCITY, MASS\nPLOT ELEMENT, STRESS, BULKQ, STATUS\n{more}\
             DEATH, 1, PRESSURE, MAX, 1.2E9, DROP\nINITIAL VELOCITY MATERIAL, 1, 1., 2., -90.\n\
             NO DISPLACEMENT, Z, 1\n{STEEL}"
        );
        let mut mesh = mesh.clone();
        let low = (0..16).collect();
        mesh.node_sets.push(NodeSet { id: 1, name: String::new(), nodes: low });
        let case = Case::new(&deck, mesh);
        let whole = case.part(1, None, 60);
        for ranks in [2, 3] {
            assert_same(&format!("{more:?}, {ranks} ranks"), &whole, &case.part(ranks, None, 60));
        }
        let begun = case.part(3, None, 25);
        assert_same(&format!("{more:?}, restart"), &whole, &case.part(2, Some(&begun.end), 35));
        // Behind time and step come KE, IE, HGE, BVE, FRICE and DEADE.
        let eroded = whole.way.last().map_or(0.0, |numbers| f64::from_bits(numbers[7]));
        assert!(eroded > 0.0, "{more:?}: elements have died");
    }
}

/// Faces all of whose nodes are among the lowest sixteen of the box.
fn bottom(mesh: &Mesh) -> Vec<(u32, u8)> {
    let mut sides = Vec::new();
    for (element, nodes) in mesh.hexahedra().enumerate() {
        for (side, corners) in HEX_SIDES.iter().enumerate() {
            let face = corners.map(|corner| nodes[corner]);
            let mut different = face.to_vec();
            different.sort_unstable();
            different.dedup();
            if different.len() > 2 && face.iter().all(|&node| node < 16) {
                sides.push((element as u32, side as u8));
            }
        }
    }
    sides
}
