//! What rigid bodies are made of: their nodes, their mass and their inertia, from the mesh.
//!
//! A body weighs what its nodes weigh, so that momentum, gravity and what shares nodes with it need no second account: the share of
//! deformable elements at its nodes and POINT MASS are part of it. Its inertia is that of the volumes of its elements,
//! integrated: masses at corners would turn as one element of a cube does, three times too slowly. What POINT MASS and PRESCRIBED
//! MOMENT say of nodes that have no rotation of their own, they say of the body.

use crate::common::vector::{add, cross, dot, normalized, scaled, subtract};
use crate::mesh::exterior::{SIDES, exterior};
use crate::mesh::hexahedron::SIGNS;
use crate::mesh::{Mesh, Shape};
use crate::model::Model;
use crate::solver::body::Body;
use crate::solver::domain::Rotations;
use crate::solver::elements::{Sample, Touch};

/// A 3 × 3 matrix by rows.
pub type Matrix = [[f64; 3]; 3];

/// A rigid body at the start.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodyShape {
    /// Its blocks, as the deck names them.
    pub blocks: Vec<i64>,
    /// Its nodes in the mesh, ascending.
    pub nodes: Vec<u32>,
    /// Of each of them whether forces can act on it: it is on the outside of the body's blocks, or others use it too.
    pub near: Vec<bool>,
    /// Mass.
    pub mass: f64,
    /// Centre of mass, a position.
    pub centre: [f64; 3],
    /// Inertia about it, mass·length².
    pub inertia: Matrix,
    /// That of its nodes alone: of their masses, and of the rotary inertias of those that can turn.
    pub of_nodes: Matrix,
    /// The part of the inertia that is not in the masses of the nodes and in the rotary inertias of those that can turn.
    pub surplus: Matrix,
    /// What each of its blocks, by its position in the mesh, has of that.
    pub surplus_of: Vec<(usize, Matrix)>,
}

impl BodyShape {
    /// How many nodes of a node set are the body's and turn with it only, having no rotation of their own; by their factors.
    pub fn without_rotation(&self, mesh: &Mesh, node_set: i64, rotations: &Rotations) -> f64 {
        let is_own = |node: u32| self.nodes.binary_search(&node).is_ok() && rotations.of(node).is_none();
        mesh.shares_of(node_set).iter().filter(|(node, _)| is_own(*node)).map(|(_, factor)| factor).sum()
    }
}

/// Of each block of the mesh, which body it belongs to.
pub fn bodies_of_blocks(mesh: &Mesh, model: &Model) -> Vec<Option<usize>> {
    let of = |id: i64| model.rigid_bodies.iter().position(|blocks| blocks.contains(&id));
    mesh.blocks.iter().map(|block| of(block.id)).collect()
}

