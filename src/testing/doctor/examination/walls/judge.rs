//! Determines the defect of walls from measured forces and motions.

use super::measure::{SUNK, TRAVEL, Wall};
use crate::testing::doctor::prelude::*;

/// Accepted range of the force on a body thrown against the wall, relative to the expected force.
/// The force oscillates; with FLIP and cubic functions, its mean over the run is 0.70.
const THROWN: std::ops::RangeInclusive<f64> = 0.5..=1.5;

/// Maximum relative wall force on a body that separates from the wall or slides along it.
const NONE: f64 = 0.2;

/// Maximum force, relative to the expected force, of a wall that counts as missing.
const ABSENT: f64 = 0.1;

/// Maximum relative difference between forces of walls that are mirror images, or that differ only
/// in their tangential condition.
const UNEVEN: f64 = 0.05;

/// Maximum [`Wall::through`] of a wall with a correct force.
const THROUGH: f64 = 0.8;

/// Maximum relative error of the force under gravity.
const SMOOTH: f64 = 0.2;

/// The wall force under gravity may be too small by this share of the weight of a cell.
const WEIGHT: f64 = 0.3;

/// Averaging (PIC) may increase the wall force under gravity by this share of the weight of a cell.
const CARRIED: f64 = 0.4;

/// Maximum error of displacements in a uniform stretch. Quadratic functions have up to 0.04 if they
/// are modified at the wall, and 0.07 or more if they are truncated there.
const STRETCH: f64 = 0.05;

