//! Laws of the truth and of the reference FEM for a material.

use crate::exact::Equation;
use crate::fem::BarLaw;
use crate::mpm::MaterialPlan;
use crate::suite::compile::evaluator::Evaluator;
use crate::suite::compile::path::Path;
use crate::suite::grammar::{ConvergenceSpec, EquationName, MethodSpec};
use crate::suite::model::Scene;
use crate::suite::yaml::Diagnostic;

/// Name of the law of an FEM bar of this material, if the FEM has it.
pub(crate) fn own(material: &MaterialPlan) -> Option<EquationName> {
    let name = equation(material)?.name();
    BarLaw::find(name).and(EquationName::find(name))
}

/// The equation of motion of a body of this material, for which motions the truth has it: J2 where
/// loading never reverses, a fluid at rest. Material and law are one by the material's name.
pub(crate) fn equation(material: &MaterialPlan) -> Option<Equation> {
    Equation::of_material(material.name(), |key| material.parameter(key))
}

/// The equation that forces are manufactured with, or why there is none.
pub(crate) fn manufactured(material: &MaterialPlan) -> Result<Equation, &'static str> {
    material.properties().depends_on_deformation_alone()?;
    equation(material).ok_or("the law has no equation")
}

/// Refuses an FEM bar, a method or the reference, of a material that it has no law for.
pub(crate) fn refuse_unknown_to_fem(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    let name = scene.material.name();
    let elastic = scene.material.elasticity().is_some();
    let of_fluid = || format!("the reference FEM is a solid bar, `{name}` has no Young's modulus");
    if spec.has_fem_reference() && !elastic {
        return Err(evaluator.diagnostic_at_key(&Path::top("reference"), &of_fluid()));
    }
    let foreign = |law: EquationName| {
        let known = BarLaw::find(law.name()).is_some();
        (!known).then(|| format!("the reference FEM has no `{}`", law.name()))
    };
    let reference = spec.reference.as_ref().and_then(|reference| reference.equation);
    if let Some(message) = reference.and_then(foreign) {
        return Err(evaluator.diagnostic(&Path::top("reference").then("equation"), &message));
    }
    for (i, method) in spec.methods.iter().enumerate() {
        let MethodSpec::Fem { law, .. } = method else { continue };
        let path = Path::top("methods").then(i);
        if !elastic {
            return Err(evaluator.diagnostic(&path, &of_fluid()));
        }
        let laws = law.as_ref().map_or(&[][..], |laws| laws.as_slice());
        if let Some(message) = laws.iter().copied().find_map(foreign) {
            return Err(evaluator.diagnostic(&path, &message));
        }
        if law.is_none() && own(&scene.material).is_none() {
            let diagnostic =
                evaluator.diagnostic(&path, &format!("the reference FEM has no `{name}`"));
            return Err(diagnostic.with_help("name the `law` of an elastic bar to compare with"));
        }
    }
    Ok(())
}
