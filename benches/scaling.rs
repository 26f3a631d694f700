//! Time per particle of P2G and G2P for 1e3 particles and more.
//!
//! `cargo bench --bench scaling` measures up to 1e6 particles, and up to 1e7 with `MPM_BENCH=full`
//! (about 4 GB); `-- FILE.svg` also writes a figure. For each size the minimum time is used,
//! because other processes can only slow down a pass. Cache sizes are visible as steps. At the end,
//! particles in random order are measured.

#[path = "common/clock.rs"]
mod clock;
#[path = "common/one_thread.rs"]
mod one_thread;
#[path = "common/random.rs"]
mod random;
#[path = "transfer/scene.rs"]
mod scene;

use clock::shortest;
use mpm_verify::mpm::{BasisName, Grid, Particles, TransferName, Vector};
use mpm_verify::report::figure::{LogLogPlot, Mark, PlotPoint, PlotSeries};
use one_thread::one_thread;
use random::Random;
use scene::{Method, Order, total};
use std::hint::black_box;

/// Returns the time per particle (ns) of P2G and of G2P.
fn measure<const D: usize>(method: (BasisName, TransferName), count: usize) -> [f64; 2] {
    let (mut method, mut grid, mut particles) = Method::<D>::new(method, Order::Sorted, count);
    let per_particle = 1e9 / total::<D>(count) as f64;
    let p2g = shortest(|| method.p2g(black_box(&particles), &mut grid));
    let mut random = Random(3);
    grid.velocity.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    grid.acceleration.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    let g2p = shortest(|| method.g2p(black_box(&grid), 1e-12, &mut particles));
    [p2g, g2p].map(|time| time * per_particle)
}

/// Returns the lines of P2G and of G2P in the figure.
fn lines<const D: usize>(method: (BasisName, TransferName), counts: &[usize]) -> Vec<PlotSeries> {
    let name = |pass| format!("{D}d {} {} {pass}", method.0.name(), method.1.name());
    let mut lines = [(0, "p2g"), (1, "g2p")].map(|(k, pass)| PlotSeries {
        name: name(pass),
        look: 2 * (D - 1) + k,
        points: Vec::new(),
    });
    for &count in counts {
        let times = measure::<D>(method, count);
        for (line, time) in lines.iter_mut().zip(times) {
            let x = total::<D>(count) as f64;
            line.points.push(PlotPoint { x, error: time, mark: Mark::Measured });
        }
    }
    for line in &lines {
        let times = line.points.iter().map(|point| point.error);
        let (least, most) = times.fold((f64::INFINITY, 0.0_f64), |(least, most), time| {
            (least.min(time), most.max(time))
        });
        print!("{:<36}", line.name);
        for point in &line.points {
            print!(" {:>8.1}", point.error);
        }
        println!(" {:>9.2}", most / least);
    }
    lines.into()
}

/// Returns the total time (s) of P2G and G2P.
fn both_passes<const D: usize>(
    (method, grid, particles): &mut (Method<D>, Grid<D>, Particles<D>),
) -> f64 {
    let p2g = shortest(|| method.p2g(black_box(particles), grid));
    p2g + shortest(|| method.g2p(black_box(grid), 1e-12, particles))
}

/// Compares particles in random order with sorted particles.
fn unsorted<const D: usize>(name: (BasisName, TransferName), count: usize) {
    let make = |order: Order| Method::<D>::new(name, order, count);
    let sorted = both_passes(&mut make(Order::Sorted));
    let shuffled = both_passes(&mut make(Order::Shuffled));
    let names = format!("{D}d {} {}", name.0.name(), name.1.name());
    println!(
        "{names}, {count:e} particles: {} {:.2} times {}",
        Order::Shuffled.name(),
        shuffled / sorted,
        Order::Sorted.name()
    );
}

fn main() {
    one_thread();
    let is_full = std::env::var("MPM_BENCH").is_ok_and(|profile| profile == "full");
    let most = if is_full { 10_000_000 } else { 1_000_000 };
    let counts: Vec<usize> = (0..9)
        .map(|k| [1, 3][k % 2] * 1000 * 10_usize.pow(k as u32 / 2))
        .filter(|&count| count <= most)
        .collect();
    println!("ns per particle, one thread, sorted by cell, 2 particles to a cell and axis");
    print!("{:<36}", "particles, about");
    for count in &counts {
        print!(" {count:>8.0e}");
    }
    println!(" {:>9}", "most/least");
    let quadratic = (BasisName::QuadraticBSpline, TransferName::Apic);
    let mut series = lines::<1>((BasisName::Linear, TransferName::Flip), &counts);
    series.extend(lines::<2>(quadratic, &counts));
    series.extend(lines::<3>(quadratic, &counts));
    println!();
    for count in [100_000, 1_000_000] {
        unsorted::<2>(quadratic, count);
        unsorted::<3>(quadratic, count);
    }
    let figure = LogLogPlot {
        title: "Cost of a particle".into(),
        x_label: "particles".into(),
        y_label: "time per particle (ns)".into(),
        series,
        ..LogLogPlot::default()
    };
    if let Some(file) =
        std::env::args().find(|word| !word.starts_with('-') && word.contains(".svg"))
    {
        std::fs::write(&file, figure.to_svg()).expect("the figure can be written");
    }
}
