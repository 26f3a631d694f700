//! Gravity: a uniform acceleration, constant or a function of time.

use super::contract::{BodySite, SceneLoad};
use super::entry::{LoadEntry, LoadKeys};
use crate::exact::Term;
use crate::exact::formula::Formula;
use crate::mpm::input::EffectInput;
use crate::suite::scene::numbers::{LoadNumbers, of_time, value_with_unit};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Uniform acceleration (m/s2), formulas of t.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub(crate) struct GravitySpec(Vec<NumberText>);

impl LoadKeys for GravitySpec {
    fn example(vector: &str) -> String {
        vector.to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        entry.refuse_second("gravity")?;
        Ok(Arc::new(GravityLoad(entry.path.vector(&self.0, entry.dimension(), &["t"])?)))
    }
}

#[derive(Debug)]
struct GravityLoad(Vec<Formula>);

impl Term for GravityLoad {
    fn stated(&self, i: usize, _: &[f64], t: f64, _: &[f64; 3]) -> f64 {
        self.0.get(i).map_or(0.0, |formula| formula.eval(&[t]))
    }

    fn is_uniform(&self) -> bool {
        true
    }

    fn is_constant(&self) -> bool {
        self.0.iter().all(|formula| formula.constant().is_some())
    }
}

impl SceneLoad for GravityLoad {
    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::vector("acceleration", &self.0)
    }

    fn rows(&self) -> Vec<(String, String)> {
        vec![("gravity".to_owned(), value_with_unit(&self.0, "m/s2"))]
    }

    fn input(&self, _: &BodySite<'_>) -> EffectInput {
        EffectInput::Gravity(of_time(&self.0))
    }
}
