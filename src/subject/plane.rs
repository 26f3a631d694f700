//! Third axis of a two-dimensional body.

use crate::named::named;

named! {
    /// State of a two-dimensional body across its plane.
    #[derive(Default)]
    pub enum PlaneState {
        /// Held across: F_33 = 1.
        #[default]
        Strain = "strain",
        /// A plate with free faces: sigma_33 = 0.
        Stress = "stress",
        /// The meridian plane (r, z) of a body of revolution: F_33 = r/R.
        Axisymmetric = "axisymmetric",
    }
}
