//! The channel frequency classes of SAE J211-1 (ISO 6487): a Butterworth filter of second order, run forwards and
//! backwards, so that nothing is shifted in time.
//!
//! Coefficients are those of SAE J211-1, appendix C: the corner of each pass is at 2.0775 times the class, which puts the
//! gain of both passes together to -3 dB at five thirds of it.

use std::str::FromStr;

use super::PlotError;

/// Corner frequency of one pass over the frequency of the class.
const CORNER: f64 = 2.0775;
/// Samples in a period of the class's frequency below which a filtered curve is not to be trusted.
pub const ENOUGH_SAMPLES: f64 = 10.0;

/// A channel frequency class. As text `CFC180`, or the number alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Class {
    /// Hertz up to which the signal passes nearly as it is.
    pub hertz: f64,
}

impl FromStr for Class {
    type Err = PlotError;

    fn from_str(text: &str) -> Result<Self, PlotError> {
        let upper = text.trim().to_ascii_uppercase();
        let hertz = upper.strip_prefix("CFC").unwrap_or(&upper).trim().parse::<f64>().ok();
        match hertz.filter(|hertz| *hertz > 0.0 && hertz.is_finite()) {
            Some(hertz) => Ok(Class { hertz }),
            None => {
                Err(PlotError::option("--filter", text, "CFC60, CFC180, CFC600, CFC1000 or CFC with another number"))
            }
        }
    }
}

impl Class {
    /// The frequency in cycles per unit of the deck's time, of which a second has `second`.
    pub fn frequency(&self, second: f64) -> f64 {
        self.hertz / second
    }
}

/// A recursive filter of second order: y = a·(x, x₋₁, x₋₂) + b·(y₋₁, y₋₂).
#[derive(Debug, Clone, Copy)]
struct Pass {
    a: [f64; 3],
    b: [f64; 2],
}

impl Pass {
    /// The pass for a frequency of class and an interval between samples; `None` where samples are too far apart for it.
    fn new(frequency: f64, interval: f64) -> Option<Pass> {
        let half = std::f64::consts::PI * frequency * CORNER * interval;
        if !(half > 0.0 && half < 0.5 * std::f64::consts::PI) {
            return None;
        }
        let w = half.tan();
        let root = std::f64::consts::SQRT_2 * w;
        let below = 1.0 + root + w * w;
        let a = w * w / below;
        Some(Pass { a: [a, 2.0 * a, a], b: [-2.0 * (w * w - 1.0) / below, (-1.0 + root - w * w) / below] })
    }

    /// Runs over the values in place, as if the first one had always been there.
    fn run<'a>(&self, values: impl Iterator<Item = &'a mut f64>) {
        let mut before: Option<[[f64; 2]; 2]> = None;
        for value in values {
            let x = *value;
            let [xs, ys] = before.unwrap_or([[x; 2]; 2]);
            let y = self.a[0] * x + self.a[1] * xs[0] + self.a[2] * xs[1] + self.b[0] * ys[0] + self.b[1] * ys[1];
            before = Some([[x, xs[0]], [y, ys[0]]]);
            *value = y;
        }
    }
}

/// What a signal did before its record begins, which a filter must know: SAE J211-1 wants records that begin before the event.
///
/// A run begins with the event, and what was before is known all the same: the body had its initial state. Continued
/// point-symmetrically, as records are that are cut out of something longer, a pulse that begins with the run would be
/// preceded by its negative, and a filter that is wider than the pulse would leave nothing of it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Before {
    /// It had its first value: the velocity at which the body came, the stress that it had.
    #[default]
    First,
    /// It is the rate of such a value: a force, an acceleration. What acted before is what acts on steadily, through a period of the class.
    /// The first value is none, as nothing has changed yet.
    Steady,
    /// The same, whose first value is the slope behind the first state: the mean with that before it counts.
    Slope,
    /// The record is cut out of something longer, of which nothing is known: it goes on point-symmetrically.
    Unknown,
}

