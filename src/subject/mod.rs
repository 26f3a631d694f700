//! The contract between the judge and the judged.
//!
//! A [`Subject`] can be put on every level of a refinement plan and held against the truth: the
//! crate's own MPM and FEM, or a solver of yours. The trait is object-safe and flat (`f64` slices,
//! no type of this crate's algebra), so that a solver in another language can stand behind it.

mod account;
mod checkpoint;
mod column;
mod plane;
mod profile;
mod reaction;
mod totals;

pub use account::Precision;
pub(crate) use account::{HIGHEST_ORDER, LONGEST_NAME, is_solver_name};
pub use checkpoint::{Checkpoint, Memory};
pub use column::{BodyFields, Column, ColumnSize, Entry, Holder, StateField};
pub use plane::PlaneState;
pub use profile::Profile;
pub use reaction::Reaction;
pub use totals::Totals;

use crate::named::named;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A solver under test, at one level of refinement.
pub trait Subject {
    /// Advances the state by one step of length `dt` (s).
    ///
    /// # Errors
    /// [`Failure`] says what broke and where. After a failure the subject is not stepped again.
    fn step(&mut self, dt: f64) -> Result<(), Failure>;

    /// Writes the present state, seen at the subject's own reference labels, into `samples`.
    /// The labels and their order do not change during a run.
    fn sample(&self, samples: &mut Samples);

    /// Counters of the run so far.
    fn counters(&self) -> RunCounters;

    /// Passes of a step in their order, as reports list them (`P2G(mass, momentum)`); empty from a
    /// subject that does not say.
    fn passes(&self) -> Vec<String> {
        Vec::new()
    }

    /// Fields of each body, for files that viewers read; none from a subject that keeps no more
    /// than its samples show.
    fn fields(&self) -> Vec<BodyFields> {
        Vec::new()
    }

    /// The sums over the body that a free motion keeps; `None` from a subject that does not say.
    fn totals(&self) -> Option<Totals> {
        None
    }

    /// Reaction of all walls on which the body stands still, or of that on one face (axis of the
    /// normal, and whether it is the high end); `None` from a subject that does not say, and before
    /// the first step.
    fn reaction(&self, _face: Option<(usize, bool)>) -> Option<Reaction> {
        None
    }

    /// Shows to `checkpoint` all that the steps to come depend on and that setting up does not give
    /// again: with it, a subject that was set up alike goes on from here and gives the same bits.
    /// False from one that cannot.
    fn checkpoint(&mut self, _checkpoint: &mut Checkpoint<'_>) -> bool {
        false
    }

    /// Kinetic energy (J) of the part of the velocities that the discretisation cannot see: of
    /// particles, the part in the null space of their map to the grid. It may take as much as some
    /// tens of steps, and is asked for only where a figure wants it; `None` from a subject that
    /// does not say.
    fn null_space_energy(&self) -> Option<f64> {
        None
    }
}

/// A subject whose step can be looked at as a map from state to state, on a configuration that does
/// not move: what a theory of small perturbations speaks of.
pub trait Perturbable: Subject {
    /// Keeps the configuration (positions and domains) as it is in all steps from now on; all else
    /// goes on as before.
    fn fix_configuration(&mut self);

    /// Writes all that a step reads and changes, but for the configuration, into `state`: always as
    /// many numbers in the same order.
    fn state(&self, state: &mut Vec<f64>);

    /// Takes over what [`Perturbable::state`] has written, possibly changed.
    fn set_state(&mut self, state: &[f64]);

    /// A natural size for each number of the state, where speeds are of the size `speed` (m/s) and
    /// stresses of the size `modulus` (Pa).
    fn sizes(&self, speed: f64, modulus: f64, sizes: &mut Vec<f64>);
}

named! {
    /// Meaning of the initial velocity `v0` in the first step.
    ///
    /// A step of Euler-Cromer, `v += dt a(u)`, `u += dt v`, is a leapfrog whose velocities are half
    /// a step behind. So the start alone decides the order in time.
    pub enum Start {
        /// `v0` stands in for `v(-dt/2)`, as in the talk. That is a push of `dt/2 a0` too much:
        /// first order in time, unless the initial acceleration `a0` is zero.
        AtZero = "at_zero",
        /// `v(-dt/2) = v0 - dt/2 a0`, the "CD" start of Wallstedt & Guilkey (2008): second order.
        HalfStepBack = "half_step_back",
    }
}

