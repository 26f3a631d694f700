//! Converts a number of space dimensions to a constant that types can use.

/// Evaluates `$work` with a constant `$D` equal to `$dimension` (1, 2 or 3; larger values count as
/// 3): `with_dimension!(scene.dimension(), D => solve::<D>(scene))`.
#[macro_export]
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
