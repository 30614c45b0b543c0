//! Two straight lines that cross between their ends, and the shortest way between them.

use crate::common::vector::{add, cross, dot, scaled, subtract};

/// Smallest sine of the angle between edges that meet: nearly parallel edges are for nodes and faces.
pub const CROSSING: f64 = 0.05;

/// Parts of a line from one end to the other.
pub const WHOLE: [f64; 2] = [0.0, 1.0];

/// A straight line by its ends.
pub type Line = [[f64; 3]; 2];

/// Where two edges are nearest to each other.
pub struct Crossing {
    /// Unit normal to both, in the sense of the product of their directions.
    pub normal: [f64; 3],
    /// Places along the edges, 0 to 1 between the ends.
    pub places: [f64; 2],
    /// Distance from the second to the first along the normal, a length with a sign.
    pub gap: f64,
    /// Lengths of the edges.
    pub lengths: [f64; 2],
    /// Sine of the angle between them.
    pub sine: f64,
}

impl Crossing {
    /// `None` for edges that are nearly parallel or have no length.
    pub fn of(lines: [Line; 2]) -> Option<Crossing> {
        Crossing::with(lines, CROSSING)
    }

    /// The same of edges with at least this sine of the angle between them.
    pub fn with([a, b]: [Line; 2], least: f64) -> Option<Crossing> {
        let (u, v, r) = (subtract(a[1], a[0]), subtract(b[1], b[0]), subtract(b[0], a[0]));
        let product = cross(u, v);
        let (uu, vv, square) = (dot(u, u), dot(v, v), dot(product, product));
        if square.is_nan() || square <= least * least * uu * vv {
            return None;
        }
        let places = [dot(cross(r, v), product) / square, dot(cross(r, u), product) / square];
        let length = square.sqrt();
        let normal = scaled(product, 1.0 / length);
        let lengths = [uu.sqrt(), vv.sqrt()];
        Some(Crossing { normal, places, gap: -dot(r, normal), lengths, sine: length / (lengths[0] * lengths[1]) })
    }

    /// Whether they cross by more than `depth` from every end: nearer to an end, a node or another edge is in the way before these two.
    /// Each line reaches from and to these parts of it.
    pub fn within(&self, depth: f64, parts: [[f64; 2]; 2]) -> bool {
        let inside = |place: f64, [low, high]: [f64; 2], length: f64| (place - low).min(high - place) * length > depth;
        inside(self.places[0], parts[0], self.lengths[0]) && inside(self.places[1], parts[1], self.lengths[1])
    }

    /// Length of the shorter one.
    pub fn shorter(&self) -> f64 {
        self.lengths[0].min(self.lengths[1])
    }
}

/// Two edges that cross, seen along the normal of both, as numbers that need no root and no quotient.
pub struct QuickCrossing {
    /// Product of their directions, and its square.
    pub product: [f64; 3],
    pub square: f64,
    /// Vector from the first to the second, times the product.
    pub fall: f64,
    /// Places along the edges, 0 at the first ends and the square at the second.
    places: [f64; 2],
}

impl QuickCrossing {
    /// How two lines cross; `None` where they do not between their ends. Each reaches from and to these parts of it.
    #[inline(always)]
    pub fn of([a, b]: [Line; 2], parts: [[f64; 2]; 2]) -> Option<QuickCrossing> {
        let (u, v, r) = (subtract(a[1], a[0]), subtract(b[1], b[0]), subtract(b[0], a[0]));
        let product = cross(u, v);
        let square = dot(product, product);
        let places = [dot(cross(r, v), product), dot(cross(r, u), product)];
        let crossing = QuickCrossing { product, square, fall: dot(r, product), places };
        crossing.is_within(parts).then_some(crossing)
    }

    /// Whether they cross where each reaches from and to these parts of it.
    #[inline(always)]
    pub fn is_within(&self, parts: [[f64; 2]; 2]) -> bool {
        let within = |place: f64, [low, high]: [f64; 2]| place >= low * self.square && place <= high * self.square;
        within(self.places[0], parts[0]) && within(self.places[1], parts[1])
    }
}

/// Shortest way from the second of two edges to the first, between their ends (Ericson 2005).
pub fn between([a, b]: [Line; 2]) -> [f64; 3] {
    let (u, v, r) = (subtract(a[1], a[0]), subtract(b[1], b[0]), subtract(a[0], b[0]));
    let (uu, uv, vv, ur, vr) = (dot(u, u), dot(u, v), dot(v, v), dot(u, r), dot(v, r));
    let within = |place: f64| if place > 0.0 { place.min(1.0) } else { 0.0 };
    // Of edges that are parallel any place of the first will do; what is no number becomes 0.
    let s = within((uv * vr - ur * vv) / (uu * vv - uv * uv));
    let t = within((uv * s + vr) / vv);
    let s = within((uv * t - ur) / uu);
    subtract(add(r, scaled(u, s)), scaled(v, t))
}
