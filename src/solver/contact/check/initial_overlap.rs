//! Overlaps that the mesh begins with: taken out by moving nodes before the run, which gives nobody a velocity.

use super::behind::{Behind, NOTHING, behind, overlaps};
use super::body_pairs::BodyPairs;
use super::deep::{self, Inside, deep_points, measured};
use super::engulfed::engulfed;
use super::overlap::{Crowded, Overlap, Squeezed, Stuck};
use super::pierced::pierced;
use super::sunk::{Inner, SunkFaces};
use super::unheld::Unheld;
use crate::common::disjoint_sets::DisjointSets;
use crate::common::vector::{add, cross, dot, scaled, subtract};
use crate::mesh::{HEX_SIDES, Mesh, plane};
use crate::model::{ContactOverlap, Model};
use crate::solver::Body;
use crate::solver::body::centroid;
use crate::solver::constraints::StepTimes;
use crate::solver::contact::enforcement::accounts::ledger::Ledger;
use crate::solver::contact::enforcement::constraint::Constraint;
use crate::solver::contact::enforcement::enforcer::Enforcer;
use crate::solver::contact::enforcement::iterations::Limits;
use crate::solver::contact::enforcement::other_ranks::NoOtherRanks;
use crate::solver::contact::geometry::motion::NodeMotion;
use crate::solver::contact::geometry::projection;
use crate::solver::contact::surface::layout::{ABSENT, Layout};
use crate::solver::contact::surface::pairings::Pairings;
use crate::solver::contact::surface::skin::Skin;
use crate::solver::elements::Touch;
use std::collections::BTreeMap;

/// An overlap that is left after all rounds and is less than this part of a face's size does not matter: contact keeps it as
/// it is.
pub(super) const STUCK: f64 = 1e-4;

/// Where overlaps stay, contact knows points as deep as this part of half the element.
const KNOWN: f64 = 1.0;

/// Elements are seen larger by this part where points between two of them must not be in neither.
const LARGER: f64 = 1e-3;

/// Nodes of an element that have come as near to each other as this part of their distance before are at the same place.
const TOGETHER: f64 = 1e-3;

/// A tetrahedron of less than this part of the product of its edges at a corner is flat.
const FLAT: f64 = 1e-9;

/// Rounds of finding overlaps and moving nodes: what moves may overlap elsewhere.
const ROUNDS: usize = 10;

/// Moves nodes of the body out of the faces that they begin behind; both sides go their share, by mass and partition. Where the room is less
/// than thicknesses, the body is told.
pub fn remove(mesh: &Mesh, model: &Model, body: &mut Body) -> Overlap {
    if !model.contact.is_some() {
        return Overlap::default();
    }
    let overlap = remove_deep(mesh, model, body);
    let balls = model.contact.node_sets.iter().any(|(_, radius)| *radius > 0.0);
    if !balls && body.elements.iter().all(|element| element.touch(&[]) == Touch::Outside) {
        return overlap;
    }
    let layout = Skin::new(mesh, model, body, Vec::new()).layout();
    let (crowded, rooms) = crowded(mesh, model, body, &layout);
    body.rooms = rooms;
    Overlap { crowded, ..overlap }
}

