//! The MPM of this crate as an external solver: from the problem alone.

use mpm_verify::external::{Capabilities, LevelProblem, ProblemNeeds, SolverFactory};
use mpm_verify::mpm::input::MpmMethod;
use mpm_verify::mpm::{
    Block, BodyForce, Boundary, Effect, Fixed, Grid, MaterialPlan, MaterialSpec, Matrix, Particles,
    Roller, Setup, Side, Solver, TransferName, Vector, kernel, mass_matrix,
};
use mpm_verify::subject::{Subject, SubjectError};
use mpm_verify::suite::Method;
use std::collections::HashMap;

/// Creates the solver of one method.
pub(super) struct ProblemSolver {
    pub(super) method: Method,
}

impl SolverFactory for ProblemSolver {
    fn name(&self) -> &'static str {
        "changed"
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        let conditions = ["free", "fixed", "roller", "periodic"];
        let mut able = Capabilities {
            columns: ["stress", "deformation_gradient"].map(str::to_owned).to_vec(),
            manufactured: true,
            initial_deformation: true,
            ..Capabilities::of(&[1, 2, 3], &[], &conditions, &["gravity", "body_force"])
        };
        able.laws = needs.laws.iter().map(|law| (*law).to_owned()).collect();
        able.lacking(needs)
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        match problem.dimension {
            1 => made::<1>(self.method, &problem),
            2 => made::<2>(self.method, &problem),
            _ => made::<3>(self.method, &problem),
        }
    }
}

/// Whether a problem for solvers contains the whole initial state of the method. It does not
/// contain affine fields, whose initial values are not zero.
pub(super) fn is_known(method: Method) -> bool {
    let Method::Mpm(method) = method else { return false };
    let without_affine = [TransferName::Flip, TransferName::Flip99, TransferName::Pic];
    without_affine.into_iter().any(|name| method.transfer == name.into())
}

fn made<const D: usize>(
    method: Method,
    problem: &LevelProblem,
) -> Result<Box<dyn Subject>, SubjectError> {
    let Method::Mpm(method) = method else { return Err("no MPM".into()) };
    let MpmMethod { basis, transfer, scheme, start, mass, frame, volume, .. } = method;
    let kernel = kernel::<D>(basis);
    let handed = &problem.grid;
    let origin = Vector::from_column_slice(&handed.origin);
    let cells = std::array::from_fn(|i| handed.cells[i] as usize);
    let grid = kernel.grid(origin, handed.h, cells, std::array::from_fn(|i| handed.periodic[i]));
    let setup = Setup {
        kernel,
        transfer: transfer.build(),
        mass: mass_matrix(mass),
        frame,
        volume,
        material: law(problem)?.build(),
        effects: effects(problem),
        boundary: boundary(problem, &grid),
        particles: particles_of(problem)?,
        grid,
        scheme,
        start,
    };
    let solver = Solver::<D>::new(setup).map_err(|failure| failure.to_string())?;
    Ok(Box::new(solver))
}

fn boundary<const D: usize>(problem: &LevelProblem, grid: &Grid<D>) -> Vec<Box<dyn Boundary<D>>> {
    let mut all: Vec<Box<dyn Boundary<D>>> = Vec::new();
    // If faces share a node, the stronger condition must come last.
    for wanted in ["roller", "fixed"] {
        for face in problem.faces.iter().filter(|face| face.condition == wanted) {
            let side = if face.high { Side::High } else { Side::Low };
            all.push(match wanted {
                "fixed" => Box::new(Fixed::face(grid, face.axis, side)),
                _ => Box::new(Roller::face(grid, face.axis, side)),
            });
        }
    }
    all
}

fn particles_of<const D: usize>(problem: &LevelProblem) -> Result<Particles<D>, String> {
    let start = &problem.particles;
    let volume = start.reference_volume.first().copied().ok_or("no particles")?;
    if start.reference_volume.iter().any(|other| *other != volume) {
        return Err("particles of several sizes".to_owned());
    }
    let vectors =
        |column: &[f64]| column.chunks_exact(D).map(Vector::<D>::from_column_slice).collect();
    let tensors = start.deformation_gradient.chunks_exact(D * D);
    let block = Block { from: Vector::<D>::zeros(), to: Vector::from_element(1.0), density: 1.0 };
    let mut particles = Particles::fill_where(&block, 1.0, 1, |_| false);
    particles.x0 = vectors(&start.reference_position);
    particles.x = vectors(&start.position);
    particles.v = vectors(&start.velocity);
    particles.mass.clone_from(&start.mass);
    particles.vol0.clone_from(&start.reference_volume);
    particles.vol.clone_from(&start.volume);
    particles.sigma = vec![Matrix::zeros(); start.len()];
    particles.grad_v = vec![Matrix::zeros(); start.len()];
    let lengths = spacing(&start.reference_position.chunks_exact(D), volume);
    particles.spacing = Vector::from_column_slice(&lengths);
    particles.def_grad = tensors.map(Matrix::<D>::from_row_slice).collect();
    Ok(particles)
}

/// Returns the distance between neighbours along each axis of a lattice.
fn spacing<'a>(places: &(impl Iterator<Item = &'a [f64]> + Clone), volume: f64) -> Vec<f64> {
    let d = places.clone().next().map_or(0, <[f64]>::len);
    let along = |axis: usize| {
        let mut all: Vec<f64> = places.clone().map(|place| place[axis]).collect();
        all.sort_by(f64::total_cmp);
        let ends = (all[0], all[all.len() - 1]);
        let near = 1e-6 * volume.powf(1.0 / d as f64);
        all.dedup_by(|a, b| (*a - *b).abs() < near);
        (all.len() > 1).then(|| (ends.1 - ends.0) / (all.len() - 1) as f64)
    };
    let found: Vec<Option<f64>> = (0..d).map(along).collect();
    let known: f64 = found.iter().flatten().product();
    found.into_iter().map(|length| length.unwrap_or(volume / known)).collect()
}

fn effects<const D: usize>(problem: &LevelProblem) -> Vec<Box<dyn Effect<D>>> {
    let Some(field) = &problem.body_force else { return Vec::new() };
    let labels: Vec<&[f64]> = problem.particles.reference_position.chunks_exact(D).collect();
    let mut placed = field.at_places(&vec![0; labels.len()], &labels);
    let mut forces = vec![[0.0; 3]; labels.len()];
    let force = move |t: f64, _: &Particles<D>, into: &mut [Vector<D>]| {
        placed(t, &mut forces);
        for (into, force) in into.iter_mut().zip(&forces) {
            *into = Vector::from_column_slice(&force[..D]);
        }
    };
    vec![Box::new(BodyForce::new(Box::new(force)))]
}

fn law(problem: &LevelProblem) -> Result<MaterialPlan, String> {
    let [material] = &problem.materials[..] else { return Err("several bodies".to_owned()) };
    let parameters = material.parameters.iter().copied().chain([("density", material.density)]);
    let parameters: HashMap<&str, f64> = parameters.collect();
    let spec: Result<MaterialSpec<f64>, _> =
        serde_json::from_value(serde_json::json!({material.law: parameters}));
    spec.map_err(|error| error.to_string())?.numbers(|_, _, number| Ok(*number))
}
