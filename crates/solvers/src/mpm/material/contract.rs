//! Interface between materials and the solver, and between materials and the suite compiler.

use super::stress_update::StressUpdate;
use super::tangent::StressResponse;
use crate::mpm::foundation::algebra::{Matrix, det, in_space};
use crate::mpm::foundation::particles::Particles;
use mpm_subject::{Column, Failure};
use std::any::Any;

/// Properties of a law that determine which problems can use the law.
pub trait MaterialProperties {
    /// Returns the modulus for uniaxial strain at rest (Pa): `rho0 c^2` of the fastest wave, in a
    /// body with the reference density `density` (kg/m3).
    fn wave_modulus(&self, density: f64) -> f64;

    /// Returns the speed (m/s) of the fastest wave at rest, in a body with the reference density
    /// `density` (kg/m3).
    fn wave_speed(&self, density: f64) -> f64 {
        (self.wave_modulus(density) / density).sqrt()
    }

    /// Whether the law integrates a stress rate, so that the stress depends on the path.
    fn is_in_rate_form(&self) -> bool {
        false
    }

    /// Checks that stress is a function of F alone. Only such laws support bodies that start in a
    /// prescribed motion, and manufactured body forces.
    ///
    /// # Errors
    /// The reason why stress depends on other quantities.
    fn depends_on_deformation_alone(&self) -> Result<(), &'static str> {
        if self.is_in_rate_form() {
            return Err("a law in rate form has no stress of the deformation alone");
        }
        Ok(())
    }

    /// Checks that the initial deformation determines the initial stress, so that a body may start
    /// deformed.
    ///
    /// # Errors
    /// The reason why a body may not start deformed.
    fn starts_deformed(&self) -> Result<(), &'static str> {
        self.depends_on_deformation_alone()
    }

    /// Checks that a body may have an initial stress in its reference configuration, in addition to
    /// the stress of the law.
    ///
    /// # Errors
    /// The reason why a body may not have an initial stress.
    fn starts_stressed(&self) -> Result<(), &'static str> {
        self.depends_on_deformation_alone()
    }

    /// Returns the yield function at the Kirchhoff stress `tau` (Pa) of a body without plastic
    /// flow. `None` if the law does not limit an initial stress.
    fn yield_function(&self, tau: &Matrix<3>) -> Option<YieldFunction> {
        let _ = tau;
        None
    }

    /// Checks that the stress may be computed at the averaged volume ratio of F-bar. This requires
    /// that the law reads F, or stores only J.
    ///
    /// # Errors
    /// The reason why the averaged volume ratio is not supported.
    fn takes_averaged_volume(&self) -> Result<(), &'static str> {
        if self.is_in_rate_form() {
            return Err("a law in rate form does not compute its stress from F or J");
        }
        self.depends_on_deformation_alone()
    }

    /// Checks that the law has a consistent tangent ([`Material::response`]), which implicit
    /// solvers need.
    ///
    /// # Errors
    /// The reason why the law has no tangent.
    fn has_tangent(&self) -> Result<(), &'static str> {
        Err("the derivative of its stress by the deformation is not implemented")
    }

    /// Whether [`Material::stress_across`] is implemented in plane strain, by default for
    /// laws with a tangent.
    fn has_stress_across(&self) -> bool {
        self.has_tangent().is_ok()
    }

    /// Whether the law is elastic. Thermal expansion is defined only for elastic laws.
    fn is_elastic(&self) -> bool {
        false
    }

    /// Returns the first parameter that contradicts another one, if any.
    fn contradiction(&self) -> Option<Contradiction> {
        None
    }

    /// Whether bodies are rigid and at rest.
    fn is_at_rest(&self) -> bool {
        false
    }

    /// Checks that the law has a stored energy in `dimension` dimensions.
    ///
    /// # Errors
    /// The reason, phrased to follow the name of the law in a sentence.
    fn has_energy(&self, dimension: usize) -> Result<(), &'static str> {
        let _ = dimension;
        if self.is_in_rate_form() {
            return Err("is integrated in rate form and has no stored energy");
        }
        Ok(())
    }
}

