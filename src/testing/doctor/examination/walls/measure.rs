//! Measures wall forces from the momentum of each half of a bar, and motions near walls.

use crate::testing::doctor::examination::stress::{
    constant_and_rate, mean_tensor, require_whole_body,
};
use crate::testing::doctor::prelude::*;

/// Length of the bar (cells).
const CELLS: f64 = 16.0;
/// Distance that waves travel during a run (cells); less than half the length of the bar.
pub(super) const TRAVEL: f64 = 7.0;

/// Number of steps; waves travel a quarter of a cell per step.
const STEPS: u64 = 28;

/// Speed of the bar, relative to the wave speed.
const SPEED: f64 = 1e-3;

/// Distance that waves travel during the run of the stretched bar (cells).
const STRETCH_TRAVEL: f64 = 4.0;
const STRETCH_STEPS: u64 = 16;
/// Strain rate of the stretched bar, multiplied by the time in which a wave crosses a cell.
const STRETCH_RATE: f64 = 1e-4;

/// Gravity (m/s2).
const GRAVITY: f64 = 1e-3;

/// Minimum [`Wall::sinking`] for which the run is repeated with half the step length.
pub(super) const SUNK: f64 = 0.1;

/// Results of the runs for one wall; `None` for a quantity that no run measures.
#[derive(Debug, Clone)]
pub(super) struct Wall {
    pub(super) face: &'static str,
    pub(super) condition: &'static str,
    /// Force on a body that is pushed against the wall, relative to the expected force.
    pub(super) pushed: Option<f64>,
    /// Force on a body that is pulled from the wall, relative to the expected force.
    pub(super) pulled: Option<f64>,
    /// Force on a body that moves along the wall, relative to the expected force.
    pub(super) along: Option<f64>,
    /// Force under gravity, relative to the expected force.
    pub(super) falling: Option<f64>,
    /// Constant error of the force under gravity, relative to the weight of one cell.
    pub(super) offset: Option<f64>,
    /// Displacement through the wall, over that of a free body while a wave crosses one cell.
    pub(super) through: Option<f64>,
    /// Largest displacement in the first step, relative to the product of velocity and step length.
    pub(super) jump: f64,
    /// Displacement along gravity at the wall, for the original and for half the step length. Unit:
    /// g t times the time in which a wave crosses one cell.
    pub(super) sinking: Option<[f64; 2]>,
    /// Error of displacements in a uniform stretch, over the displacement one cell from the wall.
    pub(super) stretch: f64,
    /// Column `stress` next to the wall at the end of the first run, over its expected value.
    pub(super) column: Option<f64>,
}

impl Wall {
    pub(super) fn describe(&self) -> String {
        let forces = [
            ("pushed", self.pushed),
            ("pulled", self.pulled),
            ("slides", self.along),
            ("falls", self.falling),
            ("first step of a fall", self.offset),
            ("stretch", Some(self.stretch)),
        ];
        let text = |(name, force): (&str, Option<f64>)| Some(format!("{name} {}", shown(force?)));
        forces.into_iter().filter_map(text).collect::<Vec<_>>().join(", ")
    }
}

pub(crate) fn bar(kind: Kind, axis: usize, condition: &'static str) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.25; 3], if kind.0 == 3 { 3.0 } else { 4.0 }, 3.0);
    scene.body.1[axis] = scene.body.0[axis] + CELLS * H;
    scene.grid.0[axis] = scene.body.0[axis];
    scene.grid.1[axis] = scene.body.1[axis];
    (scene.young, scene.poisson) = (3.1, 0.0);
    scene.faces = FACES[axis].map(|face| (face, condition)).to_vec();
    scene.with_waves(TRAVEL, STEPS)
}

