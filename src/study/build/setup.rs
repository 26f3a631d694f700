//! From the model to what the solver of one body is made of, in any number of dimensions.

use super::{
    conditions::{boundary, of_place_and_time, of_time, on_sets, periodic},
    initial_state::Initial,
    seeding, thermal,
};
use crate::{
    exact::{
        Forcing, Problem,
        formula::{Formula, Hoisted},
        heat::Conduction,
    },
    mpm::{
        BasisName, BodyForce, Damping, Effect, Gravity, Grid, HeatSolver, Kernel, LocalDamping,
        Particles, Setup, Vector, kernel,
    },
    suite::{
        compile::load::{expansion, surface, viscosity},
        model::{
            ConvergencePlan, Scene,
            grid_size::{cell_size, grid_axis, per_axis},
            method::Method,
            refine_plan::LevelPlan,
            stability::LatticeEdits,
        },
    },
};

/// Longest formula that is taken apart for its places, with its sums written out.
const MOST_OPERATIONS: u64 = 5000;

/// What a body is at the start.
pub(crate) struct Body<'a> {
    /// What all bodies have in common: the grid and its walls, and sets.
    pub(crate) scene: &'a Scene,
    /// What is its own: place, material and loads.
    pub(crate) own: &'a Scene,
    pub(crate) initial: Initial,
    /// The problem whose force is manufactured.
    pub(crate) manufactured: Option<&'a Problem>,
    /// The problem that the temperature solves.
    pub(crate) heat: Option<&'a Conduction>,
    /// Whether F is kept whoever reads it.
    pub(crate) keeps_deformation: bool,
    /// Particles that are not where the lattice has them.
    pub(crate) lattice: LatticeEdits,
}

impl<'a> Body<'a> {
    /// One of the bodies of a convergence study.
    pub(crate) fn of(plan: &'a ConvergencePlan, own: &'a Scene) -> Self {
        Self {
            scene: &plan.scene,
            own,
            initial: Initial::of_body(plan, own),
            manufactured: plan.manufactured(),
            heat: plan.heat_problem(),
            keeps_deformation: plan.of.needs_deformation_gradient(),
            lattice: LatticeEdits::default(),
        }
    }
}

/// What the solver of `body` is made of, on the cells of `level`.
///
/// # Errors
/// One line that says why there is no such solver.
pub(crate) fn setup<const D: usize>(
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
    let mut particles = seeding::particles(body.own, &grid.origin, h, per_axis);
    body.lattice.apply(&mut particles);
    if body.keeps_deformation {
        particles.track_deformation();
    }
    body.initial.put(&mut particles);
    let mut effects = effects(body.own, &particles, h);
    if let Some(heat) = thermal::heat((body.own, body.heat), (&grid, basis), &mut particles) {
        effects.push(Box::new(heat));
    }
    if let Some(expansion) = expansion::effect(body.own) {
        effects.push(Box::new(expansion));
    }
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

/// A body at rest; `with` may wrap its kernel.
pub(crate) fn conductor<const D: usize>(
    plan: &ConvergencePlan,
    basis: BasisName,
    level: LevelPlan,
    with: impl FnOnce(Box<dyn Kernel<D>>) -> Box<dyn Kernel<D>>,
) -> Result<HeatSolver<D>, String> {
    let h = cell_size(&plan.scene, level.cells);
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, D)).ok_or("MPM needs particles")?;
    let kernel = with(kernel::<D>(basis));
    let grid = grid(&plan.scene, h, kernel.as_ref());
    let mut particles = seeding::particles(&plan.scene, &grid.origin, h, per_axis);
    let heat = thermal::heat((&plan.scene, plan.heat_problem()), (&grid, basis), &mut particles);
    let effects = heat.map(|heat| Box::new(heat) as Box<dyn Effect<D>>).into_iter().collect();
    HeatSolver::new(kernel, grid, particles, effects).map_err(|failure| failure.to_string())
}

pub(crate) fn plain<const D: usize>(kernel: Box<dyn Kernel<D>>) -> Box<dyn Kernel<D>> {
    kernel
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

/// A force that the suite states. The formula of a force may be too long to be taken apart.
fn stated_force<const D: usize>(formulas: &[Formula]) -> BodyForce<D> {
    if formulas.iter().any(|formula| formula.operations() > MOST_OPERATIONS) {
        return BodyForce::pointwise(of_place_and_time(formulas));
    }
    let formulas = formulas.to_vec();
    let mut places = None;
    BodyForce::new(Box::new(move |t, labels: &[Vector<D>], b| {
        let places = places.get_or_insert_with(|| {
            let mut places = Hoisted::new(&formulas, D + 1);
            for label in labels {
                places.add(label.as_slice());
            }
            places
        });
        places.set_time(t);
        for (place, b) in b.iter_mut().enumerate() {
            for (b, value) in b.iter_mut().zip(places.eval(place)) {
                *b = value;
            }
        }
    }))
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
        effects.push(Box::new(stated_force(formulas)));
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
