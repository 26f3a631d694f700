//! Results of one run: all that is judged, reported and kept of it.

use super::error_field::ErrorField;
use super::norm::RunErrors;
use super::observer::History;
use crate::subject::{RunCounters, Totals};
use crate::verify::conservation::ConservationError;
use crate::verify::order::fit::Interval;
use serde::{Deserialize, Serialize};

/// Results of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RunResult {
    /// Errors of the compared quantity.
    pub errors: RunErrors,
    /// Errors of the displacement (m), where another quantity is compared.
    pub displacement_errors: Option<RunErrors>,
    /// How far the body's totals drifted, if the subject gives them; NaN if the run failed.
    pub drift: Option<ConservationError>,
    /// The totals at t = 0 and at every instant that was reached (s), if the subject gives them.
    pub account: Vec<(f64, Totals)>,
    /// Rate of the energy, d ln E/dt (1/s), over the run, with its confidence interval.
    pub energy_rate: Option<Interval>,
    /// Counters at the end, or at the failure.
    pub counters: RunCounters,
    /// Steps taken.
    pub steps: u64,
    /// Why and when the run ended early.
    pub failure: Option<String>,
    /// The observed label, if one was asked for and the run came to its end.
    pub history: Option<History>,
    /// Errors over the body at the end, or at the failure, if they were asked for.
    pub field: Option<ErrorField>,
    /// Displacement at the observed place at the end (m), if it could be interpolated.
    pub displacement: Option<Vec<f64>>,
    /// Its distance (m) from the exact one.
    pub observed_error: Option<f64>,
    /// Largest speed towards the end, over
    /// [`Comparison::at_rest`](crate::verify::Comparison::at_rest), where that is given.
    pub residual_speed: Option<f64>,
}

impl RunResult {
    /// Errors of the displacement (m), whatever is compared.
    pub fn errors_of_displacement(&self) -> &RunErrors {
        self.displacement_errors.as_ref().unwrap_or(&self.errors)
    }
}
