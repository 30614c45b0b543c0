//! Which bodies may overlap in the mesh, and where: in what the boxes around two of them have in common.

use super::behind::{Behind, behind};
use super::initial_overlap::{STUCK, bodies_of, stand_still};
use crate::mesh::Mesh;
use crate::model::Model;
use crate::solver::Body;
use crate::solver::contact::geometry::motion::NodeMotion;
use crate::solver::contact::search::locate::Interface;
use crate::solver::contact::search::{Box3, Candidates, SearchKind};
use crate::solver::contact::surface::layout::Layout;
use crate::solver::contact::surface::pairings::Pairings;
use std::collections::BTreeMap;

/// Bodies are what shares nodes. Bricks that lie upon each other have no room in common, nor have a body and the air around it, so
/// that what is looked for within the rooms of pairs costs where bodies may overlap only.
pub struct BodyPairs {
    /// For each node of the mesh one of its body's.
    of_node: Vec<u32>,
    /// Rooms that each body has in common with others.
    rooms: BTreeMap<u32, Vec<Box3>>,
}

/// A point that contact knows to be behind a face of another body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    /// The point.
    pub point: u32,
    /// The body of the face.
    pub other: u32,
    /// How deep it is behind the face, a length.
    pub depth: f64,
}

/// What contact sees of a body.
#[derive(Debug, Clone, Copy)]
struct Extent {
    around: Box3,
    /// Size of its smallest face, a length.
    least: f64,
    /// Whether a part of it has no inside.
    is_surface: bool,
}

impl BodyPairs {
    /// The pairs of bodies with faces of an interface; `None` where no two have any room in common.
    pub fn of(body: &Body, layout: &Layout, interface: &Interface) -> Option<BodyPairs> {
        let of_node = bodies_of(body);
        let mut extents: BTreeMap<u32, Extent> = BTreeMap::new();
        for &face in &interface.faces {
            let corners = layout.faces.corners[face as usize];
            let around = box_of(body, layout, &corners);
            let size = layout.faces.size[face as usize];
            let one = Extent { around, least: size, is_surface: layout.faces.is_two_sided(face) };
            let of_body = extents.entry(of_node[layout.nodes[corners[0] as usize] as usize]).or_insert(one);
            *of_body = Extent {
                around: of_body.around.joined(&around),
                least: of_body.least.min(size),
                is_surface: of_body.is_surface || one.is_surface,
            };
        }
        if extents.len() < 2 {
            return None;
        }
        let rooms = rooms(&extents);
        (!rooms.is_empty()).then_some(BodyPairs { of_node, rooms })
    }

    /// The body of a node of the mesh.
    pub fn body(&self, node: u32) -> u32 {
        self.of_node[node as usize]
    }

    /// Points that contact knows to be behind faces.
    pub fn known(&self, (mesh, model): (&Mesh, &Model), body: &Body, layout: &Layout) -> Vec<Known> {
        let mut motion = NodeMotion::new(layout.nodes.len(), layout.origin);
        stand_still(&mut motion, body, layout);
        let known = behind(layout, &Pairings::new(mesh, model, body), &motion).into_iter();
        let body_of = |face: u32| self.body(layout.nodes[layout.faces.corners[face as usize][0] as usize]);
        known
            .map(|Behind { point, contact, .. }| Known {
                point,
                other: body_of(contact.face),
                depth: -contact.projection.gap,
            })
            .collect()
    }

    /// Whether a box of a body reaches into a room that the body has in common with another.
    pub fn may_overlap(&self, body: u32, of: &Box3) -> bool {
        self.rooms.get(&body).is_some_and(|rooms| rooms.iter().any(|room| room.overlaps(of)))
    }
}

/// Box around some points.
pub fn box_of(body: &Body, layout: &Layout, points: &[u32]) -> Box3 {
    let at = |&point: &u32| body.positions[layout.nodes[point as usize] as usize];
    points.iter().fold(Box3::empty(), |all, point| all.including(at(point)))
}

/// What each body has in common with others.
fn rooms(extents: &BTreeMap<u32, Extent>) -> BTreeMap<u32, Vec<Box3>> {
    let all: Vec<(u32, Extent)> = extents.iter().map(|(&body, &extent)| (body, extent)).collect();
    let boxes: Vec<Box3> = all.iter().map(|(_, extent)| extent.around).collect();
    let mut near = Candidates::default();
    SearchKind::Grid.make().find(&boxes, &boxes, &vec![[u32::MAX; 4]; boxes.len()], &mut near);
    let mut rooms: BTreeMap<u32, Vec<Box3>> = BTreeMap::new();
    for (place, (body, one)) in all.iter().enumerate() {
        let others = near.of(place).iter().filter(|&&other| other as usize != place);
        let in_common = others.filter_map(|&other| room(one, &all[other as usize].1));
        let in_common: Vec<Box3> = in_common.collect();
        if !in_common.is_empty() {
            rooms.insert(*body, in_common);
        }
    }
    rooms
}

/// What two boxes have in common; `None` where that is too thin for an overlap of solids that matters.
fn room(one: &Extent, other: &Extent) -> Option<Box3> {
    let room = Box3 {
        low: [0, 1, 2].map(|axis| one.around.low[axis].max(other.around.low[axis])),
        high: [0, 1, 2].map(|axis| one.around.high[axis].min(other.around.high[axis])),
    };
    let least = STUCK * one.least.min(other.least);
    let has_extent = |of: &Box3, axis: usize| of.high[axis] > of.low[axis];
    // What lies in the plane is thin by nature.
    let is_thin = (0..3).any(|axis| {
        room.high[axis] - room.low[axis] <= least && has_extent(&one.around, axis) && has_extent(&other.around, axis)
    });
    (!is_thin || one.is_surface || other.is_surface).then_some(room)
}
