//! Elastoplasticity at finite strain: Hencky elasticity and a return to the yield surface in
//! logarithmic strain.
//!
//! The split is `F = Fe Fp`. The Kirchhoff stress is `tau = J sigma = K tr(eps) I + 2 mu dev(eps)`
//! with the elastic strain `eps = ln(be)/2` (Simo 1992; de Souza Neto, Peric & Owen 2008, chapter
//! 14). With the exponential map, the return in `eps` has the same form as in small strain and
//! keeps the axes of the trial strain. A yield surface is therefore a function of principal values.
//! The plastic flow is stored as `Cp^-1` in `be = F Cp^-1 F^T`. The trial state is computed from
//! the total F and not from increments, so rounding errors of an elastic state do not accumulate.
//!
//! A body with the initial stress S0 starts with the elastic strain `eps0`,
//! `S0 = K tr(eps0) I + 2 mu dev(eps0)`, that is `Cp^-1 = exp(2 eps0)` at F = I. The yield
//! condition therefore limits the total stress, and S0 must satisfy this condition.
//!
//! Plane and uniaxial strain have out-of-plane elastic strain, so the state is 3-D in any
//! dimension.

use super::contract::{Contradiction, Material, MaterialProperties, YieldFunction};
use super::hyperelastic::linear;
use super::linear_elastic::LinearElastic;
use super::spectral::{
    MatrixBatch, VectorBatch, assembled, half_log, half_log_batch, spectral, spectral_batch,
};
use super::stress_update::{StressBlock, StressUpdate};
use super::stretch::{HALF_LOG, PowerSeries, excess};
use super::tangent::{StressResponse, isotropic_modulus};
use crate::mpm::foundation::algebra::{
    Matrix, Vector, array, det, dyad, identity, in_space, inverse, product,
};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{BATCH, F64Batch, vectorized};
use mpm_subject::{Column, Entry, Failure, Site};
use std::any::Any;

/// Moduli (Pa) of isotropic elasticity in logarithmic strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LogElasticity {
    pub(super) lambda: f64,
    pub(super) bulk: f64,
    pub(super) mu: f64,
}

impl LogElasticity {
    pub(super) fn new(young: f64, poisson: f64) -> Self {
        let LinearElastic { lambda, mu } = LinearElastic::new(young, poisson);
        Self { lambda, bulk: lambda + 2.0 / 3.0 * mu, mu }
    }

    /// Returns the principal Kirchhoff stresses (Pa).
    pub(super) fn stress(&self, strain: &PrincipalStrain) -> Vector<3> {
        strain.deviator.map(|eps| 3.0 * self.bulk * strain.mean + 2.0 * self.mu * eps)
    }

    /// Returns the principal strains at the principal Kirchhoff stresses `stress` (Pa), the inverse
    /// of [`Self::stress`].
    fn strain(&self, stress: &Vector<3>) -> Vector<3> {
        let mean = stress.sum() / 3.0;
        stress.map(|stress| mean / (3.0 * self.bulk) + (stress - mean) / (2.0 * self.mu))
    }

    /// Returns the derivatives of the principal Kirchhoff stresses with respect to the principal
    /// strains (Pa).
    pub(super) fn modulus(&self) -> Matrix<3> {
        isotropic_modulus(self.lambda, self.mu)
    }

    /// Returns the energy per reference volume (J/m3), `K/2 tr(eps)^2 + mu |dev eps|^2`.
    fn energy(&self, strain: &Vector<3>) -> f64 {
        let deviator = strain.add_scalar(-strain.sum() / 3.0);
        0.5 * self.bulk * strain.sum() * strain.sum() + self.mu * deviator.norm_squared()
    }
}

/// Principal values of an elastic logarithmic strain: the mean, and the deviations from the mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalStrain {
    pub(super) mean: f64,
    pub(super) deviator: Vector<3>,
}

