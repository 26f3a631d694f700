//! Equal set-ups give equal bits for any number of threads, and with other runs at the same time.

use crate::common::columns::columns;
use crate::common::{DT, H, free_body, in_dimension, methods};
use mpm_solvers::mpm::{
    BasisName, Block, NeoHookean, Particles, SchemeName, Solver, TransferName, Vector, VolumeName,
};
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

/// Runs steps of so many particles that `threads` threads share the passes.
fn shared(transfer: TransferName, volume: VolumeName, threads: usize) -> Vec<u64> {
    let cells = 184;
    let mut setup = free_body::<2>((BasisName::QuadraticBSpline, transfer), SchemeName::Musl);
    let (from, to) = (Vector::from_element(2.0 * H), Vector::from_element((cells + 2) as f64 * H));
    setup.particles = Particles::fill(&Block { from, to, density: 1.0 }, H, 2);
    for (x, v) in setup.particles.x.iter().zip(&mut setup.particles.v) {
        *v = Vector::from_fn(|i, _| libm::sin(3.0 * x[i] + x[1 - i]));
    }
    setup.grid = setup.kernel.grid(Vector::zeros(), H, [cells + 4; 2], [false; 2]);
    (setup.material, setup.volume) = (Box::new(NeoHookean::new(2.0, 0.4)), volume);
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
    #[values(VolumeName::Particle, VolumeName::Averaged)] volume: VolumeName,
) {
    let one = shared(transfer, volume, 1);
    for threads in [2, 3] {
        assert!(shared(transfer, volume, threads) == one, "{threads} threads differ from one");
    }
}

#[rstest]
fn step_by_passes_is_bit_identical_and_names_its_passes(
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
) {
    let method = (BasisName::Linear, TransferName::Flip);
    let solver = || Solver::new(free_body::<2>(method, scheme)).unwrap();
    let (mut whole, mut by_pass) = (solver(), solver());
    for _ in 0..3 {
        whole.step(DT).unwrap();
        let mut names = Vec::new();
        by_pass.step_by_pass(DT, &mut |name| names.push(name)).unwrap();
        assert!(bits(by_pass.particles()) == bits(whole.particles()));
        let mut rest = names.iter();
        for listed in whole.passes() {
            assert!(rest.any(|name| *name == listed), "{listed} is not in its place in {names:?}");
        }
    }
}
