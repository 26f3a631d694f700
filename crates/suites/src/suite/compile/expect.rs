//! Compiles the expectations, one for each case or none at all, and the key `any_method`.

use crate::exact::Problem;
use crate::subject::{HIGHEST_ORDER, PlaneState};
use crate::suite::compile::check::sums::refuse_law_without_energy;
use crate::suite::compile::study::CompiledStudy;
use crate::suite::evaluator::{Evaluator, SuitePath, shown, suggestion};
use crate::suite::grammar::{CrossingsName, DriftSpec, ExpectSpec};
use crate::suite::model::method::{AnyMethod, LawChoice, Method};
use crate::suite::model::{ConvergencePlan, Scene};
use crate::suite::pattern;
use crate::suite::yaml::{Diagnostic, NumberText, OneOrMany};
use crate::verify::{
    CaseFigure, Conserved, Expectation, FigureNeed, Limits, OrderHypothesis, Verdict,
};
use std::str::FromStr;

/// Expectation of a case, and its expectation for a full run if different.
pub(crate) type CaseExpectation = (Expectation, Option<Expectation>);

/// Returns the expectations in the order of the cases; all `None` if the suite states none.
pub(crate) fn expectations(
    study: &CompiledStudy<'_>,
) -> Result<Vec<Option<CaseExpectation>>, Diagnostic> {
    let (evaluator, spec, plan) = (study.evaluator, &study.spec.expect, study.plan);
    let names: Vec<String> = plan.cases.iter().map(|case| case.name.clone()).collect();
    let selectors: Vec<_> = spec.iter().map(|spec| spec.case.as_ref()).collect();
    let owners = assign(evaluator, &selectors, &names)?;
    let both = |(i, spec): (usize, &ExpectSpec)| {
        let path = evaluator.top("expect").then(i);
        Ok((expectation(&path, spec, plan)?, in_full(&path, spec, plan)?))
    };
    let parsed = spec.iter().enumerate().map(both).collect::<Result<Vec<CaseExpectation>, _>>()?;
    for (owner, case) in owners.iter().zip(&plan.cases) {
        let Some(owner) = *owner else { continue };
        let path = evaluator.top("expect").then(owner);
        check_drift(&path, &parsed[owner].0.limits, case.method)?;
        if let Some(full) = &parsed[owner].1 {
            check_drift(&path.then("full"), &full.limits, case.method)?;
        }
    }
    Ok(owners.into_iter().map(|owner| Some(parsed[owner?].clone())).collect())
}

/// Returns for each case the index of its only entry of `expect`; `None` without entries.
pub(crate) fn assign(
    evaluator: &Evaluator<'_>,
    selectors: &[Option<&OneOrMany<String>>],
    names: &[String],
) -> Result<Vec<Option<usize>>, Diagnostic> {
    if selectors.is_empty() {
        return Ok(vec![None; names.len()]);
    }
    let path = evaluator.top("expect");
    let speaks = |i: usize, name: &str| {
        selectors[i]
            .is_none_or(|globs| globs.as_slice().iter().any(|glob| pattern::fits(glob, name)))
    };
    for (i, selector) in selectors.iter().enumerate() {
        let Some(globs) = selector else { continue };
        let idle = |glob: &String| !names.iter().any(|name| pattern::fits(glob, name));
        if let Some(k) = globs.as_slice().iter().position(idle) {
            let at = path.then(i).then("case").alternative(globs, k);
            let message = format!("`{}` matches no case", globs.as_slice()[k]);
            return at.refuse(&message, &format!("cases: {}", names.join(", ")));
        }
    }
    let owner = |name: &String| {
        let owners: Vec<usize> = (0..selectors.len()).filter(|i| speaks(*i, name)).collect();
        match owners[..] {
            [only] => Ok(Some(only)),
            [] => Err(path.diagnostic_at_key(&format!("the case `{name}` has no expectation"))),
            [_, second, ..] => {
                let message = format!("a second expectation for the case `{name}`");
                Err(path.then(second).diagnostic(&message))
            }
        }
    };
    names.iter().map(owner).collect()
}

