//! Computes the rows of one case of a stability study: runs, predictions and limits.

use super::handed;
use super::handed::{bodies, perturb};
use crate::study::convergence::time_steps::ROUNDS;
use crate::study::kind::RunContext;
use crate::study::setup::dispatch::{perturbable, stable_time_step_of};
use crate::study::time_series::ShownRun;
use crate::subject::{Perturbable, Subject, SubjectError};
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::Extent;
use crate::suite::model::stability::{ParameterValues, RunSetup, StabilityCase, StabilityPlan};
use crate::verify::{
    Critical, Prediction, Scales, Stability, StabilityLimit, StabilityRow, Trial, amplification,
    spectral_radius, stability_limit, trial,
};

/// Number of values that are tested before the first unstable interval is bisected.
const SCAN: u32 = 48;

/// Number of values that are tested first if each test is a whole run.
const SCAN_OF_RUNS: u32 = 16;

/// Relative accuracy of predicted limits.
const SHARP: f64 = 1e-5;

/// Relative accuracy of limits that are observed in runs.
const SHARP_OF_RUNS: f64 = 5e-3;

/// Fractions of a predicted limit at which runs check the prediction. Only full runs use 0.95.
const SHARES: [f64; 4] = [0.95, 0.98, 1.02, 1.05];

/// Rounding error of a double eigenvalue 1 with only one eigenvector, such as that of rigid motion.
const DEFECT: f64 = 1e-5;

pub(super) struct CaseRun<'a> {
    pub(super) plan: &'a StabilityPlan,
    pub(super) case: &'a StabilityCase,
    pub(super) context: RunContext<'a>,
}

impl CaseRun<'_> {
    pub(super) fn row(&self, value: f64) -> StabilityRow {
        let empty = StabilityRow { value, trial: None, critical: None, refused: None };
        let found = match &self.plan.sought {
            None => self
                .run(&[(&self.plan.swept, value)])
                .map(|trial| StabilityRow { trial: Some(trial), ..empty.clone() }),
            Some(sought) => self
                .critical(value, sought)
                .map(|critical| StabilityRow { critical: Some(critical), ..empty.clone() }),
        };
        found.unwrap_or_else(|reason| StabilityRow { refused: Some(reason), ..empty })
    }

    pub(super) fn setup(&self, values: &ParameterValues<'_>) -> Result<RunSetup, SubjectError> {
        let setup = self.plan.setup.with(values);
        let mut setup = setup.map_err(|diagnostic| diagnostic.one_line())?;
        if self.context.extent == Extent::Full {
            setup.steps = setup.full_steps;
        }
        if let Some(share) = setup.rule {
            setup.dt = vec![share * self.stable_time_step(&setup)?];
        }
        Ok(setup)
    }

    /// Returns the stable time step (s); for an external solver, h divided by the wave speed.
    fn stable_time_step(&self, setup: &RunSetup) -> Result<f64, SubjectError> {
        match self.case.method {
            Method::External { .. } => Ok(setup.level.h / setup.scene.fastest_wave()),
            method => {
                let all = bodies(setup, setup.scene.each());
                stable_time_step_of(all, method, setup.level, ROUNDS)
            }
        }
    }

    fn subject(&self, setup: &RunSetup) -> Result<Box<dyn Perturbable>, SubjectError> {
        let all = bodies(setup, setup.scene.each());
        let mut subject = perturbable(all, self.case.method, setup.level)?;
        if setup.frozen {
            subject.fix_configuration();
        }
        Ok(subject)
    }

    fn run(&self, values: &ParameterValues<'_>) -> Result<Trial, SubjectError> {
        let run = || {
            let setup = self.setup(values)?;
            let mut subject = self.started(&setup)?;
            Ok(trial(subject.as_mut(), &setup.dt, setup.steps, &setup.scales))
        };
        let RunContext { suite, fingerprint, extent, .. } = self.context;
        let case = &self.case.name;
        let name = format!("{suite}::{case}, {}", said(values));
        let key = format!("{suite} {fingerprint:016x} {case} {extent:?} {values:?}");
        let broken = |trial: &Trial| trial.verdict == Stability::Failed;
        self.context.cached(&key, &name, broken, run)
    }

    fn started(&self, setup: &RunSetup) -> Result<Box<dyn Subject>, SubjectError> {
        if let Some(solver) = self.context.solver {
            return handed::subject(solver, self.context.suite, setup);
        }
        let mut subject = self.subject(setup)?;
        perturb(subject.as_mut(), setup);
        Ok(subject)
    }

    pub(super) fn shown(
        &self,
        values: &ParameterValues<'_>,
    ) -> Result<ShownRun<'static>, SubjectError> {
        let setup = self.setup(values)?;
        Ok(ShownRun {
            name: said(values),
            subject: self.started(&setup)?,
            dt: setup.dt,
            steps: setup.steps,
            truth: None,
        })
    }

    /// Searches for the stability limit of the parameter `sought`. If the particles do not move,
    /// the limit is predicted and then checked by runs. Otherwise the limit is observed in runs.
    fn critical(
        &self,
        value: f64,
        (name, low, high): &(String, f64, f64),
    ) -> Result<Critical, SubjectError> {
        let with = |sought: f64| [(self.plan.swept.as_str(), value), (name.as_str(), sought)];
        if self.plan.frozen {
            return self.predicted((*low, *high), with);
        }
        let stable = |sought: f64| -> Result<bool, SubjectError> {
            Ok(self.run(&with(sought))?.verdict == Stability::Stable)
        };
        let observed = stability_limit(*low, *high, SCAN_OF_RUNS, SHARP_OF_RUNS, stable)?;
        Ok(Critical { predicted: None, confirmed: Vec::new(), observed: Some(observed) })
    }

    fn predicted<'v>(
        &self,
        range: (f64, f64),
        with: impl Fn(f64) -> [(&'v str, f64); 2],
    ) -> Result<Critical, SubjectError> {
        let mut leaves = None;
        let stable = |sought: f64| -> Result<bool, SubjectError> {
            let setup = self.setup(&with(sought))?;
            let mut subject = self.subject(&setup)?;
            let Scales { speed, modulus, .. } = setup.scales;
            let matrix = amplification(subject.as_mut(), &setup.dt, speed, modulus)
                .map_err(|error| error.to_string())?;
            let found = spectral_radius(&matrix);
            let grows = !(found.radius <= 1.0 + DEFECT);
            if grows {
                leaves = found.eigenvalue;
            }
            Ok(!grows)
        };
        let limit = stability_limit(range.0, range.1, SCAN, SHARP, stable)?;
        let shares: Vec<(f64, f64)> = match limit {
            StabilityLimit::At(limit) => {
                let least = usize::from(self.context.extent != Extent::Full);
                SHARES[least..].iter().map(|s| (*s, s * limit)).collect()
            }
            StabilityLimit::Above(end) | StabilityLimit::Below(end) => vec![(1.0, end)],
        };
        let confirm = |(share, sought)| Ok((share, self.run(&with(sought))?));
        let confirmed = shares.into_iter().map(confirm).collect::<Result<_, SubjectError>>()?;
        Ok(Critical { predicted: Some(Prediction { limit, leaves }), confirmed, observed: None })
    }
}

/// Formats parameter values, such as `a = 1, b = 2`.
fn said(values: &ParameterValues<'_>) -> String {
    let said: Vec<String> =
        values.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    said.join(", ")
}
