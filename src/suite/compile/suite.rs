//! From words to a suite: every number computed, every name resolved, the truth checked.

use super::{
    check::{fem_support, size, subject_support},
    evaluator::{Evaluator, Parameter},
    internal_force,
    load::{LoadEntry, StudyFacts},
    path::Path,
    run::{cases, refine, steps},
    scene::{rest, scene},
    stability,
    truth::{conservation_only, exact, law},
    wording::shown,
};
use crate::suite::{
    grammar::{
        ConvergenceSpec, Head, InternalForceSpec, ObserveSpec, ReferenceSpec, StabilitySpec,
        StudyName,
    },
    model::{
        ConvergencePlan, ReferencePlan, Scene, Suite, fingerprint::fingerprint,
        study_plan::StudyPlan,
    },
    yaml::{Diagnostic, Ordered, Source, read},
};
use std::sync::Arc;

/// Instants at which the error is taken unless a suite says otherwise.
const INSTANTS: u64 = 50;

impl Suite {
    /// Reads and checks a suite. No solver runs.
    ///
    /// # Errors
    /// A [`Diagnostic`] with the place of the first thing that is wrong.
    pub fn load(source: &Source) -> Result<Self, Diagnostic> {
        let suite = match study_of(source)? {
            StudyName::Convergence => convergence(source),
            StudyName::InternalForce => internal_force(source),
            StudyName::Stability => stability(source),
        };
        Ok(Self { fingerprint: fingerprint(source.text().as_bytes()), ..suite? })
    }
}

/// The kind of study, which decides what other keys are known.
fn study_of(source: &Source) -> Result<StudyName, Diagnostic> {
    read::<Head>(source).map(|head| head.study)
}

fn convergence(source: &Source) -> Result<Suite, Diagnostic> {
    let words: ConvergenceSpec = read(source)?;
    let (evaluator, parameters) = Evaluator::new(source, &words.parameters, &words.functions)?;
    name(&evaluator, &words.suite)?;
    let scene = scene::scene(&evaluator, &words.scene)?;
    fem_support::check(&evaluator, &words, &scene)?;
    let (refine, places) = refine::plan(&evaluator, &words, &scene)?;
    let instants = words.run.instants.as_ref().map_or(Ok(INSTANTS), |text| {
        evaluator.count(&Path::top("run").then("instants"), text, "the number of instants")
    })?;
    let until = cases::until(&evaluator, &words.run.until)?;
    let latest = until.iter().map(|(_, t)| *t).fold(0.0, f64::max);
    let conduction = rest::conduction(&evaluator, &words, &scene, latest)?;
    let exact = match &conduction {
        Some(_) => None,
        None => exact::exact(&evaluator, &words, &scene, latest)?,
    };
    let dimension = scene.dimension();
    let reference = words.reference.as_ref().map(|words| reference(&evaluator, words, dimension));
    let reference = reference.transpose()?.flatten();
    let same_method_dt = steps::same_method(&evaluator, &words, &refine, &until, instants)?;
    law::check(&evaluator, &words, &scene)?;
    loads(&evaluator, &words, &scene, latest)?;
    if exact.is_none() && conduction.is_none() && reference.is_none() {
        conservation_only::check(&evaluator, &words)?;
    }
    let observe = words.observe.as_ref().map(|words| observed(&evaluator, words, &scene));
    let scale = words.judge.scale.as_ref().map(|text| {
        evaluator.positive(&Path::top("judge").then("scale"), text, "the scale of the error")
    });
    let mut plan = ConvergencePlan {
        observe: observe.transpose()?,
        scene,
        exact,
        conduction,
        reference,
        same_method_dt,
        refine,
        instants,
        norm: words.judge.norm,
        of: words.judge.of,
        scale: scale.transpose()?,
        crossing_levels: words.judge.crossing_levels,
        cases: Vec::new(),
    };
    subject_support::check(&evaluator, &words, &plan)?;
    size::check(&evaluator, &words, &plan, &places)?;
    steps::check(&evaluator, &plan, &places, &until)?;
    plan.cases = cases::cases(&evaluator, &words, &plan, &until)?;
    evaluator.refuse_unused(&words.parameters, &words.functions)?;
    let head = [words.suite, words.title, words.source, words.about];
    Ok(assemble(head, parameters, &words.functions, plan))
}

