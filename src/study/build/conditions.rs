//! Boundary conditions, from the model to the solver.

use crate::mpm::{BasisName, Boundary, Fixed, Friction, Grid, Prescribed, Roller, Side};
use crate::suite::compile::load::fields::of_place_and_time;
use crate::suite::model::{BoundaryCondition, Scene, SceneFace};

/// Which end of its axis a face is.
fn side(face: &SceneFace) -> Side {
    if face.high { Side::High } else { Side::Low }
}

/// Whether an axis has no end. A round body has no faces.
pub(crate) fn periodic(scene: &Scene, axis: usize) -> bool {
    scene.faces.get(2 * axis).is_some_and(|face| matches!(face.hold, BoundaryCondition::Periodic))
}

/// Boundary conditions on the faces of the grid. Where faces share a node the stronger condition
/// wins: fixed > friction > roller > prescribed velocity. A wall that drives a body does not tear
/// it from one that holds it.
pub(crate) fn boundary<const D: usize>(
    scene: &Scene,
    grid: &Grid<D>,
    basis: BasisName,
) -> Vec<Box<dyn Boundary<D>>> {
    let mut ranked: Vec<(u8, Box<dyn Boundary<D>>)> = Vec::new();
    for face in &scene.faces {
        let (axis, side) = (face.axis, side(face));
        match &face.hold {
            BoundaryCondition::Free | BoundaryCondition::Periodic | BoundaryCondition::AtRest => {}
            BoundaryCondition::Velocity(value) => {
                let driven = Prescribed::face(grid, basis, axis, side, of_place_and_time(value));
                ranked.push((0, Box::new(driven)));
            }
            BoundaryCondition::Roller => ranked.push((1, Box::new(Roller::face(grid, axis, side)))),
            BoundaryCondition::Friction(coefficient) => {
                ranked.push((2, Box::new(Friction::face(grid, axis, side, *coefficient))));
            }
            BoundaryCondition::Fixed => ranked.push((3, Box::new(Fixed::face(grid, axis, side)))),
        }
    }
    ranked.sort_by_key(|(rank, _)| *rank);
    ranked.into_iter().map(|(_, condition)| condition).collect()
}