impl PrincipalStrain {
    #[inline]
    pub(super) fn new(values: &Vector<3>) -> Self {
        let mean = (values[0] + values[1] + values[2]) / 3.0;
        Self { mean, deviator: Vector::from_fn(|i, _| values[i] - mean) }
    }

    /// Returns the equivalent strain `sqrt(2/3) |a - b|` of the difference of two strains.
    #[inline]
    pub(super) fn distance(&self, other: &Self) -> f64 {
        let mean = self.mean - other.mean;
        let deviator = self.deviator - other.deviator;
        libm::sqrt(2.0 / 3.0 * (deviator.norm_squared() + 3.0 * mean * mean))
    }
}

/// Returns the derivatives of `mean 1 + length n` with respect to the principal strains, where `1`
/// is the vector of ones and `n` the direction of the strain deviator. `mean_slope` and
/// `length_slope` are the derivatives of the mean and of the length. The direction changes by
/// `(I - 1 (x) 1/3 - n (x) n) deps / |dev eps|`.
pub(super) fn modulus_of_invariants(
    strain: &PrincipalStrain,
    mean_slope: &Vector<3>,
    length: f64,
    length_slope: &Vector<3>,
) -> Matrix<3> {
    let size = strain.deviator.norm();
    let direction = strain.deviator / size;
    let turn = identity() - Matrix::from_element(1.0 / 3.0) - dyad(&direction, &direction);
    let one = Vector::from_element(1.0);
    dyad(&one, mean_slope) + dyad(&direction, length_slope) + turn * (length / size)
}

/// A yield surface with its flow rule.
pub trait YieldSurface: Send + Sync {
    /// Returns the elasticity inside the surface.
    fn elasticity(&self) -> &LogElasticity;

    /// Returns a parameter that contradicts another one, if any.
    fn contradiction(&self) -> Option<Contradiction> {
        None
    }

    /// Returns the yield function at the principal Kirchhoff stresses `stress` (Pa), without
    /// plastic flow.
    fn yield_function(&self, stress: &Vector<3>) -> YieldFunction;

    /// Computes the return of a trial strain to the surface: the elastic strain after the return,
    /// and the plastic strain that the return adds to the accumulated plastic strain `flowed`.
    /// `None` if the trial state is inside the surface.
    fn return_from(&self, trial: &PrincipalStrain, flowed: f64) -> Option<(PrincipalStrain, f64)>;

    /// Whether a trial strain is certainly inside the surface, given its mean and its deviator.
    /// False for NaN, and for a strain so close to the surface that rounding errors could matter.
    fn encloses(&self, mean: f64, deviator: &Matrix<3>, flowed: f64) -> bool;

    /// Returns the derivatives of the principal Kirchhoff stresses after the return (rows) with
    /// respect to the principal trial strains (Pa): the consistent tangent of
    /// [`return_from`](Self::return_from). `None` if the trial state is inside the surface.
    fn modulus_of_return(&self, trial: &PrincipalStrain, flowed: f64) -> Option<Matrix<3>>;
}

/// Isotropic elastoplasticity with a yield surface.
#[derive(Debug, Clone, PartialEq)]
pub struct ElastoPlastic<S> {
    pub(super) surface: S,
    /// Plastic state of each particle; empty before the first step.
    flowed: Vec<Flowed>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Flowed {
    /// `Cp^-1`, the inverse of the plastic right Cauchy-Green tensor.
    inverse_metric: Matrix<3>,
    /// Accumulated plastic strain.
    strain: f64,
}

/// Reports contain only the accumulated plastic strain of the state.
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

impl<S: YieldSurface> ElastoPlastic<S> {
    pub(super) fn with_surface(surface: S) -> Self {
        Self { surface, flowed: Vec::new() }
    }

