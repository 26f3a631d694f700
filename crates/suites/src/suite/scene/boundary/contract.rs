//! Boundary conditions on the faces of a body: their keys, and the compiled condition.

use crate::exact::Condition;
use crate::mpm::input::WallCondition;
use crate::suite::evaluator::SuitePath;
use crate::suite::scene::numbers::LoadNumbers;
use crate::suite::yaml::Diagnostic;
use std::sync::Arc;

pub(crate) trait BoundaryKeys {
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn BoundaryCondition>, Diagnostic>;
}

/// A condition without parameters is also the type of its keys.
impl<T: BoundaryCondition + Copy> BoundaryKeys for T {
    fn compile(&self, _: &FaceEntry<'_>) -> Result<Arc<dyn BoundaryCondition>, Diagnostic> {
        Ok(Arc::new(*self))
    }
}

/// Context for compiling a boundary condition: its path in the file, and the scene's dimension.
pub(crate) struct FaceEntry<'a> {
    pub(crate) path: SuitePath<'a>,
    pub(crate) dimension: usize,
}

/// How a boundary condition lets a face move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FaceMotion {
    /// The face is free and may carry a traction.
    Free,
    /// The face coincides with the opposite face.
    Periodic,
    /// The face has a prescribed velocity.
    Driven,
    /// The face may leave the grid face.
    MayLeave,
    /// The body face always stays on the grid face.
    Stays { holds_all_components: bool },
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceKind {
    pub(crate) name: &'static str,
    /// The verb phrase that follows "the left face" in messages.
    pub(crate) verb: &'static str,
    pub(crate) motion: FaceMotion,
    /// Priority at nodes that several faces share: the condition with the largest number applies.
    pub(crate) strength: u8,
    /// Whether the FEM of this crate lacks the condition.
    pub(crate) is_lacked_by_fem: bool,
    /// The reason why the condition excludes several bodies; `None` if it does not.
    pub(crate) against_several_bodies: Option<&'static str>,
    /// The reason why the condition excludes a consistent mass matrix; `None` if it does not.
    pub(crate) against_consistent_mass: Option<&'static str>,
}

impl FaceKind {
    /// Creates a kind without restrictions, with the lowest priority.
    pub(crate) const fn new(name: &'static str, verb: &'static str, motion: FaceMotion) -> Self {
        Self {
            name,
            verb,
            motion,
            strength: 0,
            is_lacked_by_fem: false,
            against_several_bodies: None,
            against_consistent_mass: None,
        }
    }
}

/// Compiled boundary condition on the motion of one face of the body.
pub(crate) trait BoundaryCondition: Condition + 'static {
    fn kind(&self) -> FaceKind;

    /// Returns the numbers for external solvers; empty if the name describes the condition fully.
    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::default()
    }

    /// Returns the condition on the grid nodes of the face; `None` if the nodes are free.
    fn wall(&self) -> Option<WallCondition> {
        None
    }

    /// Returns the text for the report row of the face; empty for no row.
    fn row(&self) -> String {
        self.kind().name.to_owned()
    }
}

impl dyn BoundaryCondition {
    pub(crate) fn is_free(&self) -> bool {
        self.kind().motion == FaceMotion::Free
    }

    pub(crate) fn is_periodic(&self) -> bool {
        self.kind().motion == FaceMotion::Periodic
    }

    pub(crate) fn is_driven(&self) -> bool {
        self.kind().motion == FaceMotion::Driven
    }

    /// Whether the motion of nodes on the face is prescribed.
    pub(crate) fn is_held(&self) -> bool {
        !(self.is_free() || self.is_periodic())
    }

    pub(crate) fn stays(&self) -> bool {
        matches!(self.kind().motion, FaceMotion::Stays { .. })
    }

    pub(crate) fn holds_all_components(&self) -> bool {
        self.kind().motion == FaceMotion::Stays { holds_all_components: true }
    }
}
