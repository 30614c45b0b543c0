//! What a piece says of itself: its part of the mesh, and its places in the whole.

use super::Sizes;
use crate::exodus::file::arrays::Arrays;
use crate::exodus::file::error::ResultsError;
use crate::exodus::file::names::{self, WholeFamily};
use crate::exodus::mesh::read;
use crate::exodus::results::Results;
use crate::mesh::{Mesh, Part, Places};
use std::collections::BTreeMap;
use std::path::Path;

/// A piece as it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Told {
    /// The part of the mesh, and where it is in the whole.
    pub part: Part,
    /// How large the whole is.
    pub whole: Sizes,
    /// Number of pieces.
    pub ranks: usize,
}

/// Reads a piece's mesh and places; lengths and ranges are checked.
///
/// # Errors
/// When the file is no piece, or its arrays do not fit together.
pub fn told(results: &Results) -> Result<Told, ResultsError> {
    let (path, arrays) = (results.path(), results.arrays());
    let Some(ranks) = arrays.dimension(names::NUM_PROCESSORS) else {
        return Err(unusable(path, "this is no piece of split results, but a file of its own"));
    };
    let mut mesh = read::assemble_part(path, arrays)?;
    let reader = Reader { path, arrays };
    mesh.node_factors = reader.node_factors(&mesh)?;
    let whole = Sizes {
        nodes: arrays.dimension(names::NUM_NODES_GLOBAL).unwrap_or(0),
        blocks: reader.sizes(&names::WHOLE_BLOCKS)?,
        node_sets: reader.sizes(&names::WHOLE_NODE_SETS)?,
        side_sets: reader.sizes(&names::WHOLE_SIDE_SETS)?,
    };
    let families = [mesh.blocks.len(), mesh.node_sets.len(), mesh.side_sets.len()];
    if families != [whole.blocks.len(), whole.node_sets.len(), whole.side_sets.len()] {
        return Err(unusable(path, "it does not list all blocks and sets of the whole; the piece is damaged"));
    }
    let set = |list: Vec<usize>, sizes: &[usize], name: fn(usize) -> String| -> Result<Vec<Vec<u32>>, ResultsError> {
        list.into_iter().enumerate().map(|(n, count)| reader.places(&name(n), count, sizes[n])).collect()
    };
    let here = Sizes::of(&mesh);
    let places = Places {
        nodes: reader.places(names::NODE_PLACES, here.nodes, whole.nodes)?,
        elements: reader.places(names::ELEMENT_PLACES, here.elements(), whole.elements())?,
        node_sets: set(here.node_sets, &whole.node_sets, names::node_set_places)?,
        side_sets: set(here.side_sets, &whole.side_sets, names::side_set_places)?,
    };
    Ok(Told { part: Part { mesh, places }, whole, ranks })
}

struct Reader<'a> {
    path: &'a Path,
    arrays: &'a Arrays,
}

impl Reader<'_> {
    fn integers(&self, name: &str) -> Result<Option<Vec<i64>>, ResultsError> {
        self.arrays.integers(name).map_err(|what| unusable(self.path, what))
    }

    /// Distribution factors of node sets as they are, also where those of this piece alone would say nothing.
    fn node_factors(&self, mesh: &Mesh) -> Result<BTreeMap<i64, Vec<f64>>, ResultsError> {
        let mut all = BTreeMap::new();
        for (n, set) in mesh.node_sets.iter().enumerate().filter(|(_, set)| !set.nodes.is_empty()) {
            let name = names::node_set_factors(n);
            let given = self.arrays.reals(&name).map_err(|what| unusable(self.path, what))?;
            let Some(factors) = given else { continue };
            if factors.len() != set.nodes.len() {
                let what = format!("{name} does not fit the rest of the file; the piece is damaged");
                return Err(unusable(self.path, what));
            }
            all.insert(set.id, factors);
        }
        Ok(all)
    }

    /// Sizes of all members of a family in the whole.
    fn sizes(&self, family: &WholeFamily) -> Result<Vec<usize>, ResultsError> {
        let sizes = self.integers(family.sizes)?.unwrap_or_default();
        let sizes = sizes.into_iter().map(|size| u32::try_from(size).map(|size| size as usize));
        let wrong = |_| unusable(self.path, format!("{} holds impossible sizes; the piece is damaged", family.sizes));
        sizes.collect::<Result<_, _>>().map_err(wrong)
    }

    /// The zero-based places of `count` things among `whole`.
    fn places(&self, name: &str, count: usize, whole: usize) -> Result<Vec<u32>, ResultsError> {
        if count == 0 {
            return Ok(Vec::new());
        }
        let Some(given) = self.integers(name)? else {
            let what = format!("{name} is missing: the piece is not of urto, which tells there the order of the whole");
            return Err(unusable(self.path, what));
        };
        let place = |place: i64| u32::try_from(place - 1).ok().filter(|&place| (place as usize) < whole);
        let places: Option<Vec<u32>> = given.iter().map(|&given| place(given)).collect();
        places.filter(|places| places.len() == count).ok_or_else(|| {
            unusable(self.path, format!("{name} does not fit the rest of the file; the piece is damaged"))
        })
    }
}

fn unusable(path: &Path, what: impl Into<String>) -> ResultsError {
    ResultsError::Unusable { path: path.to_owned(), what: what.into() }
}
