//! EXODUS I and GENESIS of old: a mesh as a sequence of FORTRAN records (SAND87-2997).
//!
//! Integers and reals of 4 or 8 bytes, either byte order and either size of the marks between records are found out
//! from the file. Results behind the mesh are not looked at. Sides of elements are given by their nodes; their numbers
//! are found by comparison.

mod records;

use std::collections::BTreeSet;
use std::path::Path;

use records::{Broken, Records};

use crate::exodus::file::error::MeshError;
use crate::exodus::mesh::tables::{BlockTable, NodeSetTable, SideSetTable, Tables};
use crate::mesh::Kind;
use crate::mesh::check::{Problem, Problems, counted};

/// What record 2 counts.
struct Counts {
    nodes: usize,
    dimensions: usize,
    elements: usize,
    blocks: usize,
    node_sets: usize,
    node_set_nodes: usize,
    side_sets: usize,
    side_set_elements: usize,
    side_set_nodes: usize,
}

/// Advice that fits every broken file.
const WRITE_AGAIN: &str = "copy or write it again; a program or a copy left it incomplete";

/// The arrays of a mesh file of FORTRAN records.
pub(in crate::exodus) fn read(path: &Path) -> Result<Tables, MeshError> {
    let bytes = std::fs::read(path).map_err(|e| MeshError::single(path, format!("cannot be read: {e}"), ""))?;
    let mut problems = Problems::default();
    let broken = |Broken(what): Broken| MeshError::single(path, format!("EXODUS I: {what}"), WRITE_AGAIN);
    let tables = tables(&bytes, &mut problems).map_err(broken)?;
    if problems.is_empty() { Ok(tables) } else { Err(MeshError { path: path.to_owned(), problems }) }
}

fn tables(bytes: &[u8], problems: &mut Problems) -> Result<Tables, Broken> {
    let mut file = Records::new(bytes)?;
    let title = file.text(80, "the title")?;
    let counts = counts(&mut file)?;
    let mut coordinates = file.reals(counts.dimensions.saturating_mul(counts.nodes), "the coordinates")?;
    let mut axis = || {
        let rest = coordinates.split_off(counts.nodes.min(coordinates.len()));
        std::mem::replace(&mut coordinates, rest)
    };
    let coordinates = [axis(), axis(), axis()];
    if !matches!(counts.dimensions, 2 | 3) {
        // Refused for that; what is in it would only be misunderstood.
        return Ok(Tables { title, dimensions: counts.dimensions, ..Tables::default() });
    }
    // The order in which a program wishes to work through the elements.
    file.skip("the element order map")?;
    let mut blocks =
        (0..counts.blocks).map(|n| block(&mut file, n, counts.dimensions)).collect::<Result<Vec<_>, _>>()?;
    let node_sets = node_sets(&mut file, &counts, problems)?;
    let side_sets = side_sets(&mut file, &counts, &blocks, problems)?;
    let qa = closing(&mut file, &mut blocks, counts.dimensions)?;
    Ok(Tables {
        title,
        dimensions: counts.dimensions,
        coordinates,
        node_count: Some(counts.nodes),
        element_count: Some(counts.elements),
        blocks,
        node_sets,
        side_sets,
        qa,
        ..Tables::default()
    })
}

fn counts(file: &mut Records) -> Result<Counts, Broken> {
    let values = file.all_integers(&[9, 10], "the sizes of the mesh")?;
    let mut counts = [0; 9];
    for (count, &value) in counts.iter_mut().zip(&values) {
        *count = usize::try_from(value).map_err(|_| Broken(format!("a count of the mesh is {value}, below zero")))?;
    }
    let [nodes, dimensions, elements, blocks, node_sets, node_set_nodes, side_sets, side_set_elements, side_set_nodes] =
        counts;
    if dimensions > 3 {
        return Err(Broken(format!("the mesh is said to have {dimensions} dimensions")));
    }
    Ok(Counts {
        nodes,
        dimensions,
        elements,
        blocks,
        node_sets,
        node_set_nodes,
        side_sets,
        side_set_elements,
        side_set_nodes,
    })
}

fn block(file: &mut Records, n: usize, dimensions: usize) -> Result<BlockTable, Broken> {
    let name = |what: &str| format!("{what} of block {}", n + 1);
    let head = file.integers(4, &name("the head"))?;
    let (id, nodes_per_element) = (head[0], usize::try_from(head[2]).unwrap_or(0));
    let size = usize::try_from(head[1]).unwrap_or(usize::MAX).saturating_mul(nodes_per_element);
    let connectivity = file.integers(size, &name("the connectivity"))?;
    // Attributes: the thickness of shells and the like.
    file.skip(&name("the attributes"))?;
    let attributes = head[3] > 0;
    let element_type = inferred_type(dimensions, nodes_per_element, attributes).to_string();
    Ok(BlockTable { id, element_type, nodes_per_element, connectivity, ..BlockTable::default() })
}

