//! Suites: parses and checks YAML files, and converts them to study plans.
//!
//! ```text
//! yaml      text -> values with positions; every diagnostic has file:line:column
//! evaluator values -> numbers and formulas of the suite's parameters
//! scene     the body, its loads and boundary conditions, each with its keys
//! grammar   the keys and values that a file may contain
//! model     checked values: methods, plans
//! compile   grammar -> model: computes numbers, resolves names, checks the exact solution
//! ```
//!
//! Each module imports only modules listed above it.

pub(crate) mod compile;
pub(crate) mod evaluator;
pub(crate) mod grammar;
pub(crate) mod model;
pub mod pattern;
pub(crate) mod scene;
pub(crate) mod violation;
pub mod yaml;

#[cfg(feature = "schemas")]
pub use compile::schema::suite_schema;
pub use model::method::{ExternalMethod, GateTerms, Method};
pub use model::refine_plan::{Extent, RefinePlan};
pub use model::spectrum::Wave;
pub use model::stability::StabilityPlan;
pub use model::{Against, Case, ConvergencePlan, StudyPlan, Suite};
pub use scene::Scene;

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{
    grammar::{CrossingLevels, EquationName, NormName, WarningName},
    model::gradient::{Differentiated, GradientCase, GradientPlan, SweepPlan},
    model::method::AnyMethod,
    model::refine_plan::LevelPlan,
    model::spectrum::{SpectrumCase, SpectrumPlan},
    model::stability::StabilityCase,
    model::{ForceCase, ForceExpectation, ForcePlan, ReferencePlan, SameMethod},
    scene::{EffectName, SceneFace, SceneHeat},
    violation::{meaning, next_command, violations},
};
