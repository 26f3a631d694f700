//! The stated temperature, in rows of name and value.

use crate::exact::heat::Conduction;
use crate::suite::model::ConvergencePlan;

/// The temperature that is stated.
pub(crate) fn truth(plan: &ConvergencePlan) -> Vec<(String, String)> {
    let Some(problem) = plan.heat_problem() else { return Vec::new() };
    let Conduction { temperature, manufactured, motion, .. } = problem;
    let flow = if motion.is_some() { "J C^-1 Grad T" } else { "Grad T" };
    let mut rows = vec![("temperature", temperature.source().to_owned())];
    if *manufactured {
        rows.push(("heat source", format!("manufactured, s = c T_t - Div(k {flow})/rho0")));
    }
    rows.push(("heat equation", format!("rho0 c T_t = Div(k {flow}) + rho0 s")));
    rows.into_iter().map(|(key, text)| (key.to_owned(), text)).collect()
}
