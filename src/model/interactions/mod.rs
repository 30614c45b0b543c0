//! What bodies do to each other, and to rigid planes: contact, ties, bodies that are rigid.

pub(super) mod contact;
mod interfaces;
pub(super) mod rigid;
pub(super) mod tied;

pub use interfaces::{
    Contact, ContactControl, ContactData, ContactDecomposition, ContactEdges, ContactMaterials, ContactOverlap,
    ContactSearch, ContactSurface, Friction, RigidSurface,
};
pub use tied::Tie;
