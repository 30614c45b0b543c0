//! Rigid planes of the deck: as much of each as lies under the body.

use tiny_skia::{FillRule, Paint, PathBuilder, Pixmap, Stroke, Transform};

use crate::common::vector::{add, cross, dot, scaled, subtract, unit};
use crate::postprocess::depiction::RigidPlane;
use crate::postprocess::view::camera::{Axes, Bounds, Camera};

/// Room around the body's shadow on a plane, as a part of the longer side of the shadow.
const ROOM: f64 = 0.08;
/// A plane farther off than this many sizes of the body is not drawn: the body would be a speck.
const FARTHEST: f64 = 1.0;
/// Cosine between a plane's normal and the direction to the eye below which its edge is seen.
const ON_EDGE: f64 = 1e-3;
const FILL: [u8; 3] = [231, 233, 238];
const LINE: [u8; 3] = [140, 144, 152];
/// How much a plane between the eye and the body covers, of 255.
const VEIL: u8 = 40;

/// A part of a rigid plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// Number of the side set that meets the plane.
    pub side_set: i64,
    /// Its corners, around it.
    pub corners: [[f64; 3]; 4],
    /// Cosine between its normal and the direction to the eye.
    facing: f64,
}

/// The parts of planes that lie under a body in this box.
pub fn patches(planes: &[RigidPlane], body: Bounds, axes: &Axes) -> Vec<Patch> {
    planes.iter().filter_map(|plane| patch(plane, body, axes)).collect()
}

fn patch(plane: &RigidPlane, body: Bounds, axes: &Axes) -> Option<Patch> {
    let corners = body.corners();
    let from_plane = corners.map(|corner| dot(subtract(corner, plane.point), plane.normal));
    let nearest = from_plane.into_iter().fold(f64::INFINITY, f64::min);
    let diagonal = subtract(corners[7], corners[0]);
    let size = dot(diagonal, diagonal).sqrt();
    if !size.is_finite() || nearest > FARTHEST * size {
        return None;
    }
    let n = plane.normal;
    let least = (0..3).fold(0, |least: usize, axis| if n[axis].abs() < n[least].abs() { axis } else { least });
    let mut other = [0.0; 3];
    other[least] = 1.0;
    let first = unit(cross(n, other))?;
    let second = cross(n, first);
    let ends = [first, second].map(|along| {
        let places = corners.map(|corner| dot(subtract(corner, plane.point), along));
        let low = places.into_iter().fold(f64::INFINITY, f64::min);
        [low, places.into_iter().fold(f64::NEG_INFINITY, f64::max)]
    });
    let room = ROOM * (ends[0][1] - ends[0][0]).max(ends[1][1] - ends[1][0]);
    let [[left, right], [low, high]] = ends.map(|[low, high]| [low - room, high + room]);
    let at = |a: f64, b: f64| add(plane.point, add(scaled(first, a), scaled(second, b)));
    let corners = [at(left, low), at(right, low), at(right, high), at(left, high)];
    Some(Patch { side_set: plane.side_set, corners, facing: dot(n, axes.toward) })
}

/// Draws the planes behind the body: those that turn their side with the body to the eye.
pub fn draw_behind(picture: &mut Pixmap, patches: &[Patch], camera: &Camera, unit: f64) {
    patches.iter().filter(|patch| patch.facing >= -ON_EDGE).for_each(|patch| draw(picture, patch, camera, 255, unit));
}

/// Draws the planes between the eye and the body, through which the body is seen.
pub fn draw_before(picture: &mut Pixmap, patches: &[Patch], camera: &Camera, unit: f64) {
    patches.iter().filter(|patch| patch.facing < -ON_EDGE).for_each(|patch| draw(picture, patch, camera, VEIL, unit));
}

fn draw(picture: &mut Pixmap, patch: &Patch, camera: &Camera, cover: u8, unit: f64) {
    let mut path = PathBuilder::new();
    for (i, corner) in patch.corners.iter().enumerate() {
        let [x, y, _] = camera.project(*corner).map(|place| place as f32);
        if i == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    path.close();
    let Some(path) = path.finish() else { return };
    let ink = |[red, green, blue]: [u8; 3], cover: u8| {
        let mut paint = Paint { anti_alias: true, ..Paint::default() };
        paint.set_color_rgba8(red, green, blue, cover);
        paint
    };
    if patch.facing.abs() > ON_EDGE {
        let shade = if cover < 255 { LINE } else { FILL };
        picture.fill_path(&path, &ink(shade, cover), FillRule::Winding, Transform::identity(), None);
    }
    let width = if patch.facing.abs() > ON_EDGE { 1.2 } else { 2.0 };
    let stroke = Stroke { width: (width * unit).max(0.8) as f32, ..Stroke::default() };
    picture.stroke_path(&path, &ink(LINE, 255), &stroke, Transform::identity(), None);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit_box() -> Bounds {
        let mut body = Bounds::EMPTY;
        [[0.0; 3], [1.0, 1.0, 2.0]].into_iter().for_each(|corner| body.include(corner));
        body
    }

    #[test]
    fn a_floor_reaches_a_little_beyond_the_body() {
        let floor = RigidPlane { side_set: 9, point: [40.0, 0.0, -0.5], normal: [0.0, 0.0, 1.0] };
        let found = patches(&[floor], unit_box(), &Axes::new("iso".parse().unwrap()));
        let mut around = Bounds::EMPTY;
        found[0].corners.iter().for_each(|corner| around.include(*corner));
        let ends = [around.corners()[0], around.corners()[7]];
        let expected = [[-0.08, -0.08, -0.5], [1.08, 1.08, -0.5]];
        for (end, expected) in ends.iter().flatten().zip(expected.iter().flatten()) {
            assert!((end - expected).abs() < 1e-12, "{ends:?}");
        }
        assert!(found[0].facing > 0.0);
        let far = RigidPlane { point: [0.0, 0.0, -9.0], ..floor };
        assert!(patches(&[far], unit_box(), &Axes::new("iso".parse().unwrap())).is_empty());
    }
}
