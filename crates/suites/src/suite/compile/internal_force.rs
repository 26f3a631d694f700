//! Compiles an internal-force study, and computes the grid-crossing error without a run.
//!
//! Two cells meet at a node, and all cells contain equal particles under the same uniform stress.
//! One particle of the left cell is moved across the node. At each position, the P2G of the solver
//! computes the internal force on the node.

use super::expect::assign;
use crate::mpm::{BasisName, StressedCells, force_at_node};
use crate::suite::evaluator::{Evaluator, SuitePath};
use crate::suite::grammar::{ForceExpectSpec, ForceMethodSpec, InternalForceSpec};
use crate::suite::model::{ForceCase, ForceExpectation, ForcePlan};
use crate::suite::yaml::Diagnostic;
use crate::verify::ForceRow;

/// Maximum number of particles over all positions of the moving one: about a second of run time.
const MOST_SUMMANDS: u64 = 1_000_000;

const VARIABLES: [&str; 2] = ["n_left", "n_right"];

pub(crate) fn plan(
    evaluator: &Evaluator<'_>,
    spec: &InternalForceSpec,
) -> Result<ForcePlan, Diagnostic> {
    let path = evaluator.top("internal_force");
    let force = &spec.internal_force;
    let plan = ForcePlan {
        cell: path.then("cell").positive(&force.cell, "the cell size")?,
        ppc: path.then("ppc").count(&force.ppc, "the number of particles per cell")?,
        volume: path.then("volume").positive(&force.volume, "a particle's volume")?,
        stress: path.then("stress").number(&force.stress)?,
        positions: path.then("positions").count(&force.positions, "the number of positions")?,
        prediction: path.then("prediction").formula(&force.prediction, &VARIABLES)?,
        cases: Vec::new(),
    };
    if plan.ppc.saturating_mul(plan.positions) > MOST_SUMMANDS {
        let (ppc, positions) = (plan.ppc, plan.positions);
        let message = format!("{positions} positions with {ppc} particles per cell each");
        let label = format!("expected at most {MOST_SUMMANDS} particles over all positions");
        return Err(path.then("positions").diagnostic(&message).with_label(&label));
    }
    Ok(ForcePlan { cases: cases(evaluator, spec)?, ..plan })
}

fn cases(
    evaluator: &Evaluator<'_>,
    spec: &InternalForceSpec,
) -> Result<Vec<ForceCase>, Diagnostic> {
    let bases = |ForceMethodSpec::Mpm { basis }: &ForceMethodSpec| basis.as_slice().to_vec();
    let bases: Vec<BasisName> = spec.methods.iter().flat_map(bases).collect();
    if bases.is_empty() {
        let path = evaluator.top("methods");
        return Err(path.diagnostic("the suite has no cases: `methods` is empty"));
    }
    let names: Vec<String> =
        bases.iter().map(|basis| format!("mpm-{}", basis.name().replace('_', "-"))).collect();
    if let Some(twice) = names.iter().enumerate().find(|(i, name)| names[..*i].contains(name)) {
        let message = format!("the case `{}` appears twice", twice.1);
        return Err(evaluator.top("methods").diagnostic(&message));
    }
    let selectors: Vec<_> = spec.expect.iter().map(|spec| spec.case.as_ref()).collect();
    let owners = assign(evaluator, &selectors, &names)?;
    let case = |((basis, name), owner): ((BasisName, String), Option<usize>)| {
        let (mut expected, mut because) = (None, String::new());
        if let Some(owner) = owner {
            let (path, spec) = (evaluator.top("expect").then(owner), &spec.expect[owner]);
            expected = Some(expectation(&path, spec)?);
            because = path.because("this expectation", &spec.because)?;
        }
        Ok(ForceCase { name, basis, expected, because })
    };
    bases.into_iter().zip(names).zip(owners).map(case).collect()
}

fn expectation(
    path: &SuitePath<'_>,
    spec: &ForceExpectSpec,
) -> Result<ForceExpectation, Diagnostic> {
    let share = |key: &str, text| path.then(key).positive(text, "the share");
    match (&spec.agrees_within, &spec.steps_below) {
        (Some(text), None) => share("agrees_within", text).map(ForceExpectation::AgreesWithin),
        (None, Some(text)) => share("steps_below", text).map(ForceExpectation::StepsBelow),
        _ => Err(path
            .diagnostic("this expectation must state exactly one bound")
            .with_label("expected either `agrees_within` or `steps_below`")),
    }
}

pub(crate) fn rows(plan: &ForcePlan, case: &ForceCase) -> Vec<ForceRow> {
    (0..plan.positions).map(|k| row(plan, case, k)).collect()
}

fn row(plan: &ForcePlan, case: &ForceCase, k: u64) -> ForceRow {
    // Midpoints of equal parts between -1/2 and 1/2 cells, symmetric about the node.
    let position = (k as f64 + 0.5) / plan.positions as f64 - 0.5;
    let right = plan.ppc + u64::from(position >= 0.0);
    let left = 2 * plan.ppc - right;
    let ForcePlan { cell, volume, stress, .. } = *plan;
    let cells = StressedCells { cell, ppc: plan.ppc as usize, volume, stress };
    ForceRow {
        position,
        left,
        right,
        force: force_at_node(case.basis, &cells, position),
        predicted: plan.prediction.eval(&[left as f64, right as f64]),
    }
}
