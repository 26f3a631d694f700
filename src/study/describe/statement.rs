//! What a suite computes, in rows of name and value, for reports and `explain`.

use super::{amplitude::amplitude, equation_text::equation, heat, stability};
use crate::{
    exact::formula::Formula,
    mpm::{MaterialPlan, Parameter},
    suite::{
        compile::{load::surface, truth::conservation_only, wording::shown},
        model::{
            Against, Case, ConvergencePlan, ForcePlan, Scene, StudyPlan, Suite,
            boundary::BoundaryCondition,
            refine_plan::{LevelPlan, RefinePlan},
        },
    },
    verify::Axis,
};

/// Rows for the whole suite.
pub fn rows(suite: &Suite) -> Vec<(String, String)> {
    let mut rows = Vec::new();
    let parameter = |(name, text, value): &(String, String, f64)| {
        let same = text.parse() == Ok(*value);
        if same { format!("{name} = {text}") } else { format!("{name} = {text} = {value:.6}") }
    };
    let parameters: Vec<String> = suite.parameters.iter().map(parameter).collect();
    push(&mut rows, "parameters", &parameters.join(", "));
    for (head, body) in &suite.functions {
        push(&mut rows, "function", &format!("{head} = {body}"));
    }
    match &suite.study {
        StudyPlan::Convergence(plan) => convergence(plan, &mut rows),
        StudyPlan::InternalForce(plan) => internal_force(plan, &mut rows),
        StudyPlan::Stability(plan) => {
            if let Some(first) = stability::first(plan) {
                scene(&first.scene, &mut rows);
                rows.extend(stability::rows(plan, &first));
            }
        }
    }
    rows
}

/// Rows for one case of a convergence study.
pub fn settings(plan: &ConvergencePlan, case: &Case) -> Vec<(String, String)> {
    let mut rows = case.method.settings();
    let has_walls = plan.scene.faces.iter().any(|face| face.hold.is_held());
    rows.retain(|(key, _)| has_walls || key != "walls");
    let truth = match case.against {
        Against::Exact => "the exact solution",
        Against::Reference => "the reference",
        Against::SameMethod => "the same method with shorter steps",
        Against::Nothing => "nothing",
    };
    push(&mut rows, "until", &format!("t = {} s", case.until));
    push(&mut rows, "against", truth);
    rows
}

type Rows = Vec<(String, String)>;

fn push(rows: &mut Rows, key: &str, value: &str) {
    if !value.is_empty() {
        rows.push((key.to_owned(), value.to_owned()));
    }
}

fn convergence(plan: &ConvergencePlan, rows: &mut Rows) {
    scene(&plan.scene, rows);
    rows.extend(heat::truth(plan));
    if let Some(problem) = &plan.exact {
        if problem.manufactured {
            push(rows, "motion", &problem.motion.source());
            push(rows, "body force", "manufactured, b = u_tt - Div P / rho0");
            push(rows, "equation", equation(&plan.scene.material));
        } else {
            push(rows, "equation", equation(&plan.scene.material));
        }
        if problem.at_rest {
            push(rows, "equilibrium", "under the loads at the end; errors are taken there only");
        }
        push(rows, "amplitude", &amplitude(problem));
    }
    if let Some(fine) = &plan.reference {
        let (element, mass, law) = (fine.element.name(), fine.mass.name(), fine.equation.name());
        let (cells, dt) = (fine.cells, fine.dt.source());
        let text = format!("{element} {mass} FEM, {law}, {cells} elements, dt = {dt}");
        push(rows, "reference", &text);
    }
    if let Some(dt) = plan.same_method_dt {
        let text = format!("the same method, started half a step back, with dt = {} s", shown(dt));
        push(rows, "reference", &text);
    }
    refinement(&plan.refine, plan.instants, rows);
    if !conservation_only::is_truthless(plan) {
        push(rows, "judged", &judged(plan));
    }
    push(rows, "crossing levels", plan.crossing_levels.name());
}

fn judged(plan: &ConvergencePlan) -> String {
    let judged = format!("{} error of the {}", plan.norm.name(), plan.of.words());
    plan.scale.map_or_else(|| judged.clone(), |scale| format!("{judged}, divided by {scale}"))
}

/// Time steps and particles; and cells, where it is not they that are refined.
fn refinement(plan: &RefinePlan, instants: u64, rows: &mut Rows) {
    let list = |of: &dyn Fn(&LevelPlan) -> Option<u64>, levels: &[LevelPlan]| {
        let mut texts: Vec<String> =
            levels.iter().filter_map(of).map(|count| count.to_string()).collect();
        texts.dedup();
        texts.join(", ")
    };
    let cells = |levels: &[LevelPlan]| list(&|level| Some(level.cells), levels);
    let ppc = |levels: &[LevelPlan]| list(&|level| level.ppc, levels);
    if plan.axis != Axis::Space {
        push(rows, "cells", &format!("{} on every level", cells(&plan.levels)));
    }
    let (usual, further) = plan.levels.split_at(plan.usual);
    let usual_steps = plan.steps.len().min(plan.usual);
    let (steps, further_steps) = plan.steps.split_at(usual_steps);
    let dt = steps.join(", ");
    let dt = plan.rule.map_or(format!("{dt} s"), |share| {
        let share = shown(share);
        format!("{share} of the longest safe step, case by case and level by level")
    });
    push(rows, "dt", &format!("{dt}, shortened to divide the time between instants"));
    push(rows, "instants", &format!("{instants}"));
    if plan.has_particles() {
        push(rows, "particles", &format!("{} per cell, equally spaced", ppc(usual)));
    }
    let full = match plan.axis {
        _ if further.is_empty() => String::new(),
        Axis::Space => format!("{} cells", cells(further)),
        Axis::Time => format!("dt = {} s", further_steps.join(", ")),
        Axis::Particles => format!("{} particles per cell", ppc(further)),
    };
    push(rows, "in full also", &full);
}

