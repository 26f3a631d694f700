//! The spectrum study: runs every wave of each case.

use crate::external::{ProblemNeeds, SolverFactory};
use crate::study::describe::{Rows, described, push, scene};
use crate::study::handover::{HandedRun, of_scene, problem, start, unloaded};
use crate::study::kind::{CaseRunner, PlanRunner, Progress, RunContext, ShowRun, Study};
use crate::study::setup::body::Body;
use crate::study::setup::dispatch::perturbable;
use crate::study::setup::initial_state::Initial;
use crate::study::time_series::{SeriesError, ShownRun};
use crate::subject::{Precision, Subject, SubjectError};
use crate::suite::evaluator::shown;
use crate::suite::model::Scene;
use crate::suite::model::spectrum::{SpectrumCase, SpectrumPlan, Wave};
use crate::verify::{
    AMPLITUDE, CaseOutcome, MeasuredWave, ObservedWave, PERIODS, Recurrence, SpectrumRow,
    SpectrumStudy, StudyResults, Unmet, UnmetCode, WaveFigures, distinct, run_wave, steps_of_run,
};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Relative phase error for which reports contain the number of cells per wavelength.
const ONE_PERCENT: f64 = 0.01;

struct WaveRun<'a> {
    plan: &'a SpectrumPlan,
    case: &'a SpectrumCase,
    context: RunContext<'a>,
}

impl WaveRun<'_> {
    /// Returns the number of cells per wavelength for a phase error of 1 %, for each wave.
    fn cells_for_one_percent(&self) -> Vec<Option<f64>> {
        let mut known: Vec<(f64, Option<f64>)> = Vec::new();
        let of = |wave: &Wave| {
            let same = known.iter().find(|(courant, _)| *courant == wave.courant);
            if let Some((_, cells)) = same {
                return *cells;
            }
            let curve = self.case.curve.as_ref();
            let cells =
                curve.and_then(|curve| curve.cells_for_phase_error(wave.courant, ONE_PERCENT));
            known.push((wave.courant, cells));
            cells
        };
        self.plan.waves.iter().map(of).collect()
    }

    fn row(&self, wave: &Wave, cells_for_one_percent: Option<f64>) -> SpectrumRow {
        let (cells, courant) = (wave.cells, wave.courant);
        let predicted = self.case.curve.map(|curve| {
            let step = curve.step(TAU / cells);
            let log_kept = libm::log(step.largest_modulus(courant)) * cells / courant;
            WaveFigures { phase_error: step.phase_error(courant), log_kept }
        });
        let steps = self.steps(wave);
        let measured = self.measured(wave, steps).map(|measured| {
            let step = Recurrence::new(measured.trace, measured.determinant);
            WaveFigures::of(&step, cells, courant)
        });
        let measured = measured.map_err(|reason| reason.to_string());
        SpectrumRow {
            cells,
            courant,
            steps,
            predicted,
            measured,
            cells_for_one_percent,
            limit: self.case.limit,
        }
    }

    fn steps(&self, wave: &Wave) -> u64 {
        let log_kept = self
            .case
            .curve
            .map(|curve| libm::log(curve.step(TAU / wave.cells).largest_modulus(wave.courant)));
        steps_of_run(wave.cells, wave.courant, log_kept)
    }

    fn measured(&self, wave: &Wave, steps: u64) -> Result<MeasuredWave, SubjectError> {
        let RunContext { suite, fingerprint, .. } = self.context;
        let (case, cells, courant) = (&self.case.name, wave.cells, wave.courant);
        let name = format!("{suite}::{case}, {cells} cells, C = {courant}");
        let key = format!("{suite} {fingerprint:016x} {case} {cells:e} {courant:e} {steps}");
        let run = || {
            let scene = self.plan.started(wave);
            let mut subject = self.subject(&scene, wave, steps)?;
            let dt = self.plan.level(wave).dt;
            let (from, length) = (scene.from[0], cells * self.plan.h);
            Ok(run_wave(subject.as_mut(), ObservedWave { from, length, dt, steps })?)
        };
        self.context.cached(&key, &name, |_| false, run)
    }

    fn subject(
        &self,
        scene: &Scene,
        wave: &Wave,
        steps: u64,
    ) -> Result<Box<dyn Subject>, SubjectError> {
        let level = self.plan.level(wave);
        let body = |own| Body::stated(scene, own, self.plan.lattice());
        let Some(solver) = self.context.solver else {
            return Ok(perturbable(vec![body(scene)], self.case.method, level)?);
        };
        let bare = unloaded(scene);
        let bodies: Vec<Body<'_>> = bare.iter().map(body).collect();
        let run = HandedRun {
            load_steps: None,
            steps,
            dt: level.dt,
            until: steps as f64 * level.dt,
            instants: (1..=steps).collect(),
            particles: start(bodies, level, &mut |_| ())?,
            initial: vec![Initial::stated(scene)],
            is_perturbed: false,
        };
        solver.subject(problem(self.context.suite, scene, None, level, run))
    }

    fn shown(&self, wave: &Wave) -> Result<ShownRun<'static>, SubjectError> {
        let steps = self.steps(wave);
        Ok(ShownRun {
            name: format!("{} cells, C = {}", wave.cells, wave.courant),
            subject: self.subject(&self.plan.started(wave), wave, steps)?,
            dt: vec![self.plan.level(wave).dt],
            steps,
            truth: None,
        })
    }
}

