//! Knobs of contact.

use super::{Knob, Variant};
use crate::common::numbers::scientific;
use crate::mesh::{Dimension, Mesh};
use crate::model::{ContactEdges, ContactSearch, Model};

/// How contact is enforced, what may touch, and how it is found; nothing without contact.
pub fn variants(model: &Model, mesh: &Mesh) -> Vec<Variant> {
    if !model.contact.is_some() {
        return Vec::new();
    }
    let control = &model.contact.control;
    let command = |passes: u32, tolerance: f64, unsettled: u32| {
        format!("CONTACT PASSES, {passes}, {}, {unsettled}", scientific(tolerance, 2))
    };
    let without = &["CONTACT PASSES"];
    let now = control.passes;
    let tight = (5 * now).min(1000);
    let mut all = vec![
        Variant::of(Knob::Contact, "one-pass", without, command(1, control.tolerance, 1), 1.0),
        Variant::of(
            Knob::Contact,
            "loose-contact",
            without,
            command(now, 100.0 * control.tolerance.max(1e-12), control.unsettled_passes),
            1.0,
        ),
        Variant::of(
            Knob::Contact,
            "tight-contact",
            without,
            command(tight, 0.01 * control.tolerance, tight.max(control.unsettled_passes)),
            1.5,
        ),
    ];
    if model.contact.materials.is_some() && mesh.dimension == Dimension::Three {
        let other = |name: &str, word: &str| {
            Variant::of(Knob::Contact, name, &["CONTACT EDGES"], format!("CONTACT EDGES, {word}"), 1.2)
        };
        if control.edges != ContactEdges::None {
            all.push(other("no-edges", "OFF"));
        }
        if control.edges != ContactEdges::All {
            all.push(other("all-edges", "ALL"));
        }
    }
    all.extend(search(model));
    all
}

/// The other searches. Results do not depend on them.
fn search(model: &Model) -> Vec<Variant> {
    let all = [
        (ContactSearch::Grid, "search-grid", "GRID"),
        (ContactSearch::Tree, "search-tree", "TREE"),
        (ContactSearch::PointInBox, "search-lists", "POINT IN BOX"),
    ];
    let control = &model.contact.control;
    let others = all.into_iter().filter(|(search, ..)| *search != control.search);
    let of = |(_, name, word): (ContactSearch, &str, &str)| {
        let line = format!("CONTACT SEARCH, {word}, {:?}, {:?}", control.reach, control.margin);
        Variant::of(Knob::Search, name, &["CONTACT SEARCH"], line, 1.0)
    };
    others.map(of).collect()
}
