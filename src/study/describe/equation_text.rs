//! Equations of motion as reports write them.

use crate::mpm::MaterialPlan;

const SMALL_STRAIN: &str = "small strain, rho0 u_tt = Div P + rho0 b, P = C : sym(grad u)";
const NEO_HOOKEAN: &str =
    "neo-Hookean, rho0 u_tt = Div P + rho0 b, P = lambda ln(J) F^-T + mu (F - F^-T)";
const J2: &str = "J2 under loading that never reverses, rho0 u_tt = Div P + rho0 b, P = tau F^-T, \
                  tau = K tr(eps) I + s dev(eps), eps = ln(F F^T)/2";
const TAIT: &str = "Tait, rho0 u_tt = Div P + rho0 b, P = -p J F^-T, p = K/7 (J^-7 - 1)";
const HENCKY: &str = "Hencky, rho0 u_tt = Div P + rho0 b, P = (lambda ln(J) I + mu ln(F F^T)) F^-T";

/// The problem that a formula solves in a body of this material.
pub(crate) fn equation(material: &MaterialPlan) -> &'static str {
    match material {
        MaterialPlan::NeoHookean { .. } => NEO_HOOKEAN,
        MaterialPlan::Hencky { .. } => HENCKY,
        MaterialPlan::J2 { .. } => J2,
        MaterialPlan::Newtonian { .. } => TAIT,
        MaterialPlan::LinearElastic { .. } | MaterialPlan::Rigid {} => SMALL_STRAIN,
    }
}
