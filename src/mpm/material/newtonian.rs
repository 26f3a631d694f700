//! A weakly compressible Newtonian fluid.
//!
//! `sigma = -p I + 2 eta dev(D)`, `D = sym(grad v)`, with Tait's equation of state in Cole's form,
//! `p = K/7 (J^-7 - 1)` (Cole 1948; Monaghan 1994): K is the bulk modulus at rest, and the
//! resistance to compression grows without bound, so that no particle collapses. The deviator is
//! that of three dimensions whatever D: flow in a plane or along a line still dilates or
//! compresses, `tr(D)/3` along each axis.
//!
//! Of the deformation the fluid knows J alone, which it integrates, `J *= det(I + grad v dt)`: F
//! grows without limit in a flow, and is not kept.

use super::contract::Material;
use crate::mpm::{
    algebra::{Matrix, det},
    particles::Particles,
};

/// A viscous fluid, weakly compressible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Newtonian {
    bulk: f64,
    viscosity: f64,
}

impl Newtonian {
    /// From the bulk modulus at rest (Pa) and the dynamic viscosity (Pa s).
    pub fn new(bulk: f64, viscosity: f64) -> Self {
        Self { bulk, viscosity }
    }

    fn pressure(&self, j: f64) -> f64 {
        let cube = 1.0 / (j * j * j);
        self.bulk / 7.0 * (cube * cube / j - 1.0)
    }
}

impl<const D: usize> Material<D> for Newtonian {
    fn reads_deformation(&self) -> bool {
        false
    }

    /// That of the pressure, `K/7 (J^-6/6 + J - 7/6)`.
    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        let density = |j: f64| {
            let cube = 1.0 / (j * j * j);
            self.bulk / 7.0 * (cube * cube / 6.0 + j - 7.0 / 6.0)
        };
        let all = particles.vol.iter().zip(&particles.vol0);
        Some(all.map(|(vol, vol0)| vol0 * density(vol / vol0)).sum())
    }

    fn update(&mut self, dt: f64, particles: &mut Particles<D>) {
        for p in 0..particles.len() {
            let grad_v = &particles.grad_v[p];
            particles.vol[p] *= det(&(Matrix::identity() + grad_v * dt));
            let pressure = self.pressure(particles.vol[p] / particles.vol0[p]);
            let isotropic = -pressure - 2.0 / 3.0 * self.viscosity * grad_v.trace();
            let shear = (grad_v + grad_v.transpose()) * self.viscosity;
            particles.sigma[p] = Matrix::identity() * isotropic + shear;
        }
    }
}
