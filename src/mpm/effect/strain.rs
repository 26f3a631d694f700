//! Constitutive update with the hooks of the effects.

use super::contract::Effect;
use crate::mpm::material::Material;
use crate::mpm::particles::Particles;

/// New stresses after `dt` (s).
pub(in crate::mpm) fn strain<const D: usize>(
    effects: &mut [Box<dyn Effect<D>>],
    material: &mut dyn Material<D>,
    dt: f64,
    particles: &mut Particles<D>,
) {
    for effect in effects.iter_mut() {
        effect.before_stress(particles);
    }
    material.update(dt, particles);
    for effect in effects {
        effect.after_stress(particles);
    }
}
