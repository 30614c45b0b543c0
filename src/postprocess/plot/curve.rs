//! A curve: what is drawn, written as numbers, and told in words.

use super::filter::Before;
use super::run::Site;

/// Values over something.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// What it is called in the legend.
    pub label: String,
    /// What it is over: times, or the values of another variable. As many as `y`.
    pub x: Vec<f64>,
    /// The values; NaN where there is none.
    pub y: Vec<f64>,
    /// Belongs to the axis on the right.
    pub right: bool,
    /// Its points are shown where they are few.
    pub points: bool,
    /// Comes from a file of numbers, not from a run.
    pub reference: bool,
    /// Which of the runs it comes from.
    pub run: usize,
    /// Which of the variables asked for it is; those that are taken apart have several curves.
    pub variable: usize,
    /// Where its variable is.
    pub site: Site,
    /// Each value is the mean from the value before it to its own place.
    pub means: bool,
    /// What it did before its first value.
    pub before: Before,
}

/// A curve's least, greatest and last value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremes {
    /// Where the least value is, and the value.
    pub least: [f64; 2],
    /// Where the greatest value is, and the value.
    pub greatest: [f64; 2],
    /// Where the last value is, and the value.
    pub last: [f64; 2],
}

impl Extremes {
    /// Where the value farthest from zero is, and the value.
    pub fn farthest(&self) -> [f64; 2] {
        if self.least[1].abs() > self.greatest[1].abs() { self.least } else { self.greatest }
    }
}

impl Curve {
    /// A line on the left axis of something that belongs to the whole body.
    pub fn of(label: impl Into<String>, x: Vec<f64>, y: Vec<f64>) -> Curve {
        let label = label.into();
        let site = Site::Global;
        let before = Before::default();
        Curve {
            label,
            x,
            y,
            right: false,
            points: false,
            reference: false,
            run: 0,
            variable: 0,
            site,
            means: false,
            before,
        }
    }

    /// The extremes among finite values; `None` where there are none.
    pub fn extremes(&self) -> Option<Extremes> {
        let points =
            || self.x.iter().zip(&self.y).map(|(&x, &y)| [x, y]).filter(|[x, y]| x.is_finite() && y.is_finite());
        let (first, last) = (points().next()?, points().next_back()?);
        let (mut least, mut greatest) = (first, first);
        for point in points() {
            if point[1] < least[1] {
                least = point;
            }
            if point[1] > greatest[1] {
                greatest = point;
            }
        }
        Some(Extremes { least, greatest, last })
    }
}
