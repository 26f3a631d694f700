//! Warnings and notes about a suite, with positions in its file, found before anything runs.
//!
//! Rules about orders do not apply to a suite that only bounds an error. Suites acknowledge
//! intended findings by name, with the key `acknowledge`.

pub(crate) mod alignment;
pub(crate) mod error_floor;
pub(crate) mod grid;
pub(crate) mod subject;
pub(crate) mod undamped;

use self::subject::Preflight;
use crate::study::convergence::judge_plan::in_time;
use crate::suite::grammar::WarningName;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Case, ConvergencePlan, Suite};
use crate::suite::scene::nodes;
use crate::suite::yaml::locate::Path;
use crate::suite::yaml::{Diagnostic, Severity, Source};
use crate::verify::Axis;

type PreflightRule = fn(&Preflight<'_>) -> Vec<Diagnostic>;

/// Rules for suites with an expected order, with the names by which suites acknowledge them.
const RULES_OF_ORDER: [(WarningName, PreflightRule); 6] = [
    (WarningName::FewLevels, grid::few_levels),
    (WarningName::TimeStep, check),
    (WarningName::LeavesGrid, grid::leaves_grid),
    (WarningName::SmallStrain, error_floor::small_strain),
    (WarningName::SinglePrecision, error_floor::single_precision),
    (WarningName::InsideCell, alignment::check),
];

/// Rules for all suites, with the names by which suites acknowledge them.
const RULES: [(WarningName, PreflightRule); 3] = [
    (WarningName::LooseTolerance, error_floor::loose_tolerance),
    (WarningName::EndOnNode, grid::end_on_node),
    (WarningName::Undamped, undamped::check),
];

/// Adds to the help of a warning the name by which a suite can acknowledge the warning.
fn with_name(finding: Diagnostic, name: WarningName) -> Diagnostic {
    if finding.severity() != Severity::Warning {
        return finding;
    }
    let acknowledged = format!("if the suite intends this, `acknowledge` `{}`", name.name());
    let help = match finding.help() {
        Some(help) => format!("{help}; {acknowledged}"),
        None => acknowledged,
    };
    finding.with_help(&help)
}

/// Returns warnings and notes about `suite`, which was read from `source`. Acknowledged warnings
/// are excluded. The list is empty for studies without refinement levels.
pub fn preflight(suite: &Suite, source: &Source) -> Vec<Diagnostic> {
    let Some(plan) = suite.convergence() else { return Vec::new() };
    let preflight = Preflight::new(plan, source);
    let of_order = RULES_OF_ORDER.iter().filter(|_| preflight.claims_an_order());
    let (mut findings, mut used) = (Vec::new(), Vec::new());
    for (name, rule) in of_order.chain(&RULES) {
        let found = rule(&preflight);
        if plan.acknowledged.contains(name) {
            used.extend(found.first().map(|_| *name));
        } else {
            findings.extend(found.into_iter().map(|finding| with_name(finding, *name)));
        }
    }
    findings.extend(preflight.unused_acknowledgements(&used));
    findings
}

/// Warns of a time step that is too long for waves, particles or heat conduction. A step that is
/// equal on all levels of a study in space is a note.
pub(crate) fn check(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let found = [too_long(preflight), too_long_for_heat(preflight), fixed(preflight)];
    found.into_iter().flatten().collect()
}

fn too_long(preflight: &Preflight<'_>) -> Option<Diagnostic> {
    let plan = preflight.plan;
    let moves = plan.cases.iter().any(|case| matches!(case.method, Method::Mpm(_)));
    if let Some(share) = plan.refine.rule {
        let message = format!("the time step is {share} times the stable time step");
        let found = preflight.finding(Severity::Warning, &steps(preflight), &message);
        return (share > 1.0).then(|| found.with_label("expected a share of at most 1"));
    }
    if !moves {
        return None;
    }
    let waves = plan.scene.fastest_wave();
    let speed = preflight.extremes.as_ref().map_or(0.0, |motion| motion.speed);
    let courant = |level: &LevelPlan| level.dt * (waves + speed) / level.h;
    let level = preflight.levels().iter().find(|level| courant(level) > 1.0)?;
    let (cells, courant) = (level.cells, courant(level));
    let message = format!(
        "with {cells} cells the time step is {courant:.2} times the time in which a wave crosses a \
         cell"
    );
    let found = preflight.finding(Severity::Warning, &steps(preflight), &message);
    let help = "`dt: {courant: 0.5}` uses half of the stable time step on every level";
    Some(found.with_label("expected a stable step").with_help(help))
}

/// Warns of a step that is too long for heat conduction. Forward Euler on lumped linear elements is
/// stable up to h^2 rho c/(2 k) (Hughes 2000, section 8.2).
fn too_long_for_heat(preflight: &Preflight<'_>) -> Option<Diagnostic> {
    let scene = &preflight.plan.scene;
    let heat = scene.heat()?;
    let diffusivity = heat.conductivity / (scene.density.largest() * heat.capacity);
    let limit = |level: &LevelPlan| 0.5 * level.h * level.h / diffusivity;
    let level = preflight.levels().iter().find(|level| level.dt > limit(level))?;
    let (cells, limit, times) = (level.cells, limit(level), level.dt / limit(level));
    let message = format!(
        "with {cells} cells the time step is {times:.2} times the stable time step of heat \
         conduction, {limit:.2e} s"
    );
    let found = preflight.finding(Severity::Warning, &steps(preflight), &message);
    let help = "steps of heat are stable up to about h^2*density*capacity/(2*conductivity)";
    Some(found.with_label("expected a stable step").with_help(help))
}

fn fixed(preflight: &Preflight<'_>) -> Option<Diagnostic> {
    let refine = &preflight.plan.refine;
    let levels = preflight.levels();
    let (first, last) = (levels.first()?, levels.last()?);
    let same = first.dt.total_cmp(&last.dt).is_eq() && first.h > last.h;
    if refine.axis != Axis::Space || refine.rule.is_some() || !same {
        return None;
    }
    let case = preflight.of_an_order().find(|case| matches!(case.method, Method::Mpm(_)))?;
    let order = in_time(case.method, preflight.plan.exact.as_ref());
    let message = format!(
        "the time step is the same on every level: its error, of order {order}, does not fall with \
         the cell size"
    );
    let found = preflight.finding(Severity::Note, &steps(preflight), &message);
    Some(found.with_help("a formula of h, or `{courant: 0.5}`, refines both together"))
}

fn steps(preflight: &Preflight<'_>) -> Path {
    if preflight.plan.refine.steps.len() > 1 {
        Path::top("refine").then("dt")
    } else {
        Path::top("run").then("dt")
    }
}

/// Time (s) per particle and step, by dimension, with errors and set-up. Fitted to runs of eight
/// suites with `cargo run` on one thread; single suites differ by a factor of up to three.
const SECONDS: [f64; 3] = [2.5e-7, 6e-7, 1.8e-6];

/// Assumed time (s) of a case without a prediction.
pub(crate) const UNKNOWN: f64 = 0.5;

/// Memory (bytes) per particle and per node, by dimension.
const BYTES: [[f64; 2]; 3] = [[100.0, 40.0], [250.0, 70.0], [450.0, 100.0]];

/// Estimated cost of a whole suite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Number of particles times number of steps, over all cases and levels.
    pub particle_steps: f64,
    /// Time (s) on one thread, accurate to a factor of about three.
    pub seconds: f64,
    /// Memory of the largest level (bytes).
    pub bytes: f64,
}

