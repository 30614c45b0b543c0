//! Joints of a mesh that carry less than they look: hinges of beams and shells, beams that stand on shells, trusses that nothing holds
//! across.
//!
//! Nodes of solids and trusses have no rotations. A beam that shares one node with a solid is hinged there, shells that share a line of
//! nodes turn about it, a strut of several trusses folds; nothing else in a run would say so.

mod hinges;
mod struts;
mod studs;

pub use studs::studs;

use crate::common::vector::{cross, dot, subtract};
use crate::mesh::{Block, Dimension, Mesh, Shape};
use crate::model::{Model, Unknown};
use crate::solver::elements::Element;

/// Points that are no farther from a line than this part of its length are on it: what they hold there is too soft to count.
const STRAIGHT: f64 = 1e-4;

/// A joint, or several alike, with what helps.
pub struct Loose {
    /// What is loose, and where, as a sentence.
    pub what: String,
    /// What can be done.
    pub help: &'static str,
}

/// Beams, shells and trusses that what holds them leaves free to move without a force.
pub fn loose(mesh: &Mesh, model: &Model) -> Vec<Loose> {
    if mesh.dimension != Dimension::Three
        || !mesh.blocks.iter().any(|block| block.shape == Shape::Bar || block.shape.is_surface())
    {
        return Vec::new();
    }
    let scene = Scene::of(mesh, model);
    hinges::find(&scene).into_iter().chain(struts::find(&scene)).collect()
}

/// What is at a node of the mesh.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct At {
    /// An element of any kind but a truss.
    body: bool,
    /// A solid that deforms.
    solid: bool,
    /// A beam or a shell that bends.
    turns: bool,
    /// What holds the place alone, by direction.
    place: [bool; 3],
    /// What holds its rotation: a rigid body, a condition on it. Surfaces of TIED CONTACT count, too.
    rotation: bool,
}

impl At {
    /// Whether a condition holds its place in any direction.
    fn is_placed(&self) -> bool {
        self.place.contains(&true)
    }
}

/// What the elements of a block do to rotations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// They bend.
    Turns,
    /// Bars that do not.
    Truss,
    /// Rigid ones.
    Rigid,
    /// All others.
    Other,
}

/// A mesh with what the model makes of it.
struct Scene<'a> {
    mesh: &'a Mesh,
    /// Of each block.
    kinds: Vec<Kind>,
    /// At each node.
    at: Vec<At>,
}

impl Scene<'_> {
    fn of<'a>(mesh: &'a Mesh, model: &Model) -> Scene<'a> {
        let kinds: Vec<Kind> = mesh.blocks.iter().map(|block| kind(block, model)).collect();
        let mut at = vec![At::default(); mesh.coordinates.len()];
        let mut mark =
            |nodes: &[u32], what: &dyn Fn(&mut At)| nodes.iter().for_each(|&node| what(&mut at[node as usize]));
        for (block, kind) in mesh.blocks.iter().zip(&kinds) {
            let solid = block.shape == Shape::Hexahedron;
            mark(&block.nodes, &|at| match kind {
                Kind::Turns => (at.body, at.turns) = (true, true),
                Kind::Rigid => (at.body, at.rotation) = (true, true),
                Kind::Other => (at.body, at.solid) = (true, at.solid || solid),
                Kind::Truss => {}
            });
        }
        let held = model.no_displacements.iter().map(|held| (held.of, held.node_set, held.direction));
        let driven = model.prescribed_motions.iter().map(|driven| (driven.of, driven.node_set, driven.direction));
        for (of, set, direction) in held.chain(driven) {
            mark(&mesh.distinct_nodes(set), &|at| match of {
                Unknown::Position => at.place[direction.axis()] = true,
                Unknown::Rotation => at.rotation = true,
            });
        }
        for set in model.ties.iter().flat_map(|tie| tie.side_sets) {
            mark(&mesh.side_set_nodes(set), &|at| at.rotation = true);
        }
        Scene { mesh, kinds, at }
    }

    /// Blocks of a kind.
    fn blocks(&self, kind: Kind) -> impl Iterator<Item = &Block> {
        self.mesh.blocks.iter().zip(&self.kinds).filter(move |(_, own)| **own == kind).map(|(block, _)| block)
    }

    fn at(&self, node: u32) -> &At {
        &self.at[node as usize]
    }

    fn between(&self, a: u32, b: u32) -> [f64; 3] {
        subtract(self.mesh.coordinates[b as usize], self.mesh.coordinates[a as usize])
    }

    /// A node by its number and its place.
    fn told(&self, node: u32) -> String {
        let [x, y, z] = self.mesh.coordinates[node as usize];
        format!("node {} at ({x:.4e}, {y:.4e}, {z:.4e})", self.mesh.node_ids[node as usize])
    }

    /// The ends of the line on which nodes lie, twice the same for a single place; none where they span a plane.
    fn line(&self, nodes: &[u32]) -> Option<[u32; 2]> {
        let far = |a: u32| {
            let distance = |node: &u32| dot(self.between(a, *node), self.between(a, *node));
            nodes.iter().copied().max_by(|one, other| distance(one).total_cmp(&distance(other)))
        };
        let first = far(*nodes.first()?)?;
        let last = far(first)?;
        let is_place = self.between(first, last) == [0.0; 3];
        let on = |&node: &u32| self.is_on([first, last], node);
        (is_place || nodes.iter().all(on)).then_some([first.min(last), first.max(last)])
    }

    /// Whether a node lies on the line between two others that are apart.
    fn is_on(&self, [first, last]: [u32; 2], node: u32) -> bool {
        let along = self.between(first, last);
        let aside = cross(along, self.between(first, node));
        dot(aside, aside).sqrt() / dot(along, along).max(f64::MIN_POSITIVE) <= STRAIGHT
    }
}

fn kind(block: &Block, model: &Model) -> Kind {
    if model.is_rigid(block.id) {
        return Kind::Rigid;
    }
    match Element::of_block(block, model) {
        Ok(element) if element.bends() => Kind::Turns,
        Ok(_) if block.shape == Shape::Bar => Kind::Truss,
        _ => Kind::Other,
    }
}

/// Blocks in words.
fn blocks(blocks: &[i64]) -> String {
    match blocks {
        [one] => format!("block {one}"),
        many => format!("blocks {}", many.iter().map(i64::to_string).collect::<Vec<_>>().join(", ")),
    }
}
