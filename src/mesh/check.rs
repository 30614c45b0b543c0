//! Is a mesh fit to compute with? Finds what an analyst must mend, in the analyst's numbers.

use super::hexahedron::{self, Form};
use super::{Mesh, Shape};

pub use super::hexahedron::hexahedron_volume;

/// How many problems are told in full; the rest are counted.
const LISTED: usize = 20;
/// How many elements with the same fault are named one by one before the rest of their block is summed up.
const NAMED_PER_BLOCK: usize = 3;

/// One element of a block in so many may be a tetrahedron.
const MOST_TETRAHEDRA: usize = 10;

/// Something wrong with a mesh: what it is, and what may be done.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// What is wrong, beginning with the entity: `block 3, element 1042: …`.
    pub what: String,
    /// A hint, or an empty string.
    pub help: String,
}

impl Problem {
    /// A problem with its hint.
    pub fn new(what: impl Into<String>, help: impl Into<String>) -> Self {
        Problem { what: what.into(), help: help.into() }
    }
}

/// A list of problems that stays short however broken the mesh is.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Problems {
    list: Vec<Problem>,
    found: usize,
}

impl Problems {
    /// Counts a problem, and describes it while the list is short.
    pub fn add(&mut self, describe: impl FnOnce() -> Problem) {
        self.found += 1;
        if self.list.len() < LISTED {
            self.list.push(describe());
        }
    }

    /// The problems described, in the order found.
    pub fn list(&self) -> &[Problem] {
        &self.list
    }

    /// How many were found beyond those described.
    pub fn unlisted(&self) -> usize {
        self.found - self.list.len()
    }

    /// True when nothing was found.
    pub fn is_empty(&self) -> bool {
        self.found == 0
    }
}

/// Everything that makes a mesh unfit: coordinates that are not finite, elements without positive volume, pinched ones,
/// blocks of tetrahedra.
///
/// The mesh's indices must be in range, as they are in every mesh that the `exodus` reader hands out.
pub fn geometry(mesh: &Mesh) -> Problems {
    let mut problems = Problems::default();
    coordinates(mesh, &mut problems);
    if problems.is_empty() {
        volumes(mesh, &mut problems);
    }
    if problems.is_empty() {
        tetrahedra(mesh, &mut problems);
    }
    problems
}

/// Nodes that belong to no element, as zero-based indices. They would have no mass.
pub fn unreferenced_nodes(mesh: &Mesh) -> Vec<u32> {
    let mut used = vec![false; mesh.coordinates.len()];
    for (_, nodes) in mesh.elements() {
        nodes.iter().for_each(|&n| used[n as usize] = true);
    }
    (0u32..).zip(used).filter(|&(_, used)| !used).map(|(node, _)| node).collect()
}

/// Elements that have the nodes of another one of their shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Doubled {
    /// How many there are beside the first of each.
    pub count: usize,
    /// Two with the same nodes, by their places: the first two of the mesh.
    pub first: [u32; 2],
}

/// Solids and shells that lie on others with the same nodes, in any blocks; the order of the nodes does not count. Bars on the
/// same nodes may be meant. Elements are put together by their lowest node, so that each is compared with a handful.
pub fn doubled(mesh: &Mesh) -> Option<Doubled> {
    let wanted = || mesh.shaped().zip(0u32..).filter(|((shape, _), _)| *shape != Shape::Bar);
    let lowest = |nodes: &[u32]| nodes.iter().copied().min().unwrap_or(0) as usize;
    // Where the elements of each lowest node end in the list of all, counted backwards while it is filled.
    let mut ends = vec![0u32; mesh.coordinates.len() + 1];
    wanted().for_each(|((_, nodes), _)| ends[lowest(nodes)] += 1);
    let mut sum = 0;
    for end in &mut ends {
        sum += *end;
        *end = sum;
    }
    let nothing: &[u32] = &[];
    let mut list = vec![(Shape::Bar, nothing, 0u32); sum as usize];
    for ((shape, nodes), element) in wanted() {
        let end = &mut ends[lowest(nodes)];
        *end -= 1;
        list[*end as usize] = (shape, nodes, element);
    }
    let mut doubled: Option<Doubled> = None;
    // What were ends are beginnings now.
    for near in ends.windows(2).map(|ends| &list[ends[0] as usize..ends[1] as usize]).filter(|near| near.len() > 1) {
        for first in same(near) {
            let so_far = doubled.unwrap_or(Doubled { count: 0, first });
            doubled = Some(Doubled { count: so_far.count + 1, first: so_far.first.min(first) });
        }
    }
    doubled
}

