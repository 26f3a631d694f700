//! J2 plasticity at finite strain: Hencky elasticity and radial return in logarithmic strain.
//!
//! `F = Fe Fp`, Kirchhoff stress `tau = J sigma = K tr(eps) I + 2 mu dev(eps)` of the elastic
//! strain `eps = ln(be)/2`, yield where `sqrt(3/2) |dev tau| > Y + H alpha` (Simo 1992; de Souza
//! Neto, Peric & Owen 2008, chapter 14): in `eps`, the radial return of small strain. The plastic
//! flow is kept as `Cp^-1` of `be = F Cp^-1 F^T`: the trial state follows from F alone, so a body
//! that starts deformed needs no more than its F, and nothing drifts while it is elastic.
//!
//! Plane and uniaxial strain have elastic strain out of the plane: the state is 3-D whatever D.

use super::contract::{Material, MaterialProperties};
use super::linear_elastic::LinearElastic;
use super::spectral::{
    MatrixBatch, VectorBatch, assembled, half_log, half_log_batch, spectral, spectral_batch,
};
use super::stress_update::{StressBlock, StressUpdate};
use crate::mpm::foundation::algebra::{Matrix, Vector, det, product};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{BATCH, vectorized};
use crate::subject::{Checkpoint, Column, Entry, Memory};

/// Isotropic elasto-plasticity with linear hardening.
#[derive(Debug, Clone, PartialEq)]
pub struct J2 {
    lambda: f64,
    bulk: f64,
    mu: f64,
    yield_stress: f64,
    hardening: f64,
    /// One for each particle, from the first step on.
    flowed: Vec<Flowed>,
}

/// Plastic state of a particle.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Flowed {
    /// `Cp^-1`, the inverse of the plastic right Cauchy-Green tensor.
    inverse_metric: Matrix<3>,
    /// Accumulated plastic strain, alpha.
    strain: f64,
}

/// The plastic strain alone.
impl Entry for Flowed {
    fn write(&self, numbers: &mut Vec<f64>) {
        numbers.push(self.strain);
    }
}

impl Flowed {
    const NOT: Self = Self {
        inverse_metric: Matrix::<3>::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        strain: 0.0,
    };
}

impl Default for Flowed {
    fn default() -> Self {
        Self::NOT
    }
}

impl Memory for Flowed {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { inverse_metric, strain } = self;
        checkpoint.visit(inverse_metric);
        checkpoint.visit(strain);
    }
}

impl J2 {
    /// From Young's modulus (Pa), Poisson's ratio, the yield stress in tension Y (Pa) and the
    /// hardening modulus H (Pa).
    pub fn new(young: f64, poisson: f64, yield_stress: f64, hardening: f64) -> Self {
        let LinearElastic { lambda, mu } = LinearElastic::new(young, poisson);
        let bulk = lambda + 2.0 / 3.0 * mu;
        Self { lambda, bulk, mu, yield_stress, hardening, flowed: Vec::new() }
    }

    /// The Kirchhoff stress at F after return to the yield surface, and the plastic flow then, from
    /// the trial strain along its axes.
    fn kirchhoff(
        &self,
        f: &Matrix<3>,
        before: Flowed,
        (strain, axes): (Vector<3>, Matrix<3>),
    ) -> (Matrix<3>, Flowed) {
        let mean = strain.sum() / 3.0;
        let deviator = strain.add_scalar(-mean);
        let mises = 2.0 * self.mu * 1.5_f64.sqrt() * deviator.norm();
        let excess = mises - (self.yield_stress + self.hardening * before.strain);
        if !(excess > 0.0) {
            return (self.stress(mean, &deviator, &axes), before);
        }
        let flow = excess / (3.0 * self.mu + self.hardening);
        let deviator = deviator * (1.0 - 3.0 * self.mu * flow / mises);
        let elastic = deviator.map(|eps| libm::exp(2.0 * (mean + eps)));
        // An F without inverse ends the run for its volume.
        let back = f.try_inverse().unwrap_or(*f);
        let inverse_metric = back * assembled(&elastic, &axes) * back.transpose();
        let after = Flowed { inverse_metric, strain: before.strain + flow };
        (self.stress(mean, &deviator, &axes), after)
    }