    /// Returns the Kirchhoff stress at F and the plastic state after the return. `strain` contains
    /// the principal trial strains along `axes`.
    fn kirchhoff(
        &self,
        f: &Matrix<3>,
        before: Flowed,
        strain: &Vector<3>,
        axes: &Matrix<3>,
    ) -> (Matrix<3>, Flowed) {
        let trial = PrincipalStrain::new(strain);
        let stress = |strain| assembled(&self.surface.elasticity().stress(strain), axes);
        let Some((elastic, flow)) = self.surface.return_from(&trial, before.strain) else {
            return (stress(&trial), before);
        };
        let squares = elastic.deviator.map(|eps| libm::exp(2.0 * (elastic.mean + eps)));
        // If F has no inverse, the solver detects the invalid volume and the run fails.
        let back = inverse(f).unwrap_or(*f);
        let metric_in_axes = product(&back, &assembled(&squares, axes));
        let inverse_metric = product(&metric_in_axes, &back.transpose());
        (stress(&elastic), Flowed { inverse_metric, strain: before.strain + flow })
    }

    /// Computes the Cauchy stress of a batch of particles (Pa) as that of an elastic state from the
    /// logarithms of [`small_trial`]. Also returns whether the state of a particle is certainly
    /// elastic. The stress of any other particle is not valid.
    fn elastic(&self, trial: &SmallTrial) -> (MatrixBatch<3>, [bool; BATCH]) {
        let LogElasticity { bulk, mu, .. } = *self.surface.elasticity();
        vectorized(
            #[inline(always)]
            || {
                let (mut stresses, mut inside) = (trial.strain, trial.is_small);
                for lane in 0..BATCH {
                    let mut strain = stresses.get::<3>(lane);
                    let mean = (strain[(0, 0)] + strain[(1, 1)] + strain[(2, 2)]) / 3.0;
                    for i in 0..3 {
                        strain[(i, i)] -= mean;
                    }
                    inside[lane] &= self.surface.encloses(mean, &strain, trial.flowed.get(lane));
                    let own = trial.j.get(lane);
                    stresses.set(lane, &linear(3.0 * bulk * mean / own, 2.0 * mu / own, &strain));
                }
                (stresses, inside)
            },
        )
    }
}

/// Trial states of a batch of particles, without the axes of the strain.
struct SmallTrial {
    /// Trial strain `ln(be)/2`, valid where `is_small`.
    strain: MatrixBatch<3>,
    is_small: [bool; BATCH],
    /// Volume ratio J.
    j: F64Batch,
    /// Accumulated plastic strain.
    flowed: F64Batch,
}

/// Computes the trial strains of a batch of particles by the power series of the logarithm.
///
/// With `H = F - I` and `P = Cp^-1 - I`, `be - I = P + W + W^T + H W` with `W = H^T + P H^T`.
/// Before any plastic flow P is zero, so small strains suffer no cancellation.
fn small_trial<const D: usize>(def_grad: &[Matrix<D>], flowed: &[Flowed]) -> SmallTrial {
    let (mut f, mut j) = (MatrixBatch::identity(), F64Batch([1.0; BATCH]));
    for (lane, own) in def_grad.iter().enumerate() {
        f.set(lane, own);
        j.0[lane % BATCH] = det(own);
    }
    small_trial_in_space(&f, j, flowed)
}

/// Computes [`small_trial`]. Compiled once for all dimensions.
#[inline(never)]
fn small_trial_in_space(f: &MatrixBatch<3>, j: F64Batch, flowed: &[Flowed]) -> SmallTrial {
    vectorized(
        #[inline(always)]
        || {
            let (mut metric, mut before) = (MatrixBatch::identity(), F64Batch::ZERO);
            for (lane, flowed) in flowed.iter().enumerate() {
                metric.set(lane, &flowed.inverse_metric);
                before.0[lane % BATCH] = flowed.strain;
            }
            let (h, p) = (f.minus_identity(), metric.minus_identity());
            let w = h.transpose().plus(&p.times(&h.transpose()));
            let small = PowerSeries::new(p.plus(&excess(&h, &w)));
            let mut is_small = [false; BATCH];
            for lane in 0..BATCH {
                is_small[lane] = small.is_small(lane);
            }
            SmallTrial { strain: small.sum(&HALF_LOG), is_small, j, flowed: before }
        },
    )
}

/// Returns the squared length of a symmetric matrix.
#[inline(always)]
pub(super) fn length_squared(m: &Matrix<3>) -> f64 {
    let diagonal = m[(0, 0)] * m[(0, 0)] + m[(1, 1)] * m[(1, 1)] + m[(2, 2)] * m[(2, 2)];
    let shear = m[(0, 1)] * m[(0, 1)] + m[(0, 2)] * m[(0, 2)] + m[(1, 2)] * m[(1, 2)];
    diagonal + 2.0 * shear
}

/// Margin by which a state must be inside a yield surface to be certainly elastic, relative to the
/// terms of the yield function. It is far above their rounding errors.
pub(super) const MARGIN: f64 = 1e-12;

impl<S: YieldSurface> MaterialProperties for ElastoPlastic<S> {
    fn wave_modulus(&self, _: f64) -> f64 {
        let LogElasticity { lambda, mu, .. } = self.surface.elasticity();
        lambda + 2.0 * mu
    }

