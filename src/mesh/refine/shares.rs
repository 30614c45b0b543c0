//! Distribution factors of node sets: what part of a load that is given per node each node bears, and how a finer mesh shares it out.
//!
//! A force or mass per node of a set means a total, as many times as the set has nodes. A finer mesh has more of them, and would
//! bear more. So its sets carry factors: they are as even as the set, by the length or area around each node, and keep total and resultant
//! of what the coarser mesh has.

use crate::common::vector::{add, cross, dot, scaled, subtract};
use crate::mesh::{Mesh, Shape};
use std::collections::{BTreeMap, BTreeSet};

/// Directions in which a set extends by less than this part of its largest extent bear no moment.
const FLAT: f64 = 1e-9;

impl Mesh {
    /// Nodes of a node set with their distribution factors, each once, ascending; 1 where the mesh gives none.
    pub fn shares_of(&self, set: i64) -> Vec<(u32, f64)> {
        let nodes = self.node_set(set).map_or(&[][..], |set| &set.nodes);
        let factors = self.node_factors.get(&set).map_or(&[][..], |factors| factors);
        let factors = factors.iter().copied().chain(std::iter::repeat(1.0));
        let mut all: Vec<(u32, f64)> = nodes.iter().copied().zip(factors).collect();
        all.sort_by_key(|(node, _)| *node);
        all.dedup_by_key(|(node, _)| *node);
        all
    }

    /// Gives the node sets factors with which they bear together what those of a coarser mesh of the same body do, with the same
    /// resultant.
    pub fn share_out_as(&mut self, coarse: &Mesh) {
        let factors = self.node_sets.iter().filter_map(|set| Some((set.id, self.shared_out(set.id, coarse)?)));
        self.node_factors = factors.collect();
    }

    /// The factors of a set in the order of its nodes; `None` where they are 1.
    fn shared_out(&self, set: i64, coarse: &Mesh) -> Option<Vec<f64>> {
        let own: Vec<u32> = self.shares_of(set).into_iter().map(|(node, _)| node).collect();
        let theirs = coarse.shares_of(set);
        if theirs.is_empty() || (own.len() == theirs.len() && theirs.iter().all(|(_, factor)| *factor == 1.0)) {
            return None;
        }
        let measures = self.measures(&own);
        let place = |mesh: &Mesh, node: u32| mesh.coordinates[node as usize];
        let (total, centre) = resultant(theirs.iter().map(|(node, factor)| (*factor, place(coarse, *node))))?;
        let even = || own.iter().zip(&measures).map(|(node, measure)| (*measure, place(self, *node)));
        let (whole, middle) = resultant(even())?;
        // Σ a (α + β·r) r = total (centre − middle), with r from the middle: a linear field on top of the even one.
        let slope = slope(even().map(|(measure, x)| (measure / whole, subtract(x, middle))), subtract(centre, middle));
        let factor = |(measure, x): (f64, [f64; 3])| total * measure / whole * (1.0 + dot(slope, subtract(x, middle)));
        let by_node: BTreeMap<u32, f64> = own.iter().copied().zip(even().map(factor)).collect();
        self.node_set(set).map(|set| set.nodes.iter().map(|node| by_node[node]).collect())
    }

    /// Area of the faces around each node that lie wholly in a set, or length of the edges where these do not reach all of its nodes; 1
    /// where these do not either. The nodes are ascending.
    fn measures(&self, nodes: &[u32]) -> Vec<f64> {
        let place = |node: u32| nodes.binary_search(&node).ok();
        for edges in [false, true] {
            let of_shape = |shape: Shape| -> Vec<Vec<usize>> {
                if edges {
                    shape.edges().iter().map(|edge| edge.to_vec()).collect()
                } else {
                    shape.sides().iter().filter(|side| side.len() > 2).map(|side| side.to_vec()).collect()
                }
            };
            let (mut seen, mut measures) = (BTreeSet::new(), vec![0.0; nodes.len()]);
            for (shape, element) in self.shaped().filter(|(_, element)| element.iter().any(|&n| place(n).is_some())) {
                for side in of_shape(shape) {
                    let mut on: Vec<u32> = side.iter().map(|&corner| element[corner]).collect();
                    let size = self.size(&on);
                    on.sort_unstable();
                    on.dedup();
                    let Some(places) = on.iter().map(|&node| place(node)).collect::<Option<Vec<usize>>>() else {
                        continue;
                    };
                    if seen.insert(on) {
                        places.iter().for_each(|&place| measures[place] += size / places.len() as f64);
                    }
                }
            }
            if measures.iter().all(|measure| *measure > 0.0) {
                return measures;
            }
        }
        vec![1.0; nodes.len()]
    }

