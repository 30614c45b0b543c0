//! FUNCTION groups: functions of time that conditions and laws refer to.

use crate::deck::{Card, Diagnostic};
use crate::model::problem::{Draft, Setter};

/// FUNCTION: piecewise linear, constant outside its points.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// The function's number.
    pub id: i64,
    /// Points `(t, f)` with increasing `t`; at least one.
    pub points: Vec<(f64, f64)>,
}

pub(in crate::model) const COMMANDS: &[Setter] = &[("FUNCTION", function)];

fn function(card: &Card, draft: &mut Draft) {
    let id = card.integer("id");
    if let Some(first) = draft.deck.cards_of("FUNCTION").find(|c| c.integer("id") == id).filter(|c| *c != card) {
        let diagnostic = Diagnostic::error(format!("there are two functions with number {id}"))
            .at(card.record, "the second one")
            .at(first.record, "the first one");
        return draft.report(diagnostic);
    }
    if card.rows.is_empty() {
        draft.report(
            Diagnostic::error(format!("FUNCTION {id} has no points"))
                .at(card.record, "expected lines `time, value` between this line and END"),
        );
    }
    times_increase(card, draft);
    let points = card.rows.iter().filter_map(|row| Some((*row.numbers.first()?, *row.numbers.get(1)?))).collect();
    draft.model.functions.push(Function { id, points });
}

/// Reports every time that is not larger than the one before.
fn times_increase(card: &Card, draft: &mut Draft) {
    let time = |row: &crate::deck::Row| row.numbers.first().copied().unwrap_or(f64::NAN);
    for pair in card.rows.windows(2).filter(|pair| time(&pair[1]) <= time(&pair[0])) {
        let (before, here) = (time(&pair[0]), time(&pair[1]));
        let message = format!("FUNCTION {}: times must increase, but {here} follows {before}", card.integer("id"));
        let mut diagnostic = Diagnostic::error(message)
            .at(pair[1].fields[0].span, "not larger than the time before")
            .at(pair[0].fields[0].span, "the time before");
        if here == before {
            diagnostic = diagnostic.help("for a jump, give two times that differ a little");
        }
        draft.report(diagnostic);
    }
}

/// Warns of functions that nothing refers to.
pub(in crate::model) fn report_unused(draft: &mut Draft) {
    let deck = draft.deck;
    for card in deck.cards_of("FUNCTION") {
        let id = card.maybe_integer("id");
        let in_material = id.is_some_and(|id| draft.functions_of_materials.contains(&id));
        if !in_material && !deck.cards.iter().any(|c| c.maybe_integer("function") == id || !c.complete) {
            let message = format!("FUNCTION {} is used by no command", card.integer("id"));
            draft.report(Diagnostic::warning(message).at(card.record, "nothing refers to this number"));
        }
    }
}
