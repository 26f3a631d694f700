//! Registration: one line makes a load known by name, with its words and the effects it needs.

/// Declares the family of loads. A line
///
/// `/// Strain that temperature makes.`
/// `ThermalExpansion = "thermal_expansion": thermal_expansion::ExpansionSpec, needs [Heat];`
///
/// gives the load the name that suites write and the type of its words, which implements
/// [`LoadWords`](super::LoadWords). `needs` lists other members, and may be left out.
macro_rules! loads {
    ($(
        $(#[$meta:meta])*
        $member:ident = $text:literal: $file:ident::$words:ident
        $(, needs [$($need:ident),+])?;
    )+) => {
        $crate::named::named! {
            /// Names of the loads and effects, as suites write them.
            pub enum EffectName {
                $($(#[$meta])* $member = $text,)+
            }
        }

        impl EffectName {
            /// The effects without which this one means nothing.
            pub fn needs(self) -> &'static [Self] {
                match self {
                    $(Self::$member => &[$($(Self::$need),+)?],)+
                }
            }
        }

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
