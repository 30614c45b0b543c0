//! `urto run`.

use crate::cli::input::Given;
use crate::cli::outputs::{Inputs, writable};
use crate::cli::signals::Wishes;
use crate::cli::terminal::{complain, say};
use crate::cli::{DONE, FAILED, Failure, date, display, options, restart, stopped_by, summary};
use crate::comm::{self, RankFailure, launched_by_mpi};
use crate::deck::Diagnostic;
use crate::output::print::{scientific, sentence, with_warnings};
use crate::run::{self, Continuation, Display, Ended, Files, Job, Lock, Parts, Quiet, RunError};
use crate::solver::{Body, Request};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;

/// Runs a deck, on threads of this process or as one process of an MPI job.
///
/// # Errors
///
/// Input that cannot be read or has mistakes, output that cannot be written, or a run that had to stop.
pub fn run(options: &options::Run) -> Result<u8, Failure> {
    match launched_by_mpi() {
        Some(processes) => under_mpi(options, processes),
        None => on_threads(options),
    }
}

/// Advice where results would be written over an input.
const ANOTHER_BASE: &str = "results take the deck's name, or that of --output: name another with --output";

/// What a run needs besides its communicator.
pub(in crate::cli) struct Prepared {
    pub(in crate::cli) given: Given,
    pub(in crate::cli) ranks: usize,
    pub(in crate::cli) files: Files,
    /// Old results that go, and what is said of them.
    stale: Vec<PathBuf>,
    said: Vec<String>,
    split: bool,
    continuation: Option<Continuation>,
    banner: Vec<String>,
    pub(in crate::cli) qa: [String; 4],
    pub(in crate::cli) clock: [Instant; 2],
}

impl Prepared {
    fn new(
        options: &options::Run,
        ranks: usize,
        transport: &str,
        read: impl FnOnce(&options::Input) -> Result<Given, Failure>,
    ) -> Result<(Prepared, Body), Failure> {
        let begun = Instant::now();
        let mut given = read(&options.input)?;
        let clock = [begun, Instant::now()];
        let body = given.body()?;
        let base = base(options.output.as_deref(), &given.deck);
        let found = restart::find(options, &given, &body, &base)?;
        let continuation = found.map(|(path, snapshot, idle)| {
            idle.into_iter().for_each(|message| given.problem.diagnostics.push(Diagnostic::warning(message)));
            Continuation::new(path, snapshot)
        });
        let files = if continuation.is_some() { Files::continuing(&base) } else { Files::of(&base) };
        let pieces = if options.split { ranks } else { 0 };
        let stale = if continuation.is_none() { files.stale(pieces) } else { Vec::new() };
        let written = files.written(pieces);
        let restart = continuation.iter().map(|continuation| &continuation.path);
        let aside = run::aside(&files.restart);
        let outputs = written.iter().chain(&stale).chain([&aside]);
        given.inputs().spare(outputs.chain(&files.restarts_written()), ANOTHER_BASE)?;
        given.inputs().spare(&options.summary, "name another file with --summary")?;
        if let Some(summary) = options.summary.as_ref().filter(|summary| written.contains(summary)) {
            return Err(Failure::input(format_args!(
                "error: {} is a file of the results, and the summary would be written over it\n\
                 help: name another file with --summary",
                summary.display()
            )));
        }
        // A run that goes on renews its own restart states.
        Inputs::default().with("the restart file", restart).spare(&written, ANOTHER_BASE)?;
        let (day, date, time) = date::now();
        let banner = vec![
            format!("urto {}   {}", env!("CARGO_PKG_VERSION"), env!("CARGO_PKG_DESCRIPTION")),
            format!(
                "run on {day} at {time} UTC, {} as {transport}, {} vectors",
                ranks_in_words(ranks),
                crate::lanes::InstructionSet::detect().name()
            ),
            format!(
                "deck {}   mesh {}{}",
                given.deck.display(),
                given.mesh_path.display(),
                refined(options.input.refine)
            ),
        ];
        let qa = ["URTO".to_string(), env!("CARGO_PKG_VERSION").to_string(), date, time];
        let split = options.split;
        let said = Vec::new();
        Ok((Prepared { given, ranks, files, stale, said, split, continuation, banner, qa, clock }, body))
    }

