//! Loads and effects of a body. A new effect requires a file in `mpm/effect`, a variant of
//! [`EffectInput`], and the arm of [`EffectInput::build`] that creates the effect. The whole list
//! of files is in `docs/exercises/effect.md`.

use super::wall::{FaceInput, vector_field};
use super::{ScalarAt, VectorAt, VectorOfTime};
use crate::mpm::basis::BasisName;
use crate::mpm::effect::{
    ArtificialViscosity, BodyForce, Damping, Effect, Gravity, Heat, LocalDamping, Placement,
    PrescribedVelocity, Pressure, RimCircle, SetForce, Thermal, ThermalBoundary, ThermalExpansion,
    Traction,
};
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use mpm_subject::SubjectError;

/// A load or an effect on one body.
pub enum EffectInput {
    /// A uniform acceleration (m/s2).
    Gravity(VectorOfTime),
    /// A force per unit mass.
    BodyForce(Box<dyn ForceAt>),
    /// Damping in proportion to mass.
    Damping(Damping),
    /// A damping force in proportion to the unbalanced force.
    LocalDamping(LocalDamping),
    /// Artificial viscosity. The cell size is used as its length.
    ArtificialViscosity(ArtificialViscosity),
    /// A traction (Pa, per reference area) on a face of the body.
    Traction {
        /// The face.
        face: FaceInput,
        /// Place at which the force acts.
        placement: Placement,
        /// The traction (Pa).
        value: VectorAt,
    },
    /// A pressure on the current surface of the body.
    Pressure {
        /// The part of the surface.
        part: PressedPart,
        /// The pressure (Pa).
        value: ScalarAt,
    },
    /// A total force (N) on a set of particles.
    SetForce(SetInput, VectorOfTime),
    /// A prescribed velocity (m/s) of a set of particles.
    PrescribedVelocity(SetInput, VectorAt),
    /// Heat conduction.
    Heat(HeatInput),
    /// Thermal strain.
    ThermalExpansion {
        /// Coefficient of linear expansion (1/K).
        coefficient: f64,
        /// Temperature without thermal strain (K).
        reference: f64,
        /// Young's modulus (Pa) and Poisson's ratio of a law in rate form; `None` for a law that
        /// computes the stress from F.
        rate_form: Option<(f64, f64)>,
    },
}

/// Part of the surface on which a pressure acts.
pub enum PressedPart {
    /// A face, and the place at which the force acts.
    Face(FaceInput, Placement),
    /// A round rim.
    Rim(RimCircle),
}

/// Whether a set contains the particle with a given reference position (m).
pub type InSet = Box<dyn Fn(&[f64]) -> bool>;

/// A set of particles, defined by their reference positions.
pub struct SetInput {
    /// Name of the set, for messages.
    pub name: String,
    /// Whether the set contains the particle with this reference position (m).
    pub holds: InSet,
}

/// A force per unit mass at the particles of one body. `u` returns the displacement (m) of the
/// particle with a given index, with zeros for missing dimensions.
pub trait ForceAt: Send {
    /// Prepares the force for particles with these reference positions (m). Called once, before
    /// the other functions.
    fn prepare(&mut self, labels: &[&[f64]]);

    /// Returns an upper bound on the largest eigenvalue (1/s2) of the symmetric part of -db/du.
    /// Zero if the force b does not depend on the displacement.
    fn stiffness(&self, _u: &dyn Fn(usize) -> [f64; 3]) -> f64 {
        0.0
    }

    /// Writes the force (m/s2) on each particle at time `t` (s). Components of missing dimensions
    /// are ignored.
    fn write(&mut self, t: f64, u: &dyn Fn(usize) -> [f64; 3], into: &mut [[f64; 3]]);
}

/// Returns a temperature (K) and its gradient (K/m) at a reference position (m).
pub type TemperatureAt = Box<dyn Fn(&[f64]) -> (f64, [f64; 3])>;

/// Heat conduction, its initial temperature, its source and the conditions on faces.
pub struct HeatInput {
    /// Conductivity k (W m^(2-D)/K).
    pub conductivity: f64,
    /// Heat capacity c (J/(kg K)).
    pub capacity: f64,
    /// Returns the initial temperature (K) and its gradient (K/m) at a reference position (m).
    pub initial: TemperatureAt,
    /// The heat source, if any.
    pub source: Option<Box<dyn HeatSourceAt>>,
    /// Conditions on faces that are not insulated.
    pub faces: Vec<(FaceInput, Thermal)>,
}

/// A heat source at the particles of one body.
pub trait HeatSourceAt: Send {
    /// Prepares the source for particles with these reference positions (m). Called once, before
    /// the first [`write`](Self::write).
    fn prepare(&mut self, labels: &[&[f64]]);

    /// Writes the source (W/kg) of each particle at time `t` (s) for the temperatures (K) of the
    /// particles.
    fn write(&mut self, t: f64, temperature: &[f64], into: &mut [f64]);
}

