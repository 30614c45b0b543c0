//! The account of the energy of contact: what its forces may give, what they have given, and to whom.

pub mod certificate;
pub mod gain;
pub mod ledger;
pub mod resultants;
