//! What a scene did not need, and what it lacked, from what its run saw.
//!
//! Everything here is asked once, after the last state: a part looks at what the solver and the log have gathered anyway, and
//! gives [`Advice`]. What it promises, tests hold against a run of the advised deck.

mod blocks;
mod contact;
mod foretell;
mod joints;
mod sampling;
mod steps;
mod walls;

use crate::comm::Communicator;
use crate::mesh::Mesh;
use crate::model::Model;
use crate::solver::{Section, Solver};

pub use foretell::foretold;
pub use joints::words as on_joints;

/// What is known of a run at its end.
pub struct Scene<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// What was simulated.
    pub model: &'a Model,
    /// The solver after its last state.
    pub solver: &'a Solver,
    /// Time and kinetic energy of each line of the log.
    pub lines: &'a [[f64; 2]],
    /// Times of the plot states.
    pub states: &'a [f64],
    /// Whether the run began from a restart: nobody has seen its beginning.
    pub continued: bool,
    /// Nodes that were moved out of overlaps of the mesh before it began.
    pub moved: usize,
}

/// What the advised deck keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Promise {
    /// All results, to the bit.
    Bits,
    /// All results but for round-off.
    Digits,
    /// Nothing: it is another model, or another place to look at.
    Nothing,
}

/// Something that the scene did not need, or lacked.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// Whether the scene lacked it, rather than having had no need of it.
    pub lacked: bool,
    /// What was seen.
    pub words: String,
    /// The command that would say so, or what else to do.
    pub instead: String,
    /// What stays the same then.
    pub promise: Promise,
    /// The section of the step whose time this is about, and the part of its work that it is.
    pub cost: Option<(Section, f64)>,
}

impl Advice {
    fn spare(words: String, instead: String, promise: Promise, cost: Option<(Section, f64)>) -> Advice {
        Advice { lacked: false, words, instead, promise, cost }
    }

    fn lack(words: String, instead: String) -> Advice {
        Advice { lacked: true, words, instead, promise: Promise::Nothing, cost: None }
    }

    /// What stays the same, in words.
    pub fn kept(&self) -> &'static str {
        match self.promise {
            Promise::Bits => "the same bits",
            Promise::Digits => "the same digits",
            Promise::Nothing => "",
        }
    }
}

/// What one file knows to look at.
type Part = fn(&Scene, &mut dyn Communicator) -> Vec<Advice>;

/// All advice. All ranks call it and get the same.
pub fn of_scene(scene: &Scene, comm: &mut dyn Communicator) -> Vec<Advice> {
    let parts: [Part; 6] =
        [blocks::advice, contact::advice, steps::advice, joints::advice, sampling::advice, walls::advice];
    parts.iter().flat_map(|part| part(scene, comm)).collect()
}
