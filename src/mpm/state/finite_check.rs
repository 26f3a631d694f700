//! Check that the state of the particles is finite.
//!
//! A NaN spreads through the grid to all that see the same nodes, or hides behind a node that is
//! fixed or has no mass: each quantity is checked where it is computed, so that the
//! failure names the particle it began at.

use crate::mpm::algebra::{Matrix, Vector};
use crate::mpm::particles::Particles;
use crate::mpm::simd::vectorized;
use crate::mpm::threads::{FEW, join};
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
    all(column, &matrix)
}

/// On all threads, and without early exit, so that several numbers are checked at a time.
fn all<T: Sync>(column: &[T], sound: &(impl Fn(&T) -> bool + Sync)) -> bool {
    if column.len() > FEW {
        let ((low, high), mut both) = (column.split_at(column.len() / 2), [true; 2]);
        let [one, other] = &mut both;
        join(|| *one = all(low, sound), || *other = all(high, sound));
        return both == [true; 2];
    }
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
fn first<T: Sync>(
    quantity: &'static str,
    column: &[T],
    sound: impl Fn(&T) -> bool + Sync,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::particles::Block;
    use rayon::ThreadPoolBuilder;
    use rstest::rstest;

    #[rstest]
    fn the_first_of_many_is_named(
        #[values(f64::NAN, f64::INFINITY)] wrong: f64,
        #[values(0, FEW + 18, 2 * FEW + 36)] first: usize,
        #[values(1, 3)] threads: usize,
    ) {
        let (from, to) = (Vector::zeros(), Vector::<1>::new((2 * FEW + 37) as f64));
        let mut row = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, 1);
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| row.moving_finite()), Ok(()));
        (row.v[first][0], row.v[2 * FEW + 36][0]) = (wrong, wrong);
        let found = Failure::NonFinite { quantity: "velocity", site: Site::Particle(first) };
        assert_eq!(pool.install(|| row.moving_finite()), Err(found));
    }
}