/// A parameter of a material that contradicts another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Contradiction {
    /// Key of the parameter.
    pub key: &'static str,
    /// Message of the error.
    pub reason: &'static str,
    /// Reason why both parameters are incompatible.
    pub explanation: &'static str,
}

/// Value of a yield function, which must not be positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YieldFunction {
    /// Value (Pa).
    pub value: f64,
    /// Sum of the magnitudes of all terms (Pa).
    pub size: f64,
}

impl YieldFunction {
    /// Whether the stress is outside the yield surface by more than rounding errors.
    pub fn is_exceeded(&self) -> bool {
        const ROUNDING: f64 = 1e-12;
        !(self.value <= ROUNDING * self.size)
    }
}

/// A constitutive law with its private state. The solver makes one virtual call per step.
pub trait Material<const D: usize>: Send {
    /// Whether the law reads F. The column of F exists only if the law or the basis reads F.
    fn reads_deformation(&self) -> bool;

    /// Whether the law stores the out-of-plane stretch. The column exists only in this case.
    fn keeps_stretch_across(&self) -> bool {
        false
    }

    /// Whether stress depends directly on the velocity gradient. If so, a body that starts in
    /// motion starts under stress.
    fn reads_rate(&self) -> bool {
        false
    }

    /// Whether an undeformed body at rest has a stress; [`start_deformed`](Self::start_deformed)
    /// computes this stress.
    fn is_stressed_at_rest(&self) -> bool {
        false
    }

    /// Returns the state that the law stores for each particle.
    fn columns(&self) -> Vec<Column<'_>> {
        Vec::new()
    }

    /// Returns a copy of the state that the law stores; `None` if the law has no state.
    fn state(&self) -> Option<Box<dyn Any>> {
        None
    }

    /// Replaces the state by `state`, which [`state`](Self::state) returned.
    fn set_state(&mut self, _: &dyn Any) {}

    /// Returns this law in plane stress, sigma_33 = 0; `None` if plane stress is not implemented.
    fn in_plane_stress(&self) -> Option<Box<dyn Material<D>>> {
        None
    }

    /// Returns the stored energy of all particles (J); `None` if the work of the stress is not a
    /// function of the state. Dissipated energy is not included.
    fn energy(&self, _: &Particles<D>) -> Option<f64> {
        None
    }

    /// Computes initial stresses from F and the velocity gradients, for a body that starts
    /// deformed, or in motion with a law that reads rates. Volumes have already been computed from
    /// F. A law in rate form adds to the current stress.
    ///
    /// # Errors
    /// [`Failure::NotOfDeformation`] if F and the velocity gradients do not determine a stress.
    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        if !self.reads_deformation() {
            return Err(Failure::NotOfDeformation);
        }
        self.update(&mut StressUpdate::new(0.0, particles));
        Ok(())
    }

    /// Stores the initial `stress` (Pa) of each particle in the state of the law. Returns false if
    /// the law stores no such state: the initial stress is then added to the stress of the law.
    ///
    /// # Errors
    /// [`Failure::OutsideYieldSurface`] for a stress that violates the yield condition.
    fn start_stressed(&mut self, stress: &[Matrix<3>]) -> Result<bool, Failure> {
        let _ = stress;
        Ok(false)
    }

    /// Returns the Kirchhoff stress and consistent tangent of particle `p` at the 3-D deformation
    /// gradient `f`, for a step from the stored state of the law. The stored state is not changed.
    /// `None` if the law has no tangent.
    fn response(&self, _p: usize, _f: &Matrix<3>) -> Option<StressResponse> {
        None
    }

    /// Returns the out-of-plane normal component of the Cauchy stress (Pa) of particle `p` of a
    /// two-dimensional body; `None` if the law does not define it.
    fn stress_across(&self, p: usize, particles: &Particles<D>) -> Option<f64> {
        let f = in_space(particles.def_grad.get(p)?, 1.0);
        Some(self.response(p, &f)?.kirchhoff[(2, 2)] / det(&f))
    }

    /// Updates stresses and volumes of all particles from F, if available, and from the velocity
    /// gradients. Allocates only in the first call.
    fn update(&mut self, body: &mut StressUpdate<'_, D>);
}