/// Examines both walls normal to `axis`, on the first axis with both signs of the velocity.
pub(super) fn walls_across(
    patient: &Patient<'_>,
    kind: Kind,
    axis: usize,
    condition: &'static str,
) -> Result<[Wall; 2], Hindrance> {
    let plain = bar(kind, axis, condition);
    let (c, d) = (plain.wave_speed(), kind.0);
    let thrown = |way: f64| BoxScene {
        velocity: AffineField::along(axis, way * SPEED * c),
        ..plain.clone()
    };
    let mut scenes = vec![thrown(1.0)];
    scenes.extend((axis == 0).then(|| thrown(-1.0)));
    let moves_along = condition == "fixed" && d > 1;
    scenes.extend(moves_along.then(|| broad(kind, axis, c)));
    let gravity = std::array::from_fn::<f64, 3, _>(|i| if i == axis { GRAVITY } else { 0.0 });
    let falling = BoxScene { gravity: Some(gravity[..d].to_vec()), ..plain.clone() };
    let needs = falling.needs()?;
    let falls = patient.solver.lacks(&needs).is_empty();
    scenes.extend(falls.then(|| falling.clone()));
    let courses = patient.run_all(&scenes)?;
    require_whole_body(&courses[0], &plain)?;
    let stretch = stretch_errors(patient, kind, axis, condition)?;
    let cell_time = H / c;
    let sinking = |side: BarEnd, course: &Course| {
        side.at_wall(course, &plain) / (GRAVITY * course.times[course.last()] * cell_time)
    };
    let sides = [false, true].map(|high| BarEnd { axis, high });
    let fall = falls.then(|| &courses[courses.len() - 1]);
    let sunk = fall.map(|course| sides.map(|side| sinking(side, course)));
    // The run is repeated only if the body sinks into a wall.
    let halved = match sunk {
        Some(sunk) if sunk.iter().any(|sunk| !(sunk.abs() <= SUNK)) => {
            Some(patient.run_all(&[falling.with_half_the_step()])?)
        }
        _ => None,
    };
    Ok(sides.map(|side| {
        let force = |run: usize| side.force(&courses[run], &scenes[run], axis, c);
        // The body pushes the high wall in the first run, and the low wall in the second run.
        let (push, pull) = if side.high { (0, 1) } else { (1, 0) };
        let of_run = |run: usize| (run == 0 || axis == 0).then(|| force(run));
        let run_along = if axis == 0 { 2 } else { 1 };
        let other = (axis + 1) % d;
        let through =
            |course: &Course| side.sign() * side.at_wall(course, &plain) / (SPEED * c * cell_time);
        let place = usize::from(side.high);
        let [offset, falling] = match fall {
            Some(course) => side.force_under_gravity(course, &plain, c).map(Some),
            None => [None; 2],
        };
        Wall {
            face: FACES[axis][place],
            condition,
            pushed: of_run(push),
            pulled: of_run(pull),
            along: moves_along.then(|| {
                let scene = &scenes[run_along];
                side.force(&courses[run_along], scene, other, c / libm::sqrt(2.0))
            }),
            falling,
            offset,
            through: courses.get(push).filter(|_| push == 0 || axis == 0).map(through),
            jump: courses[0].farthest(displacement, 1, [0.0; 3]) / (SPEED * c * plain.dt),
            sinking: sunk.map(|sunk| {
                let halved = halved.as_ref().and_then(|halved| halved.first());
                [sunk[place], halved.map_or(sunk[place], |halved| sinking(side, halved))]
            }),
            stretch: stretch[place],
            column: side.stress_column(&courses[0], &plain).map(|stress| {
                let expected = -side.sign() * SPEED * c * c * plain.density;
                stress / expected
            }),
        }
    }))
}

/// Computes displacement errors within two cells of the walls at both ends of `axis`, relative to
/// the displacement at a distance of one cell. Errors away from the wall are positive.
///
/// With the initial velocity `v = a (X - X_wall)`, a linear elastic bar stretches uniformly until a
/// wave arrives from its free end. A method reproduces this motion if its basis functions represent
/// a linear velocity up to the wall, so nodes behind the wall must not have zero velocity.
fn stretch_errors(
    patient: &Patient<'_>,
    kind: Kind,
    axis: usize,
    condition: &'static str,
) -> Result<[f64; 2], Hindrance> {
    let ends = [false, true].map(|high| BarEnd { axis, high });
    let scenes = ends.map(|end| stretched(kind, end, condition));
    let courses = patient.run_all(&scenes)?;
    Ok(std::array::from_fn(|k| {
        let (end, scene, course) = (ends[k], &scenes[k], &courses[k]);
        let strain = scene.velocity.gradient[axis][axis] * course.times[course.last()];
        let errors = course.points(displacement, course.last()).filter_map(|(label, u)| {
            let depth = end.depth(scene, label);
            let error = (-end.sign() * u[axis] - strain * depth) / (strain * H);
            (depth <= 2.0 * H).then_some(error)
        });
        // The result is NaN if an error is NaN.
        errors.fold(0.0, |largest: f64, error| {
            if largest.is_nan() || error.abs() <= largest.abs() { largest } else { error }
        })
    }))
}

fn stretched(kind: Kind, end: BarEnd, condition: &'static str) -> BoxScene {
    let mut scene = bar(kind, end.axis, condition);
    scene.faces = vec![(FACES[end.axis][usize::from(end.high)], condition)];
    let wall = if end.high {
        scene.grid.0[end.axis] -= 4.0 * H;
        scene.body.1[end.axis]
    } else {
        scene.grid.1[end.axis] += 4.0 * H;
        scene.body.0[end.axis]
    };
    let mut velocity = AffineField::default();
    velocity.gradient[end.axis][end.axis] = STRETCH_RATE * scene.wave_speed() / H;
    velocity.centre[end.axis] = wall;
    scene.velocity = velocity;
    scene.with_waves(STRETCH_TRAVEL, STRETCH_STEPS)
}

