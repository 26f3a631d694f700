//! The reference Material Point Method: the "original MPM" of Sulsky, Chen & Schreyer (1994) as
//! Wobbes & Tielen (2015) use it, for any number of dimensions.
//!
//! One step is a list of named stages ([`SchemeName::stages`]); each stage is a pass over particles or nodes.
//! Only basis x transfer meets inside the particle-node loop, so only these are type parameters,
//! hidden behind the object-safe [`Kernel`]; [`Material`] and [`Effect`] meet the solver between
//! stages and are trait objects. An effect that a scene does not list is not there.
//!
//! ```text
//! particles --P2G--> mass, momentum, force --solve--> acceleration --G2P--> velocity, strain, x
//! ```

mod algebra;
mod basis;
mod boundary;
mod effect;
mod family;
mod grid;
mod kernel;
mod material;
mod particles;
mod scheme;
mod solver;
mod stage;
mod transfer;

pub use algebra::{Matrix, Vector, det, dyad};
pub use basis::{
    Basis, BasisName, ContiguousGimp, CubicBSpline, Domain, Linear, QuadraticBSpline, Seen,
    UniformGimp,
};
pub use boundary::{Fixed, Side};
pub use effect::{BodyForce, Effect, Field, Gravity, Traction};
pub use grid::Grid;
pub use kernel::{Kernel, Pair};
pub use material::{LinearElastic, Material, NeoHookean};
pub use particles::{Block, Particles};
pub use scheme::SchemeName;
pub use solver::{Setup, Solver};
pub use stage::Stage;
pub use transfer::{Flip, Transfer, TransferName};

/// Builds the kernel that a suite names: the one place where names of bases and transfers become
/// types.
pub fn kernel<const D: usize>(basis: BasisName, transfer: TransferName) -> Box<dyn Kernel<D>> {
    basis::with_basis!(basis, B => transfer::with_transfer!(transfer, T => Box::new(Pair::<B, T>::new())))
}
