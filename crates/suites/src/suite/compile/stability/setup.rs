//! Computes the set-up of a run from parameter values. Any parameter can be swept, so the whole
//! specification is evaluated again for every value.

use crate::suite::compile::check::levels;
use crate::suite::compile::run::refine::{stable_share, step_formula};
use crate::suite::compile::scene;
use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::grammar::{ParameterSpec, StabilitySpec};
use crate::suite::model::Scene;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::stability::{LatticeEdits, ParameterValues, RunSetup};
use crate::suite::scene::{cell_size, grid_axis, per_axis};
use crate::suite::yaml::{Diagnostic, NumberText, Ordered, Source};
use crate::verify::{RunFigure, Scales};

/// Default initial perturbation amplitude for a run in which the particles do not move.
const PERTURBATION: f64 = 1e-9;

#[derive(Clone)]
pub(crate) struct SetupTemplate {
    pub(crate) source: Source,
    pub(crate) spec: StabilitySpec,
}

impl SetupTemplate {
    /// Returns the evaluator of the suite with `values` in place of the values in the file.
    pub(crate) fn evaluator(
        &self,
        values: &ParameterValues<'_>,
    ) -> Result<Evaluator<'_>, Diagnostic> {
        let replace = |parameters: Ordered<ParameterSpec>, (name, value): &(&str, f64)| {
            parameters.with(name, ParameterSpec::Number(NumberText::Number(*value)))
        };
        let parameters = values.iter().fold(self.spec.parameters.clone(), replace);
        Ok(Evaluator::new(&self.source, &parameters, &self.spec.functions)?.0)
    }

    pub(crate) fn setup(&self, values: &ParameterValues<'_>) -> Result<RunSetup, Diagnostic> {
        setup(&self.evaluator(values)?, &self.spec)
    }
}

pub(crate) fn setup(
    evaluator: &Evaluator<'_>,
    spec: &StabilitySpec,
) -> Result<RunSetup, Diagnostic> {
    let scene = scene::scene(evaluator, &spec.scene)?;
    let d = scene.dimension();
    let particles = evaluator.top("particles");
    let at = particles.then("cells");
    let cells = at.count(&spec.particles.cells, "the number of cells")?;
    let ppc_at = particles.then("ppc");
    let ppc = ppc_at.count(&spec.particles.ppc, "the number of particles per cell")?;
    if per_axis(ppc, d).is_none() {
        let message = format!("{ppc} particles per cell are not equally spaced in {d}-D");
        let label = format!("expected n^{d} in {d}-D");
        return Err(ppc_at.diagnostic(&message).with_label(&label));
    }
    let h = cell_size(&scene, cells);
    let run = evaluator.top("run");
    let length = |key: &str, text: &NumberText| {
        let at = run.then(key);
        let dt = at.formula(text, &["h"])?.eval(&[h]);
        if dt > 0.0 && dt.is_finite() {
            return Ok(dt);
        }
        let message = format!("the time step is {}", shown(dt));
        at.expected("a positive number", &message)
    };
    let at_dt = run.then("dt");
    let rule = stable_share(&at_dt, &spec.run.dt)?;
    let dt = length("dt", &step_formula(&at_dt, &spec.run.dt, &scene)?)?;
    let every = turns(evaluator, spec)?;
    if let (Some(_), Some(_)) = (rule, &spec.run.alternate) {
        let message = "`alternate` is not supported with an automatic time step";
        return Err(run.then("alternate").diagnostic_at_key(message));
    }
    let mut steps_of = vec![dt; every];
    if let Some(text) = &spec.run.alternate {
        steps_of.extend(std::iter::repeat_n(length("alternate", text)?, every));
    }
    let level = LevelPlan { cells, h, dt, ppc: Some(ppc) };
    if let Some((what, amount)) = level.too_large(&scene) {
        let message = format!("{cells} cells along the first axis make {amount:.1e} {what}");
        return at.expected("fewer", &message);
    }
    levels::held_faces(&at, &scene, cells)?;
    let steps = run.then("steps").count(&spec.run.steps, "the number of steps")?;
    let full_steps = spec
        .run
        .full_steps
        .as_ref()
        .map_or(Ok(steps), |text| run.then("full_steps").count(text, "the number of steps"));
    let setup = RunSetup {
        lattice: lattice(evaluator, spec, &scene, h)?,
        level,
        dt: steps_of,
        rule,
        steps,
        full_steps: full_steps?,
        frozen: spec.run.frozen,
        perturb: perturbation(evaluator, spec)?,
        scales: scales(evaluator, spec, &scene)?,
        scene,
    };
    if setup.frozen {
        at_rest(evaluator, &setup.scene)?;
    }
    Ok(setup)
}

/// Returns the number of consecutive steps of each length; 1 if all steps have equal length.
fn turns(evaluator: &Evaluator<'_>, spec: &StabilitySpec) -> Result<usize, Diagnostic> {
    const MOST: u64 = 1000;
    let Some(text) = &spec.run.every else { return Ok(1) };
    let path = evaluator.top("run.every");
    if spec.run.alternate.is_none() {
        return path
            .refuse_key("`every` needs a second step length", "add the other length: `alternate`");
    }
    let every = path.count(text, "the number of consecutive steps")?;
    if every > MOST {
        return path.expected(&format!("at most {MOST}"), &format!("{every} consecutive steps"));
    }
    Ok(every as usize)
}

