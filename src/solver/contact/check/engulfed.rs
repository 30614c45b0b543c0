//! Elements that begin inside other bodies without any node that contact knows to be inside: the same body twice at one place, or one
//! that lies wholly in a large element of another.

use super::body_pairs::BodyPairs;
use super::initial_overlap::{is_inside, solid_elements};
use super::sunk::{Inner, SunkFaces};
use super::unheld::{Place, Unheld};
use crate::mesh::check::hexahedron_volume;
use crate::mesh::{Mesh, plane};
use crate::model::Model;
use crate::solver::Body;
use crate::solver::body::centroid;
use crate::solver::contact::search::locate::Interface;
use crate::solver::contact::search::{Box3, Candidates, SearchKind};
use crate::solver::contact::surface::layout::{ABSENT, Layout};
use std::collections::BTreeSet;

/// A solid element where bodies may overlap: its number in canonical order, its nodes and its corners.
type Element = (u32, [u32; 8], [[f64; 3]; 8]);

/// Of two elements that are in each other the smaller one is inside; both are where their volumes differ by no more than this factor.
const AS_LARGE: f64 = 1.0 + 1e-6;

/// Elements with faces of an interface whose middle is inside an element of another body, and their nodes.
pub fn engulfed(
    (mesh, model): (&Mesh, &Model),
    (body, layout, interface): (&Body, &Layout, &Interface),
    pairs: &BodyPairs,
) -> (Unheld, BTreeSet<u32>) {
    let solid = solid_elements(body, layout, &interface.faces).into_iter();
    let placed = solid.map(|(number, nodes)| (number, nodes, plane::solid(&body.corners(&nodes))));
    let elements: Vec<Element> =
        placed.filter(|(_, nodes, corners)| pairs.may_overlap(pairs.body(nodes[0]), &Box3::around(corners))).collect();
    let is_outer = |&&(number, ..): &&Element| (6 * number..6 * number + 6).any(|face| layout.face(face) != ABSENT);
    let outer: Vec<&Element> = elements.iter().filter(is_outer).collect();
    let middles: Vec<Box3> = outer.iter().map(|(.., corners)| Box3::around(&[centroid(corners)])).collect();
    let boxes: Vec<Box3> = elements.iter().map(|(.., corners)| Box3::around(corners)).collect();
    let mut near = Candidates::default();
    SearchKind::Grid.make().find(&middles, &boxes, &vec![[u32::MAX; 4]; boxes.len()], &mut near);
    let block = |element: &Element| body.element_block[element.0 as usize];
    let rigid = |element: &Element| body.block_body[block(element) as usize];
    let joined = |node: &u32| layout.joined.get(layout.point(*node) as usize).is_some_and(|others| !others.is_empty());
    let mut found: Vec<(&Element, &Element)> = Vec::new();
    for (place, &inner) in outer.iter().enumerate() {
        let around = near.of(place).iter().map(|&other| &elements[other as usize]).find(|other| {
            pairs.body(other.1[0]) != pairs.body(inner.1[0])
                && is_inside(&other.2, centroid(&inner.2))
                && hexahedron_volume(&inner.2) <= AS_LARGE * hexahedron_volume(&other.2)
                && !layout.exclusions.keep_blocks_apart(block(inner), block(other))
                && (rigid(inner).is_none() || rigid(inner) != rigid(other))
        });
        found.extend(around.filter(|_| !inner.1.iter().any(joined)).map(|other| (inner, other)));
    }
    if found.is_empty() {
        return (Unheld::default(), BTreeSet::new());
    }
    let known = pairs.known((mesh, model), body, layout).into_iter();
    let known: BTreeSet<(u32, u32)> = known.map(|of| (layout.nodes[of.point as usize], of.other)).collect();
    let is_known = |node: &u32, other: u32| known.contains(&(*node, other));
    found.retain(|(inner, other)| !inner.1.iter().any(|node| is_known(node, pairs.body(other.1[0]))));
    let middle = |(inner, other): &(&Element, &Element)| {
        let [body, other] = [inner, other].map(|of| pairs.body(of.1[0]));
        Inner { at: centroid(&inner.2), body, other }
    };
    SunkFaces::of((mesh, model), body, layout, pairs).leave_out_below(&mut found, middle);
    let ids = |(inner, other): &(&Element, &Element)| [inner, other].map(|of| mesh.blocks[block(of) as usize].id);
    let worst = found.first().map(|pair @ (inner, _)| Place {
        blocks: ids(pair),
        at: centroid(&inner.2),
        nodes: [inner.1[0], inner.1[1]],
        element: body.element_order[inner.0 as usize],
        deepest: 0.0,
    });
    let nodes = found.iter().flat_map(|(inner, _)| inner.1).collect();
    (Unheld::new(found.len(), found.iter().map(ids), worst), nodes)
}
