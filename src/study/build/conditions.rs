//! Boundary conditions and loads on sets, from the model to the solver.

use crate::{
    exact::{Region, formula::Formula},
    mpm::{
        BasisName, Boundary, Effect, Fixed, Friction, Grid, Particles, Prescribed,
        PrescribedVelocity, Roller, SetForce, Side, Vector, VelocityField,
    },
    suite::model::{Scene, SceneFace, boundary::BoundaryCondition},
};

/// Which end of its axis a face is.
pub(crate) fn side(face: &SceneFace) -> Side {
    if face.high { Side::High } else { Side::Low }
}

/// Whether an axis has no end. A round body has no faces.
pub(crate) fn periodic(scene: &Scene, axis: usize) -> bool {
    scene.faces.get(2 * axis).is_some_and(|face| matches!(face.hold, BoundaryCondition::Periodic))
}

/// What is held on the faces of the grid. Where faces meet, a fixed one wins over one with
/// friction, which leaves to a roller what that holds, and all over a given velocity: a wall that drives a body does not tear it from one that holds it.
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

/// What acts on sets of particles.
///
/// # Errors
/// One line that says which set is empty.
pub(crate) fn on_sets<const D: usize>(
    scene: &Scene,
    particles: &Particles<D>,
) -> Result<Vec<Box<dyn Effect<D>>>, String> {
    let mut effects: Vec<Box<dyn Effect<D>>> = Vec::new();
    for set in &scene.sets {
        let members = members(set, particles);
        if members.is_empty() {
            return Err(format!("the set `{}` holds no particle", set.name));
        }
        if let Some(force) = &set.force {
            effects.push(Box::new(SetForce::on(particles, &members, of_time(force))));
        }
        if let Some(velocity) = &set.velocity {
            effects.push(Box::new(PrescribedVelocity::on(
                particles,
                &members,
                of_place_and_time(velocity),
            )));
        }
    }
    Ok(effects)
}

fn members<const D: usize>(set: &Region, particles: &Particles<D>) -> Vec<usize> {
    (0..particles.len()).filter(|&p| set.holds(particles.x0[p].as_slice())).collect()
}

/// Formulas of t, one for each component.
pub(crate) fn of_time<const D: usize>(
    formulas: &[Formula],
) -> Box<dyn Fn(f64) -> Vector<D> + Send> {
    let formulas = formulas.to_vec();
    Box::new(move |t| Vector::from_fn(|i, _| formulas[i].eval(&[t])))
}

/// Formulas of the coordinates and t, one for each component.
pub(crate) fn of_place_and_time<const D: usize>(formulas: &[Formula]) -> VelocityField<D> {
    let formulas = formulas.to_vec();
    Box::new(move |x: &Vector<D>, t| {
        let variables = with_time(x, t);
        Vector::from_fn(|i, _| formulas[i].eval(&variables[..=D]))
    })
}

/// The coordinates followed by the time, as formulas want them: the first D + 1 numbers.
pub(crate) fn with_time<const D: usize>(x: &Vector<D>, t: f64) -> [f64; 4] {
    let mut variables = [0.0; 4];
    variables[..D].copy_from_slice(x.as_slice());
    variables[D] = t;
    variables
}
