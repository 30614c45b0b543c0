//! Where plot states go: gathered into one file by rank 0, or into a piece by each rank. States to go on from are
//! gathered in either case.

use super::RunError;
use crate::comm::Communicator;
use crate::exodus::pieces::piece_path;
use crate::exodus::{ResultsError, ResultsHeader, ResultsWriter, StateWriter};
use crate::mesh::Dimension;
use crate::output::{self, Collector, FieldList, Split, block_energies, global_values};
use crate::partition::Share;
use crate::restart::Snapshot;
use crate::solver::{Body, Solver, Totals};
use std::path::Path;

use super::Job;

/// The plot file, or this rank's piece of it; closed on ranks that do not write.
pub struct Plots {
    file: Option<ResultsWriter>,
    /// Brings values together; there is none when nothing is gathered.
    collector: Option<Collector>,
    /// Puts values into this rank's piece; there is none when plot states are gathered.
    split: Option<Split>,
    /// Number of blocks whose energies are among the global variables.
    blocks: usize,
    dimension: Dimension,
}

impl Plots {
    /// Learns what goes where. All ranks call it.
    pub fn new(job: &Job, solver: &Solver, (body, share): (&Body, &Share), comm: &mut dyn Communicator) -> Plots {
        let (nodes, elements) = (job.mesh.coordinates.len(), job.mesh.element_count());
        let gathers = !job.split || job.model.restarts.write.is_some();
        Plots {
            file: None,
            collector: gathers.then(|| Collector::new(solver, nodes, elements, comm)),
            blocks: if job.model.plot_requests.block_energies { job.mesh.blocks.len() } else { 0 },
            dimension: job.mesh.dimension,
            split: job.split.then(|| Split::new(job.mesh, body, share, comm)),
        }
    }

    /// Opens the file of this rank, if it writes one.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn open(&mut self, path: &Path, header: &ResultsHeader, rank: usize) -> Result<(), RunError> {
        self.file = match self.split.as_ref().map(|split| &split.piece) {
            Some(piece) => Some(ResultsWriter::create_piece(&piece_path(path, piece.ranks, rank), header, piece)?),
            None if rank == 0 => Some(ResultsWriter::create(path, header)?),
            None => None,
        };
        Ok(())
    }

    /// Number of states written by this rank.
    pub fn states(&self) -> usize {
        self.file.as_ref().map_or(0, ResultsWriter::states)
    }

    /// Makes sure that the file of this rank is still there.
    ///
    /// # Errors
    /// When it is not.
    pub fn in_place(&self) -> Result<(), RunError> {
        self.file.as_ref().map_or(Ok(()), |file| Ok(file.in_place()?))
    }

    /// Appends a state. All ranks call it.
    ///
    /// # Errors
    /// When this rank cannot write.
    pub fn write(
        &mut self,
        solver: &mut Solver,
        fields: &FieldList,
        totals: &Totals,
        comm: &mut dyn Communicator,
    ) -> Result<(), RunError> {
        fields.prepare(solver, comm);
        let solver = &*solver;
        let mut globals = global_values(solver, totals, self.dimension);
        if self.blocks > 0 {
            globals.extend(block_energies(self.blocks, solver, comm));
        }
        let Plots { file, split, collector, .. } = self;
        let mut state = Appended(file.as_mut().map(|file| file.begin_state(solver.time, &globals)));
        // One variable after the other: all at once would be as much as half of what the elements store.
        let nodal = fields.nodal(solver);
        for own in (0..nodal.len()).map(|variable| nodal.of(variable)) {
            state.put(match (&mut *split, &*collector) {
                (Some(split), _) => Some(split.nodal(&own, 1, comm)),
                (None, Some(collector)) => collector.nodal(own, 1, comm),
                (None, None) => None,
            });
        }
        for part in fields.element_parts() {
            let (own, variables) = (part.element_values(solver, comm.rank()), part.element_names().len());
            state.put(match (&mut *split, &*collector) {
                (Some(split), _) => Some(split.element(&own, variables)),
                (None, Some(collector)) => collector.element(own, variables, comm),
                (None, None) => None,
            });
        }
        state.finish()
    }

    /// The state between two steps, on rank 0; `None` on the others, and when the run asks for none. All ranks call it.
    pub fn snapshot(&self, solver: &mut Solver, comm: &mut dyn Communicator) -> Option<Snapshot> {
        self.collector.as_ref().and_then(|collector| output::snapshot(solver, collector, comm))
    }
}

/// A state of this rank's file, or why it cannot be written; nothing on ranks that do not write. Collecting goes on all the same:
/// the other ranks take part in it.
struct Appended<'a>(Option<Result<StateWriter<'a>, ResultsError>>);

impl Appended<'_> {
    fn put(&mut self, arrays: Option<Vec<Vec<f64>>>) {
        if let Some(Ok(state)) = &mut self.0
            && let Err(error) = arrays.iter().flatten().try_for_each(|values| state.put(values))
        {
            self.0 = Some(Err(error));
        }
    }

    fn finish(self) -> Result<(), RunError> {
        match self.0 {
            Some(state) => Ok(state?.finish()?),
            None => Ok(()),
        }
    }
}
