//! Where a point stands against a face, and when it comes through.
//!
//! A quadrilateral of four free corners is not flat. Everywhere in contact it is taken as the four triangles around
//! the mean of its corners; neighbouring faces then share their edges exactly, and the outside has no gaps. An edge of a
//! two-dimensional mesh is the face a-b-b-a, a strip across the plane, see [`strip`].

use super::crossing::{self, Path};
use super::motion::Four;
use super::strip;
use crate::common::vector::{add, cross, dot, normalized, scaled, subtract};
use crate::lanes::array;

/// Beyond a triangle's border by this part of it is still on it. Bodies whose sides are flush meet corner on corner, and
/// round-off decides which corner is inside; without the margin each may be beyond the other's border, and they pass
/// through each other.
pub(super) const BORDER: f64 = 1e-6;

/// A foot nearer to the line between triangles or faces than this part of them is on both, for the normal. Below a node of a
/// tilted surface the feet of the perpendiculars are not quite at the node.
pub const TIE: f64 = 1e-3;

/// A point that is nearer to a plane than this part of the face may be on either side of it.
const ROUND_OFF: f64 = 1e-9;

/// Triangles of a face, continued as far as a face beside it, leave the plane of its middle by less than so many times what its corners do.
const WARPS: f64 = 8.0;

/// A point against a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection {
    /// Distance along the normal, a length; negative behind the face.
    pub gap: f64,
    /// Unit normal, outwards.
    pub normal: [f64; 3],
    /// Shares of the four corners in the foot of the perpendicular, which add up to one. Where the foot lies beyond
    /// the border, the nearest point of the border.
    pub weights: [f64; 4],
    /// How far the foot lies beyond the border, a length; 0 on the face.
    pub outside: f64,
    /// Number of the triangle in which the foot is.
    pub(super) triangle: usize,
    /// Whether gap and normal are seen from the nearest point of the border.
    pub rounded: bool,
}

/// A point is met around the border of a face up to so many times as far outside as it is in front: up to 71 degrees from the
/// normal.
const AROUND: f64 = 3.0;

impl Projection {
    /// The same of a point beyond the border that is near it, seen from the nearest point of the border: faces that touch at a
    /// distance are round there, also in their plane where the surface ends, which is at the edges `borders`, a bit each. The foot is
    /// then on the face. Itself elsewhere.
    pub fn around_border(self, corners: &[[f64; 3]; 4], point: [f64; 3], borders: u8) -> Projection {
        let in_front = self.gap > 0.0 && self.outside <= AROUND * self.gap;
        if self.outside > 0.0 && (in_front || self.is_beside(self.gap, borders)) {
            self.seen_from_border(corners, point)
        } else {
            self
        }
    }

    /// The same of a point beyond the border, seen from the nearest point of it. Itself for a point on the border.
    pub fn seen_from_border(self, corners: &[[f64; 3]; 4], point: [f64; 3]) -> Projection {
        let offset = subtract(point, foot(corners, &self.weights));
        let length = dot(offset, offset).sqrt();
        if length <= 0.0 {
            return self;
        }
        Projection { gap: length, normal: scaled(offset, 1.0 / length), outside: 0.0, rounded: true, ..self }
    }

    /// Height of a point above the plane of the triangle in which the foot is, a length; the corners may be those of another time.
    pub fn height(&self, corners: &[[f64; 3]; 4], point: [f64; 3]) -> f64 {
        if let Some(ends) = strip::of(corners) {
            return strip::project(ends, point).map_or(f64::NAN, |projection| projection.gap);
        }
        let (middle, [a, b]) = (centre(corners), self.edge().map(|i| corners[i]));
        let normal = cross(subtract(a, middle), subtract(b, middle));
        dot(subtract(point, middle), normal) / dot(normal, normal).sqrt()
    }

    /// Corners, by their places in the face, of the edge beyond which the point lies, or which is nearest to its foot.
    pub fn edge(&self) -> [usize; 2] {
        [self.triangle, (self.triangle + 1) % 4]
    }

    /// Whether the point, at this height above the face, is beyond the end of a surface, about in its plane: neither side
    /// is in the way.
    pub fn is_beside(&self, height: f64, borders: u8) -> bool {
        self.outside > AROUND * height.abs() && self.is_at_border(borders)
    }

