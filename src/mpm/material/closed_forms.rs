//! The closed forms of each material's stress. A `match` without a default asks every new one.

use super::{
    MaterialPlan,
    specimen::{FAST, SLOW, Specimen, diagonal, every, lame, stress},
};
use crate::mpm::algebra::Matrix;
use approx::{assert_abs_diff_eq, assert_relative_eq};
use rstest::rstest;

const GAMMA: f64 = 0.4;

/// The three stresses of the plane under simple shear: (11, 12, 22).
fn sheared<const D: usize>(plan: MaterialPlan) -> [f64; 3] {
    let mut f = Matrix::<D>::identity();
    f[(0, 1)] = GAMMA;
    let sigma = stress(plan, &f);
    [sigma[(0, 0)], sigma[(0, 1)], sigma[(1, 1)]]
}

/// With `e = asinh(gamma/2)` the axes of simple shear stretch by `exp(e)` and `exp(-e)`.
#[test]
fn simple_shear_has_its_closed_forms() {
    for plan in every() {
        let e = libm::asinh(0.5 * GAMMA);
        let expected = match plan {
            MaterialPlan::LinearElastic { young, poisson } => {
                [0.0, lame(young, poisson).1 * GAMMA, 0.0]
            }
            MaterialPlan::NeoHookean { young, poisson } => {
                let mu = lame(young, poisson).1;
                [mu * GAMMA * GAMMA, mu * GAMMA, 0.0]
            }
            MaterialPlan::Hencky { young, poisson } => {
                let mu = lame(young, poisson).1;
                let normal = 2.0 * mu * e * libm::tanh(e);
                [normal, 2.0 * mu * e / libm::cosh(e), -normal]
            }
            // The same axes, but the deviator ends on the yield surface.
            MaterialPlan::J2 { young, poisson, r#yield, hardening } => {
                let mu = lame(young, poisson).1;
                let trial = 2.0 * 3.0_f64.sqrt() * mu * e;
                let flow = (trial - r#yield) / (3.0 * mu + hardening);
                let shear = (r#yield + hardening * flow) / 3.0_f64.sqrt();
                [shear * libm::tanh(e), shear / libm::cosh(e), -shear * libm::tanh(e)]
            }
            MaterialPlan::Newtonian { .. } | MaterialPlan::Rigid {} => [0.0; 3],
        };
        for found in [sheared::<2>(plan), sheared::<3>(plan)] {
            for (found, expected) in found.iter().zip(expected) {
                assert_abs_diff_eq!(*found, expected, epsilon = 1e-12);
            }
        }
    }
}

/// Along and across a uniaxial stretch, the others held.
#[test]
fn stretch_has_its_closed_forms() {
    let stretch = 1.3;
    let log = libm::log(stretch);
    for plan in every() {
        let (along, across) = match plan {
            MaterialPlan::LinearElastic { young, poisson } => {
                let (lambda, mu) = lame(young, poisson);
                ((lambda + 2.0 * mu) * (stretch - 1.0), lambda * (stretch - 1.0))
            }
            MaterialPlan::NeoHookean { young, poisson } => {
                let (lambda, mu) = lame(young, poisson);
                let across = lambda * log / stretch;
                (across + mu * (stretch - 1.0 / stretch), across)
            }
            MaterialPlan::Hencky { young, poisson } => {
                let (lambda, mu) = lame(young, poisson);
                ((lambda + 2.0 * mu) * log / stretch, lambda * log / stretch)
            }
            // A history, below.
            MaterialPlan::J2 { .. } => continue,
            MaterialPlan::Newtonian { bulk, .. } => {
                let pressure = bulk / 7.0 * (libm::pow(stretch, -7.0) - 1.0);
                (-pressure, -pressure)
            }
            MaterialPlan::Rigid {} => (0.0, 0.0),
        };
        assert_relative_eq!(stress(plan, &diagonal::<1>(stretch))[0], along, epsilon = 1e-12);
        let plane = stress(plan, &diagonal::<2>(stretch));
        let space = stress(plan, &diagonal::<3>(stretch));
        for found in [plane[(0, 0)], space[(0, 0)]] {
            assert_relative_eq!(found, along, epsilon = 1e-12);
        }
        for found in [plane[(1, 1)], space[(1, 1)], space[(2, 2)]] {
            assert_relative_eq!(found, across, epsilon = 1e-12);
        }
    }
}

/// Uniaxial strain of a plastic solid: elastic to `Y/(2 mu)`, then `d tau_1 = K d eps` and
/// `tau_1 - tau_2 = Y` but for hardening (benchmark V18, in Kirchhoff stress and logarithmic
/// strain); unloading is elastic again, until it yields the other way round.
#[rstest]
fn plastic_uniaxial_strain_has_its_closed_form(#[values(0.0, 40.0)] hardening: f64) {
    pull::<1>(hardening);
    pull::<2>(hardening);
    pull::<3>(hardening);
}

fn pull<const D: usize>(hardening: f64) {
    let (young, poisson, strength) = (100.0, 0.3, 3.0);
    let plan = MaterialPlan::J2 { young, poisson, r#yield: strength, hardening };
    let (lambda, mu) = lame(young, poisson);
    let bulk = lambda + 2.0 / 3.0 * mu;
    let mut solid = Specimen::<D>::new(plan);
    let step = 0.004;
    let mut check = |eps: f64, step: f64, gap: f64| {
        let sigma = solid.deform(&diagonal(libm::exp(step)), SLOW) * libm::exp(eps);
        assert_relative_eq!(sigma[(0, 0)], bulk * eps + 2.0 / 3.0 * gap, epsilon = 1e-11);
        if D > 1 {
            assert_relative_eq!(sigma[(0, 0)] - sigma[(D - 1, D - 1)], gap, epsilon = 1e-11);
        }
    };
    let (mut eps, mut gap) = (0.0, 0.0);
    for _ in 0..40 {
        eps += step;
        let flow = (2.0 * mu * eps - strength) / (3.0 * mu + hardening);
        gap = (2.0 * mu * eps).min(strength + hardening * flow);
        check(eps, step, gap);
    }
    assert!(gap >= strength && eps > 3.0 * strength / (2.0 * mu), "most of it was plastic");
    check(eps - 0.02, -0.02, gap - 2.0 * mu * 0.02);
    let flow = (gap - strength) / hardening.max(1.0);
    let back = 0.2;
    let more = (2.0 * mu * back - gap - strength - hardening * flow) / (3.0 * mu + hardening);
    check(eps - back, 0.02 - back, -(strength + hardening * (flow + more)));
}

#[test]
fn a_fluid_resists_shear_and_dilation_by_its_viscosity() {
    let fluid = MaterialPlan::Newtonian { bulk: 50.0, viscosity: 0.7 };
    let grad_v = Matrix::<2>::new(3.0, 2.0, 0.0, 0.0);
    let sigma = Specimen::new(fluid).flow(&grad_v, FAST);
    let expected = Matrix::<2>::new(4.0 / 3.0 * 3.0, 2.0, 2.0, -2.0 / 3.0 * 3.0) * 0.7;
    assert_abs_diff_eq!(sigma, expected, epsilon = 1e-9);
    let along = Specimen::new(fluid).flow(&Matrix::<1>::new(3.0), FAST)[0];
    assert_abs_diff_eq!(along, 2.8, epsilon = 1e-9);
}
