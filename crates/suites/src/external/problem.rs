//! The problem of one level, in a form that does not depend on the solver.

use super::capabilities::SMALL_STRAIN;
use super::fields::{BodyForceField, HandedValues, ProblemFields, as_map};
use crate::subject::PlaneState;
use serde::Serialize;
#[cfg(feature = "schemas")]
use std::collections::BTreeMap;
use std::sync::Arc;

/// All inputs of a solver for one level of a study: initial state, grid, materials, loads and
/// steps.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct LevelProblem {
    /// Name of the suite.
    pub suite: String,
    /// Number of space dimensions, D.
    pub dimension: usize,
    /// The background grid.
    pub grid: ProblemGrid,
    /// Faces of a box-shaped body; empty for other shapes.
    pub faces: Vec<ProblemFace>,
    /// One material for each body.
    pub materials: Vec<ProblemMaterial>,
    /// Shapes of the bodies in the reference configuration, in the order of `materials`.
    pub bodies: Vec<ProblemBody>,
    /// Out-of-plane state of two-dimensional bodies; always plane strain in one and three
    /// dimensions.
    pub plane: PlaneState,
    /// Contact between the bodies; `None` if bodies that touch move together.
    pub contact: Option<ProblemContact>,
    /// Loads and effects, in the order in which they are applied.
    pub loads: Vec<ProblemLoad>,
    /// Particles per cell.
    pub particles_per_cell: Option<u64>,
    /// Number of load steps, equal to `steps`, if the load grows in quasi-static steps without
    /// time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load_steps: Option<u64>,
    /// Number of steps.
    pub steps: u64,
    /// Length of a step (s).
    pub dt: f64,
    /// End of the run (s).
    pub until: f64,
    /// Steps after which the state is compared with the exact solution, counted from 1.
    pub instants: Vec<u64>,
    /// The particles.
    #[serde(skip)]
    pub particles: ProblemParticles,
    /// Sum of stated and manufactured body forces; `None` without body force.
    #[serde(skip)]
    pub body_force: Option<Arc<dyn BodyForceField>>,
    /// Initial state, loads and conditions on faces at any point of the bodies.
    #[serde(skip)]
    pub fields: Option<Arc<dyn ProblemFields>>,
    /// Body force (m/s2), D numbers, if it is constant in space and time.
    #[serde(rename = "body_force_value", skip_serializing_if = "Option::is_none")]
    pub constant_body_force: Option<Vec<f64>>,
}

/// Initial values of n particles, with one column for each quantity.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct ProblemParticles {
    /// Reference positions X (m), n D numbers.
    pub reference_position: Vec<f64>,
    /// Current positions (m), n D numbers.
    pub position: Vec<f64>,
    /// Velocities (m/s), n D numbers.
    pub velocity: Vec<f64>,
    /// Masses (kg), n numbers.
    pub mass: Vec<f64>,
    /// Reference volumes (m^D), n numbers.
    pub reference_volume: Vec<f64>,
    /// Current volumes (m^D), n numbers.
    pub volume: Vec<f64>,
    /// Deformation gradients F, n D^2 numbers, row after row.
    pub deformation_gradient: Vec<f64>,
    /// Cauchy stresses (Pa), n D^2 numbers, row after row.
    pub stress: Vec<f64>,
    /// Index of the body of each particle, n numbers.
    pub body: Vec<f64>,
    /// Hoop stresses (Pa), n numbers, of bodies of revolution; empty otherwise.
    pub hoop_stress: Vec<f64>,
    /// Initial stresses (Pa), n D^2 numbers, row after row; empty if there are none.
    pub initial_stress: Vec<f64>,
    /// Out-of-plane normal components of the initial stresses (Pa), n (3 - D) numbers, for laws
    /// with a yield surface; empty otherwise.
    pub initial_stress_across: Vec<f64>,
}

impl ProblemParticles {
    pub(super) const OPTIONAL: [&str; 3] =
        ["hoop_stress", "initial_stress", "initial_stress_across"];

    /// Returns the number of particles.
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether there are no particles.
    pub fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }

    /// Returns all columns with their names, in the order of the protocol. Empty optional columns
    /// are excluded.
    pub fn columns(&self) -> Vec<(&'static str, &[f64])> {
        let mut columns: Vec<(&'static str, &[f64])> = vec![
            ("reference_position", &self.reference_position),
            ("position", &self.position),
            ("velocity", &self.velocity),
            ("mass", &self.mass),
            ("reference_volume", &self.reference_volume),
            ("volume", &self.volume),
            ("deformation_gradient", &self.deformation_gradient),
            ("stress", &self.stress),
            ("body", &self.body),
        ];
        let optional = [&self.hoop_stress, &self.initial_stress, &self.initial_stress_across];
        for (name, column) in Self::OPTIONAL.into_iter().zip(optional) {
            if !column.is_empty() {
                columns.push((name, column));
            }
        }
        columns
    }
}

/// Cells of one size along every axis.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct ProblemGrid {
    /// Lowest corner (m), D numbers.
    pub origin: Vec<f64>,
    /// Cell size (m).
    pub h: f64,
    /// Cells along each axis.
    pub cells: Vec<u64>,
    /// Whether each axis is periodic.
    pub periodic: Vec<bool>,
}

