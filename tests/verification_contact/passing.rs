//! Bodies that slide on each other, pass each other by or merely touch, in shapes that are no boxes: nothing is moved before the run, and the
//! energy of motion stays.

use super::abutting::laws;
use crate::support::bodies::{mean_velocity, nodes_of};
use crate::support::meshes::recipe;
use crate::support::run::{model, run};
use urto::mesh::Mesh;
use urto::solver::Body;

/// A scene of blocks of steel, of which some fly at a velocity, for a time.
pub struct Scene<'a> {
    pub name: &'a str,
    pub recipe: &'a str,
    pub blocks: usize,
    pub lines: &'a str,
    pub duration: f64,
}

impl Scene<'_> {
    /// Mean velocity of the second block at the end.
    pub fn velocity_of_second(&self) -> [f64; 3] {
        let mesh = self.mesh();
        let run = run(&self.deck(), &mesh).whole();
        mean_velocity(run.end(), &nodes_of(&mesh, 2))
    }

    pub fn mesh(&self) -> Mesh {
        recipe(&format!("TITLE\n {}\n{}", self.name, self.recipe))
    }

    pub fn deck(&self) -> String {
        format!(
            "TITLE\n {}\nTERMINATION TIME, {:?}\nOUTPUT TIME, {:?}\nCONTACT MATERIAL\n{}\n{}",
            self.name,
            self.duration,
            self.duration,
            self.lines,
            laws(self.blocks)
        )
    }

    /// Checks that nothing is moved before the run, and that the energy of motion stays to a part of itself, as the work of contact stays at 0.
    pub fn keeps_its_energy(&self, tolerance: f64) {
        let (mesh, deck) = (self.mesh(), self.deck());
        let overlap = Body::new(&mesh, &model(&deck, &mesh)).expect("materials").overlap;
        assert_eq!((overlap.refusal(&mesh), overlap.nodes), (None, 0), "{}: {overlap:?}", self.name);
        let run = run(&deck, &mesh).whole();
        let (first, last) = (run.lines[0].totals.kinetic, &run.last().totals);
        let off = (last.kinetic / first - 1.0).abs();
        println!("{}: energy off by {off:.1e}, work of contact {:.1e}", self.name, last.contact);
        assert!(off < tolerance && last.contact.abs() < tolerance * first, "{}: {off:.1e}", self.name);
    }
}

/// Round-off of places a length from the origin strains steel by 10⁻¹⁰ of such energies of motion.
pub const ROUND_OFF: f64 = 1e-9;

/// Plates side by side, a millimetre apart, each flush with the other.
const PLATES: &str = "BOX, 2, -1., -.9995, -.7, 2., 1., .2, 1, 1, 1\nBOX, 3, -1., .0005, -.7, 2., 1., .2, 1, 1, 1\n";

/// What slides on an edge or a tip was stopped by the side of the next plate, as no face of its own lies flat on that: a brick lost 27 % of its energy, and
/// a ball more than half of its momentum.
#[test]
fn what_slides_on_an_edge_or_a_tip_does_not_trip_over_a_flush_seam() {
    let tilted = "BOX, 1, 0., 0., 0., .5, .5, .5, 1, 1, 1\nROTATE, 1, X, 20.\nTRANSLATE, 1, -.25, 0., -.5\n";
    let brick = Scene {
        name: "tilted brick on a seam",
        recipe: &format!("{tilted}{PLATES}"),
        blocks: 3,
        lines: "INITIAL VELOCITY MATERIAL, 1, 0., 20., 0.",
        duration: 1e-4,
    };
    brick.keeps_its_energy(ROUND_OFF);
    let ball = Scene {
        name: "ball on a seam",
        recipe: &format!("SPHERE, 1, .5, 3\n{PLATES}NODE SET BLOCK, 1, 2\nNODE SET BLOCK, 1, 3\n"),
        blocks: 3,
        lines: "RIGID BODY, 2\nRIGID BODY, 3\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n\
                INITIAL VELOCITY MATERIAL, 1, 0., 20., 0.",
        duration: 2e-3,
    };
    ball.keeps_its_energy(ROUND_OFF);
}

