//! Faces to pixels: a depth buffer over a four by four grid of samples in each pixel, band by band down the picture
//! so that memory stays small.
//!
//! Each face is four triangles around its middle (three if it is a triangle itself), which keeps values symmetric on
//! a quadrilateral.

use tiny_skia::Pixmap;

use super::camera::Camera;
use super::colour::{BLOCK_COLOURS, ColourMap, NO_VALUE, Rgb};
use super::lines::{Line, Pen};
use crate::common::vector::dot;
use crate::postprocess::view::scene::{Scene, Values};

/// Samples per pixel in each direction.
const SAMPLES: usize = 4;
/// Pixel rows of a band.
const BAND: usize = 32;
/// Towards the light, in the picture's directions: over the left shoulder of the eye.
const LIGHT: [f64; 3] = [-0.339, 0.424, 0.840];
/// Brightness of a face that is turned away from the light: high, so that colours stay readable against the bar.
const AMBIENT: f64 = 0.55;
const LINE_COLOUR: Rgb = [0.07, 0.07, 0.09];

/// How a scene is painted.
pub struct Paint<'a> {
    /// Where the eye is.
    pub camera: &'a Camera,
    /// Colours of values.
    pub map: &'a ColourMap,
    /// Values at the ends of the map.
    pub range: (f64, f64),
    /// Lines along edges.
    pub pen: Pen,
}

/// Paints a scene over what the picture holds.
pub fn paint(picture: &mut Pixmap, scene: &Scene, paint: &Paint) {
    let surface = Surface::new(scene, paint);
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let mut bands = vec![Vec::new(); height.div_ceil(BAND)];
    let last = bands.len() - 1;
    for (index, triangle) in surface.triangles.iter().enumerate() {
        let (top, bottom) = triangle.rows();
        // Casts saturate, so that what is above or below the picture falls into its first or last band.
        let band = |row: f64| ((row / (BAND * SAMPLES) as f64) as usize).min(last);
        for list in &mut bands[band(top)..=band(bottom)] {
            list.push(index);
        }
    }
    let mut samples = Samples::new(width * SAMPLES, BAND * SAMPLES);
    for (band, list) in bands.iter().enumerate().filter(|(_, list)| !list.is_empty()) {
        samples.clear(band * BAND * SAMPLES);
        for &index in list {
            samples.draw(&surface, &surface.triangles[index]);
        }
        let rows = band * BAND..height.min((band + 1) * BAND);
        samples.average_into(&mut picture.data_mut()[4 * width * rows.start..4 * width * rows.end]);
    }
}

/// A scene as the eye sees it, in samples.
struct Surface<'a> {
    triangles: Vec<Triangle>,
    /// The lines of each face.
    lines: Vec<[Option<Line>; 4]>,
    map: &'a ColourMap,
}

/// The middle of a face and two neighbouring corners.
struct Triangle {
    /// To the right, down, towards the eye.
    corners: [[f64; 3]; 3],
    fill: Fill,
    /// Brightness, 0 to 1.
    shade: f32,
    face: usize,
}

enum Fill {
    /// Fraction of the range at the corners.
    Varying([f32; 3]),
    /// One colour.
    Uniform(Rgb),
}

impl Triangle {
    fn rows(&self) -> (f64, f64) {
        let rows = self.corners.map(|corner| corner[1]);
        (rows[0].min(rows[1]).min(rows[2]), rows[0].max(rows[1]).max(rows[2]))
    }
}

impl<'a> Surface<'a> {
    fn new(scene: &Scene, paint: &Paint<'a>) -> Self {
        let axes = paint.camera.axes();
        let to_samples = |position: &[f64; 3]| paint.camera.project(*position).map(|x| x * SAMPLES as f64);
        let seen: Vec<[f64; 3]> = scene.positions.iter().map(to_samples).collect();
        let edges = scene.edges(axes.toward);
        let mut surface = Surface { triangles: Vec::new(), lines: Vec::new(), map: paint.map };
        for (face, quad) in scene.quads.iter().enumerate() {
            let shade = shade(axes.turn(scene.normal(quad)));
            let sides = sides(quad);
            let middle = [0, 1, 2].map(|axis| mean(sides.iter().map(|&(_, a, _)| seen[a][axis])));
            let mut lines = [None; 4];
            for &(side, a, b) in &sides {
                let corners = [middle, seen[a], seen[b]];
                lines[side] = Line::on_edge(edges[face][side], corners, paint.pen, SAMPLES as f64);
                let fill = fill(scene, paint, face, &sides, (a, b));
                surface.triangles.push(Triangle { corners, fill, shade, face });
            }
            surface.lines.push(lines);
        }
        surface
    }
}

