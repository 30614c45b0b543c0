//! The run: what is computed and how, what is taken away on the way, what is written and when.

pub(super) mod analysis;
pub(super) mod deletion;
mod fields;
pub(super) mod output;
pub(super) mod restart;

pub use analysis::{
    Analysis, BulkViscosity, DEFAULT_HOURGLASS, Hourglass, MassScaling, Precision, ScaleMass, Spin, StepEstimate,
    StepModuli, TimeStepControl,
};
pub use deletion::{Death, DeathVariable, Deletion};
pub use fields::{ElementField, NodalField};
pub use output::{PlotRequests, PlotSchedule, StepColumns, Watched};
pub use restart::{ReadRestart, Restarts, WriteRestart};
