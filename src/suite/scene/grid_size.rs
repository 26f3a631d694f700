//! Computes cell sizes, grid sizes, and the number of particles along the axes of a cell.

use super::{Scene, SceneFace};

/// Minimum length of a body (m), because powers of smaller lengths underflow.
pub(crate) const SHORTEST: f64 = 1e-30;

/// Maximum length of a body (m), because powers of larger lengths overflow.
pub(crate) const LONGEST: f64 = 1e30;

/// Number of spare grid cells outside a free face, for bodies that expand. A tenth of the body
/// length is added to these cells.
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

    /// Returns the length (m) of the stated grid along `axis`; the length of the body if no grid is
    /// stated.
    pub fn period(&self, axis: usize) -> f64 {
        let (from, to) = self.grid.as_ref().map_or((&self.from, &self.to), |(from, to)| (from, to));
        to[axis] - from[axis]
    }
}

/// Returns the cell size (m) for `cells` cells along the first axis of the stated grid or body.
pub(crate) fn cell_size(scene: &Scene, cells: u64) -> f64 {
    let (from, to) = scene.grid.as_ref().map_or((&scene.from, &scene.to), |(from, to)| (from, to));
    (to[0] - from[0]) / cells as f64
}

/// Returns the number of particles along each axis of a cell; `None` if `ppc` is not the D-th power
/// of an integer.
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
    // The factor keeps a rounding error from adding a cell.
    (low, libm::ceil((high - low) / h * (1.0 - 1e-12)).max(1.0))
}

fn roomy(scene: &Scene, axis: usize, h: f64) -> (f64, f64) {
    let (from, to) = (scene.from[axis], scene.to[axis]);
    let spare = (SPARE_CELLS + libm::ceil(0.1 * (to - from) / h)) * h;
    let held = |i: usize| scene.faces.get(i).is_some_and(|face: &SceneFace| !face.hold.is_free());
    let free = |i: usize| if held(i) { 0.0 } else { spare };
    (from - free(2 * axis), to + free(2 * axis + 1))
}
