//! How the nodes of one surface follow the faces of another that does not match: weights that hold the gap in the mean.
//!
//! A node that follows the point of a face where it happens to lie passes no patch test: the forces of a uniform pressure,
//! handed on by such weights, are not those that the pressure gives the other side. Weights that do both, follow every
//! linear field and hand on every uniform stress, come from asking that the gap vanishes in the mean over the surface, ∫
//! µ_s (x_s-side − x_m-side) dA = 0, with functions µ that are dual to the shape functions N of the following side
//! (Wohlmuth, "A mortar finite element method using dual spaces for the Lagrange multiplier", SIAM J. Numer. Anal. 38,
//! 2000): ∫ µ_s N_t dA = δ_st D_s. Then D_s x_s = Σ_I ∫ µ_s N_I dA x_I, node by node, without a system to solve.
//!
//! Where the surface turns at an edge no such functions are: a node there belongs to both sides, and what one of them exerts on
//! it would go to leaders of the other. The nodes of edges follow the point where they lie (`edges`), and only those beside them have a
//! multiplier. These add up to 1 on each face all the same, which is all that a uniform stress needs: the mean gap of the face is
//! zero, whatever moves its nodes.
//!
//! Integrals run over the pieces that pairs of faces have in common. Whatever the rule of integration, linear fields are
//! met exactly, because µ is made with the same points; uniform stress is handed on as exactly as the rule integrates N_I,
//! which is to round-off for parallelograms.

use super::edges::{self, Edges};
use crate::common::vector::{add, cross, dot, normalized, scaled, subtract};
use crate::solver::contact::geometry::projection::area_normal;
use std::collections::BTreeMap;

/// A node that follows others: its number, and theirs with their weights, which add up to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Follower {
    /// The node that follows.
    pub node: u32,
    /// The nodes that it follows, ascending.
    pub leaders: Vec<(u32, f64)>,
}

/// A face by its corners.
pub type Face = [u32; 4];

/// Symmetric rule with seven points in a triangle, exact for polynomials of degree five (Radon 1948): barycentric
/// coordinates and weights.
const TRIANGLE: [([f64; 3], f64); 7] = {
    const A: f64 = 0.470_142_064_105_115_1;
    const B: f64 = 0.101_286_507_323_456_34;
    const P: f64 = 0.132_394_152_788_506_2;
    const Q: f64 = 0.125_939_180_544_827_14;
    const T: f64 = 1.0 / 3.0;
    [
        ([T, T, T], 0.225),
        ([1.0 - 2.0 * A, A, A], P),
        ([A, 1.0 - 2.0 * A, A], P),
        ([A, A, 1.0 - 2.0 * A], P),
        ([1.0 - 2.0 * B, B, B], Q),
        ([B, 1.0 - 2.0 * B, B], Q),
        ([B, B, 1.0 - 2.0 * B], Q),
    ]
};

/// A part of a face that is less than this of it follows nothing.
const LEAST_COVER: f64 = 1e-3;

/// A point in the plane of a face.
pub(super) type Point = [f64; 2];

/// The plane of a face, with its corners in it.
pub(super) struct Plane {
    origin: [f64; 3],
    axes: [[f64; 3]; 2],
    pub normal: [f64; 3],
    area: f64,
}

impl Plane {
    pub fn of(corners: &[[f64; 3]; 4]) -> Option<Plane> {
        let area = area_normal(corners);
        let normal = normalized(area)?;
        let along = subtract(corners[1], corners[0]);
        let first = normalized(subtract(along, scaled(normal, dot(along, normal))))?;
        let origin = scaled(corners.iter().fold([0.0; 3], |sum, corner| add(sum, *corner)), 0.25);
        Some(Plane { origin, axes: [first, cross(normal, first)], normal, area: dot(area, normal) })
    }

