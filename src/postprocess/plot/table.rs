//! Curves as numbers: comma-separated values for other programs.

use super::curve::Curve;

/// The curves as comma-separated values with a line of names.
///
/// Curves over the same values stand beside each other behind one column of these; each other curve follows with its own.
/// Every number has the digits that bring it back to the bit. Where a curve has ended or has no value, the field is
/// empty.
pub fn csv(curves: &[Curve], over: &str) -> String {
    let mut columns: Vec<(String, &[f64])> = Vec::new();
    let mut before: Option<&[f64]> = None;
    for curve in curves {
        if before.is_none_or(|x| !same(x, &curve.x)) {
            columns.push((over.to_owned(), &curve.x));
            before = Some(&curve.x);
        }
        columns.push((curve.label.clone(), &curve.y));
    }
    let line = |fields: Vec<String>| fields.join(",") + "\n";
    let mut text = line(columns.iter().map(|(name, _)| quoted(name)).collect());
    let rows = columns.iter().map(|(_, values)| values.len()).max().unwrap_or(0);
    for row in 0..rows {
        let field = |values: &[f64]| match values.get(row) {
            Some(value) if value.is_finite() => number(*value),
            _ => String::new(),
        };
        text += &line(columns.iter().map(|(_, values)| field(values)).collect());
    }
    text
}

fn same(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}

/// The shortest text that is this number.
fn number(value: f64) -> String {
    let plain = value == 0.0 || (1e-3..1e6).contains(&value.abs());
    if plain { value.to_string() } else { format!("{value:e}") }
}

fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n']) { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_over_the_same_times_share_a_column() {
        let curve = |label: &str, x: &[f64], y: &[f64]| Curve::of(label, x.to_vec(), y.to_vec());
        let curves = [
            curve("A", &[0.0, 1e-9], &[1.5, f64::NAN]),
            curve("B, b", &[0.0, 1e-9], &[2.0, -3e7]),
            curve("C", &[4.0], &[0.1 + 0.2]),
        ];
        let expected = "time,A,\"B, b\",time,C\n0,1.5,2,4,0.30000000000000004\n1e-9,,-3e7,,\n";
        assert_eq!(csv(&curves, "time"), expected);
    }
}
