//! What single precision asks of the hexahedron: sums that keep their lost digits, and the range that its products fit.

pub(super) mod carried;
pub mod range;
