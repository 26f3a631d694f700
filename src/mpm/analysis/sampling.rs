//! Samples of the particles for the verification.

use crate::mpm::foundation::particles::Particles;
use crate::subject::Samples;

impl<const D: usize> Particles<D> {
    /// Appends the state at the reference positions; F only if its column exists.
    pub(in crate::mpm) fn sample(&self, samples: &mut Samples) {
        samples.dimension = D;
        for (p, x0) in self.x0.iter().enumerate() {
            samples.label.extend(x0.iter());
            samples.displacement.extend((self.position(p) - x0).iter());
        }
        samples.velocity.extend(self.v.iter().flat_map(|v| v.iter()));
        samples.weight.extend(&self.vol0);
        samples.temperature.extend(&self.temperature);
        for (column, into) in [
            (&self.sigma, &mut samples.stress),
            (&self.def_grad, &mut samples.deformation_gradient),
        ] {
            for matrix in column {
                for i in 0..D {
                    into.extend((0..D).map(|j| matrix[(i, j)]));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::foundation::algebra::{Matrix, Vector};
    use crate::mpm::foundation::particles::Block;

    #[test]
    fn tensors_are_written_row_after_row() {
        let (from, to) = (Vector::<2>::zeros(), Vector::from_element(1.0));
        let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, 1);
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