/// What a force or acceleration does through all of the values given: that which is nearest to zero between the least and
/// the greatest.
///
/// A body that falls freely has its weight all the time, and a constant stays that constant; what comes and goes was not there before.
fn steady(values: &[f64]) -> f64 {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if least > 0.0 { least } else { greatest.min(0.0) }
}

/// Filters evenly spaced samples with a class of `frequency` cycles per unit of `interval`; `None` where the samples are
/// too far apart to have such a frequency at all.
///
/// For a period of the class the signal goes on before its record as `before` says and behind it point-symmetrically, so
/// that the filter has settled where it begins to matter.
pub fn filtered(values: &[f64], frequency: f64, interval: f64, before: Before) -> Option<Vec<f64>> {
    let pass = Pass::new(frequency, interval)?;
    let (Some(&first), Some(&last)) = (values.first(), values.last()) else { return Some(Vec::new()) };
    let pad = ((1.0 / (frequency * interval)).ceil() as usize).min(values.len() - 1);
    let mut all: Vec<f64> = match before {
        Before::First => vec![first; pad],
        Before::Steady | Before::Slope if pad == 0 => Vec::new(),
        // The first sample has no value of its own either.
        Before::Steady => vec![steady(&values[1..=pad]); pad + 1],
        Before::Slope => {
            let steady = steady(&values[..=pad]);
            [vec![steady; pad], vec![0.5 * (steady + first)]].concat()
        }
        Before::Unknown => values[1..=pad].iter().rev().map(|value| 2.0 * first - value).collect(),
    };
    all.extend(&values[all.len() - pad..]);
    all.extend(values[values.len() - 1 - pad..values.len() - 1].iter().rev().map(|value| 2.0 * last - value));
    pass.run(all.iter_mut());
    pass.run(all.iter_mut().rev());
    Some(all[pad..pad + values.len()].to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Amplitude of the filtered sine over that of the sine, in the middle of many periods, by its Fourier coefficient.
    fn gain(class: f64, hertz: f64, interval: f64) -> f64 {
        let period = (1.0 / (hertz * interval)).round() as usize;
        let hertz = 1.0 / (period as f64 * interval);
        let wave = |i: usize| 2.0 * std::f64::consts::PI * hertz * i as f64 * interval;
        let values: Vec<f64> = (0..41 * period).map(|i| wave(i).sin()).collect();
        let filtered = filtered(&values, class, interval, Before::Unknown).unwrap();
        let middle = 20 * period..30 * period;
        let part = |f: fn(f64) -> f64| middle.clone().map(|i| filtered[i] * f(wave(i))).sum::<f64>();
        2.0 * part(f64::sin).hypot(part(f64::cos)) / middle.len() as f64
    }

    /// Corridors of SAE J211-1 figure 1: up to a tenth of the class within half a decibel, at the class +0.5 to -1, at
    /// five thirds of it +0.5 to -4 dB; the design point there is -3 dB, and beyond it falls by 24 dB an octave.
    #[test]
    fn gains_are_those_of_the_standard() {
        for class in [60.0, 180.0, 600.0, 1000.0] {
            let decibels = |times: f64| 20.0 * gain(class, times * class, 1.0 / (400.0 * class)).log10();
            assert!(decibels(0.1).abs() < 0.01, "{}", decibels(0.1));
            assert!((-1.0..0.5).contains(&decibels(1.0)), "{}", decibels(1.0));
            // The period is a whole number of samples, which moves the frequency by up to 1/240: 0.1 dB of the slope.
            assert!((decibels(5.0 / 3.0) + 3.01).abs() < 0.1, "{}", decibels(5.0 / 3.0));
            assert!((decibels(CORNER) + 6.02).abs() < 0.1, "{}", decibels(CORNER));
            let octave = decibels(8.0) - decibels(16.0);
            assert!((octave - 24.0).abs() < 0.3, "{octave}");
        }
    }

    /// The exact gain of two bilinear Butterworth passes is 1 / (1 + (tan(πfT) / tan(πf_cT))⁴).
    #[test]
    fn gains_are_exact_at_coarse_samples() {
        let (class, interval) = (180.0, 1.0 / 4000.0);
        for hertz in [100.0, 250.0, 500.0] {
            let tangent = |f: f64| (std::f64::consts::PI * f * interval).tan();
            let exact = 1.0 / (1.0 + (tangent(hertz) / tangent(CORNER * class)).powi(4));
            assert!((gain(class, hertz, interval) - exact).abs() < 1e-6, "{hertz}");
        }
    }

    #[test]
    fn nothing_is_shifted_and_constants_and_slopes_stay() {
        let slope: Vec<f64> = (0..500).map(|i| 3.0 + 0.25 * f64::from(i)).collect();
        for (found, value) in filtered(&slope, 60.0, 1e-4, Before::Unknown).unwrap().iter().zip(&slope) {
            // The ends' continuation is the slope itself; what is left is the start of the pass a period before.
            assert!((found - value).abs() < 0.02 * 125.0 / 4.0, "{found} {value}");
        }
        for before in [Before::First, Before::Steady, Before::Slope, Before::Unknown] {
            for value in [7.0, -9.81] {
                let found = filtered(&[value; 50], 180.0, 1e-4, before).unwrap();
                assert!(found.iter().all(|v| (v - value).abs() < 1e-12), "{before:?}");
            }
        }
        let mut pulse = vec![0.0; 201];
        pulse[100] = 1.0;
        let found = filtered(&pulse, 180.0, 1e-4, Before::Unknown).unwrap();
        let top = (0..201).max_by(|&a, &b| found[a].total_cmp(&found[b])).unwrap();
        assert_eq!(top, 100);
        assert!((1..80).all(|i| (found[100 - i] - found[100 + i]).abs() < 1e-6));
    }

    /// A force that is there from the first interval on, and over long before a period of the filter is: as half a second later, in
    /// a record that begins with nothing.
    #[test]
    fn a_pulse_at_the_beginning_is_filtered_as_one_in_the_middle() {
        let (interval, count) = (1e-4, 600);
        let pulse = |i: usize| if (1..=8).contains(&i) { 1000.0 * (0.2 * i as f64).cos() } else { 0.0 };
        let early: Vec<f64> = (0..count).map(pulse).collect();
        let late: Vec<f64> = std::iter::repeat_n(0.0, 5000).chain(early.iter().copied()).collect();
        let found = filtered(&early, 180.0, interval, Before::Steady).unwrap();
        let expected = &filtered(&late, 180.0, interval, Before::Unknown).unwrap()[5000..];
        let peak = expected.iter().copied().fold(0.0, f64::max);
        assert!(peak > 300.0, "{peak}");
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3 * peak));
        // A velocity that jumps at the beginning is about half way between both there.
        let state: Vec<f64> = (0..count).map(|i| if i == 0 { -5.0 } else { 1.0 }).collect();
        let found = filtered(&state, 180.0, interval, Before::First).unwrap();
        assert!((-3.0..-1.5).contains(&found[0]) && (found[100] - 1.0).abs() < 1e-3, "{found:?}");
    }

    #[test]
    fn what_acts_on_steadily_is_nearest_to_zero() {
        assert_eq!(
            [steady(&[-9.81, -9.81]), steady(&[3.0, 2.0]), steady(&[-1.0, 5.0]), steady(&[0.0, 7.0])],
            [-9.81, 2.0, 0.0, 0.0]
        );
    }

    #[test]
    fn samples_too_far_apart_are_refused() {
        assert!(filtered(&[0.0, 1.0, 2.0], 1000.0, 1e-3, Before::First).is_none());
        for before in [Before::First, Before::Steady, Before::Unknown] {
            assert_eq!(filtered(&[5.0], 10.0, 1e-3, before).unwrap(), [5.0]);
            assert!(filtered(&[], 10.0, 1e-3, before).unwrap().is_empty());
        }
        assert_eq!("cfc180".parse::<Class>().unwrap().hertz, 180.0);
        assert!("CFC".parse::<Class>().is_err() && "-3".parse::<Class>().is_err());
    }
}