/// Lets all points be where they are in the body, and stay there.
pub(super) fn stand_still(motion: &mut NodeMotion, body: &Body, layout: &Layout) {
    motion.begin([0.0; 2]);
    for (point, &node) in (0..).zip(&layout.nodes) {
        let [x, y, z] = body.positions[node as usize];
        motion.receive(point, [x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    }
}

/// What thicknesses have no room for, and the room of the nodes over faces that are too near, see [`Body::rooms`].
fn crowded(mesh: &Mesh, model: &Model, body: &Body, layout: &Layout) -> (Crowded, Vec<(u32, f64)>) {
    let mut crowded = Crowded { least: 1.0, ..Crowded::default() };
    let mut rooms = BTreeMap::new();
    if layout.faces.node_reach.iter().all(|&reach| reach == 0.0) {
        return (crowded, Vec::new());
    }
    let mut motion = NodeMotion::new(layout.nodes.len(), layout.origin);
    stand_still(&mut motion, body, layout);
    let mut last = ABSENT;
    for Behind { point, contact, beside, .. } in behind(layout, &Pairings::new(mesh, model, body), &motion) {
        let distance = layout.faces.distance(point, contact.face);
        let (size, room) = (layout.faces.size[contact.face as usize], contact.projection.gap + distance);
        if distance > 0.0 && room >= -NOTHING * size && contact.projection.gap < -STUCK * size {
            crowded.nodes += usize::from(point != last);
            last = point;
            let part = (room / distance).max(0.0);
            if part < crowded.least {
                (crowded.least, crowded.node) = (part, layout.nodes[point as usize]);
            }
            // What is beside a face and near its border says nothing of the room over it.
            if beside {
                continue;
            }
            let members = layout.faces.corners[contact.face as usize].into_iter().chain([point]);
            for member in members.filter(|&member| layout.faces.node_reach[member as usize] > 0.0) {
                let least = rooms.entry(layout.nodes[member as usize]).or_insert(part);
                *least = part.min(*least);
            }
        }
    }
    (crowded, rooms.into_iter().collect())
}

/// Moves nodes of the body out of the faces that they begin behind, without regard to thicknesses.
fn remove_deep(mesh: &Mesh, model: &Model, body: &mut Body) -> Overlap {
    // No thickness is put into a mesh that has no room for it.
    let layout = Skin::new(mesh, model, body, Vec::new()).without_thickness().layout();
    let mut overlap = remove_known(mesh, model, body, &layout);
    let Some(automatic) = layout.automatic() else { return overlap };
    let treatment = model.contact.control.overlap;
    let moves = matches!(treatment, ContactOverlap::Refuse | ContactOverlap::Remove);
    let part = if moves { deep::CLEARLY } else { KNOWN };
    let mut inside = deep_points(body, &layout, automatic, part);
    if let Some(pairs) = BodyPairs::of(body, &layout, automatic) {
        let (given, surface) = ((mesh, model), (&*body, &layout, automatic));
        let must_go = matches!(treatment, ContactOverlap::Stress(_));
        overlap.pierced = Unheld { must_go, ..pierced(given, surface, &pairs) };
        overlap.known_opposite = leave_out_sunk(given, (body, &layout), (&pairs, &mut inside));
        // What is told by its nodes is told; of what only looks away from faces that are near, elements tell more.
        if inside.iter().all(|inside| inside.faces_away) {
            let nodes;
            (overlap.engulfed, nodes) = engulfed(given, surface, &pairs);
            inside.retain(|inside| !nodes.contains(&layout.nodes[inside.point as usize]));
        }
    }
    overlap.deep = measured(body, &layout, automatic, &inside);
    overlap
}

/// Leaves out nodes that are deep in a fine mesh whose surface is known to be in their body. How many these are.
fn leave_out_sunk(
    given: (&Mesh, &Model),
    (body, layout): (&Body, &Layout),
    (pairs, inside): (&BodyPairs, &mut Vec<Inside>),
) -> usize {
    if inside.is_empty() {
        return 0;
    }
    let place = |of: &Inside| {
        let node = layout.nodes[of.point as usize];
        let element = body.element_nodes[of.element as usize][0];
        Inner { at: body.positions[node as usize], body: pairs.body(element), other: pairs.body(node) }
    };
    let before = inside.len();
    SunkFaces::of(given, body, layout, pairs).leave_out_below(inside, place);
    before - inside.len()
}

/// Moves nodes out of the faces behind which contact knows them to be.
fn remove_known(mesh: &Mesh, model: &Model, body: &mut Body, layout: &Layout) -> Overlap {
    match model.contact.control.overlap {
        ContactOverlap::Keep => return Overlap { rigid: Stuck::default(), ..kept(mesh, model, body, layout) },
        ContactOverlap::Stress(_) => return kept(mesh, model, body, layout),
        ContactOverlap::Refuse | ContactOverlap::Remove => (),
    }
    let pairings = Pairings::new(mesh, model, body);
    let mut motion = NodeMotion::new(layout.nodes.len(), layout.origin);
    weigh(mesh, model, body, layout, &mut motion);
    let still = StepTimes { time: 0.0, kick: 1.0, drift: 1.0 };
    let mut enforcer = Enforcer::new(motion.len());
    // Joints have moved what follows already.
    let before = body.positions.clone();
    // The deepest overlap that each point takes part in: no farther is it moved.
    let mut farthest = vec![0.0; motion.len()];
    let mut stuck = Stuck::default();
    for round in 0..=ROUNDS {
        stand_still(&mut motion, body, layout);
        let mut constraints = overlaps(body, layout, &pairings, &motion);
        stuck = Stuck::of(&constraints, layout);
        if constraints.is_empty() || round == ROUNDS {
            break;
        }
        for c in &constraints {
            c.parts().for_each(|(point, _)| farthest[point] = f64::max(farthest[point], -c.gap));
        }
        let limits = Limits {
            iterations: 100,
            unsettled: 100,
            tolerance: 0.1 * NOTHING,
            may_give_way: false,
            farthest: f64::INFINITY,
        };
        enforcer.prepare(&mut constraints, &motion, still.drift, &Ledger::Unlimited);
        enforcer.solve(&mut constraints, &motion, &still, limits, (Ledger::Unlimited, &mut NoOtherRanks));
        let positions: &mut Vec<[f64; 3]> = &mut body.positions;
        for (point, _) in constraints.iter().flat_map(|constraint| constraint.parts()) {
            let node = layout.nodes[point] as usize;
            let there = add(motion.start(point as u32), enforcer.velocity_change(point, &motion, still.kick));
            positions[node] = within(there, before[node], farthest[point]);
        }
    }
    let moved = moved(&before, body, layout);
    let squeezed = if moved.nodes > 0 { squeezed(&before, body) } else { Squeezed::default() };
    Overlap { stuck, squeezed, ..moved }
}

/// Overlaps that stay where they are, those of rigid bodies with each other once more.
fn kept(mesh: &Mesh, model: &Model, body: &Body, layout: &Layout) -> Overlap {
    let mut motion = NodeMotion::new(layout.nodes.len(), layout.origin);
    stand_still(&mut motion, body, layout);
    let mut constraints = overlaps(body, layout, &Pairings::new(mesh, model, body), &motion);
    let kept = Stuck::of(&constraints, layout);
    let is_rigid = of_rigid_bodies(mesh, body, layout);
    constraints.retain(|c| c.parts().all(|(point, _)| is_rigid[point]));
    Overlap { kept, rigid: Stuck::of(&constraints, layout), ..Overlap::default() }
}

/// Elements two of whose nodes have come together, where they were `before`.
fn squeezed(before: &[[f64; 3]], body: &Body) -> Squeezed {
    let has_moved = |&node: &u32| body.positions[node as usize] != before[node as usize];
    let apart = |at: &[[f64; 3]], a: u32, b: u32| {
        let between = subtract(at[a as usize], at[b as usize]);
        dot(between, between).sqrt()
    };
    let mut squeezed = Squeezed::default();
    for (nodes, &element) in body.element_nodes.iter().zip(body.element_order.iter()) {
        let Some(&node) = nodes.iter().find(|node| has_moved(node)) else { continue };
        let pairs = nodes.iter().enumerate().flat_map(|(i, &a)| nodes[..i].iter().map(move |&b| (a, b)));
        let meet = |(a, b): (u32, u32)| apart(&body.positions, a, b) < TOGETHER * apart(before, a, b);
        if pairs.into_iter().any(meet) {
            if squeezed.elements == 0 || element < squeezed.element {
                (squeezed.element, squeezed.node) = (element, node);
            }
            squeezed.elements += 1;
        }
    }
    squeezed
}

impl Stuck {
    /// Overlaps that are more than round-off of what was removed. The constraints of a node follow each other.
    fn of(constraints: &[Constraint], layout: &Layout) -> Stuck {
        let deep = constraints.iter().filter(|c| -c.gap > STUCK * c.size);
        let mut last = None;
        deep.fold(Stuck::default(), |sum, c| {
            let worst = if -c.gap > sum.deepest {
                (-c.gap, layout.nodes[c.members[0] as usize])
            } else {
                (sum.deepest, sum.node)
            };
            let is_new = last.replace(c.members[0]) != Some(c.members[0]);
            Stuck { nodes: sum.nodes + usize::from(is_new), deepest: worst.0, node: worst.1 }
        })
    }
}

/// The place nearest to `there` that is no farther than `most` from `from`.
fn within(there: [f64; 3], from: [f64; 3], most: f64) -> [f64; 3] {
    let path = subtract(there, from);
    let length = dot(path, path).sqrt();
    if length > most { add(from, scaled(path, most / length)) } else { there }
}

/// Solid elements of the blocks with some faces, each by its canonical number and its nodes as [`plane::eight`] has them. Surfaces have
/// no inside.
pub(super) fn solid_elements(body: &Body, layout: &Layout, faces: &[u32]) -> Vec<(u32, [u32; 8])> {
    let of_solids = faces.iter().filter(|&&face| !layout.faces.is_two_sided(face));
    let mut blocks: Vec<u32> = of_solids.map(|&face| layout.faces.block[face as usize]).collect();
    blocks.sort_unstable();
    blocks.dedup();
    let of_blocks = (0u32..).zip(body.element_nodes.iter()).zip(&*body.element_block);
    let of_blocks = of_blocks.filter(|(_, block)| blocks.binary_search(block).is_ok());
    of_blocks.map(|((element, nodes), _)| (element, plane::eight(nodes))).collect()
}

pub(super) fn corners_of(body: &Body, layout: &Layout, face: u32) -> [[f64; 3]; 4] {
    layout.faces.corners[face as usize].map(|corner| body.positions[layout.nodes[corner as usize] as usize])
}

/// For each node one of its body's: elements that share nodes are one body.
pub(super) fn bodies_of(body: &Body) -> Vec<u32> {
    let mut joined = DisjointSets::new(body.positions.len());
    for nodes in body.element_nodes.iter() {
        nodes[1..].iter().for_each(|&node| joined.join(nodes[0], node));
    }
    joined.into_least()
}

/// Distance of a point to the nearest of some faces behind which it is.
pub(super) fn depth(body: &Body, layout: &Layout, faces: impl Iterator<Item = u32>, point: [f64; 3]) -> f64 {
    let behind = |face: u32| {
        let projection = projection::project(&corners_of(body, layout, face), point)?;
        (projection.gap < 0.0 && projection.outside <= -projection.gap)
            .then(|| projection.gap.hypot(projection.outside))
    };
    let nearest = faces.filter_map(behind).fold(f64::INFINITY, f64::min);
    if nearest.is_finite() { nearest } else { 0.0 }
}

/// Whether a point is inside a hexahedron: in one of the tetrahedra that join its middle with the four triangles of each side. The sides of a wedge
/// that have no area make none: their volumes are round-off, which may have either sign, and any point is within them.
pub(super) fn is_inside(corners: &[[f64; 3]; 8], point: [f64; 3]) -> bool {
    let middle = corners.iter().fold([0.0; 3], |sum, corner| add(sum, scaled(*corner, 0.125)));
    let volume = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| dot(a, cross(b, c));
    HEX_SIDES.iter().any(|side| {
        let side = side.map(|corner| subtract(corners[corner], middle));
        let (centre, r) = (projection::centre(&side), subtract(point, middle));
        (0..4).any(|i| {
            let (a, b) = (side[i], side[(i + 1) % 4]);
            let whole = volume(centre, a, b);
            let least = FLAT * [centre, a, b].map(|arm| dot(arm, arm)).iter().product::<f64>().sqrt();
            let parts = [volume(r, a, b), volume(centre, r, b), volume(centre, a, r)].map(|part| part / whole);
            whole > least && parts.iter().all(|part| *part >= 0.0) && parts.iter().sum::<f64>() <= 1.0
        })
    })
}

/// Corners of an element that is seen a little larger than it is, so that a point between two elements is in both.
pub(super) fn seen_larger(corners: &[[f64; 3]; 8]) -> [[f64; 3]; 8] {
    let middle = centroid(corners);
    corners.map(|corner| add(middle, scaled(subtract(corner, middle), 1.0 + LARGER)))
}

/// Inverse masses; none in directions that the deck holds.
fn weigh(mesh: &Mesh, model: &Model, body: &Body, layout: &Layout, motion: &mut NodeMotion) {
    for (point, &node) in layout.nodes.iter().enumerate() {
        motion.inverse_mass[point] = [1.0 / body.node_mass[node as usize]; 3];
        // What is on the axis stays there.
        if model.analysis.about_axis() && body.positions[node as usize][0] == 0.0 {
            motion.inverse_mass[point][0] = 0.0;
        }
    }
    // Those that follow others go where these go.
    for one in &body.tied.followers {
        if let Ok(point) = layout.nodes.binary_search(&one.node) {
            motion.inverse_mass[point] = [0.0; 3];
        }
    }
    // Rigid bodies stay as they are.
    for (inverse, is_rigid) in motion.inverse_mass.iter_mut().zip(of_rigid_bodies(mesh, body, layout)) {
        if is_rigid {
            *inverse = [0.0; 3];
        }
    }
    let still = model.no_displacements.iter().map(|held| (held.node_set, held.direction));
    let driven = model.prescribed_motions.iter().map(|motion| (motion.node_set, motion.direction));
    for (set, direction) in still.chain(driven) {
        for node in mesh.node_set(set).map_or(&[][..], |set| &set.nodes) {
            if let Ok(point) = layout.nodes.binary_search(node) {
                motion.inverse_mass[point][direction.axis()] = 0.0;
            }
        }
    }
}

/// Whether each point is a node of a rigid body.
fn of_rigid_bodies(mesh: &Mesh, body: &Body, layout: &Layout) -> Vec<bool> {
    let mut is_rigid = vec![false; layout.nodes.len()];
    let blocks = mesh.blocks.iter().zip(&body.block_body).filter(|(_, of)| of.is_some());
    for node in blocks.flat_map(|(block, _)| &block.nodes) {
        if let Ok(point) = layout.nodes.binary_search(node) {
            is_rigid[point] = true;
        }
    }
    is_rigid
}

fn moved(before: &[[f64; 3]], body: &Body, layout: &Layout) -> Overlap {
    layout.nodes.iter().fold(Overlap::default(), |sum, &node| {
        let path = subtract(body.positions[node as usize], before[node as usize]);
        let length = dot(path, path).sqrt();
        Overlap { nodes: sum.nodes + usize::from(length > 0.0), farthest: sum.farthest.max(length), ..sum }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::common::vector::normalized;

    /// A wedge, turned in steps, whose side of no area is a line: volumes over it are round-off. Points in the plane of that line and the middle are not in
    /// the wedge; its middle is.
    #[test]
    fn what_is_in_the_plane_of_a_side_without_area_is_not_in_a_wedge() {
        let triangle = [[0.0, 0.0], [0.3, 0.1], [0.2, 0.4], [0.2, 0.4]];
        let axis = normalized([1.0, 2.0, 3.0]).unwrap_or_default();
        for turn in 0..200 {
            let (sine, cosine) = (0.1 * f64::from(turn)).sin_cos();
            let turned = |x: [f64; 3]| {
                let (along, upright) = (scaled(axis, dot(axis, x) * (1.0 - cosine)), scaled(cross(axis, x), sine));
                add(add(scaled(x, cosine), upright), along)
            };
            let corner = |i: usize| [triangle[i % 4][0], triangle[i % 4][1], if i < 4 { 0.0 } else { 0.5 }];
            let wedge: [[f64; 3]; 8] = std::array::from_fn(|i| turned(corner(i)));
            let middle = centroid(&wedge);
            let [down, up] = [2, 6].map(|i| subtract(wedge[i], middle));
            assert!(is_inside(&wedge, middle));
            for (a, b) in [(3.0, 3.0), (5.0, -3.0), (-2.0, 1.0), (1.5, 0.2)] {
                assert!(!is_inside(&wedge, add(middle, add(scaled(down, a), scaled(up, b)))), "{turn}: {a}, {b}");
            }
        }
    }
}
