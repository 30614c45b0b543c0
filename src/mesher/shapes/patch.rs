//! RECTANGLE, QUADRILATERAL, DISC and RING: regions of two-dimensional meshes.

use crate::mesher::{
    body::{Body, Face, Shape},
    shapes::cylinder::Cylinder,
    shapes::hex_box::between,
    shapes::pole::Pole,
    shapes::section::Section,
    shapes::spacing::Spacing,
    turn,
};

/// A region with four edges, each straight or an arc.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// Corners, counter-clockwise.
    pub corners: [[f64; 2]; 4],
    /// Degrees that the edge from each corner to the next turns; positive bulges outwards.
    pub arcs: [f64; 4],
    /// Cells from corner 1 to 2 and from 1 to 4.
    pub cells: [Spacing; 2],
}

impl Patch {
    /// The point at s from 0 to 1 of the edge that begins at a corner.
    fn edge(&self, first: usize, s: f64) -> [f64; 2] {
        let (a, b) = (self.corners[first], self.corners[(first + 1) % 4]);
        if self.arcs[first] == 0.0 || s == 0.0 || s == 1.0 {
            return [0, 1].map(|i| between(a[i], b[i], s));
        }
        let half = 0.5 * self.arcs[first].to_radians();
        let along = [b[0] - a[0], b[1] - a[1]];
        let chord = libm::hypot(along[0], along[1]);
        let along = along.map(|x| x / chord);
        let (outward, radius) = ([along[1], -along[0]], 0.5 * chord / libm::sin(half));
        let angle = (2.0 * s - 1.0) * half;
        let (up, on) = (radius * (libm::cos(angle) - libm::cos(half)), radius * libm::sin(angle));
        [0, 1].map(|i| 0.5 * (a[i] + b[i]) + outward[i] * up + along[i] * on)
    }

    /// The point of the region at (u, v), between its edges (Coons 1967).
    fn point(&self, u: f64, v: f64) -> [f64; 2] {
        let c = &self.corners;
        let (bottom, top) = (self.edge(0, u), self.edge(2, 1.0 - u));
        let (right, left) = (self.edge(1, v), self.edge(3, 1.0 - v));
        [0, 1].map(|i| {
            let bilinear = between(between(c[0][i], c[1][i], u), between(c[3][i], c[2][i], u), v);
            // The edges themselves without rounding.
            match (u, v) {
                (_, 0.0) => bottom[i],
                (_, 1.0) => top[i],
                (0.0, _) => left[i],
                (1.0, _) => right[i],
                _ => between(bottom[i], top[i], v) + (between(left[i], right[i], u) - bilinear),
            }
        })
    }
}

impl Shape for Patch {
    fn elements(&self, refine: usize) -> f64 {
        self.cells.iter().map(|s| s.cells as f64 * refine as f64).product()
    }

    fn faces(&self) -> Vec<Face> {
        vec![Face::Front, Face::Right, Face::Back, Face::Left]
    }

    fn body(&self, refine: usize) -> Body {
        let [x, y] = self.cells.map(|s| s.positions(refine));
        let points = y.iter().flat_map(|&v| x.iter().map(move |&u| self.point(u, v))).collect();
        let names = [Some(Face::Front), Some(Face::Right), Some(Face::Back), Some(Face::Left)];
        grid(points, [x.len() - 1, y.len() - 1], false, names).flat()
    }
}

/// Cells between points row by row; the last column goes on at the first of a closed grid. Edges of the rim have these names.
fn grid(points: Vec<[f64; 2]>, [nx, ny]: [usize; 2], closed: bool, names: [Option<Face>; 4]) -> Section {
    let columns = if closed { nx } else { nx + 1 };
    let node = |i: usize, j: usize| (j * columns + i % columns) as u32;
    let mut section = Section { points, ..Section::default() };
    for j in 0..ny {
        for i in 0..nx {
            let quad = section.quads.len() as u32;
            section.quads.push([node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]);
            let rim = [j == 0, !closed && i + 1 == nx, j + 1 == ny, !closed && i == 0];
            for edge in (0..4).filter(|&edge| rim[edge]) {
                section.edges.extend(names[edge].map(|face| (face, quad, edge as u8)));
            }
        }
    }
    section
}

/// A disc: the section of a cylinder.
#[derive(Debug, Clone, PartialEq)]
pub struct Disc {
    /// Its section.
    pub section: Cylinder,
    /// Size of elements at the pole on the x axis, over what it would be.
    pub pole: f64,
}

impl Shape for Disc {
    fn elements(&self, refine: usize) -> f64 {
        self.section.elements(refine) / refine as f64
    }

    fn faces(&self) -> Vec<Face> {
        std::iter::once(Face::Outer).chain(self.section.extent.cuts()).collect()
    }

    fn body(&self, refine: usize) -> Body {
        let mut body = self.section.section(refine).flat();
        let pole = Pole { axis: 0, size: self.pole, is_cut: self.section.extent.cut()[0] };
        pole.draw_all(&mut body, self.section.radius);
        body
    }
}

