//! Plates in plane stress: the out-of-plane stretch is determined by sigma_33 = 0.
//!
//! The volume of a particle is `V = J V0` with J over all three axes, so the forces in a plate
//! account for its current thickness.

use super::contract::Material;
use super::stress_update::{StressBlock, StressUpdate};
use crate::mpm::foundation::algebra::{Matrix, det};
use crate::mpm::foundation::particles::Particles;
use mpm_subject::Failure;

/// A law whose stress depends only on F, with an implementation in plane stress.
pub(super) trait FreeAcross: Send + Sync {
    /// Returns F_33 of a plate whose in-plane F has the determinant `area`.
    fn stretch(&self, area: f64) -> f64;

    /// Returns the in-plane sigma (Pa). `j` is the volume ratio over all three axes.
    fn cauchy<const D: usize>(&self, f: &Matrix<D>, j: f64) -> Matrix<D>;

    /// Returns the stored energy (J/m3) for the out-of-plane stretch `across`.
    fn density<const D: usize>(&self, f: &Matrix<D>, across: f64) -> f64;
}

/// A plate with a law whose stress depends only on F.
pub(super) struct PlaneStress<L>(pub(super) L);

impl<const D: usize, L: FreeAcross> Material<D> for PlaneStress<L> {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn keeps_stretch_across(&self) -> bool {
        true
    }

    fn stress_across(&self, _: usize, _: &Particles<D>) -> Option<f64> {
        Some(0.0)
    }

    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        let all = particles.def_grad.iter().zip(&particles.across).zip(&particles.vol0);
        Some(all.map(|((f, across), vol0)| vol0 * self.0.density(f, *across)).sum())
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        body.by_block(|StressBlock { def_grad, across, vol0, vol, sigma, .. }| {
            let volumes = vol.iter_mut().zip(vol0.iter()).zip(across.iter_mut());
            let results = volumes.zip(sigma.iter_mut());
            for (f, (((vol, vol0), across), sigma)) in def_grad.iter().zip(results) {
                let area = det(f);
                // Any stretch may be returned for an inverted particle, because the solver detects
                // the invalid volume.
                *across = if area > 0.0 { self.0.stretch(area) } else { 1.0 };
                let j = area * *across;
                *vol = j * vol0;
                *sigma = self.0.cauchy(f, j);
            }
        });
    }
}

/// Returns `nu/(1 - nu)`, the ratio of the out-of-plane logarithmic strain to the logarithmic area
/// strain, with opposite sign.
pub(super) fn thinning(lambda: f64, mu: f64) -> f64 {
    lambda / (lambda + 2.0 * mu)
}

/// Returns the first Lame parameter (Pa) of a plate, `2 lambda mu/(lambda + 2 mu)`. In plane
/// stress, this parameter multiplies the in-plane strains only (Timoshenko & Goodier 1970, section
/// 16).
pub(super) fn lambda_of_plate(lambda: f64, mu: f64) -> f64 {
    2.0 * mu * thinning(lambda, mu)
}

/// A plate with a law in rate form, `D_33 = -nu/(1 - nu) (D_11 + D_22)`.
pub(super) struct RatePlaneStress<L> {
    /// Law for the in-plane strains, with the first Lame parameter of a plate.
    plane: L,
    /// Ratio `nu/(1 - nu)` of out-of-plane contraction to in-plane area strain.
    thinning: f64,
}

impl<L> RatePlaneStress<L> {
    /// Creates a plate. `with_lambda` returns the law for a given first Lame parameter (Pa).
    pub(super) fn new(lambda: f64, mu: f64, with_lambda: impl Fn(f64) -> L) -> Self {
        Self { plane: with_lambda(lambda_of_plate(lambda, mu)), thinning: thinning(lambda, mu) }
    }
}

impl<const D: usize, L: Material<D>> Material<D> for RatePlaneStress<L> {
    fn reads_deformation(&self) -> bool {
        false
    }

    fn keeps_stretch_across(&self) -> bool {
        true
    }

    fn stress_across(&self, _: usize, _: &Particles<D>) -> Option<f64> {
        Some(0.0)
    }

    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        self.plane.start_deformed(particles)?;
        let Particles { def_grad, across, vol, .. } = particles;
        for ((f, across), vol) in def_grad.iter().zip(across).zip(vol) {
            *across = libm::pow(det(f), -self.thinning);
            *vol *= *across;
        }
        Ok(())
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        self.plane.update(body);
        let dt = body.dt();
        let Particles { grad_v, across, vol, .. } = body.particles();
        for ((grad_v, across), vol) in grad_v.iter().zip(across).zip(vol) {
            let step = 1.0 - self.thinning * grad_v.trace() * dt;
            *across *= step;
            *vol *= step;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::specimen::{SLOW, Specimen, every, scattered};
    use crate::mpm::foundation::algebra::{Matrix, det, in_space};
    use approx::{assert_abs_diff_eq, assert_relative_eq};
    use mpm_subject::PlaneState;

    /// Returns all laws with plane stress, each as a plate and in 3-D.
    fn plates() -> Vec<(Specimen<2>, Specimen<3>)> {
        let plate =
            |plan| Some((Specimen::in_plane(plan, PlaneState::Stress)?, Specimen::new(plan)));
        let plates: Vec<_> = every().into_iter().filter_map(plate).collect();
        assert!(plates.len() >= 3, "linear elasticity, neo-Hookean, Hencky");
        plates
    }

    /// A 3-D body with the out-of-plane stretch of a plate has the in-plane stress of the plate,
    /// and no out-of-plane stress.
    #[test]
    fn a_plate_is_a_body_that_is_free_across() {
        for (mut plate, mut space) in plates() {
            for seed in [0.3, 1.1, 2.6] {
                let step = Matrix::<2>::identity() + scattered(0.2, seed);
                let before = plate.across();
                let sigma = plate.deform(&step, SLOW);
                let found = space.deform(&in_space(&step, plate.across() / before), SLOW);
                assert_abs_diff_eq!(found, in_space(&sigma, 0.0), epsilon = 1e-11);
                assert_relative_eq!(plate.j(), space.j(), max_relative = 1e-13);
                if let Some(energy) = plate.energy() {
                    assert_relative_eq!(energy, space.energy().unwrap(), max_relative = 1e-11);
                }
            }
        }
    }

    #[test]
    fn a_plate_may_start_deformed() {
        for (mut plate, mut space) in plates() {
            let f = Matrix::<2>::identity() + scattered(0.2, 0.8);
            let sigma = plate.start(&f);
            let found = space.start(&in_space(&f, plate.across()));
            assert_abs_diff_eq!(found, in_space(&sigma, 0.0), epsilon = 1e-11);
            assert_relative_eq!(plate.j(), det(&f) * plate.across(), max_relative = 1e-14);
        }
    }
}
