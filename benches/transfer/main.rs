//! Time of the particle-node loops: P2G, G2P and the whole step.
//!
//! An identifier has the form `transfer/3d/quadratic/apic/sorted/1e5/p2g`, and any part of it
//! selects benchmarks: `cargo bench --bench transfer -- 3d/quadratic`. `p2g` is mass, momentum and
//! internal force; `g2p` is velocity, gradient and position; `step` is one step of MUSL. The suffix
//! `-2-threads` marks runs on two threads. Every result is checked before it is timed.
//!
//! The short profile has two bases, particles sorted by cell, and one thread. `MPM_BENCH=full` adds
//! the other bases, shuffled particles, 1e6 particles and two threads.

mod check;
#[path = "../common/random.rs"]
mod random;
mod scene;

use check::{check_g2p, check_p2g, checked_solver};
use criterion::{Bencher, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use mpm_verify::mpm::{BasisName, MaterialPlan, SchemeName, TransferName, Vector};
use mpm_verify::subject::Subject;
use random::Random;
use rayon::ThreadPoolBuilder;
use scene::{Method, Order, total};
use std::hint::black_box;
use std::time::Duration;

/// Time step (s), so short that no particle changes its cell in any number of repetitions.
const DT: f64 = 1e-12;

/// A method, and the order and number of its particles.
#[derive(Clone, Copy)]
struct Scene {
    method: (BasisName, TransferName),
    order: Order,
    count: usize,
}

fn p2g<const D: usize>(bencher: &mut Bencher, id: &str, scene: Scene) {
    let (mut method, mut grid, particles) =
        Method::<D>::new(scene.method, scene.order, scene.count);
    check_p2g(id, &mut method, grid.clone(), &particles);
    bencher.iter(|| method.p2g(black_box(&particles), black_box(&mut grid)));
}

fn g2p<const D: usize>(bencher: &mut Bencher, id: &str, scene: Scene) {
    let (mut method, mut grid, mut particles) =
        Method::<D>::new(scene.method, scene.order, scene.count);
    check_g2p(id, &mut method, grid.clone(), &particles);
    let mut random = Random(3);
    grid.velocity.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    grid.acceleration.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    bencher.iter(|| method.g2p(black_box(&grid), DT, black_box(&mut particles)));
}

fn step<const D: usize>(bencher: &mut Bencher, id: &str, scene: Scene) {
    let (method, grid, particles) = Method::<D>::new(scene.method, scene.order, scene.count);
    let material = MaterialPlan::LinearElastic { young: 1.0, poisson: 0.3 };
    let mut solver =
        checked_solver(id, DT, (SchemeName::Musl, material), method, (grid, particles));
    bencher.iter(|| solver.step(black_box(DT)).expect("a later step succeeds"));
    assert_eq!(solver.counters().crossings, Some(0), "{id}: the order of particles must last");
}

fn bench<const D: usize>(criterion: &mut Criterion, scene: Scene, threads: &[usize]) {
    let Scene { method: (basis, transfer), order, count } = scene;
    let (names, order) = (format!("{}/{}", basis.name(), transfer.name()), order.name());
    let id = format!("transfer/{D}d/{names}/{order}/{count:e}");
    let mut group = criterion.benchmark_group(&id);
    group.throughput(Throughput::Elements(total::<D>(count) as u64));
    for &threads in threads {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let suffix = if threads == 1 { String::new() } else { format!("-{threads}-threads") };
        let loops = [
            ("p2g", p2g::<D> as fn(&mut Bencher, &str, Scene)),
            ("g2p", g2p::<D>),
            ("step", step::<D>),
        ];
        for (name, run) in loops {
            let of = BenchmarkId::from_parameter(format!("{name}{suffix}"));
            group.bench_function(of, |bencher| pool.install(|| run(bencher, &id, scene)));
        }
    }
    group.finish();
}

/// Runs the benchmark in one, two and three dimensions.
fn bench_all(criterion: &mut Criterion, scene: Scene, threads: &[usize]) {
    bench::<1>(criterion, scene, threads);
    bench::<2>(criterion, scene, threads);
    bench::<3>(criterion, scene, threads);
}

fn every_method(criterion: &mut Criterion) {
    let is_full = std::env::var("MPM_BENCH").is_ok_and(|profile| profile == "full");
    let short = [BasisName::Linear, BasisName::QuadraticBSpline];
    let bases = if is_full { BasisName::ALL } else { &short };
    for &basis in bases {
        for transfer in [TransferName::Flip, TransferName::Apic] {
            let scene = Scene { method: (basis, transfer), order: Order::Sorted, count: 100_000 };
            if !is_full {
                bench_all(criterion, scene, &[1]);
                continue;
            }
            for order in [Order::Sorted, Order::Shuffled] {
                for count in [100_000, 1_000_000] {
                    bench_all(criterion, Scene { order, count, ..scene }, &[1, 2]);
                }
            }
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(15)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1));
    targets = every_method
}
criterion_main!(benches);
