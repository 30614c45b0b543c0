//! TRIANGLES: quadrilaterals of surfaces divided into triangles.

use crate::mesh::Shape;
use crate::mesher::assembly::Assembled;
use std::collections::BTreeMap;

/// How a quadrilateral is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pattern {
    /// In two, along one diagonal and along the other in its neighbours.
    Alternating,
    /// In two, from its first corner.
    Diagonal,
    /// In four, about its middle.
    Cross,
}

impl Pattern {
    /// By its word in a recipe.
    pub fn from_word(word: &str) -> Pattern {
        match word {
            "DIAGONAL" => Pattern::Diagonal,
            "CROSS" => Pattern::Cross,
            _ => Pattern::Alternating,
        }
    }
}

/// Divides the surfaces of a block; whether there are any. Elements are numbered anew, also in the named faces.
pub fn divide(assembled: &mut Assembled, id: i64, pattern: Pattern) -> bool {
    let Assembled { mesh, faces } = assembled;
    let Some(place) = mesh.blocks.iter().position(|block| block.id == id && block.shape == Shape::Quadrilateral) else {
        return false;
    };
    let behind = mesh.blocks[..=place].iter().map(|block| block.len() as u32).sum::<u32>();
    let block = &mut mesh.blocks[place];
    let quads: Vec<[u32; 4]> = block.nodes.chunks_exact(4).map(|quad| [quad[0], quad[1], quad[2], quad[3]]).collect();
    let turned = if pattern == Pattern::Alternating { odd(&quads) } else { vec![false; quads.len()] };
    block.shape = Shape::Triangle;
    block.nodes.clear();
    for (&[a, b, c, d], turned) in quads.iter().zip(turned) {
        if pattern == Pattern::Cross {
            let middle = mesh.coordinates.len() as u32;
            let corners = [a, b, c, d].map(|node| mesh.coordinates[node as usize]);
            mesh.coordinates.push([0, 1, 2].map(|i| 0.25 * corners.iter().map(|x| x[i]).sum::<f64>()));
            block.nodes.extend([a, b, middle, b, c, middle, c, d, middle, d, a, middle]);
        } else if turned {
            block.nodes.extend([b, c, d, b, d, a]);
        } else {
            block.nodes.extend([a, b, c, a, c, d]);
        }
    }
    let first = behind - quads.len() as u32;
    let (more, parts) = ((block.len() - quads.len()) as u32, block.len() / quads.len());
    for (_, sides) in faces.iter_mut().flat_map(|(_, faces)| faces) {
        *sides = sides
            .iter()
            .flat_map(|&(element, side)| match element.checked_sub(first) {
                None => vec![(element, side)],
                Some(_) if element >= behind => vec![(element + more, side)],
                Some(quad) => {
                    let quad = quad as usize;
                    let triangles = block.nodes.chunks_exact(3).skip(parts * quad).take(parts);
                    let beside = triangles.map(|triangle| side_of_triangle(&quads[quad], side, triangle));
                    let numbers = first + (parts * quad) as u32..;
                    numbers.zip(beside).filter_map(|(number, side)| Some((number, side?))).collect()
                }
            })
            .collect();
    }
    mesh.node_ids = (1..=mesh.coordinates.len() as i64).collect();
    mesh.element_ids = (1..=mesh.element_count() as i64).collect();
    true
}

/// The side of a triangle that lies in a side of the quadrilateral of which it is a part.
fn side_of_triangle(quad: &[u32; 4], side: u8, triangle: &[u32]) -> Option<u8> {
    if Shape::Quadrilateral.is_face(side) {
        return Some(side);
    }
    let edge = Shape::Quadrilateral.sides()[usize::from(side)];
    let sides = (0..).zip(Shape::Triangle.sides()).filter(|(side, _)| !Shape::Triangle.is_face(*side));
    let ends = |corners: &[usize]| [triangle[corners[0]], triangle[corners[1]]];
    sides.filter(|(_, corners)| ends(corners) == [quad[edge[0]], quad[edge[1]]]).map(|(side, _)| side).next()
}

