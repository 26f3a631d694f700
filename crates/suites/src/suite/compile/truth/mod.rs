//! Compiles the exact solution or equilibrium of a suite, and checks that it solves the problem.

mod conduction;
mod interface;
mod places;
pub(crate) mod tolerance;

use crate::exact::heat::Conduction;
use crate::exact::{Equation, Face, Motion, Problem, Survey};
use crate::mpm::MaterialPlan;
use crate::suite::compile::study::{CompiledStudy, StudyDraft};
use crate::suite::evaluator::{COORDINATES, Evaluator, SuitePath};
use crate::suite::grammar::{EquationName, ExactSpec, ExpectSpec};
use crate::suite::model::{Scene, SceneFace};
use crate::suite::scene::load::{EffectName, LoadTarget};
use crate::suite::yaml::{Diagnostic, NumberText};
use crate::verify::JudgedBox;
use conduction::ConductionInputs;
use places::{places, without_distant_faces};
use tolerance::{TOLERANCE, no_solution, tolerances, violated};

/// Maximum number of operations in a formula, which is evaluated about 30000 times.
const MOST_OPERATIONS: u64 = 5000;

pub(crate) struct StatedTruth {
    /// Problem of a body that moves, or is in equilibrium.
    pub(crate) exact: Option<Problem>,
    /// Heat problem of a body at rest.
    pub(crate) conduction: Option<Conduction>,
    /// Sampled positions and largest terms of the exact motion; `None` for several bodies.
    pub(crate) survey: Option<Survey>,
    pub(crate) within: Option<JudgedBox>,
    /// The observed point (m).
    pub(crate) observe: Option<Vec<f64>>,
}

/// Compiles the solution of runs that end at `until` (s) at the latest. It is checked later.
pub(crate) fn truth(draft: &StudyDraft<'_>, until: f64) -> Result<StatedTruth, Diagnostic> {
    let conduction = conduction::conduction(draft, until)?;
    let exact = match &conduction {
        Some(_) => None,
        None => exact(draft, until)?,
    };
    let (within, observe) = places(draft, exact.as_ref())?;
    let survey = exact.as_ref().filter(|exact| exact.bodies.is_empty()).map(Survey::new);
    let exact = match (&within, exact, &survey) {
        (Some(within), Some(exact), Some(survey)) => {
            Some(without_distant_faces(draft.evaluator, within, exact, survey)?)
        }
        (_, exact, _) => exact,
    };
    Ok(StatedTruth { exact, conduction, survey, within, observe })
}

fn exact(draft: &StudyDraft<'_>, until: f64) -> Result<Option<Problem>, Diagnostic> {
    let StudyDraft { evaluator, spec, scene } = draft;
    if scene.each().iter().any(|body| body.mapped.is_some()) {
        // The check of solutions is implemented only for boxes and bodies with a free surface.
        let stated = [
            (spec.exact.is_some(), "exact", ""),
            (spec.equilibrium.is_some(), "equilibrium", ""),
            (spec.manufactured.is_some(), "manufactured", ""),
        ];
        let message = "a solution can be checked in a box or a body with a free rim, but not in a \
                       quadrilateral";
        evaluator.refuse_first(&stated, |path, _| path.diagnostic_at_key(message))?;
    }
    if !scene.bodies.is_empty() {
        interface::refuse(evaluator, spec)?;
    }
    if let Some(state) = &spec.equilibrium {
        refuse_equilibrium_with(draft, state)?;
        let path = evaluator.top("equilibrium");
        return Ok(Some(Problem {
            at_rest: true,
            follows_motion: false,
            ..solution(&path, state, scene, true, until)?
        }));
    }
    let Some(exact) = &spec.exact else { return manufactured(draft, until) };
    let path = evaluator.top("exact");
    if spec.manufactured.is_some() {
        let message = "the suite states both `exact` and `manufactured`: keep one";
        return Err(evaluator.top("manufactured").diagnostic_at_key(message));
    }
    let problem = solution(&path, exact, scene, false, until)?;
    let each = scene.bodies.iter().map(|body| solution(&path, exact, body, false, until));
    let bodies = each.collect::<Result<Vec<Problem>, _>>()?;
    Ok(Some(Problem { bodies, ..problem }))
}

