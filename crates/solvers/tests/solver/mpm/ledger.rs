//! The energy ledger of a step: its entries must add up to the change of the energy. For classical
//! transfers the entries have closed forms.

use crate::common::{DT, free_body, pairs};
use mpm_solvers::mpm::{
    BasisName, FrameName, NeoHookean, ParticleField, Particles, SchemeName, Setup, Solver,
    TransferName, Vector, kernel, kinetic_energy,
};
use mpm_subject::{EnergyBalance, LedgerStage, Perturbable, Subject};
use rstest::rstest;

/// Maximum difference, relative to the sum of the magnitudes of all entries.
const TOLERANCE: f64 = 1e-13;

/// Creates a free body with scattered particles of unequal mass and a stored energy.
fn scattered<const D: usize>(method: (BasisName, TransferName), scheme: SchemeName) -> Setup<D> {
    let mut setup = free_body::<D>(method, scheme);
    for (p, x0) in setup.particles.x0.iter_mut().enumerate() {
        let k = p as f64;
        *x0 += Vector::from_fn(|i, _| 0.04 * libm::sin(12.3 * k + 4.0 * i as f64));
        setup.particles.mass[p] *= 1.0 + 0.4 * libm::cos(5.7 * k);
    }
    setup.particles.x.clone_from(&setup.particles.x0);
    // The common motion is removed, because its energy is much larger than all entries.
    setup.particles.v.iter_mut().for_each(|v| *v -= Vector::from_element(1.2));
    setup.particles.sigma.fill(nalgebra::SMatrix::zeros());
    setup.particles.track_deformation();
    setup.material = Box::new(NeoHookean::new(1.0, 0.3));
    setup
}

fn balanced<const D: usize>(
    method: (BasisName, TransferName),
    scheme: SchemeName,
    frame: FrameName,
) {
    let setup = Setup { frame, ..scattered::<D>(method, scheme) };
    let mut solver = Solver::new(setup).expect("a solver").with_ledger(method.0);
    let stored = |solver: &Solver<D>| solver.totals().and_then(|totals| totals.strain_energy);
    let start = kinetic_energy(method.0, &solver) + stored(&solver).expect("an energy");
    for step in 1..=5 {
        solver.step(DT).expect("a step");
        let balance = solver.energy_balance().expect("a balance");
        let change = balance.energy() - start;
        let error = (balance.change() - change).abs();
        // An energy is a sum with a term for each node of each particle, which rounds each of its
        // partial sums.
        let terms = (solver.particles().len() * 4_usize.pow(D as u32)) as f64;
        let allowed = TOLERANCE * balance.size() + terms * f64::EPSILON * start;
        assert!(error <= allowed, "{method:?} {scheme:?} step {step}: {error:e} of {change:e}");
    }
    let size = solver.energy_balance().as_ref().map(EnergyBalance::size);
    assert!(size > Some(1e-6 * start), "{method:?}: nothing happens");
}

/// Every basis is combined with every transfer, except TLS, whose nodal masses are not computed
/// from those of the particles.
#[rstest]
fn entries_add_up_to_the_change_of_the_energy(
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
) {
    for method in pairs().filter(|(_, transfer)| *transfer != TransferName::Tls) {
        balanced::<1>(method, scheme, FrameName::Updated);
        balanced::<2>(method, scheme, FrameName::Updated);
    }
}

#[rstest]
fn entries_add_up_on_a_grid_of_the_reference(
    #[values(TransferName::Flip, TransferName::Apic)] transfer: TransferName,
) {
    for basis in [BasisName::Linear, BasisName::QuadraticBSpline] {
        balanced::<2>((basis, transfer), SchemeName::Musl, FrameName::Total);
    }
}

/// Nodal masses, the consistent mass matrix times a field, and the field of a particle map.
struct Maps<'a> {
    basis: BasisName,
    particles: &'a Particles<2>,
    solver: &'a Solver<2>,
}

impl Maps<'_> {
    /// Returns `f.(M - M_c) f/2` for a nodal field.
    fn lost(&self, field: &[Vector<2>]) -> f64 {
        let (grid, kernel) = (self.solver.grid(), kernel::<2>(self.basis));
        let mut sum = 0.0;
        for (mass, f) in grid.mass.iter().zip(field) {
            sum += 0.5 * mass * f.norm_squared();
        }
        kernel.mass_entries(grid, self.particles, &mut |i, j, mass| {
            sum -= 0.5 * mass * field[i].dot(&field[j]);
        });
        sum
    }

    /// Returns `v.m (I - P) v/2` for the velocities of the particles.
    fn filtered(&self) -> f64 {
        let (grid, kernel, v) = (self.solver.grid(), kernel::<2>(self.basis), &self.particles.v);
        let mut nodal = vec![Vector::zeros(); grid.nodes()];
        kernel.p2g_momentum(self.particles, ParticleField { v, affine: None }, grid, &mut nodal);
        for (w, mass) in nodal.iter_mut().zip(&grid.mass) {
            *w = if *mass > 0.0 { *w / *mass } else { Vector::zeros() };
        }
        let mut mapped = v.clone();
        kernel.g2p(grid, &nodal, self.particles, (0.0, 1.0), &mut mapped);
        let of = |((v, mapped), mass): ((&Vector<2>, &Vector<2>), &f64)| {
            0.5 * mass * v.dot(&(v - mapped))
        };
        v.iter().zip(&mapped).zip(&self.particles.mass).map(of).sum()
    }
}

