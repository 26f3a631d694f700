//! The machine, as far as it affects seconds: cores, load, and a loop of constant work.

use crate::verify::{Machine, Timing};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::hint::black_box;
use std::sync::LazyLock;
use std::time::Instant;

/// Rounds of the loop: about a millisecond.
const ROUNDS: u32 = 250_000;

/// A pool of one thread; `None` if the system cannot create one.
static ALONE: LazyLock<Option<ThreadPool>> =
    LazyLock::new(|| ThreadPoolBuilder::new().num_threads(1).build().ok());

/// Does `work` on one thread, all of it: large scenes would use more.
pub(crate) fn alone<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    match &*ALONE {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

/// A machine under observation.
pub(crate) struct Observed {
    load: Option<f64>,
    loops: Vec<f64>,
    passed: Instant,
    waited: Option<f64>,
}

/// Time (s) of a piece of work: wall time, and the part in which this thread waited for a core, if
/// the system reports it.
pub(crate) struct LoadMonitor {
    start: Instant,
    waited: Option<f64>,
}

impl LoadMonitor {
    /// From now on.
    pub(crate) fn start() -> Self {
        Self { waited: waited(), start: Instant::now() }
    }

    /// Until now, without the waiting.
    pub(crate) fn stop(self) -> f64 {
        let passed = self.start.elapsed().as_secs_f64();
        let idle = self.waited.zip(waited()).map_or(0.0, |(before, after)| after - before);
        // A value that is not positive is invalid.
        if idle > 0.0 && idle < passed { passed - idle } else { passed }
    }
}

/// Seconds for which this thread has been ready to run and waited: the second number of `schedstat`
/// (Linux, Documentation/scheduler/sched-stats).
fn waited() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().nth(1)?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}

impl Observed {
    /// From now on.
    pub(crate) fn new() -> Self {
        let loops = Vec::new();
        Self { load: load(), loops, passed: Instant::now(), waited: waited() }
    }

    /// Runs and times the loop once.
    pub(crate) fn look(&mut self) {
        let watch = LoadMonitor::start();
        let mut x = black_box(0.5_f64);
        for _ in 0..ROUNDS {
            x = x * 0.999 + 0.001;
        }
        black_box(x);
        self.loops.push(watch.stop());
    }

    /// The machine as observed.
    pub(crate) fn seen(self) -> Machine {
        Machine {
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            load: self.load.zip(load()).map(|(before, after)| [before, after]),
            waited: self
                .waited
                .zip(waited())
                .map(|(before, after)| (after - before) / self.passed.elapsed().as_secs_f64()),
            fixed_loop: Timing::of(&self.loops),
        }
    }
}

/// Load average over the last minute, if the system has a file with it.
fn load() -> Option<f64> {
    std::fs::read_to_string("/proc/loadavg").ok()?.split_whitespace().next()?.parse().ok()
}
