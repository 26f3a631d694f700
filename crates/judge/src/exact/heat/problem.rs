//! Heat problem of an exact temperature: body, conditions on faces, and heat source.

use super::field::{Temperature, TemperatureDerivatives, divergence, slope};
use crate::exact::formula::Formula;
use crate::exact::motion::{Derivatives, Motion, Places, variables};
use crate::exact::truth::Truth;
use crate::exact::violation::Violation;
use std::fmt::Debug;
use std::sync::Arc;

/// One face of a box-shaped body.
#[derive(Debug, Clone)]
pub struct HeatFace {
    /// Name of the face in suites.
    pub name: &'static str,
    /// Axis of the face normal.
    pub axis: usize,
    /// Whether this is the face with the larger coordinate.
    pub high: bool,
    /// Thermal condition on the face.
    pub condition: Arc<dyn ThermalCondition>,
}

/// A problem of heat in a box, `rho0 c T_t = Div (k J C^-1 Grad T) + rho0 s`, and its solution.
#[derive(Debug, Clone)]
pub struct Conduction {
    /// Lowest corner of the body (m).
    pub from: Vec<f64>,
    /// Highest corner of the body (m).
    pub to: Vec<f64>,
    /// Reference density (kg/m3).
    pub density: f64,
    /// Conductivity k (W m^(2-D)/K).
    pub conductivity: f64,
    /// Heat capacity c (J/(kg K)).
    pub capacity: f64,
    /// Heat source (W/kg), a formula that [`source_at`] evaluates.
    pub source: Option<Formula>,
    /// Initial temperature (K), a formula of the coordinates; `None` for the exact temperature.
    pub initial: Option<Formula>,
    /// All faces of the body.
    pub faces: Vec<HeatFace>,
    /// The temperature that [`Conduction::check`] verifies.
    pub temperature: Temperature,
    /// Deformation of the body; `None` if the body is at rest or strains are neglected.
    pub motion: Option<Motion>,
    /// Whether the source is derived from the exact temperature; `source` is then `None`.
    pub manufactured: bool,
    /// End of the run (s).
    pub until: f64,
    /// Maximum residual of a condition, relative to its terms.
    pub tolerance: f64,
}

impl Conduction {
    /// Returns the number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.from.len()
    }

    pub(super) fn now(&self, label: &[f64], t: f64) -> (Derivatives, TemperatureDerivatives) {
        let still = Derivatives::default;
        let motion = self.motion.as_ref().map_or_else(still, |motion| motion.derivatives(label, t));
        (motion, self.temperature.derivatives(label, t))
    }

    /// Computes the source (W/kg) of the temperature, `c T_t - Div (k J C^-1 Grad T)/rho0`.
    pub(super) fn balance(&self, motion: &Derivatives, now: &TemperatureDerivatives) -> f64 {
        self.capacity * now.rate
            - self.conductivity * divergence(self.dimension(), motion, now) / self.density
    }

    /// Computes the manufactured source (W/kg) of the exact temperature.
    pub fn manufactured_source(&self, label: &[f64], t: f64) -> f64 {
        let (motion, now) = self.now(label, t);
        self.balance(&motion, &now)
    }

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

    /// Computes minus the heat flow per reference area, `k J C^-1 Grad T` (W/m^(D-1)).
    pub(super) fn inflow(&self, motion: &Derivatives, now: &TemperatureDerivatives) -> [f64; 3] {
        slope(motion, now).map(|slope| self.conductivity * slope)
    }
}

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

/// A thermal condition on one face of the body, checked pointwise.
pub trait ThermalCondition: Debug + Send + Sync {
    /// Checks the temperature at `point`.
    ///
    /// # Errors
    /// The first violation of the condition.
    fn check(&self, point: &dyn HeatFacePoint) -> Result<(), Violation>;
}

/// A point of a face at one time, with the elementary requirements on the temperature.
pub trait HeatFacePoint {
    /// Evaluates a formula of the coordinates and t at this point and time.
    fn value(&self, formula: &Formula) -> f64;

    /// Returns the temperature (K).
    fn temperature(&self) -> f64;

    /// Returns the largest temperature in the body (K).
    fn largest_temperature(&self) -> f64;

    /// Requires `T = given` (K).
    ///
    /// # Errors
    /// If the temperature differs.
    fn has_temperature(&self, given: f64) -> Result<(), Violation>;

    /// Requires that the heat inflow per reference area (W/m^(D-1)) is `given`. `what` describes
    /// the face in messages; `size` is the scale of the terms in `given`.
    ///
    /// # Errors
    /// If the heat inflow differs.
    fn lets_in(&self, what: &str, given: f64, size: f64) -> Result<(), Violation>;

    /// Requires that temperature and heat flux equal those on the opposite face.
    ///
    /// # Errors
    /// The first violation.
    fn continues_on_opposite_face(&self) -> Result<(), Violation>;
}

/// Evaluates the heat source (W/kg), a formula of the coordinates (m), t (s) and optionally T (K).
pub fn source_at(formula: &Formula, label: &[f64], t: f64, temperature: f64) -> f64 {
    let mut all = [0.0; 5];
    all[..4].copy_from_slice(&variables(label, t));
    all[label.len() + 1] = temperature;
    formula.eval(&all[..formula.variables()])
}

/// The manufactured heat source at fixed positions.
pub struct HeatForcing {
    problem: Conduction,
    warm: Box<dyn Places>,
    motion: Option<Box<dyn Places>>,
}

impl HeatForcing {
    /// Prepares the source of `problem` at the reference positions `labels` (m).
    pub fn new<'a>(problem: &Conduction, labels: impl Iterator<Item = &'a [f64]>) -> Self {
        Self::at_labels(problem, &labels.collect::<Vec<_>>())
    }

    // Not generic, so the evaluation is compiled only in this package.
    fn at_labels(problem: &Conduction, labels: &[&[f64]]) -> Self {
        Self {
            warm: problem.temperature.at_places(labels),
            motion: problem.motion.as_ref().map(|motion| motion.at_places(labels)),
            problem: problem.clone(),
        }
    }

    /// Writes [`Conduction::manufactured_source`] (W/kg) at each position and time `t` (s). Does
    /// not allocate.
    pub fn at(&mut self, t: f64, into: &mut [f64]) {
        self.warm.set_time(t);
        if let Some(motion) = &mut self.motion {
            motion.set_time(t);
        }
        let [mut moved, mut now] = [Derivatives::default(); 2];
        for (place, source) in into.iter_mut().enumerate() {
            if let Some(motion) = &mut self.motion {
                motion.derivatives(place, &mut moved);
            }
            self.warm.derivatives(place, &mut now);
            *source = self.problem.balance(&moved, &now.into());
        }
    }
}
