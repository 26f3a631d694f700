//! What the truth and the reference FEM know of a material.

use crate::{
    exact::Equation,
    mpm::MaterialPlan,
    suite::{
        compile::{evaluator::Evaluator, path::Path},
        grammar::{ConvergenceSpec, EquationName, MethodSpec},
        model::Scene,
        yaml::Diagnostic,
    },
};

/// The law of an FEM bar of this material, if the FEM has it.
pub(crate) fn own(material: &MaterialPlan) -> Option<EquationName> {
    match material {
        MaterialPlan::LinearElastic { .. } => Some(EquationName::SmallStrain),
        MaterialPlan::NeoHookean { .. } => Some(EquationName::NeoHookean),
        MaterialPlan::Hencky { .. } => Some(EquationName::Hencky),
        MaterialPlan::J2 { .. } | MaterialPlan::Newtonian { .. } | MaterialPlan::Rigid {} => None,
    }
}

/// What suites call the equation of motion of a body of this material.
pub(crate) fn named(material: &MaterialPlan) -> Option<EquationName> {
    Some(match material {
        MaterialPlan::J2 { .. } => EquationName::J2,
        MaterialPlan::Newtonian { .. } => EquationName::Tait,
        MaterialPlan::LinearElastic { .. } => EquationName::SmallStrain,
        MaterialPlan::NeoHookean { .. } => EquationName::NeoHookean,
        MaterialPlan::Hencky { .. } => EquationName::Hencky,
        MaterialPlan::Rigid {} => return None,
    })
}

/// The equation of motion of a body of this material, for which motions the truth has it: J2 where
/// loading never reverses, a fluid at rest.
pub(crate) fn equation(material: &MaterialPlan) -> Option<Equation> {
    Some(match *material {
        MaterialPlan::LinearElastic { young, poisson } => Equation::small_strain(young, poisson),
        MaterialPlan::NeoHookean { young, poisson } => Equation::neo_hookean(young, poisson),
        MaterialPlan::Hencky { young, poisson } => Equation::hencky(young, poisson),
        MaterialPlan::J2 { young, poisson, r#yield, hardening } => {
            Equation::j2(young, poisson, r#yield, hardening)
        }
        MaterialPlan::Newtonian { bulk, .. } => Equation::tait(bulk),
        MaterialPlan::Rigid {} => return None,
    })
}

/// The equation that a motion of the scene, or its state `at_rest`, is checked against; or why there
/// is none, and what to do.
pub(crate) fn solvable(
    scene: &Scene,
    at_rest: bool,
) -> Result<Equation, (&'static str, &'static str)> {
    match scene.material {
        MaterialPlan::J2 { .. } if scene.dimension() > 1 => Err((
            "what has flowed is a function of the deformation in uniaxial strain only",
            "make it a scene of dimension 1",
        )),
        MaterialPlan::Newtonian { viscosity, .. } if !at_rest && viscosity > 0.0 => Err((
            "the stress of a viscous fluid in motion depends on its velocity",
            "state an `equilibrium`, or a motion without viscosity",
        )),
        _ => equation(&scene.material)
            .ok_or(("a rigid body does not move", "state a `temperature`, and no `displacement`")),
    }
}

/// The equation that forces are manufactured with, or why there is none.
pub(crate) fn manufactured(material: &MaterialPlan) -> Result<Equation, &'static str> {
    match material {
        MaterialPlan::LinearElastic { .. } => {
            Err("a law in rate form has no stress of the deformation alone")
        }
        MaterialPlan::J2 { .. } => Err("plastic flow depends on the whole history of the motion"),
        MaterialPlan::Newtonian { .. } => Err("viscous stress depends on the rate of deformation"),
        MaterialPlan::Rigid {} => Err("a body at rest has no force"),
        MaterialPlan::NeoHookean { .. } | MaterialPlan::Hencky { .. } => {
            equation(material).ok_or("the law has no equation")
        }
    }
}

/// Refuses an FEM bar, a method or the reference, of a material that it has no law for.
pub(crate) fn check(
    evaluator: &Evaluator<'_>,
    words: &ConvergenceSpec,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    let name = scene.material.name();
    let elastic = scene.material.elasticity().is_some();
    let of_fluid = || format!("the reference FEM is a solid bar, `{name}` has no Young's modulus");
    if words.has_fem_reference() && !elastic {
        return Err(evaluator.diagnostic_at_key(&Path::top("reference"), &of_fluid()));
    }
    let foreign = |law: EquationName| {
        let of_mpm = matches!(law, EquationName::J2 | EquationName::Tait);
        of_mpm.then(|| format!("the reference FEM has no `{}`", law.name()))
    };
    let reference = words.reference.as_ref().and_then(|reference| reference.equation);
    if let Some(message) = reference.and_then(foreign) {
        return Err(evaluator.diagnostic(&Path::top("reference").then("equation"), &message));
    }
    for (i, method) in words.methods.iter().enumerate() {
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