fn in_full(
    path: &SuitePath<'_>,
    spec: &ExpectSpec,
    plan: &ConvergencePlan,
) -> Result<Option<Expectation>, Diagnostic> {
    let Some(full) = &spec.full else { return Ok(None) };
    let path = path.then("full");
    for (key, given) in [("case", full.case.is_some()), ("full", full.full.is_some())] {
        if given {
            let message = format!("the expectation of a full run cannot have its own `{key}`");
            return path.then(key).refuse_key(&message, "remove it");
        }
    }
    expectation(&path, full, plan).map(Some)
}

fn expectation(
    path: &SuitePath<'_>,
    spec: &ExpectSpec,
    plan: &ConvergencePlan,
) -> Result<Expectation, Diagnostic> {
    let limits = limits(path, spec, plan)?;
    let verdict = match &spec.verdict {
        Some(word) => Some(verdict(&path.then("verdict"), word)?),
        None if spec.order.is_some() => Some(Verdict::Converging),
        None if !limits.is_empty() => None,
        None => {
            let diagnostic =
                path.diagnostic("this expectation has no order, no verdict and no bound");
            let help = "add `order: [1.9, 2.1]`, `verdict: divergent` or `error_below: 1e-12`";
            return Err(diagnostic.with_help(help));
        }
    };
    let because = path.because("this expectation", &spec.because)?;
    let bounds = |key: &str, spec: &Option<Vec<NumberText>>| {
        spec.as_ref().map(|pair| path.then(key).interval(pair)).transpose()
    };
    let order = bounds("order", &spec.order)?;
    if let Some((low, high)) = order
        && let Some(reason) = OrderHypothesis::within(low, low, high).diagnostic()
    {
        return path.then("order").expected("positive orders, no more than 1 apart", &reason);
    }
    Ok(Expectation {
        verdict,
        order,
        finest_pair: bounds("finest_pair", &spec.finest_pair)?,
        crossings: spec.crossings.map(|name| name == CrossingsName::Some),
        floor: spec.floor,
        limits,
        because,
    })
}

fn verdict(path: &SuitePath<'_>, word: &str) -> Result<Verdict, Diagnostic> {
    Verdict::from_str(word).map_err(|_| {
        let known: Vec<String> = Verdict::ALL.iter().map(|verdict| verdict.key()).collect();
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let diagnostic = path.diagnostic(&format!("`{word}` is not a verdict"));
        diagnostic.with_help(&suggestion("verdicts", word, &known))
    })
}

fn limits(
    path: &SuitePath<'_>,
    spec: &ExpectSpec,
    plan: &ConvergencePlan,
) -> Result<Limits, Diagnostic> {
    let bound = |(figure, text): (CaseFigure, &NumberText)| {
        Ok((figure, path.then(figure.name()).positive(text, "a bound")?))
    };
    let limits = Limits {
        bounds: spec.bounds().into_iter().map(bound).collect::<Result<_, Diagnostic>>()?,
        drift: match &spec.drift {
            Some(spec) => drifts(&path.then("drift"), spec, plan)?,
            None => Vec::new(),
        },
        energy_rate: match &spec.energy_rate {
            Some(spec) => {
                let path = path.then("energy_rate");
                refuse_law_without_energy(&path, &plan.scene)?;
                Some(path.interval(spec)?)
            }
            None => None,
        },
    };
    let bounds = [CaseFigure::ErrorBelow, CaseFigure::ErrorAbove].map(|side| limits.bound(side));
    if let [Some(most), Some(least)] = bounds
        && most < least
    {
        let message = format!("no error is below {most:e} and above {least:e}");
        return Err(path.then("error_above").diagnostic(&message));
    }
    for (figure, _) in &limits.bounds {
        refuse_missing_figure(&path.then(figure.name()), *figure, plan)?;
    }
    Ok(limits)
}

