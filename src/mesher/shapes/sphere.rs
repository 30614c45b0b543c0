//! SPHERE and SPHERE SHELL: balls about the origin, solid with a rounded cube as core, or hollow.

use crate::mesher::{
    body::{Body, CUTS, Extent, Face, Shape},
    shapes::cylinder::ROUNDING,
    shapes::hex_box::between,
    shapes::pole::Pole,
    shapes::spacing::Spacing,
};

/// A solid ball.
#[derive(Debug, Clone, PartialEq)]
pub struct Sphere {
    /// Radius R.
    pub radius: f64,
    /// Cells n from the centre to the rim of the core, and again around an eighth of a great circle.
    pub core_cells: usize,
    /// Cells from the rim of the core to the surface.
    pub rings: usize,
    /// Where the rim of the core meets the axes, as a fraction of the radius.
    pub core: f64,
    /// How much of the ball is modelled.
    pub extent: Extent,
    /// Size of elements at the pole on the z axis, over what it would be.
    pub pole: f64,
}

/// A hollow ball.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereShell {
    /// Inner radius, > 0.
    pub inner: f64,
    /// Outer radius, > inner.
    pub outer: f64,
    /// Cells around an eighth of a great circle.
    pub around: usize,
    /// Cells through the wall, from the inside.
    pub through: Spacing,
    /// How much of the ball is modelled.
    pub extent: Extent,
}

/// A point of the cubic lattice from −n or 0 to n.
type Point = [i64; 3];

impl Shape for Sphere {
    fn elements(&self, refine: usize) -> f64 {
        let [n, rings] = [self.core_cells, self.rings].map(|n| n as f64 * refine as f64);
        octants(self.extent) * (n * n * n + 3.0 * n * n * rings)
    }

    fn faces(&self) -> Vec<Face> {
        [Face::Outer].into_iter().chain(self.extent.cuts()).collect()
    }

    fn body(&self, refine: usize) -> Body {
        let lattice = Lattice::new(self.core_cells * refine, self.extent);
        let rings = self.rings * refine;
        let surface = lattice.surface();
        let mut body = lattice.core(|u| {
            // As in the cylinder's section in each of the three planes.
            let bent = u.map(|t| 1.0 - ROUNDING * t * t);
            let half = self.core * self.radius;
            [half * u[0] * bent[1] * bent[2], half * u[1] * bent[0] * bent[2], half * u[2] * bent[0] * bent[1]]
        });
        let core: Vec<u32> = surface.points.iter().map(|&point| lattice.node(point)).collect();
        let rim: Vec<[f64; 3]> = core.iter().map(|&node| body.coordinates[node as usize]).collect();
        let first = body.coordinates.len();
        for ring in 1..=rings {
            let s = ring as f64 / rings as f64;
            body.coordinates.extend(surface.points.iter().zip(&rim).map(|(&point, from)| {
                let to = lattice.direction(point).map(|c| self.radius * c);
                [0, 1, 2].map(|axis| between(from[axis], to[axis], s))
            }));
        }
        surface.add_rings(&mut body, rings, &lattice, |point, ring| match ring {
            0 => core[point],
            _ => (first + (ring - 1) * core.len() + point) as u32,
        });
        let pole = Pole { axis: 2, size: self.pole, is_cut: self.extent.cut()[2] };
        pole.draw_all(&mut body, self.radius);
        body
    }
}

impl Shape for SphereShell {
    fn elements(&self, refine: usize) -> f64 {
        let [n, through] = [self.around, self.through.cells].map(|n| n as f64 * refine as f64);
        octants(self.extent) * 3.0 * n * n * through
    }

    fn faces(&self) -> Vec<Face> {
        [Face::Inner, Face::Outer].into_iter().chain(self.extent.cuts()).collect()
    }

    fn body(&self, refine: usize) -> Body {
        let lattice = Lattice::new(self.around * refine, self.extent);
        let surface = lattice.surface();
        let directions: Vec<[f64; 3]> = surface.points.iter().map(|&point| lattice.direction(point)).collect();
        let mut body = Body::default();
        let positions = self.through.positions(refine);
        for &s in &positions {
            let radius = between(self.inner, self.outer, s);
            body.coordinates.extend(directions.iter().map(|d| d.map(|c| radius * c)));
        }
        body.add_to_face(Face::Inner, (0..surface.quads.len() as u32).map(|quad| (quad, 4)));
        surface.add_rings(&mut body, positions.len() - 1, &lattice, |point, ring| {
            (ring * directions.len() + point) as u32
        });
        body
    }
}

fn octants(extent: Extent) -> f64 {
    extent.cut().iter().map(|&cut| if cut { 1.0 } else { 2.0 }).product()
}

