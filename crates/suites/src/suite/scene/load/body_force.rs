//! A stated force per unit mass, which may depend on position, time and displacement.

use super::contract::{BodySite, SceneLoad};
use super::entry::{LoadEntry, LoadKeys};
use crate::exact::Term;
use crate::exact::formula::{Expr, Formula, FormulaForce};
use crate::mpm::input::{EffectInput, ForceAt};
use crate::suite::evaluator::{DISPLACEMENTS, coordinates_and_time};
use crate::suite::scene::numbers::{LoadNumbers, value_with_unit};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Force per unit mass (m/s2), formulas of the coordinates, t and the displacement.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub(crate) struct BodyForceSpec(Vec<NumberText>);

impl LoadKeys for BodyForceSpec {
    fn example(vector: &str) -> String {
        vector.to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        entry.refuse_second("a body force")?;
        let (path, d) = (&entry.path, entry.dimension());
        let u = &DISPLACEMENTS[..d];
        let names_it = |expr: Expr| expr.names().iter().any(|(name, _)| u.contains(&name.as_str()));
        let is_of_u = |text: &NumberText| Expr::parse(&text.to_string()).is_ok_and(names_it);
        let with_u = [&coordinates_and_time(d)[..], u].concat();
        let is_displaced = self.0.iter().any(is_of_u);
        let variables = if is_displaced { &with_u[..] } else { &with_u[..=d] };
        Ok(Arc::new(BodyForceLoad(path.vector(&self.0, d, variables)?)))
    }
}

/// Force per unit mass (m/s2): formulas of the coordinates, t and optionally the displacement.
#[derive(Debug)]
struct BodyForceLoad(Vec<Formula>);

/// A force given by formulas, with the particle positions once they are known.
struct FormulaField {
    formulas: Vec<Formula>,
    force: Option<FormulaForce>,
}

impl ForceAt for FormulaField {
    fn prepare(&mut self, labels: &[&[f64]]) {
        self.force = Some(FormulaForce::new(&self.formulas, labels));
    }

    fn stiffness(&self, u: &dyn Fn(usize) -> [f64; 3]) -> f64 {
        self.force.as_ref().map_or(0.0, |force| force.stiffness(u))
    }

    fn write(&mut self, t: f64, u: &dyn Fn(usize) -> [f64; 3], into: &mut [[f64; 3]]) {
        if let Some(force) = &mut self.force {
            force.write(t, u, into);
        }
    }
}

impl Term for BodyForceLoad {
    fn stated(&self, i: usize, label: &[f64], t: f64, u: &[f64; 3]) -> f64 {
        self.0.get(i).map_or(0.0, |formula| formula.at_displaced(label, t, u))
    }

    fn depends_on_displacement(&self) -> bool {
        let place_and_time = self.0.len() + 1;
        self.0.iter().any(|formula| formula.variables() > place_and_time)
    }

    fn is_body_force(&self) -> bool {
        true
    }
}

impl SceneLoad for BodyForceLoad {
    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::vector("acceleration", &self.0)
    }

    fn rows(&self) -> Vec<(String, String)> {
        vec![("body force".to_owned(), value_with_unit(&self.0, "m/s2"))]
    }

    fn input(&self, _: &BodySite<'_>) -> EffectInput {
        EffectInput::BodyForce(Box::new(FormulaField { formulas: self.0.clone(), force: None }))
    }
}
