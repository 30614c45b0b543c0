//! What files of two-dimensional runs leave out: components that are zero because there is no third direction.

use crate::mesh::Dimension;

/// Variables that only space has, without the number of what they belong to.
const OF_SPACE: [&str; 21] = [
    "DISPLZ", "FZ", "VELZ", "ACCLZ", "RZ", "CONTZ", "ZMOM", "ROTX", "ROTY", "TAUYZ", "TAUZX", "EPSYZ", "EPSZX",
    "STRETYZ", "STRETZX", "R13", "R23", "R31", "R32", "R33", "POSZ",
];

/// Whether a variable is in files of this dimension. Its name may end in a number: DISPLZ_BLOCK1.
pub fn is_in(dimension: Dimension, name: &str) -> bool {
    let base = name.split('_').next().unwrap_or(name);
    dimension == Dimension::Three || !OF_SPACE.contains(&base)
}
