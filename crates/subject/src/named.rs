//! Enums whose members suites choose by name.

/// Declares an enum whose members have the same spelling in YAML, reports and messages.
///
/// `named! { pub enum Mass { Lumped = "lumped", } }` derives the usual traits and adds `ALL` (in
/// declaration order) and `name()`.
#[macro_export]
macro_rules! named {
    ($(#[$meta:meta])* pub enum $names:ident {
        $($(#[$member_meta:meta])* $member:ident = $text:literal,)+
    }) => {
        $(#[$meta])*
        #[derive(
            Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Deserialize, serde::Serialize,
        )]
        #[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
        pub enum $names {
            $($(#[$member_meta])* #[serde(rename = $text)] $member,)+
        }

        impl $names {
            /// All members, in declaration order.
            pub const ALL: &[Self] = &[$(Self::$member),+];

            /// Returns the name of the member in suites and reports.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$member => $text,)+
                }
            }
        }
    };
}