    /// Makes room for the results: their folder, the old print log out of the way, and old results that the new ones do not replace.
    /// Nobody else may write them as long as the lock is kept.
    fn make_room(&mut self) -> Result<Lock, Failure> {
        let folder = self.files.print.parent().unwrap_or(Path::new(""));
        if !folder.as_os_str().is_empty() {
            std::fs::create_dir_all(folder)
                .map_err(|e| Failure::run(format_args!("error: cannot make the folder {}: {e}", folder.display())))?;
        }
        writable(folder)?;
        let lock = Lock::take(&self.files.lock).ok_or_else(|| self.taken())?;
        for path in &self.stale {
            std::fs::remove_file(path).map_err(|e| {
                Failure::run(format_args!("error: cannot remove the old results {}: {e}", path.display()))
            })?;
        }
        run::keep_old_print_files(&self.files.print)
            .map_err(|e| Failure::run(format_args!("error: cannot rename {}: {e}", self.files.print.display())))?;
        let old_states = self.set_states_aside()?;
        self.said = self.removed().into_iter().chain(old_states).collect();
        Ok(lock)
    }

    /// What is said of old results that this run does not write again.
    fn removed(&self) -> Option<String> {
        let model = &self.given.problem.model;
        let has_histories = !model.histories.is_empty() || !model.material_points.is_empty();
        let gone = self.stale.iter().filter(|path| !has_histories || **path != self.files.history);
        let gone: Vec<String> = gone.map(|path| path.display().to_string()).collect();
        let more = if gone.len() > 3 { format!(" and {} more", gone.len() - 3) } else { String::new() };
        let first = gone[..gone.len().min(3)].join(", ");
        (!gone.is_empty()).then(|| format!("results of an earlier run of this name are removed: {first}{more}"))
    }

    /// Sets states of an earlier run aside, where none is gone on from.
    fn set_states_aside(&self) -> Result<Option<String>, Failure> {
        let path = &self.files.restart;
        if self.continuation.is_some() {
            return Ok(None);
        }
        let moved = run::set_aside(path)
            .map_err(|e| Failure::run(format_args!("error: cannot rename {}: {e}", path.display())))?;
        let (path, old) = (path.display(), run::aside(path));
        Ok(moved.then(|| format!("{path} of an earlier run of this name is kept as {}", old.display())))
    }

    /// Two runs that write the same files would destroy the results of both.
    fn taken(&self) -> Failure {
        Failure::input(format_args!(
            "error: another run is writing {} and what belongs to it\n\
             help: wait until it has ended, or name another base with -o; {} is locked as long as it runs",
            self.files.print.display(),
            self.files.lock.display()
        ))
    }

    /// Says on the terminal what will run.
    fn announce(&self, quiet: bool) {
        if let Some(warnings) = self.given.warnings() {
            complain(warnings);
        }
        if quiet {
            return;
        }
        let elements = self.given.mesh.element_count();
        say(format_args!(
            "{}: {elements} elements on {}",
            self.given.problem.model.title.trim(),
            ranks_in_words(self.ranks)
        ));
        self.said.iter().for_each(say);
        if let Some(continuation) = &self.continuation {
            say(continuation.in_words());
        }
    }
}

/// How much finer a recipe's mesh is than the recipe says, in words.
fn refined(times: u32) -> String {
    if times == 1 { String::new() } else { format!(" refined {times} times") }
}

fn ranks_in_words(ranks: usize) -> String {
    if ranks == 1 { "1 rank".into() } else { format!("{ranks} ranks") }
}

/// The base name of everything written: as asked, in a folder as asked, or the deck's name here.
fn base(asked: Option<&Path>, deck: &Path) -> PathBuf {
    let name = deck.file_stem().unwrap_or_default();
    match asked {
        None => PathBuf::from(name),
        Some(folder) if folder.is_dir() || folder.as_os_str().to_string_lossy().ends_with('/') => folder.join(name),
        // The name of one of the files names them all.
        Some(file) if file.extension().is_some_and(|suffix| ["e", "o", "i", "g", "h"].iter().any(|s| suffix == *s)) => {
            file.with_extension("")
        }
        Some(base) => base.to_path_buf(),
    }
}

/// Does `work` with everything that ranks share: the job, with its parts for the ranks of this process.
fn with_job<T>(
    prepared: &Prepared,
    parts: &Parts,
    wish: &(dyn Fn() -> Request + Sync),
    work: impl FnOnce(&Job) -> T,
) -> T {
    let problem = &prepared.given.problem;
    let assumed: Vec<String> = problem.diagnostics.notes().map(|note| note.message.clone()).collect();
    let warnings: Vec<String> = prepared.given.warning_messages().collect();
    work(&Job {
        mesh: &prepared.given.mesh,
        model: &problem.model,
        deck: problem.deck.source.text(),
        assumed: &assumed,
        warnings: &warnings,
        clock: prepared.clock,
        banner: &prepared.banner,
        qa: prepared.qa.clone(),
        files: &prepared.files,
        parts,
        continuation: prepared.continuation.as_ref(),
        split: prepared.split,
        wish,
    })
}

