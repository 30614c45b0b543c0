//! Results in pieces: one file a rank, in the form of Nemesis, and how they become one file again.
//!
//! A piece `run.e.8.3` is an EXODUS file of what rank 3 of 8 computes, with all blocks and sets of the whole, the empty
//! ones as null. Nodes at its border stand in several pieces, elements in one. The analyst's numbers are its maps, and
//! Nemesis' arrays say what is whole and what is shared. Numbers do not tell the order of the whole file, so a piece
//! also says where in it everything belongs; other programs pass over these arrays.

mod gather;
mod join;
mod read;
mod write;

pub use join::{JoinError, Joined, all_pieces_of, any_pieces_of, join, pieces_of};

use crate::mesh::{Mesh, Part};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// What a piece holds beside an ordinary file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Piece {
    /// Whose piece it is.
    pub rank: usize,
    /// Of how many.
    pub ranks: usize,
    /// The part of the mesh, and where it is in the whole.
    pub part: Part,
    /// How large the whole is.
    pub whole: Sizes,
    /// Nodes of this piece that others have too, ascending.
    pub border_nodes: Vec<u32>,
    /// Elements of this piece that touch such nodes, ascending.
    pub border_elements: Vec<u32>,
    /// The ranks that share nodes with this one, ascending, each with the shared nodes in the order of the whole.
    pub neighbours: Vec<(usize, Vec<u32>)>,
    /// The ranks with elements across faces of this one's, ascending, each with these faces as element and zero-based
    /// side. Two ranks list the faces between them in the same order.
    pub across: Vec<(usize, Vec<(u32, u8)>)>,
}

/// Sizes of a mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sizes {
    /// Number of nodes.
    pub nodes: usize,
    /// Elements of each block.
    pub blocks: Vec<usize>,
    /// Nodes of each node set.
    pub node_sets: Vec<usize>,
    /// Faces of each side set.
    pub side_sets: Vec<usize>,
}

impl Sizes {
    /// Those of a mesh.
    pub fn of(mesh: &Mesh) -> Sizes {
        Sizes {
            nodes: mesh.coordinates.len(),
            blocks: mesh.blocks.iter().map(|block| block.len()).collect(),
            node_sets: mesh.node_sets.iter().map(|set| set.nodes.len()).collect(),
            side_sets: mesh.side_sets.iter().map(|set| set.sides.len()).collect(),
        }
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        self.blocks.iter().sum()
    }
}

/// The name of a rank's piece: `run.e.16.03`, with as many digits as the number of ranks has.
pub fn piece_path(whole: &Path, ranks: usize, rank: usize) -> PathBuf {
    let width = ranks.to_string().len();
    let mut name = OsString::from(whole);
    name.push(format!(".{ranks}.{rank:0width$}"));
    PathBuf::from(name)
}

/// The whole, the number of ranks and the rank that a piece's name tells, if it is the name of a piece.
pub(super) fn parts_of_name(path: &Path) -> Option<(PathBuf, usize, usize)> {
    let name = path.file_name()?.to_str()?;
    let (rest, rank) = name.rsplit_once('.')?;
    let (base, ranks) = rest.rsplit_once('.')?;
    let number = |text: &str| text.bytes().all(|b| b.is_ascii_digit()).then(|| text.parse::<usize>().ok()).flatten();
    let (count, place) = (number(ranks)?, number(rank)?);
    let fits = place < count && rank.len() == ranks.len() && !ranks.starts_with('0') && !base.is_empty();
    fits.then(|| (path.with_file_name(base), count, place))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_whole_and_rank() {
        let path = piece_path(Path::new("out/run.e"), 16, 3);
        assert_eq!(path, Path::new("out/run.e.16.03"));
        assert_eq!(parts_of_name(&path), Some((PathBuf::from("out/run.e"), 16, 3)));
        for other in ["run.e", "run.e.4", "run.e.4.4", "run.e.4.x", "run.e.16.3", "run.e.04.01", ".4.1"] {
            assert_eq!(parts_of_name(Path::new(other)), None, "{other}");
        }
    }
}
