//! Ranks the methods of one problem by cost.

use crate::verify::{
    CaseOutcome, Convergence, ConvergingPart, End, Exponent, LevelOutcome, Reach, Sample, TARGETS,
    grouped, pareto_front,
};
use std::cmp::Ordering;

/// A method with its levels, coarse to fine.
#[derive(Debug, Clone, PartialEq)]
pub struct MethodCost {
    /// Name of the method.
    pub name: String,
    /// Levels, coarse to fine.
    pub samples: Vec<Sample>,
    /// Theoretical order of the error.
    pub formal_order: f64,
    /// Theoretical growth of the work (see [`ErrorScale`](crate::verify::ErrorScale)).
    pub growth: f64,
}

/// A method with the cost of its accuracy.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranked {
    /// The method.
    pub method: MethodCost,
    /// Levels over which the method converges.
    pub part: ConvergingPart,
    /// Work at each target error.
    pub reaches: Vec<Reach>,
    /// Work at each target error, divided by the smallest work of all methods, if reached.
    pub times: Vec<Option<f64>>,
    /// Smallest error of the converging part, or of all levels if there is no such part.
    pub best: Option<f64>,
    /// Cost of one more digit.
    pub exponent: Option<Exponent>,
    /// Indices of the method's levels on the Pareto front.
    pub front: Vec<usize>,
}

/// The methods of one problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    /// Description of the problem.
    pub problem: String,
    /// Size of the solution, by which errors are divided.
    pub size: f64,
    /// Target errors, from coarse to fine.
    pub targets: Vec<f64>,
    /// Methods, sorted by the work at the finest target, then at the next coarser one.
    pub rows: Vec<Ranked>,
}

impl Ranking {
    /// Ranks `methods` by their work at each of `targets`.
    pub fn new(problem: String, size: f64, targets: &[f64], methods: Vec<MethodCost>) -> Self {
        let all: Vec<(usize, usize, Sample)> = methods
            .iter()
            .enumerate()
            .flat_map(|(c, one)| one.samples.iter().enumerate().map(move |(k, t)| (c, k, *t)))
            .collect();
        let every: Vec<Sample> = all.iter().map(|(_, _, samples)| *samples).collect();
        let front: Vec<(usize, usize)> =
            pareto_front(&every).into_iter().map(|i| (all[i].0, all[i].1)).collect();
        let rank = |(c, method): (usize, MethodCost)| {
            let of_front = front.iter().filter(|(owner, _)| *owner == c);
            let mut levels: Vec<usize> = of_front.map(|(_, level)| *level).collect();
            levels.sort_unstable();
            ranked(method, targets, levels)
        };
        let mut rows: Vec<Ranked> = methods.into_iter().enumerate().map(rank).collect();
        for k in 0..targets.len() {
            let works = rows.iter().filter_map(|row| row.reaches[k].work());
            let least = works.fold(f64::INFINITY, f64::min);
            for row in &mut rows {
                row.times[k] = row.reaches[k].work().map(|work| work / least);
            }
        }
        rows.sort_by(|a, b| order(&a.reaches, &b.reaches));
        Self { problem, size, targets: targets.to_vec(), rows }
    }
}

fn ranked(method: MethodCost, targets: &[f64], front: Vec<usize>) -> Ranked {
    let samples = &method.samples;
    let part = ConvergingPart::of(samples);
    let reaches: Vec<Reach> = targets.iter().map(|t| Reach::of(samples, &part, *t)).collect();
    let converging = if part.levels.is_empty() { 0..samples.len() } else { part.levels.clone() };
    let counted = samples[converging].iter().filter(|one| one.counts());
    Ranked {
        best: counted.map(|one| one.error).reduce(f64::min),
        exponent: Exponent::of(samples, &part, method.formal_order, method.growth),
        times: vec![None; targets.len()],
        reaches,
        front,
        part,
        method,
    }
}

impl Ranked {
    /// Returns the reason why the method does not reach the finest target; `None` if it does.
    pub fn obstacle(&self) -> Option<End> {
        let reached = self.reaches.last().is_some_and(|reach| reach.work().is_some());
        (!reached).then_some(self.part.end)
    }
}

/// Compares methods by the work at the finest target that at least one of them reaches.
fn order(a: &[Reach], b: &[Reach]) -> Ordering {
    let pairs = a.iter().zip(b).rev();
    let compare = |(a, b): (&Reach, &Reach)| match (a.work(), b.work()) {
        (Some(a), Some(b)) => a.total_cmp(&b),
        (Some(_), None) => Ordering::Less,
        (None, Some(_)) => Ordering::Greater,
        (None, None) => Ordering::Equal,
    };
    pairs.map(compare).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
}

/// Ranks the comparable cases of a suite, with one ranking for each problem; `work` returns the
/// work of a level. Cases without exact solution or reference, problems without an error scale, and
/// cases with fewer than three levels are excluded.
pub fn rankings<'a>(
    cases: impl IntoIterator<Item = &'a CaseOutcome>,
    work: impl Fn(&CaseOutcome, usize, &LevelOutcome) -> f64,
) -> Vec<Ranking> {
    let methods = cases.into_iter().filter_map(|case| {
        let study = case.convergence().filter(|study| study.compared)?;
        let problem = (study.error_scale.problem.as_str(), study.error_scale.size);
        let is_comparable = problem.1 > 0.0 && study.levels.len() >= 3;
        is_comparable.then(|| (problem, method(case, study, &work)))
    });
    let rank = |((problem, size), methods): ((&str, f64), Vec<MethodCost>)| {
        Ranking::new(problem.to_owned(), size, &TARGETS, methods)
    };
    grouped(methods).into_iter().map(rank).collect()
}

/// Ranks the cases of a suite by particle-node transfers, which external solvers do not count.
pub fn by_transfers(cases: &[CaseOutcome]) -> Vec<Ranking> {
    let is_counted = |case: &&CaseOutcome| {
        let levels = case.convergence().map(|study| study.levels.as_slice());
        levels.unwrap_or_default().iter().any(|level| level.run.counters.transfers > 0)
    };
    rankings(cases.iter().filter(is_counted), |_, _, level| level.run.counters.transfers as f64)
}

fn method(
    case: &CaseOutcome,
    study: &Convergence,
    work: &impl Fn(&CaseOutcome, usize, &LevelOutcome) -> f64,
) -> MethodCost {
    let window = study.judgement.window.as_deref().unwrap_or_default();
    let samples = |(k, level): (usize, &LevelOutcome)| Sample {
        spacing: level.spacing,
        error: level.error / study.error_scale.size,
        work: work(case, k, level),
        usable: level.usable,
        asymptotic: window.contains(&k),
        failed: level.run.failure.is_some(),
    };
    MethodCost {
        name: case.case.clone(),
        samples: study.levels.iter().enumerate().map(samples).collect(),
        formal_order: study.formal_order,
        growth: study.error_scale.growth,
    }
}
