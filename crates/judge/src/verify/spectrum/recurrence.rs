//! Computes the trace and determinant of a linear step from a series of its states.
//!
//! On the grid, the state of a Fourier mode of a linear scheme consists of two numbers, and a step
//! multiplies it by a 2 x 2 matrix. By the Cayley-Hamilton theorem each linear functional satisfies
//! `y(k+2) = tr y(k+1) - det y(k)`, here plus a constant that the grid does not resolve.

use std::f64::consts::TAU;

/// Minimum number of values in a series: six values give four equations for three unknowns.
const FEWEST: usize = 6;

/// A recurrence `y(k+2) = tr y(k+1) - det y(k) + constant`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recurrence {
    determinant: f64,
    /// `1 - tr + det`, which is small if the phase angle per step is small.
    deficit: f64,
}

impl Recurrence {
    /// Fits the recurrence by least squares. All results are NaN for short or constant series.
    ///
    /// The unknowns are `det` and `1 - tr + det`, the coefficients of `d = y(k+1) - y(k)` and `a =
    /// y(k+1)` in `y(k+2) - y(k+1) = det d - (1 - tr + det) a`. These columns are nearly orthogonal
    /// for an oscillation. Subtracting the means eliminates the constant.
    pub fn fit(series: &[f64]) -> Self {
        if series.len() < FEWEST {
            return Self { determinant: f64::NAN, deficit: f64::NAN };
        }
        let rows = || series.windows(3).map(|y| [y[1] - y[0], y[1], y[2] - y[1]]);
        let count = (series.len() - 2) as f64;
        let mut mean = [0.0; 3];
        for row in rows() {
            for (mean, value) in mean.iter_mut().zip(row) {
                *mean += value / count;
            }
        }
        // Normal equations of the two columns `d` and `a`, with the right-hand side `e`.
        let [mut dd, mut da, mut aa, mut de, mut ae] = [0.0; 5];
        for [d, a, e] in rows() {
            let (d, a, e) = (d - mean[0], a - mean[1], e - mean[2]);
            dd += d * d;
            da += d * a;
            aa += a * a;
            de += d * e;
            ae += a * e;
        }
        let scale = dd * aa - da * da;
        let determinant = (de * aa - ae * da) / scale;
        Self { determinant, deficit: (de * da - ae * dd) / scale }
    }

    /// Creates the recurrence with this trace and determinant.
    pub fn new(trace: f64, determinant: f64) -> Self {
        Self { determinant, deficit: 1.0 - trace + determinant }
    }

    /// Returns the sum of the eigenvalues of the step.
    pub fn trace(&self) -> f64 {
        1.0 + self.determinant - self.deficit
    }

    /// Returns the product of the eigenvalues of the step.
    pub fn determinant(&self) -> f64 {
        self.determinant
    }

    /// Returns `4 det - tr^2`, which is positive if the eigenvalues are complex.
    fn discriminant(&self) -> f64 {
        let lost = 1.0 - self.determinant;
        2.0 * self.deficit * (1.0 + self.determinant) - self.deficit * self.deficit - lost * lost
    }

    /// Returns the phase angle per step (rad), the argument of the complex eigenvalues; `None` if
    /// the eigenvalues are real or NaN.
    pub fn angle(&self) -> Option<f64> {
        let discriminant = self.discriminant();
        (discriminant > 0.0).then(|| libm::atan2(discriminant.sqrt(), self.trace()))
    }

    /// Returns the logarithm of the largest modulus of an eigenvalue.
    pub fn log_modulus(&self) -> f64 {
        let discriminant = self.discriminant();
        if discriminant > 0.0 {
            return 0.5 * libm::log(self.determinant);
        }
        libm::log(0.5 * (self.trace().abs() + (-discriminant).sqrt()))
    }

    /// Returns the relative error of the phase speed of a wave of `cells` cells, at the Courant
    /// number `courant`. `None` if the wave is overdamped and has no phase.
    pub fn phase_error(&self, cells: f64, courant: f64) -> Option<f64> {
        Some(self.angle()? / (TAU / cells * courant) - 1.0)
    }

    /// Returns the logarithm of the amplitude factor over one exact period of a wave of `cells`
    /// cells, at the Courant number `courant`.
    pub fn log_kept_per_period(&self, cells: f64, courant: f64) -> f64 {
        self.log_modulus() * cells / courant
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    fn series(trace: f64, determinant: f64, constant: f64, count: usize) -> Vec<f64> {
        let mut y = vec![1.0, 0.9];
        for k in 2..count {
            y.push(trace * y[k - 1] - determinant * y[k - 2]);
        }
        y.iter().map(|y| y + constant).collect()
    }

    #[rstest]
    #[case::undamped(1.98, 1.0)]
    #[case::damped(1.9, 0.95)]
    #[case::overdamped(1.2, 0.3)]
    #[case::wave_of_two_cells(-0.5, 0.9)]
    fn fit_recovers_the_coefficients_of_a_series(
        #[case] trace: f64,
        #[case] determinant: f64,
        #[values(0.0, 0.3)] constant: f64,
    ) {
        let fit = Recurrence::fit(&series(trace, determinant, constant, 60));
        assert_relative_eq!(fit.trace(), trace, epsilon = 1e-12);
        assert_relative_eq!(fit.determinant(), determinant, epsilon = 1e-12);
    }

    /// The eigenvalues `r exp(+-i phi)` have the trace `2 r cos phi` and the determinant `r^2`.
    #[test]
    fn angle_and_modulus_agree_with_the_eigenvalues() {
        let (r, phi) = (0.97, 0.2);
        let found = Recurrence::new(2.0 * r * libm::cos(phi), r * r);
        assert_relative_eq!(found.angle().unwrap(), phi, max_relative = 1e-12);
        assert_relative_eq!(found.log_modulus(), libm::log(r), max_relative = 1e-12);
        // Ten cells at C = 0.25: the exact angle is pi/20, and a period has 40 steps.
        let error = found.phase_error(10.0, 0.25).unwrap();
        assert_relative_eq!(error, phi / (TAU / 40.0) - 1.0, max_relative = 1e-12);
        let log_kept = found.log_kept_per_period(10.0, 0.25);
        assert_relative_eq!(log_kept, 40.0 * libm::log(r), max_relative = 1e-12);
    }

    /// Real eigenvalues, here 0.5 and 0.6 or -0.5 and -0.6, have no phase. The larger modulus
    /// determines the damping.
    #[test]
    fn an_overdamped_wave_has_no_phase() {
        for trace in [1.1, -1.1] {
            let found = Recurrence::new(trace, 0.3);
            assert_eq!(found.angle(), None);
            assert_relative_eq!(found.log_modulus(), libm::log(0.6), max_relative = 1e-12);
        }
    }

    #[test]
    fn a_series_that_does_not_determine_the_recurrence_is_nan() {
        for series in [vec![1.0; 20], vec![1.0, 2.0, 3.0], vec![f64::NAN; 20], Vec::new()] {
            let fit = Recurrence::fit(&series);
            assert!(fit.trace().is_nan() && fit.angle().is_none());
            assert!(fit.log_modulus().is_nan());
        }
    }
}
