//! Names become types: the only place that knows every family, and the only one that spells out
//! 1, 2 and 3 dimensions.

use super::{
    conditions::{boundary, of_time, on_sets, periodic, side},
    filling,
    method::Method,
    model::{ConvergencePlan, Scene, SceneFace},
    plan::LevelPlan,
    start::Initial,
    words::EquationName,
};
use crate::{
    exact::{Forcing, Problem, Region, formula::Formula},
    fem::{self, Bar, Sampling},
    mpm::{
        BodyForce, Effect, Gravity, Grid, Kernel, LinearElastic, MaterialPlan, Particles, Solver,
        Traction, Vector, kernel,
    },
    subject::{Start, Subject},
    verify::Quantity,
};

/// Cells that a grid extends beyond a free face of the body, besides a tenth of the body: room for
/// a body that grows.
const SPARE_CELLS: f64 = 2.0;

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

/// Cell size (m) for `cells` cells along the first axis of the grid, or of the body where the
/// suite asks for no grid.
pub(super) fn cell_size(scene: &Scene, cells: u64) -> f64 {
    let (from, to) = scene.grid.as_ref().map_or((&scene.from, &scene.to), |(from, to)| (from, to));
    (to[0] - from[0]) / cells as f64
}

/// Whether a level with cells of size `h` has no particle.
pub(super) fn is_vacant(scene: &Scene, h: f64, per_axis: usize) -> bool {
    fn vacant<const D: usize>(scene: &Scene, h: f64, per_axis: usize) -> bool {
        let origin = Vector::<D>::from_fn(|axis, _| grid_axis(scene, axis, h).0);
        filling::is_empty(scene, &origin, h, per_axis)
    }
    match scene.dimension() {
        1 => vacant::<1>(scene, h, per_axis),
        2 => vacant::<2>(scene, h, per_axis),
        _ => vacant::<3>(scene, h, per_axis),
    }
}

/// Particles along each axis of a cell, if `ppc` is a whole power.
pub(super) fn per_axis(ppc: u64, dimension: usize) -> Option<usize> {
    let root = libm::round(libm::pow(ppc as f64, 1.0 / dimension as f64)) as u64;
    (root > 0 && root.checked_pow(dimension as u32) == Some(ppc)).then_some(root as usize)
}

fn mpm<const D: usize>(
    plan: &ConvergencePlan,
    method: Method,
    level: LevelPlan,
) -> Result<Box<dyn Subject>, String> {
    let Method::Mpm { basis, transfer, scheme, start, mass, frame } = method else {
        return Err("not an MPM method".to_owned());
    };
    let scene = &plan.scene;
    let h = cell_size(scene, level.cells);
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, D)).ok_or("MPM needs particles")?;
    let kernel = kernel::<D>(basis);
    let grid = grid(scene, h, kernel.as_ref());
    let mut particles = filling::particles(scene, &grid.origin, h, per_axis);
    if plan.of == Quantity::DeformationGradient {
        particles.track_deformation();
    }
    Initial::of(plan).put(&mut particles);
    let mut effects = effects(scene, &particles);
    effects.extend(manufactured(plan).map(|made| manufactured_force(made, &particles)));
    effects.extend(on_sets(scene, &particles)?);
    let setup = crate::mpm::Setup {
        kernel,
        transfer: crate::mpm::transfer(transfer),
        mass: crate::mpm::mass_matrix(mass),
        frame,
        material: scene.material.build(),
        effects,
        boundary: boundary(scene, &grid, basis),
        grid,
        particles,
        scheme,
        start,
    };
    let solver = Solver::new(setup).map_err(|failure| failure.to_string())?;
    Ok(Box::new(solver))
}

fn at<const D: usize>(formulas: &[Formula], x0: &Vector<D>, t: f64) -> Vector<D> {
    let mut variables = [0.0; 4];
    variables[..D].copy_from_slice(x0.as_slice());
    variables[D] = t;
    Vector::from_fn(|i, _| formulas.get(i).map_or(0.0, |f| f.eval(&variables[..=D])))
}

