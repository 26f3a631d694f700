//! Running a suite: every level of every case, judged.

use super::{
    dispatch::{cell_size, subject},
    force,
    model::{Against, Case, ConvergencePlan, ForceCase, ForcePlan, StudyPlan, Suite},
    reference::Reference,
    statement,
    words::{CrossingLevels, NormName},
};
use crate::{
    exact::Truth,
    subject::Subject,
    verify::{
        self, CaseOutcome, Claim, Clock, Convergence, ForceRow, Judgement, LevelOutcome,
        Richardson, Run, Seen, Study, SuiteOutcome, judge,
    },
};
use rayon::prelude::*;
use std::sync::OnceLock;

/// Told after each level (or internal-force case) that is done.
pub type Progress<'a> = &'a (dyn Fn() + Sync);

/// Runs cases of one suite. A reference that several cases share is computed once.
pub struct Runner<'a> {
    suite: &'a Suite,
    references: Vec<(f64, OnceLock<Result<Reference, String>>)>,
}

impl<'a> Runner<'a> {
    /// A runner; nothing runs yet.
    pub fn new(suite: &'a Suite) -> Self {
        let mut ends: Vec<f64> = match &suite.study {
            StudyPlan::Convergence(plan) => plan.cases.iter().map(|case| case.until).collect(),
            StudyPlan::InternalForce(_) => Vec::new(),
        };
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let references = ends.into_iter().map(|end| (end, OnceLock::new())).collect();
        Self { suite, references }
    }

    /// Units of progress of the whole suite.
    pub fn units(&self) -> u64 {
        match &self.suite.study {
            StudyPlan::Convergence(plan) => (plan.cases.len() * plan.cells.len()) as u64,
            StudyPlan::InternalForce(plan) => plan.cases.len() as u64,
        }
    }

    /// Runs every case, in parallel; outcomes keep the order of the suite, so the number of
    /// threads cannot be seen in them.
    pub fn run(&self, progress: Progress<'_>) -> SuiteOutcome {
        let count = self.suite.case_names().len();
        self.outcome((0..count).into_par_iter().map(|i| self.case(i, progress)).collect())
    }

    /// The outcome of the suite, made of those of all its cases.
    pub fn outcome(&self, cases: Vec<CaseOutcome>) -> SuiteOutcome {
        SuiteOutcome {
            suite: self.suite.name.clone(),
            title: self.suite.title.clone(),
            source: self.suite.source.clone(),
            about: self.suite.about.trim().to_owned(),
            statement: statement::rows(self.suite),
            cases,
        }
    }

    /// Runs the case with the given index.
    ///
    /// # Panics
    /// If there is no such case.
    pub fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome {
        match &self.suite.study {
            StudyPlan::Convergence(plan) => self.convergence(plan, &plan.cases[index], progress),
            StudyPlan::InternalForce(plan) => internal_force(plan, &plan.cases[index], progress),
        }
    }

    fn convergence(
        &self,
        plan: &ConvergencePlan,
        case: &Case,
        progress: Progress<'_>,
    ) -> CaseOutcome {
        let levels: Result<Vec<LevelOutcome>, String> = plan
            .cells
            .par_iter()
            .map(|cells| {
                let level = self.level(plan, case, *cells);
                progress();
                level
            })
            .collect();
        match levels {
            Ok(levels) => judged(plan, case, levels),
            Err(reason) => refused(case, reason),
        }
    }

    fn level(
        &self,
        plan: &ConvergencePlan,
        case: &Case,
        cells: u64,
    ) -> Result<LevelOutcome, String> {
        let truth = self.truth(plan, case)?;
        let mut subject = subject(plan, case.method, cells)?;
        let h = cell_size(&plan.scene, cells);
        let clock = Clock::new(case.until, plan.dt.eval(&[h]), plan.instants)
            .ok_or("the time step makes no sense")?;
        let observe = plan.observe.as_deref();
        let run = verify::run(&mut *subject as &mut dyn Subject, truth, &clock, observe);
        let crossed = run.census.crossings.is_some_and(|n| n > 0);
        let excluded = crossed && plan.crossing_levels == CrossingLevels::Excluded;
        let ppc = plan.ppc.filter(|_| run.census.particles.is_some());
        Ok(LevelOutcome { cells, h, dt: clock.dt(), ppc, usable: !excluded, order: None, run })
    }

    fn truth(&self, plan: &'a ConvergencePlan, case: &Case) -> Result<&dyn Truth, String> {
        if case.against == Against::Exact {
            let exact = plan.exact.as_ref().ok_or("the suite declares no exact solution")?;
            return Ok(&exact.motion);
        }
        let found = self.references.iter().find(|(until, _)| *until == case.until);
        let (until, reference) = found.ok_or("no reference for this case")?;
        match reference.get_or_init(|| Reference::compute(plan, *until)) {
            Ok(reference) => Ok(reference),
            Err(reason) => Err(reason.clone()),
        }
    }
}

