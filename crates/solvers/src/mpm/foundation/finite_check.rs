//! Checks that the state of the particles is finite.
//!
//! A NaN of one particle can spread to other particles through shared nodes. A node that is fixed
//! or has no mass can hide a NaN. Each quantity is therefore checked where it is computed, and the
//! failure names the first particle with a NaN.

use super::particles::Particles;
use super::simd::{LANES, vectorized};
use super::threads::{FEW, join};
use mpm_subject::{Failure, Site};
use nalgebra::SMatrix;

impl<const D: usize> Particles<D> {
    /// Checks all quantities before the first step.
    pub(in crate::mpm) fn all_finite(&self) -> Result<(), Failure> {
        first_matrix("position", &self.x)?;
        first_matrix("reference position", &self.x0)?;
        first_matrix("velocity", &self.v)?;
        first("mass", &self.mass, |m| m.is_finite())?;
        first("reference volume", &self.vol0, |vol| vol.is_finite())?;
        first("volume", &self.vol, |vol| vol.is_finite())?;
        first_matrix("velocity gradient", &self.grad_v)?;
        first("temperature", &self.temperature, |t| t.is_finite())?;
        self.deformed_finite()?;
        self.stressed_finite()
    }

    /// Checks F after its update from velocity gradients.
    pub(in crate::mpm) fn deformed_finite(&self) -> Result<(), Failure> {
        first_matrix("deformation gradient", &self.def_grad)
    }

    pub(in crate::mpm) fn stressed_finite(&self) -> Result<(), Failure> {
        first("hoop stress", &self.stress_across, |s| s.is_finite())?;
        first_matrix("stress", &self.sigma)
    }

    /// Checks that `J = V / V0` of every particle is positive and finite, and updates the smallest
    /// J of the run, `min_j`.
    pub(in crate::mpm) fn volumes_positive(&self, min_j: &mut f64) -> Result<(), Failure> {
        for (p, (vol, vol0)) in self.vol.iter().zip(&self.vol0).enumerate() {
            let (j, site) = (vol / vol0, Site::Particle(p));
            if !j.is_finite() {
                return Err(Failure::NonFinite { quantity: "J", site });
            }
            *min_j = min_j.min(j);
            if j <= 0.0 {
                return Err(Failure::Inverted { site, j });
            }
        }
        Ok(())
    }

    pub(in crate::mpm) fn moving_finite(&self) -> Result<(), Failure> {
        first_matrix("velocity", &self.v)
    }
}

/// Whether every number of a column is finite. The loop has no early exit, so that the compiler can
/// vectorise it.
pub(in crate::mpm) fn all_finite<const R: usize, const C: usize>(
    column: &[SMatrix<f64, R, C>],
) -> bool {
    if column.len() > FEW {
        let ((low, high), mut both) = (column.split_at(column.len() / 2), [true; 2]);
        let [one, other] = &mut both;
        join(|| *one = all_finite(low), || *other = all_finite(high));
        return both == [true; 2];
    }
    let (many, rest) = column.as_chunks::<LANES>();
    vectorized(
        #[inline(always)]
        || {
            let mut sound = [u64::MAX; LANES];
            for four in many {
                for register in 0..R * C {
                    for lane in 0..LANES {
                        let number = register * LANES + lane;
                        let x = four[number / (R * C)].as_slice()[number % (R * C)];
                        sound[lane] &= if x.is_finite() { u64::MAX } else { 0 };
                    }
                }
            }
            sound == [u64::MAX; LANES]
        },
    ) && rest.iter().all(is_finite)
}

/// Checks the whole column first, and searches for the invalid matrix only if this check fails.
fn first_matrix<const R: usize, const C: usize>(
    quantity: &'static str,
    column: &[SMatrix<f64, R, C>],
) -> Result<(), Failure> {
    if all_finite(column) { Ok(()) } else { first(quantity, column, is_finite) }
}

fn first<T>(
    quantity: &'static str,
    column: &[T],
    sound: impl Fn(&T) -> bool,
) -> Result<(), Failure> {
    match column.iter().position(|entry| !sound(entry)) {
        Some(p) => Err(Failure::NonFinite { quantity, site: Site::Particle(p) }),
        None => Ok(()),
    }
}

#[inline]
pub(in crate::mpm) fn is_finite<const R: usize, const C: usize>(
    matrix: &SMatrix<f64, R, C>,
) -> bool {
    matrix.iter().all(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::foundation::algebra::Matrix;
    use rayon::ThreadPoolBuilder;
    use rstest::rstest;

    #[rstest]
    fn first_non_finite_particle_is_named(
        #[values(f64::NAN, f64::INFINITY)] wrong: f64,
        #[values(0, FEW + 18, 2 * FEW + 36)] first: usize,
        #[values(1, 3)] threads: usize,
    ) {
        let mut row = Particles::cubes([2 * FEW + 37]);
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| row.moving_finite()), Ok(()));
        (row.v[first][0], row.v[2 * FEW + 36][0]) = (wrong, wrong);
        let found = Failure::NonFinite { quantity: "velocity", site: Site::Particle(first) };
        assert_eq!(pool.install(|| row.moving_finite()), Err(found));
    }

    #[test]
    fn every_number_of_every_matrix_is_checked() {
        let sound = [Matrix::<3>::from_element(1e308); 2 * LANES + 3];
        assert!(all_finite(&sound));
        for (p, number) in (0..sound.len()).flat_map(|p| (0..9).map(move |number| (p, number))) {
            let mut column = sound;
            column[p][number] = f64::NEG_INFINITY;
            assert!(!all_finite(&column), "number {number} of matrix {p}");
        }
    }
}
