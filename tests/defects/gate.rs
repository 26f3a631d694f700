//! Name of the gate that reports an unmet expectation.

use mpm_verify::verify::CaseOutcome;

/// Gates of convergence studies by the beginning of their messages; the first match applies.
const GATES: [(&str, &str); 12] = [
    ("expected the order within", "order"),
    ("expected the finest pair's order", "order"),
    ("expected the verdict", "verdict"),
    ("expected every level to run", "verdict"),
    ("expected the floor", "verdict"),
    ("expected some crossings", "bound"),
    ("expected no crossings", "bound"),
    ("expected drift of energy", "energy"),
    ("expected drift of kinetic energy", "energy"),
    ("expected rate of energy", "energy"),
    ("expected drift", "conservation"),
    ("expected ", "bound"),
];

/// The gate that reports `line`. A wrong order is a separate gate, for any verdict.
pub(crate) fn gate(case: &CaseOutcome, line: &str) -> &'static str {
    if case.study.is_none() {
        return "verdict";
    }
    if case.stability().is_some() {
        return "stability";
    }
    if case.internal_force().is_some() {
        return "force";
    }
    // Deviations from the closed form are bounded.
    if case.spectrum().is_some() {
        return "bound";
    }
    let of_order = ["got `too low`", "got `too good`", "got `converging`"];
    let should_converge = line.starts_with("expected the verdict `converging`");
    if should_converge && of_order.iter().any(|got| line.contains(got)) {
        return "order";
    }
    let known = GATES.iter().find(|(words, _)| line.starts_with(words));
    known.unwrap_or_else(|| panic!("no gate is known to say: {line}")).1
}
