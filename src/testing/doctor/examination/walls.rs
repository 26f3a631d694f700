//! Walls on every face: a body that is thrown against them, pulled from them, moves along them,
//! and falls.
//!
//! A bar of modulus E without Poisson's effect that is held at one end and thrown with v stops
//! there with the force `rho c v A`, c^2 = E/rho, until the wave has crossed it. Under the
//! acceleration g from rest the force is `rho c g t A`. Both ends are held at once: one is pushed,
//! the other one pulled. The momentum of one half shows the force of its wall as long as no wave
//! arrives from the other.

use super::stress::constant_and_rate;
use super::translation::VELOCITY;
use crate::testing::doctor::course::{Course, displacement, line, shown, velocity};
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::motion::uniform;
use crate::testing::doctor::patient::{Examined, Hindrance, Patient};
use crate::testing::doctor::question::Examination;
use crate::testing::doctor::scene::{BoxScene, ELASTIC, FACES, H, Kind};
use crate::testing::doctor::vectors::AffineField;

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

/// Range of the force on a body that is thrown, over the expected one. It swings about its mean
/// for a long time: with FLIP and cubic functions, 0.70 is the mean of the run.
const THROWN: std::ops::RangeInclusive<f64> = 0.5..=1.5;

/// Force below which there is no wall.
const NONE: f64 = 0.2;

/// Displacement of a pushed body through the wall, over that of a free body in the time of one
/// cell.
const THROUGH: f64 = 0.8;

/// Relative error of the force under gravity, which begins smoothly.
const SMOOTH: f64 = 0.15;

/// Displacement into a wall, over g t times the time of one cell, that is examined with half the
/// step.
const SUNK: f64 = 0.1;

/// Part of the weight of a cell that may be missing in the force of a wall under gravity.
const WEIGHT: f64 = 0.3;

/// Part of the weight of a cell that may be too much in that force: averaging (PIC) makes it 0.14.
const CARRIED: f64 = 0.4;

/// One wall, as the runs show it: `None` where no run does.
#[derive(Debug, Clone)]
struct Wall {
    face: &'static str,
    condition: &'static str,
    /// Force over the expected one of a body that is pushed against the wall.
    pushed: Option<f64>,
    /// Force over the expected one of a body that is pulled from it.
    pulled: Option<f64>,
    /// Force over the expected one of a body that moves along it.
    along: Option<f64>,
    /// Force over the expected one under gravity.
    falling: Option<f64>,
    /// Force at once under gravity, over that on the mass of one cell: what is missing at all
    /// times.
    offset: Option<f64>,
    /// Displacement of a pushed body through the wall, over that of a free body in the time of one
    /// cell.
    through: Option<f64>,
    /// Largest displacement in the first step, over that of the velocity.
    jump: Option<f64>,
    /// Displacement along gravity at the wall, over g t times the time of one cell: with the steps
    /// of the run, and with half of them.
    sinking: Option<[f64; 2]>,
}

