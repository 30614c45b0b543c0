//! `urto trade`: a deck in variants, each measured. Each is a run of this program, one after the other, so that they have the machine
//! to themselves.

use crate::cli::input::Given;
use crate::cli::outputs::{Inputs, writable};
use crate::cli::signals::Wishes;
use crate::cli::terminal::say;
use crate::cli::{DONE, Failure, options, stopped_by};
use crate::common::files;
use crate::exodus;
use crate::mesh::refine::refined;
use crate::run::Files;
use crate::solver::Request;
use crate::studies::sweep::record::is_newer;
use crate::studies::trade::{self, Judgement, Measured, Quantity, Row, Variant, knobs};
use serde_json::Value;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Time between looks at a run.
const LOOK_INTERVAL: Duration = Duration::from_millis(20);
/// Processor time, in seconds, above which it is taken rather than that of the clock.
const LONG: f64 = 0.2;
/// Largest part of the accepted error that a variant may change a quantity by to be put together with others.
const HARMLESS: f64 = 0.3;
/// Part of the time that a variant must save to be put together with others.
const FASTER: f64 = 0.97;

/// A deck whose variants are run.
struct Trial<'a> {
    options: &'a options::Trade,
    given: Given,
    folder: PathBuf,
    stem: String,
    inputs: Vec<PathBuf>,
    program: PathBuf,
    /// Commands taken out of all variants and put into them.
    common: (Vec<&'static str>, Vec<String>),
    budget: f64,
    begun: Instant,
}

/// Runs the variants and says what came of them.
pub fn trade(options: &options::Trade) -> Result<u8, Failure> {
    let asked = options.quantity.iter().map(|text| text.parse::<Quantity>().map_err(Failure::input_error));
    let asked = asked.collect::<Result<Vec<_>, _>>()?;
    let within = options.within / 100.0;
    if !(within > 0.0 && within.is_finite()) {
        return Err(Failure::input(format_args!("error: --within is {}; expected per cent, above 0", options.within)));
    }
    let trial = Trial::new(options)?;
    let wishes = Wishes::listen(trial.folder.join("trade.shutdown"))
        .map_err(|e| Failure::run(format_args!("error: cannot listen for signals: {e}")))?;
    let mut list = knobs::variants(&trial.given.problem.model, &trial.given.mesh, &options.levels);
    let base = trial.run(&list[0], f64::INFINITY, &wishes)?;
    let summary = base.map_err(|reason| Failure::run(format_args!("error: the deck as it is: {reason}")))?;
    let quantities = if asked.is_empty() { trade::of_deck(&trial.given.problem.model, &summary) } else { asked };
    let mut rows = vec![trial.row(list.remove(0), Ok(summary), &quantities)];
    if let Some(Err(reason)) = rows.first().map(|row| &row.outcome) {
        return Err(Failure::input(format_args!("error: {reason}")));
    }
    // Behind the first finer mesh and the shorter steps.
    let step = rows[0].outcome.as_ref().map_or(0.0, |base| base.time / base.steps.max(1) as f64);
    let place = list.len().min(3);
    list.splice(place..place, knobs::mass_scaling(step));
    for variant in list {
        trial.add(variant, &mut rows, &quantities, &wishes)?;
    }
    if let Some(variant) = together(&rows, &quantities, within) {
        trial.add(variant, &mut rows, &quantities, &wishes)?;
    }
    wishes.obeyed();
    let judgement = Judgement::of(&quantities, &rows);
    trial.write(&judgement, &rows, within)?;
    Ok(match wishes.now() {
        Request::Signal(signal) => stopped_by(signal),
        _ => DONE,
    })
}

