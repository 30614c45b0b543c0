//! What is computed and how: kind of analysis, times, time step, precision, spin, hourglass control, bulk viscosity.

use crate::deck::{Card, Diagnostic, language};
use crate::mesh::Dimension;
use crate::model::problem::{Draft, Setter};

/// In how many dimensions bodies are, and what stands for the one that is left out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Analysis {
    /// Three dimensions.
    #[default]
    Solid,
    /// PLANE STRAIN: no motion and no change along z; a unit of thickness.
    PlaneStrain,
    /// AXISYMMETRIC: bodies of revolution about the y axis, all 2π radians of them.
    Axisymmetric,
    /// AXISYMMETRIC, COMPATIBLE: the same, with forces weighed by areas.
    AxisymmetricCompatible,
}

impl Analysis {
    /// The dimension of its meshes.
    pub fn dimension(self) -> Dimension {
        if self == Analysis::Solid { Dimension::Three } else { Dimension::Two }
    }

    /// Its name in the log.
    pub fn name(self) -> &'static str {
        match self {
            Analysis::Solid => "3D SOLID",
            Analysis::PlaneStrain => "PLANE STRAIN",
            Analysis::Axisymmetric => "AXISYMMETRIC",
            Analysis::AxisymmetricCompatible => "AXISYMMETRIC, COMPATIBLE",
        }
    }

    /// Whether x is the distance from an axis.
    pub fn about_axis(self) -> bool {
        matches!(self, Analysis::Axisymmetric | Analysis::AxisymmetricCompatible)
    }
}

/// TIME STEP SCALE and its companions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStepControl {
    /// Factor on the stable time step, (0, 1] is safe; the default is 1, as in PRONTO: the bound is rigorous.
    pub scale: f64,
    /// Strain softening factor of PRONTO, kept for the echo.
    pub softening: f64,
    /// Largest ratio of one step to the one before.
    pub growth: f64,
    /// Which moduli make the wave speed.
    pub moduli: StepModuli,
    /// No step is longer, a time.
    pub longest: f64,
}

/// Which moduli the stable step is computed from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StepModuli {
    /// The elastic moduli: a rigorous bound also when a plastic element unloads.
    #[default]
    Elastic,
    /// PRONTO's effective moduli of the last increment: larger steps in plastic flow, no longer a bound.
    Effective,
}

/// PRECISION: of the state and the kernels of elements. Nodes, forces on them, energies and time are double in both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// 64 bits.
    #[default]
    Double,
    /// 32 bits.
    Single,
}

/// SPIN: of which order the spin of the frame of hexahedra with one point is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Spin {
    /// With the stretch at the start of the step: the error falls with the step.
    #[default]
    FirstOrder,
    /// With the stretch in the middle of the step: the error falls with the square of the step.
    SecondOrder,
}

/// TIME STEP ESTIMATE: what bounds the time step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StepEstimate {
    /// The bound of each element alone: rigorous.
    #[default]
    Element,
    /// The largest frequency of the mesh, by iterations every so many steps.
    Global,
}

/// MASS SCALING: mass that is added to the elements of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassScaling {
    /// Number of the block; `None` for all blocks.
    pub block: Option<i64>,
    /// How much.
    pub scale: ScaleMass,
    /// Largest added mass of a block over the mass of its material.
    pub limit: f64,
}

/// How much mass is added to an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ScaleMass {
    /// As much as it needs for a time step of this length, if it needs any.
    Step(f64),
    /// Its mass times this factor, which is at least 1, less its mass.
    Factor(f64),
}

/// BULK VISCOSITY.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BulkViscosity {
    /// Linear coefficient b₁.
    pub linear: f64,
    /// Quadratic coefficient b₂.
    pub quadratic: f64,
}

/// Hourglass control of the one-point hexahedron.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hourglass {
    /// Flanagan and Belytschko (1981): an elastic stiffness and a viscosity, both dimensionless.
    FlanaganBelytschko {
        /// Stiffness coefficient κ.
        stiffness: f64,
        /// Viscosity coefficient ε.
        viscosity: f64,
    },
    /// Belytschko and Bindeman (1993): stiffness from an assumed strain field, following plastic flow.
    AssumedStrain {
        /// Factor on the assumed strain stiffness; 1 is the theory.
        factor: f64,
    },
}

pub(in crate::model) const COMMANDS: &[Setter] = &[
    ("TITLE", title),
    ("AXISYMMETRIC", axisymmetric),
    ("PLANE STRAIN", |card, draft| analysis(Analysis::PlaneStrain, card, draft)),
    ("TERMINATION TIME", termination_time),
    ("TIME STEP SCALE", time_step_scale),
    ("TIME STEP GROWTH", time_step_growth),
    ("TIME STEP MODULI", time_step_moduli),
    ("TIME STEP ESTIMATE", time_step_estimate),
    ("TIME STEP MAXIMUM", time_step_maximum),
    ("PRECISION", precision),
    ("SPIN", spin),
    ("MASS SCALING", mass_scaling),
    ("HOURGLASS STIFFENING", hourglass),
    ("HOURGLASS CONTROL", hourglass),
    ("BULK VISCOSITY", bulk_viscosity),
];

