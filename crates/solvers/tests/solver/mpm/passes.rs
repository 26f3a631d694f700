//! Compares the passes of steps.

use crate::common::{DT, H, body};
use mpm_solvers::mpm::{BasisName, Block, Particles, SchemeName, Solver, TransferName, Vector};
use mpm_subject::Subject;
use rstest::rstest;

fn solver(scheme: SchemeName) -> Solver<2> {
    let (from, to) = (Vector::zeros(), Vector::from_element(H * 3.0));
    let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, H, 2);
    for (p, v) in particles.v.iter_mut().enumerate() {
        *v = Vector::<2>::new(libm::sin(p as f64), libm::cos(p as f64)) * 0.01;
    }
    Solver::new(body((BasisName::Linear, TransferName::Flip), scheme, particles, (H, 3))).unwrap()
}

#[rstest]
fn step_by_passes_is_bit_identical_and_names_its_passes(
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
) {
    let (mut whole, mut by_pass) = (solver(scheme), solver(scheme));
    for _ in 0..3 {
        whole.step(DT).unwrap();
        let mut names = Vec::new();
        by_pass.step_by_pass(DT, &mut |name| names.push(name)).unwrap();
        assert_eq!(by_pass.particles().x, whole.particles().x);
        let mut rest = names.iter();
        for listed in whole.passes() {
            assert!(rest.any(|name| *name == listed), "{listed} is not in its place in {names:?}");
        }
    }
}
