//! What hides what, coarsely: the depth of the nearest face in each cell of a grid over the picture.

use crate::common::vector::dot;
use crate::postprocess::view::camera::Camera;
use crate::postprocess::view::scene::Scene;

/// Side of a cell, in pixels.
const CELL: f64 = 3.0;
/// What is this many pixels behind a face is hidden by it. Less may be the same face, seen from the side.
const SLACK: f64 = 12.0;

/// Depths of the nearest faces, in pixels towards the eye.
pub struct Cover {
    columns: usize,
    rows: usize,
    depth: Vec<f64>,
}

impl Cover {
    /// The faces of a scene that look towards the eye, in a picture of this size in pixels.
    pub fn new(scene: &Scene, camera: &Camera, [width, height]: [f64; 2]) -> Cover {
        let [columns, rows] = [width, height].map(|size| (size / CELL).ceil().max(1.0) as usize);
        let mut cover = Cover { columns, rows, depth: vec![f64::NEG_INFINITY; columns * rows] };
        let toward = camera.axes().toward;
        for quad in scene.quads.iter().filter(|quad| dot(scene.normal(quad), toward) > 0.0) {
            let [a, b, c, d] = quad.map(|node| camera.project(scene.positions[node as usize]));
            cover.add([a, b, c]);
            cover.add([a, c, d]);
        }
        cover
    }

    /// A triangle: its depth at the middles of the cells that it covers.
    fn add(&mut self, [a, b, c]: [[f64; 3]; 3]) {
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let ends = |axis: usize, count: usize| {
            let values = [a[axis], b[axis], c[axis]];
            let low = values.into_iter().fold(f64::INFINITY, f64::min);
            let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
            let first = (low / CELL - 0.5).ceil().max(0.0) as usize;
            first..((high / CELL - 0.5).floor() + 1.0).clamp(0.0, count as f64) as usize
        };
        for row in ends(1, self.rows) {
            for column in ends(0, self.columns) {
                let [x, y] = [column, row].map(|place| CELL * (place as f64 + 0.5));
                let share = |p: [f64; 3], q: [f64; 3]| ((p[0] - x) * (q[1] - y) - (q[0] - x) * (p[1] - y)) / area;
                let (of_a, of_b, of_c) = (share(b, c), share(c, a), share(a, b));
                if of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0 {
                    let depth = &mut self.depth[row * self.columns + column];
                    *depth = depth.max(of_a * a[2] + of_b * b[2] + of_c * c[2]);
                }
            }
        }
    }

    /// Whether a face hides a point of the picture.
    pub fn hides(&self, [x, y, depth]: [f64; 3]) -> bool {
        let cell = |place: f64, count: usize| {
            let cell = (place / CELL).floor();
            (cell >= 0.0 && cell < count as f64).then_some(cell as usize)
        };
        match (cell(x, self.columns), cell(y, self.rows)) {
            (Some(column), Some(row)) => self.depth[row * self.columns + column] > depth + SLACK,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::postprocess::view::camera::{Axes, Bounds, Rectangle};
    use crate::postprocess::view::scene::Values;

    #[test]
    fn what_lies_below_a_face_is_hidden_and_what_lies_in_it_is_not() {
        let square = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
        let scene = Scene {
            positions: square(0.0).into_iter().chain(square(1.0)).collect(),
            quads: vec![[4, 5, 6, 7]],
            values: Values::Blocks(vec![0]),
            seams: Vec::new(),
            vectors: Vec::new(),
        };
        let mut bounds = Bounds::EMPTY;
        [[0.0; 3], [1.0; 3]].into_iter().for_each(|corner| bounds.include(corner));
        let room = Rectangle { left: 0.0, top: 0.0, right: 100.0, bottom: 100.0 };
        let camera = Camera::fit(Axes::new("top".parse().unwrap()), bounds, room);
        let cover = Cover::new(&scene, &camera, [120.0, 100.0]);
        assert!(cover.hides(camera.project([0.5, 0.5, 0.0])) && cover.hides(camera.project([0.9, 0.1, 0.5])));
        assert!(!cover.hides(camera.project([0.5, 0.5, 1.0])) && !cover.hides([110.0, 50.0, -50.0]));
        assert!(!cover.hides([-5.0, 50.0, 0.0]));
    }
}
