//! Storage of one element block on one rank: chunks of eight elements, each quantity a row of eight numbers.

use super::hex8::rows;
use super::kinematics::rotation_matrix;
use crate::lanes::{CHUNK, Row};
use crate::material::{Law, Start};
use crate::mesh::check::hexahedron_volume;
use crate::model::Hourglass;
use crate::solver::body::centroid;
use crate::solver::domain::state_names;
use crate::solver::nodes::{add, cross, dot, scaled, subtract};

/// The elements of one material on one rank.
pub struct ElementBlock {
    /// Index of the block in the mesh.
    pub index: usize,
    /// The block's number in the deck.
    pub id: i64,
    /// Mass density at the start.
    pub density: f64,
    /// Constitutive law.
    pub law: Law,
    /// The least part of an eighth of its mass that any node has of an element: 1 but where corners coincide.
    pub least_share: f64,
    /// Hourglass control.
    pub hourglass: Hourglass,
    /// Names of the law's stored state variables, in row order.
    pub state_names: &'static [&'static str],
    /// Elements with a node that other ranks share; computed first, so that their forces travel while the rest works.
    pub border: Group,
    /// All others.
    pub interior: Group,
}

/// Some elements of a block in canonical order, in chunks. The last chunk is filled up with copies of its last
/// element, which are computed but never used.
#[derive(Default)]
pub struct Group {
    /// Place of each element in the rank's canonical order, ascending.
    pub places: Vec<u32>,
    /// Local nodes, `[chunk][corner][lane]`.
    pub connectivity: Vec<[[u32; CHUNK]; 8]>,
    /// Element masses, one row per chunk.
    pub mass: Vec<Row>,
    /// State, `stride` rows per chunk; see [`rows`].
    pub state: Vec<Row>,
    /// Rows per chunk.
    pub stride: usize,
    /// Which elements have been taken away; empty while none have.
    pub gone: Vec<bool>,
}

/// An element as a group takes it in.
pub struct NewElement {
    /// Place in the rank's canonical order.
    pub place: u32,
    /// Local nodes.
    pub nodes: [u32; 8],
    /// Corner positions.
    pub corners: [[f64; 3]; 8],
    /// Mass.
    pub mass: f64,
}

impl Group {
    /// Elements at rest, unstressed, with frames along their own axes, and what their law stores.
    pub fn new(elements: &[NewElement], law: &Law) -> Group {
        let stride = rows::LAW + state_names(law).len();
        let chunks = elements.len().div_ceil(CHUNK);
        let mut group = Group {
            places: elements.iter().map(|e| e.place).collect(),
            connectivity: vec![[[0; CHUNK]; 8]; chunks],
            mass: vec![Row::default(); chunks],
            state: vec![Row::default(); chunks * stride],
            stride,
            gone: Vec::new(),
        };
        for slot in 0..chunks * CHUNK {
            let (chunk, lane) = (slot / CHUNK, slot % CHUNK);
            let element = &elements[slot.min(elements.len() - 1)];
            for corner in 0..8 {
                group.connectivity[chunk][corner][lane] = element.nodes[corner];
            }
            group.mass[chunk].0[lane] = element.mass;
            let state = &mut group.state[chunk * stride..(chunk + 1) * stride];
            for component in 0..3 {
                state[rows::STRETCH + component].0[lane] = 1.0;
            }
            let axes = own_axes(&element.corners);
            for (row, value) in state[rows::FRAME..].iter_mut().zip(axes) {
                row.0[lane] = value;
            }
            let start = Start {
                centre: centroid(&element.corners),
                volume: hexahedron_volume(&element.corners),
                frame: rotation_matrix(&axes),
            };
            for (row, value) in state[rows::LAW..].iter_mut().zip(law.start(&start)) {
                row.0[lane] = value;
            }
        }
        group
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// One stored number of the `i`-th element.
    pub fn value(&self, i: usize, row: usize) -> f64 {
        self.state[i / CHUNK * self.stride + row].0[i % CHUNK]
    }

    /// Several consecutive stored numbers of the `i`-th element.
    pub fn values<const N: usize>(&self, i: usize, first: usize) -> [f64; N] {
        std::array::from_fn(|k| self.value(i, first + k))
    }

    /// Local nodes of the `i`-th element.
    pub fn nodes(&self, i: usize) -> [u32; 8] {
        std::array::from_fn(|corner| self.connectivity[i / CHUNK][corner][i % CHUNK])
    }

    /// Mass of the `i`-th element.
    pub fn element_mass(&self, i: usize) -> f64 {
        self.mass[i / CHUNK].0[i % CHUNK]
    }
}

impl ElementBlock {
    /// Both groups: border, then interior.
    pub fn groups(&self) -> [&Group; 2] {
        [&self.border, &self.interior]
    }
}

/// `a` at length one, or `None` when it has no direction.
fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(a, a).sqrt();
    (length > 0.0 && length.is_finite()).then(|| scaled(a, 1.0 / length))
}

/// The element's own axes as a unit quaternion: e₁ along ξ, e₂ in the plane of ξ and η. The fixed axes where an
/// element is too degenerate to have any.
pub(super) fn own_axes(corners: &[[f64; 3]; 8]) -> [f64; 4] {
    let along = |minus: [usize; 4], plus: [usize; 4]| {
        (0..4).fold([0.0; 3], |sum, i| add(sum, subtract(corners[plus[i]], corners[minus[i]])))
    };
    let xi = along([0, 3, 4, 7], [1, 2, 5, 6]);
    let eta = along([0, 1, 4, 5], [3, 2, 7, 6]);
    let axes = unit(xi).and_then(|e1| unit(subtract(eta, scaled(e1, dot(eta, e1)))).map(|e2| [e1, e2, cross(e1, e2)]));
    axes.map_or([1.0, 0.0, 0.0, 0.0], |axes| quaternion(&axes))
}

/// Unit quaternion of the rotation whose matrix has the columns `e` (Shepperd 1978: the largest term is the pivot).
fn quaternion(e: &[[f64; 3]; 3]) -> [f64; 4] {
    let (m00, m11, m22) = (e[0][0], e[1][1], e[2][2]);
    let squares = [1.0 + m00 + m11 + m22, 1.0 + m00 - m11 - m22, 1.0 - m00 + m11 - m22, 1.0 - m00 - m11 + m22];
    let pivot = (0..4).fold(0, |best, i| if squares[i] > squares[best] { i } else { best });
    // Columns are axes: component i of axis j is m[i][j].
    let (x, y, z) = (e[1][2] - e[2][1], e[2][0] - e[0][2], e[0][1] - e[1][0]);
    let (xy, yz, zx) = (e[0][1] + e[1][0], e[1][2] + e[2][1], e[2][0] + e[0][2]);
    let q = match pivot {
        0 => [squares[0], x, y, z],
        1 => [x, squares[1], xy, zx],
        2 => [y, xy, squares[2], yz],
        _ => [z, zx, yz, squares[3]],
    };
    let length = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    q.map(|c| c / length)
}
