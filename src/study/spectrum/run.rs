//! One case of a spectrum study: a run for each wave.

use crate::external::{ProblemNeeds, SolverFactory};
use crate::study::handover::{HandedRun, of_scene, problem, start, unloaded};
use crate::study::kind::RunContext;
use crate::study::setup::body::Body;
use crate::study::setup::dispatch::perturbable;
use crate::study::setup::initial_state::Initial;
use crate::study::time_series::ShownRun;
use crate::subject::{Precision, Subject, SubjectError};
use crate::suite::model::Scene;
use crate::suite::model::spectrum::{SpectrumCase, SpectrumPlan, Wave};
use crate::verify::{MeasuredWave, Recurrence, SpectrumRow, WaveFigures, run_wave, steps_of_run};
use std::f64::consts::TAU;

/// Phase error (relative) whose wavelength a report states.
const ONE_PERCENT: f64 = 0.01;

/// The needs of a run.
pub(super) fn needs(plan: &SpectrumPlan) -> ProblemNeeds {
    of_scene(&plan.scene)
}

/// One case of a study.
pub(super) struct WaveRun<'a> {
    pub(super) plan: &'a SpectrumPlan,
    pub(super) case: &'a SpectrumCase,
    pub(super) context: RunContext<'a>,
}

impl WaveRun<'_> {
    /// Cells per wavelength for a phase error of 1 % at the Courant number of each wave.
    pub(super) fn cells_for_one_percent(&self) -> Vec<Option<f64>> {
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

    /// The row of one wave.
    pub(super) fn row(&self, wave: &Wave, cells_for_one_percent: Option<f64>) -> SpectrumRow {
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

    /// Number of steps of the run of a wave.
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
            Ok(run_wave(subject.as_mut(), (dt, steps), (scene.from[0], cells * self.plan.h))?)
        };
        self.context.cached(&key, &name, |_| false, run)
    }

    /// The subject at the start of the run of `wave` in `scene`.
    fn subject(
        &self,
        scene: &Scene,
        wave: &Wave,
        steps: u64,
    ) -> Result<Box<dyn Subject>, SubjectError> {
        let level = self.plan.level(wave);
        let body = |own| Body {
            scene,
            own,
            initial: Initial::stated(own),
            manufactured: None,
            heat: None,
            keeps_deformation: false,
            lattice: self.plan.lattice(),
        };
        let Some(solver) = self.context.solver else {
            return Ok(perturbable(&[body(scene)], self.case.method, level)?);
        };
        let bare = unloaded(scene);
        let bodies: Vec<Body<'_>> = bare.iter().map(body).collect();
        let run = HandedRun {
            load_steps: None,
            steps,
            dt: level.dt,
            until: steps as f64 * level.dt,
            instants: (1..=steps).collect(),
            particles: start(&bodies, level, &mut |_| ())?,
            initial: vec![Initial::stated(scene)],
            is_perturbed: false,
        };
        solver.subject(problem(self.context.suite, scene, None, level, run))
    }

    /// The run of a wave, for output as files.
    pub(super) fn shown(&self, wave: &Wave) -> Result<ShownRun<'static>, SubjectError> {
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

/// Capabilities that the study of `plan` requires and `solver` does not have.
pub(super) fn lacking(plan: &SpectrumPlan, solver: &dyn SolverFactory) -> Vec<String> {
    let mut lacks = solver.lacks(&needs(plan));
    if solver.precision() == Precision::Single {
        lacks.push("double precision".to_owned());
    }
    lacks
}
