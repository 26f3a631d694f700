//! Speedup of P2G and G2P by a second thread, compared with the speedup of independent loops.
//!
//! `cargo bench --bench threads` runs each pass with 1e6 particles and two probes in turn, on one
//! thread and on two. The probes are multiply-adds in registers, and a loop that reads two columns
//! of memory and writes one. On a machine with other load, all speedups may be small, so compare a
//! pass with the probes. `-- 1e5` sets the number of particles. The program first checks that
//! results are bit-identical.

#[path = "common/random.rs"]
mod random;
#[path = "transfer/scene.rs"]
#[allow(dead_code, reason = "particles in any order are benched elsewhere")]
mod scene;

use mpm_verify::mpm::{BasisName, TransferName, Vector};
use mpm_verify::verify::Timing;
use random::Random;
use rayon::{ThreadPool, ThreadPoolBuilder};
use scene::{Method, Order};
use std::hint::black_box;
use std::time::Instant;

/// Number of repetitions.
const TURNS: usize = 25;

/// A loop that can be run on one thread or on two.
struct Loop<'a> {
    name: String,
    run: Box<dyn FnMut() + Send + 'a>,
    /// Times (s) on one thread and on two, for each repetition.
    times: Vec<[f64; 2]>,
}

impl<'a> Loop<'a> {
    fn new(name: impl Into<String>, run: impl FnMut() + Send + 'a) -> Self {
        Self { name: name.into(), run: Box::new(run), times: Vec::new() }
    }

    fn take_turn(&mut self, pools: &[ThreadPool; 2]) {
        let run = &mut self.run;
        self.times.push(pools.each_ref().map(|pool| {
            pool.install(|| {
                let start = Instant::now();
                run();
                start.elapsed().as_secs_f64()
            })
        }));
    }

    fn speed_up(&self) -> Timing {
        let ratios: Vec<f64> = self.times.iter().map(|[one, two]| one / two).collect();
        Timing::of(&ratios).expect("times are numbers")
    }
}

/// Computes independent chains of sums and products, distributed over all threads.
fn compute() {
    let chains = || {
        let mut sums: [f64; 32] = std::array::from_fn(|k| k as f64);
        let (factor, term) = (black_box(0.999), black_box(1e-3));
        for _ in 0..200_000 {
            for sum in &mut sums {
                *sum = *sum * factor + term;
            }
        }
        black_box(sums);
    };
    let twice = || {
        rayon::join(chains, chains);
    };
    rayon::join(twice, twice);
}

/// Columns that are too large for any cache.
struct Triad {
    a: Vec<f64>,
    b: Vec<f64>,
    c: Vec<f64>,
}

fn triad(a: &mut [f64], b: &[f64], c: &[f64]) {
    let half = a.len() / 2;
    if half > 1_000_000 {
        let (a, b, c) = (a.split_at_mut(half), b.split_at(half), c.split_at(half));
        rayon::join(|| triad(a.0, b.0, c.0), || triad(a.1, b.1, c.1));
        return;
    }
    let factor = black_box(3.0);
    for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
        *a = b + factor * c;
    }
}

/// Measures P2G and G2P of a method.
fn passes<const D: usize>(
    basis: BasisName,
    transfer: TransferName,
    count: usize,
    pools: &[ThreadPool; 2],
    probes: &mut [Loop<'_>],
) {
    let names = format!("{D}d {} {}", basis.name(), transfer.name());
    let (mut method, mut grid, particles) =
        Method::<D>::new((basis, transfer), Order::Sorted, count);
    let mut bits = pools.iter().map(|pool| {
        pool.install(|| method.p2g(&particles, &mut grid));
        let nodes = grid.velocity.iter().flatten().chain(&grid.mass);
        nodes.map(|x| x.to_bits()).collect::<Vec<u64>>()
    });
    assert!(bits.next() == bits.next(), "{names}: threads change the bits, so nothing is timed");
    drop(bits);
    let mut p2g =
        Loop::new(format!("{names} p2g"), || method.p2g(black_box(&particles), &mut grid));
    turns(&mut p2g, pools, probes);
    drop(p2g);
    let mut random = Random(3);
    grid.velocity.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    grid.acceleration.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    let mut particles = particles;
    let mut g2p =
        Loop::new(format!("{names} g2p"), || method.g2p(black_box(&grid), 1e-12, &mut particles));
    turns(&mut g2p, pools, probes);
}

/// Runs pass and probes in turn and prints a line.
fn turns(pass: &mut Loop<'_>, pools: &[ThreadPool; 2], probes: &mut [Loop<'_>]) {
    pass.take_turn(pools);
    pass.times.clear();
    for probe in probes.iter_mut() {
        probe.times.clear();
    }
    for _ in 0..TURNS {
        pass.take_turn(pools);
        for probe in probes.iter_mut() {
            probe.take_turn(pools);
        }
    }
    let Timing { low, median, high, .. } = pass.speed_up();
    print!("{:<28} {median:>6.2} [{low:.2}, {high:.2}]", pass.name);
    for probe in probes {
        let of_probe = probe.speed_up().median;
        print!("   {of_probe:>6.2} {:>6.2}", median / of_probe);
    }
    println!();
}

fn main() {
    let count = std::env::args().find_map(|word| word.parse().ok()).unwrap_or(1e6) as usize;
    let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let pools = [pool(1), pool(2)];
    let column = |value: f64| vec![value; 25_000_000];
    let mut columns = Triad { a: column(0.0), b: column(1.0), c: column(2.0) };
    let mut probes = [
        Loop::new("registers", compute),
        Loop::new("memory", || triad(&mut columns.a, &columns.b, &columns.c)),
    ];
    println!(
        "speed-up by a second thread, {count:e} particles, median of {TURNS} turns [quartiles]"
    );
    println!("{:<28} {:>20}   registers: its own, pass/it   memory: its own, pass/it", "", "");
    let (flip, apic) = (TransferName::Flip, TransferName::Apic);
    passes::<1>(BasisName::Linear, flip, count, &pools, &mut probes);
    passes::<2>(BasisName::Linear, flip, count, &pools, &mut probes);
    passes::<2>(BasisName::QuadraticBSpline, apic, count, &pools, &mut probes);
    passes::<3>(BasisName::Linear, flip, count, &pools, &mut probes);
    passes::<3>(BasisName::QuadraticBSpline, apic, count, &pools, &mut probes);
    passes::<3>(BasisName::CubicBSpline, apic, count, &pools, &mut probes);
}
