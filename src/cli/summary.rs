//! `urto run --summary`: how a run went, as JSON, for scripts and for studies.

use super::verbs::run::Prepared;
use super::{Failure, options};
use crate::common::files;
use crate::postprocess::plot::{self, Curve};
use crate::run::{Ended, Files, RunError};
use crate::solver::Finding;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// How a run went. Numbers have the units of the deck; what there is none of is null.
#[derive(Debug, Serialize)]
struct Summary {
    program: String,
    title: String,
    deck: String,
    mesh: String,
    refine: u32,
    /// What -D gave to names.
    parameters: BTreeMap<String, String>,
    /// `complete`, `stopped` on request, or `failed`.
    ended: &'static str,
    /// Why it did not come to its end.
    reason: Option<String>,
    exit_code: u8,
    begun: String,
    /// Null of a run that failed before its first step.
    steps: Option<u64>,
    time: Option<f64>,
    termination_time: f64,
    nodes: usize,
    elements: usize,
    ranks: usize,
    states: Option<usize>,
    /// Energy accounted for minus energy supplied, over the largest account.
    energy_error: Option<f64>,
    warnings: Vec<Warning>,
    /// What the scene did not need, and what it lacked.
    advice: Vec<Advised>,
    /// Global variables of the plot file over its states: energies among them.
    globals: BTreeMap<String, Reached>,
    /// Variables of the histories.
    histories: BTreeMap<String, Reached>,
    seconds: Seconds,
    memory_bytes: Option<f64>,
    files: Written,
}

/// A warning.
#[derive(Debug, Serialize)]
struct Warning {
    label: String,
    /// Of the run itself, with when it was seen; null for one from reading deck and mesh.
    step: Option<u64>,
    time: Option<f64>,
    words: Option<String>,
}

/// Something that the scene did not need, or lacked.
#[derive(Debug, Serialize)]
struct Advised {
    /// `spare` or `lacked`.
    kind: &'static str,
    /// What was seen.
    words: String,
    /// The command that would say so, or what else to do.
    instead: String,
    /// What stays the same then: `the same bits`, `the same digits`, or nothing.
    keeps: &'static str,
    /// The part of the time that this is about.
    share: Option<f64>,
}

/// What a variable has reached.
#[derive(Debug, Serialize)]
struct Reached {
    last: f64,
    least: f64,
    least_at: f64,
    greatest: f64,
    greatest_at: f64,
}

/// Wall-clock times.
#[derive(Debug, Serialize)]
struct Seconds {
    /// Of the program from its start to here.
    all: f64,
    /// Of the steps.
    steps: Option<f64>,
    /// Of the processor, in all threads; null where the system does not tell.
    processor: Option<f64>,
    /// For an element and a step.
    per_element_step: Option<f64>,
    sections: BTreeMap<String, f64>,
}

/// Names of files.
#[derive(Debug, Serialize)]
struct Written {
    log: String,
    results: String,
    histories: Option<String>,
    restart: Option<String>,
}

/// Writes the summary, if one is asked for.
///
/// # Errors
/// When it cannot be written.
pub fn write(
    options: &options::Run,
    prepared: &Prepared,
    outcome: Result<&Ended, &RunError>,
    exit_code: u8,
) -> Result<(), Failure> {
    let Some(path) = &options.summary else { return Ok(()) };
    let cannot = |reason: String| Failure::run(format_args!("error: cannot write {}: {reason}", path.display()));
    let text = serde_json::to_string_pretty(&summary(options, prepared, outcome, exit_code))
        .map_err(|error| cannot(error.to_string()))?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    folder.map_or(Ok(()), std::fs::create_dir_all).map_err(|error| cannot(error.to_string()))?;
    files::replace(path, (text + "\n").as_bytes()).map_err(|error| cannot(error.to_string()))
}

