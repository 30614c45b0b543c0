//! The members of a study as a table, for people and for other programs.

use super::Row;
use crate::output::print::scientific;

/// A number as people read it, and as another program does.
fn number(value: f64, exact: bool) -> String {
    match (value.is_finite(), exact) {
        (false, _) => String::new(),
        (true, true) => format!("{value:e}"),
        (true, false) => scientific(value, 4),
    }
}

/// Heads of the columns, then the cells of each member.
fn cells(rows: &[Row], exact: bool) -> (Vec<String>, Vec<Vec<String>>) {
    let names = rows.first().map(|row| &row.member.values).into_iter().flatten().map(|(name, _)| name.clone());
    let mut heads: Vec<String> = names.collect();
    heads.extend(["ended", "steps", "energy error", "warnings"].map(str::to_owned));
    let labels = labels(rows);
    for (label, filtered) in &labels {
        heads.extend(["last", "peak", "time of peak"].map(|what| format!("{label} {what}")));
        heads.extend(filtered.then(|| format!("{label} filtered peak")));
    }
    let line = |row: &Row| {
        let mut line: Vec<String> = row.member.values.iter().map(|(_, value)| value.clone()).collect();
        let (ended, steps, error, warnings) = match &row.record {
            Some(r) => (
                r.ended.clone(),
                r.steps.to_string(),
                r.energy_error.map_or(String::new(), |error| number(error, exact)),
                r.warnings.to_string(),
            ),
            None => ("not run".to_owned(), String::new(), String::new(), String::new()),
        };
        line.extend([ended, steps, error, warnings]);
        for (label, filtered) in &labels {
            let found = row.found.iter().flatten().find(|found| found.label == *label);
            let value =
                |pick: fn(&super::Found) -> f64| found.map_or(String::new(), |found| number(pick(found), exact));
            line.extend([value(|f| f.last), value(|f| f.peak), value(|f| f.peak_time)]);
            line.extend(filtered.then(|| value(|f| f.filtered.unwrap_or(f64::NAN))));
        }
        line
    };
    (heads, rows.iter().map(line).collect())
}

/// The variables that any member has, and whether they were filtered.
pub(super) fn labels(rows: &[Row]) -> Vec<(String, bool)> {
    let mut all: Vec<(String, bool)> = Vec::new();
    for found in rows.iter().flat_map(|row| row.found.iter().flatten()) {
        if !all.iter().any(|(label, _)| *label == found.label) {
            all.push((found.label.clone(), found.filtered.is_some()));
        }
    }
    all
}

/// The table in columns, and below it why members failed.
pub fn text(rows: &[Row]) -> String {
    let (heads, lines) = cells(rows, false);
    let width = |place: usize| {
        let cells = lines.iter().map(|line| &line[place]).chain([&heads[place]]);
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..heads.len()).map(width).collect();
    let line = |cells: &Vec<String>| {
        let cells = cells.iter().zip(&widths).map(|(cell, width)| format!("{cell:>width$}"));
        format!("{}\n", cells.collect::<Vec<_>>().join("  ").trim_end())
    };
    let mut text: String = [&heads].into_iter().chain(&lines).map(line).collect();
    for row in rows {
        let failed = row.record.as_ref().filter(|record| !record.is_complete());
        let reason = failed.map(|record| record.reason.clone().unwrap_or_else(|| "for an unknown reason".into()));
        if let Some(reason) = reason.or_else(|| row.found.as_ref().err().cloned()) {
            text += &format!("{}: {reason}\n", row.member.words());
        }
    }
    text
}

/// The table as comma-separated values, with all digits.
pub fn csv(rows: &[Row]) -> String {
    let quoted = |cell: &String| {
        let plain = !cell.contains([',', '"', '\n']);
        if plain { cell.clone() } else { format!("\"{}\"", cell.replace('"', "\"\"")) }
    };
    let line = |cells: &Vec<String>| cells.iter().map(quoted).collect::<Vec<_>>().join(",") + "\n";
    let (heads, lines) = cells(rows, true);
    [&heads].into_iter().chain(&lines).map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::super::record::Record;
    use super::super::{Found, Member};
    use super::*;

    #[test]
    fn members_that_failed_are_named_below() {
        let row = |value: &str, record, found| Row {
            member: Member { values: vec![("n".into(), value.into())] },
            record,
            found,
        };
        let mut good = Record::lost(String::new());
        (good.ended, good.steps, good.energy_error) = ("complete".into(), 12, Some(-1e-3));
        let found = Found { label: "KE, all".into(), last: 1.0, peak: -2.5, peak_time: 0.5, filtered: Some(-2.0) };
        let rows = [
            row("1", Some(good), Ok(vec![found])),
            row("2", Some(Record::lost("it broke".into())), Ok(Vec::new())),
            row("3", None, Ok(Vec::new())),
        ];
        let table = text(&rows);
        assert!(table.lines().count() == 5 && table.ends_with("n=2: it broke\n"), "{table}");
        let exact = "n,ended,steps,energy error,warnings,\"KE, all last\",\"KE, all peak\",\"KE, all time of peak\",\
                     \"KE, all filtered peak\"\n1,complete,12,-1e-3,0,1e0,-2.5e0,5e-1,-2e0\n\
                     2,failed,0,,0,,,,\n3,not run,,,,,,,\n";
        assert_eq!(csv(&rows), exact);
    }
}