pub(crate) fn refuse_unfit(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    if study.plan.is_truthless() {
        refuse_need_of_truth(study)?;
    }
    if study.evaluator.source().is_trusted() { Ok(()) } else { refuse_violated(study) }
}

fn refuse_violated(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let CompiledStudy { evaluator, spec, plan, survey, .. } = study;
    let path = evaluator.top(match (&spec.equilibrium, &spec.exact) {
        (Some(_), _) => "equilibrium",
        (None, Some(_)) => "exact",
        (None, None) => "manufactured",
    });
    if let Some(problem) = &plan.conduction {
        conduction::refuse_wrong_temperature(&path, problem)?;
    }
    let Some(problem) = &plan.exact else { return Ok(()) };
    if let Some(survey) = survey {
        return refuse_wrong_solution(&path, problem, survey);
    }
    interface::refuse_violated_conditions(
        evaluator,
        &plan.scene,
        problem.bodies.clone(),
        |problem, survey| refuse_wrong_solution(&path, problem, survey),
        |violation| no_solution(&path, &violation, problem.tolerance),
    )
}

fn solution(
    path: &SuitePath<'_>,
    spec: &ExactSpec,
    scene: &Scene,
    at_rest: bool,
    until: f64,
) -> Result<Problem, Diagnostic> {
    let (tolerance, linearised) = tolerances(path, spec)?;
    let (Some(name), Some(texts)) = (spec.equation, &spec.displacement) else {
        let message = "a body that moves needs an `equation` and a `displacement`";
        return Err(path.diagnostic_at_key(message));
    };
    let equation = equation(&path.then("equation"), name, scene, at_rest)?;
    let motion = motion(path, texts, scene.dimension())?;
    let motion_in_heat = equation.is_finite().then(|| motion.clone());
    let inputs = ConductionInputs { motion: motion_in_heat, manufactured: false, until, tolerance };
    let heat = conduction::problem(path, spec.temperature.as_ref(), scene, inputs)?;
    Ok(Problem { heat, tolerance, linearised, ..problem(scene, equation, motion, until) })
}

/// Returns the equation for checking a solution. A stated equation must agree with the material.
fn equation(
    path: &SuitePath<'_>,
    name: EquationName,
    scene: &Scene,
    at_rest: bool,
) -> Result<Equation, Diagnostic> {
    if let Some(equation) = equation_of(&scene.material).filter(|law| law.name() == name.name()) {
        return equation
            .admits(scene.dimension(), at_rest)
            .map(|()| equation)
            .map_err(|[message, help]| path.diagnostic(message).with_help(help));
    }
    let (name, material) = (name.name(), scene.material.name());
    let (message, help) = if Equation::NAMES.contains(&name) {
        (
            format!("equation `{name}` does not belong to the material `{material}`"),
            "use `small_strain` for `linear_elastic`, and for other materials the equation with \
             their name",
        )
    } else {
        let message = "a formula is checked against `small_strain`, `neo_hookean`, `hencky` or `corotated` only";
        (message.to_owned(), "give other equations a `reference`")
    };
    path.refuse(&message, help)
}

