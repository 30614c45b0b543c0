//! Where elements whose nodes turn meet others: joints that carry no moment, or one only softly.
//!
//! Nodes of solids and trusses have no rotations. A beam that shares one node with a solid is hinged there, shells that share a line of
//! nodes turn about it; nothing else in a run would say so.

use std::collections::{BTreeMap, BTreeSet};

use super::{Model, Problem, conditions::boundary::Unknown};
use crate::common::disjoint_sets::DisjointSets;
use crate::common::vector::{cross, dot, normalized, subtract};
use crate::deck::{Diagnostic, Diagnostics};
use crate::mesh::{Block, Dimension, Mesh, Shape};

/// Points that are no farther from a line than this part of its length are on it: what they hold there is too soft to count.
const STRAIGHT: f64 = 1e-4;

/// Cosine of the angle to the normal of a shell below which a beam rather lies in the shell than stands on it.
const STANDS: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// What is at a node of the mesh.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct At {
    /// A solid that deforms.
    solid: bool,
    /// A beam or a shell that bends.
    turns: bool,
    /// What holds the place alone.
    place: bool,
    /// What holds its rotation: a rigid body, a condition on it. Surfaces of TIED CONTACT count, too.
    rotation: bool,
}

/// Whether the nodes of a block turn, and their rotations are its own to hold.
fn turns(block: &Block, model: &Model) -> bool {
    let is_membrane =
        || model.section("INTEGRATION POINTS", block.id).is_some_and(|section| section.number("points") < 1.5);
    match block.shape {
        Shape::Bar => model.section("BEAM SECTION", block.id).is_some() && !model.is_rigid(block.id),
        shape => shape.is_surface() && !model.is_rigid(block.id) && !is_membrane(),
    }
}

/// What is at each node.
fn nodes(model: &Model, mesh: &Mesh) -> Vec<At> {
    let mut at = vec![At::default(); mesh.coordinates.len()];
    let mut mark = |nodes: &[u32], what: fn(&mut At)| nodes.iter().for_each(|&node| what(&mut at[node as usize]));
    for block in &mesh.blocks {
        if model.is_rigid(block.id) {
            mark(&block.nodes, |at| at.rotation = true);
        } else if turns(block, model) {
            mark(&block.nodes, |at| at.turns = true);
        } else if block.shape == Shape::Hexahedron {
            mark(&block.nodes, |at| at.solid = true);
        }
    }
    let held = model.no_displacements.iter().map(|held| (held.of, held.node_set));
    let driven = model.prescribed_motions.iter().map(|driven| (driven.of, driven.node_set));
    for (of, set) in held.chain(driven) {
        let what: fn(&mut At) = match of {
            Unknown::Position => |at| at.place = true,
            Unknown::Rotation => |at| at.rotation = true,
        };
        mark(&mesh.distinct_nodes(set), what);
    }
    for set in model.ties.iter().flat_map(|tie| tie.side_sets) {
        mark(&mesh.side_set_nodes(set), |at| at.rotation = true);
    }
    at
}

/// Parts of the mesh that hang together by elements whose nodes turn, as sets of nodes.
fn parts(model: &Model, mesh: &Mesh) -> DisjointSets {
    let mut parts = DisjointSets::new(mesh.coordinates.len());
    for nodes in mesh.blocks.iter().filter(|block| turns(block, model)).flat_map(Block::elements) {
        nodes.windows(2).for_each(|pair| parts.join(pair[0], pair[1]));
    }
    parts
}

/// The ends of the line on which nodes lie, twice the same for a single place; none where they span a plane.
fn line(mesh: &Mesh, nodes: &[u32]) -> Option<[u32; 2]> {
    let from = |a: u32, b: u32| subtract(mesh.coordinates[b as usize], mesh.coordinates[a as usize]);
    let far = |a: u32| {
        let distance = |node: &u32| dot(from(a, *node), from(a, *node));
        nodes.iter().copied().max_by(|one, other| distance(one).total_cmp(&distance(other)))
    };
    let first = far(*nodes.first()?)?;
    let last = far(first)?;
    let along = from(first, last);
    let off = |node: u32| {
        let aside = cross(along, from(first, node));
        dot(aside, aside).sqrt() / dot(along, along).max(f64::MIN_POSITIVE)
    };
    let is_place = dot(along, along) == 0.0;
    (is_place || nodes.iter().all(|&node| off(node) <= STRAIGHT)).then_some([first.min(last), first.max(last)])
}

