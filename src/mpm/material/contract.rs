//! Interface of materials to the solver and to the compiler of suites.

use super::stress_update::StressUpdate;
use super::tangent::StressResponse;
use crate::mpm::foundation::algebra::Matrix;
use crate::mpm::foundation::particles::Particles;
use crate::subject::{Checkpoint, Column, Failure};

/// [`MaterialProperties::takes_averaged_volume`] of every law in rate form.
///
/// # Errors
/// Always: such a law reads the velocity gradient.
pub(super) fn rate_form_averages_no_volume() -> Result<(), &'static str> {
    Err("a law in rate form does not compute its stress from F or J")
}

/// Properties of a law that decide which problems may be stated with it.
pub trait MaterialProperties {
    /// Stiffness against strain along one axis (Pa), at rest: `rho0 c^2` of the fastest wave, in a
    /// body of the reference density `density` (kg/m3).
    fn wave_modulus(&self, density: f64) -> f64;

    /// Speed (m/s) of the fastest wave at rest, in a body of the reference density `density`
    /// (kg/m3).
    fn wave_speed(&self, density: f64) -> f64 {
        (self.wave_modulus(density) / density).sqrt()
    }

    /// Whether stress is a function of F alone. Then a body may start in the state of a stated
    /// motion, and a body force may be manufactured.
    ///
    /// # Errors
    /// Why it is not.
    fn depends_on_deformation_alone(&self) -> Result<(), &'static str>;

    /// Whether the deformation at the start gives the stress there: a body may start deformed.
    ///
    /// # Errors
    /// Why it does not.
    fn starts_deformed(&self) -> Result<(), &'static str> {
        self.depends_on_deformation_alone()
    }

    /// Whether a body may have an initial stress in its reference configuration, in addition to the
    /// stress of the law.
    ///
    /// # Errors
    /// Why it may not.
    fn starts_stressed(&self) -> Result<(), &'static str> {
        self.depends_on_deformation_alone()
    }

    /// Whether the stress may be computed at the averaged volume ratio of F-bar: the law reads F,
    /// or keeps J alone.
    ///
    /// # Errors
    /// Why it may not.
    fn takes_averaged_volume(&self) -> Result<(), &'static str> {
        self.depends_on_deformation_alone()
    }

    /// Whether the law has a consistent tangent ([`Material::response`]), as implicit solvers need.
    ///
    /// # Errors
    /// Why it has none.
    fn has_tangent(&self) -> Result<(), &'static str> {
        Err("the derivative of its stress by the deformation is not implemented")
    }

    /// Whether the law is elastic: only then is its thermal expansion defined.
    fn is_elastic(&self) -> bool {
        false
    }

    /// The first parameter that contradicts another one, if any.
    fn contradiction(&self) -> Option<Contradiction> {
        None
    }

    /// Whether bodies neither move nor deform.
    fn is_at_rest(&self) -> bool {
        false
    }

    /// Whether the stored energy is a function of the state in `dimension` dimensions.
    ///
    /// # Errors
    /// The reason, as the part of a sentence that follows the name of the law.
    fn has_energy(&self, dimension: usize) -> Result<(), &'static str> {
        let _ = dimension;
        Ok(())
    }
}

/// A parameter of a material that contradicts another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Contradiction {
    /// The key of the parameter.
    pub key: &'static str,
    /// The message of the error.
    pub reason: &'static str,
    /// Why the two do not go together.
    pub explanation: &'static str,
}

/// Closed forms of a law, with which the tests of the family compare its stress. For laws that flow
/// or heat in a step, the values are those of one infinitely long step from a state of rest.
#[cfg(test)]
pub(super) trait ClosedForms {
    /// Cauchy stress (Pa) under simple shear in the plane: components 11, 12 and 22.
    fn simple_shear(&self, gamma: f64) -> [f64; 3];

    /// Cauchy stress (Pa) along and across a uniaxial stretch, with the other axes fixed; `None` if
    /// the law has a history, which a test in its own file covers.
    fn uniaxial_stretch(&self, stretch: f64) -> Option<[f64; 2]>;

    /// The energy density (J/m3) whose derivative is the stress, up to a constant, as long as
    /// nothing flows; `None` for a law in rate form.
    fn energy_density(&self, f: &Matrix<3>) -> Option<f64>;

    /// Stress (Pa) caused by the rounding of J in a step of zero length.
    fn rounding(&self) -> f64 {
        0.0
    }

    /// Mean stress (Pa) of a specimen at rest, positive in compression.
    fn pressure_at_rest(&self) -> f64 {
        0.0
    }

    /// Stored energy (J/m3) of a specimen at rest.
    fn energy_at_rest(&self) -> f64 {
        0.0
    }
}

/// A constitutive law, with its private state. The solver makes one virtual call per step.
pub trait Material<const D: usize>: Send {
    /// Whether the law reads F: the column exists only then, or if the basis reads F.
    fn reads_deformation(&self) -> bool;

    /// Whether the law stores the stretch across the plane: the column exists only then.
    fn keeps_stretch_across(&self) -> bool {
        false
    }

    /// Whether stress depends on the velocity gradient itself: a body that starts in motion then
    /// starts under stress.
    fn reads_rate(&self) -> bool {
        false
    }

    /// Whether a body at rest that is not deformed has a stress: `start_deformed` then sets it.
    fn is_stressed_at_rest(&self) -> bool {
        false
    }

    /// State that the law stores for each particle.
    fn columns(&self) -> Vec<Column<'_>> {
        Vec::new()
    }

    /// Visits the state of the law.
    fn checkpoint(&mut self, _: &mut Checkpoint<'_>) {}

    /// This law in plane stress, sigma_33 = 0; `None` if it is not implemented there.
    fn in_plane_stress(&self) -> Option<Box<dyn Material<D>>> {
        None
    }

    /// Energy that all particles store, over the whole body (J); `None` if the work of the stress
    /// is not a function of the state. Dissipated energy is not stored.
    fn energy(&self, _: &Particles<D>) -> Option<f64> {
        None
    }

    /// Computes the initial stresses of a body that starts deformed or, with a law that reads
    /// rates, in motion, from F and the velocity gradients. Volumes already follow from F. A law in
    /// rate form adds to the present stress.
    ///
    /// # Errors
    /// [`Failure::NotOfDeformation`] if these give no stress.
    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        if !self.reads_deformation() {
            return Err(Failure::NotOfDeformation);
        }
        self.update(&mut StressUpdate::new(0.0, particles));
        Ok(())
    }

    /// Kirchhoff stress and consistent tangent of particle `p` at the deformation gradient `f`.
    /// Both belong to a step from the state of the law at its start, which does not change. `None`
    /// if the law has no tangent.
    fn response(&self, _p: usize, _f: &Matrix<D>) -> Option<StressResponse<D>> {
        None
    }

    /// New stresses and volumes of all particles from F, where it exists, and from their velocity
    /// gradients. Allocates in the first call only.
    fn update(&mut self, body: &mut StressUpdate<'_, D>);
}
