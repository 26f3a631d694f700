//! Proposed expectations, in the notation of suites.

use super::prose::wrap;
use crate::verify::{CaseOutcome, Proposal, ProposedKey, SuiteOutcome, grouped, propose};

/// Maximum line width of a suite file.
const WIDTH: usize = 96;

/// Indentation of continuation lines in a list of cases.
const LIST: &str = "           ";

/// Writes the proposed `expect` of a suite after `remarks`, with one entry for all equal proposals.
/// Comments explain the origin of each key and how to reach a stronger expectation.
pub fn proposals(outcome: &SuiteOutcome, remarks: impl Iterator<Item = String>) -> String {
    let proposed = outcome.results(CaseOutcome::convergence).map(|(case, study)| {
        let mut proposal = propose(study);
        let seen = std::mem::take(&mut proposal.seen);
        (proposal, (case, seen))
    });
    let groups = grouped(proposed);
    let mut lines = Vec::new();
    remarks.for_each(|remark| folded(&mut lines, "# ", &remark));
    lines.push("expect:".to_owned());
    // Results of an external solver do not apply to other methods, so the entry names its cases.
    let is_external = outcome.cases.iter().any(|case| case.subject == "external");
    let alone = groups.len() == 1 && !is_external;
    for (proposal, cases) in &groups {
        entry(&mut lines, proposal, cases, alone);
    }
    lines.join("\n") + "\n"
}

fn entry(lines: &mut Vec<String>, proposal: &Proposal, cases: &[(&str, String)], alone: bool) {
    let width = cases.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    lines.extend(cases.iter().map(|(name, seen)| format!("  # {name:width$}  {seen}")));
    for advice in &proposal.stronger {
        folded(lines, "  # ", advice);
    }
    if proposal.keys.is_empty() {
        folded(lines, "  # ", "nothing can be expected of this case");
        return;
    }
    let mut keys: Vec<(String, String)> = Vec::new();
    if !alone {
        let names: Vec<&str> = cases.iter().map(|(name, _)| *name).collect();
        let mut list = Vec::new();
        wrap(&mut list, WIDTH - LIST.len(), &names.join(", "));
        keys.push((format!("case: [{}]", list.join(&format!("\n{LIST}"))), String::new()));
    }
    let ground = |key: &ProposedKey| format!("  # from {}", key.ground.name());
    keys.extend(proposal.keys.iter().map(|key| (key.text.clone(), ground(key))));
    keys.push(("because: >".to_owned(), String::new()));
    for (i, (key, comment)) in keys.iter().enumerate() {
        let lead = if i == 0 { "  - " } else { "    " };
        lines.push(format!("{lead}{key}{comment}"));
    }
    folded(lines, "      ", &proposal.because);
}

fn folded(lines: &mut Vec<String>, lead: &str, prose: &str) {
    let mut wrapped = Vec::new();
    wrap(&mut wrapped, WIDTH - lead.len(), prose);
    lines.extend(wrapped.into_iter().map(|line| format!("{lead}{line}")));
}
