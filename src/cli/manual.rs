//! The man page urto.1, made from the option table: the program, each of its verbs, then what is common to them.

use crate::output::GLOBAL_VARIABLES;
use clap::Command;
use clap_mangen::Man;
use std::io::Write;

/// The page, in roff.
pub fn manual() -> String {
    // The examples of `--help` have a section of their own here.
    let mut command = super::command().after_long_help("").after_help("").disable_help_subcommand(true);
    command.build();
    let mut out = Vec::new();
    // Writing to memory does not fail.
    let page = Man::new(command.clone()).title("URTO").section("1").manual("urto manual");
    let _ = page.render_title(&mut out);
    let _ = page.render_name_section(&mut out);
    let _ = write!(out, "{SYNOPSIS}");
    let _ = page.render_description_section(&mut out);
    for verb in command.get_subcommands().filter(|verb| !verb.is_hide_set()) {
        let _ = verb_sections(verb, &mut out);
    }
    let _ = write!(out, "{}{CLOSING}", written());
    String::from_utf8_lossy(&out).into_owned()
}

/// One section with a verb's synopsis, what it does, and its options as subsections.
fn verb_sections(verb: &Command, out: &mut Vec<u8>) -> std::io::Result<()> {
    let page = Man::new(verb.clone());
    let mut part = Vec::new();
    page.render_synopsis_section(&mut part)?;
    page.render_description_section(&mut part)?;
    page.render_options_section(&mut part)?;
    writeln!(out, ".SH \"URTO {}\"", verb.get_name().to_uppercase())?;
    for line in String::from_utf8_lossy(&part).lines() {
        match line.strip_prefix(".SH ") {
            Some("OPTIONS") => writeln!(out, ".PP")?,
            // The heading of the verb stands for both.
            Some("SYNOPSIS") => {}
            Some("DESCRIPTION") => writeln!(out, ".PP")?,
            _ => writeln!(out, "{line}")?,
        }
    }
    Ok(())
}

const SYNOPSIS: &str = r".SH SYNOPSIS
.B urto
.I DECK
[\fIoptions of run\fR]
.br
.B urto
\fIVERB\fR [\fIoptions\fR]
.br
.B mpiexec \-n
.I N
.B urto
.I DECK
";

/// Columns of the print log, in its order.
const COLUMNS: [(&str, &str); 18] = [
    ("TIME STEP NUMBER", "steps taken"),
    ("CURRENT TIME", "time of the line"),
    ("KINETIC ENERGY", "of all nodes"),
    ("SECONDS PER ELEMENT CYCLE", "wall clock per element and step since the last line"),
    ("TIME DILATATION FACTOR", "seconds of wall clock per unit of problem time since the last line"),
    ("TIME STEP", "size of the next step"),
    ("SET BY ELEMENT", "number in the mesh of the element that limits the step"),
    ("OF BLOCK", "the block of that element"),
    ("INTERNAL ENERGY", "work of stresses, elastic and dissipated"),
    (
        "HOURGLASS ENERGY",
        "work of hourglass resistance; small beside the internal energy in a sound run, in fluids heat",
    ),
    ("BULK VISC. ENERGY", "dissipated by bulk viscosity"),
    ("FRICTION ENERGY", "dissipated by friction"),
    ("EXTERNAL WORK", "work of loads and prescribed motions"),
    ("CONTACT WORK", "work of normal contact forces; negative where impacts took energy out"),
    ("ERODED ENERGY", "energy of eroded elements"),
    ("ENERGY ERROR", "energy accounted for minus energy supplied, over the largest account; should stay near zero"),
    ("SECONDS TO GO", "wall clock to the termination time at the present rate"),
    ("MOMENTUM IN X, IN Y, IN Z", "of all nodes; only with STEP LOG, MOMENTUM"),
];

/// The sections on what a run writes down in numbers.
fn written() -> String {
    let terms = |list: &[(&str, &str)]| -> String {
        list.iter().map(|(name, meaning)| format!(".TP\n.B {name}\n{meaning}\n")).collect()
    };
    format!(
        ".SH \"THE PRINT LOG\"\nThe log has one line per OUTPUT TIME. STEP LOG chooses its columns. Without it they are\nPRONTO's five, the time step and its element, the seconds to go and the energy error; there are\n{}\
         .SH \"GLOBAL VARIABLES\"\nEvery state of the plot file has these numbers of the whole body:\n{}",
        terms(&COLUMNS),
        terms(&GLOBAL_VARIABLES)
    )
}