    fn contradiction(&self) -> Option<Contradiction> {
        self.surface.contradiction()
    }

    fn depends_on_deformation_alone(&self) -> Result<(), &'static str> {
        Err("plastic flow depends on the whole history of the motion")
    }

    fn has_tangent(&self) -> Result<(), &'static str> {
        Ok(())
    }

    /// Allows a volume that is averaged over a cell: trial strains are then computed from Fbar (de
    /// Souza Neto et al. 1996, IJSS 33).
    fn takes_averaged_volume(&self) -> Result<(), &'static str> {
        Ok(())
    }

    fn starts_stressed(&self) -> Result<(), &'static str> {
        Ok(())
    }

    fn yield_function(&self, tau: &Matrix<3>) -> Option<YieldFunction> {
        Some(self.surface.yield_function(&spectral(tau).0))
    }
}

impl<const D: usize, S: YieldSurface> Material<D> for ElastoPlastic<S> {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("plastic flow", &self.flowed)]
    }

    fn state(&self) -> Option<Box<dyn Any>> {
        Some(Box::new(self.flowed.clone()))
    }

    fn set_state(&mut self, state: &dyn Any) {
        if let Some(state) = state.downcast_ref() {
            self.flowed.clone_from(state);
        }
    }

    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        let density = |p: usize, f: &Matrix<D>| {
            let before = self.flowed.get(p).unwrap_or(&Flowed::NOT);
            let f = in_space(f, 1.0);
            let strain = half_log(
                &spectral(&product(&product(&f, &before.inverse_metric), &f.transpose())).0,
            );
            self.surface.elasticity().energy(&strain)
        };
        let all = particles.def_grad.iter().zip(&particles.vol0).enumerate();
        Some(all.map(|(p, (f, vol0))| vol0 * density(p, f)).sum())
    }

    fn start_stressed(&mut self, stress: &[Matrix<3>]) -> Result<bool, Failure> {
        let start = |(p, tau): (usize, &Matrix<3>)| {
            let (stress, axes) = spectral(tau);
            let limit = self.surface.yield_function(&stress);
            if limit.is_exceeded() {
                let (site, value) = (Site::Particle(p), limit.value);
                return Err(Failure::OutsideYieldSurface { site, value });
            }
            let strain = self.surface.elasticity().strain(&stress);
            let squares = strain.map(|eps| libm::exp(2.0 * eps));
            Ok(Flowed { inverse_metric: assembled(&squares, &axes), strain: 0.0 })
        };
        self.flowed = stress.iter().enumerate().map(start).collect::<Result<_, _>>()?;
        Ok(true)
    }

    fn response(&self, p: usize, f: &Matrix<3>) -> Option<StressResponse> {
        let Flowed { inverse_metric, strain: flowed } = *self.flowed.get(p).unwrap_or(&Flowed::NOT);
        let elasticity = self.surface.elasticity();
        let principal = |strain: &Vector<3>| {
            let trial = PrincipalStrain::new(strain);
            let after = self.surface.return_from(&trial, flowed);
            let elastic = after.map_or(trial, |(elastic, _)| elastic);
            let modulus = self.surface.modulus_of_return(&trial, flowed);
            (elasticity.stress(&elastic), modulus.unwrap_or_else(|| elasticity.modulus()))
        };
        Some(StressResponse::new(f, &inverse_metric, principal))
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let mut flowed = std::mem::take(&mut self.flowed);
        body.by_block_with(&mut flowed, &|StressBlock { def_grad, vol, vol0, sigma, .. },
                                          flowed| {
            let columns = def_grad.chunks(BATCH).zip(flowed.chunks_mut(BATCH));
            let volumes = vol.chunks_mut(BATCH).zip(vol0.chunks(BATCH));
            let results = volumes.zip(sigma.chunks_mut(BATCH));
            for ((def_grad, flowed), ((vol, vol0), sigma)) in columns.zip(results) {
                let small = small_trial(def_grad, flowed);
                let (stresses, inside) = self.elastic(&small);
                let j = small.j;
                let results = vol.iter_mut().zip(vol0).zip(&mut *sigma).enumerate();
                for (lane, ((vol, vol0), sigma)) in results {
                    *vol = j.get(lane) * vol0;
                    *sigma = stresses.get(lane);
                }
                if inside[..def_grad.len()].iter().all(|inside| *inside) {
                    continue;
                }
                let (strains, axes) = trial(def_grad, flowed);
                let particles = def_grad.iter().zip(flowed).zip(sigma).enumerate();
                for (lane, ((f, flowed), sigma)) in particles.filter(|(lane, _)| !inside[*lane]) {
                    let (strain, axes) = (strains.get(lane), axes.get(lane));
                    let (stress, after) =
                        self.kirchhoff(&in_space(f, 1.0), *flowed, &strain, &axes);
                    *flowed = after;
                    *sigma = Matrix::from_fn(|i, k| stress[(i, k)] / j.get(lane));
                }
            }
        });
        self.flowed = flowed;
    }
}

