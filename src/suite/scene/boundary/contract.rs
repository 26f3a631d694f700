//! Boundary conditions on the faces of a body: their keys, and the compiled condition.

use crate::dimension::in_every_dimension;
use crate::exact::Condition;
use crate::exact::formula::Formula;
use crate::mpm::{BasisName, Boundary, Grid, Side};
use crate::suite::evaluator::{SuitePath, coordinates_and_time};
use crate::suite::scene::numbers::LoadNumbers;
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

pub(crate) trait BoundaryKeys {
    /// Checks the keys and returns the condition with all numbers computed.
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn BoundaryCondition>, Diagnostic>;

    /// Whether the face coincides with the opposite face.
    fn is_periodic(&self) -> bool {
        false
    }
}

/// A condition without parameters is also the type of its keys.
impl<T: BoundaryCondition + Copy> BoundaryKeys for T {
    fn compile(&self, _: &FaceEntry<'_>) -> Result<Arc<dyn BoundaryCondition>, Diagnostic> {
        Ok(Arc::new(*self))
    }

    fn is_periodic(&self) -> bool {
        BoundaryCondition::is_periodic(self)
    }
}

/// Context for compiling a boundary condition: its path in the file, and the scene's dimension.
pub(crate) struct FaceEntry<'a> {
    /// Path of the condition's value.
    pub(crate) path: SuitePath<'a>,
    pub(crate) dimension: usize,
}

impl FaceEntry<'_> {
    /// Compiles a formula of the coordinates and t at `path`.
    pub(crate) fn scalar(
        &self,
        path: &SuitePath<'_>,
        text: &NumberText,
    ) -> Result<Formula, Diagnostic> {
        path.formula(text, &coordinates_and_time(self.dimension))
    }

    /// Compiles one formula of the coordinates and t for each component.
    pub(crate) fn vector(&self, texts: &[NumberText]) -> Result<Vec<Formula>, Diagnostic> {
        let variables = coordinates_and_time(self.dimension);
        self.path.vector(texts, self.dimension, &variables)
    }
}

/// A face of a D-dimensional grid, for which a condition is built.
pub(crate) struct FaceSite<'a, const D: usize> {
    pub(crate) grid: &'a Grid<D>,
    pub(crate) basis: BasisName,
    /// Axis of the normal, and the end of the axis at which the face lies.
    pub(crate) at: (usize, Side),
}

/// Converts a condition of a scene to a condition of the solver.
pub(crate) trait BuildBoundary<const D: usize> {
    /// Returns the condition on the nodes of the face at `site`; `None` if the nodes are free.
    fn build(&self, _site: &FaceSite<'_, D>) -> Option<Box<dyn Boundary<D>>> {
        None
    }
}

in_every_dimension! {
    /// Implementation of [`BuildBoundary`] in every dimension.
    BuildBoundaries: BuildBoundary
}

/// Compiled boundary condition on the motion of one face of the body.
pub(crate) trait BoundaryCondition: BuildBoundaries + Condition + 'static {
    fn name(&self) -> &'static str;

    /// Returns the numbers for external solvers; empty if the name describes the condition fully.
    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::default()
    }

    /// Returns the verb phrase that follows "the left face" in messages.
    fn verb(&self) -> &'static str;

    /// Returns the text for the report row of the face; empty for no row.
    fn row(&self) -> String {
        self.name().to_owned()
    }

    /// Returns the priority at nodes that several faces share: the condition with the largest
    /// number applies. A fixed face, for example, has priority over a face with a prescribed
    /// velocity.
    fn strength(&self) -> u8 {
        0
    }

    /// Whether the face is free and may carry a traction.
    fn is_free(&self) -> bool {
        false
    }

    /// Whether the face coincides with the opposite face.
    fn is_periodic(&self) -> bool {
        false
    }

    /// Whether the motion of nodes on the face is prescribed.
    fn is_held(&self) -> bool {
        !(self.is_free() || self.is_periodic())
    }

    /// Whether the face has a prescribed velocity.
    fn is_driven(&self) -> bool {
        false
    }

    /// Whether the body face always stays on the grid face.
    fn stays(&self) -> bool {
        false
    }

    /// Whether the tangential motion is prescribed in addition to the normal motion.
    fn holds_all_components(&self) -> bool {
        false
    }

    /// Whether the FEM of this crate lacks the condition.
    fn is_lacked_by_fem(&self) -> bool {
        false
    }

    /// Returns the reason why the condition excludes several bodies; `None` if it does not.
    fn against_several_bodies(&self) -> Option<&'static str> {
        None
    }

    /// Returns the reason why the condition excludes a consistent mass matrix; `None` if it does
    /// not.
    fn against_consistent_mass(&self) -> Option<&'static str> {
        None
    }
}

/// Builds the condition in D dimensions on the nodes of the face at `site`.
pub(crate) fn build<const D: usize>(
    condition: &Arc<dyn BoundaryCondition>,
    site: &FaceSite<'_, D>,
) -> Option<Box<dyn Boundary<D>>> {
    let condition: Arc<dyn BuildBoundaries> = condition.clone();
    condition.in_dimension::<D>()?.build(site)
}
