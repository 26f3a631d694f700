//! A convergence study while it is compiled.

use crate::exact::Survey;
use crate::suite::evaluator::{Evaluator, SuitePath};
use crate::suite::grammar::ConvergenceSpec;
use crate::suite::model::{ConvergencePlan, Scene};

/// A convergence study whose scene has been compiled.
pub(crate) struct StudyDraft<'a> {
    pub(crate) evaluator: &'a Evaluator<'a>,
    pub(crate) spec: &'a ConvergenceSpec,
    pub(crate) scene: Scene,
}

/// A convergence study after its scene, exact solution, levels and cases have been compiled.
pub(crate) struct CompiledStudy<'a> {
    pub(crate) evaluator: &'a Evaluator<'a>,
    pub(crate) spec: &'a ConvergenceSpec,
    pub(crate) plan: &'a ConvergencePlan,
    /// Sampled positions and largest terms of the exact motion of a single body.
    pub(crate) survey: Option<Survey>,
    pub(crate) levels: Vec<LevelPaths<'a>>,
}

pub(crate) struct LevelPaths<'a> {
    pub(crate) size: SuitePath<'a>,
    pub(crate) dt: SuitePath<'a>,
}
