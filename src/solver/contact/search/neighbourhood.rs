//! The search on boxes: which points may meet which faces, and which edges may cross, until the next search.

use super::locate::{Candidate, Interface, Rule};
use crate::solver::contact::check::{edge_edge, node_face};
use crate::solver::contact::geometry::edges::{self, Edge};
use crate::solver::contact::nodes::ContactNodes;
use crate::solver::contact::search::occupancy::{CellRange, Occupancy};
use crate::solver::contact::search::{Box3, Candidates, Search};
use crate::solver::contact::surface::layout::{Layout, inverse};
use std::borrow::Cow;

/// Numbers, ascending, and their boxes.
#[derive(Debug, Clone, Default)]
pub struct Boxes {
    /// Numbers of points, faces or edges in the layout.
    pub ids: Vec<u32>,
    /// The box of each.
    pub boxes: Vec<Box3>,
}

impl Boxes {
    /// None yet, with room for so many and no more.
    pub fn with_capacity(count: usize) -> Boxes {
        Boxes { ids: Vec::with_capacity(count), boxes: Vec::with_capacity(count) }
    }

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
    /// Pairs of edges that may cross, ascending; the first looks around, and has the lower number where both stand out or both are bent.
    pub pairs: Vec<[u32; 2]>,
}

/// Boxes of some contact nodes, as large as they reach.
pub fn point_boxes(layout: &Layout, contact_nodes: &ContactNodes) -> Boxes {
    let mut points = Boxes::with_capacity(contact_nodes.list.len());
    for point in contact_nodes.list.iter().filter(|contact_node| contact_node.owned).map(|owned| owned.point) {
        points.push(point, contact_nodes.reach([point; 4]).grown(layout.faces.node_reach[point as usize]));
    }
    points
}

/// Box of a face, whose corners are contact nodes.
pub fn face_box(face: u32, layout: &Layout, contact_nodes: &ContactNodes) -> Box3 {
    let corners = layout.faces.corners[face as usize];
    contact_nodes.reach(corners).grown(layout.faces.margin(face, node_face::KEEP))
}

/// Boxes of all faces, whose corners are contact nodes.
pub fn face_boxes(layout: &Layout, contact_nodes: &ContactNodes) -> Boxes {
    let ids: Vec<u32> = (0..layout.faces.len() as u32).collect();
    Boxes { boxes: ids.iter().map(|&face| face_box(face, layout, contact_nodes)).collect(), ids }
}

/// Box of an edge, whose ends are contact nodes.
fn edge_box(edge: u32, layout: &Layout, contact_nodes: &ContactNodes) -> Box3 {
    let edge = &layout.edges[edge as usize];
    let reach = edge_edge::farthest_reach(&layout.faces, edge) + edge.distance(&layout.faces);
    contact_nodes.reach(edge.points(&layout.faces)).grown(reach)
}

/// Boxes of those of some edges that look around: whatever they do not meet crosses nothing.
pub fn looking_around(edges: impl Iterator<Item = u32>, layout: &Layout, contact_nodes: &ContactNodes) -> Boxes {
    let mut all = Boxes::default();
    for edge in edges.filter(|&edge| layout.looks_around(edge)) {
        all.push(edge, edge_box(edge, layout, contact_nodes));
    }
    all
}

/// Boxes of those of some edges that take part and may meet what is occupied.
pub fn edges_near(
    edges: impl Iterator<Item = u32>,
    occupied: &Occupancy,
    layout: &Layout,
    contact_nodes: &ContactNodes,
) -> Boxes {
    // Most edges are near none: that is told from the cells in which their ends are.
    let farthest = edge_edge::largest_reach(&layout.faces);
    let ends = contact_nodes.list.iter().map(|contact_node| contact_nodes.reach([contact_node.point; 4]));
    let cells: Vec<CellRange> = ends.map(|of| occupied.cells_of(&of.grown(farthest))).collect();
    let are_near = |edge: &Edge| match edge.points(&layout.faces).map(|point| contact_nodes.of(point)) {
        [Some(a), Some(b), Some(c), Some(d)] => {
            occupied.any(cells[a].joined(cells[b]).joined(cells[c].joined(cells[d])))
        }
        _ => true,
    };
    let mut all = Boxes::default();
    for edge in edges.filter(|&edge| layout.takes_part(edge) && are_near(&layout.edges[edge as usize])) {
        let of = edge_box(edge, layout, contact_nodes);
        if occupied.may_meet(&of) {
            all.push(edge, of);
        }
    }
    all
}

/// Cells along each axis of the space in which edges look around.
pub const CELLS: usize = 64;

/// Finds what there is to find on one rank: edges first, whose boxes are gone when those of points and faces come.
pub fn find_alone(search: &mut dyn Search, layout: &Layout, contact_nodes: &ContactNodes) -> SearchResult {
    let all = 0..layout.edges.len() as u32;
    let occupied = Occupancy::of(&looking_around(all.clone(), layout, contact_nodes).boxes, CELLS);
    let edges = edges_near(all, &occupied, layout, contact_nodes);
    let pairs = crossings(search, &edges, |_| true, layout);
    drop(edges);
    let points = point_boxes(layout, contact_nodes);
    let faces = face_boxes(layout, contact_nodes);
    SearchResult { pairs, ..find(search, [&points, &faces, &Boxes::default()], |_| true, layout) }
}

