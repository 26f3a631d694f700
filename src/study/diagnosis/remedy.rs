//! Suites with a remedy in them, loaded: `check` must accept each remedy that is recommended.

use crate::suite::compile::suite::with_changes;
use crate::suite::grammar::{BoxSpec, ConvergenceSpec, MethodSpec, StepSpec};
use crate::suite::model::ConvergencePlan;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::yaml::{Diagnostic, NumberText, OneOrMany, Source};

/// Why `check` refuses the suite in `source` with everything that `after` changes in `before`, two
/// plans of one case; `None` if `check` accepts the suite.
pub(super) fn refusal(
    source: &Source,
    before: &ConvergencePlan,
    after: &ConvergencePlan,
) -> Option<String> {
    let new_method = (before.cases[0].method != after.cases[0].method)
        .then(|| method_spec(after.cases[0].method))
        .flatten();
    let changed = with_changes(source, |spec| {
        if let Some(method) = new_method {
            spec.methods = vec![method];
        }
        write_levels(spec, &before.refine.levels, &after.refine.levels);
    });
    changed.err().map(|refused: Diagnostic| refused.message().to_owned())
}

/// Whether `check` accepts the suite in `source` with this time step.
pub(super) fn accepts_step(source: &Source, step: StepSpec) -> bool {
    with_changes(source, |spec| spec.run.dt = Some(step)).is_ok()
}

/// Whether `check` accepts the suite in `source` with a grid between two corners (m).
pub(super) fn accepts_grid(source: &Source, from: &[f64], to: &[f64]) -> bool {
    let corner = |x: &[f64]| x.iter().copied().map(NumberText::Number).collect();
    let grid = BoxSpec { from: corner(from), to: corner(to) };
    with_changes(source, |spec| spec.scene.grid = Some(grid)).is_ok()
}

/// The method as a suite states it; `None` of a method that is never changed.
fn method_spec(method: Method) -> Option<MethodSpec> {
    let Method::Mpm { basis, transfer, scheme, start, mass, frame } = method else { return None };
    Some(MethodSpec::Mpm {
        basis: basis.into(),
        transfer: transfer.into(),
        scheme: scheme.into(),
        start: Some(start.into()),
        mass: Some(mass.into()),
        frame: Some(frame.into()),
    })
}

/// Writes the levels `after` into a suite whose levels are `before`. A time step that is a formula
/// of h follows the cells.
fn write_levels(spec: &mut ConvergenceSpec, before: &[LevelPlan], after: &[LevelPlan]) {
    let write = |values: &mut OneOrMany<NumberText>, of: fn(&LevelPlan) -> f64| {
        let is_changed = before.iter().map(of).ne(after.iter().map(of));
        let changed = values.with_values(after.iter().map(of).map(NumberText::Number));
        if let Some(changed) = changed.filter(|_| is_changed) {
            *values = changed;
        }
    };
    write(&mut spec.refine.cells, |level| level.cells as f64);
    if let Some(ppc) = &mut spec.refine.ppc {
        write(ppc, |level| level.ppc.unwrap_or(0) as f64);
    }
    if let Some(dt) = &mut spec.refine.dt {
        write(dt, |level| level.dt);
    }
    // Finer levels of full runs need not be levels of the changed list.
    spec.refine.full = None;
}
