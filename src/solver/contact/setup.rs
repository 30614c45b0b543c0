//! What the deck lets touch, found in the mesh: points, faces, interfaces, and what holds between them.

use super::faces::Faces;
use super::locate::{Interface, Rule};
use super::surface::{Surface, face_nodes};
use crate::mesh::Mesh;
use crate::model::{Contact, ContactMaterials, Friction, Model};
use crate::solver::Body;

/// No point.
pub const ABSENT: u32 = u32::MAX;

/// What holds where a point of one kind touches a face of another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pairing {
    /// Coulomb friction.
    pub friction: Friction,
    /// Share of the slave role of the point, that of the master role of the face.
    pub share: f64,
}

/// Pairings by the blocks of point and face, and by interface.
#[derive(Debug, Clone, Default)]
pub struct Pairings {
    blocks: Vec<Pairing>,
    count: usize,
    pairs: Vec<Pairing>,
}

impl Pairings {
    /// What holds where a point of block `point` touches a face of block `face` through an interface.
    pub fn of(&self, rule: Rule, point: u32, face: u32) -> Pairing {
        match rule {
            Rule::Blocks => self.blocks[point as usize * self.count + face as usize],
            Rule::Pair(number) => self.pairs[number as usize],
        }
    }

    fn new(mesh: &Mesh, model: &Model, body: &Body) -> Pairings {
        let count = mesh.blocks.len();
        let impedance = |block: usize| {
            let material = &model.materials[body.block_material[block]];
            (material.density * material.law.moduli().dilatational()).sqrt()
        };
        let pairing = |point: usize, face: usize| {
            let ids = [mesh.blocks[point].id, mesh.blocks[face].id];
            let by_impedance = if point == face { 0.5 } else { impedance(face) / (impedance(point) + impedance(face)) };
            // The last command about two blocks holds, whichever it names first.
            let data = model.contact.data.iter().rev().find_map(|data| match data.materials {
                [a, b] if [b, a] == ids => Some((data, data.partition)),
                [a, b] if [a, b] == ids => Some((data, data.partition.map(|partition| 1.0 - partition))),
                _ => None,
            });
            match data {
                Some((data, share)) => Pairing { friction: data.friction, share: share.unwrap_or(by_impedance) },
                None => Pairing { friction: Friction::default(), share: by_impedance },
            }
        };
        let blocks = (0..count * count).map(|i| pairing(i / count, i % count)).collect();
        let pairs = model.contact.surfaces.iter().flat_map(|pair| {
            // Points of the first set on faces of the second, then the other way round.
            [1.0 - pair.partition, pair.partition].map(|share| Pairing { friction: pair.friction, share })
        });
        Pairings { blocks, count, pairs: pairs.collect() }
    }
}

/// Everything that contact needs to know of the mesh.
pub struct Layout {
    /// Node of the mesh of each point, ascending.
    pub nodes: Vec<u32>,
    /// Block of each point: that of the first of its faces.
    pub point_block: Vec<u32>,
    /// Faces.
    pub faces: Faces,
    /// The analyst's number of the element of each face.
    pub face_element: Vec<i64>,
    /// Interfaces; explicit pairs first.
    pub interfaces: Vec<Interface>,
    /// What holds where they touch.
    pub pairings: Pairings,
}

impl Layout {
    /// Finds the surfaces. `more` are nodes that are points although they may not be on any face.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body, more: &[u32]) -> Layout {
        let automatic = automatic_faces(mesh, &model.contact, body);
        let sets = side_set_faces(mesh, &model.contact, body);
        let mut numbers: Vec<u32> = automatic.iter().chain(sets.iter().flatten()).copied().collect();
        numbers.sort_unstable();
        numbers.dedup();
        let mut nodes: Vec<u32> = numbers.iter().flat_map(|&face| face_nodes(&body.element_nodes, face)).collect();
        nodes.extend(more);
        nodes.sort_unstable();
        nodes.dedup();
        let point = |node: u32| nodes.binary_search(&node).map_or(ABSENT, |point| point as u32);
        let faces = Faces::new(&numbers, body, point, nodes.len());
        let interfaces = interfaces(&faces, &automatic, &sets, nodes.len());
        let block = |point: u32| faces.around(point).first().map_or(0, |&face| faces.block[face as usize]);
        Layout {
            point_block: (0..nodes.len() as u32).map(block).collect(),
            pairings: Pairings::new(mesh, model, body),
            face_element: numbers
                .iter()
                .map(|&face| mesh.element_ids[body.element_order[face as usize / 6] as usize])
                .collect(),
            nodes,
            faces,
            interfaces,
        }
    }
}

impl Layout {
    /// The interface of CONTACT MATERIAL.
    pub fn automatic(&self) -> Option<&Interface> {
        self.interfaces.iter().find(|interface| interface.rule == Rule::Blocks)
    }
}

/// Exterior faces of the blocks that CONTACT MATERIAL names.
fn automatic_faces(mesh: &Mesh, contact: &Contact, body: &Body) -> Vec<u32> {
    let chosen = |block: u32| match &contact.materials {
        None => false,
        Some(ContactMaterials::All) => true,
        Some(ContactMaterials::Blocks(ids)) => ids.contains(&mesh.blocks[block as usize].id),
    };
    if contact.materials.is_none() {
        return Vec::new();
    }
    let mut wanted = vec![false; body.positions.len()];
    for (nodes, _) in body.element_nodes.iter().zip(&body.element_block).filter(|(_, block)| chosen(**block)) {
        nodes.iter().for_each(|&node| wanted[node as usize] = true);
    }
    let surface = Surface::new(&body.element_nodes, body.positions.len(), |node| wanted[node as usize]);
    surface.exterior().filter(|&face| chosen(body.element_block[face as usize / 6])).collect()
}

/// Faces of the side sets of each CONTACT SURFACE, two lists for each, ascending.
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
        let mut faces: Vec<u32> =
            sides.iter().map(|&(element, side)| 6 * canonical[element as usize] + u32::from(side)).collect();
        faces.sort_unstable();
        faces.dedup();
        faces
    };
    contact.surfaces.iter().flat_map(|pair| pair.side_sets.map(list)).collect()
}

fn interfaces(faces: &Faces, automatic: &[u32], sets: &[Vec<u32>], points: usize) -> Vec<Interface> {
    let places = |numbers: &[u32]| -> Vec<u32> {
        numbers.iter().filter_map(|number| faces.number.binary_search(number).ok().map(|place| place as u32)).collect()
    };
    let corners = |places: &[u32]| {
        let mut taken = vec![false; points];
        places.iter().flat_map(|&face| faces.corners[face as usize]).for_each(|point| taken[point as usize] = true);
        taken
    };
    let mut interfaces = Vec::new();
    for (number, pair) in sets.chunks_exact(2).enumerate() {
        let [first, second] = [places(&pair[0]), places(&pair[1])];
        let rule = |side: u32| Rule::Pair(2 * number as u32 + side);
        if first != second {
            interfaces.push(Interface { points: corners(&first), faces: second.clone(), rule: rule(0) });
        }
        interfaces.push(Interface { points: corners(&second), faces: first, rule: rule(1) });
    }
    if !automatic.is_empty() {
        let faces = places(automatic);
        interfaces.push(Interface { points: corners(&faces), faces, rule: Rule::Blocks });
    }
    interfaces
}
