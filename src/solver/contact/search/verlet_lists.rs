//! Verlet lists: what is near in boxes wider than those of a search, so that many searches only choose from it (Verlet 1967).
//!
//! As long as the search box of every contact node lies within the wide one, everything whose search boxes overlap is in the
//! lists, and what a search chooses from them is what it would find anew. Nodes whose search boxes come out get new wide boxes,
//! and they and the faces and edges around them are looked for alone. Pairs that have parted stay until there are many.

use super::locate::Reach;
use super::neighbourhood::{Extents, Near, SearchResult, find_alone, may_cross, may_touch};
use super::{Box3, Candidates, Search};
use crate::solver::contact::contact_nodes::ContactNodes;
use crate::solver::contact::geometry::edges::Edge;
use crate::solver::contact::geometry::swept_box::SweptBox;
use crate::solver::contact::layout::Layout;

/// Times the steps that a search is made for, for which a wide box is made.
const STEPS: f64 = 3.0;

/// Room of a wide box on all sides beyond that of a search box, in mean sizes of the faces.
const ROOM: f64 = 0.1;

/// When a list has become so many times as long as it was, pairs that have parted are left out.
const LONG: f64 = 1.3;

/// Where more than one in so many contact nodes leaves its wide box from search to search, lists gain nothing.
const MANY: usize = 4;

/// Searches before lists are tried again then.
const REST: u32 = 8;

/// What is near in the wide boxes, on a rank that is alone: there all points are contact nodes, in the same order.
#[derive(Debug, Default)]
pub struct VerletLists {
    /// Whether many have left their wide boxes at the last search, and how many searches are still made without lists.
    many_left: bool,
    rest: u32,
    /// Wide box of each contact node.
    wide: Vec<SweptBox>,
    /// What each edge does.
    roles: Vec<Role>,
    near: Lists,
}

/// Faces near points for each interface, and edges near edges, by their numbers.
#[derive(Debug, Default)]
struct Lists {
    interfaces: Vec<List>,
    edges: List,
}

/// What is near each.
#[derive(Debug, Default)]
struct List {
    pairs: Candidates,
    /// How long it was when what had parted was left out.
    length: usize,
}

/// What an edge does in the search.
#[derive(Debug, Clone, Copy, Default)]
struct Role {
    /// Others may meet it.
    is_met: bool,
    /// It stands out, and looks for others.
    asks: bool,
    /// How far around itself it does so or is met, a length.
    margin: f64,
}

/// Those that look for others or are looked for: by number their wide boxes, empty where they take no part, and whether they are new.
struct Side<'a> {
    boxes: &'a [Box3],
    new: &'a [bool],
}

impl VerletLists {
    /// What the search finds in the search boxes of the contact nodes.
    pub fn find(
        &mut self,
        search: &mut dyn Search,
        layout: &Layout,
        contact_nodes: &ContactNodes,
        (reach, mean_size): (&Reach, f64),
    ) -> SearchResult {
        if self.rest > 0 {
            self.rest -= 1;
            return find_alone(search, layout, contact_nodes);
        }
        let begins = self.wide.is_empty();
        let new = self.widen(contact_nodes, reach, mean_size);
        let many = !begins && MANY * new.iter().filter(|&&new| new).count() > new.len();
        if std::mem::replace(&mut self.many_left, many) && many {
            *self = VerletLists { rest: REST, ..VerletLists::default() };
            return find_alone(search, layout, contact_nodes);
        }
        self.look(search, layout, contact_nodes, &new);
        let extents = Extents::of_search(layout, contact_nodes);
        let (points, faces) = (extents.points(), extents.faces(0..layout.faces.len() as u32));
        let edges = self.edges(&extents);
        let near = Near {
            interfaces: self
                .near
                .interfaces
                .iter()
                .map(|all| all.pairs.overlapping(&points.boxes, &faces.boxes))
                .collect(),
            edges: self.near.edges.pairs.overlapping(&edges, &edges),
        };
        let numbers: Vec<u32> = (0..edges.len() as u32).collect();
        near.of(&points.ids, &numbers)
    }

    /// Boxes of all edges, empty for those that are not met.
    fn edges(&self, extents: &Extents) -> Vec<Box3> {
        let of = |(edge, role): (&Edge, &Role)| {
            if role.is_met { extents.around(&edge.ends).grown(role.margin) } else { Box3::empty() }
        };
        extents.layout.edges.iter().zip(&self.roles).map(of).collect()
    }

