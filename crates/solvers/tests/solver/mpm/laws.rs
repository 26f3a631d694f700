//! Compares the materials of the solver with the laws of exact solutions, which are implemented
//! independently.

use approx::assert_relative_eq;
use mpm_judge::exact::Equation;
use mpm_solvers::mpm::{Block, MaterialPlan, Matrix, Particles, StressUpdate, Vector};
use rstest::rstest;

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

fn particle<const D: usize>() -> Particles<D> {
    let block = Block { from: Vector::zeros(), to: Vector::from_element(1.0), density: DENSITY };
    let mut particle = Particles::fill(&block, 1.0, 1);
    particle.track_deformation();
    particle
}

/// Compares stress and stored energy of a particle after a step to a deformation with strains of
/// this `size`.
fn agree<const D: usize>(plan: &MaterialPlan, law: &Equation, size: f64) {
    let noise = |i: usize, j: usize| size * libm::sin(0.1 + 7.0 * i as f64 + 11.3 * j as f64);
    let h = Matrix::<D>::from_fn(noise);
    let mut body = particle::<D>();
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
    assert!(laws >= 9, "elastic laws, two rates, fluids and a gas");
}

/// Compares the stress of a material that yields along a path of uniaxial logarithmic strain.
fn yields<const D: usize>(plan: &MaterialPlan, end: f64, steps: u32) {
    let law = Equation::of_material(plan.name(), |key| plan.parameter(key)).unwrap();
    let (mut body, mut material) = (particle::<D>(), plan.build::<D>());
    for step in 1..=steps {
        let stretch = libm::exp(end * f64::from(step) / f64::from(steps));
        body.def_grad[0][(0, 0)] = stretch;
        material.update(&mut StressUpdate::new(1.0, &mut body));
        let mut grad = [[0.0; 3]; 3];
        grad[0][0] = stretch - 1.0;
        let stress = law.cauchy(&grad);
        for i in 0..D {
            let epsilon = 1e-12 * law.modulus();
            assert_relative_eq!(body.sigma[0][(i, i)], stress[i][i], epsilon = epsilon);
        }
    }
}

/// Paths of cones and pyramids in extension end at the apex.
#[rstest]
#[case::j2(HARDENING, &[-0.05, 0.02])]
#[case::drucker_prager(cone(0.3, 0.1, 10.0), &[-0.05, 0.0012, 0.005])]
#[case::associated_cone(cone(0.3, 0.3, 10.0), &[-0.05, 0.0012, 0.005])]
#[case::cone_without_dilation(cone(0.3, 0.0, 10.0), &[-0.05, 0.0012, 0.005])]
#[case::cone_without_strength(cone(0.2, 0.1, 0.0), &[-0.05])]
#[case::mohr_coulomb(pyramid(30.0, 10.0), &[-0.03, 0.001, 0.005])]
#[case::associated_pyramid(pyramid(30.0, 30.0), &[-0.03, 0.001, 0.005])]
#[case::pyramid_without_dilation(pyramid(20.0, 0.0), &[-0.03, 0.001, 0.005])]
#[case::tresca(pyramid(0.0, 0.0), &[-0.03, 0.005])]
fn materials_that_yield_agree_with_laws_of_exact_solutions(
    #[case] plan: MaterialPlan,
    #[case] ends: &[f64],
    #[values(1, 40)] steps: u32,
) {
    for end in ends {
        yields::<1>(&plan, *end, steps);
        yields::<2>(&plan, *end, steps);
        yields::<3>(&plan, *end, steps);
    }
}

const HARDENING: MaterialPlan =
    MaterialPlan::J2 { young: 15e3, poisson: 0.25, r#yield: 10.0, hardening: 2e3 };

fn cone(friction: f64, dilation: f64, strength: f64) -> MaterialPlan {
    let (young, poisson) = (15e3, 0.25);
    MaterialPlan::DruckerPrager { young, poisson, friction, dilation, strength }
}

fn pyramid(friction_angle: f64, dilation_angle: f64) -> MaterialPlan {
    let (young, poisson, cohesion) = (18e3, 0.2, 10.0);
    MaterialPlan::MohrCoulomb { young, poisson, friction_angle, dilation_angle, cohesion }
}
