//! Nodes that are pinned: between faces that cannot give way, with less room than they need.
//!
//! Each of the two constraints can be met alone, and so is not held; both together cannot, and their forces would grow with every
//! iteration, against each other and without bound, at the cost of what drives the faces. The room that is there is shared: both stay
//! short by half of what is missing.

use super::constraint::{Constraint, ConstraintState, Origin};
use crate::common::vector::dot;

/// Cosine of the angle between two normals below which a node is between two faces, and not in a wedge from which it slips.
pub(super) const OPPOSED: f64 = -0.9;

/// Lets the constraints of pinned nodes ask for no more than there is. `lone` says of which constraints only the first member can be
/// moved. The largest shortage, as a part of the face's size, and its node; a part of 0 where none is pinned.
pub(super) fn share_room(constraints: &[Constraint], states: &mut [ConstraintState], lone: &[bool]) -> (f64, u32) {
    let mut worst = (0.0, 0);
    for i in 0..constraints.len() {
        let Origin::Face(point, _) = constraints[i].origin else { continue };
        if !lone[i] {
            continue;
        }
        let of_point = |j: &usize| matches!(constraints[*j].origin, Origin::Face(other, _) if other == point);
        for j in (i + 1..constraints.len()).take_while(of_point) {
            if !lone[j] || dot(constraints[i].normal, constraints[j].normal) > OPPOSED {
                continue;
            }
            let missing = -(states[i].closing + states[j].closing);
            if missing > 0.0 {
                states[i].closing += 0.5 * missing;
                states[j].closing += 0.5 * missing;
                let part = missing / constraints[i].size.min(constraints[j].size);
                if part > worst.0 {
                    worst = (part, constraints[i].members[0]);
                }
            }
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Friction;
    use crate::solver::contact::enforcement::carried::Carried;
    use crate::solver::contact::enforcement::constraint::MEMBERS;

    fn constraint(point: u32, place: u32, z: f64) -> Constraint {
        Constraint {
            members: [point; MEMBERS],
            weights: [1.0; MEMBERS],
            count: MEMBERS,
            normal: [0.0, 0.0, z],
            gap: 0.0,
            growth: 0.0,
            persists: true,
            yields: false,
            is_thick: false,
            size: 2.0,
            share: 1.0,
            friction: Friction { at_rest: 0.0, high_speed: 0.0, decay: 0.0 },
            carried: Carried::NOTHING,
            origin: Origin::Face(point, place),
        }
    }

    #[test]
    fn what_is_missing_is_shared() {
        let constraints = [constraint(7, 0, 1.0), constraint(7, 1, -1.0), constraint(8, 0, 1.0)];
        let state = |closing| ConstraintState { closing, ..Default::default() };
        let before = [-0.3, 0.1, -0.5];
        let mut states = before.map(state);
        let (part, node) = share_room(&constraints, &mut states, &[true; 3]);
        assert!((part - 0.5 * 0.2).abs() < 1e-15 && node == 7, "{part} at {node}");
        let closing = states.map(|state| state.closing);
        assert!(
            (closing[0] + 0.2).abs() < 1e-15 && (closing[1] - 0.2).abs() < 1e-15 && closing[2] == -0.5,
            "{closing:?}"
        );
        // A face that can give way does.
        let mut states = before.map(state);
        assert_eq!(share_room(&constraints, &mut states, &[true, false, true]), (0.0, 0));
        // Where there is room enough each is met.
        let mut states = [-0.3, 0.4, 0.0].map(state);
        assert_eq!(share_room(&constraints, &mut states, &[true; 3]), (0.0, 0));
        assert_eq!(states[0].closing, -0.3);
    }
}
