//! Overlaps that the mesh begins with: taken out by moving nodes before the run, which gives nobody a velocity.

use super::behind::{NOTHING, behind, overlaps};
use super::body_pairs::BodyPairs;
use super::engulfed::engulfed;
use super::pierced::pierced;
use super::unheld::{ADVICE_ON_EDGES, ADVICE_ON_ELEMENTS, Told, Unheld};
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
use crate::solver::contact::search::locate::Interface;
use crate::solver::contact::search::{Box3, Candidates, SearchKind};
use crate::solver::contact::surface::layout::{ABSENT, Layout};
use crate::solver::contact::surface::pairings::Pairings;
use crate::solver::contact::surface::skin::Skin;
use crate::solver::elements::Touch;
use std::collections::BTreeMap;

/// An overlap that is left after all rounds and is less than this part of a face's size does not matter: contact keeps it as
/// it is.
pub(super) const STUCK: f64 = 1e-4;

/// A point nearer to an outer face than this part of half the element touches it, once what overlaps has been moved out.
const CLEARLY: f64 = 0.01;

/// The same where overlaps stay: contact knows points as deep as half the element.
const KNOWN: f64 = 1.0;

/// Of so many nodes that are left inside elements the depth is measured.
const MEASURED: usize = 1000;

/// Rounds of finding overlaps and moving nodes: what moves may overlap elsewhere.
const ROUNDS: usize = 10;

/// What was moved, and what was not.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Overlap {
    /// Number of nodes moved.
    pub nodes: usize,
    /// Farthest move, a length.
    pub farthest: f64,
    /// What is left deep inside.
    pub deep: DeepOverlap,
    /// What could not be moved out, though it is not deep.
    pub stuck: Stuck,
    /// What is to be pushed apart through strain between rigid bodies, which have none.
    pub rigid: Stuck,
    /// Where the mesh leaves less room than thicknesses.
    pub crowded: Crowded,
    /// Edges that go through faces where no node is inside.
    pub pierced: Unheld,
    /// Elements inside other bodies of which no node says so.
    pub engulfed: Unheld,
}

/// Nodes that begin nearer to faces than their thicknesses allow. Contact holds them as near as they are, and farther once they
/// have been farther.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Crowded {
    /// Their number.
    pub nodes: usize,
    /// The least room, as a part of the distance at which they would touch.
    pub least: f64,
    /// The node with the least room, from 0 in the mesh file.
    pub node: u32,
}

impl Crowded {
    /// Tells the user, where there are any.
    pub fn note(&self, mesh: &Mesh) -> Option<String> {
        let Crowded { nodes, least, node } = *self;
        let [x, y, z] = mesh.coordinates.get(node as usize)?;
        (nodes > 0).then(|| {
            format!(
                "note: {nodes} nodes begin nearer to shells or bars than their thickness allows; contact uses what room there is, \
                 at least {:.1} % of it: node {} at {x:.4e} {y:.4e} {z:.4e}",
                100.0 * least,
                mesh.node_ids[node as usize]
            )
        })
    }
}

/// Overlaps that moving nodes cannot remove, because the deck holds them or others are in the way.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stuck {
    /// Number of nodes behind faces.
    pub nodes: usize,
    /// The deepest, a length.
    pub deepest: f64,
    /// Its node, from 0 in the mesh file.
    pub node: u32,
}

impl Overlap {
    /// Why a mesh whose overlaps must go is refused; `None` where all are gone.
    pub fn refusal(&self, mesh: &Mesh) -> Option<String> {
        if let Some(refusal) = self.refusal_of_unheld(mesh).filter(|_| self.deep.nodes == 0) {
            return Some(refusal);
        }
        let Overlap { deep, stuck, rigid, .. } = *self;
        let ((count, deepest, node), why) = if deep.nodes > 0 {
            ((deep.nodes, deep.deepest, deep.node), "deeper than half an element")
        } else if rigid.nodes > 0 {
            ((rigid.nodes, rigid.deepest, rigid.node), "between rigid bodies, which no stress deforms")
        } else {
            ((stuck.nodes, stuck.deepest, stuck.node), "held by the deck or between others")
        };
        let [x, y, z] = mesh.coordinates.get(node as usize)?;
        (count > 0).then(|| {
            format!(
                "error: bodies overlap in the mesh, and {count} nodes cannot be moved out, being {why}: the deepest is node {} at \
                 {x:.4e} {y:.4e} {z:.4e}, {deepest:.4e} below the surface\n\
                 help: mend the mesh, or say CONTACT OVERLAP, REMOVE or KEEP in the deck to run with what is left",
                mesh.node_ids[node as usize]
            )
        })
    }

    /// Why a mesh is refused whose overlaps contact does not see: always where elements are inside others, else where they must go.
    fn refusal_of_unheld(&self, mesh: &Mesh) -> Option<String> {
        let [edges, elements] = self.unheld(mesh);
        let told = elements.or(edges.filter(|_| self.pierced.must_go))?;
        Some(format!("error: bodies overlap in the mesh: {told}"))
    }

    /// Warnings of the overlaps that contact does not see.
    pub fn warnings_of_unheld(&self, mesh: &Mesh) -> Vec<String> {
        self.unheld(mesh).into_iter().flatten().map(|told| format!("warning: {told}")).collect()
    }

