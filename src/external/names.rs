//! Names that capabilities may contain, and what a misspelt one stands for.

use super::capabilities::Capabilities;
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
pub(crate) const CONDITIONS: &[&str] =
    &["free", "fixed", "roller", "periodic", "friction", "velocity"];

/// Names of the optional columns of a state.
const COLUMNS: &[&str] = &["stress", "deformation_gradient", "temperature"];

/// Keys of the capabilities.
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
fn known(capability: &str) -> &'static [&'static str] {
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

/// One line for each name in `capabilities`, and for each key among `keys`, that means nothing.
pub(super) fn unknown(capabilities: &Capabilities, keys: &[String]) -> Vec<String> {
    let hint = |name: &str, known: &[&'static str]| match nearest(name, known.iter().copied()) {
        Some(known) => format!("did you mean `{known}`?"),
        None => format!("known: {}", known.join(", ")),
    };
    let mut warnings = Vec::new();
    for key in keys.iter().filter(|key| !KEYS.contains(&key.as_str())) {
        warnings.push(format!("unknown capability `{key}`; {}", hint(key, KEYS)));
    }
    for (capability, stated) in [
        ("laws", &capabilities.laws),
        ("conditions", &capabilities.conditions),
        ("loads", &capabilities.loads),
        ("columns", &capabilities.columns),
    ] {
        let known = known(capability);
        for name in stated.iter().filter(|name| !known.contains(&name.as_str())) {
            let hint = hint(name, known);
            warnings.push(format!("`{name}` is not one of the {capability}; {hint}"));
        }
    }
    for dimension in capabilities.dimensions.iter().filter(|d| !(1..=3).contains(*d)) {
        warnings.push(format!("there are no suites in {dimension} dimensions"));
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_the_fields_of_the_capabilities() {
        let all = serde_json::to_value(Capabilities::default()).unwrap();
        let mut fields: Vec<&str> = all.as_object().unwrap().keys().map(String::as_str).collect();
        let mut keys = KEYS.to_vec();
        fields.sort_unstable();
        keys.sort_unstable();
        assert_eq!(keys, fields);
    }

    #[test]
    fn unknown_names_have_hints() {
        let stated = Capabilities::of(
            &[2, 4],
            &["linear-elastic", "hencky"],
            &["clamped", "Roller"],
            &["bodyforce"],
        );
        let keys = ["periodic_axes", "contacts", "laws"].map(str::to_owned);
        let warnings = unknown(&stated, &keys);
        let expected = [
            "unknown capability `periodic_axes`; known: dimensions, ",
            "unknown capability `contacts`; did you mean `contact`?",
            "`linear-elastic` is not one of the laws; did you mean `linear_elastic`?",
            "`clamped` is not one of the conditions; known: free, fixed, ",
            "`Roller` is not one of the conditions; did you mean `roller`?",
            "`bodyforce` is not one of the loads; did you mean `body_force`?",
            "there are no suites in 4 dimensions",
        ];
        assert_eq!(warnings.len(), expected.len(), "{warnings:#?}");
        for (warning, expected) in warnings.iter().zip(expected) {
            assert!(warning.starts_with(expected), "{warning}");
        }
        assert_eq!(misspelt("laws", "linear_elastic", &stated.laws), Some("linear-elastic"));
        assert_eq!(misspelt("laws", "hencky", &stated.laws), None);
    }
}
