//! Angular momentum of a free body (Jiang et al. 2015; problem V10).
//!
//! The contribution of a particle is `m x cross v`, plus the antisymmetric part of `m C D` if it
//! has an affine field.

use crate::common::{H, body};
use mpm_solvers::mpm::{
    BasisName, Block, LinearElastic, Matrix, Particles, SchemeName, Setup, Solver, TransferName,
    Vector,
};
use mpm_subject::Subject;
use rstest::rstest;

const CELLS: usize = 12;
const DT: f64 = 0.01;

/// Creates a cube that rotates about its centre at one radian per second about the last axis, and
/// slowly about the others.
fn turning() -> Particles<3> {
    let side = H * CELLS as f64;
    let centre = Vector::<3>::from_fn(|axis, _| 0.5 * side + 0.01 * axis as f64);
    let (from, to) = (centre.add_scalar(-0.25 * side), centre.add_scalar(0.25 * side));
    let mut particles = Particles::fill(&Block { from, to, density: 2.0 }, H, 2);
    let spin = Matrix::<3>::new(0.0, -1.0, -0.4, 1.0, 0.0, -0.2, 0.4, 0.2, 0.0);
    for p in 0..particles.len() {
        let r = particles.x[p] - centre;
        particles.v[p] = spin * r + Vector::from_fn(|axis, _| 0.02 * axis as f64);
    }
    particles.grad_v.fill(spin);
    particles
}

/// Returns the antisymmetric matrix of `sum_p m_p (v_p x_p^T + C_p D_p)`.
fn angular(solver: &Solver<3>) -> Matrix<3> {
    let (particles, mut sum) = (solver.particles(), Matrix::zeros());
    for p in 0..particles.len() {
        let own = solver.transfer().moment(p).unwrap_or_else(Matrix::zeros);
        sum += (particles.v[p] * particles.x[p].transpose() + own) * particles.mass[p];
    }
    sum - sum.transpose()
}

/// The suite rotating-disk states the angular momentum of all methods in the plane.
#[rstest]
fn angular_momentum_is_conserved_in_3d(
    #[values(BasisName::Linear, BasisName::UniformGimp, BasisName::QuadraticBSpline)]
    basis: BasisName,
    #[values(TransferName::Flip, TransferName::Apic)] name: TransferName,
    #[values(SchemeName::Usl, SchemeName::Usf)] scheme: SchemeName,
) {
    // The material is so soft that no force acts, and only the transfers have an effect.
    let material = Box::new(LinearElastic::new(1e-300, 0.0));
    let setup = Setup { material, ..body((basis, name), scheme, turning(), (H, CELLS)) };
    let mut solver = Solver::new(setup).unwrap();
    let before = angular(&solver);
    for step in 1..=20 {
        solver.step(DT).unwrap();
        let change = (angular(&solver) - before).norm() / before.norm();
        assert!(change <= 1e-12, "{basis:?} {name:?}, step {step}: relative change {change:.1e}");
    }
}
