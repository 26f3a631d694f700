//! The words: what a YAML file says, checked, and turned into cases that can run.
//!
//! ```text
//! yaml      the front door: text -> words, every complaint with file:line:column
//! words     the grammar of a suite
//! load      words -> Suite: numbers computed, names resolved, the truth checked
//! cases     the product of the lists, with what is expected of each case
//! dispatch  names become types: the only place that mentions every family
//! execute   every level of every case, judged -> SuiteOutcome
//! ```

pub(crate) mod compile;
pub mod embedded;
pub(crate) mod grammar;
pub(crate) mod model;
pub mod yaml;

pub use compile::load::EffectName;
pub use grammar::{CrossingLevels, EquationName, NormName};
pub use model::heat::SceneHeat;
pub use model::method::Method;
pub use model::refine_plan::{Extent, LevelPlan, RefinePlan};
pub use model::stability::{StabilityCase, StabilityPlan};
pub use model::study_plan::StudyPlan;
pub use model::{
    Against, BoundaryCondition, Case, ConvergencePlan, ForceCase, ForceExpectation, ForcePlan,
    ReferencePlan, Scene, SceneFace, Suite,
};
