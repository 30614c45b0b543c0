//! The faces of contact.

use super::grown_together::GrownTogether;
use super::motion::NodeMotion;
use super::projection::area_normal;
use super::sides::{HiddenSide, HiddenSides};
use super::surface::{back_nodes, face_nodes};
use crate::common::shared::Shared;
use crate::common::vector::{dot, normalized, subtract};
use crate::mesh::Connectivity;

/// Most factors of √2 by which a depth becomes less: to 0.6 % of that at the start.
pub const THINNEST: u8 = 15;

/// A surface is thick against its elements when two thicknesses of its sides make more than this part of a face.
pub(super) const THICK: f64 = 0.7;

/// Faces around a point whose normals have a larger cosine between them, all of them, make a side of the body there.
const NEARLY_THE_SAME_WAY: f64 = 0.8;

/// Half of the thickness of an element between a face and the side across from it, along the normal of the face; 0 for a face
/// without area.
pub fn half_thickness(front: [[f64; 3]; 4], back: [[f64; 3]; 4]) -> f64 {
    let normal = area_normal(&front);
    let area = dot(normal, normal).sqrt();
    let through = subtract(super::projection::centre(&front), super::projection::centre(&back));
    if area > 0.0 { 0.5 * (dot(through, normal) / area).abs() } else { 0.0 }
}

/// Faces that points may touch, in ascending order of their numbers. What does not change is shared by copies: ranks of one process
/// have one surface.
#[derive(Debug, Clone, Default)]
pub struct Faces {
    /// Number in the whole body: 6 × canonical element + side.
    pub number: Shared<u32>,
    /// Corner points, counter-clockwise seen from outside.
    pub corners: Shared<[u32; 4]>,
    /// Index of the mesh block.
    pub block: Shared<u32>,
    /// Square root of the area at the start, a length.
    pub size: Shared<f64>,
    /// A point deeper than this behind a face did not come through it: half the element, as it is now where it has become
    /// thinner, to the nearest factor of √2. A length.
    pub depth: Vec<f64>,
    /// Distance in front of the face at which it is touched: half the thickness of a shell, 0 on solids. A length.
    pub reach: Shared<f64>,
    /// Distance from each point at which it touches: half the thickness of its thickest shell, the radius of a bar. A length.
    pub node_reach: Shared<f64>,
    /// Part of the distance at which they touch for which the mesh leaves room at each point; empty where there is room for all.
    room: Shared<f64>,
    /// Points and faces of thick surfaces that lie nearer to each other along the surface than they touch; none in a subset, whose
    /// candidates are found.
    grown_together: GrownTogether,
    /// Whether the face is one of both sides of a surface.
    two_sided: Shared<bool>,
    /// Which of its edges are on the border of the surface, a bit for each corner at which one begins.
    borders: Shared<u8>,
    /// How the body goes on at the borders of side sets.
    hidden_sides: HiddenSides,
    /// The same depth at the start.
    start_depth: Shared<f64>,
    /// How often the depth has become less by a factor of √2 since then.
    thinning: Vec<u8>,
    /// Faces around each point: `around[first[p]..first[p + 1]]`.
    first: Shared<u32>,
    around: Shared<u32>,
    /// Element nodes of each face as points, `u32::MAX` for nodes that are none.
    element: Shared<[u32; 8]>,
    /// Around which of its corners all faces looked nearly the same way at the start, a bit each.
    amid_side: Shared<u8>,
}

