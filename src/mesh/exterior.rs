//! Which faces are on the outside, and which element is across each of the others.
//!
//! Two elements share a face when its nodes are the same in any order, each counted once: a quadrilateral that has collapsed
//! to a triangle then matches whichever corner it repeats.

use super::Shape;
use std::ops::Range;

/// A face has the number `SIDES` × the place of its element + its side.
pub const SIDES: usize = 6;

/// Across a face on the outside.
pub const EXTERIOR: u32 = u32::MAX;

/// Across what is no face: not wanted, collapsed, or a side that the element's shape does not have.
pub const NONE: u32 = u32::MAX - 1;

/// What a face has in common with the one across: its different nodes, ascending, and `u32::MAX` in place of a repeated one.
/// `None` where a side has collapsed to a line or a point and is no face.
pub fn key(mut nodes: [u32; 4]) -> Option<[u32; 4]> {
    nodes.sort_unstable();
    for i in (1..4).rev() {
        if nodes[i] == nodes[i - 1] {
            nodes[i..].rotate_left(1);
            nodes[3] = u32::MAX;
        }
    }
    (nodes[2] != u32::MAX).then_some(nodes)
}

/// The same for a face of an element of this shape: an edge of a plane element is known by its two ends.
pub fn key_of(shape: Shape, nodes: [u32; 4]) -> Option<[u32; 4]> {
    let [a, b, ..] = nodes;
    match shape {
        Shape::Plane => (a != b).then_some([a.min(b), a.max(b), u32::MAX, u32::MAX]),
        _ => key(nodes),
    }
}

/// The faces of an element, each with its side and its nodes, counter-clockwise seen from outside.
pub fn faces(shape: Shape, nodes: &[u32]) -> impl Iterator<Item = (u8, [u32; 4])> {
    (0..).zip(shape.faces()).filter_map(move |(side, _)| Some((side, shape.face(nodes, side)?)))
}

/// For each number of a face: the number of the face across, [`EXTERIOR`] or [`NONE`].
///
/// Only faces all of whose nodes are `wanted` are looked at. Both elements at a face name the same nodes, so that it is wanted
/// on both sides or on neither, and no interior face is taken for an exterior one. Both faces of a surface element are outside,
/// as far as it alone is concerned. All node indices must be below `node_count`.
pub fn across<'a>(
    elements: impl Iterator<Item = (Shape, &'a [u32])> + Clone,
    node_count: usize,
    wanted: impl Fn(u32) -> bool,
) -> Vec<u32> {
    let count = elements.clone().count();
    let mut across = vec![NONE; SIDES * count];
    matched(elements, node_count, wanted, |same| {
        for (i, &(_, face)) in same.iter().enumerate() {
            // Three elements at a face are no body; the face is inside all the same.
            across[face as usize] = if same.len() == 1 { EXTERIOR } else { same[(i + 1) % same.len()].1 };
        }
    });
    across
}

/// Numbers of the faces on the outside, ascending; see [`across`].
pub fn exterior<'a>(
    elements: impl Iterator<Item = (Shape, &'a [u32])> + Clone,
    node_count: usize,
    wanted: impl Fn(u32) -> bool,
) -> Vec<u32> {
    let mut outside = Vec::new();
    matched(elements, node_count, wanted, |same| {
        if let [(_, face)] = same {
            outside.push(*face);
        }
    });
    outside.sort_unstable();
    outside
}

/// A face to be matched: its key, with the dimension of its element so that solids match solids only, and its number.
type Keyed = (([u32; 4], u8), u32);

/// Into so many parts lists of faces are divided, so that not all are held at once, unless they are short.
const PARTS: usize = 16;

/// The length of a short list.
const SHORT: usize = 1 << 16;

