//! Which variables of a history are means over an interval, and where the first interval of a run that goes on begins.
//!
//! An acceleration is the change of velocity since the state before, a force of contact the change of impulse: only as such
//! do they add up to what has changed. A run writes it as comments behind the deck into the records of its histories, and
//! who integrates them reads it there.

/// How a line begins that names variables by the first letters of their names.
const NAMES: &str = "$ MEANS OVER INTERVALS: ";
/// How a line begins that tells the time of the last state before the first of the file; in plot files that at which the run goes on.
const SINCE: &str = "$ MEANS SINCE: ";

/// What is told.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Means {
    /// How the names of such variables begin.
    pub beginnings: Vec<String>,
    /// Time of the state at which the first interval begins, in a run that goes on.
    pub since: Option<f64>,
}

impl Means {
    /// As lines of a deck that say nothing to who runs it.
    pub fn lines(&self) -> Vec<String> {
        // Each line fits a record of eighty letters.
        let names = self.beginnings.chunks(4).map(|some| format!("{NAMES}{}", some.join(" ")));
        let since = self.since.map(|time| format!("{SINCE}{time:e}"));
        names.chain(since).collect()
    }

    /// Finds these lines among others; what cannot be read is passed over.
    pub fn read(lines: &[String]) -> Means {
        let mut told = Means::default();
        for line in lines {
            if let Some(names) = line.strip_prefix(NAMES) {
                told.beginnings.extend(names.split_whitespace().map(str::to_owned));
            }
            let since = line.strip_prefix(SINCE).and_then(|time| time.trim().parse().ok());
            told.since = since.filter(|time: &f64| time.is_finite()).or(told.since);
        }
        told
    }

    /// All lines but these.
    pub fn without(lines: Vec<String>) -> Vec<String> {
        lines.into_iter().filter(|line| !line.starts_with(NAMES) && !line.starts_with(SINCE)).collect()
    }

    /// Whether each value of a variable is the mean since the state before.
    pub fn is_mean(&self, name: &str) -> bool {
        let name = name.to_uppercase();
        self.beginnings.iter().any(|beginning| name.starts_with(beginning.as_str()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_told_is_read_among_the_lines_of_a_deck() {
        let beginnings = ["ACCL", "FX_WALL", "FY_WALL", "FX_CONTACT", "FY_CONTACT"].map(String::from).to_vec();
        // A time comes back to the bit.
        let told = Means { beginnings, since: Some(0.1 + 0.2) };
        let lines = told.lines();
        assert!(lines.len() == 3 && lines.iter().all(|line| line.len() <= 80), "{lines:?}");
        let deck = ["TITLE", "$ MEANS SINCE: never", "EXIT"].map(String::from).to_vec();
        assert_eq!(Means::read(&[deck, lines].concat()), told);
        assert!(told.is_mean("acclx_block3") && told.is_mean("FX_WALL100"));
        assert!(!told.is_mean("VELX_1") && !told.is_mean("RX_SET1") && !told.is_mean("WORK1_CONTACT1_2"));
    }
}
