//! Balls with smaller elements towards a pole, where something touches them.
//!
//! The nodes flow towards the pole e with the velocity v = φ ((1 + x·x) e − 2 (x·e) x), by which the unit ball stays what it is.
//! With φ = 1 that is a Möbius transformation (hyperbolic translation): it keeps all angles, so that elements keep their
//! shapes, and at the pole sizes fall like exp(−2τ). Of a ball that is cut at the equator the plane must stay where it is:
//! there φ is the height above it.

use crate::common::vector::{add, dot, scaled};
use crate::mesher::body::Body;

/// Steps of Runge and Kutta's method where there is no closed form; one is never longer than 1/50.
const STEPS: usize = 256;
/// Points this near to the sphere are put back onto it.
const ON_SPHERE: f64 = 1e-9;

/// The pole of a ball and the size of elements there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pole {
    /// Axis on whose positive half the pole lies.
    pub axis: usize,
    /// Size of elements there over what it would be, at most 1.
    pub size: f64,
    /// Whether the ball ends in the plane across the axis through its centre.
    pub is_cut: bool,
}

impl Pole {
    /// Moves the nodes of a ball of this radius about the origin; nothing where elements are to stay as they are.
    pub fn draw_all(&self, body: &mut Body, radius: f64) {
        if self.size != 1.0 {
            let draw = |x: &mut [f64; 3]| *x = self.draw(x.map(|x| x / radius)).map(|x| x * radius);
            body.coordinates.iter_mut().for_each(draw);
        }
    }

    /// Where a point of the unit ball comes to be.
    fn draw(&self, x: [f64; 3]) -> [f64; 3] {
        let moved = if self.is_cut { self.flow(x) } else { self.translate(x) };
        let before = dot(x, x);
        match (before - 1.0).abs() < ON_SPHERE {
            true => scaled(moved, libm::sqrt(before / dot(moved, moved))),
            false => moved,
        }
    }

    /// The hyperbolic translation along the axis whose conformal factor at the pole is the size.
    fn translate(&self, x: [f64; 3]) -> [f64; 3] {
        let mut by = [0.0; 3];
        by[self.axis] = (1.0 - self.size) / (1.0 + self.size);
        let (square, along, all) = (dot(by, by), dot(by, x), dot(x, x));
        let whole = 1.0 + 2.0 * along + square * all;
        add(scaled(x, (1.0 - square) / whole), scaled(by, (1.0 + 2.0 * along + all) / whole))
    }

    fn flow(&self, mut x: [f64; 3]) -> [f64; 3] {
        let step = -0.5 * libm::log(self.size) / STEPS as f64;
        for _ in 0..STEPS {
            let first = self.velocity(x);
            let second = self.velocity(add(x, scaled(first, 0.5 * step)));
            let third = self.velocity(add(x, scaled(second, 0.5 * step)));
            let fourth = self.velocity(add(x, scaled(third, step)));
            let middle = scaled(add(second, third), 2.0);
            x = add(x, scaled(add(add(first, fourth), middle), step / 6.0));
        }
        x
    }

    fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        let height = x[self.axis];
        let mut velocity = scaled(x, -2.0 * height * height);
        velocity[self.axis] += height * (1.0 + dot(x, x));
        velocity
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::common::vector::subtract;

    fn length(a: [f64; 3]) -> f64 {
        dot(a, a).sqrt()
    }

    #[test]
    fn sizes_at_the_pole_are_what_is_asked_for_and_sphere_and_planes_stay() {
        for is_cut in [false, true] {
            let pole = Pole { axis: 2, size: 0.2, is_cut };
            let near = 1e-5;
            let [at_pole, below, beside] =
                [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0 - near], [near, 0.0, 1.0]].map(|x| pole.draw(x));
            assert!(length(subtract(at_pole, [0.0, 0.0, 1.0])) < 1e-12, "{at_pole:?}");
            for other in [below, beside] {
                let factor = length(subtract(at_pole, other)) / near;
                // The map is smooth: its second derivative shows.
                assert!((factor - 0.2).abs() < 1e-4, "{is_cut} {factor}");
            }
            let on_sphere = pole.draw([0.6, 0.0, 0.8]);
            assert!((length(on_sphere) - 1.0).abs() < 1e-14 && on_sphere[1] == 0.0 && on_sphere[2] > 0.8);
            let in_plane = pole.draw([0.0, 0.3, 0.4]);
            assert_eq!(in_plane[0], 0.0);
        }
        let cut = Pole { axis: 2, size: 0.2, is_cut: true };
        assert_eq!(cut.draw([0.5, 0.25, 0.0]), [0.5, 0.25, 0.0]);
        let whole = Pole { axis: 0, size: 0.25, is_cut: false };
        let far = whole.draw([-1.0 + 1e-6, 0.0, 0.0]);
        assert!(((1.0 + far[0]) / 1e-6 - 4.0).abs() < 1e-4, "{far:?}");
    }
}
