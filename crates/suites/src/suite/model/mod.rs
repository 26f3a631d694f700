//! Checked and computed values of a suite.

pub(crate) mod external;
pub(crate) mod fingerprint;
pub(crate) mod gradient;
pub(crate) mod internal_force;
pub(crate) mod method;
pub(crate) mod plan;
pub(crate) mod refine_plan;
pub(crate) mod spectrum;
pub(crate) mod stability;

pub(crate) use super::scene::{Scene, SceneFace};
pub use internal_force::{ForceCase, ForceExpectation, ForcePlan};
pub use plan::{StudyPlan, Suite};
pub use refine_plan::SameMethod;

use self::method::{AnyMethod, Method};
use self::refine_plan::{LevelPlan, RefinePlan};
use super::grammar::{CrossingLevels, EquationName, NormName, WarningName};
use super::scene::lattice::LatticeOffsets;
use crate::exact::Problem;
use crate::exact::formula::Formula;
use crate::exact::heat::Conduction;
use crate::fem::{Element, Mass};
use crate::verify::{Clock, Expectation, Gating, JudgedBox, JudgedSum, Quantity, StepKind};
use std::sync::Arc;

/// A convergence study.
#[derive(Debug, Clone)]
pub struct ConvergencePlan {
    /// The body with its conditions and loads.
    pub scene: Scene,
    /// The problem that the formulas solve; `None` if the suite has a reference only.
    pub exact: Option<Problem>,
    /// The heat problem that the stated temperature solves, for a body at rest.
    pub conduction: Option<Conduction>,
    /// A fine FEM computation to compare with.
    pub reference: Option<ReferencePlan>,
    /// A reference run by the same method with a much smaller spacing.
    pub same_method: Option<SameMethod>,
    /// The levels of refinement.
    pub refine: RefinePlan,
    /// Offsets of particles from their lattice.
    pub scatter: LatticeOffsets,
    /// Kind of steps. The length of a load step is one.
    pub steps: StepKind,
    /// Number of instants at which the error is measured.
    pub instants: u64,
    /// Norm of the error.
    pub norm: NormName,
    /// The quantity whose error is measured.
    pub of: Quantity,
    /// The sum over the body whose error is measured, if any, with its exact value.
    pub sum: Option<Arc<JudgedSum>>,
    /// Box to which errors are restricted; `None`: errors over the whole body.
    pub within: Option<JudgedBox>,
    /// Divisor of the error, if any.
    pub scale: Option<f64>,
    /// Formula of the divisor; `None` if the suite states a number or nothing.
    pub scale_formula: Option<String>,
    /// Whether the order may use levels on which particles change their cell.
    pub crossing_levels: CrossingLevels,
    /// Accuracy that any method can reach.
    pub any_method: AnyMethod,
    /// Point (m) whose velocity history and extrapolated displacement are reported.
    pub observe: Option<Vec<f64>>,
    /// The cases, one for each combination of the lists under the key `methods`, in order.
    pub cases: Vec<Case>,
    /// Warnings that the suite acknowledges, in file order.
    pub acknowledged: Vec<WarningName>,
}

/// One case of a convergence study.
#[derive(Debug, Clone)]
pub struct Case {
    /// Case name, unique in the suite.
    pub name: String,
    /// The method.
    pub method: Method,
    /// Name of the external solver; `None` for built-in methods.
    pub solver: Option<String>,
    /// End of the run (s).
    pub until: f64,
    /// The solution with which the case is compared.
    pub against: Against,
    /// Expectation for a usual run; `None` if the suite states no expectations.
    pub expectation: Option<Expectation>,
    /// Expectation for a full run, if different.
    pub expectation_in_full: Option<Expectation>,
    /// Role in `run --gate` (see [`Gating`]) of an external solver without an expectation.
    pub gating: Option<Gating>,
}

/// The solution with which a case is compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Against {
    /// The exact solution, given by formulas.
    Exact,
    /// The fine FEM computation.
    Reference,
    /// A run by the same method with a much smaller spacing.
    SameMethod(SameMethod),
    /// Nothing: only changes of conserved quantities are bounded.
    Nothing,
}

/// A fine FEM computation, used as reference if no formula is known.
#[derive(Debug, Clone)]
pub struct ReferencePlan {
    /// Stress-strain law.
    pub equation: EquationName,
    /// Shape functions.
    pub element: Element,
    /// Mass matrix.
    pub mass: Mass,
    /// Number of elements.
    pub cells: u64,
    /// Requested time step (s), a formula of h.
    pub dt: Formula,
}

impl Against {
    /// Returns a noun phrase for this solution, for use in sentences.
    pub fn words(self) -> &'static str {
        match self {
            Self::Exact => "the exact solution",
            Self::Reference => "the reference",
            Self::SameMethod(same) => same.words(),
            Self::Nothing => "nothing",
        }
    }

    /// Whether the solution is computed, and available only at instants that all runs share.
    pub fn is_computed(self) -> bool {
        matches!(self, Self::Reference | Self::SameMethod(_))
    }

    /// Returns the level of a fine-grid reference run; `None` for other solutions.
    pub fn fine_grid(self) -> Option<LevelPlan> {
        match self {
            Self::SameMethod(SameMethod::FineGrid(level)) => Some(level),
            _ => None,
        }
    }
}

impl ConvergencePlan {
    /// Returns the steps of a run that ends at `until` (s) and is compared with `against`, for a
    /// requested step `dt` (s).
    pub fn clock(&self, against: Against, until: f64, dt: f64) -> Option<Clock> {
        if against.is_computed() && self.steps == StepKind::Time {
            return Clock::with_common_instants(until, dt, self.instants);
        }
        Clock::new(until, dt, self.instants)
    }

    pub(super) fn expectation(&self, case: usize) -> Option<(String, &str)> {
        let case = &self.cases[case];
        case.expected(case.expectation.as_ref())
    }

    /// Returns the problem if its body force is manufactured.
    pub fn manufactured(&self) -> Option<&Problem> {
        self.exact.as_ref().filter(|problem| problem.manufactured)
    }

    /// Whether the exact solution is given by formulas.
    pub fn has_formulas(&self) -> bool {
        self.exact.is_some() || self.conduction.is_some()
    }

    /// Whether there are no formulas, no FEM reference and no fine-grid reference. A reference with
    /// shorter steps reveals only the error of the time step.
    pub(crate) fn is_truthless(&self) -> bool {
        let has_fine_grid = matches!(self.same_method, Some(SameMethod::FineGrid(_)));
        !self.has_formulas() && self.reference.is_none() && !has_fine_grid
    }

    /// Returns the heat problem that the formulas solve, for a body at rest or in motion.
    pub fn heat_problem(&self) -> Option<&Conduction> {
        self.conduction.as_ref().or_else(|| self.exact.as_ref()?.heat.as_ref())
    }
}

impl Case {
    /// Returns the number of load steps; `None` for a run in time.
    pub fn load_steps(&self, plan: &ConvergencePlan) -> Option<u64> {
        (plan.steps == StepKind::Load).then_some(self.until as u64)
    }

    /// Returns the steps of the case, for a requested step `dt` (s).
    pub fn clock(&self, plan: &ConvergencePlan, dt: f64) -> Option<Clock> {
        plan.clock(self.against, self.until, dt)
    }
}