/// All rigid bodies of a model whose elements and nodes have been weighed.
pub fn shapes(mesh: &Mesh, model: &Model, body: &Body) -> Vec<BodyShape> {
    if model.rigid_bodies.is_empty() {
        return Vec::new();
    }
    let owners = &body.block_body;
    let (mut members, mut others) = (vec![Vec::new(); model.rigid_bodies.len()], vec![false; mesh.coordinates.len()]);
    for (block, owner) in mesh.blocks.iter().zip(owners) {
        match owner {
            Some(owner) => members[*owner].extend_from_slice(&block.nodes),
            None => block.nodes.iter().for_each(|&node| others[node as usize] = true),
        }
    }
    // Forces are prescribed for nodes of sets.
    let loaded = model.prescribed_forces.iter().filter_map(|force| mesh.node_set(force.node_set));
    loaded.flat_map(|set| &set.nodes).for_each(|&node| others[node as usize] = true);
    let rigid = mesh.blocks.iter().zip(owners).filter(|(_, owner)| owner.is_some());
    let elements: Vec<(Shape, &[u32])> =
        rigid.flat_map(|(block, _)| block.elements().map(|nodes| (block.shape, nodes))).collect();
    let mut outside = vec![false; others.len()];
    for face in exterior(elements.iter().copied(), others.len(), |_| true) {
        let (shape, nodes) = elements[face as usize / SIDES];
        let corners = shape.face(nodes, (face as usize % SIDES) as u8).unwrap_or_default();
        corners.iter().for_each(|&node| outside[node as usize] = true);
    }
    // The two ends of a bar are no faces.
    let bars = elements.iter().filter(|(shape, _)| *shape == Shape::Bar);
    bars.flat_map(|(_, nodes)| *nodes).for_each(|&node| outside[node as usize] = true);
    let mut own = vec![Vec::new(); model.rigid_bodies.len()];
    for (element, block) in body.element_block.iter().enumerate() {
        if let Some(owner) = owners[*block as usize] {
            own[owner].push(element);
        }
    }
    let shape = |((number, mut nodes), elements): ((usize, Vec<u32>), Vec<usize>)| {
        nodes.sort_unstable();
        nodes.dedup();
        let near = nodes.iter().map(|&node| others[node as usize] || outside[node as usize]).collect();
        let blocks = model.rigid_bodies[number].clone();
        weighed(BodyShape { blocks, nodes, near, ..BodyShape::default() }, &elements, (mesh, model), body)
    };
    members.into_iter().enumerate().zip(own).map(shape).collect()
}

/// Finds mass, centre and inertia of a body with these elements. The sums run over the whole mesh in its order: they are the same
/// on every rank.
fn weighed(mut shape: BodyShape, own: &[usize], (mesh, model): (&Mesh, &Model), body: &Body) -> BodyShape {
    let mut moment = [0.0; 3];
    for &node in &shape.nodes {
        let mass = body.node_mass[node as usize];
        shape.mass += mass;
        moment = add(moment, scaled(body.positions[node as usize], mass));
    }
    shape.centre = scaled(moment, 1.0 / shape.mass);
    // Second moments Σ m r rᵀ, from which inertia follows.
    let mut of_rows = Moments::default();
    for &node in &shape.nodes {
        of_rows.point(subtract(body.positions[node as usize], shape.centre), body.node_mass[node as usize]);
        if let Some(rotation) = body.rotations.of(node) {
            of_rows.turning(body.node_mass[rotation as usize]);
        }
    }
    let mut surpluses = vec![Moments::default(); mesh.blocks.len()];
    let (mut corners, mut shares) = (Vec::new(), Vec::new());
    for &element in own {
        let block = body.element_block[element] as usize;
        let nodes = &body.element_nodes[element];
        corners.clear();
        corners.extend(nodes.iter().map(|&node| body.positions[node as usize]));
        let attributes = mesh.blocks[block].attributes_of(body.place_in_block(element));
        let sample = Sample { nodes, corners: &corners, attributes };
        shares.clear();
        shares.resize(body.element_unknowns[element].len(), 0.0);
        let density = model.materials[body.block_material[block]].density;
        let mass = body.elements[block].weigh(&sample, density, &mut shares);
        let at = |corner: &[f64; 3]| subtract(*corner, shape.centre);
        let surplus = &mut surpluses[block];
        for (corner, share) in corners.iter().zip(&shares) {
            surplus.point(at(corner), -mass * share);
        }
        shares[corners.len()..].iter().for_each(|share| surplus.turning(-mass * share));
        let arms: Vec<[f64; 3]> = corners.iter().map(at).collect();
        surplus.element(mesh.blocks[block].shape, &arms, mass, body.elements[block].touch(attributes));
    }
    let owned = (0..surpluses.len()).filter(|&block| shape.blocks.contains(&mesh.blocks[block].id));
    shape.surplus_of = owned.map(|block| (block, surpluses[block].inertia())).collect();
    let mut points = Moments::default();
    for point in &model.point_masses {
        points.turning(point.inertia * shape.without_rotation(mesh, point.node_set, &body.rotations));
    }
    let surplus = shape.surplus_of.iter().fold(points.inertia(), |all, (_, own)| sum(&all, own));
    let inertia = sum(&of_rows.inertia(), &surplus);
    let stiffened = stiffened(&inertia, LEAST);
    let added = sum(&stiffened, &inertia.map(|row| scaled(row, -1.0)));
    shape.surplus = sum(&surplus, &added);
    if let Some((_, first)) = shape.surplus_of.first_mut() {
        *first = sum(first, &added);
    }
    shape.of_nodes = self::stiffened(&of_rows.inertia(), ROUND_OFF);
    shape.inertia = stiffened;
    shape
}

