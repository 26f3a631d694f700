//! From the specification to a suite: computes every number, resolves every name and checks the
//! exact solution.

use super::check::size::LevelPaths;
use super::check::{self, size, steps, sums};
use super::expect::any_method;
use super::run::{self, places, reference, refine};
use super::truth::{self, conduction, conservation_only};
use super::{internal_force, scene, stability};
use crate::suite::evaluator::{DeclaredParameter, Evaluator};
use crate::suite::grammar::{
    AcknowledgeSpec, ConvergenceSpec, InternalForceSpec, StabilitySpec, SuiteSpec, WarningName,
};
use crate::suite::model::fingerprint::fingerprint;
use crate::suite::model::method::AnyMethod;
use crate::suite::model::study_plan::StudyPlan;
use crate::suite::model::{ConvergencePlan, Scene, Suite};
use crate::suite::yaml::{Diagnostic, NumberText, Ordered, Path, Source};
use std::sync::Arc;

/// Default number of instants at which the error is measured.
const INSTANTS: u64 = 50;

impl Suite {
    /// Reads and checks a suite. No solver runs.
    ///
    /// # Errors
    /// A [`Diagnostic`] with the place of the first error.
    pub fn load(source: &Source) -> Result<Self, Diagnostic> {
        let suite = match SuiteSpec::read(source)? {
            SuiteSpec::Convergence(spec) => convergence(source, *spec),
            SuiteSpec::InternalForce(spec) => internal_force(source, *spec),
            SuiteSpec::Stability(spec) => stability(source, *spec),
        };
        let fingerprint = fingerprint(source.text().as_bytes());
        Ok(Self { group: source.group(), fingerprint, ..suite? })
    }

    /// The scene of the convergence study in `source`, without exact solution: the problem of a
    /// solver with a defect to be found.
    ///
    /// # Errors
    /// A [`Diagnostic`] with the place of the first error.
    pub fn scene(source: &Source) -> Result<Scene, Diagnostic> {
        let spec = ConvergenceSpec::read(source)?;
        let (evaluator, _) = Evaluator::new(source, &spec.parameters, &spec.functions)?;
        scene::scene(&evaluator, &spec.scene)
    }
}

/// The convergence study in `source`, with the amplitude of the exact motion and of the initial
/// state multiplied by `factor`. Loads are not scaled.
///
/// # Errors
/// If the scaled motion is not a solution, as with loads that are not scaled.
pub(crate) fn with_amplitude(source: &Source, factor: f64) -> Result<Suite, Diagnostic> {
    with_changes(source, |spec| scale_amplitude(spec, factor))
}

/// The convergence study in `source`, without expectations and with these changes.
///
/// # Errors
/// A [`Diagnostic`] with the reason why the changed suite is refused.
pub(crate) fn with_changes(
    source: &Source,
    change: impl FnOnce(&mut ConvergenceSpec),
) -> Result<Suite, Diagnostic> {
    let mut spec = ConvergenceSpec::read(source)?;
    spec.expect.clear();
    change(&mut spec);
    convergence(source, spec)
}

fn scale_amplitude(spec: &mut ConvergenceSpec, factor: f64) {
    let ConvergenceSpec { scene, exact, manufactured, equilibrium, .. } = spec;
    let exact = exact.as_mut().and_then(|exact| exact.displacement.as_mut());
    let at_rest = equilibrium.as_mut().and_then(|exact| exact.displacement.as_mut());
    let manufactured = manufactured.as_mut().and_then(|given| given.displacement.as_mut());
    let bodies = scene.bodies.iter_mut().flatten();
    let of_bodies =
        bodies.flat_map(|body| [&mut body.initial_displacement, &mut body.initial_velocity]);
    let of_scene = [&mut scene.initial_displacement, &mut scene.initial_velocity];
    let fields = [exact, at_rest, manufactured].into_iter().chain(of_scene.map(Option::as_mut));
    for text in fields.flatten().chain(of_bodies.filter_map(Option::as_mut)).flatten() {
        *text = NumberText::Formula(format!("{factor}*({text})"));
    }
}

/// A convergence study with compiled scene, exact solution, levels and cases.
struct Compiled<'a> {
    evaluator: &'a Evaluator<'a>,
    spec: &'a ConvergenceSpec,
    plan: &'a ConvergencePlan,
    /// Paths of the levels in the file.
    levels: Vec<LevelPaths>,
    /// End of the longest run (s).
    latest: f64,
}

