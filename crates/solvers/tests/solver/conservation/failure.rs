//! A failed step names the quantity and the particle, and never panics.

use crate::common::{DT, body, free_body, in_dimension};
use mpm_solvers::mpm::{
    BasisName, Block, LinearElastic, Matrix, Particles, SchemeName, Setup, Solver, TransferName,
    Vector,
};
use mpm_subject::{Failure, Samples, Site, Subject};
use proptest::prelude::*;
use rstest::rstest;

const METHOD: (BasisName, TransferName) = (BasisName::Linear, TransferName::Flip);

/// Result of a step for the tested particle.
#[derive(Debug)]
enum Fate {
    GoesOn,
    Leaves,
}

/// Creates four particles in a grid of eight unit cells a side, so far apart that no two of them
/// have a common node. Particle 2 is tested: it is at `x` and has the velocity `v` along every
/// axis.
fn scene<const D: usize>(scheme: SchemeName, x: f64, v: f64) -> Setup<D> {
    let block = Block { from: Vector::zeros(), to: Vector::<D>::from_element(1.0), density: 1.0 };
    let mut particles = Particles::fill(&block, 1.0, 4);
    let places = [0.5, 2.5, x, 6.5].map(Vector::from_element);
    for column in [&mut particles.x, &mut particles.x0] {
        *column = places.to_vec();
    }
    particles.v = [0.0, 0.0, v, 0.0].map(Vector::from_element).to_vec();
    for column in [&mut particles.mass, &mut particles.vol, &mut particles.vol0] {
        column.resize(4, 1.0);
        column.fill(1.0);
    }
    particles.sigma = vec![Matrix::zeros(); 4];
    particles.grad_v = vec![Matrix::zeros(); 4];
    let material = Box::new(LinearElastic::new(1.0, 0.0));
    Setup { material, ..body(METHOD, scheme, particles, (1.0, 8)) }
}

fn meets<const D: usize>(x: f64, v: f64, dt: f64, fate: &Fate) {
    for &scheme in SchemeName::ALL {
        let met = Solver::new(scene::<D>(scheme, x, v)).and_then(|mut solver| solver.step(dt));
        let site = Site::Particle(2);
        match (fate, &met) {
            (Fate::GoesOn, Ok(())) => {}
            (Fate::Leaves, Err(Failure::LeftDomain { site: at, position })) => {
                assert_eq!((*at, position.len()), (site, D), "{scheme:?}");
            }
            _ => panic!("{D}-D {scheme:?}: expected {fate:?}, met {met:?}"),
        }
    }
}

#[rstest]
#[case::starts_outside(8.001, 0.0, 0.1, Fate::Leaves)]
#[case::is_pushed_over_the_last_face(4.5, 5.0, 1.0, Fate::Leaves)]
#[case::is_pushed_over_the_first_face(4.5, -5.0, 1.0, Fate::Leaves)]
#[case::moves_for_a_huge_step(4.5, 1.0, 1e30, Fate::Leaves)]
#[case::rests_for_a_huge_step(4.5, 0.0, 1e30, Fate::GoesOn)]
#[case::moves_for_a_tiny_step(4.5, 1.0, 1e-30, Fate::GoesOn)]
#[case::is_exactly_on_a_node(4.0, 0.1, 0.1, Fate::GoesOn)]
#[case::coincides_with_another(2.5, 0.1, 0.1, Fate::GoesOn)]
#[case::is_on_the_last_face(8.0, 0.0, 0.1, Fate::GoesOn)]
#[case::leaves_the_last_face(8.0, 1e-3, 0.1, Fate::Leaves)]
#[case::is_on_the_first_face(0.0, 0.0, 0.1, Fate::GoesOn)]
fn a_particle_that(
    #[values(1, 2, 3)] dimension: usize,
    #[case] x: f64,
    #[case] v: f64,
    #[case] dt: f64,
    #[case] fate: Fate,
) {
    in_dimension!(dimension, meets(x, v, dt, &fate));
}

/// Particles 2 and 3 collide inside one cell, faster than the step can resolve.
fn inverts<const D: usize>() {
    for &scheme in SchemeName::ALL {
        let mut setup = scene::<D>(scheme, 4.5, 0.0);
        for (p, (along, speed)) in [(2, (4.25, 1.0)), (3, (4.75, -1.0))] {
            setup.particles.x[p] = Vector::from_element(4.5);
            setup.particles.x[p][0] = along;
            setup.particles.v[p][0] = speed;
        }
        match Solver::new(setup).unwrap().step(4.0) {
            Err(Failure::Inverted { site: Site::Particle(2), j }) => assert!(j < 0.0),
            met => panic!("{D}-D {scheme:?}: {met:?}"),
        }
    }
}

#[rstest]
fn inverted_particle_is_reported(#[values(1, 2, 3)] dimension: usize) {
    in_dimension!(dimension, inverts());
}

/// Only domains that follow the deformation use F; their gradient is undefined for this F.
fn a_collapsed_domain_ends_the_run<const D: usize>() {
    for basis in [BasisName::ContiguousGimp, BasisName::Cpdi] {
        for &scheme in SchemeName::ALL {
            let mut setup = free_body::<D>((basis, METHOD.1), scheme);
            setup.particles.spacing.fill(0.0);
            match Solver::new(setup).unwrap().step(DT) {
                Err(Failure::NonFinite { quantity: "J" | "position", .. }) => {}
                met => panic!("{D}-D {basis:?} {scheme:?}: {met:?}"),
            }
        }
    }
}

#[rstest]
fn domain_without_volume_is_reported(#[values(1, 2, 3)] dimension: usize) {
    in_dimension!(dimension, a_collapsed_domain_ends_the_run());
}

fn survives<const D: usize>(scheme: SchemeName, [x, v, sigma, dt]: [f64; 4]) {
    let mut setup = scene::<D>(scheme, x, v);
    setup.particles.sigma[2].fill(sigma);
    let Ok(mut solver) = Solver::new(setup) else { return };
    let mut samples = Samples::default();
    while solver.counters().transfers < 1000 && solver.step(dt).is_ok() {
        solver.sample(&mut samples);
        let seen = samples.displacement.iter().chain(&samples.velocity);
        assert!(seen.copied().all(f64::is_finite), "{D}-D {scheme:?}: {samples:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(3000) })]

    #[test]
    fn no_state_or_step_causes_a_panic_or_a_silent_nan(
        dimension in 1..=3_usize,
        scheme in prop::sample::select(SchemeName::ALL),
        x in prop_oneof![4 => 0.0..=8.0_f64, 1 => prop::num::f64::ANY],
        v in prop::num::f64::ANY,
        sigma in prop::num::f64::ANY,
        dt in prop::num::f64::ANY,
    ) {
        in_dimension!(dimension, survives(scheme, [x, v, sigma, dt]));
    }
}
