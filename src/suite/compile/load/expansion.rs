//! Thermal expansion, from words to the solver.

use crate::{
    exact::Expansion,
    mpm::ThermalExpansion,
    suite::{
        compile::{evaluator::Evaluator, path::Path},
        grammar::ExpansionSpec,
        model::Scene,
        yaml::Diagnostic,
    },
};

/// The expansion that `words` at `path` give to a scene.
pub(crate) fn expansion(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &ExpansionSpec,
    scene: &Scene,
) -> Result<Expansion, Diagnostic> {
    if scene.expansion.is_some() {
        return Err(evaluator.diagnostic_at_key(path, "thermal expansion appears twice"));
    }
    let name = scene.material.name();
    let law = scene.material.properties();
    if !law.is_elastic() {
        let message = format!("the stress of a heated `{name}` body is not known");
        let diagnostic = evaluator.diagnostic_at_key(path, &message);
        return Err(diagnostic.with_help("materials: `linear_elastic`, `neo_hookean`, `hencky`"));
    }
    let split = law.depends_on_deformation_alone().is_ok();
    let poisson = scene.material.elasticity().map_or(0.0, |(_, poisson)| poisson);
    let d = scene.dimension();
    if split && d < 3 && poisson != 0.0 {
        let message = format!(
            "in {d}-D a heated `{name}` body would be held along the axes that are left out, and its \
             Poisson's ratio is {poisson}"
        );
        let diagnostic = evaluator.diagnostic_at_key(path, &message);
        return Err(diagnostic.with_help("set `poisson: 0`, choose `linear_elastic`, or use 3-D"));
    }
    let coefficient = path.then("coefficient");
    Ok(Expansion {
        coefficient: evaluator.positive(&coefficient, &words.coefficient, "the coefficient")?,
        reference: evaluator.number(&path.then("reference"), &words.reference)?,
    })
}

/// The effect of a scene that lists it.
pub(crate) fn effect<const D: usize>(scene: &Scene) -> Option<ThermalExpansion<D>> {
    let Expansion { coefficient, reference } = scene.expansion?;
    if scene.material.properties().depends_on_deformation_alone().is_ok() {
        return Some(ThermalExpansion::of_deformation(coefficient, reference));
    }
    let elasticity = scene.material.elasticity()?;
    Some(ThermalExpansion::in_rate_form(coefficient, reference, elasticity))
}
