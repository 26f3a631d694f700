//! The MPM of this crate on a changed problem. Its results are converted back.

use super::change::Change;
use mpm_verify::external::{Capabilities, LevelProblem, ProblemNeeds, SolverFactory};
use mpm_verify::mpm::input::MpmMethod;
use mpm_verify::mpm::{
    Block, BodyForce, Boundary, Effect, Fixed, Grid, MaterialParameter, MaterialPlan, Matrix,
    Particles, Roller, Setup, Side, Solver, TransferName, Vector, kernel, mass_matrix,
};
use mpm_verify::subject::{Failure, RunCounters, Samples, Subject, SubjectError, Totals};
use mpm_verify::suite::Method;

/// Creates the solver of one method.
pub(super) struct ChangedSolver {
    pub(super) method: Method,
    pub(super) change: Change,
}

impl SolverFactory for ChangedSolver {
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
            1 => made::<1>(self, problem),
            2 => made::<2>(self, problem),
            _ => made::<3>(self, problem),
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
    factory: &ChangedSolver,
    problem: LevelProblem,
) -> Result<Box<dyn Subject>, SubjectError> {
    let change = factory.change;
    if let Some(why) = change.excluded(&problem) {
        return Err(why.into());
    }
    let Method::Mpm(method) = factory.method else { return Err("no MPM".into()) };
    let MpmMethod { basis, transfer, scheme, start, mass, frame, volume, .. } = method;
    let kernel = kernel::<D>(basis);
    let (origin, h, cells) = grid_of::<D>(&change, &problem);
    let mut periodic = [false; D];
    for (i, is_periodic) in problem.grid.periodic.iter().enumerate() {
        periodic[change.axis(i, D).0] = *is_periodic;
    }
    let grid = kernel.grid(origin, h, cells, periodic);
    let boundary = boundary(&change, &problem, &grid);
    let order = change.order(problem.particles.len());
    let particles = particles_of::<D>(&change, &problem, &order)?;
    let effects = effects(&change, &problem, &order);
    let material = law(&change, &problem)?.build();
    let setup = Setup {
        kernel,
        transfer: transfer.build(),
        mass: mass_matrix(mass),
        frame,
        volume,
        material,
        effects,
        boundary,
        grid,
        particles,
        scheme,
        start,
    };
    let solver = Solver::<D>::new(setup).map_err(|failure| failure.to_string())?;
    Ok(Box::new(ChangedBody { solver, change, problem, order }))
}

/// Returns the lowest corner, the cell size and the numbers of cells of the changed grid.
fn grid_of<const D: usize>(
    change: &Change,
    problem: &LevelProblem,
) -> (Vector<D>, f64, [usize; D]) {
    let grid = &problem.grid;
    let high: Vec<f64> =
        grid.origin.iter().zip(&grid.cells).map(|(x, n)| x + *n as f64 * grid.h).collect();
    let ends = [&grid.origin, &high].map(|corner| change.place(corner, grid.h));
    let mut cells = [0; D];
    for (i, n) in grid.cells.iter().enumerate() {
        let more = usize::from(change.shifted != 0.0);
        cells[change.axis(i, D).0] = *n as usize + more;
    }
    let h = grid.h * change.length;
    let origin = Vector::from_fn(|i, _| ends[0][i].min(ends[1][i]) + change.shifted * h);
    (origin, h, cells)
}

fn boundary<const D: usize>(
    change: &Change,
    problem: &LevelProblem,
    grid: &Grid<D>,
) -> Vec<Box<dyn Boundary<D>>> {
    let mut all: Vec<Box<dyn Boundary<D>>> = Vec::new();
    // If faces share a node, the stronger condition must come last.
    for wanted in ["roller", "fixed"] {
        for face in problem.faces.iter().filter(|face| face.condition == wanted) {
            let (axis, sign) = change.axis(face.axis, D);
            let side = if face.high == (sign > 0.0) { Side::High } else { Side::Low };
            all.push(match wanted {
                "fixed" => Box::new(Fixed::face(grid, axis, side)),
                _ => Box::new(Roller::face(grid, axis, side)),
            });
        }
    }
    all
}

