//! Compiles a gradient study: functional, parameters, exact sensitivities, and expectations.

use super::convergence::convergence_plan;
use super::expect::assign;
use super::scene;
use crate::exact::ParametricMotion;
use crate::subject::{Functional, GradientParameter, PlaneState, Precision};
use crate::suite::evaluator::{Evaluator, SuitePath, coordinates_and_time, shown, suggestion};
use crate::suite::grammar::{
    FunctionalSpec, GradientExpectSpec, GradientSpec, MethodSpec, ParameterSpec,
};
use crate::suite::model::gradient::{Differentiated, GradientCase, GradientPlan, SweepPlan};
use crate::suite::model::{Case, ConvergencePlan, Scene};
use crate::suite::yaml::{Diagnostic, NumberText};
use crate::verify::{Axis, GradientTerms};

const MOST_POINTS: u64 = 1000;

/// Relative change of a parameter for which the stated solution must still hold.
const CHANGE: f64 = 1.0 / 64.0;

struct GradientDraft<'a> {
    evaluator: &'a Evaluator<'a>,
    spec: &'a GradientSpec,
    problem: ConvergencePlan,
}

pub(crate) fn plan(
    evaluator: &Evaluator<'_>,
    spec: &GradientSpec,
) -> Result<GradientPlan, Diagnostic> {
    let methods = methods(evaluator, spec)?;
    let problem = convergence_plan(evaluator, &spec.convergence(methods))?;
    let draft = GradientDraft { evaluator, spec, problem };
    refuse_unfit_problem(&draft)?;
    let of = functional(&draft)?;
    let parameters = parameters(&draft)?;
    let level = level(&draft)?;
    let sweep = sweep(evaluator, spec, &parameters)?;
    let problem = draft.problem;
    let mut plan = GradientPlan { problem, of, parameters, level, sweep, cases: Vec::new() };
    plan.cases = cases(evaluator, spec, &plan)?;
    Ok(plan)
}

/// Returns the external solvers of the suite; a single unnamed solver if the suite states none.
fn methods(evaluator: &Evaluator<'_>, spec: &GradientSpec) -> Result<Vec<MethodSpec>, Diagnostic> {
    let is_other = |method: &MethodSpec| !matches!(method, MethodSpec::External { .. });
    if let Some(i) = spec.methods.iter().position(is_other) {
        let message =
            "a gradient study needs an external solver: the built-in solvers have no gradients";
        let diagnostic = evaluator.top("methods").then(i).diagnostic(message);
        return Err(diagnostic.with_help("write `external: {name: my-solver}`"));
    }
    if !spec.methods.is_empty() {
        return Ok(spec.methods.clone());
    }
    let (name, precision) = ("solver".to_owned(), Some(Precision::Double));
    Ok(vec![MethodSpec::External { name, formal_order: None, precision }])
}

fn refuse_unfit_problem(draft: &GradientDraft<'_>) -> Result<(), Diagnostic> {
    let GradientDraft { evaluator, spec, problem } = draft;
    let scene: &Scene = &problem.scene;
    let (key, truth) = spec.truth();
    let is_displacement =
        truth.is_some_and(|truth| truth.displacement.is_some() && truth.temperature.is_none());
    let has_several_ends = spec.run.until.as_ref().is_some_and(|until| until.as_slice().len() > 1);
    let is_displaced = !scene.initial_displacement.is_empty();
    let is_stressed = !scene.initial_stress.is_none();
    let has_instants = spec.run.instants.is_some();
    let (study, body) = ("a gradient study", "the body of a gradient study");
    let (exact, step) =
        ("the exact solution of a gradient study", "the time step of a gradient study");
    let refused = [
        (!scene.bodies.is_empty(), "scene.bodies", study, "supports a single body only"),
        (scene.outline.is_some(), "scene.body", body, "must be a box"),
        (scene.plane != PlaneState::Strain, "scene.plane", study, "must be in plane strain"),
        (is_displaced, "scene.initial_displacement", body, "must start undeformed"),
        (scene.density.uniform().is_none(), "scene.material", body, "must have a uniform density"),
        (is_stressed, "scene.initial_stress", body, "must start without stress"),
        (has_several_ends, "run.until", study, "must have a single end time"),
        (spec.run.load_steps.is_some(), "run.load_steps", study, "does not support load steps"),
        (has_instants, "run.instants", study, "uses the state at the end of the run only"),
        (!is_displacement, key, exact, "must be a displacement"),
        (problem.refine.axis != Axis::Space, "refine", study, "must refine `cells`"),
        (problem.refine.rule.is_some(), "run.dt", step, "must not depend on the method"),
    ];
    match refused.iter().find(|(applies, ..)| *applies) {
        Some((_, path, subject, rule)) => {
            Err(evaluator.top(path).diagnostic_at_key(&format!("{subject} {rule}")))
        }
        None => Ok(()),
    }
}

