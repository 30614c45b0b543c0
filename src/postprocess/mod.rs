//! Results for people: pictures, curves, a page; and what these need beside the variables of a file.

pub mod depiction;
pub mod means;
pub mod plot;
pub mod report;
pub mod view;