/// A point beside a corner of a face was taken to come flush with the side of the body across the other border there: blocks as wide as others were
/// stopped a millimetre beside these, and lost 24 % of their energy; one that goes into a slot that is wider by that lost a third.
#[test]
fn what_flies_by_beside_another_is_not_stopped() {
    for gap in [1e-4, 1e-3, 4e-3] {
        let beside = Scene {
            name: "a block beside another",
            recipe: &format!(
                "BOX, 1, -.5, -.5, 0., .5, 1., .5, 1, 1, 1\nBOX, 2, {gap:?}, -.5, .501, .5, 1., .5, 1, 1, 1\n"
            ),
            blocks: 2,
            lines: "INITIAL VELOCITY MATERIAL, 2, 0., 0., -20.",
            duration: 5e-4,
        };
        beside.keeps_its_energy(ROUND_OFF);
    }
    let slot = "BOX, 1, -.5, -.5, 0., .5, 1., .5, 4, 4, 4\nBOX, 1, .502, -.5, 0., .5, 1., .5, 4, 4, 4\n\
                BOX, 2, .001, -.5, .501, .5, 1., .5, 4, 4, 4\n";
    let slot = Scene {
        name: "a block into a slot",
        recipe: slot,
        blocks: 2,
        lines: "INITIAL VELOCITY MATERIAL, 2, 0., 0., -20.",
        duration: 1e-3,
    };
    slot.keeps_its_energy(ROUND_OFF);
}

/// The rims of a tube and of a sleeve with as many facets that is a little wider cross each other beyond their ends only, where both turn away: as edges that
/// met they stopped the sleeve, with half of its energy.
#[test]
fn a_sleeve_that_is_a_little_wider_goes_onto_a_tube() {
    // One that fits exactly was stopped by the nodes of the tube, which met its end at the corners of the bore.
    for gap in [0.0, 1e-5, 1e-4, 1e-3] {
        let inner = 0.6 + gap;
        let sleeve = Scene {
            name: "a sleeve onto a tube",
            recipe: &format!(
                "TUBE, 1, .5, .6, .5, 1, 12, 1\nTUBE, 2, {inner:?}, .65, .5, 1, 12, 1\nTRANSLATE, 2, 0., 0., .501\n"
            ),
            blocks: 2,
            lines: "INITIAL VELOCITY MATERIAL, 2, 0., 0., -20.",
            duration: 2e-4,
        };
        sleeve.keeps_its_energy(ROUND_OFF);
    }
}

/// Behind a side that leans inwards, the foot of what slides on the plate is below its rim by a part of how far it has come: the side was taken to be in the way from
/// a slope of a thirtieth on, with up to half of the energy.
#[test]
fn what_slides_onto_a_plate_with_leaning_sides_is_not_stopped() {
    for lean in [-0.1, 0.0, 0.01, 0.1, 0.2] {
        let (low, high) = (0.5 - lean, 0.5);
        let ring = |half: f64, z: f64| {
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
                .map(|[x, y]| format!("{:?}, {:?}, {z:?}\n", half * x, half * y))
                .concat()
        };
        let plate = Scene {
            name: "onto a plate with leaning sides",
            recipe: &format!(
                "HEXAHEDRON, 1, 1, 1, 1\n{}{}END\nBOX, 2, .55, -.15, 0., .4, .4, .3, 1, 1, 1\n",
                ring(low, -0.3),
                ring(high, 0.0)
            ),
            blocks: 2,
            lines: "INITIAL VELOCITY MATERIAL, 2, -10., 0., 0.",
            duration: 8e-3,
        };
        plate.keeps_its_energy(ROUND_OFF);
    }
}

