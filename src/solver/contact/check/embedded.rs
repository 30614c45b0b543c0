//! Nodes that are in the outermost elements of others, and how deep: beyond half an element contact does not hold them.

use super::initial_overlap::{is_inside, seen_larger};
use crate::comm::Communicator;
use crate::mesh::check::hexahedron_volume;
use crate::mesh::{HEX_SIDES, plane};
use crate::solver::contact::Contact;
use crate::solver::contact::geometry::projection;
use crate::solver::contact::search::{Box3, Candidates, SearchKind};
use crate::solver::contact::surface::layout::ABSENT;
use crate::solver::nodes::{Nodes, dot};

/// A node inside an element that is not its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EmbeddedNode {
    /// Place of the node in the mesh file.
    pub node: u32,
    /// Canonical number of the element.
    pub element: u32,
    /// Depth below the nearest outer face of the element, in thicknesses of the element there.
    pub depth: f64,
}

/// An element by its canonical number and its local nodes, eight as [`plane::eight`] has them.
pub type Outer = (u32, [u32; 8]);

/// Elements that are looked at together. Neighbours follow each other in canonical order, so that few points are near those of one
/// round, and what a search takes for a round is small against what a run keeps.
const TOGETHER: usize = 4096;

/// A point, and where it is.
type Located = (u32, [f64; 3]);

/// Bytes of a point on its way to other ranks: its number and its position.
const PARCEL: usize = 4 + 3 * 8;

impl Contact {
    /// Canonical numbers of the solid elements with faces that CONTACT MATERIAL lets touch, ascending.
    pub fn outer_elements(&self) -> Vec<u32> {
        let automatic = self.layout.automatic();
        let faces = automatic.iter().flat_map(|interface| &interface.faces);
        // Surfaces have no inside.
        let numbers = faces.filter(|&&face| !self.layout.faces.is_two_sided(face));
        let mut elements: Vec<u32> = numbers.map(|&face| self.layout.faces.number[face as usize] / 6).collect();
        elements.sort_unstable();
        elements.dedup();
        elements
    }

    /// The nodes of all ranks that are in some of these elements, those of this rank; a node is told once for each element
    /// that it is in. All ranks call it.
    pub fn embedded_nodes(
        &self,
        elements: impl Iterator<Item = Outer> + Clone,
        nodes: &Nodes,
        comm: &mut dyn Communicator,
    ) -> Vec<EmbeddedNode> {
        let around = |(_, corners): Outer| box_of(&corners, nodes);
        let extent = elements.clone().fold(Box3::empty(), |all, outer| all.joined(&around(outer)));
        let points = self.points_of_all(&extent, nodes, comm);
        let (mut found, mut rest) = (Vec::new(), elements);
        loop {
            let some: Vec<Outer> = rest.by_ref().take(TOGETHER).collect();
            if some.is_empty() {
                return found;
            }
            self.embedded_among(&points, &some, nodes, &mut found);
        }
    }

    /// Adds what of these points is in some of these elements.
    fn embedded_among(&self, points: &[Located], elements: &[Outer], nodes: &Nodes, found: &mut Vec<EmbeddedNode>) {
        let boxes: Vec<Box3> = elements.iter().map(|(_, corners)| box_of(corners, nodes)).collect();
        let extent = boxes.iter().fold(Box3::empty(), |all, of| all.joined(of));
        let point_box = |at: &[f64; 3]| Box3::around(&[*at]);
        let points: Vec<&Located> = points.iter().filter(|(_, at)| point_box(at).overlaps(&extent)).collect();
        let places: Vec<Box3> = points.iter().map(|(_, at)| point_box(at)).collect();
        let mut near = Candidates::default();
        // An element is not a face: no point is a corner of it here.
        SearchKind::Grid.make().find(&places, &boxes, &vec![[u32::MAX; 4]; boxes.len()], &mut near);
        for (i, (point, at)) in points.into_iter().enumerate() {
            let node = self.layout.nodes[*point as usize];
            let of_others = near
                .of(i)
                .iter()
                .map(|&element| &elements[element as usize])
                .filter(|(_, corners)| corners.iter().all(|&corner| nodes.file[corner as usize] != node))
                .filter(|(element, _)| !self.is_kept_apart(*point, *element));
            found.extend(of_others.filter_map(|&(element, corners)| {
                let corners = plane::solid(&corners.map(|node| nodes.position(node)));
                Some(EmbeddedNode { node, element, depth: self.depth(element, &corners, *at)? })
            }));
        }
    }

