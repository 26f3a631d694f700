//! Averaged volume ratios, compared with loops over one particle at a time.

use crate::common::{DT, H, body, free_body};
use mpm_solvers::mpm::{
    Advance, BasisName, Block, Boundary, LinearFluid, Material, Matrix, NeoHookean, Particles,
    SchemeName, Setup, Solver, StressUpdate, TransferName, Vector, VolumeName, det,
};
use mpm_subject::{Column, Failure, Subject};
use rstest::rstest;

/// Creates a free body with averaged volume ratios and a non-uniform strain.
fn averaged<const D: usize>(
    basis: BasisName,
    scheme: SchemeName,
    material: Box<dyn Material<D>>,
) -> Setup<D> {
    let mut setup = free_body::<D>((basis, TransferName::Flip), scheme);
    let particles = &mut setup.particles;
    particles.sigma.fill(Matrix::zeros());
    for (p, (x, v)) in particles.x.iter().zip(&mut particles.v).enumerate() {
        *v = Vector::from_fn(|i, _| libm::sin(7.0 * x[i] + 3.0 * x[(i + 1) % D] + p as f64));
    }
    Setup { material, volume: VolumeName::Averaged, ..setup }
}

/// Computes Jbar of each particle by sums over particles and nodes one by one, with the weights of
/// `before` and the volumes of `after`.
fn textbook<const D: usize>(
    setup: &Setup<D>,
    before: &Particles<D>,
    after: &Particles<D>,
) -> Vec<f64> {
    let mut weighted = before.clone();
    weighted.mass.clone_from(&after.vol0);
    let j: Vec<f64> = after.vol.iter().zip(&after.vol0).map(|(vol, vol0)| vol / vol0).collect();
    let (ones, flat) = (vec![1.0; j.len()], vec![Vector::zeros(); j.len()]);
    let sum = |value: &[f64]| {
        let mut column = vec![0.0; setup.grid.nodes()];
        setup.kernel.p2g_scalar(&weighted, value, &flat, &setup.grid, &mut column);
        column
    };
    let (sums, weights) = (sum(&j), sum(&ones));
    let mean = |(sum, weight): (f64, &f64)| if *weight == 0.0 { 0.0 } else { sum / weight };
    let nodal: Vec<f64> = sums.into_iter().zip(&weights).map(mean).collect();
    let mut means = vec![0.0; j.len()];
    setup.kernel.g2p_scalar(&setup.grid, &nodal, before, 1.0, &mut means);
    means
}

/// Computes sigma of the law at `(Jbar/J)^(1/D) F`, with F and J of the particles.
fn stress_at_average<const D: usize>(
    law: &mut dyn Material<D>,
    particles: &Particles<D>,
    means: &[f64],
) -> Vec<Matrix<D>> {
    let mut copy = particles.clone();
    for (f, mean) in copy.def_grad.iter_mut().zip(means) {
        *f *= libm::pow(mean / det(f), 1.0 / D as f64);
    }
    copy.vol = means.iter().zip(&copy.vol0).map(|(mean, vol0)| mean * vol0).collect();
    law.update(&mut StressUpdate::new(0.0, &mut copy));
    copy.sigma
}

fn solid<const D: usize>() -> Box<dyn Material<D>> {
    Box::new(NeoHookean::new(2.0, 0.45))
}

/// Creates a law that uses the volume ratio only, and does not store F.
fn fluid<const D: usize>() -> Box<dyn Material<D>> {
    Box::new(LinearFluid::new(3.0))
}

fn is_law_of_average<const D: usize>(
    law: fn() -> Box<dyn Material<D>>,
    (basis, scheme): (BasisName, SchemeName),
) {
    let parts = averaged::<D>(basis, scheme, law());
    let mut solver = Solver::new(averaged::<D>(basis, scheme, law())).unwrap();
    let mut spread = 0.0_f64;
    for step in 0..5 {
        let before = solver.particles().clone();
        solver.step(DT).unwrap();
        let after = solver.particles();
        let means = textbook(&parts, &before, after);
        let expected = stress_at_average(law().as_mut(), after, &means);
        for (p, (sigma, expected)) in after.sigma.iter().zip(expected).enumerate() {
            let error = (sigma - expected).norm();
            assert!(error <= 1e-12, "{D}-D {basis:?} {scheme:?}, step {step}, {p}: {error:.1e}");
        }
        let own = after.vol.iter().zip(&after.vol0).map(|(vol, vol0)| vol / vol0);
        let apart = own.clone().fold(0.0, f64::max) - own.fold(f64::INFINITY, f64::min);
        spread = spread.max(apart);
        if !law().reads_deformation() {
            continue;
        }
        for (f, (vol, vol0)) in after.def_grad.iter().zip(after.vol.iter().zip(&after.vol0)) {
            assert!((det(f) - vol / vol0).abs() <= 1e-14, "F and V are the particle's own");
        }
    }
    assert!(solver.totals().unwrap().strain_energy.is_none(), "no energy belongs to the force");
    assert!(spread > 1e-3, "{basis:?}: the volume ratios differ, by {spread:.1e}");
}

