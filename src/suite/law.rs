//! What the truth and the reference FEM know of a material.

use super::{
    binder::Binder,
    model::Scene,
    path::Path,
    words::{ConvergenceWords, EquationName, MethodWords},
    yaml::Complaint,
};
use crate::{exact::Equation, mpm::MaterialPlan};

/// The law of an FEM bar of this material, if the FEM has it.
pub(super) fn own(material: &MaterialPlan) -> Option<EquationName> {
    match material {
        MaterialPlan::LinearElastic { .. } => Some(EquationName::SmallStrain),
        MaterialPlan::NeoHookean { .. } => Some(EquationName::NeoHookean),
        MaterialPlan::Hencky { .. } => Some(EquationName::Hencky),
        MaterialPlan::J2 { .. } | MaterialPlan::Newtonian { .. } => None,
    }
}

/// The equation of motion of a body of this material, if the truth has it.
pub(super) fn equation(material: &MaterialPlan) -> Option<Equation> {
    match *material {
        MaterialPlan::LinearElastic { young, poisson } => {
            Some(Equation::small_strain(young, poisson))
        }
        MaterialPlan::NeoHookean { young, poisson } => Some(Equation::neo_hookean(young, poisson)),
        MaterialPlan::Hencky { young, poisson } => Some(Equation::hencky(young, poisson)),
        MaterialPlan::J2 { .. } | MaterialPlan::Newtonian { .. } => None,
    }
}

/// The equation that forces are manufactured with, or why there is none.
pub(super) fn manufactured(material: &MaterialPlan) -> Result<Equation, &'static str> {
    let reason = match material {
        MaterialPlan::LinearElastic { .. } => {
            return Err("a law in rate form has no stress of the deformation alone");
        }
        MaterialPlan::J2 { .. } => "plastic flow depends on the whole history of the motion",
        MaterialPlan::Newtonian { .. } => "viscous stress depends on the rate of deformation",
        MaterialPlan::NeoHookean { .. } | MaterialPlan::Hencky { .. } => "",
    };
    equation(material).ok_or(reason)
}

/// Refuses an FEM bar, a method or the reference, of a material that it has no law for.
pub(super) fn check(
    binder: &Binder<'_>,
    words: &ConvergenceWords,
    scene: &Scene,
) -> Result<(), Complaint> {
    let name = scene.material.name();
    let elastic = scene.material.elasticity().is_some();
    let of_fluid = || format!("the reference FEM is a solid bar, `{name}` has no Young's modulus");
    if words.has_fem_reference() && !elastic {
        return Err(binder.complain_key(&Path::top("reference"), &of_fluid()));
    }
    for (i, method) in words.methods.iter().enumerate() {
        let MethodWords::Fem { law, .. } = method else { continue };
        let path = Path::top("methods").then(i);
        if !elastic {
            return Err(binder.complain(&path, &of_fluid()));
        }
        if law.is_none() && own(&scene.material).is_none() {
            let complaint = binder.complain(&path, &format!("the reference FEM has no `{name}`"));
            return Err(complaint.with_help("name the `law` of an elastic bar to compare with"));
        }
    }
    Ok(())
}