/// All knobs together that each save time and do no harm; nothing where there are not two.
fn together(rows: &[Row], quantities: &[Quantity], within: f64) -> Option<Variant> {
    let base = rows.first()?.outcome.as_ref().ok()?;
    let mut chosen: Vec<(&Variant, f64)> = Vec::new();
    for row in rows.iter().skip(1).filter(|row| row.variant.refine == 1 && row.variant.knob != knobs::Knob::RoundOff) {
        let Ok(measured) = &row.outcome else { continue };
        let change = |place: usize| ((measured.values[place] - base.values[place]) / base.values[place]).abs();
        let harmless = (0..quantities.len()).all(|place| change(place) <= HARMLESS * within);
        if !harmless || measured.seconds > FASTER * base.seconds {
            continue;
        }
        // Of a knob the position that saves most.
        match chosen.iter_mut().find(|(variant, _)| variant.knob == row.variant.knob) {
            Some(other) if other.1 > measured.seconds => *other = (&row.variant, measured.seconds),
            Some(_) => (),
            None => chosen.push((&row.variant, measured.seconds)),
        }
    }
    let variants: Vec<&Variant> = chosen.iter().map(|(variant, _)| *variant).collect();
    (variants.len() > 1).then(|| knobs::together(&variants))
}

impl<'a> Trial<'a> {
    fn new(options: &'a options::Trade) -> Result<Trial<'a>, Failure> {
        let begun = Instant::now();
        let budget = seconds(&options.budget)?;
        if let Some(level) = options.levels.iter().find(|level| **level < 2) {
            return Err(Failure::input(format_args!(
                "error: --levels {level}: a finer mesh is at least 2 times finer"
            )));
        }
        let given = Given::read(&input(options, 1))?;
        let stem = given.deck.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let folder = options.output.clone().unwrap_or_else(|| PathBuf::from(format!("{stem}_trade")));
        let cannot = |e| Failure::run(format_args!("error: cannot make the folder {}: {e}", folder.display()));
        std::fs::create_dir_all(&folder).map_err(cannot)?;
        writable(&folder)?;
        let inputs: Vec<PathBuf> =
            given.problem.deck.source.files().into_iter().map(PathBuf::from).chain(given.mesh_files.clone()).collect();
        if let Some(file) = &options.write {
            given.inputs().spare([file], "name another file with --write")?;
        }
        let program = std::env::current_exe()
            .map_err(|e| Failure::run(format_args!("error: cannot find this program to run it again: {e}")))?;
        let end = options.end.map(|end| format!("TERMINATION TIME, {end:?}"));
        // A restart has another mesh, or another step.
        let mut without = vec!["WRITE RESTART", "READ RESTART"];
        without.extend(end.is_some().then_some("TERMINATION TIME"));
        let common = (without, end.into_iter().collect());
        Ok(Trial { options, given, folder, stem, inputs, program, common, budget, begun })
    }

    fn folder_of(&self, variant: &Variant) -> PathBuf {
        self.folder.join(&variant.name)
    }

    fn files_of(&self, variant: &Variant) -> Files {
        Files::of(&self.folder_of(variant).join(&self.stem))
    }

    /// Runs a variant if that fits into what is left of the budget, and adds it to the rows.
    fn add(
        &self,
        variant: Variant,
        rows: &mut Vec<Row>,
        quantities: &[Quantity],
        wishes: &Wishes,
    ) -> Result<(), Failure> {
        let base = rows.first().and_then(|row| row.outcome.as_ref().ok()).map_or(0.0, |measured| measured.wall);
        let outcome = self.run(&variant, base, wishes)?;
        rows.push(self.row(variant, outcome, quantities));
        Ok(())
    }

    /// The row of a variant from its summary.
    fn row(&self, variant: Variant, outcome: Result<Value, String>, quantities: &[Quantity]) -> Row {
        let results = self.files_of(&variant).plot;
        let measured = |summary: Value| -> Result<Measured, String> {
            let values = quantities.iter().map(|quantity| trade::found(quantity, &summary, &results));
            let seconds = &summary["seconds"];
            Ok(Measured {
                // The system counts processor time in hundredths of a second.
                seconds: (seconds["processor"].as_f64().filter(|time| *time > LONG))
                    .or(seconds["all"].as_f64())
                    .unwrap_or(f64::NAN),
                wall: seconds["all"].as_f64().unwrap_or(f64::NAN),
                steps: summary["steps"].as_u64().unwrap_or(0),
                time: summary["time"].as_f64().unwrap_or(f64::NAN),
                memory: summary["memory_bytes"].as_f64(),
                values: values.collect::<Result<_, _>>()?,
            })
        };
        let outcome = outcome.and_then(measured);
        Row { variant, outcome }
    }

    /// The summary of a variant, which is run unless that was done before; or why there is none. `base` is what the deck as it is took.
    fn run(&self, variant: &Variant, base: f64, wishes: &Wishes) -> Result<Result<Value, String>, Failure> {
        let folder = self.folder_of(variant);
        let cannot = |e: std::io::Error| Failure::run(format_args!("error: cannot run in {}: {e}", folder.display()));
        std::fs::create_dir_all(&folder).map_err(cannot)?;
        let (deck, summary) = (folder.join(format!("{}.i", self.stem)), folder.join("summary.json"));
        let text = variant.deck(&self.given.problem.deck, &self.common);
        let same = std::fs::read_to_string(&deck).is_ok_and(|old| old == text) && is_newer(&summary, &self.inputs);
        if let Some(done) = complete(&summary).filter(|_| same) {
            say(format_args!("{}: done before", variant.name));
            return Ok(Ok(done));
        }
        if wishes.now() != Request::Continue {
            return Ok(Err("not run: it was stopped before".into()));
        }
        let left = self.budget - self.begun.elapsed().as_secs_f64();
        let expected = if base.is_finite() { base * variant.work } else { 0.0 };
        if expected > left {
            return Ok(Err(format!("not run: about {expected:.0} s are more than is left of the budget")));
        }
        let mesh = match self.mesh(variant.refine) {
            Ok(mesh) => mesh,
            Err(failure) => return Ok(Err(first_line(&failure.message))),
        };
        Inputs::default()
            .with("an input", &self.inputs)
            .spare([&deck, &summary], "name another folder with --output")?;
        let _ = std::fs::remove_file(&summary);
        std::fs::write(&deck, text).map_err(cannot)?;
        let said = folder.join("terminal.txt");
        let told = File::create(&said).map_err(cannot)?;
        let mut command = Command::new(&self.program);
        command.arg("run").arg(&deck).arg("--mesh").arg(mesh).arg("--ranks").arg(self.options.ranks.to_string());
        command.arg("--output").arg(folder.join(&self.stem)).arg("--summary").arg(&summary);
        command.stdin(Stdio::null()).stdout(told.try_clone().map_err(cannot)?).stderr(told);
        let mut child = command.spawn().map_err(cannot)?;
        let mut asked = false;
        while matches!(child.try_wait(), Ok(None)) {
            std::thread::sleep(LOOK_INTERVAL);
            let over = base.is_finite() && self.begun.elapsed().as_secs_f64() > self.budget;
            if !asked && (over || wishes.now() != Request::Continue) {
                asked = true;
                // Where that fails, the run goes on to its end.
                let _ = File::create(self.files_of(variant).shutdown);
            }
        }
        let outcome = complete(&summary).ok_or_else(|| {
            let text = std::fs::read_to_string(&said).unwrap_or_default();
            let error = text.lines().find(|line| line.starts_with("error: ")).map(String::from);
            if asked {
                "stopped: the budget was spent, or somebody asked for it".into()
            } else {
                error.unwrap_or("it ended without a word".into())
            }
        });
        match &outcome {
            Ok(summary) => say(format_args!(
                "{}: {} steps in {:.1} s",
                variant.name,
                summary["steps"],
                summary["seconds"]["all"].as_f64().unwrap_or(0.0)
            )),
            Err(reason) => say(format_args!("{}: {reason}", variant.name)),
        }
        Ok(outcome)
    }

    /// The mesh, so many times finer, as a file; a recipe makes it, any other is divided.
    fn mesh(&self, refine: u32) -> Result<PathBuf, Failure> {
        let path = self.folder.join(format!("mesh_{refine}.g"));
        if is_newer(&path, &self.inputs) {
            return Ok(path);
        }
        let recipe = crate::cli::input::is_recipe(&self.given.mesh_path);
        let finer;
        let mut mesh = &self.given.mesh;
        if refine > 1 && recipe {
            finer = Given::read(&input(self.options, refine))?.mesh;
            mesh = &finer;
        } else if refine > 1 {
            if !refine.is_power_of_two() {
                return Err(Failure::input("not run: a mesh file is divided in two, four or eight along each edge"));
            }
            let mut divided = refined(mesh).map_err(Failure::input_error)?;
            for _ in 1..refine.ilog2() {
                divided = refined(&divided).map_err(Failure::input_error)?;
            }
            divided.share_out_as(mesh);
            finer = divided;
            mesh = &finer;
        }
        exodus::write_mesh(&path, mesh).map_err(|e| Failure::run(format_args!("error: {e}")))?;
        Ok(path)
    }

    /// Table, numbers, pictures, words, and the deck that is asked for.
    fn write(&self, judgement: &Judgement, rows: &[Row], within: f64) -> Result<(), Failure> {
        let table = trade::text(judgement, rows);
        let words = trade::words(judgement, rows, within);
        let mut made = Vec::new();
        for (name, text) in [("table.txt", format!("{table}\n{words}")), ("front.csv", trade::csv(judgement, rows))] {
            let path = self.folder.join(name);
            let cannot = |e| Failure::run(format_args!("error: cannot write {}: {e}", path.display()));
            std::fs::write(&path, text).map_err(cannot)?;
            made.push(path);
        }
        say(format_args!("\n{table}\n{words}"));
        let title = self.given.problem.model.title.trim();
        made.extend(
            trade::pictures(&self.folder, title, judgement, rows)
                .map_err(|e| Failure::run(format_args!("error: {e}")))?,
        );
        if let Some(path) = &self.options.write {
            made.push(self.write_deck(path, judgement, rows, within)?);
        }
        say(made.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join("  "));
        Ok(())
    }

    /// Writes the deck of the cheapest variant that is good enough, and says which mesh belongs to it.
    fn write_deck(&self, path: &Path, judgement: &Judgement, rows: &[Row], within: f64) -> Result<PathBuf, Failure> {
        let Some(row) = judgement.cheapest(within, rows) else {
            return Err(Failure::run(
                "error: --write: nothing that was run is good enough; a larger --budget, or a larger --within",
            ));
        };
        let variant = &rows[row].variant;
        let text = variant.deck(&self.given.problem.deck, &(Vec::new(), Vec::new()));
        files::replace(path, text.as_bytes())
            .map_err(|e| Failure::run(format_args!("error: cannot write {}: {e}", path.display())))?;
        let mesh = self.folder.join(format!("mesh_{}.g", variant.refine));
        say(format_args!("{} is {}; its mesh is {}", path.display(), variant.name, mesh.display()));
        Ok(path.to_owned())
    }
}

/// A run's summary, if it came to its end.
fn complete(path: &Path) -> Option<Value> {
    let all: Value = serde_json::from_str(&std::fs::read_to_string(path).ok()?).ok()?;
    (all["ended"] == "complete").then_some(all)
}

fn input(options: &options::Trade, refine: u32) -> options::Input {
    let (deck, mesh, define) = (options.deck.clone(), options.mesh.clone(), options.define.clone());
    options::Input { deck, mesh, define, refine }
}

fn first_line(text: &str) -> String {
    text.lines().next().unwrap_or_default().to_owned()
}

/// A time as somebody types it: 90, 90s, 10m, 2h.
fn seconds(text: &str) -> Result<f64, Failure> {
    let (number, unit) = match text.trim().strip_suffix(['s', 'm', 'h']) {
        Some(number) => (number, text.trim().chars().last()),
        None => (text.trim(), None),
    };
    let factor = match unit {
        Some('m') => 60.0,
        Some('h') => 3600.0,
        _ => 1.0,
    };
    let found = number.parse::<f64>().ok().filter(|number| *number > 0.0 && number.is_finite());
    found
        .map(|number| factor * number)
        .ok_or_else(|| Failure::input(format_args!("error: --budget {text}: expected a time such as 90s, 10m or 2h")))
}
