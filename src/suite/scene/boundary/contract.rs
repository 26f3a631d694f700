//! Conditions on the faces of a body: the keys in a suite, and the checked condition.

use crate::dimension::in_every_dimension;
use crate::exact::Condition;
use crate::exact::formula::Formula;
use crate::mpm::{BasisName, Boundary, Grid, Side};
use crate::suite::evaluator::{Evaluator, coordinates_and_time};
use crate::suite::scene::numbers::LoadNumbers;
use crate::suite::yaml::{Diagnostic, NumberText, Path};
use std::sync::Arc;

/// Keys of a condition on a face, in suites.
pub(crate) trait BoundaryKeys {
    /// The condition, checked, with every number computed.
    ///
    /// # Errors
    /// The first error in its keys.
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn BoundaryCondition>, Diagnostic>;

    /// Whether the face coincides with the opposite one.
    fn is_periodic(&self) -> bool {
        false
    }
}

/// A condition without parameters is its own specification.
impl<T: BoundaryCondition + Copy> BoundaryKeys for T {
    fn compile(&self, _: &FaceEntry<'_>) -> Result<Arc<dyn BoundaryCondition>, Diagnostic> {
        Ok(Arc::new(*self))
    }

    fn is_periodic(&self) -> bool {
        BoundaryCondition::is_periodic(self)
    }
}

/// Context of the compilation of a condition on a face: its path in the file, and the dimension of
/// the scene.
pub(crate) struct FaceEntry<'a> {
    pub(crate) evaluator: &'a Evaluator<'a>,
    /// Path of its value.
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

/// A face of a grid in D dimensions, for which a condition is built.
pub(crate) struct FaceSite<'a, const D: usize> {
    pub(crate) grid: &'a Grid<D>,
    pub(crate) basis: BasisName,
    /// Axis of the normal, and the end of that axis.
    pub(crate) at: (usize, Side),
}

/// A condition of a scene as one of the solver.
pub(crate) trait BuildBoundary<const D: usize> {
    /// The condition on the nodes of the face at `site`; `None` if they are free.
    fn build(&self, _site: &FaceSite<'_, D>) -> Option<Box<dyn Boundary<D>>> {
        None
    }
}

in_every_dimension! {
    /// A condition of a scene as one of the solver in any dimension.
    BuildBoundaries: BuildBoundary
}

/// Condition on the motion of one face of the body, with every number computed.
pub(crate) trait BoundaryCondition: BuildBoundaries + Condition + 'static {
    /// Name in suites.
    fn name(&self) -> &'static str;

    /// Numbers for solvers of other programs; empty for a condition that its name describes.
    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::default()
    }

    /// Its verb, which follows "the left face" in messages.
    fn verb(&self) -> &'static str;

    /// Value of its row in reports; empty: no row.
    fn row(&self) -> String {
        self.name().to_owned()
    }

    /// If faces share a node, the stronger condition applies: a wall that drives a body does not
    /// override one that fixes it.
    fn strength(&self) -> u8 {
        0
    }

    /// Whether the face is free and may have a traction.
    fn is_free(&self) -> bool {
        false
    }

    /// Whether the face coincides with the opposite one.
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

    /// Whether the face cannot move away from the end of the grid.
    fn stays(&self) -> bool {
        false
    }

    /// Whether the motion along the face is prescribed as well as that along its normal.
    fn holds_all_components(&self) -> bool {
        false
    }

    /// Whether the reference FEM does not support it.
    fn is_lacked_by_fem(&self) -> bool {
        false
    }

    /// Why it cannot be used with several bodies; `None` if it can.
    fn against_several_bodies(&self) -> Option<&'static str> {
        None
    }

    /// Why a consistent mass matrix cannot be solved with it; `None` if it can.
    fn against_consistent_mass(&self) -> Option<&'static str> {
        None
    }
}

/// The condition in D dimensions on the nodes of the face at `site`.
pub(crate) fn build<const D: usize>(
    condition: &Arc<dyn BoundaryCondition>,
    site: &FaceSite<'_, D>,
) -> Option<Box<dyn Boundary<D>>> {
    let condition: Arc<dyn BuildBoundaries> = condition.clone();
    condition.in_dimension::<D>()?.build(site)
}
