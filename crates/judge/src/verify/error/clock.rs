//! Chooses a time step near the requested one, such that the run has a whole number of steps.

/// Number of steps of one run, and the evenly spaced ends of steps at which errors are measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// End of the run (s).
    pub until: f64,
    /// Number of steps.
    pub steps: u64,
    /// Number of instants at which the error is measured. The last instant is `until`.
    pub instants: u64,
}

/// Whether the steps of a run advance time or the load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StepKind {
    /// Steps in time.
    #[default]
    Time,
    /// Load steps, without time.
    Load,
}

/// Maximum number of steps of a run. The limit prevents endless runs due to a mistyped dt.
pub const MOST_STEPS: f64 = 1e9;

/// Maximum relative change of the step, which changes an observed order by at most 0.03.
pub const STEP_TOLERANCE: f64 = 0.01;

impl Clock {
    /// Creates a clock whose number of steps is nearest to `until / wanted`, where `wanted` is the
    /// requested step (s). With fewer steps than `instants`, every step ends at an instant. `None`
    /// if a time is not positive and finite, or for more than [`MOST_STEPS`] steps.
    pub fn new(until: f64, wanted: f64, instants: u64) -> Option<Self> {
        let steps = Self::usable(until, wanted, instants, libm::round(until / wanted))?;
        Some(Self { until, steps, instants: instants.min(steps) })
    }

    /// Creates a clock with the largest step, at most `wanted` (s), that divides the time between
    /// equally spaced instants. Runs with different steps then share their instants. `None` under
    /// the conditions of [`Clock::new`].
    pub fn with_common_instants(until: f64, wanted: f64, instants: u64) -> Option<Self> {
        let between = until / (wanted * instants as f64);
        // A ratio that is an integer up to rounding is rounded to this integer.
        let between = libm::ceil(between * (1.0 - 1e-12)).max(1.0);
        let steps = Self::usable(until, wanted, instants, between * instants as f64)?;
        Some(Self { until, steps, instants })
    }

    /// Returns `steps`, but at least one; `None` if the arguments are invalid.
    fn usable(until: f64, wanted: f64, instants: u64, steps: f64) -> Option<u64> {
        let positive = |time: f64| time > 0.0 && time.is_finite();
        let usable = positive(until) && positive(wanted) && instants > 0;
        (usable && steps <= MOST_STEPS).then_some(steps.max(1.0) as u64)
    }

    /// Returns the length of a step (s).
    pub fn dt(&self) -> f64 {
        self.until / self.steps as f64
    }

    /// Returns the time after `step` steps, without accumulated rounding errors.
    pub fn time(&self, step: u64) -> f64 {
        self.until * step as f64 / self.steps as f64
    }

    /// Whether the error is measured after `step` steps.
    pub fn is_instant(&self, step: u64) -> bool {
        is_instant(step, self.steps, self.instants)
    }
}

/// Whether step number `step` of `steps` ends at one of `instants`, which are evenly spaced.
pub fn is_instant(step: u64, steps: u64, instants: u64) -> bool {
    // Number of instants up to the end of a step. The number grows by one at an instant.
    let passed = |step: u64| u128::from(step) * u128::from(instants) / u128::from(steps);
    step > 0 && passed(step) > passed(step - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    fn taken(clock: &Clock) -> Vec<u64> {
        (1..=clock.steps).filter(|step| clock.is_instant(*step)).collect()
    }

    #[rstest]
    #[case::talk(0.5, 1e-3, 50, Some((500, 50)))]
    #[case::no_multiple_of_instants(0.5, 3e-3, 50, Some((167, 50)))]
    #[case::fewer_steps_than_instants(0.5, 0.051, 50, Some((10, 10)))]
    #[case::one_step(0.5, 1.0, 50, Some((1, 1)))]
    #[case::zero(0.5, 0.0, 50, None)]
    #[case::negative(0.5, -1e-3, 50, None)]
    #[case::no_time(0.0, 1e-3, 50, None)]
    #[case::nan(0.5, f64::NAN, 50, None)]
    #[case::no_instants(0.5, 1e-3, 0, None)]
    #[case::years(1.0, 1e-12, 50, None)]
    fn instants_do_not_change_the_step(
        #[case] until: f64,
        #[case] wanted: f64,
        #[case] instants: u64,
        #[case] found: Option<(u64, u64)>,
    ) {
        let clock = Clock::new(until, wanted, instants);
        assert_eq!(clock.map(|clock| (clock.steps, clock.instants)), found);
        let Some(clock) = clock else { return };
        let (off, steps) = ((clock.dt() / wanted - 1.0).abs(), clock.steps as f64);
        assert!(off <= 0.5 / steps + 1e-12, "{off} of the step");
        let taken = taken(&clock);
        assert_eq!((taken.len() as u64, taken.last()), (clock.instants, Some(&clock.steps)));
        for (k, step) in taken.iter().enumerate() {
            let equal = (k + 1) as f64 * until / clock.instants as f64;
            assert!((clock.time(*step) - equal).abs() <= clock.dt(), "instant {k}");
        }
    }

    #[rstest]
    #[case::talk(0.5, 1e-3, Some(500))]
    #[case::rounded_up_to_instants(0.5, 3e-3, Some(200))]
    #[case::coarse(0.5, 1.0, Some(50))]
    #[case::zero(0.5, 0.0, None)]
    fn common_instants_shorten_the_step(
        #[case] until: f64,
        #[case] wanted: f64,
        #[case] steps: Option<u64>,
    ) {
        let clock = Clock::with_common_instants(until, wanted, 50);
        assert_eq!(clock.map(|clock| clock.steps), steps);
        let Some(clock) = clock else { return };
        assert!(clock.dt() <= wanted * (1.0 + 1e-9));
        let every: Vec<u64> = (1..=50).map(|k| k * clock.steps / 50).collect();
        assert_eq!(taken(&clock), every);
    }
}
