//! Overlaps that the mesh begins with: taken out by moving nodes before the run, which gives nobody a velocity.

use super::node_face;
use super::node_face::{DetectedContact, NO_CONTACT, NodeFaceCheck};
use super::overlap::{Crowded, DeepOverlap, Overlap, Squeezed, Stuck};
use crate::common::disjoint_sets::DisjointSets;
use crate::common::vector::{add, cross, dot, scaled, subtract};
use crate::mesh::{HEX_SIDES, Mesh, plane};
use crate::model::{ContactOverlap, Model};
use crate::solver::Body;
use crate::solver::constraints::StepTimes;
use crate::solver::contact::enforcement::accounts::ledger::Ledger;
use crate::solver::contact::enforcement::constraint::Constraint;
use crate::solver::contact::enforcement::enforcer::Enforcer;
use crate::solver::contact::enforcement::iterations::Limits;
use crate::solver::contact::enforcement::other_ranks::NoOtherRanks;
use crate::solver::contact::geometry::motion::NodeMotion;
use crate::solver::contact::geometry::projection;
use crate::solver::contact::nodes::ContactNodes;
use crate::solver::contact::search::locate::{Candidate, Interface, Locator, Rule};
use crate::solver::contact::search::neighbourhood::{self, Boxes};
use crate::solver::contact::search::{Box3, Candidates, SearchKind};
use crate::solver::contact::surface::layout::{ABSENT, Layout};
use crate::solver::contact::surface::pairings::{Pairing, Pairings};
use crate::solver::contact::surface::skin::Skin;
use crate::solver::elements::Touch;
use std::collections::BTreeMap;

/// Overlap below this part of a face's size is round-off of the mesh's coordinates.
const NOTHING: f64 = 1e-9;

/// An overlap that is left after all rounds and is less than this part of a face's size does not matter: contact keeps it as
/// it is.
const STUCK: f64 = 1e-4;

/// A point nearer to an outer face than this part of half the element touches it, once what overlaps has been moved out.
const CLEARLY: f64 = 0.01;

/// The same where overlaps stay: contact knows points as deep as half the element.
const KNOWN: f64 = 1.0;

/// Nodes of an element that have come as near to each other as this part of their distance before are at the same place.
const TOGETHER: f64 = 1e-3;