/// Warns of beams and shells that solids, and what else holds them, leave free to turn about a point or a line.
pub(super) fn check(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let model = &problem.model;
    let solid = mesh.blocks.iter().any(|block| block.shape == Shape::Hexahedron);
    if mesh.dimension != Dimension::Three || !solid || !mesh.blocks.iter().any(|block| turns(block, model)) {
        return;
    }
    let at = nodes(model, mesh);
    let mut parts = parts(model, mesh);
    let holds = (0u32..).zip(&at).filter(|(_, at)| at.turns && (at.solid || at.place || at.rotation));
    let mut holds: Vec<(u32, u32)> = holds.map(|(node, _)| (parts.least(node), node)).collect();
    holds.sort_unstable();
    let mut hinges: BTreeMap<u32, [u32; 2]> = BTreeMap::new();
    for part in holds.chunk_by(|one, other| one.0 == other.0) {
        let nodes: Vec<u32> = part.iter().map(|(_, node)| *node).collect();
        let any = |what: fn(&At) -> bool| nodes.iter().any(|&node| what(&at[node as usize]));
        if any(|at| at.solid) && !any(|at| at.rotation) {
            hinges.extend(line(mesh, &nodes).map(|ends| (part[0].0, ends)));
        }
    }
    tell(mesh, model, &mut parts, &hinges, found);
}

/// Tells of hinges by the ends of their lines, once for all parts of the same blocks.
fn tell(
    mesh: &Mesh,
    model: &Model,
    parts: &mut DisjointSets,
    hinges: &BTreeMap<u32, [u32; 2]>,
    found: &mut Diagnostics,
) {
    if hinges.is_empty() {
        return;
    }
    let mut blocks_of: BTreeMap<u32, BTreeSet<i64>> = BTreeMap::new();
    for block in mesh.blocks.iter().filter(|block| turns(block, model)) {
        for root in block.elements().map(|nodes| parts.least(nodes[0])).filter(|root| hinges.contains_key(root)) {
            blocks_of.entry(root).or_default().insert(block.id);
        }
    }
    let mut alike: BTreeMap<Vec<i64>, Vec<[u32; 2]>> = BTreeMap::new();
    for (root, blocks) in blocks_of {
        alike.entry(blocks.into_iter().collect()).or_default().extend(hinges.get(&root));
    }
    for (blocks, hinges) in alike {
        let Some([first, last]) = hinges.first().map(|ends| ends.map(|node| place(mesh, node))) else { continue };
        let who = match &blocks[..] {
            [one] => format!("block {one}"),
            many => format!("blocks {}", many.iter().map(i64::to_string).collect::<Vec<_>>().join(", ")),
        };
        let how = if first == last {
            format!("hinged to solids by {first}, the only one that holds them")
        } else {
            format!(
                "held by solids, or nodes that are held, in one line only and turn freely about it, from {first} to {last}"
            )
        };
        let more = if hinges.len() > 1 { format!(", and so in {} places in all", hinges.len()) } else { String::new() };
        found.push(
            Diagnostic::warning(format!(
                "beams or shells of {who} are {how}{more}: nodes of solids have no rotation and carry no moment"
            ))
            .help(
                "carry beams on into the solid through several nodes, lay shells on its face, or make a RIGID BODY of what is around the \
                 joint; against turning about a line only nodes aside of it help. A hinge that is meant can stay",
            ),
        );
    }
}

/// A node by its number and its place.
fn place(mesh: &Mesh, node: u32) -> String {
    let [x, y, z] = mesh.coordinates[node as usize];
    format!("node {} at ({x:.4e}, {y:.4e}, {z:.4e})", mesh.node_ids[node as usize])
}

/// How many nodes there are at which beams stand on shells and nothing else carries the torque of the beams, and the first of them.
pub(crate) fn studs(model: &Model, mesh: &Mesh) -> Option<(usize, String)> {
    let is_of = |bar: bool| move |block: &&Block| turns(block, model) && (block.shape == Shape::Bar) == bar;
    if mesh.dimension != Dimension::Three || !mesh.blocks.iter().any(|block| is_of(true)(&block)) {
        return None;
    }
    let at = nodes(model, mesh);
    let position = |node: u32| mesh.coordinates[node as usize];
    // Directions of beams at each node, and then whether all of them stand on all of its shells.
    let mut beams: BTreeMap<u32, (Vec<[f64; 3]>, Option<bool>)> = BTreeMap::new();
    for ends in mesh.blocks.iter().filter(is_of(true)).flat_map(Block::elements) {
        let along = normalized(subtract(position(ends[1]), position(ends[0])));
        let free = ends.iter().filter(|&&node| !at[node as usize].rotation && !at[node as usize].solid);
        free.for_each(|&node| beams.entry(node).or_default().0.extend(along));
    }
    for corners in mesh.blocks.iter().filter(is_of(false)).flat_map(Block::elements) {
        // Of a triangle its last corner stands for the fourth.
        let [a, b, c, d] = [0, 1, 2, corners.len() - 1].map(|corner| position(corners[corner]));
        let across = if corners.len() == 4 { subtract(d, b) } else { subtract(c, b) };
        let Some(normal) = normalized(cross(subtract(c, a), across)) else { continue };
        for node in corners {
            if let Some((along, stand)) = beams.get_mut(node) {
                let all = along.iter().all(|along| dot(*along, normal).abs() > STANDS);
                *stand = Some(stand.unwrap_or(true) && all);
            }
        }
    }
    let mut stand = beams.iter().filter(|(_, (_, stand))| *stand == Some(true)).map(|(node, _)| *node);
    let first = stand.next()?;
    Some((1 + stand.count(), place(mesh, first)))
}
