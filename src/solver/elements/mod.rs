//! Elements: from positions and velocities to corner forces, block by block in chunks of eight.

mod block;
pub mod fields;
pub mod geometry;
pub mod hex8;
pub mod hourglass;
pub mod kinematics;
mod pass;

use crate::lanes::Sym3;
use nalgebra::{Matrix3, SymmetricEigen};

pub use block::{ElementBlock, Group, NewElement};
pub use pass::{PassOutcome, PassSettings, Sink, run};

/// ln U of a stretch, by its eigenvectors: logarithmic strain.
pub fn logarithm(u: Sym3<f64>) -> Sym3<f64> {
    let m = u.matrix();
    let eigen = SymmetricEigen::new(Matrix3::from_fn(|i, j| m[i][j]));
    let logarithms = eigen.eigenvalues.map(libm::log);
    let l = eigen.eigenvectors * Matrix3::from_diagonal(&logarithms) * eigen.eigenvectors.transpose();
    Sym3 { xx: l[(0, 0)], yy: l[(1, 1)], zz: l[(2, 2)], xy: l[(0, 1)], yz: l[(1, 2)], zx: l[(2, 0)] }
}

#[cfg(test)]
mod tests;
