//! A print log without what depends on machine and day, and the lines in which two of them differ.

/// Columns of step lines that time the machine, where they begin and end; and the width of SECONDS TO GO, wherever it stands.
const TIMED: (usize, usize) = (39, 71);
const TO_GO: usize = 10;

/// Words of lines that depend on the machine, or on the number of ranks.
const PASSING: [&str; 8] = [
    " % of the time went there",
    "SECONDS PER ELEMENT CYCLE",
    "ELEMENT CYCLES PER SECOND",
    "LARGEST MEMORY",
    " SECONDS",
    "MEGABYTES HELD",
    "NUMBER OF RANKS",
    "ELEMENTS OF A RANK",
];

/// Heads of the parts that are left out: the deck, which stands elsewhere, and the tables of time and of ranks.
const LEFT_OUT: [&str; 3] = ["INPUTSTREAMIMAGES", "WHERETHETIMEWENT", "WHATARANKHASTODOINASTEP"];

/// Lines of the banner: program and version; day, machine and ranks; names of the files.
const BANNER: usize = 3;

/// Words of lines among those of steps that are kept as they are.
const WARNINGS: [&str; 2] = ["***** WARNING", "  advice: "];

/// Differing lines of a log that are shown.
const SHOWN: usize = 12;

/// The log without version, day, times of the machine and memory.
pub fn lasting(log: &str) -> String {
    let mut out = String::new();
    let [mut skipped, mut steps] = [false; 2];
    let mut timed = vec![TIMED];
    for line in log.lines().skip(BANNER) {
        let packed: String = line.chars().filter(|c| !c.is_whitespace()).collect();
        if is_head(line) {
            (skipped, steps) = (LEFT_OUT.contains(&packed.as_str()), false);
        }
        // What follows the time table without a head of its own begins with the number of ranks.
        skipped &= !line.contains("NUMBER OF RANKS");
        if line.contains("TIME DILATATION") {
            steps = true;
            let end = line.rfind("SECONDS").map(|begin| begin + "SECONDS".len()).filter(|end| *end > TIMED.1);
            timed.extend(end.map(|end| (end - TO_GO, end)));
        }
        let is_warning = WARNINGS.iter().any(|words| line.starts_with(words));
        if steps && !packed.is_empty() && !line.contains("RESTART FILE") && !is_warning {
            out += &untimed(line, &timed);
            out += "\n";
        } else if !skipped && !PASSING.iter().any(|words| line.contains(words)) {
            out += line.trim_end();
            out += "\n";
        }
    }
    out
}

/// Heads are set in spaced letters.
fn is_head(line: &str) -> bool {
    let words: Vec<&str> = line.split_whitespace().collect();
    words.len() > 4 && words.iter().all(|word| word.len() == 1)
}

/// A line of steps, or of their heads, without the columns that time the machine.
fn untimed(line: &str, timed: &[(usize, usize)]) -> String {
    let timed = |place: &usize| timed.iter().any(|(begin, end)| (begin..end).contains(&place));
    let kept = line.chars().enumerate().filter(|(place, _)| !timed(place)).map(|(_, c)| c);
    kept.collect::<String>().trim_end().to_string()
}

/// The lines in which two logs differ, old ones with a minus and new ones with a plus before them.
pub fn differences(old: &str, new: &str) -> Vec<String> {
    let [old, new] = [old, new].map(|text| text.lines().collect::<Vec<&str>>());
    let same_start = old.iter().zip(&new).take_while(|(a, b)| a == b).count();
    let rest = old.len().min(new.len()) - same_start;
    let same_end = old.iter().rev().zip(new.iter().rev()).take(rest).take_while(|(a, b)| a == b).count();
    let [old, new] = [old, new].map(|lines| lines[same_start..lines.len() - same_end].to_vec());
    if old.is_empty() && new.is_empty() {
        return Vec::new();
    }
    let mut out = vec![format!("print log, from line {}:", same_start + 1)];
    // Lines that answer each other stand together, and equal ones are left out.
    let pairs = (0..old.len().max(new.len())).map(|i| (old.get(i), new.get(i))).filter(|(a, b)| a != b);
    let lines = pairs.flat_map(|(a, b)| [a.map(|line| format!("  - {line}")), b.map(|line| format!("  + {line}"))]);
    out.extend(lines.flatten().take(SHOWN));
    out
}

#[test]
fn only_the_machine_is_left_out() {
    let log = "one\ntwo\nthree\n    I N P U T   S T R E A M   I M A G E S\ndeck\n    M A S S   O F   A L L\n  1.0\n  2 SECONDS\n";
    assert_eq!(lasting(log), "    M A S S   O F   A L L\n  1.0\n");
}
