//! Names become types: the only place that knows every family, and the only one that spells out
//! 1, 2 and 3 dimensions.

use super::{
    bar::bar,
    conditions::{boundary, of_place_and_time, of_time, on_sets, periodic},
    extent::{cell_size, grid_axis, per_axis},
    filling::{self, Placed},
    method::Method,
    model::{ConvergencePlan, Scene},
    plan::LevelPlan,
    start::Initial,
    surface, viscosity,
};
use crate::{
    exact::{Forcing, Problem},
    mpm::{
        Bodies, BodyForce, Counted, Damping, Effect, Gravity, Grid, Kernel, LocalDamping,
        Particles, Setup, Solver, Tally, Vector, kernel,
    },
    subject::{Failure, Perturbable, Profile, Subject},
    verify::Quantity,
};
use std::sync::Arc;

/// Builds the subject of `method` for one level.
///
/// # Errors
/// One line that says why there is no such subject.
pub(super) fn subject(
    plan: &ConvergencePlan,
    method: Method,
    level: LevelPlan,
) -> Result<Box<dyn Subject>, String> {
    match (method, plan.scene.dimension()) {
        (Method::Fem { .. }, 1) => Ok(Box::new(bar(plan, method, level.cells)?)),
        (Method::Fem { .. }, d) => Err(format!("the reference FEM is 1-D, the scene {d}-D")),
        (Method::Mpm { .. }, 1) => mpm::<1>(plan, method, level),
        (Method::Mpm { .. }, 2) => mpm::<2>(plan, method, level),
        (Method::Mpm { .. }, 3) => mpm::<3>(plan, method, level),
        (Method::Mpm { .. }, d) => Err(format!("there is no MPM in {d} dimensions")),
    }
}

/// What a step of `method` takes on one level: the second step, the first having made all room.
/// None of a method that does not say, and of one that does not get so far.
pub(super) fn profile(plan: &ConvergencePlan, method: Method, level: LevelPlan) -> Option<Profile> {
    fn of_second_step<const D: usize>(
        plan: &ConvergencePlan,
        method: Method,
        level: LevelPlan,
    ) -> Option<Profile> {
        let tally = Arc::<Tally>::default();
        let counted = |setup: Setup<D>| {
            let kernel = Box::new(Counted::sharing(setup.kernel, &tally));
            Setup { kernel, ..setup }
        };
        let setups = setups::<D>(plan, method, level).ok()?.into_iter().map(counted).collect();
        let mut bodies = Bodies::new(setups, plan.scene.contact).ok()?;
        bodies.step(level.dt).ok()?;
        tally.take();
        bodies.step(level.dt).ok()?;
        Some(Profile { passes: tally.take(), ..bodies.profile() })
    }
    match (method, plan.scene.dimension()) {
        (Method::Fem { .. }, _) => None,
        (Method::Mpm { .. }, 1) => of_second_step::<1>(plan, method, level),
        (Method::Mpm { .. }, 2) => of_second_step::<2>(plan, method, level),
        (Method::Mpm { .. }, _) => of_second_step::<3>(plan, method, level),
    }
}

/// Whether a level with cells of size `h` has no particle of some round body.
pub(super) fn is_vacant(scene: &Scene, h: f64, per_axis: usize) -> bool {
    fn vacant<const D: usize>(scene: &Scene, h: f64, per_axis: usize) -> bool {
        let origin = Vector::<D>::from_fn(|axis, _| grid_axis(scene, axis, h).0);
        let mut round = scene.each().iter().filter(|body| body.round.is_some());
        round.any(|body| filling::is_empty(body, &origin, h, per_axis))
    }
    match scene.dimension() {
        1 => vacant::<1>(scene, h, per_axis),
        2 => vacant::<2>(scene, h, per_axis),
        _ => vacant::<3>(scene, h, per_axis),
    }
}

/// An MPM subject that can be perturbed: `body` on the cells of `level`.
///
/// # Errors
/// One line that says why there is no such subject.
pub(super) fn perturbable(
    body: &Body<'_>,
    method: Method,
    level: LevelPlan,
) -> Result<Box<dyn Perturbable>, String> {
    match body.scene.dimension() {
        1 => Ok(Box::new(solver::<1>(body, method, level)?)),
        2 => Ok(Box::new(solver::<2>(body, method, level)?)),
        _ => Ok(Box::new(solver::<3>(body, method, level)?)),
    }
}

/// What a body is at the start.
pub(super) struct Body<'a> {
    /// What all bodies have in common: the grid and its walls, and sets.
    pub(super) scene: &'a Scene,
    /// What is its own: place, material and loads.
    pub(super) own: &'a Scene,
    pub(super) initial: Initial,
    /// The problem whose force is manufactured.
    pub(super) manufactured: Option<&'a Problem>,
    /// Whether F is kept whoever reads it.
    pub(super) keeps_deformation: bool,
    /// Particles that are not where the lattice has them.
    pub(super) placed: Placed,
}

