//! A few numbers for each variable and state, from which a later run tells what has become different, and how much.
//!
//! The numbers are there to be read: six digits, with round-off shown as zero. What holds every bit is a table of hashes at
//! the end, one for each variable and state. So a rounding that has changed somewhere changes that table and hardly a line
//! above it, and what did change above it is worth reading.

use std::fmt::{self, Write};
use urto::exodus::{Difference, Place, Results, ResultsError};

/// Part of the largest value of a family of variables below which a number is round-off.
const ROUND_OFF: f64 = 1e-9;

/// Global variables that are energies: one may be nothing but the round-off of another.
const ENERGIES: [&str; 8] = ["KE", "IE", "HGE", "BVE", "FRICE", "DEADE", "EXTW", "CONTE"];

/// Element variables that are stresses.
const STRESSES: [&str; 4] = ["SIG", "TAU", "PRESSURE", "VONMISES"];

/// Results in short.
pub struct Digest {
    /// States, nodes, elements.
    counts: [usize; 3],
    lines: Vec<Line>,
}

/// One variable in one state.
#[derive(Debug, Clone, PartialEq)]
struct Line {
    /// `nodal variable DISPLX`, as `urto diff` calls it.
    variable: String,
    /// From 1; 0 for what does not change with time.
    state: usize,
    shown: Shown,
    /// Hash of all bits.
    bits: u64,
}

/// What is shown of the values of a variable in a state, each number with as many digits as are written.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Shown {
    /// The value of what has no place.
    Scalar(f64),
    /// Least and greatest value with the first place, by the analyst's number, that has it but for round-off, 0 where all
    /// values are round-off; and the mean of the absolute values.
    Field { extremes: [(f64, i64); 2], size: f64 },
}

/// Variables that are measured by the largest of their values: components of one vector or tensor, and all energies.
fn family(variable: &str) -> &str {
    let name = variable.rsplit(' ').next().unwrap_or_default();
    if ENERGIES.contains(&name) {
        return "energy";
    }
    if STRESSES.iter().any(|stress| name.starts_with(stress)) {
        return "stress";
    }
    let axes = ['X', 'Y', 'Z', 'x', 'y', 'z'];
    // Momenta have their axis in front, all others behind.
    let stem = if name.ends_with("MOM") { name.trim_start_matches(axes) } else { name.trim_end_matches(axes) };
    if stem.is_empty() { variable.split(' ').next().unwrap_or_default() } else { stem }
}

/// A number as it is written: six digits, zero for round-off of something as large as `scale`.
fn rounded(value: f64, scale: f64) -> f64 {
    if value.abs() <= ROUND_OFF * scale { 0.0 } else { format!("{value:.5e}").parse().unwrap_or(value) }
}

/// All values of a variable in a state, with the numbers of what they belong to; none for a scalar.
struct Values<'a> {
    variable: String,
    state: usize,
    values: Vec<f64>,
    ids: &'a [i64],
}

impl Values<'_> {
    fn largest(&self) -> f64 {
        self.values.iter().fold(0.0, |most, value| value.abs().max(most))
    }

    fn line(&self, scale: f64) -> Line {
        let extreme = |sign: f64| {
            let most = self.values.iter().fold(f64::NEG_INFINITY, |most, value| (sign * value).max(most));
            let near = |value: &f64| sign * value >= most - ROUND_OFF * scale;
            let value = rounded(sign * most, scale);
            let place = if value == 0.0 { None } else { self.values.iter().position(near) };
            (value, place.and_then(|place| self.ids.get(place)).copied().unwrap_or(0))
        };
        let shown = match (&self.values[..], self.ids) {
            ([value], []) => Shown::Scalar(rounded(*value, scale)),
            _ => {
                let sum = self.values.iter().fold(0.0, |sum, value| sum + value.abs());
                let size = rounded(sum / self.values.len().max(1) as f64, scale);
                Shown::Field { extremes: [extreme(-1.0), extreme(1.0)], size }
            }
        };
        Line { variable: self.variable.clone(), state: self.state, shown, bits: hash(&self.values) }
    }
}

