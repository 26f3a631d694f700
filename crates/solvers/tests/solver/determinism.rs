//! Equal set-ups give equal bits for any number of threads, and with other runs at the same time.

use crate::common::columns::columns;
use crate::common::{DT, H, free_body, in_dimension, methods};
use mpm_solvers::mpm::{BasisName, Block, Particles, SchemeName, Solver, TransferName, Vector};
use mpm_subject::Subject;
use rayon::ThreadPoolBuilder;
use rstest::rstest;
use std::sync::Barrier;
use std::thread;

const STEPS: usize = 20;

/// Returns every column of the particles as bits: -0 then differs from 0, and NaN equals NaN.
fn bits<const D: usize>(particles: &Particles<D>) -> Vec<u64> {
    let (temperature, others) = columns(particles);
    temperature.iter().chain(&others).map(|value| value.to_bits()).collect()
}

fn stepped<const D: usize>(method: (BasisName, TransferName), scheme: SchemeName) -> Vec<u64> {
    let mut solver = Solver::new(free_body::<D>(method, scheme)).unwrap();
    (0..STEPS).for_each(|_| solver.step(DT).unwrap());
    bits(solver.particles())
}

fn repeats<const D: usize>() {
    for method in methods() {
        for &scheme in SchemeName::ALL {
            let (first, second) = (stepped::<D>(method, scheme), stepped::<D>(method, scheme));
            assert!(first == second, "{D}-D {method:?} {scheme:?}: two runs differ");
        }
    }
}

#[rstest]
fn second_run_is_bit_identical(#[values(1, 2, 3)] dimension: usize) {
    in_dimension!(dimension, repeats());
}

/// Steps two solvers in lockstep, each on its own thread.
fn ignores_its_neighbour<const D: usize>() {
    for method in methods() {
        for &scheme in SchemeName::ALL {
            let serial = stepped::<D>(method, scheme);
            let together = Barrier::new(2);
            let run = |mut solver: Solver<D>| {
                for _ in 0..STEPS {
                    together.wait();
                    solver.step(DT).unwrap();
                }
                bits(solver.particles())
            };
            let solver = || Solver::new(free_body::<D>(method, scheme)).unwrap();
            let (one, other) = (solver(), solver());
            thread::scope(|scope| {
                let (one, other) = (scope.spawn(|| run(one)), scope.spawn(|| run(other)));
                for parallel in [one.join().unwrap(), other.join().unwrap()] {
                    assert!(parallel == serial, "{D}-D {method:?} {scheme:?}: a thread differs");
                }
            });
        }
    }
}

#[rstest]
fn concurrent_solvers_are_bit_identical_to_one_alone(#[values(1, 2, 3)] dimension: usize) {
    in_dimension!(dimension, ignores_its_neighbour());
}

/// Runs a step of so many particles that `threads` threads share the passes.
fn shared(transfer: TransferName, threads: usize) -> Vec<u64> {
    let cells = 184;
    let mut setup = free_body::<2>((BasisName::QuadraticBSpline, transfer), SchemeName::Musl);
    let (from, to) = (Vector::from_element(2.0 * H), Vector::from_element((cells + 2) as f64 * H));
    setup.particles = Particles::fill(&Block { from, to, density: 1.0 }, H, 2);
    for (x, v) in setup.particles.x.iter().zip(&mut setup.particles.v) {
        *v = Vector::from_fn(|i, _| libm::sin(3.0 * x[i] + x[1 - i]));
    }
    setup.grid = setup.kernel.grid(Vector::zeros(), H, [cells + 4; 2], [false; 2]);
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut solver = Solver::new(setup).unwrap();
        (0..3).for_each(|_| solver.step(DT).unwrap());
        bits(solver.particles())
    })
}

#[rstest]
fn step_on_several_threads_is_bit_identical(
    #[values(TransferName::Flip, TransferName::Apic)] transfer: TransferName,
) {
    let one = shared(transfer, 1);
    for threads in [2, 3] {
        assert!(shared(transfer, threads) == one, "{threads} threads differ from one");
    }
}

#[test]
fn different_states_have_different_bits() {
    let method = methods().next().unwrap();
    let [usf, usl] = [SchemeName::Usf, SchemeName::Usl].map(|s| stepped::<2>(method, s));
    assert!(usf != usl);
}
