//! `urto sweep`: studies. Each member is a run of this program, so that one that fails takes no other with it.

use crate::cli::input::Given;
use crate::cli::outputs::{Inputs, writable};
use crate::cli::signals::Wishes;
use crate::cli::terminal::{complain, say};
use crate::cli::{DONE, FAILED, Failure, options, stopped_by};
use crate::common::files;
use crate::exodus::Results;
use crate::output::print::scientific;
use crate::postprocess::plot::Class;
use crate::run::Files;
use crate::solver::Request;
use crate::studies::sweep::record::{Made, Record, is_newer};
use crate::studies::sweep::{self, Axis, Member, Row, Wanted, members};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// Time between looks at the runs.
const LOOK_INTERVAL: Duration = Duration::from_millis(50);

/// A study that is ready to run.
struct Study<'a> {
    options: &'a options::Sweep,
    axes: Vec<Axis>,
    members: Vec<Member>,
    folder: PathBuf,
    deck: PathBuf,
    mesh: PathBuf,
    title: String,
    /// Everything that the first member was read from.
    inputs: Vec<PathBuf>,
    wanted: Wanted,
    program: PathBuf,
}

/// A run that has not ended.
struct Running {
    member: usize,
    child: Child,
}

/// Runs a study.
pub fn sweep(options: &options::Sweep) -> Result<u8, Failure> {
    let study = Study::new(options)?;
    let wishes = Wishes::listen(study.folder.join("sweep.shutdown"))
        .map_err(|e| Failure::run(format_args!("error: cannot listen for signals: {e}")))?;
    let open: Vec<usize> = (0..study.members.len()).filter(|&place| !study.is_done(place)).collect();
    let [all, left] = [study.members.len(), open.len()];
    let done = if left < all { format!(", {} of them done before", all - left) } else { String::new() };
    say(format_args!("{}: {all} runs{done}, {} at a time", study.title, study.jobs()));
    let stopped = study.run_all(open, &wishes)?;
    wishes.obeyed();
    let rows = study.rows();
    study.write(&rows)?;
    study.tell_unreadable(&rows);
    let failed = rows.iter().filter(|row| !row.record.as_ref().is_some_and(Record::is_complete)).count();
    let unread = rows.iter().filter(|row| row.found.is_err()).count();
    Ok(match stopped {
        Request::Signal(signal) => stopped_by(signal),
        _ if failed + unread > 0 => FAILED,
        _ => DONE,
    })
}

