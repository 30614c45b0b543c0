//! Corners of hexahedra that have turned inside out.

use super::check::hexahedron_volume;
use crate::common::vector::{cross, dot, subtract};
use crate::lanes::array;

/// For each corner its neighbours along the three edges, in the order in which they turn to the right.
pub const NEIGHBOURS: [[usize; 3]; 8] =
    [[1, 3, 4], [2, 0, 5], [3, 1, 6], [0, 2, 7], [7, 5, 0], [4, 6, 1], [5, 7, 2], [6, 4, 3]];

/// The Jacobian of a hexahedron at one of its corners, the triple product of the edges there.
#[inline(always)]
fn jacobian(corners: &[[f64; 3]; 8], corner: usize) -> f64 {
    let [a, b, c] = NEIGHBOURS[corner];
    let edge = |neighbour: usize| subtract(corners[neighbour], corners[corner]);
    dot(edge(a), cross(edge(b), edge(c)))
}

/// Whether no corner of a hexahedron is flat or inside out. Corners that coincide, as in wedges and pyramids, are flat: what is meant
/// by them only [`least_corner`] knows, which takes many times as long.
#[inline]
pub fn all_corners_are_sound(corners: &[[f64; 3]; 8]) -> bool {
    // Corner by corner at compile time: a loop looks each neighbour up.
    let is_sound = array![i in 8 => jacobian(corners, i) > 0.0];
    is_sound.iter().fold(true, |all, sound| all & sound)
}

/// The least Jacobian of a hexahedron's corners over its mean one: 1 in a parallelepiped, 0 or less where a corner is
/// flat or inside out. In wedges and pyramids, whose corners coincide in part, of the corners that have three edges.
pub fn least_corner(nodes: &[u32; 8], corners: &[[f64; 3]; 8]) -> f64 {
    let has_three_edges = |corner: usize| NEIGHBOURS[corner].iter().all(|&other| nodes[other] != nodes[corner]);
    let jacobians = (0..8).filter(|&corner| has_three_edges(corner)).map(|corner| jacobian(corners, corner));
    let least = jacobians.fold(f64::INFINITY, f64::min);
    let volume = hexahedron_volume(corners).abs();
    // Where no corner has three edges, or nothing has a volume, nothing is said.
    if least.is_finite() && volume > 0.0 { least / volume } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::UNIT_CUBE;
    use proptest::prelude::*;

    const NODES: [u32; 8] = [0, 1, 2, 3, 4, 5, 6, 7];

    #[test]
    fn a_parallelepiped_has_equal_corners() {
        let sheared = UNIT_CUBE.map(|[x, y, z]| [2.0 * x + 0.5 * y, y - 0.25 * z, 3.0 * z + 0.1 * x]);
        assert!((least_corner(&NODES, &sheared) - 1.0).abs() < 1e-14);
    }

    /// One corner pushed along the diagonal of the cube by d: its Jacobian is 1 − 3d, that of the whole cube's volume
    /// stays positive long after.
    #[test]
    fn a_corner_turns_inside_out_before_the_element_does() {
        for corner in 0..8 {
            let pushed = |d: f64| {
                let mut cube = UNIT_CUBE;
                cube[corner] = cube[corner].map(|x| x + d * (1.0 - 2.0 * x));
                cube
            };
            let (sound, turned) = (pushed(0.3), pushed(0.4));
            assert!(hexahedron_volume(&turned) > 0.5);
            assert!(all_corners_are_sound(&sound) && !all_corners_are_sound(&turned));
            let measured = [sound, turned].map(|cube| least_corner(&NODES, &cube) * hexahedron_volume(&cube));
            assert!((measured[0] - 0.1).abs() < 1e-14, "corner {corner}: {measured:?}");
            assert!((measured[1] + 0.2).abs() < 1e-14, "corner {corner}: {measured:?}");
        }
    }

    #[test]
    fn coinciding_corners_of_a_wedge_are_no_fault() {
        let (mut wedge, mut nodes) = (UNIT_CUBE, NODES);
        (wedge[3], wedge[7], nodes[3], nodes[7]) = (wedge[2], wedge[6], 2, 6);
        assert!(least_corner(&nodes, &wedge) > 1.0);
        assert!(!all_corners_are_sound(&wedge), "coinciding corners are flat");
    }

    proptest! {
        /// Corners that are said to be sound are so, whatever the element: wild, collapsed, or no numbers at all.
        #[test]
        fn what_is_said_to_be_sound_is(
            shifts in prop::array::uniform8(prop::array::uniform3(-0.7..0.7f64)),
            joined in prop::option::of((0usize..8, 0usize..8)), broken in prop::option::of(0usize..8),
        ) {
            let (mut corners, mut nodes) = (UNIT_CUBE, NODES);
            for (corner, shift) in corners.iter_mut().zip(shifts) {
                *corner = [0, 1, 2].map(|i| corner[i] + shift[i]);
            }
            if let Some((one, other)) = joined {
                (corners[one], nodes[one]) = (corners[other], nodes[other]);
            }
            if let Some(corner) = broken {
                corners[corner][0] = f64::NAN;
            }
            prop_assert!(!all_corners_are_sound(&corners) || least_corner(&nodes, &corners) > 0.0);
            prop_assert!(broken.is_none() || !all_corners_are_sound(&corners));
        }
    }
}
