//! Thermal expansion: a strain due to temperature that causes no stress in a free body.
//!
//! For a law that depends only on F, F is split as `F = theta Fe` with the stretch
//! `theta = 1 + alpha (T - T0)` on every axis, and the law uses Fe (Stojanovic, Djuric & Vujosevic
//! 1964; Lubarda 2004, Appl. Mech. Rev. 57). A free body then expands exactly by theta. For a law
//! in rate form the thermal strain increment is subtracted, `sigma -= E/(1 - 2 nu) alpha dT I`
//! (Duhamel & Neumann). In 2-D this is plane strain, in 1-D uniaxial strain.
//!
//! The split applies to the D dimensions of the body. If Poisson's ratio is zero, the out-of-plane
//! axes have no effect. The heat absorbed by the expansion is neglected.

use super::contract::Effect;
use crate::mpm::foundation::algebra::{Matrix, identity};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::material::{Material, StressUpdate};
use mpm_subject::Column;
use std::any::Any;

/// Thermal expansion. In the list of effects, the effect that computes temperatures must precede
/// this effect.
pub struct ThermalExpansion<const D: usize> {
    /// Coefficient of thermal expansion alpha (1/K).
    coefficient: f64,
    /// Temperature T0 (K), at which the undeformed body is free of stress.
    reference: f64,
    law: ExpansionLaw<D>,
}

/// Form of the expansion for each kind of law.
enum ExpansionLaw<const D: usize> {
    /// While stresses are computed, `elastic` contains Fe and is used in place of F.
    OfDeformation { elastic: Vec<Matrix<D>> },
    /// `modulus` is `E/(1 - 2 nu)` (Pa). `before` holds the temperatures (K) at the last stress
    /// update.
    InRateForm { modulus: f64, before: Vec<f64> },
}

impl<const D: usize> ThermalExpansion<D> {
    /// Creates the expansion for a law that depends only on F, with alpha (1/K) and T0 (K).
    pub fn of_deformation(coefficient: f64, reference: f64) -> Self {
        Self { coefficient, reference, law: ExpansionLaw::OfDeformation { elastic: Vec::new() } }
    }

    /// Creates the expansion for a law in rate form, with Young's modulus (Pa) and Poisson's ratio.
    pub fn in_rate_form(coefficient: f64, reference: f64, young: f64, poisson: f64) -> Self {
        let modulus = young / (1.0 - 2.0 * poisson);
        Self {
            coefficient,
            reference,
            law: ExpansionLaw::InRateForm { modulus, before: Vec::new() },
        }
    }
}

impl<const D: usize> Effect<D> for ThermalExpansion<D> {
    fn name(&self) -> &'static str {
        "thermal_expansion"
    }

    fn makes_stress(&self) -> bool {
        true
    }

    fn columns(&self) -> Vec<Column<'_>> {
        match &self.law {
            ExpansionLaw::OfDeformation { elastic } => vec![Column::of_particles("Fe", elastic)],
            ExpansionLaw::InRateForm { before, .. } => {
                vec![Column::of_particles("previous T", before)]
            }
        }
    }

    /// Excludes Fe, which is overwritten before it is read.
    fn state(&self) -> Option<Box<dyn Any>> {
        match &self.law {
            ExpansionLaw::OfDeformation { .. } => None,
            ExpansionLaw::InRateForm { before, .. } => Some(Box::new(before.clone())),
        }
    }

    fn set_state(&mut self, state: &dyn Any) {
        if let ExpansionLaw::InRateForm { before, .. } = &mut self.law
            && let Some(state) = state.downcast_ref()
        {
            before.clone_from(state);
        }
    }

    /// Computes the stress for the temperature at the start.
    fn start(&mut self, material: &mut dyn Material<D>, particles: &mut Particles<D>) {
        match &mut self.law {
            ExpansionLaw::OfDeformation { elastic } => elastic.clone_from(&particles.def_grad),
            ExpansionLaw::InRateForm { before, .. } => {
                before.resize(particles.len(), self.reference);
            }
        }
        self.before_stress(particles);
        material.update(&mut StressUpdate::new(0.0, particles));
        self.after_stress(particles);
    }

    fn before_stress(&mut self, particles: &mut Particles<D>) {
        let ExpansionLaw::OfDeformation { elastic } = &mut self.law else { return };
        std::mem::swap(elastic, &mut particles.def_grad);
        let whole = elastic.iter().zip(&particles.temperature);
        for (inner, (f, temperature)) in particles.def_grad.iter_mut().zip(whole) {
            *inner = f / (1.0 + self.coefficient * (temperature - self.reference));
        }
    }

    fn after_stress(&mut self, particles: &mut Particles<D>) {
        match &mut self.law {
            ExpansionLaw::OfDeformation { elastic } => {
                std::mem::swap(elastic, &mut particles.def_grad);
                for (vol, temperature) in particles.vol.iter_mut().zip(&particles.temperature) {
                    let theta = 1.0 + self.coefficient * (temperature - self.reference);
                    *vol *= (0..D).map(|_| theta).product::<f64>();
                }
            }
            ExpansionLaw::InRateForm { modulus, before } => {
                let changes = before.iter_mut().zip(&particles.temperature);
                for (sigma, (before, now)) in particles.sigma.iter_mut().zip(changes) {
                    let pressure = *modulus * self.coefficient * (now - *before);
                    *sigma -= identity() * pressure;
                    *before = *now;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::{Hencky, NeoHookean};
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// The temperature of 30 K is 10 K above the reference temperature.
    #[rstest]
    fn a_body_that_expands_freely_has_no_stress(#[values(false, true)] hencky: bool) {
        let mut body = Particles::cubes([1; 3]);
        body.track_deformation();
        body.temperature = vec![30.0];
        let mut expansion = ThermalExpansion::of_deformation(0.02, 20.0);
        let f = Matrix::<3>::identity() * 1.2;
        body.def_grad[0] = f;
        let mut laws: [Box<dyn Material<3>>; 2] =
            [Box::new(NeoHookean::new(50.0, 0.3)), Box::new(Hencky::new(50.0, 0.3))];
        expansion.start(laws[usize::from(hencky)].as_mut(), &mut body);
        assert!(body.sigma[0].norm() < 1e-13, "{}", body.sigma[0]);
        assert_eq!(body.def_grad[0], f, "F is given back as it was");
        assert_relative_eq!(body.vol[0], 1.2 * 1.2 * 1.2, max_relative = 1e-14);
    }
}
