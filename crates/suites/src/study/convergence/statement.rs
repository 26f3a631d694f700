//! Describes a convergence study in rows, and creates the outcomes of cases that have not run.

use crate::exact::heat::Conduction;
use crate::study::describe::{self, Rows, push, scene, stated, step_profile};
use crate::study::exact_motion::{self, amplitude};
use crate::suite::evaluator::shown;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Against, Case, ConvergencePlan, SameMethod};
use crate::suite::scene::lattice::LatticeOffsets;
use crate::suite::scene::numbers::with_unit;
use crate::verify::{Axis, CaseOutcome, Expectation, StepKind, tuple};

pub(crate) fn rows(plan: &ConvergencePlan) -> Rows {
    let mut rows = Rows::new();
    scene(&plan.scene, &mut rows);
    rows.extend(exact_temperature(plan));
    if let Some(problem) = &plan.exact {
        if problem.manufactured {
            push(&mut rows, "motion", &problem.motion.source());
            push(&mut rows, "body force", "manufactured, b = u_tt - Div P / rho0");
        } else {
            push(&mut rows, "exact displacement", &problem.motion.source());
        }
        push(&mut rows, "equation", problem.equation.text());
        if problem.at_rest {
            push(
                &mut rows,
                "equilibrium",
                "under the final loads, with errors computed only at the end of the run",
            );
        }
        push(&mut rows, "amplitude", &amplitude(problem));
        push(&mut rows, "linearised", &exact_motion::row(problem, plan.norm));
    }
    if let Some(fine) = &plan.reference {
        let (element, mass, law) = (fine.element.name(), fine.mass.name(), fine.equation.name());
        let (cells, dt) = (fine.cells, with_unit(fine.dt.source(), "s"));
        let text = format!("{element} {mass} FEM, {law}, {cells} elements, dt = {dt}");
        push(&mut rows, "reference", &text);
    }
    if let Some(same) = plan.same_method {
        push(&mut rows, "reference", &same_method(same, plan));
    }
    refinement(plan, &mut rows);
    if !plan.is_truthless() {
        push(&mut rows, "judged", &judged(plan));
        push(&mut rows, "errors", &divisor(plan));
    }
    if let Some(within) = &plan.within {
        let text = format!("initial positions from {}", within.words());
        push(&mut rows, "judged particles", &text);
    }
    push(&mut rows, "crossing levels", plan.crossing_levels.name());
    rows
}

fn exact_temperature(plan: &ConvergencePlan) -> Vec<(String, String)> {
    let Some(problem) = plan.heat_problem() else { return Vec::new() };
    let Conduction { temperature, manufactured, motion, .. } = problem;
    let flow = if motion.is_some() { "J C^-1 Grad T" } else { "Grad T" };
    let mut rows = vec![("temperature", temperature.source())];
    if *manufactured {
        rows.push(("heat source", format!("manufactured, s = c T_t - Div(k {flow})/rho0")));
    }
    rows.push(("heat equation", format!("rho0 c T_t = Div(k {flow}) + rho0 s")));
    rows.into_iter().map(|(key, text)| (key.to_owned(), text)).collect()
}

fn same_method(same: SameMethod, plan: &ConvergencePlan) -> String {
    let refine = &plan.refine;
    let text = "the same method, started half a step back,";
    match same {
        SameMethod::ShorterSteps(dt) => format!("{text} with dt = {} s", shown(dt)),
        SameMethod::FineGrid(LevelPlan { cells, dt, .. }) => {
            let finest = refine.levels.last().map_or(f64::NAN, |level| level.cells as f64);
            let ratio = cells as f64 / finest;
            let step = match refine.rule {
                Some(_) => "dt by the same rule".to_owned(),
                None => format!("dt = {} s", shown(dt)),
            };
            let method = match plan.steps {
                StepKind::Time => format!("{text} on {cells} cells with {step}"),
                StepKind::Load => format!("the same method on {cells} cells"),
            };
            format!(
                "{method} (at order 2, its error is about 1/{:.0} of the error on the finest level)",
                ratio * ratio
            )
        }
    }
}

