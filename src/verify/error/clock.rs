//! From a wanted time step to a run that ends exactly where it should.

/// The steps of one run. Errors are taken at equally spaced instants, the same on every level,
/// and every instant is the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// End of the run (s).
    pub until: f64,
    /// Number of steps, a multiple of `instants`.
    pub steps: u64,
    /// Number of instants at which the error is taken, the last one at `until`.
    pub instants: u64,
}

/// No run takes more steps than this: a misspelt dt must not run for years.
pub const MOST_STEPS: f64 = 1e9;

impl Clock {
    /// The largest step that is not above `wanted` (s) and divides the time between instants.
    /// `None` if `wanted` or `until` is not positive and finite, or if more than [`MOST_STEPS`]
    /// steps would be needed.
    pub fn new(until: f64, wanted: f64, instants: u64) -> Option<Self> {
        let between = until / (wanted * instants as f64);
        // A ratio that is a whole number but for rounding is that number.
        let steps = libm::ceil(between * (1.0 - 1e-12)).max(1.0) * instants as f64;
        let usable = until > 0.0 && wanted > 0.0 && until.is_finite() && instants > 0;
        (usable && steps <= MOST_STEPS).then_some(Self { until, steps: steps as u64, instants })
    }

    /// Length of a step (s).
    pub fn dt(&self) -> f64 {
        self.until / self.steps as f64
    }

    /// Time after `step` steps, without accumulated rounding.
    pub fn time(&self, step: u64) -> f64 {
        self.until * step as f64 / self.steps as f64
    }

    /// Whether the error is taken after `step` steps.
    pub fn is_instant(&self, step: u64) -> bool {
        step.is_multiple_of(self.steps / self.instants)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case::talk(0.5, 1e-3, 50, Some(500))]
    #[case::rounded_up_to_instants(0.5, 3e-3, 50, Some(200))]
    #[case::coarse(0.5, 1.0, 50, Some(50))]
    #[case::zero(0.5, 0.0, 50, None)]
    #[case::negative(0.5, -1e-3, 50, None)]
    #[case::nan(0.5, f64::NAN, 50, None)]
    #[case::years(1.0, 1e-12, 50, None)]
    fn steps_of_a_run(
        #[case] until: f64,
        #[case] wanted: f64,
        #[case] instants: u64,
        #[case] steps: Option<u64>,
    ) {
        let clock = Clock::new(until, wanted, instants);
        assert_eq!(clock.map(|c| c.steps), steps);
        if let Some(clock) = clock {
            assert!(clock.dt() <= wanted * (1.0 + 1e-9));
            let taken = (1..=clock.steps).filter(|k| clock.is_instant(*k)).count();
            assert_eq!(taken as u64, instants);
            assert!(clock.is_instant(clock.steps));
        }
    }
}
