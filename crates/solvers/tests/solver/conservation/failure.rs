//! A failed step names the quantity and the particle, and never panics.

use crate::common::{DT, body, free_body, in_dimension};
use mpm_solvers::mpm::{
    BasisName, Block, LinearElastic, Matrix, Particles, SchemeName, Setup, Solver, TransferName,
    Vector,
};
use mpm_subject::{Failure, Site, Subject};
use rstest::rstest;

const METHOD: (BasisName, TransferName) = (BasisName::Linear, TransferName::Flip);

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

/// Asserts that the tested particle leaves the grid in a step, or that the run goes on.
fn meets<const D: usize>(x: f64, v: f64, dt: f64, leaves: bool) {
    for &scheme in SchemeName::ALL {
        let met = Solver::new(scene::<D>(scheme, x, v)).and_then(|mut solver| solver.step(dt));
        let site = Site::Particle(2);
        match (leaves, &met) {
            (false, Ok(())) => {}
            (true, Err(Failure::LeftDomain { site: at, position })) => {
                assert_eq!((*at, position.len()), (site, D), "{scheme:?}");
            }
            _ => panic!("{D}-D {scheme:?}: leaves: {leaves}, met {met:?}"),
        }
    }
}

#[rstest]
#[case::starts_outside(8.001, 0.0, 0.1, true)]
#[case::is_pushed_over_the_last_face(4.5, 5.0, 1.0, true)]
#[case::is_pushed_over_the_first_face(4.5, -5.0, 1.0, true)]
#[case::moves_for_a_huge_step(4.5, 1.0, 1e30, true)]
#[case::rests_for_a_huge_step(4.5, 0.0, 1e30, false)]
#[case::moves_for_a_tiny_step(4.5, 1.0, 1e-30, false)]
#[case::is_exactly_on_a_node(4.0, 0.1, 0.1, false)]
#[case::coincides_with_another(2.5, 0.1, 0.1, false)]
#[case::is_on_the_last_face(8.0, 0.0, 0.1, false)]
#[case::leaves_the_last_face(8.0, 1e-3, 0.1, true)]
#[case::is_on_the_first_face(0.0, 0.0, 0.1, false)]
fn a_particle_that(
    #[values(1, 2, 3)] dimension: usize,
    #[case] x: f64,
    #[case] v: f64,
    #[case] dt: f64,
    #[case] leaves: bool,
) {
    in_dimension!(dimension, meets(x, v, dt, leaves));
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
fn inverted_particle_and_domain_without_volume_are_reported(#[values(1, 2, 3)] dimension: usize) {
    in_dimension!(dimension, inverts());
    in_dimension!(dimension, a_collapsed_domain_ends_the_run());
}
