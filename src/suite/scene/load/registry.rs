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
        #[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
        pub(crate) enum LoadSpec {
            $($(#[$meta])* #[serde(rename = $text)] $member($file::$words),)+
        }

        impl EffectName {
            /// An entry of `loads` with this effect, of strength `s`, on a body in `dimension`
            /// dimensions: on its face `right` or its set `some`, if not on the whole body.
            pub fn example(self, dimension: usize) -> String {
                let vector = vec!["s*(1 + t)"; dimension].join(", ");
                let vector = format!("[{vector}]");
                let words = match self {
                    $(Self::$member => $file::$words::example(&vector),)+
                };
                format!("{}: {words}", self.name())
            }
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
