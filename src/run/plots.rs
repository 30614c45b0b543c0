//! Where plot states go: gathered into one file by rank 0, or into a piece by each rank.

use super::RunError;
use crate::comm::Communicator;
use crate::exodus::pieces::piece_path;
use crate::exodus::{ResultsHeader, ResultsWriter};
use crate::output::{Collector, FieldList, Split, global_values};
use crate::partition::Share;
use crate::solver::{Solver, Totals};
use std::path::Path;

use super::Job;

/// The plot file, or this rank's piece of it; closed on ranks that do not write.
pub struct Plots {
    file: Option<ResultsWriter>,
    /// Numbers of nodal and element variables.
    variables: [usize; 2],
    way: Way,
}

enum Way {
    Gathered(Collector),
    Split(Box<Split>),
}

impl Plots {
    /// Learns what goes where. All ranks call it.
    pub fn new(job: &Job, solver: &Solver, share: &Share, variables: [usize; 2], comm: &mut dyn Communicator) -> Plots {
        let (nodes, elements) = (job.mesh.coordinates.len(), job.mesh.element_count());
        let way = if job.split {
            Way::Split(Box::new(Split::new(job.mesh, job.body, share, comm.size())))
        } else {
            Way::Gathered(Collector::new(solver, nodes, elements, comm))
        };
        Plots { file: None, variables, way }
    }

    /// Opens the file of this rank, if it writes one.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn open(&mut self, path: &Path, header: &ResultsHeader, rank: usize) -> Result<(), RunError> {
        self.file = match &self.way {
            Way::Gathered(_) if rank == 0 => Some(ResultsWriter::create(path, header)?),
            Way::Gathered(_) => None,
            Way::Split(split) => {
                let piece = &split.piece;
                Some(ResultsWriter::create_piece(&piece_path(path, piece.ranks, rank), header, piece)?)
            }
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
        solver: &Solver,
        fields: &FieldList,
        totals: &Totals,
        comm: &mut dyn Communicator,
    ) -> Result<(), RunError> {
        let [nodal, element] = [fields.nodal_values(solver), fields.element_values(solver, comm.rank())];
        let [nodal_count, element_count] = self.variables;
        let values = match &mut self.way {
            Way::Gathered(collector) => {
                let nodal = collector.nodal(nodal, nodal_count, comm);
                nodal.zip(collector.element(element, element_count, comm))
            }
            Way::Split(split) => Some((split.nodal(&nodal, nodal_count, comm), split.element(&element, element_count))),
        };
        match (&mut self.file, values) {
            (Some(file), Some((nodal, element))) => {
                Ok(file.write_state(solver.time, &global_values(solver, totals), &nodal, &element)?)
            }
            _ => Ok(()),
        }
    }
}
