//! The stable time step, including the stiffness of effects.

use crate::common;
use approx::assert_relative_eq;
use mpm_solvers::mpm::{
    ArtificialViscosity, BasisName, Block, BodyForce, Effect, MaterialPlan, Particles, SchemeName,
    Solver, TransferChoice, TransferName, Vector, simplest_with_same_response,
};
use rstest::rstest;

/// Returns the stable time step (s) of a square with c = 1 m/s in a grid of unit cells, with an
/// effect.
fn step(material: MaterialPlan, effect: impl Effect<2> + 'static) -> f64 {
    let (from, to) = (Vector::from_element(1.0), Vector::from_element(5.0));
    let particles = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, 2);
    let method = (BasisName::Linear, TransferName::Flip);
    let mut setup = common::body(method, SchemeName::Usl, particles, (1.0, 6));
    setup.material = material.build();
    setup.effects.push(Box::new(effect));
    Solver::new(setup).unwrap().stable_time_step(10.0, 60).unwrap()
}

/// A viscosity must shorten the step equally for a law in rate form, which adds the viscous stress
/// to the stored stress, and for a law of F.
#[test]
fn viscosity_counts_once_for_any_law() {
    let viscous = |material, linear| {
        let (quadratic, length, speed) = (0.0, 1.0, 1.0);
        step(material, ArtificialViscosity { linear, quadratic, length, speed, q: Vec::new() })
    };
    let in_rate = MaterialPlan::LinearElastic { young: 1.0, poisson: 0.0 };
    let of_deformation = MaterialPlan::NeoHookean { young: 1.0, poisson: 0.0 };
    for linear in [0.0, 0.5, 2.0] {
        let (found, expected) = (viscous(in_rate, linear), viscous(of_deformation, linear));
        assert_relative_eq!(found, expected, max_relative = 0.01);
    }
}

/// A load that depends on the displacement must increase `2/dt^2` by its stiffness per mass.
#[test]
fn a_foundation_counts_by_its_stiffness() {
    let solid = MaterialPlan::LinearElastic { young: 1.0, poisson: 0.0 };
    let square = |stiffness| {
        let foundation = BodyForce::pointwise(|_, _| Vector::zeros()).with_stiffness(stiffness);
        2.0 / step(solid, foundation).powi(2)
    };
    assert_relative_eq!(square(3.0) - square(0.0), 3.0, max_relative = 1e-3);
}

/// Methods that are declared to have the same response share predictions, so their steps must have
/// the same bits. Some methods have another response, so the test would detect a wrong declaration.
#[rstest]
fn methods_with_the_same_response_have_equal_steps(
    #[values(
        BasisName::Linear,
        BasisName::ContiguousGimp,
        BasisName::Cpdi,
        BasisName::CubicBSpline
    )]
    basis: BasisName,
) {
    let step = |(scheme, transfer): (SchemeName, TransferChoice)| {
        let (from, to) = (Vector::<2>::new(1.2, 1.1), Vector::<2>::new(3.9, 4.2));
        let mut particles = Particles::fill(&Block { from, to, density: 2.0 }, 0.5, 2);
        for (v, x) in particles.v.iter_mut().zip(&particles.x) {
            *v = Vector::<2>::new(0.1 * x[1], -0.2 * x[0]);
        }
        let mut setup = common::body((basis, TransferName::Flip), scheme, particles, (0.5, 10));
        setup.transfer = transfer.build();
        setup.material = MaterialPlan::NeoHookean { young: 3.0, poisson: 0.2 }.build();
        Solver::new(setup).unwrap().stable_time_step(10.0, 6).unwrap()
    };
    let mut distinct = Vec::new();
    let transfers = TransferName::ALL.iter().map(|name| TransferChoice::from(*name));
    for (transfer, &scheme) in transfers.flat_map(|t| SchemeName::ALL.iter().map(move |s| (t, s))) {
        let found = step((scheme, transfer));
        let shared = step(simplest_with_same_response(scheme, transfer));
        assert_eq!(found.to_bits(), shared.to_bits(), "{} {}", scheme.name(), transfer.name());
        distinct.push(found.to_bits());
    }
    distinct.sort_unstable();
    distinct.dedup();
    assert!(distinct.len() > 1, "no method differs from another");
}
