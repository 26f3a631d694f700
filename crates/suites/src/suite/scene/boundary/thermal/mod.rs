//! Thermal conditions on the faces of a heat-conducting body. A new condition needs a file in this
//! folder, its `mod` line and a line in `conditions!` below.

mod contract;
mod convection;
mod flux;
mod insulated;
mod temperature;

pub use contract::SceneHeat;
pub(crate) use contract::{HeatCondition, ThermalFace, ThermalKeys};
pub(crate) use insulated::{Insulated, PeriodicTemperature};

use super::conditions;

conditions! {
    /// Thermal condition on a face; a face that is not named is insulated.
    ThermalSpec: ThermalKeys;
    /// No heat flows through the face.
    Insulated = "insulated" is insulated::Insulated;
    /// Prescribed temperature (K).
    Temperature = "temperature" of temperature::TemperatureSpec;
    /// Prescribed heat flux into the body (W/m^(D-1)).
    Flux = "flux" of flux::FluxSpec;
    /// Heat flux proportional to the difference from the ambient temperature.
    Convection = "convection" of convection::ConvectionSpec;
}
