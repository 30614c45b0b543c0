//! The surfaces that the deck lets touch, found in the mesh, and layouts made of them, again when elements go.

use super::exclusions::Exclusions;
use super::layout::{ABSENT, Layout};
use super::touching::Touching;
use crate::mesh::{Connectivity, Coordinates, Dimension, Mesh, exterior};
use crate::model::{Contact, ContactEdges, Model};
use crate::solver::Body;
use crate::solver::contact::geometry::edges;
use crate::solver::contact::geometry::faces::Faces;
use crate::solver::contact::geometry::sides::HiddenSides;
use crate::solver::contact::geometry::surface::{Surface, back_nodes, face_nodes};
use crate::solver::contact::observations::meetings;
use crate::solver::contact::search::Box3;
use crate::solver::contact::search::locate::{Interface, Rule};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Middle of the box around some points, or what is left of one without end.
fn middle(positions: &[[f64; 3]]) -> [f64; 3] {
    let of = Box3::around(positions);
    let middle = [0, 1, 2].map(|axis| 0.5 * of.low[axis] + 0.5 * of.high[axis]);
    middle.map(|x| if x.is_finite() { x } else { 0.0 })
}

/// What layouts are made of, and made of again when elements go. Copies share what is large.
#[derive(Clone)]
pub struct Skin {
    element_order: Arc<Vec<u32>>,
    element_nodes: Arc<Connectivity>,
    element_block: Arc<Vec<u32>>,
    positions: Coordinates,
    /// Those of the points, once nothing else is left.
    of_points: Coordinates,
    /// Whether CONTACT MATERIAL names a block.
    chosen: Vec<bool>,
    /// Which faces are across from each other, where elements may go.
    surface: Option<Arc<Surface>>,
    /// Faces of the side sets of each CONTACT SURFACE, two lists for each, ascending.
    sets: Vec<Vec<u32>>,
    /// The outer faces of the elements of those, ascending, as the mesh has them.
    around_sets: Arc<Vec<u32>>,
    /// Nodes that are points although they may not be on any face.
    more: Vec<u32>,
    /// Nodes that TIED CONTACT joins, ascending, each with those that it follows or that follow it.
    joined: Vec<(u32, Vec<u32>)>,
    /// Which edges may touch edges.
    edges_wanted: ContactEdges,
    exclusions: Arc<Exclusions>,
    /// See [`Body::rooms`].
    rooms: Vec<(u32, f64)>,
    /// At what distance elements touch, and those of the chosen blocks whose nodes do, as long as they are there.
    touching: Touching,
    /// Nodes that have lost their last face, or all their elements before they had one, and go on as free points, each with the block of the faces it had
    /// or of its elements.
    pub(in crate::solver::contact) free: Vec<(u32, u32)>,
}

