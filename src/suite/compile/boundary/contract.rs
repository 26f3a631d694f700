//! The words of a condition on a face, and what they are compiled with.

use crate::exact::formula::Formula;
use crate::suite::evaluator::{Evaluator, coordinates_and_time};
use crate::suite::model::boundary::BoundaryCondition;
use crate::suite::yaml::{Diagnostic, NumberText, Path};
use std::sync::Arc;

/// Words of the condition on a face, as suites write them.
pub(crate) trait BoundaryWords {
    /// The condition, checked, with every number computed.
    ///
    /// # Errors
    /// The first word that is wrong.
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn BoundaryCondition>, Diagnostic>;

    /// Whether the face is one and the same with the opposite one.
    fn is_periodic(&self) -> bool {
        false
    }
}

/// A word that says all is the condition itself.
impl<T: BoundaryCondition + Copy> BoundaryWords for T {
    fn compile(&self, _: &FaceEntry<'_>) -> Result<Arc<dyn BoundaryCondition>, Diagnostic> {
        Ok(Arc::new(*self))
    }

    fn is_periodic(&self) -> bool {
        BoundaryCondition::is_periodic(self)
    }
}

/// Where a condition on a face is compiled: its place in the file, and the dimension of the scene.
pub(crate) struct FaceEntry<'a> {
    pub(crate) evaluator: &'a Evaluator<'a>,
    /// Of its value.
    pub(crate) path: Path,
    /// Number of space dimensions.
    pub(crate) dimension: usize,
}

impl FaceEntry<'_> {
    /// A formula of the coordinates and t, at `path`.
    pub(crate) fn scalar(&self, path: &Path, text: &NumberText) -> Result<Formula, Diagnostic> {
        self.evaluator.formula(path, text, &coordinates_and_time(self.dimension))
    }

    /// One formula of the coordinates and t for each component, at its place.
    pub(crate) fn vector(&self, texts: &[NumberText]) -> Result<Vec<Formula>, Diagnostic> {
        let variables = coordinates_and_time(self.dimension);
        self.evaluator.vector(&self.path, texts, self.dimension, &variables)
    }
}
