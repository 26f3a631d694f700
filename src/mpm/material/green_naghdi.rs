//! Linear elasticity with the Green-Naghdi rate.
//!
//! `tau_dot = lambda tr(d) I + 2 mu d + Omega tau - tau Omega` for the Kirchhoff stress `tau = J
//! sigma`, with `Omega = R_dot R^T` and the polar decomposition `F = R U` (Green & Naghdi 1965;
//! Johnson & Bammann 1984). The state is the stress `R^T tau R`, whose rate is `lambda tr(D) I + 2
//! mu D` with `D = sym(U_dot U^-1)`. A step from U to U' adds `sym(ln(U' U^-1))` to the integral of
//! D. The integration of a pure rotation is exact; in general, the order in the time step is 2. The
//! work of the stress in a closed cycle of deformation is not zero, so the law has no energy.

use super::contract::{Material, MaterialProperties, rate_form_averages_no_volume};
use super::linear_elastic::{LinearElastic, logarithm};
use super::spectral::{MatrixBatch, VectorBatch, assembled, spectral_batch};
use super::stress_update::{StressBlock, StressUpdate};
use crate::mpm::foundation::algebra::{Matrix, Vector, det, product};
use crate::mpm::foundation::simd::{BATCH, vectorized};
use crate::subject::{Checkpoint, Column, Entry, Memory};

/// Isotropic linear elasticity with the Green-Naghdi rate.
#[derive(Debug, Clone, PartialEq)]
pub struct GreenNaghdi {
    elasticity: LinearElastic,
    /// State of each particle; empty before the first step.
    states: Vec<Unrotated>,
}

/// State of a particle in three dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Unrotated {
    /// `R^T tau R` (Pa).
    stress: Matrix<3>,
    inverse_stretch: Matrix<3>,
}

impl Default for Unrotated {
    fn default() -> Self {
        Self { stress: Matrix::zeros(), inverse_stretch: Matrix::identity() }
    }
}

impl Entry for Unrotated {
    fn write(&self, numbers: &mut Vec<f64>) {
        self.stress.write(numbers);
    }
}

impl Memory for Unrotated {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { stress, inverse_stretch } = self;
        checkpoint.visit(stress);
        checkpoint.visit(inverse_stretch);
    }
}

impl GreenNaghdi {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self { elasticity: LinearElastic::new(young, poisson), states: Vec::new() }
    }

    /// Returns the state after a step to F, and the Kirchhoff stress (Pa). `squares` are the
    /// squared principal right stretches along `axes`.
    fn after<const D: usize>(
        &self,
        before: &Unrotated,
        f: &Matrix<D>,
        squares: &Vector<D>,
        axes: &Matrix<D>,
    ) -> (Unrotated, Matrix<D>) {
        let stretch = assembled(&squares.map(f64::sqrt), axes);
        let inverse_stretch = assembled(&squares.map(|square| 1.0 / square.sqrt()), axes);
        let log = logarithm(&product(&stretch, &in_plane(&before.inverse_stretch)));
        let strain = (log + log.transpose()) * 0.5;
        let stress = in_plane(&before.stress) + self.elasticity.increment(&strain);
        let turn = product(f, &inverse_stretch);
        let tau = product(&product(&turn, &stress), &turn.transpose());
        let after =
            Unrotated { stress: in_space(&stress), inverse_stretch: in_space(&inverse_stretch) };
        (after, tau)
    }
}

fn in_plane<const D: usize>(m: &Matrix<3>) -> Matrix<D> {
    Matrix::from_fn(|i, j| m[(i, j)])
}

fn in_space<const D: usize>(m: &Matrix<D>) -> Matrix<3> {
    Matrix::from_fn(|i, j| if i < D && j < D { m[(i, j)] } else { 0.0 })
}

/// Returns the squared right stretches of a batch of particles, and their axes.
fn stretch<const D: usize>(def_grad: &[Matrix<D>]) -> (VectorBatch<D>, MatrixBatch<D>) {
    vectorized(
        #[inline(always)]
        || {
            let mut squares = MatrixBatch::identity();
            for (lane, f) in def_grad.iter().enumerate() {
                squares.set(lane, &product(&f.transpose(), f));
            }
            spectral_batch(squares)
        },
    )
}

impl MaterialProperties for GreenNaghdi {
    fn wave_modulus(&self, _: f64) -> f64 {
        self.elasticity.lambda + 2.0 * self.elasticity.mu
    }

    fn depends_on_deformation_alone(&self) -> Result<(), &'static str> {
        Err("a law in rate form has no stress of the deformation alone")
    }

    fn takes_averaged_volume(&self) -> Result<(), &'static str> {
        rate_form_averages_no_volume()
    }

    fn has_energy(&self, _: usize) -> Result<(), &'static str> {
        Err("is integrated in rate form and has no stored energy")
    }
}

impl<const D: usize> Material<D> for GreenNaghdi {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("unrotated stress", &self.states)]
    }

    fn checkpoint(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.visit(&mut self.states);
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let mut states = std::mem::take(&mut self.states);
        body.by_block_with(&mut states, &|StressBlock { def_grad, vol, vol0, sigma, .. },
                                          states| {
            let columns = def_grad.chunks(BATCH).zip(states.chunks_mut(BATCH));
            let volumes = vol.chunks_mut(BATCH).zip(vol0.chunks(BATCH));
            let results = volumes.zip(sigma.chunks_mut(BATCH));
            for ((def_grad, states), ((vol, vol0), sigma)) in columns.zip(results) {
                let (squares, axes) = stretch(def_grad);
                let results = vol.iter_mut().zip(vol0).zip(sigma);
                let particles = def_grad.iter().zip(states).zip(results).enumerate();
                for (lane, ((f, state), ((vol, vol0), sigma))) in particles {
                    let (after, tau) = self.after(state, f, &squares.get(lane), &axes.get(lane));
                    let j = det(f);
                    *state = after;
                    *vol = j * vol0;
                    *sigma = tau / j;
                }
            }
        });
        self.states = states;
    }
}

#[cfg(test)]
impl super::contract::ClosedForms for GreenNaghdi {
    /// Returns the stress of one step, whose strain increment is the logarithmic strain.
    fn simple_shear(&self, gamma: f64) -> [f64; 3] {
        let e = libm::asinh(0.5 * gamma);
        let shear = 2.0 * self.elasticity.mu * e;
        [shear * libm::tanh(e), shear / libm::cosh(e), -shear * libm::tanh(e)]
    }

    fn uniaxial_stretch(&self, stretch: f64) -> Option<[f64; 2]> {
        let LinearElastic { lambda, mu } = self.elasticity;
        let strain = libm::log(stretch);
        Some([(lambda + 2.0 * mu) * strain / stretch, lambda * strain / stretch])
    }

    fn energy_density(&self, _: &Matrix<3>) -> Option<f64> {
        None
    }
}
