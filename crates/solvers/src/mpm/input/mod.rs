//! Problems as data: a scene of bodies, from which solvers of any dimension and basis are created.
//!
//! The types of this module have no type parameters. Fields are functions of slices with one number
//! per dimension. Only this module chooses the dimension of a solver.

mod body;
mod create;
mod effect;
mod state;
mod wall;

pub use body::{BodyInput, ShapeInput};
pub use create::{
    initial_particles, initial_stress, perturbable, profile, stable_time_step, subject,
};
pub use effect::EffectInput;
pub use state::{InitialState, ParticleTable};
pub use wall::WallCondition;

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{
    body::{CellLattice, CutLattice, Displace, FragmentInput, LatticeCell, MassAt, visit_lattice},
    effect::{ForceAt, HeatInput, HeatSourceAt, InSet, PressedPart, SetInput, TemperatureAt},
    state::{MotionAt, StateInput, StressAt},
    wall::{FaceInput, SharedVectorAt, WallInput},
};

use super::basis::BasisName;
#[doc(hidden)]
pub use super::effect::{HeatInflow as InflowAt, ScalarField as ScalarAt};
use super::foundation::particles::FrameName;
use super::mass::MassName;
use super::scheme::SchemeName;
use super::step::volume_average::VolumeName;
use super::transfer::TransferChoice;
use mpm_subject::{PlaneState, Precision, Start};

/// A vector field: a function of the position (m) and time (s), which writes one number per
/// dimension.
pub type VectorAt = Box<dyn Fn(&[f64], f64, &mut [f64]) + Send>;

/// A vector that depends on time (s): writes one number per dimension.
pub type VectorOfTime = Box<dyn Fn(f64, &mut [f64]) + Send>;

/// Bodies on one grid. Functions that are called only during the set-up may borrow for `'a`.
pub struct SceneInput<'a> {
    /// Plane state of the bodies in two dimensions.
    pub plane: PlaneState,
    /// The background grid, which also defines the dimension.
    pub grid: GridInput,
    /// Conditions on faces of the grid. Where faces meet, the last condition applies.
    pub walls: Vec<WallInput>,
    /// The bodies.
    pub bodies: Vec<BodyInput<'a>>,
    /// Friction coefficient of the contact between bodies; `None` if the bodies share one velocity
    /// field.
    pub contact: Option<f64>,
}

/// A grid of equal cells.
#[derive(Debug, Clone, PartialEq)]
pub struct GridInput {
    /// Lowest corner (m). The number of entries, 1 to 3, is the dimension.
    pub origin: Vec<f64>,
    /// Cell size (m).
    pub h: f64,
    /// Number of cells along each axis.
    pub cells: Vec<usize>,
    /// Whether each axis is periodic.
    pub periodic: Vec<bool>,
}

impl GridInput {
    /// Returns the number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.origin.len()
    }
}

/// The parts of an MPM method, by their names in suites.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MpmMethod {
    /// Basis functions.
    pub basis: BasisName,
    /// Velocity transfer.
    pub transfer: TransferChoice,
    /// Time scheme.
    pub scheme: SchemeName,
    /// Treatment of the initial velocity.
    pub start: Start,
    /// Mass matrix.
    pub mass: MassName,
    /// Configuration in which the basis functions are defined.
    pub frame: FrameName,
    /// Volume ratio at which the material law is evaluated.
    pub volume: VolumeName,
    /// Precision of the state.
    pub precision: Precision,
}

/// A method of the MPM solvers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MethodInput {
    /// Dynamics.
    Dynamic(MpmMethod),
    /// Equilibrium after each of `load_steps` load steps.
    QuasiStatic {
        /// Basis functions.
        basis: BasisName,
        /// Number of load steps.
        load_steps: u64,
    },
    /// Heat conduction in a body at rest.
    Heat {
        /// Basis functions.
        basis: BasisName,
    },
}
