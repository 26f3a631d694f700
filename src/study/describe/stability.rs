//! A stability study in rows of name and value.

use crate::suite::{
    compile::{stability::recipe::Setting, wording::shown},
    model::stability::StabilityPlan,
};

/// The set-up of the first row, of which a report tells.
pub(crate) fn first(plan: &StabilityPlan) -> Option<Setting> {
    let value = plan.values.first()?;
    plan.recipe.setting(&[(&plan.swept, *value)]).ok()
}

/// Rows for the whole study, besides those of its scene.
pub(crate) fn rows(plan: &StabilityPlan, setting: &Setting) -> Vec<(String, String)> {
    let mut rows: Vec<(String, String)> = Vec::new();
    let mut push = |key: &str, value: String| rows.push((key.to_owned(), value));
    let values: Vec<String> = plan.values.iter().map(|value| shown(*value)).collect();
    push("swept", format!("{} = {}", plan.swept, values.join(", ")));
    if let Some((name, from, to)) = &plan.sought {
        push(
            "sought",
            format!("the largest stable {name}, from {} to {}", shown(*from), shown(*to)),
        );
    }
    let ppc = setting.level.ppc.unwrap_or(0);
    push(
        "cells",
        format!(
            "{} of size {} m, {ppc} particles each",
            setting.level.cells,
            shown(setting.level.h)
        ),
    );
    let full = if setting.full_steps == setting.steps {
        String::new()
    } else {
        format!(", in full {}", setting.full_steps)
    };
    push("run", format!("{} steps{full}", setting.steps));
    if let Some(share) = setting.rule {
        push("dt", format!("{} of the longest safe step", shown(share)));
    }
    if let (Some(first), Some(last)) = (setting.dt.first(), setting.dt.last()) {
        let turns = setting.dt.len() / 2;
        if turns > 0 {
            push("steps in turn", format!("{turns} of {first:e} s, {turns} of {last:e} s"));
        }
    }
    if setting.frozen {
        push("particles", "frozen: no step moves a particle or its domain".to_owned());
    }
    if setting.perturb > 0.0 {
        push(
            "start",
            format!("random, of size {:e} in every number of the state", setting.perturb),
        );
    }
    push(
        "verdicts",
        format!(
            "stable: energy up to {:e} times that at the start; unstable: beyond {:e}",
            setting.scales.stable_below, setting.scales.unstable_above
        ),
    );
    rows
}
