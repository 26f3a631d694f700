//! Sizes of a level: cells, grid, and particles along a cell.

use super::{Scene, SceneFace};

/// Minimum length (m) of a body. Powers of smaller lengths underflow.
pub(crate) const SHORTEST: f64 = 1e-30;

/// Maximum length (m) of a body. Powers of larger lengths overflow.
pub(crate) const LONGEST: f64 = 1e30;

/// Cells by which a grid extends beyond a free face, in addition to a tenth of the body, for a body
/// that expands.
const SPARE_CELLS: f64 = 2.0;

impl Scene {
    /// Number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.from.len()
    }

    /// Whether the body neither moves nor deforms.
    pub fn is_at_rest(&self) -> bool {
        self.material.properties().is_at_rest()
    }

    /// Speed (m/s) of the fastest wave in the body at rest.
    pub fn wave_speed(&self) -> f64 {
        let properties = self.material.properties();
        let [low, high] = [self.density.smallest(), self.density.largest()];
        properties.wave_speed(low).max(properties.wave_speed(high))
    }

    /// Largest stiffness (Pa) against strain along one axis in the body at rest.
    pub(crate) fn wave_modulus(&self) -> f64 {
        self.material.properties().wave_modulus(self.density.largest())
    }

    /// Speed (m/s) of the fastest wave in any of the bodies at rest.
    pub fn fastest_wave(&self) -> f64 {
        self.each().iter().map(Self::wave_speed).fold(0.0, f64::max)
    }

    /// Length (m) of an axis of the stated grid, otherwise of the body.
    pub fn period(&self, axis: usize) -> f64 {
        let (from, to) = self.grid.as_ref().map_or((&self.from, &self.to), |(from, to)| (from, to));
        to[axis] - from[axis]
    }
}

/// Cell size (m) for `cells` cells along the first axis of the stated grid, otherwise of the body.
pub(crate) fn cell_size(scene: &Scene, cells: u64) -> f64 {
    let (from, to) = scene.grid.as_ref().map_or((&scene.from, &scene.to), |(from, to)| (from, to));
    (to[0] - from[0]) / cells as f64
}

/// Particles along each axis of a cell, if `ppc` is a whole power.
pub(crate) fn per_axis(ppc: u64, dimension: usize) -> Option<usize> {
    let root = libm::round(libm::pow(ppc as f64, 1.0 / dimension as f64)) as u64;
    (root > 0 && root.checked_pow(dimension as u32) == Some(ppc)).then_some(root as usize)
}

/// Lower end of the grid on an axis (m), and its number of cells.
pub(crate) fn grid_axis(scene: &Scene, axis: usize, h: f64) -> (f64, f64) {
    let (low, high) = match &scene.grid {
        Some((from, to)) => (from[axis], to[axis]),
        None => roomy(scene, axis, h),
    };
    // A number of cells that is whole up to rounding is rounded to it.
    (low, libm::ceil((high - low) / h * (1.0 - 1e-12)).max(1.0))
}

fn roomy(scene: &Scene, axis: usize, h: f64) -> (f64, f64) {
    let (from, to) = (scene.from[axis], scene.to[axis]);
    let spare = (SPARE_CELLS + libm::ceil(0.1 * (to - from) / h)) * h;
    let held = |i: usize| scene.faces.get(i).is_some_and(|face: &SceneFace| !face.hold.is_free());
    let free = |i: usize| if held(i) { 0.0 } else { spare };
    (from - free(2 * axis), to + free(2 * axis + 1))
}