    pub fn seen(&self, x: [f64; 3]) -> Point {
        let r = subtract(x, self.origin);
        [dot(r, self.axes[0]), dot(r, self.axes[1])]
    }

    fn height(&self, x: [f64; 3]) -> f64 {
        dot(subtract(x, self.origin), self.normal)
    }
}

/// Shape functions of a quadrilateral.
pub(super) fn shapes([x, y]: Point) -> [f64; 4] {
    [(1.0 - x) * (1.0 - y), (1.0 + x) * (1.0 - y), (1.0 + x) * (1.0 + y), (1.0 - x) * (1.0 + y)].map(|n| 0.25 * n)
}

fn interpolated(corners: &[Point; 4], n: &[f64; 4]) -> Point {
    [0, 1].map(|i| (0..4).map(|k| n[k] * corners[k][i]).sum())
}

/// Natural coordinates of a point of a quadrilateral, by Newton's method.
pub(super) fn natural(corners: &[Point; 4], at: Point) -> Point {
    let mut xi = [0.0; 2];
    for _ in 0..30 {
        let [x, y] = xi;
        let there = interpolated(corners, &shapes(xi));
        let by_x = [-(1.0 - y), 1.0 - y, 1.0 + y, -(1.0 + y)].map(|d| 0.25 * d);
        let by_y = [-(1.0 - x), -(1.0 + x), 1.0 + x, 1.0 - x].map(|d| 0.25 * d);
        let (a, b) = (interpolated(corners, &by_x), interpolated(corners, &by_y));
        let r = [at[0] - there[0], at[1] - there[1]];
        let determinant = a[0] * b[1] - a[1] * b[0];
        let change = [(r[0] * b[1] - r[1] * b[0]) / determinant, (a[0] * r[1] - a[1] * r[0]) / determinant];
        if !change.iter().all(|c| c.is_finite()) {
            break;
        }
        xi = [x + change[0], y + change[1]];
        if change[0].abs().max(change[1].abs()) < 1e-15 {
            break;
        }
    }
    xi
}

/// What two convex polygons, both counter-clockwise, have in common (Sutherland and Hodgman 1974).
fn common(subject: &[Point; 4], clip: &[Point; 4]) -> Vec<Point> {
    let mut left: Vec<Point> = subject.to_vec();
    for i in 0..4 {
        let (a, b) = (clip[i], clip[(i + 1) % 4]);
        let side = |p: Point| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        let all = std::mem::take(&mut left);
        for (k, &p) in all.iter().enumerate() {
            let q = all[(k + 1) % all.len()];
            let (here, there) = (side(p), side(q));
            if here >= 0.0 {
                left.push(p);
            }
            if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
                let s = here / (here - there);
                left.push([0, 1].map(|i| p[i] + s * (q[i] - p[i])));
            }
        }
    }
    left
}

/// Points of integration over a convex polygon, with their weights, areas.
fn points(polygon: &[Point]) -> Vec<(Point, f64)> {
    let Some(&first) = polygon.first() else { return Vec::new() };
    let count = polygon.len() as f64;
    let sum = polygon.iter().fold([0.0; 2], |sum, p| [sum[0] + (p[0] - first[0]), sum[1] + (p[1] - first[1])]);
    let middle = [first[0] + sum[0] / count, first[1] + sum[1] / count];
    let mut all = Vec::new();
    for (k, &p) in polygon.iter().enumerate() {
        let q = polygon[(k + 1) % polygon.len()];
        let (u, v) = ([p[0] - middle[0], p[1] - middle[1]], [q[0] - middle[0], q[1] - middle[1]]);
        let area = 0.5 * (u[0] * v[1] - u[1] * v[0]);
        all.extend(
            TRIANGLE
                .iter()
                .map(|([a, b, c], weight)| ([0, 1].map(|i| a * middle[i] + b * p[i] + c * q[i]), weight * area)),
        );
    }
    all
}

