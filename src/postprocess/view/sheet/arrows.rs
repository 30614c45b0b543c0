//! Vectors as arrows: at nodes of faces that the eye sees, one in each field of a grid, as long as they are.

use std::collections::HashMap;

use tiny_skia::{FillRule, Paint, PathBuilder, Pixmap, Stroke, Transform};

use super::cover::Cover;
use crate::common::vector::dot;
use crate::postprocess::view::camera::{Camera, Rectangle};
use crate::postprocess::view::scene::Scene;

/// Pixels, of a picture 900 high, that an arrow has for itself, and of the longest arrow.
const APART: f64 = 30.0;
pub const LONGEST: f64 = 62.0;
/// Arrows are no smaller than in a picture 450 high, but where the room for them would be.
const LEAST_UNIT: f64 = 0.5;
/// Arrows shorter than this many pixels are not drawn.
const SHORTEST: f64 = 2.5;
const INK: [u8; 3] = [20, 20, 24];

/// What is left of the room of a body when arrows need some around it.
pub fn room(body: Rectangle, unit: f64) -> Rectangle {
    let inset = |size: f64| (LONGEST * unit.max(LEAST_UNIT)).min(0.2 * size);
    let (aside, above) = (inset(body.right - body.left), inset(body.bottom - body.top));
    Rectangle { left: body.left + aside, top: body.top + above, right: body.right - aside, bottom: body.bottom - above }
}

/// The largest length of a finite vector at a drawn node; zero without any.
pub fn longest(scene: &Scene) -> f64 {
    let length = |node: usize| scene.vectors.get(node).map_or(0.0, |v| dot(*v, *v).sqrt());
    scene.drawn_nodes().map(length).filter(|length| length.is_finite()).fold(0.0, f64::max)
}

/// Draws arrows, of which one of length `most` would be the longest.
pub fn draw(picture: &mut Pixmap, scene: &Scene, camera: &Camera, most: f64, unit: f64) {
    if scene.vectors.is_empty() || most <= 0.0 {
        return;
    }
    let axes = camera.axes();
    let cover = Cover::new(scene, camera, [f64::from(picture.width()), f64::from(picture.height())]);
    // Of the nodes in a field the one with the longest vector; ties go to the first.
    let mut chosen: HashMap<(i64, i64), (f64, usize)> = HashMap::new();
    for quad in scene.quads.iter().filter(|quad| dot(scene.normal(quad), axes.toward) > 0.0) {
        for node in quad.iter().map(|&node| node as usize) {
            let length = dot(scene.vectors[node], scene.vectors[node]).sqrt();
            if !length.is_finite() || length == 0.0 {
                continue;
            }
            let spot = camera.project(scene.positions[node]);
            if cover.hides(spot) {
                continue;
            }
            let [x, y, _] = spot;
            let field = ((x / (APART * unit)).floor() as i64, (y / (APART * unit)).floor() as i64);
            let best = chosen.entry(field).or_insert((length, node));
            if length > best.0 {
                *best = (length, node);
            }
        }
    }
    let mut nodes: Vec<usize> = chosen.into_values().map(|(_, node)| node).collect();
    nodes.sort_unstable();
    for node in nodes {
        let [x, y, _] = camera.project(scene.positions[node]);
        let [right, up, _] = axes.turn(scene.vectors[node]);
        let scale = LONGEST * unit / most;
        arrow(picture, [x, y], [scale * right, -scale * up], unit);
    }
}

fn arrow(picture: &mut Pixmap, [x, y]: [f64; 2], [dx, dy]: [f64; 2], unit: f64) {
    let length = dx.hypot(dy);
    if length < SHORTEST * unit {
        return;
    }
    let (along, head) = ([dx / length, dy / length], (0.34 * length).clamp(3.5 * unit, 9.0 * unit).min(length));
    let at = |ahead: f64, aside: f64| {
        ((x + ahead * along[0] - aside * along[1]) as f32, (y + ahead * along[1] + aside * along[0]) as f32)
    };
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(INK[0], INK[1], INK[2], 255);
    let mut shaft = PathBuilder::new();
    let (start, end) = (at(0.0, 0.0), at(length - 0.8 * head, 0.0));
    shaft.move_to(start.0, start.1);
    shaft.line_to(end.0, end.1);
    let mut tip = PathBuilder::new();
    let (point, left, right) = (at(length, 0.0), at(length - head, 0.38 * head), at(length - head, -0.38 * head));
    tip.move_to(point.0, point.1);
    tip.line_to(left.0, left.1);
    tip.line_to(right.0, right.1);
    tip.close();
    let (Some(shaft), Some(tip)) = (shaft.finish(), tip.finish()) else { return };
    // A light border keeps dark arrows apart from dark colours.
    let mut halo = Paint { anti_alias: true, ..Paint::default() };
    halo.set_color_rgba8(255, 255, 255, 200);
    let width = (1.5 * unit).max(1.0) as f32;
    let stroke = |width: f32| Stroke { width, ..Stroke::default() };
    picture.stroke_path(&shaft, &halo, &stroke(width + 2.0), Transform::identity(), None);
    picture.stroke_path(&tip, &halo, &stroke(2.0), Transform::identity(), None);
    picture.stroke_path(&shaft, &paint, &stroke(width), Transform::identity(), None);
    picture.fill_path(&tip, &paint, FillRule::Winding, Transform::identity(), None);
}
