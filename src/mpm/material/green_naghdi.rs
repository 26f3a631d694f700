//! Linear elasticity with the rate of Green and Naghdi.
//!
//! `tau_dot = lambda tr(d) I + 2 mu d + Omega tau - tau Omega` for the Kirchhoff stress `tau = J
//! sigma`, with `Omega = R_dot R^T` of the polar decomposition `F = R U` (Green & Naghdi 1965;
//! Johnson & Bammann 1984 compare such rates). The state is the stress `R^T tau R`, whose rate is
//! `lambda tr(D) I + 2 mu D` with `D = sym(U_dot U^-1)`. A step adds `sym(ln(U' U^-1))` to the
//! integral of D: exact under any rotation, and of order 2 in the time step. The work of the stress
//! in a closed cycle of deformation is not zero, so that there is no energy.

use super::contract::{Material, MaterialProperties, rate_form_averages_no_volume};
use super::linear_elastic::LinearElastic;
use super::spectral::{MatrixBatch, assembled_batch, spectral_batch};
use super::stress_update::{StressBlock, StressUpdate};
use crate::mpm::foundation::algebra::{Matrix, det};
use crate::mpm::foundation::simd::{BATCH, F64Batch, vectorized};
use crate::subject::{Checkpoint, Column, Entry, Memory};

/// Isotropic linear elasticity with the rate of Green and Naghdi.
#[derive(Debug, Clone, PartialEq)]
pub struct GreenNaghdi {
    elasticity: LinearElastic,
    /// One for each particle, from the first step on.
    states: Vec<Unrotated>,
}

/// State of a particle in three dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Unrotated {
    /// `R^T tau R` (Pa).
    stress: Matrix<3>,
    /// `U`.
    stretch: Matrix<3>,
}

impl Default for Unrotated {
    fn default() -> Self {
        Self { stress: Matrix::zeros(), stretch: Matrix::identity() }
    }
}

impl Entry for Unrotated {
    fn write(&self, numbers: &mut Vec<f64>) {
        self.stress.write(numbers);
    }
}

impl Memory for Unrotated {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { stress, stretch } = self;
        checkpoint.visit(stress);
        checkpoint.visit(stretch);
    }
}

impl GreenNaghdi {
    /// From Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self { elasticity: LinearElastic::new(young, poisson), states: Vec::new() }
    }

    /// Updates the states of a batch of particles after a step to `def_grad`, and returns the
    /// Kirchhoff stresses (Pa).
    #[inline(always)]
    fn step<const D: usize>(
        &self,
        states: &mut [Unrotated],
        def_grad: &[Matrix<D>],
    ) -> MatrixBatch<D> {
        let mut f = MatrixBatch::identity();
        let (mut before, mut stress) = (f, f);
        for (lane, (state, def_grad)) in states.iter().zip(def_grad).enumerate() {
            f.set(lane, def_grad);
            before.set(lane, &in_plane(&state.stretch));
            stress.set(lane, &in_plane(&state.stress));
        }
        let (squares, axes) = spectral_batch(f.transposed().product(&f));
        let stretch = assembled_batch(&squares.map(|all| map(all, f64::sqrt)), &axes);
        let inverse = assembled_batch(&squares.map(|all| map(all, |x| 1.0 / x.sqrt())), &axes);
        let strain = strain(&before, &stretch);
        let LinearElastic { lambda, mu } = self.elasticity;
        stress = stress.zip(&strain, |stress, strain| stress + 2.0 * mu * strain);
        stress.add_to_diagonal(&map(&strain.traces(), |trace| lambda * trace));
        for (lane, state) in states.iter_mut().enumerate() {
            state.stress = in_space(&stress.get(lane));
            state.stretch = in_space(&stretch.get(lane));
        }
        let rotation = f.product(&inverse);
        rotation.product(&stress).product(&rotation.transposed())
    }
}

/// `f` of every number.
#[inline(always)]
fn map(numbers: &F64Batch, f: impl Fn(f64) -> f64) -> F64Batch {
    let mut all = *numbers;
    for lane in 0..BATCH {
        all.0[lane] = f(all.0[lane]);
    }
    all
}

