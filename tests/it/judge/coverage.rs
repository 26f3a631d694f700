//! Does the interval that the judge reports contain the true order as often as it says?

use super::Random;
use mpm_verify::verify::{Level, OrderHypothesis, judge};

const SERIES: usize = 10_000;

#[derive(Debug, Default)]
struct Count {
    covered: usize,
    without_order: usize,
    shortened: usize,
}

/// Cells along a bar of length 25, in two plans of refinement.
const HALVINGS: [f64; 8] = [5.0, 10.0, 20.0, 40.0, 80.0, 160.0, 320.0, 640.0];
const UNEQUAL: [f64; 8] = [5.0, 10.0, 20.0, 40.0, 60.0, 80.0, 120.0, 160.0];

fn noisy(random: &mut Random, cells: &[f64], order: f64) -> Vec<Level> {
    let levels = random.between(5.0, 9.0) as usize;
    let sigma = random.between(0.01, 0.05);
    let level = |n: &f64| Level::new(25.0 / n, libm::pow(1.0 / n, order));
    let mut series: Vec<Level> = cells[..levels].iter().map(level).collect();
    random.disturb(&mut series, sigma);
    series
}

fn count(cells: &[f64], seed: u64) -> Count {
    let mut random = Random(seed);
    let mut count = Count::default();
    for _ in 0..SERIES {
        let order = random.between(1.0, 3.0);
        let series = noisy(&mut random, cells, order);
        let judgement = judge(&series, &OrderHypothesis::formal(order));
        match judgement.order {
            Some(found) => {
                count.covered += usize::from(found.low <= order && order <= found.high);
            }
            None => count.without_order += 1,
        }
        let kept = judgement.window.map_or(0, |window| window.len());
        count.shortened += usize::from(kept < series.len());
    }
    count
}

/// Log-normal noise of 1 to 5 %, 5 to 8 levels, orders from 1 to 3. A series without an order
/// counts as not covered, and must be rare in itself.
#[test]
fn the_interval_of_the_judge_covers_the_true_order_in_95_per_cent() {
    for (cells, seed) in [(HALVINGS, 2024), (UNEQUAL, 2025)] {
        let count = count(&cells, seed);
        let share = count.covered as f64 / SERIES as f64;
        assert!((share - 0.95).abs() <= 0.01, "{count:?}");
        assert!(count.without_order * 100 < SERIES, "{count:?}");
        assert!(count.shortened * 100 < SERIES, "{count:?}");
    }
}
