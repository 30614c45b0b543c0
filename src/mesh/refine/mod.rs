//! Every element divided, so that elements are half as long: for a second answer whose difference from the first tells
//! how far both are from converged.
//!
//! New nodes stand midway between old ones: of edges, faces and elements. The surface stays what it was, facets and all.
//! A hexahedron becomes eight, a quadrilateral four, a bar two. What has fewer corners than a hexahedron is divided at its
//! corners too: one hexahedron at each corner where three edges meet, so that a wedge becomes six, and at a corner where
//! more edges meet one pyramid on each face there, so that a pyramid becomes four hexahedra and four pyramids. A face with
//! three corners is then divided in three in all elements that share it. Inside a pyramid these share faces that are not
//! plane, and the two sides of which are not the same surface: a hundredth of its volume is lost.

mod shares;

use super::hexahedron::{HEX_SIDES, is_collapsed};
use super::{Block, Mesh, NodeSet, Shape, SideSet, UNIT_CUBE};
use std::collections::HashMap;

/// Elements of a divided mesh at most, as of meshes from recipes.
const MOST_ELEMENTS: usize = 200_000_000;

/// Why a mesh cannot be divided.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Undivided {
    /// It would become too large.
    #[error("the divided mesh would have {0} elements; at most {MOST_ELEMENTS} are made")]
    TooLarge(usize),
    /// An element is no body with faces all round.
    #[error("element {0} has nodes repeated in such a way that it is no closed body, and cannot be divided")]
    Open(i64),
}

/// Stands for "no side" in a child.
const INSIDE: u8 = u8::MAX;

/// What an element is divided into.
#[derive(Debug, Clone, PartialEq)]
struct Child {
    nodes: Vec<u32>,
    /// Its own side that lies on each side of its parent.
    outside: [u8; 6],
}

/// The mesh with every element divided. Old nodes keep place and number, new ones follow; elements are numbered anew from
/// one. A new node belongs to the node sets that all corners of its edge, face or element belong to; side sets have the
/// same surface. Who loads node sets shares loads out anew: [`Mesh::share_out_as`].
///
/// # Errors
/// [`Undivided`].
pub fn refined(mesh: &Mesh) -> Result<Mesh, Undivided> {
    // Each axis of an element is divided once: eight children in space, four in a surface, two of a bar.
    let children = |block: &Block| block.len().saturating_mul(1 << block.shape.dimension());
    let total = mesh.blocks.iter().map(children).fold(0, usize::saturating_add);
    if total > MOST_ELEMENTS {
        return Err(Undivided::TooLarge(total));
    }
    let mut divider = Divider { coordinates: mesh.coordinates.to_vec(), ..Divider::default() };
    let (mut blocks, mut outside, mut first) = (Vec::new(), Vec::new(), vec![0]);
    let mut element = 0;
    for block in &mesh.blocks {
        let mut fine = Block { nodes: Vec::new(), attributes: Vec::new(), ..block.clone() };
        for (place, nodes) in block.elements().enumerate() {
            let open = Undivided::Open(mesh.element_ids.get(element).copied().unwrap_or(element as i64 + 1));
            for child in divider.children(block.shape, nodes).ok_or(open)? {
                fine.nodes.extend(child.nodes);
                fine.attributes.extend(block.attributes_of(place));
                outside.push(child.outside);
            }
            first.push(outside.len() as u32);
            element += 1;
        }
        blocks.push(fine);
    }
    let node_sets = mesh.node_sets.iter().map(|set| divider.node_set(set, mesh.coordinates.len())).collect();
    let side_sets = mesh.side_sets.iter().map(|set| side_set(set, &first, &outside)).collect();
    let last = mesh.node_ids.iter().copied().max().unwrap_or(0);
    let made = divider.coordinates.len() - mesh.coordinates.len();
    Ok(Mesh {
        dimension: mesh.dimension,
        node_ids: mesh.node_ids.iter().copied().chain((1..=made as i64).map(|number| last + number)).collect(),
        element_ids: (1..=outside.len() as i64).collect(),
        coordinates: divider.coordinates.into(),
        blocks,
        node_sets,
        side_sets,
        title: mesh.title.clone(),
        qa: mesh
            .qa
            .iter()
            .cloned()
            .chain([["urto refine", env!("CARGO_PKG_VERSION"), "", ""].map(str::to_owned)])
            .collect(),
        weighted: mesh.weighted.clone(),
        ..Mesh::default()
    })
}

