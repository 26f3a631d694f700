//! The scene of a suite: the body with its conditions and loads.
//!
//! Loads and boundary conditions are families: the file of a member contains its keys, their
//! checks, and its conversion for the solver and the exact solution.

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

/// The body with its conditions and loads.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Lowest corner of the body, or of the box around it (m); its length is the dimension.
    pub from: Vec<f64>,
    /// Highest corner (m).
    pub to: Vec<f64>,
    /// The shape of a body that is not a box.
    pub outline: Option<Arc<dyn Outline>>,
    /// The map of a body with an outline that is a mapped box; any other has a free rim.
    pub mapped: Option<Quadrilateral>,
    /// Stated grid, lowest and highest corner (m).
    pub grid: Option<(Vec<f64>, Vec<f64>)>,
    /// State of the bodies across the plane of two dimensions.
    pub plane: PlaneState,
    /// The material, without its density.
    pub material: MaterialPlan,
    /// Reference density.
    pub density: Density,
    /// The 2 D faces of a box: low and high, axis by axis. A body with a free rim has none.
    pub faces: Vec<SceneFace>,
    /// Sets of particles; one load acts on each.
    pub sets: Vec<Region>,
    /// Loads and effects, in the order in which solvers apply them.
    pub(crate) loads: Vec<ListedLoad>,
    /// Several bodies, each as a scene with the grid, the faces and the loads of this one; empty if
    /// there is one body. Otherwise this scene is the box around all of them, with the material of
    /// the first.
    pub bodies: Vec<Self>,
    /// Coefficient of friction between bodies that are in contact; absent: they share one velocity
    /// field.
    pub contact: Option<f64>,
    /// Stress of the reference configuration.
    pub initial_stress: InitialStress,
    /// Initial displacement (m), formulas of the coordinates and t; empty: not stated.
    pub initial_displacement: Vec<Formula>,
    /// Initial velocity (m/s), formulas of the coordinates and t; empty: not stated.
    pub initial_velocity: Vec<Formula>,
}

/// Distance that counts as rounding, relative to the size of the body.
const ROUNDING: f64 = 1e-9;

impl Scene {
    /// The bodies: this one, or several.
    pub fn each(&self) -> &[Self] {
        if self.bodies.is_empty() { std::slice::from_ref(self) } else { &self.bodies }
    }

    /// Length of the longest side of the box around the body (m).
    pub(crate) fn size(&self) -> f64 {
        self.from.iter().zip(&self.to).map(|(from, to)| to - from).fold(0.0, f64::max)
    }

    /// Largest distance of a place from the body or from a face that counts as rounding (m).
    pub(crate) fn rounding(&self) -> f64 {
        ROUNDING * self.size()
    }

    /// Whether the body contains a reference position, up to rounding.
    pub(crate) fn holds(&self, label: &[f64]) -> bool {
        let near = self.rounding();
        let mut ends = self.from.iter().zip(&self.to).zip(label);
        if !ends.all(|((from, to), x)| from - near <= *x && *x <= to + near) {
            return false;
        }
        let Some(outline) = &self.outline else { return true };
        // A place next to the rim counts as inside if it is inside after a small shift across the
        // rim.
        let moved = |k: usize| {
            let step = |axis: usize| near * ((k / [1, 3, 9][axis]) % 3) as f64 - near;
            label.iter().enumerate().map(|(axis, x)| x + step(axis)).collect::<Vec<f64>>()
        };
        outline.holds(label) || (0..[3, 9, 27][label.len() - 1]).any(|k| outline.holds(&moved(k)))
    }

    /// Whether the scene lists `effect`.
    pub(crate) fn lists(&self, effect: EffectName) -> bool {
        self.loads.iter().any(|load| load.effect == effect)
    }

    /// The loads on one part of the scene.
    pub(crate) fn loads_on(&self, target: LoadTarget) -> impl Iterator<Item = &ListedLoad> {
        self.loads.iter().filter(move |load| load.target() == target)
    }

    /// The rim that a load acts on.
    pub(crate) fn rim(&self, load: &ListedLoad) -> Option<Circle> {
        let LoadTarget::Rim(number) = load.target() else { return None };
        self.outline.as_ref()?.circles().into_iter().find(|circle| circle.number == number)
    }

    /// The conduction that the scene lists.
    pub(crate) fn heat(&self) -> Option<&SceneHeat> {
        self.loads.iter().find_map(|load| load.heat())
    }

    /// Terms of the loads in the equation of motion.
    pub(crate) fn terms(&self) -> Vec<Arc<dyn Term>> {
        self.loads.iter().map(|load| load.load.clone() as Arc<dyn Term>).collect()
    }

    /// The name of the first set that is driven.
    pub(crate) fn driven_set(&self) -> Option<&str> {
        self.loads.iter().find_map(|load| Some(load.driven()?.0.name.as_str()))
    }
}
