//! Points of integration that fail before their element goes.
//!
//! In an element with several points a rule on stress or state is one on each point: what has passed the value carries nothing
//! any more, and the element goes when as large a part of its points has.

use super::{Erosion, has_passed};
use crate::model::{Death, DeathVariable};
use crate::solver::elements::fields::{point_state, point_values};
use crate::solver::elements::{ElementBlock, Group};
use crate::solver::nodes::Nodes;

/// Whether a rule is one on each point of a block's elements.
pub(super) fn is_of_points(rule: &Death, block: &ElementBlock) -> bool {
    let differs = match &rule.variable {
        DeathVariable::State(_) => true,
        DeathVariable::Field(field, _) => field.of_points(),
        DeathVariable::Volume | DeathVariable::TimeStep => false,
    };
    differs && block.element.entry().points.is_some()
}

impl Erosion {
    /// Lets points that have passed the value of a rule carry nothing any more; returns the elements of which as many have as
    /// their rule asks for, in no order.
    pub(super) fn lose_points(
        block: &mut ElementBlock,
        at_border: bool,
        rules: &[&Death],
        nodes: &Nodes,
    ) -> Vec<usize> {
        let mut failed = Vec::new();
        let points = block.element.points();
        for &rule in rules {
            if !is_of_points(rule, block) {
                continue;
            }
            let group = if at_border { &block.border } else { &block.interior };
            let mut lost = Vec::new();
            for i in (0..group.len()).filter(|&i| group.is_alive(i)) {
                let mut gone = 0;
                for point in 0..points {
                    if block.is_lost(group, i, point) {
                        gone += 1;
                    } else if has_passed(rule, value(rule, block, group, (i, point), nodes)) {
                        lost.push((i, point));
                        gone += 1;
                    }
                }
                if gone as f64 >= rule.share * points as f64 {
                    failed.push(i);
                }
            }
            let row = |point: usize| {
                block.first_of_point(point) + block.element.entry().points.as_ref().map_or(0, |p| p.lost)
            };
            let rows: Vec<(usize, usize)> = lost.into_iter().map(|(i, point)| (i, row(point))).collect();
            let group = if at_border { &mut block.border } else { &mut block.interior };
            rows.into_iter().for_each(|(i, row)| group.set_value(i, row, 1.0));
        }
        failed
    }
}

/// The variable of a rule at a point; zero where the law has none of that name.
fn value(rule: &Death, block: &ElementBlock, group: &Group, (i, point): (usize, usize), nodes: &Nodes) -> f64 {
    match &rule.variable {
        DeathVariable::State(name) => match block.state_names.iter().position(|stored| stored == name) {
            Some(row) => group.value(i, block.first_of_law(point) + row),
            None => {
                let place = block.law.entry().state.iter().position(|variable| variable.name == name);
                place.map_or(0.0, |place| point_state(block, group, i, point, nodes)[place])
            }
        },
        DeathVariable::Field(field, component) => point_values(*field, block, group, i, point, nodes)[*component],
        DeathVariable::Volume | DeathVariable::TimeStep => f64::NAN,
    }
}
