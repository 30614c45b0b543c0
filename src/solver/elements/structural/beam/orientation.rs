//! How the cross section of a beam lies at the start: its y axis.

use super::kernel::axes;
use crate::common::vector::{cross, dot, subtract};

/// Sine of the angle between a beam and the vector of its section below which they count as parallel: what is across the beam is then
/// little else than round-off of the mesh, and would turn the section anywhere.
pub const PARALLEL: f64 = 1e-3;

/// The axis of space that a beam along a vector leans to least.
pub fn axis_across(along: [f64; 3]) -> [f64; 3] {
    let least =
        (0..3).fold(0, |least: usize, axis| if along[axis].abs() < along[least].abs() { axis } else { least });
    [0, 1, 2].map(|axis| if axis == least { 1.0 } else { 0.0 })
}

/// The y axis of a beam that lies along a vector, at the start, from the vector of its section if it has one.
pub fn y_axis(along: [f64; 3], direction: Option<[f64; 3]>) -> [f64; 3] {
    axes(&along, &direction.unwrap_or_else(|| axis_across(along))).e[1]
}

/// Sine of the angle between a beam and a direction of unit length.
pub fn sine([a, b]: [[f64; 3]; 2], direction: [f64; 3]) -> f64 {
    let along = subtract(b, a);
    let across = cross(along, direction);
    (dot(across, across) / dot(along, along)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_are_those_of_the_angle() {
        let ends = [[1.0, 2.0, 3.0], [1.0, 2.0, 7.0]];
        assert!((sine(ends, [0.6, 0.0, 0.8]) - 0.6).abs() < 1e-15);
        assert!(sine(ends, [0.0, 0.0, -1.0]) < PARALLEL);
    }
}
