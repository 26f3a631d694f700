//! Tests of properties that every registered material must have, in 1-D, 2-D and 3-D.

use super::specimen::{DENSITY, FAST, SLOW, Specimen, every, scattered, stress};
use super::{
    COHESION, EXPONENT, FRICTION, FRICTION_ANGLE, LinearElastic, MaterialPlan, POISSON, STRENGTH,
    YIELD,
};
use crate::mpm::foundation::algebra::{Matrix, det};
use approx::{assert_abs_diff_eq, assert_relative_eq};

/// The material added by `docs/exercises/material.md`.
#[allow(unreachable_pub)] // the page has it in a public module
#[path = "../../../../../tests/exercises/st_venant_kirchhoff.rs"]
mod exercise;

/// Returns a rotation about an oblique axis (Rodrigues' formula); the identity in 1-D.
fn rotation<const D: usize>(angle: f64) -> Matrix<D> {
    let w = 1.0 / 3.0_f64.sqrt();
    let spin = match D {
        1 => Matrix::zeros(),
        2 => Matrix::<3>::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        _ => Matrix::<3>::new(0.0, -w, w, w, 0.0, -w, -w, w, 0.0),
    };
    let turn = spin * libm::sin(angle) + spin * spin * (1.0 - libm::cos(angle));
    Matrix::identity() + turn.fixed_view::<D, D>(0, 0)
}

/// Whether the law reads F. The stress of such a law is objective under any rotation in one step.
/// For other laws, a rotation during a step causes an error of second order in the angle.
fn reads_deformation(plan: MaterialPlan) -> bool {
    plan.build::<1>().reads_deformation()
}

/// Returns the stress of an undeformed body at rest.
fn stress_at_rest<const D: usize>(plan: MaterialPlan) -> Matrix<D> {
    if plan.build::<D>().is_stressed_at_rest() {
        Specimen::new(plan).start(&Matrix::identity())
    } else {
        Matrix::zeros()
    }
}

fn no_strain_adds_no_stress<const D: usize>(plan: MaterialPlan) {
    let mut rest = Specimen::<D>::new(plan);
    let stress = stress_at_rest::<D>(plan);
    for dt in [0.0, 1e-3] {
        assert_abs_diff_eq!(rest.flow(&Matrix::zeros(), dt), stress, epsilon = 1e-13);
        assert_eq!(rest.j(), 1.0);
    }
}

fn waves_have_their_speed<const D: usize>(plan: MaterialPlan) {
    let along = |eps: f64| {
        let mut f = Matrix::<D>::identity();
        f[(0, 0)] += eps;
        stress(plan, &f)[(0, 0)]
    };
    let slope = (along(1e-6) - along(-1e-6)) / 2e-6;
    let properties = plan.properties();
    assert_relative_eq!(slope, properties.wave_modulus(DENSITY), max_relative = 1e-8);
    let speed = properties.wave_speed(DENSITY);
    assert_relative_eq!(DENSITY * speed * speed, slope, max_relative = 1e-8);
}

/// Tests `P : dF = dW` with `P = J sigma F^-T`, for large and small strains. The energy is zero at
/// rest, unless the body is under pressure. A law in rate form depends on the path.
fn stress_is_the_derivative_of_the_energy<const D: usize>(plan: MaterialPlan) {
    if plan.properties().takes_averaged_volume().is_err() {
        return;
    }
    let deformed = |f: &Matrix<D>| {
        let mut specimen = Specimen::<D>::new(plan);
        (specimen.deform(f, SLOW), specimen.energy().expect("an energy"))
    };
    if !plan.build::<D>().is_stressed_at_rest() {
        assert_abs_diff_eq!(deformed(&Matrix::identity()).1, 0.0, epsilon = 1e-13);
    }
    for (size, h, seed) in [
        (0.25, 1e-6, 0.1),
        (0.25, 1e-6, 1.7),
        (0.25, 1e-6, 2.9),
        (1e-2, 1e-5, 0.9),
        (1e-6, 1e-7, 0.9),
    ] {
        let f = Matrix::<D>::identity() + scattered(size, seed);
        let direction = scattered::<D>(1.0, seed + 0.5);
        let [low, high] = [-h, h].map(|h| deformed(&(f + direction * h)).1);
        let piola = deformed(&f).0 * f.try_inverse().unwrap().transpose() * det(&f);
        let (work, change) = (piola.dot(&direction), (high - low) / (2.0 * h));
        assert_relative_eq!(work, change, max_relative = 1e-7, epsilon = 1e-7);
    }
}

/// Tests `sigma(Q dF F) = Q sigma(dF F) Q^T` for a step dF and a rotation Q, also after plastic
/// flow in the previous step.
fn rotation_in_a_step_only_rotates_the_stress<const D: usize>(plan: MaterialPlan) {
    let error = |size: f64, angle: f64| {
        let (before, step) = (Matrix::identity() + scattered(0.2, 0.3), scattered(size, 1.1));
        let step = Matrix::identity() + step;
        let q = rotation::<D>(angle);
        let after = |step: Matrix<D>| {
            let mut specimen = Specimen::<D>::new(plan);
            if reads_deformation(plan) {
                specimen.deform(&before, SLOW);
            }
            specimen.deform(&step, 1.0)
        };
        (after(q * step) - q * after(step) * q.transpose()).norm()
    };
    if reads_deformation(plan) {
        assert_abs_diff_eq!(error(0.1, 2.0), 0.0, epsilon = 1e-11);
    } else if D > 1 {
        let (error, half) = (error(1e-3, 1e-3), error(5e-4, 5e-4));
        // A stress that depends only on J has no error due to rotation.
        let is_second_order = error < 1e-13 || (3.9 * half..=4.1 * half).contains(&error);
        assert!(is_second_order, "{plan:?}: {error}, {half}");
    }
}