    fn stress(&self, mean: f64, deviator: &Vector<3>, axes: &Matrix<3>) -> Matrix<3> {
        assembled(&deviator.map(|eps| 3.0 * self.bulk * mean + 2.0 * self.mu * eps), axes)
    }
}

impl MaterialProperties for J2 {
    fn wave_modulus(&self) -> f64 {
        self.lambda + 2.0 * self.mu
    }

    fn depends_on_deformation_alone(&self) -> Result<(), &'static str> {
        Err("plastic flow depends on the whole history of the motion")
    }

    fn starts_stressed(&self) -> Result<(), &'static str> {
        Err("the yield stress bounds the whole stress, of which the law knows its own part only")
    }
}

impl<const D: usize> Material<D> for J2 {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("plastic flow", &self.flowed)]
    }

    fn checkpoint(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.visit(&mut self.flowed);
    }

    /// That of the elastic strain, `K/2 tr(eps)^2 + mu |dev eps|^2`.
    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        let density = |p: usize, f: &Matrix<D>| {
            let before = self.flowed.get(p).unwrap_or(&Flowed::NOT);
            let f = in_space(f);
            let strain = half_log(&spectral(&(f * before.inverse_metric * f.transpose())).0);
            let deviator = strain.add_scalar(-strain.sum() / 3.0);
            0.5 * self.bulk * strain.sum() * strain.sum() + self.mu * deviator.norm_squared()
        };
        let all = particles.def_grad.iter().zip(&particles.vol0).enumerate();
        Some(all.map(|(p, (f, vol0))| vol0 * density(p, f)).sum())
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let mut flowed = std::mem::take(&mut self.flowed);
        body.by_block_with(&mut flowed, &|StressBlock { def_grad, vol, vol0, sigma, .. },
                                          flowed| {
            let columns = def_grad.chunks(BATCH).zip(flowed.chunks_mut(BATCH));
            let volumes = vol.chunks_mut(BATCH).zip(vol0.chunks(BATCH));
            let results = volumes.zip(sigma.chunks_mut(BATCH));
            for ((def_grad, flowed), ((vol, vol0), sigma)) in columns.zip(results) {
                let (strains, axes) = trial(def_grad, flowed);
                let results = vol.iter_mut().zip(vol0).zip(sigma);
                let particles = def_grad.iter().zip(flowed).zip(results).enumerate();
                for (lane, ((f, flowed), ((vol, vol0), sigma))) in particles {
                    let trial = (strains.get(lane), axes.get(lane));
                    let (j, (stress, after)) =
                        (det(f), self.kirchhoff(&in_space(f), *flowed, trial));
                    *flowed = after;
                    *vol = j * vol0;
                    *sigma = Matrix::from_fn(|i, k| stress[(i, k)] / j);
                }
            }
        });
        self.flowed = flowed;
    }
}

/// Trial strains of a batch of particles, `ln(be)/2` with `be = F Cp^-1 F^T`, along their axes.
fn trial<const D: usize>(
    def_grad: &[Matrix<D>],
    flowed: &[Flowed],
) -> (VectorBatch<3>, MatrixBatch<3>) {
    vectorized(
        #[inline(always)]
        || {
            let mut trial = MatrixBatch::identity();
            for (lane, (f, Flowed { inverse_metric, .. })) in
                def_grad.iter().zip(flowed).enumerate()
            {
                let f = in_space(f);
                trial.set(lane, &product(&product(&f, inverse_metric), &f.transpose()));
            }
            let (squares, axes) = spectral_batch(trial);
            (squares.map(half_log_batch), axes)
        },
    )
}

