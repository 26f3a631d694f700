//! Linear elasticity in rate form, as the original MPM integrates it.
//!
//! `d eps = sym(grad v) dt`, `sigma += lambda tr(d eps) I + 2 mu d eps`, `V *= det(I + grad v dt)`
//! (Wobbes & Tielen 2015, step 5; in 1-D `V *= 1 + d eps`). In the limit dt -> 0 the 1-D form
//! integrates to `sigma = E ln F`. This stress agrees with small-strain elasticity only to first
//! order in the strain. Reports list this difference separately from the discretisation error.
//!
//! The stress rate has no Jaumann or Green-Naghdi terms, so the law does not rotate the current
//! stress. In more than one dimension, the law is objective only for small rotations.
//!
//! For a body that starts deformed, the rate is integrated along the straight path `x = X + s u`, s
//! from 0 to 1. This path has `grad v = H (I + s H)^-1` with `H = F - I`, and so `eps = sym(ln F)`
//! (Higham 2008, *Functions of Matrices*, eq. 11.1).

use super::contract::{Material, MaterialProperties};
use super::hyperelastic::linear;
use super::plane_stress::RatePlaneStress;
use super::spectral::MatrixBatch;
use super::stress_update::{StressBlock, StressUpdate};
use crate::mpm::foundation::algebra::{Matrix, det, identity, inverse, product};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::BATCH;
use mpm_subject::Failure;

/// Isotropic linear elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearElastic {
    /// First Lame parameter (Pa).
    pub lambda: f64,
    /// Shear modulus (Pa).
    pub mu: f64,
}

impl LinearElastic {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio. In 1-D, a bar with nu = 0 has
    /// `lambda + 2 mu = E`.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self {
            lambda: young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
            mu: young / (2.0 * (1.0 + poisson)),
        }
    }

    #[inline]
    pub(super) fn increment<const D: usize>(&self, eps: &Matrix<D>) -> Matrix<D> {
        identity() * (self.lambda * eps.trace()) + eps * (2.0 * self.mu)
    }

    /// Returns the stress increments (Pa) of a batch of particles.
    #[inline(always)]
    pub(super) fn increments<const D: usize>(&self, eps: &MatrixBatch<D>) -> MatrixBatch<D> {
        let mut all = *eps;
        for lane in 0..BATCH {
            let trace = (1..D).fold(eps.0[0][0].0[lane], |sum, i| sum + eps.0[i][i].0[lane]);
            let own = linear(self.lambda * trace, 2.0 * self.mu, &eps.get::<D>(lane));
            all.set(lane, &own);
        }
        all
    }
}

/// Returns `eps e^eps - e^eps + 1`, the integral of `s e^s`. For small `eps` the terms would
/// cancel, so a series is evaluated instead.
#[inline]
fn logarithmic_work(eps: f64) -> f64 {
    if eps.abs() > 0.05 {
        return eps * libm::exp(eps) - libm::expm1(eps);
    }
    // Terms of sum over n of (n - 1)/n! eps^n.
    let mut power = 1.0;
    let mut sum = 0.0;
    for n in 1..=9 {
        power *= eps / f64::from(n);
        sum += power * f64::from(n - 1);
    }
    sum
}

/// Maximum number of terms of the logarithm series, sufficient for stretches from 1/100 to 100.
const MOST_TERMS: u32 = 2000;

/// Returns `ln F = 2 artanh(Z)`, `Z = (F - I)(F + I)^-1` (Higham 2008, eq. 11.5). NaN if the series
/// does not converge: for stretches below 1/100 or above 100, and for rotations by 90 degrees.
pub(super) fn logarithm<const D: usize>(f: &Matrix<D>) -> Matrix<D> {
    let nothing = Matrix::from_element(f64::NAN);
    let Some(inverse) = inverse(&(f + identity())) else { return nothing };
    let z = product(&(f - identity()), &inverse);
    let square = product(&z, &z);
    let (mut sum, mut power) = (z, z);
    for k in 1..MOST_TERMS {
        power = product(&power, &square);
        let term = power / f64::from(2 * k + 1);
        sum += term;
        if term.norm() <= 0.1 * f64::EPSILON * sum.norm() {
            return sum * 2.0;
        }
    }
    nothing
}

impl MaterialProperties for LinearElastic {
    fn wave_modulus(&self, _: f64) -> f64 {
        self.lambda + 2.0 * self.mu
    }

    fn is_in_rate_form(&self) -> bool {
        true
    }

    fn starts_deformed(&self) -> Result<(), &'static str> {
        Ok(())
    }

    fn starts_stressed(&self) -> Result<(), &'static str> {
        Ok(())
    }

    fn is_elastic(&self) -> bool {
        true
    }

    fn has_energy(&self, dimension: usize) -> Result<(), &'static str> {
        match dimension {
            1 => Ok(()),
            _ => Err("is integrated in rate form and has a stored energy in 1-D only"),
        }
    }
}

impl<const D: usize> Material<D> for LinearElastic {
    fn reads_deformation(&self) -> bool {
        false
    }

    fn in_plane_stress(&self) -> Option<Box<dyn Material<D>>> {
        let plate = |lambda| Self { lambda, ..*self };
        Some(Box::new(RatePlaneStress::new(self.lambda, self.mu, plate)))
    }