impl Skin {
    /// Finds the surfaces. `more` are nodes that are points although they may not be on any face.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body, more: Vec<u32>) -> Skin {
        let contact = &model.contact;
        let chosen: Vec<bool> = mesh.blocks.iter().map(|block| contact.names(block.id)).collect();
        let sets = side_set_faces(mesh, contact, body);
        Skin {
            element_order: body.element_order.clone(),
            element_nodes: body.element_nodes.clone(),
            element_block: body.element_block.clone(),
            positions: body.positions.clone(),
            of_points: Coordinates::default(),
            surface: contact.materials.is_some().then(|| Arc::new(surface(&chosen, body))),
            around_sets: Arc::new(around(&sets, body)),
            sets,
            more,
            joined: body.tied.joined(),
            // In the plane the edges are the faces.
            touching: Touching::of_chosen(Touching::new(mesh, model, body), |element| {
                chosen[body.element_block[element as usize] as usize]
            }),
            edges_wanted: if mesh.dimension == Dimension::Two { ContactEdges::None } else { contact.control.edges },
            exclusions: Arc::new(Exclusions::new(mesh, model)),
            rooms: body.rooms.clone(),
            free: Vec::new(),
            chosen,
        }
    }

    /// The same without any distance at which surfaces and bars touch.
    pub fn without_thickness(self) -> Skin {
        Skin { touching: self.touching.without_distances(), ..self }
    }

    /// Lets go of what only a surface asks for from which elements go, once it is laid out.
    pub fn settle(&mut self, layout: &Layout) {
        self.of_points = self.positions(&layout.nodes).into();
        self.surface = None;
    }

    /// Lets go of the body, of which a surface that is settled asks for nothing more once the run has been set up.
    pub fn release_construction_data(&mut self) {
        self.positions = Coordinates::default();
        (self.element_nodes, self.element_block, self.around_sets) = Default::default();
    }

    /// Initial positions of the points of a layout.
    pub fn of_points(&self, layout: &Layout) -> Coordinates {
        if self.of_points.is_empty() { self.positions(&layout.nodes).into() } else { self.of_points.clone() }
    }

    /// Initial positions of some nodes of the mesh.
    fn positions(&self, nodes: &[u32]) -> Vec<[f64; 3]> {
        nodes.iter().map(|&node| self.positions[node as usize]).collect()
    }

    /// Nodes of a face by its number, and of the side across the element from it.
    pub fn sides(&self, face: u32) -> [[u32; 4]; 2] {
        [face_nodes(&self.element_nodes, face), back_nodes(&self.element_nodes, face)]
    }

    /// Place in the mesh file, from 1, of the element of a face.
    pub fn file_number(&self, face: u32) -> f64 {
        f64::from(self.element_order[face as usize / 6] + 1)
    }

    /// Points, faces and interfaces as they are now.
    pub fn layout(&self) -> Layout {
        let automatic: Vec<u32> = self.outside().collect();
        let mut numbers: Vec<u32> = automatic.iter().chain(self.sets.iter().flatten()).copied().collect();
        numbers.sort_unstable();
        numbers.dedup();
        let mut nodes: Vec<u32> = numbers.iter().flat_map(|&face| face_nodes(&self.element_nodes, face)).collect();
        nodes.extend(self.more.iter().copied().chain(self.free.iter().map(|(node, _)| *node)));
        nodes.extend(self.balls().map(|(node, ..)| node));
        nodes.sort_unstable();
        nodes.dedup();
        nodes.shrink_to_fit();
        let mut layout =
            Layout { nodes: nodes.into(), lines: self.edges_wanted == ContactEdges::All, ..Default::default() };
        layout.origin = middle(&self.positions(&layout.nodes));
        let points = layout.nodes.len();
        if !self.joined.is_empty() {
            let mut joined = vec![Vec::new(); points];
            for (node, others) in &self.joined {
                let point = layout.point(*node);
                if let Some(own) = joined.get_mut(point as usize) {
                    own.extend(
                        others.iter().filter_map(|other| layout.nodes.binary_search(other).ok()).map(|p| p as u32),
                    );
                }
            }
            layout.joined = joined.into();
        }
        let body = (&*self.element_nodes, &self.element_block[..], &self.positions[..]);
        let distance = |element| self.touching.distance(element);
        let mut faces = Faces::new(&numbers, body, (|node| layout.point(node), points), distance);
        let mut blocks = vec![None; if self.balls().next().is_none() { 0 } else { points }];
        for (node, radius, block) in self.balls() {
            let point = layout.point(node) as usize;
            faces.node_reach[point] = faces.node_reach[point].max(radius);
            blocks[point].get_or_insert(block);
        }
        faces.grow_together(|| self.positions(&layout.nodes));
        faces.set_hidden_sides(HiddenSides::of(&numbers, &self.around_sets, (&self.element_nodes, &self.positions)));
        for &(node, part) in &self.rooms {
            faces.limit_room(layout.point(node), part);
        }
        layout.faces = Arc::new(faces);
        let faces = &layout.faces;
        let of_ball = |point: u32| blocks.get(point as usize).copied().flatten().unwrap_or(0);
        let block = |point: u32| faces.around(point).first().map_or(of_ball(point), |&face| faces.block[face as usize]);
        let mut point_block: Vec<u32> = (0..points as u32).map(block).collect();
        for &(node, block) in &self.free {
            point_block[layout.point(node) as usize] = block;
        }
        layout.point_block = point_block.into();
        layout.blocks_around = meetings::blocks_around(&layout);
        layout.exclusions = self.exclusions.clone();
        layout.interfaces = self.interfaces(&layout, &automatic).into();
        if let Some(automatic) = layout.automatic().filter(|_| self.edges_wanted != ContactEdges::None) {
            let positions = self.positions(&layout.nodes);
            let surfaces = automatic.faces.iter().any(|&face| layout.faces.is_two_sided(face));
            let edges = edges::between(&automatic.faces, &layout.faces, &positions, layout.lines || surfaces);
            layout.edges = edges.into();
            layout.surfaces = surfaces;
        }
        layout
    }

    /// Takes elements away. Nodes that lose their last face, or all their elements before they had one, and that `keeps` wants become free points.
    pub fn delete(&mut self, elements: &[u32], old: &Layout, keeps: impl Fn(u32) -> bool) {
        self.touching.delete(elements);
        let Some(surface) = &mut self.surface else { return self.shorten_sets(elements) };
        let surface = Arc::make_mut(surface);
        elements.iter().for_each(|&element| surface.delete(element));
        self.shorten_sets(elements);
        let Some(automatic) = old.automatic() else { return };
        let mut on_a_face = vec![false; old.nodes.len()];
        let mut inner = self.not_outside(elements, old);
        for face in self.outside() {
            for node in face_nodes(&self.element_nodes, face) {
                match on_a_face.get_mut(old.point(node) as usize) {
                    Some(on) => *on = true,
                    None => _ = inner.remove(&node),
                }
            }
        }
        for (node, ..) in self.balls() {
            if let Some(on) = on_a_face.get_mut(old.point(node) as usize) {
                *on = true;
            }
        }
        let lost = (0..old.nodes.len()).filter(|&point| automatic.points[point] && !on_a_face[point]);
        self.free = lost.map(|p| (old.nodes[p], old.point_block[p])).filter(|(node, _)| keeps(*node)).collect();
        self.free.extend(inner.into_iter().filter(|(node, _)| keeps(*node)));
        self.free.sort_unstable();
    }

    /// Nodes of elements of the chosen blocks that no face had before these went, each with the first block of them.
    fn not_outside(&self, gone: &[u32], old: &Layout) -> BTreeMap<u32, u32> {
        let mut inner = BTreeMap::new();
        for &element in gone {
            let block = self.element_block[element as usize];
            if self.chosen[block as usize] {
                for &node in self.element_nodes[element as usize].iter().filter(|&&node| old.point(node) == ABSENT) {
                    inner.entry(node).and_modify(|first: &mut u32| *first = block.min(*first)).or_insert(block);
                }
            }
        }
        inner
    }

    /// Nodes that touch as balls, once for each of their elements, with radius and block.
    fn balls(&self) -> impl Iterator<Item = (u32, f64, u32)> + '_ {
        let of = |&element: &u32| {
            let (radius, block) = (self.touching.distance(element), self.element_block[element as usize]);
            self.element_nodes[element as usize].iter().map(move |&node| (node, radius, block))
        };
        let single = self.touching.single.iter().map(|single| (single.node, single.radius, single.block));
        self.touching.of_nodes.iter().flat_map(of).chain(single)
    }

    fn shorten_sets(&mut self, dead: &[u32]) {
        for set in &mut self.sets {
            set.retain(|face| dead.binary_search(&(face / 6)).is_err());
        }
    }

    /// Exterior faces of the chosen blocks.
    fn outside(&self) -> impl Iterator<Item = u32> + '_ {
        let exterior = self.surface.iter().flat_map(|surface| surface.exterior());
        exterior.filter(|&face| self.chosen[self.element_block[face as usize / 6] as usize])
    }

    fn interfaces(&self, layout: &Layout, automatic: &[u32]) -> Vec<Interface> {
        let places = |numbers: &[u32]| -> Vec<u32> { numbers.iter().map(|&number| layout.face(number)).collect() };
        let corners = |places: &[u32]| {
            let mut taken = vec![false; layout.nodes.len()];
            let corners = places.iter().flat_map(|&face| layout.faces.corners[face as usize]);
            corners.for_each(|point| taken[point as usize] = true);
            taken
        };
        let mut interfaces = Vec::new();
        for (number, pair) in self.sets.chunks_exact(2).enumerate() {
            let [first, second] = [places(&pair[0]), places(&pair[1])];
            let rule = |side: u32| Rule::Pair(2 * number as u32 + side);
            if first != second {
                interfaces.push(Interface { points: corners(&first), faces: second.clone(), rule: rule(0) });
            }
            interfaces.push(Interface { points: corners(&second), faces: first, rule: rule(1) });
        }
        if !automatic.is_empty() {
            let faces = places(automatic);
            let mut points = corners(&faces);
            self.balls().for_each(|(node, ..)| points[layout.point(node) as usize] = true);
            self.free.iter().for_each(|&(node, _)| points[layout.point(node) as usize] = true);
            interfaces.push(Interface { points, faces, rule: Rule::Blocks });
        }
        interfaces
    }
}