/// Whether each quadrilateral is an odd number of edges away from the first of its surface.
fn odd(quads: &[[u32; 4]]) -> Vec<bool> {
    let edges = |quad: &[u32; 4]| [0, 1, 2, 3].map(|i| [quad[i], quad[(i + 1) % 4]]).map(|[a, b]| [a.min(b), a.max(b)]);
    let mut at: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (place, quad) in quads.iter().enumerate() {
        edges(quad).into_iter().for_each(|edge| at.entry(edge).or_default().push(place));
    }
    let mut odd: Vec<Option<bool>> = vec![None; quads.len()];
    for first in 0..quads.len() {
        let mut waiting = std::collections::VecDeque::from([(first, false)]);
        while let Some((place, parity)) = waiting.pop_front() {
            if odd[place].is_none() {
                odd[place] = Some(parity);
                let beside = edges(&quads[place]).into_iter().filter_map(|edge| at.get(&edge)).flatten();
                waiting.extend(beside.filter(|&&other| odd[other].is_none()).map(|&other| (other, !parity)));
            }
        }
    }
    odd.into_iter().map(|parity| parity.unwrap_or(false)).collect()
}

#[cfg(test)]
mod tests {
    use crate::common::vector::{cross, dot, subtract};
    use crate::mesh::{Shape, check};
    use crate::mesher;

    #[test]
    fn a_sheet_keeps_its_area_and_its_top() {
        for (pattern, count, nodes) in [("", 12, 12), ("DIAGONAL", 12, 12), ("CROSS", 24, 18)] {
            let recipe = format!("SHEET, 1, 0, 0, 0, 3, 2, 0, 3, 2\nTRIANGLES, 1, {pattern}\n");
            let mesh = mesher::make(&recipe, "t", 1).expect("a mesh");
            assert_eq!((mesh.element_count(), mesh.coordinates.len()), (count, nodes), "{pattern}");
            assert!(mesh.blocks[0].shape == Shape::Triangle && check::geometry(&mesh).is_empty());
            let area = |nodes: &[u32]| {
                let [a, b, c] = [0, 1, 2].map(|i: usize| mesh.coordinates[nodes[i] as usize]);
                0.5 * dot(cross(subtract(b, a), subtract(c, a)), [0.0, 0.0, 1.0])
            };
            let sum: f64 = mesh.elements().map(|(_, nodes)| area(nodes)).sum();
            assert!((sum - 6.0).abs() < 1e-14, "{pattern}: {sum}");
        }
        // By turns: the six triangles that meet at an inner node become four and eight.
        let mesh = mesher::make("SHEET, 1, 0, 0, 0, 4, 4, 0, 4, 4\nTRIANGLES, 1\n", "t", 1).expect("a mesh");
        let around = |at: [f64; 3]| {
            let node = mesh.coordinates.iter().position(|x| *x == at).expect("a node") as u32;
            mesh.elements().filter(|(_, nodes)| nodes.contains(&node)).count()
        };
        let mut counts = [around([1.0, 1.0, 0.0]), around([2.0, 1.0, 0.0])];
        counts.sort_unstable();
        assert_eq!(counts, [4, 8]);
        assert!(mesher::make("BOX, 1, 0, 0, 0, 3, 2, 1, 3, 2, 1\nTRIANGLES, 1\n", "t", 1).is_err());
    }

    /// Elements behind those that are divided are others by number: their named faces stay where they are.
    #[test]
    fn faces_of_blocks_behind_stay_where_they_are() {
        for pattern in ["", "DIAGONAL", "CROSS"] {
            let sheet = format!(
                "SHEET, 1, 0, 0, 0, 3, 2, 0, 3, 2\nTRIANGLES, 1, {pattern}\nSHEET, 4, 0, 0, 9, 3, 2, 0, 3, 2\n"
            );
            let boxes = "BOX, 2, 0, 0, 1, 3, 2, 2, 3, 2, 2\nNODE SET FACE, 1, 2, TOP\nSIDE SET FACE, 10, 2, TOP\n";
            let mesh = mesher::make(&format!("{sheet}{boxes}"), "t", 1).expect("a mesh");
            let nodes = &mesh.node_set(1).expect("a node set").nodes;
            assert_eq!(nodes.len(), 12, "{pattern}");
            assert!(nodes.iter().all(|&node| mesh.coordinates[node as usize][2] == 3.0), "{pattern}");
            let sides = &mesh.side_set(10).expect("a side set").sides;
            assert_eq!(sides.len(), 6);
            let elements: Vec<&[u32]> = mesh.elements().map(|(_, nodes)| nodes).collect();
            for (element, side) in sides {
                let corners = crate::mesh::HEX_SIDES[*side as usize].map(|c| elements[*element as usize][c]);
                assert!(corners.iter().all(|&node| mesh.coordinates[node as usize][2] == 3.0), "{pattern}");
            }
        }
    }
}
