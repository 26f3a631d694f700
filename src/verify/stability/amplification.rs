//! One step of a frozen subject as a matrix.
//!
//! About a state of rest the step is linear in small perturbations, `s(n+1) = A s(n)`. Column j of
//! A is what the subject itself makes of a unit perturbation of number j of its state: there is no
//! second implementation to agree with. The difference is taken on both sides of rest, so that what
//! is quadratic (volume times stress) drops out, and numbers are measured in their natural sizes,
//! which is a similarity and leaves eigenvalues alone.

use crate::subject::Perturbable;
use nalgebra::DMatrix;

/// Size of a perturbation. Laws of the deformation round it against F = I, to 1e-10 of the result.
const STEP: f64 = 1e-6;

/// Largest change of a state of rest in a step, in natural sizes.
const REST: f64 = 1e-12;

/// Size of differences of rounded numbers whose exact difference is zero.
const ROUNDING: f64 = 1e-8;

/// The amplification matrix of a step, or of several steps of the lengths `dt` (s) after one
/// another. `subject` must be frozen and at rest, with speeds of the size `speed` (m/s) and
/// stresses of the size `modulus` (Pa). Numbers of the state that nothing else depends on and that
/// only keep their own perturbation (the volume of a particle without stress) have an eigenvalue of
/// one and no row.
///
/// # Errors
/// One line, if the subject is not at rest or a perturbed step fails.
pub fn amplification(
    subject: &mut dyn Perturbable,
    dt: &[f64],
    speed: f64,
    modulus: f64,
) -> Result<DMatrix<f64>, String> {
    let (mut sizes, mut rest, mut after) = (Vec::new(), Vec::new(), Vec::new());
    subject.sizes(speed, modulus, &mut sizes);
    subject.state(&mut rest);
    advance(subject, dt)?;
    subject.state(&mut after);
    let moved = rest.iter().zip(&after).zip(&sizes).map(|((a, b), size)| (b - a).abs() / size);
    if !moved.fold(0.0, crate::verify::larger).le(&REST) {
        return Err("the body does not stay at rest by itself".to_owned());
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

fn advance(subject: &mut dyn Perturbable, dt: &[f64]) -> Result<(), String> {
    dt.iter().try_for_each(|dt| subject.step(*dt)).map_err(|failure| failure.to_string())
}

/// The matrix without the numbers whose column is that of the identity.
fn reduced(full: &DMatrix<f64>) -> DMatrix<f64> {
    let keeps_itself = |j: usize| {
        let expected = |i: usize| if i == j { 1.0 } else { 0.0 };
        (0..full.nrows()).all(|i| (full[(i, j)] - expected(i)).abs() <= ROUNDING)
    };
    let kept: Vec<usize> = (0..full.ncols()).filter(|j| !keeps_itself(*j)).collect();
    DMatrix::from_fn(kept.len(), kept.len(), |i, j| full[(kept[i], kept[j])])
}
