//! The scene of a suite: the body with its conditions and loads.
//!
//! Each load and each boundary condition has one file with its keys, their checks, and the
//! conversions for the solver and the exact solution.

pub(crate) mod boundary;
pub(crate) mod face;
pub(crate) mod grid_size;
pub(crate) mod lattice;
pub(crate) mod load;
pub(crate) mod numbers;

pub use boundary::thermal::SceneHeat;
pub use face::SceneFace;
pub use load::EffectName;

use crate::exact::formula::Formula;
use crate::exact::{Circle, Density, InitialStress, Outline, Region, Term};
use crate::mpm::{MaterialPlan, Quadrilateral};
use crate::subject::PlaneState;
use load::{ListedLoad, LoadTarget};
use std::sync::Arc;

/// The body or bodies, with boundary conditions and loads.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Lowest corner (m) of the body or its bounding box; the number of entries is the dimension.
    pub from: Vec<f64>,
    /// Highest corner (m).
    pub to: Vec<f64>,
    /// Shape of the body, unless it is a box.
    pub outline: Option<Arc<dyn Outline>>,
    /// Map from a box to a quadrilateral; `None` for other shapes. All other shapes with an outline
    /// have free surfaces.
    pub mapped: Option<Quadrilateral>,
    /// Lowest and highest corner of the stated grid (m).
    pub grid: Option<(Vec<f64>, Vec<f64>)>,
    /// Plane state of the bodies in two dimensions.
    pub plane: PlaneState,
    /// The material without density.
    pub material: MaterialPlan,
    /// Reference density.
    pub density: Density,
    /// The 2 D faces of a box in axis order, with the low face of each axis before the high face.
    /// Empty for a body with a free surface.
    pub faces: Vec<SceneFace>,
    /// Particle sets, each with one load.
    pub sets: Vec<Region>,
    /// Loads and effects, in the order in which solvers apply them.
    pub(crate) loads: Vec<ListedLoad>,
    /// The bodies if there are several, otherwise empty. Each body is a scene with the same grid,
    /// faces and loads. If there are several bodies, `self` describes their bounding box and the
    /// material of the first body.
    pub bodies: Vec<Self>,
    /// Friction coefficient of the contact between bodies; `None` if the bodies share one velocity
    /// field.
    pub contact: Option<f64>,
    /// Stress of the reference configuration.
    pub initial_stress: InitialStress,
    /// Initial displacement (m), formulas of the coordinates and t; empty if not stated.
    pub initial_displacement: Vec<Formula>,
    /// Initial velocity (m/s), formulas of the coordinates and t; empty if not stated.
    pub initial_velocity: Vec<Formula>,
}

/// Distances up to this share of the body size are treated as rounding errors.
const ROUNDING: f64 = 1e-9;

impl Scene {
    /// Returns all bodies: the list of bodies, or this scene if there is one body.
    pub fn each(&self) -> &[Self] {
        if self.bodies.is_empty() { std::slice::from_ref(self) } else { &self.bodies }
    }

    /// Returns the length of the longest side of the bounding box (m).
    pub(crate) fn size(&self) -> f64 {
        self.from.iter().zip(&self.to).map(|(from, to)| to - from).fold(0.0, f64::max)
    }

    /// Returns the distance (m) that is treated as rounding error.
    pub(crate) fn rounding(&self) -> f64 {
        ROUNDING * self.size()
    }

    /// Whether the body contains the reference position `label`, up to rounding error.
    pub(crate) fn holds(&self, label: &[f64]) -> bool {
        let near = self.rounding();
        let mut ends = self.from.iter().zip(&self.to).zip(label);
        if !ends.all(|((from, to), x)| from - near <= *x && *x <= to + near) {
            return false;
        }
        let Some(outline) = &self.outline else { return true };
        // A position near the edge is inside if a small shift moves it inside.
        let moved = |k: usize| {
            let step = |axis: usize| near * ((k / [1, 3, 9][axis]) % 3) as f64 - near;
            label.iter().enumerate().map(|(axis, x)| x + step(axis)).collect::<Vec<f64>>()
        };
        outline.holds(label) || (0..[3, 9, 27][label.len() - 1]).any(|k| outline.holds(&moved(k)))
    }

    pub(crate) fn lists(&self, effect: EffectName) -> bool {
        self.loads.iter().any(|load| load.effect == effect)
    }

    pub(crate) fn loads_on(&self, target: LoadTarget) -> impl Iterator<Item = &ListedLoad> {
        self.loads.iter().filter(move |load| load.target() == target)
    }

    /// Returns the rim on which `load` acts; `None` if the load does not act on a rim.
    pub(crate) fn rim(&self, load: &ListedLoad) -> Option<Circle> {
        let LoadTarget::Rim(number) = load.target() else { return None };
        self.outline.as_ref()?.circles().into_iter().find(|circle| circle.number == number)
    }

    pub(crate) fn heat(&self) -> Option<&SceneHeat> {
        self.loads.iter().find_map(|load| load.heat())
    }

    pub(crate) fn terms(&self) -> Vec<Arc<dyn Term>> {
        self.loads.iter().map(|load| load.load.clone() as Arc<dyn Term>).collect()
    }

    /// Returns the name of the first set with a prescribed velocity.
    pub(crate) fn driven_set(&self) -> Option<&str> {
        self.loads.iter().find_map(|load| Some(load.driven()?.0.name.as_str()))
    }
}
