//! Overlaps that the mesh begins with: taken out by moving nodes before the run, which gives nobody a velocity.

use super::detect::{Check, UNTOUCHED};
use super::enforce::{Alone, Enforcer, Limits};
use super::locate::{Locator, Near};
use super::neighbourhood::{self, Boxes};
use super::points::Points;
use super::search::SearchKind;
use super::setup::{Layout, Pairings, Skin};
use super::sites::Sites;
use crate::mesh::Mesh;
use crate::model::Model;
use crate::solver::Body;
use crate::solver::constraints::StepTimes;
use crate::solver::nodes::{add, dot, subtract};
use std::sync::Arc;

/// Overlap below this part of a face's size is round-off of the mesh's coordinates.
const NOTHING: f64 = 1e-9;

/// Rounds of finding overlaps and moving nodes: what moves may overlap elsewhere.
const ROUNDS: usize = 10;

/// What was moved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Overlap {
    /// Number of nodes moved.
    pub nodes: usize,
    /// Farthest move, a length.
    pub farthest: f64,
}

/// Moves nodes of the body out of the faces that they begin behind; both sides go their share, by mass and partition.
pub fn remove(mesh: &Mesh, model: &Model, body: &mut Body) -> Overlap {
    if !model.contact.is_some() {
        return Overlap::default();
    }
    let layout = Skin::new(mesh, model, body, Vec::new()).layout();
    let pairings = Pairings::new(mesh, model, body);
    let mut points = Points::new(layout.nodes.len());
    weigh(mesh, model, body, &layout, &mut points);
    let still = StepTimes { time: 0.0, kick: 1.0, drift: 1.0 };
    let mut enforcer = Enforcer::new(points.len());
    for _ in 0..ROUNDS {
        points.begin(0.0);
        for (point, &node) in layout.nodes.iter().enumerate() {
            points.set(point, body.positions[node as usize], [0.0; 3]);
        }
        let mut constraints = overlaps(&layout, &pairings, &points);
        if constraints.is_empty() {
            break;
        }
        let limits = Limits { passes: 100, tolerance: 0.1 * NOTHING };
        enforcer.prepare(&mut constraints, &points);
        enforcer.solve(&mut constraints, &points, &still, limits, &mut Alone);
        let positions = Arc::make_mut(&mut body.positions);
        for (point, _) in constraints.iter().flat_map(|constraint| constraint.parts()) {
            positions[layout.nodes[point] as usize] =
                add(points.start[point], enforcer.change(point, &points, still.kick));
        }
    }
    moved(mesh, body, &layout)
}

/// Inverse masses; none in directions that the deck holds.
fn weigh(mesh: &Mesh, model: &Model, body: &Body, layout: &Layout, points: &mut Points) {
    for (point, &node) in layout.nodes.iter().enumerate() {
        points.inverse_mass[point] = [1.0 / body.node_mass[node as usize]; 3];
    }
    let still = model.no_displacements.iter().map(|held| (held.node_set, held.direction));
    let driven = model.prescribed_motions.iter().map(|motion| (motion.node_set, motion.direction));
    for (set, direction) in still.chain(driven) {
        for node in mesh.node_set(set).map_or(&[][..], |set| &set.nodes) {
            if let Ok(point) = layout.nodes.binary_search(node) {
                points.inverse_mass[point][direction.axis()] = 0.0;
            }
        }
    }
}

/// Every point behind a face that faces it.
fn overlaps(layout: &Layout, pairings: &Pairings, points: &Points) -> Vec<super::enforce::Constraint> {
    let sites = Sites::still(points);
    let all = neighbourhood::point_boxes(&sites);
    let boxes = neighbourhood::face_boxes(0..layout.faces.len() as u32, layout, &sites);
    let mut search = SearchKind::Grid.make();
    let found = neighbourhood::find(&mut *search, [&all, &boxes, &Boxes::default()], |_| true, layout);
    let mut locator = Locator::new(found, 1.0, points, &layout.faces);
    locator.step(points, &layout.faces);
    let check = Check { points, faces: &layout.faces };
    let (mut touches, mut constraints) = (Vec::new(), Vec::new());
    let mut near: Vec<Near> = Vec::new();
    for i in 0..locator.watched().len() {
        let point = locator.watched()[i];
        locator.near(i, points, &layout.faces, &UNTOUCHED, &mut near);
        let faces: Vec<u32> = near.iter().map(|near| near.face).collect();
        check.point(point, &faces, &vec![true; faces.len()], &UNTOUCHED, &mut touches);
        for touch in &mut touches {
            touch.allowed = 0.0;
            let size = layout.faces.size[touch.face as usize];
            let Some(near) = near.iter().find(|near| near.face == touch.face) else { continue };
            let rule = layout.interfaces[near.interface as usize].rule;
            let face = layout.faces.block[touch.face as usize];
            let pairing = pairings.of(rule, layout.point_block[point as usize], face);
            if touch.stand.gap < -NOTHING * size {
                constraints.extend(super::constraint(&layout.faces, pairing, point, touch));
            }
        }
    }
    constraints
}

fn moved(mesh: &Mesh, body: &Body, layout: &Layout) -> Overlap {
    layout.nodes.iter().fold(Overlap::default(), |sum, &node| {
        let way = subtract(body.positions[node as usize], mesh.coordinates[node as usize]);
        let length = dot(way, way).sqrt();
        Overlap { nodes: sum.nodes + usize::from(length > 0.0), farthest: sum.farthest.max(length) }
    })
}