    /// Gives contact nodes whose search boxes are not within their wide boxes new ones. Which these are.
    fn widen(&mut self, contact_nodes: &ContactNodes, reach: &Reach, mean_size: f64) -> Vec<bool> {
        let boxes = contact_nodes.search_boxes();
        let begins = self.wide.len() != boxes.len();
        self.wide.resize(boxes.len(), SweptBox::EVERYTHING);
        let is_new = |((i, own), wide): ((u32, &SweptBox), &mut SweptBox)| {
            let is_new = begins || !wide.contains(own);
            if is_new {
                *wide = contact_nodes.box_ahead(i, STEPS * reach.steps, reach.least + ROOM * mean_size);
                // Searches pass by what has no end: the wide box must not be the only one without.
                *wide = if wide.is_finite() && wide.contains(own) { *wide } else { *own };
            }
            is_new
        };
        (0..).zip(boxes).zip(&mut self.wide).map(is_new).collect()
    }

    /// Looks for what is near the contact nodes that have new wide boxes, and near edges that do something else than before.
    fn look(&mut self, search: &mut dyn Search, layout: &Layout, contact_nodes: &ContactNodes, new: &[bool]) {
        self.look_for_edges(search, layout, contact_nodes, new);
        if !new.contains(&true) {
            return;
        }
        let extents = Extents { layout, contact_nodes, boxes: &self.wide };
        let is_new = |of: &[u32; 4]| of.iter().any(|&point| new[point as usize]);
        let new_faces: Vec<bool> = layout.faces.corners.iter().map(is_new).collect();
        let (points, faces) = (extents.points().boxes, extents.faces(0..layout.faces.len() as u32).boxes);
        self.near.interfaces.resize_with(layout.interfaces.len(), List::default);
        for ((number, interface), list) in (0..).zip(&layout.interfaces).zip(&mut self.near.interfaces) {
            let (mut of_points, mut of_faces) = (points.clone(), vec![Box3::empty(); faces.len()]);
            let out = of_points.iter_mut().zip(&interface.points).filter(|(_, takes_part)| !**takes_part);
            out.for_each(|(of, _)| *of = Box3::empty());
            interface.faces.iter().for_each(|&face| of_faces[face as usize] = faces[face as usize]);
            let sides = [Side { boxes: &of_points, new }, Side { boxes: &of_faces, new: &new_faces }];
            list.renew(search, sides, |point, face| may_touch(point, face, number, layout));
        }
    }

    /// The same for edges.
    fn look_for_edges(&mut self, search: &mut dyn Search, layout: &Layout, contact_nodes: &ContactNodes, new: &[bool]) {
        let begins = self.roles.len() != layout.edges.len();
        self.roles.resize(layout.edges.len(), Role::default());
        let mut other_role = vec![begins; layout.edges.len()];
        for (edge, role) in self.roles.iter_mut().enumerate() {
            let [is_met, asks] = [layout.takes_part(edge as u32), layout.edges[edge].stands_out()];
            if begins || [is_met, asks] != [role.is_met, role.asks] {
                *role = Role { is_met, asks, margin: layout.edge_margin(edge as u32) };
                other_role[edge] = true;
            }
        }
        if !begins && other_role.contains(&true) {
            let stays = |edge: usize, other: u32| !other_role[edge] && !other_role[other as usize];
            self.near.edges.pairs.retain(stays);
        }
        let mut is_new = other_role;
        for (is_new, edge) in is_new.iter_mut().zip(&layout.edges) {
            *is_new |= edge.ends.iter().any(|&end| new[end as usize]);
        }
        if !is_new.contains(&true) {
            return;
        }
        let edges = self.edges(&Extents { layout, contact_nodes, boxes: &self.wide });
        let asks = |(of, role): (&Box3, &Role)| if role.asks { *of } else { Box3::empty() };
        let asking: Vec<Box3> = edges.iter().zip(&self.roles).map(asks).collect();
        let sides = [Side { boxes: &asking, new: &is_new }, Side { boxes: &edges, new: &is_new }];
        self.near.edges.renew(search, sides, |edge, other| edge != other && may_cross(edge, other, layout));
    }
}

impl List {
    /// Adds what is near those that are new on either side and may ever touch, as `keep` says; leaves out what has parted when that has
    /// become much.
    fn renew(&mut self, search: &mut dyn Search, [askers, others]: [Side; 2], keep: impl Fn(u32, u32) -> bool) {
        self.pairs.extend_to(askers.boxes.len());
        let all = |_| true;
        let (own, theirs) = (|i: usize| askers.new[i], |i: usize| others.new[i]);
        let mut pairs = Vec::new();
        if let Some(near) = around(&askers, own) {
            let (own, others) = (chosen(&askers, own, None), chosen(&others, all, Some(near)));
            overlaps(search, own, others, &mut pairs);
        }
        if let Some(near) = around(&others, theirs) {
            let (own, others) = (chosen(&askers, |i| !own(i), Some(near)), chosen(&others, theirs, None));
            overlaps(search, own, others, &mut pairs);
        }
        pairs.retain(|&(asker, other)| keep(asker, other));
        // Two ascending runs.
        pairs.sort();
        self.pairs.insert(&pairs);
        if self.pairs.len() as f64 > LONG * self.length as f64 {
            self.pairs = self.pairs.overlapping(askers.boxes, others.boxes);
            self.length = self.pairs.len();
        }
    }
}

