//! Interface between the verifier and a solver under test.
//!
//! A [`Subject`] is a solver under test at one refinement level: the MPM or FEM solver of
//! `mpm-solvers`, or an external solver. The trait is object-safe and uses only slices of `f64`, so
//! that it can wrap a solver in another language.
//!
//! The crate also defines samples, counters and failures, sums over a body, wall reactions, the
//! rules for the name and the claimed order of a solver, and the out-of-plane state of a
//! two-dimensional body.

mod column;
mod dimension;
mod functional;
mod named;
mod nearest;

pub use column::{BodyFields, Column, ColumnSize, Entry, Holder, Profile, StateField};
pub use functional::{Functional, FunctionalValue, GradientParameter};
pub use nearest::{by_nearness, nearest};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A solver under test, at one level of refinement.
pub trait Subject {
    /// Advances the state by one step of length `dt` (s).
    ///
    /// # Errors
    /// [`Failure`] names the failure and its location. After a failure the subject must not be
    /// stepped again.
    fn step(&mut self, dt: f64) -> Result<(), Failure>;

    /// Writes the current state at the reference labels of the subject into `samples`. The labels
    /// and their order must not change during a run.
    fn sample(&self, samples: &mut Samples);

    /// Returns the counters of the run so far.
    fn counters(&self) -> RunCounters;

    /// Returns the names of the passes of a step in order, for reports, such as
    /// `P2G(mass, momentum)`; empty by default.
    fn passes(&self) -> Vec<String> {
        Vec::new()
    }

    /// Returns the fields of each body, for viewer files; empty if the subject reports only
    /// samples.
    fn fields(&self) -> Vec<BodyFields> {
        Vec::new()
    }

    /// Returns the conserved sums over the body; `None` by default.
    fn totals(&self) -> Option<Totals> {
        None
    }

    /// Returns the reaction of all fixed walls, or of one face, given by the axis of its normal and
    /// by `true` for the high end of this axis. `None` by default, and before the first step.
    fn reaction(&self, _face: Option<(usize, bool)>) -> Option<Reaction> {
        None
    }

    /// Returns the kinetic energy (J) of the part of the velocities that the discretisation does
    /// not resolve. For particles, this part is in the null space of the map to the grid. The
    /// computation may cost as much as tens of steps. `None` by default.
    fn null_space_energy(&self) -> Option<f64> {
        None
    }
}

/// A subject whose step can be run on a fixed configuration, as a map of state vectors, for linear
/// stability analysis.
pub trait Perturbable: Subject {
    /// Fixes the configuration (positions and domains) in all later steps. All other quantities
    /// continue to advance.
    fn fix_configuration(&mut self);

    /// Writes to `state` all numbers that a step reads and changes, except the configuration. The
    /// number and order of the entries never change.
    fn state(&self, state: &mut Vec<f64>);

    /// Sets the state from numbers in the order of [`Perturbable::state`].
    fn set_state(&mut self, state: &[f64]);

    /// Writes a natural scale of each state number to `sizes`. `speed` (m/s) is the scale of
    /// velocities, `modulus` (Pa) that of stresses.
    fn sizes(&self, speed: f64, modulus: f64, sizes: &mut Vec<f64>);
}

named! {
    /// Meaning of the initial velocity `v0` in the first step.
    ///
    /// A step of Euler-Cromer, `v += dt a(u)`, `u += dt v`, is a leapfrog whose velocities are half
    /// a step behind. The choice of the start therefore determines the order in time.
    pub enum Start {
        /// `v(-dt/2) = v0`, as in Wobbes & Tielen (2015). The velocity error is `dt/2 a0`: first
        /// order in time, unless the initial acceleration `a0` is zero.
        AtZero = "at_zero",
        /// `v(-dt/2) = v0 - dt/2 a0`, the "CD" start of Wallstedt & Guilkey (2008): second order.
        HalfStepBack = "half_step_back",
    }
}

/// State at reference labels: `n` labels in `dimension` dimensions, one label after another.
/// Stress, F and temperature can be verified only if their columns are present.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Samples {
    /// Number of space dimensions, D.
    pub dimension: usize,
    /// Reference positions X, `n * D` numbers (m).
    pub label: Vec<f64>,
    /// Displacements u = x - X, `n * D` numbers (m).
    pub displacement: Vec<f64>,
    /// Velocities, `n * D` numbers (m/s).
    pub velocity: Vec<f64>,
    /// Reference volume of each label, `n` numbers (m^D): the weight in L1 and L2.
    pub weight: Vec<f64>,
    /// Mass of each label, `n` numbers (kg): the weight in the mass-weighted norms; may be empty.
    pub mass: Vec<f64>,
    /// Cauchy stresses, `n * D * D` numbers, row by row (Pa); may be empty.
    pub stress: Vec<f64>,
    /// Out-of-plane normal Cauchy stresses of a two-dimensional body, `n` numbers (Pa); may be
    /// empty.
    pub stress_across: Vec<f64>,
    /// Deformation gradients F, `n * D * D` numbers, row by row; may be empty.
    pub deformation_gradient: Vec<f64>,
    /// Temperatures, `n` numbers (K); may be empty.
    pub temperature: Vec<f64>,
}

