//! Suites under a solver that is not of this crate.

use super::external_method::ExternalMethod;
use super::method::Method;
use super::{Against, Case, ConvergencePlan, Suite};
use crate::verify::{Axis, Expectation};

impl Suite {
    /// The same study of one solver that is not of this crate; none of a study that looks inside a
    /// method of this crate. Where a convergence study has cases of this solver, it has these only.
    /// Otherwise it has a case for each of its truths and ends, of which the solver's formal order
    /// in h is expected if this is a `gate`, and nothing if not. A stability study has one case, of
    /// which nothing is expected.
    pub fn of_external(&self, solver: ExternalMethod<'_>, gate: bool) -> Option<Self> {
        let study = self.study.of_external(solver, gate)?;
        Some(Self { study, ..self.clone() })
    }
}

impl ConvergencePlan {
    /// The study of one solver.
    pub(super) fn under(&self, solver: ExternalMethod<'_>, gate: bool) -> Self {
        let mut plan = self.clone();
        let is_stated = |case: &Case| case.solver.as_deref() == Some(solver.name);
        if plan.cases.iter().any(is_stated) {
            plan.cases.retain(is_stated);
        } else {
            plan.cases = unstated(&plan, solver, gate);
        }
        plan
    }
}

/// A case of the solver for each truth and end.
fn unstated(plan: &ConvergencePlan, solver: ExternalMethod<'_>, gate: bool) -> Vec<Case> {
    let ExternalMethod { name, formal_order, precision } = solver;
    let in_space = plan.refine.axis == Axis::Space;
    let expectation = |against: Against| {
        (gate && in_space && against != Against::Nothing)
            .then(|| Expectation::of_order(formal_order, "the solver claims this order"))
    };
    let mut cases: Vec<Case> = Vec::new();
    for case in &plan.cases {
        let known = |other: &Case| (other.until, other.against) == (case.until, case.against);
        let is_its_own_truth = matches!(case.against, Against::SameMethod(_));
        if is_its_own_truth || cases.iter().any(known) {
            continue;
        }
        cases.push(Case {
            name: name.to_owned(),
            method: Method::External { formal_order, precision },
            solver: Some(name.to_owned()),
            expectation: expectation(case.against),
            expectation_in_full: None,
            ..case.clone()
        });
    }
    if cases.len() > 1 {
        for (number, case) in cases.iter_mut().enumerate() {
            case.name = format!("{name}-{}", number + 1);
        }
    }
    cases
}