impl Wall {
    /// The forces, for reports.
    fn describe(&self) -> String {
        let forces = [
            ("pushed", self.pushed),
            ("pulled", self.pulled),
            ("along it", self.along),
            ("under gravity", self.falling),
            ("under gravity at once", self.offset),
        ];
        let texts = forces
            .into_iter()
            .filter_map(|(name, force)| force.map(|force| format!("{name} {}", shown(force))));
        texts.collect::<Vec<_>>().join(", ")
    }
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
    let name = |wall: &Wall| format!("{} {}: {}", wall.condition, wall.face, wall.describe());
    let forces = walls.iter().map(name).collect::<Vec<_>>().join("; ");
    let mut measured = vec![format!("forces over the expected ones: {forces}")];
    if !sliding.measured.is_empty() {
        measured.push(format!("sliding: {}", sliding.measured));
    }
    let mut findings: Vec<SolverFinding> = finding(&walls).into_iter().collect();
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

/// Both walls across `axis`: the bar is thrown, moves along the wall, and falls. On the first axis
/// it is thrown both ways.
fn walls_across(
    patient: &Patient<'_>,
    kind: Kind,
    axis: usize,
    condition: &'static str,
) -> Result<[Wall; 2], Hindrance> {
    let plain = bar(kind, axis, condition);
    let (c, d) = (plain.wave_speed(), kind.0);
    let thrown = |way: f64| {
        let velocity = std::array::from_fn(|i| if i == axis { way * SPEED * c } else { 0.0 });
        BoxScene { velocity: AffineField::uniform(velocity), ..plain.clone() }
    };
    let mut scenes = vec![thrown(1.0)];
    if axis == 0 {
        scenes.push(thrown(-1.0));
    }
    let moves_along = condition == "fixed" && d > 1;
    if moves_along {
        scenes.push(broad(kind, axis, c));
    }
    let gravity = std::array::from_fn::<f64, 3, _>(|i| if i == axis { GRAVITY } else { 0.0 });
    let falling = BoxScene { gravity: Some(gravity[..d].to_vec()), ..plain.clone() };
    let (_, needs) = falling.problem().map_err(Hindrance::Lacks)?;
    let falls = patient.solver.lacks(&needs).is_empty();
    if falls {
        scenes.push(falling.clone());
    }
    let courses = patient.run_all(&scenes)?;
    let cell_time = H / c;
    let sinking = |side: BarEnd, course: &Course| {
        side.at_wall(course, &plain) / (GRAVITY * course.times[course.last()] * cell_time)
    };
    let sides = [false, true].map(|high| BarEnd { axis, high });
    let fall = falls.then(|| &courses[courses.len() - 1]);
    let sunk = fall.map(|course| sides.map(|side| sinking(side, course)));
    // Only a body that sinks into the wall is examined again.
    let halved = match sunk {
        Some(sunk) if sunk.iter().any(|sunk| !(sunk.abs() <= SUNK)) => {
            Some(patient.run_all(&[falling.with_half_the_step()])?)
        }
        _ => None,
    };
    Ok(sides.map(|side| {
        let force = |run: usize| side.force(&courses[run], &scenes[run], axis, c);
        // The first run pushes the high wall and pulls the low one, the second one the reverse.
        let (push, pull) = if side.high { (0, 1) } else { (1, 0) };
        let of_run = |run: usize| (run == 0 || axis == 0).then(|| force(run));
        let run_along = if axis == 0 { 2 } else { 1 };
        let other = (axis + 1) % d;
        let through =
            |course: &Course| side.sign() * side.at_wall(course, &plain) / (SPEED * c * cell_time);
        let place = usize::from(side.high);
        Wall {
            face: FACES[axis][place],
            condition,
            pushed: of_run(push),
            pulled: of_run(pull),
            along: moves_along.then(|| {
                let scene = &scenes[run_along];
                side.force(&courses[run_along], scene, other, c / libm::sqrt(2.0))
            }),
            falling: fall.map(|course| side.force_under_gravity(course, &plain, c).1),
            offset: fall.map(|course| side.force_under_gravity(course, &plain, c).0),
            through: courses.get(push).filter(|_| push == 0 || axis == 0).map(through),
            jump: Some(courses[0].farthest(displacement, 1, [0.0; 3]) / (SPEED * c * plain.dt)),
            sinking: sunk.map(|sunk| {
                let halved = halved.as_ref().and_then(|halved| halved.first());
                [sunk[place], halved.map_or(sunk[place], |halved| sinking(side, halved))]
            }),
        }
    }))
}

/// A broad body between two `fixed` walls across `axis`, which moves along them with a thousandth
/// of `c` (m/s). It ends before waves have crossed it.
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
struct BarEnd {
    axis: usize,
    high: bool,
}

impl BarEnd {
    /// Sign of the outward normal.
    fn sign(self) -> f64 {
        if self.high { 1.0 } else { -1.0 }
    }

    /// Distance (m) of a place from the wall.
    fn depth(self, scene: &BoxScene, label: [f64; 3]) -> f64 {
        let ends = (scene.body.0[self.axis], scene.body.1[self.axis]);
        if self.high { ends.1 - label[self.axis] } else { label[self.axis] - ends.0 }
    }

    /// Velocity component `along` gained by this half since the start, over the length of the bar:
    /// the impulse of the wall per mass of the half times its length (m2/s).
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

    /// Force of the wall under gravity from rest: the part that acts at once, over `rho h g`, and
    /// the part that grows, over `rho c g t`.
    fn force_under_gravity(self, course: &Course, scene: &BoxScene, c: f64) -> (f64, f64) {
        let half = 0.5 * (scene.body.1[self.axis] - scene.body.0[self.axis]);
        let held: Vec<f64> = (0..=course.last())
            .map(|k| half * GRAVITY * course.times[k] - self.gained(course, scene, self.axis, k))
            .collect();
        let [constant, rate] = constant_and_rate(&course.times, &held);
        (constant / (scene.h * GRAVITY), rate / (c * GRAVITY))
    }

