//! Family of the boundary conditions on the faces of a body. A member is one file and one line
//! below (and a `mod` line), and its condition on nodes is a file in the family of the solver. Two
//! conditions are not stated in suites: a face without condition is a [`FreeFace`], or a
//! [`FaceAtRest`] of a body that does not move.

mod contract;
mod fixed;
mod friction;
mod periodic;
mod roller;
pub(crate) mod thermal;
mod unstated;
mod velocity;

pub(crate) use contract::{BoundaryCondition, BoundaryKeys, FaceEntry, FaceSite, build};
pub(crate) use unstated::{FaceAtRest, FreeFace};

/// Declares a family of conditions. The lines
///
/// `/// No displacement.`
/// `Fixed = "fixed" is fixed::FixedFace;`
///
/// `/// A wall that presses and does not pull, with a coefficient of friction.`
/// `Friction = "friction" of friction::FrictionSpec;`
///
/// give a condition its name in suites: the first form for a condition without value, the second
/// for one with a value. Both types implement the contract of the keys.
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
            /// The name, and the keys under it.
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
    /// A wall that presses and does not pull, with a coefficient of friction.
    Friction = "friction" of friction::FrictionSpec;
    /// State equal to that of the opposite face.
    Periodic = "periodic" is periodic::PeriodicFace;
    /// Prescribed velocity (m/s), formulas of the coordinates and t.
    Velocity = "velocity" of velocity::VelocitySpec;
}
