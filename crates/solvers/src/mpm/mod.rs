//! The reference Material Point Method in 1-D, 2-D and 3-D: the "original MPM" of Sulsky, Chen &
//! Schreyer (1994) in the form of Wobbes & Tielen (2015).
//!
//! A scheme is a list of named stages ([`SchemeName::stages`]). The set-up fuses the stages into
//! passes over particles or nodes, and a step runs these passes. The loops over particles and nodes
//! have two type parameters, the dimension and the basis; the object-safe [`Kernel`] hides both.
//! [`Transfer`], [`MassMatrix`] and [`Effect`] use the passes of the kernel. These three and
//! [`Material`] are trait objects that are called between stages. A solver contains only the
//! effects that its set-up lists.
//!
//! ```text
//! particles --P2G--> mass, momentum, force --solve--> acceleration --G2P--> velocity, strain, x
//! ```
//!
//! Each layer imports only those above it:
//!
//! ```text
//! foundation    vectors, registers, threads, grid, particles
//! basis         basis functions
//! kernel        the loops over particles and nodes, compiled for each basis
//! families      boundary, mass, material, transfer, effect
//! step          set-up, schedule and passes of a solver
//! multibody, quasi_static    several solvers on one grid; a solver without dynamics
//! analysis      analyses of a solver
//! input         solvers created from data
//! ```

mod analysis;
mod basis;
mod boundary;
mod effect;
mod foundation;
pub mod input;
mod kernel;
mod mass;
pub mod material;
mod multibody;
mod quasi_static;
mod scheme;
mod seeding;
mod step;
mod transfer;

pub use basis::*;
pub use boundary::{Boundary, Fixed, Friction, Prescribed, Roller};
pub use effect::*;
pub use foundation::algebra::{Matrix, Vector, cofactor, det, inverse};
pub use foundation::grid::Grid;
pub use foundation::particles::{FrameName, Particles};
pub use kernel::contract::{Affine, G2pRequest, Kernel, P2gRequest};
pub use kernel::kernel;
pub use mass::{Consistent, Lumped, MassMatrix, MassName};
pub use material::{
    CamClay, DruckerPrager, GreenNaghdi, Hencky, J2, Jaumann, LinearElastic, LinearFluid, Material,
    MaterialPlan, MaterialProperties, MohrCoulomb, NeoHookean, Newtonian, Prestressed, Range,
    StressUpdate,
};
pub use multibody::Bodies;
pub use quasi_static::{QuasiStatic, QuasiStaticSetup};
pub use scheme::{SchemeName, Stage};
pub use step::combination::{CombinationError, combine};
pub use step::setup::Setup;
pub use step::solver::Solver;
pub use step::volume_average::VolumeName;
pub use transfer::{
    AffineTransfer, Apic, Flip, Fmpm, Mls, Pic, Tls, Tpic, Transfer, TransferChoice, TransferKind,
    TransferName, Xpic, g2p, transfer,
};

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{
    analysis::crossing_force::{StressedCells, force_at_node},
    analysis::dispersion::{WaveMethod, WaveStep, WaveTransfer},
    analysis::stable_time_step::simplest_with_same_response,
    analysis::wave_symbols::{Spline, WaveSymbols},
    boundary::{Advance, Side, VelocityField},
    foundation::algebra::{det_of_rows, dyad},
    foundation::moments::{Moments, WeightMoments},
    foundation::particles::Block,
    kernel::contract::{Divergence, LoopSettings, ParticleField, Tally},
    kernel::kernel_with,
    mass::mass_matrix,
    material::{
        Contradiction, ElastoPlastic, MaterialParameter, MaterialSpec, Rigid, StressBlock,
        StressResponse,
    },
    seeding::Fragment,
    seeding::quadrilateral::Quadrilateral,
    step::combination::{
        combine_across, combine_basis, combine_bodies, combine_precision, combine_volume,
    },
    step::heat_solver::HeatSolver,
    transfer::{Blend, TransferParameter, WithParameter},
};