fn index(
    path: &SuitePath<'_>,
    text: &NumberText,
    what: &str,
    count: usize,
) -> Result<usize, Diagnostic> {
    let value = path.number(text)?;
    if value >= 0.0 && value.fract() == 0.0 && value < count as f64 {
        return Ok(value as usize);
    }
    let diagnostic = path.diagnostic(&format!("the {what} is {}", shown(value)));
    Err(diagnostic.with_label(&format!("expected a whole number from 0 to {}", count - 1)))
}

fn functional(draft: &GradientDraft<'_>) -> Result<Functional, Diagnostic> {
    let GradientDraft { evaluator, spec, problem } = draft;
    let path = evaluator.top("gradient.of");
    let axis = |name: &str, text: &NumberText| {
        let count = problem.scene.dimension();
        index(&path.then(name).then("axis"), text, "axis", count)
    };
    Ok(match &spec.gradient.of {
        FunctionalSpec::MeanDisplacement { axis: text } => {
            Functional::MeanDisplacement { axis: axis("mean_displacement", text)? }
        }
        FunctionalSpec::MeanSquareDisplacement => Functional::MeanSquareDisplacement,
        FunctionalSpec::KineticEnergy => Functional::KineticEnergy,
        FunctionalSpec::PositionOf { particle, axis: text } => {
            let count = coarsest_particles(problem);
            let at = path.then("position_of").then("particle");
            let particle = index(&at, particle, "index of the particle", count)?;
            Functional::PositionOf { particle, axis: axis("position_of", text)? }
        }
    })
}

fn coarsest_particles(problem: &ConvergencePlan) -> usize {
    let scene = &problem.scene;
    let Some(level) = problem.refine.levels.first() else { return 1 };
    let cells = scene.from.iter().zip(&scene.to).map(|(from, to)| (to - from) / level.h);
    let cells: f64 = cells.map(libm::round).product();
    (cells * level.ppc.unwrap_or(1) as f64).max(1.0) as usize
}

fn parameters(draft: &GradientDraft<'_>) -> Result<Vec<Differentiated>, Diagnostic> {
    let path = draft.evaluator.top("gradient.with_respect_to");
    let entries = draft.spec.gradient.with_respect_to.as_slice();
    if entries.is_empty() {
        return path
            .refuse("`with_respect_to` names no parameter", "write `with_respect_to: {young: E}`");
    }
    let one = |(key, name): &(String, String)| {
        let path = path.then(key.as_str());
        let all = GradientParameter::ALL;
        let Some(parameter) = all.iter().find(|one| one.name() == key) else {
            let known: Vec<&str> = all.iter().map(|one| one.name()).collect();
            let message = format!("`{key}` is not a parameter of the problem");
            return path.refuse_key(&message, &suggestion("parameters", key, &known));
        };
        differentiated(&path, draft, *parameter, name)
    };
    let all = entries.iter().map(one).collect::<Result<Vec<Differentiated>, Diagnostic>>()?;
    let has_velocity = all.iter().any(|one| one.parameter == GradientParameter::InitialVelocity);
    let is_total = |one: &Differentiated| {
        one.velocity_factor != 0.0 && one.parameter != GradientParameter::InitialVelocity
    };
    match all.iter().find(|one| is_total(one)) {
        Some(one) if !has_velocity => {
            let name = &one.name;
            let message = format!("the initial velocity depends on `{name}`");
            path.then(one.parameter.name())
                .refuse(&message, "add `initial_velocity` to `with_respect_to`")
        }
        _ => Ok(all),
    }
}

