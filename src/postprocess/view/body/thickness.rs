//! Shells as thick as they are: their faces moved apart by the thickness, and closed at free edges.

use std::collections::BTreeMap;

use super::bars::at;
use super::section::Between;
use super::subject::Face;
use crate::common::disjoint_sets::DisjointSets;
use crate::common::vector::{add, cross, dot, scaled, subtract, unit};

/// A fold as sharp as this lengthens the fibre in its edge no more, so that folded sheets grow no spikes.
const LONGEST_FIBRE: f64 = 2.0;

/// A surface with what is added to it.
#[derive(Debug, Clone, Default)]
pub struct Added {
    /// Positions of nodes, then of points added.
    pub positions: Vec<[f64; 3]>,
    /// Where the points added have their values from.
    pub made: Vec<Between>,
    /// Faces.
    pub skin: Vec<Face>,
    /// Edges between faces that are parts of one, lower point first.
    pub seams: Vec<[u32; 2]>,
    /// Solids that thick shells are: element, bottom, top.
    pub solids: Vec<(usize, [u32; 8])>,
}

impl Added {
    /// A point with the values of a node.
    pub fn point(&mut self, position: [f64; 3], node: u32) -> u32 {
        self.positions.push(position);
        self.made.push(at(node));
        self.positions.len() as u32 - 1
    }

    /// No line is drawn between these points.
    pub fn seam(&mut self, a: u32, b: u32) {
        self.seams.push([a.min(b), a.max(b)]);
    }
}

/// A shell: its element, corners and thickness.
pub type Shell = (usize, [u32; 4], f64);

/// Replaces shells by solids. Fibres stand on the mean of the planes around a node that continue each other, so that both sides
/// of a fold stay as thick as they are; what meets at an edge of three or more ends there.
pub fn thicken(added: &mut Added, mut shells: Vec<Shell>) {
    orient(&mut shells);
    let edges = Edges::new(&shells);
    let fibres = edges.fibres(&shells);
    let normals: Vec<[f64; 3]> = shells.iter().map(|shell| normal(added, shell)).collect();
    let mut sums: BTreeMap<usize, ([f64; 3], f64, f64)> = BTreeMap::new();
    for (place, &fibre) in fibres.iter().enumerate() {
        let (sum, thickness, count) = sums.entry(fibre).or_insert(([0.0; 3], 0.0, 0.0));
        *sum = add(*sum, normals[place / 4]);
        *thickness += shells[place / 4].2;
        *count += 1.0;
    }
    let mut ends: BTreeMap<usize, [u32; 2]> = BTreeMap::new();
    for (place, &fibre) in fibres.iter().enumerate() {
        if ends.contains_key(&fibre) {
            continue;
        }
        let Some(&(sum, thickness, count)) = sums.get(&fibre) else { continue };
        let direction = unit(sum).unwrap_or(normals[place / 4]);
        // The mean of the cosines between the fibre and the normals around it.
        let cosine = dot(sum, direction) / count;
        let half = 0.5 * thickness / count * (1.0 / cosine.max(1e-9)).min(LONGEST_FIBRE);
        let node = shells[place / 4].1[place % 4];
        let middle = added.positions[node as usize];
        let [bottom, top] = [-half, half].map(|height| added.point(add(middle, scaled(direction, height)), node));
        ends.insert(fibre, [bottom, top]);
    }
    for (i, (element, ..)) in shells.iter().enumerate() {
        let element = *element;
        let corners = [0, 1, 2, 3].map(|corner| ends.get(&fibres[4 * i + corner]).copied().unwrap_or([0; 2]));
        let [bottom, top] = [0, 1].map(|side| corners.map(|corner| corner[side]));
        let [a, b, c, d] = bottom;
        added.skin.push(Face { element, nodes: top });
        added.skin.push(Face { element, nodes: [d, c, b, a] });
        added.solids.push((element, [a, b, c, d, top[0], top[1], top[2], top[3]]));
        for place in (0..4).filter(|&place| edges.beside(&shells, i, place).is_none()) {
            let next = (place + 1) % 4;
            if bottom[place] != bottom[next] {
                added.skin.push(Face { element, nodes: [bottom[place], bottom[next], top[next], top[place]] });
            }
        }
    }
}

fn normal(added: &Added, (_, nodes, _): &Shell) -> [f64; 3] {
    let [a, b, c, d] = nodes.map(|node| added.positions[node as usize]);
    unit(cross(subtract(c, a), subtract(d, b))).unwrap_or([0.0; 3])
}

/// The ends of a side, the lower first, and whether it goes from that to the other.
fn side((_, nodes, _): &Shell, side: usize) -> ([u32; 2], bool) {
    let (a, b) = (nodes[side], nodes[(side + 1) % 4]);
    ([a.min(b), a.max(b)], a < b)
}

/// Which shells meet at an edge, and in which of their sides.
struct Edges(BTreeMap<[u32; 2], Vec<(usize, usize)>>);

