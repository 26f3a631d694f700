//! `run --gate` and `--solver-config`: the requirements on a solver, and whether it meets them.

use super::args::GateArgs;
use crate::cli::{output, select, solver};
use mpm_verify::external::SolverFactory;
use mpm_verify::nearest;
use mpm_verify::suite::yaml::{Diagnostic, Ordered, Source, Step, read};
use mpm_verify::suite::{GateTerms, Suite, pattern};
use mpm_verify::verify::{CaseOutcome, Exemption, SuiteOutcome};
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::Path;

/// An external solver, with the gate (set of requirements) that it must pass.
pub(super) struct JudgedSolver {
    pub(super) solver: Box<dyn SolverFactory>,
    pub(super) gate: Option<SolverGate>,
}

pub(super) struct SolverGate {
    named: BTreeSet<String>,
    /// Whether the gate may pass although named suites are not applicable to the solver.
    allows_not_applicable: bool,
    /// Names of suites that external solvers cannot run.
    left_out: Vec<String>,
}

/// Replaces the methods of the suites by the solver. Also returns the gate, if requested.
pub(super) fn prepare(
    suites: Vec<Suite>,
    solver: &dyn SolverFactory,
    args: &GateArgs,
    named: &BTreeSet<String>,
) -> Result<(Vec<Suite>, Option<SolverGate>), Diagnostic> {
    let config = args.solver_config.as_deref().map(|file| SolverConfig::read(file, &suites));
    let config = config.transpose()?.unwrap_or_default();
    let terms = |suite: &Suite| args.gate.then(|| config.terms(suite));
    let (judged, left_out) = solver::suites_of_solver(suites, solver, terms);
    let allows_not_applicable = args.allow_not_applicable;
    let gate =
        args.gate.then(|| SolverGate { named: named.clone(), allows_not_applicable, left_out });
    Ok((judged, gate))
}

impl SolverGate {
    /// Returns the suites whose cases must all be tested for the gate to pass.
    pub(super) fn required(&self) -> BTreeSet<String> {
        if self.allows_not_applicable { BTreeSet::new() } else { self.named.clone() }
    }

    /// Prints the skipped suites. Prints an error and returns false if no case is tested, or if a
    /// required suite is not tested. Failed cases are not checked here.
    pub(super) fn passes(&self, outcomes: &[SuiteOutcome]) -> bool {
        let is_excepted = |case: &CaseOutcome| case.exemption == Some(Exemption::Excepted);
        for (suite, case) in cases(outcomes).filter(|(_, case)| is_excepted(case)) {
            output::complain(&format!("note: {suite} is skipped: {}", case.reason));
        }
        if !cases(outcomes).any(|(_, case)| case.is_tested() || is_excepted(case)) {
            output::complain("error: --gate: no case has a requirement for the solver");
            return false;
        }
        let untested = cases(outcomes).filter(|(_, case)| {
            !case.lacks.is_empty() || case.exemption == Some(Exemption::NotGated)
        });
        let untested = untested.map(|(suite, _)| suite);
        let untested = untested.chain(self.left_out.iter().map(String::as_str));
        let untested: BTreeSet<&str> =
            untested.filter(|suite| self.named.contains(*suite)).collect();
        if untested.is_empty() || self.allows_not_applicable {
            return true;
        }
        output::complain(&format!(
            "error: --gate: not applicable or explored: {}; `--allow-not-applicable` accepts this",
            Vec::from_iter(untested).join(", ")
        ));
        false
    }
}

fn cases(outcomes: &[SuiteOutcome]) -> impl Iterator<Item = (&str, &CaseOutcome)> {
    outcomes.iter().flat_map(|suite| suite.cases.iter().map(|case| (suite.suite.as_str(), case)))
}

