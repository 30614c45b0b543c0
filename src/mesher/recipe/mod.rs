//! Recipes: cards → what to make, checked as far as that goes without making it.

mod language;
mod manual;
mod moves;
mod selections;
mod shapes;

pub use language::{CARDS, language};
pub use manual::manual;

use super::{
    body::Shape,
    changes::transform::Move,
    changes::triangles::Pattern,
    sets::{Place, Request},
};
use crate::deck::{Card, Deck, Diagnostic, Diagnostics, Source, Span, spelling};

/// What to make.
#[derive(Clone, Default)]
pub struct Recipe {
    pub(super) title: String,
    /// TOLERANCE and where it stands.
    pub(super) tolerance: Option<(f64, Span)>,
    pub(super) parts: Vec<Part>,
    pub(super) merges: Vec<Merge>,
    pub(super) splits: Vec<Split>,
    pub(super) triangles: Vec<Triangles>,
    pub(super) perturbs: Vec<Perturb>,
    pub(super) node_sets: Vec<Request>,
    pub(super) side_sets: Vec<Request>,
}

/// A shape in its place.
#[derive(Clone)]
pub(super) struct Part {
    pub block: i64,
    pub shape: std::sync::Arc<dyn Shape>,
    /// Moves in the order of the recipe.
    pub moves: Vec<Move>,
    pub place: Place,
}

/// Blocks whose coincident nodes become one; none means all.
#[derive(Clone)]
pub(super) struct Merge {
    pub blocks: Vec<i64>,
    pub place: Place,
}

/// Elements of a block in a box, and the block they go to.
#[derive(Clone)]
pub(super) struct Split {
    pub block: i64,
    pub new: i64,
    pub low: [f64; 3],
    pub high: [f64; 3],
    pub place: Place,
}

/// A block of surfaces to be divided into triangles.
#[derive(Clone)]
pub(super) struct Triangles {
    pub block: i64,
    pub pattern: Pattern,
    pub place: Place,
}

/// Interior nodes to push about.
#[derive(Clone)]
pub(super) struct Perturb {
    pub block: Option<i64>,
    pub amplitude: f64,
    pub place: Place,
}

/// A recipe being filled from its cards.
pub(super) struct Draft {
    pub recipe: Recipe,
    pub diagnostics: Diagnostics,
}