/// F in three dimensions: nothing stretches along the axes that are left out.
fn in_space<const D: usize>(f: &Matrix<D>) -> Matrix<3> {
    Matrix::from_fn(|i, k| if i < D && k < D { f[(i, k)] } else { f64::from(u8::from(i == k)) })
}

#[cfg(test)]
impl super::contract::ClosedForms for J2 {
    fn simple_shear(&self, gamma: f64) -> [f64; 3] {
        // The axes of simple shear stretch by exp(e) and exp(-e), the deviator ends on the yield
        // surface.
        let e = libm::asinh(0.5 * gamma);
        let trial = 2.0 * 3.0_f64.sqrt() * self.mu * e;
        let flow = (trial - self.yield_stress) / (3.0 * self.mu + self.hardening);
        let shear = (self.yield_stress + self.hardening * flow) / 3.0_f64.sqrt();
        [shear * libm::tanh(e), shear / libm::cosh(e), -shear * libm::tanh(e)]
    }

    fn uniaxial_stretch(&self, _: f64) -> Option<[f64; 2]> {
        None
    }

    fn energy_density(&self, f: &Matrix<3>) -> Option<f64> {
        let squares = (f.transpose() * f).symmetric_eigenvalues();
        let (log, strain) = (libm::log(det(f)), squares.map(|square| 0.5 * libm::log(square)));
        Some(0.5 * self.lambda * log * log + self.mu * strain.norm_squared())
    }
}

#[cfg(test)]
mod tests {
    use super::super::MaterialPlan;
    use super::super::specimen::{SLOW, Specimen, diagonal};
    use super::LinearElastic;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// Uniaxial strain: elastic to `Y/(2 mu)`, then `d tau_1 = K d eps` and `tau_1 - tau_2 = Y` but
    /// for hardening (benchmark V18, in Kirchhoff stress and logarithmic strain); unloading is
    /// elastic again, until it yields the other way round.
    #[rstest]
    fn uniaxial_strain_has_its_closed_form(#[values(0.0, 40.0)] hardening: f64) {
        pull::<1>(hardening);
        pull::<2>(hardening);
        pull::<3>(hardening);
    }

    fn pull<const D: usize>(hardening: f64) {
        let (young, poisson, strength) = (100.0, 0.3, 3.0);
        let plan = MaterialPlan::J2 { young, poisson, r#yield: strength, hardening };
        let LinearElastic { lambda, mu } = LinearElastic::new(young, poisson);
        let bulk = lambda + 2.0 / 3.0 * mu;
        let mut solid = Specimen::<D>::new(plan);
        let step = 0.004;
        let mut check = |eps: f64, step: f64, gap: f64| {
            let sigma = solid.deform(&diagonal(libm::exp(step)), SLOW) * libm::exp(eps);
            assert_relative_eq!(sigma[(0, 0)], bulk * eps + 2.0 / 3.0 * gap, epsilon = 1e-11);
            if D > 1 {
                assert_relative_eq!(sigma[(0, 0)] - sigma[(D - 1, D - 1)], gap, epsilon = 1e-11);
            }
        };
        let (mut eps, mut gap) = (0.0, 0.0);
        for _ in 0..40 {
            eps += step;
            let flow = (2.0 * mu * eps - strength) / (3.0 * mu + hardening);
            gap = (2.0 * mu * eps).min(strength + hardening * flow);
            check(eps, step, gap);
        }
        assert!(gap >= strength && eps > 3.0 * strength / (2.0 * mu), "most of it was plastic");
        check(eps - 0.02, -0.02, gap - 2.0 * mu * 0.02);
        let flow = (gap - strength) / hardening.max(1.0);
        let back = 0.2;
        let more = (2.0 * mu * back - gap - strength - hardening * flow) / (3.0 * mu + hardening);
        check(eps - back, 0.02 - back, -(strength + hardening * (flow + more)));
    }
}
