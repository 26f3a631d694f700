//! Measures stresses from the momentum flux through the middle of a body.
//!
//! Also checks the columns `stress` and `deformation_gradient`, if the solver reports them.

use crate::testing::doctor::prelude::*;

/// Rate of stretch along the first axis (1/s). The rate is negative, because artificial viscosity
/// acts in compression only. Strains stay below 1e-3.
pub(super) const STRETCH: f64 = -5e-3;
/// Rate of shear (1/s).
pub(super) const SHEAR: f64 = 4e-3;

/// Half the width (cells) of the tube: the points near an axis whose momentum is measured.
const TUBE: f64 = 2.0;

/// Distance that waves travel during the run (cells); waves from free faces do not reach the tube.
pub(crate) const TRAVEL: f64 = 1.5;

/// Number of steps. The number is small, because averaging (PIC) spreads momentum in each step.
pub(crate) const STEPS: u64 = 6;

/// Moduli (Pa) from the growth of stresses: sigma_xx and sigma_yy relative to the stretch, sigma_xy
/// (force along y) and sigma_yx relative to the shear. In 1-D, only `along` is measured.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct MeasuredModuli {
    pub(crate) along: f64,
    pub(super) across: f64,
    pub(super) shear: [f64; 2],
    /// Kinematic viscosity (m2/s) of a stress that is proportional to the strain rate; negative if
    /// the stress follows the strain with a delay.
    pub(super) viscosity: f64,
    /// Ratio of the momentum transferred by averaging to that transferred by stress; at most 1.
    pub(super) averaged_share: f64,
    /// Ratio of the momentum transferred by averaging to that transferred by the stress of the law.
    pub(super) averaging: f64,
    /// Ratio of the momentum transferred by viscosity to that transferred by stress; at most 1.
    pub(super) viscous_share: f64,
    /// Error of sums over a sample, relative to the momentum that the free faces gain; zero for a
    /// complete set of points.
    pub(super) sampling_error: f64,
}

pub(crate) fn spreading(kind: Kind) -> BoxScene {
    // With these cells and particle numbers, each defect changes the moduli by another factor.
    let mut scene = BoxScene::of_cells(kind, [0.75, 0.25, 0.5], 12.0, 3.0);
    scene.ppc = if kind.0 == 3 { 2 } else { 3 };
    let mut scene = scene.scaled(1.2);
    scene.velocity = scene.linear(|i, j| [[STRETCH, SHEAR, 0.0], [0.0; 3], [0.0; 3]][i][j]);
    scene.young = 3.1;
    scene.with_waves(TRAVEL, STEPS)
}

/// Computes moduli from the momentum of the two halves of tubes along the axes. The momentum in a
/// run without stiffness (`soft`) is subtracted, so that averaging does not count as stress.
pub(crate) fn moduli_by_momentum(
    course: &Course,
    soft: Option<&Course>,
    scene: &BoxScene,
) -> MeasuredModuli {
    let flux = |(i, j): (usize, usize)| {
        let mut difference = impulses(course, scene, i, j);
        if let Some(soft) = soft {
            let averaged = impulses(soft, scene, i, j);
            difference.iter_mut().zip(averaged).for_each(|(impulse, other)| *impulse -= other);
        }
        constant_and_rate(&course.times, &difference)
    };
    let [viscous, along] = flux((0, 0));
    let last = course.last();
    let end = course.times[last];
    let (lambda, mu) = scene.lame();
    let averaged = soft.map_or(0.0, |soft| impulses(soft, scene, 0, 0)[last]);
    let share = averaged / impulses(course, scene, 0, 0)[last];
    let mut measured = MeasuredModuli {
        along: along / STRETCH,
        averaged_share: share.abs().min(1.0),
        averaging: averaged / (0.5 * (lambda + 2.0 * mu) * STRETCH * end * end),
        ..MeasuredModuli::default()
    };
    // A time shift of the stress by half a step is not viscosity.
    let excess = (viscous.abs() - 0.6 * (along * scene.dt).abs()).max(0.0);
    measured.viscosity = excess.copysign(viscous / STRETCH) / STRETCH.abs() / scene.density;
    measured.viscous_share = (2.0 * excess / (along * end).abs()).min(1.0);
    if scene.dimension > 1 {
        measured.across = flux((1, 1))[1] / STRETCH;
        measured.shear = [(0, 1), (1, 0)].map(|way| flux(way)[1] / SHEAR);
    }
    measured
}

/// Computes the constant part (Pa) and the rate (Pa/s) of a stress from its impulses (Pa s) at the
/// times `t` (s): a least-squares fit of `constant t + rate t^2/2` from the end of the first step.
pub(crate) fn constant_and_rate(t: &[f64], impulse: &[f64]) -> [f64; 2] {
    let (mut rows, mut ends) = ([[0.0; 2]; 2], [0.0; 2]);
    for k in 2..impulse.len() {
        let terms = [t[k] - t[1], 0.5 * (t[k] * t[k] - t[1] * t[1])];
        for a in 0..2 {
            ends[a] += terms[a] * (impulse[k] - impulse[1]);
            for b in 0..2 {
                rows[a][b] += terms[a] * terms[b];
            }
        }
    }
    let det = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
    let constant = (ends[0] * rows[1][1] - ends[1] * rows[0][1]) / det;
    [constant, (ends[1] * rows[0][0] - ends[0] * rows[1][0]) / det]
}

