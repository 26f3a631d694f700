//! Family of boundary conditions on the faces of a body. A new member needs one file, its `mod`
//! line and one line below; its condition on grid nodes is a file in the solver's family. Suites
//! cannot state two of the conditions: a face without condition is a [`FreeFace`], or a
//! [`FaceAtRest`] if the body does not move.

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
/// define the names of conditions in suites: the first form is for a condition without value, the
/// second for a condition with a value. Both types implement the trait of the keys.
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
            /// The name of the condition, and its keys.
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
