//! What the blocks of a mesh would cost in a run, tried out.

use crate::solver::elements::{ElementBlock, Sink};
use crate::solver::{Domain, Solver};
use std::time::Instant;

/// A block by itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockTrial {
    /// Index of the block in the mesh.
    pub index: usize,
    /// Largest stable step of its elements, a time.
    pub stable_step: f64,
    /// Seconds of the fastest pass over its elements.
    pub seconds: f64,
}

impl Solver {
    /// Lets every block by itself go over its elements `passes` times, as it would in a step, in the order of the blocks. For one
    /// rank that wants to know what a run would cost: the elements have gone on afterwards, and nothing else has.
    pub fn try_blocks(&mut self, passes: u32) -> Vec<BlockTrial> {
        let Domain { blocks, nodes, .. } = &mut self.domain;
        let mut forces = nodes.forces.clone();
        let trial = |block: &mut ElementBlock| {
            let mut trial = BlockTrial { index: block.index, stable_step: f64::INFINITY, seconds: f64::INFINITY };
            for _ in 0..passes {
                let begun = Instant::now();
                let found = block.run(
                    &nodes.rows,
                    &nodes.rates.means,
                    Sink::Nodes { forces: &mut forces, border: &[] },
                    &self.pass,
                );
                trial.seconds = trial.seconds.min(begun.elapsed().as_secs_f64());
                trial.stable_step = trial.stable_step.min(found.stable_step);
            }
            trial
        };
        blocks.iter_mut().map(trial).collect()
    }
}