/// Hourglass control of a deck that asks for none.
pub const DEFAULT_HOURGLASS: Hourglass = Hourglass::AssumedStrain { factor: 1.0 };

fn axisymmetric(card: &Card, draft: &mut Draft) {
    let compatible = card.text("form") == "COMPATIBLE";
    let kind = if compatible { Analysis::AxisymmetricCompatible } else { Analysis::Axisymmetric };
    analysis(kind, card, draft);
}

fn analysis(kind: Analysis, card: &Card, draft: &mut Draft) {
    if ![Analysis::Solid, kind].contains(&draft.model.analysis) {
        let other = draft.model.analysis.name();
        draft.report(
            Diagnostic::error(format!("{} contradicts {other}", card.name))
                .at(card.record, "a deck is one or the other")
                .help("take one of the two lines out"),
        );
    }
    draft.model.analysis = kind;
}

fn title(card: &Card, draft: &mut Draft) {
    draft.model.title = card.text("title").trim_end().to_string();
}

fn termination_time(card: &Card, draft: &mut Draft) {
    draft.model.termination_time = card.number("t");
}

fn time_step_scale(card: &Card, draft: &mut Draft) {
    draft.model.time_step.scale = card.number("factor");
    draft.model.time_step.softening = card.number("softening");
    if card.number("factor") > 1.0 {
        draft.report(
            Diagnostic::warning("TIME STEP SCALE: the factor is above 1, so the time step is above the stable one")
                .at(card.place("factor"), "the run is likely to blow up")
                .help("the default of 1.0 is safe; 0.9 leaves a margin"),
        );
    }
}

fn time_step_growth(card: &Card, draft: &mut Draft) {
    draft.model.time_step.growth = card.number("factor");
}

fn time_step_moduli(card: &Card, draft: &mut Draft) {
    draft.model.time_step.moduli =
        if card.text("moduli") == "EFFECTIVE" { StepModuli::Effective } else { StepModuli::Elastic };
}

fn time_step_maximum(card: &Card, draft: &mut Draft) {
    draft.model.time_step.longest = card.number("t");
}

fn time_step_estimate(card: &Card, draft: &mut Draft) {
    draft.model.step_estimate =
        if card.text("estimate") == "GLOBAL" { StepEstimate::Global } else { StepEstimate::Element };
}

fn precision(card: &Card, draft: &mut Draft) {
    draft.model.precision = if card.text("precision") == "SINGLE" { Precision::Single } else { Precision::Double };
}

fn spin(card: &Card, draft: &mut Draft) {
    draft.model.spin = if card.text("order") == "SECOND ORDER" { Spin::SecondOrder } else { Spin::FirstOrder };
}

fn mass_scaling(card: &Card, draft: &mut Draft) {
    let value = card.number("value");
    let scale = if card.text("way") == "FACTOR" { ScaleMass::Factor(value) } else { ScaleMass::Step(value) };
    if matches!(scale, ScaleMass::Factor(factor) if factor < 1.0) {
        return draft.report(
            Diagnostic::error("MASS SCALING: a factor below 1 would take mass away")
                .at(card.place("value"), "the factor on the mass is at least 1")
                .help("a lighter block has a smaller density in its MATERIAL"),
        );
    }
    draft.model.mass_scalings.push(MassScaling {
        block: card.maybe_integer("block"),
        scale,
        limit: card.number("limit"),
    });
}

fn bulk_viscosity(card: &Card, draft: &mut Draft) {
    draft.model.bulk_viscosity = BulkViscosity { linear: card.number("linear"), quadratic: card.number("quadratic") };
}

/// HOURGLASS STIFFENING gives coefficients of the one formulation, HOURGLASS CONTROL chooses between two; either may
/// come first.
fn hourglass(card: &Card, draft: &mut Draft) {
    let stiffening = draft.deck.cards_of("HOURGLASS STIFFENING").next();
    let control = draft.deck.cards_of("HOURGLASS CONTROL").next();
    let factor = control.map_or(1.0, |c| c.number("factor"));
    let assumed_strain = control.is_some_and(|c| c.text("kind") == "ASSUMED STRAIN");
    if assumed_strain {
        draft.model.hourglass = Hourglass::AssumedStrain { factor };
    } else {
        let defaults = language().entry("HOURGLASS STIFFENING").map(|e| e.default_card()).unwrap_or_default();
        let given = stiffening.unwrap_or(&defaults);
        draft.model.hourglass = Hourglass::FlanaganBelytschko {
            stiffness: factor * given.number("stiffness"),
            viscosity: given.number("viscosity"),
        };
    }
    if let (true, Some(stiffening), Some(control)) = (assumed_strain, stiffening, control)
        && card == control
    {
        draft.report(
            Diagnostic::error("HOURGLASS STIFFENING has no meaning with ASSUMED STRAIN hourglass control")
                .at(stiffening.record, "these coefficients are those of FLANAGAN BELYTSCHKO")
                .at(control.record, "but this chooses another formulation")
                .help("take one of the two lines out"),
        );
    }
}
