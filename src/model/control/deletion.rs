//! What is taken away: elements that fail, and blocks at a time.

use super::fields::ElementField;
use crate::deck::{Card, Diagnostic, spelling};
use crate::model::problem::{Draft, Setter};

/// DEATH: elements of a block are taken away when a variable passes a value.
#[derive(Debug, Clone, PartialEq)]
pub struct Death {
    /// Element block number.
    pub block: i64,
    /// What is watched.
    pub variable: DeathVariable,
    /// Whether the value is a largest one; a smallest one otherwise.
    pub is_maximum: bool,
    /// The value.
    pub value: f64,
    /// Whether nodes that lose their last element go on as free masses.
    pub keeps_nodes: bool,
    /// Part of the points of integration that must have passed the value before an element with several of them goes.
    pub share: f64,
}

/// What DEATH watches.
#[derive(Debug, Clone, PartialEq)]
pub enum DeathVariable {
    /// A state variable of the material.
    State(String),
    /// A component of an element field of the plot file.
    Field(ElementField, usize),
    /// Present volume over initial volume; 0 is inversion.
    Volume,
    /// The stable time step of the element.
    TimeStep,
}

impl DeathVariable {
    /// Its name in the command.
    pub fn name(&self) -> &str {
        match self {
            DeathVariable::State(name) => name,
            DeathVariable::Field(field, component) => field.components().get(*component).copied().unwrap_or_default(),
            DeathVariable::Volume => "VOLUME",
            DeathVariable::TimeStep => "TMSTEP",
        }
    }
}

pub(in crate::model) const COMMANDS: &[Setter] =
    &[("DEATH", death), ("DELETE MATERIAL", delete_material), ("ACTIVE LIMITS", active_limits)];

/// DELETE MATERIAL: an element block is taken away at the state nearest to a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deletion {
    /// Element block number.
    pub block: i64,
    /// The time.
    pub time: f64,
}

fn delete_material(card: &Card, draft: &mut Draft) {
    draft.model.deletions.push(Deletion { block: card.integer("block"), time: card.number("t") });
}

/// The end of a block's time is a deletion; its beginning must be that of the run.
fn active_limits(card: &Card, draft: &mut Draft) {
    let (block, begin) = (card.integer("block"), card.number("begin"));
    if begin > 0.0 {
        let message = format!("ACTIVE LIMITS: block {block} is to begin at {begin}, but blocks begin with the run");
        return draft.report(
            Diagnostic::error(message)
                .at(card.place("begin"), "must be 0")
                .help("a block born later would bring mass and momentum from nowhere, into nodes that have moved"),
        );
    }
    if let Some(time) = card.maybe_number("end") {
        draft.model.deletions.push(Deletion { block, time });
    }
}

fn death(card: &Card, draft: &mut Draft) {
    let block = card.integer("block");
    let name = card.text("variable").to_uppercase();
    let Some(variable) = death_variable(block, &name, draft) else {
        let mut known = vec!["VOLUME".to_string(), "TMSTEP".to_string()];
        known.extend(state_names(block, draft));
        let fields =
            ElementField::ALL.iter().filter(|field| !matches!(field, ElementField::Status | ElementField::Rank));
        known.extend(fields.flat_map(|field| field.components()).map(|name| name.to_string()));
        let diagnostic = Diagnostic::error(format!("DEATH: there is no variable {} to watch", spelling::cut(&name)))
            .at(card.place("variable"), "expected a state variable or a component of PLOT ELEMENT");
        let near = spelling::nearest(&name, known.iter().map(String::as_str));
        return draft.report(match near {
            Some(near) => diagnostic.help(format!("did you mean {near}?")),
            None => diagnostic.help(format!("block {block} has {}", spelling::all(&known))),
        });
    };
    let keeps_nodes = card.text("nodes") == "FREE";
    if draft.model.deaths.iter().any(|other| other.block == block && other.keeps_nodes != keeps_nodes) {
        let message = format!("DEATH: nodes of block {block} are to be kept by one command and dropped by another");
        return draft
            .report(Diagnostic::error(message).at(card.place("nodes").join(card.record), "the second of them"));
    }
    draft.model.deaths.push(Death {
        block,
        variable,
        is_maximum: card.text("bound") == "MAX",
        value: card.number("value"),
        keeps_nodes,
        share: card.number("share"),
    });
}

fn state_names(block: i64, draft: &Draft) -> Vec<String> {
    let material = draft.model.materials.iter().find(|material| material.block == block);
    material.map_or(Vec::new(), |m| m.law.entry().state.iter().map(|variable| variable.name.to_string()).collect())
}

fn death_variable(block: i64, name: &str, draft: &Draft) -> Option<DeathVariable> {
    match name {
        "VOLUME" => return Some(DeathVariable::Volume),
        "TMSTEP" => return Some(DeathVariable::TimeStep),
        _ => (),
    }
    let watched = ElementField::ALL.iter().filter(|field| !matches!(field, ElementField::Status | ElementField::Rank));
    let field = watched.copied().find_map(|field| {
        let component = field.components().iter().position(|component| *component == name)?;
        Some(DeathVariable::Field(field, component))
    });
    // A material that could not be read has been reported; its variables are not known.
    let unread = draft.model.materials.iter().all(|material| material.block != block);
    let of_material = state_names(block, draft).iter().any(|variable| variable == name);
    field.or((of_material || unread).then(|| DeathVariable::State(name.to_string())))
}