fn error_of(norm: NormName, run: &Run) -> f64 {
    match norm {
        NormName::Rms => run.errors.rms,
        NormName::L1 => run.errors.l1,
        NormName::L2 => run.errors.l2,
        NormName::Linf => run.errors.linf,
        NormName::MaxRms => run.max_rms,
    }
}

fn judged(plan: &ConvergencePlan, case: &Case, mut levels: Vec<LevelOutcome>) -> CaseOutcome {
    let judgement = judge_levels(plan, case, &levels);
    for (level, order) in levels.iter_mut().zip(&judgement.pairwise) {
        level.order = *order;
    }
    let finest = levels.last();
    let seen = Seen {
        verdict: judgement.verdict,
        order: judgement.order.map(|order| (order.low, order.high)),
        finest_pair: finest.and_then(|level| level.order),
        crossings: finest.and_then(|level| level.run.census.crossings),
    };
    CaseOutcome {
        verdict: judgement.verdict.to_string(),
        reason: judgement.reason.clone(),
        unmet: case.expectation.unmet(&seen),
        study: Study::Convergence(Box::new(Convergence {
            formal_order: case.method.formal_order(),
            richardson: richardson(&levels),
            observed_at: plan.observe.as_ref().map(|place| place[0]),
            norm: plan.norm.name(),
            judgement,
            levels,
        })),
        ..described(case)
    }
}

fn judge_levels(plan: &ConvergencePlan, case: &Case, levels: &[LevelOutcome]) -> Judgement {
    let judged: Vec<verify::Level> = levels
        .iter()
        .map(|level| {
            let plain = verify::Level::new(level.h, error_of(plan.norm, &level.run));
            let plain = if level.usable { plain } else { plain.unusable() };
            match &level.run.failure {
                Some(reason) => plain.failing(reason.clone()),
                None => plain,
            }
        })
        .collect();
    let claim =
        Claim { formal_order: case.method.formal_order(), expected: case.expectation.order };
    judge(&judged, &claim)
}

/// Richardson's extrapolation for each triple of levels with n, 2n and 4n cells.
fn richardson(levels: &[LevelOutcome]) -> Vec<([u64; 3], Richardson)> {
    let value = |cells: u64| {
        levels.iter().find(|level| level.cells == cells).and_then(|level| level.run.displacement)
    };
    levels
        .iter()
        .filter_map(|level| {
            let cells = [level.cells, 2 * level.cells, 4 * level.cells];
            let values = [value(cells[0])?, value(cells[1])?, value(cells[2])?];
            Some((cells, Richardson::equal_ratio(values, 2.0)))
        })
        .collect()
}

/// What is known of a case before it runs.
fn described(case: &Case) -> CaseOutcome {
    CaseOutcome {
        case: case.name.clone(),
        subject: case.method.subject(),
        settings: statement::settings(case),
        expected: case.expectation.summary(),
        because: case.expectation.because.clone(),
        verdict: String::new(),
        reason: String::new(),
        unmet: Vec::new(),
        study: Study::Refused,
    }
}

fn refused(case: &Case, reason: String) -> CaseOutcome {
    CaseOutcome {
        verdict: verify::Verdict::Failed.to_string(),
        unmet: vec![format!("the case could not be run: {reason}")],
        reason,
        ..described(case)
    }
}

fn internal_force(plan: &ForcePlan, case: &ForceCase, progress: Progress<'_>) -> CaseOutcome {
    let rows = force::rows(plan, case);
    progress();
    let deviation = deviation(&rows);
    let agrees = deviation <= case.agrees_within;
    let reason = format!(
        "largest deviation from the prediction {deviation:.1e} of the largest predicted force, \
         over {} positions",
        rows.len()
    );
    let wanted = format!("agrees with the prediction within {:e}", case.agrees_within);
    let unmet = if agrees { Vec::new() } else { vec![format!("expected: {wanted}; {reason}")] };
    CaseOutcome {
        case: case.name.clone(),
        subject: "mpm",
        settings: vec![("basis".to_owned(), case.basis.name().to_owned())],
        expected: wanted,
        because: case.because.clone(),
        verdict: if agrees { "agrees" } else { "differs" }.to_owned(),
        reason,
        unmet,
        study: Study::InternalForce(rows),
    }
}

/// Largest deviation relative to the largest prediction; NaN if any force is.
fn deviation(rows: &[ForceRow]) -> f64 {
    let largest = |value: &dyn Fn(&ForceRow) -> f64| {
        rows.iter()
            .map(value)
            .fold(0.0, |a: f64, b| if (a + b).is_nan() { f64::NAN } else { a.max(b.abs()) })
    };
    largest(&|row| row.force - row.predicted) / largest(&|row| row.predicted)
}