/// The identities are checked after one step of USL, when the grid still has the fields of the
/// step.
#[rstest]
fn classical_transfers_have_closed_forms(
    #[values(BasisName::Linear, BasisName::QuadraticBSpline, BasisName::CubicBSpline)]
    basis: BasisName,
    #[values(TransferName::Flip, TransferName::Pic)] transfer: TransferName,
) {
    let mut solver = Solver::new(scattered::<2>((basis, transfer), SchemeName::Usl)).unwrap();
    // The stress is non-zero from the second step.
    solver.step(DT).unwrap();
    let particles = solver.particles().clone();
    let mut solver = solver.with_ledger(basis);
    solver.step(DT).unwrap();
    let balance = solver.energy_balance().unwrap();
    let maps = Maps { basis, particles: &particles, solver: &solver };
    let near = |found: f64, expected: f64| {
        let error = (found - expected).abs();
        assert!(error <= TOLERANCE * kinetic_energy(basis, &solver), "{found:e}, {expected:e}");
    };
    near(balance.entry(LedgerStage::ParticleToGrid), -maps.filtered());
    let returned =
        balance.entry(LedgerStage::GridToParticle) + balance.entry(LedgerStage::ParticleVelocity);
    let grid = solver.grid();
    if transfer == TransferName::Pic {
        near(returned, -maps.lost(&grid.velocity));
    } else {
        let advance: Vec<Vector<2>> = grid.acceleration.iter().map(|a| a * DT).collect();
        near(returned, maps.filtered() - maps.lost(&advance));
    }
    for nothing in [LedgerStage::NodalVelocity, LedgerStage::Constraints, LedgerStage::Motion] {
        near(balance.entry(nothing), 0.0);
    }
}

/// PIC and APIC replace velocities by mapped ones, so no particle keeps a part of its own velocity.
#[rstest]
fn entry_of_replaced_velocities_is_zero(
    #[values(TransferName::Pic, TransferName::Apic)] transfer: TransferName,
) {
    let basis = BasisName::CubicBSpline;
    let setup = scattered::<2>((basis, transfer), SchemeName::Musl);
    let mut solver = Solver::new(setup).unwrap().with_ledger(basis);
    solver.step(DT).unwrap();
    let (size, balance) = (kinetic_energy(basis, &solver), solver.energy_balance().unwrap());
    assert!(balance.entry(LedgerStage::ParticleVelocity).abs() <= TOLERANCE * size);
    assert!(balance.entry(LedgerStage::GridToParticle) < -1e-9 * size);
}

/// The ledger observes a step and does not change it.
#[test]
fn step_with_a_ledger_is_bit_identical() {
    let method = (BasisName::QuadraticBSpline, TransferName::Apic);
    for scheme in SchemeName::ALL {
        let solver = || Solver::new(scattered::<2>(method, *scheme)).expect("a solver");
        let (mut with, mut without) = (solver().with_ledger(method.0), solver());
        for _ in 0..3 {
            with.step(DT).unwrap();
            without.step(DT).unwrap();
        }
        assert_eq!(with.particles().x, without.particles().x);
        assert_eq!(with.particles().v, without.particles().v);
    }
}

/// A stability study perturbs and freezes a solver with a ledger like one without.
#[test]
fn solver_with_a_ledger_has_the_same_state() {
    let method = (BasisName::CubicBSpline, TransferName::Apic);
    let solver = || Solver::new(scattered::<2>(method, SchemeName::Usl)).expect("a solver");
    let state = |subject: &dyn Perturbable| {
        let mut state = Vec::new();
        subject.state(&mut state);
        state
    };
    let (mut with, mut without) = (solver().with_ledger(method.0), solver());
    assert_eq!(with.energy_balance(), None);
    for subject in [&mut with as &mut dyn Perturbable, &mut without] {
        subject.fix_configuration();
        let start: Vec<f64> = state(subject).iter().map(|number| number * 1.01).collect();
        subject.set_state(&start);
        (0..3).for_each(|_| subject.step(DT).unwrap());
    }
    assert_eq!(state(&with), state(&without));
    let balance = with.energy_balance().expect("a balance");
    let energy = with.totals().and_then(|totals| totals.energy()).expect("an energy");
    assert!(balance.size() > 1e-6 * energy && balance.gap() * balance.size() <= TOLERANCE * energy);
    assert_eq!(balance.entry(LedgerStage::Motion), 0.0);
}

/// FLIP under MUSL conserves the energy of a smooth motion. The error of the stress work decreases
/// with the square of the step, because kinetic and stored energy are taken at the same time.
#[test]
fn the_error_of_the_stress_work_has_order_two_in_the_step() {
    let error = |dt: f64, steps: usize| {
        let method = (BasisName::CubicBSpline, TransferName::Flip);
        let solver = Solver::new(scattered::<1>(method, SchemeName::Musl)).unwrap();
        let mut solver = solver.with_ledger(method.0);
        (0..steps).for_each(|_| solver.step(dt).unwrap());
        let balance = solver.energy_balance().unwrap();
        balance.stress_work_error().abs() / balance.entry(LedgerStage::Stored).abs()
    };
    let (coarse, fine) = (error(4e-3, 50), error(2e-3, 100));
    assert!(coarse < 0.05 && fine < 0.6 * coarse, "{coarse:e}, {fine:e}");
}
