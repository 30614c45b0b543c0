//! The lines along a face's edges. Each face draws its half of a line on itself, so that a line is hidden exactly
//! where its face is.

use crate::postprocess::view::scene::Edge;

/// Half the widths (pixels of a picture 900 high) and the darkness of lines.
const MESH: (f64, f32) = (0.45, 0.50);
const SILHOUETTE: (f64, f32) = (0.55, 0.65);
const OUTLINE: (f64, f32) = (0.80, 0.85);
/// Element edges fade when a face's middle is nearer to its edge than this many pixels, and are gone at the first:
/// a fine mesh would be black otherwise.
const FADE: (f64, f64) = (1.2, 4.5);

/// What lines are drawn.
#[derive(Debug, Clone, Copy)]
pub struct Pen {
    /// Element edges are drawn; outlines are in any case.
    pub mesh: bool,
    /// Factor on the widths.
    pub scale: f64,
}

/// A line along an edge as it is seen, in samples.
#[derive(Debug, Clone, Copy, Default)]
pub struct Line {
    start: [f64; 2],
    /// Unit vector from the start to the end.
    along: [f64; 2],
    length: f64,
    half_width: f64,
    darkness: f32,
}

impl Line {
    /// The line on the edge from `a` to `b` of a face with this middle; `None` where none is drawn.
    pub fn on_edge(edge: Edge, [middle, a, b]: [[f64; 3]; 3], pen: Pen, samples: f64) -> Option<Line> {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy);
        if length == 0.0 {
            return None;
        }
        let along = [dx / length, dy / length];
        let apart = ((middle[0] - a[0]) * along[1] - (middle[1] - a[1]) * along[0]).abs() / samples;
        let ((half_width, darkness), fade) = match edge {
            Edge::Outline => (OUTLINE, 1.0),
            Edge::Silhouette => (SILHOUETTE, 1.0),
            Edge::Mesh if pen.mesh => (MESH, ((apart - FADE.0) / (FADE.1 - FADE.0)).clamp(0.0, 1.0)),
            _ => return None,
        };
        let half_width = half_width * pen.scale * samples;
        Some(Line { start: [a[0], a[1]], along, length, half_width, darkness: darkness * fade as f32 })
    }

    /// How much of the line's colour a sample has, 0 to 1.
    pub fn darkness_at(&self, [x, y]: [f64; 2]) -> f32 {
        let (dx, dy) = (x - self.start[0], y - self.start[1]);
        let aside = (dx * self.along[1] - dy * self.along[0]).abs();
        let ahead = dx * self.along[0] + dy * self.along[1];
        // Ends are square and reach beyond the corners, so that lines around a corner meet. The long side is soft over
        // one sample, which spares fine meshes a moiré pattern.
        let beside = ahead >= -self.half_width && ahead <= self.length + self.half_width;
        if beside { self.darkness * (self.half_width - aside + 0.5).clamp(0.0, 1.0) as f32 } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_as_wide_as_its_pen_and_as_long_as_its_edge() {
        let pen = Pen { mesh: true, scale: 1.0 };
        let face = [[50.0, 40.0, 0.0], [10.0, 0.0, 0.0], [90.0, 0.0, 0.0]];
        let line = Line::on_edge(Edge::Outline, face, pen, 10.0).unwrap();
        assert_eq!(line.darkness_at([50.0, 7.4]), OUTLINE.1);
        assert_eq!(line.darkness_at([50.0, 8.6]), 0.0);
        assert_eq!(line.darkness_at([1.9, 0.0]), 0.0);
        assert!(Line::on_edge(Edge::Mesh, face, Pen { mesh: false, ..pen }, 10.0).is_none());
    }

    #[test]
    fn element_edges_fade_on_small_faces() {
        let darkness = |height: f64| {
            let face = [[0.5, height, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
            let line = Line::on_edge(Edge::Mesh, face, Pen { mesh: true, scale: 2.0 }, 1.0);
            line.unwrap().darkness_at([0.5, 0.0])
        };
        assert_eq!(darkness(1.0), 0.0);
        assert_eq!(darkness(9.0), MESH.1);
        assert!(darkness(2.0) < darkness(3.0));
    }
}
