//! Proposed expectations, in the notation of suites.

use super::prose::wrap;
use crate::verify::{CaseOutcome, Proposal, ProposedKey, SuiteOutcome, propose};

/// Maximum line width of a suite file.
const WIDTH: usize = 96;

/// Indentation of continuation lines in a list of cases.
const LIST: &str = "           ";

/// Cases that have the same proposed expectation.
struct Group<'a> {
    proposal: Proposal,
    /// Name and observed result of each case.
    cases: Vec<(&'a str, String)>,
}

/// Writes the proposed `expect` of a suite, with one entry for all cases with equal proposals.
/// Comments explain the origin of each key and how to reach a stronger expectation. The text begins
/// with `remarks` about the suite.
pub fn proposals(outcome: &SuiteOutcome, remarks: impl Iterator<Item = String>) -> String {
    let mut groups: Vec<Group<'_>> = Vec::new();
    for (case, study) in outcome.results(CaseOutcome::convergence) {
        let proposal = propose(study);
        let seen = (case, proposal.seen.clone());
        let same = |group: &&mut Group<'_>| {
            let known = &group.proposal;
            (&known.keys, &known.because, &known.stronger)
                == (&proposal.keys, &proposal.because, &proposal.stronger)
        };
        match groups.iter_mut().find(same) {
            Some(group) => group.cases.push(seen),
            None => groups.push(Group { proposal, cases: vec![seen] }),
        }
    }
    let mut lines = Vec::new();
    remarks.for_each(|remark| folded(&mut lines, "# ", &remark));
    lines.push("expect:".to_owned());
    // An external solver is only one method of its suite. Its results do not apply to other
    // methods, so the entry names the cases of the solver.
    let is_external = outcome.cases.iter().any(|case| case.subject == "external");
    let alone = groups.len() == 1 && !is_external;
    for group in &groups {
        entry(&mut lines, group, alone);
    }
    lines.join("\n") + "\n"
}

fn entry(lines: &mut Vec<String>, group: &Group<'_>, alone: bool) {
    let Group { proposal, cases } = group;
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