/// Returns the problem parameter that the suite parameter `name` sets.
fn differentiated(
    path: &SuitePath<'_>,
    draft: &GradientDraft<'_>,
    parameter: GradientParameter,
    name: &String,
) -> Result<Differentiated, Diagnostic> {
    let GradientDraft { spec, problem, .. } = draft;
    let declared = spec.parameters.as_slice();
    if spec.parameters.get(name).is_none() {
        let known: Vec<&str> = declared.iter().map(|(name, _)| name.as_str()).collect();
        let message = format!("`{name}` is not a parameter of this suite");
        return path.refuse(&message, &suggestion("parameters", name, &known));
    }
    let value = path.number(&NumberText::Formula(name.clone()))?;
    if value == 0.0 {
        let message = format!("`{name}` is 0, but perturbations are relative to its value");
        return path.expected("a value other than 0", &message);
    }
    let motion = motion(draft, name, value)?;
    let factor = motion.velocity_factor().ok_or_else(|| {
        path.diagnostic(&format!("the shape of the initial velocity depends on `{name}`"))
    })?;
    if spec.equilibrium.is_none() && !motion.starts_at_rest_position() {
        let message = "the body of a gradient study must start undeformed";
        let path = path.evaluator.top("exact.displacement");
        return Err(path.diagnostic_at_key(message));
    }
    let growth = factor * value;
    let other = value * (1.0 + CHANGE);
    let is_set = sets(parameter, &problem.scene, value, growth)
        && with_value(draft, name, other, |evaluator| {
            let scene = scene::scene(evaluator, &spec.scene)?;
            Ok(sets(parameter, &scene, other, growth))
        })?;
    if !is_set {
        let key = parameter.name();
        let message = format!("`{name}` does not set the parameter `{key}` of the problem");
        let help = match parameter {
            GradientParameter::InitialVelocity => {
                format!("the initial velocity must be proportional to `{name}`")
            }
            _ => format!("write `{key}: {name}` in the scene"),
        };
        return path.refuse(&message, &help);
    }
    let solver =
        MethodSpec::External { name: "solver".to_owned(), formal_order: None, precision: None };
    let check = |evaluator: &Evaluator<'_>| {
        convergence_plan(evaluator, &spec.convergence(vec![solver])).map(|_| ())
    };
    with_value(draft, name, other, check).map_err(|error| {
        let reason = error.message();
        path.diagnostic(&format!("the suite is not valid for {name} = {}: {reason}", shown(other)))
    })?;
    Ok(Differentiated { parameter, name: name.clone(), motion, velocity_factor: factor })
}

/// Whether the suite parameter sets `parameter` in `scene`. An initial velocity must be
/// proportional to it: its relative `growth` is 1.
fn sets(parameter: GradientParameter, scene: &Scene, value: f64, growth: f64) -> bool {
    let of_material = || {
        let parameters = scene.material.keyed_parameters();
        parameters.into_iter().find(|(key, _)| *key == parameter.name()).map(|(_, value)| value)
    };
    match parameter {
        GradientParameter::InitialVelocity => (growth - 1.0).abs() <= 1e-12,
        GradientParameter::Density => scene.density.uniform() == Some(value),
        GradientParameter::Friction => scene
            .faces
            .iter()
            .any(|face| face.hold.numbers().constants.contains(&("coefficient", value))),
        _ => of_material() == Some(value),
    }
}

