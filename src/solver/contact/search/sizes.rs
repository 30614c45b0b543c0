//! Classes of size, four times apart. A grid serves boxes of one size well, so each class gets its own.

use super::Box3;

/// Number of classes, the last of which has no upper bound and the first no lower one.
pub const CLASSES: u8 = 64;
/// The class of an ordinary face, from half to twice the median.
pub const ORDINARY: u8 = 32;
/// The class of boxes that take no part in the search.
pub const UNSOUND: u8 = u8::MAX;
/// Number of faces from which the median is estimated.
const SAMPLES: usize = 1000;

/// The measure against which boxes are classed.
#[derive(Debug, Default)]
pub struct Sizes {
    /// The median extent of the faces.
    median: f64,
    sample: Vec<f64>,
}

impl Sizes {
    /// Takes the measure from some of the faces. Classes decide on time alone, so an estimate does.
    pub fn measure(&mut self, faces: &[Box3]) {
        let every = faces.len() / SAMPLES + 1;
        self.sample.clear();
        self.sample.extend(faces.iter().step_by(every).filter(|face| face.is_sound()).map(Box3::extent));
        self.sample.retain(|extent| *extent > 0.0);
        let middle = self.sample.len() / 2;
        self.median = if self.sample.is_empty() {
            1.0
        } else {
            // Bounded so that neither a class's cell nor its inverse overflows.
            self.sample.select_nth_unstable_by(middle, f64::total_cmp).1.clamp(1e-200, 1e200)
        };
    }

    /// The class of a box.
    pub fn class(&self, of: &Box3) -> u8 {
        if !of.is_sound() {
            return UNSOUND;
        }
        // The binary exponent is the logarithm to base two, rounded down.
        let binary = ((of.extent() * (2.0 / self.median)).to_bits() >> 52) as i32 - 1023;
        (i32::from(ORDINARY) + (binary >> 1)).clamp(0, i32::from(CLASSES) - 1) as u8
    }

    /// The classes of boxes.
    pub fn classes(&self, of: &[Box3], into: &mut Vec<u8>) {
        into.clear();
        into.extend(of.iter().map(|one| self.class(one)));
    }

    /// Median of the faces, scaled to a class: boxes of this class are half to twice as long.
    pub fn typical(&self, class: u8) -> f64 {
        self.median * 4f64.powi(i32::from(class) - i32::from(ORDINARY))
    }
}

/// How many boxes are in each of the classes.
pub fn members(classes: &[u8]) -> [usize; CLASSES as usize] {
    let mut members = [0; CLASSES as usize];
    classes.iter().filter(|class| **class < CLASSES).for_each(|class| members[*class as usize] += 1);
    members
}

/// Whether some box is in each of the classes.
pub fn present(classes: &[u8]) -> [bool; CLASSES as usize] {
    members(classes).map(|members| members > 0)
}