/// Maximum number of terms of a logarithm: enough for a stretch of 1/100 or 100 in one step.
const MOST_TERMS: u32 = 2000;

/// `sym(ln(U' U^-1)) = 2 sym(artanh(Z))`, `Z = (U' - U)(U' + U)^-1` (Higham 2008, eq. 11.5), from U
/// before and U' after a step; NaN if the series does not converge. A particle whose series has
/// converged takes no further term, so that its bits do not depend on the batch.
#[inline(always)]
fn strain<const D: usize>(before: &MatrixBatch<D>, after: &MatrixBatch<D>) -> MatrixBatch<D> {
    let difference = after.zip(before, |after, before| after - before);
    let sum = after.zip(before, |after, before| after + before);
    // U and U' are symmetric: Z^T = (U' + U)^-1 (U' - U).
    let z = difference.solved_by(sum).transposed();
    let square = z.product(&z);
    let (mut series, mut power) = (z, z);
    let mut is_open = F64Batch([1.0; BATCH]);
    for k in 1..MOST_TERMS {
        power = power.product(&square);
        let divisor = f64::from(2 * k + 1);
        let term = power.map_lanes(|lane, x| if is_open.0[lane] > 0.0 { x / divisor } else { 0.0 });
        series = series.zip(&term, |series, term| series + term);
        let (last, all) = (term.norms_squared(), series.norms_squared());
        let mut open = 0.0;
        for lane in 0..BATCH {
            let is_settled = last.0[lane] <= (0.01 * f64::EPSILON * f64::EPSILON) * all.0[lane];
            is_open.0[lane] = if is_settled { 0.0 } else { is_open.0[lane] };
            open += is_open.0[lane];
        }
        if open == 0.0 {
            break;
        }
    }
    let series = series.map_lanes(|lane, x| if is_open.0[lane] > 0.0 { f64::NAN } else { x });
    series.zip(&series.transposed(), |entry, mirrored| entry + mirrored)
}

/// The part of a tensor along the axes of a scene in D dimensions.
fn in_plane<const D: usize>(m: &Matrix<3>) -> Matrix<D> {
    Matrix::from_fn(|i, j| m[(i, j)])
}

/// A tensor with zeros along the axes that a scene in D dimensions has not.
fn in_space<const D: usize>(m: &Matrix<D>) -> Matrix<3> {
    Matrix::from_fn(|i, j| if i < D && j < D { m[(i, j)] } else { 0.0 })
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
        Err("is integrated in rate form, and has no energy")
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
                let tau = vectorized(
                    #[inline(always)]
                    || self.step(states, def_grad),
                );
                let results = vol.iter_mut().zip(vol0).zip(sigma).zip(def_grad);
                for (lane, (((vol, vol0), sigma), f)) in results.enumerate() {
                    let j = det(f);
                    *vol = j * vol0;
                    *sigma = tau.get(lane) / j;
                }
            }
        });
        self.states = states;
    }
}

#[cfg(test)]
impl super::contract::ClosedForms for GreenNaghdi {
    /// One step has the logarithmic strain.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Right stretches near and far from the identity, so that the series end at different terms.
    fn stretches() -> impl Iterator<Item = Matrix<3>> {
        (0..BATCH).map(|lane| {
            let size = libm::exp2(-(lane as f64));
            let m = Matrix::<3>::new(0.3, -0.2, 0.1, -0.2, 0.5, 0.05, 0.1, 0.05, -0.4);
            Matrix::identity() + m * size
        })
    }

    #[test]
    fn bits_of_a_particle_do_not_depend_on_its_batch() {
        let before = MatrixBatch::<3>::identity();
        let mut together = before;
        stretches().enumerate().for_each(|(lane, u)| together.set(lane, &u));
        let strains = strain(&before, &together);
        for (lane, u) in stretches().enumerate() {
            let mut alone = before;
            alone.set(BATCH - 1 - lane, &u);
            let alone = strain(&before, &alone).get(BATCH - 1 - lane);
            assert_eq!(strains.get(lane), alone, "particle {lane}");
        }
    }
}
