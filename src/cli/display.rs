//! Progress: a live bar on a terminal, plain lines otherwise.

use super::terminal::{complain, say};
use crate::output::print::{StepLine, scientific, warning_on_terminal};
use crate::run::Display;
use crate::solver::Finding;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// The display that suits the user's terminal.
pub fn display(quiet: bool, termination_time: f64, elements: usize) -> Box<dyn Display + Send> {
    if quiet {
        Box::new(OnlyWarnings)
    } else if std::io::stderr().is_terminal() {
        Box::new(Bar::new(termination_time, elements))
    } else {
        Box::new(Lines { header: false })
    }
}

/// Nothing but what must be known.
struct OnlyWarnings;

impl Display for OnlyWarnings {
    fn line(&mut self, _: &StepLine) {}

    fn warning(&mut self, finding: &Finding) {
        complain(warning_on_terminal(finding));
    }

    fn progress(&mut self, _: u64, _: f64, _: f64) {}

    fn finish(&mut self) {}
}

/// One plain line per OUTPUT TIME on the standard output.
struct Lines {
    header: bool,
}

impl Display for Lines {
    fn line(&mut self, line: &StepLine) {
        if !std::mem::replace(&mut self.header, true) {
            let heads = ["step", "time", "time step", "kinetic", "energy error", "ns/element"];
            say(heads.map(|head| format!("{head:>13}")).concat());
        }
        let cells = [
            line.step.to_string(),
            scientific(line.time, 5),
            scientific(line.time_step, 4),
            scientific(line.totals.kinetic, 4),
            scientific(line.totals.relative_error(line.initial_energy), 1),
            format!("{:.1}", line.grind * 1e9),
        ];
        say(cells.map(|cell| format!("{cell:>13}")).concat());
    }

    fn warning(&mut self, finding: &Finding) {
        complain(warning_on_terminal(finding));
    }

    fn progress(&mut self, _: u64, _: f64, _: f64) {}

    fn finish(&mut self) {}
}

/// A live bar: time, step size, energy error, grind time, time left.
struct Bar {
    bar: ProgressBar,
    termination_time: f64,
    elements: usize,
    begun: Instant,
    drawn: Instant,
    energy_error: f64,
}

/// Positions of the bar.
const LENGTH: u64 = 1000;
/// Time between redraws.
const REDRAW: Duration = Duration::from_millis(100);

impl Bar {
    fn new(termination_time: f64, elements: usize) -> Bar {
        let bar = ProgressBar::with_draw_target(Some(LENGTH), ProgressDrawTarget::stderr());
        let template = "{bar:18.cyan/blue} {percent:>3}%  {msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        let now = Instant::now();
        Bar { bar, termination_time, elements, begun: now, drawn: now, energy_error: 0.0 }
    }
}

impl Display for Bar {
    fn line(&mut self, line: &StepLine) {
        self.energy_error = line.totals.relative_error(line.initial_energy);
    }

    fn warning(&mut self, finding: &Finding) {
        self.bar.suspend(|| complain(warning_on_terminal(finding)));
    }

    fn progress(&mut self, step: u64, time: f64, time_step: f64) {
        if !step.is_multiple_of(16) || self.drawn.elapsed() < REDRAW {
            return;
        }
        self.drawn = Instant::now();
        let done = (time / self.termination_time).clamp(0.0, 1.0);
        let elapsed = self.begun.elapsed().as_secs_f64();
        let left = if done > 0.0 { elapsed * (1.0 - done) / done } else { 0.0 };
        let grind = elapsed * 1e9 / (step.max(1) as f64 * self.elements as f64);
        self.bar.set_position((done * LENGTH as f64) as u64);
        // What matters most comes first: narrow terminals cut the rest off.
        self.bar.set_message(format!(
            "{:#} left  t {}  dt {}  energy error {}  {grind:.0} ns/element",
            indicatif::HumanDuration(Duration::from_secs_f64(left.min(1e9))),
            scientific(time, 3),
            scientific(time_step, 1),
            scientific(self.energy_error, 0),
        ));
    }

    fn finish(&mut self) {
        self.bar.finish_and_clear();
    }
}