/// Tests isotropy and frame indifference, `sigma(Q L Q^T + W) = Q sigma(L) Q^T`, for the velocity
/// gradient L and any spin W. For a law that reads F, the test
/// [`rotation_in_a_step_only_rotates_the_stress`] is stronger.
fn spin_only_rotates_the_stress<const D: usize>(plan: MaterialPlan) {
    if reads_deformation(plan) {
        return;
    }
    let rate = |grad_v: Matrix<D>| Specimen::<D>::new(plan).flow(&grad_v, FAST);
    let (l, w, q) = (scattered::<D>(1.0, 0.6), scattered::<D>(1.0, 2.2), rotation::<D>(2.0));
    let turned = q * rate(l) * q.transpose();
    let found = rate(q * l * q.transpose() + w - w.transpose());
    // A step of zero length changes J by a rounding error.
    let rounding = 8.0 * f64::EPSILON * plan.properties().wave_modulus(DENSITY);
    assert_abs_diff_eq!(found, turned, epsilon = 1e-12 * turned.norm() + rounding);
}

/// A step without deformation does not change the stress, even after plastic flow.
fn step_without_deformation_preserves_the_stress<const D: usize>(plan: MaterialPlan) {
    let mut specimen = Specimen::<D>::new(plan);
    let first = specimen.deform(&(Matrix::identity() + scattered(0.25, 0.3)), SLOW);
    let again = specimen.flow(&Matrix::zeros(), SLOW);
    assert_abs_diff_eq!(again, first, epsilon = 1e-11);
}

/// A body that starts deformed has the stress that one step from rest to this deformation causes,
/// up to a relative error proportional to the strain.
fn deformed_start_has_the_stress_of_one_step<const D: usize>(plan: MaterialPlan) {
    if plan.properties().starts_deformed().is_err() {
        return;
    }
    for size in [1e-3, 1e-5] {
        let f = Matrix::<D>::identity() + scattered(size, 0.4);
        let mut specimen = Specimen::new(plan);
        let found = specimen.start(&f);
        assert_relative_eq!(specimen.j(), det(&f), max_relative = 1e-15);
        let way = stress(plan, &f);
        let change = (way - stress_at_rest::<D>(plan)).norm();
        assert!((found - way).norm() <= 9.0 * size * change, "{plan:?}: {found}, {way}");
        assert_eq!(specimen.flow(&Matrix::zeros(), SLOW), found, "{plan:?}: it stays there");
    }
}

/// The stable time step restores states, so a state must include plastic flow and hardening.
fn copied_state_gives_identical_bits<const D: usize>(plan: MaterialPlan) {
    let step = |k: i32| scattered::<D>(0.1, f64::from(k));
    for dt in [SLOW, 1.0, FAST] {
        let mut whole = Specimen::<D>::new(plan);
        (0..3).for_each(|k| _ = whole.flow(&(step(k) / dt), dt));
        let mut other = whole.copied(plan);
        for k in 3..6 {
            let [a, b] = [&mut whole, &mut other].map(|one| one.flow(&(step(k) / dt), dt));
            assert_eq!(a, b, "{plan:?}");
            assert_eq!((whole.energy(), whole.j()), (other.energy(), other.j()), "{plan:?}");
        }
    }
}

fn hold<const D: usize>(plan: MaterialPlan) {
    copied_state_gives_identical_bits::<D>(plan);
    step_without_deformation_preserves_the_stress::<D>(plan);
    deformed_start_has_the_stress_of_one_step::<D>(plan);
    no_strain_adds_no_stress::<D>(plan);
    waves_have_their_speed::<D>(plan);
    rotation_in_a_step_only_rotates_the_stress::<D>(plan);
    spin_only_rotates_the_stress::<D>(plan);
}

#[test]
fn every_material_obeys_its_laws() {
    for plan in every() {
        hold::<1>(plan);
        hold::<2>(plan);
        hold::<3>(plan);
    }
}

#[test]
fn every_stress_is_the_derivative_of_an_energy() {
    let strong = MaterialPlan::every(|parameter| match *parameter {
        POISSON => 0.3,
        YIELD | STRENGTH | COHESION => 1e9,
        FRICTION | FRICTION_ANGLE => 0.1,
        EXPONENT => 5.0 / 3.0,
        _ => 100.0,
    });
    for plan in strong {
        stress_is_the_derivative_of_the_energy::<1>(plan);
        stress_is_the_derivative_of_the_energy::<2>(plan);
        stress_is_the_derivative_of_the_energy::<3>(plan);
    }
}

/// Compares the stress in simple shear with its closed form.
#[test]
fn material_of_the_exercise_has_its_closed_form() {
    let law = exercise::StVenantKirchhoff::new(100.0, 0.3);
    let LinearElastic { lambda, mu } = LinearElastic::new(100.0, 0.3);
    let (gamma, mut f) = (0.4, Matrix::<2>::identity());
    f[(0, 1)] = gamma;
    let stress = Specimen::with(Box::new(law)).deform(&f, SLOW);
    let square = gamma * gamma;
    let across = (0.5 * lambda + mu) * square;
    let along = (0.5 * lambda + 2.0 * mu + across) * square;
    let closed_form = [along, gamma * (mu + across), across];
    for (component, exact) in [(0, 0), (0, 1), (1, 1)].into_iter().zip(closed_form) {
        assert_relative_eq!(stress[component], exact, max_relative = 1e-12);
    }
}
