//! Commands that pick node sets and side sets.

use super::{Draft, Place, Setter};
use crate::{
    deck::{Card, Diagnostic, spelling},
    mesher::{
        body::Face,
        region::Region,
        sets::{Request, What},
    },
};

pub(super) const COMMANDS: &[Setter] = &[
    ("NODE SET PLANE", |card, draft| add_nodes(card, draft, plane)),
    ("NODE SET EDGE", |card, draft| add_nodes(card, draft, edge)),
    ("NODE SET POINT", |card, draft| add_nodes(card, draft, point)),
    ("NODE SET BOX", |card, draft| add_nodes(card, draft, within)),
    ("NODE SET CYLINDER", |card, draft| add_nodes(card, draft, cylinder)),
    ("NODE SET SPHERE", |card, draft| add_nodes(card, draft, sphere)),
    ("NODE SET OBLIQUE", |card, draft| add_nodes(card, draft, oblique)),
    ("NODE SET FACE", |card, draft| add_nodes(card, draft, face)),
    ("NODE SET BLOCK", |card, draft| add_nodes(card, draft, all)),
    ("SIDE SET PLANE", |card, draft| add_sides(card, draft, plane)),
    ("SIDE SET BOX", |card, draft| add_sides(card, draft, within)),
    ("SIDE SET CYLINDER", |card, draft| add_sides(card, draft, cylinder)),
    ("SIDE SET SPHERE", |card, draft| add_sides(card, draft, sphere)),
    ("SIDE SET OBLIQUE", |card, draft| add_sides(card, draft, oblique)),
    ("SIDE SET FACE", |card, draft| add_sides(card, draft, face)),
    ("SIDE SET NORMAL", |card, draft| add_sides(card, draft, normal)),
    ("SIDE SET BLOCK", |card, draft| add_sides(card, draft, all)),
];

/// What a card picks, unless it is wrong.
type Picked = fn(&Card, &mut Draft) -> Option<What>;

fn add_nodes(card: &Card, draft: &mut Draft, picked: Picked) {
    let request = request(card, draft, "node_set", picked);
    draft.recipe.node_sets.extend(request);
}

fn add_sides(card: &Card, draft: &mut Draft, picked: Picked) {
    let request = request(card, draft, "side_set", picked);
    draft.recipe.side_sets.extend(request);
}

fn request(card: &Card, draft: &mut Draft, set: &str, picked: Picked) -> Option<Request> {
    let what = picked(card, draft)?;
    // The block of a named face is the one it was made as, which SPLIT BLOCK may have changed.
    let block = card.maybe_integer("block").filter(|_| !matches!(what, What::Face(..)));
    Some(Request { id: card.integer(set), what, block, place: Place::of(card) })
}

fn plane(card: &Card, _: &mut Draft) -> Option<What> {
    let mut values = [None; 3];
    values[super::axis(card, "axis")] = card.maybe_number("at");
    Some(What::Region(Region::Coordinates(values)))
}

fn edge(card: &Card, draft: &mut Draft) -> Option<What> {
    let axes = ["axis", "second_axis"].map(|field| super::axis(card, field));
    if axes[0] == axes[1] {
        let message = format!("NODE SET EDGE: both planes are across {}", card.text("axis"));
        draft.report(
            Diagnostic::error(message)
                .at(card.place("second_axis"), "planes across the same axis do not meet")
                .help("the edge x = 0, y = 1 is written NODE SET EDGE, 5, X, 0., Y, 1."),
        );
        return None;
    }
    let mut values = [None; 3];
    values[axes[0]] = card.maybe_number("at");
    values[axes[1]] = card.maybe_number("second_at");
    Some(What::Region(Region::Coordinates(values)))
}

fn point(card: &Card, _: &mut Draft) -> Option<What> {
    Some(What::Region(Region::Coordinates(card.vector(["x", "y", "z"]).map(Some))))
}

fn within(card: &Card, draft: &mut Draft) -> Option<What> {
    let [low, high] = super::bounds(card, draft)?;
    Some(What::Region(Region::Box { low, high }))
}

fn cylinder(card: &Card, _: &mut Draft) -> Option<What> {
    let axis = super::axis(card, "axis");
    let (radius, centre) = (card.number("radius"), card.vector(["x", "y", "z"]));
    Some(What::Region(Region::Cylinder { axis, radius, centre }))
}

fn sphere(card: &Card, _: &mut Draft) -> Option<What> {
    Some(What::Region(Region::Sphere { radius: card.number("radius"), centre: card.vector(["x", "y", "z"]) }))
}

fn oblique(card: &Card, draft: &mut Draft) -> Option<What> {
    let normal = super::unit_vector(card, ["nx", "ny", "nz"], draft)?;
    Some(What::Region(Region::Plane { point: card.vector(["x", "y", "z"]), normal }))
}

fn normal(card: &Card, draft: &mut Draft) -> Option<What> {
    let direction = super::unit_vector(card, ["nx", "ny", "nz"], draft)?;
    Some(What::Normal { direction, cosine: libm::cos(card.number("angle").to_radians()) })
}

fn all(_: &Card, _: &mut Draft) -> Option<What> {
    Some(What::All)
}

fn face(card: &Card, draft: &mut Draft) -> Option<What> {
    let block = card.integer("block");
    if !draft.knows(card, "block", block) {
        return None;
    }
    let face = Face::ALL.into_iter().find(|face| face.words() == card.text("face"))?;
    let parts = draft.recipe.parts.iter().filter(|part| part.block == block);
    let mut faces: Vec<Face> = Vec::new();
    for name in parts.flat_map(|part| part.shape.faces()) {
        if !faces.contains(&name) {
            faces.push(name);
        }
    }
    if faces.contains(&face) {
        return Some(What::Face(block, face));
    }
    let names: Vec<&str> = faces.iter().map(|face| face.words()).collect();
    let message = format!("{}: the shape of block {block} has no face {}", card.name, face.words());
    let told = if names.is_empty() { "it has none".to_string() } else { format!("it has {}", spelling::all(&names)) };
    draft.report(Diagnostic::error(message).at(card.place("face"), told));
    None
}
