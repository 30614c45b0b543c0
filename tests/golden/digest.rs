//! A few numbers for each variable and state, from which a later run tells what has become different, and how much.

use std::fmt::{self, Write};
use urto::exodus::{Difference, Place, Results, ResultsError};

/// Results in short.
pub struct Digest {
    /// States, nodes, elements.
    counts: [usize; 3],
    lines: Vec<Line>,
}

/// One variable in one state.
#[derive(Clone)]
struct Line {
    /// `nodal variable DISPLX`, as `urto diff` calls it.
    variable: String,
    /// From 1; 0 for what does not change with time.
    state: usize,
    time: f64,
    /// Least and greatest value and where they are, by the analyst's number; 0 for what has no place.
    extremes: [(f64, i64); 2],
    /// Sum of the absolute values, in the order of the file, over their number.
    size: f64,
    /// Hash of all bits.
    bits: u64,
}

impl Line {
    fn new(variable: &str, (state, time): (usize, f64), values: &[f64], ids: &[i64]) -> Line {
        let id = |place: usize| ids.get(place).copied().unwrap_or(0);
        let extreme = |better: fn(f64, f64) -> bool| {
            let start = (values.first().copied().unwrap_or(f64::NAN), id(0));
            values.iter().enumerate().fold(
                start,
                |best, (place, &value)| {
                    if better(value, best.0) { (value, id(place)) } else { best }
                },
            )
        };
        Line {
            variable: variable.into(),
            state,
            time,
            extremes: [extreme(|a, b| a < b), extreme(|a, b| a > b)],
            size: values.iter().fold(0.0, |sum, value| sum + value.abs()) / values.len().max(1) as f64,
            bits: hash(values),
        }
    }

    fn parse(text: &str) -> Option<Line> {
        let (variable, rest) = text.split_at_checked(VARIABLE)?;
        let mut cells = rest.split_whitespace();
        let mut real = || cells.next()?.parse::<f64>().ok();
        let (state, time) = (real()? as usize, real()?);
        let extremes = [(real()?, real()? as i64), (real()?, real()? as i64)];
        let (size, bits) = (real()?, cells.next()?);
        let bits = u64::from_str_radix(bits, 16).ok()?;
        Some(Line { variable: variable.trim().into(), state, time, extremes, size, bits })
    }

    /// The numbers that are set against those of another line, with what they are.
    fn numbers(&self) -> Vec<(String, f64)> {
        let [(least, low), (greatest, high)] = self.extremes;
        if low == 0 {
            return vec![(String::new(), least)];
        }
        let kind = if self.variable.starts_with("element") { "element" } else { "node" };
        vec![
            (format!("the least, {kind} {low}"), least),
            (format!("the greatest, {kind} {high}"), greatest),
            ("the mean size".to_string(), self.size),
        ]
    }

    /// Whether all values are the same, to the bit. That the times differ is told once, of the times.
    fn same(&self, other: &Line) -> bool {
        self.bits == other.bits
    }
}

/// Width of the first column.
const VARIABLE: usize = 26;

