//! EXODUS II files, and meshes of EXODUS I: meshes read and written, results appended, read, compared and joined from
//! pieces. Bytes become arrays here; nothing here knows mechanics.
//!
//! A mesh is read in two steps: the file's arrays as they stand ([`tables`]), then, after every check, a
//! [`Mesh`](crate::mesh::Mesh). The netCDF library serialises all calls in a process, so one rank should read and
//! write for all.

mod arrays;
mod checksum;
mod compare;
pub mod container;
mod error;
mod genesis;
mod names;
pub mod pieces;
mod probe;
mod read;
mod restart;
mod results;
mod results_writer;
mod slabs;
pub mod tables;
mod write;

pub use compare::{Comparison, Difference, Place, Tolerance, compare};
pub use error::{MeshError, ResultsError};
pub use probe::{probe_with, try_out};
pub use read::{read_mesh, read_mesh_together};
pub use restart::{Restart, RestartHeader, read_restart, restart_number, write_restart};
pub use results::Results;
pub use results_writer::{ResultsHeader, ResultsWriter, StateWriter};
pub use slabs::Together;
pub use write::{names_in_writing, write_mesh};
