//! Creates solvers from data, in the dimension of the data.

use super::body::BodyInput;
use super::state::{InitialState, ParticleTable, rows};
use super::wall::WallInput;
use super::{GridInput, MethodInput, MpmMethod, SceneInput};
use crate::mpm::basis::{BasisName, Domain};
use crate::mpm::effect::Hoop;
use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::particles::{Block, Particles};
use crate::mpm::kernel::kernel;
use crate::mpm::mass::mass_matrix;
use crate::mpm::material::MaterialPlan;
use crate::mpm::multibody::Bodies;
use crate::mpm::quasi_static::{QuasiStatic, QuasiStaticSetup};
use crate::mpm::seeding::Fragment;
use crate::mpm::step::heat_solver::HeatSolver;
use crate::mpm::step::initial::complete;
use crate::mpm::step::setup::Setup;
use crate::mpm::step::solver::Solver;
use mpm_subject::with_dimension;
use mpm_subject::{Perturbable, PlaneState, Precision, Profile, Subject, SubjectError};

/// Creates the solver of a scene.
///
/// # Errors
/// The reason why the solver cannot be created.
pub fn subject(
    scene: SceneInput<'_>,
    method: MethodInput,
) -> Result<Box<dyn Subject>, SubjectError> {
    with_dimension!(scene.grid.dimension(), D => match method {
        MethodInput::Dynamic(method) => Ok(dynamic::<D>(scene, method)?),
        MethodInput::QuasiStatic { basis, load_steps } => {
            Ok(Box::new(quasi_static::<D>(scene, basis, load_steps)?))
        }
        MethodInput::Heat { basis } => Ok(Box::new(conductor::<D>(scene, basis)?)),
    })
}

