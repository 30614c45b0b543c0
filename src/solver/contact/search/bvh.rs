//! The search by a tree of boxes: faces along a space-filling curve, in groups of eight, these in groups of eight, and so
//! on. Each node goes down the tree.

use super::{Box3, Candidates, Search};
use crate::partition::space_filling_order;

/// Boxes in a group.
const WIDTH: usize = 8;
/// Growth of the groups' boxes since the faces were last ordered, at which they are ordered anew.
const WORN: f64 = 1.2;

/// A tree of boxes around the faces. Their order along the curve is kept from call to call, and renewed when motion has
/// worn it.
#[derive(Debug, Default)]
pub struct Bvh {
    order: Vec<u32>,
    /// Mean extent of the groups of faces when they were ordered, in mean extents of the faces.
    looseness: f64,
    /// Groups of boxes from the faces up to the root, the last.
    groups: Vec<Group>,
    /// Index of the first group of each level, and of the end.
    levels: Vec<usize>,
    waiting: Vec<(usize, usize)>,
}

/// Eight boxes side by side: coordinates by axis.
#[derive(Debug, Clone, Copy)]
struct Group {
    low: [[f64; WIDTH]; 3],
    high: [[f64; WIDTH]; 3],
}

impl Group {
    const EMPTY: Group = Group { low: [[f64::INFINITY; WIDTH]; 3], high: [[f64::NEG_INFINITY; WIDTH]; 3] };

    fn of(boxes: impl Iterator<Item = Box3>) -> Group {
        let mut group = Group::EMPTY;
        for (lane, one) in boxes.enumerate() {
            for axis in 0..3 {
                group.low[axis][lane] = one.low[axis];
                group.high[axis][lane] = one.high[axis];
            }
        }
        group
    }

    fn bounds(&self) -> Box3 {
        Box3 {
            low: self.low.map(|lanes| lanes.into_iter().fold(f64::INFINITY, f64::min)),
            high: self.high.map(|lanes| lanes.into_iter().fold(f64::NEG_INFINITY, f64::max)),
        }
    }

    /// Which of the boxes overlap `of`, a bit for each.
    fn overlapping(&self, of: &Box3) -> u8 {
        let mut hit = [true; WIDTH];
        for axis in 0..3 {
            for lane in 0..WIDTH {
                hit[lane] &= (self.low[axis][lane] <= of.high[axis]) & (of.low[axis] <= self.high[axis][lane]);
            }
        }
        (0..WIDTH).fold(0, |bits, lane| bits | u8::from(hit[lane]) << lane)
    }
}

impl Bvh {
    fn order_anew(&mut self, faces: &[Box3]) {
        let centres: Vec<[f64; 3]> =
            faces.iter().map(|face| [0, 1, 2].map(|axis| 0.5 * (face.low[axis] + face.high[axis]))).collect();
        self.order = space_filling_order(&centres);
    }

    /// Puts boxes around the faces in their present order.
    fn fit(&mut self, faces: &[Box3]) {
        self.groups.clear();
        self.levels.clear();
        self.levels.push(0);
        let sound = |face: &u32| match &faces[*face as usize] {
            face if face.is_sound() => *face,
            _ => Box3::empty(),
        };
        self.groups.extend(self.order.chunks(WIDTH).map(|eight| Group::of(eight.iter().map(sound))));
        let mut below = 0..self.groups.len();
        while below.len() > 1 {
            self.levels.push(below.end);
            for first in below.clone().step_by(WIDTH) {
                let last = (first + WIDTH).min(below.end);
                let group = Group::of(self.groups[first..last].iter().map(Group::bounds));
                self.groups.push(group);
            }
            below = below.end..self.groups.len();
        }
        self.levels.push(below.end);
    }

    /// Mean extent of groups of faces over that of faces; not a number when nothing has an extent.
    fn measure(&self, faces: &[Box3]) -> f64 {
        let sum =
            |boxes: &mut dyn Iterator<Item = Box3>| -> f64 { boxes.filter(Box3::is_sound).map(|b| b.extent()).sum() };
        let groups = &self.groups[..self.levels[1]];
        sum(&mut groups.iter().map(Group::bounds)) / sum(&mut faces.iter().copied())
    }

    fn build(&mut self, faces: &[Box3]) {
        let kept = self.order.len() == faces.len();
        if kept {
            self.fit(faces);
        }
        if !kept || self.measure(faces) > WORN * self.looseness {
            self.order_anew(faces);
            self.fit(faces);
            self.looseness = self.measure(faces);
        }
    }

    /// Visits the faces whose boxes overlap `of`.
    fn visit(&mut self, of: &Box3, mut visit: impl FnMut(u32)) {
        let Bvh { order, groups, levels, waiting, .. } = self;
        // A group is known by its level and its place there; the children of place p are the places from 8 p.
        waiting.clear();
        waiting.push((levels.len() - 2, 0));
        while let Some((level, place)) = waiting.pop() {
            let mut bits = groups[levels[level] + place].overlapping(of);
            while bits != 0 {
                let child = WIDTH * place + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                if level == 0 {
                    visit(order[child]);
                } else {
                    waiting.push((level - 1, child));
                }
            }
        }
    }
}

impl Search for Bvh {
    fn find(&mut self, nodes: &[Box3], faces: &[Box3], connectivity: &[[u32; 4]], found: &mut Candidates) {
        found.clear();
        if !faces.is_empty() {
            self.build(faces);
            for (node, of) in (0..).zip(nodes).filter(|(_, of)| of.is_sound()) {
                self.visit(of, |face| found.push(node, face, &connectivity[face as usize]));
            }
        }
        found.sort_by_node(nodes.len());
    }

    fn name(&self) -> &'static str {
        "tree"
    }
}
