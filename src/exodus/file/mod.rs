//! netCDF files as they stand: containers, arrays, names, checksums, and what a damaged file does.

pub(in crate::exodus) mod arrays;
pub(in crate::exodus) mod checksum;
pub mod container;
pub(in crate::exodus) mod error;
pub(in crate::exodus) mod names;
pub(in crate::exodus) mod probe;
pub(in crate::exodus) mod slabs;
