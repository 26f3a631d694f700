//! A stability study whose suite has passed all checks.

use super::Scene;
use super::method::{ExternalMethod, GateTerms, Method};
use super::refine_plan::LevelPlan;
use crate::suite::scene::lattice::LatticeOffsets;
use crate::suite::yaml::Diagnostic;
use crate::verify::{Gating, RunFigure, Scales, StabilityExpectation};
use std::fmt;
use std::sync::Arc;

/// A study of the growth of energy in runs, for several values of one parameter.
#[derive(Debug, Clone)]
pub struct StabilityPlan {
    pub(crate) setup: CompileSetup,
    /// Name of the swept parameter.
    pub swept: String,
    /// Values of the swept parameter, one for each row of the report.
    pub values: Vec<f64>,
    /// Name of the parameter whose largest stable value is sought, and the limits of the search.
    pub sought: Option<(String, f64, f64)>,
    /// Whether the particles do not move.
    pub frozen: bool,
    /// Measured quantities in the report tables.
    pub figures: Vec<RunFigure>,
    /// The cases, one for each combination of the lists under the key `methods`, in order.
    pub cases: Vec<StabilityCase>,
    /// Requirement of `run --gate` on external solvers, if the suite states one.
    pub any_method: Option<RowExpectations>,
}

/// Expectations for the rows of a case.
#[derive(Debug, Clone, Default)]
pub struct RowExpectations {
    /// Expectation for each row; empty if the suite states no expectations.
    pub expected: Vec<StabilityExpectation>,
    /// Summary of all expectations in one line; `None` if the suite states none.
    pub summary: Option<String>,
    /// The reason for the expectations.
    pub because: String,
}

/// Values that replace those of parameters in the suite, by name.
pub(crate) type ParameterValues<'a> = [(&'a str, f64)];

type SetupFunction = dyn Fn(&ParameterValues<'_>) -> Result<RunSetup, Diagnostic> + Send + Sync;

/// A function from values of parameters to the set-up of a run. Any parameter can be swept.
#[derive(Clone)]
pub(crate) struct CompileSetup(pub(crate) Arc<SetupFunction>);

impl CompileSetup {
    pub(crate) fn with(&self, values: &ParameterValues<'_>) -> Result<RunSetup, Diagnostic> {
        (self.0)(values)
    }
}

impl fmt::Debug for CompileSetup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("CompileSetup")
    }
}

#[derive(Debug, Clone)]
pub(crate) struct RunSetup {
    pub(crate) scene: Scene,
    pub(crate) lattice: LatticeEdits,
    pub(crate) level: LevelPlan,
    /// Step lengths (s), repeated cyclically.
    pub(crate) dt: Vec<f64>,
    /// Share of the stable time step for an automatic `dt`, computed once the particles exist.
    pub(crate) rule: Option<f64>,
    pub(crate) steps: u64,
    pub(crate) full_steps: u64,
    pub(crate) frozen: bool,
    pub(crate) perturb: f64,
    pub(crate) scales: Scales,
}

#[derive(Debug, Clone, Default)]
pub(crate) struct LatticeEdits {
    /// Translation of all particles (m), one number for each axis; empty for none.
    pub(crate) shift: Vec<f64>,
    pub(crate) scatter: LatticeOffsets,
    /// Positions (m) of additional particles, which otherwise equal the first particle.
    pub(crate) extra: Vec<Vec<f64>>,
}

/// One case of a stability study.
#[derive(Debug, Clone)]
pub struct StabilityCase {
    /// Case name, unique in the suite.
    pub name: String,
    /// The method.
    pub method: Method,
    /// Expectations of the suite, or of the gate for an external solver.
    pub expectations: RowExpectations,
    /// Role in `run --gate` (required, exempt or excepted), for an external solver.
    pub gating: Option<Gating>,
}

impl StabilityPlan {
    pub(crate) fn expectation(&self, case: usize) -> Option<(String, &str)> {
        let RowExpectations { summary, because, .. } = &self.cases[case].expectations;
        Some((summary.clone()?, because))
    }

    pub(super) fn under(&self, solver: ExternalMethod<'_>, terms: Option<&GateTerms>) -> Self {
        let ExternalMethod { name, formal_order, precision } = solver;
        let case = StabilityCase {
            name: name.to_owned(),
            method: Method::External { formal_order, precision },
            expectations: terms.and(self.any_method.clone()).unwrap_or_default(),
            gating: terms.and_then(|terms| match (&terms.skip, &self.any_method) {
                (Some(reason), _) => Some(Gating::Excepted(reason.clone())),
                (None, Some(_)) => None,
                (None, None) => {
                    let reason = "a stability study has no order, and the suite states no \
                                  expectation with `any_method`";
                    Some(Gating::NotGated(reason.to_owned()))
                }
            }),
        };
        Self { cases: vec![case], ..self.clone() }
    }
}