    /// Whether the edge beyond which the point lies, or which is nearest to its foot, is an end of the surface.
    pub fn is_at_border(&self, borders: u8) -> bool {
        borders >> self.triangle & 1 == 1
    }
}

/// Mean of four corners.
pub fn centre(corners: &[[f64; 3]; 4]) -> [f64; 3] {
    scaled(add(add(corners[0], corners[1]), add(corners[2], corners[3])), 0.25)
}

/// The point of a face with these shares of its corners.
pub fn foot(corners: &[[f64; 3]; 4], weights: &[f64; 4]) -> [f64; 3] {
    (0..4).fold([0.0; 3], |foot, i| add(foot, scaled(corners[i], weights[i])))
}

/// Normal with the length of the face's area.
#[inline]
pub fn area_normal(corners: &[[f64; 3]; 4]) -> [f64; 3] {
    if let Some(ends) = strip::of(corners) {
        return strip::area_normal(ends);
    }
    scaled(cross(subtract(corners[2], corners[0]), subtract(corners[3], corners[1])), 0.5)
}

/// Whether a point is surely in front of a face: above the plane of its middle by more than the corners are. Cheap, for
/// the many that are, and in whole vectors.
#[inline(always)]
pub fn is_in_front([a, b, c, d]: [Four; 4], point: Four) -> bool {
    let each = |of: fn(f64, f64) -> f64, u: Four, v: Four| -> Four { std::array::from_fn(|i| of(u[i], v[i])) };
    let (sum, less) = (|u, v| each(|a, b| a + b, u, v), |u, v| each(|a, b| a - b, u, v));
    let (u, v) = (less(c, a), less(d, b));
    let turned = |[x, y, z, w]: Four| [y, z, x, w];
    // The product of the diagonals, its last coordinate first.
    let product = less(each(|a, b| a * b, u, turned(v)), each(|a, b| a * b, turned(u), v));
    let along = |r: Four| product[1] * r[0] + product[2] * r[1] + product[0] * r[2];
    let middle = sum(sum(a, b), sum(c, d)).map(|x| 0.25 * x);
    // The diagonals are parallel to that plane, so the corners are above it and below by the same height.
    let warp = along(less(a, middle)).abs();
    along(less(point, middle)) > warp * (1.0 + BORDER)
}

/// Whether the gap of a point is surely below zero: behind the planes of all four triangles, and where two of them are blended, too. Cheap, for
/// the many that are, and in whole vectors. A foot on the line between two triangles lies off the plane of either by no more than [`TIE`] of
/// what the other arms do, and these all span the same volume with a triangle.
#[inline(always)]
pub fn is_behind(corners: &[[f64; 3]; 4], point: [f64; 3]) -> bool {
    let middle = centre(corners);
    let [x, y, z] = array!(i in 3 => array!(k in 4 => corners[k][i] - middle[i]));
    let next = |[a, b, c, d]: Four| [b, c, d, a];
    let (u, v, w) = (next(x), next(y), next(z));
    let normal: [Four; 3] = [
        array!(k in 4 => y[k] * w[k] - z[k] * v[k]),
        array!(k in 4 => z[k] * u[k] - x[k] * w[k]),
        array!(k in 4 => x[k] * v[k] - y[k] * u[k]),
    ];
    let r = [point[0] - middle[0], point[1] - middle[1], point[2] - middle[2]];
    let height: Four = array!(k in 4 => r[0] * normal[0][k] + r[1] * normal[1][k] + r[2] * normal[2][k]);
    let volume = x[2] * normal[0][0] + y[2] * normal[1][0] + z[2] * normal[2][0];
    let round_off = ROUND_OFF
        * (x[0].abs() + y[0].abs() + z[0].abs())
        * (normal[0][0].abs() + normal[1][0].abs() + normal[2][0].abs());
    let least = -(2.0 * TIE * volume.abs() + round_off);
    (height[0] < least) & (height[1] < least) & (height[2] < least) & (height[3] < least)
}

/// The same of a point that touches the face from farther away, at some distance, a length.
pub fn is_out_of_reach(corners: &[[f64; 3]; 4], point: [f64; 3], distance: f64) -> bool {
    let (middle, normal) = (centre(corners), area_normal(corners));
    let along = |at: [f64; 3]| dot(subtract(at, middle), normal);
    along(point) > along(corners[0]).abs() * (1.0 + BORDER) + distance * dot(normal, normal).sqrt()
}

