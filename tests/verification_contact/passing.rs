//! Bodies that slide on each other, pass each other by or merely touch, in shapes that are no boxes: nothing is moved before the run, and the
//! energy of motion stays.

use super::abutting::laws;
use crate::support::meshes::recipe;
use crate::support::run::{model, run};
use urto::mesh::Mesh;
use urto::solver::Body;

/// A scene of blocks of steel, of which some fly at a velocity, for a time.
struct Scene<'a> {
    name: &'a str,
    recipe: &'a str,
    blocks: usize,
    lines: &'a str,
    duration: f64,
}

impl Scene<'_> {
    fn mesh(&self) -> Mesh {
        recipe(&format!("TITLE\n {}\n{}", self.name, self.recipe))
    }

    fn deck(&self) -> String {
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
    fn keeps_its_energy(&self, tolerance: f64) {
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
const ROUND_OFF: f64 = 1e-9;

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
    for gap in [1e-5, 1e-4, 1e-3] {
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