/// The sides of the children that lie on the sides of a set.
fn side_set(set: &SideSet, first: &[u32], outside: &[[u8; 6]]) -> SideSet {
    let of_side = |&(element, side): &(u32, u8)| {
        let children = first[element as usize]..first[element as usize + 1];
        children.filter_map(move |child| {
            let own = outside[child as usize][usize::from(side)];
            (own != INSIDE).then_some((child, own))
        })
    };
    SideSet { sides: set.sides.iter().flat_map(of_side).collect(), ..set.clone() }
}

/// Makes new nodes, each once.
#[derive(Default)]
struct Divider {
    coordinates: Vec<[f64; 3]>,
    /// Nodes midway between others, by these in ascending order.
    between: HashMap<[u32; 4], u32>,
    /// The nodes that each new one is midway between, one list behind the other, and where each begins.
    parents: Vec<u32>,
    begins: Vec<u32>,
}

impl Divider {
    /// The node midway between the corners of an edge or a face; a corner itself where all are one.
    fn middle(&mut self, corners: &[u32]) -> u32 {
        let mut nodes = corners.to_vec();
        nodes.sort_unstable();
        nodes.dedup();
        if let [one] = nodes[..] {
            return one;
        }
        let mut key = [u32::MAX; 4];
        key.iter_mut().zip(&nodes).for_each(|(place, node)| *place = *node);
        if let Some(&known) = self.between.get(&key) {
            return known;
        }
        let made = self.centre(&nodes);
        self.between.insert(key, made);
        made
    }

    /// A new node in the middle of others, which are different from each other.
    fn centre(&mut self, nodes: &[u32]) -> u32 {
        let mut sum = [0.0; 3];
        for &node in nodes {
            let at = self.coordinates[node as usize];
            (0..3).for_each(|axis| sum[axis] += at[axis]);
        }
        self.coordinates.push(sum.map(|sum| sum / nodes.len() as f64));
        self.begins.push(self.parents.len() as u32);
        self.parents.extend(nodes);
        (self.coordinates.len() - 1) as u32
    }

    /// A set with the new nodes all of whose parents are in it.
    fn node_set(&self, set: &NodeSet, old: usize) -> NodeSet {
        let mut inside = vec![false; old];
        set.nodes.iter().for_each(|&node| inside[node as usize] = true);
        let ends = self.begins.iter().skip(1).copied().chain([self.parents.len() as u32]);
        let lists = self.begins.iter().zip(ends).map(|(&begin, end)| &self.parents[begin as usize..end as usize]);
        let made = lists.enumerate().filter(|(_, parents)| parents.iter().all(|&parent| inside[parent as usize]));
        let nodes = set.nodes.iter().copied().chain(made.map(|(place, _)| (old + place) as u32)).collect();
        NodeSet { nodes, ..set.clone() }
    }

    /// What an element becomes; `None` for one that is no closed body.
    fn children(&mut self, shape: Shape, nodes: &[u32]) -> Option<Vec<Child>> {
        match (shape, <&[u32; 8]>::try_from(nodes)) {
            (Shape::Hexahedron, Ok(corners)) if is_collapsed(corners) => self.at_corners(corners),
            (Shape::Triangle, _) => Some(self.triangle(nodes)),
            // Nor is a triangle of the plane a quadrilateral with four halves of edges.
            _ if shape == Shape::Plane && (0..4).any(|i| nodes[i] == nodes[(i + 1) % 4]) => None,
            _ => Some(self.halved(shape, nodes)),
        }
    }

    /// A triangle of a surface: one at each corner, turned as their parent is, and one between them.
    fn triangle(&mut self, nodes: &[u32]) -> Vec<Child> {
        let [a, b, c] = [0, 1, 2].map(|i: usize| nodes[i]);
        let [ab, bc, ca] = [self.middle(&[a, b]), self.middle(&[b, c]), self.middle(&[c, a])];
        let child = |nodes: [u32; 3], edges: &[usize]| {
            let mut outside = [0, 1, INSIDE, INSIDE, INSIDE, INSIDE];
            edges.iter().for_each(|&edge| outside[edge] = edge as u8);
            Child { nodes: nodes.to_vec(), outside }
        };
        vec![
            child([a, ab, ca], &[2, 4]),
            child([ab, b, bc], &[2, 3]),
            child([ca, bc, c], &[3, 4]),
            child([bc, ca, ab], &[]),
        ]
    }