/// FNV-1a over the bytes of all values.
fn hash(values: &[f64]) -> u64 {
    let bytes = values.iter().flat_map(|value| value.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}

impl Digest {
    /// Reads all variables in all states.
    pub fn of(results: &Results) -> Result<Digest, ResultsError> {
        let mesh = results.mesh()?;
        let mut lines = Vec::new();
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let values: Vec<f64> = mesh.coordinates.iter().map(|position| position[axis]).collect();
            lines.push(Line::new(&format!("coordinate {name}"), (0, 0.0), &values, &mesh.node_ids));
        }
        let states = || results.times().iter().enumerate();
        for (state, &time) in states() {
            lines.push(Line::new("time", (state + 1, time), &[time], &[]));
        }
        let globals = states().map(|(state, _)| results.global(state)).collect::<Result<Vec<_>, _>>()?;
        for (place, name) in results.global_names().iter().enumerate() {
            let values = states().zip(&globals).map(|((state, &time), globals)| {
                Line::new(&format!("global variable {name}"), (state + 1, time), &globals[place..=place], &[])
            });
            lines.extend(values);
        }
        for name in results.nodal_names() {
            for (state, &time) in states() {
                let values = results.nodal(name, state)?;
                lines.push(Line::new(&format!("nodal variable {name}"), (state + 1, time), &values, &mesh.node_ids));
            }
        }
        for name in results.element_names() {
            for (state, &time) in states() {
                let values = results.element(name, state)?;
                lines.push(Line::new(
                    &format!("element variable {name}"),
                    (state + 1, time),
                    &values,
                    &mesh.element_ids,
                ));
            }
        }
        Ok(Digest { counts: [results.times().len(), mesh.coordinates.len(), mesh.element_count()], lines })
    }

    /// Elements times steps of the run.
    pub fn element_cycles(&self) -> f64 {
        let steps = self.lines.iter().filter(|line| line.variable == "global variable NSTEPS");
        steps.map(|line| line.size).fold(0.0, f64::max) * self.counts[2] as f64
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
        let read = lines.skip(1).map(|line| Line::parse(line).ok_or(format!("this is no line of a digest: {line}")));
        Ok(Digest { counts, lines: read.collect::<Result<_, _>>()? })
    }

    /// What is different in `new`, each variable in a line, in the words of `urto diff`.
    pub fn differences(&self, new: &Digest) -> Vec<String> {
        let mut out = Vec::new();
        if self.counts != new.counts {
            out.push(format!("states, nodes, elements: {:?} and {:?}", self.counts, new.counts));
        }
        let names = |digest: &Digest| {
            let mut names: Vec<String> = digest.lines.iter().map(|line| line.variable.clone()).collect();
            names.dedup();
            names
        };
        let [own, others] = [names(self), names(new)];
        let missing = |list: &[String], name: &String| !list.contains(name);
        out.extend(own.iter().filter(|name| missing(&others, name)).map(|name| format!("only as kept: {name}")));
        out.extend(others.iter().filter(|name| missing(&own, name)).map(|name| format!("only now: {name}")));
        out.extend(own.iter().filter(|name| !missing(&others, name)).filter_map(|name| self.difference(new, name)));
        out
    }

    fn difference(&self, new: &Digest, variable: &str) -> Option<String> {
        let of = |digest: &Digest| -> Vec<Line> {
            digest.lines.iter().filter(|line| line.variable == variable).cloned().collect()
        };
        let [own, others] = [of(self), of(new)];
        let changed = own.iter().zip(&others).filter(|(a, b)| !a.same(b));
        let (first, _) = changed.clone().next()?;
        let values = changed.clone().flat_map(|(a, b)| {
            let both = a.numbers().into_iter().zip(b.numbers());
            both.map(move |((entity, x), (_, y))| Place {
                state: (a.state > 0).then(|| (a.state - 1, a.time)),
                entity,
                values: [x, y],
            })
        });
        let differing: Vec<Place> =
            values.filter(|place| place.values[0].to_bits() != place.values[1].to_bits()).collect();
        let Some(largest) = differing.iter().max_by(|a, b| a.absolute().total_cmp(&b.absolute())).cloned() else {
            return Some(format!(
                "{variable}: other bits in {} of {} states, first in state {} (time {:e}); least, greatest and mean size are \
                 the same",
                changed.count(),
                own.len(),
                first.state,
                first.time
            ));
        };
        let (compared, differing) = (own.iter().map(|line| line.numbers().len()).sum(), differing.len());
        Some(Difference { variable: variable.into(), largest, compared, differing }.to_string())
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [states, nodes, elements] = self.counts;
        writeln!(f, "{states} states  {nodes} nodes  {elements} elements")?;
        let head = "state time least at greatest at mean-size bits";
        let head: Vec<&str> = head.split(' ').collect();
        writeln!(f, "{}", row("variable", &head))?;
        for line in &self.lines {
            let real = |value: f64| format!("{value:e}");
            let [(least, low), (greatest, high)] = line.extremes;
            let cells = [
                line.state.to_string(),
                real(line.time),
                real(least),
                low.to_string(),
                real(greatest),
                high.to_string(),
                real(line.size),
                format!("{:016x}", line.bits),
            ];
            writeln!(f, "{}", row(&line.variable, &cells))?;
        }
        Ok(())
    }
}

/// Cells in columns.
fn row(variable: &str, cells: &[impl AsRef<str>]) -> String {
    let widths = [5, 24, 25, 8, 25, 8, 25, 18];
    let mut out = format!("{variable:<VARIABLE$}");
    for (cell, width) in cells.iter().zip(widths) {
        let _ = write!(out, "{:>width$}", cell.as_ref());
    }
    out
}

#[test]
fn a_difference_is_told_as_by_urto_diff() {
    let line = |greatest: f64, bits: u64| Line {
        variable: "nodal variable DISPLX".into(),
        state: 2,
        time: 5e-6,
        extremes: [(-1.0, 17), (greatest, 12)],
        size: 0.5,
        bits,
    };
    let digest = |greatest, bits| Digest { counts: [2, 20, 4], lines: vec![line(greatest, bits)] };
    let kept = Digest::parse(&digest(2.0, 7).to_string()).expect("what was printed can be read");
    assert!(kept.differences(&digest(2.0, 7)).is_empty());
    let told = "nodal variable DISPLX: 1 of 3 values differ, most in state 2 (time 5e-6) at the greatest, node 12: 2e0 and \
                2.5e0, difference 5.000e-1, relative 2.000e-1";
    assert_eq!(kept.differences(&digest(2.5, 8)), [told]);
    let hidden = kept.differences(&digest(2.0, 8));
    assert!(hidden.len() == 1 && hidden[0].contains("other bits in 1 of 1 states"), "{hidden:?}");
}
