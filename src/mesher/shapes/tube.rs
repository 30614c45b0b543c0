//! TUBE: a hollow cylinder on the origin, its axis along z.

use crate::mesher::{
    body::{Body, Extent, Face, Shape},
    shapes::hex_box::between,
    shapes::section::Section,
    shapes::spacing::Spacing,
    turn,
};

/// A hollow cylinder from z = 0 to z = length.
#[derive(Debug, Clone, PartialEq)]
pub struct Tube {
    /// Inner radius, > 0.
    pub inner: f64,
    /// Outer radius, > inner.
    pub outer: f64,
    /// Length along z.
    pub length: f64,
    /// Cells through the wall, from the inside.
    pub through: Spacing,
    /// Cells around the part that is modelled.
    pub around: usize,
    /// Cells along z.
    pub along: Spacing,
    /// How much of the circle is modelled.
    pub extent: Extent,
}

impl Tube {
    fn section(&self, refine: usize) -> Section {
        let radii: Vec<f64> =
            self.through.positions(refine).iter().map(|&s| between(self.inner, self.outer, s)).collect();
        let around = self.around * refine;
        let closed = self.extent == Extent::Full;
        let rays = if closed { around } else { around + 1 };
        let mut section = Section::default();
        for ray in 0..rays {
            let quarter_turns = (ray * self.extent.quadrants()) as f64 / around as f64;
            let [c, s] = turn::direction(quarter_turns);
            section.points.extend(radii.iter().map(|r| [r * c, r * s]));
        }
        let walls = radii.len() - 1;
        let node = |ray: usize, wall: usize| ((ray % rays) * radii.len() + wall) as u32;
        for ray in 0..around {
            for wall in 0..walls {
                let quad = section.quads.len() as u32;
                section.quads.push([
                    node(ray, wall),
                    node(ray, wall + 1),
                    node(ray + 1, wall + 1),
                    node(ray + 1, wall),
                ]);
                let end = if self.extent == Extent::Half { Face::CutY } else { Face::CutX };
                let rim = [
                    (!closed && ray == 0, Face::CutY),
                    (wall + 1 == walls, Face::Outer),
                    (!closed && ray + 1 == around, end),
                    (wall == 0, Face::Inner),
                ];
                let rim = rim.iter().zip(0..).filter(|((here, _), _)| *here);
                section.edges.extend(rim.map(|(&(_, face), edge)| (face, quad, edge)));
            }
        }
        section
    }
}

impl Shape for Tube {
    fn elements(&self, refine: usize) -> f64 {
        [self.through.cells, self.around, self.along.cells].iter().map(|&n| n as f64 * refine as f64).product()
    }

    fn faces(&self) -> Vec<Face> {
        [Face::Bottom, Face::Top, Face::Inner, Face::Outer].into_iter().chain(self.extent.cuts()).collect()
    }

    fn body(&self, refine: usize) -> Body {
        self.section(refine).sweep(self.length, self.along, refine)
    }
}
