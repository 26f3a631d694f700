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
pub mod embedded;
pub(crate) mod evaluator;
pub(crate) mod grammar;
pub(crate) mod model;
pub mod pattern;
pub(crate) mod scene;
pub mod yaml;

#[cfg(feature = "schemas")]
pub use compile::schema::suite_schema;
pub use grammar::{CrossingLevels, EquationName, NormName, WarningName};
pub use model::gradient::{Differentiated, GradientCase, GradientPlan, SweepPlan};
pub use model::method::{AnyMethod, ExternalMethod, GateTerms, Method};
pub use model::refine_plan::{Extent, LevelPlan, RefinePlan};
pub use model::spectrum::{SpectrumCase, SpectrumPlan, Wave};
pub use model::stability::{StabilityCase, StabilityPlan};
pub use model::{
    Against, Case, ConvergencePlan, ForceCase, ForceExpectation, ForcePlan, ReferencePlan,
    SameMethod, StudyPlan, Suite,
};
pub use scene::{EffectName, Scene, SceneFace, SceneHeat};
