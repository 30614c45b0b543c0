//! The whole state of a run on rank 0, in file order.

use super::Collector;
use crate::comm::Communicator;
use crate::restart::{Archive, List, Snapshot, sort_rows};
use crate::solver::Solver;

/// An archive that is written: brings the shares of all ranks together.
struct Saver<'a> {
    collector: &'a Collector,
    owned: Vec<bool>,
    snapshot: Snapshot,
    comm: &'a mut dyn Communicator,
}

/// The state between two steps, on rank 0; `None` on the others. All ranks call it.
pub fn snapshot(solver: &mut Solver, collector: &Collector, comm: &mut dyn Communicator) -> Option<Snapshot> {
    let owned = solver.domain.nodes.owned.clone();
    let mut saver = Saver { collector, owned, snapshot: Snapshot::default(), comm };
    solver.visit_state(&mut saver);
    let Saver { snapshot, comm, .. } = saver;
    (comm.rank() == 0).then_some(snapshot)
}

impl Archive for Saver<'_> {
    fn loading(&self) -> bool {
        false
    }

    fn number(&mut self, name: &str, value: &mut f64) {
        self.snapshot.numbers.push((name.to_string(), *value));
    }

    fn nodal(&mut self, name: &str, values: &mut [f64]) {
        let own = values.iter().zip(&self.owned).filter(|(_, owned)| **owned).map(|(value, _)| *value).collect();
        if let Some(whole) = self.collector.nodal(own, 1, self.comm) {
            self.snapshot.nodal.extend(whole.into_iter().map(|values| (name.to_string(), values)));
        }
    }

    fn element(&mut self, name: &str, values: &mut [f64]) {
        if let Some(whole) = self.collector.element(values.to_vec(), 1, self.comm) {
            self.snapshot.element.extend(whole.into_iter().map(|values| (name.to_string(), values)));
        }
    }

    fn list(&mut self, name: &str, width: usize, rows: &mut Vec<f64>) {
        let bytes = rows.iter().flat_map(|value| value.to_ne_bytes()).collect();
        let Some(parts) = self.comm.gather(bytes) else { return };
        let numbers = parts.iter().flat_map(|part| part.chunks_exact(8));
        let mut values: Vec<f64> = numbers.map(|b| f64::from_ne_bytes(b.try_into().unwrap_or_default())).collect();
        sort_rows(width, &mut values);
        if !values.is_empty() {
            self.snapshot.lists.push(List { name: name.to_string(), width, values });
        }
    }

    fn comm(&mut self) -> &mut dyn Communicator {
        self.comm
    }
}
