//! What an analyst may ask of a plot.

use std::path::PathBuf;
use std::str::FromStr;

use super::PlotError;
use super::filter::Class;

/// What is plotted, how it is worked on and how it looks.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotOptions {
    /// Results and histories.
    pub files: Vec<PathBuf>,
    /// Variables on the left axis; `*` stands for any letters. Without any, the energies of the body.
    pub variables: Vec<String>,
    /// Variables on the right axis.
    pub right: Vec<String>,
    /// Variable that the others are plotted over; without one, time.
    pub over: Option<String>,
    /// Numbers of the nodes at which nodal variables are taken.
    pub nodes: Vec<i64>,
    /// Numbers of the elements in which element variables are taken.
    pub elements: Vec<i64>,
    /// What is subtracted: a variable, or the same variables of another file.
    pub minus: Option<String>,
    /// Derivative with respect to time.
    pub derive: bool,
    /// Integral over time from the first state.
    pub integrate: bool,
    /// Low-pass filter.
    pub filter: Option<Class>,
    /// How long a second is in the deck's units of time.
    pub second: f64,
    /// Factor on the values.
    pub scale: f64,
    /// Files of numbers that are drawn beside the curves.
    pub references: Vec<PathBuf>,
    /// Which axes are logarithmic.
    pub log: Log,
    /// Ends of the axes below, left and right.
    pub ranges: [Option<Range>; 3],
    /// Title; else that of the first run.
    pub title: Option<String>,
    /// Texts at the axes below, left and right; else names of variables.
    pub labels: [Option<String>; 3],
    /// Width and height of the picture in pixels.
    pub size: (u32, u32),
}

/// Two ends of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// Which axes are logarithmic. As text any of the letters x, y and r.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Log {
    /// The axis below.
    pub x: bool,
    /// The axis on the left.
    pub y: bool,
    /// The axis on the right.
    pub right: bool,
}

impl Default for PlotOptions {
    fn default() -> Self {
        PlotOptions {
            files: Vec::new(),
            variables: Vec::new(),
            right: Vec::new(),
            over: None,
            nodes: Vec::new(),
            elements: Vec::new(),
            minus: None,
            derive: false,
            integrate: false,
            filter: None,
            second: 1.0,
            scale: 1.0,
            references: Vec::new(),
            log: Log::default(),
            ranges: [None; 3],
            title: None,
            labels: [const { None }; 3],
            size: (1200, 800),
        }
    }
}

impl FromStr for Range {
    type Err = PlotError;

    fn from_str(text: &str) -> Result<Self, PlotError> {
        let finite = |text: &str| text.trim().parse().ok().filter(|value: &f64| value.is_finite());
        let ends = text.split_once(',').and_then(|(low, high)| Some((finite(low)?, finite(high)?)));
        match ends {
            Some((low, high)) if low < high => Ok(Range { low, high }),
            _ => Err(PlotError::option("range", text, "two numbers LOW,HIGH, the smaller one first")),
        }
    }
}

impl FromStr for Log {
    type Err = PlotError;

    fn from_str(text: &str) -> Result<Self, PlotError> {
        let mut log = Log::default();
        for letter in text.to_ascii_lowercase().chars() {
            match letter {
                'x' => log.x = true,
                'y' => log.y = true,
                'r' => log.right = true,
                _ => return Err(PlotError::option("--log", text, "any of x, y and r, such as xy")),
            }
        }
        Ok(log)
    }
}

impl PlotOptions {
    /// Refuses numbers that nothing can be made with.
    pub(super) fn check(&self) -> Result<(), PlotError> {
        let (width, height) = self.size;
        if !(300..=16_384).contains(&width) || !(200..=16_384).contains(&height) {
            return Err(PlotError::option("size", format!("{width}x{height}"), "300x200 to 16384x16384 pixels"));
        }
        if !(self.second > 0.0 && self.second.is_finite()) {
            return Err(PlotError::option("--second", self.second.to_string(), "a positive number"));
        }
        if !(self.scale != 0.0 && self.scale.is_finite()) {
            return Err(PlotError::option("--scale", self.scale.to_string(), "a finite number other than zero"));
        }
        Ok(())
    }

    /// What the curves are over, in a word.
    pub(super) fn x_name(&self) -> String {
        self.over.as_ref().map_or_else(|| "time".to_owned(), |name| name.to_uppercase())
    }
}
