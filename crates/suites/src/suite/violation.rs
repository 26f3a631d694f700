//! Positions of violated expectations in the file of a suite.

use super::pattern::fits;
use super::yaml::{Diagnostic, Source, Step};
use crate::verify::{CaseOutcome, Unmet, UnmetCode};

/// Returns a diagnostic for each expectation that a case of `suite` violates. It points at the
/// entry of `expect` (or at `any_method`, with `run --gate`) that the result violates, or at the
/// file if the requirement comes from elsewhere.
pub fn violations(source: &Source, suite: &str, case: &CaseOutcome) -> Vec<Diagnostic> {
    let place = entry(source, case).and_then(|path| {
        let key = REQUIREMENTS.iter().find_map(|key| source.key_at(&then(&path, *key)));
        key.or_else(|| source.value_at(&path))
    });
    let diagnostic = |unmet: &Unmet| {
        let code = unmet.code.name();
        let next = next_command(source, suite, case);
        let help = format!("next: mpm-verify {next}; mpm-verify explain {code}");
        let message = format!("{suite}::{}: {unmet}", case.case);
        let diagnostic = match place {
            Some(place) => source.diagnostic(place, &message).with_label("violated"),
            None => Diagnostic::about(source.name(), &message),
        };
        diagnostic.with_code(code).with_help(&help)
    };
    case.unmet.iter().map(diagnostic).collect()
}

/// Returns the arguments of the command that helps with a failed case.
pub fn next_command(source: &Source, suite: &str, case: &CaseOutcome) -> String {
    let is_file = std::path::Path::new(source.name()).is_file();
    let suite = if is_file { source.name() } else { suite };
    match case.convergence() {
        None => format!("explain {suite}"),
        Some(_) if case.subject == "external" => format!("diagnose {suite} --solver COMMAND"),
        Some(_) => format!("diagnose {suite} --case {}", case.case),
    }
}

/// Returns the meaning of a code, and what to do about the failure.
pub fn meaning(code: UnmetCode) -> [&'static str; 2] {
    match code {
        UnmetCode::RunFailed => [
            "A level did not run to its end: the solver stopped with an error, or a value is not \
             finite.",
            "Read the reason of the failure in the report. Shorten the time step of the suite to \
             find out whether the run is unstable.",
        ],
        UnmetCode::VerdictDiffers => [
            "The errors behave differently under refinement than expected, or they have no \
             observed order.",
            "Look at the errors of the levels in the report; docs/judge.md describes each verdict.",
        ],
        UnmetCode::OrderTooLow => [
            "The 95 % interval of the observed order is not above the lower bound. The error \
             decreases more slowly than expected, or so irregularly that the order is uncertain.",
            "`diagnose` runs the finest levels again with one change at a time, and names the \
             change that restores the order.",
        ],
        UnmetCode::OrderTooHigh => [
            "The 95 % interval of the observed order is not below the upper bound. The order of a \
             method cannot exceed theory: the test is too easy, or its coarse levels have an \
             additional error.",
            "Check that the exact solution is no member of the discrete space and that the errors \
             are not rounding errors. Add finer levels.",
        ],
        UnmetCode::LimitGone => [
            "The suite expects the method to fail, but the method converges. Either the method \
             has improved, or the suite no longer shows the defect.",
            "If the improvement is intended, expect `order` in place of the failure, and change \
             the reason.",
        ],
        UnmetCode::BoundExceeded => [
            "A measured value is above its largest or below its smallest accepted value, or it \
             could not be measured.",
            "Compare the value with the report of the last passing commit: `mpm-verify compare`.",
        ],
        UnmetCode::NotConserved => [
            "Mass, momentum, angular momentum or energy changes by more than the bound.",
            "A drift at rounding level that grows with the number of steps is harmless; a larger \
             one indicates a defect of the transfer or of the time integration.",
        ],
        UnmetCode::CrossingsDiffer => [
            "On the finest level particles cross cells although the suite expects none, or the \
             reverse. The suite then tests another effect than its name promises.",
            "Change the amplitude, the spacing or the duration, or correct `crossings`.",
        ],
        UnmetCode::FloorDiffers => [
            "Halving another spacing than the expected one lowers the error on the finest level.",
            "Refine the axis that the report names, or correct `floor`.",
        ],
        UnmetCode::StabilityDiffers => [
            "A run is stable, unstable or damped against the expectation, or the stability limit \
             or another value is out of bounds.",
            "The row names the swept value. Run the case alone, and look at its energy.",
        ],
        UnmetCode::SpectrumDiffers => [
            "Phase or amplitude of a wave differs from the closed form of the method.",
            "The row names resolution and Courant number. Check transfer and mass matrix.",
        ],
        UnmetCode::ForceDiffers => [
            "The internal force at some position of the body differs from the prediction, or \
             jumps between neighbouring positions.",
            "Check the gradients of the basis functions at cell boundaries.",
        ],
        UnmetCode::DerivativeDiffers => [
            "The derivative that the solver reports does not agree with differences of its own \
             results.",
            "The state names the likely cause, such as single precision or a detached part.",
        ],
    }
}

/// Keys of an entry that can be pointed at, the most important first.
const REQUIREMENTS: [&str; 6] =
    ["order", "verdict", "error_below", "drift", "energy_rate", "crossings"];

fn then(path: &[Step], step: impl Into<Step>) -> Vec<Step> {
    [path, &[step.into()]].concat()
}

/// Returns the path of the entry whose `case` and `because` are those of the case.
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
