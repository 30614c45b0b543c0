//! When and what to write.

use super::fields::{ElementField, NodalField};
use crate::model::problem::{Draft, Setter};
use crate::{
    deck::{Card, Diagnostic, Item, spelling},
    material::MATERIALS,
};

/// HISTORY: what is watched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Watched {
    /// Every block, as a body.
    Blocks,
    /// The block with this number, as a body.
    Block(i64),
    /// The node set with this number.
    NodeSet(i64),
    /// The node with this number.
    Node(i64),
    /// The force of rigid surfaces on the nodes of the side set with this number, and its work.
    RigidSurface(i64),
    /// The force of the block with the second number on that with the first, or of all others where there is none, and their
    /// works.
    Contact(i64, Option<i64>),
}

/// PLOT TIME: states are written at the steps nearest to `start`, `start + interval`, … up to `stop`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlotSchedule {
    /// Interval between states; `None` writes only the first and the last state.
    pub interval: Option<f64>,
    /// First time.
    pub start: f64,
    /// Last time.
    pub stop: f64,
}

/// PLOT NODAL, PLOT ELEMENT, PLOT STATE.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlotRequests {
    /// Nodal fields, in EXODUS order; DISPLACEMENT is always first.
    pub nodal: Vec<NodalField>,
    /// Element fields.
    pub element: Vec<ElementField>,
    /// Names of material state variables.
    pub state: Vec<String>,
    /// Energies of each block, as global variables.
    pub block_energies: bool,
}

/// Groups of columns that STEP LOG can ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepColumns {
    /// None beside PRONTO's own.
    Pronto,
    /// The time step and the element that sets it.
    TimeStep,
    /// The energy accounts and their balance.
    Energy,
    /// The error of the energy balance alone.
    EnergyError,
    /// The momentum of the body.
    Momentum,
    /// Seconds to the termination time.
    ToGo,
}

impl StepColumns {
    /// All of them.
    pub const ALL: [StepColumns; 6] =
        [Self::Pronto, Self::TimeStep, Self::Energy, Self::EnergyError, Self::Momentum, Self::ToGo];
    /// What a log has when the deck does not say: PRONTO's 132 columns hold it.
    pub const USUAL: [StepColumns; 3] = [Self::TimeStep, Self::ToGo, Self::EnergyError];

    /// The word that STEP LOG knows.
    pub fn keyword(self) -> &'static str {
        match self {
            Self::Pronto => "PRONTO",
            Self::TimeStep => "TIME STEP",
            Self::Energy => "ENERGY",
            Self::EnergyError => "ENERGY ERROR",
            Self::Momentum => "MOMENTUM",
            Self::ToGo => "TO GO",
        }
    }
}

pub(in crate::model) const COMMANDS: &[Setter] = &[
    ("OUTPUT TIME", output_time),
    ("STEP LOG", step_log),
    ("PLOT TIME", plot_time),
    ("PLOT NODAL", plot_nodal),
    ("PLOT ELEMENT", plot_element),
    ("PLOT STATE", plot_state),
    ("PLOT GLOBAL", |_, draft| draft.model.plot_requests.block_energies = true),
    ("MATERIAL POINT", |card, draft| draft.model.material_points.push(card.vector(["x", "y", "z"]))),
    ("HISTORY TIME", |card, draft| draft.model.history_interval = Some(card.number("dt"))),
    ("HISTORY BLOCK", history_block),
    ("HISTORY NODE SET", |card, draft| watch(card, draft, "node_set", Watched::NodeSet)),
    ("HISTORY NODE", |card, draft| watch(card, draft, "node", Watched::Node)),
    ("HISTORY RIGID SURFACE", |card, draft| watch(card, draft, "side_set", Watched::RigidSurface)),
    ("HISTORY CONTACT", |card, draft| {
        let second = card.items("second").first().and_then(|item| item.value.integer());
        add_new(&mut draft.model.histories, [Watched::Contact(card.integer("first"), second)]);
    }),
];

