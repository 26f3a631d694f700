//! Time measurement on a machine with other load.

use std::time::Instant;

/// Returns the minimum time of one call (s), from at least five calls and 0.3 s.
pub(crate) fn shortest(mut run: impl FnMut()) -> f64 {
    let (mut least, mut calls, begin) = (f64::INFINITY, 0, Instant::now());
    while calls < 5 || begin.elapsed().as_secs_f64() < 0.3 {
        let start = Instant::now();
        run();
        least = least.min(start.elapsed().as_secs_f64());
        calls += 1;
    }
    least
}