    /// Length of an edge, or area of a face.
    fn size(&self, corners: &[u32]) -> f64 {
        let at = |corner: usize| self.coordinates[corners[corner] as usize];
        let area = |a: [f64; 3], b: [f64; 3]| 0.5 * dot(cross(a, b), cross(a, b)).sqrt();
        match corners.len() {
            2 => dot(subtract(at(1), at(0)), subtract(at(1), at(0))).sqrt(),
            3 => area(subtract(at(1), at(0)), subtract(at(2), at(0))),
            4 => area(subtract(at(2), at(0)), subtract(at(3), at(1))),
            _ => 0.0,
        }
    }
}

/// Sum of weights, and where their resultant acts; `None` where they add up to nothing.
fn resultant(all: impl Iterator<Item = (f64, [f64; 3])>) -> Option<(f64, [f64; 3])> {
    let (sum, moment) = all.fold((0.0, [0.0; 3]), |(sum, moment), (w, x)| (sum + w, add(moment, scaled(x, w))));
    (sum > 0.0).then(|| (sum, scaled(moment, 1.0 / sum)))
}

/// β with Σ w (β·r) r = wanted, in the directions in which there are any r.
fn slope(all: impl Iterator<Item = (f64, [f64; 3])>, wanted: [f64; 3]) -> [f64; 3] {
    let mut second = nalgebra::Matrix3::zeros();
    for (weight, r) in all {
        let r = nalgebra::Vector3::from(r);
        second += weight * r * r.transpose();
    }
    let eigen = second.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    let wanted = nalgebra::Vector3::from(wanted);
    let mut slope = nalgebra::Vector3::zeros();
    for (value, direction) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > FLAT * FLAT * largest {
            slope += direction * (direction.dot(&wanted) / value);
        }
    }
    slope.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::refine::refined;
    use crate::mesh::{Block, NodeSet};

    /// A plate of two rows of elements of widths that grow along x, with sets of its face, an edge, and two nodes apart.
    fn plate() -> Mesh {
        let xs = [0.0, 0.1, 0.3, 0.7, 1.5];
        let coordinates: Vec<[f64; 3]> =
            (0..30).map(|k: usize| [xs[k % 5], 0.4 * ((k / 5) % 3) as f64, 0.2 * (k / 15) as f64]).collect();
        let node = |i: usize, j: usize, k: usize| (i + 5 * (j + 3 * k)) as u32;
        let element = |e: usize| {
            let (i, j) = (e % 4, e / 4);
            [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
                .map(|[a, b, c]: [usize; 3]| node(i + a, j + b, c))
        };
        let set = |id: i64, nodes: Vec<u32>| NodeSet { id, name: String::new(), nodes };
        let top = (15..30).collect();
        Mesh {
            node_ids: (1..=30).collect(),
            element_ids: (1..=8).collect(),
            coordinates: coordinates.into(),
            blocks: vec![Block::hexahedra_of(1, (0..8).map(element))],
            // The last one has a node twice.
            node_sets: vec![set(1, top), set(2, (0..5).collect()), set(3, vec![0, 29]), set(4, vec![4, 9, 4, 14])],
            ..Mesh::default()
        }
    }

    fn sums(mesh: &Mesh, set: i64) -> (f64, [f64; 3]) {
        let all = mesh.shares_of(set).into_iter().map(|(node, factor)| (factor, mesh.coordinates[node as usize]));
        resultant(all).unwrap()
    }

    #[test]
    fn total_and_resultant_are_those_of_the_coarser_mesh() {
        let coarse = plate();
        let mut fine = refined(&coarse).unwrap();
        fine.share_out_as(&coarse);
        let mut finest = refined(&fine).unwrap();
        finest.share_out_as(&fine);
        for mesh in [&fine, &finest] {
            for (set, count) in [(1, 15.0), (2, 5.0), (3, 2.0), (4, 3.0)] {
                let ((total, at), (_, expected)) = (sums(mesh, set), sums(&coarse, set));
                assert!((total - count).abs() < 1e-12, "set {set}: {total}");
                assert!((0..3).all(|i| (at[i] - expected[i]).abs() < 1e-12), "set {set}: {at:?} {expected:?}");
            }
        }
        // Two nodes apart are the same two.
        assert!(!fine.node_factors.contains_key(&3) && fine.node_factors.len() == 3);
        // Sets that are even already: 3 nodes of a line become 5, the ends of which bear half.
        let expected = [0.375, 0.75, 0.75, 0.75, 0.375];
        let mut found: Vec<f64> = fine.shares_of(4).into_iter().map(|(_, factor)| factor).collect();
        found.sort_by(f64::total_cmp);
        assert!(found.len() == 5 && (found[0] - 0.375).abs() < 1e-12 && (found[4] - expected[1]).abs() < 1e-12);
    }
}
