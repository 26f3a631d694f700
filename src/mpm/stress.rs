//! Strains and stresses, the same for every basis and transfer.

use super::algebra::{Matrix, product};
use super::effect::strain;
use super::frame::FrameName;
use super::particles::Particles;
use super::setup::Setup;
use super::simd::vectorized;
use super::solver::Solver;
use crate::subject::{Failure, Site};

impl<const D: usize> Solver<D> {
    /// Deformation, stress and volume from the velocity gradients of the particles.
    pub(super) fn stress(&mut self, dt: f64) -> Result<(), Failure> {
        let Setup { particles, material, frame, effects, kernel, grid, .. } = &mut self.setup;
        if *frame == FrameName::Total {
            particles.push_gradients_forward();
        }
        strain_by(dt, &particles.grad_v, &mut particles.def_grad);
        for effect in effects.iter_mut() {
            self.transfers += effect.map_velocity(dt, kernel.as_ref(), grid, particles);
        }
        strain(effects, material.as_mut(), dt, particles);
        self.jacobians()?;
        let Setup { particles, material, .. } = &self.setup;
        // A law of F takes J from F: each number of F is a factor in J, which is finite by now.
        if !material.reads_deformation() {
            particles.deformed_finite()?;
        }
        particles.stressed_finite()
    }

    /// `J = V / V0` of every particle: the smallest so far is kept.
    fn jacobians(&mut self) -> Result<(), Failure> {
        let Particles { vol, vol0, .. } = &self.setup.particles;
        if let Some(least) = least_ratio(vol, vol0) {
            self.min_j = self.min_j.min(least);
            return Ok(());
        }
        for (p, (vol, vol0)) in vol.iter().zip(vol0).enumerate() {
            let (j, site) = (vol / vol0, Site::Particle(p));
            if !j.is_finite() {
                return Err(Failure::NonFinite { quantity: "J", site });
            }
            self.min_j = self.min_j.min(j);
            if j <= 0.0 {
                return Err(Failure::Inverted { site, j });
            }
        }
        Ok(())
    }
}

/// `F <- (I + grad v dt) F`.
fn strain_by<const D: usize>(dt: f64, grad_v: &[Matrix<D>], def_grad: &mut [Matrix<D>]) {
    vectorized(
        #[inline(always)]
        || {
            for (f, grad_v) in def_grad.iter_mut().zip(grad_v) {
                let mut step = Matrix::zeros();
                for j in 0..D {
                    for i in 0..D {
                        let unit = if i == j { 1.0 } else { 0.0 };
                        step[(i, j)] = unit + grad_v[(i, j)] * dt;
                    }
                }
                *f = product(&step, f);
            }
        },
    );
}

/// Ratios computed together.
const TOGETHER: usize = 4;

/// The smallest `a / b`, if all are positive and finite; infinity of none. As all are in most
/// steps, the loop has no early exit, and divides several at a time.
fn least_ratio(a: &[f64], b: &[f64]) -> Option<f64> {
    let (many_a, rest_a) = a.as_chunks::<TOGETHER>();
    let (many_b, rest_b) = b.as_chunks::<TOGETHER>();
    let (mut least, mut sound) = ([f64::INFINITY; TOGETHER], [1.0; TOGETHER]);
    vectorized(
        #[inline(always)]
        || {
            for (a, b) in many_a.iter().zip(many_b) {
                for k in 0..TOGETHER {
                    let ratio = a[k] / b[k];
                    // Zero of a finite number; else not a number, for good.
                    sound[k] += ratio * 0.0;
                    least[k] = if ratio < least[k] { ratio } else { least[k] };
                }
            }
        },
    );
    let rest = rest_a.iter().zip(rest_b).map(|(a, b)| a / b);
    let sound = rest.clone().fold(sound.iter().sum(), |sound: f64, ratio| sound + ratio * 0.0);
    let least = least.into_iter().chain(rest).fold(f64::INFINITY, f64::min);
    (least > 0.0 && sound.is_finite()).then_some(least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case::of_several(&[2.0, 1.0, 3.0, 4.0, 1.5], Some(1.0))]
    #[case::in_the_rest(&[2.0, 1.0, 3.0, 4.0, 0.5], Some(0.5))]
    #[case::of_none(&[], Some(f64::INFINITY))]
    #[case::inverted(&[2.0, -1.0, 3.0, 4.0, 0.5], None)]
    #[case::flat(&[2.0, 1.0, 3.0, 4.0, 0.0], None)]
    #[case::nan(&[2.0, 1.0, f64::NAN, 4.0, 1.0], None)]
    #[case::nan_in_the_rest(&[2.0, 1.0, 1.0, 4.0, f64::NAN], None)]
    #[case::infinite(&[f64::INFINITY, 1.0, 1.0, 4.0, 1.0, 1.0, 1.0, 1.0], None)]
    fn the_least_ratio_is_one_of_sound_numbers(#[case] a: &[f64], #[case] least: Option<f64>) {
        assert_eq!(least_ratio(a, &vec![1.0; a.len()]), least);
    }
}
