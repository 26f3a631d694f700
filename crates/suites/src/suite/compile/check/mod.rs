//! Checks that involve several keys.

pub(crate) mod levels;
pub(crate) mod load_steps;
pub(crate) mod sums;

use crate::fem::BarLaw;
use crate::subject::PlaneState;
use crate::suite::compile::run::methods::law_of_bar;
use crate::suite::compile::study::CompiledStudy;
use crate::suite::compile::truth;
use crate::suite::grammar::{EquationName, MethodSpec};
use crate::suite::model::Scene;
use crate::suite::scene::load::{LoadEntry, StudyFacts};
use crate::suite::yaml::Diagnostic;

type CrossCheck = fn(&CompiledStudy<'_>) -> Result<(), Diagnostic>;

/// Checks that run before the expectations are compiled, in this order.
const CROSS_CHECKS: [CrossCheck; 7] = [
    refuse_conditions_unknown_to_fem,
    refuse_law_unknown_to_fem,
    refuse_foreign,
    refuse_quantity_unknown_to_fem,
    refuse_unknown_stress,
    truth::refuse_unfit,
    levels::refuse_unfit,
];

pub(crate) fn refuse_contradictions(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    CROSS_CHECKS.iter().try_for_each(|check| check(study))
}

fn refuse_conditions_unknown_to_fem(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let CompiledStudy { evaluator, spec, plan, .. } = study;
    let scene = &plan.scene;
    if !spec.has_fem_reference() && spec.fem_method().is_none() {
        return Ok(());
    }
    let path = evaluator.top("scene");
    let help = "remove the FEM (also as `reference`), or the condition";
    for face in &scene.faces {
        if face.hold.kind().is_lacked_by_fem {
            let message = format!(
                "the {} face {}, but the built-in FEM supports only fixed and free ends",
                face.name,
                face.hold.kind().verb
            );
            let at = path.then("boundary").then(face.name);
            return at.refuse(&message, help);
        }
    }
    if !scene.initial_stress.is_none() {
        let at = path.then("initial_stress");
        return at.refuse_key("the built-in FEM does not support an initial stress", help);
    }
    if let Some(set) = scene.driven_set() {
        let message = format!(
            "the set `{set}` has a given velocity, which the built-in FEM does not support"
        );
        let at = path.then("sets").then(set);
        return at.refuse_key(&message, help);
    }
    Ok(())
}

fn refuse_law_unknown_to_fem(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let CompiledStudy { evaluator, spec, plan, .. } = study;
    let scene = &plan.scene;
    let name = scene.material.name();
    let elastic = scene.material.elasticity().is_some();
    let of_fluid =
        || format!("the built-in FEM is a solid bar, but `{name}` has no Young's modulus");
    if spec.has_fem_reference() && !elastic {
        return Err(evaluator.top("reference").diagnostic_at_key(&of_fluid()));
    }
    let foreign = |law: EquationName| {
        let known = BarLaw::find(law.name()).is_some();
        (!known).then(|| format!("the built-in FEM does not support the law `{}`", law.name()))
    };
    let reference = spec.reference.as_ref().and_then(|reference| reference.equation);
    if let Some(message) = reference.and_then(foreign) {
        return Err(evaluator.top("reference.equation").diagnostic(&message));
    }
    for (i, method) in spec.methods.iter().enumerate() {
        let MethodSpec::Fem { law, .. } = method else { continue };
        let path = evaluator.top("methods").then(i);
        if !elastic {
            return Err(path.diagnostic(&of_fluid()));
        }
        let laws = law.as_ref().map_or(&[][..], |laws| laws.as_slice());
        if let Some(message) = laws.iter().copied().find_map(foreign) {
            return Err(path.diagnostic(&message));
        }
        if law.is_none() && law_of_bar(&scene.material).is_none() {
            let diagnostic =
                path.diagnostic(&format!("the built-in FEM does not support the law `{name}`"));
            return Err(diagnostic.with_help("name the `law` of an elastic bar to compare with"));
        }
    }
    Ok(())
}

/// Refuses loads that are not allowed in this study, and the FEM bar if it lacks a load.
fn refuse_foreign(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let CompiledStudy { evaluator, spec, plan, .. } = study;
    let until = plan.cases.iter().map(|case| case.until).fold(0.0, f64::max);
    let facts = StudyFacts { manufactured: spec.manufactured.is_some(), until };
    let scene = &plan.scene;
    for (i, load) in spec.scene.loads.iter().enumerate() {
        let entry = LoadEntry { effect: load.effect(), path: load.path(evaluator, i), scene };
        load.keys().check(&entry, &facts)?;
        let Some(lacked) = load.keys().lacked_by_fem() else { continue };
        let message = format!("the built-in FEM does not support {lacked}");
        if spec.has_fem_reference() {
            return Err(evaluator.top("reference").diagnostic_at_key(&message));
        }
        if let Some(i) = spec.fem_method() {
            return Err(evaluator.top("methods").then(i).diagnostic(&message));
        }
    }
    Ok(())
}

fn refuse_quantity_unknown_to_fem(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let CompiledStudy { evaluator, spec, plan, .. } = study;
    if !plan.of.is_optional() {
        return Ok(());
    }
    let name = plan.of.words();
    let help = "judge the displacement or the velocity";
    if plan.reference.is_some() || plan.same_method.is_some() {
        let message = format!("a reference does not provide the {name} that this suite judges");
        return evaluator.top("reference").refuse_key(&message, help);
    }
    match spec.fem_method() {
        Some(i) => {
            let message =
                format!("the built-in FEM does not provide the {name} that this suite judges");
            evaluator.top("methods").then(i).refuse(&message, help)
        }
        None => Ok(()),
    }
}

fn refuse_unknown_stress(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let CompiledStudy { evaluator, plan, .. } = study;
    let (of, d, scene) = (plan.of, plan.scene.dimension(), &plan.scene);
    let needs_across = of.needs_stress_across();
    let axis = of.name().strip_prefix("stress_").and_then(|axes| axes.bytes().last());
    let is_beyond = axis.is_some_and(|axis| usize::from(axis - b'x') >= d) && !needs_across;
    let is_plane = d == 2 && needs_across && scene.plane == PlaneState::Strain;
    let computes = |own: &Scene| own.material.properties().has_stress_across();
    let lacking = scene.each().iter().find(|own| !computes(own));
    let is_averaged = plan.cases.iter().any(|case| case.method.averages_volume());
    let law = lacking.map_or("", |own| own.material.name());
    let absent = format!("there is no {} in {d}-D", of.words());
    let of_law = format!("the out-of-plane stress of `{law}` in plane strain is not computed");
    let of_average = "the out-of-plane stress of averaged volume ratios is not computed";
    let entries = [
        (is_beyond || (d == 1 && needs_across), "judge.of", absent.as_str()),
        (is_plane && lacking.is_some(), "judge.of", &of_law),
        (is_plane && is_averaged, "judge.of", of_average),
    ];
    let help = "judge the `stress`, or use a scene with more dimensions";
    evaluator.refuse_first(&entries, |path, text| path.diagnostic(text).with_help(help))
}
