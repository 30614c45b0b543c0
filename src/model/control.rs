//! Title, times, time step, hourglass control, bulk viscosity.

use super::{
    Analysis, BulkViscosity, Hourglass, MassScaling, Precision, ScaleMass, StepEstimate, StepModuli,
    problem::{Draft, Setter},
};
use crate::deck::{Card, Diagnostic, language};

pub(super) const COMMANDS: &[Setter] = &[
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
