//! Curves on paper: what stands where ([`layout`], [`axis`], [`legend`]), and how it is drawn ([`figure`], [`stroke`],
//! [`sheet`]).

mod axis;
mod figure;
mod layout;
mod legend;
mod sheet;
mod stroke;

pub use figure::draw;
pub use layout::Texts;
