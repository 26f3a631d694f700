//! Walls on every face: a body that is thrown against them, pulled from them, moves along them, and falls.
//!
//! A bar of modulus E without Poisson's effect that is held at one end and thrown with v stops there with
//! the force `rho c v A`, c^2 = E/rho, until the wave has crossed it. Under the acceleration g from rest the
//! force is `rho c g t A`. Both ends are held at once: one is pushed, the other one pulled. The momentum of
//! one half shows the force of its wall as long as no wave arrives from the other.

use super::translation::VELOCITY;
use crate::testing::doctor::course::{Course, displacement, line, shown, velocity};
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::motion::uniform;
use crate::testing::doctor::patient::{Examined, Hindrance, Patient};
use crate::testing::doctor::question::Examination;
use crate::testing::doctor::scene::{AffineField, BoxScene, ELASTIC, FACES, H, Kind};

pub(super) const EXAMINATION: Examination = Examination {
    name: "walls",
    expected: "every wall holds a body that is pushed against it and one that is pulled from it with the \
               force rho c v of an elastic bar, also under gravity, and a roller lets it slide",
    after: &["conversation", "rest", "translation", "fall", "force", "transfer", "stress"],
    examine,
};

/// Length of the bar, and distance that waves travel (cells).
const CELLS: f64 = 16.0;
const TRAVEL: f64 = 7.0;

/// Steps of a run: a quarter of a cell each.
const STEPS: u64 = 28;

/// Speed of the bar over that of waves.
const SPEED: f64 = 1e-3;

/// Gravity (m/s2): the speed that it gives in the run is of that order.
const GRAVITY: f64 = 1e-3;

/// Range of the force on a body that is thrown, over the expected one. It swings about its mean for a long
/// time: with FLIP and cubic functions, 0.70 is the mean of the run.
const THROWN: std::ops::RangeInclusive<f64> = 0.5..=1.5;

/// Force below which there is no wall.
const NONE: f64 = 0.2;

/// Relative error of the force under gravity, which begins smoothly.
const SMOOTH: f64 = 0.15;

/// One wall in one run.
#[derive(Debug, Clone)]
struct Wall {
    face: &'static str,
    condition: &'static str,
    /// Force over the expected one of a body that is pushed, that is pulled, and under gravity.
    pushed: f64,
    pulled: f64,
    /// Force along the wall over the expected one.
    along: f64,
    falling: Option<f64>,
    /// Displacement (m) of the body at the wall, over that of a free body in the time of one cell.
    through: f64,
    /// Displacement (m) along gravity at the wall, over g t times the time of one cell: with the steps of
    /// the run, and with half of them.
    sinking: [f64; 2],
}

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let (mut walls, mut lacks) = (Vec::new(), Vec::new());
    let mut sliding = Examined::default();
    for condition in ["fixed", "roller"] {
        let thrown = |kind| bar(kind, 0, condition);
        match patient.able(&[2, 1, 3], &ELASTIC, &thrown) {
            Ok(scene) => {
                let kind = (scene.dimension, scene.law);
                for axis in 0..kind.0 {
                    walls.extend(walls_across(patient, kind, axis, condition)?);
                    if condition == "roller" && kind.0 > 1 && sliding.findings.is_empty() {
                        sliding = slide(patient, kind, axis)?;
                    }
                }
            }
            Err(Hindrance::Lacks(what)) => lacks.push(what),
            Err(broke) => return Err(broke),
        }
    }
    if walls.is_empty() {
        lacks.dedup();
        return Err(Hindrance::Lacks(lacks.join("; ")));
    }
    let mut measured: Vec<String> = Vec::new();
    for wall in &walls {
        let falling =
            wall.falling.map_or(String::new(), |f| format!(", {} under gravity", shown(f)));
        measured.push(format!(
            "{} {}: {} of the force pushed, {} pulled{falling}, {} cells beyond",
            wall.condition,
            wall.face,
            shown(wall.pushed),
            shown(wall.pulled),
            shown(wall.through)
        ));
    }
    if !sliding.measured.is_empty() {
        measured.push(format!("sliding: {}", sliding.measured));
    }
    let mut findings = findings(&walls);
    // A wall that moves or is missing explains a body that does not slide evenly.
    if findings.is_empty() {
        findings.extend(sliding.findings);
    }
    Ok(Examined::new(measured.join("; "), findings))
}

