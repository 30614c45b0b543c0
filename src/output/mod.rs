//! Results to files: plot states and the print log. Reads solver state and never changes it.

mod across;
mod collect;
mod fields;
mod history;
mod nodal;
mod plane;
pub mod print;
mod restart;
mod schedule;
mod split;

pub use collect::Collector;
pub use fields::{FieldList, GLOBAL_VARIABLES, global_names, global_values};
pub use history::{HistoryPlan, block_energies, block_energy_names};
pub use nodal::NodalValues;
pub use restart::snapshot;
pub use schedule::Schedule;
pub use split::Split;
