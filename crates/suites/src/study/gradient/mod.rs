//! Gradient studies compare the derivatives of a differentiable solver with the solver's own
//! values, with exact sensitivities, and with values over an interval of a parameter.

mod run;
use self::run::GradientRun;
use crate::external::{GradientError, ProblemNeeds, SolverFactory};
use crate::study::convergence::statement;
use crate::study::describe::{self, Rows, push};
use crate::study::handover::needs;
use crate::study::kind::{CaseRunner, PlanRunner, Progress, RunContext, Study};
use crate::subject::GradientParameter;
use crate::suite::evaluator::shown;
use crate::suite::model::gradient::{GradientCase, GradientPlan};
use crate::verify::{
    CaseOutcome, FIRST_LEVEL, GradientStudy, LAST_LEVEL, StudyResults, Unmet, UnmetCode,
};
use std::sync::Arc;

impl Study for GradientPlan {
    fn statement(&self) -> Rows {
        let mut rows = statement::rows(&self.problem);
        rows.retain(|(key, _)| {
            !["instants", "judged", "errors", "crossing levels"].contains(&key.as_str())
        });
        push(&mut rows, "functional", &self.of.name().replace('_', " "));
        for one in &self.parameters {
            let follows = match one.velocity_factor {
                _ if one.parameter == GradientParameter::InitialVelocity => "",
                factor if factor != 0.0 => ", on which the initial velocity depends",
                _ => "",
            };
            let (name, value) = (&one.name, shown(one.motion.value));
            let text = format!("{} ({name} = {value}){follows}", one.parameter.name());
            push(&mut rows, "with respect to", &text);
        }
        let cells = self.problem.refine.levels.get(self.level).map_or(0, |level| level.cells);
        push(
            &mut rows,
            "perturbed",
            &format!("on {cells} cells, by 2^-4 to 2^-16 of the parameter"),
        );
        if let Some(sweep) = self.sweep {
            let (name, within) = (sweep.parameter.name(), shown(sweep.within));
            let text = format!("{name} within {within} of its value, {} points", sweep.points);
            push(&mut rows, "sweep", &text);
        }
        rows
    }

    fn needs(&self) -> Option<ProblemNeeds> {
        Some(needs(&self.problem))
    }

    fn runner<'a>(&'a self, context: RunContext<'a>) -> Box<dyn CaseRunner + 'a> {
        Box::new(PlanRunner { plan: self, context })
    }
}

impl CaseRunner for PlanRunner<'_, GradientPlan> {
    fn units(&self) -> u64 {
        let levels = self.plan.problem.refine.levels(self.context.extent).len() as u64;
        let perturbed = u64::from(LAST_LEVEL - FIRST_LEVEL + 1);
        let points = |case: &GradientCase| {
            let parameter = self.plan.parameters[case.parameter].parameter;
            let sweep = self.plan.sweep.filter(|sweep| sweep.parameter == parameter);
            sweep.map_or(0, |sweep| sweep.points)
        };
        self.plan.cases.iter().map(|case| levels + perturbed + points(case)).sum()
    }

    fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome {
        let (plan, case) = (self.plan, &self.plan.cases[index]);
        let described = described(plan, index, self.context.solver);
        let Some(solver) = self.context.solver else {
            let lacks = vec!["a solver with gradients (`--solver COMMAND`)".to_owned()];
            return CaseOutcome {
                reason: "needs a solver with gradients".to_owned(),
                ..described.not_applicable(lacks, "must be named with")
            };
        };
        let lacks = lacking(plan, case, solver);
        described.after(case.gating.as_ref(), lacks, |described| {
            let all = plan.parameters.iter().map(|one| one.parameter);
            let request = all.filter(|one| has_gradient(solver, *one)).collect();
            let run = GradientRun { context: self.context, plan, case, solver, request };
            match run.study(progress) {
                Ok(study) => judged(described, case, study),
                // If the solver lacks a capability, the case is not applicable rather than failed.
                Err(GradientError::Cannot(reason)) => {
                    described.not_applicable(vec![reason], "refuses the problem:")
                }
                Err(GradientError::Failed(reason)) => failed(described, &reason),
            }
        })
    }
}

fn has_gradient(solver: &dyn SolverFactory, parameter: GradientParameter) -> bool {
    let of = |gradients| ProblemNeeds { gradients, ..ProblemNeeds::default() };
    let without = solver.lacks(&of(Vec::new())).len();
    solver.lacks(&of(vec![parameter.name()])).len() == without
}

fn lacking(plan: &GradientPlan, case: &GradientCase, solver: &dyn SolverFactory) -> Vec<String> {
    let one = &plan.parameters[case.parameter];
    let mut gradients = vec![one.parameter.name()];
    let velocity = GradientParameter::InitialVelocity.name();
    if one.velocity_factor != 0.0 && gradients != [velocity] {
        gradients.push(velocity);
    }
    // Derivatives are compared with those of the built-in law in rate form.
    solver.lacks(&ProblemNeeds { gradients, small_strain: false, ..needs(&plan.problem) })
}

fn described(plan: &GradientPlan, index: usize, solver: Option<&dyn SolverFactory>) -> CaseOutcome {
    let case = &plan.cases[index];
    let one = &plan.parameters[case.parameter];
    let mut settings = solver.map_or(Vec::new(), SolverFactory::settings);
    settings.extend(case.solver.method.settings());
    push(&mut settings, "derivative", &format!("with respect to {}", one.parameter.name()));
    describe::described(&case.name, case.solver.method, settings, plan.expectation(index))
}

fn judged(described: CaseOutcome, case: &GradientCase, study: GradientStudy) -> CaseOutcome {
    let (state, reason) = study.state();
    let unmet = case.expected.as_ref().map_or(Vec::new(), |(terms, _)| terms.unmet(&study));
    CaseOutcome {
        verdict: state.name().replace('_', " "),
        reason: format!("{reason}; order of the derivative {:.2}", study.order()),
        unmet,
        study: Some(StudyResults::Gradient(Arc::new(study))),
        ..described
    }
}

fn failed(described: CaseOutcome, reason: &str) -> CaseOutcome {
    let reason = format!("the solver {reason}");
    let is_expected = described.expected.is_some();
    let unmet = if is_expected {
        vec![Unmet::new(UnmetCode::RunFailed, reason.as_str())]
    } else {
        Vec::new()
    };
    CaseOutcome { verdict: "failed".to_owned(), reason, unmet, ..described }
}