/// A check of keys that belong together.
type CrossCheck = fn(&Compiled<'_>) -> Result<(), Diagnostic>;

/// Checks of a convergence study before its expectations are read. They are independent: their
/// order only determines which of several errors is reported.
const CROSS_CHECKS: [CrossCheck; 8] = [
    |suite| check::refuse_conditions_unknown_to_fem(suite.evaluator, suite.spec, &suite.plan.scene),
    |suite| truth::refuse_violated(suite.evaluator, suite.spec, suite.plan),
    |suite| check::refuse_law_unknown_to_fem(suite.evaluator, suite.spec, &suite.plan.scene),
    |suite| check::refuse_foreign(suite.evaluator, suite.spec, &suite.plan.scene, suite.latest),
    |suite| conservation_only::refuse_need_of_truth(suite.evaluator, suite.spec, suite.plan),
    |suite| check::refuse_quantity_unknown_to_fem(suite.evaluator, suite.spec, suite.plan),
    |suite| size::refuse_unfit_levels(suite.evaluator, suite.spec, suite.plan, &suite.levels),
    |suite| steps::refuse_unusable(suite.evaluator, suite.plan, &suite.levels),
];

fn convergence(source: &Source, spec: ConvergenceSpec) -> Result<Suite, Diagnostic> {
    let (evaluator, parameters) = Evaluator::new(source, &spec.parameters, &spec.functions)?;
    refuse_unusable_name(&evaluator, &spec.suite)?;
    let scene = scene::scene(&evaluator, &spec.scene)?;
    let (refine, levels) = refine::plan(&evaluator, &spec, &scene)?;
    let instants = spec.run.instants.as_ref().map_or(Ok(INSTANTS), |text| {
        evaluator.count(&Path::top("run").then("instants"), text, "the number of instants")
    })?;
    let until = run::until(&evaluator, &spec.run.until)?;
    let latest = until.iter().map(|(_, t)| *t).fold(0.0, f64::max);
    let conduction = conduction::conduction(&evaluator, &spec, &scene, latest)?;
    let exact = match &conduction {
        Some(_) => None,
        None => truth::exact(&evaluator, &spec, &scene, latest)?,
    };
    let dimension = scene.dimension();
    let reference =
        spec.reference.as_ref().map(|spec| reference::reference(&evaluator, spec, dimension));
    let reference = reference.transpose()?.flatten();
    let same_method = reference::same_method(&evaluator, &spec, &scene, &refine, &until, instants)?;
    let observe = spec.observe.as_ref().map(|spec| places::observed(&evaluator, spec, &scene));
    let scale = spec.judge.scale.as_ref().map(|text| {
        evaluator.positive(&Path::top("judge").then("scale"), text, "the scale of the error")
    });
    let scatter = places::scatter(&evaluator, &spec, &scene)?;
    let mut plan = ConvergencePlan {
        observe: observe.transpose()?,
        scene,
        exact,
        conduction,
        reference,
        same_method,
        refine,
        scatter,
        instants,
        norm: spec.judge.norm,
        of: spec.judge.of,
        sum: None,
        scale: scale.transpose()?,
        crossing_levels: spec.judge.crossing_levels,
        any_method: AnyMethod::default(),
        cases: Vec::new(),
        acknowledged: acknowledged(&evaluator, &spec.acknowledge)?,
    };
    plan.cases = run::cases(&evaluator, &spec, &plan, &until)?;
    let compiled = Compiled { evaluator: &evaluator, spec: &spec, plan: &plan, levels, latest };
    CROSS_CHECKS.iter().try_for_each(|check| check(&compiled))?;
    // The exact value of a sum comes from a solution that has been checked.
    plan.sum = sums::judged(&evaluator, &spec, &plan)?;
    plan.scale = plan.scale.or(plan.sum.as_ref().map(|sum| sum.size()));
    if let Some(spec) = &spec.any_method {
        plan.any_method = any_method(&evaluator, spec, &plan)?;
    }
    plan.cases = run::expected(&evaluator, &spec, &plan)?;
    evaluator.refuse_unused(&spec.parameters, &spec.functions)?;
    let head = [spec.suite, spec.title, spec.source, spec.about];
    Ok(assemble(head, parameters, &spec.functions, plan))
}

/// The warnings that a suite acknowledges. Each must have a reason, and occur once.
fn acknowledged(
    evaluator: &Evaluator<'_>,
    specs: &[AcknowledgeSpec],
) -> Result<Vec<WarningName>, Diagnostic> {
    let mut names = Vec::new();
    for (i, spec) in specs.iter().enumerate() {
        let path = Path::top("acknowledge").then(i);
        evaluator.because(&path, "an acknowledged warning", &spec.because)?;
        if names.contains(&spec.warning) {
            let message = format!("`{}` is acknowledged twice", spec.warning.name());
            return Err(evaluator.diagnostic(&path.then("warning"), &message));
        }
        names.push(spec.warning);
    }
    Ok(names)
}

fn internal_force(source: &Source, spec: InternalForceSpec) -> Result<Suite, Diagnostic> {
    let (evaluator, parameters) = Evaluator::new(source, &spec.parameters, &spec.functions)?;
    refuse_unusable_name(&evaluator, &spec.suite)?;
    let plan = internal_force::plan(&evaluator, &spec)?;
    evaluator.refuse_unused(&spec.parameters, &spec.functions)?;
    let head = [spec.suite, spec.title, spec.source, spec.about];
    Ok(assemble(head, parameters, &spec.functions, plan))
}

fn stability(source: &Source, spec: StabilitySpec) -> Result<Suite, Diagnostic> {
    let (evaluator, parameters) = Evaluator::new(source, &spec.parameters, &spec.functions)?;
    refuse_unusable_name(&evaluator, &spec.suite)?;
    let plan = stability::plan(&evaluator, source, &spec)?;
    evaluator.refuse_unused(&spec.parameters, &spec.functions)?;
    let head = [spec.suite, spec.title, spec.source, spec.about];
    Ok(assemble(head, parameters, &spec.functions, plan))
}

/// A suite with this name, title, source and text about it.
fn assemble(
    [name, title, source, about]: [String; 4],
    parameters: Vec<DeclaredParameter>,
    functions: &Ordered<String>,
    plan: impl StudyPlan,
) -> Suite {
    let (functions, study) = (functions.as_slice().to_vec(), Arc::new(plan));
    let group = String::new();
    Suite { name, group, title, source, about, parameters, functions, study, fingerprint: 0 }
}

/// A name becomes part of test and file names.
fn refuse_unusable_name(evaluator: &Evaluator<'_>, name: &str) -> Result<(), Diagnostic> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if !name.is_empty() && name.len() <= 64 && name.chars().all(plain) {
        return Ok(());
    }
    let diagnostic = evaluator.diagnostic(&Path::top("suite"), "this is not a name for a suite");
    Err(diagnostic.with_label("expected lower-case letters, digits and hyphens, at most 64"))
}