fn summary(options: &options::Run, prepared: &Prepared, outcome: Result<&Ended, &RunError>, exit_code: u8) -> Summary {
    let (given, files) = (&prepared.given, &prepared.files);
    let ended = outcome.ok();
    let (how, reason) = ending(outcome);
    let (steps, time) = reached(outcome);
    let [_, _, date, clock] = &prepared.qa;
    Summary {
        program: format!("urto {}", env!("CARGO_PKG_VERSION")),
        title: given.problem.model.title.trim().to_owned(),
        deck: given.deck.display().to_string(),
        mesh: given.mesh_path.display().to_string(),
        refine: options.input.refine,
        parameters: parameters(&options.input.define),
        ended: how,
        reason,
        exit_code,
        begun: format!("{date} {clock} UTC"),
        steps,
        time,
        termination_time: given.problem.model.termination_time,
        nodes: given.mesh.coordinates.len(),
        elements: given.mesh.element_count(),
        ranks: prepared.ranks,
        states: ended.map(|ended| ended.states),
        energy_error: ended.map(|ended| ended.energy_error),
        warnings: warnings(prepared, outcome),
        advice: ended.map(advised).unwrap_or_default(),
        globals: extremes(&files.plot),
        histories: if files.history.exists() { extremes(&files.history) } else { BTreeMap::new() },
        seconds: Seconds {
            all: prepared.clock[0].elapsed().as_secs_f64(),
            steps: ended.map(|ended| ended.wall),
            processor: crate::run::processor(),
            per_element_step: ended.map(|ended| ended.grind),
            sections: ended.map(|ended| ended.sections.iter().cloned().collect()).unwrap_or_default(),
        },
        memory_bytes: ended.and_then(|ended| ended.memory),
        files: written(files, ended),
    }
}

fn advised(ended: &Ended) -> Vec<Advised> {
    let told = |(advice, share): &(crate::studies::advice::Advice, Option<f64>)| Advised {
        kind: if advice.lacked { "lacked" } else { "spare" },
        words: advice.words.clone(),
        instead: advice.instead.clone(),
        keeps: advice.kept(),
        share: *share,
    };
    ended.advice.iter().map(told).collect()
}

/// What options -D give, as texts.
pub fn parameters(define: &[String]) -> BTreeMap<String, String> {
    let pair = |text: &String| text.split_once('=').map(|(name, value)| (name.trim().into(), value.trim().into()));
    define.iter().filter_map(pair).collect()
}

fn ending(outcome: Result<&Ended, &RunError>) -> (&'static str, Option<String>) {
    match outcome {
        Err(error) => ("failed", Some(error.to_string())),
        Ok(ended) => match ended.by.asked_by() {
            None => ("complete", None),
            by => ("stopped", by),
        },
    }
}

/// Steps taken and time reached, where they are known.
fn reached(outcome: Result<&Ended, &RunError>) -> (Option<u64>, Option<f64>) {
    match outcome {
        Ok(Ended { steps: step, time, .. })
        | Err(RunError::Stopped { step, time, .. } | RunError::Underway { step, time, .. }) => {
            (Some(*step), Some(*time))
        }
        Err(_) => (None, None),
    }
}

fn warnings(prepared: &Prepared, outcome: Result<&Ended, &RunError>) -> Vec<Warning> {
    let findings: &[Finding] = match outcome {
        Ok(ended) => &ended.findings,
        Err(RunError::Stopped { findings, .. } | RunError::Underway { findings, .. }) => findings,
        Err(_) => &[],
    };
    let read = prepared.given.warning_messages().map(|label| Warning { label, step: None, time: None, words: None });
    let of_run = findings.iter().map(|finding| Warning {
        label: finding.label(),
        step: Some(finding.step),
        time: Some(finding.time),
        words: Some(finding.words()),
    });
    read.chain(of_run).collect()
}

/// What the global variables of a file reach; none where it cannot be read.
fn extremes(path: &Path) -> BTreeMap<String, Reached> {
    let curves = plot::whole_body(path).unwrap_or_default();
    let reached = |curve: &Curve| {
        let found = curve.extremes()?;
        let [[least_at, least], [greatest_at, greatest], [_, last]] = [found.least, found.greatest, found.last];
        Some((curve.label.clone(), Reached { last, least, least_at, greatest, greatest_at }))
    };
    curves.iter().filter_map(reached).collect()
}

fn written(files: &Files, ended: Option<&Ended>) -> Written {
    let name = |path: &Path| path.display().to_string();
    Written {
        log: name(&files.print),
        results: name(&files.plot),
        histories: files.history.exists().then(|| name(&files.history)),
        restart: ended.filter(|ended| ended.restart).map(|_| name(&files.restart)),
    }
}