    /// What is said of edges through faces and of elements inside bodies, with what to try.
    fn unheld(&self, mesh: &Mesh) -> [Option<String>; 2] {
        let edges = Told::of(&self.pierced, mesh).map(|told| (told.edges_in_words(), ADVICE_ON_EDGES));
        let elements = Told::of(&self.engulfed, mesh).map(|told| (told.elements_in_words(), ADVICE_ON_ELEMENTS));
        [edges, elements].map(|told| told.map(|(words, advice)| format!("{words}\nhelp: {advice}")))
    }
}

/// Nodes that remain inside elements that are not theirs: too deep to say which way is out. Contact does not see them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DeepOverlap {
    /// Their number.
    pub nodes: usize,
    /// Distance of the deepest from the nearest face of the outside, a length.
    pub deepest: f64,
    /// The deepest, from 0 in the mesh file.
    pub node: u32,
    /// The element in which it is, from 0 in the mesh file.
    pub element: u32,
}

impl DeepOverlap {
    /// Tells the user, where there are any.
    pub fn warning(&self, mesh: &Mesh) -> Option<String> {
        let DeepOverlap { nodes, deepest, node, element } = *self;
        let [x, y, z] = mesh.coordinates.get(node as usize)?;
        (nodes > 0).then(|| {
            format!(
                "warning: {nodes} nodes of contact surfaces begin deep inside other elements and are not held by contact there, \
                 the deepest {deepest:.4e} below the surface: node {} at {x:.4e} {y:.4e} {z:.4e} in element {}",
                mesh.node_ids[node as usize], mesh.element_ids[element as usize]
            )
        })
    }
}

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
    let overlap = remove_known(mesh, model, body, &layout);
    let Some(automatic) = layout.automatic() else { return overlap };
    let Some(pairs) = BodyPairs::of(body, &layout, automatic) else { return overlap };
    let must_go = matches!(model.contact.control.overlap, ContactOverlap::Stress(_));
    let (given, surface) = ((mesh, model), (&*body, &layout, automatic));
    let pierced = Unheld { must_go, ..pierced(given, surface, &pairs) };
    // What is told by its nodes is told.
    let engulfed = if overlap.deep.nodes > 0 { Unheld::default() } else { engulfed(given, surface, &pairs) };
    Overlap { pierced, engulfed, ..overlap }
}

/// Moves nodes out of the faces behind which contact knows them to be.
fn remove_known(mesh: &Mesh, model: &Model, body: &mut Body, layout: &Layout) -> Overlap {
    let left = || Overlap { deep: deep_overlap(body, layout, KNOWN), ..Default::default() };
    match model.contact.control.overlap {
        ContactOverlap::Keep => return left(),
        ContactOverlap::Stress(_) => {
            return Overlap { rigid: between_rigid_bodies(mesh, model, body, layout), ..left() };
        }
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
        let mut constraints = overlaps(layout, &pairings, &motion);
        stuck = Stuck::of(&constraints, layout);
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
    Overlap { deep: deep_overlap(body, layout, CLEARLY), stuck, ..moved(&before, body, layout) }
}

/// Overlaps of rigid bodies with each other.
fn between_rigid_bodies(mesh: &Mesh, model: &Model, body: &Body, layout: &Layout) -> Stuck {
    if body.block_body.iter().all(Option::is_none) {
        return Stuck::default();
    }
    let mut motion = NodeMotion::new(layout.nodes.len(), layout.origin);
    stand_still(&mut motion, body, layout);
    let mut constraints = overlaps(layout, &Pairings::new(mesh, model, body), &motion);
    let is_rigid = of_rigid_bodies(mesh, body, layout);
    constraints.retain(|c| c.parts().all(|(point, _)| is_rigid[point]));
    Stuck::of(&constraints, layout)
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
        let on_the_side = held.iter().any(|&element| touches_a_side(body, layout, element, (at(point), part)));
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
pub(super) fn solid_elements(body: &Body, layout: &Layout, interface: &Interface) -> Vec<(u32, [u32; 8])> {
    let of_solids = interface.faces.iter().filter(|&&face| !layout.faces.is_two_sided(face));
    let mut blocks: Vec<u32> = of_solids.map(|&face| layout.faces.block[face as usize]).collect();
    blocks.sort_unstable();
    blocks.dedup();
    let of_blocks = (0u32..).zip(body.element_nodes.iter()).zip(&*body.element_block);
    let of_blocks = of_blocks.filter(|(_, block)| blocks.binary_search(block).is_ok());
    of_blocks.map(|((element, nodes), _)| (element, plane::eight(nodes))).collect()
}

/// Whether a point in an element is no deeper below one of its outer faces than this part of half the element.
fn touches_a_side(body: &Body, layout: &Layout, element: u32, (point, part): ([f64; 3], f64)) -> bool {
    let faces = (6 * element..6 * element + 6).map(|number| layout.face(number)).filter(|&face| face != ABSENT);
    let gap = |face: u32| {
        projection::project(&corners_of(body, layout, face), point)
            .map_or(f64::NEG_INFINITY, |projection| projection.gap)
    };
    faces.into_iter().any(|face| gap(face) > -part * layout.faces.depth[face as usize])
}

fn corners_of(body: &Body, layout: &Layout, face: u32) -> [[f64; 3]; 4] {
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

fn moved(before: &[[f64; 3]], body: &Body, layout: &Layout) -> Overlap {
    layout.nodes.iter().fold(Overlap::default(), |sum, &node| {
        let path = subtract(body.positions[node as usize], before[node as usize]);
        let length = dot(path, path).sqrt();
        Overlap { nodes: sum.nodes + usize::from(length > 0.0), farthest: sum.farthest.max(length), ..sum }
    })
}