    /// An element with all its corners, halved along each of its directions; a child stands at each corner, turned as its
    /// parent is.
    fn halved(&mut self, shape: Shape, nodes: &[u32]) -> Vec<Child> {
        let directions = shape.dimension();
        let corners = &UNIT_CUBE[..nodes.len()];
        // Whether a place of the parent's grid, in half edges, has the corner on its line, face or body.
        let has = |grid: [f64; 3], corner: &[f64; 3]| {
            (0..directions).all(|axis| grid[axis] == 1.0 || 0.5 * grid[axis] == corner[axis])
        };
        let whole = [1.0; 3];
        let heart = (directions == 3).then(|| self.centre(nodes));
        let mut at = |grid: [f64; 3]| match heart {
            Some(heart) if grid == whole => heart,
            _ => {
                let on: Vec<u32> =
                    corners.iter().zip(nodes).filter(|(corner, _)| has(grid, corner)).map(|(_, node)| *node).collect();
                self.middle(&on)
            }
        };
        let child = |place: usize| {
            let own = corners.iter().map(|corner| at([0, 1, 2].map(|axis| corners[place][axis] + corner[axis])));
            let mut outside = [INSIDE; 6];
            for (side, of_side) in shape.sides().iter().enumerate() {
                if of_side.contains(&place) {
                    outside[side] = side as u8;
                }
            }
            Child { nodes: own.collect(), outside }
        };
        (0..nodes.len()).map(child).collect()
    }

    /// A hexahedron some of whose corners are one node, divided at its corners.
    fn at_corners(&mut self, nodes: &[u32; 8]) -> Option<Vec<Child>> {
        let faces: Vec<(u8, Vec<u32>)> = (0..6).map(|side| (side as u8, polygon(nodes, side))).collect();
        let faces: Vec<(u8, Vec<u32>)> = faces.into_iter().filter(|(_, corners)| corners.len() > 2).collect();
        let mut vertices = nodes.to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        let heart = self.centre(&vertices);
        let mut children = Vec::new();
        for vertex in vertices {
            let around = around(vertex, &faces)?;
            let edges: Vec<u32> = around.iter().map(|&(before, _)| self.middle(&[vertex, before])).collect();
            let middles: Vec<u32> = around.iter().map(|&(_, face)| self.middle(&faces[face].1)).collect();
            let side = |place: usize| usize::from(faces[around[place].1].0);
            if let ([a, b, c], [ab, bc, ca]) = (&edges[..], &middles[..]) {
                let mut outside = [INSIDE; 6];
                // The three faces lie on the bottom, the fourth and the first side of the child.
                [(0, 4), (1, 3), (2, 0)].into_iter().for_each(|(place, own)| outside[side(place)] = own);
                children.push(Child { nodes: vec![vertex, *a, *ab, *b, *c, *ca, heart, *bc], outside });
                continue;
            }
            for place in 0..around.len() {
                let (one, next) = (edges[place], edges[(place + 1) % edges.len()]);
                let mut outside = [INSIDE; 6];
                outside[side(place)] = 4;
                let nodes = vec![vertex, one, middles[place], next, heart, heart, heart, heart];
                children.push(Child { nodes, outside });
            }
        }
        Some(children)
    }
}

/// The different nodes around a side, counter-clockwise seen from outside.
fn polygon(nodes: &[u32; 8], side: usize) -> Vec<u32> {
    let mut corners: Vec<u32> = Vec::with_capacity(4);
    for corner in HEX_SIDES[side] {
        if !corners.contains(&nodes[corner]) {
            corners.push(nodes[corner]);
        }
    }
    corners
}