/// Returns the profile of the second step of length `dt` (s), because the first step also allocates
/// memory. `None` if the solver fails earlier.
pub fn profile(scene: SceneInput<'_>, method: MethodInput, dt: f64) -> Option<Profile> {
    fn of_second_step<S: Subject>(
        mut subject: S,
        dt: f64,
        take_visits: fn(&S) -> Vec<(&'static str, u64)>,
        profile: fn(&S) -> Profile,
    ) -> Option<Profile> {
        subject.step(dt).ok()?;
        take_visits(&subject);
        subject.step(dt).ok()?;
        let visits = take_visits(&subject);
        Some(Profile { passes: subject.passes(), visits, ..profile(&subject) })
    }
    with_dimension!(scene.grid.dimension(), D => match method {
        MethodInput::QuasiStatic { basis, .. } => {
            let body = quasi_static::<D>(scene, basis, 2).ok()?;
            of_second_step(body, 1.0, QuasiStatic::take_visits, QuasiStatic::profile)
        }
        MethodInput::Heat { basis } => {
            let body = conductor::<D>(scene, basis).ok()?;
            of_second_step(body, dt, HeatSolver::take_visits, HeatSolver::profile)
        }
        MethodInput::Dynamic(method) => {
            let contact = scene.contact;
            let bodies = Bodies::<D>::new(setups(scene, method).ok()?, contact).ok()?;
            of_second_step(bodies, dt, Bodies::take_visits, Bodies::profile)
        }
    })
}

/// Predicts the stable time step (s): the minimum over the bodies, from `rounds` power iterations.
/// Each body is treated separately, because nodes shared with other bodies do not make it less
/// stable. `wave_speeds` are the speeds of the fastest wave in each body (m/s).
///
/// # Errors
/// The reason why a solver cannot be created, or why its stable time step is undefined.
pub fn stable_time_step(
    scene: SceneInput<'_>,
    method: MpmMethod,
    wave_speeds: &[f64],
    rounds: u32,
) -> Result<f64, SubjectError> {
    let h = scene.grid.h;
    with_dimension!(scene.grid.dimension(), D => {
        let setups = setups::<D>(scene, method)?;
        setups.into_iter().zip(wave_speeds).try_fold(f64::INFINITY, |least, (setup, speed)| {
            let solver = Solver::new(setup)?;
            let fastest = solver.particles().v.iter().map(Vector::norm).fold(0.0, f64::max);
            let longest = h / (speed + fastest);
            Ok(least.min(solver.stable_time_step(longest, rounds)?))
        })
    })
}

/// Creates an MPM solver whose state can be perturbed.
///
/// # Errors
/// The reason why the solver cannot be created.
pub fn perturbable(
    scene: SceneInput<'_>,
    method: MpmMethod,
) -> Result<Box<dyn Perturbable>, SubjectError> {
    with_dimension!(scene.grid.dimension(), D => dynamic::<D>(scene, method))
}

/// Creates the initial particles of each body; `disturb` may modify the state of each body. The law
/// of a body computes the initial stress from the initial deformation.
///
/// # Errors
/// The reason why a body cannot be created.
pub fn initial_particles(
    scene: SceneInput<'_>,
    method: MpmMethod,
    disturb: &mut dyn FnMut(&mut dyn Perturbable),
) -> Result<Vec<ParticleTable>, SubjectError> {
    with_dimension!(scene.grid.dimension(), D => {
        let table = |setup: Setup<D>| {
            let mut solver = Solver::new(setup)?;
            disturb(&mut solver);
            Ok(ParticleTable::new(solver.particles().clone()))
        };
        setups::<D>(scene, method)?.into_iter().map(table).collect()
    })
}

/// Computes the Cauchy stress (Pa, tensors in rows) of a body in its initial state, at reference
/// positions (m, one number per dimension) with the densities `densities` (kg/m3).
///
/// # Errors
/// The reason why the stress is not defined.
pub fn initial_stress(
    labels: &[Vec<f64>],
    plane: PlaneState,
    material: &MaterialPlan,
    initial: &InitialState<'_>,
    densities: &[f64],
) -> Result<Vec<f64>, SubjectError> {
    let dimension = labels.first().map_or(1, Vec::len);
    with_dimension!(dimension, D => {
        let (from, to) = (Vector::<D>::zeros(), Vector::from_element(1.0));
        let none = Block { from, to, density: 1.0 };
        let mut particles = Particles::fill_where(&none, 1.0, 1, |_| false);
        let fragment = |label: &Vec<f64>| {
            let place = Vector::from_column_slice(label);
            Fragment { place, volume: 1.0, domain: Matrix::identity() }
        };
        let fragments: Vec<Fragment<D>> = labels.iter().map(fragment).collect();
        particles.add_fragments(&fragments, 1.0);
        particles.mass.copy_from_slice(densities);
        if plane == PlaneState::Axisymmetric {
            particles.revolve();
        }
        initial.put(&mut particles);
        let law = material.in_plane(plane).ok_or("a law not supported in its plane")?;
        let mut law = initial.stressed(law, &mut particles)?;
        complete(&mut particles, Domain::Point, law.as_mut())?;
        Ok(rows(&particles.sigma))
    })
}

fn dynamic<const D: usize>(
    scene: SceneInput<'_>,
    method: MpmMethod,
) -> Result<Box<dyn Perturbable>, SubjectError> {
    let contact = scene.contact;
    let mut setups = setups::<D>(scene, method)?;
    if setups.len() > 1 {
        return Ok(Box::new(Bodies::new(setups, contact)?));
    }
    let one = setups.pop().ok_or("a scene has at least one body")?;
    Ok(match method.precision {
        Precision::Single => Box::new(Solver::in_single_precision(one)?),
        Precision::Double => Box::new(Solver::new(one)?),
    })
}

fn setups<const D: usize>(
    scene: SceneInput<'_>,
    method: MpmMethod,
) -> Result<Vec<Setup<D>>, SubjectError> {
    let SceneInput { plane, grid, walls, bodies, .. } = scene;
    bodies.into_iter().map(|body| setup(body, &grid, plane, &walls, method)).collect()
}

fn setup<const D: usize>(
    mut body: BodyInput<'_>,
    grid: &GridInput,
    plane: PlaneState,
    walls: &[WallInput],
    method: MpmMethod,
) -> Result<Setup<D>, SubjectError> {
    let MpmMethod { basis, transfer, scheme, start, mass, frame, volume, .. } = method;
    let kernel = kernel::<D>(basis);
    let mut particles = body.seed(grid.h, plane);
    let grid = grid.build(kernel.as_ref());
    if body.stores_deformation {
        particles.track_deformation();
    }
    body.initial.put(&mut particles);
    let mut effects = body.take_effects(&grid, basis, &mut particles)?;
    if plane == PlaneState::Axisymmetric {
        effects.insert(0, Box::new(Hoop::default()));
    }
    let material = body.law(plane, &mut particles)?;
    Ok(Setup {
        kernel,
        transfer: transfer.build(),
        mass: mass_matrix(mass),
        frame,
        volume,
        material,
        effects,
        boundary: walls.iter().map(|wall| wall.build(&grid, basis)).collect(),
        grid,
        particles,
        scheme,
        start,
    })
}

/// Takes the only body of a scene.
fn only_body<'a>(bodies: Vec<BodyInput<'a>>) -> Result<BodyInput<'a>, SubjectError> {
    let only: Result<[BodyInput<'a>; 1], _> = bodies.try_into();
    only.map(|[body]| body).map_err(|_| "the solver is for one body".into())
}

fn quasi_static<const D: usize>(
    scene: SceneInput<'_>,
    basis: BasisName,
    load_steps: u64,
) -> Result<QuasiStatic<D>, SubjectError> {
    let SceneInput { plane, grid, walls, bodies, .. } = scene;
    let mut body = only_body(bodies)?;
    let kernel = kernel::<D>(basis);
    let mut particles = body.seed(grid.h, plane);
    let grid = grid.build(kernel.as_ref());
    let effects = body.take_effects(&grid, basis, &mut particles)?;
    let boundary = walls.iter().map(|wall| wall.build(&grid, basis)).collect();
    let material = body.law(plane, &mut particles)?;
    Ok(QuasiStatic::new(QuasiStaticSetup {
        grid,
        particles,
        kernel,
        material,
        effects,
        boundary,
        load_steps,
    })?)
}

fn conductor<const D: usize>(
    scene: SceneInput<'_>,
    basis: BasisName,
) -> Result<HeatSolver<D>, SubjectError> {
    let SceneInput { grid, bodies, .. } = scene;
    let mut body = only_body(bodies)?;
    let kernel = kernel::<D>(basis);
    let mut particles = body.fill(grid.h);
    let grid = grid.build(kernel.as_ref());
    let effects = body.take_effects(&grid, basis, &mut particles)?;
    Ok(HeatSolver::new(kernel, grid, particles, effects)?)
}
