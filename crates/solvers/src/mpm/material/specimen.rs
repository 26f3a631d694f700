//! One particle of each registered material, for tests of all materials.

use super::stress_update::StressUpdate;
use super::tangent::StressResponse;
use super::{
    COHESION, COMPRESSION, CRITICAL_SLOPE, DILATION, DILATION_ANGLE, EXPONENT, FRICTION,
    FRICTION_ANGLE, Material, MaterialPlan, POISSON, PRECONSOLIDATION, STRENGTH, SWELLING,
    VISCOSITY, YIELD, YOUNG,
};
use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::particles::{Block, Particles};
use mpm_subject::PlaneState;

/// Duration (s) of a step so slow that viscous stresses are negligible. In a step of the duration
/// `FAST`, all other stresses are negligible. Both durations are powers of two, so their products
/// with velocity gradients are exact.
pub(super) const SLOW: f64 = 1_099_511_627_776.0;
pub(super) const FAST: f64 = 1.0 / SLOW;

/// Reference density of a specimen (kg/m3).
pub(super) const DENSITY: f64 = 1.25;

pub(super) fn every() -> Vec<MaterialPlan> {
    MaterialPlan::every(|parameter| match *parameter {
        YOUNG => 100.0,
        POISSON | FRICTION => 0.3,
        YIELD | STRENGTH | COHESION => 3.0,
        DILATION => 0.1,
        FRICTION_ANGLE => 20.0,
        DILATION_ANGLE => 0.0,
        VISCOSITY => 0.7,
        EXPONENT => 1.4,
        CRITICAL_SLOPE => 1.2,
        SWELLING => 0.5,
        COMPRESSION => 1.0,
        PRECONSOLIDATION => 80.0,
        _ => 40.0,
    })
}

/// A material with its only particle.
pub(super) struct Specimen<const D: usize>(Box<dyn Material<D>>, Particles<D>);

impl<const D: usize> Specimen<D> {
    pub(super) fn new(plan: MaterialPlan) -> Self {
        Self::with(plan.build())
    }

    pub(super) fn with(material: Box<dyn Material<D>>) -> Self {
        let (from, to) = (Vector::zeros(), Vector::from_element(1.0));
        let mut particles = Particles::fill(&Block { from, to, density: DENSITY }, 1.0, 1);
        particles.track_deformation();
        Self(material, particles)
    }

    /// Creates a particle of a body with this out-of-plane state; `None` if the law does not
    /// support this state.
    pub(super) fn in_plane(plan: MaterialPlan, plane: PlaneState) -> Option<Self> {
        let Self(_, mut particles) = Self::new(plan);
        particles.across = vec![1.0];
        if plane == PlaneState::Axisymmetric {
            (particles.rate_across, particles.stress_across) = (vec![0.0], vec![0.0]);
        }
        Some(Self(plan.in_plane(plane)?, particles))
    }

    pub(super) fn flow(&mut self, grad_v: &Matrix<D>, dt: f64) -> Matrix<D> {
        let Self(material, particles) = self;
        particles.grad_v[0] = *grad_v;
        particles.def_grad[0] = (Matrix::identity() + grad_v * dt) * particles.def_grad[0];
        material.update(&mut StressUpdate::new(dt, particles));
        particles.sigma[0]
    }

    pub(super) fn flow_in_hoops(&mut self, grad_v: &Matrix<D>, rate: f64, dt: f64) -> Matrix<D> {
        self.1.rate_across[0] = rate;
        self.1.across[0] *= 1.0 + rate * dt;
        self.flow(grad_v, dt)
    }

    pub(super) fn deform(&mut self, step: &Matrix<D>, dt: f64) -> Matrix<D> {
        self.flow(&((step - Matrix::identity()) / dt), dt)
    }

    /// Returns the stress of a body that starts at this F.
    pub(super) fn start(&mut self, f: &Matrix<D>) -> Matrix<D> {
        let Self(material, particles) = self;
        particles.deform(|_| (Vector::zeros(), *f));
        material.start_deformed(particles).unwrap();
        particles.sigma[0]
    }

    /// Creates another specimen of `plan` with the state of this specimen.
    pub(super) fn copied(&self, plan: MaterialPlan) -> Self {
        let Self(mut material, _) = Self::new(plan);
        if let Some(state) = self.0.state() {
            material.set_state(state.as_ref());
        }
        Self(material, self.1.clone())
    }

    /// Returns stress and tangent at this 3-D F, for a step from the current state.
    pub(super) fn response(&self, f: &Matrix<3>) -> Option<StressResponse> {
        self.0.response(0, f)
    }

    pub(super) fn energy(&self) -> Option<f64> {
        self.0.energy(&self.1)
    }

    pub(super) fn across(&self) -> f64 {
        self.1.across[0]
    }

    pub(super) fn stress_across(&self) -> f64 {
        self.1.stress_across[0]
    }

    pub(super) fn j(&self) -> f64 {
        self.1.vol[0] / self.1.vol0[0]
    }
}

/// Returns the stress after one slow step from rest.
pub(super) fn stress<const D: usize>(plan: MaterialPlan, f: &Matrix<D>) -> Matrix<D> {
    Specimen::new(plan).deform(f, SLOW)
}

/// Returns a matrix of irregular numbers with magnitudes up to `size`.
pub(super) fn scattered<const D: usize>(size: f64, seed: f64) -> Matrix<D> {
    Matrix::from_fn(|i, j| size * libm::sin(seed + 7.0 * i as f64 + 11.3 * j as f64))
}

/// Extrapolates `rows`, computed with steps that halve from row to row, to step zero by
/// Richardson's method in powers of the step: all powers for `base` 2, even powers for `base` 4.
/// Also returns the observed order of the first component.
pub(super) fn richardson<const N: usize>(mut rows: Vec<Vector<N>>, base: i32) -> (Vector<N>, f64) {
    let change = |k: usize| rows[rows.len() - k][0] - rows[rows.len() - k - 1][0];
    let order = libm::log2(change(2) / change(1));
    for k in 1..rows.len() as u32 {
        let weight = f64::from(base.pow(k) - 1);
        rows = rows.windows(2).map(|pair| pair[1] + (pair[1] - pair[0]) / weight).collect();
    }
    (rows[0], order)
}
