//! Thermal expansion: strain due to temperature.

use super::contract::{BodySite, SceneLoad};
use super::entry::{LoadEntry, LoadKeys};
use crate::exact::{Expansion, Term};
use crate::mpm::input::EffectInput;
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Coefficients of the expansion.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ExpansionSpec {
    /// Coefficient of thermal expansion (1/K).
    coefficient: NumberText,
    /// Temperature (K) at which the undeformed body is stress-free.
    reference: NumberText,
}

impl LoadKeys for ExpansionSpec {
    fn example(_: &str) -> String {
        "{coefficient: 0.1, reference: 0}".to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        let path = &entry.path;
        if entry.scene.lists(entry.effect) {
            return Err(path.diagnostic_at_key("thermal expansion appears twice"));
        }
        if !entry.scene.initial_stress.is_none() {
            let message = "`thermal_expansion` is not supported with an initial stress, which \
                           could be that before or after the expansion";
            return Err(path.diagnostic_at_key(message));
        }
        let rate_form = rate_form(entry)?;
        let at = path.then("coefficient");
        let coefficient = at.positive(&self.coefficient, "the coefficient")?;
        let reference = path.then("reference").number(&self.reference)?;
        Ok(Arc::new(ExpansionLoad(Expansion { coefficient, reference }, rate_form)))
    }

    fn is_of_one_body(&self) -> bool {
        true
    }
}

/// Returns Young's modulus (Pa) and Poisson's ratio for a law in rate form, otherwise `None`.
/// Refuses a material without thermal stress.
fn rate_form(entry: &LoadEntry<'_>) -> Result<Option<(f64, f64)>, Diagnostic> {
    let LoadEntry { path, scene, .. } = entry;
    let (name, d) = (scene.material.name(), scene.dimension());
    let law = scene.material.properties();
    if !law.is_elastic() {
        let message = format!("`thermal_expansion` does not support the law `{name}`");
        return path.refuse_key(&message, "materials: `linear_elastic`, `neo_hookean`, `hencky`");
    }
    let elasticity = scene.material.elasticity();
    if law.depends_on_deformation_alone().is_err() {
        return Ok(elasticity);
    }
    let poisson = elasticity.map_or(0.0, |(_, poisson)| poisson);
    if d < 3 && poisson != 0.0 {
        let message = format!(
            "in {d}-D `thermal_expansion` of a `{name}` body needs a Poisson's ratio of 0, not \
             {poisson}: the body cannot expand along the other axes"
        );
        return path.refuse_key(&message, "set `poisson: 0`, choose `linear_elastic`, or use 3-D");
    }
    Ok(None)
}

/// The expansion, with Young's modulus (Pa) and Poisson's ratio for a law in rate form.
#[derive(Debug)]
struct ExpansionLoad(Expansion, Option<(f64, f64)>);

impl Term for ExpansionLoad {
    fn expansion(&self) -> Option<Expansion> {
        Some(self.0)
    }
}

impl SceneLoad for ExpansionLoad {
    fn rows(&self) -> Vec<(String, String)> {
        let Expansion { coefficient, reference } = self.0;
        let text = format!("coefficient {coefficient} per K, zero strain at {reference} K");
        vec![("thermal expansion".to_owned(), text)]
    }

    fn disturbs_rest(&self) -> bool {
        false
    }

    fn input(&self, _: &BodySite<'_>) -> EffectInput {
        let Self(Expansion { coefficient, reference }, rate_form) = *self;
        EffectInput::ThermalExpansion { coefficient, reference, rate_form }
    }
}
