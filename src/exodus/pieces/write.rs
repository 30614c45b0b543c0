//! The arrays that make a file a piece.

use super::Piece;
use crate::exodus::file::names::{self, WholeFamily};
use crate::exodus::mesh::write::{Writer, one_based};

/// Version of the Nemesis conventions.
const NEMESIS_VERSION: f32 = 2.6;

/// A list of one-based numbers with the name of its variable and of its dimension.
type List = (String, String, Vec<i32>);

impl Writer<'_> {
    /// Defines what Nemesis and the joining want to know, after the mesh.
    pub(in super::super) fn define_piece(&mut self, piece: &Piece) -> netcdf::Result<()> {
        for name in names::NEMESIS_VERSIONS {
            self.file.add_attribute(name, NEMESIS_VERSION)?;
        }
        self.dimensions(&[
            (names::NUM_PROCESSORS, piece.ranks),
            (names::NUM_PROCESSORS_OF_FILE, 1),
            (names::NUM_NODES_GLOBAL, piece.whole.nodes),
            (names::NUM_ELEM_GLOBAL, piece.whole.elements()),
        ])?;
        self.variable::<i32>(names::FILE_KIND, &[])?;
        for (family, ids, _) in families(piece) {
            self.dimensions(&[(family.count, ids.len())])?;
            if !ids.is_empty() {
                self.numbers(family.ids, family.count)?;
                for name in [Some(family.sizes), family.factors].into_iter().flatten() {
                    self.variable::<i32>(name, &[family.count])?;
                }
            }
        }
        for status in names::STANDINGS.iter().map(|s| s.status).chain([names::OUTER_NODES_STATUS]) {
            self.variable::<i32>(status, &[names::NUM_PROCESSORS_OF_FILE])?;
        }
        // Of these the dimensions are new.
        for (_, dimension, list) in &[standings(piece), node_map(piece), element_map(piece)].concat() {
            if self.file.dimension(dimension).is_none() {
                self.dimensions(&[(dimension, list.len())])?;
            }
        }
        for (name, dimension, list) in all_lists(piece) {
            if !list.is_empty() {
                self.variable::<i32>(&name, &[&dimension])?;
            }
        }
        Ok(())
    }

    /// Fills what [`Writer::define_piece`] defined.
    pub(in super::super) fn put_piece(&mut self, piece: &Piece) -> netcdf::Result<()> {
        self.values(names::FILE_KIND, &[0i32])?;
        for (family, ids, sizes) in families(piece) {
            self.put_numbers(family.ids, &ids)?;
            let sizes: Vec<i32> = sizes.iter().map(|&size| size as i32).collect();
            if !ids.is_empty() {
                self.values(family.sizes, &sizes)?;
                if let Some(factors) = family.factors {
                    self.values(factors, &factor_counts(piece, &family, &sizes))?;
                }
            }
        }
        for (standing, (_, _, list)) in names::STANDINGS.iter().zip(standings(piece)) {
            self.values(standing.status, &[i32::from(!list.is_empty())])?;
        }
        self.values(names::OUTER_NODES_STATUS, &[0i32])?;
        for (name, _, list) in all_lists(piece) {
            if !list.is_empty() {
                self.values(&name, &list)?;
            }
        }
        Ok(())
    }
}

/// How many distribution factors each set of the whole has: as many as nodes, or none. Those of side sets are not kept.
fn factor_counts(piece: &Piece, family: &WholeFamily, sizes: &[i32]) -> Vec<i32> {
    let mesh = &piece.part.mesh;
    let has = |n: usize| {
        let is_of_nodes = family.ids == names::WHOLE_NODE_SETS.ids;
        is_of_nodes && mesh.node_sets.get(n).is_some_and(|set| mesh.node_factors.contains_key(&set.id))
    };
    sizes.iter().enumerate().map(|(n, &size)| if has(n) { size } else { 0 }).collect()
}

/// The families of the whole, with numbers and sizes.
fn families(piece: &Piece) -> [(WholeFamily, Vec<i64>, &[usize]); 3] {
    let (mesh, whole) = (&piece.part.mesh, &piece.whole);
    [
        (names::WHOLE_BLOCKS, mesh.blocks.iter().map(|b| b.id).collect(), &whole.blocks),
        (names::WHOLE_NODE_SETS, mesh.node_sets.iter().map(|s| s.id).collect(), &whole.node_sets),
        (names::WHOLE_SIDE_SETS, mesh.side_sets.iter().map(|s| s.id).collect(), &whole.side_sets),
    ]
}