fn listen(prepared: &Prepared) -> Result<Wishes, Failure> {
    Wishes::listen(prepared.files.shutdown.clone())
        .map_err(|e| Failure::run(format_args!("error: cannot listen for signals and the shutdown file: {e}")))
}

fn screen(prepared: &Prepared, quiet: bool) -> Box<dyn Display + Send> {
    let given = &prepared.given;
    display::display(quiet, given.problem.model.termination_time, given.mesh.element_count())
}

fn on_threads(options: &options::Run) -> Result<u8, Failure> {
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
    let ranks = options.ranks.map_or(cores, |n| n as usize);
    let (mut prepared, body) = Prepared::new(options, ranks, "threads", Given::read)?;
    let _lock = prepared.make_room()?;
    prepared.announce(options.quiet);
    let wishes = listen(&prepared)?;
    let screen = Mutex::new(Some(screen(&prepared, options.quiet)));
    let parts = Parts::new(body, ranks, 0..ranks);
    let outcome = with_job(&prepared, &parts, &|| wishes.now(), |job| {
        comm::run_threads(ranks, |comm| {
            let own = if comm.rank() == 0 { screen.lock().ok().and_then(|mut screen| screen.take()) } else { None };
            run::run(job, comm, own.unwrap_or(Box::new(Quiet)).as_mut())
        })
    });
    match outcome {
        Ok(ended) => {
            wishes.obeyed();
            let code = report(&prepared, options.quiet, options.strict, ended.first());
            match ended.first() {
                Some(ended) => summary::write(options, &prepared, Ok(ended), code).map(|()| code),
                None => Ok(code),
            }
        }
        Err(RankFailure::Failed { error, .. }) => Err(failed(options, &prepared, &error)),
        Err(other) => Err(Failure::run(format_args!("error: {other}"))),
    }
}

/// The processes of a job, as readers of one file.
#[cfg(feature = "mpi")]
struct Processes<'a>(&'a mut comm::mpi::World);

#[cfg(feature = "mpi")]
impl crate::exodus::Together for Processes<'_> {
    fn place(&self) -> (usize, usize) {
        use crate::comm::Communicator;
        (self.0.rank(), self.0.size())
    }

    /// Through the first process, one slab after the other, so that no process holds more than one beside its own.
    fn all(&mut self, own: Vec<u8>, take: &mut dyn FnMut(&[u8])) {
        use crate::comm::Communicator;
        let mut slabs = self.0.gather(own).unwrap_or_default().into_iter();
        for _ in 0..self.0.size() {
            let mut slab = slabs.next().unwrap_or_default();
            self.0.broadcast(&mut slab);
            take(&slab);
        }
    }
}

#[cfg(feature = "mpi")]
fn under_mpi(options: &options::Run, _: usize) -> Result<u8, Failure> {
    use crate::comm::Communicator;
    let mut world =
        comm::mpi::World::start().map_err(|e| Failure::run(format_args!("error: cannot start MPI: {e}")))?;
    let (rank, ranks) = (world.rank(), world.size());
    if options.ranks.is_some_and(|asked| asked as usize != ranks) {
        return all_leave(
            &mut world,
            Failure::input("error: under mpiexec the number of ranks is that of its processes; leave --ranks out"),
        );
    }
    let read = |input: &options::Input| Given::read_together(input, &mut Processes(&mut world));
    let prepared = Prepared::new(options, ranks, "MPI processes", read).and_then(|(mut prepared, body)| {
        let mut lock = None;
        if rank == 0 {
            lock = Some(prepared.make_room()?);
            prepared.announce(options.quiet);
        }
        let wishes = listen(&prepared)?;
        Ok((prepared, body, wishes, lock))
    });
    // One process may fail to read what the others could: all leave together.
    let mut good = [if prepared.is_ok() { 1.0 } else { 0.0 }];
    world.all_min(&mut good);
    let (prepared, body, wishes, _lock) = match prepared {
        // Rank 0 reads the same files, so as a rule it has the words; where only another rank failed, that one tells.
        Ok(_) if good[0] == 0.0 => return all_leave(&mut world, Failure::input("")),
        Ok(prepared) => prepared,
        Err(failure) => return all_leave(&mut world, failure),
    };
    let mut screen: Box<dyn Display + Send> =
        if rank == 0 { screen(&prepared, options.quiet) } else { Box::new(Quiet) };
    let parts = Parts::new(body, ranks, rank..rank + 1);
    let outcome = with_job(&prepared, &parts, &|| wishes.now(), |job| run::run(job, &mut world, screen.as_mut()));
    match outcome {
        Ok(ended) => {
            wishes.obeyed();
            let code = report(&prepared, options.quiet || rank != 0, options.strict && rank == 0, Some(&ended));
            if rank == 0 {
                summary::write(options, &prepared, Ok(&ended), code)?;
            }
            Ok(code)
        }
        Err(error) if rank == 0 => {
            let failure = failed(options, &prepared, &error);
            all_leave(&mut world, failure)
        }
        Err(error) => all_leave(&mut world, failure(&error)),
    }
}