#[rstest]
fn stress_uses_the_averaged_volume_ratio(
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
) {
    for &basis in BasisName::ALL {
        let method = (basis, scheme);
        is_law_of_average::<2>(fluid, method);
        is_law_of_average::<3>(fluid, method);
        is_law_of_average::<2>(solid, method);
        is_law_of_average::<3>(solid, method);
    }
}

/// The internal force must use the stress of the average and the particle's own volume. After one
/// USL step from a deformed start, the accelerations must equal those of particles with that
/// stress.
#[test]
fn a_deformed_start_and_its_force_have_averaged_stress_and_own_volumes() {
    for &basis in BasisName::ALL {
        let law = || Box::new(NeoHookean::new(2.0, 0.45));
        let deformed = || {
            let mut setup = averaged::<2>(basis, SchemeName::Usl, law());
            setup.particles.v.fill(Vector::zeros());
            let x0 = setup.particles.x0.clone();
            setup.particles.deform(|p| {
                let f = 0.1 * libm::cos(9.0 * x0[p][0] + 4.0 * x0[p][1] + 2.0 * p as f64);
                (Vector::zeros(), Matrix::<2>::new(1.0 + f, 0.2, -0.1, 1.05 - 0.5 * f))
            });
            setup
        };
        let mut solver = Solver::new(deformed()).unwrap();
        let start = solver.particles().clone();
        let means = textbook(&deformed(), &start, &start);
        let expected = stress_at_average(law().as_mut(), &start, &means);
        for (sigma, expected) in start.sigma.iter().zip(&expected) {
            assert!((sigma - expected).norm() <= 1e-12, "{basis:?}");
        }
        let mut parts = deformed();
        (parts.particles, parts.particles.sigma) = (start.clone(), expected);
        parts.kernel.p2g_internal_force(&parts.particles, &mut parts.grid);
        solver.step(DT).unwrap();
        for (found, expected) in solver.grid().force.iter().zip(&parts.grid.force) {
            assert!((found - expected).norm() <= 1e-13, "{basis:?}");
        }
    }
}

/// A grid whose nodes move with the velocity `rate (x - centre)`.
struct Affine {
    velocity: Vec<Vector<2>>,
}

impl Boundary<2> for Affine {
    fn columns(&self) -> Vec<Column<'_>> {
        Vec::new()
    }

    fn hold_velocity(&self, velocity: &mut [Vector<2>], _: f64) {
        velocity.copy_from_slice(&self.velocity);
    }

    fn hold_acceleration(&self, acceleration: &mut [Vector<2>], _: &Advance) {
        acceleration.fill(Vector::zeros());
    }

    fn clear(&self, field: &mut [Vector<2>]) {
        field.fill(Vector::zeros());
    }
}

/// With a uniform velocity gradient J grows equally everywhere, and so does its mean.
#[rstest]
fn averaging_does_not_change_an_affine_motion(
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
) {
    let rate = Matrix::<2>::new(0.5, 0.3, -0.2, 0.4);
    for &basis in BasisName::ALL {
        let run = |volume: VolumeName| {
            let material = Box::new(NeoHookean::new(1.0, 0.4999));
            let setup = averaged::<2>(basis, scheme, material);
            let place = |node: usize| {
                Vector::from_fn(|axis, _| (setup.grid.index_on_axis(node, axis) as f64 - 3.5) * H)
            };
            let velocity = (0..setup.grid.nodes()).map(|node| rate * place(node)).collect();
            let boundary: Vec<Box<dyn Boundary<2>>> = vec![Box::new(Affine { velocity })];
            let mut solver = Solver::new(Setup { volume, boundary, ..setup }).unwrap();
            (0..40).for_each(|_| solver.step(2.5e-3).unwrap());
            solver
        };
        let (plain, average) = (run(VolumeName::Particle), run(VolumeName::Averaged));
        let (plain, average) = (plain.particles(), average.particles());
        let j = det(&average.def_grad[0]);
        assert!((j - 1.0).abs() > 0.05, "{basis:?}: J = {j}");
        for p in 0..plain.len() {
            let moved = (plain.x[p] - average.x[p]).norm();
            assert!(moved <= 1e-13, "{basis:?} {scheme:?} particle {p}: {moved:.1e}");
            let stress = (plain.sigma[p] - average.sigma[p]).norm() / plain.sigma[p].norm();
            assert!(stress <= 1e-13, "{basis:?} {scheme:?} particle {p}: stress {stress:.1e}");
        }
    }
}

#[test]
fn a_bar_is_refused() {
    let (from, to) = (Vector::<1>::new(1.0), Vector::<1>::new(2.0));
    let bar = Particles::fill(&Block { from, to, density: 1.0 }, 0.5, 2);
    let setup = body((BasisName::Linear, TransferName::Flip), SchemeName::Usl, bar, (0.5, 6));
    let material = Box::new(NeoHookean::new(1.0, 0.3));
    let setup = Setup { material, volume: VolumeName::Averaged, ..setup };
    assert!(matches!(Solver::new(setup), Err(Failure::Solve(_))));
}