/// The problem whose force is manufactured, if it is.
fn manufactured(plan: &ConvergencePlan) -> Option<&Problem> {
    plan.exact.as_ref().filter(|problem| problem.manufactured)
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

/// Where the grid starts on an axis (m), and its number of cells.
pub(super) fn grid_axis(scene: &Scene, axis: usize, h: f64) -> (f64, f64) {
    let (low, high) = match &scene.grid {
        Some((from, to)) => (from[axis], to[axis]),
        None => roomy(scene, axis, h),
    };
    // A whole number of cells but for rounding is that number.
    (low, libm::ceil((high - low) / h * (1.0 - 1e-12)).max(1.0))
}

fn roomy(scene: &Scene, axis: usize, h: f64) -> (f64, f64) {
    let (from, to) = (scene.from[axis], scene.to[axis]);
    let spare = (SPARE_CELLS + libm::ceil(0.1 * (to - from) / h)) * h;
    let held = |i: usize| scene.faces.get(i).is_some_and(|face: &SceneFace| !face.hold.is_free());
    let free = |i: usize| if held(i) { 0.0 } else { spare };
    (from - free(2 * axis), to + free(2 * axis + 1))
}

fn effects<const D: usize>(scene: &Scene, particles: &Particles<D>) -> Vec<Box<dyn Effect<D>>> {
    let mut effects: Vec<Box<dyn Effect<D>>> = Vec::new();
    if let Some(formulas) = &scene.gravity {
        effects.push(Box::new(Gravity(of_time(formulas))));
    }
    if let Some(formulas) = scene.body_force.clone() {
        effects.push(Box::new(BodyForce::pointwise(move |x0, t| at(&formulas, x0, t))));
    }
    for face in &scene.faces {
        if let Some(formulas) = &face.traction {
            let pull = Traction::on(particles, face.axis, side(face), of_time(formulas));
            effects.push(Box::new(pull));
        }
    }
    effects
}

/// The FEM bar of `method`; also what references are made of.
pub(super) fn bar(plan: &ConvergencePlan, method: Method, cells: u64) -> Result<Bar, String> {
    let Method::Fem { element, mass, law, start, sampling } = method else {
        return Err("not an FEM method".to_owned());
    };
    let scene = &plan.scene;
    let (from, to) = (scene.from[0], scene.to[0]);
    let elements = libm::round((to - from) / cell_size(scene, cells)).max(1.0);
    let [deformed, moving] = [Initial::of(plan), Initial::of(plan)];
    let setup = fem::Setup {
        from,
        to,
        cells: elements as usize,
        element,
        mass,
        density: scene.density,
        law: piola(law, &scene.material)?,
        fixed: [&scene.faces[0], &scene.faces[1]].map(|face| !face.hold.is_free()),
        body_force: body_force(scene, manufactured(plan).cloned()),
        traction: [&scene.faces[0], &scene.faces[1]].map(end_traction),
        initial_displacement: Box::new(move |x| deformed.at(&[x]).u[0]),
        initial_velocity: Box::new(move |x| moving.at(&[x]).velocity[0]),
        start,
        sampling,
    };
    Bar::new(setup).map_err(|error| error.to_string())
}

/// Gravity, declared and manufactured force and forces on sets of a bar, if it has any.
fn body_force(scene: &Scene, made: Option<Problem>) -> Option<fem::Load> {
    let scene = scene.clone();
    let stated = scene.gravity.is_some() || scene.body_force.is_some() || !scene.sets.is_empty();
    if !stated && made.is_none() {
        return None;
    }
    let at = move |x: f64, t: f64| {
        let body = (&scene.from[..], &scene.to[..]);
        let on = |set: &Region| set.force_density(0, &[x], t, body) / scene.density;
        let sets: f64 = scene.sets.iter().map(on).sum();
        let declared = scene.body_force.as_ref().map_or(0.0, |b| b[0].eval(&[x, t]));
        declared + scene.gravity.as_ref().map_or(0.0, |b| b[0].eval(&[t])) + sets
    };
    let Some(made) = made else { return Some(fem::pointwise(at)) };
    let mut forcing = None;
    Some(Box::new(move |t, places, values| {
        let labels = || places.iter().map(std::slice::from_ref);
        let forcing = forcing.get_or_insert_with(|| Forcing::new(&made, labels()));
        forcing.at(t, values, |force| force[0]);
        if stated {
            values.iter_mut().zip(places).for_each(|(value, x)| *value += at(*x, t));
        }
    }))
}

/// A suite gives forces along +X; the FEM wants tension, which points outwards.
fn end_traction(face: &SceneFace) -> Option<fem::History> {
    let outwards = if face.high { 1.0 } else { -1.0 };
    let formula = face.traction.as_ref()?.first()?.clone();
    Some(Box::new(move |t| outwards * formula.eval(&[t])))
}

/// P(F) (Pa) of a bar in uniaxial strain.
fn piola(law: EquationName, material: &MaterialPlan) -> Result<fem::Field, String> {
    let (young, poisson) = material.elasticity().ok_or("the material has no Young's modulus")?;
    let material = LinearElastic::new(young, poisson);
    let modulus = material.lambda + 2.0 * material.mu;
    Ok(match law {
        EquationName::SmallStrain => Box::new(move |f| modulus * (f - 1.0)),
        EquationName::LogStrain => Box::new(move |f| modulus * libm::log(f)),
        EquationName::NeoHookean => {
            let LinearElastic { lambda, mu } = material;
            Box::new(move |f| lambda * libm::log(f) / f + mu * (f - 1.0 / f))
        }
        EquationName::Hencky => Box::new(move |f| modulus * libm::log(f) / f),
    })
}

/// The method that a reference is computed with.
pub(super) fn reference_method(plan: &super::model::ReferencePlan) -> Method {
    Method::Fem {
        element: plan.element,
        mass: plan.mass,
        law: plan.equation,
        start: Start::HalfStepBack,
        sampling: Sampling::Inside,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{mpm::Matrix, suite::law};
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// `J sigma F^-T` (Pa) of the MPM's material.
    fn piola_of_mpm<const D: usize>(plan: &MaterialPlan, f: &Matrix<D>) -> Matrix<3> {
        let (from, to) = (Vector::zeros(), Vector::from_element(1.0));
        let mut one = Particles::<D>::fill(&crate::mpm::Block { from, to, density: 1.0 }, 1.0, 1);
        one.track_deformation();
        one.def_grad[0] = *f;
        plan.build().update(0.0, &mut one);
        let mut space = Matrix::<3>::identity();
        space.fixed_view_mut::<D, D>(0, 0).copy_from(f);
        let mut sigma = Matrix::<3>::zeros();
        sigma.fixed_view_mut::<D, D>(0, 0).copy_from(&one.sigma[0]);
        sigma * space.try_inverse().unwrap().transpose() * space.determinant()
    }

    /// A law is written three times, in three ways: no part can agree with another's slip.
    #[rstest]
    #[case(MaterialPlan::NeoHookean { young: 100.0, poisson: 0.3 })]
    #[case(MaterialPlan::Hencky { young: 100.0, poisson: 0.3 })]
    fn mpm_fem_and_truth_mean_the_same_law(#[case] plan: MaterialPlan) {
        let truth = law::manufactured(&plan).unwrap();
        let bar = piola(law::own(&plan).unwrap(), &plan).unwrap();
        for stretch in [0.7, 1.0 + 1e-6, 1.4] {
            let stress = piola_of_mpm(&plan, &Matrix::<1>::new(stretch))[(0, 0)];
            assert_relative_eq!(bar(stretch), stress, max_relative = 1e-9);
        }
        let f = Matrix::<3>::new(1.2, -0.1, 0.05, 0.3, 0.8, 0.1, 0.0, 0.15, 1.1);
        let grad = f - Matrix::identity();
        let stress = truth.piola(&[0, 1, 2].map(|i| [0, 1, 2].map(|j| grad[(i, j)])));
        let expected = piola_of_mpm(&plan, &f);
        for (k, expected) in expected.iter().enumerate() {
            assert_relative_eq!(stress[k % 3][k / 3], *expected, epsilon = 1e-11);
        }
    }
}