/// Whether a point within some edges of a face is surely farther from it than a distance, on either side of its plane and of its continuation. Cheap, for
/// the many that are.
#[inline(always)]
pub fn is_off_plane(corners: &[[f64; 3]; 4], point: [f64; 3], distance: f64) -> bool {
    let (middle, normal) = (centre(corners), area_normal(corners));
    let along = |at: [f64; 3]| dot(subtract(at, middle), normal).abs();
    along(point) > WARPS * along(corners[0]) + distance * dot(normal, normal).sqrt()
}

/// Paths of the corners of a face pushed outwards by a distance, along the normals that it has at both ends of the step.
pub fn pushed_out(corners: &[Path; 4], distance: f64) -> [Path; 4] {
    let ends = |part: f64| corners.map(|path| at(path, part));
    let push = |corners: [[f64; 3]; 4]| {
        let normal = area_normal(&corners);
        let length = dot(normal, normal).sqrt();
        if length > 0.0 { scaled(normal, distance / length) } else { [0.0; 3] }
    };
    let (start, end) = (push(ends(0.0)), push(ends(1.0)));
    corners.map(|(from, path)| (add(from, start), add(path, subtract(end, start))))
}

/// Where a point stands against a face. `None` for a face without area, or where something is not finite.
pub fn project(corners: &[[f64; 3]; 4], point: [f64; 3]) -> Option<Projection> {
    if let Some(ends) = strip::of(corners) {
        return strip::project(ends, point);
    }
    let middle = centre(corners);
    // Written out: `map` of the arrays would be calls.
    let &[a, b, c, d] = corners;
    let arms = [subtract(a, middle), subtract(b, middle), subtract(c, middle), subtract(d, middle)];
    let r = subtract(point, middle);
    // Which side of each arm the point is on, seen along the mean normal.
    let mean = area_normal(corners);
    let turn_at = |arm| dot(r, cross(mean, arm));
    let turn = [turn_at(arms[0]), turn_at(arms[1]), turn_at(arms[2]), turn_at(arms[3])];
    let triangle = (0..4).find(|&k| turn[k] >= 0.0 && turn[(k + 1) % 4] < 0.0).unwrap_or(0);
    let next = (triangle + 1) % 4;
    let (e1, e2) = (arms[triangle], arms[next]);
    let normal = cross(e1, e2);
    let square = dot(normal, normal);
    if square.is_nan() || square <= 0.0 {
        return None;
    }
    let (b1, b2) = (dot(cross(r, e2), normal) / square, dot(cross(e1, r), normal) / square);
    let length = square.sqrt();
    let edge = subtract(e2, e1);
    let beyond = b1 + b2 - 1.0;
    let (b1, b2, outside) = if beyond > 0.0 {
        // The shares must add up to one in the margin, too: forces are spread by them.
        let along = (dot(subtract(r, e1), edge) / dot(edge, edge)).clamp(0.0, 1.0);
        let distance = beyond * length / dot(edge, edge).sqrt();
        (1.0 - along, along, if beyond > BORDER { distance } else { 0.0 })
    } else {
        (b1.max(0.0), b2.max(0.0), 0.0)
    };
    let rest = 0.25 * (1.0 - b1 - b2).max(0.0);
    let mut weights = [rest; 4];
    weights[triangle] += b1;
    weights[next] += b2;
    let mut gap = dot(r, normal) / length;
    let mut normal = scaled(normal, 1.0 / length);
    if let Some(blended) = between_triangles(&arms, triangle, [b1, b2], normal) {
        normal = blended;
        gap = dot(subtract(r, add(scaled(e1, b1), scaled(e2, b2))), normal);
    }
    gap.is_finite().then_some(Projection { gap, normal, weights, outside, triangle, rounded: false })
}

