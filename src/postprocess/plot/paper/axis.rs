//! Axes: which values they span, where their marks are and what stands there.

use crate::postprocess::plot::options::Range;
use crate::postprocess::view::numbers::{number, ticks};

/// Values beyond this are not drawn: differences of them would overflow.
const LARGEST: f64 = 1e300;
/// Share of the span that is left free above and below the curves.
const MARGIN: f64 = 0.04;
/// An axis whose least value is below this share of the greatest begins at zero.
const NEAR_ZERO: f64 = 0.5;
/// Decades up to which a logarithmic axis has marks inside them.
const FEW_DECADES: f64 = 2.5;

/// An axis of a plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    low: f64,
    high: f64,
    log: bool,
}

impl Axis {
    /// An axis for values, between given ends if there are any. `upright` axes leave room above and below and begin at
    /// zero where that is near. `None` where no value can stand on it.
    pub fn around(values: impl Iterator<Item = f64>, log: bool, ends: Option<Range>, upright: bool) -> Option<Axis> {
        let fits = |value: &f64| value.abs() < LARGEST && (!log || *value > 0.0);
        if let Some(Range { low, high }) = ends {
            return (fits(&low) && fits(&high)).then_some(Axis { low, high, log });
        }
        let (low, high) = values
            .filter(fits)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        if low > high {
            return None;
        }
        Some(if log { Axis::decades(low, high) } else { Axis::linear(low, high, upright) })
    }

    fn linear(low: f64, high: f64, upright: bool) -> Axis {
        // Differences below this are rounding errors, not a curve.
        if high - low <= 1e-9 * low.abs().max(high.abs()) {
            let half = if low == 0.0 { 1.0 } else { 0.5 * low.abs().max(high.abs()) };
            return Axis { low: low - half, high: high + half, log: false };
        }
        let (mut low, mut high) = (low, high);
        if upright {
            let margin = MARGIN * (high - low);
            let to_zero = |near: f64, far: f64| near.abs() < NEAR_ZERO * far.abs() && near * far >= 0.0;
            let (floor, ceiling) = (to_zero(low, high) && low >= 0.0, to_zero(high, low) && high <= 0.0);
            (low, high) = (if floor { 0.0 } else { low - margin }, if ceiling { 0.0 } else { high + margin });
        }
        Axis { low, high, log: false }
    }

    fn decades(low: f64, high: f64) -> Axis {
        let (below, above) = (low.log10(), high.log10());
        if above - below < 0.3 {
            return Axis { low: low / 1.5, high: high * 1.5, log: true };
        }
        let margin = MARGIN * (above - below);
        Axis { low: 10f64.powf(below - margin), high: 10f64.powf(above + margin), log: true }
    }

    /// Where a value stands, from 0 at the lower end to 1 at the upper; NaN for one that has no place on the axis.
    pub fn fraction(&self, value: f64) -> f64 {
        if value.is_nan() || value.abs() >= LARGEST || (self.log && value <= 0.0) {
            return f64::NAN;
        }
        match self.log {
            true => (value.ln() - self.low.ln()) / (self.high.ln() - self.low.ln()),
            false => (value - self.low) / (self.high - self.low),
        }
    }

    /// Marks with their texts, about `wanted`.
    pub fn marks(&self, wanted: usize) -> Vec<(f64, String)> {
        if !self.log {
            let marks = ticks(self.low, self.high, wanted);
            return if marks.is_empty() { [self.low, self.high].map(|v| (v, number(v))).to_vec() } else { marks };
        }
        let decades = self.high.log10() - self.low.log10();
        let (first, last) = (self.low.log10().ceil() as i32, self.high.log10().floor() as i32);
        if decades > FEW_DECADES {
            let step = (decades / wanted.max(1) as f64).ceil().max(1.0) as usize;
            return (first..=last).step_by(step).map(|power| (10f64.powi(power), plain(10f64.powi(power)))).collect();
        }
        let inside = |value: &f64| (self.low..=self.high).contains(value);
        let values = (first - 1..=last).flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * 10f64.powi(power)));
        let values: Vec<f64> = values.filter(inside).collect();
        if values.len() < 3 {
            return ticks(self.low, self.high, wanted);
        }
        values.into_iter().map(|value| (value, plain(value))).collect()
    }
}

/// A round number with the digits that it needs: 0.02, 500, 2E−05.
fn plain(value: f64) -> String {
    if (0.9e-3..1e5).contains(&value) {
        return ((value * 1e6).round() / 1e6).to_string();
    }
    let text = format!("{value:.0e}");
    let (digit, power) = text.split_once('e').unwrap_or((&text, "0"));
    let (sign, power) = power.strip_prefix('-').map_or(("+", power), |power| ("−", power));
    format!("{digit}E{sign}{power:0>2}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(values: &[f64], log: bool) -> Vec<String> {
        let axis = Axis::around(values.iter().copied(), log, None, true).unwrap();
        axis.marks(6).into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn axes_have_marks_whatever_their_values() {
        for values in [
            &[0.0][..],
            &[-3.0, -3.0],
            &[1.0, 1.0 + 1e-12],
            &[1.0, 1.0 + 1e-7],
            &[1e-300, 3e-300],
            &[-9e299, 9e299],
            &[f64::NAN, 4.0, f64::INFINITY],
            &[-2.0, 5.0, 1e308],
        ] {
            let marks = texts(values, false);
            assert!((2..=16).contains(&marks.len()), "{values:?}: {marks:?}");
        }
        for values in [&[1.0][..], &[2.0, 30.0], &[1e-200, 1e200], &[100.0, 104.0], &[-1.0, 0.0, 7.0]] {
            let marks = texts(values, true);
            assert!((2..=16).contains(&marks.len()), "{values:?}: {marks:?}");
        }
        assert!(Axis::around([f64::NAN].into_iter(), false, None, true).is_none());
        assert!(Axis::around([-1.0, 0.0].into_iter(), true, None, true).is_none());
    }

    #[test]
    fn decades_are_marked() {
        assert_eq!(texts(&[0.9e-4, 1.1e3], true), ["1E−04", "0.01", "1", "100"]);
        assert_eq!(texts(&[1.0, 100.0], true), ["1", "2", "5", "10", "20", "50", "100"]);
    }

    #[test]
    fn axes_begin_at_zero_when_it_is_near() {
        assert_eq!(Axis::linear(1.0, 10.0, true).low, 0.0);
        assert_eq!(Axis::linear(-10.0, -1.0, true).high, 0.0);
        assert!(Axis::linear(8.0, 10.0, true).low > 7.0);
        assert!(Axis::linear(-1.0, 10.0, true).low < -1.0);
    }
}
