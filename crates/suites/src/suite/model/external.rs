//! Replaces the methods of a suite by an external solver.

use super::method::{ExternalMethod, GateTerms, Method};
use super::plan::{StudyPlan, Suite};
use super::{Against, Case, ConvergencePlan};
use crate::verify::{Axis, CaseFigure, Expectation, Gating, Requirement, format_number};

impl Suite {
    /// Returns the suite with an external solver in place of its methods; `None` if the study
    /// examines the internals of a method. A convergence study keeps the cases stated for this
    /// solver. If there are none, the solver gets one case for each combination of end time and
    /// reference solution. With `terms`, each case without an expectation must reach an order or an
    /// error bound.
    pub fn of_external(
        &self,
        solver: ExternalMethod<'_>,
        terms: Option<&GateTerms>,
    ) -> Option<Self> {
        let study = match &self.study {
            StudyPlan::Convergence(plan) => plan.under(solver, terms).into(),
            StudyPlan::InternalForce(_) => return None,
            StudyPlan::Stability(plan) => plan.under(solver, terms).into(),
            StudyPlan::Gradient(plan) => plan.under(solver, terms).into(),
            StudyPlan::Spectrum(plan) => plan.under(solver, terms).into(),
        };
        Some(Self { study, ..self.clone() })
    }

    /// Returns the convergence study without expectations; `None` for another kind of study.
    pub fn without_expectations(&self) -> Option<Self> {
        let mut plan = self.convergence()?.clone();
        for case in &mut plan.cases {
            (case.expectation, case.expectation_in_full) = (None, None);
        }
        Some(Self { study: plan.into(), ..self.clone() })
    }
}

impl ConvergencePlan {
    pub(super) fn under(&self, solver: ExternalMethod<'_>, terms: Option<&GateTerms>) -> Self {
        let mut plan = self.clone();
        let is_stated = |case: &Case| case.solver.as_deref() == Some(solver.name);
        if plan.cases.iter().any(is_stated) {
            plan.cases.retain(is_stated);
        } else {
            plan.cases = unstated(&plan, solver);
            // A reference is preferred: formulas may solve a simplified equation.
            let has_reference = plan.cases.iter().any(|case| case.against == Against::Reference);
            if has_reference && terms.is_some() {
                plan.cases.retain(|case| case.against != Against::Exact);
            }
        }
        if let Some(terms) = terms {
            for case in &mut plan.cases {
                self.gate(case, solver, terms);
            }
        }
        plan
    }

    /// Sets the requirements of `run --gate` on a case. An expectation of the suite remains, unless
    /// `terms` replace it.
    fn gate(&self, case: &mut Case, solver: ExternalMethod<'_>, terms: &GateTerms) {
        let has_terms = terms.order.is_some() || terms.error_below.is_some();
        if case.expectation.is_some() && terms.skip.is_none() && !has_terms {
            return;
        }
        let formal_order = terms.formal_order.unwrap_or_else(|| match case.method {
            // The order that the suite states for this solver may be lower.
            Method::External { formal_order, .. } => formal_order.min(solver.formal_order),
            _ => solver.formal_order,
        });
        let gating = self.gating(case.against, formal_order, terms);
        if let (
            Gating::Required(Requirement { order: Some(order), .. }),
            Method::External { precision, .. },
        ) = (&gating, case.method)
        {
            case.method = Method::External { formal_order: *order, precision };
        }
        (case.expectation, case.expectation_in_full) = (None, None);
        case.gating = Some(gating);
    }

    fn gating(&self, against: Against, formal_order: f64, terms: &GateTerms) -> Gating {
        if let Some(reason) = &terms.skip {
            return Gating::Excepted(reason.clone());
        }
        if against == Against::Nothing {
            return Gating::NotGated("the suite states no solution to compare with".to_owned());
        }
        if !self.any_method.gated && terms.order.is_none() && terms.error_below.is_none() {
            return Gating::NotGated(self.any_method.because.clone());
        }
        let stated = terms.order.map(|order| (order, terms.because.clone()));
        let order = stated.or_else(|| self.required_order(formal_order));
        let error_below = terms.error_below.or(self.any_method.error_below);
        let own_error_below = if error_below.is_none() { self.smallest_own_bound() } else { None };
        let because = match order {
            _ if terms.order.is_some() || terms.error_below.is_some() => terms.because.clone(),
            Some((_, ref reason)) => reason.clone(),
            None if !self.any_method.because.is_empty() => self.any_method.because.clone(),
            None => "the suite bounds the errors of its own methods".to_owned(),
        };
        match order.map(|(order, _)| order) {
            None if error_below.is_none() && own_error_below.is_none() => {
                Gating::NotGated(format!(
                    "the suite refines {}, but the solver states its order in space only",
                    self.refine.axis.name()
                ))
            }
            order => Gating::Required(Requirement { order, error_below, own_error_below, because }),
        }
    }

    /// Returns the required order and its reason; `None` if no order on the refined axis is known.
    fn required_order(&self, formal_order: f64) -> Option<(f64, String)> {
        let is_gradient = self.of.is_stress() || self.of.needs_deformation_gradient();
        let (of_solver, reason) = if is_gradient && formal_order > 1.0 {
            let of = format_number(formal_order);
            let reason = format!("displacements have the order {of}, and their gradients one less");
            (formal_order - 1.0, reason)
        } else {
            let of = format_number(formal_order);
            (formal_order, format!("the solver has the formal order {of}"))
        };
        let in_space = self.refine.axis == Axis::Space;
        match self.any_method.order {
            Some(limit) if !in_space || limit < of_solver => {
                Some((limit, self.any_method.because.clone()))
            }
            _ => in_space.then_some((of_solver, reason)),
        }
    }

    /// Returns the smallest `error_below` of the suite's own methods; `None` if a verdict is
    /// expected. Entries with `error_above` describe methods that fail.
    fn smallest_own_bound(&self) -> Option<f64> {
        let expectations = || self.cases.iter().filter_map(|case| case.expectation.as_ref());
        let bound = |expectation: &Expectation| {
            let limits = &expectation.limits;
            let above = limits.bound(CaseFigure::ErrorAbove);
            limits.bound(CaseFigure::ErrorBelow).filter(|_| above.is_none())
        };
        let is_bound_only = |expectation: &Expectation| expectation.verdict.is_none();
        if !expectations().all(is_bound_only) {
            return None;
        }
        expectations().filter_map(bound).reduce(f64::min)
    }
}

impl Case {
    /// Returns summary and reason of an `expectation`, or else of the requirement of `run --gate`.
    pub(crate) fn expected<'a>(
        &'a self,
        expectation: Option<&'a Expectation>,
    ) -> Option<(String, &'a str)> {
        match (expectation, &self.gating) {
            (Some(expectation), _) => Some((expectation.summary(), &expectation.because)),
            (None, Some(Gating::Required(required))) => {
                Some((required.summary(), &required.because))
            }
            _ => None,
        }
    }
}

/// Returns one case of the solver for each combination of end time and reference solution.
fn unstated(plan: &ConvergencePlan, solver: ExternalMethod<'_>) -> Vec<Case> {
    let ExternalMethod { name, formal_order, precision } = solver;
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
            expectation: None,
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
