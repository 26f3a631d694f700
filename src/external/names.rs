//! Names that capabilities may contain, and what a misspelt one stands for.

use crate::members::{each_effect, each_material};
use crate::nearest::nearest;

/// Declares the names of the materials, from the lines of [`each_material`](crate::members).
macro_rules! laws {
    ($($name:literal => $file:ident::$law:ident {$($parameters:tt)*}
        $(, truth $truth_file:ident::$truth:ident)?;)+
    ) => {
        /// Names of the materials.
        const LAWS: &[&str] = &[$($name),+];
    };
}

each_material!(laws);

/// Declares the names of the loads and effects, from the lines of [`each_effect`](crate::members).
macro_rules! loads {
    ($($(#[$meta:meta])* $member:ident = $name:literal => $file:ident::$words:ident
        $(, effect $effect_file:ident::$effect:ident)? $(, needs [$($need:ident),+])?;)+
    ) => {
        /// Names of the loads and effects.
        const LOADS: &[&str] = &[$($name),+];
    };
}

each_effect!(loads);

/// Names of the conditions on faces.
const CONDITIONS: &[&str] = &["free", "fixed", "roller", "periodic", "friction", "velocity"];

/// Names of the optional columns of a state.
const COLUMNS: &[&str] = &["stress", "deformation_gradient", "temperature"];

/// Keys of the capabilities.
#[cfg(feature = "external-programs")]
pub(super) const KEYS: &[&str] = &[
    "dimensions",
    "laws",
    "conditions",
    "loads",
    "columns",
    "manufactured",
    "initial_deformation",
    "several_bodies",
    "contact",
    "plane_stress",
    "axisymmetric",
    "initial_stress",
    "displacement_force",
    "binary",
];

/// The names that the list called `capability` may contain.
pub(super) fn known(capability: &str) -> &'static [&'static str] {
    match capability {
        "laws" => LAWS,
        "conditions" => CONDITIONS,
        "loads" => LOADS,
        _ => COLUMNS,
    }
}

/// The unknown name among `stated` that most likely means `name`.
pub(super) fn misspelt<'a>(capability: &str, name: &str, stated: &'a [String]) -> Option<&'a str> {
    let known = known(capability);
    let unknown = stated.iter().map(String::as_str).filter(|stated| !known.contains(stated));
    unknown.into_iter().find(|stated| nearest(stated, known.iter().copied()) == Some(name))
}

/// The known name that a misspelt one most likely means, or all of them.
#[cfg(feature = "external-programs")]
pub(super) fn hint(name: &str, known: &[&'static str]) -> String {
    match nearest(name, known.iter().copied()) {
        Some(known) => format!("did you mean `{known}`?"),
        None => format!("known: {}", known.join(", ")),
    }
}
