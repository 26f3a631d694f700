//! Observables of a body: conserved sums, samples of the particles, and the reaction of fixed
//! walls.
//!
//! The reaction balances the internal and external forces on the fixed nodes, so it is `-sum f_i`
//! over the fixed components. Only the functions of these nodes are non-zero on the wall, where
//! their sum is one, so the reaction converges to the integral of the traction for small cells.

use super::solver::Solver;
use crate::mpm::boundary::{Boundary, Side};
use crate::mpm::foundation::algebra::{Matrix, Vector, dyad, zeros};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::material::Material;
use mpm_subject::{Reaction, Samples, Totals};

impl<const D: usize> Particles<D> {
    /// Returns current mass, momenta and kinetic energy, without the strain energy of the material.
    /// The function `own` returns the first moment of the velocity field within a particle, if the
    /// transfer has such a field (Jiang et al. 2015).
    pub fn totals(&self, own: impl Fn(usize) -> Option<Matrix<D>>) -> Totals {
        let mut totals = Totals::default();
        // Bodies at rest have no column of velocities.
        for p in 0..self.v.len() {
            let (m, mut v, axial) = (self.mass[p], [0.0; 3], axial(&self.moment(p, own(p))));
            v[..D].copy_from_slice(self.v[p].as_slice());
            totals.add(m, v, [m * axial[0], m * axial[1], m * axial[2]]);
            totals.add_second_moments(m, self.position(p).as_slice(), self.x0[p].as_slice());
        }
        totals
    }

    /// Returns a matrix whose axial vector is the angular momentum of particle p per unit mass:
    /// `v x^T` for the motion of its centre, plus the moment `own` about the centre.
    fn moment(&self, p: usize, own: Option<Matrix<D>>) -> Matrix<D> {
        dyad(&self.v[p], self.position(p)) + own.unwrap_or_else(zeros)
    }

    /// Appends the state of the particles to `samples`. F is included only if its column exists.
    pub(in crate::mpm) fn sample(&self, samples: &mut Samples) {
        samples.dimension = D;
        for (p, x0) in self.x0.iter().enumerate() {
            samples.label.extend_from_slice(x0.as_slice());
            samples.displacement.extend_from_slice((self.position(p) - x0).as_slice());
        }
        for v in &self.v {
            samples.velocity.extend_from_slice(v.as_slice());
        }
        samples.weight.extend(&self.vol0);
        samples.mass.extend(&self.mass);
        samples.temperature.extend(&self.temperature);
        for (column, into) in [
            (&self.sigma, &mut samples.stress),
            (&self.def_grad, &mut samples.deformation_gradient),
        ] {
            for matrix in column {
                for i in 0..D {
                    for j in 0..D {
                        into.push(matrix[(i, j)]);
                    }
                }
            }
        }
    }

    /// Appends the state of the particles to `samples`, with the out-of-plane stresses of a body of
    /// revolution and, if requested, of any two-dimensional body.
    pub(in crate::mpm) fn sample_with(&self, material: &dyn Material<D>, samples: &mut Samples) {
        self.sample(samples);
        samples.stress_across.extend(&self.stress_across);
        if self.samples_stress_across && self.stress_across.is_empty() {
            let across = (0..self.len()).map(|p| material.stress_across(p, self));
            samples.stress_across.extend(across.map(|across| across.unwrap_or(f64::NAN)));
        }
    }
}

/// Returns `(M_zy - M_yz, M_xz - M_zx, M_yx - M_xy)`, which is x cross v for `M = v x^T`, in any
/// dimension.
fn axial<const D: usize>(m: &Matrix<D>) -> [f64; 3] {
    let part = |i: usize, j: usize| if i.max(j) < D { m[(i, j)] - m[(j, i)] } else { 0.0 };
    [part(2, 1), part(0, 2), part(1, 0)]
}

impl<const D: usize> Solver<D> {
    /// Returns the reaction of all fixed walls, or of one face of the grid, at the beginning of the
    /// last step. A face is given by the axis of its normal and the end of this axis.
    pub fn reaction(&self, of: Option<(usize, Side)>) -> Reaction {
        let force = wall_reaction(&self.setup.grid.force, &self.setup.boundary, of);
        Reaction { time: self.advance.to - 0.5 * self.advance.dt, force }
    }
}

/// Returns the reaction (N) of all fixed walls, or of one face of the grid, to the nodal forces
/// `force` (N), which are the sum of internal and external forces.
pub(in crate::mpm) fn wall_reaction<const D: usize>(
    force: &[Vector<D>],
    boundary: &[Box<dyn Boundary<D>>],
    of: Option<(usize, Side)>,
) -> [f64; 3] {
    let mut unheld = force.to_vec();
    for wall in boundary {
        if wall.standing_face().is_some_and(|face| of.is_none_or(|of| of == face)) {
            wall.clear(&mut unheld);
        }
    }
    let differences = unheld.iter().zip(force).map(|(unheld, force)| unheld - force);
    let sum = differences.fold(zeros(), |sum, each| sum + each);
    let mut reaction = [0.0; 3];
    reaction[..D].copy_from_slice(sum.as_slice());
    reaction
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tensors_are_written_row_by_row() {
        let mut particles = Particles::cubes([1; 2]);
        particles.sigma[0] = Matrix::<2>::new(1.0, 2.0, 3.0, 4.0);
        let mut samples = Samples::default();
        particles.sample(&mut samples);
        assert_eq!(samples.stress, [1.0, 2.0, 3.0, 4.0]);
        assert!(samples.deformation_gradient.is_empty(), "nothing tracks F");
        particles.track_deformation();
        particles.def_grad[0][(0, 1)] = 0.5;
        samples.clear();
        particles.sample(&mut samples);
        assert_eq!(samples.deformation_gradient, [1.0, 0.5, 0.0, 1.0]);
    }
}
