//! Reactions of walls.

use crate::common::{DT, H, body, in_dimension, scattered_stress};
use approx::assert_relative_eq;
use mpm_solvers::mpm::{
    BasisName, Block, Fixed, Matrix, Particles, Prescribed, Roller, SchemeName, Setup, Side,
    Solver, TransferName, Vector,
};
use mpm_subject::{Start, Subject};
use rstest::rstest;

const CELLS: usize = 3;

/// Creates a stressed body that fills the grid.
fn full<const D: usize>(basis: BasisName, scheme: SchemeName) -> Setup<D> {
    let (from, to) = (Vector::zeros(), Vector::from_element(H * CELLS as f64));
    let mut particles = Particles::<D>::fill(&Block { from, to, density: 1.0 }, H, 2);
    for (p, sigma) in particles.sigma.iter_mut().enumerate() {
        *sigma = scattered_stress(p as f64);
    }
    body((basis, TransferName::Flip), scheme, particles, (H, CELLS))
}

/// Without loads, only reactions change the momentum: FLIP with a lumped mass adds the nodal forces
/// to it, and the internal forces cancel.
fn balances<const D: usize>(scheme: SchemeName, start: Start) {
    for basis in [BasisName::Linear, BasisName::QuadraticBSpline, BasisName::ContiguousGimp] {
        let mut setup = Setup { start, ..full::<D>(basis, scheme) };
        setup.boundary.push(Box::new(Roller::face(&setup.grid, D - 1, Side::High)));
        setup.boundary.push(Box::new(Fixed::face(&setup.grid, 0, Side::Low)));
        let mut solver = Solver::new(setup).unwrap();
        assert_eq!(Subject::reaction(&solver, None), None, "no step, no force");
        solver.step(DT).unwrap();
        for step in 1..4 {
            let before = solver.totals().unwrap().momentum;
            solver.step(DT).unwrap();
            let after = solver.totals().unwrap().momentum;
            let reaction = Subject::reaction(&solver, None).unwrap();
            assert_relative_eq!(reaction.time, f64::from(step) * DT, max_relative = 1e-12);
            assert!(reaction.force.iter().any(|f| f.abs() > 1e-4), "{reaction:?}");
            for i in 0..3 {
                let change = (after[i] - before[i]) / DT;
                assert_relative_eq!(reaction.force[i], change, epsilon = 1e-12);
            }
        }
    }
}

#[rstest]
fn reactions_balance_the_change_of_momentum(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
    #[values(Start::AtZero, Start::HalfStepBack)] start: Start,
) {
    in_dimension!(dimension, balances(scheme, start));
}

/// Under uniform stress the reaction of a roller must equal the normal traction of its face, even
/// at the edges. A moving wall has no reaction.
#[test]
fn reaction_of_a_roller_includes_the_traction_on_its_face() {
    let mut setup = full::<2>(BasisName::Linear, SchemeName::Usl);
    let stress = Matrix::<2>::new(0.02, 0.0, 0.0, -0.01);
    setup.particles.sigma.iter_mut().for_each(|sigma| *sigma = stress);
    for (axis, side) in [(0, Side::Low), (1, Side::Low), (0, Side::High)] {
        setup.boundary.push(Box::new(Roller::face(&setup.grid, axis, side)));
    }
    let still = Box::new(|_: &Vector<2>, _| Vector::zeros());
    let top = Prescribed::face(&setup.grid, BasisName::Linear, 1, Side::High, still);
    setup.boundary.push(Box::new(top));
    let mut solver = Solver::new(setup).unwrap();
    solver.step(DT).unwrap();
    let side = CELLS as f64 * H;
    let force = |face| Subject::reaction(&solver, face).unwrap().force;
    for (face, expected) in [
        (Some((0, false)), [-0.02 * side, 0.0]),
        (Some((0, true)), [0.02 * side, 0.0]),
        (Some((1, false)), [0.0, 0.01 * side]),
        (Some((1, true)), [0.0, 0.0]),
        (None, [0.0, 0.01 * side]),
    ] {
        let [x, y, z] = force(face);
        assert_relative_eq!(x, expected[0], epsilon = 1e-14);
        assert_relative_eq!(y, expected[1], epsilon = 1e-14);
        assert_eq!(z, 0.0);
    }
}
