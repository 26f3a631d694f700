//! Initial states of bodies, and tables of particles.

use crate::mpm::foundation::algebra::{Matrix, Vector, inverse};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::material::{Material, Prestressed};
use mpm_subject::Failure;

/// Motion of a point at t = 0. Entries of missing dimensions are ignored.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct StateInput {
    /// Displacement (m).
    pub u: [f64; 3],
    /// Displacement gradient, with components `[i][j] = du_i/dX_j`.
    pub grad: [[f64; 3]; 3],
    /// Velocity (m/s).
    pub velocity: [f64; 3],
    /// Gradient of the velocity with respect to X (1/s).
    pub grad_rate: [[f64; 3]; 3],
}

/// Returns the motion at a reference position (m).
pub type MotionAt<'a> = Box<dyn Fn(&[f64]) -> StateInput + 'a>;

/// Returns a Cauchy stress (Pa) at a reference position (m).
pub type StressAt<'a> = Box<dyn Fn(&[f64]) -> [[f64; 3]; 3] + 'a>;

/// Functions of the reference position (m) that describe a body at t = 0.
pub struct InitialState<'a> {
    /// Motion of the point.
    pub motion: MotionAt<'a>,
    /// Whether the body is displaced. If false, `u` and `grad` are ignored.
    pub is_displaced: bool,
    /// Initial Cauchy stress (Pa), if any.
    pub stress: Option<StressAt<'a>>,
}

impl InitialState<'_> {
    /// Adds the initial stress of `particles`, if any, to `law`.
    ///
    /// # Errors
    /// [`Failure::OutsideYieldSurface`] for a stress that violates the yield condition of `law`.
    pub(super) fn stressed<const D: usize>(
        &self,
        law: Box<dyn Material<D>>,
        particles: &mut Particles<D>,
    ) -> Result<Box<dyn Material<D>>, Failure> {
        let Some(stress) = &self.stress else { return Ok(law) };
        let stress = particles.x0.iter().map(|x0| {
            let stress = stress(x0.as_slice());
            Matrix::from_fn(|i, j| stress[i][j])
        });
        let stress: Vec<Matrix<3>> = stress.collect();
        Ok(Box::new(Prestressed::new(law, &stress, particles)?))
    }

    /// Sets the velocities of `particles`, and their deformation if the body is displaced.
    pub(super) fn put<const D: usize>(&self, particles: &mut Particles<D>) {
        let states: Vec<StateInput> =
            particles.x0.iter().map(|x0| (self.motion)(x0.as_slice())).collect();
        for (v, now) in particles.v.iter_mut().zip(&states) {
            *v = Vector::from_fn(|i, _| now.velocity[i]);
        }
        for (grad_v, now) in particles.grad_v.iter_mut().zip(&states) {
            let f: Matrix<D> = Matrix::from_fn(|i, j| now.grad[i][j]) + Matrix::identity();
            let rate = Matrix::from_fn(|i, j| now.grad_rate[i][j]);
            // If F has no inverse, the solver rejects the initial state.
            *grad_v = inverse(&f).map_or_else(Matrix::zeros, |inverse| rate * inverse);
        }
        if self.is_displaced {
            particles.deform(|p| {
                let StateInput { u, grad, .. } = &states[p];
                let grad = Matrix::from_fn(|i, j| grad[i][j]);
                (Vector::from_fn(|i, _| u[i]), Matrix::identity() + grad)
            });
        }
    }
}

/// The particles of one body as flat columns, one particle after another. Vectors have D numbers,
/// tensors D*D numbers in rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ParticleTable {
    /// Reference positions (m).
    pub reference_position: Vec<f64>,
    /// Positions (m).
    pub position: Vec<f64>,
    /// Velocities (m/s).
    pub velocity: Vec<f64>,
    /// Masses (kg).
    pub mass: Vec<f64>,
    /// Reference volumes (m^D).
    pub reference_volume: Vec<f64>,
    /// Volumes (m^D).
    pub volume: Vec<f64>,
    /// Deformation gradients.
    pub deformation_gradient: Vec<f64>,
    /// Cauchy stresses (Pa).
    pub stress: Vec<f64>,
    /// Out-of-plane stresses (Pa); empty except in a body of revolution.
    pub hoop_stress: Vec<f64>,
}

impl ParticleTable {
    pub(super) fn new<const D: usize>(mut particles: Particles<D>) -> Self {
        // F is listed even if the law does not use it.
        particles.track_deformation();
        let vectors = |all: &[Vector<D>]| all.iter().flatten().copied().collect::<Vec<_>>();
        Self {
            reference_position: vectors(&particles.x0),
            position: vectors(&particles.x),
            velocity: vectors(&particles.v),
            deformation_gradient: rows(&particles.def_grad),
            stress: rows(&particles.sigma),
            mass: particles.mass,
            reference_volume: particles.vol0,
            volume: particles.vol,
            hoop_stress: particles.stress_across,
        }
    }
}

/// Lists the components of tensors in rows. The matrix library stores columns.
pub(super) fn rows<const D: usize>(tensors: &[Matrix<D>]) -> Vec<f64> {
    tensors.iter().flat_map(|tensor| tensor.transpose().data.0).flatten().collect()
}