/// The mean of the normals of both triangles, for a foot on the line between them: the numbering of the corners must not
/// choose one, or what is symmetric would not stay so. `None` elsewhere.
fn between_triangles(arms: &[[f64; 3]; 4], triangle: usize, [b1, b2]: [f64; 2], normal: [f64; 3]) -> Option<[f64; 3]> {
    let other = match (b1 < TIE, b2 < TIE) {
        (false, false) => return None,
        (true, true) => (triangle + 2) % 4,
        (true, false) => (triangle + 1) % 4,
        (false, true) => (triangle + 3) % 4,
    };
    let second = cross(arms[other], arms[(other + 1) % 4]);
    let sum = add(normal, scaled(second, 1.0 / dot(second, second).sqrt()));
    let length = dot(sum, sum).sqrt();
    // Triangles that have collapsed or turned over have no say.
    (length > 1.0).then(|| scaled(sum, 1.0 / length))
}

/// Unit normal of a face at a point of its border that has these shares of its corners: of the triangle at an edge, or the mean of
/// the two at a corner; zero where the face has no area there. It stands upright on the edge, which the mean normal of a warped face
/// does not: along that, what slides on the edge would sink in or rise.
pub fn normal_on_border(corners: &[[f64; 3]; 4], weights: &[f64; 4]) -> [f64; 3] {
    if let Some(ends) = strip::of(corners) {
        return normalized(strip::area_normal(ends)).unwrap_or_default();
    }
    let middle = centre(corners);
    let mut sum = [0.0; 3];
    for k in 0..4 {
        let next = (k + 1) % 4;
        if weights[k] + weights[next] > 1.0 - 2.0 * TIE {
            let normal = normalized(cross(subtract(corners[k], middle), subtract(corners[next], middle)));
            sum = add(sum, normal.unwrap_or_default());
        }
    }
    normalized(sum).unwrap_or_default()
}

/// Shares of the corners in the point of a face that is met along a direction: Σ N x_I = point − α direction, in the plane
/// of the triangle that `projection` has found. Beyond the border they are continued. `None` where the direction hardly leaves
/// the plane, or far beyond the border.
///
/// Forces act at the beginning of a step, on the positions there; along the normal of its end they have no moment when
/// the shares are these. The gap at the end is the same with all shares of points in the plane.
pub fn shares_along(corners: &[[f64; 3]; 4], point: [f64; 3], projection: &Projection) -> Option<[f64; 4]> {
    if let Some(ends) = strip::of(corners) {
        return strip::shares_along(ends, point, projection.normal);
    }
    let middle = centre(corners);
    let next = (projection.triangle + 1) % 4;
    let (e1, e2, r) =
        (subtract(corners[projection.triangle], middle), subtract(corners[next], middle), subtract(point, middle));
    let volume = dot(projection.normal, cross(e1, e2));
    let (b1, b2) = (dot(projection.normal, cross(r, e2)) / volume, dot(projection.normal, cross(e1, r)) / volume);
    let near = |b: f64| (-0.5..=1.5).contains(&b);
    if volume <= 0.0 || !(near(b1) && near(b2) && near(b1 + b2)) {
        return None;
    }
    let mut shares = [0.25 * (1.0 - b1 - b2); 4];
    shares[projection.triangle] += b1;
    shares[next] += b2;
    Some(shares)
}

/// Part of the step, 0 to 1, after which a point comes through a face from the front (Heinstein et al. 1993), or
/// `None`. Corners and point move straight.
pub fn first_crossing(corners: &[Path; 4], point: Path) -> Option<f64> {
    if strip::of(&corners.map(|(start, _)| start)).is_some() {
        return strip::first_crossing([corners[0], corners[1]], point);
    }
    let mean = |pick: fn(&Path) -> [f64; 3]| centre(&[0, 1, 2, 3].map(|i| pick(&corners[i])));
    let middle: Path = (mean(|path| path.0), mean(|path| path.1));
    let r = crossing::relative(point, middle);
    let arms = corners.map(|corner| crossing::relative(corner, middle));
    (0..4)
        .filter_map(|k| {
            let (e1, e2) = (arms[k], arms[(k + 1) % 4]);
            let g = crossing::coplanarity(r, e1, e2);
            crossing::roots(&g).find(|&t| falls(&g, t) && on_triangle(at(r, t), at(e1, t), at(e2, t)))
        })
        .min_by(f64::total_cmp)
}

/// Position on a path at part `t` of the step.
fn at(path: Path, t: f64) -> [f64; 3] {
    add(path.0, scaled(path.1, t))
}

/// Whether the volume falls at a root: the point passes from the front to the back.
fn falls(g: &[f64; 4], t: f64) -> bool {
    crossing::slope(g, t) < 0.0
}

