//! Is a mesh fit to compute with? Finds what an analyst must mend, in the analyst's numbers.

use super::{Mesh, shape};

/// How many problems are told in full; the rest are counted.
const LISTED: usize = 20;
/// How many elements with the same fault are named one by one before the rest of their block is summed up.
const NAMED_PER_BLOCK: usize = 3;

/// Less than this part of an eighth of its element's mass makes a node of a collapsed element too light: a fifth of what
/// a regular pyramid leaves its apex.
const LEAST_SHARE: f64 = 0.1;

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
        let found = block.connectivity.iter().filter(|nodes| shape::kind(nodes) == shape::Shape::Tetrahedron).count();
        if found * MOST_TETRAHEDRA > block.connectivity.len() {
            problems.add(|| {
                let of = block.connectivity.len();
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
        for (nodes, id) in block.connectivity.iter().zip(&mut ids) {
            let corners = nodes.map(|n| mesh.coordinates[n as usize]);
            let Some(Problem { what, help }) = fault(mesh, nodes, &corners) else { continue };
            faulty += 1;
            if faulty <= NAMED_PER_BLOCK {
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
                        block.connectivity.len()
                    ),
                    "",
                )
            });
        }
    }
}

/// Why an element cannot be computed with, if it cannot.
fn fault(mesh: &Mesh, nodes: &[u32; 8], corners: &[[f64; 3]; 8]) -> Option<Problem> {
    let volume = hexahedron_volume(corners);
    if volume <= smallest_volume(corners) || volume.is_nan() {
        let what = format!("its volume is {}, it must be positive", short(volume));
        return Some(Problem::new(what, volume_hint(mesh, nodes, corners, volume)));
    }
    if !shape::is_collapsed(nodes) {
        return None;
    }
    if let Some(node) = shape::pinched_at(nodes) {
        let what = format!("node {} stands at corners that no edge joins", mesh.node_ids[node as usize]);
        return Some(Problem::new(what, "only the ends of edges may be one node, as in wedges and pyramids"));
    }
    let least = shape::least_share(nodes, &shape::mass_shares(nodes, corners));
    (least.is_nan() || least < LEAST_SHARE).then(|| {
        Problem::new(
            "it is so distorted that one of its nodes would have hardly any of its mass",
            "give it a shape nearer to that of a regular wedge or pyramid",
        )
    })
}

/// What may be wrong with an element that has no positive volume.
fn volume_hint(mesh: &Mesh, nodes: &[u32; 8], corners: &[[f64; 3]; 8], volume: f64) -> String {
    let repeated = (1..8).find(|&i| nodes[..i].contains(&nodes[i]));
    let [a, b, c, d, e, f, g, h] = *corners;
    let upside_down = [e, f, g, h, a, b, c, d];
    match repeated {
        Some(_) if volume < 0.0 => {
            "its base must turn counter-clockwise seen from its apex, a wedge's first triangle seen from \
                                    the second"
                .into()
        }
        Some(i) => format!("node {} appears more than once among its nodes", mesh.node_ids[nodes[i] as usize]),
        None if volume < 0.0 && hexahedron_volume(&upside_down) > 0.0 => {
            "nodes 1-2-3-4 must turn counter-clockwise seen from nodes 5-6-7-8; here the two faces are exchanged \
             or the mesh is mirrored"
                .into()
        }
        None => "the element is flat or twisted; look at the positions and the order of its nodes".into(),
    }
}

/// Exact volume of the trilinear hexahedron, equal to the mean-quadrature volume of Flanagan and Belytschko (1981).
///
/// By the divergence theorem it is the sum over the six faces of the volume between the face and the first corner;
/// for a bilinear face that is the mean of the two ways to cut it into triangles.
pub fn hexahedron_volume(corners: &[[f64; 3]; 8]) -> f64 {
    let from_first = corners.map(|c| [c[0] - corners[0][0], c[1] - corners[0][1], c[2] - corners[0][2]]);
    let six_fold = |a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let mut sum = 0.0;
    for face in &super::HEX_SIDES {
        let [a, b, c, d] = face.map(|i| &from_first[i]);
        sum += six_fold(a, b, c) + six_fold(a, c, d) + six_fold(a, b, d) + six_fold(b, c, d);
    }
    sum / 12.0
}

/// The volume below which an element counts as flat: round-off of the cube of its extent.
fn smallest_volume(corners: &[[f64; 3]; 8]) -> f64 {
    let extent = (0..3).map(|axis| {
        let values = corners.iter().map(|c| c[axis]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    });
    4.0 * f64::EPSILON * extent.fold(0.0, f64::max).powi(3)
}

fn centre(corners: &[[f64; 3]; 8]) -> [f64; 3] {
    [0, 1, 2].map(|axis| corners.iter().map(|c| c[axis]).sum::<f64>() / 8.0)
}

fn point(p: [f64; 3]) -> String {
    format!("({}, {}, {})", short(p[0]), short(p[1]), short(p[2]))
}

/// A number with five significant digits, without an exponent where it reads well.
fn short(value: f64) -> String {
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
        let coordinates: Vec<[f64; 3]> = (0..7).flat_map(|k| layer(f64::from(k / 6))).chain([[5.0; 3]]).collect();
        let element = |k: u32| std::array::from_fn(|corner| 4 * k + corner as u32);
        Mesh {
            node_ids: (1..=29).collect(),
            element_ids: (11..=16).collect(),
            coordinates,
            blocks: vec![Block { id: 3, name: String::new(), connectivity: (0..6).map(element).collect() }],
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
    fn numbers_are_short_and_plurals_right() {
        assert_eq!([0.1 + 0.2, -1.234_567e-7, 1e9].map(short), ["0.3", "-1.2346e-7", "1e9"]);
        assert_eq!((counted(1, "node"), counted(0, "node")), ("1 node".into(), "0 nodes".into()));
    }
}