/// Returns the result of `check` for the suite with a changed value of a suite parameter.
fn with_value<T>(
    GradientDraft { evaluator, spec, .. }: &GradientDraft<'_>,
    name: &str,
    value: f64,
    check: impl FnOnce(&Evaluator<'_>) -> Result<T, Diagnostic>,
) -> Result<T, Diagnostic> {
    let number = ParameterSpec::Number(NumberText::Number(value));
    let parameters = spec.parameters.clone().with(name, number);
    let (evaluator, _) = Evaluator::new(evaluator.source(), &parameters, &spec.functions)?;
    check(&evaluator)
}

fn motion(
    GradientDraft { evaluator, spec, problem }: &GradientDraft<'_>,
    name: &str,
    value: f64,
) -> Result<ParametricMotion, Diagnostic> {
    let free = evaluator.with_free(name, &spec.parameters, &spec.functions)?;
    let (key, truth) = spec.truth();
    let path = free.top(key).then("displacement");
    let mut variables = coordinates_and_time(problem.scene.dimension());
    variables.push(name);
    let texts = truth.and_then(|truth| truth.displacement.as_ref());
    let texts = texts.into_iter().flatten().enumerate();
    let formulas = texts.map(|(i, text)| path.then(i).formula(text, &variables));
    Ok(ParametricMotion {
        from: problem.scene.from.clone(),
        to: problem.scene.to.clone(),
        displacement: formulas.collect::<Result<_, _>>()?,
        value,
    })
}

/// Returns the index of the level whose parameters are perturbed.
fn level(draft: &GradientDraft<'_>) -> Result<usize, Diagnostic> {
    let GradientDraft { evaluator, spec, problem } = draft;
    let levels = &problem.refine.levels[..problem.refine.usual];
    let Some(text) = &spec.gradient.cells else { return Ok(levels.len().saturating_sub(1)) };
    let path = evaluator.top("gradient.cells");
    let cells = path.count(text, "the number of cells")?;
    levels.iter().position(|level| level.cells == cells).ok_or_else(|| {
        let known: Vec<String> = levels.iter().map(|level| level.cells.to_string()).collect();
        let diagnostic = path.diagnostic(&format!("no level has {cells} cells"));
        diagnostic.with_label(&format!("expected one of {}", known.join(", ")))
    })
}

fn sweep(
    evaluator: &Evaluator<'_>,
    spec: &GradientSpec,
    parameters: &[Differentiated],
) -> Result<Option<SweepPlan>, Diagnostic> {
    let Some(sweep) = &spec.gradient.sweep else { return Ok(None) };
    let path = evaluator.top("gradient.sweep");
    let found = parameters.iter().find(|one| one.parameter.name() == sweep.parameter);
    let Some(parameter) = found.map(|one| one.parameter) else {
        let known: Vec<&str> = parameters.iter().map(|one| one.parameter.name()).collect();
        let message = format!("`{}` is not among `with_respect_to`", sweep.parameter);
        let diagnostic = path.then("parameter").diagnostic(&message);
        return Err(diagnostic.with_help(&suggestion("parameters", &sweep.parameter, &known)));
    };
    let at = path.then("within");
    let within = at.positive(&sweep.within, "half of the interval")?;
    if !(within < 1.0) {
        let message = format!("half of the interval is {} of the parameter", shown(within));
        return at.expected("a share below 1", &message);
    }
    let at = path.then("points");
    let points = at.count(&sweep.points, "the number of points")?;
    if !(2..=MOST_POINTS).contains(&points) {
        return at.expected(&format!("2 to {MOST_POINTS}"), &format!("a sweep of {points} points"));
    }
    Ok(Some(SweepPlan { parameter, within, points }))
}

fn cases(
    evaluator: &Evaluator<'_>,
    spec: &GradientSpec,
    plan: &GradientPlan,
) -> Result<Vec<GradientCase>, Diagnostic> {
    let of_solver = |solver: &Case| plan.cases_of(&solver.name, solver);
    let cases: Vec<GradientCase> = plan.problem.cases.iter().flat_map(of_solver).collect();
    let names: Vec<String> = cases.iter().map(|case| case.name.clone()).collect();
    let selectors: Vec<_> = spec.expect.iter().map(|spec| spec.case.as_ref()).collect();
    let owners = assign(evaluator, &selectors, &names)?;
    let stated = spec.expect.iter().enumerate().map(|(i, spec)| terms(evaluator, i, spec));
    let stated = stated.collect::<Result<Vec<(GradientTerms, String)>, _>>()?;
    let expected = owners.into_iter().map(|owner| Some(stated[owner?].clone()));
    let all = cases.into_iter().zip(expected);
    Ok(all.map(|(case, expected)| GradientCase { expected, ..case }).collect())
}

fn terms(
    evaluator: &Evaluator<'_>,
    entry: usize,
    spec: &GradientExpectSpec,
) -> Result<(GradientTerms, String), Diagnostic> {
    let path = evaluator.top("expect").then(entry);
    let order = spec.order.as_ref().map(|pair| path.then("order").interval(pair));
    let order = order.transpose()?;
    if spec.state.is_none() && order.is_none() {
        return path.expected("`state`, `order`, or both", "this expectation is empty");
    }
    let because = path.because("this expectation", &spec.because)?;
    Ok((GradientTerms { state: spec.state, order, finest: None }, because))
}
