//! Compiles levels, time steps, methods and cases.

pub(crate) mod methods;
pub(crate) mod reference;
pub(crate) mod refine;

use crate::mpm::input::MpmMethod;
use crate::mpm::{
    CombinationError, FrameName, MassName, combine, combine_across, combine_basis, combine_bodies,
    combine_precision, combine_volume,
};
use crate::suite::compile::study::{LevelPaths, StudyDraft};
use crate::suite::evaluator::{Evaluator, SuitePath, shown};
use crate::suite::grammar::{ConvergenceSpec, MethodSpec, RunSpec, ScatterSpec};
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::RefinePlan;
use crate::suite::model::{Against, Case, ConvergencePlan, SceneFace};
use crate::suite::scene::lattice::LatticeOffsets;
use crate::suite::scene::load::{ListedLoad, LoadTarget};
use crate::suite::yaml::{Diagnostic, NumberText, OneOrMany};
use crate::verify::Axis;
use methods::{NamedMethod, methods};

const MOST_CASES: usize = 1000;

const MOST_LOAD_STEPS: f64 = 1e5;

const INSTANTS: u64 = 50;

pub(crate) struct RunPlan<'a> {
    /// Ends of the runs: the text for case names, and the value (s, or number of load steps).
    pub(crate) until: Vec<(String, f64)>,
    pub(crate) refine: RefinePlan,
    pub(crate) levels: Vec<LevelPaths<'a>>,
    pub(crate) instants: u64,
    pub(crate) scatter: LatticeOffsets,
}

pub(crate) fn plan<'a>(draft: &StudyDraft<'a>) -> Result<RunPlan<'a>, Diagnostic> {
    let StudyDraft { evaluator, spec, .. } = draft;
    let until = ends(evaluator, &spec.run)?;
    let (refine, levels) = refine::plan(draft)?;
    let instants = spec.run.instants.as_ref().map_or(Ok(INSTANTS), |text| {
        evaluator.top("run.instants").count(text, "the number of instants")
    })?;
    Ok(RunPlan { until, refine, levels, instants, scatter: scatter(draft)? })
}

fn ends(evaluator: &Evaluator<'_>, run: &RunSpec) -> Result<Vec<(String, f64)>, Diagnostic> {
    match (&run.until, &run.load_steps) {
        (Some(spec), None) => distinct(&evaluator.top("run.until"), spec, |path, text| {
            let until = path.positive(text, "the end of the run")?;
            let end = shown(until);
            Ok((format!("until-{end}"), until, format!("the end {end} s appears twice")))
        }),
        (None, Some(spec)) => distinct(&evaluator.top("run.load_steps"), spec, |path, text| {
            let count = path.count_up_to(MOST_LOAD_STEPS, text, "the number of load steps")?;
            let repeated = format!("{count} load steps appear twice");
            Ok((format!("load-steps-{count}"), count as f64, repeated))
        }),
        (Some(_), Some(_)) => {
            let path = evaluator.top("run.until");
            let message = "`until` is not supported with `load_steps`: load steps have no time";
            path.refuse_key(message, "keep one of them")
        }
        (None, None) => evaluator.top("run").refuse(
            "a run needs an end",
            "add `until`, or `load_steps` for `scheme: quasi_static`",
        ),
    }
}

