//! The truss alone: what must hold for any motion and law.

use super::{Truss, rows, smallest_rotation};
use crate::common::vector::{cross, dot};
use crate::lanes::{Force, Row};
use crate::material::{Elastic, ElasticPlastic, Law};
use crate::solver::elements::structural::BAR_STEP;
use crate::solver::elements::{Element, ElementBlock, PassOutcome, PassSettings, Sink, by_hand};

const YOUNG: f64 = 200e9;
const DENSITY: f64 = 8000.0;
const AREA: f64 = 2e-4;
const STEEL: Law = Law::Elastic(Elastic { young: YOUNG, poisson: 0.3 });

/// One truss whose two nodes are moved by hand.
struct Rig {
    block: ElementBlock,
    nodes: Vec<Row>,
    forces: Vec<Force>,
    settings: PassSettings,
}

impl Rig {
    fn new(ends: [[f64; 3]; 2], law: Law) -> Rig {
        let element = Element::Truss(Truss { area: Some(AREA) });
        let length = (0..3).map(|i| (ends[1][i] - ends[0][i]).powi(2)).sum::<f64>().sqrt();
        let new = by_hand::single(&[0, 1], &ends, DENSITY * AREA * length);
        let block = by_hand::block(&element, &law, DENSITY, &[new]);
        let nodes = ends.map(by_hand::at_rest).to_vec();
        Rig { block, nodes, forces: vec![Force::default(); 2], settings: by_hand::settings() }
    }

    /// Moves both nodes to places in a step of one second.
    fn step_to(&mut self, ends: [[f64; 3]; 2]) -> PassOutcome {
        for (row, end) in self.nodes.iter_mut().zip(ends) {
            (0..3).for_each(|i| (row.0[4 + i], row.0[i]) = (end[i] - row.0[i], end[i]));
        }
        self.forces.fill(Force::default());
        self.settings.time_step = 1.0;
        let sink = Sink::Nodes { forces: &mut self.forces, border: &[] };
        self.block.run(&self.nodes, &[], sink, &self.settings)
    }

    fn state(&self, row: usize) -> f64 {
        self.block.interior.value(0, row)
    }
}

fn close(what: &str, a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{what}: {a:e} instead of {b:e}");
}

/// Turned by a radian a step and moved, a truss under tension keeps its stress, and the forces follow it.
#[test]
fn rigid_motion_leaves_the_stress_alone() {
    let mut rig = Rig::new([[0.0; 3], [1.0, 0.0, 0.0]], STEEL);
    rig.step_to([[0.0; 3], [1.001, 0.0, 0.0]]);
    let tension = rig.state(rows::STRESS);
    close("tension", tension, YOUNG * 1e-3, YOUNG * 1e-6);
    for step in 1..=50 {
        let (angle, drift) = (f64::from(step), 10.0 * f64::from(step));
        let at = |r: f64| [drift + r * angle.cos(), r * angle.sin(), -drift];
        rig.step_to([at(0.0), at(1.001)]);
        close("stress", rig.state(rows::STRESS), tension, 1e-9 * tension);
        let force = &rig.forces[0].0;
        let pull = force[0] * angle.cos() + force[1] * angle.sin();
        close("force on the first node", pull, tension * AREA, 1e-3 * tension * AREA);
    }
}

/// A truss that has not turned has the rotation 1, wherever it lies; turned in a plane by any angle, that angle's, half a turn included.
#[test]
fn turns_by_the_smallest_rotation() {
    for along in [[1.0, 0.0, 0.0], [0.0, 0.0, 2.0], [-0.3, 0.2, -0.7]] {
        let r = smallest_rotation(along, along);
        (0..9).for_each(|k| close("at rest", r[k / 3][k % 3], if k % 4 == 0 { 1.0 } else { 0.0 }, 1e-15));
    }
    for angle in [0.1, 1.0, 3.0, 3.2, 6.0] {
        let (c, s) = (f64::cos(angle), f64::sin(angle));
        let r = smallest_rotation([2.0, 0.0, 0.0], [3.0 * c, 3.0 * s, 0.0]);
        let expected = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]];
        (0..9).for_each(|k| close("turned", r[k / 3][k % 3], expected[k / 3][k % 3], 1e-12));
    }
    let r = smallest_rotation([0.0, 1.0, 0.0], [0.0, -1.0, 0.0]);
    close("half a turn", dot(r[0], cross(r[1], r[2])), 1.0, 1e-15);
    close("its direction", r[1][1], -1.0, 1e-15);
}

/// ν of contraction in tension: the area shrinks by exp(−2νε); the stress across is nothing.
#[test]
fn the_area_follows_the_strain_across() {
    let mut rig = Rig::new([[0.0; 3], [0.0, 0.0, 2.0]], STEEL);
    for step in 1..=10 {
        rig.step_to([[0.0; 3], [0.0, 0.0, 2.0 + 2e-3 * f64::from(step)]]);
    }
    let strain = libm::log(1.01);
    close("strain across", rig.state(rows::LATERAL), -0.3 * strain, 1e-6 * strain);
    assert!(rig.state(rows::ACROSS).abs() < 1e-9 * YOUNG);
    let force = AREA * libm::exp(-0.6 * strain) * YOUNG * strain;
    close("force", -rig.forces[1].0[2], force, 1e-6 * force);
    // Loaded and let go along one stretch, nothing is kept.
    for step in (0..10).rev() {
        rig.step_to([[0.0; 3], [0.0, 0.0, 2.0 + 2e-3 * f64::from(step)]]);
    }
    let most = 0.5 * force * 0.02;
    close("energy", rig.state(rows::INTERNAL_ENERGY), 0.0, 1e-9 * most);
}

/// Yield in uniaxial stress is at the yield stress itself, and stays there; across it is nothing.
#[test]
fn flows_at_the_yield_stress() {
    let law = ElasticPlastic { young: YOUNG, poisson: 0.3, yield_stress: 400e6, hardening: 0.0, beta: 1.0 };
    let mut rig = Rig::new([[0.0; 3], [1.0, 0.0, 0.0]], Law::ElasticPlastic(law));
    for step in 1..=100 {
        let stretch = 0.01 * (f64::from(step) * 0.07).sin();
        rig.step_to([[0.0; 3], [1.0 + stretch, 0.0, 0.0]]);
        assert!(rig.state(rows::STRESS).abs() < 400e6 * 1.001, "{}", rig.state(rows::STRESS));
        assert!(rig.state(rows::ACROSS).abs() < 400e6 * 1e-3, "{}", rig.state(rows::ACROSS));
    }
    // At the end it is squeezed, well beyond yield.
    close("stress", rig.state(rows::STRESS), 400e6, 400e6 * 1e-3);
}

/// √(M/k) is what the two masses need: 2/ω with ω² = 4 k/M.
#[test]
fn the_stable_step_is_length_over_bar_speed() {
    let mut rig = Rig::new([[0.0; 3], [0.5, 0.0, 0.0]], STEEL);
    let found = rig.step_to([[0.0; 3], [0.5, 0.0, 0.0]]);
    close("step", found.stable_step, BAR_STEP * 0.5 / (YOUNG / DENSITY).sqrt(), 1e-12);
    assert_eq!(found.failed, None);
    let found = rig.step_to([[0.0; 3], [0.0; 3]]);
    assert_eq!(found.failed, Some(0));
}

#[test]
fn the_page_on_adding_an_element_shows_what_is_built() {
    let page = include_str!("../../../../../docs/adding-an-element.md");
    for file in [include_str!("mod.rs"), include_str!("truss.cards")] {
        assert!(page.contains(file), "docs/adding-an-element.md is stale");
    }
}
