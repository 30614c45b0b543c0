//! Rigid planes.

use super::{
    RigidSurface,
    problem::{Draft, Setter},
};
use crate::deck::{Card, Diagnostic};

pub(super) const COMMANDS: &[Setter] = &[("RIGID SURFACE", rigid_surface)];

fn rigid_surface(card: &Card, draft: &mut Draft) {
    let Some(normal) = unit(card.vector(["nx", "ny", "nz"])) else {
        return draft.report(
            Diagnostic::error("RIGID SURFACE: the normal has length zero")
                .at(card.place("nx").join(card.place("nz")), "a direction is expected here")
                .help("the normal points away from the plane to the side where the body is: 0., 0., 1. for a floor"),
        );
    };
    draft.model.rigid_surfaces.push(RigidSurface {
        side_set: card.integer("side_set"),
        point: card.vector(["x0", "y0", "z0"]),
        normal,
        friction: card.number("friction"),
    });
}

/// The vector at length one; `None` for a zero vector. Divides by the largest component first, which neither
/// overflows nor underflows.
pub(super) fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let largest = vector.iter().fold(0.0f64, |largest, x| largest.max(x.abs()));
    if largest == 0.0 {
        return None;
    }
    let scaled = vector.map(|x| x / largest);
    let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
    Some(scaled.map(|x| x / length))
}

#[cfg(test)]
mod tests {
    use super::unit;

    #[test]
    fn normals_of_any_length_become_units() {
        assert_eq!(unit([0.0, 0.0, -2.0]), Some([0.0, 0.0, -1.0]));
        assert_eq!(unit([3e300, 4e300, 0.0]), Some([0.6, 0.8, 0.0]));
        assert_eq!(unit([0.0, 5e-324, 0.0]), Some([0.0, 1.0, 0.0]));
        assert_eq!(unit([0.0; 3]), None);
    }
}