impl Samples {
    /// Returns the number of labels, `n`.
    pub fn len(&self) -> usize {
        self.weight.len()
    }

    /// Whether there are no labels.
    pub fn is_empty(&self) -> bool {
        self.weight.is_empty()
    }

    /// Removes all labels and sets the number of dimensions.
    pub fn restart(&mut self, dimension: usize) {
        self.clear();
        self.dimension = dimension;
    }

    /// Adds a label: reference position (m), displacement (m) and velocity (m/s), D numbers each,
    /// and reference volume (m^D).
    pub fn push(&mut self, label: &[f64], displacement: &[f64], velocity: &[f64], weight: f64) {
        self.dimension = label.len();
        self.label.extend_from_slice(label);
        self.displacement.extend_from_slice(displacement);
        self.velocity.extend_from_slice(velocity);
        self.weight.push(weight);
    }

    /// Empties the columns without freeing their memory.
    pub fn clear(&mut self) {
        self.label.clear();
        self.displacement.clear();
        self.velocity.clear();
        self.weight.clear();
        self.mass.clear();
        self.stress.clear();
        self.stress_across.clear();
        self.deformation_gradient.clear();
        self.temperature.clear();
    }
}

/// Deterministic counts and values of a run, which describe the cost of the run and help to explain
/// the error. `None` if the subject does not have a value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RunCounters {
    /// Number of particles (MPM).
    pub particles: Option<u64>,
    /// Number of particle-node pairs that P2G and G2P have visited so far; for FEM, pairs of a
    /// quadrature point and a node.
    pub transfers: u64,
    /// Number of cell changes of particles so far (MPM).
    pub crossings: Option<u64>,
    /// Number of particles that are now outside the grid (MPM).
    pub left_domain: Option<u64>,
    /// Smallest J = det F so far; NaN if unknown.
    pub min_j: f64,
}

impl RunCounters {
    /// Creates the counters of a subject that counts only `transfers`.
    pub fn new(transfers: u64) -> Self {
        let (particles, crossings, left_domain) = (None, None, None);
        Self { particles, transfers, crossings, left_domain, min_j: f64::NAN }
    }
}

/// Location of a failure in the discretisation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
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

/// Reason for the failure of a subject.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Failure {
    /// A quantity became NaN or infinite.
    #[error("{quantity} of {site} is not finite")]
    NonFinite {
        /// Name of the quantity.
        quantity: &'static str,
        /// Location of the failure.
        site: Site,
    },
    /// The determinant of a deformation gradient is not positive.
    #[error("{site} is inverted, J = {j:.3e}")]
    Inverted {
        /// Location of the failure.
        site: Site,
        /// The determinant of the deformation gradient.
        j: f64,
    },
    /// A body starts deformed, but its law does not define the stress of the initial deformation.
    #[error("the law has no stress for a body that starts deformed")]
    NotOfDeformation,
    /// The initial stress violates the yield condition of the law.
    #[error("the initial stress of {site} is outside the yield surface, f = {value:.3e} Pa")]
    OutsideYieldSurface {
        /// The particle.
        site: Site,
        /// Value of the yield function (Pa).
        value: f64,
    },
    /// A particle is outside all cells of the grid.
    #[error("{site} left the domain at x = {position:?}")]
    LeftDomain {
        /// The particle.
        site: Site,
        /// Position of the particle, D numbers (m).
        position: Vec<f64>,
    },
    /// Newton's method did not converge in a load step.
    #[error(
        "Newton's method did not converge: the largest residual is {residual:.1e} of the load, at \
         node {node}"
    )]
    NotConverged {
        /// Largest nodal residual, divided by the norm of the load.
        residual: f64,
        /// Index of the node with this residual.
        node: usize,
    },
    /// A linear system could not be solved, for the given reason.
    #[error("{0}")]
    Solve(String),
    /// An external solver stopped, or violated the protocol; with a description.
    #[error("the solver {0}")]
    External(String),
}

/// Reason why a problem cannot be run.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SubjectError {
    /// The solver does not support the problem, or the problem does not exist; with the reason in
    /// one line.
    #[error("{0}")]
    Unsupported(String),
    /// The solver failed before its first step.
    #[error(transparent)]
    Failed(#[from] Failure),
}

impl From<String> for SubjectError {
    fn from(reason: String) -> Self {
        Self::Unsupported(reason)
    }
}

impl From<&str> for SubjectError {
    fn from(reason: &str) -> Self {
        Self::Unsupported(reason.to_owned())
    }
}

