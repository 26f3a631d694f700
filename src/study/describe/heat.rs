//! What a suite says of heat, in rows of name and value.

use crate::{
    exact::{
        Expansion,
        heat::{Conduction, ThermalCondition},
    },
    suite::model::{ConvergencePlan, heat::SceneHeat},
};

/// Conduction in the scene.
pub(crate) fn scene(heat: &SceneHeat) -> Vec<(String, String)> {
    let mut texts = vec![format!(
        "conductivity {} W/(m K), capacity {} J/(kg K)",
        heat.conductivity, heat.capacity
    )];
    texts.extend(heat.source.iter().map(|source| format!("source {} W/kg", source.source())));
    texts.extend(heat.initial.iter().map(|initial| format!("from {} K on", initial.source())));
    let mut rows = vec![("heat".to_owned(), texts.join(", "))];
    for face in &heat.faces {
        let text = match &face.condition {
            ThermalCondition::Insulated => "insulated".to_owned(),
            ThermalCondition::Periodic => continue,
            ThermalCondition::Temperature(value) => format!("temperature {} K", value.source()),
            ThermalCondition::Flux(value) => format!("heat enters, {} W/m2", value.source()),
            ThermalCondition::Convection { coefficient, ambient } => {
                format!("convection, {coefficient} W/(m2 K) from {} K", ambient.source())
            }
        };
        rows.push((format!("heat {}", face.name), text));
    }
    rows
}

/// Expansion in the scene.
pub(crate) fn expansion(expansion: &Expansion) -> (String, String) {
    let Expansion { coefficient, reference } = expansion;
    ("thermal expansion".to_owned(), format!("{coefficient} 1/K, none at {reference} K"))
}

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
