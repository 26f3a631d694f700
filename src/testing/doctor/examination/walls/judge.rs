//! Determines the defect of walls from measured forces and motions.

use super::measure::{SUNK, TRAVEL, Wall};
use crate::testing::doctor::course::shown;
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::scene::FACES;

/// Accepted range of the force on a body thrown against the wall, relative to the expected force.
/// The force oscillates about its mean for a long time. With FLIP and cubic functions, the mean
/// over the run is 0.70.
const THROWN: std::ops::RangeInclusive<f64> = 0.5..=1.5;

/// Maximum wall force, relative to the expected force, of a body that separates from the wall or
/// slides along it.
const NONE: f64 = 0.2;

/// Maximum force, relative to the expected force, of a wall that counts as missing.
const ABSENT: f64 = 0.1;

/// Maximum relative difference between forces of walls that are mirror images, or that differ only
/// in their tangential condition.
const UNEVEN: f64 = 0.05;

/// Maximum displacement through a wall with a correct force, relative to the displacement of a free
/// body in the time in which a wave crosses one cell.
const THROUGH: f64 = 0.8;

/// Maximum relative error of the force under gravity.
const SMOOTH: f64 = 0.2;

/// The wall force under gravity may be too small by this share of the weight of a cell.
const WEIGHT: f64 = 0.3;

/// The wall force under gravity may be too large by this share of the weight of a cell, because
/// averaging (PIC) increases the force.
const CARRIED: f64 = 0.4;

/// Maximum error of displacements in a uniform stretch. Quadratic functions that are modified at
/// the wall have an error of up to 0.04, and functions that are truncated at the wall of 0.07 or
/// more.
const STRETCH: f64 = 0.05;

/// Names of findings in order of priority: a finding may be the cause of those after it.
const KINDS: [&str; 11] = [
    "position-limited",
    "wall-holds-acceleration-only",
    "wall-holds-velocity-only",
    "wall-lets-go",
    "wall-missing",
    "wall-force",
    "fixed-lets-slide",
    "particles-cross-wall",
    "wall-moves-under-gravity",
    "stress-column",
    "wall-breaks-linear-fields",
];

/// Returns the defect with the highest priority, with all faces that have this defect. Without a
/// defect, returns a remark, if any.
pub(super) fn finding(walls: &[Wall]) -> Option<SolverFinding> {
    first_kind(walls, of_wall).or_else(|| uneven(walls)).or_else(|| first_kind(walls, of_stretch))
}

