//! Registration: one line makes a load known by name, with its words.

/// Declares the family of loads, from the lines of [`each_effect`](crate::members). The type of the
/// words implements [`LoadWords`](super::LoadWords).
macro_rules! loads {
    ($(
        $(#[$meta:meta])*
        $member:ident = $text:literal => $file:ident::$words:ident
        $(, effect $effect_file:ident::$effect:ident)?
        $(, needs [$($need:ident),+])?;
    )+) => {
        $(mod $file;)+

        /// One entry of `loads`.
        #[derive(Debug, Clone, serde::Deserialize)]
        pub(crate) enum LoadSpec {
            $($(#[$meta])* #[serde(rename = $text)] $member($file::$words),)+
        }

        impl LoadSpec {
            /// The effect that the entry asks for.
            pub(crate) fn effect(&self) -> EffectName {
                match self {
                    $(Self::$member(_) => EffectName::$member,)+
                }
            }

            /// The words under its name.
            pub(crate) fn words(&self) -> &dyn LoadWords {
                match self {
                    $(Self::$member(words) => words,)+
                }
            }
        }
    };
}
pub(super) use loads;
