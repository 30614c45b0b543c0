//! Nodes of elements of several shapes, each found by its place.

use super::Shape;
use std::ops::Index;

/// A list of elements, or of other things with corners, in runs of one shape each. Indexed, it gives the nodes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Connectivity {
    runs: Vec<Run>,
    nodes: Vec<u32>,
    len: usize,
}

/// Elements of one shape that follow each other.
#[derive(Debug, Clone, PartialEq)]
struct Run {
    shape: Shape,
    /// Nodes of each.
    corners: usize,
    /// The first of them, and the place of its first corner among all.
    first: usize,
    start: usize,
}

impl Connectivity {
    /// Elements of one shape, given by the nodes of one after the other.
    pub fn of(shape: Shape, nodes: Vec<u32>) -> Connectivity {
        let len = nodes.len() / shape.corners();
        Connectivity { runs: vec![Run { shape, corners: shape.corners(), first: 0, start: 0 }], nodes, len }
    }

    /// An empty list with room for so many corners of all elements.
    pub fn with_room_for(corners: usize) -> Connectivity {
        Connectivity { nodes: Vec::with_capacity(corners), ..Connectivity::default() }
    }

    /// Adds an element with its nodes, of which there must be at least one: as many as its shape has corners, or more where
    /// other unknowns than positions are numbered behind them.
    pub fn push(&mut self, shape: Shape, nodes: impl IntoIterator<Item = u32>) {
        let start = self.nodes.len();
        self.nodes.extend(nodes);
        let corners = self.nodes.len() - start;
        if self.runs.last().is_none_or(|run| run.shape != shape || run.corners != corners) {
            self.runs.push(Run { shape, corners, first: self.len, start });
        }
        self.len += 1;
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// All corners, element by element.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// Shape of an element.
    pub fn shape(&self, element: usize) -> Shape {
        self.run(element).shape
    }

    /// Place of an element's first corner among all corners.
    #[inline]
    pub fn start(&self, element: usize) -> usize {
        let run = self.run(element);
        run.start + (element - run.first) * run.corners
    }

    /// The element that has a corner at this place among all corners, and which corner that is.
    pub fn corner(&self, place: usize) -> (usize, usize) {
        let run = &self.runs[self.runs.partition_point(|run| run.start <= place) - 1];
        let (behind, corners) = (place - run.start, run.corners);
        (run.first + behind / corners, behind % corners)
    }

    /// The nodes of each element.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> + Clone {
        self.shaped().map(|(_, nodes)| nodes)
    }

    /// Shape and nodes of each element.
    pub fn shaped(&self) -> impl Iterator<Item = (Shape, &[u32])> + Clone {
        let ends = self.runs.iter().skip(1).map(|run| run.start).chain([self.nodes.len()]);
        self.runs
            .iter()
            .zip(ends)
            .flat_map(|(run, end)| self.nodes[run.start..end].chunks_exact(run.corners).map(|nodes| (run.shape, nodes)))
    }

    #[inline]
    fn run(&self, element: usize) -> &Run {
        &self.runs[self.runs.partition_point(|run| run.first <= element) - 1]
    }
}

impl Index<usize> for Connectivity {
    type Output = [u32];

    #[inline]
    fn index(&self, element: usize) -> &[u32] {
        let run = self.run(element);
        &self.nodes[run.start + (element - run.first) * run.corners..][..run.corners]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_of_several_shapes_are_found_by_their_places() {
        let mut list = Connectivity::default();
        let elements: [(Shape, &[u32]); 5] = [
            (Shape::Bar, &[7, 8]),
            (Shape::Bar, &[8, 9]),
            (Shape::Quadrilateral, &[0, 1, 2, 3]),
            (Shape::Hexahedron, &[0, 1, 2, 3, 4, 5, 6, 7]),
            (Shape::Bar, &[1, 5]),
        ];
        elements.iter().for_each(|(shape, nodes)| list.push(*shape, nodes.iter().copied()));
        assert_eq!(list.len(), 5);
        assert!(list.shaped().eq(elements));
        for (place, (shape, nodes)) in elements.into_iter().enumerate() {
            assert_eq!((list.shape(place), &list[place]), (shape, nodes));
            assert_eq!(&list.nodes()[list.start(place)..][..nodes.len()], nodes);
            (0..nodes.len()).for_each(|i| assert_eq!(list.corner(list.start(place) + i), (place, i)));
        }
    }
}
