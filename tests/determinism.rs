//! The same set-up gives the same bits, whoever computes it and what else runs meanwhile.

#[path = "common/columns.rs"]
mod columns;
mod common;

use columns::columns;
use common::{DT, free_body, in_dimension, methods};
use mpm_verify::{
    mpm::{BasisName, Particles, SchemeName, Solver, TransferName},
    subject::Subject,
};
use rstest::rstest;
use std::{sync::Barrier, thread};

const STEPS: usize = 20;

/// Every column of the particles, as bits: so that -0 is not 0 and NaN is itself.
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
fn a_second_run_repeats_every_bit(#[values(1, 2, 3)] dimension: usize) {
    in_dimension!(dimension, repeats());
}

/// Two solvers, made here and stepped on two threads in lockstep.
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
fn two_solvers_at_once_give_the_bits_of_one_alone(#[values(1, 2, 3)] dimension: usize) {
    in_dimension!(dimension, ignores_its_neighbour());
}

#[test]
fn the_bits_do_tell_two_states_apart() {
    let method = methods().next().unwrap();
    let [usf, usl] = [SchemeName::Usf, SchemeName::Usl].map(|s| stepped::<2>(method, s));
    assert!(usf != usl);
}
