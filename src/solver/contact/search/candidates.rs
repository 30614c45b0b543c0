//! What a search found: for each node, the faces that it can meet.

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
        // They take more than all the rest, and are not asked for any more.
        self.pairs = Vec::new();
        for bounds in self.starts.windows(2) {
            let list = &mut self.faces[bounds[0] as usize..bounds[1] as usize];
            if !list.is_sorted() {
                list.sort_unstable();
            }
        }
    }
}
