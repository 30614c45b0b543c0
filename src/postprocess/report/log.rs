//! The print log read again: its sections, its warnings, and how the run ended.

use std::path::Path;

/// A print log.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Log {
    /// Lines before the first heading: program, date, ranks, files.
    pub banner: Vec<String>,
    /// Sections in their order.
    pub sections: Vec<Section>,
    /// Warnings, each with its advice; those that the log of an earlier part of the run has told have none.
    pub warnings: Vec<[String; 2]>,
    /// The last line: how the run ended. Empty where it has not ended, or was killed.
    pub outcome: String,
}

/// A section under a heading of spread letters.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Section {
    /// The heading, in capitals: `WHAT IS MODELLED`.
    pub heading: String,
    /// The lines below it that are not empty.
    pub lines: Vec<String>,
}

/// Heading of the last section.
const END: &str = "END OF SOLUTION PHASE";
/// Heading of the table of all warnings.
const ALL_WARNINGS: &str = "WARNINGS OF THE RUN";
/// How a warning among the steps begins.
const WARNING: &str = "***** WARNING: ";

impl Log {
    /// The log at a path; `None` where there is none that can be read.
    pub fn read(path: &Path) -> Option<Log> {
        std::fs::read(path).ok().map(|bytes| Log::of(&String::from_utf8_lossy(&bytes)))
    }

    fn of(text: &str) -> Log {
        let mut log = Log::default();
        let mut lines = text.lines().peekable();
        while let Some(line) = lines.next() {
            if let Some(words) = line.strip_prefix(WARNING) {
                let advice = lines.peek().and_then(|next| next.trim().strip_prefix("advice: ")).unwrap_or_default();
                log.warnings.push([words.to_owned(), advice.to_owned()]);
            } else if let Some(heading) = heading(line) {
                log.sections.push(Section { heading, lines: Vec::new() });
            } else if !line.trim().is_empty() {
                match log.sections.last_mut() {
                    Some(section) => section.lines.push(line.trim_end().to_owned()),
                    None => log.banner.push(line.trim().to_owned()),
                }
            }
        }
        let last = log.sections.last().filter(|section| section.heading == END);
        log.outcome = last.map(|section| section.lines.join(" ").trim().to_owned()).unwrap_or_default();
        let before = log.told_before();
        log.warnings.splice(0..0, before);
        log
    }

    /// Warnings of a run that went on which only the table at its end has: they were told in the log of the part before. What is seen
    /// at one step is told in one log.
    fn told_before(&self) -> Vec<[String; 2]> {
        let told = |step: &str| self.warnings.iter().any(|[words, _]| words.starts_with(&format!("AT STEP {step},")));
        let rows = self.section(ALL_WARNINGS).into_iter().flat_map(|section| &section.lines);
        let row = |line: &String| {
            let mut columns = line.split_whitespace();
            let [step, time, _, worst] = [(); 4].map(|()| columns.next().unwrap_or_default());
            let what = columns.collect::<Vec<_>>().join(" ");
            let is_row = step.parse::<u64>().is_ok() && !what.is_empty();
            (is_row && !told(step)).then(|| {
                [
                    format!("AT STEP {step}, TIME {time}: {what}, told in the log before this one; at most {worst}"),
                    String::new(),
                ]
            })
        };
        rows.filter_map(row).collect()
    }

    /// The lines of the last section with this heading.
    pub fn section(&self, heading: &str) -> Option<&Section> {
        self.sections.iter().rev().find(|section| section.heading == heading)
    }
}

impl Section {
    /// Names and values of its lines with dot leaders.
    pub fn leaders(&self) -> Vec<(String, String)> {
        self.lines.iter().filter_map(|line| leader(line)).collect()
    }

    /// Its lines without the indent that they have in common.
    pub fn block(&self) -> String {
        let indent = |line: &String| line.len() - line.trim_start().len();
        let least = self.lines.iter().map(indent).min().unwrap_or(0);
        self.lines.iter().map(|line| line.get(least..).unwrap_or(line).to_owned() + "\n").collect()
    }
}

/// The words of a heading: `A B   C` is `AB C`.
fn heading(line: &str) -> Option<String> {
    let line = line.trim();
    let words: Vec<String> = line.split("   ").map(|word| word.replace(' ', "")).collect();
    let spread = line.split("   ").all(|word| {
        let letters: Vec<&str> = word.split(' ').collect();
        letters.iter().all(|letter| letter.chars().count() == 1)
    });
    let letters = words.iter().map(|word| word.chars().count()).sum::<usize>();
    (spread && letters > 3).then(|| words.join(" "))
}

/// `NAME ..... value`.
fn leader(line: &str) -> Option<(String, String)> {
    let (name, rest) = line.trim().split_once(" ..")?;
    let value = rest.trim_start_matches('.').trim();
    (!name.is_empty() && !value.is_empty()).then(|| (name.trim().to_owned(), value.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_is_taken_apart() {
        let text = "urto 0.1\n\n                P R O B L E M   T I T L E\n\n          A B C\n\n\n    C O N T A C T\n\n\
                    \x20             CONTACT NODES ............................          12\n\n\
                    ***** WARNING: AT STEP 5, TIME 1e-3: it is hot\n  advice: cool it\n\n\
                    \x20  E N D   O F   S O L U T I O N   P H A S E\n\n  THE RUN IS COMPLETE\n";
        let log = Log::of(text);
        assert_eq!(log.banner, ["urto 0.1"]);
        assert_eq!(log.section("PROBLEM TITLE").map(Section::block).as_deref(), Some("A B C\n"));
        let contact = log.section("CONTACT").map(Section::leaders).unwrap_or_default();
        assert_eq!(contact, [("CONTACT NODES".to_owned(), "12".to_owned())]);
        assert_eq!(log.warnings, [["AT STEP 5, TIME 1e-3: it is hot".to_owned(), "cool it".to_owned()]]);
        assert_eq!(log.outcome, "THE RUN IS COMPLETE");
        assert_eq!(Log::of("P R O B L E M").outcome, "");
    }

    /// A run that went on tells among its steps only what it has seen itself.
    #[test]
    fn warnings_of_the_part_before_are_in_the_table_alone() {
        let text = "***** WARNING: AT STEP 70, TIME 7e-3: it is hot\n  advice: cool it\n\n\
                    \x20      W A R N I N G S   O F   T H E   R U N\n\n\
                    \x20    STEP         TIME        SHARE      AT MOST   OF WHAT\n\
                    \x20       5    1.000e-03    1.585e-01    2.585e-01   hourglass energy of block 7\n\
                    \x20      70    7.000e-03    1.585e-01    1.585e-01   heat\n\n\
                    \x20  E N D   O F   S O L U T I O N   P H A S E\n\n  THE RUN IS COMPLETE\n";
        let [before, own] = &Log::of(text).warnings[..] else { panic!("two") };
        assert!(before[0].starts_with("AT STEP 5, TIME 1.000e-03: hourglass energy of block 7, told"), "{before:?}");
        assert_eq!(own, &["AT STEP 70, TIME 7e-3: it is hot".to_owned(), "cool it".to_owned()]);
    }
}