/// What a command does to the recipe.
pub(super) type Setter = (&'static str, fn(&Card, &mut Draft));

const GENERAL: &[Setter] = &[("TITLE", title), ("TOLERANCE", tolerance)];

impl Recipe {
    /// Reads a recipe. Where something is wrong the recipe lacks it, and the messages say so.
    pub fn read(source: Source) -> (Recipe, Diagnostics) {
        let name = source.name().to_string();
        let (deck, diagnostics) = Deck::read(source, language());
        let recipe = Recipe { title: name, ..Recipe::default() };
        let mut draft = Draft { recipe, diagnostics };
        // Sets last: they are picked from the finished mesh, wherever they stand.
        for commands in [[GENERAL, shapes::COMMANDS, moves::COMMANDS].concat(), selections::COMMANDS.to_vec()] {
            for card in deck.cards.iter().filter(|card| card.complete) {
                if let Some((_, set)) = commands.iter().find(|(name, _)| *name == card.name) {
                    set(card, &mut draft);
                }
            }
        }
        if draft.recipe.parts.is_empty() && !draft.diagnostics.has_errors() {
            let message = Diagnostic::error("the recipe makes no elements");
            draft.report(message.help("a first shape: BOX, 1, 0., 0., 0., 1., 1., 1., 4, 4, 4"));
        }
        (draft.recipe, draft.diagnostics)
    }
}

impl Recipe {
    /// Number of elements that the recipe makes, every number of cells multiplied by `refine`; a real number, as it may
    /// be too large for any other.
    pub fn elements(&self, refine: usize) -> f64 {
        self.parts.iter().map(|part| part.shape.elements(refine)).sum()
    }
}

impl Draft {
    pub fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Whether shapes above have made this block; reports it if not.
    fn knows(&mut self, card: &Card, field: &str, block: i64) -> bool {
        let mut made: Vec<i64> = self.recipe.parts.iter().map(|part| part.block).collect();
        made.sort_unstable();
        made.dedup();
        let known = made.contains(&block);
        // A shape with a mistake is not in the list, and what refers to it is no further mistake.
        if !known && !self.diagnostics.has_errors() {
            let help = match made.is_empty() {
                true => "a shape such as BOX or CYLINDER makes a block; it must stand above this line".to_string(),
                false => format!("the shapes above this line make {}", blocks(&made)),
            };
            let message = format!("{}: there is no block {block} yet", card.name);
            self.report(Diagnostic::error(message).at(card.place(field), "no shape has made it").help(help));
        }
        known
    }
}

/// "block 1", "blocks 1, 2 and 3".
pub(super) fn blocks(ids: &[i64]) -> String {
    let numbers: Vec<String> = ids.iter().map(i64::to_string).collect();
    format!("block{} {}", if ids.len() == 1 { "" } else { "s" }, spelling::all(&numbers))
}

impl Place {
    fn of(card: &Card) -> Place {
        Place { owner: card.name.clone(), span: card.record }
    }
}

/// An optional field's number, or what stands for it.
fn number_or(card: &Card, field: &str, otherwise: f64) -> f64 {
    card.maybe_number(field).unwrap_or(otherwise)
}

/// A direction field as 0, 1 or 2.
fn axis(card: &Card, field: &str) -> usize {
    ["X", "Y", "Z"].iter().position(|name| *name == card.text(field)).unwrap_or(2)
}

/// A vector's direction; reports one of length zero.
fn unit_vector(card: &Card, fields: [&str; 3], draft: &mut Draft) -> Option<[f64; 3]> {
    let vector = card.vector(fields);
    // Dividing first keeps the squares of very long and very short vectors within range.
    let largest = vector.iter().fold(0.0, |largest: f64, c| largest.max(c.abs()));
    if largest == 0.0 {
        let place = card.place(fields[0]).join(card.place(fields[2]));
        let message = format!("{}: the direction has length zero", card.name);
        draft.report(Diagnostic::error(message).at(place, "for the z direction, give 0., 0., 1."));
        return None;
    }
    let vector = vector.map(|c| c / largest);
    let length = super::distance(vector, [0.0; 3]);
    Some(vector.map(|c| c / length))
}

/// Bounds of a box from fields x0, x1, … z1, of which any may be left out; reports those in the wrong order.
fn bounds(card: &Card, draft: &mut Draft) -> Option<[[f64; 3]; 2]> {
    let low = ["x0", "y0", "z0"].map(|field| number_or(card, field, f64::NEG_INFINITY));
    let high = ["x1", "y1", "z1"].map(|field| number_or(card, field, f64::INFINITY));
    let Some(axis) = (0..3).find(|&axis| low[axis] > high[axis]) else { return Some([low, high]) };
    let name = ["x", "y", "z"][axis];
    let message = format!("{}: {name}0 is {}, larger than {name}1, {}", card.name, low[axis], high[axis]);
    let place = card.place(&format!("{name}0")).join(card.place(&format!("{name}1")));
    draft.report(Diagnostic::error(message).at(place, "the smaller bound comes first"));
    None
}

fn title(card: &Card, draft: &mut Draft) {
    draft.recipe.title = card.text("title").trim().to_string();
}

fn tolerance(card: &Card, draft: &mut Draft) {
    draft.recipe.tolerance = Some((card.number("length"), card.place("length")));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deck::Status;

    #[test]
    fn every_entry_has_a_setter_and_every_setter_an_entry() {
        let setters: Vec<&str> =
            [GENERAL, shapes::COMMANDS, moves::COMMANDS, selections::COMMANDS].concat().iter().map(|s| s.0).collect();
        let entries: Vec<&str> = language()
            .commands()
            .filter(|entry| entry.status == Status::Built && entry.name != "EXIT")
            .map(|entry| entry.name.as_str())
            .collect();
        assert_eq!(setters, entries);
    }

    #[test]
    fn every_entry_is_described_with_an_example_that_reads() {
        for entry in &language().entries {
            assert!(!entry.does.is_empty() && !entry.example.is_empty(), "{}", entry.name);
            assert!(entry.see.iter().all(|name| language().entry(name).is_some()), "{}", entry.name);
            let (_, found) = Deck::read(Source::new(entry.name.as_str(), entry.example.join("\n")), language());
            assert!(!found.has_errors(), "{found}");
        }
    }
}