/// One face of a box-shaped body.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct ProblemFace {
    /// Name in suites.
    pub name: &'static str,
    /// Axis of the face normal.
    pub axis: usize,
    /// Whether this is the face with the larger coordinate.
    pub high: bool,
    /// Reference coordinate along the axis (m).
    pub at: f64,
    /// Condition on the motion, by its name in suites.
    pub condition: &'static str,
    /// Numbers of the condition: `coefficient` (friction) or `velocity` (m/s).
    #[serde(flatten)]
    pub numbers: HandedValues,
}

/// Shape of one body in the reference configuration.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct ProblemBody {
    /// `box`, `disk`, `annulus`, `ball`, `polygon` or `quadrilateral`.
    pub shape: &'static str,
    /// Lowest corner of the box around the body (m), D numbers.
    pub from: Vec<f64>,
    /// Highest corner of the box around the body (m), D numbers.
    pub to: Vec<f64>,
    /// Centre (m) of a disk, an annulus or a ball.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre: Option<Vec<f64>>,
    /// Inner and outer radius (m) of a disk, an annulus or a ball.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radii: Option<[f64; 2]>,
    /// Corners (m) of a polygon or a quadrilateral, counter-clockwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corners: Option<Vec<[f64; 2]>>,
}

/// Contact between bodies.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct ProblemContact {
    /// Contact law: `coulomb`, meaning no penetration, no tension, and Coulomb friction.
    pub law: &'static str,
    /// Coefficient of friction.
    pub coefficient: f64,
}

/// The material of one body.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct ProblemMaterial {
    /// Name of the law in suites.
    pub law: &'static str,
    /// Parameters by their keys, in SI units.
    #[serde(serialize_with = "as_map")]
    #[cfg_attr(feature = "schemas", schemars(with = "BTreeMap<String, f64>"))]
    pub parameters: Vec<(&'static str, f64)>,
    /// Reference density (kg/m3), or its largest value if it varies over the body.
    pub density: f64,
    /// Reference density (kg/m3) that varies over the body, as a formula of X, Y, Z. The mass of a
    /// particle is the integral of this formula over the particle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub varying_density: Option<String>,
}

impl LevelProblem {
    /// Returns the times (s) at which the state is compared with the exact solution.
    pub fn times(&self) -> Vec<f64> {
        let time = |step: &u64| self.until * *step as f64 / self.steps as f64;
        self.instants.iter().map(time).collect()
    }

    /// Replaces the law `linear_elastic` by `small_strain`. A body that starts deformed has the
    /// stress `C : sym(F - I)`.
    #[doc(hidden)]
    pub fn replace_by_small_strain(&mut self) {
        for material in self.materials.iter_mut().filter(|one| one.law == "linear_elastic") {
            material.law = SMALL_STRAIN;
        }
        let (d, particles) = (self.dimension, &mut self.particles);
        let tensors = particles.stress.chunks_exact_mut(d * d);
        let tensors = tensors.zip(particles.deformation_gradient.chunks_exact(d * d));
        for ((stress, f), body) in tensors.zip(&particles.body) {
            let Some(material) = self.materials.get(*body as usize) else { continue };
            let excess = |i: usize, j: usize| f[i * d + j] - f64::from(u8::from(i == j));
            if material.law != SMALL_STRAIN || (0..d * d).all(|k| excess(k / d, k % d) == 0.0) {
                continue;
            }
            let (young, poisson) = (material.parameter("young"), material.parameter("poisson"));
            let twice_mu = young / (1.0 + poisson);
            let trace: f64 = (0..d).map(|i| excess(i, i)).sum();
            let pressure = twice_mu * poisson / (1.0 - 2.0 * poisson) * trace;
            for k in 0..d * d {
                let (i, j) = (k / d, k % d);
                let spherical = if i == j { pressure } else { 0.0 };
                stress[k] = spherical + 0.5 * twice_mu * (excess(i, j) + excess(j, i));
            }
        }
    }
}

impl ProblemMaterial {
    /// Returns the value of the parameter with this key (SI units); NaN if the law does not have
    /// it.
    pub fn parameter(&self, key: &str) -> f64 {
        let found = self.parameters.iter().find(|(name, _)| *name == key);
        found.map_or(f64::NAN, |(_, value)| *value)
    }
}

/// A load or effect of the scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct ProblemLoad {
    /// Name in suites.
    pub load: &'static str,
    /// Values in the suite, as rows of name and text for reports.
    pub rows: Vec<(String, String)>,
    /// Face on which the load acts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub face: Option<&'static str>,
    /// Rim (`inner` or `outer`) of a round body on which the load acts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rim: Option<&'static str>,
    /// Part of the bodies on which the load acts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub region: Option<ProblemRegion>,
    /// Numbers of the load.
    #[serde(flatten)]
    pub numbers: HandedValues,
}

/// Box that selects the material points whose reference position is in the box or on its surface.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct ProblemRegion {
    /// Name of the set in the suite.
    pub name: String,
    /// Lowest corner (m), D numbers.
    pub from: Vec<f64>,
    /// Highest corner (m), D numbers.
    pub to: Vec<f64>,
}
