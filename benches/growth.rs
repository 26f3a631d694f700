//! Time per particle of a whole step for 1e3 particles and more, on one thread and on two, and the
//! memory per particle.
//!
//! `cargo bench --bench growth` measures up to 1e6 particles. `MPM_BENCH=full` raises the maximum
//! to 1e7 (about 5 GB), and a number sets the maximum (`-- 3e7`). Other arguments select methods
//! (`-- 3d`), and `-- FILE.svg` writes a figure. One thread and two run in turn, and the minimum
//! time of each is used. Each method first makes one step to check conservation of momentum.

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
use mpm_verify::report::figure::{LogLogPlot, Mark, PlotPoint, PlotSeries};
use mpm_verify::subject::{Holder, Subject};
use rayon::{ThreadPool, ThreadPoolBuilder};
use scene::{Method, Order, total};
use std::time::Instant;

/// Length of a step (s), so short that no particle leaves its cell in any number of steps.
const DT: f64 = 1e-12;

/// Returns the minimum time (s) of a step, from at least three steps and 0.5 s.
fn shortest<const D: usize>(solver: &mut Solver<D>, pool: &ThreadPool) -> f64 {
    let (begin, mut steps, mut shortest) = (Instant::now(), 0, f64::INFINITY);
    while steps < 3 || begin.elapsed().as_secs_f64() < 0.5 {
        let start = Instant::now();
        pool.install(|| solver.step(DT)).expect("a step succeeds");
        shortest = shortest.min(start.elapsed().as_secs_f64());
        steps += 1;
    }
    shortest
}

/// Measures a method on one thread and on two, and returns a line of the figure for each.
/// `first_look` is the index of the style of the first line.
fn lines<const D: usize>(
    first_look: usize,
    (basis, name): (BasisName, TransferName),
    counts: &[usize],
) -> Vec<PlotSeries> {
    let id = format!("{D}d {} {}", basis.name(), name.name());
    if !words::selects(&id) {
        return Vec::new();
    }
    let pools = [1, 2].map(|threads| {
        ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start")
    });
    let (mut lines, mut bytes) = ([Vec::new(), Vec::new()], 0);
    for &count in counts {
        let (method, grid, particles) = Method::<D>::new((basis, name), Order::Sorted, count);
        let law = MaterialPlan::NeoHookean { young: 1.0, poisson: 0.3 };
        let parts = (grid, particles);
        let mut solver = checked_solver(&id, DT, (SchemeName::Usl, law), method, parts);
        let columns = solver.profile().columns.into_iter();
        let of_particles = columns.filter(|column| column.holder == Holder::Particle);
        bytes = of_particles.map(|column| column.bytes).sum();
        let mut times = [f64::INFINITY; 2];
        for _ in 0..2 {
            for (time, pool) in times.iter_mut().zip(&pools) {
                *time = time.min(shortest(&mut solver, pool));
            }
        }
        for (line, time) in lines.iter_mut().zip(times) {
            let (x, error) = (total::<D>(count) as f64, 1e9 * time / total::<D>(count) as f64);
            line.push(PlotPoint { x, error, mark: Mark::Measured });
        }
    }
    println!("{id}, {bytes} bytes a particle");
    for (threads, line) in (1..).zip(&lines) {
        print!("{:<28}", format!("  threads: {threads}"));
        for point in line {
            print!(" {:>8.1}", point.error);
        }
        println!();
    }
    let series = |(k, points)| {
        let name = format!("{id} ({bytes} bytes), threads: {}", k + 1);
        PlotSeries { name, look: first_look + k, points }
    };
    lines.into_iter().enumerate().map(series).collect()
}

fn main() {
    let is_full = std::env::var("MPM_BENCH").is_ok_and(|profile| profile == "full");
    let most = words::count(if is_full { 1e7 } else { 1e6 });
    let counts: Vec<usize> = (0..11)
        .map(|k| [1, 3][k % 2] * 1000 * 10_usize.pow(k as u32 / 2))
        .filter(|&count| count as f64 <= most)
        .collect();
    println!(
        "ns per particle of a step, neo-Hookean, USL, sorted by cell, 2^D particles to a cell"
    );
    print!("{:<28}", "particles, about");
    for count in &counts {
        print!(" {count:>8.0e}");
    }
    println!();
    let quadratic = |transfer| (BasisName::QuadraticBSpline, transfer);
    let mut series = lines::<1>(0, (BasisName::Linear, TransferName::Flip), &counts);
    series.extend(lines::<2>(2, quadratic(TransferName::Mls), &counts));
    series.extend(lines::<3>(4, quadratic(TransferName::Apic), &counts));
    series.extend(lines::<3>(6, quadratic(TransferName::Mls), &counts));
    let figure = LogLogPlot {
        title: "Cost of a particle in a whole step".into(),
        x_label: "particles".into(),
        y_label: "time per particle (ns)".into(),
        series,
        ..LogLogPlot::default()
    };
    if let Some(file) = words::file(".svg") {
        std::fs::write(&file, figure.to_svg()).expect("the figure can be written");
    }
}