/// Finds all candidates of these points among these faces, and the crossings of `mine` among these edges with all of them.
pub fn find(
    search: &mut dyn Search,
    [points, faces, edges]: [&Boxes; 3],
    mine: impl Fn(u32) -> bool,
    layout: &Layout,
) -> SearchResult {
    let mut found = SearchResult { pairs: crossings(search, edges, mine, layout), ..Default::default() };
    let candidates: Vec<(Cow<Boxes>, Candidates)> =
        (layout.interfaces.iter()).map(|interface| of_interface(search, points, faces, (layout, interface))).collect();
    for (place, &point) in points.ids.iter().enumerate() {
        let begin = found.candidates.len();
        for (number, (faces, candidates)) in candidates.iter().enumerate() {
            let near = candidates.of(place).iter().map(|&place| faces.ids[place as usize]);
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
fn of_interface<'a>(
    search: &mut dyn Search,
    points: &Boxes,
    faces: &'a Boxes,
    (layout, interface): (&Layout, &Interface),
) -> (Cow<'a, Boxes>, Candidates) {
    let takes_part = |point: u32| interface.points[point as usize];
    let nodes = match points.ids.iter().all(|&point| takes_part(point)) {
        true => Cow::Borrowed(&points.boxes),
        false => {
            let places = points.ids.iter().zip(&points.boxes);
            Cow::Owned(places.map(|(&point, of)| if takes_part(point) { *of } else { Box3::empty() }).collect())
        }
    };
    let chosen = among(faces, &interface.faces);
    let corners = corners_among(points, &chosen.ids, layout);
    let mut found = Candidates::default();
    search.find(&nodes, &chosen.boxes, &corners, &mut found);
    (chosen, found)
}

/// Places among some points of the corners of some faces.
fn corners_among<'a>(points: &Boxes, faces: &[u32], layout: &'a Layout) -> Cow<'a, [[u32; 4]]> {
    let all = &layout.faces.corners;
    // Where all are there, every number is its own place.
    if points.ids.len() == layout.nodes.len() && faces.len() == all.len() {
        return Cow::Borrowed(all);
    }
    let places = inverse(points.ids.iter().copied(), layout.nodes.len());
    Cow::Owned(faces.iter().map(|&face| all[face as usize].map(|corner| places[corner as usize])).collect())
}

/// Those of some faces that are in an ascending list. Mostly these are all, and nothing is copied.
fn among<'a>(faces: &'a Boxes, list: &[u32]) -> Cow<'a, Boxes> {
    let chosen = || {
        let mut list = list.iter().peekable();
        faces.ids.iter().zip(&faces.boxes).filter(move |(face, _)| {
            while list.next_if(|other| other < face).is_some() {}
            list.next_if_eq(face).is_some()
        })
    };
    let count = chosen().count();
    if count == faces.ids.len() {
        return Cow::Borrowed(faces);
    }
    let mut all = Boxes::with_capacity(count);
    chosen().for_each(|(&face, of)| all.push(face, *of));
    Cow::Owned(all)
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

/// Edges that are looked through together: what a search takes for these is small against what a run keeps.
const TOGETHER: usize = 1 << 15;

/// Crossings that `mine` among these edges can have with all of them, ascending.
fn crossings(search: &mut dyn Search, edges: &Boxes, mine: impl Fn(u32) -> bool, layout: &Layout) -> Vec<[u32; 2]> {
    let asks = |edge: u32| mine(edge) && layout.looks_around(edge);
    let own: Vec<(u32, &Box3)> = edges.ids.iter().copied().zip(&edges.boxes).filter(|(edge, _)| asks(*edge)).collect();
    let mut pairs = Vec::new();
    for (ids, boxes) in edges.ids.chunks(TOGETHER).zip(edges.boxes.chunks(TOGETHER)) {
        let extent = boxes.iter().fold(Box3::empty(), |all, of| all.joined(of));
        let near: Vec<(u32, &Box3)> = own.iter().copied().filter(|(_, of)| of.overlaps(&extent)).collect();
        let near_boxes: Vec<Box3> = near.iter().map(|(_, of)| **of).collect();
        let mut found = Candidates::default();
        search.find(&near_boxes, boxes, &vec![[u32::MAX; 4]; ids.len()], &mut found);
        for (place, &(first, _)) in near.iter().enumerate() {
            let others = found.of(place).iter().map(|&other| ids[other as usize]);
            pairs.extend(others.filter(|&other| may_cross(first, other, layout)).map(|other| [first, other]));
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Whether an edge that looks around may cross another, as the first of both.
fn may_cross(first: u32, other: u32, layout: &Layout) -> bool {
    let (one, another) = (&layout.edges[first as usize], &layout.edges[other as usize]);
    layout.meets(first, other)
        && !one.ends.iter().any(|&end| layout.are_joined(end, &another.points(&layout.faces)))
        && !layout.exclusions.keep_edges_apart(one.faces, another.faces, &layout.faces)
        && edges::unrelated(one, another, &layout.faces)
}
