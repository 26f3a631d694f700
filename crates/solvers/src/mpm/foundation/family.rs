//! Macros that declare a family of types with a common trait, such as the basis functions. One line
//! registers a type with its name.

/// Declares a family of types that suite files select by name.
///
/// `family! { /// docs  pub enum BasisName; with_basis; "linear" => linear::Linear, }` exports the
/// types from their files. It defines the enum of names and a macro `with_basis!(name, B => expr)`,
/// which contains the only `match` from a name to a type.
macro_rules! family {
    (
        $(#[$meta:meta])* pub enum $names:ident; $with:ident;
        $($text:literal => $file:ident::$member:ident,)+
    ) => {
        $(pub use self::$file::$member;)+

        mpm_subject::named! {
            $(#[$meta])*
            pub enum $names {
                $(
                    #[doc = concat!("`", $text, "`, see [`", stringify!($member), "`].")]
                    $member = $text,
                )+
            }
        }

        $crate::mpm::foundation::family::family!(@with ($) $names $with $($member)+);
    };
    (@with ($dollar:tt) $names:ident $with:ident $($member:ident)+) => {
        macro_rules! $with {
            ($dollar name:expr, $dollar kind:ident => $dollar body:expr) => {
                match $dollar name {
                    $(
                        $crate::mpm::$names::$member => {
                            type $dollar kind = $crate::mpm::$member;
                            $dollar body
                        }
                    )+
                }
            };
        }
        pub(in $crate::mpm) use $with;
    };
}
pub(in crate::mpm) use family;

/// Declares a family of trait objects that suite files select by name.
///
/// `objects! { /// docs  pub enum Names; /// docs  pub fn make -> Trait; "flip" => Flip: Flip, }`
/// defines the enum of names and a function that creates the object with a given name, in any
/// dimension.
macro_rules! objects {
    ($(#[$meta:meta])* pub enum $names:ident; $(#[$fn_meta:meta])* pub fn $make:ident -> $contract:ident;
        $($text:literal => $member:ident: $build:expr,)+
    ) => {
        mpm_subject::named! {
            $(#[$meta])*
            pub enum $names {
                $(
                    #[doc = concat!("`", $text, "`: `", stringify!($build), "`.")]
                    $member = $text,
                )+
            }
        }

        $(#[$fn_meta])*
        pub fn $make<const D: usize>(name: $names) -> Box<dyn $contract<D>> {
            match name {
                $($names::$member => Box::new($build),)+
            }
        }
    };
}
pub(in crate::mpm) use objects;
