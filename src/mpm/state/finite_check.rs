//! Check that the state of the particles is finite.
//!
//! A NaN spreads through the grid to all that see the same nodes, or hides behind a node that is
//! fixed or has no mass: each quantity is checked where it is computed, so that the
//! failure names the particle it began at.

use crate::mpm::algebra::{Matrix, Vector};
use crate::mpm::particles::Particles;
use crate::mpm::simd::vectorized;
use crate::subject::{Failure, Site};

impl<const D: usize> Particles<D> {
    /// Names the first particle of which any number is not finite: before the first step.
    ///
    /// # Errors
    /// [`Failure::NonFinite`].
    pub(in crate::mpm) fn all_finite(&self) -> Result<(), Failure> {
        first("position", &self.x, vector)?;
        first("reference position", &self.x0, vector)?;
        first("velocity", &self.v, vector)?;
        first("mass", &self.mass, |m| m.is_finite())?;
        first("reference volume", &self.vol0, |vol| vol.is_finite())?;
        first("volume", &self.vol, |vol| vol.is_finite())?;
        first("velocity gradient", &self.grad_v, matrix)?;
        first("temperature", &self.temperature, |t| t.is_finite())?;
        self.deformed_finite()?;
        self.stressed_finite()
    }

    /// The same for F, after an update from velocity gradients.
    ///
    /// # Errors
    /// [`Failure::NonFinite`].
    pub(in crate::mpm) fn deformed_finite(&self) -> Result<(), Failure> {
        first("deformation gradient", &self.def_grad, matrix)
    }

    /// The same for stresses.
    ///
    /// # Errors
    /// [`Failure::NonFinite`].
    pub(in crate::mpm) fn stressed_finite(&self) -> Result<(), Failure> {
        first("hoop stress", &self.stress_across, |s| s.is_finite())?;
        first("stress", &self.sigma, matrix)
    }

    /// The same for velocities, at the end of a step.
    ///
    /// # Errors
    /// [`Failure::NonFinite`].
    pub(in crate::mpm) fn moving_finite(&self) -> Result<(), Failure> {
        first("velocity", &self.v, vector)
    }
}

/// Whether every number of a column is finite.
pub(in crate::mpm) fn all_finite<const D: usize>(column: &[Matrix<D>]) -> bool {
    all(column, matrix)
}

/// Without early exit, so that several numbers are checked at a time.
#[inline(always)]
fn all<T>(column: &[T], sound: impl Fn(&T) -> bool) -> bool {
    vectorized(
        #[inline(always)]
        || {
            let mut all = true;
            for entry in column {
                all &= sound(entry);
            }
            all
        },
    )
}

/// Searches for the particle only if there is one.
#[inline(always)]
fn first<T>(
    quantity: &'static str,
    column: &[T],
    sound: impl Fn(&T) -> bool,
) -> Result<(), Failure> {
    if all(column, &sound) {
        return Ok(());
    }
    match column.iter().position(|entry| !sound(entry)) {
        Some(p) => Err(Failure::NonFinite { quantity, site: Site::Particle(p) }),
        None => Ok(()),
    }
}

#[inline(always)]
fn vector<const D: usize>(v: &Vector<D>) -> bool {
    v.as_slice().iter().fold(true, |all, c| all & c.is_finite())
}

#[inline(always)]
fn matrix<const D: usize>(m: &Matrix<D>) -> bool {
    m.as_slice().iter().fold(true, |all, c| all & c.is_finite())
}
