//! Judges the order of a finite difference solver of the heat equation `u_t = u_xx`.

use mpm_judge::verify::{Level, OrderHypothesis, judge};
use std::f64::consts::PI;

/// Computes the largest error at t = 0.1 on `cells` cells, with steps in proportion to h^2.
fn error(cells: usize) -> f64 {
    let h = 1.0 / cells as f64;
    let steps = (0.1 / (0.25 * h * h)).round();
    let ratio = 0.1 / steps / (h * h);
    let mut u: Vec<f64> = (0..=cells).map(|i| libm::sin(PI * h * i as f64)).collect();
    for _ in 0..steps as usize {
        let old = u.clone();
        for i in 1..cells {
            u[i] = old[i] + ratio * (old[i - 1] - 2.0 * old[i] + old[i + 1]);
        }
    }
    let decay = libm::exp(-PI * PI * 0.1);
    let exact = |i: usize| decay * libm::sin(PI * h * i as f64);
    (0..=cells).map(|i| (u[i] - exact(i)).abs()).fold(0.0, f64::max)
}

fn main() {
    let levels: Vec<Level> = [10, 20, 40, 80]
        .iter()
        .map(|&cells| Level::new(1.0 / cells as f64, error(cells)))
        .collect();
    let judgement = judge(&levels, &OrderHypothesis::formal(2.0));
    println!("{}: {}", judgement.verdict, judgement.reason);
}
