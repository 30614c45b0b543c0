//! CYLINDER: a solid cylinder on the origin, its axis along z, with a butterfly section.
//!
//! The middle of the section is a rounded square of cells, the core; rings of cells lead from its rim to the circle.
//! So there are no thin wedges at the axis, and all cells are of about one size.

use crate::mesher::{
    body::{Body, Extent, Face, Shape},
    shapes::hex_box::between,
    shapes::section::Section,
    shapes::spacing::Spacing,
    turn,
};

/// A solid cylinder from z = 0 to z = length.
#[derive(Debug, Clone, PartialEq)]
pub struct Cylinder {
    /// Radius R.
    pub radius: f64,
    /// Length along z.
    pub length: f64,
    /// Cells n from the axis to the rim of the core, and again around an eighth of the circle.
    pub core_cells: usize,
    /// Cells from the rim of the core to the circle.
    pub rings: usize,
    /// Where the rim of the core meets the x axis, as a fraction of the radius.
    pub core: f64,
    /// Cells along z.
    pub along: Spacing,
    /// How much of the circle is modelled.
    pub extent: Extent,
}

/// How far the sides of the core bend inwards towards its corners, c: the solution of 13c² − 10c + 1 = 0 for which the
/// three cells at a corner meet at 120 degrees.
pub const ROUNDING: f64 = 0.118_146_029_604_788_1;

impl Cylinder {
    /// Position of the core's lattice point (i, j), counted in cells from the axis.
    fn core_point(&self, lattice: [i64; 2], n: usize) -> [f64; 2] {
        let [u, v] = lattice.map(|i| i as f64 / n as f64);
        let half = self.core * self.radius;
        [half * u * (1.0 - ROUNDING * v * v), half * v * (1.0 - ROUNDING * u * u)]
    }

    pub(in crate::mesher) fn section(&self, refine: usize) -> Section {
        let n = self.core_cells * refine;
        let rings = self.rings * refine;
        let lattice = Lattice::new(n, self.extent);
        let rim = rim(n, self.extent);
        let mut section = Section::default();
        section.points.extend(lattice.points().map(|point| self.core_point(point, n)));
        let core_points = section.points.len();
        for ring in 1..=rings {
            let s = ring as f64 / rings as f64;
            section.points.extend(rim.iter().zip(0..).map(|(&point, m)| {
                let from = self.core_point(point, n);
                let to = turn::direction(m as f64 / (2 * n) as f64).map(|c| self.radius * c);
                [between(from[0], to[0], s), between(from[1], to[1], s)]
            }));
        }
        lattice.add_quads(&mut section);
        let node = |m: usize, ring: usize| match ring {
            0 => lattice.node(rim[m % rim.len()]),
            _ => (core_points + (ring - 1) * rim.len() + m % rim.len()) as u32,
        };
        self.add_rings(&mut section, n, rings, node);
        section
    }

    /// The cells between the core and the circle; `node` numbers the points by position along the rim and ring.
    fn add_rings(&self, section: &mut Section, n: usize, rings: usize, node: impl Fn(usize, usize) -> u32) {
        let around = 2 * n * self.extent.quadrants();
        let open = self.extent != Extent::Full;
        let end = if self.extent == Extent::Half { Face::CutY } else { Face::CutX };
        for m in 0..around {
            for ring in 0..rings {
                let quad = section.quads.len() as u32;
                section.quads.push([node(m, ring), node(m, ring + 1), node(m + 1, ring + 1), node(m + 1, ring)]);
                let rim = [
                    (open && m == 0, Face::CutY, 0),
                    (ring + 1 == rings, Face::Outer, 1),
                    (open && m + 1 == around, end, 2),
                ];
                let rim = rim.iter().filter(|(here, ..)| *here);
                section.edges.extend(rim.map(|&(_, face, edge)| (face, quad, edge)));
            }
        }
    }
}

impl Shape for Cylinder {
    fn elements(&self, refine: usize) -> f64 {
        let [n, rings] = [self.core_cells, self.rings].map(|n| n as f64 * refine as f64);
        let quads = self.extent.quadrants() as f64 * (n * n + 2.0 * n * rings);
        quads * self.along.cells as f64 * refine as f64
    }

    fn faces(&self) -> Vec<Face> {
        [Face::Bottom, Face::Top, Face::Outer].into_iter().chain(self.extent.cuts()).collect()
    }

    fn body(&self, refine: usize) -> Body {
        self.section(refine).sweep(self.length, self.along, refine)
    }
}

/// The square lattice of the core: −n or 0 to n in x and y.
struct Lattice {
    n: i64,
    low: [i64; 2],
}

impl Lattice {
    fn new(n: usize, extent: Extent) -> Lattice {
        let n = n as i64;
        let [x, y, _] = extent.cut().map(|cut| if cut { 0 } else { -n });
        Lattice { n, low: [x, y] }
    }

    fn points(&self) -> impl Iterator<Item = [i64; 2]> {
        (self.low[1]..=self.n).flat_map(move |j| (self.low[0]..=self.n).map(move |i| [i, j]))
    }

    fn node(&self, [i, j]: [i64; 2]) -> u32 {
        ((j - self.low[1]) * (self.n - self.low[0] + 1) + (i - self.low[0])) as u32
    }

    fn add_quads(&self, section: &mut Section) {
        for j in self.low[1]..self.n {
            for i in self.low[0]..self.n {
                let quad = section.quads.len() as u32;
                section.quads.push([[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|point| self.node(point)));
                // Where the lattice begins at 0, the shape is cut.
                let rim = [(self.low[1] == 0 && j == 0, Face::CutY, 0), (self.low[0] == 0 && i == 0, Face::CutX, 3)];
                let rim = rim.iter().filter(|(here, ..)| *here);
                section.edges.extend(rim.map(|&(_, face, edge)| (face, quad, edge)));
            }
        }
    }
}

/// Lattice points on the rim of the core, counter-clockwise from the x axis.
fn rim(n: usize, extent: Extent) -> Vec<[i64; 2]> {
    let quadrants = extent.quadrants();
    let last = if extent == Extent::Full { 0 } else { 1 };
    (0..2 * n * quadrants + last)
        .map(|m| {
            let (quadrant, along) = (m / (2 * n), m % (2 * n));
            let (n, along) = (n as i64, along as i64);
            let first = if along <= n { [n, along] } else { [2 * n - along, n] };
            (0..quadrant).fold(first, |[i, j], _| [-j, i])
        })
        .collect()
}
