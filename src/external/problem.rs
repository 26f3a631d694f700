//! A problem, ready to be stepped by any solver.

use serde::{Serialize, Serializer};
#[cfg(feature = "external-programs")]
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// Initial state of one level of a study, with all that its motion depends on.
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
    /// Faces of the body's box; a body of another shape has none.
    pub faces: Vec<ProblemFace>,
    /// One material for each body.
    pub materials: Vec<ProblemMaterial>,
    /// Loads and effects, in the order in which they are applied.
    pub loads: Vec<ProblemLoad>,
    /// Particles per cell.
    pub particles_per_cell: Option<u64>,
    /// Number of steps.
    pub steps: u64,
    /// Length of a step (s).
    pub dt: f64,
    /// End of the run (s).
    pub until: f64,
    /// Numbers of the steps after which the state is compared.
    pub instants: Vec<u64>,
    /// The particles.
    #[serde(skip)]
    pub particles: ProblemParticles,
    /// Body force, stated and manufactured; none where no force acts.
    #[serde(skip)]
    pub body_force: Option<BodyForceField>,
    /// Body force (m/s2), D numbers, where it is the same at every place and time.
    #[serde(rename = "body_force_value", skip_serializing_if = "Option::is_none")]
    pub constant_body_force: Option<Vec<f64>>,
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
    /// Axes without an end.
    pub periodic: Vec<bool>,
}

/// One face of the body's box.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct ProblemFace {
    /// Its name, as suites write it.
    pub name: &'static str,
    /// Axis of its normal.
    pub axis: usize,
    /// Whether it is the face with the larger coordinate.
    pub high: bool,
    /// Its reference coordinate (m).
    pub at: f64,
    /// Condition on the motion there, as suites write it.
    pub condition: &'static str,
}

/// The material of one body.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct ProblemMaterial {
    /// Name of the law, as suites write it.
    pub law: &'static str,
    /// Parameters by their keys, in SI units.
    #[serde(serialize_with = "as_map")]
    #[cfg_attr(feature = "schemas", schemars(with = "BTreeMap<String, f64>"))]
    pub parameters: Vec<(&'static str, f64)>,
    /// Reference density (kg/m^D).
    pub density: f64,
}

impl ProblemMaterial {
    /// The parameter with this key (SI units); NaN if the law has none.
    pub fn parameter(&self, key: &str) -> f64 {
        let found = self.parameters.iter().find(|(name, _)| *name == key);
        found.map_or(f64::NAN, |(_, value)| *value)
    }
}

fn as_map<S: Serializer>(all: &[(&'static str, f64)], to: S) -> Result<S::Ok, S::Error> {
    to.collect_map(all.iter().copied())
}

/// A load or effect of the scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct ProblemLoad {
    /// Its name, as suites write it.
    pub load: &'static str,
    /// Its values in the suite, as rows of name and value.
    pub rows: Vec<(String, String)>,
}

/// Particles at the start: n of them, one after the other.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct ProblemParticles {
    /// Reference positions X (m), n D numbers.
    pub reference_position: Vec<f64>,
    /// Positions (m), n D numbers.
    pub position: Vec<f64>,
    /// Velocities (m/s), n D numbers.
    pub velocity: Vec<f64>,
    /// Masses (kg), n numbers.
    pub mass: Vec<f64>,
    /// Reference volumes (m^D), n numbers.
    pub reference_volume: Vec<f64>,
    /// Volumes (m^D), n numbers.
    pub volume: Vec<f64>,
    /// Deformation gradients F, n D^2 numbers, row after row.
    pub deformation_gradient: Vec<f64>,
    /// Cauchy stresses (Pa), n D^2 numbers, row after row.
    pub stress: Vec<f64>,
    /// Number of the body that each belongs to.
    pub body: Vec<f64>,
}

impl ProblemParticles {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }

    /// Every column with its name, in the order of the protocol.
    pub fn columns(&self) -> [(&'static str, &[f64]); 9] {
        [
            ("reference_position", &self.reference_position),
            ("position", &self.position),
            ("velocity", &self.velocity),
            ("mass", &self.mass),
            ("reference_volume", &self.reference_volume),
            ("volume", &self.volume),
            ("deformation_gradient", &self.deformation_gradient),
            ("stress", &self.stress),
            ("body", &self.body),
        ]
    }
}

/// A body force of a scene.
pub(crate) trait ForceSource: Send + Sync {
    /// [`BodyForceField::at`].
    fn at(&self, body: usize, label: &[f64], t: f64) -> [f64; 3];

    /// [`BodyForceField::at_places`], where that is cheaper than one place after another.
    fn at_places(&self, _bodies: &[usize], _labels: &[&[f64]]) -> Option<PlacedBodyForce> {
        None
    }
}

/// A body force at its places: fills in the components (m/s2) at each, at a time (s).
pub type PlacedBodyForce = Box<dyn FnMut(f64, &mut [[f64; 3]]) + Send>;

/// A body force per unit of mass, as a function of the reference position and time.
#[derive(Clone)]
pub struct BodyForceField(pub(crate) Arc<dyn ForceSource>);

impl BodyForceField {
    /// The force (m/s2) at a reference position `label` (m, D numbers) of the body with a number,
    /// and a time (s); components beyond the dimension are zero.
    pub fn at(&self, body: usize, label: &[f64], t: f64) -> [f64; 3] {
        self.0.at(body, label, t)
    }

    /// The force at places that are given once, with the body of each: much cheaper where the times
    /// are many.
    pub fn at_places(&self, bodies: &[usize], labels: &[&[f64]]) -> PlacedBodyForce {
        self.0.at_places(bodies, labels).unwrap_or_else(|| {
            let (force, places) = (self.clone(), owned(bodies, labels));
            Box::new(move |t, into| {
                for (into, (body, label)) in into.iter_mut().zip(&places) {
                    *into = force.at(*body, label, t);
                }
            })
        })
    }
}

/// Places with their bodies, to be kept.
pub(crate) fn owned(bodies: &[usize], labels: &[&[f64]]) -> Vec<(usize, Vec<f64>)> {
    bodies.iter().copied().zip(labels.iter().map(|label| label.to_vec())).collect()
}

impl fmt::Debug for BodyForceField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("BodyForceField")
    }
}
