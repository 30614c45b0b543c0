//! Parallel projection of the body onto the picture.

use crate::postprocess::view::options::Direction;

/// A rectangle of the picture in pixels, y downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// Left edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Right edge.
    pub right: f64,
    /// Lower edge.
    pub bottom: f64,
}

/// The three directions of the picture, each of unit length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    /// To the right.
    pub right: [f64; 3],
    /// Upwards.
    pub up: [f64; 3],
    /// From the body towards the eye.
    pub toward: [f64; 3],
}

impl Axes {
    /// The picture's directions when the eye is in a direction from the body.
    pub fn new(from: Direction) -> Self {
        let (sin_azimuth, cos_azimuth) = from.azimuth.to_radians().sin_cos();
        let (sin_elevation, cos_elevation) = from.elevation.to_radians().sin_cos();
        let toward = [cos_azimuth * cos_elevation, sin_azimuth * cos_elevation, sin_elevation];
        let right = [-sin_azimuth, cos_azimuth, 0.0];
        let up = [-cos_azimuth * sin_elevation, -sin_azimuth * sin_elevation, cos_elevation];
        Axes { right, up, toward }
    }

    /// A vector's parts to the right, upwards, and towards the eye.
    pub fn turn(&self, v: [f64; 3]) -> [f64; 3] {
        [self.right, self.up, self.toward].map(|axis| axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2])
    }
}

/// The box around points as the eye sees them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    low: [f64; 3],
    high: [f64; 3],
}

impl Bounds {
    /// The box around nothing.
    pub const EMPTY: Bounds = Bounds { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    /// Width and height as the eye sees them.
    pub fn size(&self) -> [f64; 2] {
        [0, 1].map(|axis| (self.high[axis] - self.low[axis]).max(0.0))
    }

    /// Its eight corners: the lowest first, the highest last.
    pub fn corners(&self) -> [[f64; 3]; 8] {
        std::array::from_fn(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { self.low[axis] } else { self.high[axis] }))
    }

    /// Lets the box hold a point.
    pub fn include(&mut self, point: [f64; 3]) {
        self.low = [0, 1, 2].map(|axis| self.low[axis].min(point[axis]));
        self.high = [0, 1, 2].map(|axis| self.high[axis].max(point[axis]));
    }

    /// Lets the box hold another one.
    pub fn join(&mut self, other: Bounds) {
        // What lies around nothing is nowhere, and no corner of its is to be included.
        self.low = [0, 1, 2].map(|axis| self.low[axis].min(other.low[axis]));
        self.high = [0, 1, 2].map(|axis| self.high[axis].max(other.high[axis]));
    }
}

/// A parallel projection that fits a box into a rectangle of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    axes: Axes,
    /// Pixels per unit of length.
    scale: f64,
    /// The turned point that is seen at `target`.
    centre: [f64; 3],
    /// Middle of the rectangle in pixels.
    target: [f64; 2],
}

impl Camera {
    /// Shows all of `bounds`, as large as it fits, in the middle of `rectangle`.
    pub fn fit(axes: Axes, bounds: Bounds, rectangle: Rectangle) -> Self {
        let size = |axis: usize| bounds.high[axis] - bounds.low[axis];
        let fits = |length: f64, pixels: f64| if length > 0.0 { pixels / length } else { f64::INFINITY };
        let (width, height) = (rectangle.right - rectangle.left, rectangle.bottom - rectangle.top);
        let scale = fits(size(0), width).min(fits(size(1), height));
        let target = [0.5 * (rectangle.left + rectangle.right), 0.5 * (rectangle.top + rectangle.bottom)];
        let centre = [0, 1, 2].map(|axis| bounds.low[axis] + 0.5 * size(axis));
        Camera { axes, scale: if scale.is_finite() { scale } else { 1.0 }, centre, target }
    }

    /// Where a point is seen: pixels to the right, pixels down, and pixels towards the eye.
    pub fn project(&self, point: [f64; 3]) -> [f64; 3] {
        let turned = self.axes.turn(point);
        let [right, up, toward] = [0, 1, 2].map(|axis| self.scale * (turned[axis] - self.centre[axis]));
        [self.target[0] + right, self.target[1] - up, toward]
    }

    /// The directions of the picture.
    pub fn axes(&self) -> &Axes {
        &self.axes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: [f64; 3], b: [f64; 3]) -> bool {
        (0..3).all(|i| (a[i] - b[i]).abs() < 1e-12)
    }

    #[test]
    fn from_the_front_x_is_right_and_z_is_up_and_from_the_top_y_is_up() {
        let front = Axes::new("front".parse().unwrap());
        assert!(close(front.turn([1.0, 2.0, 3.0]), [1.0, 3.0, -2.0]));
        let top = Axes::new("top".parse().unwrap());
        assert!(close(top.turn([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]));
        let bottom = Axes::new("bottom".parse().unwrap());
        assert!(close(bottom.turn([1.0, 2.0, 3.0]), [-1.0, 2.0, -3.0]));
    }

    #[test]
    fn the_box_fills_the_tighter_side_of_the_rectangle() {
        let mut bounds = Bounds::EMPTY;
        bounds.include([0.0, 0.0, 0.0]);
        bounds.include([4.0, 1.0, 1.0]);
        let rectangle = Rectangle { left: 100.0, top: 50.0, right: 500.0, bottom: 450.0 };
        let camera = Camera::fit(Axes::new("top".parse().unwrap()), bounds, rectangle);
        assert!(close(camera.project([0.0, 0.0, 0.5]), [100.0, 300.0, 0.0]));
        assert!(close(camera.project([4.0, 1.0, 0.5]), [500.0, 200.0, 0.0]));
    }
}
