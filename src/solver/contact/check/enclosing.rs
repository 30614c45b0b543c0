//! Elements of other bodies in which points are, by the elements alone: a second opinion on what faces say.

use super::initial_overlap::{is_inside, seen_larger};
use crate::mesh::plane;
use crate::solver::Body;
use crate::solver::contact::search::{Box3, Candidates, SearchKind};
use crate::solver::contact::surface::layout::Layout;

/// Solid elements, and those of them that are near each of some points.
pub struct Enclosing<'a> {
    body: &'a Body,
    layout: &'a Layout,
    /// Each by its number in canonical order, and its nodes as [`plane::eight`] has them.
    elements: Vec<(u32, [u32; 8])>,
    /// Where each point of the layout is looked for; `None` where it is not.
    places: Vec<Option<[f64; 3]>>,
    near: Candidates,
}

impl<'a> Enclosing<'a> {
    /// Looks for points of the layout by their places, where these are given.
    pub fn new(
        body: &'a Body,
        layout: &'a Layout,
        elements: Vec<(u32, [u32; 8])>,
        places: Vec<Option<[f64; 3]>>,
    ) -> Enclosing<'a> {
        let mut enclosing = Enclosing { body, layout, elements, places, near: Candidates::default() };
        let all = 0..enclosing.elements.len() as u32;
        let boxes: Vec<Box3> = all.map(|element| Box3::around(&enclosing.corners(element))).collect();
        let one = |at: &Option<[f64; 3]>| at.map_or(Box3::empty(), |at| Box3::around(&[at]));
        let points: Vec<Box3> = enclosing.places.iter().map(one).collect();
        let mut near = Candidates::default();
        SearchKind::Grid.make().find(&points, &boxes, &vec![[u32::MAX; 4]; boxes.len()], &mut near);
        enclosing.near = near;
        enclosing
    }

    /// Elements, by their numbers in canonical order, in which the place of a point is that is no corner of theirs.
    pub fn of(&self, point: usize) -> impl Iterator<Item = u32> + '_ {
        let (node, at) = (self.layout.nodes[point], self.places[point]);
        let near = self.near.of(point).iter().map(|&element| (element, &self.elements[element as usize]));
        let holding = near.filter(move |(element, (_, nodes))| {
            !nodes.contains(&node) && at.is_some_and(|at| is_inside(&self.corners(*element), at))
        });
        holding.map(|(_, (element, _))| *element)
    }

    /// Corners of an element. Nodes of meshes that match may be between two elements, where round-off would leave them in neither.
    fn corners(&self, element: u32) -> [[f64; 3]; 8] {
        seen_larger(&plane::solid(&self.body.corners(&self.elements[element as usize].1)))
    }
}