/// Hands out the faces that are the same, by ascending keys. They are put together by their lowest node: equal ones are then among a
/// handful, so that neither a hash table nor a sort of all is needed.
fn matched<'a>(
    elements: impl Iterator<Item = (Shape, &'a [u32])> + Clone,
    node_count: usize,
    wanted: impl Fn(u32) -> bool,
    mut take: impl FnMut(&[Keyed]),
) {
    // Faces whose lowest node is one of these.
    let keys = |of: Range<usize>| {
        let (wanted, among, lowest) = (&wanted, of.clone(), of);
        let near = elements
            .clone()
            .zip(0u32..)
            .filter(move |((_, nodes), _)| nodes.iter().any(|&node| among.contains(&(node as usize))));
        let all = near.flat_map(|((shape, nodes), element)| {
            faces(shape, nodes).map(move |(side, nodes)| (shape, nodes, element * SIDES as u32 + u32::from(side)))
        });
        let keyed =
            all.filter(|(_, nodes, _)| nodes.iter().all(|&node| wanted(node))).filter_map(|(shape, nodes, number)| {
                // The two faces of a surface element have the same nodes, and are not across from each other.
                let kind = if shape.is_solid() { 0 } else { 1 + number as usize % SIDES };
                Some(((key_of(shape, nodes)?, kind as u8), number))
            });
        keyed.filter(move |((nodes, _), _)| lowest.contains(&(nodes[0] as usize)))
    };
    let mut counts = vec![0u32; node_count];
    keys(0..node_count).for_each(|((nodes, _), _)| counts[nodes[0] as usize] += 1);
    let total: usize = counts.iter().map(|&count| count as usize).sum();
    let most = (total / PARTS).max(SHORT);
    let mut list: Vec<Keyed> = Vec::new();
    let mut begin = 0;
    while begin < node_count {
        let (mut end, mut length) = (begin, 0);
        // Where the faces of a node go next, and when all are there, where they end.
        let mut next = Vec::new();
        while end < node_count && (end == begin || length + counts[end] as usize <= most) {
            next.push(length);
            length += counts[end] as usize;
            end += 1;
        }
        list.clear();
        // No more than it takes: a list that grows as it is would have twice the room.
        list.reserve_exact(length);
        list.resize(length, Keyed::default());
        for face in keys(begin..end) {
            let place = &mut next[face.0.0[0] as usize - begin];
            list[*place] = face;
            *place += 1;
        }
        let starts = std::iter::once(0).chain(next.iter().copied());
        starts.zip(&next).for_each(|(start, &end)| list[start..end].sort_unstable());
        list.chunk_by(|a, b| a.0 == b.0).for_each(&mut take);
        begin = end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of `n` unit hexahedra along x: nodes of plane i are 4 i to 4 i + 3.
    fn row(n: u32) -> Vec<(Shape, Vec<u32>)> {
        (0..n).map(|i| (Shape::Hexahedron, (4 * i..4 * i + 8).collect())).collect()
    }

    fn outside(elements: &[(Shape, Vec<u32>)]) -> Vec<u32> {
        exterior(elements.iter().map(|(shape, nodes)| (*shape, &nodes[..])), 64, |_| true)
    }

    #[test]
    fn a_row_of_elements_shows_four_faces_each_and_its_two_ends() {
        let faces = outside(&row(5));
        assert_eq!(faces.len(), 5 * 4 + 2);
        assert_eq!(faces.iter().filter(|&&face| face / 6 == 0).count(), 5);
        assert_eq!(faces.iter().filter(|&&face| face / 6 == 2).count(), 4);
        let elements = row(5);
        let across = across(elements.iter().map(|(shape, nodes)| (*shape, &nodes[..])), 64, |_| true);
        let inside = (0..).zip(&across).filter(|(_, across)| **across < NONE);
        assert!(inside.clone().count() == 8 && inside.into_iter().all(|(face, &other)| across[other as usize] == face));
    }

    #[test]
    fn a_wedge_shows_two_triangles_and_three_quadrilaterals() {
        // Nodes 2 and 3, and 6 and 7, have become one: side 2-3-7-6 has collapsed to the line 2-6.
        let wedge = vec![0, 1, 2, 2, 4, 5, 6, 6];
        let faces = outside(&[(Shape::Hexahedron, wedge.clone())]);
        let keys = faces.iter().map(|&face| Shape::Hexahedron.face(&wedge, face as u8).and_then(key).expect("a face"));
        assert_eq!((faces.len(), keys.filter(|key| key[3] == u32::MAX).count()), (5, 2));
    }

    #[test]
    fn triangles_match_whichever_corner_they_repeat() {
        assert_eq!(key([5, 9, 9, 2]), key([2, 2, 5, 9]));
        assert_eq!(key([5, 9, 9, 2]), Some([2, 5, 9, u32::MAX]));
        assert!(key([3, 3, 8, 8]).is_none() && key([4, 4, 4, 4]).is_none() && key([1, 2, 3, 3]).is_some());
    }

    #[test]
    fn edges_of_plane_elements_are_inside_between_two_and_a_triangle_has_three() {
        // Two squares side by side, and a triangle on the top of the first.
        let strip =
            [(Shape::Plane, vec![0, 1, 4, 3]), (Shape::Plane, vec![1, 2, 5, 4]), (Shape::Plane, vec![3, 4, 6, 6])];
        assert_eq!(outside(&strip), [0, 3, 6, 7, 8, 13, 15]);
    }

    #[test]
    fn both_faces_of_a_surface_are_outside_and_bars_have_none() {
        let strip = [(Shape::Quadrilateral, vec![0, 1, 2, 3]), (Shape::Bar, vec![2, 3])];
        assert_eq!(outside(&strip), [0, 1]);
        let glued = [(Shape::Quadrilateral, vec![4, 5, 6, 7]), (Shape::Hexahedron, (0..8).collect())];
        assert_eq!(outside(&glued).len(), 2 + 6);
    }
}
