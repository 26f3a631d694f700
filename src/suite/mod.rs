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

mod amplitude;
mod bar;
mod bar_limits;
mod binder;
mod bodies;
mod body;
mod cases;
mod checkpoints;
mod comparable;
mod conditions;
mod coordinates;
mod damping;
mod dispatch;
pub mod embedded;
mod energy;
mod equation_text;
mod equilibrium;
mod execute;
mod expansion;
mod expect;
mod extent;
mod filling;
mod fine_steps;
mod fingerprint;
mod force;
mod force_case;
mod force_plan;
mod formal;
mod heat;
mod heat_statement;
mod hold;
mod interval;
mod judged;
mod kept;
mod law;
mod lengths;
mod limits;
mod load;
mod material;
mod meetings;
mod method;
mod methods;
mod model;
mod nature;
mod notes;
mod path;
mod plan;
pub mod pricing;
mod probe;
pub mod profiles;
mod quadrilateral;
mod reference;
mod refine;
mod rest;
mod scene;
mod scene_heat;
mod sets;
mod setup;
mod size;
mod stability;
mod start;
pub mod statement;
mod step_rule;
mod steps;
mod surface;
mod thermal;
mod truth;
mod truthless;
mod viscosity;
mod wording;
mod words;
pub mod yaml;
mod yardstick;

pub use execute::{Progress, Runner};
pub use hold::Hold;
pub use kept::Kept;
pub use method::Method;
pub use model::{
    Against, Case, ConvergencePlan, ForceCase, ForceExpectation, ForcePlan, ReferencePlan, Scene,
    SceneFace, StudyPlan, Suite,
};
pub use plan::{Extent, LevelPlan, RefinePlan};
pub use scene_heat::SceneHeat;
pub use stability::{StabilityCase, StabilityPlan};
pub use words::{CrossingLevels, EquationName, NormName};