    /// Displacement (m) along the axis at the wall at the end: the line through the points within
    /// two cells.
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

/// Kinds of findings, those that explain others first.
const KINDS: [&str; 9] = [
    "position-limited",
    "wall-holds-acceleration-only",
    "wall-holds-velocity-only",
    "wall-lets-go",
    "wall-missing",
    "wall-force",
    "fixed-lets-slide",
    "particles-cross-wall",
    "wall-moves-under-gravity",
];

/// The finding that explains the others, with the faces that show it.
fn finding(walls: &[Wall]) -> Option<SolverFinding> {
    let of_walls: Vec<(&Wall, SolverFinding)> =
        walls.iter().filter_map(|wall| Some((wall, of_wall(wall)?))).collect();
    let first = KINDS.iter().find(|kind| of_walls.iter().any(|(_, found)| found.name == **kind))?;
    let faces: Vec<String> = of_walls
        .iter()
        .filter(|(_, found)| found.name == *first)
        .map(|(wall, _)| format!("{} {}", wall.condition, wall.face))
        .collect();
    let faces = if faces.len() == walls.len() { "all walls".to_owned() } else { faces.join(", ") };
    let (_, mut finding) = of_walls.into_iter().find(|(_, found)| found.name == *first)?;
    finding.seen = format!("{faces}: {}", finding.seen);
    Some(finding)
}

/// The finding on a wall that moves particles, or that no force acts at.
fn of_absent_wall(wall: &Wall) -> Option<SolverFinding> {
    let seen = format!("forces over the expected ones are {}", wall.describe());
    if let Some(jump) = wall.jump.filter(|jump| !(jump.abs() <= 3.0)) {
        return Some(SolverFinding::defect(
            "position-limited",
            format!("in the first step particles move by up to {} of v dt", shown(jump)),
            "particles next to a wall are moved away from it, to a limit of the solver's own",
            "clamps on positions, margins at the ends of the grid: a wall is where the grid ends",
        ));
    }
    if [wall.pushed, wall.pulled].into_iter().flatten().all(|force| force.abs() <= NONE) {
        if wall.through.is_some_and(|through| through.abs() <= 0.5 * TRAVEL) {
            return Some(SolverFinding::defect(
                "wall-holds-velocity-only",
                seen,
                "the velocity of the nodes at the wall is held and their acceleration is not: particles \
                 get no force from the wall",
                "accelerations of held nodes, or changes of their velocity, from which particles are \
                 updated (FLIP): zero at the wall, or the change from the mapped velocity to zero",
            ));
        }
        if wall.falling.is_some_and(|falling| falling > 0.5) {
            return Some(SolverFinding::defect(
                "wall-holds-acceleration-only",
                seen,
                "the acceleration of the nodes at the wall is held and their velocity is not: they keep the \
                 velocity that is mapped to them",
                "velocities of held nodes: zero after the mapping from particles, before they move \
                 particles and strain them",
            ));
        }
        return Some(SolverFinding::defect(
            "wall-missing",
            seen,
            "no force acts at the wall",
            "`faces` of the problem: `axis` and `high` give the side (every axis, low and high ends), `at` \
             the place; nodes beyond the wall, if the solver has some there",
        ));
    }
    None
}

fn of_wall(wall: &Wall) -> Option<SolverFinding> {
    if let Some(finding) = of_absent_wall(wall) {
        return Some(finding);
    }
    let is_near = |force: f64| THROWN.contains(&force);
    let is_none = |force: f64| force.abs() <= NONE;
    let (pushed, pulled) = (wall.pushed, wall.pulled);
    let seen = format!("forces over the expected ones are {}", wall.describe());
    let thrown = || [pushed, pulled].into_iter().flatten();
    if pushed.is_some_and(is_near) && pulled.is_some_and(is_none) {
        return Some(SolverFinding::defect(
            "wall-lets-go",
            seen,
            "the wall holds a body that is pushed against it, and not one that is pulled from it",
            "walls act in both directions here: a solver whose walls separate does not claim `fixed` or \
             `roller`",
        ));
    }
    let is_smooth = |falling: f64| (falling - 1.0).abs() <= SMOOTH;
    // A wall that carries more than the weight of its own nodes stands inside the body.
    let is_inside = wall.offset.is_some_and(|offset| !(offset <= CARRIED));
    let is_even = wall.along.is_none_or(|along| is_near(along) || along.abs() <= NONE);
    if !(thrown().all(is_near) && is_even && !is_inside && wall.falling.is_none_or(is_smooth)) {
        return Some(SolverFinding::defect(
            "wall-force",
            seen,
            "the wall acts with another strength, or at another place",
            "nodes on the face of the body: their normal velocity is zero, also in the velocities that move \
             particles and strain them; functions at the wall",
        ));
    }
    if wall.along.is_some_and(|along| along.abs() <= NONE) {
        return Some(SolverFinding::defect(
            "fixed-lets-slide",
            seen,
            "a fixed wall holds the normal component of the velocity only",
            "at `fixed`, every component of the velocity of a node is zero; `roller` holds the one along \
             `axis` of the face only",
        ));
    }
    if let Some(through) = wall.through.filter(|through| !(through.abs() <= THROUGH)) {
        return Some(SolverFinding::defect(
            "particles-cross-wall",
            format!(
                "the force is right, but at the end the body is beyond the wall by {} times the free motion \
                 in the time of a wave through a cell",
                shown(through)
            ),
            "particles do not move with the velocity of the grid at their place, which is zero at a wall",
            "the velocity that moves particles: the sum of the weights times the new velocities of nodes, \
             not the particle's own velocity or a mean with it",
        ));
    }
    let [sinking, halved] = wall.sinking?;
    // Averaging (PIC) softens the wall too, but more with smaller steps.
    let sinks_by_steps = sinking.abs() > SUNK && halved.abs() <= 0.75 * sinking.abs();
    // The wall does not carry the weight of its own nodes: half a cell.
    let is_missing = wall.offset.is_some_and(|offset| !(offset >= -WEIGHT));
    if sinks_by_steps || is_missing {
        return Some(SolverFinding::defect(
            "wall-moves-under-gravity",
            format!(
                "{seen}; under gravity the body sinks at the wall by {} of g t times the time of a wave \
                 through a cell, and by {} with half the step",
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