impl Line {
    /// The numbers that are set against those of another line, with what they are.
    fn numbers(&self) -> Vec<(String, f64)> {
        match self.shown {
            Shown::Scalar(value) => vec![(String::new(), value)],
            Shown::Field { extremes: [(least, low), (greatest, high)], size } => {
                let kind = if self.variable.starts_with("element") { "element" } else { "node" };
                vec![
                    (format!("the least, {kind} {low}"), least),
                    (format!("the greatest, {kind} {high}"), greatest),
                    ("the mean size".to_string(), size),
                ]
            }
        }
    }
}

/// FNV-1a over the bytes of all values.
fn hash(values: &[f64]) -> u64 {
    let bytes = values.iter().flat_map(|value| value.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}

impl Digest {
    /// Reads all variables in all states.
    pub fn of(results: &Results) -> Result<Digest, ResultsError> {
        let mesh = results.mesh()?;
        let mut all: Vec<Values> = Vec::new();
        let mut add = |variable: String, state: usize, values: Vec<f64>, ids| {
            all.push(Values { variable, state, values, ids });
        };
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let values = mesh.coordinates.iter().map(|position| position[axis]).collect();
            add(format!("coordinate {name}"), 0, values, &mesh.node_ids);
        }
        for (state, &time) in results.times().iter().enumerate() {
            add("time".into(), state + 1, vec![time], &[]);
            for (name, value) in results.global_names().iter().zip(results.global(state)?) {
                add(format!("global variable {name}"), state + 1, vec![value], &[]);
            }
            for name in results.nodal_names() {
                add(format!("nodal variable {name}"), state + 1, results.nodal(name, state)?, &mesh.node_ids);
            }
            for name in results.element_names() {
                add(format!("element variable {name}"), state + 1, results.element(name, state)?, &mesh.element_ids);
            }
        }
        let lines = all.iter().map(|values| {
            // An imbalance is a part of the energies already.
            let own = if values.variable.ends_with("EBAL") { 1.0 } else { 0.0 };
            let relatives = all.iter().filter(|other| family(&other.variable) == family(&values.variable));
            values.line(relatives.map(Values::largest).fold(own, f64::max))
        });
        Ok(Digest {
            counts: [results.times().len(), mesh.coordinates.len(), mesh.element_count()],
            lines: lines.collect(),
        })
    }

    /// Elements times steps of the run.
    pub fn element_cycles(&self) -> f64 {
        let steps = self.of_variable("global variable NSTEPS").flat_map(|line| line.numbers());
        steps.map(|(_, steps)| steps).fold(0.0, f64::max) * self.counts[2] as f64
    }

    fn of_variable<'a>(&'a self, variable: &str) -> impl Iterator<Item = &'a Line> {
        self.lines.iter().filter(move |line| line.variable == variable)
    }

    /// Names of all variables, in order.
    fn variables(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for line in &self.lines {
            if !names.contains(&line.variable.as_str()) {
                names.push(&line.variable);
            }
        }
        names
    }

    /// The digest of a text that one was printed as.
    pub fn parse(text: &str) -> Result<Digest, String> {
        if text.is_empty() {
            return Err("there is no such file yet".into());
        }
        let mut lines = text.lines();
        let first: Vec<usize> = lines.next().unwrap_or_default().split_whitespace().flat_map(str::parse).collect();
        let counts =
            <[usize; 3]>::try_from(first).map_err(|_| "the first line does not count states, nodes, elements")?;
        let mut digest = Digest { counts, lines: Vec::new() };
        let mut part = "";
        for line in lines.filter(|line| !line.is_empty()) {
            match PARTS.iter().find(|[name, _]| line.starts_with(name)) {
                Some([name, _]) => part = name,
                None => digest.take(part, line).ok_or(format!("this is no line of a digest: {line}"))?,
            }
        }
        Ok(digest)
    }

    /// Takes in a line of a part.
    fn take(&mut self, part: &str, text: &str) -> Option<()> {
        // A longer name pushes its cells aside.
        let end = (VARIABLE..text.len()).find(|&place| text.as_bytes()[place] == b' ')?;
        let (variable, rest) = text.split_at_checked(end)?;
        let (variable, cells) = (variable.trim(), rest.split_whitespace());
        if part == FIELDS[0] {
            let cells: Vec<f64> = cells.map(str::parse).collect::<Result<_, _>>().ok()?;
            let [state, least, low, greatest, high, size] = cells[..].try_into().ok()?;
            let extremes = [(least, low as i64), (greatest, high as i64)];
            let shown = Shown::Field { extremes, size };
            self.lines.push(Line { variable: variable.into(), state: state as usize, shown, bits: 0 });
        } else if part == SCALARS[0] {
            for (state, cell) in (1..).zip(cells) {
                let shown = Shown::Scalar(cell.parse().ok()?);
                self.lines.push(Line { variable: variable.into(), state, shown, bits: 0 });
            }
        } else {
            let lines = self.lines.iter_mut().filter(|line| line.variable == variable);
            for (line, cell) in lines.zip(cells) {
                line.bits = u64::from_str_radix(cell, 16).ok()?;
            }
        }
        Some(())
    }

    /// What is different in `new`, each variable in a line, in the words of `urto diff`.
    pub fn differences(&self, new: &Digest) -> Vec<String> {
        let mut out = Vec::new();
        if self.counts != new.counts {
            out.push(format!("states, nodes, elements: {:?} and {:?}", self.counts, new.counts));
        }
        let [own, others] = [self.variables(), new.variables()];
        out.extend(own.iter().filter(|name| !others.contains(name)).map(|name| format!("only as kept: {name}")));
        out.extend(others.iter().filter(|name| !own.contains(name)).map(|name| format!("only now: {name}")));
        out.extend(own.iter().filter(|name| others.contains(name)).filter_map(|name| self.difference(new, name)));
        out
    }

    fn difference(&self, new: &Digest, variable: &str) -> Option<String> {
        let pairs: Vec<(&Line, &Line)> = self.of_variable(variable).zip(new.of_variable(variable)).collect();
        let changed: Vec<_> = pairs.iter().filter(|(a, b)| a.bits != b.bits || a.shown != b.shown).collect();
        let (first, _) = changed.first()?;
        let time = |state: usize| {
            let line = self.of_variable("time").find(|line| line.state == state);
            line.and_then(|line| line.numbers().first().map(|(_, time)| *time)).unwrap_or(0.0)
        };
        let values = changed.iter().flat_map(|(a, b)| {
            let both = a.numbers().into_iter().zip(b.numbers());
            let state = (a.state > 0).then(|| (a.state - 1, time(a.state)));
            both.map(move |((entity, x), (_, y))| Place { state, entity, values: [x, y] })
        });
        let differing: Vec<Place> = values.filter(|place| place.values[0] != place.values[1]).collect();
        let Some(largest) = differing.iter().max_by(|a, b| a.absolute().total_cmp(&b.absolute())).cloned() else {
            return Some(format!(
                "{variable}: other bits in {} of {} states, first in state {} (time {:e}); what is shown of them is the same",
                changed.len(),
                pairs.len(),
                first.state,
                time(first.state)
            ));
        };
        let compared = pairs.iter().map(|(line, _)| line.numbers().len()).sum();
        Some(Difference { variable: variable.into(), largest, compared, differing: differing.len() }.to_string())
    }
}