fn refuse_missing_figure(
    path: &SuitePath<'_>,
    figure: CaseFigure,
    plan: &ConvergencePlan,
) -> Result<(), Diagnostic> {
    let is_at_rest = || plan.exact.as_ref().is_some_and(|truth| truth.at_rest);
    let (has_figure, message, help) = match figure.need() {
        FigureNeed::Nothing => return Ok(()),
        FigureNeed::ObservedPlace => (
            plan.observe.is_some(),
            "`observed_within` needs an observed point, but the suite has no `observe`",
            "add `observe: {at: [...]}` to the suite",
        ),
        FigureNeed::StateOfRest => (
            is_at_rest(),
            "`rest_below` needs an `equilibrium`",
            "state the exact solution under `equilibrium`",
        ),
    };
    if has_figure {
        return Ok(());
    }
    path.refuse_key(message, help)
}

fn drifts(
    path: &SuitePath<'_>,
    spec: &DriftSpec,
    plan: &ConvergencePlan,
) -> Result<Vec<(Conserved, f64)>, Diagnostic> {
    let mut drifts = Vec::new();
    for &sum in Conserved::ALL {
        let text = match sum {
            Conserved::Mass => &spec.mass,
            Conserved::Momentum => &spec.momentum,
            Conserved::AngularMomentum => &spec.angular_momentum,
            Conserved::KineticEnergy => &spec.kinetic_energy,
            Conserved::KineticEnergyGain => &spec.kinetic_energy_gain,
            Conserved::Energy => &spec.energy,
        };
        let Some(text) = text else { continue };
        let path = path.then(sum.name());
        if sum == Conserved::AngularMomentum && plan.scene.dimension() == 1 {
            return Err(path.diagnostic_at_key("there is no angular momentum in 1-D"));
        }
        let is_revolved = plan.scene.plane == PlaneState::Axisymmetric;
        if is_revolved && matches!(sum, Conserved::Momentum | Conserved::AngularMomentum) {
            let message = "this sum over the meridian plane is not conserved in a body of \
                           revolution";
            return path.refuse_key(message, "bound the drift of `mass` or of an energy");
        }
        if sum == Conserved::Energy {
            refuse_law_without_energy(&path, &plan.scene)?;
        }
        drifts.push((sum, path.positive(text, "a bound")?));
    }
    if drifts.is_empty() {
        let names: Vec<&str> = Conserved::ALL.iter().map(|sum| sum.name()).collect();
        return path
            .refuse("`drift` is empty", &format!("add one or more of: {}", names.join(", ")));
    }
    Ok(drifts)
}

fn check_drift(path: &SuitePath<'_>, limits: &Limits, method: Method) -> Result<(), Diagnostic> {
    let key = if limits.energy_rate.is_some() { "energy_rate" } else { "drift" };
    let asks = !limits.drift.is_empty() || limits.energy_rate.is_some();
    let asks_of_energy =
        limits.energy_rate.is_some() || limits.drifts().contains(&Conserved::Energy);
    if asks_of_energy && method.averages_volume() {
        let message = "the force of `volume: averaged` does not derive from a stored energy";
        return path.then(key).refuse_key(message, "bound the drift of `momentum` or `mass`");
    }
    if !asks || matches!(method, Method::Mpm(_) | Method::External { .. }) {
        return Ok(());
    }
    let message = match method {
        Method::QuasiStatic { .. } => "load steps have no motion whose sums could drift",
        Method::Heat { .. } => "a body at rest has no motion whose sums could drift",
        _ => "the built-in FEM does not compute the sums whose drift is bounded here",
    };
    path.then(key).refuse_key(message, "restrict this expectation to MPM cases")
}

/// Number of points along each axis, and of time intervals, in `has_gradients_up_to`.
const PLACES: usize = 5;

