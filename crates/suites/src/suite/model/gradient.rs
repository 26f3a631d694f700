//! A gradient study whose suite has passed all checks.

use super::method::{ExternalMethod, GateTerms, Method};
use super::{Case, ConvergencePlan};
use crate::exact::ParametricMotion;
use crate::subject::{Functional, GradientParameter};
use crate::verify::{Gating, GradientTerms};

/// A study of the derivatives that a differentiable solver reports.
#[derive(Debug, Clone)]
pub struct GradientPlan {
    /// The problem and its levels, with one case.
    pub problem: ConvergencePlan,
    /// The functional.
    pub of: Functional,
    /// The parameters, in file order.
    pub parameters: Vec<Differentiated>,
    /// Index of the level whose parameters are perturbed.
    pub level: usize,
    /// Interval of one parameter for a sweep, if any.
    pub sweep: Option<SweepPlan>,
    /// The cases.
    pub cases: Vec<GradientCase>,
}

/// A parameter for which the study verifies the derivative.
#[derive(Debug, Clone)]
pub struct Differentiated {
    /// The problem parameter.
    pub parameter: GradientParameter,
    /// Name of the suite parameter that sets the problem parameter.
    pub name: String,
    /// The exact motion as a function of the suite parameter.
    pub motion: ParametricMotion,
    /// Factor c in `dv/dq = c v`, where v is the initial velocity and q the suite parameter; 0 if v
    /// does not depend on q.
    pub velocity_factor: f64,
}

/// An interval of one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepPlan {
    /// The parameter to vary.
    pub parameter: GradientParameter,
    /// Half the length of the interval, relative to the value of the parameter.
    pub within: f64,
    /// Number of points.
    pub points: u64,
}

/// One case: the derivative with respect to one parameter, computed by one solver.
#[derive(Debug, Clone)]
pub struct GradientCase {
    /// Case name, composed of solver and parameter.
    pub name: String,
    /// The solver, with its formal order and precision.
    pub solver: Case,
    /// Index of the parameter in [`GradientPlan::parameters`].
    pub parameter: usize,
    /// Expectation and its reason; `None` if the suite states no expectations.
    pub expected: Option<(GradientTerms, String)>,
    /// Role in `run --gate` (required, exempt or excepted), for a solver without an expectation.
    pub gating: Option<Gating>,
}

impl GradientPlan {
    /// Returns one case for each parameter; the solver is called `name` in case names.
    pub(crate) fn cases_of(&self, name: &str, solver: &Case) -> Vec<GradientCase> {
        let case = |(parameter, one): (usize, &Differentiated)| GradientCase {
            name: format!("{name}-{}", one.parameter.name().replace('_', "-")),
            solver: solver.clone(),
            parameter,
            expected: None,
            gating: None,
        };
        self.parameters.iter().enumerate().map(case).collect()
    }

    pub(crate) fn expectation(&self, case: usize) -> Option<(String, &str)> {
        let (terms, because) = self.cases[case].expected.as_ref()?;
        Some((terms.summary(), because))
    }

    pub(super) fn under(&self, solver: ExternalMethod<'_>, terms: Option<&GateTerms>) -> Self {
        let ExternalMethod { name, formal_order, precision } = solver;
        let mut plan = self.clone();
        let is_stated = |case: &GradientCase| case.solver.solver.as_deref() == Some(name);
        if plan.cases.iter().any(is_stated) {
            plan.cases.retain(is_stated);
        } else {
            let method = Method::External { formal_order, precision };
            let own = |own: &Case| Case { method, solver: Some(name.to_owned()), ..own.clone() };
            let solver = self.problem.cases.first().map(own);
            plan.cases = solver.map_or(Vec::new(), |solver| self.cases_of(name, &solver));
        }
        for case in plan.cases.iter_mut().filter(|case| case.expected.is_none()) {
            let Some(terms) = terms else { continue };
            if let Some(reason) = &terms.skip {
                case.gating = Some(Gating::Excepted(reason.clone()));
                continue;
            }
            let order = terms.order.or(terms.formal_order).unwrap_or(formal_order);
            let because = if terms.because.is_empty() {
                "the derivative of an accurate state has the order of the state".to_owned()
            } else {
                terms.because.clone()
            };
            case.expected = Some((GradientTerms::of_gate(order), because));
        }
        plan
    }
}
