//! Points of a body at rest that are behind faces, each behind that through which the way out is shortest.

use super::enclosing::Enclosing;
use super::initial_overlap::solid_elements;
use super::node_face;
use super::node_face::{DetectedContact, NO_CONTACT, NodeFaceCheck};
use crate::common::vector::{add, normalized, scaled};
use crate::solver::Body;
use crate::solver::contact::enforcement::constraint::Constraint;
use crate::solver::contact::geometry::motion::NodeMotion;
use crate::solver::contact::nodes::ContactNodes;
use crate::solver::contact::search::SearchKind;
use crate::solver::contact::search::locate::{Candidate, Locator, Rule};
use crate::solver::contact::search::neighbourhood::{self, Boxes};
use crate::solver::contact::surface::layout::Layout;
use crate::solver::contact::surface::pairings::{Pairing, Pairings};

/// Overlap below this part of a face's size is round-off of the mesh's coordinates.
pub const NOTHING: f64 = 1e-9;

/// So is what is below this part of the coordinates themselves: that of faces which are small where they are. Positions come out of
/// several roundings.
const OF_COORDINATES: f64 = 16.0 * f64::EPSILON;

/// A point behind a face that faces it, or nearer to it than they touch.
#[derive(Debug, Clone, Copy)]
pub struct Behind {
    pub point: u32,
    pub contact: DetectedContact,
    pub pairing: Pairing,
    /// Whether the point is beside the face, and not over a bend beyond its border.
    pub beside: bool,
}

/// Of what is behind a face by no more than this part of its size elements are not asked, and so far into its own body a point is moved for that.
const SHALLOW: f64 = 0.01;

/// Constraints of all points of a body at rest that are behind faces that face them, as far as elements say so, too.
pub fn overlaps(body: &Body, layout: &Layout, pairings: &Pairings, motion: &NodeMotion) -> Vec<Constraint> {
    let mut behind = behind(layout, pairings, motion);
    leave_out_touching(&mut behind, (body, layout), motion);
    let constraint =
        |Behind { point, contact, pairing, .. }: Behind| node_face::constraint(&layout.faces, pairing, point, &contact);
    behind.into_iter().filter_map(constraint).collect()
}

/// Leaves out what is clearly behind a face and in no element of another body: which faces hold a point is a matter of many rules, and no node is
/// moved by part of an element on their word alone. A point of a surface is looked for a little into its own body, where that does not overlap
/// another one: a point at an edge of that would be in its elements but for round-off.
fn leave_out_touching(behind: &mut Vec<Behind>, (body, layout): (&Body, &Layout), motion: &NodeMotion) {
    let part = |of: &Behind| -of.contact.projection.gap / layout.faces.size[of.contact.face as usize];
    let mut places = vec![None; layout.nodes.len()];
    for of in behind.iter().filter(|of| part(of) > SHALLOW) {
        let at = motion.start(of.point);
        let inwards = normalized(layout.faces.point_normal(of.point, motion)).unwrap_or_default();
        let size = layout.faces.size[of.contact.face as usize];
        places[of.point as usize] = Some(add(at, scaled(inwards, -0.5 * SHALLOW * size)));
    }
    if places.iter().all(Option::is_none) {
        return;
    }
    let mut faces: Vec<u32> = layout.interfaces.iter().flat_map(|interface| &interface.faces).copied().collect();
    faces.sort_unstable();
    let enclosing = Enclosing::new(body, layout, solid_elements(body, layout, &faces), places);
    behind.retain(|of| part(of) <= SHALLOW || enclosing.of(of.point as usize).next().is_some());
}

/// Every point behind a face that faces it, or nearer to it than they touch, points ascending.
pub fn behind(layout: &Layout, pairings: &Pairings, motion: &NodeMotion) -> Vec<Behind> {
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
        let check =
            NodeFaceCheck { motion: &motion, faces, rules: &strict, longest_path, edges_hold, have_friction: false };
        check.point(point, &near, &NO_CONTACT, &mut contacts);
        if !contacts.is_empty() && check.leave_nearest_ways_out(point, &mut near, |face| nothing(layout, &motion, face))
        {
            check.point(point, &near, &NO_CONTACT, &mut contacts);
        }
        for contact in &mut contacts {
            contact.tolerated = 0.0;
            let (at, end) = ((point, contact.face), &contact.projection);
            let beside = end.rounded && !check.is_over_bend(at, &near, end);
            let Some(near) = near.iter().find(|near| near.face == contact.face) else { continue };
            let rule = layout.interfaces[near.interface as usize].rule;
            let face = layout.faces.block[contact.face as usize];
            let pairing = pairings.of(rule, layout.point_block[point as usize], face);
            if contact.projection.gap < -nothing(layout, &motion, contact.face) {
                found.push(Behind { point, contact: *contact, pairing, beside });
            }
        }
    }
    found
}

/// Overlap with a face that is no more than round-off, a length.
fn nothing(layout: &Layout, motion: &NodeMotion, face: u32) -> f64 {
    let corners = layout.faces.corners[face as usize].map(|corner| motion.start(corner));
    let farthest = corners.as_flattened().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    (NOTHING * layout.faces.size[face as usize]).max(OF_COORDINATES * farthest)
}
