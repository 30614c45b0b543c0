//! What the front part of the log says of contact and of the removal of elements.

use super::{echo::table, number};
use crate::model::{ContactEdges, ContactMaterials, ContactSearch, Death, Friction, Model};
use crate::solver::contact::{Crowded, DeepOverlap, Overlap, Stuck};

/// Tables of contact, of initial overlaps and of erosion; empty where the deck asks for none.
pub fn tables(model: &Model, overlap: Overlap) -> String {
    let contact = &model.contact;
    let friction =
        |f: &Friction| format!("{:>13}{:>13}{:>13}", number(f.at_rest), number(f.high_speed), number(f.decay));
    let share = |partition: Option<f64>| partition.map_or("IMPEDANCE".to_string(), number);
    let pairs = contact.surfaces.iter().map(|pair| {
        let [first, second] = pair.side_sets;
        format!("{:<14}{first:>8}{second:>8}{:>13}{}", "SIDE SETS", number(pair.partition), friction(&pair.friction))
    });
    let data = contact.data.iter().map(|data| {
        let [first, second] = data.materials;
        format!("{:<14}{first:>8}{second:>8}{:>13}{}", "MATERIALS", share(data.partition), friction(&data.friction))
    });
    let lines: Vec<String> = materials(contact.materials.as_ref()).into_iter().chain(pairs).chain(data).collect();
    [
        table("CONTACT", "BETWEEN          FIRST  SECOND    PARTITION     FRICTION   HIGH SPEED        DECAY", lines),
        table("CONTACT CONTROL", "", if contact.is_some() { control(model) } else { Vec::new() }),
        table("INITIAL OVERLAPS TAKEN OUT OF THE MESH", "NODES MOVED   FARTHEST", overlaps(overlap)),
        table(
            "OVERLAPS THAT CONTACT OVERLAP LETS STAY OR PUSHES APART",
            "NODES BEHIND FACES    DEEPEST",
            kept(if overlap.kept.nodes > 0 { overlap.kept } else { overlap.stuck }),
        ),
        table("OVERLAPS LEFT IN THE MESH", "NODES INSIDE ELEMENTS    DEEPEST", left(overlap.deep)),
        table(
            "NODES NEARER TO SHELLS OR BARS THAN THEIR THICKNESS",
            "  NODES   LEAST PART OF THE DISTANCE",
            crowded(overlap.crowded),
        ),
        table(
            "REMOVAL OF ELEMENTS",
            "BLOCK   VARIABLE      BOUND        VALUE   NODES",
            model.deaths.iter().map(death).collect(),
        ),
        table(
            "REMOVAL OF BLOCKS",
            "BLOCK         TIME",
            model.deletions.iter().map(|one| format!("{:>5}{:>13}", one.block, number(one.time))).collect(),
        ),
    ]
    .concat()
}

fn materials(materials: Option<&ContactMaterials>) -> Option<String> {
    let named = match materials? {
        ContactMaterials::All => "ALL".to_string(),
        ContactMaterials::Blocks(ids) => ids.iter().map(i64::to_string).collect::<Vec<_>>().join(" "),
    };
    Some(format!("{:<14}{named}", "MATERIALS"))
}

fn control(model: &Model) -> Vec<String> {
    let control = &model.contact.control;
    let search = match control.search {
        ContactSearch::PointInBox => "POINT IN BOX",
        ContactSearch::Grid => "GRID",
        ContactSearch::Tree => "TREE",
    };
    let thicknesses = model.contact.thicknesses.iter();
    let thicknesses =
        thicknesses.map(|(block, factor)| format!("THICKNESS OF BLOCK {block} TIMES {}", number(*factor)));
    let sets = model.contact.node_sets.iter();
    let sets = sets.map(|(set, radius)| format!("NODES OF SET {set} TOUCH, RADIUS {}", number(*radius)));
    let mut lines = vec![
        format!(
            "AT MOST {} PASSES{}, TO AN OVERLAP OF {} FACE SIZES",
            control.passes,
            if control.unsettled_passes > control.passes {
                format!(" ({} WHERE THEY DO NOT SETTLE)", control.unsettled_passes)
            } else {
                String::new()
            },
            number(control.tolerance)
        ),
        format!("SEARCH BY {search}, TO LAST {} STEPS OR {} FACE SIZES", number(control.reach), number(control.margin)),
        format!("EDGES TOUCH EDGES: {}", edges(control.edges)),
    ];
    let apart = |pair: &[Option<i64>; 2]| match pair.map(|id| id.map_or("ALL".to_string(), |id| id.to_string())) {
        [first, second] if pair[1].is_some() => format!("KEPT APART: {first} AND {second}"),
        [first, _] => format!("KEPT FROM TOUCHING ITSELF: {first}"),
    };
    lines.extend(thicknesses.chain(sets).chain(model.contact.exclusions.iter().map(apart)));
    lines
}

fn edges(edges: ContactEdges) -> &'static str {
    match edges {
        ContactEdges::None => "NO",
        ContactEdges::Sharp => "YES",
        ContactEdges::All => "YES, AND THE LINES IN FLAT FACES",
    }
}

fn overlaps(overlap: Overlap) -> Vec<String> {
    let moved = (overlap.nodes > 0).then(|| format!("{:>11}{:>13}", overlap.nodes, number(overlap.farthest)));
    moved.into_iter().collect()
}

fn kept(kept: Stuck) -> Vec<String> {
    let some = (kept.nodes > 0).then(|| format!("{:>18}{:>13}", kept.nodes, number(kept.deepest)));
    some.into_iter().collect()
}

fn left(left: DeepOverlap) -> Vec<String> {
    let some = (left.nodes > 0).then(|| format!("{:>21}{:>13}", left.nodes, number(left.deepest)));
    some.into_iter().collect()
}

fn crowded(crowded: Crowded) -> Vec<String> {
    let some = (crowded.nodes > 0).then(|| format!("{:>7}{:>13}", crowded.nodes, number(crowded.least)));
    some.into_iter().collect()
}

fn death(death: &Death) -> String {
    let variable = death.variable.name();
    let bound = if death.is_maximum { "MAX" } else { "MIN" };
    let nodes = if death.keeps_nodes { "FREE" } else { "DROP" };
    let share = if death.share < 1.0 { format!("   {}", number(death.share)) } else { String::new() };
    format!("{:>5}   {variable:<14}{bound:<8}{:>10}   {nodes}{share}", death.block, number(death.value))
}