/// Sums over the particles p, for checks of conservation. Components above the dimension are zero.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Totals {
    /// `sum m_p` (kg).
    pub mass: f64,
    /// `sum m_p v_p` (kg m/s).
    pub momentum: [f64; 3],
    /// `sum m_p |v_p|`, the scale for changes of the momentum (kg m/s).
    pub momentum_size: f64,
    /// `sum m_p x_p x v_p` about the origin, plus the angular momentum within particles (kg m2/s).
    /// In 2-D only the third component is non-zero; in 1-D all are zero.
    pub angular_momentum: [f64; 3],
    /// Sum of the magnitudes of the terms of the angular momentum (kg m2/s).
    pub angular_momentum_size: f64,
    /// `sum m_p v_p^2 / 2` (J).
    pub kinetic_energy: f64,
    /// Stored energy of the material (J); `None` if the law defines no energy.
    pub strain_energy: Option<f64>,
    /// `sum m_p x_p^2` for each axis (kg m2).
    pub second_moment: [f64; 3],
    /// `sum m_p X_p^2` of the reference positions, for each axis (kg m2).
    pub reference_second_moment: [f64; 3],
}

impl Totals {
    /// Returns the sums over sampled points with these masses (kg), without the stored energy.
    pub fn of_points(masses: &[f64], samples: &Samples) -> Self {
        let d = samples.dimension;
        let mut totals = Self::default();
        for (p, (mass, label)) in
            masses.iter().zip(samples.label.chunks_exact(d.max(1))).enumerate()
        {
            let at = |column: &[f64], i: usize| if i < d { column[p * d + i] } else { 0.0 };
            let v: [f64; 3] = std::array::from_fn(|i| at(&samples.velocity, i));
            let x: [f64; 3] =
                std::array::from_fn(|i| at(&samples.label, i) + at(&samples.displacement, i));
            let turn =
                [x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]];
            totals.add(*mass, v, turn.map(|turn| mass * turn));
            totals.add_second_moments(*mass, &x[..d], label);
        }
        totals
    }

    /// Adds a particle with this mass (kg), velocity (m/s) and angular momentum (kg m2/s).
    #[inline]
    pub fn add(&mut self, mass: f64, velocity: [f64; 3], spin: [f64; 3]) {
        let [x, y, z] = velocity;
        let speed = (x * x + y * y + z * z).sqrt();
        self.mass += mass;
        self.momentum_size += mass * speed;
        self.kinetic_energy += 0.5 * mass * speed * speed;
        self.angular_momentum_size += libm::hypot(libm::hypot(spin[0], spin[1]), spin[2]);
        for i in 0..3 {
            self.momentum[i] += mass * velocity[i];
            self.angular_momentum[i] += spin[i];
        }
    }

    /// Adds the second moments of a particle with this mass (kg) at the position `x` with the
    /// reference position `label` (m).
    #[inline]
    pub fn add_second_moments(&mut self, mass: f64, x: &[f64], label: &[f64]) {
        for axis in 0..x.len() {
            self.second_moment[axis] += mass * x[axis] * x[axis];
            self.reference_second_moment[axis] += mass * label[axis] * label[axis];
        }
    }

    /// Returns the sum of kinetic and stored energy (J); `None` if the law defines no energy.
    pub fn energy(&self) -> Option<f64> {
        self.strain_energy.map(|stored| self.kinetic_energy + stored)
    }

    /// Adds the sums of two bodies.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        let sum = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| a[i] + b[i]);
        Self {
            mass: self.mass + other.mass,
            momentum: sum(self.momentum, other.momentum),
            momentum_size: self.momentum_size + other.momentum_size,
            angular_momentum: sum(self.angular_momentum, other.angular_momentum),
            angular_momentum_size: self.angular_momentum_size + other.angular_momentum_size,
            kinetic_energy: self.kinetic_energy + other.kinetic_energy,
            strain_energy: self.strain_energy.zip(other.strain_energy).map(|(a, b)| a + b),
            second_moment: sum(self.second_moment, other.second_moment),
            reference_second_moment: sum(
                self.reference_second_moment,
                other.reference_second_moment,
            ),
        }
    }
}

/// Force of walls on the body at the beginning of the last step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reaction {
    /// Time (s) at which the force acts.
    pub time: f64,
    /// The force (N); components above the dimension are zero.
    pub force: [f64; 3],
}

/// Maximum length of a solver name (bytes).
pub const LONGEST_NAME: usize = 64;

/// Maximum order that a solver may claim.
pub const HIGHEST_ORDER: f64 = 20.0;

/// Whether `name` is a valid solver name, which becomes part of case and file names.
pub fn is_solver_name(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    !name.is_empty() && name.len() <= LONGEST_NAME && name.chars().all(plain)
}

named! {
    /// Floating-point precision of a solver.
    #[derive(Default)]
    pub enum Precision {
        /// 53-bit significand.
        #[default]
        Double = "double",
        /// 24-bit significand.
        Single = "single",
    }
}

named! {
    /// Out-of-plane state of a two-dimensional body.
    #[derive(Default)]
    pub enum PlaneState {
        /// Plane strain: F_33 = 1.
        #[default]
        Strain = "strain",
        /// Plane stress, a plate with free faces: sigma_33 = 0.
        Stress = "stress",
        /// The meridian plane (r, z) of a body of revolution: F_33 = r/R.
        Axisymmetric = "axisymmetric",
    }
}
