//! Which line is which: colours and dashes that stay apart for colour-blind eyes, and their names in rows.

use crate::postprocess::plot::curve::Curve;

/// Colours for lines on white after M. Okabe and K. Ito, Color universal design (2008), without their yellow.
const COLOURS: [[u8; 3]; 7] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [34, 34, 38], [86, 180, 233], [230, 159, 0]];
/// Dash and gap in turn, in widths of the line; one pattern for each round of colours.
const PATTERNS: [&[f64]; 4] = [&[], &[4.5, 2.2], &[1.2, 1.8], &[6.0, 1.8, 1.2, 1.8]];
/// Curves from files of numbers.
const REFERENCE: [u8; 3] = [110, 110, 116];

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    /// Red, green, blue.
    pub colour: [u8; 3],
    /// Dash and gap in turn, in widths of the line.
    pub pattern: &'static [f64],
}

/// A pen for each curve. References are grey, each dashed in its own way.
pub fn pens(curves: &[Curve]) -> Vec<Pen> {
    let (mut own, mut references) = (0, 0);
    let pen = |curve: &Curve| {
        let count = if curve.reference { &mut references } else { &mut own };
        let place = std::mem::replace(count, *count + 1);
        match curve.reference {
            true => Pen { colour: REFERENCE, pattern: PATTERNS[(place + 1) % PATTERNS.len()] },
            false => Pen {
                colour: COLOURS[place % COLOURS.len()],
                pattern: PATTERNS[place / COLOURS.len() % PATTERNS.len()],
            },
        }
    };
    curves.iter().map(pen).collect()
}

/// Where entries of these widths stand when they flow in rows of `width`: row, and place in it; and how many have room
/// in `rows`. The last place is left to say how many have none.
pub fn flow(widths: &[f64], width: f64, rows: usize) -> Vec<(usize, f64)> {
    let (mut row, mut x) = (0, 0.0);
    let mut places = Vec::new();
    for &entry in widths {
        if x > 0.0 && x + entry > width {
            (row, x) = (row + 1, 0.0);
        }
        if row >= rows {
            break;
        }
        places.push((row, x));
        x += entry;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_flow_and_end() {
        assert_eq!(
            flow(&[40.0, 40.0, 40.0, 200.0, 10.0], 100.0, 9),
            [(0, 0.0), (0, 40.0), (1, 0.0), (2, 0.0), (3, 0.0)]
        );
        assert_eq!(flow(&[60.0; 5], 100.0, 2).len(), 2);
    }
}
