//! Laws of the truth for a material.

use crate::exact::Equation;
use crate::mpm::MaterialPlan;

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
