//! The strain at fracture of Johnson and Cook (1985), ε_f = (D₁ + D₂ exp(D₃ σ_m/σ̄))(1 + D₄ ln ε̇*)(1 + D₅ T*): where it is positive.
//!
//! The kernel takes it as at least 10⁻⁶, so that where the formula gives nothing, or less, an element fails with its first plastic
//! strain. That can be a slip of a sign as well as what is meant, and is told when the deck is read.

use super::johnson_cook::JohnsonCook;
use super::{Given, Refusal};

/// Largest triaxiality σ_m/σ̄ for which Johnson and Cook gave the formula. Compression has no such end.
const MOST_TRIAXIALITY: f64 = 1.5;

/// Plastic strain rates over the reference one that impacts reach.
const FASTEST: f64 = 1e6;

const CONSEQUENCE: &str =
    "a strain at fracture that is not positive counts as 1E-6: elements fail there with the first plastic strain";

/// Refuses constants with which nothing is ever ductile, and warns of those that lose their strain at fracture in the range of use.
pub(super) fn check(law: &JohnsonCook, given: &Given) -> Result<(), Refusal> {
    let [d1, d2, _, d4, d5] = law.damage;
    if d1 == 0.0 && d2 == 0.0 {
        return Ok(()); // There is no damage.
    }
    if !is_somewhere_positive(law.damage) {
        let (keyword, value, other) = if d1 < 0.0 { ("D1", d1, ("D2", d2)) } else { ("D2", d2, ("D1", d1)) };
        let reason = format!(
            "is {value}, which with {} = {} makes a strain at fracture that is positive nowhere",
            other.0, other.1
        );
        return Err(Refusal { keyword, reason });
    }
    let warn = |keyword, value: f64, place: String| {
        let reason = format!("is {value}, which makes a strain at fracture that is not positive {place}");
        given.warn(keyword, reason, CONSEQUENCE);
    };
    if let Some((triaxiality, side)) = not_positive(law.damage) {
        let (keyword, value) = if d1 < 0.0 { ("D1", d1) } else { ("D2", d2) };
        let place = format!("where mean stress over von Mises stress is {side} {triaxiality:.4}");
        warn(keyword, value, place);
    }
    let rate = libm::exp(-1.0 / d4);
    if d4 < 0.0 && rate < FASTEST {
        warn("D4", d4, format!("from a plastic strain rate of {:.3e} on", rate * law.reference_rate));
    }
    if d5 < -1.0 && law.heats() {
        let temperature = law.reference_temperature - (law.melt_temperature - law.reference_temperature) / d5;
        warn("D5", d5, format!("from a temperature of {temperature:.4} on"));
    }
    Ok(())
}

/// Whether ε_f > 0 at any triaxiality, slow and cold, where the other two factors are 1. The exponential takes every positive
/// value, unless D₃ = 0 makes it 1.
fn is_somewhere_positive([d1, d2, d3, ..]: [f64; 5]) -> bool {
    if d3 == 0.0 { d1 + d2 > 0.0 } else { d1 > 0.0 || d2 > 0.0 }
}

/// The triaxiality at which D₁ + D₂ exp(D₃ σ_m/σ̄) vanishes, and on which side of it less is left, if that is in the range of use.
fn not_positive([d1, d2, d3, ..]: [f64; 5]) -> Option<(f64, &'static str)> {
    if d1 * d2 >= 0.0 || d3 == 0.0 {
        return None;
    }
    let root = libm::log(-d1 / d2) / d3;
    if d2 * d3 < 0.0 { (root < MOST_TRIAXIALITY).then_some((root, "above")) } else { Some((root, "below")) }
}

#[cfg(test)]
mod tests {
    use super::super::johnson_cook;
    use super::*;

    /// Copper with these constants of damage: the refusal, or the warnings.
    fn said(damage: [f64; 5]) -> Result<Vec<String>, String> {
        let elastic = [124e9, 0.34, 90e6, 292e6, 0.31, 0.025, 2.0, 1.09, 298.0, 1356.0, 383.0, 0.9];
        let values: Vec<f64> = elastic.into_iter().chain(damage).collect();
        let given = Given::new(&values, 8960.0);
        let said = |keyword: &str, reason: &str| format!("{keyword} {reason}");
        match (johnson_cook::ENTRY.build)(&given) {
            Ok(_) => Ok(given.cautions.take().iter().map(|c| said(c.keyword, &c.reason)).collect()),
            Err(refusal) => Err(said(refusal.keyword, &refusal.reason)),
        }
    }

    /// exp takes all positive values, so that D₁ ≤ 0 is saved by D₂ > 0 alone and the other way round; without D₃ the sum decides.
    #[test]
    fn what_is_never_positive_is_refused() {
        for refused in [
            [-0.3, 0.0, 0.0, 0.0, 0.0],
            [-0.3, 0.0, -1.5, 0.0, 0.0],
            [0.0, -0.1, -1.5, 0.0, 0.0],
            [-0.3, -0.1, 2.0, 0.0, 0.0],
            [-0.3, 0.2, 0.0, 0.0, 0.0],
            [0.3, -0.3, 0.0, 0.0, 0.0],
        ] {
            let reason = said(refused).expect_err("refused");
            assert!(reason.contains("positive nowhere"), "{reason}");
        }
        for sound in [[0.0; 5], [0.3, 0.0, 0.0, 0.0, 0.0], [0.0, 0.4, -1.5, 0.0, 0.0], [0.05, 3.44, -2.12, 0.002, 0.61]]
        {
            assert_eq!(said(sound), Ok(Vec::new()), "{sound:?}");
        }
    }

    /// The roots of the three factors: ln(−D₁/D₂)/D₃, ε̇₀ exp(−1/D₄), T_r − (T_m − T_r)/D₅.
    #[test]
    fn where_it_becomes_nothing_is_told() {
        let one = |damage: [f64; 5], ends: &str| {
            let told = said(damage).expect("a law");
            assert!(told.len() == 1 && told[0].ends_with(ends), "{damage:?}: {told:?}");
        };
        // ln 3/−1.5 = −0.7324; ln 0.5/−1 = 0.6931; 2 exp(0.5) = 3.297; 298 + 1058/4 = 562.5
        one([-0.3, 0.1, -1.5, 0.0, 0.0], "is above -0.7324");
        one([-0.1, 0.2, -1.0, 0.0, 0.0], "is above 0.6931");
        one([0.1, -0.2, -1.0, 0.0, 0.0], "is below 0.6931");
        one([0.3, 0.0, 0.0, -2.0, 0.0], "rate of 3.297e0 on");
        one([0.3, 0.0, 0.0, 0.0, -4.0], "temperature of 562.5000 on");
        // Published for Ti-6Al-4V: nothing is left only beyond what the formula is for, at ln(0.36)/−0.5 = 2.04.
        for sound in [[-0.09, 0.25, -0.5, 0.014, 3.87], [0.3, 0.0, 0.0, -0.07, 0.0], [0.3, 0.0, 0.0, 0.0, -1.0]] {
            assert_eq!(said(sound), Ok(Vec::new()), "{sound:?}");
        }
    }
}