/// Returns the first finding in the order of [`KINDS`], with all faces that have this finding.
fn first_kind(
    walls: &[Wall],
    judge: impl Fn(&Wall) -> Option<SolverFinding>,
) -> Option<SolverFinding> {
    let of_walls: Vec<(&Wall, SolverFinding)> =
        walls.iter().filter_map(|wall| Some((wall, judge(wall)?))).collect();
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

/// Returns a finding if two walls that should exert equal forces do not. These are walls on
/// opposite faces with equal conditions, and the same wall in two runs with different tangential
/// conditions.
fn uneven(walls: &[Wall]) -> Option<SolverFinding> {
    let axis = |wall: &Wall| FACES.iter().position(|pair| pair.contains(&wall.face));
    let differ =
        |a: Option<f64>, b: Option<f64>| a.zip(b).is_some_and(|(a, b)| !((a - b).abs() <= UNEVEN));
    let pairs = walls.iter().enumerate().flat_map(|(k, a)| walls[..k].iter().map(move |b| (a, b)));
    let is_uneven = |(a, b): &(&Wall, &Wall)| {
        let are_alike =
            if a.condition == b.condition { axis(a) == axis(b) } else { a.face == b.face };
        are_alike
            && (differ(a.pushed, b.pushed)
                || differ(a.pulled, b.pulled)
                || differ(a.falling, b.falling)
                || differ(a.offset, b.offset))
    };
    let (a, b) = pairs.into_iter().find(is_uneven)?;
    let of = |wall: &Wall| format!("{} {}: {}", wall.condition, wall.face, wall.describe());
    Some(SolverFinding::defect(
        "wall-force",
        format!("forces divided by the expected forces: {}; {}", of(b), of(a)),
        "two equivalent walls exert different forces on the same motion",
        "the nodes on the face of the body at low and high ends; conditions that are applied to \
         particles instead of nodes",
    ))
}

/// Returns a finding if the wall moves particles or exerts no force.
fn of_absent_wall(wall: &Wall) -> Option<SolverFinding> {
    let seen = format!("forces divided by the expected forces: {}", wall.describe());
    if let Some(jump) = wall.jump.filter(|jump| !(jump.abs() <= 3.0)) {
        return Some(SolverFinding::defect(
            "position-limited",
            format!("in the first step, particles move by up to {} of v dt", shown(jump)),
            "the solver keeps particles away from walls: particles next to a wall are moved to a \
             limit that is not in the problem",
            "clamps on positions; margins at the ends of the grid: a wall is at the end of the \
             grid",
        ));
    }
    if [wall.pushed, wall.pulled].into_iter().flatten().all(|force| force.abs() <= ABSENT) {
        if wall.through.is_some_and(|through| through.abs() <= 0.8 * TRAVEL) {
            return Some(SolverFinding::defect(
                "wall-holds-velocity-only",
                seen,
                "at nodes on the wall the velocity is set to zero, but the acceleration is not: \
                 particles get no force from the wall",
                "the accelerations of nodes on the wall, or their velocity changes, from which \
                 FLIP updates particles: set them to zero, or to the change from the mapped \
                 velocity to zero",
            ));
        }
        if wall.falling.is_some_and(|falling| falling > 0.5) {
            return Some(SolverFinding::defect(
                "wall-holds-acceleration-only",
                seen,
                "at nodes on the wall the acceleration is set to zero, but the velocity is not: \
                 these nodes keep the velocity that is mapped from particles",
                "the velocities of nodes on the wall: set them to zero after the mapping from \
                 particles, before they move and strain particles",
            ));
        }
        return Some(SolverFinding::defect(
            "wall-missing",
            seen,
            "the wall exerts no force on the body",
            "`faces` of the problem: `axis` and `high` give the side (every axis, low and high \
             ends), and `at` gives the coordinate; nodes beyond the wall, if the solver has such \
             nodes",
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
    let seen = format!("forces divided by the expected forces: {}", wall.describe());
    let thrown = || [pushed, pulled].into_iter().flatten();
    if pushed.is_some_and(is_near) && pulled.is_some_and(is_none) {
        return Some(SolverFinding::defect(
            "wall-lets-go",
            seen,
            "the wall stops a body that is pushed against the wall, but not a body that is pulled \
             away",
            "the condition on the normal velocity: `fixed` and `roller` act in both directions. A \
             solver whose walls allow separation must not list `fixed` or `roller`",
        ));
    }
    let is_smooth = |falling: f64| (falling - 1.0).abs() <= SMOOTH;
    // A force above the expected force plus [`CARRIED`] indicates a wall inside the body.
    let is_inside = wall.offset.is_some_and(|offset| !(offset <= CARRIED));
    let is_even = wall.along.is_none_or(|along| is_near(along) || along.abs() <= NONE);
    if !(thrown().all(is_near) && is_even && !is_inside && wall.falling.is_none_or(is_smooth)) {
        return Some(SolverFinding::defect(
            "wall-force",
            seen,
            "the wall exerts a wrong force, or acts at a wrong position",
            "the nodes on the face of the body, whose normal velocity must be zero, also in the \
             velocities that move and strain particles; the basis functions at the wall",
        ));
    }
    if wall.along.is_some_and(|along| along.abs() <= NONE) {
        return Some(SolverFinding::defect(
            "fixed-lets-slide",
            seen,
            "a fixed wall sets only the normal component of the velocity to zero",
            "the condition at nodes: `fixed` sets every component of the velocity to zero, and \
             `roller` only the component along `axis` of the face",
        ));
    }
    if let Some(through) = wall.through.filter(|through| !(through.abs() <= THROUGH)) {
        return Some(SolverFinding::defect(
            "particles-cross-wall",
            format!(
                "the force is correct, but at the end the body has passed the wall by {} times the \
                 distance that a free body moves while a wave crosses one cell",
                shown(through)
            ),
            "particles do not move with the grid velocity at their positions, which is zero at a \
             wall",
            "the velocity that moves particles: the sum of the weights times the new velocities of \
             nodes, not the velocity of the particle or a mean with this velocity",
        ));
    }
    of_sinking(wall, &seen).or_else(|| of_column(wall))
}

/// Returns a finding if a body sinks into the wall under gravity.
fn of_sinking(wall: &Wall, seen: &str) -> Option<SolverFinding> {
    let [sinking, halved] = wall.sinking?;
    // Averaging (PIC) also makes the body sink, but the body then sinks further with smaller steps.
    let sinks_by_steps = sinking.abs() > SUNK && halved.abs() <= 0.75 * sinking.abs();
    // The wall fixes its nodes correctly, but its force lacks the weight of these nodes (half a
    // cell).
    let is_missing =
        wall.stretch.abs() <= STRETCH && wall.offset.is_some_and(|offset| !(offset >= -WEIGHT));
    if sinks_by_steps || is_missing {
        return Some(SolverFinding::defect(
            "wall-moves-under-gravity",
            format!(
                "{seen}; under gravity, the body sinks at the wall by {} (with half the time step \
                 by {}), in units of g t tau, where tau is the time in which a wave crosses one \
                 cell",
                shown(sinking),
                shown(halved)
            ),
            "gravity or another load is added to nodes after the velocities at the wall were set \
             to zero",
            "the order of operations on the grid: forces, all loads, new velocities, and walls \
             last",
        ));
    }
    None
}

/// Returns a finding if the column `stress` disagrees with the correct wall force. Stress at the
/// wall differs from stress elsewhere, so this also detects a wrong order of points.
fn of_column(wall: &Wall) -> Option<SolverFinding> {
    let column = wall.column.filter(|column| !THROWN.contains(column))?;
    Some(SolverFinding::defect(
        "stress-column",
        format!(
            "the force of the wall is correct, but the column `stress` next to the wall is {} of \
             the stress that this force causes",
            shown(column)
        ),
        "the column `stress` is in a different order than the particles or `points`",
        "particles that the solver sorts by cell: columns must keep the order of the problem, or \
         of `points`",
    ))
}

/// Returns a remark if linear fields are not reproduced near the wall.
fn of_stretch(wall: &Wall) -> Option<SolverFinding> {
    let error = Some(wall.stretch).filter(|error| !(error.abs() <= STRETCH))?;
    Some(SolverFinding::remark(
        "wall-breaks-linear-fields",
        format!(
            "in a bar that is stretched uniformly from the wall, displacements next to the wall \
             differ from the exact ones by up to {} of the displacement at a distance of one cell",
            shown(error)
        ),
        "a linear velocity that is zero at the wall is not reproduced next to the wall. Errors \
         there are of first order in the cell size",
        "the nodes beyond the wall: add their mass, and their normal momentum with the opposite \
         sign, to their mirror images, and give them the negative normal velocity of the mirror \
         images. Alternatively, modify the basis functions at the wall. Averaging of velocities \
         (PIC) causes errors of the same kind",
    ))
}
