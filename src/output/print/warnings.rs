//! What a run has found out about itself: at once, at the end of the log, and in one line.

use super::{echo, scientific};
use crate::solver::Finding;

/// A warning in the log, among the lines of steps.
pub fn warning(finding: &Finding) -> String {
    let Finding { step, time, .. } = finding;
    let (words, advice) = (finding.words(), finding.advice());
    format!("\n***** WARNING: AT STEP {step}, TIME {time:.6e}: {words}\n  advice: {advice}\n\n")
}

/// A warning on the terminal.
pub fn warning_on_terminal(finding: &Finding) -> String {
    let Finding { step, time, .. } = finding;
    let when = if *step == 0 { String::new() } else { format!("step {step}, time {}: ", scientific(*time, 4)) };
    format!("warning: {when}{}\nhelp: {}", finding.words(), finding.advice())
}

/// All warnings of a run in a few words each; `before` is the number of those from reading deck and mesh.
pub fn labels(before: usize, findings: &[Finding]) -> Vec<String> {
    let read = std::iter::repeat_n("of the deck or the mesh".to_string(), before);
    read.chain(findings.iter().map(Finding::label)).collect()
}

/// The end of a run's last line: `, with 2 warnings: …`; nothing where there were none.
pub fn with_warnings(labels: &[String]) -> String {
    let mut told: Vec<String> = Vec::new();
    for run in labels.chunk_by(|a, b| a == b) {
        let times = if run.len() > 1 { format!("{} ", run.len()) } else { String::new() };
        told.push(format!("{times}{}", run[0]));
    }
    let plural = if labels.len() == 1 { "warning" } else { "warnings" };
    if labels.is_empty() { String::new() } else { format!(", with {} {plural}: {}", labels.len(), told.join("; ")) }
}

/// The warnings once more, with how far each has gone.
pub(super) fn table(findings: &[Finding]) -> String {
    let line = |finding: &Finding| {
        let Finding { step, time, evidence, worst, .. } = finding;
        let numbers = [*time, evidence.share, *worst].map(|value| format!("{:>13}", scientific(value, 3))).concat();
        format!("{step:>9}{numbers}   {}", finding.label())
    };
    echo::table(
        "WARNINGS OF THE RUN",
        "     STEP         TIME        SHARE      AT MOST   OF WHAT",
        findings.iter().map(line).collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_are_counted_in_one_line() {
        let labels = |before| with_warnings(&labels(before, &[]));
        assert_eq!(labels(0), "");
        assert_eq!(labels(1), ", with 1 warning: of the deck or the mesh");
        assert_eq!(labels(2), ", with 2 warnings: 2 of the deck or the mesh");
    }
}
