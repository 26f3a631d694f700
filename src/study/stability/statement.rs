//! A stability study in rows of name and value.

use crate::study::describe::statement::{Rows, push, scene};
use crate::suite::compile::stability::setup::RunSetup;
use crate::suite::evaluator::shown;
use crate::suite::model::stability::StabilityPlan;

/// Rows of the study, with the set-up of its first row.
pub(crate) fn rows(plan: &StabilityPlan) -> Rows {
    let mut rows = Rows::new();
    let first = |value: &f64| plan.template.setup(&[(&plan.swept, *value)]).ok();
    if let Some(first) = plan.values.first().and_then(first) {
        scene(&first.scene, &mut rows);
        of_setup(plan, &first, &mut rows);
    }
    rows
}

fn of_setup(plan: &StabilityPlan, setup: &RunSetup, rows: &mut Rows) {
    let mut push = |key: &str, value: String| push(rows, key, &value);
    let values: Vec<String> = plan.values.iter().map(|value| shown(*value)).collect();
    push("swept", format!("{} = {}", plan.swept, values.join(", ")));
    if let Some((name, from, to)) = &plan.sought {
        push(
            "sought",
            format!("the largest stable {name}, from {} to {}", shown(*from), shown(*to)),
        );
    }
    let ppc = setup.level.ppc.unwrap_or(0);
    push("cells", format!("{} of size {} m", setup.level.cells, shown(setup.level.h)));
    push("particles", format!("{ppc} per cell"));
    let full = if setup.full_steps == setup.steps {
        String::new()
    } else {
        format!(", {} with --full", setup.full_steps)
    };
    push("run", format!("{} steps{full}", setup.steps));
    if let Some(share) = setup.rule {
        push("dt", format!("{} of the stable time step", shown(share)));
    }
    if let (Some(first), Some(last)) = (setup.dt.first(), setup.dt.last()) {
        let turns = setup.dt.len() / 2;
        if turns > 0 {
            push("steps in turn", format!("{turns} of {first:e} s, {turns} of {last:e} s"));
        }
    }
    if setup.frozen {
        push("configuration", "frozen: no step moves a particle or its domain".to_owned());
    }
    if setup.perturb > 0.0 {
        push("start", format!("random, of size {:e} in every number of the state", setup.perturb));
    }
    push(
        "verdicts",
        format!(
            "stable: energy up to {:e} times that at the start; unstable: beyond {:e}",
            setup.scales.stable_below, setup.scales.unstable_above
        ),
    );
}