/// The cubic lattice that is bent into a ball.
struct Lattice {
    n: i64,
    low: [i64; 3],
}

impl Lattice {
    fn new(n: usize, extent: Extent) -> Lattice {
        let n = n as i64;
        Lattice { n, low: extent.cut().map(|cut| if cut { 0 } else { -n }) }
    }

    fn node(&self, point: Point) -> u32 {
        let [i, j, k] = [0, 1, 2].map(|axis| point[axis] - self.low[axis]);
        let [nx, ny, _] = self.low.map(|low| self.n - low + 1);
        ((k * ny + j) * nx + i) as u32
    }

    /// The solid core; `position` places a point given as fractions from −1 to 1.
    fn core(&self, position: impl Fn([f64; 3]) -> [f64; 3]) -> Body {
        let mut body = Body::default();
        let n = self.n;
        let [x, y, z] = self.low;
        for k in z..=n {
            for j in y..=n {
                body.coordinates.extend((x..=n).map(|i| position([i, j, k].map(|i| i as f64 / n as f64))));
            }
        }
        for k in z..n {
            for j in y..n {
                for i in x..n {
                    let element = body.hexes.len() as u32;
                    let ring = |k| [[i, j, k], [i + 1, j, k], [i + 1, j + 1, k], [i, j + 1, k]].map(|p| self.node(p));
                    let ([a, b, c, d], [e, f, g, h]) = (ring(k), ring(k + 1));
                    body.hexes.push([a, b, c, d, e, f, g, h]);
                    for (axis, side) in [(0, 3), (1, 0), (2, 4)] {
                        if self.low[axis] == 0 && [i, j, k][axis] == 0 {
                            body.add_to_face(CUTS[axis], [(element, side)]);
                        }
                    }
                }
            }
        }
        body
    }

    /// The outer surface of the lattice, without the planes at which it is cut.
    fn surface(&self) -> Surface {
        let mut corners: Vec<[Point; 4]> = Vec::new();
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let ends = if self.low[axis] == 0 { vec![self.n] } else { vec![self.low[axis], self.n] };
            for end in ends {
                for b in self.low[v]..self.n {
                    for a in self.low[u]..self.n {
                        let at = |a: i64, b: i64| {
                            let mut point = [end; 3];
                            (point[u], point[v]) = (a, b);
                            point
                        };
                        let (first, last) = (at(a, b), at(a + 1, b + 1));
                        let (second, third) = (at(a + 1, b), at(a, b + 1));
                        // Counter-clockwise seen from outside.
                        corners.push(if end > 0 { [first, second, last, third] } else { [first, third, last, second] });
                    }
                }
            }
        }
        let mut points: Vec<Point> = corners.as_flattened().to_vec();
        points.sort_unstable();
        points.dedup();
        // Every corner is in the list that has been made of them.
        let index = |point: Point| points.partition_point(|p| *p < point) as u32;
        let quads = corners.iter().map(|quad| quad.map(index)).collect();
        Surface { quads, points }
    }

    /// Unit vector through a point of the lattice's surface: equal angles between neighbours on the great circles.
    fn direction(&self, point: Point) -> [f64; 3] {
        let tangents = point.map(|i| match i.abs() == self.n {
            true => i.signum() as f64,
            false => libm::tan(i as f64 / self.n as f64 * std::f64::consts::FRAC_PI_4),
        });
        let length = libm::sqrt(tangents.iter().map(|t| t * t).sum());
        tangents.map(|t| t / length)
    }
}

/// Quadrilaterals on the surface of a lattice.
struct Surface {
    points: Vec<Point>,
    quads: Vec<[u32; 4]>,
}

impl Surface {
    /// Layers of hexahedra on the surface; `node` numbers them by point of the surface and ring.
    fn add_rings(&self, body: &mut Body, rings: usize, lattice: &Lattice, node: impl Fn(usize, usize) -> u32) {
        for ring in 0..rings {
            for quad in &self.quads {
                let element = body.hexes.len() as u32;
                let [a, b, c, d] = quad.map(|point| node(point as usize, ring));
                let [e, f, g, h] = quad.map(|point| node(point as usize, ring + 1));
                body.hexes.push([a, b, c, d, e, f, g, h]);
                for edge in 0..4 {
                    let ends = [quad[edge], quad[(edge + 1) % 4]].map(|point| self.points[point as usize]);
                    for axis in (0..3).filter(|&axis| lattice.low[axis] == 0) {
                        if ends.iter().all(|point| point[axis] == 0) {
                            body.add_to_face(CUTS[axis], [(element, edge as u8)]);
                        }
                    }
                }
                if ring + 1 == rings {
                    body.add_to_face(Face::Outer, [(element, 5)]);
                }
            }
        }
    }
}
