//! The results of a stability study.

use crate::verify::{RunFigure, Stability, StabilityLimit, Trial, format_number};
use mpm_subject::SubjectError;

/// Results of a stability study: one row for each value of the swept parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct StabilityStudy {
    /// Name of the swept parameter.
    pub swept: String,
    /// Name of the parameter whose stability limit the study searches for, if any.
    pub sought: Option<String>,
    /// Measured values that tables show.
    pub figures: Vec<RunFigure>,
    /// The rows.
    pub rows: Vec<StabilityRow>,
}

/// Results for one value of the swept parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct StabilityRow {
    /// Value of the swept parameter.
    pub value: f64,
    /// Result of the run; `None` if the study seeks a limit.
    pub trial: Option<Trial>,
    /// Stability limit, if the study seeks one.
    pub critical: Option<Critical>,
    /// Reason why there is neither a run nor a limit.
    pub refused: Option<SubjectError>,
}

/// Predicted and observed stability limit.
#[derive(Debug, Clone, PartialEq)]
pub struct Critical {
    /// Prediction from the amplification matrix, with particles at rest on the grid.
    pub predicted: Option<Prediction>,
    /// Runs below and above the prediction, with parameter values divided by the prediction.
    pub confirmed: Vec<(f64, Trial)>,
    /// Limit from runs by bisection, if there is no prediction.
    pub observed: Option<StabilityLimit>,
}

/// Limit predicted from an amplification matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// Parameter value at which the spectral radius exceeds one.
    pub limit: StabilityLimit,
    /// Eigenvalue that leaves the unit circle: real part, and magnitude of the imaginary part.
    pub leaves: Option<(f64, f64)>,
}

impl Critical {
    /// Returns the predicted limit; without a prediction, the observed limit.
    pub fn limit(&self) -> Option<StabilityLimit> {
        self.predicted.map(|prediction| prediction.limit).or(self.observed)
    }
}

impl StabilityStudy {
    /// Whether the method fails at the problem. Such a failure may be expected.
    pub fn fails(&self) -> bool {
        let is_stable = |trial: &Trial| trial.verdict == Stability::Stable;
        self.sought.is_none()
            && !self.rows.iter().all(|row| row.trial.as_ref().is_some_and(is_stable))
    }

    /// Summarises the verdicts of the rows, or the stability limits.
    pub fn verdict(&self) -> String {
        if let Some(sought) = &self.sought {
            return format!("limit of {sought}");
        }
        let trials = self.rows.iter().map(|row| row.trial.as_ref());
        let words = trials.map(|trial| trial.map_or("failed", |trial| trial.verdict.words()));
        let mut words: Vec<&str> = words.collect();
        words.dedup();
        words.join(", ")
    }

    /// Explains the verdict with measured values.
    pub fn reason(&self) -> String {
        let count = self.rows.len();
        let values = if count == 1 { "value" } else { "values" };
        let all = format!("{count} {values} of `{}`", self.swept);
        if self.sought.is_none() {
            let stable = |row: &&StabilityRow| {
                row.trial.as_ref().is_some_and(|trial| trial.verdict == Stability::Stable)
            };
            let stable = self.rows.iter().filter(stable).count();
            return format!("stable for {stable} of {all}");
        }
        let critical = || self.rows.iter().filter_map(|row| row.critical.as_ref());
        let values: Vec<f64> =
            critical().filter_map(|critical| critical.limit()?.value()).collect();
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(0.0, f64::max);
        let runs: usize = critical().map(|critical| critical.confirmed.len()).sum();
        let longest = critical().max_by_key(|critical| critical.confirmed.len());
        let shares = longest.into_iter().flat_map(|critical| &critical.confirmed);
        let shares: Vec<String> = shares.map(|(share, _)| share.to_string()).collect();
        let found = if values.is_empty() {
            format!("none in the range, for {all}")
        } else {
            let (least, most) = (format_number(least), format_number(most));
            let range = if least == most { least } else { format!("from {least} to {most}") };
            format!("{range} for {all}")
        };
        if runs == 0 {
            found
        } else {
            format!("{found}; {runs} runs at {} times the predicted limits", shares.join(", "))
        }
    }
}