/// What is integrated over a face of the side that follows.
#[derive(Default)]
struct OfFace {
    /// ∫ N_s N_t
    own: [[f64; 4]; 4],
    /// ∫ N_s
    whole: [f64; 4],
    /// ∫ N_t N_I by the node I.
    others: BTreeMap<u32, [f64; 4]>,
}

impl OfFace {
    /// Adds what a face of the other side, seen in the plane of this one, has in common with it.
    fn meet(
        &mut self,
        (plane, corners): (&Plane, &[[f64; 3]; 4]),
        (face, others): (&Face, &[[f64; 3]; 4]),
        tolerance: f64,
    ) {
        let flat = corners.map(|x| plane.seen(x));
        // The other side runs the other way round.
        let turned = [others[3], others[2], others[1], others[0]];
        let nodes = [face[3], face[2], face[1], face[0]];
        let theirs = turned.map(|x| plane.seen(x));
        let polygon = common(&flat, &theirs);
        for (at, weight) in points(&polygon).into_iter().filter(|(_, weight)| *weight > 0.0) {
            let (n, m) = (shapes(natural(&flat, at)), shapes(natural(&theirs, at)));
            let place = |corners: &[[f64; 3]; 4], n: &[f64; 4]| {
                (0..4).fold([0.0; 3], |sum, k| add(sum, scaled(corners[k], n[k])))
            };
            let gap = plane.height(place(&turned, &m)) - plane.height(place(corners, &n));
            if gap.abs() > tolerance {
                continue;
            }
            for s in 0..4 {
                (0..4).for_each(|t| self.own[s][t] += weight * n[s] * n[t]);
                self.whole[s] += weight * n[s];
            }
            for (node, part) in nodes.iter().zip(m) {
                let sums = self.others.entry(*node).or_default();
                (0..4).for_each(|t| sums[t] += weight * n[t] * part);
            }
        }
    }

    /// A in µ = A N, so that ∫ µ_s N_t = δ_st ∫ N_s for all corners s and t that lie on no edge, and Σ µ_s = 1.
    ///
    /// The functions are combined of those of these corners, to which those of an edge are added, each to its neighbours.
    fn dual(&self, on_edge: [bool; 4]) -> Option<[[f64; 4]; 4]> {
        let functions = nalgebra::Matrix4::from_fn(|t, v| part_of(t, v, on_edge));
        let own = nalgebra::Matrix4::from_fn(|i, j| self.own[i][j]);
        let mut matrix = if on_edge.contains(&true) { functions * own } else { own };
        for edge in (0..4).filter(|&corner| on_edge[corner]) {
            (0..4).for_each(|other| (matrix[(edge, other)], matrix[(other, edge)]) = (0.0, 0.0));
            matrix[(edge, edge)] = 1.0;
        }
        let inverse = matrix.try_inverse()?;
        let combined = if on_edge.contains(&true) { inverse * functions } else { inverse };
        Some(std::array::from_fn(|s| std::array::from_fn(|t| self.whole[s] * combined[(s, t)])))
    }
}

/// How much of the function of corner v belongs to that of corner t: all of its own, and of a corner on an edge a share of each neighbour that
/// is not, or the corner across where there is none.
fn part_of(t: usize, v: usize, on_edge: [bool; 4]) -> f64 {
    let beside = |corner: usize| [(corner + 1) % 4, (corner + 3) % 4];
    match (on_edge[t], on_edge[v]) {
        (true, _) => 0.0,
        (false, false) => f64::from(u8::from(t == v)),
        (false, true) => {
            let near = beside(v).into_iter().filter(|&corner| !on_edge[corner]).count();
            let has = if near == 0 { t == (v + 2) % 4 } else { beside(v).contains(&t) };
            if has { 1.0 / near.max(1) as f64 } else { 0.0 }
        }
    }
}