/// A ring about the origin, or a part of one.
#[derive(Debug, Clone, PartialEq)]
pub struct Ring {
    /// Inner radius, > 0.
    pub inner: f64,
    /// Outer radius, > inner.
    pub outer: f64,
    /// Cells from the inner to the outer radius.
    pub through: Spacing,
    /// Cells around.
    pub around: usize,
    /// Degrees from the x axis at which it begins.
    pub from: f64,
    /// Degrees from there to its end; 360 close it.
    pub turned: f64,
}

impl Shape for Ring {
    fn elements(&self, refine: usize) -> f64 {
        [self.through.cells, self.around].iter().map(|&n| n as f64 * refine as f64).product()
    }

    fn faces(&self) -> Vec<Face> {
        let ends = [Face::Front, Face::Back].into_iter().filter(|_| self.turned < 360.0);
        [Face::Inner, Face::Outer].into_iter().chain(ends).collect()
    }

    fn body(&self, refine: usize) -> Body {
        let (around, closed) = (self.around * refine, self.turned == 360.0);
        let rays = if closed { around } else { around + 1 };
        let directions: Vec<[f64; 2]> = (0..rays)
            .map(|ray| turn::direction((self.from + self.turned * (ray as f64 / around as f64)) / 90.0))
            .collect();
        let radii = self.through.positions(refine);
        // Rows follow the circle, the outermost first, so that cells turn counter-clockwise.
        let points = radii.iter().rev().flat_map(|&s| {
            let radius = between(self.inner, self.outer, s);
            directions.iter().map(move |[c, s]| [radius * c, radius * s])
        });
        let points = points.collect();
        let names = [Some(Face::Outer), Some(Face::Back), Some(Face::Inner), Some(Face::Front)];
        grid(points, [around, radii.len() - 1], closed, names).flat()
    }
}

#[cfg(test)]
mod tests {
    use crate::mesh::{Dimension, Mesh, plane};
    use crate::mesher::make;

    fn area(mesh: &Mesh) -> f64 {
        let corners = |nodes: &[u32]| [0, 1, 2, 3].map(|i: usize| mesh.coordinates[nodes[i] as usize]);
        mesh.elements().map(|(_, nodes)| plane::area(&corners(nodes))).sum()
    }

    #[test]
    fn flat_shapes_have_their_areas() {
        let made = |recipe: &str| make(recipe, "t", 1).expect("a mesh");
        let rectangle =
            made("RECTANGLE, 1, 1., 2., 3., 4., 3, 5, 2.\nNODE SET PLANE, 1, X, 1.\nSIDE SET FACE, 2, 1, BACK\n");
        assert_eq!(rectangle.dimension, Dimension::Two);
        assert_eq!((rectangle.coordinates.len(), rectangle.element_count()), (24, 15));
        assert_eq!((rectangle.node_sets[0].nodes.len(), rectangle.side_sets[0].sides.len()), (6, 3));
        assert!((area(&rectangle) - 12.0).abs() < 1e-12);
        let pi = std::f64::consts::PI;
        let ring = made("RING, 1, 1., 2., 4, 60, 0., 90.\nSIDE SET BLOCK, 1\nSIDE SET FACE, 2, 1, INNER\n");
        assert!((area(&ring) - 0.75 * pi).abs() < 1e-3 && ring.side_sets[0].sides.len() == 128);
        let sector = made("QUADRILATERAL, 1, 4, 60\n1., 0.\n2., 0., 90.\n0., 2.\n0., 1., -90.\nEND\n");
        assert!((area(&sector) - area(&ring)).abs() < 1e-12);
        let disc = made("DISC, 1, 2., 20\nSIDE SET NORMAL, 3, 1., 0., 30.\n");
        assert!((area(&disc) - 4.0 * pi).abs() < 5e-3 && !disc.side_sets[0].sides.is_empty());
        let whole = made("RING, 1, 1., 2., 4, 60\nROTATE, 1, 30.\nTRANSLATE, 1, 5., 0.\n");
        assert_eq!((whole.coordinates.len(), whole.element_count()), (300, 240));
    }

    #[test]
    fn regions_are_joined_and_solids_are_refused() {
        let joined =
            "RECTANGLE, 1, 0., 0., 1., 1., 4, 4\nRECTANGLE, 2, 1., 0., 3., 1., 2, 4\nMERGE\nSIDE SET BLOCK, 1\n";
        let mesh = make(joined, "t", 1).expect("a mesh");
        assert_eq!((mesh.coordinates.len(), mesh.side_sets[0].sides.len()), (35, 20));
        let mixed = make("RECTANGLE, 1, 0., 0., 1., 1., 4, 4\nBOX, 2, 0., 0., 0., 1., 1., 1., 1, 1, 1\n", "t", 1);
        assert!(mixed.is_err_and(|found| found.to_string().contains("it belongs to three dimensions")));
    }
}
