//! Edges of a two-dimensional mesh as faces: strips a-b-b-a across the plane.
//!
//! All that contact asks of a face it asks of a strip as well; the answers are those of a line in the plane, and exactly in
//! it: no normal has a component across. Shares of corners are those of the first two, the others have none.

use super::crossing::{self, Path};
use super::projection::{BORDER, Projection};

/// A strip by its two ends; it faces to the right of the way from the first to the second.
pub type Ends = [[f64; 3]; 2];

/// The ends of a face that is a strip.
#[inline]
pub fn of(corners: &[[f64; 3]; 4]) -> Option<Ends> {
    let [a, b, c, d] = corners;
    // Faces of solids have four or three different corners; a flat coincidence is not in the plane z = 0.
    let is_strip = a[2] == 0.0 && b == c && a == d && b[2] == 0.0;
    is_strip.then_some([*a, *b])
}

fn vector_along([a, b]: &Ends) -> [f64; 2] {
    [b[0] - a[0], b[1] - a[1]]
}

/// Normal with the area of a strip as wide as it is long.
pub fn area_normal(ends: Ends) -> [f64; 3] {
    let [x, y] = vector_along(&ends);
    let length = (x * x + y * y).sqrt();
    [y * length, -x * length, 0.0]
}

/// Where a point stands against a strip. `None` without a length, or where something is not finite.
pub fn project(ends: Ends, point: [f64; 3]) -> Option<Projection> {
    let [x, y] = vector_along(&ends);
    let square = x * x + y * y;
    if square.is_nan() || square <= 0.0 {
        return None;
    }
    let length = square.sqrt();
    let normal = [y / length, -x / length, 0.0];
    let r = [point[0] - ends[0][0], point[1] - ends[0][1]];
    let gap = r[0] * normal[0] + r[1] * normal[1];
    let along = (r[0] * x + r[1] * y) / square;
    let beyond = (-along).max(along - 1.0);
    let foot = along.clamp(0.0, 1.0);
    let outside = if beyond > BORDER { beyond * length } else { 0.0 };
    gap.is_finite().then_some(Projection {
        gap,
        normal,
        weights: [1.0 - foot, foot, 0.0, 0.0],
        outside,
        triangle: 0,
        rounded: false,
    })
}

/// Shares of the ends in the point of the strip that is met along a direction; `None` where the direction hardly leaves it,
/// or far beyond its ends.
pub fn shares_along(ends: Ends, point: [f64; 3], direction: [f64; 3]) -> Option<[f64; 4]> {
    let [x, y] = vector_along(&ends);
    let across = y * direction[0] - x * direction[1];
    let r = [point[0] - ends[0][0], point[1] - ends[0][1]];
    let along = (r[1] * direction[0] - r[0] * direction[1]) / across;
    (across > 0.0 && (-0.5..=1.5).contains(&along)).then_some([1.0 - along, along, 0.0, 0.0])
}

/// Part of the step, 0 to 1, after which a point comes through a strip from the front, or `None`. All move straight.
pub fn first_crossing([a, b]: [Path; 2], point: Path) -> Option<f64> {
    let (e, r) = (crossing::relative(b, a), crossing::relative(point, a));
    let product = |u: [f64; 3], v: [f64; 3]| u[0] * v[1] - u[1] * v[0];
    // e × r is positive behind the strip: with the other sign it falls as the point comes through.
    let cubic = [-product(e.0, r.0), -(product(e.1, r.0) + product(e.0, r.1)), -product(e.1, r.1), 0.0];
    let on = |t: f64| {
        let [e, r] = [e, r].map(|(start, path)| [start[0] + t * path[0], start[1] + t * path[1]]);
        let along = (r[0] * e[0] + r[1] * e[1]) / (e[0] * e[0] + e[1] * e[1]);
        (-BORDER..=1.0 + BORDER).contains(&along)
    };
    crossing::roots(&cubic).find(|&t| crossing::slope(&cubic, t) < 0.0 && on(t))
}

#[cfg(test)]
mod tests {
    use super::super::projection;
    use super::*;

    const A: [f64; 3] = [0.0, 0.0, 0.0];
    const B: [f64; 3] = [0.0, 2.0, 0.0];

    /// The strip from (0, 0) to (0, 2) faces towards positive x.
    #[test]
    fn a_strip_is_a_face_of_the_plane() {
        let corners = [A, B, B, A];
        assert_eq!(projection::area_normal(&corners), [4.0, 0.0, 0.0]);
        let front = projection::project(&corners, [0.5, 0.5, 0.0]).expect("a strip");
        assert_eq!(
            (front.gap, front.normal, front.weights, front.outside),
            (0.5, [1.0, 0.0, 0.0], [0.75, 0.25, 0.0, 0.0], 0.0)
        );
        let beyond = projection::project(&corners, [-0.25, 2.5, 0.0]).expect("a strip");
        assert_eq!((beyond.gap, beyond.weights, beyond.outside), (-0.25, [0.0, 1.0, 0.0, 0.0], 0.5));
        let shares = projection::shares_along(&corners, [0.5, 0.5, 0.0], &front);
        assert_eq!(shares, Some([0.75, 0.25, 0.0, 0.0]));
        assert!(projection::project(&[A, A, A, A], B).is_none());
    }

    #[test]
    fn a_point_comes_through_a_moving_strip_from_the_front_only() {
        let moving = |x: [f64; 3]| (x, [0.5, 0.0, 0.0]);
        let strip = [moving(A), moving(B), moving(B), moving(A)];
        let comes = projection::first_crossing(&strip, ([1.0, 0.5, 0.0], [-1.0, 0.0, 0.0])).expect("a hit");
        assert!((comes - 2.0 / 3.0).abs() < 1e-12);
        assert_eq!(projection::first_crossing(&strip, ([-0.25, 0.5, 0.0], [2.0, 0.0, 0.0])), None);
        assert_eq!(projection::first_crossing(&strip, ([1.0, 2.5, 0.0], [-1.0, 0.0, 0.0])), None);
        // A strip that turns on its first end meets a point at rest when it points at it.
        let turning = [(A, [0.0; 3]), ([0.0, 2.0, 0.0], [2.0, 0.0, 0.0])];
        let at_rest = ([0.5, 1.0, 0.0], [0.0; 3]);
        let hit = first_crossing(turning, at_rest).expect("a hit");
        assert!((hit - 0.5).abs() < 1e-12);
    }
}