impl Faces {
    /// Takes faces in by their numbers from the nodes and blocks of the elements and the initial positions; `point`
    /// gives the point of a node of the mesh, `reach` the distance at which an element is touched.
    pub fn new(
        numbers: &[u32],
        (elements, blocks, positions): (&Connectivity, &[u32], &[[f64; 3]]),
        (point, points): (impl Fn(u32) -> u32, usize),
        reach: impl Fn(u32) -> f64,
    ) -> Faces {
        let nodes_of = |number: &u32| face_nodes(elements, *number);
        let element_of = |number: &u32| *number as usize / 6;
        let at = |nodes: [u32; 4]| nodes.map(|n| positions[n as usize]);
        let area = |number: &u32| {
            let normal = area_normal(&at(nodes_of(number)));
            dot(normal, normal).sqrt()
        };
        let is_two_sided = |number: &u32| elements.shape(element_of(number)).is_surface();
        let start_depth = |number: &u32| match is_two_sided(number) {
            // History says on which side a point is, so that it may be deep.
            true => (0.5 * area(number).sqrt()).max(2.0 * reach(number / 6)),
            false => half_thickness(at(nodes_of(number)), at(back_nodes(elements, *number))),
        };
        let of_element = |number: &u32| {
            let mut points = [u32::MAX; 8];
            points.iter_mut().zip(&elements[element_of(number)]).for_each(|(place, &node)| *place = point(node));
            points
        };
        let start_depth: Shared<f64> = numbers.iter().map(start_depth).collect();
        let mut faces = Faces {
            corners: numbers.iter().map(|number| nodes_of(number).map(&point)).collect(),
            block: numbers.iter().map(|number| blocks[element_of(number)]).collect(),
            size: numbers.iter().map(|number| area(number).sqrt()).collect(),
            depth: start_depth.to_vec(),
            reach: numbers.iter().map(|number| reach(number / 6)).collect(),
            two_sided: numbers.iter().map(is_two_sided).collect(),
            thinning: vec![0; numbers.len()],
            element: numbers.iter().map(of_element).collect(),
            number: numbers.to_vec().into(),
            start_depth,
            ..Default::default()
        };
        faces.connect(points);
        faces.borders = (0..faces.len() as u32).map(|face| faces.find_borders(face)).collect();
        let thickest =
            |point: u32| faces.around(point).iter().map(|&face| faces.reach[face as usize]).fold(0.0, f64::max);
        faces.node_reach = (0..points as u32).map(thickest).collect();
        let normals: Vec<[f64; 3]> =
            numbers.iter().map(|number| normalized(area_normal(&at(nodes_of(number)))).unwrap_or_default()).collect();
        faces.amid_side = (0..faces.len() as u32).map(|face| faces.find_amid_side(face, &normals)).collect();
        faces
    }

    /// Some of these faces, ascending; `point` gives the new numbers of points, of which there are `points`.
    pub fn subset(&self, chosen: &[u32], point: impl Fn(u32) -> u32, points: usize) -> Faces {
        let element = |of: [u32; 8]| of.map(|node| if node == u32::MAX { node } else { point(node) });
        let mut some = Faces {
            number: chosen_of(&self.number, chosen),
            corners: chosen.iter().map(|&face| self.corners[face as usize].map(&point)).collect(),
            block: chosen_of(&self.block, chosen),
            size: chosen_of(&self.size, chosen),
            depth: chosen_of(&self.depth, chosen),
            start_depth: chosen_of(&self.start_depth, chosen),
            reach: chosen_of(&self.reach, chosen),
            two_sided: chosen_of(&self.two_sided, chosen),
            borders: chosen_of(&self.borders, chosen),
            amid_side: chosen_of(&self.amid_side, chosen),
            hidden_sides: self.hidden_sides.subset(chosen),
            thinning: chosen_of(&self.thinning, chosen),
            element: chosen.iter().map(|&face| element(self.element[face as usize])).collect(),
            node_reach: vec![0.0; points].into(),
            ..Faces::default()
        };
        for (old, &reach) in (0..).zip(&self.node_reach).filter(|(_, reach)| **reach > 0.0) {
            if let Some(place) = some.node_reach.get_mut(point(old) as usize) {
                *place = reach;
            }
        }
        for (old, &part) in (0..).zip(&self.room).filter(|(_, part)| **part < 1.0) {
            some.limit_room(point(old), part);
        }
        some.connect(points);
        some
    }

    /// Says how the body goes on at the borders of side sets.
    pub fn set_hidden_sides(&mut self, sides: HiddenSides) {
        self.hidden_sides = sides;
    }

