//! Runs that are interrupted and continued, in memory, against runs that never stopped.

use super::run::model;
use urto::comm::{Communicator, run_threads};
use urto::mesh::{Dimension, Mesh};
use urto::model::Model;
use urto::output::{Collector, FieldList, global_values, snapshot};
use urto::restart::Snapshot;
use urto::solver::{Body, Request, Solver};

/// A deck on a mesh, ready to be run in parts.
pub struct Case {
    pub mesh: Mesh,
    pub model: Model,
    pub body: Body,
}

/// A part of a run: what it leaves, and what it shows on the way.
pub struct Part {
    /// The state between the last step taken and the next.
    pub end: Snapshot,
    /// Steps taken, time, time step and global values of each state of the way, as bits.
    pub way: Vec<Vec<u64>>,
    /// All plot fields of the last prepared state, as bits.
    pub shown: Vec<u64>,
}

impl Case {
    #[track_caller]
    pub fn new(deck: &str, mesh: Mesh) -> Case {
        let model = model(deck, &mesh);
        let body = Body::new(&mesh, &model).expect("materials");
        Case { mesh, model, body }
    }

    /// Takes steps on so many ranks, from the beginning or from a state.
    #[track_caller]
    pub fn part(&self, ranks: usize, from: Option<&Snapshot>, steps: usize) -> Part {
        let cut = self.body.cut(ranks);
        let contributors = self.body.contributors(&cut);
        let decomposition = self.body.decomposition(&contributors, ranks);
        let parts = run_threads(ranks, |comm| {
            let share = decomposition.share(comm.rank());
            let mut solver = Solver::new(&self.mesh, &self.model, &self.body, &share, comm);
            if let Some(from) = from {
                solver.restore(from, comm).map_err(|missing| format!("missing: {missing:?}"))?;
            }
            self.steps(&mut solver, steps, comm)
        });
        let parts = parts.unwrap_or_else(|e| panic!("{e}"));
        parts.into_iter().flatten().next().expect("rank 0 has something to show")
    }

    fn steps(&self, solver: &mut Solver, steps: usize, comm: &mut dyn Communicator) -> Result<Option<Part>, String> {
        let fields = FieldList::new(&self.model, solver);
        let collector = Collector::new(solver, self.mesh.coordinates.len(), self.mesh.element_count(), comm);
        let (mut way, mut shown) = (Vec::new(), Vec::new());
        for step in 0..steps {
            solver.prepare(Request::Continue, comm).map_err(|stop| stop.to_string())?;
            let totals = solver.totals(comm);
            let numbers =
                [vec![solver.time, solver.time_step], global_values(solver, &totals, Dimension::Three)].concat();
            way.push(bits(&numbers));
            if step + 1 == steps {
                let (nodal, element) = (fields.nodal_names().len(), fields.element_names().len());
                let nodal = collector.nodal(fields.nodal_values(solver, comm), nodal, comm).unwrap_or_default();
                // Who computes an element is of no account.
                let element = collector.element(fields.element_values(solver, 0), element, comm).unwrap_or_default();
                shown = bits(&[nodal.concat(), element.concat()].concat());
            }
            solver.advance();
        }
        Ok(snapshot(solver, &collector, comm).map(|end| Part { end, way, shown }))
    }
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

/// Names of what differs between two states, but the number of searches: a continued run begins with one.
pub fn differences(a: &Snapshot, b: &Snapshot) -> Vec<String> {
    let arrays = |s: &Snapshot| -> Vec<(String, Vec<u64>)> {
        let numbers = s.numbers.iter().filter(|(name, _)| name != "CONTSEARCHES");
        let numbers = numbers.map(|(name, value)| (name.clone(), bits(&[*value])));
        let places = s.nodal.iter().chain(&s.element).map(|(name, values)| (name.clone(), bits(values)));
        let lists = s.lists.iter().map(|list| (list.name.clone(), bits(&list.values)));
        numbers.chain(places).chain(lists).collect()
    };
    let (a, b) = (arrays(a), arrays(b));
    let name = |(name, _): &(String, Vec<u64>)| name.clone();
    let missing = |a: &[(String, Vec<u64>)], b: &[(String, Vec<u64>)]| -> Vec<String> {
        a.iter().filter(|one| !b.contains(one)).map(name).collect()
    };
    [missing(&a, &b), missing(&b, &a)].concat()
}

/// Asserts that the second part of a whole run and a continued one are the same to the bit.
#[track_caller]
pub fn assert_same(what: &str, whole: &Part, continued: &Part) {
    let tail = &whole.way[whole.way.len() - continued.way.len()..];
    let parted = tail.iter().zip(&continued.way).position(|(a, b)| a != b);
    assert_eq!(parted, None, "{what}: time, step and totals differ from this step on");
    let differ = differences(&whole.end, &continued.end);
    assert!(differ.is_empty(), "{what}: these differ at the end: {differ:?}");
    assert!(whole.shown == continued.shown, "{what}: plot fields differ at the end");
}
