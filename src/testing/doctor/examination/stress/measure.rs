//! The scene, and moduli by the momentum that flows through its middle.

use crate::testing::doctor::course::{Course, velocity};
use crate::testing::doctor::scene::{BoxScene, H};

/// Rates of stretch along the first axis and of shear (1/s): strains stay below 1e-3.
pub(super) const STRETCH: f64 = 5e-3;
pub(super) const SHEAR: f64 = 4e-3;

/// Half the width (cells) of the tube whose momentum is counted.
const TUBE: f64 = 2.0;

/// Way of a wave (cells) in the time of the run: it does not reach the tube's flank nor its middle.
const WAY: f64 = 1.5;

const STEPS: u64 = 15;

/// Moduli (Pa) by which stresses grow: sigma_xx and sigma_yy over the stretch, sigma_xy (of force
/// along y) and sigma_yx over the shear. In one dimension there is the first one only.
#[derive(Debug, Clone, Copy)]
pub(super) struct SeenModuli {
    pub(super) along: f64,
    pub(super) across: f64,
    pub(super) shear: [f64; 2],
    /// Kinematic viscosity (m2/s) by which momentum spreads besides.
    pub(super) viscosity: f64,
    /// Share of the momentum that spreads so, up to one.
    pub(super) spread: f64,
    /// Share of the momentum that the first step moves by itself, up to one.
    pub(super) jump: f64,
}

/// The scene; also that of others that want a body under stress.
pub(in crate::testing::doctor) fn spreading(kind: (usize, &'static str), cells: f64) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.75, 0.25, 0.5], cells, 3.0);
    let middle = |i: usize| 0.5 * (scene.body.0[i] + scene.body.1[i]);
    let mut along = format!("{STRETCH:e}*(X - {:e})", middle(0));
    if kind.0 > 1 {
        along.push_str(&format!(" + {SHEAR:e}*(Y - {:e})", middle(1)));
    }
    scene.velocity[0] = along;
    scene.young = 3.0;
    let dt = WAY * H / scene.wave_speed() / STEPS as f64;
    BoxScene { steps: STEPS, dt, ..scene }
}

/// Moduli by the momentum of the two halves of tubes along the axes.
pub(super) fn moduli_of(course: &Course, scene: &BoxScene) -> SeenModuli {
    let [along, spread, jump] = flux(course, scene, (0, 0));
    let mut seen = SeenModuli {
        along: along / STRETCH,
        across: 0.0,
        shear: [0.0; 2],
        viscosity: 0.0,
        spread: 0.0,
        jump: 0.0,
    };
    // What the staggering of a step puts there is no viscosity.
    let spread = (spread.abs() - 0.6 * (along * scene.dt).abs()).max(0.0);
    let end = course.times[course.last()];
    let share = |impulse: f64| (2.0 * impulse / (along * end * end).abs()).min(1.0);
    seen.viscosity = spread / STRETCH / scene.density;
    (seen.spread, seen.jump) = (share(spread * end), share(jump.abs()));
    if scene.dimension > 1 {
        seen.across = flux(course, scene, (1, 1))[0] / STRETCH;
        seen.shear = [(0, 1), (1, 0)].map(|way| flux(course, scene, way)[0] / SHEAR);
    }
    seen
}

/// Rate of the stress (Pa/s) of normal i and force j, a constant stress besides (Pa), and what the
/// first step moves by itself (Pa s), by the momentum that has left the upper half for the lower.
fn flux(course: &Course, scene: &BoxScene, way: (usize, usize)) -> [f64; 3] {
    let (t, y) = (&course.times, impulses(course, scene, way));
    let (mut rows, mut ends) = ([[0.0; 2]; 2], [0.0; 2]);
    for k in 2..y.len() {
        let terms = [t[k] - t[1], 0.5 * (t[k] * t[k] - t[1] * t[1])];
        for a in 0..2 {
            ends[a] += terms[a] * (y[k] - y[1]);
            for b in 0..2 {
                rows[a][b] += terms[a] * terms[b];
            }
        }
    }
    let det = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
    let constant = (ends[0] * rows[1][1] - ends[1] * rows[0][1]) / det;
    let rate = (ends[1] * rows[0][0] - ends[0] * rows[1][0]) / det;
    [rate, constant, y[1] - constant * t[1] - 0.5 * rate * t[1] * t[1]]
}

/// Impulse (Pa s) from the upper half to the lower at each time.
fn impulses(course: &Course, scene: &BoxScene, (i, j): (usize, usize)) -> Vec<f64> {
    let d = scene.dimension;
    let middle: Vec<f64> = (0..d).map(|k| 0.5 * (scene.body.0[k] + scene.body.1[k])).collect();
    let area = (1..d).fold(1.0, |area, _| area * 2.0 * TUBE * scene.h);
    let weight = &course.states[0].weight;
    let start: Vec<[f64; 3]> = course.points(velocity, 0).map(|(_, v)| v).collect();
    let impulse = |k: usize| {
        let mut gained = 0.0;
        for (p, (label, v)) in course.points(velocity, k).enumerate() {
            let in_tube = |a: usize| a == i || (label[a] - middle[a]).abs() <= TUBE * scene.h;
            if (0..d).all(in_tube) {
                let side = if label[i] > middle[i] { 0.5 } else { -0.5 };
                gained += side * scene.density * weight[p] * (v[j] - start[p][j]);
            }
        }
        -gained / area
    };
    (0..=course.last()).map(impulse).collect()
}
