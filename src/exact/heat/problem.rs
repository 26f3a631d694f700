//! The heat problem that a temperature is held to.

use super::condition::ThermalCondition;
use super::equation::{divergence, slope};
use super::field::{Temperature, TemperatureDerivatives};
use super::source::source_at;
use crate::exact::formula::Formula;
use crate::exact::motion::{Derivatives, Motion};
use crate::exact::truth::Truth;
use std::sync::Arc;

/// One face of a box-shaped body.
#[derive(Debug, Clone)]
pub struct HeatFace {
    /// Name that a suite gives it.
    pub name: &'static str,
    /// Axis of its normal.
    pub axis: usize,
    /// Whether it is the face with the larger coordinate.
    pub high: bool,
    /// Its condition.
    pub condition: Arc<dyn ThermalCondition>,
}

/// An initial-boundary-value problem of heat in a box, `rho0 c T_t = Div (k J C^-1 Grad T) + rho0
/// s`, with the temperature that claims to solve it.
#[derive(Debug, Clone)]
pub struct Conduction {
    /// Lowest corner of the body (m).
    pub from: Vec<f64>,
    /// Highest corner (m).
    pub to: Vec<f64>,
    /// Reference density (kg/m3).
    pub density: f64,
    /// k (W/(m K), per m^(3-D)).
    pub conductivity: f64,
    /// c (J/(kg K)).
    pub capacity: f64,
    /// Heat that arises, per unit mass (W/kg), a formula for [`source_at`].
    pub source: Option<Formula>,
    /// Initial temperature (K), a formula of the coordinates; not stated, it is that of the claim.
    pub initial: Option<Formula>,
    /// Every face of the body.
    pub faces: Vec<HeatFace>,
    /// The claimed solution.
    pub temperature: Temperature,
    /// How the body deforms; none where it is at rest, or strains count as none.
    pub motion: Option<Motion>,
    /// Whether the source is the one that makes the temperature a solution; none is stated then.
    pub manufactured: bool,
    /// End of the run (s).
    pub until: f64,
    /// Largest residual that passes, relative to the terms of the condition.
    pub tolerance: f64,
}

impl Conduction {
    /// Number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.from.len()
    }

    /// The motion and the temperature at one point and time.
    pub(super) fn now(&self, label: &[f64], t: f64) -> (Derivatives, TemperatureDerivatives) {
        let still = Derivatives::default;
        let motion = self.motion.as_ref().map_or_else(still, |motion| motion.derivatives(label, t));
        (motion, self.temperature.derivatives(label, t))
    }

    /// The source that the temperature needs, `c T_t - Div (k J C^-1 Grad T)/rho0` (W/kg).
    pub(super) fn balance(&self, motion: &Derivatives, now: &TemperatureDerivatives) -> f64 {
        self.capacity * now.rate
            - self.conductivity * divergence(self.dimension(), motion, now) / self.density
    }

    /// The manufactured source (W/kg): what the temperature needs.
    pub fn manufactured_source(&self, label: &[f64], t: f64) -> f64 {
        let (motion, now) = self.now(label, t);
        self.balance(&motion, &now)
    }

    /// The source of the problem (W/kg), manufactured or stated.
    pub(super) fn source(
        &self,
        label: &[f64],
        t: f64,
        motion: &Derivatives,
        now: &TemperatureDerivatives,
    ) -> f64 {
        if self.manufactured {
            return self.balance(motion, now);
        }
        self.source.as_ref().map_or(0.0, |source| source_at(source, label, t, now.value))
    }

    /// `k J C^-1 Grad T` (W/m^(D-1)): minus the flow per reference area.
    pub(super) fn inflow(&self, motion: &Derivatives, now: &TemperatureDerivatives) -> [f64; 3] {
        slope(motion, now).map(|slope| self.conductivity * slope)
    }
}

/// The temperature; and displacements, which are zero where the body is at rest.
impl Truth for Conduction {
    fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]) {
        match &self.motion {
            Some(motion) => motion.displacement(label, t, into),
            None => into.fill(0.0),
        }
    }

    fn velocity(&self, label: &[f64], t: f64, into: &mut [f64]) {
        match &self.motion {
            Some(motion) => motion.velocity(label, t, into),
            None => into.fill(0.0),
        }
    }

    fn temperature(&self, label: &[f64], t: f64) -> Option<f64> {
        Some(self.temperature.at(label, t))
    }
}