/// Estimates the cost of a convergence study without `--full`; `None` for other studies.
pub fn estimate(suite: &Suite) -> Option<Estimate> {
    suite.convergence().map(estimate_of)
}

/// Estimates the cost of each case of a suite; `None` for studies without refinement.
pub fn estimates(suite: &Suite, extent: Extent) -> Vec<Option<Estimate>> {
    match suite.convergence() {
        Some(plan) => plan.cases.iter().map(|case| Some(of_case(plan, case, extent))).collect(),
        None => vec![None; suite.case_names().len()],
    }
}

pub(crate) fn estimate_of(plan: &ConvergencePlan) -> Estimate {
    let none = Estimate { particle_steps: 0.0, seconds: 0.0, bytes: 0.0 };
    let cases = plan.cases.iter().map(|case| of_case(plan, case, Extent::Usual));
    cases.fold(none, |all, case| Estimate {
        particle_steps: all.particle_steps + case.particle_steps,
        seconds: all.seconds + case.seconds,
        bytes: all.bytes.max(case.bytes),
    })
}

/// Predicts the time (s) on one thread for each progress unit of a run. A unit is a level or, in a
/// study without refinement, a case with a default time.
pub fn unit_seconds(suite: &Suite, extent: Extent) -> Vec<f64> {
    let Some(plan) = suite.convergence() else {
        return vec![UNKNOWN; suite.case_names().len()];
    };
    let index = plan.scene.dimension().clamp(1, 3) - 1;
    let levels = plan.refine.levels(extent);
    let each = plan.cases.iter().flat_map(|case| levels.iter().map(move |level| (case, level)));
    each.map(|(case, level)| SECONDS[index] * particle_steps(plan, case, *level)).collect()
}

fn particle_steps(plan: &ConvergencePlan, case: &Case, level: LevelPlan) -> f64 {
    let steps = case.clock(plan, level.dt).map_or(0, |clock| clock.steps);
    level.particles(&plan.scene) * steps as f64
}

fn of_case(plan: &ConvergencePlan, case: &Case, extent: Extent) -> Estimate {
    let scene = &plan.scene;
    let index = scene.dimension().clamp(1, 3) - 1;
    let (mut all, mut bytes) = (0.0, 0.0_f64);
    for level in plan.refine.levels(extent) {
        let particles = level.particles(scene);
        all += particle_steps(plan, case, *level);
        let [particle, node] = BYTES[index];
        bytes = bytes.max(particle * particles + node * nodes(scene, level.h));
    }
    Estimate { particle_steps: all, seconds: SECONDS[index] * all, bytes }
}