/// The kind of an element that a file does not name.
fn inferred_type(dimensions: usize, nodes: usize, attributes: bool) -> &'static str {
    match (nodes, attributes) {
        (4, _) if dimensions == 2 => "QUAD",
        (3, _) if dimensions == 2 => "TRIANGLE",
        (8, _) if dimensions == 2 => "QUAD8",
        (8, false) => "HEX",
        (8, true) => "SHELL8",
        (4, false) => "TETRA",
        (4, true) | (3, _) => "SHELL",
        (6, _) => "WEDGE",
        (5, _) => "PYRAMID",
        (2, _) => "BEAM",
        (1, _) => "SPHERE",
        _ => "",
    }
}

/// The lengths of the parts of an array; what they must add up to is known.
fn lengths(counts: &[i64], total: usize, what: &str, problems: &mut Problems) -> Vec<usize> {
    let lengths: Vec<usize> = counts.iter().map(|&count| usize::try_from(count).unwrap_or(usize::MAX)).collect();
    let sum = lengths.iter().fold(0usize, |sum, &length| sum.saturating_add(length));
    if sum == total {
        return lengths;
    }
    let said = if sum == usize::MAX { "a count below zero".to_string() } else { format!("{sum} members") };
    problems.add(|| Problem::new(format!("the {what} have {said} by their counts, but {total} in all"), WRITE_AGAIN));
    Vec::new()
}

fn node_sets(file: &mut Records, counts: &Counts, problems: &mut Problems) -> Result<Vec<NodeSetTable>, Broken> {
    let ids = file.integers(counts.node_sets, "the numbers of node sets")?;
    let sizes = file.integers(counts.node_sets, "the sizes of node sets")?;
    file.skip("the places of node sets")?;
    let nodes = file.integers(counts.node_set_nodes, "the nodes of node sets")?;
    file.skip("the factors of node sets")?;
    let lengths = lengths(&sizes, nodes.len(), "node sets", problems);
    let mut nodes = nodes.into_iter();
    let table = |(id, length)| NodeSetTable { id, nodes: nodes.by_ref().take(length).collect(), ..Default::default() };
    Ok(ids.into_iter().zip(lengths).map(table).collect())
}

fn side_sets(
    file: &mut Records,
    counts: &Counts,
    blocks: &[BlockTable],
    problems: &mut Problems,
) -> Result<Vec<SideSetTable>, Broken> {
    let ids = file.integers(counts.side_sets, "the numbers of side sets")?;
    let sizes = file.integers(counts.side_sets, "the sizes of side sets")?;
    // Some programs write wrong numbers of nodes here; how many a side has follows from the list itself.
    file.skip("the numbers of nodes of side sets")?;
    file.skip("the places of side sets")?;
    file.skip("the places of nodes of side sets")?;
    let elements = file.integers(counts.side_set_elements, "the elements of side sets")?;
    let nodes = file.integers(counts.side_set_nodes, "the nodes of side sets")?;
    file.skip("the factors of side sets")?;
    let (per_side, side_of, advice) = match counts.dimensions {
        2 => (2, "an edge in the plane has two", WRITE_AGAIN),
        _ => (4, "a face of a hexahedron has four", "make side sets of faces, not of edges"),
    };
    if nodes.len() != per_side * elements.len() {
        problems.add(|| {
            let [nodes, sides] = [counted(nodes.len(), "node"), counted(elements.len(), "side")];
            Problem::new(format!("the side sets have {nodes} for {sides}; {side_of}"), advice)
        });
        return Ok(Vec::new());
    }
    let lengths = lengths(&sizes, elements.len(), "side sets", problems);
    let mut faces = elements.into_iter().zip(nodes.chunks_exact(per_side));
    let mut tables = Vec::new();
    for (id, length) in ids.into_iter().zip(lengths) {
        let mut table = SideSetTable { id, ..SideSetTable::default() };
        for (element, nodes) in faces.by_ref().take(length) {
            table.elements.push(element);
            table.sides.push(side((blocks, counts.dimensions), id, element, nodes, problems));
        }
        tables.push(table);
    }
    Ok(tables)
}

/// The one-based side of an element that has these nodes, in any order.
fn side(
    (blocks, dimensions): (&[BlockTable], usize),
    set: i64,
    element: i64,
    nodes: &[i64],
    problems: &mut Problems,
) -> i64 {
    // An element that does not exist, or of a kind that is refused, is reported where that is looked at.
    let Some((kind, own)) = element_nodes(blocks, dimensions, element) else { return 1 };
    let wanted: BTreeSet<i64> = nodes.iter().copied().collect();
    let places: Vec<u32> = (0..own.len() as u32).collect();
    let corners: Vec<i64> = kind.expand(&places).map(|node| own[node as usize]).collect();
    let sides = kind.shape().sides();
    let is = |&side: &u8| sides[side as usize].iter().map(|&corner| corners[corner]).collect::<BTreeSet<_>>() == wanted;
    if let Some(side) = kind.sides().iter().position(is) {
        return side as i64 + 1;
    }
    problems.add(|| {
        let side = if dimensions == 2 { "edge" } else { "face" };
        let nodes: Vec<String> = nodes.iter().map(i64::to_string).collect();
        let what = format!("side set {set}: the nodes {} are no {side} of element {element}", nodes.join(", "));
        Problem::new(what, "write the mesh again")
    });
    1
}