fn manufactured(draft: &StudyDraft<'_>, until: f64) -> Result<Option<Problem>, Diagnostic> {
    let StudyDraft { evaluator, spec, scene } = draft;
    let Some(made) = &spec.manufactured else { return Ok(None) };
    let path = evaluator.top("manufactured");
    let equation = manufactured_law(&scene.material).map_err(|reason| {
        let message =
            "a force can be manufactured for `neo_hookean`, `hencky` and `corotated` only";
        path.diagnostic_at_key(message).with_help(reason)
    })?;
    for (key, what, stated) in [
        ("initial_displacement", "displacement", &scene.initial_displacement),
        ("initial_velocity", "velocity", &scene.initial_velocity),
    ] {
        if !stated.is_empty() {
            let message = format!("the manufactured motion defines the initial {what}");
            let at = evaluator.top("scene").then(key);
            return at.refuse_key(&message, "remove it");
        }
    }
    if scene.lists(EffectName::BodyForce) {
        let message = "the manufactured motion defines the body force: remove `body_force`";
        let help = "to have a stated force checked, state the motion under `exact`";
        return path.refuse_key(message, help);
    }
    let Some(texts) = &made.displacement else {
        return Err(path.diagnostic_at_key("a body that moves needs a `displacement`"));
    };
    let motion = motion(&path, texts, scene.dimension())?;
    let inputs = ConductionInputs {
        motion: Some(motion.clone()),
        manufactured: true,
        until,
        tolerance: TOLERANCE,
    };
    let heat = conduction::problem(&path, made.temperature.as_ref(), scene, inputs)?;
    Ok(Some(Problem { manufactured: true, heat, ..problem(scene, equation, motion, until) }))
}

fn problem(scene: &Scene, equation: Equation, motion: Motion, until: f64) -> Problem {
    Problem {
        from: scene.from.clone(),
        to: scene.to.clone(),
        outline: scene.outline.clone(),
        bodies: Vec::new(),
        plane: scene.plane,
        density: scene.density.clone(),
        equation,
        terms: scene.terms(),
        heat: None,
        at_rest: false,
        manufactured: false,
        faces: (0..scene.faces.len()).map(|number| face(scene, number)).collect(),
        follows_motion: scene.material.properties().depends_on_deformation_alone().is_ok(),
        initial_stress: scene.initial_stress.clone(),
        initial_displacement: scene.initial_displacement.clone(),
        initial_velocity: scene.initial_velocity.clone(),
        until,
        motion,
        tolerance: TOLERANCE,
        linearised: None,
        shared: None,
    }
}

fn refuse_wrong_solution(
    path: &SuitePath<'_>,
    problem: &Problem,
    survey: &Survey,
) -> Result<(), Diagnostic> {
    if let Some(problem) = &problem.heat {
        conduction::refuse_wrong_temperature(path, problem)?;
    }
    problem.check_with(survey).map_err(|violation| violated(path, problem, &violation))
}

fn motion(
    path: &SuitePath<'_>,
    displacement: &[NumberText],
    dimension: usize,
) -> Result<Motion, Diagnostic> {
    let path = path.then("displacement");
    let components = path.fields(displacement, dimension)?;
    for (i, component) in components.iter().enumerate() {
        let operations = component.operations();
        if operations > MOST_OPERATIONS {
            let message = format!("this formula takes {operations} operations");
            let label = format!("expected at most {MOST_OPERATIONS}: shorten its sums");
            return Err(path.then(i).diagnostic(&message).with_label(&label));
        }
    }
    Ok(Motion::new(components))
}

fn face(scene: &Scene, number: usize) -> Face {
    let SceneFace { name, axis, high, hold } = &scene.faces[number];
    let loaded =
        scene.loads_on(LoadTarget::Face(number)).find_map(|load| load.load.clone().condition());
    let condition = loaded.unwrap_or_else(|| hold.clone());
    Face { name, axis: *axis, high: *high, period: scene.period(*axis), condition }
}

/// Returns the equation of motion of a material, which may restrict the motion.
pub(crate) fn equation_of(material: &MaterialPlan) -> Option<Equation> {
    Equation::of_material(material.name(), |key| material.parameter(key))
}

fn manufactured_law(material: &MaterialPlan) -> Result<Equation, &'static str> {
    material.properties().depends_on_deformation_alone()?;
    equation_of(material).ok_or("the law has no equation")
}

