//! Compares the materials of the solver with the laws of exact solutions, which are implemented
//! independently.

use approx::assert_relative_eq;
use mpm_verify::exact::Equation;
use mpm_verify::mpm::{Block, MaterialPlan, Matrix, Particles, StressUpdate, Vector};

/// Duration (s) of a step so slow that viscous stresses are negligible.
const SLOW: f64 = 1e12;

/// Reference density (kg/m3).
const DENSITY: f64 = 1.25;

/// Returns the law that gives the stress of a material after one step from rest; `None` for a
/// material that yields, or is rigid. In such a step, the strain increment of an objective rate is
/// the logarithmic strain.
fn law_of_one_step(plan: &MaterialPlan) -> Option<Equation> {
    let name = match plan.name() {
        "jaumann" | "green_naghdi" => "hencky",
        "j2" | "drucker_prager" | "mohr_coulomb" | "cam_clay" => return None,
        name => name,
    };
    Equation::of_material(name, |key| plan.parameter(key))
}

/// Compares stress and stored energy of a particle after a step to a deformation with strains of
/// this `size`.
fn agree<const D: usize>(plan: &MaterialPlan, law: &Equation, size: f64) {
    let noise = |i: usize, j: usize| size * libm::sin(0.1 + 7.0 * i as f64 + 11.3 * j as f64);
    let h = Matrix::<D>::from_fn(noise);
    let block = Block { from: Vector::zeros(), to: Vector::from_element(1.0), density: DENSITY };
    let mut body = Particles::<D>::fill(&block, 1.0, 1);
    body.track_deformation();
    (body.def_grad[0], body.grad_v[0]) = (Matrix::identity() + h, h / SLOW);
    let mut material = plan.build::<D>();
    material.update(&mut StressUpdate::new(SLOW, &mut body));
    let within = |i: usize, j: usize| if i.max(j) < D { h[(i, j)] } else { 0.0 };
    let grad = std::array::from_fn(|i| std::array::from_fn(|j| within(i, j)));
    let (stress, factor) = (law.cauchy(&grad), law.density_factor(DENSITY));
    let modulus = factor * law.modulus();
    for (i, j) in (0..D).flat_map(|i| (0..D).map(move |j| (i, j))) {
        assert_relative_eq!(
            body.sigma[0][(i, j)],
            factor * stress[i][j],
            epsilon = 1e-12 * modulus
        );
    }
    // A law in rate form has no energy, or its energy depends on the path.
    if plan.properties().takes_averaged_volume().is_ok() {
        let [found, expected] = [material.energy(&body), law.energy(&grad)].map(Option::unwrap);
        let (expected, epsilon) = (factor * expected, 1e-15 * modulus);
        assert_relative_eq!(found, expected, max_relative = 1e-9, epsilon = epsilon);
    }
}

#[test]
fn materials_agree_with_laws_of_exact_solutions() {
    let plans = MaterialPlan::every(|parameter| match parameter.symbol {
        "nu" => 0.3,
        "g" => 1.4,
        _ => 40.0,
    });
    let mut laws = 0;
    for (plan, law) in plans.iter().filter_map(|plan| Some((plan, law_of_one_step(plan)?))) {
        for size in [0.25, 1e-3] {
            agree::<1>(plan, &law, size);
            agree::<2>(plan, &law, size);
            agree::<3>(plan, &law, size);
        }
        laws += 1;
    }
    assert_eq!(laws, 9, "elastic laws, two rates, fluids and a gas");
}