/// Of so many nodes that are left inside elements the depth is measured.
const MEASURED: usize = 1000;

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
fn stand_still(motion: &mut NodeMotion, body: &Body, layout: &Layout) {
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
    for (point, contact, _) in behind(layout, &Pairings::new(mesh, model, body), &motion) {
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
            if contact.projection.rounded {
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
    match model.contact.control.overlap {
        ContactOverlap::Keep => return Overlap { rigid: Stuck::default(), ..kept(mesh, model, body, &layout) },
        ContactOverlap::Stress(_) => return kept(mesh, model, body, &layout),
        ContactOverlap::Refuse | ContactOverlap::Remove => (),
    }
    let pairings = Pairings::new(mesh, model, body);
    let mut motion = NodeMotion::new(layout.nodes.len(), layout.origin);
    weigh(mesh, model, body, &layout, &mut motion);
    let still = StepTimes { time: 0.0, kick: 1.0, drift: 1.0 };
    let mut enforcer = Enforcer::new(motion.len());
    // Joints have moved what follows already.
    let before = body.positions.clone();
    // The deepest overlap that each point takes part in: no farther is it moved.
    let mut farthest = vec![0.0; motion.len()];
    let mut stuck = Stuck::default();
    for round in 0..=ROUNDS {
        stand_still(&mut motion, body, &layout);
        let mut constraints = overlaps(&layout, &pairings, &motion);
        stuck = Stuck::of(&constraints, &layout);
        if constraints.is_empty() || round == ROUNDS {
            break;
        }
        for c in &constraints {
            c.parts().for_each(|(point, _)| farthest[point] = f64::max(farthest[point], -c.gap));
        }
        let limits = Limits { iterations: 100, unsettled: 100, tolerance: 0.1 * NOTHING };
        enforcer.prepare(&mut constraints, &motion, still.drift, &Ledger::Unlimited);
        enforcer.solve(&mut constraints, &motion, &still, limits, (Ledger::Unlimited, &mut NoOtherRanks));
        let positions: &mut Vec<[f64; 3]> = &mut body.positions;
        for (point, _) in constraints.iter().flat_map(|constraint| constraint.parts()) {
            let node = layout.nodes[point] as usize;
            let there = add(motion.start(point as u32), enforcer.velocity_change(point, &motion, still.kick));
            positions[node] = within(there, before[node], farthest[point]);
        }
    }
    let (deep, squeezed) = (deep_overlap(body, &layout, CLEARLY), squeezed(&before, body));
    Overlap { deep, stuck, squeezed, ..moved(&before, body, &layout) }
}

/// Overlaps that stay where they are, those of rigid bodies with each other once more.
fn kept(mesh: &Mesh, model: &Model, body: &Body, layout: &Layout) -> Overlap {
    let mut motion = NodeMotion::new(layout.nodes.len(), layout.origin);
    stand_still(&mut motion, body, layout);
    let mut constraints = overlaps(layout, &Pairings::new(mesh, model, body), &motion);
    let kept = Stuck::of(&constraints, layout);
    let is_rigid = of_rigid_bodies(mesh, body, layout);
    constraints.retain(|c| c.parts().all(|(point, _)| is_rigid[point]));
    Overlap {
        deep: deep_overlap(body, layout, KNOWN),
        kept,
        rigid: Stuck::of(&constraints, layout),
        ..Default::default()
    }
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

/// Nodes of the surface that CONTACT MATERIAL lets touch and that are inside elements of its blocks, deeper than this part of half
/// the element.
fn deep_overlap(body: &Body, layout: &Layout, part: f64) -> DeepOverlap {
    let Some(automatic) = layout.automatic() else { return DeepOverlap::default() };
    let elements = solid_elements(body, layout, automatic);
    let corners = |place: u32| plane::solid(&body.corners(&elements[place as usize].1));
    let boxes: Vec<Box3> = (0..elements.len() as u32).map(|place| Box3::around(&corners(place))).collect();
    let at = |point: usize| body.positions[layout.nodes[point] as usize];
    let one = |point: usize| if automatic.points[point] { Box3::around(&[at(point)]) } else { Box3::empty() };
    let points: Vec<Box3> = (0..layout.nodes.len()).map(one).collect();
    let mut candidates = Candidates::default();
    SearchKind::Grid.make().find(&points, &boxes, &vec![[u32::MAX; 4]; boxes.len()], &mut candidates);
    let mut motion = NodeMotion::new(layout.nodes.len(), layout.origin);
    stand_still(&mut motion, body, layout);
    let mut deep = DeepOverlap::default();
    let mut bodies: Option<Vec<u32>> = None;
    for (point, &node) in layout.nodes.iter().enumerate() {
        let holds = |&place: &u32| !elements[place as usize].1.contains(&node) && is_inside(&corners(place), at(point));
        let held = candidates.of(point).iter().copied().filter(holds);
        let held: Vec<u32> = held.map(|place| elements[place as usize].0).collect();
        let apart = |element: &u32| {
            let face = (6 * element..6 * element + 6).map(|number| layout.face(number)).find(|&face| face != ABSENT);
            let block = layout.point_block[point];
            face.is_some_and(|face| layout.exclusions.keep_apart(point as u32, block, face, &layout.faces))
        };
        let held: Vec<u32> = held.into_iter().filter(|element| !apart(element)).collect();
        let is_known = |&element: &u32| touches_a_side(body, layout, element, (point as u32, &motion), part);
        let on_the_side = held.iter().any(is_known);
        let Some(&element) = held.first().filter(|_| !on_the_side) else { continue };
        deep.nodes += 1;
        // A great number says enough: the depth of those that come first.
        if deep.nodes <= MEASURED {
            let bodies = bodies.get_or_insert_with(|| bodies_of(body));
            let inside = bodies[body.element_nodes[element as usize][0] as usize];
            let of_body = |face: u32| {
                let corner = layout.faces.corners[face as usize][0];
                bodies[layout.nodes[corner as usize] as usize] == inside
            };
            let faces = automatic.faces.iter().copied().filter(|&face| of_body(face));
            let depth = depth(body, layout, faces, at(point));
            if depth > deep.deepest {
                deep = DeepOverlap { deepest: depth, node, element: body.element_order[element as usize], ..deep };
            }
        }
    }
    deep
}

/// Solid elements of the blocks with faces of an interface, each by its canonical number and its nodes as [`plane::eight`] has
/// them. Surfaces have no inside.
fn solid_elements(body: &Body, layout: &Layout, interface: &Interface) -> Vec<(u32, [u32; 8])> {
    let of_solids = interface.faces.iter().filter(|&&face| !layout.faces.is_two_sided(face));
    let mut blocks: Vec<u32> = of_solids.map(|&face| layout.faces.block[face as usize]).collect();
    blocks.sort_unstable();
    blocks.dedup();
    let of_blocks = (0u32..).zip(body.element_nodes.iter()).zip(&*body.element_block);
    let of_blocks = of_blocks.filter(|(_, block)| blocks.binary_search(block).is_ok());
    of_blocks.map(|((element, nodes), _)| (element, plane::eight(nodes))).collect()
}

/// Whether a point in an element is no deeper below one of its outer faces than this part of half the element. Contact knows what is below a
/// face only where the point's body looks at it: what is inside another body looks at faces on its far side.
fn touches_a_side(body: &Body, layout: &Layout, element: u32, (point, motion): (u32, &NodeMotion), part: f64) -> bool {
    let faces = (6 * element..6 * element + 6).map(|number| layout.face(number)).filter(|&face| face != ABSENT);
    let outwards = layout.faces.point_normal(point, motion);
    let length = dot(outwards, outwards).sqrt();
    let is_known = |face: u32| {
        let (depth, projection) = (
            layout.faces.depth[face as usize],
            projection::project(&corners_of(body, layout, face), motion.start(point)),
        );
        projection.is_some_and(|projection| {
            // A node without faces of its own looks everywhere.
            let looks = length == 0.0 || dot(outwards, projection.normal) < node_face::FACING * length;
            projection.gap > -CLEARLY * depth || (looks && projection.gap > -part * depth)
        })
    };
    faces.into_iter().any(is_known)
}

fn corners_of(body: &Body, layout: &Layout, face: u32) -> [[f64; 3]; 4] {
    layout.faces.corners[face as usize].map(|corner| body.positions[layout.nodes[corner as usize] as usize])
}

/// For each node one of its body's: elements that share nodes are one body.
fn bodies_of(body: &Body) -> Vec<u32> {
    let mut joined = DisjointSets::new(body.positions.len());
    for nodes in body.element_nodes.iter() {
        nodes[1..].iter().for_each(|&node| joined.join(nodes[0], node));
    }
    joined.into_least()
}

/// Distance of a point to the nearest of some faces behind which it is.
fn depth(body: &Body, layout: &Layout, faces: impl Iterator<Item = u32>, point: [f64; 3]) -> f64 {
    let behind = |face: u32| {
        let projection = projection::project(&corners_of(body, layout, face), point)?;
        (projection.gap < 0.0 && projection.outside <= -projection.gap)
            .then(|| projection.gap.hypot(projection.outside))
    };
    let nearest = faces.filter_map(behind).fold(f64::INFINITY, f64::min);
    if nearest.is_finite() { nearest } else { 0.0 }
}

/// Whether a point is inside a hexahedron: in one of the tetrahedra that join its middle with the four triangles of each side.
pub(super) fn is_inside(corners: &[[f64; 3]; 8], point: [f64; 3]) -> bool {
    let middle = corners.iter().fold([0.0; 3], |sum, corner| add(sum, scaled(*corner, 0.125)));
    let volume = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| dot(a, cross(b, c));
    HEX_SIDES.iter().any(|side| {
        let side = side.map(|corner| subtract(corners[corner], middle));
        let (centre, r) = (projection::centre(&side), subtract(point, middle));
        (0..4).any(|i| {
            let (a, b) = (side[i], side[(i + 1) % 4]);
            let whole = volume(centre, a, b);
            let parts = [volume(r, a, b), volume(centre, r, b), volume(centre, a, r)].map(|part| part / whole);
            whole > 0.0 && parts.iter().all(|part| *part >= 0.0) && parts.iter().sum::<f64>() <= 1.0
        })
    })
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

/// Constraints of all points behind faces that face them.
fn overlaps(layout: &Layout, pairings: &Pairings, motion: &NodeMotion) -> Vec<Constraint> {
    let behind = behind(layout, pairings, motion).into_iter();
    let constraint = |(point, contact, pairing): (u32, DetectedContact, Pairing)| {
        node_face::constraint(&layout.faces, pairing, point, &contact)
    };
    behind.filter_map(constraint).collect()
}

/// Every point behind a face that faces it, or nearer to it than they touch, points ascending.
fn behind(layout: &Layout, pairings: &Pairings, motion: &NodeMotion) -> Vec<(u32, DetectedContact, Pairing)> {
    let contact_nodes = ContactNodes::still(motion);
    let all = neighbourhood::point_boxes(layout, &contact_nodes);
    let boxes = neighbourhood::face_boxes(layout, &contact_nodes);
    let mut search = SearchKind::Grid.make();
    let found = neighbourhood::find(&mut *search, [&all, &boxes, &Boxes::default()], |_| true, layout);
    let mut locator = Locator::new(found, 1.0, motion.len(), &layout.faces, &layout.edges);
    let mut motion = contact_nodes.motion;
    locator.step(&motion, &layout.faces);
    let longest_path = locator.longest_path();
    let (mut contacts, mut found) = (Vec::new(), Vec::new());
    // Whatever their interface, only points that look at a face can be behind it.
    let strict = vec![Rule::Blocks; layout.interfaces.len()];
    let mut near: Vec<Candidate> = Vec::new();
    for i in 0..locator.slave_nodes().len() {
        let point = locator.slave_nodes()[i];
        locator.locate(i, &mut motion, &layout.faces, &NO_CONTACT, &mut near);
        // Nothing comes through anything, so that edges need not be asked.
        let (faces, edges_hold) = (&*layout.faces, false);
        let check = NodeFaceCheck { motion: &motion, faces, rules: &strict, longest_path, edges_hold };
        check.point(point, &near, &NO_CONTACT, &mut contacts);
        for contact in &mut contacts {
            contact.tolerated = 0.0;
            let size = layout.faces.size[contact.face as usize];
            let Some(near) = near.iter().find(|near| near.face == contact.face) else { continue };
            let rule = layout.interfaces[near.interface as usize].rule;
            let face = layout.faces.block[contact.face as usize];
            let pairing = pairings.of(rule, layout.point_block[point as usize], face);
            if contact.projection.gap < -NOTHING * size {
                found.push((point, *contact, pairing));
            }
        }
    }
    found
}

fn moved(before: &[[f64; 3]], body: &Body, layout: &Layout) -> Overlap {
    layout.nodes.iter().fold(Overlap::default(), |sum, &node| {
        let path = subtract(body.positions[node as usize], before[node as usize]);
        let length = dot(path, path).sqrt();
        Overlap { nodes: sum.nodes + usize::from(length > 0.0), farthest: sum.farthest.max(length), ..sum }
    })
}
