//! Seconds that were measured, and on what machine.

/// Repeated measurements of one thing, in seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// The median.
    pub median: f64,
    /// The lower quartile.
    pub low: f64,
    /// The upper quartile.
    pub high: f64,
    /// How many there are.
    pub repeats: usize,
}

/// State of the machine, by which its seconds can be judged.
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    /// Cores that the process may use.
    pub cores: usize,
    /// Load average over a minute, before and after, where the system tells it.
    pub load: Option<[f64; 2]>,
    /// Share of the time for which the measuring thread waited for a core; it has been left out of
    /// all seconds. Absent where the system does not tell it: then it is in them.
    pub waited: Option<f64>,
    /// A loop that always does the same, timed between all other measurements: its spread is the
    /// noise of clock frequency and of other processes.
    pub fixed_loop: Option<Timing>,
}

impl Timing {
    /// Median and quartiles; none without samples, or if one is not a number.
    pub fn of(samples: &[f64]) -> Option<Self> {
        if samples.is_empty() || samples.iter().any(|s| !s.is_finite()) {
            return None;
        }
        let mut sorted = samples.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let place = share * (sorted.len() - 1) as f64;
            let below = place as usize;
            let above = (below + 1).min(sorted.len() - 1);
            sorted[below] + (sorted[above] - sorted[below]) * (place - below as f64)
        };
        Some(Self { median: at(0.5), low: at(0.25), high: at(0.75), repeats: sorted.len() })
    }

    /// The interquartile range over the median.
    pub fn spread(&self) -> f64 {
        (self.high - self.low) / self.median
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles() {
        let timing = Timing::of(&[5.0, 1.0, 3.0, 2.0, 4.0]).unwrap();
        assert_eq!((timing.low, timing.median, timing.high, timing.repeats), (2.0, 3.0, 4.0, 5));
        assert_eq!(timing.spread(), 2.0 / 3.0);
        let two = Timing::of(&[2.0, 1.0]).unwrap();
        assert_eq!((two.low, two.median, two.high), (1.25, 1.5, 1.75));
        let one = Timing::of(&[7.0]).unwrap();
        assert_eq!((one.low, one.median, one.high), (7.0, 7.0, 7.0));
    }

    #[test]
    fn nothing_measured_is_no_time() {
        assert_eq!(Timing::of(&[]), None);
        assert_eq!(Timing::of(&[1.0, f64::NAN]), None);
    }
}