/// What comes under a foot whose chamfer is part of another element met the chamfer where that ends in the foot, if it is less than 60 degrees steep: up to 31 % of
/// the energy were lost.
#[test]
fn what_comes_under_a_chamfered_foot_is_not_stopped() {
    for degrees in [5.0_f64, 20.0, 45.0, 58.0, 70.0] {
        let rise = 0.2 * degrees.to_radians().tan();
        let side = |y: f64| format!("0., {y:?}, 0.\n.2, {y:?}, {rise:?}\n.2, {y:?}, 1.\n0., {y:?}, 1.\n");
        let foot = Scene {
            name: "under a chamfered foot",
            recipe: &format!(
                "BOX, 1, -.2, 0., 0., .2, 1., 1., 1, 1, 1\nHEXAHEDRON, 1, 1, 1, 1\n{}{}END\nMERGE, 1\n\
                 BOX, 2, -.45, -.2, -.2, 1., 1.4, .2, 2, 1, 1\n",
                side(1.0),
                side(0.0)
            ),
            blocks: 2,
            lines: "INITIAL VELOCITY MATERIAL, 1, 20., 0., 0.",
            duration: 5e-3,
        };
        foot.keeps_its_energy(ROUND_OFF);
    }
}

/// A ridge comes down on a plate whose ends are flush with its own, on a node of that: the end of the ridge was taken for the side with which the node comes flush,
/// before the two touched, and a plate without friction went as fast to the side as downwards.
#[test]
fn a_ridge_with_flush_ends_pushes_a_plate_along_its_normal() {
    let side = |x: [f64; 4], y: [f64; 4], z: f64| {
        let corner = |i: usize| format!("{:?}, {:?}, {z:?}\n", x[i], y[i]);
        (0..4).map(corner).collect::<String>()
    };
    let half =
        |x: [f64; 4], y: [f64; 4]| format!("HEXAHEDRON, 1, 1, 1, 1\n{}{}END\n", side(x, y, 0.0), side(x, y, 0.2));
    let ridge = half([0.0, 0.3, 0.3, 0.0], [0.0005, 0.3005, 0.7, 0.7])
        + &half([-0.3, 0.0, 0.0, -0.3], [0.3005, 0.0005, 0.7, 0.7]);
    for beyond in [0.0, 0.01] {
        let plate = format!("MERGE, 1\nBOX, 2, -.5, -.1, {:?}, 1., .1, {:?}, 2, 1, 1\n", -beyond, 0.2 + 2.0 * beyond);
        let scene = Scene {
            name: "a ridge on a plate",
            recipe: &format!("{ridge}{plate}"),
            blocks: 2,
            lines: "PLOT NODAL, DISPLACEMENT, VELOCITY, MASS\nINITIAL VELOCITY MATERIAL, 1, -6., -7., 0.",
            duration: 3e-4,
        };
        let [x, y, _] = scene.velocity_of_second();
        println!("ridge on a plate, ends {beyond:?} beyond: {:.1e} of its velocity to the side", x / y);
        // The plate bends by this much while it is pushed: 6e-4 with longer ends. As fast as downwards before.
        assert!(y < -1.0 && (x / y).abs() < 2e-3, "{x}, {y}");
    }
}