/// Creates a broad body between two `fixed` walls normal to `axis`. The body moves along the walls
/// with the speed `c/1000` (m/s), and the run ends before waves have crossed the body.
fn broad(kind: Kind, axis: usize, c: f64) -> BoxScene {
    let mut scene = bar(kind, axis, "fixed");
    let other = (axis + 1) % kind.0;
    // The body has the full length along the walls, and half the length from wall to wall.
    scene.body.1[axis] = scene.body.0[axis] + 0.5 * CELLS * H;
    scene.grid.1[axis] = scene.body.1[axis];
    scene.body.1[other] = scene.body.0[other] + CELLS * H;
    scene.grid.1[other] = scene.body.1[other] + 4.0 * H;
    scene.velocity = AffineField::along(other, SPEED * c);
    scene.with_waves(0.5 * TRAVEL, STEPS / 2)
}

#[derive(Debug, Clone, Copy)]
struct BarEnd {
    axis: usize,
    high: bool,
}

impl BarEnd {
    fn sign(self) -> f64 {
        if self.high { 1.0 } else { -1.0 }
    }

    /// Returns the distance of a position from the wall (m).
    fn depth(self, scene: &BoxScene, label: Vector3<f64>) -> f64 {
        let ends = (scene.body.0[self.axis], scene.body.1[self.axis]);
        if self.high { ends.1 - label[self.axis] } else { label[self.axis] - ends.0 }
    }

    /// Returns the impulse of the wall along `along` over the mass per length of this half (m2/s).
    fn gained(self, course: &Course, scene: &BoxScene, along: usize, k: usize) -> f64 {
        let half = 0.5 * (scene.body.1[self.axis] - scene.body.0[self.axis]);
        let weights = &course.states[0].weight;
        let (mut sum, mut volume) = (0.0, 0.0);
        let start = course.points(velocity, 0);
        for (((label, v), (_, v0)), weight) in course.points(velocity, k).zip(start).zip(weights) {
            let inside = half - self.depth(scene, label);
            // Points on the middle plane belong to both halves.
            let share =
                if inside.abs() <= 1e-9 * H { 0.5 } else { f64::from(u8::from(inside > 0.0)) };
            sum += share * weight * (v[along] - v0[along]);
            volume += share * weight;
        }
        half * sum / volume
    }

    /// Returns the wall force on a body with uniform initial velocity, relative to `rho c v`. The
    /// first quarter of the run is ignored, because averaging (PIC) increases the force there.
    fn force(self, course: &Course, scene: &BoxScene, along: usize, c: f64) -> f64 {
        let last = course.last();
        let late = last / 4..=last;
        let time: Vec<f64> = late.clone().map(|k| course.times[k]).collect();
        let gained: Vec<f64> = late.map(|k| self.gained(course, scene, along, k)).collect();
        let (_, slope, _) = line(&time, &gained);
        -slope / (c * scene.velocity.value[along])
    }

    /// Returns two parts of the wall force under gravity from rest: the constant part relative to
    /// `rho h g`, and the growing part relative to `rho c g t`.
    fn force_under_gravity(self, course: &Course, scene: &BoxScene, c: f64) -> [f64; 2] {
        let half = 0.5 * (scene.body.1[self.axis] - scene.body.0[self.axis]);
        let held: Vec<f64> = (0..=course.last())
            .map(|k| half * GRAVITY * course.times[k] - self.gained(course, scene, self.axis, k))
            .collect();
        let [constant, rate] = constant_and_rate(&course.times, &held);
        [constant / (scene.h * GRAVITY), rate / (c * GRAVITY)]
    }

    /// Returns the mean normal stress (Pa) next to the wall at the end, if reported.
    fn stress_column(self, course: &Course, scene: &BoxScene) -> Option<f64> {
        let d = scene.dimension;
        let is_near = |label: &[f64]| {
            let label = Vector3::from_fn(|i, _| label.get(i).copied().unwrap_or_default());
            self.depth(scene, label) <= 2.0 * H
        };
        let mean = mean_tensor(course, &course.states[course.last()].stress, is_near)?;
        Some(mean[self.axis * (d + 1)])
    }

    /// Returns the displacement (m) along the axis at the wall at the end. The displacement at the
    /// wall is extrapolated by a line through the points less than two cells from the wall.
    fn at_wall(self, course: &Course, scene: &BoxScene) -> f64 {
        let (mut depth, mut out) = (Vec::new(), Vec::new());
        for (label, u) in course.points(displacement, course.last()) {
            let distance = self.depth(scene, label);
            if distance <= 2.0 * H {
                depth.push(distance);
                out.push(u[self.axis]);
            }
        }
        if depth.is_empty() {
            return 0.0;
        }
        line(&depth, &out).0
    }
}
