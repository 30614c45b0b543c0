//! Commands that make shapes.

use std::sync::Arc;

use super::{Draft, Part, Place, Setter};
use crate::{
    deck::{Card, Diagnostic},
    mesher::{
        body::{Extent, Face, Shape},
        shapes::{
            cylinder::Cylinder,
            hex_box::Hexahedron,
            line::Line,
            patch::{Disc, Patch, Ring},
            sheet::Sheet,
            spacing::Spacing,
            sphere::{Sphere, SphereShell},
            tube::Tube,
        },
    },
};

pub(super) const COMMANDS: &[Setter] = &[
    ("BOX", right_angled),
    ("HEXAHEDRON", hexahedron),
    ("CYLINDER", cylinder),
    ("TUBE", tube),
    ("SPHERE", sphere),
    ("SPHERE SHELL", sphere_shell),
    ("LINE", line),
    ("RECTANGLE", rectangle),
    ("QUADRILATERAL", quadrilateral),
    ("DISC", disc),
    ("RING", ring),
    ("SHEET", sheet),
    ("SHEET TUBE", sheet_tube),
    ("SHEET SPHERE", sheet_sphere),
];

fn add(card: &Card, draft: &mut Draft, shape: impl Shape + 'static) {
    let (block, shape) = (card.integer("block"), Arc::new(shape));
    draft.recipe.parts.push(Part { block, shape, moves: Vec::new(), place: Place::of(card) });
}

/// Cells from two fields; a field that the command does not have grades evenly.
fn spacing(card: &Card, cells: &str, grading: &str) -> Spacing {
    Spacing { cells: count(card, cells), grading: super::number_or(card, grading, 1.0) }
}

fn count(card: &Card, field: &str) -> usize {
    card.integer(field).try_into().unwrap_or(1)
}

fn cells_of_hexahedron(card: &Card) -> [Spacing; 3] {
    [("nx", "gx"), ("ny", "gy"), ("nz", "gz")].map(|(cells, grading)| spacing(card, cells, grading))
}

fn right_angled(card: &Card, draft: &mut Draft) {
    let (corner, size) = (card.vector(["x", "y", "z"]), card.vector(["dx", "dy", "dz"]));
    add(card, draft, Hexahedron::right_angled(corner, size, cells_of_hexahedron(card)));
}

fn hexahedron(card: &Card, draft: &mut Draft) {
    let rows = card.rows.iter().filter_map(|row| row.numbers[..].try_into().ok());
    let corners: Vec<[f64; 3]> = rows.collect();
    match corners[..].try_into() {
        Ok(corners) => add(card, draft, Hexahedron { corners, cells: cells_of_hexahedron(card) }),
        Err(_) => draft.report(
            Diagnostic::error(format!("HEXAHEDRON: it has {} corners; it must have 8", corners.len()))
                .at(card.record, "one line with x, y, z for each corner, then END")
                .help("four around the bottom, counter-clockwise seen from the top, then the four above them"),
        ),
    }
}

fn line(card: &Card, draft: &mut Draft) {
    let ends = [card.vector(["x", "y", "z"]), card.vector(["x2", "y2", "z2"])];
    if ends[0] == ends[1] {
        let message = "LINE: it begins where it ends";
        return draft.report(Diagnostic::error(message).at(card.record, "the two ends must be apart"));
    }
    add(card, draft, Line { ends, cells: count(card, "n") });
}

/// Thickness over radius of the solids whose outer faces round sheets are; the faces do not depend on it.
const WALL: f64 = 0.1;

fn sheet(card: &Card, draft: &mut Draft) {
    let (corner, size) = (card.vector(["x", "y", "z"]), card.vector(["dx", "dy", "dz"]));
    let flat: Vec<usize> = (0..3).filter(|&axis| size[axis] == 0.0).collect();
    let &[across] = &flat[..] else {
        let place = card.place("dx").join(card.place("dz"));
        return draft.report(
            Diagnostic::error("SHEET: one of its three sizes must be 0, and the others not")
                .at(place, "sizes along x, y and z")
                .help("a sheet lies across x, y or z; ROTATE turns it"),
        );
    };
    let mut cells = [Spacing { cells: 1, grading: 1.0 }; 3];
    let along = (0..3).filter(|&axis| axis != across);
    along.zip([("n1", "g1"), ("n2", "g2")]).for_each(|(axis, (n, g))| cells[axis] = spacing(card, n, g));
    let face = [Face::Right, Face::Back, Face::Top][across];
    // A sheet that is made towards smaller coordinates has its first edge at the larger one; with one size of the two its top looks down.
    let mut against = size.map(|size| size < 0.0);
    against[across] = against.iter().filter(|&&against| against).count() == 1;
    add(card, draft, Sheet { solid: Hexahedron::right_angled(corner, size, cells), face, against });
}

fn sheet_tube(card: &Card, draft: &mut Draft) {
    let (outer, around) = (card.number("radius"), count(card, "around"));
    let extent = Extent::from_word(card.text("model"));
    let through = Spacing { cells: 1, grading: 1.0 };
    let inner = outer * (1.0 - WALL);
    let along = spacing(card, "nz", "gz");
    let least = [1, 1, 2, 0, 3][extent.quadrants()];
    if around < least {
        let message = format!("SHEET TUBE: {around} cells around are not enough; it needs {least}");
        return draft
            .report(Diagnostic::error(message).at(card.place("around"), "cells around the part that is modelled"));
    }
    let solid = Tube { inner, outer, length: card.number("length"), through, around, along, extent };
    add(card, draft, Sheet { solid, face: Face::Outer, against: [false; 3] });
}