/// The bar along `axis`, held at both ends.
fn bar(kind: Kind, axis: usize, condition: &'static str) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.25; 3], if kind.0 == 3 { 3.0 } else { 4.0 }, 3.0);
    scene.body.1[axis] = scene.body.0[axis] + CELLS * H;
    scene.grid.0[axis] = scene.body.0[axis];
    scene.grid.1[axis] = scene.body.1[axis];
    (scene.young, scene.poisson) = (3.1, 0.0);
    scene.faces = FACES[axis].map(|face| (face, condition)).to_vec();
    scene.with_waves(TRAVEL, STEPS)
}

/// Both walls across `axis`: the bar is thrown one way, the other way, along the wall, and falls.
fn walls_across(
    patient: &Patient<'_>,
    kind: Kind,
    axis: usize,
    condition: &'static str,
) -> Result<[Wall; 2], Hindrance> {
    let plain = bar(kind, axis, condition);
    let (c, d) = (plain.wave_speed(), kind.0);
    let thrown =
        |velocity: [f64; 3]| BoxScene { velocity: AffineField::uniform(velocity), ..plain.clone() };
    let normal = |way: f64| std::array::from_fn(|i| if i == axis { way * SPEED * c } else { 0.0 });
    let mut scenes = vec![thrown(normal(1.0)), thrown(normal(-1.0))];
    let holds_along = condition == "fixed" && d > 1;
    let other = (axis + 1) % d;
    if holds_along {
        scenes.push(broad(kind, axis, c));
    }
    let gravity = std::array::from_fn::<f64, 3, _>(|i| if i == axis { GRAVITY } else { 0.0 });
    let falling = BoxScene { gravity: Some(gravity[..d].to_vec()), ..plain.clone() };
    let (_, needs) = falling.problem().map_err(Hindrance::Lacks)?;
    let has_gravity = patient.solver.lacks(&needs).is_empty();
    if has_gravity {
        scenes.extend([falling.clone(), falling.with_half_the_step()]);
    }
    let courses = patient.run_all(&scenes)?;
    let falls = has_gravity.then(|| [&courses[courses.len() - 2], &courses[courses.len() - 1]]);
    Ok([false, true].map(|high| {
        let side = Side { axis, high };
        // Towards the high wall, the first run pushes and the second one pulls.
        let (push, pull) = if high { (0, 1) } else { (1, 0) };
        let force = |run: usize| side.force(&courses[run], &scenes[run], axis, c);
        let along = if holds_along {
            side.force(&courses[2], &scenes[2], other, c / libm::sqrt(2.0))
        } else {
            1.0
        };
        let cell_time = H / c;
        Wall {
            face: FACES[axis][usize::from(high)],
            condition,
            pushed: force(push),
            pulled: force(pull),
            along,
            falling: falls.map(|[course, _]| side.force_under_gravity(course, &plain, c)),
            through: side.sign() * side.at_wall(&courses[push], &plain) / (SPEED * c * cell_time),
            sinking: falls.map_or([0.0; 2], |falls| {
                falls.map(|course| {
                    let end = course.times[course.last()];
                    side.at_wall(course, &plain) / (GRAVITY * end * cell_time)
                })
            }),
        }
    }))
}

/// A broad body between two `fixed` walls across `axis`, which moves along them with a thousandth of `c`
/// (m/s). It ends before waves have crossed it.
fn broad(kind: Kind, axis: usize, c: f64) -> BoxScene {
    let mut scene = bar(kind, axis, "fixed");
    let other = (axis + 1) % kind.0;
    // As long along the walls, and half as long between them.
    scene.body.1[axis] = scene.body.0[axis] + 0.5 * CELLS * H;
    scene.grid.1[axis] = scene.body.1[axis];
    scene.body.1[other] = scene.body.0[other] + CELLS * H;
    scene.grid.1[other] = scene.body.1[other] + 4.0 * H;
    let mut velocity = [0.0; 3];
    velocity[other] = SPEED * c;
    scene.velocity = AffineField::uniform(velocity);
    scene.with_waves(0.5 * TRAVEL, STEPS / 2)
}