/// Pairs of elements that follow each other in the order of the mesh and have the same shape and nodes.
fn same(near: &[(Shape, &[u32], u32)]) -> Vec<[u32; 2]> {
    let sorted = |&(shape, nodes, element): &(Shape, &[u32], u32)| {
        let mut nodes = nodes.to_vec();
        nodes.sort_unstable();
        (shape, nodes, element)
    };
    let mut keyed: Vec<_> = near.iter().map(sorted).collect();
    keyed.sort_unstable();
    let pairs = keyed.windows(2).filter(|pair| pair[0].0 == pair[1].0 && pair[0].1 == pair[1].1);
    pairs.map(|pair| [pair[0].2, pair[1].2]).collect()
}

fn coordinates(mesh: &Mesh, problems: &mut Problems) {
    for (position, id) in mesh.coordinates.iter().zip(&mesh.node_ids) {
        if let Some((axis, value)) = ["x", "y", "z"].iter().zip(position).find(|(_, value)| !value.is_finite()) {
            problems.add(|| {
                Problem::new(
                    format!("node {id}: its {axis} coordinate is {value}"),
                    "write the mesh again with finite coordinates",
                )
            });
        }
    }
}

/// Tetrahedra lock; a few in a block do no harm.
fn tetrahedra(mesh: &Mesh, problems: &mut Problems) {
    for block in &mesh.blocks {
        let found = block.hexahedra().iter().filter(|nodes| hexahedron::form(nodes) == Form::Tetrahedron).count();
        if found * MOST_TETRAHEDRA > block.len() {
            problems.add(|| {
                let of = block.len();
                Problem::new(
                    format!(
                        "block {}: {found} of its {of} elements are tetrahedra; they lock in plastic flow and when nearly \
                         incompressible",
                        block.id
                    ),
                    format!("mesh the part with hexahedra, wedges or pyramids; one in {MOST_TETRAHEDRA} may be a tetrahedron"),
                )
            });
        }
    }
}

fn volumes(mesh: &Mesh, problems: &mut Problems) {
    let mut ids = mesh.element_ids.iter();
    for block in &mesh.blocks {
        let mut faulty = 0;
        for (nodes, id) in block.elements().zip(&mut ids) {
            let Some(Problem { what, help }) = block.shape.fault(mesh, nodes) else { continue };
            faulty += 1;
            if faulty <= NAMED_PER_BLOCK {
                let corners: Vec<[f64; 3]> = nodes.iter().map(|&n| mesh.coordinates[n as usize]).collect();
                let place = point(centre(&corners));
                problems
                    .add(|| Problem::new(format!("block {}, element {id}: {what}; centre {place}", block.id), help));
            }
        }
        if faulty > NAMED_PER_BLOCK {
            problems.add(|| {
                Problem::new(
                    format!(
                        "block {}: {faulty} of its {} elements cannot be computed with, the first {NAMED_PER_BLOCK} are \
                         named above",
                        block.id,
                        block.len()
                    ),
                    "",
                )
            });
        }
    }
}

fn centre(corners: &[[f64; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|axis| corners.iter().map(|c| c[axis]).sum::<f64>() / corners.len() as f64)
}

fn point(p: [f64; 3]) -> String {
    format!("({}, {}, {})", short(p[0]), short(p[1]), short(p[2]))
}

/// A number with five significant digits, without an exponent where it reads well.
pub(super) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.4e}").parse().unwrap_or(value);
    let plain = rounded == 0.0 || (1e-3..1e5).contains(&rounded.abs());
    if plain { format!("{rounded}") } else { format!("{rounded:e}") }
}