/// What an element is and its nodes, by its one-based place in the file.
fn element_nodes(blocks: &[BlockTable], dimensions: usize, element: i64) -> Option<(Kind, &[i64])> {
    let mut place = usize::try_from(element).ok()?.checked_sub(1)?;
    for block in blocks {
        let size = block.connectivity.len() / block.nodes_per_element.max(1);
        if place < size {
            return Some((
                block.kind(dimensions)?,
                block.connectivity.chunks_exact(block.nodes_per_element).nth(place)?,
            ));
        }
        place -= size;
    }
    None
}

/// What may stand behind the mesh: QA records, information, names of axes and of element types. A file may end before
/// any of them.
fn closing(file: &mut Records, blocks: &mut [BlockTable], dimensions: usize) -> Result<Vec<[String; 4]>, Broken> {
    let mut qa = Vec::new();
    if file.is_at_end() {
        return Ok(qa);
    }
    for _ in 0..file.count("the number of QA records")? {
        let texts = file.texts(4, "a QA record")?;
        qa.push(std::array::from_fn(|i| texts[i].clone()));
    }
    if file.is_at_end() {
        return Ok(qa);
    }
    for _ in 0..file.count("the number of information records")? {
        file.skip("an information record")?;
    }
    if file.is_at_end() {
        return Ok(qa);
    }
    file.texts(dimensions, "the names of axes")?;
    if !file.is_at_end() {
        let names = file.texts(blocks.len(), "the names of element types")?;
        for (block, name) in blocks.iter_mut().zip(names).filter(|(_, name)| !name.is_empty()) {
            block.element_type = name;
        }
    }
    Ok(qa)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Dimension, Shape};

    /// A FORTRAN record of words of four bytes, little endian.
    fn record(bytes: Vec<u8>) -> Vec<u8> {
        let mark = (bytes.len() as u32).to_le_bytes();
        [&mark[..], &bytes, &mark].concat()
    }

    fn integers(values: &[i32]) -> Vec<u8> {
        record(values.iter().flat_map(|value| value.to_le_bytes()).collect())
    }

    fn reals(values: &[f32]) -> Vec<u8> {
        record(values.iter().flat_map(|value| value.to_le_bytes()).collect())
    }

    /// A square and a triangle beside it, as FASTQ writes them: two coordinates, side sets of edges given by their nodes.
    #[test]
    fn a_two_dimensional_mesh_is_read() {
        let file = [
            record(format!("{:<80}", "TWO ELEMENTS").into_bytes()),
            integers(&[5, 2, 2, 2, 1, 2, 1, 3, 6, 1]),
            reals(&[0.0, 1.0, 1.0, 0.0, 2.0, 0.0, 0.0, 1.0, 1.0, 0.5]),
            integers(&[1, 2]),
            integers(&[10, 1, 4, 0]),
            integers(&[1, 2, 3, 4]),
            reals(&[0.0]),
            integers(&[20, 1, 3, 0]),
            integers(&[2, 5, 3]),
            reals(&[0.0]),
            integers(&[7]),
            integers(&[2]),
            integers(&[1]),
            integers(&[1, 4]),
            reals(&[1.0, 1.0]),
            integers(&[99]),
            integers(&[3]),
            integers(&[6]),
            integers(&[1]),
            integers(&[1]),
            integers(&[1, 2, 2]),
            integers(&[1, 2, 2, 5, 5, 3]),
            reals(&[1.0; 6]),
        ]
        .concat();
        let mut problems = Problems::default();
        let mesh = tables(&file, &mut problems).ok().and_then(|tables| tables.assemble().ok()).expect("a mesh");
        assert!(problems.is_empty());
        assert_eq!((mesh.dimension, mesh.coordinates[4]), (Dimension::Two, [2.0, 0.5, 0.0]));
        assert_eq!((mesh.blocks[0].shape, &mesh.blocks[1].nodes[..]), (Shape::Plane, &[1, 4, 2, 2][..]));
        assert_eq!(mesh.node_sets[0].nodes, [0, 3]);
        // The third side of a triangle is the fourth of a quadrilateral.
        assert_eq!(mesh.side_sets[0].sides, [(0, 0), (1, 0), (1, 1)]);
    }
}
