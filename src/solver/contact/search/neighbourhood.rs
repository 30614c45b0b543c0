//! The search on boxes: which points may meet which faces, and which edges may cross, until the next search.

use super::locate::{Candidate, Interface, Rule};
use crate::solver::contact::check::{edge_edge, node_face};
use crate::solver::contact::contact_nodes::ContactNodes;
use crate::solver::contact::geometry::edges;
use crate::solver::contact::layout::Layout;
use crate::solver::contact::search::{Box3, Candidates, Search};

/// Numbers, ascending, and their boxes.
#[derive(Debug, Clone, Default)]
pub struct Boxes {
    /// Numbers of points, faces or edges in the layout.
    pub ids: Vec<u32>,
    /// The box of each.
    pub boxes: Vec<Box3>,
}

impl Boxes {
    /// Adds one.
    pub fn push(&mut self, id: u32, of: Box3) {
        self.ids.push(id);
        self.boxes.push(of);
    }
}

/// What a search finds, by the numbers of the layout.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SearchResult {
    /// Slave nodes: points with candidates, ascending.
    pub slave_nodes: Vec<u32>,
    /// Where the candidates of each begin in `candidates`; one more than there are slave nodes.
    pub first: Vec<u32>,
    /// Candidates, faces ascending.
    pub candidates: Vec<Candidate>,
    /// Pairs of edges that may cross, ascending; the first stands out, and has the lower number where both do.
    pub pairs: Vec<[u32; 2]>,
}

/// Box in which a contact node stays until the next search.
fn around(contact_nodes: &ContactNodes, contact_node: usize) -> Box3 {
    let [low, high] = contact_nodes.reach(contact_node);
    Box3 { low, high }
}

/// Boxes of some contact nodes, as large as they reach.
pub fn point_boxes(layout: &Layout, contact_nodes: &ContactNodes) -> Boxes {
    let mut points = Boxes::default();
    for (i, contact_node) in contact_nodes.list.iter().enumerate().filter(|(_, contact_node)| contact_node.owned) {
        let reach = layout.faces.node_reach[contact_node.point as usize];
        points.push(contact_node.point, around(contact_nodes, i).grown(reach));
    }
    points
}

/// Boxes of some faces, whose corners are contact nodes.
pub fn face_boxes(faces: impl Iterator<Item = u32>, layout: &Layout, contact_nodes: &ContactNodes) -> Boxes {
    let mut all = Boxes::default();
    for face in faces {
        let corners = layout.faces.corners[face as usize].map(|corner| contact_nodes.of(corner));
        let of = corners
            .iter()
            .flatten()
            .fold(Box3::empty(), |all, &contact_node| all.joined(&around(contact_nodes, contact_node)));
        all.push(face, of.grown(layout.faces.margin(face, node_face::KEEP)));
    }
    all
}

/// Boxes of those of some edges that take part, whose ends are contact nodes.
pub fn edge_boxes(edges: impl Iterator<Item = u32>, layout: &Layout, contact_nodes: &ContactNodes) -> Boxes {
    let mut all = Boxes::default();
    for edge in edges.filter(|&edge| layout.takes_part(edge)) {
        let one = &layout.edges[edge as usize];
        let of = one.ends.iter().filter_map(|&end| contact_nodes.of(end));
        let of = of.fold(Box3::empty(), |all, contact_node| all.joined(&around(contact_nodes, contact_node)));
        all.push(edge, of.grown(edge_edge::farthest_reach(&layout.faces, one) + one.distance(&layout.faces)));
    }
    all
}

