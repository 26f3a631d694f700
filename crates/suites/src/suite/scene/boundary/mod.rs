//! Boundary conditions on the faces of a body. A new condition needs a file in this folder, its
//! `mod` line and a line in `conditions!` below. Two conditions have no name in suites: a face
//! without a stated condition is a [`FreeFace`], or a [`FaceAtRest`] if the body does not move.

mod contract;
mod fixed;
mod friction;
mod periodic;
mod roller;
pub(crate) mod thermal;
mod velocity;

pub(crate) use contract::{BoundaryCondition, BoundaryKeys, FaceEntry};

use crate::exact::{Condition, FacePoint, Violation};
use contract::{FaceKind, FaceMotion};
use fixed::FixedFace;

/// Declares the names of conditions in suites. For example, the lines
///
/// `/// No displacement.`
/// `Fixed = "fixed" is fixed::FixedFace;`
///
/// `/// A frictional wall.`
/// `Friction = "friction" of friction::FrictionSpec;`
///
/// declare a condition without a value (`is`) and a condition with a value (`of`). Both types
/// implement the trait of the keys, such as [`BoundaryKeys`].
macro_rules! conditions {
    ($(#[$family:meta])* $spec:ident: $contract:ident;
     $($(#[$meta:meta])* $member:ident = $text:literal
        $(is $file:ident::$condition:ident)? $(of $from:ident::$keys:ident)?;)+
    ) => {
        $(#[$family])*
        #[derive(Debug, Clone, serde::Deserialize)]
        #[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
        pub(crate) enum $spec {
            $($(#[$meta])* #[serde(rename = $text)] $member $(($from::$keys))?,)+
        }

        impl $spec {
            pub(crate) fn named(&self) -> (&'static str, &dyn $contract) {
                match self {
                    $(
                        $(Self::$member => ($text, &$file::$condition),)?
                        $(Self::$member(keys) => {
                            let keys: &$from::$keys = keys;
                            ($text, keys)
                        })?
                    )+
                }
            }
        }
    };
}
use conditions;

conditions! {
    /// Boundary condition on a face; a face that is not named is free.
    BoundarySpec: BoundaryKeys;
    /// No displacement.
    Fixed = "fixed" is fixed::FixedFace;
    /// No displacement along the normal, no traction along the face.
    Roller = "roller" is roller::RollerFace;
    /// A wall that can push but not pull, with a coefficient of friction.
    Friction = "friction" of friction::FrictionSpec;
    /// State equal to that of the opposite face.
    Periodic = "periodic" is periodic::PeriodicFace;
    /// Prescribed velocity (m/s), formulas of the coordinates and t.
    Velocity = "velocity" of velocity::VelocitySpec;
}

/// The condition P n = 0, unless a load acts on the face.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FreeFace;

impl Condition for FreeFace {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        (0..point.dimension()).try_for_each(|i| point.traction(i, "free", 0.0))
    }
}

impl BoundaryCondition for FreeFace {
    fn kind(&self) -> FaceKind {
        FaceKind::new("free", "is free", FaceMotion::Free)
    }
}

/// The condition on the faces of a body with u = 0 everywhere.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceAtRest;

impl Condition for FaceAtRest {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        FixedFace.check(point)
    }
}

impl BoundaryCondition for FaceAtRest {
    fn kind(&self) -> FaceKind {
        let motion = FaceMotion::Stays { holds_all_components: false };
        FaceKind::new("at rest", "is at rest", motion)
    }

    fn row(&self) -> String {
        String::new()
    }
}