/// One end of the bar.
#[derive(Debug, Clone, Copy)]
struct Side {
    axis: usize,
    high: bool,
}

impl Side {
    /// Sign of the outward normal.
    fn sign(self) -> f64 {
        if self.high { 1.0 } else { -1.0 }
    }

    /// Distance (m) of a place from the wall.
    fn depth(self, scene: &BoxScene, label: [f64; 3]) -> f64 {
        let ends = (scene.body.0[self.axis], scene.body.1[self.axis]);
        if self.high { ends.1 - label[self.axis] } else { label[self.axis] - ends.0 }
    }

    /// Velocity component `along` gained by this half since the start, over the length of the bar: the
    /// impulse of the wall per mass of the half times its length (m2/s).
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

    /// Force of the wall on a body of uniform initial velocity, over `rho c v`, in the last three
    /// quarters of the run: averaging (PIC) adds to it at the start.
    fn force(self, course: &Course, scene: &BoxScene, along: usize, c: f64) -> f64 {
        let last = course.last();
        let late = last / 4..=last;
        let time: Vec<f64> = late.clone().map(|k| course.times[k]).collect();
        let gained: Vec<f64> = late.map(|k| self.gained(course, scene, along, k)).collect();
        let (_, slope, _) = line(&time, &gained);
        -slope / (c * scene.velocity.value[along])
    }

    /// Force of the wall over `rho c g t`, under gravity from rest.
    fn force_under_gravity(self, course: &Course, scene: &BoxScene, c: f64) -> f64 {
        let last = course.last();
        let half = 0.5 * (scene.body.1[self.axis] - scene.body.0[self.axis]);
        let squares: Vec<f64> =
            (last / 2..=last).map(|k| 0.5 * course.times[k] * course.times[k]).collect();
        let held: Vec<f64> = (last / 2..=last)
            .map(|k| half * GRAVITY * course.times[k] - self.gained(course, scene, self.axis, k))
            .collect();
        let (_, slope, _) = line(&squares, &held);
        slope / (c * GRAVITY)
    }

