//! Time of whole steps, as users experience it.
//!
//! An identifier has the form `step/3d/quadratic_bspline/mls/usl/neo_hookean/1e4`, and any part of
//! it selects benchmarks: `cargo bench --bench step -- 3d/quadratic_bspline`.
//! `cargo bench --bench scaling` uses a million particles and more, and `cargo bench --bench ratio`
//! compares with plain loops. Each method first makes one step to check conservation of momentum.
//!
//! The short profile varies the transfer and the scheme, and then the law of one method.
//! `MPM_BENCH=full` measures every basis, transfer, scheme and law, also with 1e2 and 1e5
//! particles.

#[path = "../transfer/check.rs"]
#[allow(dead_code, reason = "those of passes are for the bench of transfers")]
mod check;
#[path = "../common/one_thread.rs"]
mod one_thread;
#[path = "../common/random.rs"]
mod random;
#[path = "../transfer/scene.rs"]
#[allow(dead_code, reason = "the passes are for the bench of transfers")]
mod scene;

use check::checked_solver;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use mpm_verify::mpm::{
    BasisName, FrameName, MassName, MaterialPlan, SchemeName, TransferName, combine,
};
use mpm_verify::subject::Subject;
use one_thread::one_thread;
use scene::{Method, Order, total};
use std::hint::black_box;
use std::time::Duration;

/// Length of a step (s), so short that no particle of a body of modulus 1 Pa, density 1 and cells
/// of 1 m leaves its cell in any number of steps.
const DT: f64 = 1e-12;

/// Number of particles in the short profile.
const SHORT: usize = 10_000;

/// A method, its material law, and the number of particles.
#[derive(Clone, Copy)]
struct Scene {
    basis: BasisName,
    transfer: TransferName,
    scheme: SchemeName,
    material: MaterialPlan,
    count: usize,
}

/// Law of all benchmarks that compare methods.
const LAW: MaterialPlan = MaterialPlan::NeoHookean { young: 1.0, poisson: 0.3 };

/// Returns all other laws, except laws of bodies at rest.
fn other_laws() -> Vec<MaterialPlan> {
    let mut all = MaterialPlan::every(|parameter| match parameter.symbol {
        "nu" => 0.3,
        "Y" | "H" | "eta" | "kappa" => 0.1,
        "pc" => 1e3,
        _ => 1.0,
    });
    all.retain(|plan| !plan.properties().is_at_rest() && plan.name() != LAW.name());
    all
}

fn bench<const D: usize>(criterion: &mut Criterion, scene: Scene) {
    let Scene { basis, transfer, scheme, material, count } = scene;
    let (basis, transfer, scheme) = (basis.name(), transfer.name(), scheme.name());
    let id = format!("step/{D}d/{basis}/{transfer}/{scheme}/{}", material.name());
    let mut group = criterion.benchmark_group(&id);
    group.throughput(Throughput::Elements(total::<D>(count) as u64));
    group.bench_function(BenchmarkId::from_parameter(format!("{count:e}")), |bencher| {
        let (method, grid, particles) =
            Method::<D>::new((scene.basis, scene.transfer), Order::Sorted, count);
        let of = (scene.scheme, material);
        let mut solver = checked_solver(&id, DT, of, method, (grid, particles));
        bencher.iter(|| solver.step(black_box(DT)).expect("a later step succeeds"));
        assert_eq!(solver.counters().crossings, Some(0), "{id}: the order of particles must last");
    });
    group.finish();
}

/// Runs the benchmark in one, two and three dimensions.
fn bench_all(criterion: &mut Criterion, scene: Scene) {
    bench::<1>(criterion, scene);
    bench::<2>(criterion, scene);
    bench::<3>(criterion, scene);
}

fn every_method(criterion: &mut Criterion) {
    one_thread();
    let is_full = std::env::var("MPM_BENCH").is_ok_and(|profile| profile == "full");
    let (basis, scheme) = (BasisName::QuadraticBSpline, SchemeName::Usl);
    let short = [TransferName::Flip, TransferName::Apic, TransferName::Mls];
    let plain = Scene { basis, transfer: TransferName::Mls, scheme, material: LAW, count: SHORT };
    if !is_full {
        for transfer in short {
            for scheme in [SchemeName::Usl, SchemeName::Musl] {
                bench_all(criterion, Scene { transfer, scheme, ..plain });
            }
        }
        for material in other_laws() {
            bench_all(criterion, Scene { transfer: TransferName::Flip, material, ..plain });
        }
        return;
    }
    for count in [100, SHORT, 100_000] {
        for &basis in BasisName::ALL {
            let goes_with_basis = |transfer: &TransferName| {
                combine(basis, *transfer, MassName::Lumped, FrameName::Updated).is_ok()
            };
            for transfer in TransferName::ALL.iter().copied().filter(goes_with_basis) {
                for &scheme in SchemeName::ALL {
                    let own = Scene { basis, transfer, scheme, count, ..plain };
                    bench_all(criterion, own);
                }
            }
        }
        for material in other_laws() {
            bench_all(criterion, Scene { material, count, ..plain });
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(500));
    targets = every_method
}
criterion_main!(benches);