    /// The sides of the body at the edges of a face that are no faces of contact, at the present state.
    pub fn hidden_sides(&self, face: u32, motion: &NodeMotion) -> impl Iterator<Item = HiddenSide> + '_ {
        self.hidden_sides.at(face, move || (self.corners[face as usize], self.start(face, motion)))
    }

    /// How often the depth of a face has become less by a factor of √2, at most [`THINNEST`].
    pub fn thinning(&self, face: u32) -> u8 {
        self.thinning[face as usize]
    }

    /// Sets the depth of a face to that of the start less so many factors of √2. Whether it has become deeper.
    pub fn set_thinning(&mut self, face: u32, thinning: u8) -> bool {
        let face = face as usize;
        let before = std::mem::replace(&mut self.thinning[face], thinning);
        self.depth[face] = self.start_depth[face] * libm::exp2(-0.5 * f64::from(thinning));
        thinning < before
    }

    /// The thinning of a face whose element is so thick now that half of it is `depth`. It follows an element that becomes thicker
    /// again late, lest it change to and fro.
    pub fn thinning_at(&self, face: u32, depth: f64) -> u8 {
        let (start, now) = (self.start_depth[face as usize], self.thinning[face as usize]);
        if start <= 0.0 || depth.is_nan() {
            return now;
        }
        let exact = -2.0 * libm::log2(depth / start);
        let next = (exact - 0.5).ceil().clamp(0.0, f64::from(THINNEST)) as u8;
        if next > now || exact + 1.0 < f64::from(now) { next } else { now }
    }

    /// The outer faces of a face's element, itself included.
    pub fn of_same_element(&self, face: u32) -> impl Iterator<Item = u32> + '_ {
        let same = move |other: &u32| self.number[*other as usize] / 6 == self.number[face as usize] / 6;
        (0..face).rev().take_while(same).chain((face..self.len() as u32).take_while(same))
    }

    /// Number of faces.
    pub fn len(&self) -> usize {
        self.number.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.number.is_empty()
    }

    fn connect(&mut self, points: usize) {
        let mut first = vec![0; points + 1];
        let pairs = || self.corners.iter().zip(0u32..).flat_map(|(corners, face)| corners.map(|point| (point, face)));
        for (point, _) in pairs() {
            first[point as usize + 1] += 1;
        }
        for i in 0..points {
            first[i + 1] += first[i];
        }
        let mut next = first.clone();
        let mut around = vec![0; 4 * self.corners.len()];
        for (point, face) in pairs() {
            around[next[point as usize] as usize] = face;
            next[point as usize] += 1;
        }
        (self.first, self.around) = (first.into(), around.into());
    }

    /// See [`Faces::borders_of`].
    fn find_borders(&self, face: u32) -> u8 {
        let corners = self.corners[face as usize];
        let goes_on = |a: u32, b: u32| {
            let there = |&other: &u32| self.corners[other as usize].contains(&b);
            self.around(a)
                .iter()
                .filter(|other| there(other))
                .any(|&other| self.number[other as usize] / 6 != self.number[face as usize] / 6)
        };
        let is_border = |i: &usize| {
            let (a, b) = (corners[*i], corners[(*i + 1) % 4]);
            a != b && !goes_on(a, b)
        };
        if self.two_sided[face as usize] { (0..4).filter(is_border).fold(0, |borders, i| borders | 1 << i) } else { 0 }
    }

    /// See [`Faces::is_amid_side`]; `normals` are those of all faces.
    fn find_amid_side(&self, face: u32, normals: &[[f64; 3]]) -> u8 {
        let look_alike = |[a, b]: [u32; 2]| dot(normals[a as usize], normals[b as usize]) > NEARLY_THE_SAME_WAY;
        let is_amid = |corner: &usize| {
            let around = self.around(self.corners[face as usize][*corner]);
            around.iter().all(|&a| around.iter().all(|&b| look_alike([a, b])))
        };
        (0..4).filter(is_amid).fold(0, |corners, corner| corners | 1 << corner)
    }

    /// Edges of one side of a surface at which no other element goes on: bit i for that from corner i to the next.
    pub fn borders_of(&self, face: u32) -> u8 {
        self.borders[face as usize]
    }

    /// Faces with this point as a corner.
    pub fn around(&self, point: u32) -> &[u32] {
        &self.around[self.first[point as usize] as usize..self.first[point as usize + 1] as usize]
    }

    /// Whether a point was in the middle of a side of its body at the start: neither on an edge of it nor in a corner.
    pub fn is_amid_side(&self, point: u32) -> bool {
        self.around(point).first().is_some_and(|&face| {
            let is_there = |corner: &usize| self.corners[face as usize][*corner] == point;
            (0..4).find(is_there).is_some_and(|corner| self.amid_side[face as usize] >> corner & 1 == 1)
        })
    }

    /// Whether the point is a node of the face's element: never a contact, however crushed the element.
    pub fn same_element(&self, face: u32, point: u32) -> bool {
        self.element[face as usize].contains(&point)
    }

    /// Whether a face is one of both sides of a surface: then its element's other face looks the other way, at the same place.
    pub fn is_two_sided(&self, face: u32) -> bool {
        self.two_sided[face as usize]
    }

    /// Distance between a point and a face at which they touch, a length.
    #[inline]
    pub fn distance(&self, point: u32, face: u32) -> f64 {
        self.node_reach[point as usize] + self.reach[face as usize]
    }

    /// Says for what part of the distance at which it touches a point has room; one that is not there is passed over.
    pub fn limit_room(&mut self, point: u32, part: f64) {
        let points = self.node_reach.len();
        if (point as usize) < points {
            self.room.resize(points, 1.0);
            self.room[point as usize] = part;
        }
    }

    /// How near a point beside a face comes to its border before that is in its way, a length. What the mesh has put nearer to something
    /// than they touch is as thin to what comes from beside: with its whole thickness it would be stopped by the next node of what it lies on.
    pub fn rim(&self, point: u32, face: u32) -> f64 {
        self.least_room(self.corners[face as usize].into_iter().chain([point])) * self.distance(point, face)
    }

    /// The least part of the distance at which they touch for which the mesh leaves room at some points.
    pub fn least_room(&self, points: impl IntoIterator<Item = u32>) -> f64 {
        let room = |point: u32| self.room.get(point as usize).copied().unwrap_or(1.0);
        points.into_iter().map(room).fold(1.0, f64::min)
    }

    /// Depth behind a face at the start, a length, which it never exceeds.
    pub fn start_depth(&self, face: u32) -> f64 {
        self.start_depth[face as usize]
    }

    /// How far around its corners a face looks at most for points that it may meet, a length: behind solids for those that began
    /// there, in front of surfaces, `kept` being the part of the depth that a point may leave them.
    pub fn margin(&self, face: u32, kept: f64) -> f64 {
        let (depth, reach) = (self.start_depth[face as usize], self.reach[face as usize]);
        if self.is_two_sided(face) { kept * depth + reach } else { depth + reach }
    }

    /// Whether a point is on a surface, which looks both ways.
    pub fn is_on_surface(&self, point: u32) -> bool {
        self.around(point).iter().any(|&face| self.is_two_sided(face))
    }

    /// Finds what is [`Faces::grown_together`] beyond the next face; `positions` are those of the points at the start.
    pub fn grow_together(&mut self, positions: impl FnOnce() -> Vec<[f64; 3]>) {
        if self.two_sided.contains(&true) {
            self.grown_together = GrownTogether::of(self, &positions());
        }
    }

    /// Whether a face is so near to a point along the surface, and the surface so thick, that they would always touch: across a
    /// node where the surface is thicker than most of an element, or farther away and within its reach at the start.
    pub fn grown_together(&self, point: u32, face: u32) -> bool {
        let distance = self.distance(point, face);
        let is_next = || self.around(point).iter().any(|&own| self.adjacent(own, face));
        (distance > THICK * self.size[face as usize] && is_next()) || self.grown_together.contains(point, face)
    }

    /// Whether two faces with a common edge look the same way across it, as neighbours on one side of a surface do: they run
    /// along it in opposite directions. Both sides of one element look opposite ways, although they run around it so. `None` for
    /// faces that have no edge in common.
    pub fn go_on(&self, a: u32, b: u32) -> Option<bool> {
        if self.number[a as usize] / 6 == self.number[b as usize] / 6 {
            return Some(false);
        }
        let (a, b) = (self.corners[a as usize], self.corners[b as usize]);
        let runs = |of: [u32; 4], from: u32, to: u32| (0..4).any(|i| of[i] == from && of[(i + 1) % 4] == to);
        let ways = (0..4).map(|i| (a[i], a[(i + 1) % 4])).filter(|(from, to)| from != to);
        ways.filter_map(|(from, to)| match (runs(b, to, from), runs(b, from, to)) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        })
        .next()
    }

    /// Whether two faces have a corner in common.
    pub fn adjacent(&self, a: u32, b: u32) -> bool {
        let other = self.corners[b as usize];
        self.corners[a as usize].iter().any(|corner| other.contains(corner))
    }

    /// Corner positions at the present state.
    #[inline]
    pub fn start(&self, face: u32, motion: &NodeMotion) -> [[f64; 3]; 4] {
        // Written out, as `map` would be a call for every corner.
        let [a, b, c, d] = self.corners[face as usize];
        [motion.start(a), motion.start(b), motion.start(c), motion.start(d)]
    }

    /// Corner positions at the end of the step without contact.
    #[inline]
    pub fn end(&self, face: u32, motion: &NodeMotion) -> [[f64; 3]; 4] {
        let [a, b, c, d] = self.corners[face as usize];
        [motion.end(a), motion.end(b), motion.end(c), motion.end(d)]
    }

    /// Sum of the area normals of the faces around a point: which way its body faces there.
    pub fn point_normal(&self, point: u32, motion: &NodeMotion) -> [f64; 3] {
        self.around(point).iter().fold([0.0; 3], |sum, &face| {
            let normal = area_normal(&self.start(face, motion));
            [sum[0] + normal[0], sum[1] + normal[1], sum[2] + normal[2]]
        })
    }
}

