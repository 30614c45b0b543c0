//! When four moving points lie in a plane: the first root of a cubic on the unit interval.

use crate::solver::nodes::{cross, dot, subtract};

/// Halvings of an interval: enough for every bit of a double.
const HALVINGS: usize = 60;

/// Steps of Newton's method, and how near they nearly always come.
const STEPS: usize = 3;
const CLOSE: f64 = 1e-15;

/// A straight motion over one step: where a point begins and how far it goes.
pub type Path = ([f64; 3], [f64; 3]);

/// Coefficients of det(p + ṗτ, b + ḃτ, c + ċτ), lowest power first: six times the volume of the tetrahedron that four
/// points span (Heinstein et al. 1993).
pub fn coplanarity(p: Path, b: Path, c: Path) -> [f64; 4] {
    let det = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| dot(a, cross(b, c));
    let ((p, dp), (b, db), (c, dc)) = (p, b, c);
    [
        det(p, b, c),
        det(dp, b, c) + det(p, db, c) + det(p, b, dc),
        det(p, db, dc) + det(dp, b, dc) + det(dp, db, c),
        det(dp, db, dc),
    ]
}

/// Motion of `a` relative to `o`.
pub fn relative(a: Path, o: Path) -> Path {
    (subtract(a.0, o.0), subtract(a.1, o.1))
}

fn value(c: &[f64; 4], t: f64) -> f64 {
    ((c[3] * t + c[2]) * t + c[1]) * t + c[0]
}

/// Derivative of the cubic.
pub fn slope(c: &[f64; 4], t: f64) -> f64 {
    (3.0 * c[3] * t + 2.0 * c[2]) * t + c[1]
}

/// Roots of the derivative inside (0, 1), ascending; they cut the cubic into monotone pieces.
fn turning_points(c: &[f64; 4]) -> [f64; 2] {
    let (q, h, o) = (3.0 * c[3], c[2], c[1]);
    // q t² + 2 h t + o = 0 by the form that loses no digits; a vanishing q gives an infinite root, which is outside.
    let discriminant = h * h - q * o;
    if discriminant.is_nan() || discriminant < 0.0 {
        return [1.0; 2];
    }
    let s = -(h + if h < 0.0 { -discriminant.sqrt() } else { discriminant.sqrt() });
    let inside = |t: f64| if t > 0.0 && t < 1.0 { t } else { 1.0 };
    let (a, b) = (inside(s / q), inside(o / s));
    [a.min(b), a.max(b)]
}

/// Roots of the cubic in [0, 1], one per monotone piece, ascending.
pub fn roots(c: &[f64; 4]) -> impl Iterator<Item = f64> + '_ {
    let [first, second] = turning_points(c);
    [(0.0, first), (first, second), (second, 1.0)].into_iter().filter_map(move |(low, high)| piece(c, low, high))
}

/// The root on a monotone piece, in the end by halving, which needs nothing of the cubic but its sign.
fn piece(c: &[f64; 4], mut low: f64, mut high: f64) -> Option<f64> {
    let (at_low, at_high) = (value(c, low), value(c, high));
    // A root at a border belongs to the piece that ends there.
    if at_low == 0.0 {
        return (low == 0.0).then_some(low);
    }
    if low < high && at_high == 0.0 {
        return Some(high);
    }
    if at_low.signum() == at_high.signum() || at_low.is_nan() || at_high.is_nan() {
        return None;
    }
    // Nearly always the piece is nearly straight: Newton's method from its chord comes within round-off of the root, and
    // two signs around that leave little to halve. Where it does not, nothing is lost.
    let mut guess = low + (high - low) * (at_low / (at_low - at_high));
    for _ in 0..STEPS {
        guess -= value(c, guess) / slope(c, guess);
    }
    for place in [guess - CLOSE, guess + CLOSE] {
        if low < place && place < high {
            if value(c, place).signum() == at_low.signum() { low = place } else { high = place }
        }
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if value(c, middle).signum() == at_low.signum() { low = middle } else { high = middle }
    }
    Some(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(c: [f64; 4]) -> Vec<f64> {
        roots(&c).collect()
    }

    #[test]
    fn simple_roots_of_every_degree() {
        assert_eq!(all([-0.5, 1.0, 0.0, 0.0]), [0.5]);
        assert_eq!(all([1.0, 0.0, 0.0, 0.0]), [] as [f64; 0]);
        for (c, expected) in [
            // (t − ¼)(t − ¾)
            ([0.1875, -1.0, 1.0, 0.0], vec![0.25, 0.75]),
            // (t − 0.2)(t − 0.5)(t − 0.8)
            ([-0.08, 0.66, -1.5, 1.0], vec![0.2, 0.5, 0.8]),
            // A leading term that is only round-off
            ([-0.5, 1.0, 1e-17, -1e-18], vec![0.5]),
            // (t − ½)³
            ([-0.125, 0.75, -1.5, 1.0], vec![0.5]),
        ] {
            let found = all(c);
            assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
            assert!(found.iter().zip(&expected).all(|(f, e)| (f - e).abs() < 1e-5), "{found:?} {expected:?}");
        }
    }

    #[test]
    fn a_point_falls_on_a_rising_triangle() {
        let still = |x: [f64; 3]| (x, [0.0; 3]);
        let rise = |x: [f64; 3]| (x, [0.0, 0.0, 1.0]);
        let (a, b, c) = (rise([0.0; 3]), rise([1.0, 0.0, 0.0]), rise([0.0, 1.0, 0.0]));
        let p = still([0.2, 0.2, 0.25]);
        let g = coplanarity(relative(p, a), relative(b, a), relative(c, a));
        assert!(roots(&g).next().is_some_and(|t| (t - 0.25).abs() < 1e-15));
    }
}