fn refuse_equilibrium_with(draft: &StudyDraft<'_>, state: &ExactSpec) -> Result<(), Diagnostic> {
    let StudyDraft { evaluator, spec, scene } = draft;
    let path = evaluator.top("equilibrium");
    let others = [
        (spec.exact.is_some(), "exact", "exact"),
        (spec.manufactured.is_some(), "manufactured", "manufactured"),
        (spec.reference.is_some(), "reference", "reference"),
    ];
    evaluator.refuse_first(&others, |path, other| {
        let message = format!("the suite states both `{other}` and `equilibrium`: keep one");
        path.diagnostic_at_key(&message)
    })?;
    // A formula that contains t is refused here.
    let d = scene.dimension();
    if let Some(texts) = &state.displacement {
        path.then("displacement").vector(texts, d, &COORDINATES[..d])?;
    }
    if scene.heat().is_some() {
        let message = "`equilibrium` is not supported with `heat`: state a motion under `exact`";
        return Err(path.diagnostic_at_key(message));
    }
    if let Some(until) = spec.run.until.as_ref().filter(|until| until.as_slice().len() > 1) {
        let at = evaluator.top("run.until").alternative(until, 1);
        return at.expected("one end", "a suite with `equilibrium` has a single end time");
    }
    if spec.judge.norm.is_over_instants() {
        let message = "a `max_` norm needs a motion: with `equilibrium` the error exists only at \
                       the end";
        let diagnostic = evaluator.top("judge.norm").diagnostic(message);
        return Err(diagnostic.with_label("expected a norm at the end: rms, l1, l2 or linf"));
    }
    refuse_driven(evaluator, scene)?;
    match spec.fem_method() {
        Some(i) => {
            let message = "the built-in FEM has no damping, so it does not reach an equilibrium";
            Err(evaluator.top("methods").then(i).diagnostic(message))
        }
        None => Ok(()),
    }
}

/// Refuses prescribed velocities in an equilibrium study, because the velocity at the end of a run
/// does not determine the final position.
fn refuse_driven(evaluator: &Evaluator<'_>, scene: &Scene) -> Result<(), Diagnostic> {
    let scene_path = evaluator.top("scene");
    if let Some(face) = scene.faces.iter().find(|face| face.hold.is_driven()) {
        let message = format!(
            "the face `{}` has a given velocity, but `equilibrium` needs a body at rest",
            face.name
        );
        return Err(scene_path.then("boundary").then(face.name).diagnostic_at_key(&message));
    }
    if let Some(set) = scene.driven_set() {
        let message =
            format!("the set `{set}` has a given velocity, but `equilibrium` needs a body at rest");
        let at = scene_path.then("sets").then(set);
        return Err(at.diagnostic_at_key(&message));
    }
    Ok(())
}

fn refuse_need_of_truth(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let CompiledStudy { evaluator, spec, .. } = study;
    let asked = |spec: &ExpectSpec| {
        let ExpectSpec { order, verdict, finest_pair, floor, drift, energy_rate, .. } = spec;
        let judged = order.is_some() || verdict.is_some() || finest_pair.is_some();
        let kept = drift.is_some() || energy_rate.is_some();
        judged || floor.is_some() || !spec.bounds().is_empty() || !kept
    };
    let full = |spec: &ExpectSpec| spec.full.as_deref().is_some_and(asked);
    if spec.expect.iter().any(|spec| asked(spec) || full(spec)) {
        return evaluator.top("suite").refuse_key(
            "a convergence study needs `exact`, `manufactured`, `equilibrium` or \
                       `reference`",
            "without one of them, expectations can only bound a `drift` or an `energy_rate`",
        );
    }
    if spec.observe.is_some() {
        let message = "`observe` needs an exact solution or a reference, and the suite has neither";
        return Err(evaluator.top("observe").diagnostic_at_key(message));
    }
    Ok(())
}