/// Finds all candidates of these points among these faces, and the crossings of `mine` among these edges with all of them.
pub fn find(
    search: &mut dyn Search,
    [points, faces, edges]: [&Boxes; 3],
    mine: impl Fn(u32) -> bool,
    layout: &Layout,
) -> SearchResult {
    let candidates: Vec<(Vec<u32>, Candidates)> =
        (layout.interfaces.iter()).map(|interface| of_interface(search, points, faces, interface)).collect();
    let mut found = SearchResult { pairs: crossings(search, edges, mine, layout), ..Default::default() };
    for (place, &point) in points.ids.iter().enumerate() {
        let begin = found.candidates.len();
        for (number, (faces, candidates)) in candidates.iter().enumerate() {
            let near = candidates.of(place).iter().map(|&place| faces[place as usize]);
            let faces = &layout.faces;
            let joined = |face: u32| layout.are_joined(point, &faces.corners[face as usize]);
            let by_blocks = layout.interfaces[number].rule == Rule::Blocks;
            let block = layout.point_block[point as usize];
            let kept_apart = |face: u32| by_blocks && layout.exclusions.keep_apart(point, block, face, faces);
            let unrelated = near.filter(|&face| {
                !faces.same_element(face, point)
                    && !faces.grown_together(point, face)
                    && !joined(face)
                    && !kept_apart(face)
            });
            found.candidates.extend(unrelated.map(|face| Candidate { face, interface: number as u32 }));
        }
        if found.candidates.len() > begin {
            keep_first(&mut found.candidates, begin);
            found.slave_nodes.push(point);
            found.first.push(begin as u32);
        }
    }
    found.first.push(found.candidates.len() as u32);
    found
}

/// Candidates of one interface, and the faces among which they count.
fn of_interface(
    search: &mut dyn Search,
    points: &Boxes,
    faces: &Boxes,
    interface: &Interface,
) -> (Vec<u32>, Candidates) {
    let takes_part = |(&point, of): (&u32, &Box3)| if interface.points[point as usize] { *of } else { Box3::empty() };
    let nodes: Vec<Box3> = points.ids.iter().zip(&points.boxes).map(takes_part).collect();
    let mut chosen = Boxes::default();
    let mut list = interface.faces.iter().peekable();
    for (&face, of) in faces.ids.iter().zip(&faces.boxes) {
        while list.next_if(|&&other| other < face).is_some() {}
        if list.next_if(|&&other| other == face).is_some() {
            chosen.push(face, *of);
        }
    }
    // Corners are left out with all nodes of the element.
    let corners = vec![[u32::MAX; 4]; chosen.ids.len()];
    let mut found = Candidates::default();
    search.find(&nodes, &chosen.boxes, &corners, &mut found);
    (chosen.ids, found)
}

/// Puts the candidates of one point in order. Of interfaces that name the same pair, the first holds.
fn keep_first(near: &mut Vec<Candidate>, begin: usize) {
    near[begin..].sort_by_key(|near| (near.face, near.interface));
    let mut kept = begin + 1;
    for i in begin + 1..near.len() {
        if near[i].face != near[kept - 1].face {
            near[kept] = near[i];
            kept += 1;
        }
    }
    near.truncate(kept);
}

fn crossings(search: &mut dyn Search, edges: &Boxes, mine: impl Fn(u32) -> bool, layout: &Layout) -> Vec<[u32; 2]> {
    if edges.ids.is_empty() {
        return Vec::new();
    }
    let stands_out = |edge: u32| layout.edges[edge as usize].stands_out();
    let asks = |edge: u32| mine(edge) && stands_out(edge);
    let own = edges.ids.iter().zip(&edges.boxes).map(|(&edge, of)| if asks(edge) { *of } else { Box3::empty() });
    let own: Vec<Box3> = own.collect();
    let selves: Vec<[u32; 4]> = (0..own.len() as u32).map(|edge| [edge; 4]).collect();
    let mut found = Candidates::default();
    search.find(&own, &edges.boxes, &selves, &mut found);
    let mut pairs = Vec::new();
    for (place, &first) in edges.ids.iter().enumerate() {
        let others = found.of(place).iter().map(|&other| edges.ids[other as usize]);
        let others = others.filter(|&other| layout.meets(first, other) && (other > first || !stands_out(other)));
        let one = &layout.edges[first as usize];
        let joined = |other: u32| {
            let others = &layout.edges[other as usize].ends;
            one.ends.iter().any(|&end| layout.are_joined(end, others))
        };
        let kept_apart = |other: u32| {
            layout.exclusions.keep_edges_apart(one.faces, layout.edges[other as usize].faces, &layout.faces)
        };
        let others = others.filter(|&other| !joined(other) && !kept_apart(other));
        let unrelated = others.filter(|&other| edges::unrelated(one, &layout.edges[other as usize], &layout.faces));
        pairs.extend(unrelated.map(|second| [first, second]));
    }
    pairs
}
