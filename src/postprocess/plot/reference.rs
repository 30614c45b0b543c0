//! Curves from a file of numbers: what was measured, or computed by others.

use std::io::ErrorKind;
use std::path::Path;

use super::PlotError;
use super::curve::Curve;

/// The curves of a file of comma-separated values: the first column is what the others are over.
///
/// Commas, semicolons, tabs or blanks stand between; lines that begin with # are left out; a first line of words names
/// the columns. An empty field has no value.
///
/// # Errors
/// When the file cannot be read, or a line does not fit the first one.
pub fn read(path: &Path) -> Result<Vec<Curve>, PlotError> {
    let wrong = |line: Option<usize>, what: String| PlotError::Numbers { path: path.to_owned(), line, what };
    let text = std::fs::read_to_string(path).map_err(|e| match e.kind() {
        ErrorKind::InvalidData => wrong(None, "is no text: expected columns of numbers, as in a CSV file".to_owned()),
        _ => wrong(None, format!("cannot be read: {e}")),
    })?;
    let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim().trim_start_matches('\u{feff}')));
    let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#')).peekable();
    let mut names: Vec<String> = Vec::new();
    if let Some((_, line)) = lines.next_if(|(_, line)| fields(line).iter().any(|field| number(field).is_none())) {
        names = fields(line);
    }
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for (place, line) in lines {
        let row: Option<Vec<f64>> = fields(line).iter().map(|field| number(field)).collect();
        let row = row.ok_or_else(|| wrong(Some(place), format!("expected numbers, got {line:?}")))?;
        if columns.is_empty() {
            columns = vec![Vec::new(); row.len()];
        }
        if row.len() != columns.len() {
            return Err(wrong(Some(place), format!("{} numbers where {} belong", row.len(), columns.len())));
        }
        columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
    }
    if columns.len() < 2 {
        return Err(wrong(None, "expected two columns of numbers or more".to_owned()));
    }
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let x = columns.remove(0);
    let label = |i: usize| match names.get(i + 1) {
        Some(name) if !name.is_empty() => format!("{stem}: {name}"),
        _ => stem.clone(),
    };
    let curves = columns.into_iter().enumerate();
    Ok(curves.map(|(i, y)| Curve { points: true, reference: true, ..Curve::of(label(i), x.clone(), y) }).collect())
}

fn fields(line: &str) -> Vec<String> {
    let separator = [',', ';', '\t'].into_iter().find(|&separator| line.contains(separator));
    match separator {
        Some(separator) => line.split(separator).map(|field| field.trim().trim_matches('"').to_owned()).collect(),
        None => line.split_whitespace().map(str::to_owned).collect(),
    }
}

/// A number; an empty field and NaN are none.
fn number(field: &str) -> Option<f64> {
    if field.is_empty() { Some(f64::NAN) } else { field.parse().ok() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Vec<Curve>, PlotError> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        read(file.path())
    }

    #[test]
    fn columns_become_curves() {
        let curves = parse("# test 7\ntime; force; gap\n0;1;\n1e-3;2;0.5\n").unwrap();
        assert_eq!((curves.len(), curves[0].y.clone(), curves[1].x.clone()), (2, vec![1.0, 2.0], vec![0.0, 1e-3]));
        assert!(curves[0].label.ends_with(": force") && curves[1].y[0].is_nan());
        assert_eq!(parse("0 1\n2 3\n").unwrap()[0].y, [1.0, 3.0]);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        assert!(parse("0,1\n2\n").unwrap_err().to_string().contains("line 2"));
        assert!(parse("0,1\n2,x\n").unwrap_err().to_string().contains("expected numbers"));
        assert!(parse("").unwrap_err().to_string().contains("two columns"));
        assert!(parse("1\n2\n").unwrap_err().to_string().contains("two columns"));
    }
}