/// Lines of the print log when OUTPUT TIME does not say.
const PRINTED_LINES: f64 = 100.0;

/// A plot file with more states than this is most likely a slip of the exponent.
const MANY_STATES: f64 = 100_000.0;

fn output_time(card: &Card, draft: &mut Draft) {
    draft.model.output_interval = card.number("dt");
}

fn step_log(card: &Card, draft: &mut Draft) {
    let asked = card.items("name").iter().filter_map(|item| item.value.text());
    let columns = asked.filter_map(|name| StepColumns::ALL.into_iter().find(|columns| columns.keyword() == name));
    add_new(&mut draft.model.step_log, columns);
}

fn plot_time(card: &Card, draft: &mut Draft) {
    let stop = card.maybe_number("stop").unwrap_or(f64::NAN);
    draft.model.plot = PlotSchedule { interval: card.maybe_number("dt"), start: card.number("start"), stop };
}

fn plot_nodal(card: &Card, draft: &mut Draft) {
    let asked = card.items("name").iter().filter_map(|item| item.value.text());
    let fields = asked.filter_map(|name| NodalField::ALL.iter().copied().find(|f| f.keyword() == name));
    add_new(&mut draft.model.plot_requests.nodal, fields);
}

fn plot_element(card: &Card, draft: &mut Draft) {
    let asked = card.items("name").iter().filter_map(|item| item.value.text());
    let fields = asked.filter_map(|name| ElementField::ALL.iter().copied().find(|f| f.keyword() == name));
    add_new(&mut draft.model.plot_requests.element, fields);
}

fn history_block(card: &Card, draft: &mut Draft) {
    match card.items("block") {
        [] => add_new(&mut draft.model.histories, [Watched::Blocks]),
        _ => watch(card, draft, "block", Watched::Block),
    }
}

fn watch(card: &Card, draft: &mut Draft, field: &str, watched: fn(i64) -> Watched) {
    let ids = card.items(field).iter().filter_map(|item| item.value.integer());
    add_new(&mut draft.model.histories, ids.map(watched));
}

fn plot_state(card: &Card, draft: &mut Draft) {
    let mut names = Vec::new();
    for item in card.items("name") {
        names.extend(state_name(item, draft));
    }
    add_new(&mut draft.model.plot_requests.state, names);
}

fn add_new<T: PartialEq>(list: &mut Vec<T>, more: impl IntoIterator<Item = T>) {
    for one in more {
        if !list.contains(&one) {
            list.push(one);
        }
    }
}

/// The name of a state variable that a material of the deck has; reports one that none has.
fn state_name(item: &Item, draft: &mut Draft) -> Option<String> {
    let name = item.value.text()?.to_uppercase();
    let place = item.span.unwrap_or_default();
    let in_deck: Vec<&str> = draft
        .model
        .materials
        .iter()
        .flat_map(|material| material.law.entry().state.iter().map(|variable| variable.name))
        .collect();
    let materials_written = draft.deck.cards.iter().filter(|card| card.name == "MATERIAL").count();
    // A material that could not be read might have had the variable.
    if in_deck.contains(&name.as_str()) || draft.model.materials.len() < materials_written {
        return Some(name);
    }
    let owners: Vec<&str> =
        MATERIALS.iter().filter(|m| m.state.iter().any(|v| v.name == name)).map(|m| m.name).collect();
    let mut offered = in_deck.clone();
    offered.sort_unstable();
    offered.dedup();
    let diagnostic = Diagnostic::error(format!("PLOT STATE: no material of this deck has a state variable {name}"))
        .at(place, "unknown state variable");
    let near = spelling::nearest(&name, in_deck);
    draft.report(match (owners.is_empty(), near, offered.is_empty()) {
        (false, _, _) => diagnostic.help(format!("{name} belongs to {}", spelling::all(&owners))),
        (true, Some(near), _) => diagnostic.help(format!("did you mean {near}?")),
        (true, None, true) => diagnostic.help("the materials of this deck have no state variables"),
        (true, None, false) => diagnostic.help(format!("the materials of this deck have {}", spelling::all(&offered))),
    });
    None
}

