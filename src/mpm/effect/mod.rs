//! Registry of the effects: additions to the equations of motion, such as gravity. A new effect
//! requires one file and one line in `src/members.rs`. A solver has a list of effects. An effect
//! that is not in the list adds no call, column or branch.

mod contract;
mod hoop;
mod rim;
/// The effect added by `docs/exercises/effect.md`.
#[cfg(test)]
#[allow(unreachable_pub)] // the page has it in a public module
#[path = "../../../tests/exercises/spin.rs"]
mod spin;
mod surface;
mod thermal_face;

pub use body_force::ForceField;
pub(super) use contract::strain;
pub use contract::{BodyOnGrid, Effect};
pub use heat::HeatSource;
pub use hoop::Hoop;
pub use pressure::PressureField;
pub use rim::RimCircle;
pub use surface::Placement;
pub use thermal_face::{HeatInflow, ScalarField, Thermal, ThermalBoundary};
pub use traction::TractionField;

use crate::members::each_effect;

/// Declares the registry of effects from the lines of [`each_effect`](crate::members).
macro_rules! effects {
    ($(
        $(#[$meta:meta])*
        $member:ident = $text:literal => $words_file:ident::$words:ident
        $(, effect $file:ident::$effect:ident)?
        $(, needs [$($need:ident),+])?;
    )+) => {
        $($(
            mod $file;
            pub use $file::$effect;
        )?)+
    };
}

each_effect!(effects);
