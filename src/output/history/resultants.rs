//! Contact: resultants of the forces of rigid surfaces on a side set and of one block on another, and their works.

use crate::model::Watched;

/// How the names of those begin that are means over intervals.
pub const MEANS: [&str; 6] = ["FX_WALL", "FY_WALL", "FZ_WALL", "FX_CONTACT", "FY_CONTACT", "FZ_CONTACT"];

/// Names of the variables of what a command watches; none where it watches no contact.
pub fn names(watched: &Watched) -> Vec<String> {
    const OF_WALL: [&str; 5] = ["FX", "FY", "FZ", "WORK", "FRICE"];
    const OF_CONTACT: [&str; 6] = ["FX", "FY", "FZ", "WORK1", "WORK2", "FRICE"];
    match *watched {
        Watched::RigidSurface(id) => OF_WALL.map(|name| format!("{name}_WALL{id}")).to_vec(),
        Watched::Contact(first, Some(second)) => {
            OF_CONTACT.map(|name| format!("{name}_CONTACT{first}_{second}")).to_vec()
        }
        Watched::Contact(block, None) => OF_CONTACT.map(|name| format!("{name}_CONTACT{block}")).to_vec(),
        Watched::Blocks | Watched::Block(_) | Watched::NodeSet(_) | Watched::Node(_) => Vec::new(),
    }
}

/// Those of the solver's values that have a name: a rigid surface does not move, and no work is done on it.
pub fn values(watched: &Watched, [x, y, z, first, second, friction]: [f64; 6]) -> Vec<f64> {
    match watched {
        Watched::RigidSurface(_) => vec![x, y, z, first, friction],
        _ => vec![x, y, z, first, second, friction],
    }
}
