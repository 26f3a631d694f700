//! Conditions and laws outside the scope of the FEM bar, refused before anything runs.

use crate::fem::BarLaw;
use crate::suite::compile::run::bar_law;
use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::{ConvergenceSpec, EquationName, MethodSpec};
use crate::suite::model::Scene;
use crate::suite::yaml::{Diagnostic, Path};

/// Refuses conditions that the bar does not know, if the suite asks for one.
pub(crate) fn refuse_conditions_unknown_to_fem(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    if !spec.has_fem_reference() && spec.fem_method().is_none() {
        return Ok(());
    }
    let path = Path::top("scene");
    let help = "remove the FEM, also as `reference`, or the condition";
    for face in &scene.faces {
        if face.hold.is_lacked_by_fem() {
            let message = format!(
                "the {} face {}, and the FEM knows fixed and free ends only",
                face.name,
                face.hold.verb()
            );
            let at = path.then("boundary").then(face.name);
            return Err(evaluator.diagnostic(&at, &message).with_help(help));
        }
    }
    if !scene.initial_stress.is_none() {
        let at = path.then("initial_stress");
        let message = "an initial stress, which the FEM does not have";
        return Err(evaluator.diagnostic_at_key(&at, message).with_help(help));
    }
    if let Some(set) = scene.driven_set() {
        let message = format!("the set `{set}` is driven, which the FEM cannot do");
        let at = path.then("sets").then(set);
        return Err(evaluator.diagnostic_at_key(&at, &message).with_help(help));
    }
    Ok(())
}

/// Refuses an FEM bar, a method or the reference, of a material that it has no law for.
pub(crate) fn refuse_law_unknown_to_fem(
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
        if law.is_none() && bar_law::own(&scene.material).is_none() {
            let diagnostic =
                evaluator.diagnostic(&path, &format!("the reference FEM has no `{name}`"));
            return Err(diagnostic.with_help("name the `law` of an elastic bar to compare with"));
        }
    }
    Ok(())
}