/// The surface of the chosen blocks and of what is joined to them.
fn surface(chosen: &[bool], body: &Body) -> Surface {
    let mut wanted = vec![false; body.positions.len()];
    let elements = body.element_nodes.iter().zip(&*body.element_block);
    for (nodes, _) in elements.filter(|(_, block)| chosen[**block as usize]) {
        nodes.iter().for_each(|&node| wanted[node as usize] = true);
    }
    Surface::new(&body.element_nodes, body.positions.len(), |node| wanted[node as usize])
}

/// The outer faces of the solid elements of some faces, ascending.
fn around(sets: &[Vec<u32>], body: &Body) -> Vec<u32> {
    let solid = |face: &&u32| !body.element_nodes.shape(**face as usize / exterior::SIDES).is_surface();
    let mut elements: Vec<u32> =
        sets.iter().flatten().filter(solid).map(|face| face / exterior::SIDES as u32).collect();
    if elements.is_empty() {
        return Vec::new();
    }
    elements.sort_unstable();
    elements.dedup();
    let mut wanted = vec![false; body.positions.len()];
    let nodes = elements.iter().flat_map(|&element| &body.element_nodes[element as usize]);
    nodes.for_each(|&node| wanted[node as usize] = true);
    let mut faces = exterior::exterior(body.element_nodes.shaped(), body.positions.len(), |node| wanted[node as usize]);
    faces.retain(|face| elements.binary_search(&(face / exterior::SIDES as u32)).is_ok());
    faces
}

fn side_set_faces(mesh: &Mesh, contact: &Contact, body: &Body) -> Vec<Vec<u32>> {
    if contact.surfaces.is_empty() {
        return Vec::new();
    }
    let mut canonical = vec![0u32; body.element_order.len()];
    for (place, &file) in body.element_order.iter().enumerate() {
        canonical[file as usize] = place as u32;
    }
    let list = |id: i64| {
        let sides = mesh.side_set(id).map_or(&[][..], |set| &set.sides);
        // Edges of surfaces are sides as well, but no faces.
        let is_face = |element: u32, side: u8| body.element_nodes.shape(element as usize).is_face(side);
        let sides = sides.iter().map(|&(element, side)| (canonical[element as usize], side));
        let sides = sides.filter(|&(element, side)| is_face(element, side));
        let mut faces: Vec<u32> = sides.map(|(element, side)| 6 * element + u32::from(side)).collect();
        faces.sort_unstable();
        faces.dedup();
        faces
    };
    contact.surfaces.iter().flat_map(|pair| pair.side_sets.map(list)).collect()
}
