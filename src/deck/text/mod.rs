//! Text with its places: where it comes from, how it falls into records and fields, numbers, spelling, messages.

pub(super) mod diagnostic;
pub(super) mod identify;
pub(super) mod lexer;
pub(super) mod number;
pub(super) mod origin;
pub(super) mod source;
pub mod spelling;