/// Parts of a digest: how their heads begin, and the words for the columns behind.
const SCALARS: [&str; 2] = ["numbers", ""];
const FIELDS: [&str; 2] = ["fields", "state least at greatest at mean-size"];
const BITS: [&str; 2] = ["bits", ""];
const PARTS: [[&str; 2]; 3] = [SCALARS, FIELDS, BITS];

/// Widths of the first column, of a scalar or hash, and of the columns of fields.
const VARIABLE: usize = 26;
const COLUMN: usize = 18;
const COLUMNS: [usize; 6] = [7, 14, 9, 14, 9, 14];

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [states, nodes, elements] = self.counts;
        writeln!(f, "{states} states  {nodes} nodes  {elements} elements")?;
        let numbered: Vec<String> = (1..=states).map(|state| format!("state {state}")).collect();
        writeln!(f, "\n{}", row(SCALARS[0], &numbered, &[COLUMN; 1]))?;
        for variable in self.variables() {
            let cells: Vec<String> = (self.of_variable(variable))
                .filter_map(
                    |line| if let Shown::Scalar(value) = line.shown { Some(format!("{value:e}")) } else { None },
                )
                .collect();
            if !cells.is_empty() {
                writeln!(f, "{}", row(variable, &cells, &[COLUMN; 1]))?;
            }
        }
        let words: Vec<&str> = FIELDS[1].split(' ').collect();
        writeln!(f, "\n{}", row(FIELDS[0], &words, &COLUMNS))?;
        for line in self.variables().into_iter().flat_map(|variable| self.of_variable(variable)) {
            let Shown::Field { extremes: [(least, low), (greatest, high)], size } = line.shown else { continue };
            let state = line.state.to_string();
            let real = |value: f64| format!("{value:e}");
            let cells = [state, real(least), low.to_string(), real(greatest), high.to_string(), real(size)];
            writeln!(f, "{}", row(&line.variable, &cells, &COLUMNS))?;
        }
        writeln!(f, "\n{}", row(BITS[0], &numbered, &[COLUMN; 1]))?;
        for variable in self.variables() {
            let cells: Vec<String> = self.of_variable(variable).map(|line| format!("{:016x}", line.bits)).collect();
            writeln!(f, "{}", row(variable, &cells, &[COLUMN; 1]))?;
        }
        Ok(())
    }
}