/// Computes the impulse (Pa s) of the stress with normal i and force direction j at each time: the
/// momentum transferred from the upper to the lower half of a tube along axis i, over its area.
pub(crate) fn impulses(course: &Course, scene: &BoxScene, i: usize, j: usize) -> Vec<f64> {
    let (d, middle) = (scene.dimension, scene.centre());
    let weight = &course.states[0].weight;
    let start: Vec<Vector3<f64>> = course.points(velocity, 0).map(|(_, v)| v).collect();
    let in_tube = |label: Vector3<f64>| {
        (0..d).all(|a| a == i || (label[a] - middle[a]).abs() <= TUBE * scene.h * (1.0 + 1e-9))
    };
    let labels = course.points(velocity, 0).map(|(label, _)| label);
    // Points (such as nodes) may lie on the side of the tube, so the points give the area.
    let volume: f64 = labels.zip(weight).filter(|(x, _)| in_tube(*x)).map(|(_, w)| w).sum();
    let area = volume / (scene.body.1[i] - scene.body.0[i]);
    let impulse = |k: usize| {
        let mut gained = 0.0;
        for (p, (label, v)) in course.points(velocity, k).enumerate() {
            if in_tube(label) {
                let above = label[i] - middle[i];
                // Points on the middle plane belong to both halves.
                let side = if above.abs() <= 1e-9 * H { 0.0 } else { 0.5 * above.signum() };
                gained += side * scene.density * weight[p] * (v[j] - start[p][j]);
            }
        }
        -gained / area
    };
    (0..=course.last()).map(impulse).collect()
}

/// Maximum relative error of a column. The limit is large, because the column may be one step old.
pub(super) const NEAR: f64 = 0.2;

/// Returns the growth of the column `stress` along the stretch over its exact growth, if reported.
pub(super) fn factor(course: &Course, scene: &BoxScene) -> Option<f64> {
    let last = course.last();
    let (lambda, mu) = scene.lame();
    let along = |k: usize| Some(inside(course, scene, &course.states[k].stress)?[0]);
    let time = course.times[last] - course.times[1];
    Some((along(last)? - along(1)?) / ((lambda + 2.0 * mu) * STRETCH * time))
}

/// Returns F_00 - 1 of the column `deformation_gradient` over that of the motion, if reported.
pub(super) fn strain_factor(course: &Course, scene: &BoxScene) -> Option<f64> {
    let last = course.last();
    let f = inside(course, scene, &course.states[last].deformation_gradient)?;
    Some((f[0] - 1.0) / (STRETCH * course.times[last]))
}

pub(super) fn findings(course: &Course, scene: &BoxScene) -> Vec<SolverFinding> {
    let (d, last) = (scene.dimension, course.last());
    let (samples, t) = (&course.states[last], course.times[last]);
    let (lambda, mu) = scene.lame();
    let mut stress = vec![0.0; d * d];
    let mut strain = vec![0.0; d * d];
    (0..d).for_each(|i| stress[i * d + i] = lambda * STRETCH * t);
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

/// Returns the mean of a tensor column over the points within one cell of the centre, if reported.
pub(crate) fn inside(course: &Course, scene: &BoxScene, column: &[f64]) -> Option<Vec<f64>> {
    mean_tensor(course, column, |label| {
        let ends = scene.body.0.iter().zip(&scene.body.1);
        label.iter().zip(ends).all(|(x, (low, high))| (x - 0.5 * (low + high)).abs() <= scene.h)
    })
}

/// Returns the mean of a tensor column (`d * d` numbers per point) over the points for whose label
/// `is_near` holds. `None` without this column, NaN without such points.
pub(crate) fn mean_tensor(
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

/// Returns the entry with the largest magnitude of several tensors; infinite if an entry is NaN.
pub(crate) fn largest_entry(tensors: &[f64]) -> f64 {
    tensors.iter().fold(0.0, |most, x| if x.is_nan() { f64::INFINITY } else { x.abs().max(most) })
}

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
        "the column is positive in compression".to_owned()
    } else if is(seen, wanted, factor) {
        let factor = shown(factor);
        format!(
            "the column is {factor} times the expected stress: another unit, or stress times volume"
        )
    } else {
        "the column contains a different tensor, or its components are in a different order"
            .to_owned()
    };
    let [seen, wanted] = [seen, wanted].map(shown_list);
    Some(SolverFinding::defect(
        "stress-column",
        format!(
            "in the middle of the body, the column `stress` is {seen} Pa; the motion gives {wanted} \
             Pa"
        ),
        &cause,
        "the column, which is the Cauchy stress in Pa: positive in tension, row after row, d x d \
         numbers per point",
    ))
}

fn of_gradient(seen: &[f64], wanted: &[f64], d: usize) -> Option<SolverFinding> {
    if is(seen, wanted, 1.0) {
        return None;
    }
    let (name, cause) = if is(seen, &transposed(wanted, d), 1.0) {
        ("deformation-gradient-transposed", "the column contains the transpose of F")
    } else {
        (
            "deformation-gradient-column",
            "the column contains a different tensor, or F is not updated with the motion",
        )
    };
    let [seen, wanted] = [seen, wanted].map(shown_list);
    Some(SolverFinding::defect(
        name,
        format!(
            "in the middle of the body, the column gives F - I = {seen}; the motion gives {wanted}"
        ),
        cause,
        "the column, which is F = dx/dX row after row: F_ij = dx_i/dX_j; arrays that are stored by \
         columns; the update F <- (I + dt L) F",
    ))
}
