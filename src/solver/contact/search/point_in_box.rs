//! Swegle's point-in-box search: nodes sorted along each axis, and for each face the nodes in all three of its intervals.

use super::sizes::{ORDINARY, Sizes, UNSOUND, present};
use super::{Box3, Candidates, Search, lowest_start};
use std::ops::Range;

/// The search of Swegle et al. (1993), with lists of positions replaced by ranks. It needs seven words per node: their
/// order along each axis, their ranks in these orders, and one word more. Nodes of unusually long reach are searched for
/// apart, four times longer reaches at a time.
#[derive(Debug, Default)]
pub struct PointInBox {
    sizes: Sizes,
    classes: Vec<u8>,
    sorted: Sorted,
}

/// Nodes in order of the low corners of their boxes.
#[derive(Debug, Default)]
struct Sorted {
    /// Nodes by coordinate, for each axis.
    order: [Vec<u32>; 3],
    /// Place of each node in each order.
    rank: [Vec<u32>; 3],
    /// Longest of the nodes' boxes along each axis.
    extent: [f64; 3],
}

impl Sorted {
    fn fill(&mut self, nodes: &[Box3], chosen: impl Fn(u32) -> bool) {
        for axis in 0..3 {
            let (order, rank) = (&mut self.order[axis], &mut self.rank[axis]);
            order.clear();
            order.extend((0..nodes.len() as u32).filter(|node| chosen(*node)));
            let low = |node: &u32| nodes[*node as usize].low[axis];
            order.sort_unstable_by(|one, other| low(one).total_cmp(&low(other)).then(one.cmp(other)));
            rank.resize(nodes.len(), 0);
            order.iter().zip(0..).for_each(|(node, place)| rank[*node as usize] = place);
            let length = |node: &u32| nodes[*node as usize].high[axis] - low(node);
            self.extent[axis] = order.iter().map(length).fold(0.0, f64::max);
        }
    }

    /// The places of the nodes that a box can touch as far as one axis can tell.
    fn interval(&self, nodes: &[Box3], of: &Box3, axis: usize) -> Range<u32> {
        let order = &self.order[axis];
        let low = |node: &u32| nodes[*node as usize].low[axis];
        let start = lowest_start(of.low[axis], self.extent[axis]);
        let first = order.partition_point(|node| low(node) < start);
        let count = order[first..].partition_point(|node| low(node) <= of.high[axis]);
        first as u32..(first + count) as u32
    }

    /// Visits the nodes in all three intervals of a box.
    fn visit(&self, nodes: &[Box3], of: &Box3, mut visit: impl FnMut(u32)) {
        let intervals = [0, 1, 2].map(|axis| self.interval(nodes, of, axis));
        let shortest = if intervals[1].len() < intervals[0].len() { 1 } else { 0 };
        let shortest = if intervals[2].len() < intervals[shortest].len() { 2 } else { shortest };
        let [second, third] = [(shortest + 1) % 3, (shortest + 2) % 3];
        let list = intervals[shortest].start as usize..intervals[shortest].end as usize;
        for &node in &self.order[shortest][list] {
            if intervals[second].contains(&self.rank[second][node as usize])
                && intervals[third].contains(&self.rank[third][node as usize])
            {
                visit(node);
            }
        }
    }
}

impl Search for PointInBox {
    fn find(&mut self, nodes: &[Box3], faces: &[Box3], connectivity: &[[u32; 4]], found: &mut Candidates) {
        found.clear();
        self.sizes.measure(faces);
        self.sizes.classes(nodes, &mut self.classes);
        // Reaches below the size of a face hardly make its box larger.
        let classes = &mut self.classes;
        classes.iter_mut().filter(|class| **class < ORDINARY).for_each(|class| *class = ORDINARY - 1);
        for (class, _) in (0..UNSOUND).zip(present(classes)).filter(|(_, present)| *present) {
            self.sorted.fill(nodes, |node| classes[node as usize] == class);
            for (face, of) in (0..).zip(faces).filter(|(_, of)| of.is_sound()) {
                self.sorted.visit(nodes, of, |node| {
                    if nodes[node as usize].overlaps(of) {
                        found.push(node, face, &connectivity[face as usize]);
                    }
                });
            }
        }
        found.sort_by_node(nodes.len());
    }

    fn name(&self) -> &'static str {
        "point in box"
    }
}
