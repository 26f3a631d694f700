//! A suite whose keys have all been checked and whose numbers have all been computed.

pub(crate) mod external;
pub(crate) mod fingerprint;
pub(crate) mod gradient;
pub(crate) mod internal_force;
pub(crate) mod method;
pub(crate) mod refine_plan;
pub(crate) mod spectrum;
pub(crate) mod stability;

pub(crate) use super::scene::{Scene, SceneFace};
pub use internal_force::{ForceCase, ForceExpectation, ForcePlan};
pub use refine_plan::SameMethod;

use self::method::{AnyMethod, ExternalMethod, GateTerms, Method};
use self::refine_plan::{LevelPlan, RefinePlan};
use super::grammar::{CrossingLevels, EquationName, NormName, WarningName};
use super::scene::lattice::LatticeOffsets;
use crate::exact::Problem;
use crate::exact::formula::Formula;
use crate::exact::heat::Conduction;
use crate::fem::{Element, Mass};
use crate::verify::{Clock, Expectation, Gating, JudgedBox, JudgedSum, Quantity, StepKind};
use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

/// A suite, ready to run.
#[derive(Debug, Clone)]
pub struct Suite {
    /// Its name, unique among suites.
    pub name: String,
    /// Name of the folder that its file is in.
    pub group: String,
    /// Headline.
    pub title: String,
    /// Reference for the problem.
    pub source: String,
    /// Remarks of the author for a reader.
    pub about: String,
    /// Every parameter: name, text, and its value unless it is a table.
    pub parameters: Vec<(String, String, Option<f64>)>,
    /// User functions: head and body.
    pub functions: Vec<(String, String)>,
    /// Plan of its study.
    pub study: Arc<dyn StudyPlan>,
    /// Fingerprint of the text of the file.
    pub(crate) fingerprint: u64,
}

/// A convergence study without its methods.
#[derive(Debug, Clone)]
pub struct ConvergencePlan {
    /// The body with its conditions and loads.
    pub scene: Scene,
    /// The problem that the formulas solve, already checked; `None` if there is only a reference.
    pub exact: Option<Problem>,
    /// The heat problem that a temperature solves in a body at rest, already checked.
    pub conduction: Option<Conduction>,
    /// A fine computation to compare with.
    pub reference: Option<ReferencePlan>,
    /// A reference run by the same method with a much shorter spacing.
    pub same_method: Option<SameMethod>,
    /// The levels of refinement.
    pub refine: RefinePlan,
    /// Offsets of particles from their lattice.
    pub scatter: LatticeOffsets,
    /// Kind of the steps. A load step takes one unit of time, so that a run of N load steps ends at
    /// time N.
    pub steps: StepKind,
    /// Instants at which the error is measured.
    pub instants: u64,
    /// The judged error.
    pub norm: NormName,
    /// Quantity whose error is measured.
    pub of: Quantity,
    /// The judged sum with its exact value, if the judged quantity is a sum over the body.
    pub sum: Option<Arc<JudgedSum>>,
    /// Box to which errors are restricted; `None`: errors over the whole body.
    pub within: Option<JudgedBox>,
    /// Scale by which the error is divided, if any.
    pub scale: Option<f64>,
    /// Whether levels with crossings may count.
    pub crossing_levels: CrossingLevels,
    /// Accuracy that any method can reach.
    pub any_method: AnyMethod,
    /// Point to be observed (m).
    pub observe: Option<Vec<f64>>,
    /// The cases, in the order of the product.
    pub cases: Vec<Case>,
    /// Warnings that the suite intends, in the order of the file.
    pub acknowledged: Vec<WarningName>,
}

/// One case of a convergence study.
#[derive(Debug, Clone)]
pub struct Case {
    /// Its name, unique in the suite.
    pub name: String,
    /// The method.
    pub method: Method,
    /// Name of the external solver; `None` for built-in methods.
    pub solver: Option<String>,
    /// End of the run (s).
    pub until: f64,
    /// Solution against which errors are measured.
    pub against: Against,
    /// Expectation on a usual run; `None` if the suite explores.
    pub expectation: Option<Expectation>,
    /// Expectation on a full run, if that differs.
    pub expectation_in_full: Option<Expectation>,
    /// Treatment by `run --gate`, of an external solver without an expectation.
    pub gating: Option<Gating>,
}

/// Kind of truth with which a case is compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Against {
    /// The formulas.
    Exact,
    /// The fine computation.
    Reference,
    /// A run by the same method with a much shorter spacing.
    SameMethod(SameMethod),
    /// No truth: only drifts of conserved quantities have bounds.
    Nothing,
}

/// A fine FEM computation as reference, if no formula is known.
#[derive(Debug, Clone)]
pub struct ReferencePlan {
    /// Law between stress and strain.
    pub equation: EquationName,
    /// Shape functions.
    pub element: Element,
    /// Mass matrix.
    pub mass: Mass,
    /// Elements.
    pub cells: u64,
    /// Wanted time step (s), a formula of h.
    pub dt: Formula,
}

