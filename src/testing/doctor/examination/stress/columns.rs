//! The columns `stress` and `deformation_gradient` of a solver that gives them.

use super::measure::{SHEAR, STRETCH};
use crate::testing::doctor::course::{Course, shown};
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::scene::BoxScene;

/// Share by which a column may be off: it may be that of a step before, and waves are near.
pub(super) const NEAR: f64 = 0.2;

/// Ratio of the growth of the column `stress` along the stretch to its expected value; `None` if
/// the column is not given.
pub(super) fn factor(course: &Course, scene: &BoxScene) -> Option<f64> {
    let last = course.last();
    let (lambda, mu) = scene.lame();
    let along = |k: usize| Some(inside(course, scene, &course.states[k].stress)?[0]);
    let time = course.times[last] - course.times[1];
    Some((along(last)? - along(1)?) / ((lambda + 2.0 * mu) * STRETCH * time))
}

/// Ratio of F_00 - 1 of the column `deformation_gradient` to that of the motion; `None` if the
/// column is not given.
pub(super) fn strain_factor(course: &Course, scene: &BoxScene) -> Option<f64> {
    let last = course.last();
    let f = inside(course, scene, &course.states[last].deformation_gradient)?;
    Some((f[0] - 1.0) / (STRETCH * course.times[last]))
}

/// Columns that do not agree with the motion.
pub(super) fn findings(course: &Course, scene: &BoxScene) -> Vec<SolverFinding> {
    let (d, last) = (scene.dimension, course.last());
    let (samples, t) = (&course.states[last], course.times[last]);
    let (lambda, mu) = scene.lame();
    let mut stress = vec![0.0; d * d];
    let mut strain = vec![0.0; d * d];
    for i in 0..d {
        stress[i * d + i] = lambda * STRETCH * t;
    }
    stress[0] += 2.0 * mu * STRETCH * t;
    strain[0] = STRETCH * t;
    if d > 1 {
        stress[1] = mu * SHEAR * t;
        stress[d] = mu * SHEAR * t;
        strain[1] = SHEAR * t;
    }
    let mut found = Vec::new();
    if let Some(seen) = inside(course, scene, &samples.stress) {
        found.extend(of_stress(&seen, &stress));
    }
    if let Some(mut seen) = inside(course, scene, &samples.deformation_gradient) {
        (0..d).for_each(|i| seen[i * d + i] -= 1.0);
        found.extend(of_gradient(&seen, &strain, d));
    }
    found
}

/// Mean of a tensor within a cell of the middle; `None` if the column is not given.
pub(in crate::testing::doctor) fn inside(
    course: &Course,
    scene: &BoxScene,
    column: &[f64],
) -> Option<Vec<f64>> {
    mean_tensor(course, column, |label| {
        let ends = scene.body.0.iter().zip(&scene.body.1);
        label.iter().zip(ends).all(|(x, (low, high))| (x - 0.5 * (low + high)).abs() <= scene.h)
    })
}

/// Mean of a tensor (`d * d` numbers per point) over points whose label `is_near`; `None` if the
/// column is not given, NaN without such points.
pub(in crate::testing::doctor) fn mean_tensor(
    course: &Course,
    column: &[f64],
    is_near: impl Fn(&[f64]) -> bool,
) -> Option<Vec<f64>> {
    let d = course.problem.dimension;
    if column.is_empty() {
        return None;
    }
    let labels = course.states[0].label.chunks_exact(d);
    let (mut sum, mut count) = (vec![0.0; d * d], 0.0);
    for (_, tensor) in labels.zip(column.chunks_exact(d * d)).filter(|(label, _)| is_near(label)) {
        sum.iter_mut().zip(tensor).for_each(|(sum, x)| *sum += x);
        count += 1.0;
    }
    Some(sum.into_iter().map(|sum| sum / count).collect())
}

/// Largest entry of tensors by magnitude; infinite if one is not a number.
pub(in crate::testing::doctor) fn largest_entry(tensors: &[f64]) -> f64 {
    tensors.iter().fold(0.0, |most, x| if x.is_nan() { f64::INFINITY } else { x.abs().max(most) })
}

/// Whether `seen` is `factor` times `wanted`.
fn is(seen: &[f64], wanted: &[f64], factor: f64) -> bool {
    let scale = factor.abs() * wanted.iter().map(|x| x.abs()).fold(0.0, f64::max);
    seen.iter().zip(wanted).all(|(a, b)| (a - factor * b).abs() <= NEAR * scale)
}

fn of_stress(seen: &[f64], wanted: &[f64]) -> Option<SolverFinding> {
    if is(seen, wanted, 1.0) {
        return None;
    }
    let factor = seen[0] / wanted[0];
    let cause = if is(seen, wanted, -1.0) {
        "compression is positive in the column".to_owned()
    } else if is(seen, wanted, factor) {
        format!("the column is {} of it: another unit, or a stress times the volume", shown(factor))
    } else {
        "the column is another tensor, or in another order".to_owned()
    };
    Some(SolverFinding::defect(
        "stress-column",
        format!(
            "`stress` has {} Pa in the middle, where the motion shows {}",
            all(seen),
            all(wanted)
        ),
        &cause,
        "Cauchy's stress in Pa, tension positive, row after row, d x d numbers a point",
    ))
}

fn of_gradient(seen: &[f64], wanted: &[f64], d: usize) -> Option<SolverFinding> {
    if is(seen, wanted, 1.0) {
        return None;
    }
    let turned: Vec<f64> = (0..d * d).map(|k| wanted[(k % d) * d + k / d]).collect();
    let name = if is(seen, &turned, 1.0) {
        "deformation-gradient-transposed"
    } else {
        "deformation-gradient-column"
    };
    Some(SolverFinding::defect(
        name,
        format!("F - I is {} in the middle, where the motion shows {}", all(seen), all(wanted)),
        if name.ends_with("transposed") {
            "the column has F's transpose"
        } else {
            "the column is another tensor, or F is not updated as the motion goes"
        },
        "F = dx/dX, row after row: F_ij = dx_i/dX_j; a store that goes by columns; F <- (I + dt L) F",
    ))
}

fn all(tensor: &[f64]) -> String {
    format!("({})", tensor.iter().map(|x| shown(*x)).collect::<Vec<_>>().join(", "))
}
