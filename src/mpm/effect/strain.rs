//! Constitutive update with the hooks of the effects.

use super::contract::Effect;
use crate::mpm::material::{Material, StressUpdate};

/// New stresses; returns [`StressUpdate::least_j`].
pub(in crate::mpm) fn strain<const D: usize>(
    effects: &mut [Box<dyn Effect<D>>],
    material: &mut dyn Material<D>,
    mut body: StressUpdate<'_, D>,
) -> Option<f64> {
    for effect in effects.iter_mut().filter(|effect| effect.makes_stress()) {
        effect.before_stress(body.particles());
    }
    material.update(&mut body);
    // Brackets: an effect finds the particles as its hook before has left them. The volume that
    // thermal expansion gives back is that of the density which artificial viscosity takes.
    for effect in effects.iter_mut().rev().filter(|effect| effect.makes_stress()) {
        effect.after_stress(body.particles());
    }
    body.least_j()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::{
        ArtificialViscosity, Block, Hencky, Matrix, Particles, ThermalExpansion, Vector,
    };
    use approx::assert_relative_eq;

    /// A hot bar that closes: Hencky's stress of its elastic stretch 1.5/1.2 with E = 50, less
    /// `q = rho (l D)^2` with l D = 0.3 and the density at the whole stretch, 3/1.5.
    #[test]
    fn a_viscosity_has_the_density_of_the_expanded_body() {
        let block = Block { from: Vector::zeros(), to: Vector::<1>::new(1.0), density: 3.0 };
        let mut bar = Particles::fill(&block, 1.0, 1);
        bar.track_deformation();
        bar.temperature = vec![30.0];
        bar.def_grad[0] = Matrix::<1>::new(1.5);
        let (linear, quadratic, length, speed) = (0.0, 1.0, 0.1, 1.0);
        let viscosity = ArtificialViscosity { linear, quadratic, length, speed, q: Vec::new() };
        let mut expansion = ThermalExpansion::of_deformation(0.02, 20.0);
        let mut law = Hencky::new(50.0, 0.0);
        expansion.start(&mut law, &mut bar);
        bar.grad_v[0] = Matrix::<1>::new(-3.0);
        let mut effects: Vec<Box<dyn Effect<1>>> = vec![Box::new(viscosity), Box::new(expansion)];
        strain(&mut effects, &mut law, StressUpdate::new(0.0, &mut bar));
        let expected = 50.0 * libm::log(1.25) / 1.25 - 2.0 * 0.09;
        assert_relative_eq!(bar.sigma[0][(0, 0)], expected, max_relative = 1e-14);
        assert_relative_eq!(bar.vol[0], 1.5, max_relative = 1e-14);
    }
}