fn divisor(plan: &ConvergencePlan) -> String {
    let (Some(formula), Some(scale)) = (&plan.scale_formula, plan.scale) else {
        return String::new();
    };
    let text = format!("divided by {formula} = {} {}", plan.of.shown_scale(scale), plan.of.unit());
    text.trim_end().to_owned()
}

fn judged(plan: &ConvergencePlan) -> String {
    if let Some(sum) = &plan.sum {
        let (norm, of, unit) = (plan.norm.name(), plan.of.words(), plan.of.unit());
        let divisor = match plan.scale {
            Some(scale) if scale != sum.size() => format!("{scale}"),
            _ => format!("its largest size, {:.3e} {unit}", sum.size()),
        };
        return format!("{norm} over the instants of the error of the {of}, divided by {divisor}");
    }
    let judged = format!("{} error of the {}", plan.norm.name(), plan.of.words());
    match plan.scale.filter(|_| plan.scale_formula.is_none()) {
        Some(scale) => format!("{judged}, divided by {scale}"),
        None => judged,
    }
}

fn refinement(study: &ConvergencePlan, rows: &mut Rows) {
    let (plan, instants) = (&study.refine, study.instants);
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
    let dt = plan.rule.map_or(with_unit(&dt, "s"), |share| {
        let share = shown(share);
        format!("{share} times the stable time step of each case and level")
    });
    if study.steps == StepKind::Time {
        // A run can be compared with a reference run only at instants that both have in common.
        let between = if study.cases.iter().any(|case| case.against.is_computed()) {
            " between instants if compared with another run"
        } else {
            ""
        };
        push(rows, "dt", &format!("{dt}, rounded to whole steps{between}"));
        push(rows, "instants", &format!("{instants}"));
    }
    if plan.has_particles() {
        let placed = placed(&study.scatter);
        push(rows, "particles", &format!("{} per cell, {placed}", ppc(usual)));
    }
    let full = match plan.axis {
        _ if further.is_empty() => String::new(),
        Axis::Space => format!("{} cells", cells(further)),
        Axis::Time => format!("dt = {}", with_unit(&further_steps.join(", "), "s")),
        Axis::Particles => format!("{} particles per cell", ppc(further)),
    };
    if !full.is_empty() {
        push(rows, "further levels", &format!("{full}, with the option --full"));
    }
}

fn placed(scatter: &LatticeOffsets) -> String {
    let LatticeOffsets { shift, perturb, seed } = scatter;
    if scatter.is_none() {
        return "equally spaced".to_owned();
    }
    let shares: Vec<String> = shift.iter().map(|share| shown(*share)).collect();
    let shifted =
        (!shares.is_empty()).then(|| format!("shifted by {} times their spacing", tuple(&shares)));
    let perturbed = (*perturb > 0.0).then(|| {
        let most = shown(*perturb);
        format!("moved at random by up to {most} times their spacing (seed {seed})")
    });
    let both: Vec<String> = [shifted, perturbed].into_iter().flatten().collect();
    both.join(" and ")
}

pub(crate) fn settings(plan: &ConvergencePlan, case: &Case) -> Rows {
    let mut rows = case.method.settings();
    match case.load_steps(plan) {
        Some(count) => push(&mut rows, "load steps", &count.to_string()),
        None => push(&mut rows, "until", &format!("t = {} s", stated(case.until))),
    }
    // The exact solution is the default and omitted.
    if !matches!(case.against, Against::Exact) {
        push(&mut rows, "compared with", case.against.words());
    }
    rows
}

pub(crate) fn described(
    plan: &ConvergencePlan,
    case: &Case,
    expectation: Option<&Expectation>,
) -> CaseOutcome {
    let rows = settings(plan, case);
    let described = describe::described(&case.name, case.method, rows, case.expected(expectation));
    CaseOutcome { profile: step_profile(plan, case), ..described }
}
