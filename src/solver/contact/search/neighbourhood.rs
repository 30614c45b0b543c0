//! The search on boxes: which points may meet which faces, and which edges may cross, until the next search.

use super::locate::{Candidate, Rule};
use crate::solver::contact::check::node_face;
use crate::solver::contact::contact_nodes::ContactNodes;
use crate::solver::contact::geometry::edges;
use crate::solver::contact::geometry::swept_box::SweptBox;
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

/// What moves, in boxes around the paths of its contact nodes.
pub struct Extents<'a> {
    /// Points, faces and edges.
    pub layout: &'a Layout,
    /// Which points are contact nodes.
    pub contact_nodes: &'a ContactNodes,
    /// Box of each contact node.
    pub boxes: &'a [SweptBox],
}

impl<'a> Extents<'a> {
    /// In the boxes in which the contact nodes stay until the next search.
    pub fn of_search(layout: &'a Layout, contact_nodes: &'a ContactNodes) -> Extents<'a> {
        Extents { layout, contact_nodes, boxes: contact_nodes.search_boxes() }
    }

    /// Box around some of the points, as far as they are contact nodes.
    pub fn around(&self, points: &[u32]) -> Box3 {
        let boxes = points.iter().filter_map(|&point| Some(&self.boxes[self.contact_nodes.of(point)?]));
        let [low, high] = SweptBox::hull(boxes).corners();
        Box3 { low, high }
    }

    /// Boxes of the contact nodes that this rank answers for, as large as they reach.
    pub fn points(&self) -> Boxes {
        let mut points = Boxes::default();
        for (i, contact_node) in self.contact_nodes.list.iter().enumerate().filter(|(_, node)| node.owned) {
            let reach = self.layout.faces.node_reach[contact_node.point as usize];
            let [low, high] = self.boxes[i].corners();
            points.push(contact_node.point, Box3 { low, high }.grown(reach));
        }
        points
    }

    /// Boxes of some faces, whose corners are contact nodes.
    pub fn faces(&self, faces: impl Iterator<Item = u32>) -> Boxes {
        let mut all = Boxes::default();
        for face in faces {
            let of = self.around(&self.layout.faces.corners[face as usize]);
            all.push(face, of.grown(self.layout.faces.margin(face, node_face::KEEP)));
        }
        all
    }

    /// Boxes of those of some edges that take part, whose ends are contact nodes.
    pub fn edges(&self, edges: impl Iterator<Item = u32>) -> Boxes {
        let mut all = Boxes::default();
        for edge in edges.filter(|&edge| self.layout.takes_part(edge)) {
            let one = &self.layout.edges[edge as usize];
            all.push(edge, self.around(&one.ends).grown(self.layout.edge_margin(edge)));
        }
        all
    }
}

/// Faces that may be near points, and edges that may be near edges, by their numbers: one list for each interface, with a place for
/// each of some points, and one with a place for each of some edges.
#[derive(Debug, Default)]
pub struct Near {
    /// For each interface.
    pub interfaces: Vec<Candidates>,
    /// Of the edges.
    pub edges: Candidates,
}

/// Finds all candidates of these points among these faces, and the crossings of `mine` among these edges with all of them.
pub fn find(
    search: &mut dyn Search,
    [points, faces, edges]: [&Boxes; 3],
    mine: impl Fn(u32) -> bool,
    layout: &Layout,
) -> SearchResult {
    let near = Near {
        interfaces: (0..layout.interfaces.len() as u32)
            .map(|number| of_interface(search, points, faces, number, layout))
            .collect(),
        edges: near_edges(search, edges, mine, layout),
    };
    near.of(&points.ids, &edges.ids)
}

/// The same in the search boxes of a rank that is alone.
pub fn find_alone(search: &mut dyn Search, layout: &Layout, contact_nodes: &ContactNodes) -> SearchResult {
    let extents = Extents::of_search(layout, contact_nodes);
    let (points, faces) = (extents.points(), extents.faces(0..layout.faces.len() as u32));
    let edges = extents.edges(0..layout.edges.len() as u32);
    find(search, [&points, &faces, &edges], |_| true, layout)
}

impl Near {
    /// What is near, of these points and edges.
    pub fn of(&self, points: &[u32], edges: &[u32]) -> SearchResult {
        let pairs = edges
            .iter()
            .enumerate()
            .flat_map(|(place, &first)| self.edges.of(place).iter().map(move |&second| [first, second]));
        let mut found = SearchResult { pairs: pairs.collect(), ..Default::default() };
        for (place, &point) in points.iter().enumerate() {
            let begin = found.candidates.len();
            for (interface, candidates) in (0..).zip(&self.interfaces) {
                found.candidates.extend(candidates.of(place).iter().map(|&face| Candidate { face, interface }));
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
}

/// Whether a point may touch a face as what an interface says, wherever they are.
pub fn may_touch(point: u32, face: u32, interface: u32, layout: &Layout) -> bool {
    let faces = &layout.faces;
    let kept_apart = || {
        let by_blocks = layout.interfaces[interface as usize].rule == Rule::Blocks;
        by_blocks && layout.exclusions.keep_apart(point, layout.point_block[point as usize], face, faces)
    };
    !faces.same_element(face, point)
        && !faces.grown_together(point, face)
        && !layout.are_joined(point, &faces.corners[face as usize])
        && !kept_apart()
}

/// Faces of one interface that are near its points and may touch them.
fn of_interface(search: &mut dyn Search, points: &Boxes, faces: &Boxes, number: u32, layout: &Layout) -> Candidates {
    let interface = &layout.interfaces[number as usize];
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
    found.rename(&chosen.ids);
    found.retain(|place, face| may_touch(points.ids[place], face, number, layout));
    found
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

/// Edges that are near to `mine` that stand out, and may cross them.
fn near_edges(search: &mut dyn Search, edges: &Boxes, mine: impl Fn(u32) -> bool, layout: &Layout) -> Candidates {
    let mut found = Candidates::default();
    if edges.ids.is_empty() {
        return found;
    }
    let asks = |edge: u32| mine(edge) && layout.edges[edge as usize].stands_out();
    let own = edges.ids.iter().zip(&edges.boxes).map(|(&edge, of)| if asks(edge) { *of } else { Box3::empty() });
    let own: Vec<Box3> = own.collect();
    let selves: Vec<[u32; 4]> = (0..own.len() as u32).map(|edge| [edge; 4]).collect();
    search.find(&own, &edges.boxes, &selves, &mut found);
    found.rename(&edges.ids);
    found.retain(|place, other| may_cross(edges.ids[place], other, layout));
    found
}

/// Whether an edge that stands out may cross another, which is not told of the other as well, wherever they are.
pub fn may_cross(first: u32, other: u32, layout: &Layout) -> bool {
    let [one, another] = [first, other].map(|edge| &layout.edges[edge as usize]);
    layout.meets(first, other)
        && (other > first || !another.stands_out())
        && !one.ends.iter().any(|&end| layout.are_joined(end, &another.ends))
        && !layout.exclusions.keep_edges_apart(one.faces, another.faces, &layout.faces)
        && edges::unrelated(one, another, &layout.faces)
}
