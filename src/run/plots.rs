//! Where plot states go: gathered into one file by rank 0, or into a piece by each rank. States to go on from are
//! gathered in either case.

use super::RunError;
use crate::comm::Communicator;
use crate::exodus::pieces::piece_path;
use crate::exodus::{ResultsHeader, ResultsWriter};
use crate::mesh::Dimension;
use crate::output::{self, Collector, FieldList, Split, block_energies, global_values};
use crate::partition::Share;
use crate::restart::Snapshot;
use crate::solver::{Solver, Totals};
use std::path::Path;

use super::Job;

/// The plot file, or this rank's piece of it; closed on ranks that do not write.
pub struct Plots {
    file: Option<ResultsWriter>,
    /// Numbers of nodal and element variables.
    variables: [usize; 2],
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
    pub fn new(job: &Job, solver: &Solver, share: &Share, variables: [usize; 2], comm: &mut dyn Communicator) -> Plots {
        let (nodes, elements) = (job.mesh.coordinates.len(), job.mesh.element_count());
        let gathers = !job.split || job.model.restarts.write.is_some();
        Plots {
            file: None,
            variables,
            collector: gathers.then(|| Collector::new(solver, nodes, elements, comm)),
            blocks: if job.model.plot_requests.block_energies { job.mesh.blocks.len() } else { 0 },
            dimension: job.mesh.dimension,
            split: job.split.then(|| Split::new(job.mesh, job.body, share, comm)),
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
        let [nodal, element] = [fields.nodal_values(solver, comm), fields.element_values(solver, comm.rank())];
        let mut globals = global_values(solver, totals, self.dimension);
        if self.blocks > 0 {
            globals.extend(block_energies(self.blocks, solver, comm));
        }
        let [nodal_count, element_count] = self.variables;
        let values = match (&mut self.split, &self.collector) {
            (Some(split), _) => Some((split.nodal(&nodal, nodal_count, comm), split.element(&element, element_count))),
            (None, Some(collector)) => {
                let nodal = collector.nodal(nodal, nodal_count, comm);
                nodal.zip(collector.element(element, element_count, comm))
            }
            (None, None) => None,
        };
        match (&mut self.file, values) {
            (Some(file), Some((nodal, element))) => Ok(file.write_state(solver.time, &globals, &nodal, &element)?),
            _ => Ok(()),
        }
    }

    /// The state between two steps, on rank 0; `None` on the others, and when the run asks for none. All ranks call it.
    pub fn snapshot(&self, solver: &mut Solver, comm: &mut dyn Communicator) -> Option<Snapshot> {
        self.collector.as_ref().and_then(|collector| output::snapshot(solver, collector, comm))
    }
}