/// Two surfaces that are joined.
#[derive(Debug, Clone, Default)]
pub struct Joint {
    /// Faces whose nodes follow, by their corners counter-clockwise from outside.
    pub following: Vec<Face>,
    /// Faces whose nodes they follow, in the same way.
    pub leading: Vec<Face>,
    /// How far apart they may be, as a part of the root of a face's area.
    pub tolerance: f64,
}

/// What is integrated around each node that follows: ∫ N_s, and ∫ µ_s N_I by the node I.
type Sums = BTreeMap<u32, (f64, BTreeMap<u32, f64>)>;

/// A face of the side that follows, with what it has in common with the other side.
pub(super) struct Covered {
    /// Place of its joint.
    pub joint: usize,
    pub face: Face,
    pub normal: [f64; 3],
    integrals: OfFace,
}

/// Lets nodes of the following faces of joints follow those of the leading ones that they face. A node of several joints follows the
/// leaders of all.
pub fn followers(joints: &[Joint], position: impl Fn(u32) -> [f64; 3]) -> Vec<Follower> {
    let covered: Vec<Covered> =
        joints.iter().enumerate().flat_map(|(place, joint)| integrate(place, joint, &position)).collect();
    let edges = edges::of(&covered, joints, &position);
    let mut sums = Sums::new();
    covered.iter().for_each(|face| share_out(face, &edges, &mut sums));
    let follower = |(node, (whole, leaders)): (u32, (f64, BTreeMap<u32, f64>))| {
        let least = 1e-12 * whole;
        let mut leaders: Vec<(u32, f64)> = leaders
            .into_iter()
            .filter(|(_, part)| part.abs() > least)
            .map(|(leader, part)| (leader, part / whole))
            .collect();
        let sum: f64 = leaders.iter().map(|(_, weight)| weight).sum();
        leaders.iter_mut().for_each(|(_, weight)| *weight /= sum);
        Follower { node, leaders }
    };
    let inside = sums.into_iter().map(follower).filter(|follower| !follower.leaders.is_empty());
    let on_edges = edges.iter().map(|(&node, leaders)| Follower { node, leaders: leaders.clone() });
    let mut all: Vec<Follower> = inside.chain(on_edges).collect();
    all.sort_by_key(|follower| follower.node);
    all
}

/// Adds what a face asks of its nodes that are on no edge: that the gap vanishes in the mean, with what those on edges do of themselves.
fn share_out(Covered { face, integrals, .. }: &Covered, edges: &Edges, sums: &mut Sums) {
    let on_edge = face.map(|node| edges.contains_key(&node));
    let Some(dual) = integrals.dual(on_edge) else { return };
    for (s, &node) in face.iter().enumerate().filter(|(s, _)| !on_edge[*s]) {
        let (whole, leaders) = sums.entry(node).or_default();
        *whole += integrals.whole[s];
        for (&leader, parts) in &integrals.others {
            *leaders.entry(leader).or_default() += (0..4).map(|t| dual[s][t] * parts[t]).sum::<f64>();
        }
        for (e, node) in face.iter().enumerate() {
            let Some(followed) = edges.get(node) else { continue };
            let part: f64 = (0..4).map(|t| dual[s][t] * integrals.own[t][e]).sum();
            followed.iter().for_each(|(leader, weight)| *leaders.entry(*leader).or_default() -= part * weight);
        }
    }
}

