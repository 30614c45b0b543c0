//! How a problem would run on many ranks. The ranks run as threads, however few cores there are, and count what each
//! of them has to do and to say; a [`Machine`] then says what that would cost where every rank has a core of its own.

mod machine;
mod table;

pub use machine::{Machine, Price};
pub use table::{Row, csv, rows, text};

use crate::comm::{Communicator, Count, Counted, Counts, RankFailure, Traffic, run_threads};
use crate::mesh::Mesh;
use crate::model::Model;
use crate::solver::contact::Contact;
use crate::solver::{Body, Request, Solver, Stop};

/// What one rank did in all steps that were counted.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RankWork {
    /// Elements that it computes in every step.
    pub elements: u64,
    /// Contact points that it looked after, summed over the steps.
    pub contact_points: u64,
    /// Pairs of points and faces that it checked, summed over the steps.
    pub candidates: u64,
    /// Constraints times passes, summed over the steps.
    pub corrections: u64,
    /// What it said to others.
    pub counts: Counts,
}

/// A problem on a number of ranks.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Steps that were counted.
    pub steps: u64,
    /// The ranks.
    pub work: Vec<RankWork>,
}

impl RankWork {
    /// What contact said to others.
    pub fn of_contact(&self) -> Count {
        let parts = [Traffic::ContactSearch, Traffic::ContactMotion, Traffic::ContactPasses];
        parts.into_iter().map(|part| self.counts.of(part)).fold(Count::default(), Count::and)
    }

    /// What every step says to others: all but the setting up, sums of energies and files.
    pub fn of_steps(&self) -> Count {
        let parts = [Traffic::Elements, Traffic::Step, Traffic::Erosion];
        parts.into_iter().map(|part| self.counts.of(part)).fold(self.of_contact(), Count::and)
    }
}

/// Takes the first steps of a problem on ranks that are threads, and counts; so many ranks are taken to be on each node
/// of a machine. No file is written.
///
/// # Errors
/// When the problem stops before these steps are done, or a thread cannot be had.
pub fn count(
    mesh: &Mesh,
    model: &Model,
    body: &Body,
    ranks: usize,
    ranks_of_node: usize,
    steps: u64,
) -> Result<Case, Box<RankFailure<Stop>>> {
    let cut = body.cut(ranks);
    let contributors = body.contributors(&cut);
    let decomposition = body.decomposition(&contributors, ranks);
    let work = run_threads(ranks, |inner| {
        let comm = &mut Counted::on_nodes(inner, ranks_of_node);
        let mut solver = Solver::new(mesh, model, body, &decomposition.share(comm.rank()), comm);
        count_rank(&mut solver, steps, comm)
    })?;
    Ok(Case { steps, work })
}

/// Takes the steps on one rank.
fn count_rank(solver: &mut Solver, steps: u64, comm: &mut Counted) -> Result<RankWork, Stop> {
    let mut work = RankWork { elements: solver.domain.element_file.len() as u64, ..RankWork::default() };
    let mut iterations = 0;
    for _ in 0..steps {
        solver.prepare(Request::Continue, comm)?;
        if let Some(contact) = solver.domain.contact.as_ref().map(Contact::work) {
            work.contact_points += contact.points;
            work.candidates += contact.candidates;
            work.corrections += contact.constraints * (contact.iterations - iterations);
            iterations = contact.iterations;
        }
        solver.advance();
    }
    work.counts = comm.counts();
    Ok(work)
}

#[cfg(test)]
mod tests;
