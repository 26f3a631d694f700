//! The variables of formulas of place and time.

/// Names of the coordinates in formulas.
pub(crate) const COORDINATES: [&str; 3] = ["X", "Y", "Z"];

/// Names of the components of the displacement in loads.
pub(crate) const DISPLACEMENTS: [&str; 3] = ["ux", "uy", "uz"];

/// The coordinates of `dimension` dimensions, followed by t.
pub(crate) fn coordinates_and_time(dimension: usize) -> Vec<&'static str> {
    COORDINATES[..dimension].iter().copied().chain(["t"]).collect()
}
