//! Suites: the text of a YAML file, read, checked, and turned into plans of studies.
//!
//! ```text
//! yaml      text -> located values, every diagnostic with file:line:column
//! evaluator values -> numbers and formulas of the parameters of a suite
//! grammar   the keys and values that a file may hold
//! model     checked values: scenes, methods, plans
//! compile   grammar -> model: numbers computed, names resolved, the truth checked
//! ```
//!
//! Each of these imports only those above it.

pub(crate) mod compile;
pub mod embedded;
pub(crate) mod evaluator;
pub(crate) mod grammar;
pub(crate) mod model;
pub mod pattern;
pub mod yaml;

#[cfg(feature = "schemas")]
pub use compile::schema::suite_schema;
pub use grammar::{CrossingLevels, EquationName, NormName, WarningName};
pub use model::external_method::{AnyMethod, ExternalMethod, GateTerms};
pub use model::heat::SceneHeat;
pub use model::load::EffectName;
pub use model::method::Method;
pub use model::refine_plan::{Extent, LevelPlan, RefinePlan};
pub use model::stability::{StabilityCase, StabilityPlan};
pub use model::study_plan::StudyPlan;
pub use model::{
    Against, Case, ConvergencePlan, ForceCase, ForceExpectation, ForcePlan, ReferencePlan,
    SameMethod, Scene, SceneFace, Suite,
};
