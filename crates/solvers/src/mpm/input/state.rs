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

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// F = (1.5, -0.5; 1, 1) has the determinant 2 and the inverse (0.5, 0.25; -0.5, 0.75).
    #[test]
    fn deformed_and_rotated_particles_have_their_state_in_rows() {
        let motion = |x: &[f64]| StateInput {
            u: [x[0], 10.0 * x[1], 7.0],
            grad: [[0.5, -0.5, 7.0], [1.0, 0.0, 7.0], [7.0; 3]],
            velocity: [3.0 * x[0], 4.0 * x[1], 7.0],
            grad_rate: [[2.0, 4.0, 7.0], [6.0, 8.0, 7.0], [7.0; 3]],
        };
        let mut particles = Particles::<2>::cubes([2, 1]);
        particles.mass = vec![3.0, 5.0];
        particles.sigma[1] = Matrix::<2>::new(1.0, 2.0, 3.0, 4.0);
        let mut state = InitialState { motion: Box::new(motion), is_displaced: true, stress: None };
        state.put(&mut particles);
        // grad_rate F^-1
        let expected = Matrix::<2>::new(-1.0, 3.5, -1.0, 7.5);
        assert_relative_eq!(particles.grad_v[1], expected, epsilon = 1e-14);
        let table = ParticleTable::new(particles.clone());
        let expected = ParticleTable {
            reference_position: vec![0.5, 0.5, 1.5, 0.5],
            position: vec![1.0, 5.5, 3.0, 5.5],
            velocity: vec![1.5, 2.0, 4.5, 2.0],
            mass: vec![3.0, 5.0],
            reference_volume: vec![1.0, 1.0],
            volume: vec![2.0, 2.0],
            deformation_gradient: [1.5, -0.5, 1.0, 1.0].repeat(2),
            stress: vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0],
            hoop_stress: Vec::new(),
        };
        assert_eq!(table, expected);
        // Without a displacement, only the velocity is set.
        state.is_displaced = false;
        let mut undeformed = Particles::<2>::cubes([2, 1]);
        state.put(&mut undeformed);
        assert_eq!((&undeformed.x, &undeformed.v), (&undeformed.x0, &particles.v));
        assert!(undeformed.def_grad.is_empty());
    }
}