impl EffectInput {
    /// Creates the effect on the body of these particles. Heat conduction also initialises the
    /// temperatures of the particles. `basis` is the basis of `grid`.
    ///
    /// # Errors
    /// [`SubjectError::Unsupported`] for a set without particles.
    pub fn build<const D: usize>(
        self,
        grid: &Grid<D>,
        basis: BasisName,
        particles: &mut Particles<D>,
    ) -> Result<Box<dyn Effect<D>>, SubjectError> {
        Ok(match self {
            Self::Gravity(value) => Box::new(Gravity(of_time(value))),
            Self::BodyForce(force) => Box::new(body_force(force, particles)),
            Self::Damping(damping) => Box::new(damping),
            Self::LocalDamping(damping) => Box::new(damping),
            Self::ArtificialViscosity(viscosity) => {
                Box::new(ArtificialViscosity { length: grid.h, ..viscosity })
            }
            Self::Traction { face: FaceInput { axis, side }, placement, value } => {
                Box::new(Traction::at(particles, axis, side, placement, vector_field(value)))
            }
            Self::Pressure { part, value } => {
                let value = Box::new(move |x: &Vector<D>, t| value(x.as_slice(), t));
                Box::new(match part {
                    PressedPart::Face(FaceInput { axis, side }, placement) => {
                        Pressure::at(particles, axis, side, placement, value)
                    }
                    PressedPart::Rim(circle) => Pressure::on_rim(particles, &circle, value),
                })
            }
            Self::SetForce(set, value) => {
                let members = set.members(particles)?;
                Box::new(SetForce::on(particles, &members, of_time(value)))
            }
            Self::PrescribedVelocity(set, value) => {
                let members = set.members(particles)?;
                Box::new(PrescribedVelocity::on(particles, &members, vector_field(value)))
            }
            Self::Heat(heat) => Box::new(heat.build(grid, basis, particles)),
            Self::ThermalExpansion { coefficient, reference, rate_form } => {
                Box::new(match rate_form {
                    None => ThermalExpansion::of_deformation(coefficient, reference),
                    Some((young, poisson)) => {
                        ThermalExpansion::in_rate_form(coefficient, reference, young, poisson)
                    }
                })
            }
        })
    }
}

impl SetInput {
    /// Returns the indices of the particles in the set.
    fn members<const D: usize>(
        &self,
        particles: &Particles<D>,
    ) -> Result<Vec<usize>, SubjectError> {
        let inside = |p: &usize| (self.holds)(particles.x0[*p].as_slice());
        let members: Vec<usize> = (0..particles.len()).filter(inside).collect();
        if members.is_empty() {
            let reason = format!("the set `{}` holds no particle", self.name);
            return Err(SubjectError::Unsupported(reason));
        }
        Ok(members)
    }
}

fn of_time<const D: usize>(value: VectorOfTime) -> Box<dyn Fn(f64) -> Vector<D> + Send> {
    Box::new(move |t| {
        let mut vector: Vector<D> = Vector::zeros();
        value(t, vector.as_mut_slice());
        vector
    })
}

fn labels<const D: usize>(particles: &Particles<D>) -> Vec<&[f64]> {
    particles.x0.iter().map(Vector::as_slice).collect()
}

/// Returns the displacement of particle `p` (m), with zeros for missing dimensions.
fn displacement<const D: usize>(particles: &Particles<D>, p: usize) -> [f64; 3] {
    let u = particles.position(p) - particles.x0[p];
    std::array::from_fn(|axis| u.get(axis).copied().unwrap_or(0.0))
}

fn body_force<const D: usize>(
    mut force: Box<dyn ForceAt>,
    particles: &Particles<D>,
) -> BodyForce<D> {
    force.prepare(&labels(particles));
    let stiffness = force.stiffness(&|p| displacement(particles, p));
    let mut numbers = Vec::new();
    let field = move |t, particles: &Particles<D>, b: &mut [Vector<D>]| {
        numbers.resize(b.len(), [0.0; 3]);
        force.write(t, &|p| displacement(particles, p), &mut numbers);
        for (b, numbers) in b.iter_mut().zip(&numbers) {
            *b = Vector::from_fn(|i, _| numbers[i]);
        }
    };
    BodyForce::new(Box::new(field)).with_stiffness(stiffness)
}

impl HeatInput {
    fn build<const D: usize>(
        self,
        grid: &Grid<D>,
        basis: BasisName,
        particles: &mut Particles<D>,
    ) -> Heat<D> {
        let initial = |x0: &Vector<D>| {
            let (value, grad) = (self.initial)(x0.as_slice());
            (value, Vector::from_fn(|axis, _| grad[axis]))
        };
        let heat = Heat::new(self.conductivity, self.capacity, particles, initial);
        let build = |(FaceInput { axis, side }, condition): (FaceInput, Thermal)| {
            ThermalBoundary::new(grid, basis, particles, axis, side, condition)
        };
        let heat = heat.with_faces(self.faces.into_iter().map(build).collect());
        let Some(mut source) = self.source else { return heat };
        source.prepare(&labels(particles));
        heat.with_source(Box::new(move |t, particles: &Particles<D>, into| {
            source.write(t, &particles.temperature, into);
        }))
    }
}
