//! Time of each pass of a step, and the speedup of each pass by a second thread.
//!
//! `cargo bench --bench stages` times steps of six methods with 1e4 particles. A number sets the
//! number of particles (`-- 1e6`), and other arguments select methods (`-- 1e6 3d mls`). One thread
//! and two run in turn, and the minimum time of each pass is used. Each method first makes one step
//! to check conservation of momentum.

#[path = "transfer/check.rs"]
#[allow(dead_code, reason = "those of passes are for the bench of transfers")]
mod check;
#[path = "common/random.rs"]
mod random;
#[path = "transfer/scene.rs"]
#[allow(dead_code, reason = "the passes are for the bench of transfers")]
mod scene;
#[path = "common/words.rs"]
mod words;

use check::checked_solver;
use mpm_verify::mpm::{BasisName, MaterialPlan, SchemeName, Solver, TransferName};
use rayon::ThreadPoolBuilder;
use scene::{Method, Order, total};
use std::time::Instant;

/// Length of a step (s), so short that no particle leaves its cell in any number of steps.
const DT: f64 = 1e-12;

/// Minimum times of a pass (s), on one thread and on two.
struct PassTime {
    name: String,
    shortest: [f64; 2],
}

/// Runs at least five steps, for at least 0.5 s, and stores the minimum times of `passes`.
fn step<const D: usize>(solver: &mut Solver<D>, threads: usize, passes: &mut Vec<PassTime>) {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
    let (begin, mut steps) = (Instant::now(), 0);
    while steps < 5 || begin.elapsed().as_secs_f64() < 0.5 {
        pool.install(|| {
            let (mut index, mut last) = (0, Instant::now());
            let mut after = |name: String| {
                if index == passes.len() {
                    passes.push(PassTime { name, shortest: [f64::INFINITY; 2] });
                }
                let shortest = &mut passes[index].shortest[threads - 1];
                *shortest = shortest.min(last.elapsed().as_secs_f64());
                (index, last) = (index + 1, Instant::now());
            };
            solver.step_by_pass(DT, &mut after).expect("a step succeeds");
        });
        steps += 1;
    }
}

fn profile<const D: usize>(
    count: usize,
    (basis, transfer, scheme): (BasisName, TransferName, SchemeName),
) {
    let id = format!("{D}d/{}/{}/{}", basis.name(), transfer.name(), scheme.name());
    if !words::selects(&id) {
        return;
    }
    let (method, grid, particles) = Method::<D>::new((basis, transfer), Order::Sorted, count);
    let law = MaterialPlan::NeoHookean { young: 1.0, poisson: 0.3 };
    let mut solver = checked_solver(&id, DT, (scheme, law), method, (grid, particles));
    let mut passes = Vec::new();
    for _ in 0..2 {
        step(&mut solver, 1, &mut passes);
        step(&mut solver, 2, &mut passes);
    }
    let whole = |threads: usize| passes.iter().map(|pass| pass.shortest[threads - 1]).sum::<f64>();
    let (per_particle, all) = (1e9 / total::<D>(count) as f64, whole(1));
    println!("{id}, {count:e} particles");
    let line = |name: &str, [one, two]: [f64; 2]| {
        let (share, faster) = (100.0 * one / all, one / two);
        println!("  {name:<44} {:>8.2} {share:>5.1} % {faster:>6.2}", one * per_particle);
    };
    for PassTime { name, shortest } in &passes {
        line(name, *shortest);
    }
    line("a step", [all, whole(2)]);
}

fn main() {
    let count = words::count(1e4) as usize;
    println!("ns per particle on one thread, share of the step, times faster on two threads");
    let (quadratic, usl) = (BasisName::QuadraticBSpline, SchemeName::Usl);
    profile::<1>(count, (BasisName::Linear, TransferName::Flip, SchemeName::Musl));
    profile::<2>(count, (quadratic, TransferName::Mls, usl));
    profile::<3>(count, (quadratic, TransferName::Flip, usl));
    profile::<3>(count, (quadratic, TransferName::Flip, SchemeName::Musl));
    profile::<3>(count, (quadratic, TransferName::Apic, usl));
    profile::<3>(count, (quadratic, TransferName::Mls, usl));
}
