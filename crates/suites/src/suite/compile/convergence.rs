//! Compiles a convergence study: computes numbers, resolves names and checks the exact solution.

use super::check::{load_steps, refuse_contradictions, sums};
use super::expect;
use super::run::reference::references;
use super::run::{self, RunPlan};
use super::scene;
use super::study::{CompiledStudy, StudyDraft};
use super::truth::{self, StatedTruth};
use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::{AcknowledgeSpec, ConvergenceSpec, WarningName};
use crate::suite::model::ConvergencePlan;
use crate::suite::model::method::AnyMethod;
use crate::suite::yaml::Diagnostic;
use crate::verify::StepKind;

pub(crate) fn convergence_plan(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
) -> Result<ConvergencePlan, Diagnostic> {
    let scene = scene::scene(evaluator, &spec.scene)?;
    let draft = StudyDraft { evaluator, spec, scene };
    load_steps::refuse_unfit(&draft)?;
    let run = run::plan(&draft)?;
    let latest = run.until.iter().map(|(_, t)| *t).fold(0.0, f64::max);
    let truth = truth::truth(&draft, latest)?;
    let (reference, same_method) = references(&draft, &run)?;
    let scale = spec
        .judge
        .scale
        .as_ref()
        .map(|text| evaluator.top("judge.scale").positive(text, "the scale of the error"));
    let RunPlan { until, refine, levels, instants, scatter } = run;
    let StatedTruth { exact, conduction, survey, within, observe } = truth;
    let mut plan = ConvergencePlan {
        observe,
        scene: draft.scene,
        exact,
        conduction,
        reference,
        same_method,
        refine,
        scatter,
        steps: spec.run.load_steps.as_ref().map_or(StepKind::Time, |_| StepKind::Load),
        instants,
        norm: spec.judge.norm,
        of: spec.judge.of,
        sum: None,
        within,
        scale: scale.transpose()?,
        scale_formula: spec
            .judge
            .scale
            .as_ref()
            .map(ToString::to_string)
            .filter(|text| text.parse::<f64>().is_err()),
        crossing_levels: spec.judge.crossing_levels,
        any_method: AnyMethod::default(),
        cases: Vec::new(),
        acknowledged: acknowledged(evaluator, &spec.acknowledge)?,
    };
    plan.cases = run::cases(evaluator, spec, &plan, &until)?;
    let study = CompiledStudy { evaluator, spec, plan: &plan, survey, levels };
    refuse_contradictions(&study)?;
    // The exact value of the sum needs the solution, which has been checked above.
    let sum = sums::judged(&study)?;
    let any_method = expect::any_method(&study)?;
    let expectations = expect::expectations(&study)?;
    plan.scale = plan.scale.or(sum.as_ref().map(|sum| sum.size()));
    (plan.sum, plan.any_method) = (sum, any_method);
    for (case, expected) in plan.cases.iter_mut().zip(expectations) {
        let (expectation, in_full) = expected.unzip();
        (case.expectation, case.expectation_in_full) = (expectation, in_full.flatten());
    }
    Ok(plan)
}

fn acknowledged(
    evaluator: &Evaluator<'_>,
    specs: &[AcknowledgeSpec],
) -> Result<Vec<WarningName>, Diagnostic> {
    let mut names = Vec::new();
    for (i, spec) in specs.iter().enumerate() {
        let path = evaluator.top("acknowledge").then(i);
        path.because("this acknowledged warning", &spec.because)?;
        if names.contains(&spec.warning) {
            let message = format!("`{}` is acknowledged twice", spec.warning.name());
            return Err(path.then("warning").diagnostic(&message));
        }
        names.push(spec.warning);
    }
    Ok(names)
}
