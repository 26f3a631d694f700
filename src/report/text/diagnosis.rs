//! Diagnoses as text: causes, evidence and remedies.

use super::prose::{paragraph_lines, row};
use super::table::Table;
use crate::report::columns::TableColumn;
use crate::verify::{Cause, ChangedRun, Diagnosis, Evidence, Interval, Verdict};

/// Writes the diagnosis of one case: a paragraph, and a table of the runs.
pub fn diagnosis(found: &Diagnosis) -> String {
    let mut lines = vec![format!("== {} ==", found.case)];
    paragraph_lines(&mut lines, &paragraph(found));
    if !found.runs.is_empty() {
        lines.push(String::new());
        lines.extend(Table::new(&columns(), &found.runs).lines());
    }
    if !found.skipped.is_empty() {
        row(&mut lines, "beyond the budget", &found.skipped.join("; "));
    }
    lines.join("\n") + "\n"
}

pub(crate) fn paragraph(found: &Diagnosis) -> String {
    let judgement = &found.judgement;
    if found.is_sound() {
        return format!("The observed order agrees with theory: {}.", judgement.reason);
    }
    let (p, verdict) = (found.formal_order, judgement.verdict);
    let mut sentences = vec![format!(
        "Theory gives order {p}, and the verdict is {verdict}: {}.",
        judgement.reason
    )];
    let causes = found.causes();
    for (k, cause) in causes.iter().enumerate() {
        let lead = match (k, cause) {
            (0, Cause::Run(_, Evidence::Lowered)) => "Largest contribution",
            (0, _) => "Cause",
            _ => "Also possible",
        };
        sentences.push(format!("{lead}: {}.", cause.cause()));
        sentences.push(match cause {
            Cause::Known(finding) => finding.evidence.clone(),
            Cause::Run(run, evidence) => evidence_of_run(found, run, *evidence),
        });
        sentences.extend(remedy(cause));
    }
    if causes.is_empty() {
        sentences.push(unknown_cause(found));
    }
    if found.is_external && !found.is_known() {
        sentences.push(
            "Settings of the method (start, scheme, basis, transfer, mass matrix, frame) are not \
             changed, because the solver is external."
                .to_owned(),
        );
    }
    sentences.join(" ")
}

fn range(found: &Diagnosis) -> String {
    match (found.levels.first(), found.levels.last()) {
        (Some(first), Some(last)) => format!("{first} to {last}"),
        _ => String::new(),
    }
}

fn order(order: Option<Interval>) -> String {
    order.map_or("not determined".to_owned(), |order| order.shown())
}

fn evidence_of_run(found: &Diagnosis, run: &ChangedRun, evidence: Evidence) -> String {
    let (change, with, before) = (&run.change, order(run.order), order(found.finest.order));
    let (range, error) = (range(found), error_of_run(found, run));
    match evidence {
        Evidence::Restored => format!(
            "With {change} the order from {range} is {with} (before: {before}), and {error}."
        ),
        Evidence::Raised => format!(
            "With {change} the order from {range} is {with} (before: {before}), which does not yet \
             agree with theory."
        ),
        Evidence::Lowered => format!(
            "With {change} {error}. The order from {range} is then {with}, so there is another cause."
        ),
    }
}

/// Describes the finest error of a changed run, compared with that of the unchanged case.
fn error_of_run(found: &Diagnosis, run: &ChangedRun) -> String {
    let (before, after) = (found.finest_error, run.error);
    if !run.ratio.is_finite() {
        return format!("the error on the finest level is {after:.3e} (before: not finite)");
    }
    let relative = if (run.relative_ratio / run.ratio - 1.0).abs() > 1e-9 {
        let share = share(run.relative_ratio);
        format!("; relative to the exact solution, it is {share} the error before")
    } else {
        String::new()
    };
    let share = share(run.ratio);
    format!("the error on the finest level is {after:.3e}, {share} {before:.3e}{relative}")
}

/// Formats a positive ratio for a text in which the reference value follows, such as `1/8 of`.
fn share(ratio: f64) -> String {
    if ratio < 1e-4 {
        format!("{ratio:.0e} of")
    } else if ratio < 0.15 {
        format!("1/{:.0} of", 1.0 / ratio)
    } else {
        format!("{ratio:.2} times")
    }
}

fn remedy(cause: &Cause<'_>) -> Option<String> {
    let label = match cause {
        Cause::Run(_, Evidence::Raised | Evidence::Lowered) => "Partial remedy",
        _ => "Remedy",
    };
    match (cause.remedy(), cause) {
        (Some(remedy), _) => Some(format!("{label}: {remedy}.")),
        (None, Cause::Run(run, _)) => {
            let refusal = run.refusal.as_deref().unwrap_or_default();
            Some(format!("`check` refuses {} in this suite: {refusal}.", run.remedy))
        }
        (None, Cause::Known(_)) => None,
    }
}

fn unknown_cause(found: &Diagnosis) -> String {
    let range = range(found);
    if found.runs.is_empty() && !found.skipped.is_empty() {
        return "No change was tested within the budget.".to_owned();
    }
    if found.finest.verdict == Verdict::Converging {
        let order = order(found.finest.order);
        return format!(
            "From {range} the order is {order}: coarser levels are not asymptotic, or the levels are \
             too few."
        );
    }
    let worse = found.runs.iter().find(|run| run.has_more_particles && run.ratio > WORSE);
    let cause = worse.map_or("The cause is none of those that `diagnose` tests.".to_owned(), |run| {
        format!(
            "But {} make the error {:.2} times larger. Particles are quadrature points, so more of \
             them should not increase the error. Check sums and means over the particles of a cell, \
             and the volumes and masses of particles.",
            run.change, run.ratio
        )
    });
    format!(
        "No single change restores the order from {range}, or removes a quarter of the error on the \
         finest level. {cause}"
    )
}

/// Ratio of errors above which more particles count as a cause.
const WORSE: f64 = 1.15;

fn columns<'a>() -> [TableColumn<'a, ChangedRun>; 4] {
    type RunColumn<'a> = TableColumn<'a, ChangedRun>;
    [
        RunColumn::text("changed", "the change", |run| run.change.clone()).flush_left(),
        RunColumn::text("verdict", "verdict", |run| run.verdict.to_string()).flush_left(),
        RunColumn::text("order", "observed order", |run| run.order.map(|order| order.shown())),
        RunColumn::text(
            "error/before",
            "error on the finest level, divided by the error before",
            |run| {
                let ratio = Some(run.ratio).filter(|ratio| ratio.is_finite())?;
                Some(if ratio >= 1e4 { format!("{ratio:.1e}") } else { format!("{ratio:.3}") })
            },
        ),
    ]
}