/// The sides of a face that have a length: each one's number, start and end.
fn sides(quad: &[u32; 4]) -> Vec<(usize, usize, usize)> {
    let sides = (0..4).map(|side| (side, quad[side] as usize, quad[(side + 1) % 4] as usize));
    sides.filter(|(_, a, b)| a != b).collect()
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// What fills the triangle between the middle of a face and its corners `a` and `b`.
fn fill(scene: &Scene, paint: &Paint, face: usize, sides: &[(usize, usize, usize)], (a, b): (usize, usize)) -> Fill {
    let (low, high) = paint.range;
    let fraction = |value: f64| ((value - low) / (high - low)) as f32;
    match &scene.values {
        Values::Faces(values) => Fill::Uniform(paint.map.at(fraction(values[face]))),
        Values::Blocks(blocks) => Fill::Uniform(BLOCK_COLOURS[blocks[face] % BLOCK_COLOURS.len()]),
        Values::Nodes(values) => {
            let middle = mean(sides.iter().map(|&(_, start, _)| values[start]));
            Fill::Varying([middle, values[a], values[b]].map(fraction))
        }
    }
}

/// Brightness of a face with this normal (in the picture's directions), lit from either side: what an eye sees of a
/// torn or inverted surface is its inside. It falls with the cosine all the way round, so that no part of a body
/// lies in a flat shadow.
fn shade(normal: [f64; 3]) -> f32 {
    let facing = if normal[2] < 0.0 { normal.map(|x| -x) } else { normal };
    (AMBIENT + (1.0 - AMBIENT) * 0.5 * (1.0 + dot(facing, LIGHT))) as f32
}

/// The samples of a band.
struct Samples {
    width: usize,
    rows: usize,
    /// First row of samples in the picture.
    first: usize,
    depth: Vec<f32>,
    colour: Vec<[u8; 3]>,
}

impl Samples {
    fn new(width: usize, rows: usize) -> Self {
        Samples { width, rows, first: 0, depth: vec![0.0; width * rows], colour: vec![[0; 3]; width * rows] }
    }

    /// Starts a band of which nothing is covered.
    fn clear(&mut self, first: usize) {
        self.first = first;
        self.depth.fill(f32::NEG_INFINITY);
        self.colour.fill([255; 3]);
    }

    fn draw(&mut self, surface: &Surface, triangle: &Triangle) {
        let [p, q, r] = triangle.corners;
        let area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        // Barycentric coordinates of the sample in column 0, row 0, and their change per column and per row.
        let weights = [(q, r), (r, p), (p, q)].map(|(s, t)| {
            let (per_column, per_row) = ((s[1] - t[1]) / area, (t[0] - s[0]) / area);
            (per_column, per_row, per_column * (0.5 - s[0]) + per_row * (0.5 - s[1]))
        });
        let (top, bottom) = triangle.rows();
        let first = (top.floor() as usize).max(self.first);
        let end = (bottom.ceil().max(0.0) as usize).min(self.first + self.rows);
        for row in first..end {
            let at_row = weights.map(|(per_column, per_row, start)| (per_column, start + per_row * row as f64));
            let (begin, end) = span(at_row, triangle.corners.map(|corner| corner[0]), self.width);
            for column in begin..end {
                let weight = at_row.map(|(per_column, start)| start + per_column * column as f64);
                let depth = (weight[0] * p[2] + weight[1] * q[2] + weight[2] * r[2]) as f32;
                let index = (row - self.first) * self.width + column;
                if depth > self.depth[index] {
                    self.depth[index] = depth;
                    let place = [column as f64 + 0.5, row as f64 + 0.5];
                    self.colour[index] = surface.colour(triangle, weight, place);
                }
            }
        }
    }

    /// Averages the samples of each pixel into rows of opaque RGBA; where nothing covers a sample, the pixel's own colour counts.
    fn average_into(&self, pixels: &mut [u8]) {
        let width = self.width / SAMPLES;
        for (index, pixel) in pixels.chunks_exact_mut(4).enumerate() {
            let (row, column) = (index / width * SAMPLES, index % width * SAMPLES);
            let samples = (0..SAMPLES).flat_map(|r| {
                let start = (row + r) * self.width + column;
                self.colour[start..start + SAMPLES].iter().zip(&self.depth[start..start + SAMPLES])
            });
            let behind = [pixel[0], pixel[1], pixel[2]];
            let sum = samples.fold([0u32; 3], |sum, (colour, depth)| {
                let seen = if *depth == f32::NEG_INFINITY { &behind } else { colour };
                [0, 1, 2].map(|i| sum[i] + u32::from(seen[i]))
            });
            let count = (SAMPLES * SAMPLES) as u32;
            let mean = sum.map(|total| ((total + count / 2) / count) as u8);
            pixel.copy_from_slice(&[mean[0], mean[1], mean[2], 255]);
        }
    }
}

/// The columns of a row in which all barycentric coordinates are positive.
fn span(weights: [(f64, f64); 3], columns: [f64; 3], width: usize) -> (usize, usize) {
    // Neighbours overlap by a hair rather than leave a gap between them.
    const HAIR: f64 = 1e-6;
    let mut begin = columns[0].min(columns[1]).min(columns[2]).floor();
    let mut end = columns[0].max(columns[1]).max(columns[2]).ceil();
    for (per_column, start) in weights {
        let zero = -start / per_column;
        if per_column > 0.0 {
            begin = begin.max((zero - HAIR).ceil());
        } else if per_column < 0.0 {
            end = end.min((zero + HAIR).floor() + 1.0);
        } else if start < 0.0 {
            return (0, 0);
        }
    }
    (begin.max(0.0) as usize, (end.max(0.0) as usize).min(width))
}

impl Surface<'_> {
    /// The colour of a triangle at a sample.
    fn colour(&self, triangle: &Triangle, weight: [f64; 3], place: [f64; 2]) -> [u8; 3] {
        let base = match triangle.fill {
            Fill::Uniform(colour) => colour,
            Fill::Varying(fraction) => {
                let value: f32 = (0..3).map(|i| weight[i] as f32 * fraction[i]).sum();
                if value.is_finite() { self.map.at(value) } else { NO_VALUE }
            }
        };
        let lines = self.lines[triangle.face].iter().flatten();
        let line = lines.map(|line| line.darkness_at(place)).fold(0.0, f32::max);
        [0, 1, 2].map(|i| (255.0 * (triangle.shade * base[i] * (1.0 - line) + LINE_COLOUR[i] * line) + 0.5) as u8)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::postprocess::view::camera::{Axes, Bounds, Rectangle};

    /// Squares of 10 by 10 seen from above at their height, in a picture of 20 by 20 with one pixel per length.
    fn picture(squares: &[(f64, f64, f64)]) -> Pixmap {
        let corner = |x: f64, y: f64, z: f64| [[x, y, z], [x + 10.0, y, z], [x + 10.0, y + 10.0, z], [x, y + 10.0, z]];
        let positions = squares.iter().flat_map(|&(x, y, z)| corner(x, y, z)).collect();
        let quads = (0..squares.len() as u32).map(|i| [4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3]).collect();
        let values = Values::Faces((0..squares.len()).map(|i| i as f64).collect());
        let scene = Scene { positions, quads, values, seams: Vec::new(), vectors: Vec::new() };
        let mut bounds = Bounds::EMPTY;
        bounds.include([0.0, 0.0, 0.0]);
        bounds.include([20.0, 20.0, 0.0]);
        let rectangle = Rectangle { left: 0.0, top: 0.0, right: 20.0, bottom: 20.0 };
        let camera = Camera::fit(Axes::new("top".parse().unwrap()), bounds, rectangle);
        let mut picture = Pixmap::new(20, 20).unwrap();
        picture.fill(tiny_skia::Color::WHITE);
        let map = ColourMap::sequential();
        paint(
            &mut picture,
            &scene,
            &Paint { camera: &camera, map: &map, range: (0.0, 1.0), pen: Pen { mesh: false, scale: 0.0 } },
        );
        picture
    }

    fn pixel(picture: &Pixmap, x: u32, y: u32) -> [u8; 3] {
        let p = picture.pixel(x, y).unwrap();
        [p.red(), p.green(), p.blue()]
    }

    /// The colour of a face seen squarely.
    fn squarely(fraction: f32) -> [u8; 3] {
        let shade = shade([0.0, 0.0, 1.0]);
        ColourMap::sequential().at(fraction).map(|c| (255.0 * shade * c + 0.5) as u8)
    }

    #[test]
    fn a_square_covers_its_pixels_and_no_others() {
        let picture = picture(&[(0.0, 0.0, 0.0)]);
        for (x, y) in [(0, 10), (9, 10), (0, 19), (9, 19), (4, 14)] {
            assert_eq!(pixel(&picture, x, y), squarely(0.0), "({x}, {y})");
        }
        for (x, y) in [(10, 10), (9, 9), (10, 19), (0, 9)] {
            assert_eq!(pixel(&picture, x, y), [255; 3], "({x}, {y})");
        }
    }

    #[test]
    fn a_half_covered_pixel_is_half_as_dark() {
        let picture = picture(&[(0.5, 0.0, 0.0)]);
        let expected = squarely(0.0).map(|c| (u32::from(c) + 255).div_ceil(2) as u8);
        assert_eq!(pixel(&picture, 0, 15), expected);
        assert_eq!(pixel(&picture, 10, 15), expected);
    }

    #[test]
    fn the_nearer_face_hides_the_farther_one_whatever_the_order() {
        for (squares, front) in [([(0.0, 0.0, 1.0), (5.0, 0.0, 2.0)], 1.0), ([(0.0, 0.0, 2.0), (5.0, 0.0, 1.0)], 0.0)] {
            assert_eq!(pixel(&picture(&squares), 7, 15), squarely(front));
        }
    }
}
