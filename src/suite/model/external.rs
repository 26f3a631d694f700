//! Suites under a solver that is not of this crate.

use super::method::Method;
use super::{Against, Case, ConvergencePlan, Suite};
use crate::verify::{Axis, Expectation};
use std::sync::Arc;

impl Suite {
    /// The same convergence study of one solver that is not of this crate: a case for each truth
    /// and end that the suite has, of which its formal order in h is expected if this is a `gate`,
    /// and nothing otherwise. None of another kind of study.
    pub fn of_external(&self, name: &str, formal_order: f64, gate: bool) -> Option<Self> {
        let mut plan = self.plan::<ConvergencePlan>()?.clone();
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
                method: Method::External { formal_order },
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
        plan.cases = cases;
        Some(Self { study: Arc::new(plan), ..self.clone() })
    }
}