    /// Returns the work of the stress in 1-D. The rate integrates to `sigma = M eps` with
    /// `eps = ln J`, and the work per reference volume is `M (eps e^eps - e^eps + 1)`. In 2-D and
    /// 3-D the work depends on the path, so there is no energy.
    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        let modulus = self.lambda + 2.0 * self.mu;
        let stored = |(sigma, vol0): (&Matrix<D>, &f64)| {
            vol0 * modulus * logarithmic_work(sigma[(0, 0)] / modulus)
        };
        (D == 1).then(|| particles.sigma.iter().zip(&particles.vol0).map(stored).sum())
    }

    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        for (f, sigma) in particles.def_grad.iter().zip(&mut particles.sigma) {
            let log = logarithm(f);
            *sigma += self.increment(&((log + log.transpose()) * 0.5));
        }
        Ok(())
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let dt = body.dt();
        body.by_block(|StressBlock { grad_v, vol, sigma, .. }| {
            for ((grad_v, vol), sigma) in grad_v.iter().zip(vol.iter_mut()).zip(sigma.iter_mut()) {
                let step = grad_v * dt;
                *vol *= det(&(identity() + step));
                *sigma += self.increment(&((step + step.transpose()) * 0.5));
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::foundation::algebra::Vector;
    use approx::assert_relative_eq;

    /// Compares the initial stress with the rate along `x = X + s u`, integrated by the midpoint
    /// rule.
    #[test]
    fn initial_stress_is_that_of_the_straight_path() {
        let (law, steps) = (LinearElastic::new(100.0, 0.3), 2000);
        let f = Matrix::<3>::new(1.2, 0.3, 0.0, -0.2, 0.7, 0.1, 0.05, 0.0, 1.4);
        let grad = f - Matrix::identity();
        let mut pulled = Particles::cubes([1; 3]);
        for step in 0..steps {
            let middle = (f64::from(step) + 0.5) / f64::from(steps);
            let now = Matrix::identity() + grad * middle;
            pulled.grad_v[0] = grad * now.try_inverse().unwrap();
            { law }.update(&mut StressUpdate::new(1.0 / f64::from(steps), &mut pulled));
        }
        assert_relative_eq!(started(law, f).sigma[0], pulled.sigma[0], epsilon = 1e-5);
    }

    /// Expects `E ln F` in 1-D, without cancellation for small strain, and NaN for a rotation by
    /// 180 degrees.
    #[test]
    fn initial_stress_is_that_of_the_logarithm() {
        let law = LinearElastic::new(100.0, 0.0);
        for stretch in [0.02, 0.7, 1.0 + 1e-9, 3.0, 50.0] {
            let sigma = started(law, Matrix::<1>::new(stretch)).sigma[0][(0, 0)];
            assert_relative_eq!(sigma, 100.0 * libm::log(stretch), max_relative = 1e-13);
        }
        let half_a_turn = Matrix::<2>::new(-1.0, 0.0, 0.0, -1.0);
        assert!(started(law, half_a_turn).sigma[0].iter().all(|sigma| sigma.is_nan()));
    }

    #[test]
    fn logarithm_of_a_stretch_is_its_strain() {
        let (c, s) = (0.6, 0.8);
        let axes = Matrix::<3>::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
        for size in [0.0, 1e-12, 1e-3, 0.1, 0.2, 0.29, 0.31, 0.5, 2.0] {
            let strains = Vector::<3>::new(size, -0.5 * size, 0.25 * size);
            let turned =
                |values: Vector<3>| axes * Matrix::from_diagonal(&values) * axes.transpose();
            let log = logarithm(&turned(strains.map(libm::exp)));
            assert_relative_eq!(log, turned(strains), epsilon = 1e-15, max_relative = 1e-13);
        }
    }

    fn started<const D: usize>(mut law: LinearElastic, f: Matrix<D>) -> Particles<D> {
        let mut body = Particles::cubes([1; D]);
        body.deform(|_| (Vector::zeros(), f));
        law.start_deformed(&mut body).unwrap();
        body
    }

    /// Expects `W(J) = M (J ln J - J + 1)`, whose derivative is sigma, and no energy in 2-D.
    #[test]
    fn a_bar_stores_the_work_of_its_stress() {
        for stretch in [1.2, 0.7, 1.01, 1.0 - 1e-9] {
            let mut bar = Particles::cubes([1]);
            bar.sigma[0] = Matrix::<1>::new(100.0 * libm::log(stretch));
            let stored = Material::<1>::energy(&LinearElastic::new(100.0, 0.0), &bar);
            let small = stretch - 1.0;
            let expected = if small.abs() < 1e-6 {
                50.0 * small * small
            } else {
                100.0 * (stretch * libm::log(stretch) - small)
            };
            assert_relative_eq!(stored.unwrap(), expected, max_relative = 1e-8);
        }
        let plate = Particles::cubes([1; 2]);
        assert_eq!(Material::<2>::energy(&LinearElastic::new(100.0, 0.0), &plate), None);
    }

    /// An objective law would rotate the stress.
    #[test]
    fn spin_does_not_rotate_the_stress() {
        let mut solid = Particles::cubes([1; 2]);
        solid.sigma[0] = Matrix::<2>::new(3.0, 0.5, 0.5, -1.0);
        let before = solid.sigma[0];
        solid.grad_v[0] = Matrix::<2>::new(0.0, -1.0, 1.0, 0.0);
        LinearElastic::new(50.0, 0.3).update(&mut StressUpdate::new(0.1, &mut solid));
        assert_eq!(solid.sigma[0], before);
    }
}