    /// Displacement (m) along the axis at the wall at the end: the line through the points within two cells.
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

/// The findings on all walls, one for each kind, with the faces that show it.
fn findings(walls: &[Wall]) -> Vec<SolverFinding> {
    let mut findings = Vec::<(SolverFinding, Vec<String>)>::new();
    for wall in walls {
        let Some(finding) = of_wall(wall) else { continue };
        let name = format!("{} {}", wall.condition, wall.face);
        match findings.iter_mut().find(|(known, _)| known.name == finding.name) {
            Some((_, faces)) => faces.push(name),
            None => findings.push((finding, vec![name])),
        }
    }
    let named = findings.into_iter().map(|(mut finding, faces)| {
        let all = faces.len() == walls.len();
        let faces = if all { "all walls".to_owned() } else { faces.join(", ") };
        finding.seen = format!("{faces}: {}", finding.seen);
        finding
    });
    named.collect()
}

fn of_wall(wall: &Wall) -> Option<SolverFinding> {
    let is_near = |force: f64| THROWN.contains(&force);
    let is_none = |force: f64| force.abs() <= NONE;
    let forces = format!(
        "{} of the force that stops a bar pushed against it, {} of that of one pulled from it",
        shown(wall.pushed),
        shown(wall.pulled)
    );
    if is_none(wall.pushed) && is_none(wall.pulled) {
        if let Some(falling) = wall.falling.filter(|falling| *falling > 0.5) {
            return Some(SolverFinding::defect(
                "wall-holds-acceleration-only",
                format!("{forces}, but {} of that under gravity from rest", shown(falling)),
                "the acceleration of the nodes at the wall is held and their velocity is not: they keep the \
                 velocity that is mapped to them",
                "velocities of held nodes: zero after the mapping from particles, before they move \
                 particles and strain them",
            ));
        }
        return Some(SolverFinding::defect(
            "wall-missing",
            forces,
            "no force acts at the wall",
            "`faces` of the problem: `axis` and `high` give the side (every axis, low and high ends), `at` \
             the place; nodes beyond the wall, if the solver has some there",
        ));
    }
    if is_near(wall.pushed) && is_none(wall.pulled) {
        return Some(SolverFinding::defect(
            "wall-lets-go",
            forces,
            "the wall holds a body that is pushed against it, and not one that is pulled from it",
            "walls act in both directions here: a solver whose walls separate does not claim `fixed` or \
             `roller`",
        ));
    }
    if !(is_near(wall.pushed) && is_near(wall.pulled)) {
        return Some(SolverFinding::defect(
            "wall-force",
            forces,
            "the wall acts with another strength, or at another place",
            "nodes on the face of the body: their normal velocity is zero, also in the velocities that move \
             particles and strain them; functions at the wall",
        ));
    }
    if !is_near(wall.along) {
        return Some(SolverFinding::defect(
            "fixed-lets-slide",
            format!("{} of the force that stops a body that moves along it", shown(wall.along)),
            "a fixed wall holds the normal component of the velocity only",
            "at `fixed`, every component of the velocity of a node is zero; `roller` holds the one along \
             `axis` of the face only",
        ));
    }
    if !(wall.through.abs() <= 0.5) {
        return Some(SolverFinding::defect(
            "particles-cross-wall",
            format!(
                "the force is right, but at the end the body is {} cells of free motion beyond the wall",
                shown(wall.through)
            ),
            "particles do not move with the velocity of the grid at their place, which is zero at a wall",
            "the velocity that moves particles: the sum of the weights times the new velocities of nodes, \
             not the particle's own velocity or a mean with it",
        ));
    }
    let falling = wall.falling?;
    let [sinking, halved] = wall.sinking;
    // Averaging (PIC) softens the wall too, but more with smaller steps.
    let sinks_by_steps = sinking.abs() > 0.1 && halved.abs() <= 0.75 * sinking.abs();
    if sinks_by_steps || !((falling - 1.0).abs() <= SMOOTH) {
        return Some(SolverFinding::defect(
            "wall-moves-under-gravity",
            format!(
                "{} of the force under gravity, and at the wall the body falls by {} of g t times the time \
                 of a wave through a cell, {} with half the step",
                shown(falling),
                shown(sinking),
                shown(halved)
            ),
            "gravity or another load is added to nodes after those at the wall were set to zero",
            "the order of a step on the grid: forces, all loads, new velocities, and walls last",
        ));
    }
    None
}

/// A body next to two rollers across `axis` moves along them as if there were none.
fn slide(patient: &Patient<'_>, kind: Kind, axis: usize) -> Result<Examined, Hindrance> {
    let other = (axis + 1) % kind.0;
    // Particles pass cell faces at a distance.
    let mut from = [0.25; 3];
    from[other] += 0.1125 * H;
    let mut scene = BoxScene::of_cells(kind, from, 4.0, 4.0);
    scene.grid.0[axis] = scene.body.0[axis];
    scene.grid.1[axis] = scene.body.1[axis];
    scene.faces = FACES[axis].map(|face| (face, "roller")).to_vec();
    let mut velocity = [0.0; 3];
    velocity[other] = VELOCITY[0];
    scene.velocity = AffineField::uniform(velocity);
    let scene = BoxScene { steps: 40, dt: 0.025, ..scene };
    let examined = uniform(patient, &scene)?;
    let findings = examined.findings.into_iter().map(|finding| {
        SolverFinding::defect(
            "roller-holds-tangent",
            format!("between {} and {}: {}", FACES[axis][0], FACES[axis][1], finding.seen),
            "a roller slows a body that moves along it",
            "at a roller only the velocity along `axis` of the face is zero",
        )
    });
    Ok(Examined { findings: findings.collect(), ..examined })
}
