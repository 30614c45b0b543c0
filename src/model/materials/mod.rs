//! What element blocks are made of, and what the deck says of their elements.

pub(super) mod explosive;
pub(super) mod material;
mod properties;
pub(super) mod section;

pub use material::BlockMaterial;
pub use section::Section;