fn particles_of<const D: usize>(
    change: &Change,
    problem: &LevelProblem,
    order: &[usize],
) -> Result<Particles<D>, String> {
    let start = &problem.particles;
    let volume = start.reference_volume.first().copied().ok_or("no particles")?;
    if start.reference_volume.iter().any(|other| *other != volume) {
        return Err("particles of several sizes".to_owned());
    }
    let spacing = spacing(&start.reference_position.chunks_exact(D), volume);
    let to = |v: Vec<f64>| Vector::<D>::from_fn(|i, _| v[i]);
    let place = |p: usize, column: &[f64]| to(change.place(&column[p * D..][..D], problem.grid.h));
    let speed = change.length / change.time;
    let tensor = |p: usize, column: &[f64], scale: f64| {
        let rows = change.tensor(&column[p * D * D..][..D * D], D, scale);
        Matrix::<D>::from_fn(|i, j| rows[i * D + j])
    };
    let mut new = vec![0; order.len()];
    for (p, number) in order.iter().enumerate() {
        new[*number] = p;
    }
    let each = |of: &dyn Fn(usize) -> Vector<D>| new.iter().map(|p| of(*p)).collect::<Vec<_>>();
    let block = Block { from: Vector::<D>::zeros(), to: Vector::from_element(1.0), density: 1.0 };
    let volumes = |column: &[f64]| {
        new.iter().map(|p| column[*p] * change.length.powi(D as i32)).collect::<Vec<f64>>()
    };
    let mut particles = Particles::fill_where(&block, 1.0, 1, |_| false);
    particles.x0 = each(&|p| place(p, &start.reference_position));
    particles.x = each(&|p| place(p, &start.position));
    particles.v = each(&|p| to(change.vector(&start.velocity[p * D..][..D], speed)));
    particles.mass = new.iter().map(|p| start.mass[*p] * change.mass).collect();
    particles.vol0 = volumes(&start.reference_volume);
    particles.vol = volumes(&start.volume);
    particles.sigma = vec![Matrix::zeros(); new.len()];
    particles.grad_v = vec![Matrix::zeros(); new.len()];
    let mut lengths = [0.0; D];
    for (i, length) in spacing.iter().enumerate() {
        lengths[change.axis(i, D).0] = length * change.length;
    }
    particles.spacing = Vector::from_fn(|i, _| lengths[i]);
    particles.def_grad = new.iter().map(|p| tensor(*p, &start.deformation_gradient, 1.0)).collect();
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

/// Creates the effects. Positions and times are converted back before the body force is evaluated.
fn effects<const D: usize>(
    change: &Change,
    problem: &LevelProblem,
    order: &[usize],
) -> Vec<Box<dyn Effect<D>>> {
    let Some(field) = &problem.body_force else { return Vec::new() };
    let labels: Vec<&[f64]> = problem.particles.reference_position.chunks_exact(D).collect();
    let mut placed = field.at_places(&vec![0; labels.len()], &labels);
    let (change, order) = (*change, order.to_vec());
    let scale = change.length / (change.time * change.time);
    let mut forces = vec![[0.0; 3]; labels.len()];
    let force = move |t: f64, _: &Particles<D>, into: &mut [Vector<D>]| {
        placed(t / change.time, &mut forces);
        for (force, number) in forces.iter().zip(&order) {
            let changed = change.vector(&force[..D], scale);
            into[*number] = Vector::from_fn(|i, _| changed[i]);
        }
    };
    vec![Box::new(BodyForce::new(Box::new(force)))]
}

/// Converts the law to the changed units.
fn law(change: &Change, problem: &LevelProblem) -> Result<MaterialPlan, String> {
    let [material] = &problem.materials[..] else { return Err("several bodies".to_owned()) };
    let ones = MaterialPlan::every(|_| 1.0);
    let one = ones.iter().find(|plan| plan.name() == material.law).ok_or("an unknown law")?;
    let stress = change.stress(problem.dimension);
    let unit = |parameter: &MaterialParameter| match parameter.unit {
        "Pa" => stress,
        "Pa s" => stress * change.time,
        "kg/m3" => change.mass / change.length.powi(problem.dimension as i32),
        _ => 1.0,
    };
    let keys = one.keyed_parameters().into_iter().map(|(key, _)| key);
    let known: Vec<(&str, f64)> = one
        .parameters()
        .iter()
        .zip(keys)
        .map(|((parameter, _), key)| (parameter.what, material.parameter(key) * unit(parameter)))
        .collect();
    let value = |parameter: &MaterialParameter| {
        known.iter().find(|(what, _)| *what == parameter.what).map_or(1.0, |(_, value)| *value)
    };
    let all = MaterialPlan::every(value);
    all.into_iter().find(|plan| plan.name() == material.law).ok_or("an unknown law".to_owned())
}

/// A body in a changed problem.
struct ChangedBody<const D: usize> {
    solver: Solver<D>,
    change: Change,
    problem: LevelProblem,
    order: Vec<usize>,
}

impl<const D: usize> Subject for ChangedBody<D> {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.solver.step(dt * self.change.time)
    }

    fn sample(&self, samples: &mut Samples) {
        let (change, start) = (&self.change, &self.problem.particles);
        let mut found = Samples::default();
        self.solver.sample(&mut found);
        samples.restart(D);
        let (length, speed) = (1.0 / change.length, change.time / change.length);
        for (p, number) in self.order.iter().enumerate() {
            let of = |column: &[f64], scale: f64| change.vector(&column[number * D..][..D], scale);
            let label = &start.reference_position[p * D..][..D];
            let (u, v) = (of(&found.displacement, length), of(&found.velocity, speed));
            samples.push(label, &u, &v, start.reference_volume[p]);
            let stress = 1.0 / change.stress(D);
            for (from, into, scale) in [
                (&found.stress, &mut samples.stress, stress),
                (&found.deformation_gradient, &mut samples.deformation_gradient, 1.0),
            ] {
                if !from.is_empty() {
                    let rows = &from[number * D * D..][..D * D];
                    into.extend(change.tensor(rows, D, scale));
                }
            }
        }
    }

    fn counters(&self) -> RunCounters {
        self.solver.counters()
    }

    /// Computes sums over the samples, about the origin of the original problem.
    fn totals(&self) -> Option<Totals> {
        let mut samples = Samples::default();
        self.sample(&mut samples);
        let mut totals = Totals::default();
        for (p, mass) in self.problem.particles.mass.iter().enumerate() {
            let at = |column: &[f64], i: usize| if i < D { column[p * D + i] } else { 0.0 };
            let v: [f64; 3] = std::array::from_fn(|i| at(&samples.velocity, i));
            let x: [f64; 3] =
                std::array::from_fn(|i| at(&samples.label, i) + at(&samples.displacement, i));
            let spin =
                [x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]];
            totals.add(*mass, v, spin.map(|spin| mass * spin));
        }
        let stored = self.solver.totals().and_then(|totals| totals.strain_energy);
        Some(Totals { strain_energy: stored.map(|e| e / self.change.energy()), ..totals })
    }
}
