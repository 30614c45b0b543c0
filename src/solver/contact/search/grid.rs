//! The search by grids: of a pair, the smaller box is put into cells of the larger one's size, and the larger one looks
//! through the cells around it.

use super::sizes::{CLASSES, Sizes, members};
use super::{Box3, Candidates, Search, lowest_start};
use crate::lanes::{InstructionSet, Vectors};
use crate::solver::contact::geometry::swept_box::{Exchanged, SweptBox};

/// Edge of a cell in typical sizes of the class that looks through it.
const CELL: f64 = 0.7;
/// From this many times the boxes of another list on, a list is looked through instead of looking.
const FEW: usize = 4;
/// Cells are numbered within this bound, which keeps numbers in 32 bits; the outermost cells have no end.
const OUTERMOST: f64 = (1 << 30) as f64;

/// One grid for each class of sizes that occurs, so that neither a huge face nor a fast node slows the others down. Faces
/// look for nodes of smaller classes, and nodes for faces of the same or smaller classes; nearly always nodes are small,
/// faces are alike, and one grid is enough.
#[derive(Debug)]
pub struct Grid {
    sizes: Sizes,
    node_classes: Vec<u8>,
    face_classes: Vec<u8>,
    cells: Cells,
    instructions: InstructionSet,
}

impl Default for Grid {
    fn default() -> Grid {
        Grid {
            sizes: Sizes::default(),
            node_classes: Vec::new(),
            face_classes: Vec::new(),
            cells: Cells::default(),
            instructions: InstructionSet::detect(),
        }
    }
}

impl Search for Grid {
    fn find(&mut self, nodes: &[Box3], faces: &[Box3], connectivity: &[[u32; 4]], found: &mut Candidates) {
        match self.instructions.vectors() {
            // SAFETY: an instruction set is one that this processor has, and AVX-512 includes AVX2.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx2 | Vectors::Avx512 => unsafe { self.find_avx2(nodes, faces, connectivity, found) },
            _ => self.find_pairs(nodes, faces, connectivity, found),
        }
    }

    fn name(&self) -> &'static str {
        "grid"
    }
}

impl Grid {
    /// The same with a box to a register. `unsafe` for a third of the instructions of a search (docs/performance.md).
    ///
    /// # Safety
    ///
    /// The processor must have AVX2.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn find_avx2(&mut self, nodes: &[Box3], faces: &[Box3], connectivity: &[[u32; 4]], found: &mut Candidates) {
        self.find_pairs(nodes, faces, connectivity, found)
    }

    // Inlined, as what it calls, so that it is compiled for the instructions of its caller.
    #[inline(always)]
    fn find_pairs(&mut self, nodes: &[Box3], faces: &[Box3], connectivity: &[[u32; 4]], found: &mut Candidates) {
        let Grid { sizes, node_classes, face_classes, cells, .. } = self;
        found.clear();
        sizes.measure(faces);
        sizes.classes(nodes, node_classes);
        sizes.classes(faces, face_classes);
        let (of_nodes, of_faces) = (members(node_classes), members(face_classes));
        for class in 0..CLASSES {
            // The last class has boxes of any size, for which there is one cell.
            let edge = if class + 1 < CLASSES { CELL * sizes.typical(class) } else { f64::INFINITY };
            let larger = |face: usize| face_classes[face] == class;
            let smaller = |node: usize| node_classes[node] < class;
            let mut push = |node: u32, face: u32| found.push(node, face, &connectivity[face as usize]);
            let (many, few) = (of_faces[class as usize], of_nodes[..class as usize].iter().sum());
            cells.join((faces, many, larger), (nodes, few, smaller), edge, |face, node| push(node, face));
            let larger = |node: usize| node_classes[node] == class;
            let smaller = |face: usize| face_classes[face] <= class;
            let (many, few) = (of_nodes[class as usize], of_faces[..=class as usize].iter().sum());
            cells.join((nodes, many, larger), (faces, few, smaller), edge, push);
        }
        // Between searches the memory of the cells is better used by others.
        *cells = Cells::default();
        found.sort_by_node(nodes.len());
    }
}

/// Boxes by the cells of their low corners. Space has any number of cells; they share a table whose length is that of the
/// list of boxes. Cells along x are neighbours in the table too, so a row of them is one run.
#[derive(Debug, Default)]
struct Cells {
    /// Where each bucket of the table begins in `members`; one more than there are buckets.
    starts: Vec<u32>,
    /// Boxes by bucket: their indices, boxes around them in single precision, and their cells along y and z.
    members: Vec<u32>,
    bounds: Vec<SweptBox>,
    rows: Vec<[i32; 2]>,
    /// Members of the cells around a box that may overlap it, and how many those are.
    hits: Vec<u32>,
    /// The chosen boxes and their buckets, as they came.
    chosen: Vec<(u32, u32)>,
    /// Cells per length.
    inverse: f64,
    /// Longest of the boxes along each axis.
    extent: [f64; 3],
    /// Number of buckets, a power of two, less one.
    mask: u32,
    /// Distance in the table of cells that are neighbours along y and z.
    strides: [u32; 2],
}