/// Refuses what the loads of the scene do not go with, and the FEM where it lacks one.
fn loads(
    evaluator: &Evaluator<'_>,
    words: &ConvergenceSpec,
    scene: &Scene,
    until: f64,
) -> Result<(), Diagnostic> {
    let study = StudyFacts { manufactured: words.manufactured.is_some(), until };
    for (i, load) in words.scene.loads.iter().enumerate() {
        let path = Path::top("scene").then("loads").then(i).then(load.effect().name());
        load.words().check(&LoadEntry { evaluator, path, scene }, &study)?;
        if let Some(lacked) = load.words().lacked_by_fem() {
            subject_support::fem_lacks(evaluator, words, lacked)?;
        }
    }
    Ok(())
}

fn internal_force(source: &Source) -> Result<Suite, Diagnostic> {
    let words: InternalForceSpec = read(source)?;
    let (evaluator, parameters) = Evaluator::new(source, &words.parameters, &words.functions)?;
    name(&evaluator, &words.suite)?;
    let plan = internal_force::plan(&evaluator, &words)?;
    evaluator.refuse_unused(&words.parameters, &words.functions)?;
    let head = [words.suite, words.title, words.source, words.about];
    Ok(assemble(head, parameters, &words.functions, plan))
}

fn stability(source: &Source) -> Result<Suite, Diagnostic> {
    let words: StabilitySpec = read(source)?;
    let (evaluator, parameters) = Evaluator::new(source, &words.parameters, &words.functions)?;
    name(&evaluator, &words.suite)?;
    let plan = stability::plan(&evaluator, source, &words)?;
    evaluator.refuse_unused(&words.parameters, &words.functions)?;
    let head = [words.suite, words.title, words.source, words.about];
    Ok(assemble(head, parameters, &words.functions, plan))
}

fn assemble(
    [name, title, source, about]: [String; 4],
    parameters: Vec<Parameter>,
    functions: &Ordered<String>,
    plan: impl StudyPlan,
) -> Suite {
    let (functions, study) = (functions.as_slice().to_vec(), Arc::new(plan));
    Suite { name, title, source, about, parameters, functions, study, fingerprint: 0 }
}

/// A name becomes part of test and file names.
fn name(evaluator: &Evaluator<'_>, name: &str) -> Result<(), Diagnostic> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if !name.is_empty() && name.len() <= 64 && name.chars().all(plain) {
        return Ok(());
    }
    let diagnostic = evaluator.diagnostic(&Path::top("suite"), "this is not a name for a suite");
    Err(diagnostic.with_label("expected lower-case letters, digits and hyphens, at most 64"))
}

/// The place that is watched: one in the body.
fn observed(
    evaluator: &Evaluator<'_>,
    words: &ObserveSpec,
    scene: &Scene,
) -> Result<Vec<f64>, Diagnostic> {
    let path = Path::top("observe").then("at");
    let place = evaluator.point(&path, &words.at, scene.dimension())?;
    for (axis, x) in place.iter().enumerate() {
        let (from, to) = (scene.from[axis], scene.to[axis]);
        if !(from..=to).contains(x) {
            let message = format!("{} is outside the body", shown(*x));
            let label = format!("expected a number from {} to {}", shown(from), shown(to));
            return Err(evaluator.diagnostic(&path.then(axis), &message).with_label(&label));
        }
    }
    if scene.round.as_ref().is_some_and(|round| !round.holds(&place)) {
        let diagnostic = evaluator.diagnostic(&path, "this place is outside the body");
        return Err(diagnostic.with_label("expected a place between the rims"));
    }
    Ok(place)
}

fn reference(
    evaluator: &Evaluator<'_>,
    words: &ReferenceSpec,
    dimension: usize,
) -> Result<Option<ReferencePlan>, Diagnostic> {
    let path = Path::top("reference");
    let (equation, fem) = match (words.equation, &words.fem) {
        (Some(equation), Some(fem)) => (equation, fem),
        (None, None) if words.same_method.is_some() => return Ok(None),
        _ => {
            let message =
                "a reference is a `fem` computation of an `equation`, or the `same_method`";
            return Err(evaluator.diagnostic_at_key(&path, message));
        }
    };
    if dimension != 1 {
        let message = format!("the reference FEM is 1-D, the scene {dimension}-D");
        let diagnostic = evaluator.diagnostic_at_key(&path, &message);
        return Err(diagnostic.with_help("give this scene an `exact` solution"));
    }
    let path = path.then("fem");
    Ok(Some(ReferencePlan {
        equation,
        element: fem.element,
        mass: fem.mass,
        cells: evaluator.count(&path.then("cells"), &fem.cells, "the number of elements")?,
        dt: evaluator.formula(&path.then("dt"), &fem.dt, &["h"])?,
    }))
}
