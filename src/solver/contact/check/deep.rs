//! Nodes that begin inside elements and that contact does not know to be there: too deep below the faces at which they look.

use super::enclosing::Enclosing;
use super::initial_overlap::{bodies_of, corners_of, depth, solid_elements, stand_still};
use super::node_face;
use super::overlap::DeepOverlap;
use crate::solver::Body;
use crate::solver::contact::geometry::motion::NodeMotion;
use crate::solver::contact::geometry::projection;
use crate::solver::contact::search::locate::Interface;
use crate::solver::contact::surface::layout::{ABSENT, Layout};
use std::collections::BTreeSet;

/// A point nearer to an outer face than this part of half the element touches it, whichever way it looks.
pub const CLEARLY: f64 = 0.01;

/// Of so many nodes that are left inside elements the depth is measured.
const MEASURED: usize = 1000;

/// A point inside an element that is not its own.
#[derive(Debug, Clone, Copy)]
pub struct Inside {
    pub point: u32,
    /// The element, by its number in canonical order.
    pub element: u32,
    /// Whether a face is near behind which it does not look.
    pub faces_away: bool,
}

/// What an element says of a point in it; what knows more is greater.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    /// No outer face is near.
    Deep,
    /// Its body looks away from those that are.
    FacesAway,
    /// It touches one, or its body stands upright on it, which is held by others of its nodes.
    Beside,
    /// Contact knows it to be there.
    Known,
}

/// Points of the surface that CONTACT MATERIAL lets touch and that are inside elements of its blocks, deeper than this part of half
/// the element below every face at which they look.
pub fn deep_points(body: &Body, layout: &Layout, automatic: &Interface, part: f64) -> Vec<Inside> {
    let elements = solid_elements(body, layout, &automatic.faces);
    let at = |(&node, takes_part): (&u32, &bool)| takes_part.then(|| body.positions[node as usize]);
    let places = layout.nodes.iter().zip(automatic.points.iter()).map(at).collect();
    let enclosing = Enclosing::new(body, layout, elements, places);
    let mut motion: Option<NodeMotion> = None;
    let (mut deep, mut known) = (Vec::new(), Vec::new());
    for (point, &node) in layout.nodes.iter().enumerate() {
        let apart = |element: &u32| {
            let face = (6 * element..6 * element + 6).map(|number| layout.face(number)).find(|&face| face != ABSENT);
            let block = layout.point_block[point];
            face.is_some_and(|face| layout.exclusions.keep_apart(point as u32, block, face, &layout.faces))
                || is_joined(body, layout, point as u32, *element)
        };
        let held: Vec<u32> = enclosing.of(point).filter(|element| !apart(element)).collect();
        let Some(&element) = held.first() else { continue };
        let motion = motion.get_or_insert_with(|| at_rest(body, layout));
        let place = |&element: &u32| (place(body, layout, element, (point as u32, motion), part), element);
        match held.iter().map(place).max_by_key(|(place, _)| *place) {
            Some((Place::Known, of)) => known.push([node, body.element_nodes[of as usize][0]]),
            Some((Place::Beside, _)) => (),
            nearest => {
                let faces_away = nearest.is_some_and(|(place, _)| place == Place::FacesAway);
                deep.push(Inside { point: point as u32, element, faces_away });
            }
        }
    }
    leave_out_held(body, layout, &mut deep, &known);
    deep
}

/// Leaves out what looks away from the faces of a body with which contact knows an overlap, by two nodes of each that is known: what
/// is held elsewhere is held with its body.
fn leave_out_held(body: &Body, layout: &Layout, deep: &mut Vec<Inside>, known: &[[u32; 2]]) {
    if known.is_empty() || !deep.iter().any(|inside| inside.faces_away) {
        return;
    }
    let bodies = bodies_of(body);
    let pair = |nodes: [u32; 2]| {
        let [a, b] = nodes.map(|node| bodies[node as usize]);
        [a.min(b), a.max(b)]
    };
    let known: BTreeSet<[u32; 2]> = known.iter().map(|&nodes| pair(nodes)).collect();
    let nodes = |inside: &Inside| [layout.nodes[inside.point as usize], body.element_nodes[inside.element as usize][0]];
    deep.retain(|inside| !(inside.faces_away && known.contains(&pair(nodes(inside)))));
}

/// Whether TIED CONTACT joins a point with a node of an element: what follows a curved surface is in it by what faces of both meshes differ.
fn is_joined(body: &Body, layout: &Layout, point: u32, element: u32) -> bool {
    let nodes = body.element_nodes[element as usize].iter().map(|&node| layout.point(node));
    let corners: Vec<u32> = nodes.filter(|&corner| corner != ABSENT).collect();
    layout.are_joined(point, &corners)
}

fn at_rest(body: &Body, layout: &Layout) -> NodeMotion {
    let mut motion = NodeMotion::new(layout.nodes.len(), layout.origin);
    stand_still(&mut motion, body, layout);
    motion
}

/// Where a point in an element is below its outer faces. Contact knows what is no deeper than half the element below a face only where
/// the point's body looks at it: what has come nearly through another body looks at faces on its far side.
fn place(body: &Body, layout: &Layout, element: u32, (point, motion): (u32, &NodeMotion), part: f64) -> Place {
    let faces = (6 * element..6 * element + 6).map(|number| layout.face(number)).filter(|&face| face != ABSENT);
    let at = body.positions[layout.nodes[point as usize] as usize];
    let below = |face: u32| {
        let Some(projection) = projection::project(&corners_of(body, layout, face), at) else { return Place::Deep };
        let depth = -projection.gap / layout.faces.depth[face as usize];
        if depth < CLEARLY {
            return Place::Beside;
        }
        let opposition = node_face::opposition(&layout.faces, motion, point, &projection);
        match depth < part {
            false => Place::Deep,
            true if opposition < node_face::FACING => Place::Known,
            true if opposition > -node_face::FACING => Place::FacesAway,
            true => Place::Beside,
        }
    };
    faces.into_iter().map(below).max().unwrap_or(Place::Deep)
}

/// How many such points there are, and the deepest.
pub fn measured(body: &Body, layout: &Layout, automatic: &Interface, points: &[Inside]) -> DeepOverlap {
    let faces_away = points.iter().filter(|inside| inside.faces_away).count();
    let mut deep = DeepOverlap { nodes: points.len(), faces_away, ..DeepOverlap::default() };
    if points.is_empty() {
        return deep;
    }
    let bodies = bodies_of(body);
    let body_of = |face: u32| bodies[layout.nodes[layout.faces.corners[face as usize][0] as usize] as usize];
    // A great number says enough: the depth of those that come first.
    for &Inside { point, element, .. } in points.iter().take(MEASURED) {
        let inside = bodies[body.element_nodes[element as usize][0] as usize];
        let node = layout.nodes[point as usize];
        let faces = automatic.faces.iter().copied().filter(|&face| body_of(face) == inside);
        let depth = depth(body, layout, faces, body.positions[node as usize]);
        if depth > deep.deepest {
            deep = DeepOverlap { deepest: depth, node, element: body.element_order[element as usize], ..deep };
        }
    }
    deep
}