/// Displacement gradients up to this value count as rounding errors.
const UNDEFORMED: f64 = 1e-14;

/// Maximum displacement gradient at which another isotropic elastic law may replace the law of a
/// suite. Stresses of laws with equal moduli differ by a fraction of about this size.
const SMALL: f64 = 1e-3;

pub(crate) fn any_method(study: &CompiledStudy<'_>) -> Result<AnyMethod, Diagnostic> {
    let Some(spec) = &study.spec.any_method else { return Ok(AnyMethod::default()) };
    let path = study.evaluator.top("any_method");
    let because = path.because("this requirement", &spec.because)?;
    let order = spec.order.as_ref().map(|text| {
        let path = path.then("order");
        let order = path.positive(text, "the order")?;
        if order <= HIGHEST_ORDER {
            return Ok(order);
        }
        let message = format!("the order is {}", shown(order));
        let label = format!("expected an order up to {HIGHEST_ORDER}");
        Err(path.diagnostic(&message).with_label(&label))
    });
    let error_below = spec
        .error_below
        .as_ref()
        .map(|text| path.then("error_below").positive(text, "the bound on errors"));
    let (order, error_below) = (order.transpose()?, error_below.transpose()?);
    let gated = spec.gated.unwrap_or(true);
    let has_bounds = order.is_some() || error_below.is_some();
    if gated && !has_bounds && !spec.any_law {
        let diagnostic = path.diagnostic("this entry states no requirement");
        let help = "add `order: 1`, `error_below: 1e-12`, `any_law: true` or `gated: false`";
        return Err(diagnostic.with_help(help));
    }
    if !gated && has_bounds {
        let message = "with `gated: false`, a required order or bound has no effect";
        let diagnostic = path.then("gated").diagnostic_at_key(message);
        return Err(diagnostic.with_help("remove `gated`, or `order` and `error_below`"));
    }
    let law = if spec.any_law { replaceable_law(study.plan) } else { LawChoice::Stated };
    if spec.any_law && law == LawChoice::Stated {
        let message = "the solution depends on the law, because it is neither a translation nor a \
                       small strain of isotropic elastic bodies";
        return path.then("any_law").refuse(message, "remove `any_law`");
    }
    Ok(AnyMethod { order, error_below, law, gated, because })
}

/// Returns the laws that give the exact solution of `plan`.
fn replaceable_law(plan: &ConvergencePlan) -> LawChoice {
    let Some(problem) = plan.exact.as_ref().filter(|problem| problem.initial_stress.is_none())
    else {
        return LawChoice::Stated;
    };
    let is_elastic = |body: &Scene| body.material.is_isotropic_elastic();
    if has_gradients_up_to(problem, UNDEFORMED) {
        LawChoice::Any
    } else if has_gradients_up_to(problem, SMALL) && plan.scene.each().iter().all(is_elastic) {
        LawChoice::SameModuli
    } else {
        LawChoice::Stated
    }
}

/// Whether no entry of the displacement gradient exceeds `limit`, at a lattice of positions and
/// times.
fn has_gradients_up_to(problem: &Problem, limit: f64) -> bool {
    let d = problem.dimension();
    let along = |axis: usize, k: usize| {
        let length = problem.to[axis] - problem.from[axis];
        problem.from[axis] + length * (k as f64 + 0.5) / PLACES as f64
    };
    let place = |point: usize| -> Vec<f64> {
        (0..d).map(|axis| along(axis, point / PLACES.pow(axis as u32) % PLACES)).collect()
    };
    let is_small = |label: &[f64], t: f64| {
        let gradient = problem.motion.derivatives(label, t).grad;
        gradient.iter().flatten().all(|entry| entry.abs() <= limit)
    };
    let times = || (0..=PLACES).map(|k| problem.until * k as f64 / PLACES as f64);
    (0..PLACES.pow(d as u32)).map(place).all(|label| times().all(|t| is_small(&label, t)))
}
