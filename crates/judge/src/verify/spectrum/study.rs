//! Rows of a spectrum study.

use super::recurrence::Recurrence;

/// Phase error and damping of a wave, measured or predicted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveFigures {
    /// Relative error of the phase speed; `None` if the wave is overdamped and has no phase.
    pub phase_error: Option<f64>,
    /// Logarithm of the amplitude factor over one exact period.
    pub log_kept: f64,
}

impl WaveFigures {
    /// Computes phase error and damping of a wave of `cells` cells at the Courant number `courant`.
    pub fn of(step: &Recurrence, cells: f64, courant: f64) -> Self {
        Self {
            phase_error: step.phase_error(cells, courant),
            log_kept: step.log_kept_per_period(cells, courant),
        }
    }

    /// Returns the amplitude factor over one exact period.
    pub fn kept(&self) -> f64 {
        libm::exp(self.log_kept)
    }
}

/// Results for one wave of one method.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumRow {
    /// Wavelength (cells).
    pub cells: f64,
    /// Courant number.
    pub courant: f64,
    /// Number of steps of the run.
    pub steps: u64,
    /// Phase error and damping from the closed form, if one is known for the method.
    pub predicted: Option<WaveFigures>,
    /// Phase error and damping from the run, or the reason why there are none.
    pub measured: Result<WaveFigures, String>,
    /// Minimum number of cells per wavelength for a predicted phase error below 1 %. `None` without
    /// a prediction, or if this holds for all waves of two cells or more.
    pub cells_for_one_percent: Option<f64>,
    /// Predicted stability limit of the Courant number.
    pub limit: Option<f64>,
}

/// Results of a spectrum study: one row for each wavelength and Courant number.
#[derive(Debug, Clone)]
pub struct SpectrumStudy {
    /// The rows.
    pub rows: Vec<SpectrumRow>,
}

impl SpectrumStudy {
    /// Whether the method fails at the problem. Such a failure may be expected.
    pub fn fails(&self) -> bool {
        self.rows.iter().any(|row| row.measured.is_err())
    }

    /// Returns text with the largest measured phase error and the smallest amplitude.
    pub fn reason(&self) -> String {
        let measured = || self.rows.iter().filter_map(|row| row.measured.as_ref().ok());
        let phases = measured().filter_map(|figures| figures.phase_error).map(f64::abs);
        let most = phases.fold(0.0, crate::verify::larger);
        let kept = measured().map(WaveFigures::kept).fold(f64::INFINITY, f64::min);
        let (count, failed) = (self.rows.len(), self.rows.len() - measured().count());
        if failed == count {
            return format!("no results: all {count} runs failed");
        }
        let failed = if failed == 0 { String::new() } else { format!(", {failed} of them failed") };
        format!(
            "phase error up to {:.2} %, amplitude per period at least {:.4}, over {count} runs{failed}",
            100.0 * most,
            kept
        )
    }
}