fn corner(c: &[f64]) -> String {
    c.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

fn body(scene: &Scene) -> String {
    let (from, to) = (corner(&scene.from), corner(&scene.to));
    let body = match (&scene.round, &scene.quadrilateral) {
        (_, Some(panel)) => {
            let corners = panel.corners().iter().map(|c| format!("({})", corner(c.as_slice())));
            format!("quadrilateral {} m", corners.collect::<Vec<_>>().join(", "))
        }
        (None, None) => format!("({from}) to ({to}) m"),
        (Some(round), None) => {
            let (kind, centre, outer) = (round.name(), corner(&round.centre), round.outer);
            let inner =
                if round.inner > 0.0 { format!("{} to ", round.inner) } else { String::new() };
            format!("{kind} about ({centre}), radius {inner}{outer} m, free rims")
        }
    };
    format!("{body}, density {}", scene.density)
}

/// Several bodies, and what couples them.
fn bodies(scene: &Scene, rows: &mut Rows) {
    for (i, one) in scene.bodies.iter().enumerate() {
        push(rows, &format!("body {}", i + 1), &body(one));
        push(rows, "  material", &material(&one.material));
        push(rows, "  velocity", &sources(&one.initial_velocity));
    }
    match (scene.contact, scene.bodies.len()) {
        (Some(mu), _) => push(rows, "contact", &format!("coefficient of friction {mu}")),
        (None, 0 | 1) => {}
        (None, _) => push(rows, "contact", "none: the bodies share one velocity field"),
    }
}

fn scene(scene: &Scene, rows: &mut Rows) {
    let one = scene.bodies.is_empty();
    if one {
        push(rows, "body", &body(scene));
    }
    bodies(scene, rows);
    if let Some((from, to)) = &scene.grid {
        push(rows, "grid", &format!("({}) to ({}) m", corner(from), corner(to)));
    }
    if one {
        push(rows, "material", &material(&scene.material));
    }
    for face in &scene.faces {
        let state = match (surface::described(face), &face.hold) {
            (Some(load), _) => load,
            (None, BoundaryCondition::Velocity(value)) => {
                format!("velocity {} m/s", sources(value))
            }
            (None, BoundaryCondition::Friction(coefficient)) => {
                format!("wall that does not pull, coefficient of friction {coefficient}")
            }
            (None, BoundaryCondition::Free) => "free".to_owned(),
            (None, BoundaryCondition::Fixed) => "fixed".to_owned(),
            (None, BoundaryCondition::Roller) => "roller".to_owned(),
            (None, BoundaryCondition::Periodic) => "periodic".to_owned(),
            (None, BoundaryCondition::AtRest) => String::new(),
        };
        push(rows, face.name, &state);
    }
    for set in &scene.sets {
        let (from, to) = (corner(&set.from), corner(&set.to));
        let force = set.force.iter().map(|value| format!("force {} N in all", sources(value)));
        let speed = set.velocity.iter().map(|value| format!("velocity {} m/s", sources(value)));
        let what: Vec<String> = force.chain(speed).collect();
        let text = format!("({from}) to ({to}) m, {}", what.join(", "));
        push(rows, &format!("set {}", set.name), &text);
    }
    if let Some(gravity) = &scene.gravity {
        push(rows, "gravity", &format!("{} m/s2", sources(gravity)));
    }
    if let Some(force) = &scene.body_force {
        push(rows, "body force", &format!("{} m/s2", sources(force)));
    }
    if let Some(damping) = &scene.damping {
        push(rows, "damping", &format!("{} 1/s", damping.source()));
    }
    if let Some([linear, quadratic]) = scene.viscosity {
        push(rows, "viscosity", &format!("artificial, linear {linear}, quadratic {quadratic}"));
    }
    if let Some(share) = scene.local_damping {
        push(rows, "local damping", &format!("{} of the force out of balance", shown(share)));
    }
    rows.extend(scene.heat.iter().flat_map(heat::scene));
    rows.extend(scene.expansion.iter().map(heat::expansion));
    push(rows, "initial displacement", &sources(&scene.initial_displacement));
    if one {
        push(rows, "initial velocity", &sources(&scene.initial_velocity));
    }
}

/// The material's name and parameters: `linear elastic, E = 100 Pa, nu = 0`.
fn material(plan: &MaterialPlan) -> String {
    let written = |(Parameter { symbol, unit, .. }, value): (Parameter, f64)| {
        format!(", {symbol} = {value} {unit}").trim_end().to_owned()
    };
    let parameters: String = plan.parameters().into_iter().map(written).collect();
    plan.name().replace('_', " ") + &parameters
}

fn sources(formulas: &[Formula]) -> String {
    formulas.iter().map(Formula::source).collect::<Vec<_>>().join(", ")
}

fn internal_force(plan: &ForcePlan, rows: &mut Rows) {
    push(rows, "cells", &format!("two of size {} m, {} particles each", plan.cell, plan.ppc));
    push(rows, "particle volume", &format!("{} m", plan.volume));
    push(rows, "stress", &format!("{} Pa, uniform", plan.stress));
    push(rows, "prediction", &format!("{} N", plan.prediction.source()));
}