/// Condition on a wall, observed values, name of the finding, likely cause, and the code to check.
type WallRule = (fn(&Wall) -> bool, fn(&Wall) -> String, &'static str, &'static str, &'static str);

/// Rules for single walls, in order of priority: a finding may be the cause of those after it.
const RULES: [WallRule; 10] = [
    (
        |wall| !(wall.jump.abs() <= 3.0),
        |wall| format!("in the first step, particles move by up to {} of v dt", shown(wall.jump)),
        "position-limited",
        "the solver keeps particles away from walls: particles next to a wall are moved to a limit \
         that is not in the problem",
        "clamps on positions; margins at the ends of the grid: a wall is at the end of the grid",
    ),
    (
        |wall| is_absent(wall) && !stops_particles(wall) && wall.falling.is_some_and(|f| f > 0.5),
        forces,
        "wall-holds-acceleration-only",
        "at nodes on the wall the acceleration is set to zero, but the velocity is not: these \
         nodes keep the velocity that is mapped from particles",
        "the velocities of nodes on the wall: set them to zero after the mapping from particles, \
         before they move and strain particles",
    ),
    (
        |wall| is_absent(wall) && stops_particles(wall),
        forces,
        "wall-holds-velocity-only",
        "at nodes on the wall the velocity is set to zero, but the acceleration is not: particles \
         get no force from the wall",
        "the accelerations of nodes on the wall, or their velocity changes, from which FLIP \
         updates particles: set them to zero, or to the change from the mapped velocity to zero",
    ),
    (
        |wall| {
            let is_near = |force| THROWN.contains(&force);
            wall.pushed.is_some_and(is_near) && wall.pulled.is_some_and(is_none)
        },
        forces,
        "wall-lets-go",
        "the wall stops a body that is pushed against the wall, but not a body that is pulled away",
        "the condition on the normal velocity: `fixed` and `roller` act in both directions. A \
         solver whose walls allow separation must not list `fixed` or `roller`",
    ),
    (
        is_absent,
        forces,
        "wall-missing",
        "the wall exerts no force on the body",
        "`faces` of the problem: `axis` and `high` give the side (every axis, low and high ends), \
         and `at` gives the coordinate; nodes beyond the wall, if the solver has such nodes",
    ),
    (
        has_wrong_force,
        forces,
        "wall-force",
        "the wall exerts a wrong force, or acts at a wrong position",
        "the nodes on the face of the body, whose normal velocity must be zero, also in the \
         velocities that move and strain particles; the basis functions at the wall",
    ),
    (
        |wall| wall.along.is_some_and(is_none),
        forces,
        "fixed-lets-slide",
        "a fixed wall sets only the normal component of the velocity to zero",
        "the condition at nodes: `fixed` sets every component of the velocity to zero, and \
         `roller` only the component along `axis` of the face",
    ),
    (
        |wall| wall.through.is_some_and(|through| !(through.abs() <= THROUGH)),
        |wall| {
            format!(
                "the force is correct, but at the end the body has passed the wall by {} times the \
                 distance that a free body moves while a wave crosses one cell",
                wall.through.map_or(String::new(), shown)
            )
        },
        "particles-cross-wall",
        "particles do not move with the grid velocity at their positions, which is zero at a wall",
        "the velocity that moves particles: the sum of the weights times the new velocities of \
         nodes, not the velocity of the particle or a mean with this velocity",
    ),
    (
        sinks,
        |wall| {
            let [sinking, halved] = wall.sinking.unwrap_or_default().map(shown);
            format!(
                "{}; under gravity, the body sinks at the wall by {sinking} (with half the time \
                 step by {halved}), in units of g t tau, where tau is the time in which a wave \
                 crosses one cell",
                forces(wall)
            )
        },
        "wall-moves-under-gravity",
        "gravity or another load is added to nodes after the velocities at the wall were set to \
         zero",
        "the order of operations on the grid: forces, all loads, new velocities, and walls last",
    ),
    // Stress at the wall differs from stress elsewhere, so wrongly ordered points are detected.
    (
        |wall| wall.column.is_some_and(|column| !THROWN.contains(&column)),
        |wall| {
            format!(
                "the force of the wall is correct, but the column `stress` next to the wall is {} \
                 of the stress that this force causes",
                wall.column.map_or(String::new(), shown)
            )
        },
        "stress-column",
        "the column `stress` is in a different order than the particles or `points`",
        "particles that the solver sorts by cell: columns must keep the order of the problem, or \
         of `points`",
    ),
];

const NOT_LINEAR: WallRule = (
    |wall| !(wall.stretch.abs() <= STRETCH),
    |wall| {
        format!(
            "in a bar that is stretched uniformly from the wall, displacements next to the wall \
             differ from the exact ones by up to {} of the displacement at a distance of one cell",
            shown(wall.stretch)
        )
    },
    "wall-breaks-linear-fields",
    "a linear velocity that is zero at the wall is not reproduced next to the wall. Errors there \
     are of first order in the cell size",
    "the nodes beyond the wall: add their mass, and their normal momentum with the opposite sign, \
     to their mirror images, and give them the negative normal velocity of the mirror images. \
     Alternatively, modify the basis functions at the wall. Averaging of velocities (PIC) causes \
     errors of the same kind",
);

/// Returns the defect with the highest priority, with all its faces, or else a remark, if any.
pub(super) fn finding(walls: &[Wall]) -> Option<SolverFinding> {
    first_finding(walls, &RULES).or_else(|| uneven(walls)).or_else(|| {
        let finding = first_finding(walls, &[NOT_LINEAR])?;
        Some(SolverFinding { weight: FindingWeight::Remark, ..finding })
    })
}

/// Returns the finding of the first broken rule, with all faces whose first broken rule it is.
fn first_finding(walls: &[Wall], rules: &[WallRule]) -> Option<SolverFinding> {
    let rule_of = |wall: &Wall| rules.iter().position(|(holds, ..)| holds(wall));
    let first = walls.iter().filter_map(rule_of).min()?;
    let alike: Vec<&Wall> = walls.iter().filter(|wall| rule_of(wall) == Some(first)).collect();
    let faces: Vec<String> =
        alike.iter().map(|wall| format!("{} {}", wall.condition, wall.face)).collect();
    let faces = if faces.len() == walls.len() { "all walls".to_owned() } else { faces.join(", ") };
    let (_, seen, name, cause, look_at) = rules[first];
    Some(SolverFinding::defect(name, format!("{faces}: {}", seen(alike[0])), cause, look_at))
}

/// Returns a finding if equivalent walls exert different forces: walls on opposite faces with equal
/// conditions, and one wall in two runs with different tangential conditions.
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

fn forces(wall: &Wall) -> String {
    format!("forces divided by the expected forces: {}", wall.describe())
}

fn is_none(force: f64) -> bool {
    force.abs() <= NONE
}

fn is_absent(wall: &Wall) -> bool {
    [wall.pushed, wall.pulled].into_iter().flatten().all(|force| force.abs() <= ABSENT)
}

fn stops_particles(wall: &Wall) -> bool {
    wall.through.is_some_and(|through| through.abs() <= 0.8 * TRAVEL)
}

fn has_wrong_force(wall: &Wall) -> bool {
    let is_near = |force: f64| THROWN.contains(&force);
    let mut thrown = [wall.pushed, wall.pulled].into_iter().flatten();
    let is_smooth = |falling: f64| (falling - 1.0).abs() <= SMOOTH;
    // A force above the expected force plus [`CARRIED`] indicates a wall inside the body.
    let is_inside = wall.offset.is_some_and(|offset| !(offset <= CARRIED));
    let is_even = wall.along.is_none_or(|along| is_near(along) || is_none(along));
    !(thrown.all(is_near) && is_even && !is_inside && wall.falling.is_none_or(is_smooth))
}

/// Whether a body sinks into the wall under gravity.
fn sinks(wall: &Wall) -> bool {
    let Some([sinking, halved]) = wall.sinking else { return false };
    // Averaging (PIC) also makes the body sink, but the body then sinks further with smaller steps.
    let sinks_by_steps = sinking.abs() > SUNK && halved.abs() <= 0.75 * sinking.abs();
    // The force lacks the weight of the fixed nodes (half a cell).
    let is_missing =
        wall.stretch.abs() <= STRETCH && wall.offset.is_some_and(|offset| !(offset >= -WEIGHT));
    sinks_by_steps || is_missing
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::doctor::tests::{assert_found, rows};

    /// Columns: forces on a body that is pushed, is pulled, moves along, and falls; force in the
    /// first step of a fall; displacement through the wall; jump; sinking, and sinking with half
    /// the step; error in a stretch; column `stress`.
    #[test]
    fn walls_have_their_cause() {
        let walls = "
1.04 0.96 1.45 1.04 0.04  0.79  2.9 0.11 0.084 0.049 1.45 |                              | 
1.04 0.96 0.55 0.96 -0.04 -0.79 -3  0.09 0.09  0     0.55 |                              | 
1    1    1    1    0     0     3.1 0    0     0     1    | position-limited             | 3.100 of v dt
NaN  1    1    1    0     0     1   0    0     0     1    | wall-force                   | right
0.09 0.09 1    0.52 0     5.7   1   0    0     0     1    | wall-holds-acceleration-only | falls 0.5200
0.09 0.09 1    0.48 0     5.7   1   0    0     0     1    | wall-missing                 | pushed 0.09000
0.09 0.09 1    0.52 0     5.5   1   0    0     0     1    | wall-holds-velocity-only     | pulled 0.09000
0.55 0.19 1    1    0     0     1   0    0     0     1    | wall-lets-go                 | fixed right: forc
0.55 0.21 1    1    0     0     1   0    0     0     1    | wall-force                   | pushed 0.5500
0.11 0.11 1    0.5  0     5.7   1   0    0     0     1    | wall-force                   | pushed 0.1100
1.55 1    1    1    0     0     1   0    0     0     1    | wall-force                   | pushed 1.550
1    0.45 1    1    0     0     1   0    0     0     1    | wall-force                   | pulled 0.4500
1    1    1    1.22 0     0     1   0    0     0     1    | wall-force                   | falls 1.220
1    1    1    0.78 0     0     1   0    0     0     1    | wall-force                   | falls 0.7800
1    1    1    1    0.42  0     1   0    0     0     1    | wall-force                   | of a fall 0.4200
1    1    0.45 1    0     0     1   0    0     0     1    | wall-force                   | slides 0.4500
1    1    1.55 1    0     0     1   0    0     0     1    | wall-force                   | slides 1.550
1    1    0.19 1    0     0     1   0    0     0     1    | fixed-lets-slide             | slides 0.1900
1    1    1    1    0     0.81  1   0    0     0     1    | particles-cross-wall         | by 0.8100 times
1    1    1    1    0     -0.81 1   0    0     0     1    | particles-cross-wall         | by -0.8100 times
1    1    1    1    0     0     1   0.11 0.08  0     1    | wall-moves-under-gravity     | by 0.1100 (with h
1    1    1    1    -0.32 0     1   0    0     0     1    | wall-moves-under-gravity     | of a fall -0.3200
1    1    1    1    0     0     1   0    0     0     1.55 | stress-column                | wall is 1.550
1    1    1    1    0     0     1   0    0     0     0.45 | stress-column                | wall is 0.4500
1.06 1    1    1    0     0     1   0    0     0     1    | wall-force                   | fixed left: pushe
1    1    1    1.06 0     0     1   0    0     0     1    | wall-force                   | fixed right: push
1    1    1    1    0     0     1   0    0     0.051 1    | (wall-breaks-linear-fields)  | up to 0.05100
";
        for (numbers, name, figure) in rows(walls) {
            let wall = |face, numbers: [f64; 11]| {
                let [pushed, pulled, along, falling, offset, through, jump, sinks, halved, ..] =
                    numbers;
                Wall {
                    face,
                    condition: "fixed",
                    pushed: Some(pushed),
                    pulled: Some(pulled),
                    along: Some(along),
                    falling: Some(falling),
                    offset: Some(offset),
                    through: Some(through),
                    jump,
                    sinking: Some([sinks, halved]),
                    stretch: numbers[9],
                    column: Some(numbers[10]),
                }
            };
            let sound = wall("left", [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
            let found = finding(&[sound, wall("right", numbers)]);
            assert_found(&Examined::new(String::new(), found), name, figure);
        }
    }
}
