//! What can be turned in a deck: only what the scene has.

mod of_contact;
mod of_elements;

use super::edit::with_command;
use crate::common::numbers::scientific;
use crate::deck::Deck;
use crate::mesh::{Dimension, Mesh};
use crate::model::{Death, Model, Precision};

/// Part by which round-off is imitated: it is far above that of a step and far below any error that is told.
const ROUND_OFF: f64 = 1e-9;

/// Which knob a variant turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Knob {
    /// None: the deck as it is.
    None,
    /// A perturbation of the size of round-off.
    RoundOff,
    /// The mesh.
    Mesh,
    /// The time step.
    TimeStep,
    /// What bounds the time step.
    Estimate,
    /// The formulation of hexahedra.
    Formulation,
    /// Points through the thickness of shells.
    Points,
    /// Hourglass control.
    Hourglass,
    /// Bulk viscosity.
    Viscosity,
    /// Single precision.
    Precision,
    /// Order of the spin of hexahedra with one point.
    Spin,
    /// Added mass.
    Mass,
    /// How contact is enforced.
    Contact,
    /// How what may touch is found.
    Search,
    /// When elements are taken away.
    Erosion,
    /// Several together.
    Several,
}

impl Knob {
    /// The knob in words.
    pub fn name(self) -> &'static str {
        match self {
            Knob::None => "the deck",
            Knob::RoundOff => "round-off",
            Knob::Mesh => "mesh",
            Knob::TimeStep => "time step",
            Knob::Estimate => "time step estimate",
            Knob::Formulation => "element formulation",
            Knob::Points => "thickness points",
            Knob::Hourglass => "hourglass control",
            Knob::Viscosity => "bulk viscosity",
            Knob::Precision => "precision",
            Knob::Spin => "spin",
            Knob::Mass => "mass scaling",
            Knob::Contact => "contact",
            Knob::Search => "contact search",
            Knob::Erosion => "erosion",
            Knob::Several => "several",
        }
    }
}

/// A deck that differs from the given one.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// Name of its folder.
    pub name: String,
    /// What is different.
    pub knob: Knob,
    /// The command that says so, or what else is done.
    pub words: String,
    /// The commands that are taken out and those that are put in.
    pub change: (Vec<&'static str>, Vec<String>),
    /// How many times finer than the given mesh its mesh is.
    pub refine: u32,
    /// How often the work of the given deck it is expected to be.
    pub work: f64,
}

