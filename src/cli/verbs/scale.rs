//! `urto scale`: what a run would do on many ranks.

use crate::cli::input::Given;
use crate::cli::options::{DecompositionName, MachineName};
use crate::cli::terminal::{complain, say};
use crate::cli::{DONE, Failure, options};
use crate::comm::RankFailure;
use crate::common::files;
use crate::model::ContactDecomposition;
use crate::solver::Body;
use crate::studies::scale::{self, Case, Machine};

/// Counts, prices and prints.
///
/// # Errors
///
/// Input that cannot be read or has mistakes, or a model that stops within the steps that are counted.
pub fn scale(options: &options::Scale) -> Result<u8, Failure> {
    let cases = if options.scaled { scaled(options)? } else { fixed(options)? };
    let machine = machine(options);
    let rows = scale::rows(&cases, &machine);
    say(format_args!("the first {} steps, counted", options.steps));
    say(scale::text(&rows, &machine).trim_end());
    if let Some(path) = &options.csv {
        files::replace(path, scale::csv(&rows).as_bytes())
            .map_err(|e| Failure::run(format_args!("error: cannot write {}: {e}", path.display())))?;
    }
    Ok(DONE)
}

/// The problem, with what the options replace.
fn read(options: &options::Scale, ranks: Option<u32>) -> Result<Given, Failure> {
    let mut given = Given::read_for(&options.input, ranks)?;
    given.inputs().spare(&options.csv, "name another file with --csv")?;
    let chosen = &mut given.problem.model.contact.control.decomposition;
    *chosen = match options.decomposition {
        None => *chosen,
        Some(DecompositionName::Rcb) => ContactDecomposition::Bisection,
        Some(DecompositionName::Slices) => ContactDecomposition::Slices,
        Some(DecompositionName::Static) => ContactDecomposition::Static,
    };
    Ok(given)
}

/// One mesh for all.
fn fixed(options: &options::Scale) -> Result<Vec<Case>, Failure> {
    let given = read(options, None)?;
    introduce(&given);
    let body = given.body()?;
    options.ranks.iter().map(|&ranks| count(options, &given, &body, ranks)).collect()
}

/// A mesh for each.
fn scaled(options: &options::Scale) -> Result<Vec<Case>, Failure> {
    let mut cases = Vec::new();
    let mut before: Option<(u32, usize)> = None;
    for &ranks in &options.ranks {
        let given = read(options, Some(ranks))?;
        let elements = given.mesh.element_count();
        match before {
            None => introduce(&given),
            Some((other, same)) if other != ranks && same == elements => {
                return Err(Failure::input(format_args!(
                    "error: the mesh {} has {elements} elements for {other} and for {ranks} ranks\n\
                     help: --scaled needs a recipe whose expressions use the name ranks, such as {{18 * ranks}}",
                    given.mesh_path.display()
                )));
            }
            Some(_) => {}
        }
        before = Some((ranks, elements));
        cases.push(count(options, &given, &given.body()?, ranks)?);
    }
    Ok(cases)
}

fn introduce(given: &Given) {
    if let Some(warnings) = given.warnings() {
        complain(warnings);
    }
    say(given.problem.model.title.trim());
}

fn count(options: &options::Scale, given: &Given, body: &Body, ranks: u32) -> Result<Case, Failure> {
    let model = &given.problem.model;
    scale::count(&given.mesh, model, body, ranks as usize, machine(options).ranks_of_node, u64::from(options.steps))
        .map_err(|failure| match *failure {
            RankFailure::Failed { error, .. } => Failure::run(format_args!(
                "error: the run would stop: {error}\nhelp: {}",
                error.advice().join("\nhelp: ")
            )),
            other => Failure::run(format_args!("error: {other}")),
        })
}

/// The machine that was named, with what replaces its costs.
fn machine(options: &options::Scale) -> Machine {
    let mut machine = match options.machine {
        MachineName::Paragon => Machine::PARAGON,
        MachineName::Cluster => Machine::CLUSTER,
    };
    if let Some(microseconds) = options.element_cost {
        machine = machine.with_element(1e-6 * microseconds);
    }
    machine.latency = options.latency.map_or(machine.latency, |microseconds| 1e-6 * microseconds);
    machine.bandwidth = options.bandwidth.map_or(machine.bandwidth, |megabytes| 1e6 * megabytes);
    machine
}