/// Computes the trial strains of a batch of particles along their axes, `ln(be)/2` with
/// `be = F Cp^-1 F^T`.
fn trial<const D: usize>(
    def_grad: &[Matrix<D>],
    flowed: &[Flowed],
) -> (VectorBatch<3>, MatrixBatch<3>) {
    let in_space = |lane: usize| def_grad.get(lane).map_or(identity(), |f| in_space(f, 1.0));
    trial_in_space(&array(identity(), in_space), flowed)
}

/// Computes [`trial`]. Compiled once for all dimensions.
#[inline(never)]
fn trial_in_space(
    def_grad: &[Matrix<3>; BATCH],
    flowed: &[Flowed],
) -> (VectorBatch<3>, MatrixBatch<3>) {
    vectorized(
        #[inline(always)]
        || {
            let mut trial = MatrixBatch::identity();
            for (lane, (f, Flowed { inverse_metric, .. })) in
                def_grad.iter().zip(flowed).enumerate()
            {
                trial.set(lane, &product(&product(f, inverse_metric), &f.transpose()));
            }
            let (squares, axes) = spectral_batch(trial);
            (squares.map(half_log_batch), axes)
        },
    )
}

#[cfg(test)]
mod tests {
    use super::super::drucker_prager::DruckerPrager;
    use super::super::j2::J2;
    use super::super::mohr_coulomb::MohrCoulomb;
    use super::super::specimen::{SLOW, scattered};
    use super::*;
    use crate::mpm::foundation::algebra::in_body;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn encloses(surface: &impl YieldSurface, strain: &PrincipalStrain, axes: &Matrix<3>) -> bool {
        surface.encloses(strain.mean, &assembled(&strain.deviator, axes), 0.1)
    }

