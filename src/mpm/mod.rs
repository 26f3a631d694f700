//! The reference Material Point Method: the "original MPM" of Sulsky, Chen & Schreyer (1994) as
//! Wobbes & Tielen (2015) use it, for any number of dimensions.
//!
//! One step is a list of named stages ([`SchemeName::stages`]); each stage is a pass over particles or nodes.
//! Only the basis meets particles and nodes inside a loop, so only dimension and basis are type
//! parameters, hidden behind the object-safe [`Kernel`], whose passes [`Transfer`], [`MassMatrix`]
//! and [`Effect`] are made of; these and [`Material`] meet the solver between stages and are trait
//! objects. An effect that a scene does not list is not there.
//!
//! ```text
//! particles --P2G--> mass, momentum, force --solve--> acceleration --G2P--> velocity, strain, x
//! ```

pub mod adding_a_basis;

mod algebra;
mod basis;
mod bodies;
mod boundary;
mod checkpoint;
mod combination;
mod conductor;
mod counted;
mod counted_scalars;
mod effect;
mod family;
mod four;
mod frame;
mod grid;
mod initial;
mod kernel;
mod loops;
mod mapped;
mod mass;
mod material;
mod moments;
mod null_space;
mod order;
mod packed;
mod particles;
mod quadrilateral;
mod safe_step;
mod sampling;
mod scalars;
mod scheme;
mod setup;
mod solver;
mod soundness;
mod stage;
mod state;
mod step;
mod stress;
mod threads;
mod totals;
mod touch;
mod transfer;
mod visits;
mod whereabouts;

pub use algebra::{Matrix, Vector, cofactor, det, dyad};
pub use basis::*;
pub use bodies::Bodies;
pub use boundary::{Advance, Boundary, Fixed, Friction, Prescribed, Roller, Side, VelocityField};
pub use combination::{combine, combine_bodies};
pub use conductor::Conductor;
pub use counted::{Counted, Tally};
pub use effect::{
    ArtificialViscosity, BodyForce, Damping, Driven, Effect, EffectName, Field, Gravity, Heat,
    HeatSource, LocalDamping, Placement, Pressure, PressureField, ScalarField, SetForce, Thermal,
    ThermalExpansion, ThermalFace, Traction, TractionField,
};
pub use frame::FrameName;
pub use grid::Grid;
pub use kernel::{Affine, Divergence, Kernel, Maps, Shown, Takes};
pub use loops::kernel;
pub use mass::{Consistent, Lumped, MassMatrix, MassName, mass_matrix};
pub use material::{
    Hencky, J2, LinearElastic, Material, MaterialPlan, MaterialWords, NeoHookean, Newtonian,
    Parameter, Range, Rigid,
};
pub use moments::Moments;
pub use particles::{Block, Particles};
pub use quadrilateral::Quadrilateral;
pub use scalars::Scalars;
pub use scheme::SchemeName;
pub use setup::Setup;
pub use solver::Solver;
pub use stage::Stage;
pub use transfer::{
    Also, Apic, Blend, Flip, Fmpm, Kind, Mls, Pic, Recipe, Tls, Tpic, Transfer, TransferChoice,
    TransferName, Wanted, Xpic, g2p, transfer,
};