impl Cells {
    /// Finds all pairs of a larger and a smaller box, each a list with so many boxes chosen. The larger ones look through the smaller
    /// ones' cells, but where they are many for a few: a few look through the cells of many, which are not smaller.
    #[inline(always)]
    fn join(
        &mut self,
        (large, larger, is_larger): (&[Box3], usize, impl Fn(usize) -> bool),
        (small, smaller, is_smaller): (&[Box3], usize, impl Fn(usize) -> bool),
        edge: f64,
        mut pair: impl FnMut(u32, u32),
    ) {
        if larger == 0 || smaller == 0 {
            return;
        }
        if FEW * smaller < larger {
            self.fill(large, edge, is_larger);
            for (index, of) in (0..).zip(small).filter(|(index, _)| is_smaller(*index as usize)) {
                self.visit(of, large, |other| pair(other, index));
            }
        } else {
            self.fill(small, edge, is_smaller);
            for (index, of) in (0..).zip(large).filter(|(index, _)| is_larger(*index as usize)) {
                self.visit(of, small, |other| pair(index, other));
            }
        }
    }

    #[inline(always)]
    fn fill(&mut self, boxes: &[Box3], edge: f64, chosen: impl Fn(usize) -> bool) {
        self.inverse = 1.0 / edge;
        self.size_table(boxes.len());
        self.chosen.clear();
        self.extent = [0.0; 3];
        for (index, one) in boxes.iter().enumerate().filter(|(index, _)| chosen(*index)) {
            let [x, y, z] = one.low.map(|x| cell(self.inverse, x));
            let bucket = self.row(y, z).wrapping_add(x as u32) & self.mask;
            self.starts[bucket as usize] += 1;
            self.chosen.push((index as u32, bucket));
            for axis in 0..3 {
                self.extent[axis] = self.extent[axis].max(one.high[axis] - one.low[axis]);
            }
        }
        let mut end = 0;
        for start in &mut self.starts {
            end += *start;
            *start = end;
        }
        self.members.resize(self.chosen.len(), 0);
        self.bounds.resize(self.chosen.len(), SweptBox::EVERYTHING);
        self.rows.resize(self.chosen.len(), [0; 2]);
        for (index, bucket) in self.chosen.iter().rev() {
            let start = &mut self.starts[*bucket as usize];
            *start -= 1;
            self.members[*start as usize] = *index;
            let one = &boxes[*index as usize];
            self.bounds[*start as usize] = SweptBox::around(one.low, one.high);
            self.rows[*start as usize] = [cell(self.inverse, one.low[1]), cell(self.inverse, one.low[2])];
        }
    }

    /// Clears the table for so many boxes. The strides are irrational fractions of its length, so that rows next to each
    /// other in a sheet or a block spread evenly.
    fn size_table(&mut self, boxes: usize) {
        let length = boxes.next_power_of_two().clamp(16, 1 << 30);
        self.mask = length as u32 - 1;
        self.strides = [0.618_033_988_75, 0.414_213_562_37].map(|part| (part * length as f64) as u32 | 1);
        self.starts.clear();
        self.starts.resize(length + 1, 0);
    }

    /// Place in the table, before wrapping, of the cell `[0, y, z]`.
    fn row(&self, y: i32, z: i32) -> u32 {
        (y as u32).wrapping_mul(self.strides[0]).wrapping_add((z as u32).wrapping_mul(self.strides[1]))
    }

    /// Visits each of `boxes` that overlaps `of`, once.
    #[inline(always)]
    fn visit(&mut self, of: &Box3, boxes: &[Box3], mut visit: impl FnMut(u32)) {
        let first = [0, 1, 2].map(|axis| cell(self.inverse, lowest_start(of.low[axis], self.extent[axis])));
        let last = of.high.map(|x| cell(self.inverse, x));
        let bounds = SweptBox::around(of.low, of.high).exchanged();
        let more = ((last[0] - first[0]) as u32).min(self.mask);
        let mut hits = 0;
        for z in first[2]..=last[2] {
            for y in first[1]..=last[1] {
                let from = self.row(y, z).wrapping_add(first[0] as u32) & self.mask;
                let to = from + more;
                hits = self.look_through(from, to.min(self.mask), [y, z], &bounds, hits);
                if to > self.mask {
                    hits = self.look_through(0, to - self.mask - 1, [y, z], &bounds, hits);
                }
            }
        }
        for &member in &self.hits[..hits] {
            if boxes[member as usize].overlaps(of) {
                visit(member);
            }
        }
    }

    /// Adds to so many hits the boxes that may overlap another in buckets `from` to `to`, but for those of other rows in the same
    /// buckets. How many hits there are then.
    #[inline(always)]
    fn look_through(&mut self, from: u32, to: u32, row: [i32; 2], other: &Exchanged, mut hits: usize) -> usize {
        let run = self.starts[from as usize] as usize..self.starts[to as usize + 1] as usize;
        if self.hits.len() < hits + run.len() {
            self.hits.resize(2 * (hits + run.len()), 0);
        }
        // Every second box overlaps, so a branch would be foretold wrongly every second time.
        let boxes = self.bounds[run.clone()].iter().zip(&self.rows[run.clone()]);
        for (member, (one, at)) in self.members[run].iter().zip(boxes) {
            self.hits[hits] = *member;
            hits += usize::from(!one.is_apart(other) & (at[0] == row[0]) & (at[1] == row[1]));
        }
        hits
    }
}

/// Number of the cell along an axis. It never falls when `x` grows; rounding towards zero makes cell 0 twice as long.
fn cell(inverse: f64, x: f64) -> i32 {
    (x * inverse).clamp(-OUTERMOST, OUTERMOST) as i32
}
