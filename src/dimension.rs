//! Converts a number of space dimensions to a constant that types can use.

/// Evaluates `$work` with a constant `$D` equal to `$dimension` (1, 2 or 3; larger values count as
/// 3): `with_dimension!(scene.dimension(), D => solve::<D>(scene))`.
macro_rules! with_dimension {
    ($dimension:expr, $D:ident => $work:expr) => {
        match $dimension {
            1 => {
                const $D: usize = 1;
                $work
            }
            2 => {
                const $D: usize = 2;
                $work
            }
            _ => {
                const $D: usize = 3;
                $work
            }
        }
    };
}
pub(crate) use with_dimension;

/// Declares the trait `$every` for types that implement `$contract<D>` in every dimension. A
/// `dyn $every` object converts to a `dyn $contract<D>` object for any D.
macro_rules! in_every_dimension {
    ($(#[$meta:meta])* $every:ident: $contract:ident) => {
        $(#[$meta])*
        pub(crate) trait $every: $contract<1> + $contract<2> + $contract<3> {}

        impl<T: $contract<1> + $contract<2> + $contract<3> + ?Sized> $every for T {}

        impl dyn $every {
            /// Converts this object to an implementation in D dimensions (1, 2 or 3).
            pub(crate) fn in_dimension<const D: usize>(
                self: std::sync::Arc<Self>,
            ) -> Option<std::sync::Arc<dyn $contract<D>>> {
                $crate::dimension::with_dimension!(D, N => {
                    let object: std::sync::Arc<dyn $contract<N>> = self;
                    // N equals D, but the compiler cannot infer this.
                    let object: &dyn std::any::Any = &object;
                    object.downcast_ref().cloned()
                })
            }
        }
    };
}
pub(crate) use in_every_dimension;
