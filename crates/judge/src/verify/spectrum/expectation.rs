//! Expectations of a spectrum study.

use crate::verify::{AMPLITUDE, SpectrumRow};

/// Maximum deviations from the prediction, divided by the predicted value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumExpectation {
    /// Maximum deviation of the phase error.
    pub phase_within: Option<f64>,
    /// Maximum deviation of the logarithm of the amplitude per period. A difference per step below
    /// the strain of the wave is accepted, because the closed form assumes particles at rest and
    /// neglects terms of this order.
    pub damping_within: Option<f64>,
}

impl SpectrumExpectation {
    /// Returns the expectation in one line.
    pub fn summary(&self) -> String {
        let phase = self
            .phase_within
            .map(|share| format!("phase error within {} of theory", percent(share)));
        let damping = self
            .damping_within
            .map(|share| format!("ln of the amplitude within {} of theory", percent(share)));
        [phase, damping].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    /// Lists the expectations that a row does not meet. NaN meets none of them.
    pub fn unmet(&self, row: &SpectrumRow) -> Vec<String> {
        let place = format!("{} cells, C = {}", row.cells, row.courant);
        let measured = match &row.measured {
            Ok(measured) => measured,
            Err(reason) => return vec![format!("{place}: {reason}")],
        };
        let Some(predicted) = &row.predicted else {
            return vec![format!("{place}: there is no prediction")];
        };
        let mut unmet = Vec::new();
        if let Some(within) = self.phase_within {
            let is_met = match (measured.phase_error, predicted.phase_error) {
                (Some(got), Some(wanted)) => (got - wanted).abs() <= within * wanted.abs(),
                (got, wanted) => got.is_none() && wanted.is_none(),
            };
            if !is_met {
                let text = |error: Option<f64>| {
                    error.map_or("none".to_owned(), |error| format!("{error:.6}"))
                };
                let (got, wanted) = (text(measured.phase_error), text(predicted.phase_error));
                unmet.push(format!("{place}: expected the phase error {wanted}, got {got}"));
            }
        }
        if let Some(within) = self.damping_within {
            let (got, wanted) = (measured.log_kept, predicted.log_kept);
            let floor = AMPLITUDE * row.cells / row.courant;
            if !((got - wanted).abs() <= within * wanted.abs() + floor) {
                unmet.push(format!(
                    "{place}: expected the amplitude {:.6} per period, got {:.6}",
                    predicted.kept(),
                    measured.kept()
                ));
            }
        }
        unmet
    }
}

/// Formats a fraction in per cent, rounded to six decimals: 0.07 is 7 %, not 7.000000000000001 %.
fn percent(share: f64) -> String {
    format!("{} %", libm::round(1e8 * share) / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::{SpectrumStudy, WaveFigures};

    const EXPECTED: SpectrumExpectation =
        SpectrumExpectation { phase_within: Some(0.02), damping_within: Some(0.02) };

    fn row(phase_error: Option<f64>, log_kept: f64) -> SpectrumRow {
        SpectrumRow {
            cells: 8.0,
            courant: 0.4,
            steps: 400,
            predicted: Some(WaveFigures { phase_error: Some(-0.05), log_kept: -0.1 }),
            measured: Ok(WaveFigures { phase_error, log_kept }),
            cells_for_one_percent: None,
            limit: None,
        }
    }

    #[test]
    fn figures_within_two_percent_are_met() {
        assert!(EXPECTED.unmet(&row(Some(-0.0509), -0.1019)).is_empty());
        assert_eq!(EXPECTED.unmet(&row(Some(-0.0511), -0.1)).len(), 1);
        assert_eq!(EXPECTED.unmet(&row(Some(-0.05), -0.1021)).len(), 1);
        assert_eq!(EXPECTED.unmet(&row(Some(0.05), 0.1)).len(), 2);
    }

    #[test]
    fn missing_figures_meet_nothing() {
        assert_eq!(EXPECTED.unmet(&row(None, f64::NAN)).len(), 2);
        assert_eq!(EXPECTED.unmet(&row(Some(f64::NAN), -0.1)).len(), 1);
        let failed = SpectrumRow { measured: Err("broke".to_owned()), ..row(None, 0.0) };
        assert_eq!(EXPECTED.unmet(&failed), ["8 cells, C = 0.4: broke"]);
        let unknown = SpectrumRow { predicted: None, ..row(Some(-0.05), -0.1) };
        assert_eq!(EXPECTED.unmet(&unknown).len(), 1);
    }

    #[test]
    fn the_largest_phase_error_and_the_smallest_amplitude_are_reported() {
        let failed = SpectrumRow { measured: Err("broke".to_owned()), ..row(None, 0.0) };
        let rows = vec![row(Some(-0.05), libm::log(0.9)), row(Some(0.03), libm::log(0.25)), failed];
        let text = "phase error up to 5.00 %, amplitude per period at least 0.2500, over 3 runs";
        let mut study = SpectrumStudy { rows };
        assert_eq!((study.reason(), study.fails()), (format!("{text}, 1 of them failed"), true));
        study.rows.pop();
        assert_eq!((study.reason(), study.fails()), (text.replace("3 runs", "2 runs"), false));
    }

    #[test]
    fn constant_amplitude_may_change_by_the_strain_per_step() {
        let undamped = |log_kept| SpectrumRow {
            predicted: Some(WaveFigures { phase_error: None, log_kept: 0.0 }),
            ..row(None, log_kept)
        };
        assert!(EXPECTED.unmet(&undamped(1.9e-5)).is_empty());
        assert_eq!(EXPECTED.unmet(&undamped(2.1e-5)).len(), 1);
    }
}
