//! A body, and its particles.

use super::GridInput;
use super::effect::EffectInput;
use super::state::InitialState;
use crate::mpm::basis::BasisName;
use crate::mpm::effect::Effect;
use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::{Block, Particles};
use crate::mpm::kernel::contract::Kernel;
use crate::mpm::material::{Material, MaterialPlan};
use crate::mpm::seeding::Fragment;
use crate::mpm::seeding::quadrilateral::Quadrilateral;
use mpm_subject::with_dimension;
use mpm_subject::{PlaneState, SubjectError};

/// Returns the mass (kg) of a particle from its reference position and the half-lengths of its
/// lattice cell (m).
pub type MassAt<'a> = Box<dyn Fn(&[f64], &[f64]) -> f64 + 'a>;

/// Moves a reference position (m) off the lattice, whose spacing (m) is the second argument. Called
/// once per particle, in the order of the particles.
pub type Displace<'a> = Box<dyn FnMut(&mut [f64], &[f64]) + 'a>;

/// Returns the part of each lattice cell that is in the body.
pub type CutLattice<'a> = Box<dyn Fn(&CellLattice) -> Vec<LatticeCell> + 'a>;

/// One body: its particles, material, effects and initial state.
pub struct BodyInput<'a> {
    /// The part of space that the particles fill.
    pub shape: ShapeInput<'a>,
    /// Number of particles along each axis of a cell.
    pub per_axis: usize,
    /// Reference density (kg/m3); the largest density of the body if it varies.
    pub density: f64,
    /// Masses of the particles; by default, the density times the volume.
    pub mass: Option<MassAt<'a>>,
    /// Displacement of the particles from the lattice, if any.
    pub displace: Option<Displace<'a>>,
    /// Positions of additional particles (m), which otherwise equal the first particle.
    pub extra: Vec<Vec<f64>>,
    /// The constitutive law.
    pub material: MaterialPlan,
    /// Loads and effects, in the order in which they are applied.
    pub effects: Vec<EffectInput>,
    /// State at t = 0.
    pub initial: InitialState<'a>,
    /// Whether particles store F even if no part of the solver reads it.
    pub stores_deformation: bool,
    /// Whether samples contain the out-of-plane stress in plane strain and in plane stress.
    pub samples_stress_across: bool,
}

/// Shapes that can be filled with particles.
pub enum ShapeInput<'a> {
    /// A box, divided into equal parts.
    Box {
        /// Lowest corner (m).
        from: Vec<f64>,
        /// Highest corner (m).
        to: Vec<f64>,
    },
    /// A part of a lattice.
    Cells {
        /// Lowest corner of the lattice (m).
        from: Vec<f64>,
        /// Highest corner of the lattice (m).
        to: Vec<f64>,
        /// Shape of the body.
        cut: CutLattice<'a>,
    },
    /// A quadrilateral, filled by its bilinear map.
    Panel(Quadrilateral),
}

/// A lattice of equal cells, the first axis being the fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct CellLattice {
    /// Centres of the cells (m), one number per dimension.
    pub centres: Vec<Vec<f64>>,
    /// Half-lengths of a cell (m).
    pub half: Vec<f64>,
    /// Number of cells along the first axis, from which the neighbours of a cell follow.
    pub along: usize,
}

/// The part of a lattice cell that is in a body.
#[derive(Debug, Clone, PartialEq)]
pub enum LatticeCell {
    /// The cell is outside.
    Empty,
    /// The cell is inside.
    Whole,
    /// Some parts of the cell are inside; each becomes one particle.
    Parts(Vec<FragmentInput>),
}

/// A part of a plane body that one particle represents, with unit thickness along a third axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FragmentInput {
    /// Centroid (m).
    pub place: [f64; 2],
    /// Volume (m2).
    pub volume: f64,
    /// Half-edge vectors a and b of a parallelogram with this volume (m): `[a_x, b_x, a_y, b_y]`.
    pub domain: [f64; 4],
}

impl FragmentInput {
    fn build<const D: usize>(&self) -> Fragment<D> {
        Fragment {
            volume: self.volume,
            place: Vector::from_fn(|i, _| self.place.get(i).copied().unwrap_or(0.0)),
            domain: Matrix::from_fn(|i, j| match (i, j) {
                (0 | 1, 0 | 1) => self.domain[2 * i + j],
                _ => 0.5 * f64::from(u8::from(i == j)),
            }),
        }
    }
}

