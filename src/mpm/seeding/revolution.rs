//! A body of revolution, of what lies in its meridian plane.

use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::particles::Particles;

impl<const D: usize> Particles<D> {
    /// Makes a body of revolution of the particles in its meridian plane, r being the first axis
    /// and z the second: masses (kg/rad) and volumes (m^3/rad) are those of one radian.
    pub fn revolve(&mut self) {
        for (p, x0) in self.x0.iter().enumerate() {
            for column in [&mut self.mass, &mut self.vol0, &mut self.vol] {
                column[p] *= x0[0];
            }
        }
        self.across = vec![1.0; self.len()];
        (self.rate_across, self.stress_across) = (vec![0.0; self.len()], vec![0.0; self.len()]);
    }

    /// Whether any hoop starts with another radius than its own, or with NaN.
    pub(in crate::mpm) fn is_widened(&self) -> bool {
        let is_own = |(x, x0): (&Vector<D>, &Vector<D>)| x[0] == x0[0];
        !self.stress_across.is_empty() && !self.x.iter().zip(&self.x0).all(is_own)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::Block;
    use approx::assert_relative_eq;

    /// `int r dr dz` of a box is exact with the radius at the middle of each share.
    #[test]
    fn a_hollow_cylinder_has_its_mass_per_radian() {
        let (from, to) = (Vector::<2>::new(0.5, 0.0), Vector::<2>::new(2.0, 3.0));
        let mut ring = Particles::fill(&Block { from, to, density: 2.0 }, 0.25, 2);
        ring.revolve();
        let volume = 0.5 * (2.0 * 2.0 - 0.5 * 0.5) * 3.0;
        assert_relative_eq!(ring.vol0.iter().sum::<f64>(), volume, max_relative = 1e-13);
        assert_relative_eq!(ring.mass.iter().sum::<f64>(), 2.0 * volume, max_relative = 1e-13);
        assert_eq!((ring.vol.as_slice(), ring.across[0]), (ring.vol0.as_slice(), 1.0));
    }
}
