//! Compiles a suite, and changed copies of a convergence study.

use super::convergence::convergence_plan;
use super::{gradient, internal_force, scene, spectrum, stability};
use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::{ConvergenceSpec, SuiteSpec};
use crate::suite::model::fingerprint::fingerprint;
use crate::suite::model::{Scene, Suite};
use crate::suite::yaml::{Diagnostic, NumberText, Source};

/// Creates a suite from its keys and the function that compiles its study. Group and fingerprint
/// are set by [`Suite::load`] only: changed copies of a study have none.
macro_rules! compile_suite {
    ($source:ident, $spec:ident, $plan:path) => {{
        let (evaluator, parameters) = Evaluator::new($source, &$spec.parameters, &$spec.functions)?;
        refuse_unusable_name(&evaluator, &$spec.suite)?;
        let plan = $plan(&evaluator, &$spec)?;
        evaluator.refuse_unused(&$spec.parameters, &$spec.functions)?;
        let functions = $spec.functions.as_slice().to_vec();
        Suite {
            name: $spec.suite,
            group: String::new(),
            title: $spec.title,
            source: $spec.source,
            about: $spec.about,
            parameters,
            functions,
            study: plan.into(),
            fingerprint: 0,
        }
    }};
}

impl Suite {
    /// Parses and checks a suite, without running a solver.
    ///
    /// # Errors
    /// A [`Diagnostic`] with the position of the first error.
    pub fn load(source: &Source) -> Result<Self, Diagnostic> {
        let suite = match SuiteSpec::read(source)? {
            SuiteSpec::Convergence(spec) => convergence(source, *spec)?,
            SuiteSpec::InternalForce(spec) => compile_suite!(source, spec, internal_force::plan),
            SuiteSpec::Stability(spec) => compile_suite!(source, spec, stability::plan),
            SuiteSpec::Gradient(spec) => compile_suite!(source, spec, gradient::plan),
            SuiteSpec::Spectrum(spec) => compile_suite!(source, spec, spectrum::plan),
        };
        let fingerprint = fingerprint(source.text().as_bytes());
        Ok(Self { group: source.group(), fingerprint, ..suite })
    }

    /// Compiles the scene of the convergence study in `source`, without exact solution. Tests that
    /// run solvers with deliberate defects need this function.
    ///
    /// # Errors
    /// A [`Diagnostic`] with the position of the first error.
    pub fn scene(source: &Source) -> Result<Scene, Diagnostic> {
        let spec = ConvergenceSpec::read(source)?;
        let (evaluator, _) = Evaluator::new(source, &spec.parameters, &spec.functions)?;
        scene::scene(&evaluator, &spec.scene)
    }
}

/// Loads a convergence study with exact motion and initial state, but not the loads, multiplied by
/// `factor`. Refuses a scaled motion that is not a solution.
pub(crate) fn with_amplitude(source: &Source, factor: f64) -> Result<Suite, Diagnostic> {
    with_changes(source, |spec| scale_amplitude(spec, factor))
}

/// Loads the convergence study in `source` after a `change` of its keys, without expectations.
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

fn convergence(source: &Source, spec: ConvergenceSpec) -> Result<Suite, Diagnostic> {
    Ok(compile_suite!(source, spec, convergence_plan))
}

fn refuse_unusable_name(evaluator: &Evaluator<'_>, name: &str) -> Result<(), Diagnostic> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if !name.is_empty() && name.len() <= 64 && name.chars().all(plain) {
        return Ok(());
    }
    let diagnostic = evaluator.top("suite").diagnostic("this is not a name for a suite");
    Err(diagnostic.with_label("expected lower-case letters, digits and hyphens, at most 64"))
}
