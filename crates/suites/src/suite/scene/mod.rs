//! The scene of a suite: the body with its conditions and loads. Each load and each condition has
//! one file with its keys, their checks, and the conversions for the solver and the exact solution.

pub(crate) mod boundary;
pub(crate) mod face;
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
    /// Map from a box to a quadrilateral. Other shapes except the box have free surfaces.
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
    /// faces and loads. `self` then describes their bounding box and the material of the first
    /// body.
    pub bodies: Vec<Self>,
    /// Friction coefficient between bodies; `None` if they share one velocity field.
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

/// Minimum length of a body (m), because powers of smaller lengths underflow.
pub(crate) const SHORTEST: f64 = 1e-30;

/// Maximum length of a body (m), because powers of larger lengths overflow.
pub(crate) const LONGEST: f64 = 1e30;

/// Spare grid cells at a free face, for expansion, in addition to a tenth of the body length.
const SPARE_CELLS: f64 = 2.0;

impl Scene {
    /// Returns the number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.from.len()
    }

    /// Whether the body neither moves nor deforms.
    pub fn is_at_rest(&self) -> bool {
        self.material.properties().is_at_rest()
    }

    /// Returns the speed of the fastest wave in the body at rest (m/s).
    pub fn wave_speed(&self) -> f64 {
        let properties = self.material.properties();
        let [low, high] = [self.density.smallest(), self.density.largest()];
        properties.wave_speed(low).max(properties.wave_speed(high))
    }

    /// Returns the largest stiffness against uniaxial strain in the body at rest (Pa).
    pub(crate) fn wave_modulus(&self) -> f64 {
        self.material.properties().wave_modulus(self.density.largest())
    }

    /// Returns the speed of the fastest wave in any of the bodies at rest (m/s).
    pub fn fastest_wave(&self) -> f64 {
        self.each().iter().map(Self::wave_speed).fold(0.0, f64::max)
    }

    /// Returns the length (m) of the grid along `axis`, or of the body without a stated grid.
    pub fn period(&self, axis: usize) -> f64 {
        let (from, to) = self.grid.as_ref().map_or((&self.from, &self.to), |(from, to)| (from, to));
        to[axis] - from[axis]
    }

    /// Returns all bodies: the list of bodies, or this scene if there is one body.
    pub fn each(&self) -> &[Self] {
        if self.bodies.is_empty() { std::slice::from_ref(self) } else { &self.bodies }
    }

    /// Returns the length of the longest side of the bounding box (m).
    pub(crate) fn size(&self) -> f64 {
        longest(&self.from, &self.to)
    }

    /// Returns the distance (m) that is treated as rounding error.
    pub(crate) fn rounding(&self) -> f64 {
        rounding(&self.from, &self.to)
    }

    pub(crate) fn holds(&self, label: &[f64]) -> bool {
        holds(&self.from, &self.to, self.outline.as_deref(), label)
    }

    pub(crate) fn lists(&self, effect: EffectName) -> bool {
        self.loads.iter().any(|load| load.effect == effect)
    }

    pub(crate) fn loads_on(&self, target: LoadTarget) -> impl Iterator<Item = &ListedLoad> {
        self.loads.iter().filter(move |load| load.target() == target)
    }

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

    pub(crate) fn driven_set(&self) -> Option<&str> {
        self.loads.iter().find_map(|load| Some(load.driven()?.0.name.as_str()))
    }
}

pub(crate) fn holds(
    from: &[f64],
    to: &[f64],
    outline: Option<&dyn Outline>,
    label: &[f64],
) -> bool {
    let near = rounding(from, to);
    let mut ends = from.iter().zip(to).zip(label);
    if !ends.all(|((from, to), x)| from - near <= *x && *x <= to + near) {
        return false;
    }
    let Some(outline) = outline else { return true };
    // A position near the edge counts as inside if a small shift moves it inside.
    let moved = |k: usize| {
        let step = |axis: usize| near * ((k / [1, 3, 9][axis]) % 3) as f64 - near;
        label.iter().enumerate().map(|(axis, x)| x + step(axis)).collect::<Vec<f64>>()
    };
    outline.holds(label) || (0..[3, 9, 27][label.len() - 1]).any(|k| outline.holds(&moved(k)))
}

fn rounding(from: &[f64], to: &[f64]) -> f64 {
    ROUNDING * longest(from, to)
}

fn longest(from: &[f64], to: &[f64]) -> f64 {
    from.iter().zip(to).map(|(from, to)| to - from).fold(0.0, f64::max)
}

/// Returns the cell size (m) for `cells` cells along the first axis of the stated grid or body.
pub(crate) fn cell_size(scene: &Scene, cells: u64) -> f64 {
    let (from, to) = scene.grid.as_ref().map_or((&scene.from, &scene.to), |(from, to)| (from, to));
    (to[0] - from[0]) / cells as f64
}

/// Returns the number of particles along each axis of a cell, if `ppc` is a D-th power.
pub(crate) fn per_axis(ppc: u64, dimension: usize) -> Option<usize> {
    let root = libm::round(libm::pow(ppc as f64, 1.0 / dimension as f64)) as u64;
    (root > 0 && root.checked_pow(dimension as u32) == Some(ppc)).then_some(root as usize)
}

/// Returns the lower end of the grid along `axis` (m), and its number of cells.
pub(crate) fn grid_axis(scene: &Scene, axis: usize, h: f64) -> (f64, f64) {
    let (low, high) = match &scene.grid {
        Some((from, to)) => (from[axis], to[axis]),
        None => roomy(scene, axis, h),
    };
    // Without the factor, a rounding error could add a cell.
    (low, libm::ceil((high - low) / h * (1.0 - 1e-12)).max(1.0))
}

pub(crate) fn nodes(scene: &Scene, h: f64) -> f64 {
    (0..scene.dimension()).map(|axis| grid_axis(scene, axis, h).1 + 1.0).product()
}

fn roomy(scene: &Scene, axis: usize, h: f64) -> (f64, f64) {
    let (from, to) = (scene.from[axis], scene.to[axis]);
    let spare = (SPARE_CELLS + libm::ceil(0.1 * (to - from) / h)) * h;
    let held = |i: usize| scene.faces.get(i).is_some_and(|face| !face.hold.is_free());
    let free = |i: usize| if held(i) { 0.0 } else { spare };
    (from - free(2 * axis), to + free(2 * axis + 1))
}
