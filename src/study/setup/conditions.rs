//! Boundary conditions, from the model to the solver.

use crate::mpm::{BasisName, Boundary, Grid, Side};
use crate::suite::model::boundary::{self, FaceSite};
use crate::suite::model::{Scene, SceneFace};

/// Whether an axis has no end. A round body has no faces.
pub(crate) fn periodic(scene: &Scene, axis: usize) -> bool {
    scene.faces.get(2 * axis).is_some_and(|face| face.hold.is_periodic())
}

/// Boundary conditions on the faces of the grid: where faces share a node, a later one overrides an
/// earlier one, and so the stronger come last.
pub(crate) fn boundary<const D: usize>(
    scene: &Scene,
    grid: &Grid<D>,
    basis: BasisName,
) -> Vec<Box<dyn Boundary<D>>> {
    let mut faces: Vec<&SceneFace> = scene.faces.iter().collect();
    faces.sort_by_key(|face| face.hold.strength());
    let build = |face: &SceneFace| {
        let side = if face.high { Side::High } else { Side::Low };
        boundary::build(&face.hold, &FaceSite { grid, basis, at: (face.axis, side) })
    };
    faces.into_iter().filter_map(build).collect()
}
