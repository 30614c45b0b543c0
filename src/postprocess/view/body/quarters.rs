//! Faces divided among their corners, for values that stand for something: between a node that touches and one that does not
//! there is nothing in between.

use std::collections::HashMap;

use super::section::Between;
use super::subject::{Cut, Face};

/// Gives each corner of each face its part of it; the corner comes first in its part.
pub fn quarter(cut: &mut Cut) {
    let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
    let mut parts = Vec::with_capacity(4 * cut.skin.len());
    for face in std::mem::take(&mut cut.skin) {
        let mut corners = face.nodes.to_vec();
        corners.dedup();
        if corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        let count = corners.len();
        if count < 3 {
            continue;
        }
        let sides: Vec<u32> = (0..count)
            .map(|i| {
                let (a, b) = (corners[i], corners[(i + 1) % count]);
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| point(cut, [a, b], 0.5))
            })
            .collect();
        // The middle of a quadrilateral lies between the middles of opposite sides, that of a triangle on the line to a corner.
        let middle = match count {
            3 => point(cut, [corners[2], sides[0]], 2.0 / 3.0),
            _ => point(cut, [sides[0], sides[2]], 0.5),
        };
        for i in 0..count {
            let before = sides[(i + count - 1) % count];
            parts.push(Face { element: face.element, nodes: [corners[i], sides[i], middle, before] });
            cut.seams.push([middle.min(sides[i]), middle.max(sides[i])]);
        }
    }
    cut.skin = parts;
    let known: std::collections::HashSet<[u32; 2]> = cut.seams.iter().copied().collect();
    // Halves of what is no line are none either.
    for (ends, middle) in middles.iter().filter(|(ends, _)| known.contains(*ends)) {
        cut.seams.extend(ends.map(|end| [end.min(*middle), end.max(*middle)]));
    }
    cut.seams.sort_unstable();
}

fn point(cut: &mut Cut, ends: [u32; 2], part: f64) -> u32 {
    let [from, to] = ends.map(|end| cut.positions[end as usize]);
    cut.positions.push([0, 1, 2].map(|axis| from[axis] + part * (to[axis] - from[axis])));
    cut.made.push(Between { ends, part });
    cut.positions.len() as u32 - 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_corner_gets_its_part() {
        let positions = vec![[0.0; 3], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0], [5.0, 0.0, 0.0]];
        let skin = vec![Face { element: 0, nodes: [0, 1, 2, 3] }, Face { element: 1, nodes: [1, 4, 2, 2] }];
        let mut cut = Cut { positions, skin, made: Vec::new(), seams: Vec::new() };
        quarter(&mut cut);
        // Four parts and three; seven sides less the common one, and two middles.
        assert_eq!((cut.skin.len(), cut.made.len(), cut.seams.len()), (7, 6 + 2, 7));
        assert_eq!(cut.skin.iter().filter(|face| face.nodes[0] == 1).count(), 2);
        let middle = cut.positions[cut.skin[0].nodes[2] as usize];
        assert_eq!(middle, [1.0, 1.0, 0.0]);
        let centre = cut.positions[cut.skin[4].nodes[2] as usize];
        assert!((centre[0] - 3.0).abs() < 1e-15 && (centre[1] - 2.0 / 3.0).abs() < 1e-15, "{centre:?}");
    }
}
