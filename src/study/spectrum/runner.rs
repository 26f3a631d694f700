//! The runner of a spectrum study, and the rows that state the study.

use super::run::{WaveRun, lacking, needs};
use crate::external::{ProblemNeeds, SolverFactory};
use crate::study::describe::statement::{Rows, push, scene};
use crate::study::kind::{CaseRunner, Progress, RunContext, ShowRun, Study};
use crate::study::time_series::SeriesError;
use crate::suite::evaluator::shown;
use crate::suite::model::spectrum::{SpectrumCase, SpectrumPlan};
use crate::verify::{AMPLITUDE, CaseOutcome, Gating, PERIODS, SpectrumRow, SpectrumStudy};
use rayon::prelude::*;
use std::sync::Arc;

impl Study for SpectrumPlan {
    fn statement(&self) -> Rows {
        rows(self)
    }

    fn needs(&self) -> Option<ProblemNeeds> {
        Some(needs(self))
    }

    fn runner<'a>(&'a self, context: RunContext<'a>) -> Box<dyn CaseRunner + 'a> {
        Box::new(SpectrumRunner { plan: self, context })
    }
}

/// Runs cases of a spectrum study.
struct SpectrumRunner<'a> {
    plan: &'a SpectrumPlan,
    context: RunContext<'a>,
}

impl CaseRunner for SpectrumRunner<'_> {
    fn units(&self) -> u64 {
        (self.plan.cases.len() * self.plan.waves.len()) as u64
    }

    fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome {
        let (plan, context, case) = (self.plan, self.context, &self.plan.cases[index]);
        let described = described(case, context.solver);
        if let Some(Gating::Excepted(reason)) = &case.gating {
            return described.excepted(reason.clone());
        }
        let lacks = context.solver.map_or(Vec::new(), |solver| lacking(plan, solver));
        if !lacks.is_empty() {
            return described.not_applicable(lacks, "lacks");
        }
        let run = WaveRun { plan, case, context };
        let row = |(wave, cells)| {
            let row = run.row(wave, cells);
            progress();
            row
        };
        let rows: Vec<SpectrumRow> =
            plan.waves.par_iter().zip(run.cells_for_one_percent()).map(row).collect();
        let outcome = outcome(described, case, rows);
        match &case.gating {
            Some(Gating::NotGated(reason)) => outcome.not_gated(reason),
            _ => outcome,
        }
    }

    fn shown(
        &self,
        case: usize,
        outcome: &CaseOutcome,
        show: ShowRun<'_>,
    ) -> Result<(), SeriesError> {
        let (plan, case) = (self.plan, &self.plan.cases[case]);
        let study: &SpectrumStudy = outcome.results().ok_or("it could not be run")?;
        let failed = study.rows.iter().position(|row| row.measured.is_err());
        let wave = plan.waves.get(failed.unwrap_or(plan.waves.len().saturating_sub(1)));
        let run = WaveRun { plan, case, context: self.context };
        show(run.shown(wave.ok_or("it has no runs")?)?)
    }
}

/// The part of an outcome that is known before the case runs.
fn described(case: &SpectrumCase, solver: Option<&dyn SolverFactory>) -> CaseOutcome {
    let mut settings = solver.map_or(Vec::new(), SolverFactory::settings);
    // A periodic row has no walls.
    settings.extend(case.method.settings().into_iter().filter(|(key, _)| key != "walls"));
    let expected = case.expected.as_ref();
    CaseOutcome {
        expected: expected.map(|(expected, _)| expected.summary()),
        because: expected.map(|(_, because)| because.clone()).unwrap_or_default(),
        ..CaseOutcome::new(&case.name, case.method.subject(), settings)
    }
}

/// The outcome of a case, from its rows.
fn outcome(described: CaseOutcome, case: &SpectrumCase, rows: Vec<SpectrumRow>) -> CaseOutcome {
    let unmet: Vec<String> = case
        .expected
        .iter()
        .flat_map(|(expected, _)| rows.iter().flat_map(|row| expected.unmet(row)))
        .collect();
    let study = SpectrumStudy { rows };
    let verdict = match (case.expected.is_some(), unmet.is_empty()) {
        (false, _) => "measured",
        (true, true) => "as predicted",
        (true, false) => "differs",
    };
    CaseOutcome {
        verdict: verdict.to_owned(),
        reason: study.reason(),
        unmet,
        study: Some(Arc::new(study)),
        ..described
    }
}

/// Rows of the study.
fn rows(plan: &SpectrumPlan) -> Rows {
    let mut rows = Rows::new();
    scene(&plan.scene, &mut rows);
    let list = |values: Vec<f64>| {
        let mut texts: Vec<String> = Vec::new();
        for text in values.into_iter().map(shown) {
            if !texts.contains(&text) {
                texts.push(text);
            }
        }
        texts.join(", ")
    };
    let shift = match plan.shift {
        0.0 => String::new(),
        shift => format!(", shifted by {} m", shown(shift)),
    };
    push(&mut rows, "cells", &format!("{} of size {} m", plan.cells, shown(plan.h)));
    push(&mut rows, "particles", &format!("{} per cell{shift}", plan.ppc));
    let lengths = list(plan.waves.iter().map(|wave| wave.cells).collect());
    push(&mut rows, "wavelengths", &format!("{lengths} cells"));
    let courants = list(plan.waves.iter().map(|wave| wave.courant).collect());
    push(&mut rows, "dt", &format!("C h/c with C = {courants}"));
    push(&mut rows, "start", &format!("standing wave with a velocity of {AMPLITUDE:e} c"));
    push(
        &mut rows,
        "run",
        &format!("{PERIODS} exact periods, or until a millionth of the amplitude remains"),
    );
    for (solver, case) in &plan.solvers {
        push(&mut rows, "solver", &format!("`{solver}` is compared with `{case}`"));
    }
    rows
}