impl Against {
    /// Phrase for this reference in a sentence.
    pub fn words(self) -> &'static str {
        match self {
            Self::Exact => "the exact solution",
            Self::Reference => "the reference",
            Self::SameMethod(same) => same.words(),
            Self::Nothing => "nothing",
        }
    }

    /// Whether it is computed, and available only at instants that all runs share.
    pub fn is_computed(self) -> bool {
        matches!(self, Self::Reference | Self::SameMethod(_))
    }

    /// The level of a reference run on a fine grid; `None` for other references.
    pub fn fine_grid(self) -> Option<LevelPlan> {
        match self {
            Self::SameMethod(SameMethod::FineGrid(level)) => Some(level),
            _ => None,
        }
    }
}

impl ConvergencePlan {
    /// The steps of a run until `until` (s) that is compared with `against`, for a requested step
    /// `dt` (s).
    pub fn clock(&self, against: Against, until: f64, dt: f64) -> Option<Clock> {
        if against.is_computed() && self.steps == StepKind::Time {
            return Clock::with_common_instants(until, dt, self.instants);
        }
        Clock::new(until, dt, self.instants)
    }
}

impl Case {
    /// Number of load steps; `None` for a run in time.
    pub fn load_steps(&self, plan: &ConvergencePlan) -> Option<u64> {
        (plan.steps == StepKind::Load).then_some(self.until as u64)
    }

    /// The steps of a run, for a requested step `dt` (s).
    pub fn clock(&self, plan: &ConvergencePlan, dt: f64) -> Option<Clock> {
        plan.clock(self.against, self.until, dt)
    }
}

impl Suite {
    /// Names of the cases, in order.
    pub fn case_names(&self) -> Vec<&str> {
        self.study.case_names()
    }

    /// The suite with only the cases for whose index `keep` returns true.
    #[must_use]
    pub fn only(&self, keep: &dyn Fn(usize) -> bool) -> Self {
        Self { study: self.study.only(keep), ..self.clone() }
    }

    /// Whether the suite has no expectations, so that it is not a gate.
    pub fn explores(&self) -> bool {
        (0..self.case_names().len()).all(|case| self.study.expectation(case).is_none())
    }

    /// The plan, if the study is of this kind.
    pub fn plan<P: StudyPlan>(&self) -> Option<&P> {
        let plan: &dyn Any = self.study.as_ref();
        plan.downcast_ref()
    }
}

impl StudyPlan for ConvergencePlan {
    fn case_names(&self) -> Vec<&str> {
        self.cases.iter().map(|case| case.name.as_str()).collect()
    }

    fn expectation(&self, case: usize) -> Option<(String, &str)> {
        self.cases[case].expected()
    }

    fn only(&self, keep: &dyn Fn(usize) -> bool) -> Arc<dyn StudyPlan> {
        Arc::new(Self { cases: kept(&self.cases, keep), ..self.clone() })
    }

    fn of_external(
        &self,
        solver: ExternalMethod<'_>,
        terms: Option<&GateTerms>,
    ) -> Option<Arc<dyn StudyPlan>> {
        Some(Arc::new(self.under(solver, terms)))
    }
}

impl ConvergencePlan {
    /// The problem with a manufactured force; `None` without one.
    pub fn manufactured(&self) -> Option<&Problem> {
        self.exact.as_ref().filter(|problem| problem.manufactured)
    }

    /// Whether the exact solution is given by formulas.
    pub fn has_formulas(&self) -> bool {
        self.exact.is_some() || self.conduction.is_some()
    }

    /// The heat problem that the formulas solve, of a body at rest or in motion.
    pub fn heat_problem(&self) -> Option<&Conduction> {
        self.conduction.as_ref().or_else(|| self.exact.as_ref()?.heat.as_ref())
    }
}

/// Checked values of one kind of study.
pub trait StudyPlan: Any + Debug + Send + Sync {
    /// Names of the cases, in order.
    fn case_names(&self) -> Vec<&str>;

    /// Summary of the expectation of the case with this index, and its reason; `None` if the suite
    /// explores.
    ///
    /// # Panics
    /// If there is no such case.
    fn expectation(&self, case: usize) -> Option<(String, &str)>;

    /// This study with only the cases for whose index `keep` returns true.
    fn only(&self, keep: &dyn Fn(usize) -> bool) -> Arc<dyn StudyPlan>;

    /// The study with an external solver in place of its methods, gated on `terms`, if any; `None`
    /// for a study of the inside of a method.
    fn of_external(
        &self,
        _solver: ExternalMethod<'_>,
        _terms: Option<&GateTerms>,
    ) -> Option<Arc<dyn StudyPlan>> {
        None
    }
}

/// The members of a list for whose index `keep` returns true.
pub(super) fn kept<T: Clone>(all: &[T], keep: &dyn Fn(usize) -> bool) -> Vec<T> {
    let kept = all.iter().enumerate().filter(|(i, _)| keep(*i));
    kept.map(|(_, member)| member.clone()).collect()
}