/// A state seen at reference labels: `n` labels in `dimension` dimensions, point after point. A
/// subject that has no stress, no F or no temperature leaves that column empty, and cannot be
/// judged by it.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct Samples {
    /// Number of space dimensions, D.
    pub dimension: usize,
    /// Reference positions X, `n * D` numbers (m).
    pub label: Vec<f64>,
    /// Displacements u = x - X, `n * D` numbers (m).
    pub displacement: Vec<f64>,
    /// Velocities, `n * D` numbers (m/s).
    pub velocity: Vec<f64>,
    /// Reference volume that each label stands for, `n` numbers (m^D): the weight in L1 and L2.
    pub weight: Vec<f64>,
    /// Cauchy stresses, `n * D * D` numbers, row after row (Pa); may be empty.
    pub stress: Vec<f64>,
    /// Deformation gradients F, `n * D * D` numbers, row after row; may be empty.
    pub deformation_gradient: Vec<f64>,
    /// Temperatures, `n` numbers (K); may be empty.
    pub temperature: Vec<f64>,
}

impl Samples {
    /// Number of labels, `n`.
    pub fn len(&self) -> usize {
        self.weight.len()
    }

    /// Whether there is no label.
    pub fn is_empty(&self) -> bool {
        self.weight.is_empty()
    }

    /// Begins anew, in so many dimensions.
    pub fn restart(&mut self, dimension: usize) {
        self.clear();
        self.dimension = dimension;
    }

    /// Adds a point: reference position (m), displacement (m) and velocity (m/s), D numbers each,
    /// and the reference volume (m^D) that it stands for.
    pub fn push(&mut self, label: &[f64], displacement: &[f64], velocity: &[f64], weight: f64) {
        self.dimension = label.len();
        self.label.extend_from_slice(label);
        self.displacement.extend_from_slice(displacement);
        self.velocity.extend_from_slice(velocity);
        self.weight.push(weight);
    }

    /// Empties the columns and keeps their memory.
    pub fn clear(&mut self) {
        self.label.clear();
        self.displacement.clear();
        self.velocity.clear();
        self.weight.clear();
        self.stress.clear();
        self.deformation_gradient.clear();
        self.temperature.clear();
    }
}

/// Deterministic figures of a run: what it cost, and what a reader must know beside an error.
/// `None` where the subject has no such thing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RunCounters {
    /// Particles (MPM).
    pub particles: Option<u64>,
    /// Particle-node pairs visited by P2G and G2P so far; for FEM, pairs of quadrature point and
    /// node.
    pub transfers: u64,
    /// How often a particle has changed its cell so far (MPM).
    pub crossings: Option<u64>,
    /// Particles outside the grid now (MPM).
    pub left_domain: Option<u64>,
    /// Smallest J = det F met so far; NaN where it is not known.
    pub min_j: f64,
}

impl RunCounters {
    /// Counters of a subject that knows no more than its `transfers`.
    pub fn new(transfers: u64) -> Self {
        let (particles, crossings, left_domain) = (None, None, None);
        Self { particles, transfers, crossings, left_domain, min_j: f64::NAN }
    }
}

/// Where a failure happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Site {
    /// Index of a particle.
    #[error("particle {0}")]
    Particle(usize),
    /// Index of an element.
    #[error("element {0}")]
    Element(usize),
    /// Index of a node.
    #[error("node {0}")]
    Node(usize),
}

/// Why a subject could not go on.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Failure {
    /// A quantity became NaN or infinite.
    #[error("{quantity} of {site} is not finite")]
    NonFinite {
        /// Name of the quantity.
        quantity: &'static str,
        /// Where.
        site: Site,
    },
    /// The deformation gradient lost its orientation.
    #[error("{site} is inverted, J = {j:.3e}")]
    Inverted {
        /// Where.
        site: Site,
        /// The determinant that was met.
        j: f64,
    },
    /// A body starts deformed, and its law cannot tell the stress of that.
    #[error("the law has no stress for a body that starts deformed")]
    NotOfDeformation,
    /// A particle has no cell any more.
    #[error("{site} left the domain at x = {position:?}")]
    LeftDomain {
        /// Which particle.
        site: Site,
        /// Its position, D numbers (m).
        position: Vec<f64>,
    },
    /// A linear system could not be solved.
    #[error("{0}")]
    Solve(String),
    /// A solver that is not of this crate broke, or broke the protocol.
    #[error("the solver {0}")]
    External(String),
}