const CLOSING: &str = r#".SH FILES
All files of a run have one base name: the deck's, or that of
.BR \-\-output .
No verb writes over a file that it reads, by whatever name or link; old results are replaced, pieces and those of runs that went on with them.
.TP
.B BASE.i
The deck, see
.BR urto\-deck (5).
.TP
.B BASE.g
The mesh: GENESIS with hexahedra (HEX8), wedges (WEDGE6) and pyramids (PYRAMID5), EXODUS II in any netCDF format, or EXODUS I.
It is the whole mesh, not a piece of one that was cut for several ranks. Numbers of blocks, sets, nodes and elements may
begin with 0. Files of netCDF-4 are first read by a process of their own, of which nothing is seen: the HDF5 library does not
survive every damaged file. It reads files up to 64 MB whole, of larger ones all but the values.
.TP
.B BASE.mesh
A recipe, from which
.B urto mesh
makes BASE.g, see
.BR urto\-mesh (5).
.TP
.B BASE.o
The print log: the deck, what is modelled, masses, one line per OUTPUT TIME, the energy balance, where the time went, and
how evenly elements, contact and messages were spread over the ranks.
Older ones are kept as BASE.o.1, BASE.o.2 and so on.
.TP
.B BASE.e
The plot states, EXODUS II: for ParaView, VTK, netCDF and
.BR "urto view" .
It can be read at any instant, also while the run goes on and after it was killed.
.TP
.B BASE.e.N.0 \fRto\fP BASE.e.N.N-1
With
.BR \-\-split ,
the pieces of the plot states, one for each of N ranks, numbered in as many digits as N has: EXODUS with the arrays of
Nemesis.
.B urto join BASE.e
makes BASE.e of them.
.TP
.B BASE.h
Histories of what MATERIAL POINT and HISTORY watch, if the deck has any: an EXODUS file of the watched elements, with one state
per HISTORY TIME (else OUTPUT TIME) and global variables such as SIGZZ_1 and ACCLZ_BLOCK3, for
.BR "urto plot" .
.TP
.B BASE.shutdown
When this file appears, the run writes a last state and leaves. It is removed when it was obeyed, and one
left from before at the start.
.TP
.B BASE.lock
An empty file, locked while a run writes the others and removed at its end. A second run of the same base is refused meanwhile:
wait, or name another base with
.BR -o .
A run that was killed may leave the file, but not the lock; it is in nobody's way.
.SH "EXIT STATUS"
.TP
.B 0
Done; also when the shutdown file ended the run. For
.BR diff ,
the files are the same.
.TP
.B 1
The run failed: an inverted element, a motion that is no longer a number, a collapsing time step, energy running away,
a file that cannot be written, or a full standard output. The last state is written and the cause named. For
.BR diff ,
the files differ; a picture, a mesh or a table could not be written. A reader who closes the pipe early is no failure.
.TP
.B 2
The deck, the mesh, the results to draw or to join, or the command line is wrong; a file that is read would be written
over; or the run would take more than 1E12 steps. For
.BR diff ,
the files cannot be compared.
.TP
.BR 130 ", " 143
Stopped by SIGINT, by SIGTERM, after a last state was written; by SIGHUP, SIGUSR1, SIGUSR2 or SIGXCPU likewise, with 128 and the
number of the signal. A second signal of the same kind ends the program at once. SIGHUP is ignored where
.BR nohup
says so.
.SH ENVIRONMENT
.TP
.B NO_COLOR
When set, messages have no colours. They have none either when they do not go to a terminal.
.TP
.B URTO_SIMD
The widest vector instructions to use:
.BR portable ", " avx2 " or " avx512 .
Results do not depend on it.
.TP
.BR OMPI_COMM_WORLD_SIZE ", " PMI_SIZE " and their kin"
Set by MPI launchers. When one is there, ranks are the processes of the job, which needs a program built with the
feature
.BR mpi .
.SH EXAMPLES
.TP
.B urto check decks/taylor_bar.i
What would be modelled, the first time step, and what the run would cost.
.TP
.B urto decks/taylor_bar.i \-\-output out/case1
Runs the deck on all cores; writes out/case1.o and out/case1.e.
.TP
.B mpiexec \-n 4 urto decks/taylor_bar.i
The same on four MPI processes, with the same bits.
.TP
.B urto view out/case1.e \-\-variable EQPS \-\-mirror xy
Draws the last state, coloured by equivalent plastic strain, with the mirror images of a quarter model.
.TP
.B urto view out/case1.e \-v SIGZZ \-\-cut y=0 \-\-mirror xy \-s 2,8,last
The whole bar from its quarter, cut open, at three times side by side.
.TP
.B urto plot out/case1.e
The energies of the body over time, as case1_curves.png; with a table of what they reach.
.TP
.B urto plot a.h b.h \-v SIGZZ_1 \-\-filter CFC1000 \-o stress.svg
The stress at the first watched point in two runs, filtered, in one picture.
.TP
.B urto explain INITIAL VELOCITY MATERIAL
A command of the deck: form, fields, units, defaults, an example.
.TP
.B urto mesh meshes/taylor_bar.mesh \-o fine.g \-\-refine 2
A mesh with twice as many elements along each edge.
.TP
.B urto scale decks/bending_beam.i \-\-ranks 1,16,256 \-\-machine paragon \-\-csv beam.csv
What each rank would do and say on so many ranks, and what a step would cost on an Intel Paragon.
.TP
.B urto scale decks/bending_beam_scaled.i \-\-scaled
The same with a mesh that grows: its recipe uses the name
.BR ranks .
.TP
.B mpiexec \-n 16 urto decks/taylor_bar.i \-\-split; urto join taylor_bar.e
Every process writes its own results, which then become one file.
.TP
.B urto diff a.e b.e \-\-tolerance 1e\-6 \-\-floor 1e\-12
Whether two runs agree to six digits.
.SH "SEE ALSO"
.BR urto\-deck (5),
.BR urto\-mesh (5),
.BR mpiexec (1)
"#;