/// What is added to the inertia of a line, as a part of its trace; and the determinant, over the cube of that, of what is as thin.
const LEAST: f64 = 1e-6;

/// The determinant of what has no inertia about a line but round-off, over the cube of the trace.
const ROUND_OFF: f64 = 1e-12;

/// What has no extent across a line would turn about it without any effort: where the determinant is below this part of the cube of
/// the trace, a millionth of its largest inertia is added.
fn stiffened(inertia: &Matrix, least: f64) -> Matrix {
    let trace = inertia[0][0] + inertia[1][1] + inertia[2][2];
    let [x, y, z] = *inertia;
    let determinant = dot(x, cross(y, z));
    if determinant > least * trace * trace * trace {
        return *inertia;
    }
    let mut stiffened = *inertia;
    (0..3).for_each(|i| stiffened[i][i] += LEAST * trace);
    stiffened
}

/// a + b
pub fn sum(a: &Matrix, b: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| add(a[i], b[i]))
}

/// Σ m r rᵀ, and what turns alike about all axes.
#[derive(Debug, Clone, Copy, Default)]
struct Moments {
    second: Matrix,
    turning: f64,
}

/// Points and weights of Gauss's rule with three points on [−1, 1]: exact for the fourth powers of a trilinear volume.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

impl Moments {
    fn point(&mut self, r: [f64; 3], mass: f64) {
        (0..3).for_each(|i| (0..3).for_each(|j| self.second[i][j] += mass * r[i] * r[j]));
    }

    fn turning(&mut self, inertia: f64) {
        self.turning += inertia;
    }

    /// Adds an element of this mass, given by the arms of its corners.
    fn element(&mut self, shape: Shape, arms: &[[f64; 3]], mass: f64, touch: Touch) {
        let mut points: Vec<([f64; 3], f64)> = Vec::new();
        let mut across = [0.0; 3];
        match shape {
            Shape::Hexahedron => points.extend(rule(3).map(|at| {
                let [a, b, c] = tangents(arms, at, 3);
                (place(arms, at.0, 3), at.1 * dot(a, cross(b, c)))
            })),
            Shape::Bar => points.extend(
                [0.5 - 0.5 / 3f64.sqrt(), 0.5 + 0.5 / 3f64.sqrt()]
                    .map(|s| (add(scaled(arms[0], 1.0 - s), scaled(arms[1], s)), 0.5)),
            ),
            Shape::Triangle => {
                // The map of a quadrilateral two corners of which are one, of which the rule is exact.
                let four = [arms[0], arms[1], arms[2], arms[2]];
                return self.element(Shape::Quadrilateral, &four, mass, touch);
            }
            _ => points.extend(rule(2).map(|at| {
                let [a, b, _] = tangents(arms, at, 2);
                let area = cross(a, b);
                across = add(across, scaled(area, at.1));
                (place(arms, at.0, 2), at.1 * dot(area, area).sqrt())
            })),
        }
        let whole: f64 = points.iter().map(|(_, weight)| weight).sum();
        points.iter().for_each(|(r, weight)| self.point(*r, mass * weight / whole));
        match touch {
            // t²/12 of the thickness t, along the normal.
            Touch::BothSides(half) => {
                self.point(normalized(across).unwrap_or_default(), mass * half * half / 3.0);
            }
            // r²/4 of a round section, across the bar.
            Touch::Nodes(radius) if shape == Shape::Bar => {
                let (own, along) = (0.25 * mass * radius * radius, subtract(arms[1], arms[0]));
                (0..3).for_each(|i| self.second[i][i] += own);
                self.point(normalized(along).unwrap_or_default(), -own);
            }
            _ => (),
        }
    }

