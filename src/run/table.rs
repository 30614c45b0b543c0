//! The closing table of a run: where the time went, and how evenly work and messages were spread over the ranks.

use super::memory;
use crate::comm::{Communicator, Counted, Traffic, spreads};
use crate::output::print::{Balance, TimeTable};
use crate::solver::contact::Contact;
use crate::solver::{Section, Solver};

/// The table, the same on every rank but for its memory; all ranks call it. `wall` is in seconds, `steps` were taken by
/// this run on so many elements in all.
pub fn time_table(solver: &Solver, comm: &mut Counted, wall: f64, [steps, elements]: [u64; 2]) -> TimeTable {
    TimeTable {
        sections: sections(solver, comm),
        // The forces of the last state are found too, though no step is taken from it.
        balance: balance(solver, comm, steps + 1),
        wall,
        ranks: comm.size(),
        element_cycles: steps as f64 * elements as f64,
        memory: memory::resident().map(|(_, most)| most),
    }
}

/// Seconds of each section.
fn sections(solver: &Solver, comm: &mut Counted) -> Vec<Balance> {
    // Microseconds, as integers: their sum does not depend on the order.
    let own = Section::ALL.map(|(section, _)| solver.clock.spent(section).as_micros() as u64);
    let seconds = spreads(&own, comm).into_iter().map(|spread| spread.over(1e6));
    let balance = |((_, name), spread): ((Section, &str), _)| Balance { name: name.to_string(), spread };
    Section::ALL.into_iter().zip(seconds).map(balance).collect()
}

/// Work and messages of a step. What no rank has is left out.
fn balance(solver: &Solver, comm: &mut Counted, prepared: u64) -> Vec<Balance> {
    let counts = comm.counts();
    let work = solver.domain.contact.as_ref().map(Contact::work).unwrap_or_default();
    let mut rows = vec![
        ("ELEMENTS".to_string(), solver.domain.element_file.len() as u64, 1),
        ("CONTACT NODES".to_string(), work.points, 1),
        ("PAIRS OF NODES AND FACES".to_string(), work.candidates, 1),
    ];
    for (part, name) in Traffic::ALL.into_iter().filter(|(part, _)| *part != Traffic::Setup) {
        let count = counts.of(part);
        rows.push((format!("MESSAGES FOR {name}"), count.sent.messages, prepared));
        rows.push((format!("BYTES FOR {name}"), count.sent.bytes, prepared));
        rows.push((format!("CALLS OF ALL FOR {name}"), count.collectives, prepared));
    }
    let own: Vec<u64> = rows.iter().map(|row| row.1).collect();
    let spreads = spreads(&own, comm);
    let balance = rows.into_iter().zip(spreads).map(|((name, _, steps), spread)| (name, spread.over(steps as f64)));
    balance.filter(|(_, spread)| spread.most > 0.0).map(|(name, spread)| Balance { name, spread }).collect()
}
