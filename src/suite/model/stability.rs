//! A stability study whose keys have all been checked.

use super::method::{ExternalMethod, GateTerms, Method};
use super::{StudyPlan, kept};
use crate::suite::grammar::StabilitySpec;
use crate::suite::scene::lattice::LatticeOffsets;
use crate::suite::yaml::Source;
use crate::verify::{Gating, RunFigure, StabilityExpectation};
use std::sync::Arc;

/// A stability study.
#[derive(Debug, Clone)]
pub struct StabilityPlan {
    /// Template of the set-ups, evaluated for every value of the parameters.
    pub(crate) template: SetupTemplate,
    /// The parameter that is swept.
    pub swept: String,
    /// Its values, one for each row.
    pub values: Vec<f64>,
    /// The parameter whose limit is sought, and the range.
    pub sought: Option<(String, f64, f64)>,
    /// Whether the particles do not move.
    pub frozen: bool,
    /// Figures that tables show.
    pub figures: Vec<RunFigure>,
    /// The cases, in the order of the product.
    pub cases: Vec<StabilityCase>,
}

/// A suite that can be read with other values of its parameters.
#[derive(Debug, Clone)]
pub(crate) struct SetupTemplate {
    pub(crate) source: Source,
    pub(crate) spec: StabilitySpec,
}

/// Changes to the lattice of particles before a run.
#[derive(Debug, Clone, Default)]
pub(crate) struct LatticeEdits {
    /// Translation of all particles (m), one number for each axis; empty: none.
    pub(crate) shift: Vec<f64>,
    /// Offsets from the lattice.
    pub(crate) scatter: LatticeOffsets,
    /// Positions of further particles (m), each like the first particle of the lattice.
    pub(crate) extra: Vec<Vec<f64>>,
}

/// One case of a stability study.
#[derive(Debug, Clone)]
pub struct StabilityCase {
    /// Its name, unique in the suite.
    pub name: String,
    /// The method.
    pub method: Method,
    /// Expectation of each row; empty if the suite explores.
    pub expected: Vec<StabilityExpectation>,
    /// All expectations in one line; `None` if the suite explores.
    pub summary: Option<String>,
    /// The reason for the expectations.
    pub because: String,
    /// Treatment by `run --gate`, of an external solver.
    pub gating: Option<Gating>,
}

impl StudyPlan for StabilityPlan {
    fn case_names(&self) -> Vec<&str> {
        self.cases.iter().map(|case| case.name.as_str()).collect()
    }

    fn expectation(&self, case: usize) -> Option<(String, &str)> {
        let StabilityCase { summary, because, .. } = &self.cases[case];
        Some((summary.clone()?, because))
    }

    fn only(&self, keep: &dyn Fn(usize) -> bool) -> Arc<dyn StudyPlan> {
        Arc::new(Self { cases: kept(&self.cases, keep), ..self.clone() })
    }

    fn of_external(
        &self,
        solver: ExternalMethod<'_>,
        terms: Option<&GateTerms>,
    ) -> Option<Arc<dyn StudyPlan>> {
        let ExternalMethod { name, formal_order, precision } = solver;
        let case = StabilityCase {
            name: name.to_owned(),
            method: Method::External { formal_order, precision },
            expected: Vec::new(),
            summary: None,
            because: String::new(),
            gating: terms.map(|terms| match &terms.skip {
                Some(reason) => Gating::Excepted(reason.clone()),
                None => Gating::NotGated("a stability study has no order".to_owned()),
            }),
        };
        Some(Arc::new(Self { cases: vec![case], ..self.clone() }))
    }
}
