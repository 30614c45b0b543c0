//! Studies: one deck with all combinations of some values, and what came out of each in one table.
//!
//! [`Axis`]es of values become [`Member`]s; each is run by itself, and leaves a [`record`] of how it went; `results` are
//! read from what it wrote, and end in a `table` and in pictures.

mod axis;
mod picture;
pub mod record;
mod results;
mod table;

pub use axis::{Axis, AxisError, Member, members};
pub use picture::pictures;
pub use results::{Found, Wanted, found};
pub use table::{csv, text};

use record::Record;

/// A member with what came of it.
#[derive(Debug, Clone)]
pub struct Row {
    /// The values.
    pub member: Member,
    /// How it went; `None` where it has not come to run.
    pub record: Option<Record>,
    /// What it reached, or why that cannot be read.
    pub found: Result<Vec<Found>, String>,
}