/// Fills in what follows from other commands, and looks at the schedule as a whole.
pub(in crate::model) fn finish(draft: &mut Draft) {
    let end = draft.model.termination_time;
    let plot = &mut draft.model.plot;
    if plot.stop.is_nan() {
        plot.stop = 2.0 * end;
    }
    if draft.model.output_interval.is_nan() {
        draft.model.output_interval = end / PRINTED_LINES;
    }
    if draft.model.step_log.is_empty() {
        draft.model.step_log = StepColumns::USUAL.to_vec();
    }
    let nodal = &mut draft.model.plot_requests.nodal;
    nodal.retain(|field| *field != NodalField::Displacement);
    nodal.insert(0, NodalField::Displacement);
    let element = &mut draft.model.plot_requests.element;
    let goes = !draft.model.deaths.is_empty() || !draft.model.deletions.is_empty();
    if goes && !element.contains(&ElementField::Status) {
        element.push(ElementField::Status);
    }
    check_schedule(draft);
    check_histories(draft);
}

/// Warns of an interval of histories when nothing is watched.
fn check_histories(draft: &mut Draft) {
    let model = &draft.model;
    let Some(card) = draft.deck.cards_of("HISTORY TIME").last() else { return };
    if model.histories.is_empty() && model.material_points.is_empty() {
        draft.report(
            Diagnostic::warning("HISTORY TIME: nothing is watched, so that nothing follows from this")
                .at(card.record, "interval of histories")
                .help("HISTORY BLOCK, HISTORY NODE SET, HISTORY NODE, HISTORY RIGID SURFACE, HISTORY CONTACT and MATERIAL POINT say what to watch"),
        );
    }
}

fn check_schedule(draft: &mut Draft) {
    let (plot, end) = (draft.model.plot, draft.model.termination_time);
    let Some(card) = draft.deck.cards_of("PLOT TIME").last() else { return };
    if plot.start > end {
        return draft.report(
            Diagnostic::warning(format!("PLOT TIME: plotting starts at {}, but the run ends at {end}", plot.start))
                .at(card.place("start"), "only the first and the last state will be written"),
        );
    }
    if plot.stop < plot.start {
        let message = format!("PLOT TIME: stop is {}, before start at {}", plot.stop, plot.start);
        return draft.report(Diagnostic::error(message).at(card.place("stop"), "must not be before start"));
    }
    let states = (end.min(plot.stop) - plot.start) / plot.interval.unwrap_or(f64::INFINITY);
    if states > MANY_STATES {
        draft.report(
            Diagnostic::warning(format!("PLOT TIME: this asks for about {states:.0} states"))
                .at(card.place("dt"), "interval between states")
                .help(format!("the run ends at {end}; is the exponent right?")),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deck::{Kind, Standing, language};

    #[test]
    fn the_grammar_lists_the_fields_that_the_model_has() {
        let listed = |command: &str| -> Vec<String> {
            let Some(Kind::Choice(choices)) = language().entry(command).and_then(|e| e.field("name")).map(|f| &f.kind)
            else {
                return Vec::new();
            };
            choices.iter().filter(|c| c.standing == Standing::Built).map(|c| c.name.clone()).collect()
        };
        assert_eq!(listed("STEP LOG"), StepColumns::ALL.map(StepColumns::keyword));
        assert_eq!(listed("PLOT NODAL"), NodalField::ALL.iter().map(|f| f.keyword()).collect::<Vec<_>>());
        assert_eq!(listed("PLOT ELEMENT"), ElementField::ALL.iter().map(|f| f.keyword()).collect::<Vec<_>>());
    }
}