fn all_lists(piece: &Piece) -> Vec<List> {
    let mut lists = standings(piece);
    lists.extend(node_map(piece));
    lists.extend(element_map(piece));
    lists.extend(places(piece));
    lists
}

/// Nodes and elements inside and at the border.
fn standings(piece: &Piece) -> Vec<List> {
    let inside = |count: usize, border: &[u32]| -> Vec<u32> {
        (0..count as u32).filter(|n| border.binary_search(n).is_err()).collect()
    };
    let mesh = &piece.part.mesh;
    let lists = [
        inside(mesh.coordinates.len(), &piece.border_nodes),
        piece.border_nodes.clone(),
        inside(mesh.element_count(), &piece.border_elements),
        piece.border_elements.clone(),
    ];
    let named = names::STANDINGS.iter().zip(lists);
    named.map(|(standing, list)| (standing.list.into(), standing.count.into(), one_based(&list))).collect()
}

/// Who shares which nodes.
fn node_map(piece: &Piece) -> Vec<List> {
    let nodes = entries(&piece.neighbours, |&node| node as i32 + 1);
    let [ids, statuses, ends, ranks] = lists_of_ranks(&piece.neighbours);
    let dimensions = [names::NUM_NODE_MAPS, names::NUM_NODE_MAP_ENTRIES];
    map(&names::NODE_MAP, dimensions, vec![ids, statuses, ends, nodes, ranks])
}

/// Who has elements across which sides.
fn element_map(piece: &Piece) -> Vec<List> {
    let elements = entries(&piece.across, |&(element, _)| element as i32 + 1);
    let sides = entries(&piece.across, |&(_, side)| i32::from(side) + 1);
    let [ids, statuses, ends, ranks] = lists_of_ranks(&piece.across);
    let dimensions = [names::NUM_ELEMENT_MAPS, names::NUM_ELEMENT_MAP_ENTRIES];
    map(&names::ELEMENT_MAP, dimensions, vec![ids, statuses, ends, elements, ranks, sides])
}

/// The lists of a communication map by their names: the first three have a value a rank, the others a value an entry.
fn map(names: &[&str], [of_ranks, of_entries]: [&str; 2], lists: Vec<Vec<i32>>) -> Vec<List> {
    let dimensions = [of_ranks; 3].into_iter().chain(std::iter::repeat(of_entries));
    names.iter().zip(dimensions).zip(lists).map(|((&name, size), list)| (name.into(), size.into(), list)).collect()
}

/// For each rank its number, status and the end of its entries, and for each entry its rank.
fn lists_of_ranks<T>(map: &[(usize, Vec<T>)]) -> [Vec<i32>; 4] {
    let mut end = 0;
    let ends = map.iter().map(|(_, entries)| {
        end += entries.len() as i32;
        end
    });
    let ranks = map.iter().flat_map(|(rank, entries)| entries.iter().map(|_| *rank as i32));
    [map.iter().map(|(rank, _)| *rank as i32).collect(), vec![1; map.len()], ends.collect(), ranks.collect()]
}

/// What a map says of its entries, rank by rank.
fn entries<T>(map: &[(usize, Vec<T>)], value: impl Fn(&T) -> i32) -> Vec<i32> {
    map.iter().flat_map(|(_, entries)| entries).map(value).collect()
}

/// Where everything is in the whole.
fn places(piece: &Piece) -> Vec<List> {
    let places = &piece.part.places;
    let list = |name: &str, dimension: String, places: &[u32]| (name.to_string(), dimension, one_based(places));
    let mut lists = vec![
        list(names::NODE_PLACES, names::NUM_NODES.into(), &places.nodes),
        list(names::ELEMENT_PLACES, names::NUM_ELEM.into(), &places.elements),
    ];
    let node_sets = places.node_sets.iter().enumerate();
    lists.extend(node_sets.map(|(n, set)| list(&names::node_set_places(n), names::node_set_size(n), set)));
    let side_sets = places.side_sets.iter().enumerate();
    lists.extend(side_sets.map(|(n, set)| list(&names::side_set_places(n), names::side_set_size(n), set)));
    lists
}