fn on_triangle(r: [f64; 3], e1: [f64; 3], e2: [f64; 3]) -> bool {
    let normal = cross(e1, e2);
    let square = dot(normal, normal);
    let (b1, b2) = (dot(cross(r, e2), normal) / square, dot(cross(e1, r), normal) / square);
    b1 >= -BORDER && b2 >= -BORDER && b1 + b2 <= 1.0 + BORDER
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::contact::geometry::motion::four;
    use proptest::prelude::*;

    const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn the_foot_of_the_perpendicular() {
        let s = project(&SQUARE, [0.3, 0.6, -0.1]).expect("a face");
        let foot = (0..4).fold([0.0; 3], |sum, i| add(sum, scaled(SQUARE[i], s.weights[i])));
        assert!((s.gap + 0.1).abs() < 1e-15 && s.outside == 0.0 && s.normal == [0.0, 0.0, 1.0]);
        assert!(subtract(foot, [0.3, 0.6, 0.0]).iter().all(|d| d.abs() < 1e-15), "{foot:?}");
        assert!((s.weights.iter().sum::<f64>() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn normals_on_the_border_stand_upright_on_it() {
        // Warped: its mean normal leans along the first edge.
        let warped = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.3], [0.0, 1.0, -0.3]];
        let mean = area_normal(&warped);
        let on_edge = normal_on_border(&warped, &[0.4, 0.6, 0.0, 0.0]);
        assert!(mean[0].abs() > 0.1 && on_edge[0].abs() < 1e-15, "{mean:?} {on_edge:?}");
        // At a corner between both edges that end there; of a strip its own.
        let (along, at) =
            (normal_on_border(&warped, &[0.0, 0.5, 0.5, 0.0]), normal_on_border(&warped, &[0.0, 1.0, 0.0, 0.0]));
        let sum = add(on_edge, along);
        assert!(subtract(at, scaled(sum, 1.0 / dot(sum, sum).sqrt())).iter().all(|x| x.abs() < 1e-15), "{at:?}");
        let strip = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
        assert_eq!(normal_on_border(&strip, &[1.0, 0.0, 0.0, 0.0]), [0.0, -1.0, 0.0]);
    }

    #[test]
    fn heights_over_the_part_of_a_face_where_the_foot_is() {
        let s = project(&SQUARE, [0.5, 0.1, 0.2]).expect("a face");
        let lifted = SQUARE.map(|[x, y, z]| [x, y, z + 1.0 + 0.5 * y]);
        assert!((s.height(&lifted, [0.7, -3.0, 0.0]) * 1.25f64.sqrt() - 0.5).abs() < 1e-15);
        let strip = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
        let s = project(&strip, [0.5, -0.1, 0.0]).expect("a strip");
        assert_eq!(s.height(&strip, [5.0, -0.3, 0.0]), 0.3);
    }

    proptest! {
        #[test]
        fn in_front_is_above_all_corners(x in prop::array::uniform5(prop::array::uniform3(-1.0..1.0))) {
            let [a, b, c, d, point] = x.map(four);
            let (corners, normal) = ([x[0], x[1], x[2], x[3]], area_normal(&[x[0], x[1], x[2], x[3]]));
            let above = |at: [f64; 3]| dot(subtract(at, centre(&corners)), normal);
            let highest = corners.map(above).into_iter().fold(0.0, f64::max);
            // Margins and round-off decide between these.
            prop_assume!((above(x[4]) - highest).abs() > 1e-5);
            prop_assert_eq!(is_in_front([a, b, c, d], point), above(x[4]) > highest);
        }
    }

    proptest! {
        #[test]
        fn behind_all_triangles_the_gap_is_below_zero(
            x in prop::array::uniform4(prop::array::uniform3(-0.4..0.4)), point in prop::array::uniform3(-3.0..3.0), flat in 0.0..1.0,
        ) {
            let corners = [0, 1, 2, 3].map(|i| [SQUARE[i][0] + x[i][0], SQUARE[i][1] + x[i][1], flat * x[i][2]]);
            if is_behind(&corners, point) {
                let gap = project(&corners, point).map_or(-1.0, |projection| projection.gap);
                prop_assert!(gap < 0.0, "{gap}");
            }
            prop_assert!(is_behind(&SQUARE, [point[0], point[1], -1e-8 - point[2].abs()]));
        }
    }

    proptest! {
        #[test]
        fn off_the_plane_the_gap_is_larger(
            x in prop::array::uniform4(prop::array::uniform3(-0.1..0.1)), point in prop::array::uniform3(-2.0..3.0), flat in 0.0..1.0, far in 0.0..0.5,
        ) {
            let corners = [0, 1, 2, 3].map(|i| [SQUARE[i][0] + x[i][0], SQUARE[i][1] + x[i][1], flat * x[i][2]]);
            if is_off_plane(&corners, point, far) {
                let gap = project(&corners, point).map_or(f64::INFINITY, |projection| projection.gap.abs());
                prop_assert!(gap > far, "{gap}");
            }
            prop_assert!(!is_off_plane(&SQUARE, [point[0], point[1], far], 1.01 * far + 1e-9));
        }
    }

    #[test]
    fn beyond_the_border_the_nearest_point_of_it() {
        let s = project(&SQUARE, [1.25, 0.5, 0.5]).expect("a face");
        assert!((s.outside - 0.25).abs() < 1e-15 && (s.gap - 0.5).abs() < 1e-15);
        assert_eq!(s.weights, [0.0, 0.5, 0.5, 0.0]);
        let corner = project(&SQUARE, [2.0, 2.5, 0.0]).expect("a face");
        assert_eq!(corner.weights, [0.0, 0.0, 1.0, 0.0]);
    }

    #[test]
    fn within_the_margin_of_the_border_a_point_is_on_the_face() {
        for beyond in [0.0, 1e-12, 0.4e-6] {
            let s = project(&SQUARE, [1.0 + beyond, 0.3, 0.0]).expect("a face");
            assert!(s.outside == 0.0 && s.weights.iter().sum::<f64>() == 1.0, "{s:?}");
        }
        assert!(project(&SQUARE, [1.0 + 1e-6, 0.3, 0.0]).is_some_and(|s| s.outside > 0.0));
    }

    #[test]
    fn shares_along_a_direction_have_no_arm_across_it() {
        // A face that turns and a point that slides: the shares are those of the beginning, along the normal of the end.
        let end = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0]];
        let s = project(&end, [0.7, 0.4, 0.0]).expect("a face");
        let shares = shares_along(&SQUARE, [0.65, 0.45, 0.02], &s).expect("near the face");
        let foot = (0..4).fold([0.0; 3], |sum, i| add(sum, scaled(SQUARE[i], shares[i])));
        let arm = cross(subtract([0.65, 0.45, 0.02], foot), s.normal);
        assert!(arm.iter().all(|x| x.abs() < 1e-16) && foot[2].abs() < 1e-16, "{arm:?} {foot:?}");
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-15);
        assert_eq!(shares_along(&SQUARE, [5.0, 0.4, 0.0], &s), None);
    }

    #[test]
    fn triangles_and_faces_without_area() {
        let triangle = [SQUARE[0], SQUARE[1], SQUARE[2], SQUARE[2]];
        let s = project(&triangle, [0.7, 0.3, 0.2]).expect("a face");
        assert!((s.gap - 0.2).abs() < 1e-15 && s.outside == 0.0);
        assert_eq!(project(&[SQUARE[0]; 4], [0.0; 3]), None);
        assert_eq!(project(&SQUARE, [f64::NAN; 3]).map(|s| s.outside), None);
    }

    #[test]
    fn a_point_comes_through_a_moving_face_from_the_front_only() {
        let moving = SQUARE.map(|x| (x, [0.0, 0.0, 0.4]));
        let down = ([0.2, 0.7, 0.3], [0.0, 0.0, -0.6]);
        assert!((first_crossing(&moving, down).expect("a hit") - 0.3).abs() < 1e-12);
        let up = ([0.2, 0.7, -0.3], [0.0, 0.0, 1.4]);
        assert_eq!(first_crossing(&moving, up), None);
        let beside = ([1.2, 0.7, 0.3], [0.0, 0.0, -0.6]);
        assert_eq!(first_crossing(&moving, beside), None);
        // Exactly on the corner of the face.
        let corner = ([1.0, 1.0, 0.3], [0.0, 0.0, -0.6]);
        assert!(first_crossing(&moving, corner).is_some());
    }
}
