//! The reference Material Point Method: the "original MPM" of Sulsky, Chen & Schreyer (1994) as
//! Wobbes & Tielen (2015) use it, for any number of dimensions.
//!
//! A scheme is a list of named stages ([`SchemeName::stages`]), which the schedule fuses to passes
//! over particles or nodes once, when the solver is set up; a step is a loop over these passes.
//! Only the basis meets particles and nodes inside a loop, so only dimension and basis are type
//! parameters, hidden behind the object-safe [`Kernel`], whose passes [`Transfer`], [`MassMatrix`]
//! and [`Effect`] are made of; these and [`Material`] meet the solver between stages and are trait
//! objects. Effects exist only where a scene lists them.
//!
//! ```text
//! particles --P2G--> mass, momentum, force --solve--> acceleration --G2P--> velocity, strain, x
//! ```

pub(crate) mod analysis;
pub(crate) mod seeding;
pub(crate) mod state;

mod algebra;
mod basis;
mod boundary;
mod combination;
mod effect;
mod family;
mod frame;
mod grid;
mod heat_solver;
mod kernel;
mod mass;
pub mod material;
mod multibody;
mod packed_grid;
mod particles;
mod schedule;
mod scheme;
mod setup;
mod simd;
mod solver;
mod stage;
mod step;
mod stress;
mod threads;
mod transfer;

pub use algebra::{Matrix, Vector, cofactor, det, det_of_rows, dyad};
pub use analysis::stable_time_step::simplest_with_same_response;
pub use basis::*;
pub use boundary::{Advance, Boundary, Fixed, Friction, Prescribed, Roller, Side, VelocityField};
pub use combination::{combine, combine_across, combine_bodies};
pub use effect::*;
pub use frame::FrameName;
pub use grid::Grid;
pub use heat_solver::HeatSolver;
pub use kernel::contract::Kernel;
pub use kernel::moments::Moments;
pub use kernel::request::{Affine, Divergence, G2pRequest, P2gRequest, ParticleField};
pub use kernel::scalar_contract::Scalars;
pub use kernel::settings::LoopSettings;
pub use kernel::tally::Tally;
pub use kernel::{kernel, kernel_with};
pub use mass::{Consistent, Lumped, MassMatrix, MassName, mass_matrix};
pub use material::{
    DruckerPrager, ElastoPlastic, Hencky, J2, LinearElastic, LinearFluid, Material,
    MaterialParameter, MaterialPlan, MaterialProperties, MaterialSpec, MohrCoulomb, NeoHookean,
    Newtonian, Prestressed, Range, Rigid, StressBlock, StressUpdate,
};
pub use multibody::Bodies;
pub use particles::{Block, Particles};
pub use scheme::SchemeName;
pub use seeding::fragments::Fragment;
pub use seeding::quadrilateral::Quadrilateral;
pub use setup::Setup;
pub use solver::Solver;
pub use stage::Stage;
pub use state::initial::complete_start;
pub use transfer::{
    Apic, Blend, Flip, Fmpm, Mls, Pic, Tls, Tpic, Transfer, TransferChoice, TransferKind,
    TransferName, TransferParameter, WithParameter, Xpic, g2p, transfer,
};