impl<'a> Body<'a> {
    fn of(plan: &'a ConvergencePlan, own: &'a Scene) -> Self {
        Self {
            scene: &plan.scene,
            own,
            initial: Initial::of_body(plan, own),
            manufactured: plan.manufactured(),
            keeps_deformation: plan.of == Quantity::DeformationGradient,
            placed: Placed::default(),
        }
    }
}

fn solver<const D: usize>(
    body: &Body<'_>,
    method: Method,
    level: LevelPlan,
) -> Result<Solver<D>, String> {
    Solver::new(setup(body, method, level)?).map_err(|failure| failure.to_string())
}

fn mpm<const D: usize>(
    plan: &ConvergencePlan,
    method: Method,
    level: LevelPlan,
) -> Result<Box<dyn Subject>, String> {
    let mut setups = setups::<D>(plan, method, level)?;
    let said = |failure: Failure| failure.to_string();
    Ok(match (setups.pop(), setups.is_empty(), plan.scene.contact) {
        (Some(one), true, None) => Box::new(Solver::new(one).map_err(said)?),
        (last, _, contact) => {
            setups.extend(last);
            Box::new(Bodies::new(setups, contact).map_err(said)?)
        }
    })
}

/// What the solver of each body is made of.
fn setups<const D: usize>(
    plan: &ConvergencePlan,
    method: Method,
    level: LevelPlan,
) -> Result<Vec<Setup<D>>, String> {
    plan.scene.each().iter().map(|own| setup(&Body::of(plan, own), method, level)).collect()
}

fn setup<const D: usize>(
    body: &Body<'_>,
    method: Method,
    level: LevelPlan,
) -> Result<Setup<D>, String> {
    let Method::Mpm { basis, transfer, scheme, start, mass, frame } = method else {
        return Err("not an MPM method".to_owned());
    };
    let scene = body.scene;
    let h = cell_size(scene, level.cells);
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, D)).ok_or("MPM needs particles")?;
    let kernel = kernel::<D>(basis);
    let grid = grid(scene, h, kernel.as_ref());
    let mut particles = filling::particles(body.own, &grid.origin, h, per_axis);
    body.placed.put(&mut particles);
    if body.keeps_deformation {
        particles.track_deformation();
    }
    body.initial.put(&mut particles);
    let mut effects = effects(body.own, &particles, h);
    effects.extend(body.manufactured.map(|made| manufactured_force(made, &particles)));
    effects.extend(on_sets(scene, &particles)?);
    Ok(Setup {
        kernel,
        transfer: transfer.build(),
        mass: crate::mpm::mass_matrix(mass),
        frame,
        material: body.own.material.build(),
        effects,
        boundary: boundary(scene, &grid, basis),
        grid,
        particles,
        scheme,
        start,
    })
}

fn manufactured_force<const D: usize>(
    made: &Problem,
    particles: &Particles<D>,
) -> Box<dyn Effect<D>> {
    let mut forcing = Forcing::new(made, particles.x0.iter().map(Vector::as_slice));
    Box::new(BodyForce::new(Box::new(move |t, _, b| {
        forcing.at(t, b, |force| Vector::from_fn(|i, _| force[i]));
    })))
}

/// The grid that the suite asks for, or the body's box with room beyond its free faces.
fn grid<const D: usize>(scene: &Scene, h: f64, kernel: &dyn Kernel<D>) -> Grid<D> {
    let axes: [(f64, f64); D] = std::array::from_fn(|axis| grid_axis(scene, axis, h));
    let origin = Vector::from_fn(|axis, _| axes[axis].0);
    let cells = axes.map(|(_, cells)| cells as usize);
    kernel.grid(origin, h, cells, std::array::from_fn(|axis| periodic(scene, axis)))
}

fn effects<const D: usize>(
    scene: &Scene,
    particles: &Particles<D>,
    h: f64,
) -> Vec<Box<dyn Effect<D>>> {
    let mut effects: Vec<Box<dyn Effect<D>>> = Vec::new();
    if let Some(formulas) = &scene.gravity {
        effects.push(Box::new(Gravity(of_time(formulas))));
    }
    if let Some(formulas) = &scene.body_force {
        effects.push(Box::new(BodyForce::pointwise(of_place_and_time(formulas))));
    }
    if let Some(rate) = scene.damping.clone() {
        effects.push(Box::new(Damping(Box::new(move |t| rate.eval(&[t])))));
    }
    effects.extend(
        scene.local_damping.map(|share| -> Box<dyn Effect<D>> { Box::new(LocalDamping(share)) }),
    );
    if let Some(effect) = viscosity::on(scene, h) {
        effects.push(Box::new(effect));
    }
    effects.extend(surface::on_faces(scene, particles));
    effects
}