/// The faces around a vertex, counter-clockwise seen from outside, each with the vertex before on it; the vertex that
/// follows on it is the one before on the next. `None` where they do not close.
fn around(vertex: u32, faces: &[(u8, Vec<u32>)]) -> Option<Vec<(u32, usize)>> {
    let neighbours = |face: usize| {
        let corners = &faces[face].1;
        let place = corners.iter().position(|&corner| corner == vertex)?;
        let count = corners.len();
        Some((corners[(place + count - 1) % count], corners[(place + 1) % count]))
    };
    let own: Vec<(usize, (u32, u32))> = (0..faces.len()).filter_map(|face| Some((face, neighbours(face)?))).collect();
    let &(first, (begin, mut next)) = own.first()?;
    let mut ring = vec![(begin, first)];
    while next != begin {
        let &(face, (before, after)) = own.iter().find(|(_, (before, _))| *before == next)?;
        if ring.len() >= own.len() {
            return None;
        }
        ring.push((before, face));
        next = after;
    }
    (ring.len() == own.len() && ring.len() > 2).then_some(ring)
}

#[cfg(test)]
mod tests {
    use super::super::check::{geometry, hexahedron_volume};
    use super::super::hexahedron::Form;
    use super::*;

    fn mesh(coordinates: Vec<[f64; 3]>, blocks: Vec<Block>) -> Mesh {
        let elements: usize = blocks.iter().map(Block::len).sum();
        Mesh {
            node_ids: (11..11 + coordinates.len() as i64).collect(),
            element_ids: (1..=elements as i64).collect(),
            coordinates: coordinates.into(),
            blocks,
            ..Mesh::default()
        }
    }

    fn volume(mesh: &Mesh) -> f64 {
        mesh.hexahedra().map(|nodes| hexahedron_volume(&nodes.map(|node| mesh.coordinates[node as usize]))).sum()
    }

    /// Two boxes beside each other, the common face in a side set and its nodes in a node set.
    #[test]
    fn hexahedra_become_eight_and_sets_stay_the_surface_they_were() {
        let mut coordinates: Vec<[f64; 3]> = Vec::new();
        for z in [0.0, 1.0] {
            for y in [0.0, 1.0] {
                (0..3).for_each(|x| coordinates.push([f64::from(x), y, z]));
            }
        }
        let block = Block {
            attributes: vec![3.0, 4.0],
            ..Block::hexahedra_of(7, [[0, 1, 4, 3, 6, 7, 10, 9], [1, 2, 5, 4, 7, 8, 11, 10]])
        };
        let mut coarse = mesh(coordinates, vec![block]);
        coarse.side_sets = vec![SideSet { id: 5, sides: vec![(0, 1)], ..SideSet::default() }];
        coarse.node_sets = vec![NodeSet { id: 4, name: "middle".into(), nodes: vec![1, 4, 7, 10] }];
        let fine = refined(&coarse).unwrap();
        assert_eq!((fine.element_count(), fine.coordinates.len()), (16, 45));
        assert_eq!(fine.blocks[0].attributes, [[3.0; 8], [4.0; 8]].concat());
        assert!(geometry(&fine).is_empty() && (volume(&fine) - 2.0).abs() < 1e-14);
        assert_eq!((fine.node_ids[0], fine.node_ids[12]), (11, 23));
        assert_eq!((fine.side_sets[0].sides.len(), fine.node_sets[0].nodes.len()), (4, 9));
        assert!(fine.node_sets[0].nodes.iter().all(|&node| fine.coordinates[node as usize][0] == 1.0));
        let mut on_sides = fine.side_set_nodes(5);
        let mut in_set = fine.node_sets[0].nodes.clone();
        on_sides.sort_unstable();
        in_set.sort_unstable();
        assert_eq!(on_sides, in_set);
    }

