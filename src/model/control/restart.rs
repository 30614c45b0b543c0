//! Restarts: writing them and going on from them.

use crate::deck::{Card, Diagnostic};
use crate::model::problem::{Draft, Setter};

pub(in crate::model) const COMMANDS: &[Setter] = &[("WRITE RESTART", write_restart), ("READ RESTART", read_restart)];

/// What a deck wants of restarts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Restarts {
    /// WRITE RESTART.
    pub write: Option<WriteRestart>,
    /// READ RESTART.
    pub read: Option<ReadRestart>,
}

/// WRITE RESTART: states are written at the steps nearest to multiples of an interval, and at the end of the run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WriteRestart {
    /// Interval between states.
    pub interval: f64,
    /// Number of states kept.
    pub keep: u32,
}

/// READ RESTART: the run goes on from a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadRestart {
    /// Time of the state; the newest without one.
    pub time: Option<f64>,
}

fn write_restart(card: &Card, draft: &mut Draft) {
    draft.model.restarts.write = Some(WriteRestart { interval: card.number("dt"), keep: card.integer("keep") as u32 });
}

fn read_restart(card: &Card, draft: &mut Draft) {
    draft.model.restarts.read = Some(ReadRestart { time: card.maybe_number("t") });
}

/// A run must end after the state that it goes on from.
pub(in crate::model) fn finish(draft: &mut Draft) {
    let end = draft.model.termination_time;
    let Some(time) = draft.model.restarts.read.and_then(|read| read.time).filter(|time| *time >= end) else { return };
    let Some(card) = draft.deck.cards_of("READ RESTART").last() else { return };
    let message = format!("READ RESTART: the run ends at {end}, before the state at {time} that it is to go on from");
    let diagnostic = Diagnostic::error(message).at(card.place("t"), "must be before the end");
    draft.report(diagnostic.help("a later TERMINATION TIME lets the run go on"));
}
