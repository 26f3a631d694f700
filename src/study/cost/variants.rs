//! A suite with other settings than its own: particles per cell, time steps, bases.

use crate::mpm::{BasisName, combine, combine_across, combine_bodies};
use crate::named::named;
use crate::suite::model::grid_size::per_axis;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Case, ConvergencePlan, Suite};
use std::sync::Arc;

named! {
    /// Settings that may be varied besides the refined one.
    pub enum Over {
        /// Particles per cell: half and twice as many along each axis.
        Ppc = "ppc",
        /// Time steps: half and twice as long.
        Dt = "dt",
        /// Basis functions: all that go with the rest of the method.
        Basis = "basis",
    }
}

/// The suite with every combination of the varied settings, except its own. The names of cases
/// state the variation.
pub fn variants(suite: &Suite, over: &[Over]) -> Vec<Suite> {
    let Some(plan) = suite.plan::<ConvergencePlan>() else { return Vec::new() };
    let varies = |one: Over| over.contains(&one);
    let steps: &[f64] = if varies(Over::Dt) { &[1.0, 0.5, 2.0] } else { &[1.0] };
    let particles: &[(u64, u64)] =
        if varies(Over::Ppc) { &[(1, 1), (1, 2), (2, 1)] } else { &[(1, 1)] };
    let own = if varies(Over::Basis) { with_bases(plan) } else { plan.cases.clone() };
    let mut all = Vec::new();
    for dt in steps {
        for ppc in particles {
            let plain = *dt == 1.0 && *ppc == (1, 1);
            let Some(mut varied) = varied(plan, *dt, *ppc) else { continue };
            varied.cases = own
                .iter()
                .filter(|case| !plain || !plan.cases.iter().any(|known| known.name == case.name))
                .filter(|case| *ppc == (1, 1) || !matches!(case.method, Method::Fem { .. }))
                .map(|case| Case { name: name(&case.name, *dt, *ppc, &varied), ..case.clone() })
                .collect();
            if !varied.cases.is_empty() {
                let study = Arc::new(varied);
                all.push(Suite { study, ..suite.clone() });
            }
        }
    }
    all
}

fn name(case: &str, dt: f64, ppc: (u64, u64), plan: &ConvergencePlan) -> String {
    let mut name = case.to_owned();
    if ppc != (1, 1) {
        let count = plan.refine.levels.first().and_then(|level| level.ppc).unwrap_or(0);
        name += &format!("-ppc-{count}");
    }
    if dt != 1.0 {
        name += &format!("-dt-x{dt}");
    }
    name
}

/// None if that many particles cannot be equally spaced, or there are none.
fn varied(plan: &ConvergencePlan, dt: f64, (times, over): (u64, u64)) -> Option<ConvergencePlan> {
    let d = plan.scene.dimension();
    let level = |level: &LevelPlan| {
        let ppc = match level.ppc {
            None => None,
            Some(ppc) => {
                let n = per_axis(ppc, d)? as u64 * times;
                if !n.is_multiple_of(over) {
                    return None;
                }
                Some((n / over).pow(d as u32))
            }
        };
        let unchanged = ppc.is_none() && (times, over) != (1, 1);
        (!unchanged).then_some(LevelPlan { dt: dt * level.dt, ppc, ..*level })
    };
    let levels = plan.refine.levels.iter().map(level).collect::<Option<Vec<_>>>()?;
    let mut plan = plan.clone();
    plan.refine.levels = levels;
    Some(plan)
}

/// The cases, and those of other bases that mean something.
fn with_bases(plan: &ConvergencePlan) -> Vec<Case> {
    let mut all = plan.cases.clone();
    for case in &plan.cases {
        let Method::Mpm { basis: own, transfer, scheme, start, mass, frame } = case.method else {
            continue;
        };
        for basis in BasisName::ALL {
            let contact = plan.scene.contact.is_some();
            let mut known = combine(*basis, transfer, mass, frame)
                .and_then(|()| combine_across(plan.scene.plane, *basis, transfer));
            if plan.scene.bodies.len() > 1 {
                known = known.and_then(|()| combine_bodies(transfer, mass, frame, start, contact));
            }
            let spelt = |basis: BasisName| format!("mpm-{}-", basis.name().replace('_', "-"));
            let name = case.name.replacen(&spelt(own), &spelt(*basis), 1);
            if known.is_ok() && !all.iter().any(|known: &Case| known.name == name) {
                let method = Method::Mpm { basis: *basis, transfer, scheme, start, mass, frame };
                all.push(Case { name, method, ..case.clone() });
            }
        }
    }
    all
}
