//! What each verb does.

pub(super) mod check;
pub(super) mod curve;
pub(super) mod plot;
pub(super) mod report;
pub(super) mod run;
pub(super) mod scale;
pub(super) mod small;
pub(super) mod sweep;
pub(super) mod trade;
pub(super) mod view;