    /// tr(S) 1 − S
    fn inertia(&self) -> Matrix {
        let s = &self.second;
        let trace = s[0][0] + s[1][1] + s[2][2];
        let at = |i: usize, j: usize| if i == j { trace - s[i][j] + self.turning } else { -s[i][j] };
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| at(i, j)))
    }
}

/// Points of Gauss's rule in so many dimensions, with their weights.
fn rule(dimensions: usize) -> impl Iterator<Item = ([f64; 3], f64)> {
    let along = move |axis: usize| if axis < dimensions { &GAUSS[..] } else { &[(0.0, 1.0)][..] };
    along(0).iter().flat_map(move |&(x, wx)| {
        along(1).iter().flat_map(move |&(y, wy)| along(2).iter().map(move |&(z, wz)| ([x, y, z], wx * wy * wz)))
    })
}

/// N_I of the corners at a point.
fn shape_function(corner: usize, at: [f64; 3], dimensions: usize) -> f64 {
    (0..dimensions).map(|i| 0.5 * (1.0 + SIGNS[corner][i] * at[i])).product()
}

fn place(arms: &[[f64; 3]], at: [f64; 3], dimensions: usize) -> [f64; 3] {
    (0..arms.len()).fold([0.0; 3], |sum, corner| add(sum, scaled(arms[corner], shape_function(corner, at, dimensions))))
}

/// ∂x/∂ξ, ∂x/∂η, ∂x/∂ζ
fn tangents(arms: &[[f64; 3]], (at, _): ([f64; 3], f64), dimensions: usize) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|along| {
        (0..arms.len()).fold([0.0; 3], |sum, corner| {
            let others = (0..dimensions).filter(|&i| i != along);
            let rest: f64 = others.map(|i| 0.5 * (1.0 + SIGNS[corner][i] * at[i])).product();
            add(sum, scaled(arms[corner], 0.5 * SIGNS[corner][along] * rest))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_a_plate_and_a_bar_have_the_inertia_of_the_textbook() {
        let box_of = |[a, b, c]: [f64; 3]| SIGNS.map(|x| [0.5 * a * x[0], 0.5 * b * x[1], 0.5 * c * x[2]]);
        let mut solid = Moments::default();
        solid.element(Shape::Hexahedron, &box_of([1.0, 2.0, 3.0]), 12.0, Touch::Outside);
        let plate = &box_of([1.0, 2.0, 0.0])[..4];
        let mut thick = Moments::default();
        thick.element(Shape::Quadrilateral, plate, 12.0, Touch::BothSides(1.5));
        for (found, what) in [(solid.inertia(), "box"), (thick.inertia(), "plate with its thickness")] {
            for (i, expected) in [13.0, 10.0, 5.0].into_iter().enumerate() {
                assert!((found[i][i] - expected).abs() < 1e-13, "{what}: {} is not {expected}", found[i][i]);
                assert!(found[i][(i + 1) % 3].abs() < 1e-14);
            }
        }
        let mut bar = Moments::default();
        bar.element(Shape::Bar, &[[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]], 12.0, Touch::Nodes(0.5));
        let found = bar.inertia();
        // m L²/12 + m r²/4 across, m r²/2 along.
        assert!((found[0][0] - 4.75).abs() < 1e-13 && (found[2][2] - 1.5).abs() < 1e-13, "{found:?}");
    }
}