fn sheet_sphere(card: &Card, draft: &mut Draft) {
    let (outer, around) = (card.number("radius"), count(card, "n"));
    let extent = Extent::from_word(card.text("model"));
    let through = Spacing { cells: 1, grading: 1.0 };
    let solid = SphereShell { inner: outer * (1.0 - WALL), outer, around, through, extent };
    add(card, draft, Sheet { solid, face: Face::Outer, against: [false; 3] });
}

fn cylinder(card: &Card, draft: &mut Draft) {
    let core_cells = count(card, "n");
    let rings = if card.given("rings") { count(card, "rings") } else { core_cells };
    let shape = Cylinder {
        radius: card.number("radius"),
        length: card.number("length"),
        core_cells,
        rings,
        core: card.number("core"),
        along: spacing(card, "nz", "gz"),
        extent: Extent::from_word(card.text("model")),
    };
    add(card, draft, shape);
}

fn rectangle(card: &Card, draft: &mut Draft) {
    let ([x, y], [dx, dy]) = (["x", "y"].map(|field| card.number(field)), ["dx", "dy"].map(|field| card.number(field)));
    let corners = [[x, y], [x + dx, y], [x + dx, y + dy], [x, y + dy]];
    add(card, draft, Patch { corners, arcs: [0.0; 4], cells: cells_of_patch(card) });
}

fn cells_of_patch(card: &Card) -> [Spacing; 2] {
    [spacing(card, "nx", "gx"), spacing(card, "ny", "gy")]
}

fn quadrilateral(card: &Card, draft: &mut Draft) {
    let rows: Vec<[f64; 3]> = card.rows.iter().filter_map(|row| row.numbers[..].try_into().ok()).collect();
    let rows: Result<[[f64; 3]; 4], _> = rows[..].try_into();
    match rows {
        Ok(rows) => {
            let (corners, arcs) = (rows.map(|[x, y, _]| [x, y]), rows.map(|[.., arc]| arc));
            add(card, draft, Patch { corners, arcs, cells: cells_of_patch(card) });
        }
        Err(_) => draft.report(
            Diagnostic::error(format!("QUADRILATERAL: it has {} corners; it must have 4", card.rows.len()))
                .at(card.record, "one line with x, y and, for an arc, its angle for each corner, then END")
                .help("corners run counter-clockwise"),
        ),
    }
}

fn disc(card: &Card, draft: &mut Draft) {
    let core_cells = count(card, "n");
    let section = Cylinder {
        radius: card.number("radius"),
        length: 1.0,
        core_cells,
        rings: if card.given("rings") { count(card, "rings") } else { core_cells },
        core: card.number("core"),
        along: Spacing { cells: 1, grading: 1.0 },
        extent: Extent::from_word(card.text("model")),
    };
    add(card, draft, Disc { section, pole: card.number("pole") });
}

fn ring(card: &Card, draft: &mut Draft) {
    let Some([inner, outer]) = radii(card, draft) else { return };
    let [from, to] = ["from", "to"].map(|field| card.number(field));
    let (turned, around) = (to - from, count(card, "around"));
    // With fewer cells the wall would be flat.
    if !(0.0..=360.0).contains(&turned) || turned == 0.0 || (around as f64) * 180.0 <= turned {
        let message = format!("RING: {around} cells cannot make {turned} degrees");
        let place = card.place("from").join(card.place("to"));
        return draft.report(
            Diagnostic::error(message)
                .at(place, "the end lies beyond the beginning, by 360 degrees at most")
                .help("a cell spans less than 180 degrees"),
        );
    }
    add(card, draft, Ring { inner, outer, through: spacing(card, "through", "gr"), around, from, turned });
}

fn tube(card: &Card, draft: &mut Draft) {
    let Some([inner, outer]) = radii(card, draft) else { return };
    let (extent, around) = (Extent::from_word(card.text("model")), count(card, "around"));
    // With fewer cells the wall would be flat.
    let least = [1, 1, 2, 0, 3][extent.quadrants()];
    if around < least {
        let message = format!("TUBE: {around} cells around are not enough; a {} needs {least}", card.text("model"));
        let diagnostic =
            Diagnostic::error(message.replace("a FULL", "a FULL circle").replace("a HALF", "a HALF circle"));
        return draft.report(diagnostic.at(card.place("around"), "cells around the part that is modelled"));
    }
    let (through, along) = (spacing(card, "through", "gr"), spacing(card, "nz", "gz"));
    add(card, draft, Tube { inner, outer, length: card.number("length"), through, around, along, extent });
}

fn sphere(card: &Card, draft: &mut Draft) {
    let core_cells = count(card, "n");
    let rings = if card.given("rings") { count(card, "rings") } else { core_cells };
    let extent = Extent::from_word(card.text("model"));
    let (radius, core) = (card.number("radius"), card.number("core"));
    add(card, draft, Sphere { radius, core_cells, rings, core, extent, pole: card.number("pole") });
}

fn sphere_shell(card: &Card, draft: &mut Draft) {
    let Some([inner, outer]) = radii(card, draft) else { return };
    let extent = Extent::from_word(card.text("model"));
    let (around, through) = (count(card, "n"), spacing(card, "through", "gr"));
    add(card, draft, SphereShell { inner, outer, around, through, extent });
}

/// Inner and outer radius; reports an outer one that is not larger.
fn radii(card: &Card, draft: &mut Draft) -> Option<[f64; 2]> {
    let [inner, outer] = ["inner", "outer"].map(|field| card.number(field));
    if inner < outer {
        return Some([inner, outer]);
    }
    let message = format!("{}: the outer radius is {outer}; it must be larger than the inner one, {inner}", card.name);
    let place = card.place("inner").join(card.place("outer"));
    draft.report(Diagnostic::error(message).at(place, "inner radius, outer radius"));
    None
}
