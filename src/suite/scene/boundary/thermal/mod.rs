//! Family of thermal conditions on the faces of a heat-conducting body. A new member needs one
//! file, its `mod` line and one line below.

mod contract;
mod convection;
mod flux;
mod insulated;
mod temperature;

pub use contract::SceneHeat;
pub(crate) use contract::{HeatCondition, ThermalFace, ThermalKeys, build};
pub(crate) use insulated::{Insulated, PeriodicTemperature};

use super::conditions;

conditions! {
    /// Thermal condition on a face; a face that is not named is insulated.
    ThermalSpec: ThermalKeys;
    /// No heat flows.
    Insulated = "insulated" is insulated::Insulated;
    /// The temperature (K).
    Temperature = "temperature" of temperature::TemperatureSpec;
    /// Heat that enters (W/m^(D-1)).
    Flux = "flux" of flux::FluxSpec;
    /// Heat that enters in proportion to a difference of temperatures.
    Convection = "convection" of convection::ConvectionSpec;
}