/// Corners of a body that touch another one at an edge of that: in the inner corner of an L, and at the ridge between two facets. The element there has no face
/// that they touch, and so they were taken to be in it: nodes were moved by up to 0.19 of 1, or a quarter of the energy of motion was lost.
#[test]
fn what_touches_an_inner_corner_or_a_ridge_glides_along_it() {
    let l = "BOX, 1, 0., 0., 0., 1., .5, 1., 1, 1, 1\nBOX, 1, -.5, 0., 0., .5, .5, 1., 1, 1, 1\n\
             BOX, 1, -.5, .5, 0., .5, 1., 1., 1, 1, 1\nMERGE, 1\nBOX, 2, 0., .5, .8, .3, .3, 1., 1, 1, 1\n";
    let l = Scene {
        name: "box in an L",
        recipe: l,
        blocks: 2,
        lines: "INITIAL VELOCITY MATERIAL, 2, 0., 0., -20.",
        duration: 1e-4,
    };
    l.keeps_its_energy(ROUND_OFF);
    let (x, y) = (0.5, 0.75_f64.sqrt());
    let lower: String =
        [[0.0, 0.0], [1.0, 0.0], [x, y], [x - 1.0, y]].map(|[x, y]| format!("{x:?}, {y:?}, 0.\n")).concat();
    let upper = lower.replace(", 0.\n", ", 1.\n");
    let fin = format!(
        "BOX, 1, 0., -1., 0., 1., 1., 1., 1, 1, 1\nHEXAHEDRON, 1, 1, 1, 1\n{lower}{upper}END\nMERGE, 1\n\
         BOX, 2, 1., -.5, -.2, 1., .5, .3, 1, 1, 1\n"
    );
    let fin = Scene {
        name: "fin at a ridge",
        recipe: &fin,
        blocks: 2,
        lines: "INITIAL VELOCITY MATERIAL, 2, 0., 0., 20.",
        duration: 1e-4,
    };
    fin.keeps_its_energy(ROUND_OFF);
}

/// The lower layer of a slanted side is nearer to what lies on the plate than half an element, and its face below that: nodes were moved by 0.47, more
/// than the plate is thick. A body that tapers was taken to be in itself.
#[test]
fn what_lies_on_layers_with_a_slanted_side_and_what_tapers_is_not_moved() {
    for layers in 1..=4 {
        let plates = format!(
            "HEXAHEDRON, 1, 1, 1, {layers}\n0., 0., 0.\n2., 0., 0.\n2., 2., 0.\n0., 2., 0.\n.25, 0., .3\n2.25, 0., .3\n2.25, 2., .3\n\
             .25, 2., .3\nEND\nBOX, 2, .55, 0., .3, 2., 2., .3, 2, 1, 1\n"
        );
        let plates = Scene {
            name: "plate on slanted layers",
            recipe: &plates,
            blocks: 2,
            lines: "INITIAL VELOCITY MATERIAL, 1, 10., 0., 0.\nINITIAL VELOCITY MATERIAL, 2, 10., 0., 0.",
            duration: 1e-4,
        };
        plates.keeps_its_energy(ROUND_OFF);
    }
    let tapering = "HEXAHEDRON, 1, 2, 1, 1\n0., 0., 0.\n1., 0., 0.\n.55, 1., 0.\n.45, 1., 0.\n0., 0., 1.\n1., 0., 1.\n\
                    .55, 1., 1.\n.45, 1., 1.\nEND\n";
    let tapering = Scene {
        name: "a body that tapers",
        recipe: tapering,
        blocks: 1,
        lines: "INITIAL VELOCITY MATERIAL, 1, 0., 0., 1.",
        duration: 1e-5,
    };
    tapering.keeps_its_energy(ROUND_OFF);
}

/// A ball in a socket whose facets match, too large by 1 to 4 hundredths: every node of it is behind a corner of the socket, beyond the ends of all borders that
/// meet there. Of three hundredths on none was found, so that nothing was pressed.
#[test]
fn a_ball_that_is_too_large_for_its_socket_is_found_to_overlap_it() {
    for (elements, nodes) in [(2, 98), (3, 218)] {
        for overlap in [0.01, 0.02, 0.03, 0.04] {
            let mesh = recipe(&format!(
                "TITLE\n ball\nSPHERE SHELL, 1, 1.0, 1.6, {elements}, 2\nSPHERE SHELL, 2, 0.4, {:?}, {elements}, 2\n",
                1.0 + overlap
            ));
            let deck = format!(
                "TITLE\n ball\nTERMINATION TIME, 1.E-6\nCONTACT MATERIAL\nCONTACT DATA, 1, 2, 0., 1.\nCONTACT OVERLAP, KEEP\n{}",
                laws(2)
            );
            let found = Body::new(&mesh, &model(&deck, &mesh)).expect("materials").overlap.kept.nodes;
            assert_eq!(found, nodes, "{elements} elements, {overlap}");
        }
    }
}
