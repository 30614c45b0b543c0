//! What a language says of itself: `urto explain` and the manual.

pub(super) mod explain;
pub(super) mod glossary;
pub(super) mod manual;
pub(super) mod page;