/// A number of things: `1 node`, `2 nodes`.
pub(crate) fn counted(count: usize, thing: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {thing}{plural}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Block, UNIT_CUBE};

    /// Volume by 2×2×2 Gauss points of the trilinear map, for which that rule is exact.
    fn volume_by_quadrature(corners: &[[f64; 3]; 8]) -> f64 {
        let g = 0.5 / f64::sqrt(3.0);
        let mut volume = 0.0;
        for point in 0..8 {
            let at = [1, 2, 4].map(|bit| if point & bit == 0 { 0.5 - g } else { 0.5 + g });
            let mut jacobian = [[0.0; 3]; 3];
            for (corner, position) in UNIT_CUBE.iter().zip(corners) {
                let shape = |d: usize| if corner[d] == 0.0 { 1.0 - at[d] } else { at[d] };
                let slope = |d: usize| if corner[d] == 0.0 { -1.0 } else { 1.0 };
                let gradient =
                    [slope(0) * shape(1) * shape(2), shape(0) * slope(1) * shape(2), shape(0) * shape(1) * slope(2)];
                for i in 0..3 {
                    for j in 0..3 {
                        jacobian[i][j] += position[i] * gradient[j];
                    }
                }
            }
            volume += nalgebra::Matrix3::from(jacobian).determinant() / 8.0;
        }
        volume
    }

    #[test]
    fn volume_is_that_of_the_trilinear_map() {
        assert_eq!(hexahedron_volume(&UNIT_CUBE), 1.0);
        let wave = |n: usize, d: usize| 0.3 * ((7 * n + 3 * d) as f64).sin();
        let warped: [[f64; 3]; 8] =
            std::array::from_fn(|n| std::array::from_fn(|d| 2.0 * UNIT_CUBE[n][d] + wave(n, d)));
        let expected = volume_by_quadrature(&warped);
        assert!((hexahedron_volume(&warped) - expected).abs() < 1e-14 * expected, "{expected}");
        let far = warped.map(|p| p.map(|x| x + 1e6));
        assert!((hexahedron_volume(&far) - expected).abs() < 1e-8);
    }

    #[test]
    fn a_wedge_made_by_repeating_nodes_has_half_the_volume() {
        let mut wedge = UNIT_CUBE;
        (wedge[3], wedge[7]) = (wedge[2], wedge[6]);
        assert!((hexahedron_volume(&wedge) - 0.5).abs() < 1e-15);
    }

    /// A column of flat elements under one good one, and a node that no element uses.
    fn column() -> Mesh {
        let layer = |z: f64| UNIT_CUBE[..4].iter().map(move |p| [p[0], p[1], z]);
        let coordinates: crate::mesh::Coordinates =
            (0..7).flat_map(|k| layer(f64::from(k / 6))).chain([[5.0; 3]]).collect();
        let element = |k: u32| std::array::from_fn(|corner| 4 * k + corner as u32);
        Mesh {
            node_ids: (1..=29).collect(),
            element_ids: (11..=16).collect(),
            coordinates,
            blocks: vec![Block::hexahedra_of(3, (0..6).map(element))],
            ..Mesh::default()
        }
    }

    #[test]
    fn many_flat_elements_are_summed_up() {
        let problems = geometry(&column());
        let told: Vec<&str> = problems.list().iter().map(|p| p.what.as_str()).collect();
        assert_eq!(told[0], "block 3, element 11: its volume is 0, it must be positive; centre (0.5, 0.5, 0)");
        assert_eq!(told[3], "block 3: 5 of its 6 elements cannot be computed with, the first 3 are named above");
        assert_eq!(told.len(), 4);
    }

    #[test]
    fn nodes_without_elements_are_found() {
        assert_eq!(unreferenced_nodes(&column()), [28]);
    }

    #[test]
    fn elements_on_the_nodes_of_others_are_found() {
        let of = |shape, id, nodes: &[u32]| Block { id, shape, nodes: nodes.to_vec(), ..Block::default() };
        let column = column();
        assert_eq!(doubled(&column), None);
        // Shells and bars on the nodes of solids are none; nor are bars on each other, nor triangles on half a quadrilateral.
        let around = |more: &[Block]| Mesh { blocks: [&column.blocks[..], more].concat(), ..column.clone() };
        let shell = of(Shape::Quadrilateral, 5, &[0, 1, 2, 3, 4, 5, 6, 7]);
        let others = [shell.clone(), of(Shape::Bar, 6, &[0, 1, 1, 0]), of(Shape::Triangle, 7, &[0, 1, 2])];
        assert_eq!(doubled(&around(&others)), None);
        // In another block and another order.
        let again = [shell, of(Shape::Quadrilateral, 8, &[7, 4, 5, 6, 1, 2, 3, 0, 1, 0, 3, 2])];
        assert_eq!(doubled(&around(&again)), Some(Doubled { count: 3, first: [6, 9] }));
        let twice = Block { id: 9, ..column.blocks[0].clone() };
        assert_eq!(doubled(&around(&[twice])), Some(Doubled { count: 6, first: [0, 6] }));
    }

    #[test]
    fn numbers_are_short_and_plurals_right() {
        assert_eq!([0.1 + 0.2, -1.234_567e-7, 1e9].map(short), ["0.3", "-1.2346e-7", "1e9"]);
        assert_eq!((counted(1, "node"), counted(0, "node")), ("1 node".into(), "0 nodes".into()));
    }
}
