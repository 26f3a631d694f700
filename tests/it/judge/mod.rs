//! The whole judge, tested on series with known verdicts.

mod coverage;
mod gate;
mod limits;
mod pitfalls;
mod properties;
mod richardson;
mod rounding;
mod series;

use std::f64::consts::PI;

use mpm_verify::verify::{Judgement, Level, OrderHypothesis, judge};

/// Creates levels with the spacings 1, 1/2, 1/4, ... and these errors.
fn halvings(errors: &[f64]) -> Vec<Level> {
    let level = |(k, error): (usize, &f64)| Level::new(libm::exp2(-(k as f64)), *error);
    errors.iter().enumerate().map(level).collect()
}

/// Creates levels with the spacings 1, 1/2, 1/4, ... whose errors are given by a function.
fn halved(levels: usize, error: impl Fn(f64) -> f64) -> Vec<Level> {
    let spacing = |k: usize| libm::exp2(-(k as f64));
    (0..levels).map(|k| Level::new(spacing(k), error(spacing(k)))).collect()
}

fn judged(errors: &[f64], order: f64) -> Judgement {
    judge(&halvings(errors), &OrderHypothesis::formal(order))
}

/// A small random generator (xorshift64*, Vigna 2016). The series then do not depend on the
/// platform or on versions of dependencies.
struct Random(u64);

impl Random {
    /// Returns a number that is uniform in `[0, 1)`.
    fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 * libm::exp2(-53.0)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// Returns a standard normal number (Box & Muller 1958).
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(1.0 - self.uniform())).sqrt();
        radius * libm::cos(2.0 * PI * self.uniform())
    }

    /// Multiplies each error by log-normal noise.
    fn disturb(&mut self, levels: &mut [Level], sigma: f64) {
        for level in levels {
            level.error *= libm::exp(sigma * self.normal());
        }
    }
}
