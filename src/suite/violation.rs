//! Positions of violated expectations in the file of a suite.

use super::pattern::fits;
use super::yaml::{Diagnostic, Source, Step};
use crate::verify::CaseOutcome;

/// Returns a diagnostic for each expectation that a case of `suite` violates. It points at the
/// entry of `expect` (or at `any_method`, with `run --gate`) that the result violates, or at the
/// file if the requirement comes from elsewhere.
pub fn violations(source: &Source, suite: &str, case: &CaseOutcome) -> Vec<Diagnostic> {
    let place = entry(source, case).and_then(|path| {
        let key = REQUIREMENTS.iter().find_map(|key| source.key_at(&then(&path, *key)));
        key.or_else(|| source.value_at(&path))
    });
    let help = format!("next: mpm-verify {}", next_command(source, suite, case));
    let diagnostic = |unmet: &String| {
        let message = format!("{suite}::{}: {unmet}", case.case);
        let diagnostic = match place {
            Some(place) => source.diagnostic(place, &message).with_label("violated"),
            None => Diagnostic::about(source.name(), &message),
        };
        diagnostic.with_help(&help)
    };
    case.unmet.iter().map(diagnostic).collect()
}

/// Returns the arguments of the command that helps with a failed case. Only convergence studies can
/// be diagnosed.
pub fn next_command(source: &Source, suite: &str, case: &CaseOutcome) -> String {
    let is_file = std::path::Path::new(source.name()).is_file();
    let suite = if is_file { source.name() } else { suite };
    match case.convergence() {
        None => format!("explain {suite}"),
        Some(_) if case.subject == "external" => format!("diagnose {suite} --solver COMMAND"),
        Some(_) => format!("diagnose {suite} --case {}", case.case),
    }
}

/// Keys of an entry that can be pointed at, the most important first.
const REQUIREMENTS: [&str; 6] =
    ["order", "verdict", "error_below", "drift", "energy_rate", "crossings"];

fn then(path: &[Step], step: impl Into<Step>) -> Vec<Step> {
    [path, &[step.into()]].concat()
}

/// Returns the path of the entry whose expectation the case has: its pattern matches the name of
/// the case, and its reason is that of the case.
fn entry(source: &Source, case: &CaseOutcome) -> Option<Vec<Step>> {
    let list = [Step::from("expect")];
    let entries = (0..).map(|k| then(&list, k)).take_while(|path| source.value_at(path).is_some());
    let any_method = std::iter::once(vec![Step::from("any_method")]);
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let reason = words(&case.because);
    entries.chain(any_method).find(|path| {
        let names = then(path, "case");
        let matches = match source.text_at(&names) {
            Some(name) => fits(name, &case.case),
            None if source.value_at(&names).is_none() => true,
            None => (0..)
                .map_while(|k| source.text_at(&then(&names, k)))
                .any(|name| fits(name, &case.case)),
        };
        matches && source.text_at(&then(path, "because")).map(words) == Some(reason.clone())
    })
}
