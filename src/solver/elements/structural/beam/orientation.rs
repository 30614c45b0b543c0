//! How the cross section of a beam lies at the start: its y axis.

use super::kernel::axes;
use crate::common::vector::{cross, dot, subtract};

/// Sine of the angle between a beam and the vector of its section below which they count as parallel: what is across the beam is then
/// little else than round-off of the mesh, and would turn the section anywhere.
pub const PARALLEL: f64 = 1e-3;

/// Axes of space that lean to a beam as much as each other but for this cosine are equally good. Round-off of a mesh that has been
/// turned is far below, so that it does not choose.
const TIE: f64 = 1e-6;

/// The axis of space that a beam along a vector leans to least: of equally good ones the first of x, y and z.
pub fn axis_across(along: [f64; 3]) -> [f64; 3] {
    let length = dot(along, along).sqrt();
    let least = along.iter().fold(f64::INFINITY, |least: f64, component| least.min(component.abs()));
    let first = along.iter().position(|component| component.abs() <= least + TIE * length).unwrap_or(0);
    [0, 1, 2].map(|axis| if axis == first { 1.0 } else { 0.0 })
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

    /// A column that was turned there and back has the section that it had, whichever way round-off goes.
    #[test]
    fn round_off_does_not_choose_the_axis() {
        for off in [0.0, 1e-16, -1e-16, 1e-9] {
            for other in [0.0, 1e-16, -3e-16] {
                let [column, beam] = [[off, other, 3.0], [3.0, other, off]].map(|along| y_axis(along, None));
                assert!(
                    (column[0] - 1.0).abs() < 1e-12 && (beam[1] - 1.0).abs() < 1e-12,
                    "{off} {other}: {column:?}, {beam:?}"
                );
            }
            let diagonal = y_axis([1.0, 1.0 + off, 1.0 - off], None);
            assert!((diagonal[0] - (2f64 / 3.0).sqrt()).abs() < 1e-8, "{off}: {diagonal:?}");
        }
        // What differs by more chooses as before: the least of them.
        assert_eq!(axis_across([1e-3, 0.0, 1.0]), [0.0, 1.0, 0.0]);
        assert_eq!(axis_across([0.3, 0.2, -0.1]), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn sines_are_those_of_the_angle() {
        let ends = [[1.0, 2.0, 3.0], [1.0, 2.0, 7.0]];
        assert!((sine(ends, [0.6, 0.0, 0.8]) - 0.6).abs() < 1e-15);
        assert!(sine(ends, [0.0, 0.0, -1.0]) < PARALLEL);
    }
}
