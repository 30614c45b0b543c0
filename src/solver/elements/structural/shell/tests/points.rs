//! Points through the thickness: plane stress, moments, what DEATH takes.

use super::rig::{Rig, STEEL, close};
use crate::material::{ElasticPlastic, Law};
use crate::model::BulkViscosity;
use crate::solver::elements::shell::{QUADRILATERAL, point_rows, rows, rule::Rule};

const YIELD: f64 = 400e6;
const PLASTIC: Law =
    Law::ElasticPlastic(ElasticPlastic { young: 200e9, poisson: 0.3, yield_stress: YIELD, hardening: 0.0, beta: 1.0 });

/// V-19: bent to fifty times the curvature of first yield, the moment over σ t²/4 is what the rule makes of it. In one direction
/// only, with the strain across held: the yield stress is that of plane strain, 2/√3 Y.
#[test]
fn v19_fully_plastic_moment() {
    let cases: [(Rule, &[(usize, f64)]); 2] = [
        (Rule::Gauss, &[(2, 1.155), (3, 0.861), (4, 1.043), (5, 0.945), (7, 0.971), (9, 0.982)]),
        (Rule::Lobatto, &[(3, 0.667), (4, 1.079), (5, 0.913), (7, 0.960), (9, 0.977)]),
    ];
    for (rule, counts) in cases {
        for &(count, expected) in counts {
            let mut rig = Rig::new(PLASTIC, rule.points(count), 0.01);
            // First yield in plane strain.
            let first = YIELD / 200e9 / 0.005;
            rig.bend(50.0 * first, 400);
            let moment = rig.state(QUADRILATERAL.resultants + 3) / (2.0 / 3f64.sqrt() * YIELD * 1e-4 / 4.0);
            let thinner = (rig.state(rows::THICKNESS) / 0.01).powi(2);
            close(&format!("{rule:?} {count}"), moment / thinner, expected, 2e-3 * expected + 6e-4);
        }
    }
}

/// Stretched and bent while elastic: plane stress, and a thickness that shrinks by ν/(1 − ν) of the strains.
#[test]
fn elastic_stress_thickness_and_moment() {
    let mut rig = Rig::new(STEEL, Rule::Gauss.points(3), 0.01);
    rig.stretch(1e-4, 10);
    let modulus = 200e9 / (1.0 - 0.09);
    close("σ_xx", rig.point(1, point_rows::XX), modulus * 1e-4, modulus * 1e-8);
    close("σ_yy", rig.point(1, point_rows::YY), 0.3 * modulus * 1e-4, modulus * 1e-8);
    close("σ_zz", rig.point(1, point_rows::LEFT), 0.0, 1.0);
    close("thickness", rig.state(rows::THICKNESS) / 0.01 - 1.0, -0.3 / 0.7 * 1e-4, 1e-8);
    let work = 0.5 * modulus * 1e-8 * 0.01;
    close("energy", rig.state(QUADRILATERAL.internal_energy), work, 2e-3 * work);
    let mut rig = Rig::new(STEEL, Rule::Gauss.points(3), 0.01);
    rig.bend(0.01, 10);
    let stiffness = modulus * 1e-6 / 12.0;
    close("moment", rig.state(QUADRILATERAL.resultants + 3), stiffness * 0.01, 1e-3 * stiffness * 0.01);
    close("moment across", rig.state(QUADRILATERAL.resultants + 4), 0.3 * stiffness * 0.01, 1e-3 * stiffness * 0.01);
}

/// A point that is lost carries nothing any more; the others go on.
#[test]
fn lost_points_carry_nothing() {
    let mut rig = Rig::new(STEEL, Rule::Gauss.points(5), 0.01);
    rig.stretch(1e-4, 10);
    let before = rig.state(QUADRILATERAL.resultants);
    for point in 1..5 {
        rig.lose(point);
    }
    rig.stretch(0.0, 1);
    let share = 0.5 * Rule::Gauss.points(5)[0][1];
    close("force", rig.state(QUADRILATERAL.resultants), share * before, 1e-3 * before);
    assert_eq!(rig.point(2, point_rows::XX), 0.0);
    assert!(rig.outcome.failed.is_none() && rig.outcome.stable_step > 0.0);
}

/// Turned by half a radian a step in its plane and in space, a stretched shell keeps its stress and its energy.
#[test]
fn rigid_motion_leaves_the_stress_alone() {
    let mut rig = Rig::new(STEEL, Rule::Gauss.points(5), 0.01);
    rig.stretch(1e-4, 10);
    let stress = rig.point(0, point_rows::XX);
    let energy = rig.state(QUADRILATERAL.internal_energy);
    for axis in [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.6, 0.0, 0.8]] {
        for _ in 0..20 {
            rig.turn(axis, 0.01);
        }
        close("stress", rig.point(0, point_rows::XX), stress, 2e-4 * stress);
        close("energy", rig.state(QUADRILATERAL.internal_energy), energy, 1e-3 * energy);
    }
}

/// Bulk viscosity is b₁ E/(1 − ν²) Δt̂ times the rate of area while the shell is elastic; it vanishes in plastic flow at a constant
/// stress, which changes the area all the same, and is whole again when the shell unloads.
#[test]
fn bulk_viscosity_follows_the_elastic_part_of_the_rate_of_area() {
    let mut rig = Rig::new(PLASTIC, Rule::Gauss.points(3), 0.01);
    rig.settings.bulk_viscosity = BulkViscosity { linear: 0.06, quadratic: 1.2 };
    let mut part_of_whole = |strain: f64, steps: usize| {
        rig.stretch(strain * (steps - 1) as f64 / steps as f64, steps - 1);
        let (length, bound) = (rig.nodes[1].0[0], rig.state(rows::STEP));
        let growth = strain / steps as f64;
        rig.stretch(growth, 1);
        let rate = growth / (length + 0.5 * growth);
        rig.state(QUADRILATERAL.viscous_stress) / (0.06 * 200e9 / (1.0 - 0.09) * bound * rate)
    };
    close("elastic", part_of_whole(1e-3, 10), 1.0, 1e-6);
    close("plastic", part_of_whole(0.05, 500), 0.0, 1e-3);
    close("unloading", part_of_whole(-1e-4, 2), 1.0, 1e-6);
}