/// Cells in columns; the last width goes for all that follow.
fn row(variable: &str, cells: &[impl AsRef<str>], widths: &[usize]) -> String {
    let mut out = format!("{variable:<VARIABLE$}");
    for (place, cell) in cells.iter().enumerate() {
        let width = widths[place.min(widths.len() - 1)];
        let _ = write!(out, "{:>width$}", cell.as_ref());
    }
    out
}

#[cfg(test)]
fn example(values: [f64; 3]) -> Digest {
    let of = |variable: &str, values: &[f64], ids| {
        Values { variable: variable.into(), state: 1, values: values.to_vec(), ids }.line(2.0)
    };
    let ids = &[17, 12, 5];
    Digest { counts: [1, 20, 4], lines: vec![of("time", &[5e-6], &[]), of("nodal variable DISPLX", &values, ids)] }
}

#[test]
fn a_difference_is_told_as_by_urto_diff() {
    let kept = Digest::parse(&example([-1.0, 2.0, 0.5]).to_string()).expect("what was printed can be read");
    assert!(kept.differences(&example([-1.0, 2.0, 0.5])).is_empty());
    let told = "nodal variable DISPLX: 1 of 3 values differ, most in state 1 (time 5e-6) at the greatest, node 12: 2e0 and \
                2.5e0, difference 5.000e-1, relative 2.000e-1";
    let found = kept.differences(&example([-1.0, 2.5, 0.0]));
    assert_eq!(found, [told]);
}

/// Zero instead of 1e-20, and another last bit at the greatest: what is read stays, the bits tell.
#[test]
fn another_rounding_changes_one_line() {
    let [old, new] = [example([-1e-20, 2.0, 2.0]), example([0.0, 2.0f64.next_down(), 2.0])];
    let told = old.differences(&new);
    assert!(told.len() == 1 && told[0].contains("other bits in 1 of 1 states"), "{told:?}");
    let [old, new] = [old, new].map(|digest| digest.to_string());
    let changed: Vec<&str> = new.lines().zip(old.lines()).filter(|(a, b)| a != b).map(|(a, _)| a).collect();
    assert!(changed.len() == 1 && changed[0].starts_with("nodal variable DISPLX"), "{changed:?}");
    assert!(new.contains("0e0        0           2e0       12"), "{new}");
}