/// Box around the sound boxes of those of a side of which `choose` says so, if there are any.
fn around(side: &Side, choose: impl Fn(usize) -> bool) -> Option<Box3> {
    let sound = side.boxes.iter().enumerate().filter(|(i, of)| choose(*i) && of.is_sound());
    sound.fold(None, |all, (_, of)| Some(all.map_or(*of, |all: Box3| all.joined(of))))
}

/// Those of a side of which `choose` says so, `near` to some box, and their boxes.
fn chosen(side: &Side, choose: impl Fn(usize) -> bool, near: Option<Box3>) -> (Vec<u32>, Vec<Box3>) {
    let all = (0..).zip(side.boxes).filter(|(i, of)| choose(*i as usize) && near.is_none_or(|near| near.overlaps(of)));
    all.map(|(i, of)| (i, *of)).unzip()
}

/// Appends all pairs of two sets whose boxes overlap, ascending.
fn overlaps(
    search: &mut dyn Search,
    (askers, asker_boxes): (Vec<u32>, Vec<Box3>),
    (others, other_boxes): (Vec<u32>, Vec<Box3>),
    pairs: &mut Vec<(u32, u32)>,
) {
    if askers.is_empty() || others.is_empty() {
        return;
    }
    let mut found = Candidates::default();
    search.find(&asker_boxes, &other_boxes, &vec![[u32::MAX; 4]; others.len()], &mut found);
    pairs.reserve(found.len());
    for (place, &asker) in askers.iter().enumerate() {
        pairs.extend(found.of(place).iter().map(|&other| (asker, others[other as usize])));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::contact::search::SearchKind;
    use proptest::prelude::*;

    fn cube(middle: [f64; 3], half: f64) -> Box3 {
        Box3::around(&[middle]).grown(half)
    }

    /// Box of a step, and the wide one where the former has left it; whether it has.
    fn follow(middle: &[[f64; 3]], wide: &mut [Box3]) -> (Vec<Box3>, Vec<bool>) {
        let inside = |one: &Box3, wide: &Box3| one.joined(wide) == *wide;
        let boxes: Vec<Box3> = middle.iter().map(|&middle| cube(middle, 0.1)).collect();
        let new: Vec<bool> = boxes.iter().zip(&*wide).map(|(one, wide)| !inside(one, wide)).collect();
        for ((wide, &middle), _) in wide.iter_mut().zip(middle).zip(&new).filter(|(_, new)| **new) {
            *wide = cube(middle, 0.2);
        }
        (boxes, new)
    }

    proptest! {
        #[test]
        fn lists_have_all_that_overlaps(
            mut askers in prop::collection::vec(prop::array::uniform3(0.0..1.0), 1..40),
            mut others in prop::collection::vec(prop::array::uniform3(0.0..1.0), 1..40),
            ways in prop::collection::vec(prop::array::uniform3(-0.1..0.1), 80),
            kind in prop::sample::select(&SearchKind::ALL[..]),
        ) {
            let mut search = kind.make();
            let mut list = List::default();
            let [mut wide, mut wide_others] = [askers.len(), others.len()].map(|count| vec![Box3::empty(); count]);
            let keep = |asker: u32, other: u32| !(asker + 2 * other).is_multiple_of(5);
            for step in 0..12 {
                // Half of them rest for a while.
                let moving = askers.iter_mut().chain(&mut others).zip(&ways).skip(step % 2).step_by(2);
                moving.for_each(|(at, way)| (0..3).for_each(|axis| at[axis] += way[axis]));
                let (own, new) = follow(&askers, &mut wide);
                let (theirs, new_others) = follow(&others, &mut wide_others);
                let sides = [Side { boxes: &wide, new: &new }, Side { boxes: &wide_others, new: &new_others }];
                list.renew(&mut *search, sides, keep);
                let chosen = list.pairs.overlapping(&own, &theirs);
                for (asker, one) in own.iter().enumerate() {
                    let near = |other: &u32| one.overlaps(&theirs[*other as usize]) && keep(asker as u32, *other);
                    let expected: Vec<u32> = (0..theirs.len() as u32).filter(near).collect();
                    prop_assert_eq!(chosen.of(asker), &expected[..]);
                }
            }
        }
    }
}
