//! Whether the state of the particles is made of numbers.
//!
//! A NaN spreads through the grid to all that see the same nodes, or hides behind a node that is
//! fixed or has no mass: what is not finite is looked for where it comes about, so that the particle
//! that is named is the one to blame.

use crate::{
    mpm::{
        algebra::{Matrix, Vector},
        particles::Particles,
    },
    subject::{Failure, Site},
};

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
        self.strained_finite()
    }

    /// The same for what has just come of a velocity gradient: F and the stress. The volume is
    /// looked at by who knows what it means.
    ///
    /// # Errors
    /// [`Failure::NonFinite`].
    pub(in crate::mpm) fn strained_finite(&self) -> Result<(), Failure> {
        first("deformation gradient", &self.def_grad, matrix)?;
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

/// Looks for the particle to blame only if there is one: the loop that every step makes has no early
/// way out, so that several numbers are looked at at a time.
#[inline(always)]
fn first<T>(
    quantity: &'static str,
    column: &[T],
    sound: impl Fn(&T) -> bool,
) -> Result<(), Failure> {
    if column.iter().fold(true, |all, entry| all & sound(entry)) {
        return Ok(());
    }
    match column.iter().position(|entry| !sound(entry)) {
        Some(p) => Err(Failure::NonFinite { quantity, site: Site::Particle(p) }),
        None => Ok(()),
    }
}

#[inline(always)]
fn vector<const D: usize>(v: &Vector<D>) -> bool {
    v.iter().fold(true, |all, c| all & c.is_finite())
}

#[inline(always)]
fn matrix<const D: usize>(m: &Matrix<D>) -> bool {
    m.iter().fold(true, |all, c| all & c.is_finite())
}
