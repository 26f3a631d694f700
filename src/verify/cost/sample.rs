//! One level: what it gave and what it took.

/// A setting that was run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The spacing that is refined.
    pub spacing: f64,
    /// Error over the size of the solution.
    pub error: f64,
    /// Work: transfers, or seconds.
    pub work: f64,
    /// Whether the judge may count the level.
    pub usable: bool,
    /// Whether the judge fits the order to this level.
    pub asymptotic: bool,
    /// Whether the run broke.
    pub failed: bool,
}

impl Sample {
    /// Whether the level says what an error costs. Written so that NaN does not.
    pub fn counts(&self) -> bool {
        let sound = self.error >= 0.0 && self.error.is_finite();
        self.usable && !self.failed && sound && self.work > 0.0 && self.work.is_finite()
    }

    /// Whether it has a place on logarithmic axes.
    pub(crate) fn has_logarithm(&self) -> bool {
        self.counts() && self.error > 0.0 && self.spacing > 0.0 && self.spacing.is_finite()
    }
}