/// Reads entries as a name, a value, and the message about a second entry with this name.
fn distinct(
    path: &SuitePath<'_>,
    spec: &OneOrMany<NumberText>,
    read: impl Fn(&SuitePath<'_>, &NumberText) -> Result<(String, f64, String), Diagnostic>,
) -> Result<Vec<(String, f64)>, Diagnostic> {
    let mut ends: Vec<(String, f64)> = Vec::new();
    for (i, text) in spec.as_slice().iter().enumerate() {
        let path = path.alternative(spec, i);
        let (name, end, repeated) = read(&path, text)?;
        if ends.iter().any(|(known, _)| *known == name) {
            return Err(path.diagnostic(&repeated).with_label("the second time"));
        }
        ends.push((name, end));
    }
    Ok(ends)
}

/// Maximum offset of a particle, as a fraction of the particle spacing: halfway to the next one.
const MOST_OFFSET: f64 = 0.5;

/// Maximum random offset at a loaded face, as a fraction of the particle spacing. The layer at the
/// face stays separate from the next layer.
const MOST_OFFSET_AT_LOADS: f64 = 0.25;

const SEED: u64 = 1;

fn scatter(draft: &StudyDraft<'_>) -> Result<LatticeOffsets, Diagnostic> {
    let StudyDraft { evaluator, spec, scene } = draft;
    let Some(ScatterSpec { shift, perturb, seed }) = &spec.particles else {
        return Ok(LatticeOffsets::default());
    };
    let path = evaluator.top("particles");
    if scene.each().iter().any(|body| body.outline.is_some()) {
        let message = "`particles` is supported for boxes only: it moves particles off a regular \
                       lattice";
        return Err(path.diagnostic_at_key(message));
    }
    let numbers = |texts: &[NumberText]| path.then("shift").point(texts, scene.dimension());
    let shift = shift.as_deref().map(numbers).transpose()?.unwrap_or_default();
    let at = path.then("perturb");
    let number = |text: &NumberText| at.positive(text, "the share of the spacing");
    let perturb = perturb.as_ref().map(number).transpose()?.unwrap_or(0.0);
    let at = path.then("seed");
    let count = |text: &NumberText| at.count(text, "the seed");
    if seed.is_some() && perturb == 0.0 {
        let diagnostic = at.diagnostic_at_key("`seed` has no effect without `perturb`");
        return Err(diagnostic.with_help("add `perturb: 0.2`, or remove the seed"));
    }
    let seed = seed.as_ref().map(count).transpose()?.unwrap_or(SEED);
    let furthest = shift.iter().fold(0.0_f64, |most, share| most.max(share.abs())) + perturb;
    if !(furthest <= MOST_OFFSET) {
        let message = format!("particles are moved by up to {} of their spacing", shown(furthest));
        let label =
            format!("expected at most {MOST_OFFSET}, so that they stay in the body and apart");
        return Err(path.diagnostic(&message).with_label(&label));
    }
    let at_face =
        |load: &ListedLoad| matches!(load.target(), LoadTarget::Face(_) | LoadTarget::Rim(_));
    if perturb > MOST_OFFSET_AT_LOADS && scene.loads.iter().any(at_face) {
        let message = format!("particles are moved by up to {} of their spacing", shown(perturb));
        let label = format!("expected at most {MOST_OFFSET_AT_LOADS} at a face or rim with a load");
        return Err(path.then("perturb").diagnostic(&message).with_label(&label));
    }
    let scatter = LatticeOffsets { shift, perturb, seed };
    if scatter.is_none() {
        let diagnostic = path.diagnostic_at_key("`particles` moves no particle");
        return Err(diagnostic.with_help("add `shift: [0.25]` or `perturb: 0.2`, or remove it"));
    }
    Ok(scatter)
}

pub(crate) fn cases(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    plan: &ConvergencePlan,
    until: &[(String, f64)],
) -> Result<Vec<Case>, Diagnostic> {
    let truths = truths(plan);
    for (i, method) in spec.methods.iter().enumerate() {
        possible(&evaluator.top("methods").then(i), method, plan)?;
    }
    let (material, of_each) = (&plan.scene.material, until.len() * truths.len());
    let found = methods(evaluator, &spec.methods, material, MOST_CASES, of_each)?;
    found.iter().try_for_each(|method| combined(evaluator, method, plan))?;
    Ok(found.iter().flat_map(|method| runs(method, &truths, until)).collect())
}

/// Returns the solutions with which the cases are compared, each with a suffix for case names.
fn truths(plan: &ConvergencePlan) -> Vec<(Against, &'static str)> {
    let truths = [
        plan.has_formulas().then_some((Against::Exact, "-vs-exact")),
        plan.reference.as_ref().map(|_| (Against::Reference, "-vs-reference")),
        plan.same_method.map(|same| (Against::SameMethod(same), same.suffix())),
    ];
    let nothing = plan.is_truthless().then_some((Against::Nothing, ""));
    truths.into_iter().flatten().chain(nothing).collect()
}

fn runs(method: &NamedMethod, truths: &[(Against, &str)], until: &[(String, f64)]) -> Vec<Case> {
    let mut cases = Vec::new();
    for (text, until_value) in until {
        for (against, suffix) in truths {
            let mut name = method.name();
            if until.len() > 1 {
                name += &format!("-{text}");
            }
            if truths.len() > 1 {
                name += suffix;
            }
            cases.push(Case {
                name,
                method: method.method.with_load_steps(*until_value as u64),
                solver: method.solver.clone(),
                until: *until_value,
                against: *against,
                expectation: None,
                expectation_in_full: None,
                gating: None,
            });
        }
    }
    cases
}

fn combined(
    evaluator: &Evaluator<'_>,
    named: &NamedMethod,
    plan: &ConvergencePlan,
) -> Result<(), Diagnostic> {
    let refuse = |reason: CombinationError| {
        let help = "list compatible settings in separate entries of `methods`";
        named.path(evaluator).diagnostic(&reason.to_string()).with_help(help)
    };
    let method = named.method;
    if let Method::QuasiStatic { basis, .. } = method {
        return combine_basis(plan.scene.plane, basis).map_err(refuse);
    }
    let Method::Mpm(method) = method else { return Ok(()) };
    let MpmMethod { basis, transfer, mass, frame, start, volume, precision, .. } = method;
    let mut known = combine(basis, transfer, mass, frame)
        .and_then(|()| combine_across(plan.scene.plane, basis, transfer))
        .and_then(|()| combine_precision(precision, plan.scene.bodies.len()));
    if plan.scene.bodies.len() > 1 {
        let contact = plan.scene.contact.is_some();
        known = known.and_then(|()| combine_bodies(transfer, mass, frame, start, contact));
    }
    let (dimension, plane) = (plan.scene.dimension(), plan.scene.plane);
    for body in plan.scene.each() {
        let material = &body.material;
        known = known.and_then(|()| combine_volume(volume, frame, material, dimension, plane));
    }
    known.map_err(refuse)
}

fn possible(
    path: &SuitePath<'_>,
    spec: &MethodSpec,
    plan: &ConvergencePlan,
) -> Result<(), Diagnostic> {
    if let MethodSpec::Mpm { mass: Some(mass), .. } = spec
        && mass.as_slice().contains(&MassName::Consistent)
        && let Some(message) = against_consistent_mass(plan)
    {
        return Err(path.then("mpm").then("mass").diagnostic(message));
    }
    match spec {
        MethodSpec::Fem { .. } if plan.scene.dimension() != 1 => {
            let d = plan.scene.dimension();
            Err(path.diagnostic(&format!("the built-in FEM is 1-D, but the scene is {d}-D")))
        }
        MethodSpec::Fem { .. } if plan.scene.density.uniform().is_none() => Err(path
            .diagnostic("the built-in FEM does not support a density that varies over the body")),
        MethodSpec::Fem { .. } if !plan.scene.bodies.is_empty() => Err(path.diagnostic(
            "the built-in FEM supports a single body only, but the scene lists `bodies`",
        )),
        MethodSpec::Mpm { frame: Some(frame), .. }
            if frame.as_slice().contains(&FrameName::Total) && stretched(plan) =>
        {
            let message = "`total_lagrangian` needs a periodic grid as long as the body, which \
                           stays at its reference position";
            Err(path.then("mpm").then("frame").diagnostic(message))
        }
        MethodSpec::External { .. } if plan.same_method.is_some() => {
            let message = "`same_method` does not support external solvers";
            path.refuse(message, "state `exact` or a `reference`")
        }
        MethodSpec::Fem { .. } if plan.refine.axis == Axis::Particles => {
            Err(path.diagnostic("the suite refines particles per cell, but an FEM has none"))
        }
        MethodSpec::Mpm { .. } | MethodSpec::Heat { .. } | MethodSpec::External { .. }
            if !plan.refine.has_particles() =>
        {
            let solver =
                if matches!(spec, MethodSpec::External { .. }) { "a solver" } else { "MPM" };
            let message = format!("{solver} needs particles, but `refine` has no `ppc`");
            path.refuse(&message, "add `ppc: 4` to `refine`")
        }
        _ => Ok(()),
    }
}

fn against_consistent_mass(plan: &ConvergencePlan) -> Option<&'static str> {
    plan.scene.faces.iter().find_map(|face| face.hold.kind().against_consistent_mass)
}

fn stretched(plan: &ConvergencePlan) -> bool {
    let scene = &plan.scene;
    let apart = |face: &SceneFace| {
        let length = scene.to[face.axis] - scene.from[face.axis];
        (scene.period(face.axis) - length).abs() > 1e-12 * length
    };
    scene.faces.iter().any(|face| face.hold.is_periodic() && apart(face))
}