/// Integrates over what the faces of a joint have in common.
fn integrate(place: usize, joint: &Joint, position: impl Fn(u32) -> [f64; 3]) -> Vec<Covered> {
    let mut covered = Vec::new();
    let Joint { following, leading, tolerance } = joint;
    let corners = |face: &Face| face.map(&position);
    let extent = |corners: &[[f64; 3]; 4], axis: usize| {
        let along = corners.map(|x| x[axis]);
        [along.iter().copied().fold(f64::INFINITY, f64::min), along.iter().copied().fold(f64::NEG_INFINITY, f64::max)]
    };
    // Those of the other side by where they begin along x.
    let mut others: Vec<(f64, usize)> =
        leading.iter().enumerate().map(|(i, face)| (extent(&corners(face), 0)[0], i)).collect();
    others.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let longest = leading.iter().map(|face| extent(&corners(face), 0)).fold(0.0, |most, [a, b]| f64::max(most, b - a));
    for face in following {
        let own = corners(face);
        let Some(plane) = Plane::of(&own) else { continue };
        let room = tolerance * plane.area.sqrt();
        let boxes = [0, 1, 2].map(|axis| extent(&own, axis));
        let first = others.partition_point(|(x, _)| *x < boxes[0][0] - room - longest);
        let mut of_face = OfFace::default();
        for (_, other) in others[first..].iter().take_while(|(x, _)| *x <= boxes[0][1] + room) {
            let other = &leading[*other];
            let theirs = corners(other);
            let meets = |axis: usize| {
                let [low, high] = extent(&theirs, axis);
                low <= boxes[axis][1] + room && high >= boxes[axis][0] - room
            };
            let opposed = Plane::of(&theirs).is_some_and(|other| dot(other.normal, plane.normal) < -0.5);
            if (0..3).all(meets) && opposed {
                of_face.meet((&plane, &own), (other, &theirs), room);
            }
        }
        if of_face.whole.iter().sum::<f64>() < LEAST_COVER * plane.area {
            continue;
        }
        covered.push(Covered { joint: place, face: *face, normal: plane.normal, integrals: of_face });
    }
    covered
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of n × n faces over the unit square at z = 0, numbers from `first`; its corners with the normal up or down.
    fn grid(n: u32, first: u32, up: bool) -> (Vec<[f64; 3]>, Vec<Face>) {
        let at = |i: u32| f64::from(i) / f64::from(n);
        let places = (0..(n + 1) * (n + 1)).map(|k| [at(k % (n + 1)), at(k / (n + 1)), 0.0]).collect();
        let node = |i: u32, j: u32| first + i + j * (n + 1);
        let faces = (0..n * n).map(|k| {
            let (i, j) = (k % n, k / n);
            let face = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            if up { face } else { [face[0], face[3], face[2], face[1]] }
        });
        (places, faces.collect())
    }

    #[test]
    fn linear_fields_are_followed_and_uniform_pressure_is_handed_on() {
        for (n, m) in [(4, 3), (3, 4), (2, 5)] {
            let ((mut places, own), (others, leading)) = (grid(n, 0, true), grid(m, (n + 1) * (n + 1), false));
            places.extend(others);
            let joint = Joint { following: own, leading, tolerance: 0.05 };
            let found = followers(&[joint], |node| places[node as usize]);
            assert_eq!(found.len(), ((n + 1) * (n + 1)) as usize);
            let mut handed = vec![0.0; places.len()];
            for follower in &found {
                for axis in 0..2 {
                    let there: f64 = follower.leaders.iter().map(|(node, w)| w * places[*node as usize][axis]).sum();
                    assert!((there - places[follower.node as usize][axis]).abs() < 1e-13, "{follower:?}");
                }
                // A quarter of each face around it.
                let edges = |x: f64| if x == 0.0 || x == 1.0 { 0.5 } else { 1.0 };
                let [x, y, _] = places[follower.node as usize];
                let force = edges(x) * edges(y) / f64::from(n * n);
                follower.leaders.iter().for_each(|(node, w)| handed[*node as usize] += w * force);
            }
            for (node, force) in handed.iter().enumerate().skip(((n + 1) * (n + 1)) as usize) {
                let edges = |x: f64| if x == 0.0 || x == 1.0 { 0.5 } else { 1.0 };
                let expected = edges(places[node][0]) * edges(places[node][1]) / f64::from(m * m);
                assert!((force - expected).abs() < 1e-14, "{force} is not {expected}");
            }
        }
    }

    /// The sides z = 0 of a cube of n elements along each edge, x = 0 and y = 0, as faces whose nodes are shared; numbers from `first`.
    fn corner(n: u32, first: u32, sides: usize, outward: bool) -> (Vec<[f64; 3]>, Vec<Vec<Face>>) {
        let at = |i: u32| f64::from(i) / f64::from(n);
        let node = |p: [u32; 3]| first + p[0] + (n + 1) * (p[1] + (n + 1) * p[2]);
        let places = (0..(n + 1).pow(3)).map(|k| [at(k % (n + 1)), at(k / (n + 1) % (n + 1)), at(k / (n + 1).pow(2))]);
        let side = |axis: usize| {
            let faces = (0..n * n).map(|k| {
                let corner = |a: u32, b: u32| {
                    let mut p = [0; 3];
                    (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (k % n + a, k / n + b);
                    node(p)
                };
                let face = [corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)];
                if outward { face } else { [face[0], face[3], face[2], face[1]] }
            });
            faces.collect()
        };
        (places.collect(), (0..sides).map(side).collect())
    }

    /// A cube in a corner of two or three walls, tied to all, whether by a command for each or in one: each side's uniform stress goes to the
    /// leaders of that side, and what is linear is followed.
    #[test]
    fn a_corner_hands_on_the_stress_of_each_side() {
        for (n, m, sides, single) in
            [(4, 3, 2, false), (3, 4, 2, false), (5, 2, 3, false), (2, 5, 3, false), (3, 4, 3, true), (3, 3, 2, true)]
        {
            let (mut places, following) = corner(n, 0, sides, true);
            let begin = places.len();
            let (others, leading) = corner(m, begin as u32, sides, false);
            places.extend(others);
            let joint = |following: Vec<Face>, leading: Vec<Face>| Joint { following, leading, tolerance: 0.05 };
            let joints: Vec<Joint> = if single {
                vec![joint(following.concat(), leading.concat())]
            } else {
                following.iter().cloned().zip(leading.iter().cloned()).map(|(a, b)| joint(a, b)).collect()
            };
            let found = followers(&joints, |node| places[node as usize]);
            for one in &found {
                for axis in 0..3 {
                    let there: f64 = one.leaders.iter().map(|(node, w)| w * places[*node as usize][axis]).sum();
                    assert!((there - places[one.node as usize][axis]).abs() < 1e-13, "{n} on {m}: {one:?}");
                }
            }
            // A quarter of each face around a node.
            let of_side = |faces: &[Face], n: u32| {
                let mut areas = vec![0.0; places.len()];
                faces.iter().flatten().for_each(|&node| areas[node as usize] += 0.25 / f64::from(n * n));
                areas
            };
            for side in 0..sides {
                let (from, to) = (of_side(&following[side], n), of_side(&leading[side], m));
                let mut handed = vec![0.0; places.len()];
                for one in &found {
                    one.leaders.iter().for_each(|(node, w)| handed[*node as usize] += w * from[one.node as usize]);
                }
                for node in begin..places.len() {
                    assert!(
                        (handed[node] - to[node]).abs() < 1e-14,
                        "{n} on {m}, side {side} of {sides}, {:?}: {} is not {}",
                        places[node],
                        handed[node],
                        to[node]
                    );
                }
            }
        }
    }

    #[test]
    fn what_is_too_far_away_is_not_followed() {
        let ((mut places, own), (others, leading)) = (grid(2, 0, true), grid(2, 9, false));
        places.extend(others.iter().map(|x| [x[0], x[1], 0.1]));
        let mut joint = Joint { following: own, leading, tolerance: 0.05 };
        assert!(followers(std::slice::from_ref(&joint), |node| places[node as usize]).is_empty());
        joint.tolerance = 0.5;
        assert_eq!(followers(&[joint], |node| places[node as usize]).len(), 9);
    }
}
