//! Registration: one line makes a condition on faces known by name, with its words.

/// Declares a family of conditions. The lines
///
/// `/// No displacement.`
/// `Fixed = "fixed" is fixed::FixedFace;`
///
/// `/// A wall that presses and does not pull, with a coefficient of friction.`
/// `Friction = "friction" of friction::FrictionSpec;`
///
/// give a condition the name that suites write: one that its name says all of, and one with a value
/// under its name. Both types implement the contract of the family's words.
macro_rules! conditions {
    ($(#[$family:meta])* $spec:ident: $contract:ident;
     $($(#[$meta:meta])* $member:ident = $text:literal
        $(is $file:ident::$condition:ident)? $(of $from:ident::$words:ident)?;)+
    ) => {
        $(#[$family])*
        #[derive(Debug, Clone, serde::Deserialize)]
        #[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
        pub(crate) enum $spec {
            $($(#[$meta])* #[serde(rename = $text)] $member $(($from::$words))?,)+
        }

        impl $spec {
            /// The name, and the words under it.
            pub(crate) fn named(&self) -> (&'static str, &dyn $contract) {
                match self {
                    $(
                        $(Self::$member => ($text, &$file::$condition),)?
                        $(Self::$member(words) => {
                            let words: &$from::$words = words;
                            ($text, words)
                        })?
                    )+
                }
            }
        }
    };
}
pub(super) use conditions;
