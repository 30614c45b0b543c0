//! Directions on a circle, to the bit the same in all quadrants and exact on the axes.

/// Cosine and sine of an angle given in quarter turns.
///
/// Only angles up to an eighth of a turn are evaluated; all others follow by symmetry, so that a half model is the
/// mirror image of the other half and 90 degrees give exactly (0, 1).
pub fn direction(quarter_turns: f64) -> [f64; 2] {
    let whole = quarter_turns.floor();
    let part = quarter_turns - whole;
    let angle = |part: f64| part * std::f64::consts::FRAC_PI_2;
    let [c, s] = if part <= 0.5 {
        [libm::cos(angle(part)), libm::sin(angle(part))]
    } else {
        [libm::sin(angle(1.0 - part)), libm::cos(angle(1.0 - part))]
    };
    match whole.rem_euclid(4.0) as u8 {
        0 => [c, s],
        1 => [-s, c],
        2 => [-c, -s],
        _ => [s, -c],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_on_the_axes_and_symmetric() {
        assert_eq!(direction(0.0), [1.0, 0.0]);
        assert_eq!(direction(1.0), [0.0, 1.0]);
        assert_eq!(direction(-1.0), [0.0, -1.0]);
        assert_eq!(direction(2.0), [-1.0, 0.0]);
        let ([c, s], [d, t]) = (direction(0.125), direction(1.875));
        assert_eq!([c, s], [-d, t]);
    }
}
