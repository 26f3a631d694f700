//! The internal force on a node while a particle crosses it.

use crate::mpm::basis::BasisName;
use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::{Block, Particles};
use crate::mpm::kernel::contract::Kernel;
use crate::mpm::kernel::kernel;

/// Number of full cells on each side of the node: enough to keep wide basis functions away from the
/// ends of the periodic axis.
const SIDE: usize = 4;

/// Cells of a bar that contain equal particles under the same uniform stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressedCells {
    /// Cell size (m).
    pub cell: f64,
    /// Number of particles per cell.
    pub ppc: usize,
    /// Volume of a particle (m).
    pub volume: f64,
    /// Stress (Pa).
    pub stress: f64,
}

/// Computes the internal force (N) on the node between two halves of the bar, after the last
/// particle of the left half was moved to `position`, in cells from the node.
pub fn force_at_node(basis: BasisName, cells: &StressedCells, position: f64) -> f64 {
    let StressedCells { cell: h, ppc, volume, stress } = *cells;
    let kernel = kernel::<1>(basis);
    let (from, to) = (Vector::<1>::new(-h * SIDE as f64), Vector::<1>::new(h * SIDE as f64));
    let mut grid = kernel.grid(from, h, [2 * SIDE], [true]);
    let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, h, ppc);
    particles.vol.fill(volume);
    particles.sigma.fill(Matrix::<1>::new(stress));
    particles.x[SIDE * ppc - 1][0] = position * h;
    kernel.p2g_internal_force(&particles, &mut grid);
    let node = node_at(kernel.as_ref(), &mut grid, h);
    grid.force[node][0]
}

/// Returns the node with the largest weight for a particle at x = 0. Of two equal nodes, returns
/// the right one.
fn node_at(kernel: &dyn Kernel<1>, grid: &mut Grid<1>, h: f64) -> usize {
    let (from, to) = (Vector::<1>::new(-0.5 * h), Vector::<1>::new(0.5 * h));
    let alone = Particles::fill(&Block { from, to, density: 1.0 }, h, 1);
    kernel.p2g_mass(&alone, grid);
    (0..grid.nodes()).max_by(|a, b| grid.mass[*a].total_cmp(&grid.mass[*b])).unwrap_or(0)
}
