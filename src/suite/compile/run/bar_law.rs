//! Laws of the reference FEM for a material.

use crate::fem::BarLaw;
use crate::mpm::MaterialPlan;
use crate::suite::compile::truth::law::equation;
use crate::suite::grammar::EquationName;

/// Name of the law of an FEM bar of this material, if the FEM has it.
pub(crate) fn own(material: &MaterialPlan) -> Option<EquationName> {
    let name = equation(material)?.name();
    BarLaw::find(name).and(EquationName::find(name))
}