    /// Twice divided, so that the children of pyramids are divided too.
    #[test]
    fn wedges_and_pyramids_keep_their_volume_and_their_sides() {
        let prism =
            vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 3.0], [2.0, 0.0, 3.0], [0.5, 1.0, 3.0]];
        let roof = vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 3.0]];
        for (form, nodes, expected, counts) in [(Form::Wedge, prism, 3.0, [6, 48]), (Form::Pyramid, roof, 4.0, [8, 64])]
        {
            let corners = form.corners().map(|corner| corner as u32);
            let mut coarse = mesh(nodes, vec![Block::hexahedra_of(1, [corners])]);
            coarse.side_sets = vec![SideSet { id: 1, sides: vec![(0, 4), (0, 0)], ..SideSet::default() }];
            let fine = refined(&coarse).unwrap();
            let finer = refined(&fine).unwrap();
            assert_eq!([fine.element_count(), finer.element_count()], counts, "{form:?}");
            for mesh in [&fine, &finer] {
                assert!(geometry(mesh).is_empty(), "{form:?}: {:?}", geometry(mesh).list());
                // 4/90 of a pyramid's volume of 4, and of the smaller ones' again.
                let lost = if form == Form::Wedge { 0.0 } else { 0.015 * expected };
                assert!((volume(mesh) - expected).abs() < 1e-12 + lost, "{form:?}: {}", volume(mesh));
                assert!(outward_and_closed(mesh), "{form:?}");
            }
            // The bottom and the front are planes.
            let on_planes = |mesh: &Mesh| {
                mesh.side_set_nodes(1).iter().filter(|&&node| mesh.coordinates[node as usize][2] == 0.0).count()
            };
            let bottom = if form == Form::Wedge { 7 } else { 9 };
            assert_eq!(on_planes(&fine), bottom, "{form:?}");
        }
    }

    /// Whether every face is outer or shared by two elements that see it from both sides.
    fn outward_and_closed(mesh: &Mesh) -> bool {
        let mut seen: HashMap<(u32, u32), i32> = HashMap::new();
        for nodes in mesh.hexahedra() {
            for side in 0..6 {
                let corners = polygon(nodes, side);
                if corners.len() > 2 {
                    for (place, &corner) in corners.iter().enumerate() {
                        *seen.entry((corner, corners[(place + 1) % corners.len()])).or_default() += 1;
                    }
                }
            }
        }
        seen.iter().all(|(&(a, b), count)| seen.get(&(b, a)) == Some(count))
    }

    #[test]
    fn surfaces_and_lines_are_divided_and_share_nodes_with_solids() {
        let coordinates = UNIT_CUBE.to_vec();
        let shell = Block { id: 2, shape: Shape::Quadrilateral, nodes: vec![4, 5, 6, 7], ..Block::default() };
        let bar = Block { id: 3, shape: Shape::Bar, nodes: vec![0, 1], ..Block::default() };
        let mut coarse = mesh(coordinates, vec![Block::hexahedra_of(1, [[0, 1, 2, 3, 4, 5, 6, 7]]), shell, bar]);
        coarse.side_sets = vec![SideSet { id: 1, sides: vec![(1, 0), (1, 3), (2, 1)], ..SideSet::default() }];
        let fine = refined(&coarse).unwrap();
        assert_eq!(fine.blocks.iter().map(Block::len).collect::<Vec<_>>(), [8, 4, 2]);
        assert_eq!(fine.coordinates.len(), 27);
        assert!(geometry(&fine).is_empty());
        assert_eq!(fine.side_sets[0].sides, [(8, 0), (9, 0), (10, 0), (11, 0), (9, 3), (10, 3), (13, 1)]);
    }

    #[test]
    fn a_triangle_becomes_four() {
        let coordinates = vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
        let block = Block { id: 2, shape: Shape::Triangle, nodes: vec![0, 1, 2], ..Block::default() };
        let mut coarse = mesh(coordinates, vec![block]);
        coarse.side_sets = vec![SideSet { id: 1, sides: vec![(0, 0), (0, 3)], ..SideSet::default() }];
        let fine = refined(&coarse).unwrap();
        assert!((fine.element_count(), fine.coordinates.len()) == (4, 6) && geometry(&fine).is_empty());
        assert_eq!(fine.side_sets[0].sides, [(0, 0), (1, 0), (2, 0), (3, 0), (1, 3), (2, 3)]);
        // All turn as their parent does.
        let area = |nodes: &[u32]| {
            let [a, b, c] = [0, 1, 2].map(|i: usize| fine.coordinates[nodes[i] as usize]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        assert!(fine.elements().all(|(_, nodes)| (area(nodes) - 1.0).abs() < 1e-15));
    }

    #[test]
    fn what_is_no_body_is_not_divided() {
        let pinched = mesh(UNIT_CUBE.to_vec(), vec![Block::hexahedra_of(1, [[0, 1, 0, 3, 4, 5, 6, 7]])]);
        assert_eq!(refined(&pinched), Err(Undivided::Open(1)));
    }
}