/// Calls `visit` with the centre and the half-lengths (m) of each cell of the lattice in a box,
/// until `visit` returns true. Returns whether it did. `h` is the size of a grid cell (m).
pub fn visit_lattice(
    (from, to): (&[f64], &[f64]),
    h: f64,
    per_axis: usize,
    visit: &mut dyn FnMut(&[f64], &[f64]) -> bool,
) -> bool {
    with_dimension!(from.len(), D => {
        let block = block::<D>(from, to, 1.0);
        let half = block.spacing(h, per_axis) * 0.5;
        block.centres(h, per_axis).any(|centre| visit(centre.as_slice(), half.as_slice()))
    })
}

fn block<const D: usize>(from: &[f64], to: &[f64], density: f64) -> Block<D> {
    Block { from: vector(from), to: vector(to), density }
}

/// Converts numbers to a vector, with zeros for missing numbers.
fn vector<const D: usize>(numbers: &[f64]) -> Vector<D> {
    Vector::from_fn(|i, _| numbers.get(i).copied().unwrap_or(0.0))
}

impl GridInput {
    pub(super) fn build<const D: usize>(&self, kernel: &dyn Kernel<D>) -> Grid<D> {
        let cells = std::array::from_fn(|axis| self.cells[axis]);
        let periodic = std::array::from_fn(|axis| self.periodic[axis]);
        kernel.grid(vector(&self.origin), self.h, cells, periodic)
    }
}

impl BodyInput<'_> {
    /// Creates the particles on cells of size `h` (m), undeformed and at rest.
    pub(super) fn seed<const D: usize>(&mut self, h: f64, plane: PlaneState) -> Particles<D> {
        let mut particles = self.fill(h);
        self.edit(&mut particles);
        particles.samples_stress_across = D == 2 && self.samples_stress_across;
        if plane == PlaneState::Axisymmetric {
            particles.revolve();
        }
        particles
    }

    pub(super) fn fill<const D: usize>(&self, h: f64) -> Particles<D> {
        let Self { per_axis, density, .. } = *self;
        let mut particles: Particles<D> = match &self.shape {
            // The masses of a panel are those of its uniform density.
            ShapeInput::Panel(panel) => return panel.fill(density, h, per_axis),
            ShapeInput::Box { from, to } => Particles::fill(&block(from, to, density), h, per_axis),
            ShapeInput::Cells { from, to, cut } => {
                self.fill_cells(&block(from, to, density), h, cut)
            }
        };
        if let Some(mass_at) = &self.mass {
            let half = particles.spacing * 0.5;
            for (mass, x0) in particles.mass.iter_mut().zip(&particles.x0) {
                *mass = mass_at(x0.as_slice(), half.as_slice());
            }
        }
        particles
    }

    fn fill_cells<const D: usize>(
        &self,
        block: &Block<D>,
        h: f64,
        cut: &dyn Fn(&CellLattice) -> Vec<LatticeCell>,
    ) -> Particles<D> {
        let per_axis = self.per_axis;
        let cells = cut(&CellLattice {
            centres: block.centres(h, per_axis).map(|x| x.as_slice().to_vec()).collect(),
            half: (block.spacing(h, per_axis) * 0.5).as_slice().to_vec(),
            along: block.counts(h, per_axis)[0],
        });
        let mut fragments = Vec::new();
        let mut all = cells.iter();
        let mut particles = Particles::fill_where(block, h, per_axis, |_| match all.next() {
            Some(LatticeCell::Parts(parts)) => {
                fragments.extend(parts.iter().map(FragmentInput::build));
                false
            }
            cell => cell == Some(&LatticeCell::Whole),
        });
        particles.add_fragments(&fragments, self.density);
        particles
    }

    /// Moves the particles off the lattice, and adds the extra particles.
    fn edit<const D: usize>(&mut self, particles: &mut Particles<D>) {
        if let Some(displace) = &mut self.displace {
            let spacing = particles.spacing;
            for x in &mut particles.x0 {
                displace(x.as_mut_slice(), spacing.as_slice());
            }
        }
        for place in &self.extra {
            particles.add(vector(place));
        }
        particles.x.clone_from(&particles.x0);
    }

    /// Creates the material law, with the initial stress of the body.
    pub(super) fn law<const D: usize>(
        &self,
        plane: PlaneState,
        particles: &mut Particles<D>,
    ) -> Result<Box<dyn Material<D>>, SubjectError> {
        let law = self.material.in_plane(plane).ok_or("a law not supported in its plane")?;
        Ok(self.initial.stressed(law, particles)?)
    }

    pub(super) fn take_effects<const D: usize>(
        &mut self,
        grid: &Grid<D>,
        basis: BasisName,
        particles: &mut Particles<D>,
    ) -> Result<Vec<Box<dyn Effect<D>>>, SubjectError> {
        let effects = std::mem::take(&mut self.effects).into_iter();
        effects.map(|effect| effect.build(grid, basis, particles)).collect()
    }
}