impl Variant {
    fn of(knob: Knob, name: &str, without: &[&'static str], line: String, work: f64) -> Variant {
        let lines = if line.is_empty() { Vec::new() } else { vec![line] };
        Variant::with(knob, name, without, lines, work)
    }

    fn with(knob: Knob, name: &str, without: &[&'static str], lines: Vec<String>, work: f64) -> Variant {
        let words = match (&lines[..], without) {
            ([], []) => "as it is".to_string(),
            ([], _) => format!("without {}", without.join(", ")),
            _ => lines.join("; "),
        };
        Variant { name: name.into(), knob, words, change: (without.to_vec(), lines), refine: 1, work }
    }

    /// Whether it is more exact than the deck as it is, as far as its knob goes, or at least no less: what it changes is an
    /// error of the deck.
    pub fn is_finer(&self) -> bool {
        match self.knob {
            Knob::Contact => ["tight-contact", "all-edges"].contains(&self.name.as_str()),
            Knob::Points => self.name == "more-points",
            Knob::Estimate => self.name == "element-estimate",
            Knob::Spin => self.name == "second-order-spin",
            Knob::RoundOff | Knob::Mesh | Knob::TimeStep | Knob::Viscosity | Knob::Search => true,
            // Another formulation is neither finer nor coarser, and when a material breaks is what its tests say.
            Knob::None
            | Knob::Formulation
            | Knob::Hourglass
            | Knob::Precision
            | Knob::Mass
            | Knob::Erosion
            | Knob::Several => false,
        }
    }

    /// Its deck. `more` lines and names belong to all variants.
    pub fn deck(&self, deck: &Deck, (without, lines): &(Vec<&'static str>, Vec<String>)) -> String {
        with_command(deck, &[&without[..], &self.change.0].concat(), &[&lines[..], &self.change.1].concat())
    }
}

/// All variants but those of several knobs, the most telling first: `levels` are the refinements of the mesh.
pub fn variants(model: &Model, mesh: &Mesh, levels: &[u32]) -> Vec<Variant> {
    let scale = model.time_step.scale;
    let mut all = vec![
        Variant::of(Knob::None, "deck", &[], String::new(), 1.0),
        Variant::of(
            Knob::RoundOff,
            "round-off",
            &["TIME STEP SCALE"],
            format!("TIME STEP SCALE, {:?}", scale * (1.0 - ROUND_OFF)),
            1.0,
        ),
    ];
    let finer = |&refine: &u32| {
        let dimensions = if mesh.dimension == Dimension::Two { 2 } else { 3 };
        let work = f64::from(refine).powi(dimensions + 1);
        let words = format!("mesh {refine} times finer");
        Variant { refine, words, ..Variant::of(Knob::Mesh, &format!("mesh-{refine}"), &[], String::new(), work) }
    };
    let mut meshes = levels.iter().map(finer);
    all.extend(meshes.next());
    all.push(Variant::of(
        Knob::TimeStep,
        "half-steps",
        &["TIME STEP SCALE"],
        format!("TIME STEP SCALE, {:?}", 0.5 * scale),
        2.0,
    ));
    all.extend(of_elements::variants(model, mesh));
    all.extend(viscosity(model));
    all.extend(precision(model, mesh));
    all.extend(erosion(model));
    all.extend(of_contact::variants(model, mesh));
    all.extend(meshes);
    all
}

fn precision(model: &Model, mesh: &Mesh) -> Option<Variant> {
    let has = mesh.blocks.iter().any(|block| !block.is_empty() && model.has_one_point_hexahedra(block));
    let line = "PRECISION, SINGLE".to_string();
    (has && model.precision == Precision::Double)
        .then(|| Variant::of(Knob::Precision, "single", &["PRECISION"], line, 0.7))
}

fn viscosity(model: &Model) -> Vec<Variant> {
    let now = model.bulk_viscosity;
    let command = |linear: f64, quadratic: f64| format!("BULK VISCOSITY, {linear}, {quadratic}");
    let mut all = Vec::new();
    if now.linear > 0.0 || now.quadratic > 0.0 {
        let half = command(0.5 * now.linear, 0.5 * now.quadratic);
        all.push(Variant::of(Knob::Viscosity, "half-viscosity", &["BULK VISCOSITY"], half, 1.0));
    }
    if now.linear > 0.0 {
        // It shortens the step.
        all.push(Variant::of(
            Knob::Viscosity,
            "no-linear-viscosity",
            &["BULK VISCOSITY"],
            command(0.0, now.quadratic),
            1.0,
        ));
    }
    all
}

/// Factor by which elements go later, and over which they go sooner.
const LATER: f64 = 1.25;

/// All rules of DEATH with other values; a value of zero stays.
fn erosion(model: &Model) -> Vec<Variant> {
    if model.deaths.iter().all(|rule| rule.value == 0.0) {
        return Vec::new();
    }
    let of = |name: &str, later: f64| {
        let lines = model.deaths.iter().map(|rule| {
            // A largest value that is positive grows, and so does a smallest one that is negative.
            let away = rule.is_maximum == (rule.value > 0.0);
            death(rule, rule.value * if away { later } else { 1.0 / later })
        });
        Variant::with(Knob::Erosion, name, &["DEATH"], lines.collect(), 1.0)
    };
    vec![of("later-erosion", LATER), of("sooner-erosion", 1.0 / LATER)]
}

fn death(rule: &Death, value: f64) -> String {
    let variable = rule.variable.name();
    let bound = if rule.is_maximum { "MAX" } else { "MIN" };
    let nodes = if rule.keeps_nodes { "FREE" } else { "DROP" };
    let share = if rule.share == 1.0 { String::new() } else { format!(", {:?}", rule.share) };
    format!("DEATH, {}, {variable}, {bound}, {}, {nodes}{share}", rule.block, scientific(value, 3))
}

/// Steps with which mass is added, of the mean step of the deck as it is.
const LONGER: [(&str, f64); 2] = [("mass-1.2", 1.2), ("mass-2", 2.0)];

/// Mass scaling to steps longer than `step`, the mean one of the deck as it is. Its own limit is no limit here: the error is measured.
pub fn mass_scaling(step: f64) -> Vec<Variant> {
    let of = |(name, factor): (&str, f64)| {
        let line = format!("MASS SCALING, ALL, STEP, {}, 1000.", scientific(factor * step, 3));
        Variant::of(Knob::Mass, name, &["MASS SCALING"], line, 1.0 / factor)
    };
    LONGER.into_iter().map(of).collect()
}

/// A variant with what all of these turn.
pub fn together(variants: &[&Variant]) -> Variant {
    let without = variants.iter().flat_map(|variant| variant.change.0.clone()).collect();
    let lines: Vec<String> = variants.iter().flat_map(|variant| variant.change.1.clone()).collect();
    let words = lines.join("; ");
    Variant { name: "together".into(), knob: Knob::Several, words, change: (without, lines), refine: 1, work: 1.0 }
}
