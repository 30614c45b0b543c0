//! The frame in which an element begins: the rotation of its own axes.
//!
//! Axes of a skewed element are not at right angles. Of all rotations the polar factor of the three, the R of J = R U with the mean
//! Jacobian J, is nearest to them, and no numbering of the corners chooses it. (A frame with e₁ along ξ depends on the corner at which
//! the numbering begins, and with it the assumed strain.)

use crate::common::vector::{add, cross, dot, scaled, subtract};

/// Iterations after which the axes count as degenerate: 60 halve the ratio of lengths from 10¹⁸ to 1.
const ITERATIONS: usize = 80;

/// An iteration that changes no component by more than this is the last: the error of what it leaves is of the order of the square.
const SETTLED: f64 = 1e-9;

/// The frame of an element with these corners as a unit quaternion. The fixed axes where an element is too degenerate, or inside out.
pub(in crate::solver::elements::solids) fn own_axes(corners: &[[f64; 3]; 8]) -> [f64; 4] {
    let along = |minus: [usize; 4], plus: [usize; 4]| {
        (0..4).fold([0.0; 3], |sum, i| add(sum, subtract(corners[plus[i]], corners[minus[i]])))
    };
    let axes =
        [along([0, 3, 4, 7], [1, 2, 5, 6]), along([0, 1, 4, 5], [3, 2, 7, 6]), along([0, 1, 2, 3], [4, 5, 6, 7])];
    polar_factor(axes).map_or([1.0, 0.0, 0.0, 0.0], |axes| quaternion(&axes))
}

/// The rotation R of J = R U, both as columns: X ← ½ (X + X⁻ᵀ) from X = J (Higham 1986, eq. 3.3). `None` where J has no inverse or
/// turns space inside out.
fn polar_factor(jacobian: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let largest = jacobian.as_flattened().iter().fold(0.0f64, |largest, x| largest.max(x.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return None;
    }
    let mut x = jacobian.map(|axis| axis.map(|component| component / largest));
    for _ in 0..ITERATIONS {
        let [a, b, c] = x;
        let cofactors = [cross(b, c), cross(c, a), cross(a, b)];
        let determinant = dot(a, cofactors[0]);
        if determinant.is_nan() || determinant <= 0.0 {
            return None;
        }
        let next = [0, 1, 2].map(|i| scaled(add(x[i], scaled(cofactors[i], 1.0 / determinant)), 0.5));
        let change = next.as_flattened().iter().zip(x.as_flattened()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        x = next;
        if change <= SETTLED {
            return Some(x);
        }
    }
    None
}

/// Unit quaternion of the rotation whose matrix has the columns `e` (Shepperd 1978: the largest term is the pivot).
fn quaternion(e: &[[f64; 3]; 3]) -> [f64; 4] {
    let (m00, m11, m22) = (e[0][0], e[1][1], e[2][2]);
    let squares = [1.0 + m00 + m11 + m22, 1.0 + m00 - m11 - m22, 1.0 - m00 + m11 - m22, 1.0 - m00 - m11 + m22];
    let pivot = (0..4).fold(0, |best, i| if squares[i] > squares[best] { i } else { best });
    // Columns are axes: component i of axis j is m[i][j].
    let (x, y, z) = (e[1][2] - e[2][1], e[2][0] - e[0][2], e[0][1] - e[1][0]);
    let (xy, yz, zx) = (e[0][1] + e[1][0], e[1][2] + e[2][1], e[2][0] + e[0][2]);
    let q = match pivot {
        0 => [squares[0], x, y, z],
        1 => [x, squares[1], xy, zx],
        2 => [y, xy, squares[2], yz],
        _ => [z, zx, yz, squares[3]],
    };
    let length = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    q.map(|c| c / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::elements::solids::hexahedron::kinematics::rotation_matrix;

    /// Corners of a parallelepiped with these edges, numbered from the corner before `first` turns about ζ.
    fn corners([a, b, c]: [[f64; 3]; 3], first: usize) -> [[f64; 3]; 8] {
        let layer = [[0.0; 3], a, add(a, b), b];
        std::array::from_fn(|n| {
            let at = layer[(n + first) % 4];
            if n < 4 { at } else { add(at, c) }
        })
    }

    /// The frame, its axes as an unordered set: each without its sign, in the order of where they point.
    fn directions(q: [f64; 4]) -> Vec<[f64; 3]> {
        let m = rotation_matrix(&q);
        let axis = |j: usize| {
            let axis = [m[0][j], m[1][j], m[2][j]];
            let largest = axis.iter().fold(0.0f64, |most, x| if x.abs() > most.abs() { *x } else { most });
            axis.map(|x| x * largest.signum())
        };
        let mut all = vec![axis(0), axis(1), axis(2)];
        all.sort_by(|a, b| a[0].total_cmp(&b[0]));
        all
    }

    #[test]
    fn no_numbering_chooses_the_frame_of_a_skewed_element() {
        let edges = [[2.0, 0.1, 0.0], [0.9, 1.5, 0.2], [-0.3, 0.4, 0.7]];
        let whole = directions(own_axes(&corners(edges, 0)));
        for first in 1..4 {
            let turned = directions(own_axes(&corners(edges, first)));
            for (a, b) in whole.as_flattened().iter().zip(turned.as_flattened()) {
                assert!((a - b).abs() < 1e-14, "{whole:?} {turned:?}");
            }
        }
        // Also where another pair of faces is numbered first.
        let [a, b, c] = edges;
        let other = directions(own_axes(&corners([b, c, a], 0)));
        assert!(whole.as_flattened().iter().zip(other.as_flattened()).all(|(a, b)| (a - b).abs() < 1e-14));
    }

    /// R is the polar factor where J = R U for a symmetric positive U, also of a flat element.
    #[test]
    fn the_frame_is_the_polar_factor_of_the_axes() {
        for heights in [[1.0, 1.0, 1.0], [1.0, 2.0, 3.0], [1.0, 1e-6, 1.0], [1e150, 1e140, 1e150]] {
            let [x, y, z] = heights;
            let edges = [[x, 0.2 * y, 0.0], [0.2 * y, y, 0.0], [0.0, 0.0, z]];
            let q = own_axes(&corners(edges, 0));
            assert!((q[0].abs() - 1.0).abs() < 1e-14, "{heights:?} {q:?}");
        }
    }

    /// What is along the fixed axes begins there exactly; what has no axes, too.
    #[test]
    fn boxes_begin_without_round_off() {
        let own = own_axes(&corners([[3.0, 0.0, 0.0], [0.0, 0.7, 0.0], [0.0, 0.0, 1e-3]], 0));
        assert_eq!(own, [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(own_axes(&[[1.0; 3]; 8]), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(own_axes(&corners([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]], 0)), [1.0, 0.0, 0.0, 0.0]);
    }
}