impl Edges {
    fn new(shells: &[Shell]) -> Edges {
        let mut edges: BTreeMap<[u32; 2], Vec<(usize, usize)>> = BTreeMap::new();
        for (i, shell) in shells.iter().enumerate() {
            for place in 0..4 {
                let (ends, _) = side(shell, place);
                if ends[0] != ends[1] {
                    edges.entry(ends).or_default().push((i, place));
                }
            }
        }
        Edges(edges)
    }

    /// The one shell across a side, and its side; none where the surface ends or branches.
    fn across(&self, shells: &[Shell], i: usize, place: usize) -> Option<(usize, usize)> {
        match self.0.get(&side(&shells[i], place).0)?.as_slice() {
            [one, other] => Some(if one.0 == i { *other } else { *one }),
            _ => None,
        }
    }

    /// The same where both have the same top.
    fn beside(&self, shells: &[Shell], i: usize, place: usize) -> Option<(usize, usize)> {
        let (other, its) = self.across(shells, i, place)?;
        (side(&shells[other], its).1 != side(&shells[i], place).1).then_some((other, its))
    }

    /// For each corner of each shell the number of its fibre: corners of neighbours at a node have one.
    fn fibres(&self, shells: &[Shell]) -> Vec<usize> {
        let mut fibres = DisjointSets::new(4 * shells.len());
        let mut join = |a: usize, b: usize| fibres.join(a as u32, b as u32);
        for (i, shell) in shells.iter().enumerate() {
            for place in 0..4 {
                let next = (place + 1) % 4;
                if shell.1[place] == shell.1[next] {
                    join(4 * i + place, 4 * i + next);
                } else if let Some((other, its)) = self.beside(shells, i, place) {
                    join(4 * i + place, 4 * other + (its + 1) % 4);
                    join(4 * i + next, 4 * other + its);
                }
            }
        }
        fibres.into_least().into_iter().map(|fibre| fibre as usize).collect()
    }
}

/// Turns shells over so that neighbours have the same top, as far as there is one.
fn orient(shells: &mut [Shell]) {
    let edges = Edges::new(shells);
    let mut known = vec![false; shells.len()];
    for first in 0..shells.len() {
        if std::mem::replace(&mut known[first], true) {
            continue;
        }
        let mut waiting = vec![first];
        while let Some(i) = waiting.pop() {
            for place in 0..4 {
                let Some((other, _)) = edges.across(shells, i, place).filter(|(other, _)| !known[*other]) else {
                    continue;
                };
                let (ends, forth) = side(&shells[i], place);
                let same_way = (0..4).map(|its| side(&shells[other], its)).any(|its| its == (ends, forth));
                if same_way {
                    shells[other].1.reverse();
                }
                known[other] = true;
                waiting.push(other);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume(added: &Added) -> f64 {
        added.skin.iter().fold(0.0, |sum, face| {
            let [a, b, c, d] = face.nodes.map(|node| added.positions[node as usize]);
            sum + (dot(a, cross(b, c)) + dot(a, cross(c, d))) / 6.0
        })
    }

    /// Two unit squares that meet at a right angle, the second turned over.
    #[test]
    fn a_folded_sheet_is_as_thick_as_it_is_and_closed() {
        let positions =
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
        let mut added = Added { positions, ..Added::default() };
        thicken(&mut added, vec![(0, [0, 1, 2, 3], 0.1), (1, [1, 2, 5, 4], 0.1)]);
        // Two faces each, and six free edges; the fibre in the fold is that of a mitre.
        assert_eq!((added.skin.len(), added.solids.len()), (4 + 6, 2));
        assert!((volume(&added).abs() - 2.0 * 0.1).abs() < 1e-12, "{}", volume(&added));
        let fold: Vec<_> = added.positions.iter().zip(&added.positions[6..]).map(|(_, x)| x).collect();
        assert!(fold.iter().any(|x| (x[0] - 0.95).abs() < 1e-12 && (x[2] - 0.05).abs() < 1e-12), "{fold:?}");
        assert!(fold.iter().any(|x| (x[0] - 1.05).abs() < 1e-12 && (x[2] + 0.05).abs() < 1e-12), "{fold:?}");
    }

    /// Three sheets at one edge end there, each as if it were alone.
    #[test]
    fn sheets_that_branch_end_at_the_edge() {
        let mut positions = vec![[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        positions.extend([
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [-1.0, 0.0, 0.0],
            [-1.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 1.0, 1.0],
        ]);
        let mut added = Added { positions, ..Added::default() };
        thicken(&mut added, [[0, 2, 3, 1], [0, 1, 5, 4], [0, 1, 7, 6]].map(|nodes| (0, nodes, 0.2)).to_vec());
        assert_eq!(added.skin.len(), 3 * (2 + 4));
        // Where none continues another, each stands on its own plane.
        assert!((volume(&added) - 3.0 * 0.2).abs() < 1e-12, "{}", volume(&added));
    }

    /// A triangle is a shell whose last corner is named twice.
    #[test]
    fn triangles_have_three_sides() {
        let mut added = Added { positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], ..Added::default() };
        thicken(&mut added, vec![(0, [0, 1, 2, 2], 0.1)]);
        assert_eq!((added.skin.len(), added.made.len()), (2 + 3, 2 * 3));
        assert!((volume(&added) - 0.05).abs() < 1e-12);
    }
}
