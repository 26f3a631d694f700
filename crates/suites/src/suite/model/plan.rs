//! A suite, and its study of any kind.

use super::ConvergencePlan;
use super::gradient::GradientPlan;
use super::internal_force::ForcePlan;
use super::spectrum::SpectrumPlan;
use super::stability::StabilityPlan;
use std::sync::Arc;

/// A suite, ready to run.
#[derive(Debug, Clone)]
pub struct Suite {
    /// Suite name, unique among all suites.
    pub name: String,
    /// Name of the folder that contains the suite file.
    pub group: String,
    /// Headline of the report.
    pub title: String,
    /// Source of the problem, such as a textbook.
    pub source: String,
    /// The author's remarks for readers.
    pub about: String,
    /// Name and text of every parameter, and its value unless it is a table.
    pub parameters: Vec<(String, String, Option<f64>)>,
    /// Head (such as `s(tau)`) and formula of each declared function.
    pub functions: Vec<(String, String)>,
    /// The study plan.
    pub study: StudyPlan,
    pub(crate) fingerprint: u64,
}

impl Suite {
    /// Returns the case names, in order.
    pub fn case_names(&self) -> Vec<&str> {
        self.study.names()
    }

    /// Returns the suite with only those cases for whose index `keep` returns true.
    #[must_use]
    pub fn only(&self, keep: &dyn Fn(usize) -> bool) -> Self {
        Self { study: self.study.only(keep), ..self.clone() }
    }

    /// Whether the suite has no expectations, so its cases neither pass nor fail.
    pub fn explores(&self) -> bool {
        (0..self.case_names().len()).all(|case| self.study.expectation(case).is_none())
    }

    /// Returns the convergence study; `None` for other kinds of study.
    pub fn convergence(&self) -> Option<&ConvergencePlan> {
        match &self.study {
            StudyPlan::Convergence(plan) => Some(plan),
            _ => None,
        }
    }
}

/// Checked values of a study, by its kind.
#[derive(Debug, Clone)]
pub enum StudyPlan {
    /// Errors on several levels of refinement.
    Convergence(Arc<ConvergencePlan>),
    /// The internal force on a node while a particle moves.
    InternalForce(Arc<ForcePlan>),
    /// Growth of energy in runs.
    Stability(Arc<StabilityPlan>),
    /// Derivatives that a solver reports.
    Gradient(Arc<GradientPlan>),
    /// Phase speed and damping of waves.
    Spectrum(Arc<SpectrumPlan>),
}

macro_rules! with_plan {
    ($study:expr, $plan:ident => $value:expr) => {
        match $study {
            StudyPlan::Convergence($plan) => $value,
            StudyPlan::InternalForce($plan) => $value,
            StudyPlan::Stability($plan) => $value,
            StudyPlan::Gradient($plan) => $value,
            StudyPlan::Spectrum($plan) => $value,
        }
    };
}

impl StudyPlan {
    /// Returns the case names, in order.
    pub fn names(&self) -> Vec<&str> {
        with_plan!(self, plan => plan.cases.iter().map(|case| case.name.as_str()).collect())
    }

    /// Returns summary and reason of the expectation of the case with this index; `None` if the
    /// suite states no expectations.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn expectation(&self, case: usize) -> Option<(String, &str)> {
        with_plan!(self, plan => plan.expectation(case))
    }

    fn only(&self, keep: &dyn Fn(usize) -> bool) -> Self {
        with_plan!(self, plan => {
            let mut plan = plan.as_ref().clone();
            let mut index = 0..;
            plan.cases.retain(|_| index.next().is_some_and(keep));
            plan.into()
        })
    }
}

macro_rules! from_plan {
    ($($kind:ident: $plan:ident,)+) => {
        $(impl From<$plan> for StudyPlan {
            fn from(plan: $plan) -> Self {
                Self::$kind(Arc::new(plan))
            }
        })+
    };
}

from_plan! {
    Convergence: ConvergencePlan,
    InternalForce: ForcePlan,
    Stability: StabilityPlan,
    Gradient: GradientPlan,
    Spectrum: SpectrumPlan,
}
