//! What is drawn: a file's body at a state with its surface, its sections and the variable on it.

pub mod bars;
mod choice;
pub mod field;
mod quarters;
mod revolve;
pub mod scene;
pub mod section;
mod selection;
pub mod subject;
pub mod thickness;
