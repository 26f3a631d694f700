//! Time to reach a target error: for each suite and target, the cheapest methods, each on the
//! coarsest level that reaches the target.
//!
//! An identifier has the form `accuracy/vibrating-bar/1e-3/mpm-linear-flip-musl`, and any part of
//! it selects benchmarks: `cargo bench --bench accuracy -- 1e-3`. Only steps are timed, without
//! set-up. Each level first runs once to check its error.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use mpm_verify::embedded;
use mpm_verify::study::cost::{Goal, goals};
use mpm_verify::suite::Suite;
use std::time::Duration;

/// Suites, each with targets that some of its methods reach within a tenth of a second.
const SUITES: [(&str, &[f64]); 4] = [
    ("vibrating-bar", &[1e-2, 1e-3, 1e-4]),
    ("mms-periodic-bar-cos", &[1e-2, 1e-3]),
    ("mms-axis-aligned-2d", &[1e-2]),
    ("column-hencky", &[1e-2, 1e-3]),
];

/// Maximum number of methods per suite.
const METHODS: usize = 3;

fn suite(name: &str) -> Suite {
    let source = embedded::source(name).expect(name).expect("a source");
    Suite::load(&source).expect("a sound suite")
}

fn accuracy(criterion: &mut Criterion) {
    for (name, targets) in SUITES {
        let suite = suite(name);
        for target in targets {
            let id = format!("accuracy/{name}/{target:e}");
            let goals = goals(&suite, *target);
            assert!(!goals.is_empty(), "{id}: no method reaches it");
            let mut group = criterion.benchmark_group(&id);
            for goal in goals.iter().take(METHODS) {
                check(&id, goal, *target);
                group.bench_function(BenchmarkId::from_parameter(goal.case()), |bencher| {
                    bencher.iter_custom(|runs| (0..runs).map(|_| time(goal)).sum());
                });
            }
            group.finish();
        }
    }
}

/// Panics if the error is zero or above the target, because a wrong result must not be timed.
fn check(id: &str, goal: &Goal<'_>, target: f64) {
    let (case, cells, error) = (goal.case(), goal.cells(), goal.error());
    assert!(
        error > 0.0 && error <= target,
        "{id}/{case}: not timed, error {error} with {cells} cells"
    );
}

fn time(goal: &Goal<'_>) -> Duration {
    Duration::from_secs_f64(goal.seconds().expect("it has run before"))
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(800));
    targets = accuracy
}
criterion_main!(benches);
