//! The amplification matrix of a step of a solver whose particles keep their position on the grid.
//!
//! Near rest, `s(n+1) = A s(n)` for small perturbations. Column j of A is computed from runs with
//! entry j perturbed; central differences eliminate quadratic terms (volume times stress). Entries
//! are scaled by their natural sizes, which does not change eigenvalues.

use mpm_subject::{Failure, Perturbable};
use nalgebra::DMatrix;
use thiserror::Error;

/// Size of a perturbation, relative to the natural size of the entry. The rounding error of F = I
/// plus the perturbation is then 1e-10 of the perturbation.
const STEP: f64 = 1e-6;

/// Maximum change of a state of rest in a step, relative to the natural sizes.
const REST: f64 = 1e-12;

/// Maximum difference from the identity matrix that counts as a rounding error.
const ROUNDING: f64 = 1e-8;

/// Reason why a step has no amplification matrix.
#[derive(Debug, Error)]
pub enum AmplificationError {
    /// The unperturbed state changes in a step.
    #[error("the body does not stay at rest by itself")]
    NotAtRest,
    /// A step of the solver failed.
    #[error("{0}")]
    Failed(Failure),
}

/// Computes the amplification matrix of consecutive steps of lengths `dt` (s). `subject` must be at
/// rest, with particles that do not move relative to the grid. `speed` (m/s) and `modulus` (Pa) are
/// natural sizes. A constant entry that affects no other has no row; its eigenvalue is one.
///
/// # Errors
/// If the body is not at rest, or if a step fails.
pub fn amplification(
    subject: &mut dyn Perturbable,
    dt: &[f64],
    speed: f64,
    modulus: f64,
) -> Result<DMatrix<f64>, AmplificationError> {
    let (mut sizes, mut rest, mut after) = (Vec::new(), Vec::new(), Vec::new());
    subject.sizes(speed, modulus, &mut sizes);
    subject.state(&mut rest);
    advance(subject, dt)?;
    subject.state(&mut after);
    let moved = rest.iter().zip(&after).zip(&sizes).map(|((a, b), size)| (b - a).abs() / size);
    if !moved.fold(0.0, crate::verify::larger).le(&REST) {
        return Err(AmplificationError::NotAtRest);
    }
    let n = rest.len();
    let mut full = DMatrix::zeros(n, n);
    let mut state = rest.clone();
    for j in 0..n {
        for sign in [1.0, -1.0] {
            state.copy_from_slice(&rest);
            state[j] += sign * STEP * sizes[j];
            subject.set_state(&state);
            advance(subject, dt)?;
            subject.state(&mut after);
            for i in 0..n {
                full[(i, j)] += sign * (after[i] - rest[i]) / (2.0 * STEP * sizes[i]);
            }
        }
    }
    subject.set_state(&rest);
    Ok(reduced(&full))
}

fn advance(subject: &mut dyn Perturbable, dt: &[f64]) -> Result<(), AmplificationError> {
    dt.iter().try_for_each(|dt| subject.step(*dt)).map_err(AmplificationError::Failed)
}

/// Removes the entries whose column is a column of the identity matrix.
fn reduced(full: &DMatrix<f64>) -> DMatrix<f64> {
    let keeps_itself = |j: usize| {
        let expected = |i: usize| if i == j { 1.0 } else { 0.0 };
        (0..full.nrows()).all(|i| (full[(i, j)] - expected(i)).abs() <= ROUNDING)
    };
    let kept: Vec<usize> = (0..full.ncols()).filter(|j| !keeps_itself(*j)).collect();
    DMatrix::from_fn(kept.len(), kept.len(), |i, j| full[(kept[i], kept[j])])
}

#[cfg(test)]
mod tests {
    use super::*;
    use mpm_subject::{RunCounters, Samples, Subject};

    /// The step `a' = a/2 + b, b' = 3 dt b` of three numbers; `third` advances the third one.
    struct Linear {
        state: Vec<f64>,
        third: fn(f64) -> f64,
    }

    impl Subject for Linear {
        fn step(&mut self, dt: f64) -> Result<(), Failure> {
            let [a, b, c] = self.state[..] else { return Ok(()) };
            self.state = vec![0.5 * a + b, 3.0 * dt * b, (self.third)(c)];
            Ok(())
        }

        fn sample(&self, _: &mut Samples) {}

        fn counters(&self) -> RunCounters {
            RunCounters::new(0)
        }
    }

    impl Perturbable for Linear {
        fn fix_configuration(&mut self) {}

        fn state(&self, state: &mut Vec<f64>) {
            state.clone_from(&self.state);
        }

        fn set_state(&mut self, state: &[f64]) {
            self.state = state.to_vec();
        }

        fn sizes(&self, speed: f64, modulus: f64, sizes: &mut Vec<f64>) {
            *sizes = vec![speed, modulus, 1.0];
        }
    }

    fn matrix(third: fn(f64) -> f64) -> Result<DMatrix<f64>, AmplificationError> {
        amplification(&mut Linear { state: vec![0.0; 3], third }, &[1.0], 10.0, 40.0)
    }

    /// One unit of b equals four of a. An entry that affects only itself has no row.
    #[test]
    fn amplification_matrix_of_a_linear_step_is_exact() {
        let found = matrix(|c| c).unwrap();
        let expected = DMatrix::from_row_slice(2, 2, &[0.5, 4.0, 0.0, 3.0]);
        assert!((found - expected).amax() < 1e-9);
        assert_eq!(matrix(|c| 2.0 * c).unwrap().nrows(), 3);
        // With b' = 3 b and then b' = 6 b, a' = a/4 + b/2 + 3 b.
        let mut linear = Linear { state: vec![0.0; 3], third: |c| c };
        let found = amplification(&mut linear, &[1.0, 2.0], 1e-6, 1e6).unwrap();
        let expected = DMatrix::from_row_slice(2, 2, &[0.25, 3.5e12, 0.0, 18.0]);
        assert!((found - &expected).component_div(&expected.map(|x| x.max(1.0))).amax() < 1e-9);
    }

    #[test]
    fn moving_body_has_no_amplification_matrix() {
        assert!(matrix(|c| c + 1e-9).is_err());
        assert!(matrix(|_| f64::NAN).is_err());
    }
}
