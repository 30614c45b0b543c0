//! The strength of SOIL N FOAMS, A₀ + A₁p + A₂p²: at which pressures that its function reaches it would be negative.

use super::soil::Soil;
use super::{Given, Refusal};

/// Refuses strengths that are positive at no pressure from 0 to the largest of the function, and warns of those that are below 0 at
/// some of them. In tension a strength below 0 is meant: soil without cohesion has A₀ = 0.
pub(super) fn check(law: &Soil, given: &Given) -> Result<(), Refusal> {
    let Soil { a0, a1, a2, .. } = *law;
    let largest = law.curve.points.last().map_or(0.0, |point| point.1);
    let below = negative([a0, a1, a2], largest);
    let (keyword, value) = if a0 < 0.0 {
        ("A0", a0)
    } else if a2 < 0.0 {
        ("A2", a2)
    } else {
        ("A1", a1)
    };
    if below == [[0.0, largest]] {
        let reason = format!(
            "is {value}, which makes a strength below 0 at every pressure up to {largest:e}, the largest of the function"
        );
        return Err(Refusal { keyword, reason });
    }
    if !below.is_empty() {
        let ranges: Vec<String> = below.iter().map(|range| words(*range, largest)).collect();
        let reason = format!("is {value}, which makes a strength below 0 {}", ranges.join(" and "));
        let help =
            format!("it counts as 0 there: nothing resists shear; the function reaches a pressure of {largest:e}");
        given.warn(keyword, reason, &help);
    }
    Ok(())
}

/// Where A₀ + A₁p + A₂p² < 0 between 0 and the largest pressure: ranges, ascending.
fn negative([a0, a1, a2]: [f64; 3], largest: f64) -> Vec<[f64; 2]> {
    let strength = |p: f64| a0 + p * (a1 + p * a2);
    if largest <= 0.0 {
        return if a0 < 0.0 { vec![[0.0, largest]] } else { Vec::new() };
    }
    let mut ends = vec![0.0, largest];
    let discriminant = a1 * a1 - 4.0 * a0 * a2;
    if discriminant > 0.0 {
        // One root is found without cancellation, the other by their product a0/a2; of a straight line the first is infinite.
        let sum = -0.5 * (a1 + discriminant.sqrt().copysign(a1));
        ends.extend([sum / a2, a0 / sum].into_iter().filter(|end| (0.0..=largest).contains(end)));
        ends.sort_by(f64::total_cmp);
    }
    let ranges = ends.windows(2).map(|pair| [pair[0], pair[1]]);
    ranges.filter(|[start, end]| start < end && strength(0.5 * (start + end)) < 0.0).collect()
}

fn words([start, end]: [f64; 2], largest: f64) -> String {
    if start == 0.0 {
        format!("up to a pressure of {end:.4e}")
    } else if end == largest {
        format!("from a pressure of {start:.4e} on")
    } else {
        format!("between pressures of {start:.4e} and {end:.4e}")
    }
}

#[cfg(test)]
mod tests {
    use super::super::soil;
    use super::*;

    /// A soil whose function goes to a pressure of 20: the refusal, or the warnings.
    fn said(a: [f64; 3]) -> Result<String, String> {
        let values = [60.0, 100.0, a[0], a[1], a[2], 0.2, 7.0];
        let function = |_| Some(vec![(0.0, 0.0), (0.4, 20.0)]);
        let given = Given { function: &function, ..Given::new(&values, 1.0) };
        match (soil::ENTRY.build)(&given) {
            Ok(_) => Ok(given.cautions.take().iter().map(|c| format!("{} {}", c.keyword, c.reason)).collect()),
            Err(refusal) => Err(format!("{} {}", refusal.keyword, refusal.reason)),
        }
    }

    #[test]
    fn what_is_nowhere_positive_is_refused() {
        for (a, keyword) in [
            ([-5.0, 0.0, 0.0], "A0"),
            ([-5.0, 0.2, 0.0], "A0"),
            ([0.0, 0.0, -1.0], "A2"),
            ([0.0, -0.1, 0.0], "A1"),
            ([-5.0, 0.1, -1.0], "A0"),
        ] {
            let reason = said(a).expect_err("refused");
            assert!(reason.starts_with(keyword) && reason.contains("up to 2e1"), "{reason}");
        }
        for sound in [[0.0; 3], [5.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, 0.6, 1e-8], [1.0, 0.5, -0.01]] {
            assert_eq!(said(sound), Ok(String::new()), "{sound:?}");
        }
    }

    /// Roots of the quadratic: 5/0.5 = 10; (0.5 + sqrt(0.25 + 1))/10 = 0.161803; 1 − 0.5 p + 0.05 p² at 5 ± sqrt(5); and of one
    /// that is positive between its roots 1 and 15 alone.
    #[test]
    fn where_it_is_below_nothing_is_told() {
        for (a, ends) in [
            ([-5.0, 0.5, 0.0], "A0 is -5, which makes a strength below 0 up to a pressure of 1.0000e1"),
            ([0.05, 0.5, -5.0], "A2 is -5, which makes a strength below 0 from a pressure of 1.6180e-1 on"),
            (
                [1.0, -0.5, 0.05],
                "A1 is -0.5, which makes a strength below 0 between pressures of 2.7639e0 and 7.2361e0",
            ),
            (
                [-15.0, 16.0, -1.0],
                "A0 is -15, which makes a strength below 0 up to a pressure of 1.0000e0 and from a pressure of 1.5000e1 on",
            ),
        ] {
            assert_eq!(said(a), Ok(ends.to_owned()));
        }
    }
}