/// What a list of all faces has of those chosen.
fn chosen_of<T: Copy, L: FromIterator<T>>(all: &[T], chosen: &[u32]) -> L {
    chosen.iter().map(|&face| all[face as usize]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Shape;
    use crate::mesh::exterior::exterior;

    /// Two by two by two cubes: a point in the middle of each of six sides, in all faces and in those of one element.
    #[test]
    fn points_amid_sides_are_neither_on_edges_nor_in_corners() {
        let range = |n: u32| (0..n).flat_map(move |k| (0..n).flat_map(move |j| (0..n).map(move |i| [i, j, k])));
        let at: Vec<[f64; 3]> = range(3).map(|place| place.map(f64::from)).collect();
        let nodes = range(2).flat_map(|[i, j, k]| {
            let corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
            corners.map(|[a, b, c]| ((k + c) * 3 + j + b) * 3 + i + a)
        });
        let elements = Connectivity::of(Shape::Hexahedron, nodes.collect());
        let numbers = exterior(elements.shaped(), at.len(), |_| true);
        let faces = Faces::new(&numbers, (&elements, &[0; 8], &at), (|node| node, at.len()), |_| 0.0);
        let amid = |faces: &Faces| (0..27).filter(|&point| faces.is_amid_side(point)).collect::<Vec<u32>>();
        assert_eq!(amid(&faces), [4, 10, 12, 14, 16, 22]);
        assert_eq!(amid(&faces.subset(&[0, 1, 2], |point| point, 27)), [4, 10, 12]);
    }

    #[test]
    fn a_depth_follows_a_thinner_element_at_once_and_a_thicker_one_late() {
        let mut faces =
            Faces { start_depth: vec![1.0].into(), depth: vec![1.0], thinning: vec![0], ..Default::default() };
        let mut at = |depth: f64| {
            let thinning = faces.thinning_at(0, depth);
            faces.set_thinning(0, thinning);
            faces.depth[0]
        };
        assert_eq!(at(1.3), 1.0);
        assert_eq!(at(0.9), 1.0);
        assert_eq!(at(0.8), libm::exp2(-0.5));
        assert_eq!(at(0.99), libm::exp2(-0.5));
        assert_eq!(at(0.5), 0.5);
        assert_eq!(at(0.4), libm::exp2(-1.5));
        assert_eq!(at(0.45), libm::exp2(-1.5));
        assert_eq!(at(0.6), libm::exp2(-0.5));
        assert_eq!(at(1e-9), libm::exp2(-7.5));
        assert_eq!(at(f64::NAN), libm::exp2(-7.5));
    }
}
