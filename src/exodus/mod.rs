//! EXODUS II files, and meshes of EXODUS I: meshes read and written, results appended, read, compared and joined from
//! pieces. Bytes become arrays here; nothing here knows mechanics.
//!
//! A mesh is read in two steps: the file's arrays as they stand ([`tables`]), then, after every check, a
//! [`Mesh`](crate::mesh::Mesh). The netCDF library serialises all calls in a process, so one rank should read and
//! write for all.

mod file;
mod mesh;
pub mod pieces;
mod results;

pub use file::container;
pub use file::error::{MeshError, ResultsError};
pub use file::probe::{probe_with, try_out};
pub use file::slabs::Together;
pub use mesh::read::{read_mesh, read_mesh_together};
pub use mesh::tables;
pub use mesh::write::{names_in_writing, write_mesh};
pub use results::Results;
pub use results::compare::{Comparison, Difference, Place, Tolerance, compare};
pub use results::restart::{Restart, RestartHeader, read_restart, restart_number, write_restart};
pub use results::writer::{ResultsHeader, ResultsWriter, StateWriter};
