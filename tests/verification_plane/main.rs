//! Two dimensions against known answers: solids, contact and gases, in the plane and as bodies of revolution.

mod axis;
mod contact;
mod gases;
mod solids;

#[path = "../support/mod.rs"]
mod support;
