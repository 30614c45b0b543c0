//! Bars as tubes: two-node elements have no faces, and get some around the line between their nodes.

use std::collections::BTreeMap;

use super::section::Between;
use super::subject::Face;
use super::thickness::Added;
use crate::common::vector::{add, cross, scaled, subtract, unit};

/// Sides of a tube; a multiple of two for its ends.
const SIDES: usize = 12;

/// Adds a tube of the radius of its element around each bar; bars without a length or a place are left out. No ring is drawn
/// where two bars go on from each other.
pub fn add_tubes(added: &mut Added, bars: &[(usize, [u32; 2], f64)]) {
    let mut ends: BTreeMap<u32, usize> = BTreeMap::new();
    bars.iter().flat_map(|bar| bar.1).for_each(|node| *ends.entry(node).or_default() += 1);
    for &(element, [a, b], radius) in bars {
        let [from, to] = [a, b].map(|node| added.positions[node as usize]);
        let Some(along) = unit(subtract(to, from)) else { continue };
        let least =
            (0..3).fold(0, |least: usize, axis| if along[axis].abs() < along[least].abs() { axis } else { least });
        let mut other = [0.0; 3];
        other[least] = 1.0;
        let Some(first) = unit(cross(along, other)) else { continue };
        let second = cross(along, first);
        let ring = |added: &mut Added, node: u32, centre: [f64; 3]| -> Vec<u32> {
            let place = |i: usize| {
                let (sin, cos) = (std::f64::consts::TAU * i as f64 / SIDES as f64).sin_cos();
                add(centre, add(scaled(first, radius * cos), scaled(second, radius * sin)))
            };
            (0..SIDES).map(|i| added.point(place(i), node)).collect()
        };
        let (start, end) = (ring(added, a, from), ring(added, b, to));
        for i in 0..SIDES {
            let next = (i + 1) % SIDES;
            added.skin.push(Face { element, nodes: [start[i], start[next], end[next], end[i]] });
            added.seam(start[i], end[i]);
        }
        for (node, ring) in [(a, &start), (b, &end)] {
            if ends.get(&node) == Some(&2) {
                (0..SIDES).for_each(|i| added.seam(ring[i], ring[(i + 1) % SIDES]));
            }
        }
        for i in (1..SIDES - 2).step_by(2) {
            let corners = |ring: &[u32]| [ring[0], ring[i], ring[i + 1], ring[i + 2]];
            let ([p, q, r, s], [t, u, v, w]) = (corners(&start), corners(&end));
            added.solids.push((element, [p, q, r, s, t, u, v, w]));
            added.skin.push(Face { element, nodes: [end[0], end[i], end[i + 1], end[i + 2]] });
            added.skin.push(Face { element, nodes: [start[0], start[i + 2], start[i + 1], start[i]] });
            if i > 1 {
                added.seam(end[0], end[i]);
                added.seam(start[0], start[i]);
            }
        }
    }
}

/// Points made at a node have its values.
pub fn at(node: u32) -> Between {
    Between { ends: [node, node], part: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::common::vector::dot;

    #[test]
    fn a_tube_is_closed_and_its_faces_look_outwards() {
        let mut added = Added { positions: vec![[0.0; 3], [3.0, 0.0, 4.0]], ..Added::default() };
        add_tubes(&mut added, &[(7, [0, 1], 0.5), (8, [1, 1], 0.5)]);
        assert_eq!(added.skin.len(), SIDES + 2 * (SIDES / 2 - 1));
        // The volume by the divergence theorem: that of a prism of twelve sides.
        let mut volume = 0.0;
        for face in &added.skin {
            let [a, b, c, d] = face.nodes.map(|node| added.positions[node as usize]);
            volume += (dot(a, cross(b, c)) + dot(a, cross(c, d))) / 6.0;
        }
        let area = 0.5 * SIDES as f64 * 0.25 * (std::f64::consts::TAU / SIDES as f64).sin();
        assert!((volume - 5.0 * area).abs() < 1e-12, "{volume} {}", 5.0 * area);
        assert!(added.made.iter().all(|made| made.part == 0.0) && added.skin.iter().all(|face| face.element == 7));
    }
}