fn lacking(plan: &SpectrumPlan, solver: &dyn SolverFactory) -> Vec<String> {
    let mut lacks = solver.lacks(&of_scene(&plan.scene));
    if solver.precision() == Precision::Single {
        lacks.push("double precision".to_owned());
    }
    lacks
}

impl Study for SpectrumPlan {
    fn statement(&self) -> Rows {
        let mut rows = Rows::new();
        scene(&self.scene, &mut rows);
        let list =
            |of: fn(&Wave) -> f64| distinct(self.waves.iter().map(|w| shown(of(w)))).join(", ");
        let shift = match self.shift {
            0.0 => String::new(),
            shift => format!(", shifted by {} m", shown(shift)),
        };
        push(&mut rows, "cells", &format!("{} of size {} m", self.cells, shown(self.h)));
        push(&mut rows, "particles", &format!("{} per cell{shift}", self.ppc));
        let lengths = list(|wave| wave.cells);
        push(&mut rows, "wavelengths", &format!("{lengths} cells"));
        let courants = list(|wave| wave.courant);
        push(&mut rows, "dt", &format!("C h/c with C = {courants}"));
        push(&mut rows, "start", &format!("standing wave with a velocity of {AMPLITUDE:e} c"));
        push(
            &mut rows,
            "run",
            &format!("{PERIODS} exact periods, or until a millionth of the amplitude remains"),
        );
        for (solver, case) in &self.solvers {
            push(&mut rows, "solver", &format!("`{solver}` is compared with `{case}`"));
        }
        rows
    }

    fn needs(&self) -> Option<ProblemNeeds> {
        Some(of_scene(&self.scene))
    }

    fn runner<'a>(&'a self, context: RunContext<'a>) -> Box<dyn CaseRunner + 'a> {
        Box::new(PlanRunner { plan: self, context })
    }
}

impl CaseRunner for PlanRunner<'_, SpectrumPlan> {
    fn units(&self) -> u64 {
        (self.plan.cases.len() * self.plan.waves.len()) as u64
    }

    fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome {
        let (plan, context, case) = (self.plan, self.context, &self.plan.cases[index]);
        let lacks = context.solver.map_or(Vec::new(), |solver| lacking(plan, solver));
        let mut settings = context.solver.map_or(Vec::new(), SolverFactory::settings);
        // The setting of walls is omitted, because a periodic domain has no walls.
        settings.extend(case.method.settings().into_iter().filter(|(key, _)| key != "walls"));
        let described = described(&case.name, case.method, settings, plan.expectation(index));
        described.after(case.gating.as_ref(), lacks, |described| {
            let run = WaveRun { plan, case, context };
            let waves = plan.waves.par_iter().zip(run.cells_for_one_percent());
            let rows = waves.map(|(wave, cells)| run.row(wave, cells));
            outcome(described, case, rows.inspect(|_| progress()).collect())
        })
    }

    fn shown(
        &self,
        case: usize,
        outcome: &CaseOutcome,
        show: ShowRun<'_>,
    ) -> Result<(), SeriesError> {
        let (plan, case) = (self.plan, &self.plan.cases[case]);
        let study = outcome.spectrum().ok_or("it could not be run")?;
        let failed = study.rows.iter().position(|row| row.measured.is_err());
        let wave = plan.waves.get(failed.unwrap_or(plan.waves.len().saturating_sub(1)));
        let run = WaveRun { plan, case, context: self.context };
        show(run.shown(wave.ok_or("it has no runs")?)?)
    }
}

fn outcome(described: CaseOutcome, case: &SpectrumCase, rows: Vec<SpectrumRow>) -> CaseOutcome {
    let unmet: Vec<Unmet> = case
        .expected
        .iter()
        .flat_map(|(expected, _)| rows.iter().flat_map(|row| expected.unmet(row)))
        .map(|text| Unmet::new(UnmetCode::SpectrumDiffers, text))
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
        study: Some(StudyResults::Spectrum(Arc::new(study))),
        ..described
    }
}