    /// Asserts that no state that the surface encloses returns to the surface, and that all states
    /// inside the surface are enclosed, except near the surface.
    fn hold<S: YieldSurface>(
        ElastoPlastic { surface, .. }: &ElastoPlastic<S>,
        strain: [f64; 3],
        axes: &Matrix<3>,
    ) {
        let at = |share: f64| PrincipalStrain::new(&(Vector::<3>::from(strain) * share));
        // Shares far from the surface, and shares that bracket the surface.
        let (mut low, mut high) = (0.0, 2.0);
        for share in [0.01, 0.1, 0.3, 1.0] {
            let is_inside = surface.return_from(&at(share), 0.1).is_none();
            assert!(is_inside || !encloses(surface, &at(share), axes), "{share} of {strain:?}");
            assert!(!encloses(surface, &at(f64::NAN * share), axes));
        }
        for _ in 0..60 {
            let middle: f64 = 0.5 * (low + high);
            let is_inside = surface.return_from(&at(middle), 0.1).is_none();
            assert!(is_inside || !encloses(surface, &at(middle), axes), "{middle} of {strain:?}");
            if is_inside { low = middle } else { high = middle }
        }
        assert!(encloses(surface, &at(0.9 * low), axes), "{low} of {strain:?}");
    }

    proptest! {
        #[test]
        fn surface_encloses_the_states_without_return(
            strain in proptest::array::uniform3(-0.05..0.05_f64),
            equal in any::<bool>(),
            turn in proptest::array::uniform9(-1.0..1.0_f64),
            poisson in 0.0..0.49_f64,
            friction in prop_oneof![Just(0.0), 0.0..60.0_f64],
            strength in 1.0..50.0_f64,
        ) {
            let strain = if equal { [strain[0], strain[0], strain[2]] } else { strain };
            let turn = Matrix::<3>::from_row_slice(&turn);
            let (_, axes) = spectral(&(turn + turn.transpose()));
            hold(&J2::new(1e4, poisson, strength, 20.0), strain, &axes);
            hold(&DruckerPrager::new(1e4, poisson, friction / 60.0, 0.0, strength), strain, &axes);
            hold(&MohrCoulomb::new(1e4, poisson, friction, 0.0, strength), strain, &axes);
        }
    }

    /// Unloads a particle after plastic flow, and compares the stress with the stress from the axes
    /// of the trial strain.
    #[test]
    fn elastic_stress_after_flow_agrees_with_the_stress_from_axes() {
        fn of<const D: usize, S: YieldSurface>(mut law: ElastoPlastic<S>) {
            let mut body = Particles::cubes([1; D]);
            let first = Matrix::identity() + scattered::<D>(0.1, 0.3);
            body.deform(|_| (Vector::zeros(), first));
            law.update(&mut StressUpdate::new(SLOW, &mut body));
            assert!(law.flowed[0].strain > 1e-3);
            let f = Matrix::identity() * 1e-4 + first * (1.0 - 1e-3);
            let trial = small_trial(&[f], &law.flowed);
            let (sigma, inside) = law.elastic(&trial);
            assert!(inside[0] && trial.j.get(0) == det(&f));
            let tau = sigma.get::<D>(0) * det(&f);
            let response = Material::<D>::response(&law, 0, &in_space(&f, 1.0)).unwrap();
            let expected = in_body::<D>(&response.kirchhoff);
            assert_relative_eq!(tau, expected, epsilon = 1e-12 * expected.norm());
        }
        of::<2, _>(J2::new(1e4, 0.3, 30.0, 20.0));
        of::<3, _>(J2::new(1e4, 0.3, 30.0, 20.0));
        of::<3, _>(DruckerPrager::new(1e4, 0.3, 0.2, 0.0, 30.0));
        of::<3, _>(MohrCoulomb::new(1e4, 0.3, 20.0, 0.0, 30.0));
    }
}
