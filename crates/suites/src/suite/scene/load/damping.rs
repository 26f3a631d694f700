//! Mass-proportional damping: velocities decay at a given rate.

use super::contract::{BodySite, SceneLoad};
use super::entry::{LoadEntry, LoadKeys, StudyFacts};
use crate::exact::Term;
use crate::exact::formula::Formula;
use crate::mpm::Damping;
use crate::mpm::input::EffectInput;
use crate::suite::evaluator::shown;
use crate::suite::scene::numbers::{LoadNumbers, with_unit};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Number of times during a run at which the sign of the rate is checked.
const TIMES: u32 = 1000;

/// Rate (1/s) at which velocities decay: a formula of t.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub(crate) struct DampingSpec(NumberText);

impl LoadKeys for DampingSpec {
    fn example(_: &str) -> String {
        "s*(1 + t)".to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        entry.refuse_second("damping")?;
        Ok(Arc::new(DampingLoad(entry.path.formula(&self.0, &["t"])?)))
    }

    fn check(&self, entry: &LoadEntry<'_>, study: &StudyFacts) -> Result<(), Diagnostic> {
        let rate = entry.path.formula(&self.0, &["t"])?;
        for k in 0..=TIMES {
            let t = study.until * f64::from(k) / f64::from(TIMES);
            let alpha = rate.eval(&[t]);
            if !(alpha >= 0.0 && alpha.is_finite()) {
                let message =
                    format!("the rate of damping is {} at t = {}", shown(alpha), shown(t));
                let label = "expected zero or a positive number (1/s)";
                return Err(entry.path.diagnostic(&message).with_label(label));
            }
        }
        Ok(())
    }

    fn lacked_by_fem(&self) -> Option<&'static str> {
        Some("damping")
    }
}

/// Damping with the rate alpha(t) (1/s).
#[derive(Debug)]
struct DampingLoad(Formula);

/// Adds the term `-alpha u_t` to the equation of motion.
impl Term for DampingLoad {
    fn resistance(&self, t: f64, velocity: f64, _: &dyn Fn() -> f64) -> f64 {
        -self.0.eval(&[t]) * velocity
    }
}

impl SceneLoad for DampingLoad {
    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::scalar("rate", &self.0)
    }

    fn rows(&self) -> Vec<(String, String)> {
        vec![("damping".to_owned(), with_unit(self.0.source(), "1/s"))]
    }

    fn input(&self, _: &BodySite<'_>) -> EffectInput {
        let rate = self.0.clone();
        EffectInput::Damping(Damping(Box::new(move |t| rate.eval(&[t]))))
    }
}
