//! What a search found: for each node, the faces that it can meet.

use super::Box3;

/// The faces near each node, as lists in one array.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Candidates {
    /// Where each node's list begins in `faces`; one more than there are nodes.
    starts: Vec<u32>,
    faces: Vec<u32>,
    /// Pairs of node and face as they were found.
    pairs: Vec<(u32, u32)>,
}

impl Candidates {
    /// The faces near a node, in ascending order.
    pub fn of(&self, node: usize) -> &[u32] {
        &self.faces[self.starts[node] as usize..self.starts[node + 1] as usize]
    }

    /// Number of pairs of a node and a face.
    pub fn len(&self) -> usize {
        self.faces.len()
    }

    /// Whether nothing is near anything.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// Number of nodes that were searched for.
    pub fn nodes(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Calls each face by another number, of which there is one for each place; they ascend as the places do.
    pub(super) fn rename(&mut self, numbers: &[u32]) {
        self.faces.iter_mut().for_each(|face| *face = numbers[*face as usize]);
    }

    /// Those whose boxes overlap, of boxes by the numbers of nodes and faces.
    pub(super) fn overlapping(&self, nodes: &[Box3], faces: &[Box3]) -> Candidates {
        let mut chosen = Candidates::default();
        chosen.starts.reserve_exact(self.starts.len());
        chosen.faces.resize(self.faces.len(), 0);
        let mut end = 0;
        for (node, of) in nodes.iter().enumerate().take(self.nodes()) {
            chosen.starts.push(end as u32);
            // Without a branch that nobody can foretell.
            for &face in self.of(node) {
                chosen.faces[end] = face;
                end += usize::from(of.overlaps(&faces[face as usize]));
            }
        }
        chosen.starts.push(end as u32);
        chosen.faces.truncate(end);
        chosen
    }

    /// Keeps those pairs of a node and a face of which `keep` says so.
    pub(super) fn retain(&mut self, keep: impl Fn(usize, u32) -> bool) {
        let (mut begin, mut end) = (0, 0);
        for node in 0..self.nodes() {
            let list = begin..self.starts[node + 1] as usize;
            begin = list.end;
            self.starts[node] = end as u32;
            for place in list {
                let face = self.faces[place];
                if keep(node, face) {
                    self.faces[end] = face;
                    end += 1;
                }
            }
        }
        if let Some(last) = self.starts.last_mut() {
            *last = end as u32;
        }
        self.faces.truncate(end);
    }

    /// Makes lists for so many nodes, empty ones for those that have none yet.
    pub(super) fn extend_to(&mut self, nodes: usize) {
        self.starts.resize(nodes + 1, self.faces.len() as u32);
    }

    /// Adds pairs of a node and a face, ascending, as far as they are not there.
    pub(super) fn insert(&mut self, pairs: &[(u32, u32)]) {
        if pairs.is_empty() {
            return;
        }
        let mut faces = Vec::with_capacity(self.faces.len() + pairs.len());
        // Up to which node starts are those of the new lists, and which of the old entries are in them.
        let (mut done, mut copied) = (0, 0);
        for added in pairs.chunk_by(|a, b| a.0 == b.0) {
            let node = added[0].0 as usize;
            let (begin, end) = (self.starts[node] as usize, self.starts[node + 1] as usize);
            let shift = (faces.len() - copied) as u32;
            self.starts[done..=node].iter_mut().for_each(|start| *start += shift);
            faces.extend_from_slice(&self.faces[copied..begin]);
            let mut old = self.faces[begin..end].iter().copied().peekable();
            for &(_, face) in added {
                while let Some(before) = old.next_if(|&old| old <= face) {
                    faces.push(before);
                }
                if faces.last() != Some(&face) || faces.len() == self.starts[node] as usize {
                    faces.push(face);
                }
            }
            faces.extend(old);
            (done, copied) = (node + 1, end);
        }
        let shift = (faces.len() - copied) as u32;
        self.starts[done..].iter_mut().for_each(|start| *start += shift);
        faces.extend_from_slice(&self.faces[copied..]);
        self.faces = faces;
    }

    pub(super) fn clear(&mut self) {
        self.pairs.clear();
    }

    /// Adds a pair, which nobody may add again, unless the node is a corner of the face.
    pub(super) fn push(&mut self, node: u32, face: u32, corners: &[u32; 4]) {
        if !corners.contains(&node) {
            self.pairs.push((node, face));
        }
    }

    /// Makes the lists of so many nodes from the pairs.
    pub(super) fn sort_by_node(&mut self, nodes: usize) {
        self.starts.clear();
        self.starts.resize(nodes + 1, 0);
        for (node, _) in &self.pairs {
            self.starts[*node as usize] += 1;
        }
        let mut end = 0;
        for start in &mut self.starts {
            end += *start;
            *start = end;
        }
        self.faces.resize(self.pairs.len(), 0);
        // From the last pair to the first, each list is filled from its end, and keeps the order of its pairs.
        for (node, face) in self.pairs.iter().rev() {
            let start = &mut self.starts[*node as usize];
            *start -= 1;
            self.faces[*start as usize] = *face;
        }
        for bounds in self.starts.windows(2) {
            let list = &mut self.faces[bounds[0] as usize..bounds[1] as usize];
            if !list.is_sorted() {
                list.sort_unstable();
            }
        }
    }
}
