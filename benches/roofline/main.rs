//! Performance limits of this machine for particle-node loops, and the fraction of the limits that
//! the loops reach: the table of `benches/ROOFLINE.md`.
//!
//! `cargo bench --bench roofline` measures the limits of one core (arithmetic, memory, caches) and
//! the passes in the same run, with 1e5 particles sorted by cell. Other processes can only slow
//! down a measurement, so the best of many measurements is used.

#[path = "../common/clock.rs"]
mod clock;
mod demand;
#[path = "../common/one_thread.rs"]
mod one_thread;
mod probe;
#[path = "../common/random.rs"]
mod random;
#[path = "../transfer/scene.rs"]
#[allow(dead_code, reason = "particles in any order are benched elsewhere")]
mod scene;

use clock::shortest;
use demand::Demand;
use mpm_verify::mpm::{BasisName, TransferName, Vector};
use one_thread::one_thread;
use probe::Limits;
use random::Random;
use scene::{Method, Order, total};
use std::hint::black_box;

fn row(name: &str, limits: &Limits, demand: &Demand, reached: f64) {
    let by_flops = 1e9 * demand.flops / limits.flops;
    let by_updates = 1e9 * demand.updates / limits.updates;
    let by_memory = 1e9 * demand.bytes / limits.memory;
    let bound = by_flops.max(by_updates).max(by_memory);
    println!(
        "| {name} | {:.0} | {:.0} | {by_flops:.1} | {by_updates:.1} | {by_memory:.1} | {reached:.1} | {:.0} % |",
        demand.flops,
        demand.bytes,
        100.0 * bound / reached
    );
}

fn passes<const D: usize>(
    limits: &Limits,
    basis: (BasisName, usize),
    transfer: TransferName,
    count: usize,
) {
    let method = (basis.0, transfer);
    let name = |pass| format!("{D}d {} {} {pass}", basis.0.name(), transfer.name());
    let (size, is_affine) = ((D as f64, basis.1 as f64), transfer == TransferName::Apic);
    let (mut method, mut grid, mut particles) = Method::<D>::new(method, Order::Sorted, count);
    let nanoseconds = 1e9 / total::<D>(count) as f64;
    let time = nanoseconds * shortest(|| method.p2g(black_box(&particles), &mut grid));
    row(&name("p2g"), limits, &demand::p2g(size, is_affine), time);
    let mut random = Random(3);
    grid.velocity.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    grid.acceleration.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    let time = nanoseconds * shortest(|| method.g2p(black_box(&grid), 1e-12, &mut particles));
    row(&name("g2p"), limits, &demand::g2p(size, is_affine), time);
}

fn main() {
    one_thread();
    let limits = Limits::measured();
    println!(
        "one core: {:.1} Gflop/s in fours, each product fused with a sum",
        1e-9 * limits.flops
    );
    println!(
        "          {:.1} GB/s to memory, {:.1} in the second cache",
        1e-9 * limits.memory,
        1e-9 * limits.cache
    );
    println!(
        "          {:.2} G updates of four numbers a second in the first cache\n",
        1e-9 * limits.updates
    );
    println!(
        "| pass | flops | bytes | ns by flops | by updates of nodes | by memory | reached ns | of the bound |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    let (count, flip, apic) = (100_000, TransferName::Flip, TransferName::Apic);
    let linear = (BasisName::Linear, 2);
    let quadratic = (BasisName::QuadraticBSpline, 3);
    let cubic = (BasisName::CubicBSpline, 4);
    passes::<1>(&limits, linear, flip, count);
    passes::<2>(&limits, linear, flip, count);
    passes::<2>(&limits, quadratic, apic, count);
    passes::<3>(&limits, linear, flip, count);
    passes::<3>(&limits, quadratic, apic, count);
    passes::<3>(&limits, cubic, apic, count);
}
