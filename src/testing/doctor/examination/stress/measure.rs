//! Stresses by the momentum that flows through the middle of a body.

use crate::testing::doctor::course::{Course, velocity};
use crate::testing::doctor::scene::{BoxScene, H, Kind};
use crate::testing::doctor::vectors::AffineField;

/// Rates of stretch along the first axis and of shear (1/s): strains stay below 1e-3. The body is
/// compressed, as artificial viscosities act in compression only.
pub(super) const STRETCH: f64 = -5e-3;
pub(super) const SHEAR: f64 = 4e-3;

/// Half the width (cells) of the tube whose momentum is counted.
const TUBE: f64 = 2.0;

/// Distance (cells) that waves travel during the run: they reach neither the side of the tube nor
/// its middle.
pub(in crate::testing::doctor) const TRAVEL: f64 = 1.5;

/// Steps of the run: few, since averaging (PIC) spreads momentum in each.
pub(in crate::testing::doctor) const STEPS: u64 = 6;

/// Moduli (Pa) by which stresses grow: sigma_xx and sigma_yy over the stretch, sigma_xy (force
/// along y) and sigma_yx over the shear. In one dimension there is the first one only.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct MeasuredModuli {
    pub(super) along: f64,
    pub(super) across: f64,
    pub(super) shear: [f64; 2],
    /// Kinematic viscosity (m2/s) of a stress in proportion to the rate of strain.
    pub(super) viscosity: f64,
    /// Momentum moved without stress, as a share of that moved by stress, at most one.
    pub(super) averaged_share: f64,
    /// Momentum moved by that viscosity, as a share of that moved by stress, at most one.
    pub(super) viscous_share: f64,
}

/// The scene, which `units` runs as well.
pub(in crate::testing::doctor) fn spreading(kind: Kind) -> BoxScene {
    let cells = if kind.0 == 3 { 10.0 } else { 12.0 };
    // A cell of 0.15 m and these numbers of particles give no two mistakes the same factor.
    let mut scene = BoxScene::of_cells(kind, [0.75, 0.25, 0.5], cells, 3.0);
    scene.ppc = if kind.0 == 3 { 2 } else { 3 };
    let mut scene = scene.scaled(1.2, 1.0, libm::pow(1.2, kind.0 as f64));
    let mut field = AffineField { centre: scene.centre(), ..AffineField::default() };
    field.gradient[0][0] = STRETCH;
    if kind.0 > 1 {
        field.gradient[0][1] = SHEAR;
    }
    scene.velocity = field;
    scene.young = 3.1;
    scene.with_waves(TRAVEL, STEPS)
}

/// Moduli by the momentum of the two halves of tubes along the axes. A run without stiffness
/// (`soft`) is subtracted, so that momentum that is moved by averaging does not count as stress.
pub(super) fn moduli_by_momentum(
    course: &Course,
    soft: Option<&Course>,
    scene: &BoxScene,
) -> MeasuredModuli {
    let flux = |way: (usize, usize)| {
        let mut difference = impulses(course, scene, way);
        if let Some(soft) = soft {
            let averaged = impulses(soft, scene, way);
            difference.iter_mut().zip(averaged).for_each(|(impulse, other)| *impulse -= other);
        }
        constant_and_rate(&course.times, &difference)
    };
    let [viscous, along] = flux((0, 0));
    let last = course.last();
    let averaged = soft.map_or(0.0, |soft| {
        impulses(soft, scene, (0, 0))[last] / impulses(course, scene, (0, 0))[last]
    });
    let mut measured = MeasuredModuli {
        along: along / STRETCH,
        averaged_share: averaged.abs().min(1.0),
        ..MeasuredModuli::default()
    };
    // A stress that is half a step ahead or behind is not viscous.
    let viscous = (viscous.abs() - 0.6 * (along * scene.dt).abs()).max(0.0);
    let end = course.times[course.last()];
    measured.viscosity = viscous / STRETCH / scene.density;
    measured.viscous_share = (2.0 * viscous / (along * end).abs()).min(1.0);
    if scene.dimension > 1 {
        measured.across = flux((1, 1))[1] / STRETCH;
        measured.shear = [(0, 1), (1, 0)].map(|way| flux(way)[1] / SHEAR);
    }
    measured
}

/// The constant part (Pa) and the rate (Pa/s) of a stress, by its impulses (Pa s) at times (s):
/// the least squares of `constant t + rate t^2/2` from the end of the first step on.
pub(in crate::testing::doctor) fn constant_and_rate(t: &[f64], impulse: &[f64]) -> [f64; 2] {
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

/// Impulse (Pa s) of the stress with normal i and force j at each time: the momentum that has left
/// the upper half of a tube along axis i for the lower one, over the area of the tube. Only
/// velocities enter, at reference places.
pub(in crate::testing::doctor) fn impulses(
    course: &Course,
    scene: &BoxScene,
    (i, j): (usize, usize),
) -> Vec<f64> {
    let (d, middle) = (scene.dimension, scene.centre());
    let weight = &course.states[0].weight;
    let start: Vec<[f64; 3]> = course.points(velocity, 0).map(|(_, v)| v).collect();
    let in_tube = |label: [f64; 3]| {
        (0..d).all(|a| a == i || (label[a] - middle[a]).abs() <= TUBE * scene.h * (1.0 + 1e-9))
    };
    let labels = course.points(velocity, 0).map(|(label, _)| label);
    // Points may lie on the side of the tube, as nodes do: the area is that of the points inside.
    let volume: f64 = labels.zip(weight).filter(|(x, _)| in_tube(*x)).map(|(_, w)| w).sum();
    let area = volume / (scene.body.1[i] - scene.body.0[i]);
    let impulse = |k: usize| {
        let mut gained = 0.0;
        for (p, (label, v)) in course.points(velocity, k).enumerate() {
            if in_tube(label) {
                let above = label[i] - middle[i];
                // Points on the plane belong to both halves.
                let side = if above.abs() <= 1e-9 * H { 0.0 } else { 0.5 * above.signum() };
                gained += side * scene.density * weight[p] * (v[j] - start[p][j]);
            }
        }
        -gained / area
    };
    (0..=course.last()).map(impulse).collect()
}