/// The same failure on every rank is told once, by the first rank that has words for it, and before any rank leaves:
/// a launcher kills what still runs when one process ends with an error. The others leave with it, quietly.
#[cfg(feature = "mpi")]
fn all_leave(world: &mut comm::mpi::World, failure: Failure) -> Result<u8, Failure> {
    use crate::comm::Communicator;
    let rank = world.rank();
    let mut speaker = [if failure.message.is_empty() { f64::INFINITY } else { rank as f64 }];
    world.all_min(&mut speaker);
    if speaker[0] == rank as f64 {
        complain(&failure.message);
    }
    world.barrier();
    Ok(if rank == 0 { failure.code } else { DONE })
}

#[cfg(not(feature = "mpi"))]
fn under_mpi(options: &options::Run, processes: usize) -> Result<u8, Failure> {
    if processes > 1 {
        return Err(Failure::input(
            "error: started by an MPI launcher, but this urto was built without MPI\n\
             help: build it with `cargo build --release --features mpi`, or run it without mpiexec: it uses all cores",
        ));
    }
    on_threads(options)
}

/// Tells how the run ended and picks the exit code.
fn report(prepared: &Prepared, quiet: bool, strict: bool, ended: Option<&Ended>) -> u8 {
    let Some(ended) = ended else { return FAILED };
    let warnings = with_warnings(&ended.warnings);
    if !quiet {
        let how = match ended.by {
            Request::Continue => "done",
            _ => "stopped on request",
        };
        say(format_args!(
            "{how}: {} steps to time {} in {:.2} s, {:.0} ns per element and cycle, energy error {}{warnings}",
            ended.steps,
            scientific(ended.time, 6),
            ended.wall,
            ended.grind * 1e9,
            scientific(ended.energy_error, 1)
        ));
        let (plot, print) = (prepared.files.plot.display(), prepared.files.print.display());
        if prepared.split {
            let ranks = prepared.ranks;
            say(format_args!(
                "{} plot states: {plot}.{ranks}.*, which urto join {plot} joins   log: {print}",
                ended.states
            ));
        } else {
            say(format_args!("{} plot states: {plot}   log: {print}", ended.states));
        }
        if !ended.advice.is_empty() {
            let first = &ended.advice[0].0;
            let more =
                if ended.advice.len() > 1 { format!(", and {} more", ended.advice.len() - 1) } else { String::new() };
            say(format_args!("advice: {}{more}: see the end of {print}", sentence(first)));
        }
        if ended.restart {
            say(format_args!("to go on from here: {}", prepared.files.restart.display()));
        }
    }
    let failed = strict && !warnings.is_empty();
    if failed {
        complain(format_args!("error: the run ended{warnings}; --strict makes that a failure"));
    }
    match ended.by {
        Request::Continue | Request::Shutdown if failed => FAILED,
        Request::Continue | Request::Shutdown => DONE,
        Request::Signal(signal) => stopped_by(signal),
    }
}

/// What is told of a run that failed, with its summary written.
fn failed(options: &options::Run, prepared: &Prepared, error: &RunError) -> Failure {
    let mut failure = failure(error);
    if let Err(unwritten) = summary::write(options, prepared, Err(error), failure.code) {
        failure.message += &format!("\n{}", unwritten.message);
    }
    failure
}

fn failure(error: &RunError) -> Failure {
    match error {
        RunError::Stopped { stop, unwritten, .. } => {
            let lost =
                unwritten.as_ref().map_or(String::new(), |e| format!("\nerror: its last state is not written: {e}"));
            Failure::run(format_args!("error: {error}{lost}\nhelp: {}", stop.advice().join("\nhelp: ")))
        }
        RunError::Endless(endless) => Failure::input(format_args!("error: {endless}\nhelp: {}", endless.advice())),
        _ => Failure::run(format_args!("error: {error}")),
    }
}