/// Maximum order that the configuration may state.
const HIGHEST_ORDER: f64 = 20.0;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct ConfigSpec {
    /// Formal order of the solver in h.
    formal_order: Option<f64>,
    /// Requirements by suite name, group or pattern.
    #[serde(default)]
    suites: Ordered<TermsSpec>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct TermsSpec {
    order: Option<f64>,
    /// Errors at or below this bound are accepted for any observed order.
    error_below: Option<f64>,
    skip: Option<String>,
    /// Reason for `order` and `error_below`.
    because: Option<String>,
}

#[derive(Debug, Default)]
struct SolverConfig {
    formal_order: Option<f64>,
    /// Requirements, with the suite name, group or pattern that they apply to.
    suites: Vec<(String, GateTerms)>,
}

impl SolverConfig {
    fn read(file: &Path, suites: &[Suite]) -> Result<Self, Diagnostic> {
        let source = Source::read(file)?;
        let spec: ConfigSpec = read(&source)?;
        if let Some(order) = spec.formal_order {
            check_order(&source, &["formal_order".into()], order)?;
        }
        let known = known_names(suites);
        let mut checked = Vec::new();
        for (name, terms) in spec.suites.as_slice() {
            if !known.iter().any(|known| pattern::fits(name, known)) {
                return Err(unknown_suite(&source, name, &known));
            }
            checked.push((name.clone(), terms.checked(&source, name)?));
        }
        Ok(Self { formal_order: spec.formal_order, suites: checked })
    }

    /// Returns the requirements of the first entry that matches the name or group of a suite.
    fn terms(&self, suite: &Suite) -> GateTerms {
        let in_group = format!("{}/{}", suite.group, suite.name);
        let names = [&suite.name, &suite.group, &in_group];
        let fits = |glob: &str| names.iter().any(|name| pattern::fits(glob, name));
        let entry = self.suites.iter().find(|(glob, _)| fits(glob));
        let terms = entry.map_or_else(GateTerms::default, |(_, terms)| terms.clone());
        GateTerms { formal_order: self.formal_order, ..terms }
    }
}

impl TermsSpec {
    fn checked(&self, source: &Source, suite: &str) -> Result<GateTerms, Diagnostic> {
        let entry = || -> Vec<Step> { vec!["suites".into(), suite.into()] };
        let at = |key: &str| -> Vec<Step> {
            let mut path = entry();
            path.push(key.into());
            path
        };
        let Self { order, error_below, skip, because } = self;
        if let Some(order) = *order {
            check_order(source, &at("order"), order)?;
        }
        if let Some(bound) = *error_below
            && !(bound > 0.0 && bound.is_finite())
        {
            let message = format!("the bound on errors is {bound}");
            let diagnostic = source.diagnostic_at(&at("error_below"), &message);
            return Err(diagnostic.with_label("expected a positive number"));
        }
        let bounds = order.is_some() || error_below.is_some();
        let about_entry = |message: &str, help: &str| {
            let place = source.key_at(&entry());
            let diagnostic = match place {
                Some(place) => source.diagnostic(place, message),
                None => source.diagnostic_at(&entry(), message),
            };
            Err(diagnostic.with_help(help))
        };
        match (bounds, skip, because) {
            (true, Some(_), _) => {
                about_entry("a skipped suite cannot have an order or a bound", "remove `skip`")
            }
            (false, None, _) => about_entry(
                "this entry states no order, no bound and no reason to skip the suite",
                "add `order: 1`, `error_below: 1e-6` or `skip: the reason`",
            ),
            (true, None, None) => {
                about_entry("an order or a bound needs a reason", "add `because: the reason`")
            }
            (false, Some(_), Some(_)) => {
                about_entry("`skip` already states the reason", "remove `because`")
            }
            (_, Some(text), _) | (_, None, Some(text)) if text.trim().is_empty() => {
                let key = if skip.is_some() { "skip" } else { "because" };
                let diagnostic = source.diagnostic_at(&at(key), "the reason is empty");
                Err(diagnostic.with_label("expected a text"))
            }
            _ => Ok(GateTerms {
                formal_order: None,
                order: *order,
                error_below: *error_below,
                skip: skip.as_deref().map(|text| text.trim().to_owned()),
                because: because.as_deref().unwrap_or_default().trim().to_owned(),
            }),
        }
    }
}

fn check_order(source: &Source, path: &[Step], order: f64) -> Result<(), Diagnostic> {
    if order > 0.0 && order <= HIGHEST_ORDER {
        return Ok(());
    }
    let diagnostic = source.diagnostic_at(path, &format!("the order is {order}"));
    Err(diagnostic.with_label(&format!("expected a number above 0 and up to {HIGHEST_ORDER}")))
}

fn known_names(suites: &[Suite]) -> Vec<String> {
    let mut known = select::suite_names();
    for suite in suites {
        let in_group = format!("{}/{}", suite.group, suite.name);
        known.extend([suite.name.clone(), suite.group.clone(), in_group]);
    }
    known
}

fn unknown_suite(source: &Source, name: &str, known: &[String]) -> Diagnostic {
    let message = format!("no suite has the name `{name}`");
    let diagnostic = match source.key_at(&["suites".into(), name.into()]) {
        Some(place) => source.diagnostic(place, &message),
        None => Diagnostic::about(source.name(), &message),
    };
    let near = nearest(name, known.iter().map(String::as_str));
    let help = near.map_or_else(
        || "`mpm-verify list` shows the suites; `*` stands for any text".to_owned(),
        |near| format!("did you mean `{near}`?"),
    );
    diagnostic.with_help(&help)
}