    /// Whether the deck keeps a point from touching the faces of an element.
    fn is_kept_apart(&self, point: u32, element: u32) -> bool {
        let layout = &self.layout;
        let block = layout.point_block[point as usize];
        let faces = (6 * element..6 * element + 6).map(|number| layout.face(number)).find(|&face| face != ABSENT);
        faces.is_some_and(|face| layout.exclusions.keep_apart(point, block, face, &layout.faces))
    }

    /// How deep a point is in an element, in thicknesses below the nearest of its outer faces; `None` where it is not in it.
    fn depth(&self, element: u32, corners: &[[f64; 3]; 8], point: [f64; 3]) -> Option<f64> {
        if !is_inside(&seen_larger(corners), point) {
            return None;
        }
        let volume = hexahedron_volume(corners);
        let mut least = f64::INFINITY;
        for (side, of_side) in (0..).zip(HEX_SIDES) {
            if self.layout.face(6 * element + side) == ABSENT {
                continue;
            }
            let face = of_side.map(|corner| corners[corner]);
            let area = projection::area_normal(&face);
            // A face without area says nothing.
            let Some(projection) = projection::project(&face, point) else { continue };
            least = least.min(-projection.gap * dot(area, area).sqrt() / volume);
        }
        least.is_finite().then_some(least)
    }

    /// Points that CONTACT MATERIAL lets touch, of all ranks: those in `extent`, and where they are. All ranks call it.
    fn points_of_all(&self, extent: &Box3, nodes: &Nodes, comm: &mut dyn Communicator) -> Vec<Located> {
        let Some(automatic) = self.layout.automatic() else { return Vec::new() };
        let own = self
            .contact_nodes
            .list
            .iter()
            .filter(|contact_node| contact_node.owned && automatic.points[contact_node.point as usize]);
        let own = own.map(|contact_node| (contact_node.point, nodes.position(contact_node.node)));
        let in_box = |extent: &Box3, (_, at): &Located| Box3::around(&[*at]).overlaps(extent);
        let count = own.clone().filter(|point| in_box(extent, point)).count();
        let mut points = Vec::with_capacity(count);
        points.extend(own.clone().filter(|point| in_box(extent, point)));
        if comm.size() > 1 {
            let extents = extents_of_all(extent, comm);
            let others = (0..comm.size()).filter(|&rank| rank != comm.rank());
            let parcels = others.map(|rank| {
                let theirs = own.clone().filter(|point| in_box(&extents[rank], point));
                (rank, theirs.flat_map(packed).collect::<Vec<u8>>())
            });
            let incoming = comm.sparse_exchange(parcels.filter(|(_, bytes)| !bytes.is_empty()).collect());
            points.extend(incoming.iter().flat_map(|(_, bytes)| bytes.chunks_exact(PARCEL)).map(unpacked));
        }
        points.sort_unstable_by_key(|(point, _)| *point);
        points
    }
}

/// The box around an element of these local nodes.
fn box_of(corners: &[u32; 8], nodes: &Nodes) -> Box3 {
    Box3::around(&plane::solid(&corners.map(|node| nodes.position(node))))
}

/// What every rank calls its extent, by rank; all ranks call it.
fn extents_of_all(own: &Box3, comm: &mut dyn Communicator) -> Vec<Box3> {
    let mut sides = vec![[f64::INFINITY; 6]; comm.size()];
    let ([a, b, c], [d, e, f]) = (own.low, own.high);
    sides[comm.rank()] = [a, b, c, -d, -e, -f];
    comm.all_min(sides.as_flattened_mut());
    sides.into_iter().map(|[a, b, c, d, e, f]| Box3 { low: [a, b, c], high: [-d, -e, -f] }).collect()
}

fn packed((point, at): Located) -> [u8; PARCEL] {
    let mut bytes = [0; PARCEL];
    bytes[..4].copy_from_slice(&point.to_le_bytes());
    bytes[4..].chunks_exact_mut(8).zip(at).for_each(|(place, x)| place.copy_from_slice(&x.to_le_bytes()));
    bytes
}

fn unpacked(bytes: &[u8]) -> Located {
    let mut number = [0; 4];
    number.copy_from_slice(&bytes[..4]);
    let coordinate = |i: usize| {
        let mut word = [0; 8];
        word.copy_from_slice(&bytes[4 + 8 * i..12 + 8 * i]);
        f64::from_le_bytes(word)
    };
    (u32::from_le_bytes(number), std::array::from_fn(coordinate))
}
