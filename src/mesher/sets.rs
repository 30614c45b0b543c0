//! NODE SET and SIDE SET: picked out of the finished mesh.

use super::{
    assembly::Assembled,
    body::{Face, Sides},
    recipe::blocks,
    region::Region,
    skin,
};
use crate::{
    common::vector::{cross, subtract},
    deck::{Diagnostic, Diagnostics, Span},
    mesh::{Dimension, Mesh, NodeSet, SideSet},
};

/// One command that adds to a set.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Number of the set.
    pub id: i64,
    /// What to pick.
    pub what: What,
    /// Only from this block.
    pub block: Option<i64>,
    /// The command's name and where it stands, for messages.
    pub place: Place,
}

/// A command in a recipe, as messages refer to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// What messages call it.
    pub owner: String,
    /// Where it stands.
    pub span: Span,
}

/// What a set is made of.
#[derive(Debug, Clone, PartialEq)]
pub enum What {
    /// Nodes in a region, or exterior faces with all their nodes there.
    Region(Region),
    /// Everything: all nodes, or all exterior faces.
    All,
    /// A named face of the shapes made as this block.
    Face(i64, Face),
    /// Exterior faces whose outward normal is near a direction.
    Normal {
        /// Unit vector.
        direction: [f64; 3],
        /// Cosine of the largest angle between the two.
        cosine: f64,
    },
}

/// Fills the mesh's node sets and side sets. Several requests with one number add up. A request that picks nothing is
/// reported.
pub fn fill(
    assembled: &mut Assembled,
    node_sets: &[Request],
    side_sets: &[Request],
    tolerance: f64,
    diagnostics: &mut Diagnostics,
) {
    for request in node_sets {
        let nodes = nodes(assembled, request, tolerance);
        if nodes.is_empty() {
            diagnostics.push(nothing(&assembled.mesh, request, "node"));
        }
        let sets = &mut assembled.mesh.node_sets;
        let index = sets.iter().position(|set| set.id == request.id).unwrap_or_else(|| {
            sets.push(NodeSet { id: request.id, ..NodeSet::default() });
            sets.len() - 1
        });
        unite(&mut sets[index].nodes, nodes);
    }
    for request in side_sets {
        let sides = sides(assembled, request, tolerance);
        if sides.is_empty() {
            diagnostics.push(nothing(&assembled.mesh, request, "exterior face"));
        }
        let sets = &mut assembled.mesh.side_sets;
        let index = sets.iter().position(|set| set.id == request.id).unwrap_or_else(|| {
            sets.push(SideSet { id: request.id, ..SideSet::default() });
            sets.len() - 1
        });
        unite(&mut sets[index].sides, sides);
    }
}

fn unite<T: Ord>(list: &mut Vec<T>, more: Vec<T>) {
    list.extend(more);
    list.sort_unstable();
    list.dedup();
}

fn nodes(assembled: &Assembled, request: &Request, tolerance: f64) -> Vec<u32> {
    let mesh = &assembled.mesh;
    let elements = mesh.connectivity();
    let mut eligible = vec![request.block.is_none(); mesh.coordinates.len()];
    for block in mesh.blocks.iter().filter(|block| request.block == Some(block.id)) {
        block.nodes.iter().for_each(|&node| eligible[node as usize] = true);
    }
    let mut nodes: Vec<u32> = match &request.what {
        What::Region(region) => (0..mesh.coordinates.len() as u32)
            .filter(|&node| region.contains(mesh.coordinates[node as usize], tolerance))
            .collect(),
        What::Face(block, face) => {
            named(assembled, *block, *face).flat_map(|side| skin::nodes_of_side(&elements, side)).collect()
        }
        What::All | What::Normal { .. } => (0..mesh.coordinates.len() as u32).collect(),
    };
    nodes.retain(|&node| eligible[node as usize]);
    unite(&mut nodes, Vec::new());
    nodes
}

fn sides(assembled: &Assembled, request: &Request, tolerance: f64) -> Sides {
    let mesh = &assembled.mesh;
    let at = |node: u32| mesh.coordinates[node as usize];
    let mut sides: Sides = match &request.what {
        What::Region(region) => skin::exterior(mesh, |node| region.contains(at(node), tolerance)),
        What::All => skin::exterior(mesh, |_| true),
        What::Face(block, face) => named(assembled, *block, *face).collect(),
        What::Normal { direction, cosine } => {
            let elements = mesh.connectivity();
            let mut sides = skin::exterior(mesh, |_| true);
            sides.retain(|&(element, side)| {
                let corners = skin::nodes(&elements, element, side).map(at);
                let normal = if mesh.dimension == Dimension::Two { across(corners) } else { normal(corners) };
                (0..3).map(|i| normal[i] * direction[i]).sum::<f64>() >= *cosine
            });
            sides
        }
    };
    if let Some(id) = request.block {
        let block_of: Vec<i64> = mesh.elements().map(|(block, _)| mesh.blocks[block].id).collect();
        sides.retain(|&(element, _)| block_of[element as usize] == id);
    }
    sides
}

fn named(assembled: &Assembled, block: i64, face: Face) -> impl Iterator<Item = (u32, u8)> {
    let parts = assembled.faces.iter().filter(move |(id, _)| *id == block);
    let faces = parts.flat_map(|(_, faces)| faces).filter(move |(name, _)| *name == face);
    faces.flat_map(|(_, sides)| sides.iter().copied())
}

/// Unit normal of an edge in the plane, to the right of the way from its first node to its second.
fn across([a, b, ..]: [[f64; 3]; 4]) -> [f64; 3] {
    let along = subtract(b, a);
    let length = super::distance(along, [0.0; 3]);
    [along[1] / length, -along[0] / length, 0.0]
}

/// Unit normal of a quadrilateral, from its diagonals.
fn normal(x: [[f64; 3]; 4]) -> [f64; 3] {
    let normal = cross(subtract(x[2], x[0]), subtract(x[3], x[1]));
    let length = super::distance(normal, [0.0; 3]);
    normal.map(|c| c / length)
}

/// The message for a set that would be empty, with what helps to find the slip.
fn nothing(mesh: &Mesh, request: &Request, what: &str) -> Diagnostic {
    let diagnostic = Diagnostic::error(format!("{}: no {what} is found", request.place.owner))
        .at(request.place.span, "this set would be empty");
    let ids: Vec<i64> = mesh.blocks.iter().map(|block| block.id).collect();
    if let Some(block) = request.block.filter(|block| !ids.contains(block)) {
        return diagnostic.help(format!("there is no block {block}; the mesh has {}", blocks(&ids)));
    }
    let nearest = match &request.what {
        What::Region(region) => mesh.coordinates.iter().map(|&x| region.distance(x)).fold(f64::INFINITY, f64::min),
        _ => f64::INFINITY,
    };
    let reach = ["x", "y", "z"].iter().zip(super::bounds(&mesh.coordinates));
    let reach: Vec<String> =
        reach.map(|(axis, [low, high])| format!("{axis} from {} to {}", short(low), short(high))).collect();
    let diagnostic = diagnostic.help(format!("the model reaches over {}", reach.join(", ")));
    match nearest {
        0.0 if what != "node" => diagnostic.help("faces inside the mesh do not count, and all four nodes must agree"),
        _ if nearest.is_finite() && nearest > 0.0 => {
            diagnostic.help(format!("the nearest node is {} away", short(nearest)))
        }
        _ => diagnostic,
    }
}

/// A number with six digits at most.
fn short(number: f64) -> String {
    format!("{:?}", format!("{number:.5e}").parse().unwrap_or(number))
}