fn lattice(
    evaluator: &Evaluator<'_>,
    spec: &StabilitySpec,
    scene: &Scene,
    h: f64,
) -> Result<LatticeEdits, Diagnostic> {
    let (path, d) = (evaluator.top("particles"), scene.dimension());
    if !(scene.bodies.is_empty() || spec.particles.extra.is_empty()) {
        let message = "`extra` is supported for a single body only, but the scene lists `bodies`";
        return Err(path.then("extra").diagnostic_at_key(message));
    }
    let shift = spec.particles.shift.as_ref();
    let shift = shift.map(|texts| path.then("shift").point(texts, d)).transpose()?;
    let mut extra = Vec::new();
    for (i, texts) in spec.particles.extra.iter().enumerate() {
        let at = path.then("extra").then(i);
        let place = at.point(texts, d)?;
        for (axis, x) in place.iter().enumerate() {
            let (origin, cells) = grid_axis(scene, axis, h);
            if !(origin..=origin + cells * h).contains(x) {
                let message = format!("a particle at {} is outside the grid", shown(*x));
                let (low, high) = (shown(origin), shown(origin + cells * h));
                let label = format!("expected a position from {low} to {high}");
                return Err(at.diagnostic(&message).with_label(&label));
            }
        }
        extra.push(place);
    }
    Ok(LatticeEdits { shift: shift.unwrap_or_default(), extra, ..LatticeEdits::default() })
}

fn perturbation(evaluator: &Evaluator<'_>, spec: &StabilitySpec) -> Result<f64, Diagnostic> {
    let default = if spec.run.frozen { PERTURBATION } else { 0.0 };
    let path = evaluator.top("run.perturb");
    spec.run
        .perturb
        .as_ref()
        .map_or(Ok(default), |text| path.positive(text, "the size of the perturbation"))
}

fn at_rest(evaluator: &Evaluator<'_>, scene: &Scene) -> Result<(), Diagnostic> {
    let loaded = scene.loads.iter().any(|load| load.disturbs_rest());
    let driven = scene.faces.iter().any(|face| face.hold.is_driven());
    let moves = scene.each().iter().any(|body| {
        let moves = !body.initial_displacement.is_empty() || !body.initial_velocity.is_empty();
        moves || !body.initial_stress.is_none()
    });
    if scene.contact.is_some() {
        let message = "`frozen` is not supported with contact, because a step with contact is not \
                       linear";
        return Err(evaluator.top("run.frozen").diagnostic_at_key(message));
    }
    if !(loaded || driven || moves) {
        return Ok(());
    }
    evaluator.top("run.frozen").refuse_key(
        "a frozen run must start at rest, without loads and without initial stress",
        "remove loads, velocities and initial values from the scene; `perturb` starts the run",
    )
}

/// Default maximum energy of a stable run, relative to the initial energy. The maximum is large,
/// because just below the stability limit of a leapfrog scheme the energy oscillates strongly.
const STABLE_BELOW: f64 = 1e3;

/// Default energy, relative to the initial energy, above which a run is unstable.
const UNSTABLE_ABOVE: f64 = 1e8;

fn scales(
    evaluator: &Evaluator<'_>,
    spec: &StabilitySpec,
    scene: &Scene,
) -> Result<Scales, Diagnostic> {
    let modulus = scene.each().iter().map(Scene::wave_modulus).fold(0.0, f64::max);
    let path = evaluator.top("run");
    let bound = |key: &str, text: &Option<NumberText>, default: f64| {
        let at = path.then(key);
        text.as_ref().map_or(Ok(default), |text| at.positive(text, "the bound"))
    };
    let stable_below = bound("stable_below", &spec.run.stable_below, STABLE_BELOW)?;
    let unstable_above = bound("unstable_above", &spec.run.unstable_above, UNSTABLE_ABOVE)?;
    if !(stable_below <= unstable_above) {
        let message = format!(
            "`stable_below` is {}, which is above `unstable_above`, {}",
            shown(stable_below),
            shown(unstable_above)
        );
        return Err(path.diagnostic_at_key(&message));
    }
    let speed = scene.fastest_wave();
    let centred = scene.faces.iter().all(|face| !face.hold.is_held());
    let null_space = null_space(evaluator, spec, scene)?;
    Ok(Scales { speed, modulus, stable_below, unstable_above, centred, null_space })
}

/// Whether a measured value in `show` or `expect` needs the null space of the grid, which runs
/// compute only on request. Refuses several bodies, for which the null space is not implemented.
fn null_space(
    evaluator: &Evaluator<'_>,
    spec: &StabilitySpec,
    scene: &Scene,
) -> Result<bool, Diagnostic> {
    let shown = spec.show.iter().enumerate();
    let shown = shown.map(|(i, figure)| (evaluator.top("show").then(i), *figure));
    let expected = spec.expect.iter().enumerate().flat_map(|(i, entry)| {
        let path = evaluator.top("expect").then(i).then("figures");
        let named =
            entry.figures.as_slice().iter().filter_map(|(name, _)| RunFigure::by_name(name));
        named.map(move |figure| (path.then(figure.name()), figure))
    });
    let Some((path, figure)) = shown.chain(expected).find(|(_, figure)| figure.is_of_null_space())
    else {
        return Ok(false);
    };
    if scene.bodies.is_empty() {
        return Ok(true);
    }
    let message = format!(
        "`{}` is supported for a single body only, but the scene lists `bodies`",
        figure.name()
    );
    Err(path.diagnostic(&message))
}
