//! TRANSLATE, ROTATE and MIRROR: bodies put into place.

use crate::mesher::{body::Body, turn};

/// One change of place.
#[derive(Debug, Clone, PartialEq)]
pub enum Move {
    /// A displacement.
    Translate([f64; 3]),
    /// A right-handed rotation about a line parallel to an axis.
    Rotate {
        /// 0, 1 or 2 for x, y or z.
        axis: usize,
        /// Angle.
        degrees: f64,
        /// A point of the line.
        about: [f64; 3],
    },
    /// A reflection at a plane across an axis.
    Mirror {
        /// 0, 1 or 2 for x, y or z.
        axis: usize,
        /// Where the plane cuts the axis.
        at: f64,
    },
}

impl Move {
    /// Moves a body.
    pub fn apply(&self, body: &mut Body) {
        match *self {
            Move::Translate(by) => body.coordinates.iter_mut().for_each(|x| (0..3).for_each(|i| x[i] += by[i])),
            Move::Rotate { axis, degrees, about } => rotate(body, axis, degrees, about),
            Move::Mirror { axis, at } => mirror(body, axis, at),
        }
    }
}

fn rotate(body: &mut Body, axis: usize, degrees: f64, about: [f64; 3]) {
    let [c, s] = turn::direction(degrees / 90.0);
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    for x in &mut body.coordinates {
        let (a, b) = (x[u] - about[u], x[v] - about[v]);
        x[u] = about[u] + (c * a - s * b);
        x[v] = about[v] + (s * a + c * b);
    }
}

/// A mirror image turns elements inside out; exchanging their bottom and top turns them back.
fn mirror(body: &mut Body, axis: usize, at: f64) {
    body.coordinates.iter_mut().for_each(|x| x[axis] = at - (x[axis] - at));
    body.hexes.iter_mut().for_each(|nodes| nodes.rotate_left(4));
    for (_, side) in body.faces.iter_mut().flat_map(|(_, sides)| sides) {
        *side = match *side {
            4 => 5,
            5 => 4,
            around => around,
        };
    }
}