impl<'a> Study<'a> {
    /// Reads the first member, so that what is wrong with all is told before any runs.
    fn new(options: &'a options::Sweep) -> Result<Study<'a>, Failure> {
        let axes = options.define.iter().map(|text| text.parse::<Axis>().map_err(Failure::input_error));
        let axes = axes.collect::<Result<Vec<_>, _>>()?;
        let members = members(&axes).map_err(Failure::input_error)?;
        let filter = options.filter.as_deref().map(|t| t.parse::<Class>()).transpose().map_err(Failure::input_error)?;
        if !(options.second > 0.0 && options.second.is_finite()) {
            return Err(Failure::input(format_args!(
                "error: --second is {}; expected a positive number",
                options.second
            )));
        }
        let first = members.first().map(definitions).unwrap_or_default();
        let (deck, mesh, refine) = (options.deck.clone(), options.mesh.clone(), options.refine);
        let given = Given::read(&options::Input { deck, mesh, define: first, refine })?;
        let stem = given.deck.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let folder = options.output.clone().unwrap_or_else(|| PathBuf::from(stem + "_sweep"));
        std::fs::create_dir_all(&folder)
            .map_err(|e| Failure::run(format_args!("error: cannot make the folder {}: {e}", folder.display())))?;
        writable(&folder)?;
        let inputs: Vec<PathBuf> =
            given.problem.deck.source.files().into_iter().map(PathBuf::from).chain(given.mesh_files.clone()).collect();
        let program = std::env::current_exe()
            .map_err(|e| Failure::run(format_args!("error: cannot find this program to run it again: {e}")))?;
        let wanted = Wanted {
            variables: options.variables.clone(),
            nodes: options.node.clone(),
            elements: options.element.clone(),
            filter,
            second: options.second,
        };
        let (deck, mesh, title) = (given.deck, given.mesh_path, given.problem.model.title.trim().to_owned());
        Ok(Study { options, axes, members, folder, deck, mesh, title, inputs, wanted, program })
    }

    /// Runs at a time.
    fn jobs(&self) -> usize {
        let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
        let fitting = (cores / self.options.ranks as usize).max(1);
        self.options.jobs.map_or(fitting, |jobs| jobs as usize)
    }

    fn folder_of(&self, member: usize) -> PathBuf {
        self.folder.join(self.members[member].name())
    }

    fn files_of(&self, member: usize) -> Files {
        Files::of(&self.folder_of(member).join(self.deck.file_stem().unwrap_or_default()))
    }

    fn summary_of(&self, member: usize) -> PathBuf {
        self.folder_of(member).join("summary.json")
    }

    /// What a member is made of.
    fn made_of(&self, member: usize) -> Made {
        Made {
            deck: self.deck.display().to_string(),
            mesh: self.mesh.display().to_string(),
            refine: self.options.refine,
            parameters: self.members[member].values.iter().cloned().collect(),
        }
    }

    /// Whether a member has come to its end before, with what deck and mesh are now.
    fn is_done(&self, member: usize) -> bool {
        let path = self.summary_of(member);
        let record = Record::read(&path).filter(|record| record.is_complete() && record.is_of(&self.made_of(member)));
        record.is_some() && is_newer(&path, &self.inputs)
    }

    /// Runs members until none is left, or somebody wants it to end.
    fn run_all(&self, open: Vec<usize>, wishes: &Wishes) -> Result<Request, Failure> {
        let (count, mut waiting, mut ended) = (open.len(), open.into_iter(), 0);
        let mut running: Vec<Running> = Vec::new();
        let mut wish = Request::Continue;
        loop {
            while wish == Request::Continue && running.len() < self.jobs() {
                let Some(member) = waiting.next() else { break };
                running.push(Running { member, child: self.start(member)? });
            }
            if running.is_empty() {
                return Ok(wish);
            }
            std::thread::sleep(LOOK_INTERVAL);
            if wish == Request::Continue {
                wish = wishes.now();
                if wish != Request::Continue {
                    running.iter().for_each(|run| self.ask_to_end(run.member));
                }
            }
            let mut still = Vec::new();
            for mut run in running {
                match run.child.try_wait() {
                    Ok(None) => still.push(run),
                    _ => {
                        ended += 1;
                        say(format_args!("{ended} of {count}: {}", self.told(run.member)));
                    }
                }
            }
            running = still;
        }
    }

    /// Starts a run. What it says goes to a file beside its results.
    fn start(&self, member: usize) -> Result<Child, Failure> {
        let folder = self.folder_of(member);
        let cannot =
            |e: std::io::Error| Failure::run(format_args!("error: cannot start the run in {}: {e}", folder.display()));
        std::fs::create_dir_all(&folder).map_err(cannot)?;
        let summary = self.summary_of(member);
        let files = self.files_of(member);
        Inputs::default()
            .with("an input of the study", &self.inputs)
            .spare([&summary, &files.plot], "name another folder with --output")?;
        // A summary from before must not stand for this run, should it be killed.
        let _ = std::fs::remove_file(&summary);
        let said = File::create(folder.join("terminal.txt")).map_err(cannot)?;
        let mut command = Command::new(&self.program);
        command.arg("run").arg(&self.deck).arg("--mesh").arg(&self.mesh);
        command.arg("--refine").arg(self.options.refine.to_string());
        definitions(&self.members[member]).iter().for_each(|value| {
            command.arg("-D").arg(value);
        });
        command.arg("--ranks").arg(self.options.ranks.to_string());
        command.arg("--output").arg(files.print.with_extension("")).arg("--summary").arg(&summary);
        command.stdin(Stdio::null()).stdout(said.try_clone().map_err(cannot)?).stderr(said);
        command.spawn().map_err(cannot)
    }

    /// Asks a run to write a last state and leave.
    fn ask_to_end(&self, member: usize) {
        // Where that fails, the run goes on to its end.
        let _ = File::create(self.files_of(member).shutdown);
    }

    /// How a member went, or why that is not known: wrong input leaves no summary, but words.
    fn record(&self, member: usize) -> Option<Record> {
        let folder = self.folder_of(member);
        Record::read(&self.summary_of(member)).or_else(|| {
            let said = std::fs::read_to_string(folder.join("terminal.txt")).ok()?;
            let error = said.lines().find_map(|line| line.strip_prefix("error: "));
            Some(Record::lost(error.unwrap_or("it ended without a word").to_owned()))
        })
    }

    /// A line on a member that has ended.
    fn told(&self, member: usize) -> String {
        let words = self.members[member].words();
        match self.record(member) {
            Some(record) if record.is_complete() => {
                let error =
                    record.energy_error.map_or(String::new(), |e| format!(", energy error {}", scientific(e, 1)));
                let warned =
                    if record.warnings > 0 { format!(", {} warnings", record.warnings) } else { String::new() };
                format!("{words}: {} steps in {:.1} s{error}{warned}", record.steps, record.seconds)
            }
            Some(record) => format!("{words}: {}: {}", record.ended, record.reason.unwrap_or_default()),
            None => format!("{words}: failed"),
        }
    }

    /// All members with what came of them.
    fn rows(&self) -> Vec<Row> {
        let row = |member: usize| {
            let record = self.record(member);
            let files = self.files_of(member);
            let found = match record.as_ref().is_some_and(Record::is_complete) {
                true => sweep::found(&files.plot, &files.history, &self.wanted).map_err(|error| error.to_string()),
                false => Ok(Vec::new()),
            };
            Row { member: self.members[member].clone(), record, found }
        };
        (0..self.members.len()).map(row).collect()
    }

    /// Says what is to be done where a run has come to its end and its results cannot be read: its summary keeps it from being
    /// run again.
    fn tell_unreadable(&self, rows: &[Row]) {
        for (member, row) in rows.iter().enumerate().filter(|(_, row)| row.found.is_err()) {
            let files = self.files_of(member);
            let is_bad = |path: &PathBuf| Results::open(path).is_err();
            // A history is not there in every study.
            if is_bad(&files.plot) || (files.history.exists() && is_bad(&files.history)) {
                complain(format_args!(
                    "warning: {} has ended well before, and its results are cut or gone\n\
                     help: delete the folder {} and run the study again, and only this is run anew",
                    row.member.words(),
                    self.folder_of(member).display()
                ));
            }
        }
    }

    /// Table and pictures.
    fn write(&self, rows: &[Row]) -> Result<(), Failure> {
        let cannot =
            |path: &Path, e: std::io::Error| Failure::run(format_args!("error: cannot write {}: {e}", path.display()));
        let table = sweep::text(rows);
        for (name, text) in [("table.txt", &table), ("table.csv", &sweep::csv(rows))] {
            let path = self.folder.join(name);
            files::replace(&path, text.as_bytes()).map_err(|e| cannot(&path, e))?;
        }
        say(format_args!("\n{}", table.trim_end()));
        let made = sweep::pictures(&self.folder, &self.title, &self.axes, rows);
        let made = made.map_err(|error| Failure::run(format_args!("error: {error}")))?;
        let names = ["table.txt", "table.csv"].map(|name| self.folder.join(name)).into_iter().chain(made);
        say(format_args!("\n{}", names.map(|name| name.display().to_string()).collect::<Vec<_>>().join("  ")));
        for row in rows.iter().filter(|row| row.record.as_ref().is_some_and(|record| !record.is_complete())) {
            let folder = self.folder.join(row.member.name());
            complain(format_args!(
                "error: {} has failed: see {}",
                row.member.words(),
                folder.join("terminal.txt").display()
            ));
        }
        Ok(())
    }
}

/// A member's values as options -D take them.
fn definitions(member: &Member) -> Vec<String> {
    member.values.iter().map(|(name, value)| format!("{name}={value}")).collect()
}
