//! The measured quantities of walls.

use super::{PointState, check};
use crate::external::LevelProblem;
use nalgebra::{Matrix3, Vector3};

/// Wave speed (m/s) for E = 3.1 Pa, nu = 0 and 1.7 kg/m3, and the cell size (m).
fn speed_and_cell() -> (f64, f64) {
    (libm::sqrt(3.1 / 1.7), 0.125)
}

/// Columns: face with the mistake (4 fixed and 4 rollers; 9 for all); forces on a body that is
/// pushed, is pulled, moves along, and falls; force in the first step of a fall; displacement
/// through the wall; jump in the first step; sinking, and sinking with half the step; error in a
/// stretch; column `stress`; velocity along a roller.
#[test]
fn forces_and_motions_at_walls_are_measured() {
    let walls_rows = "
9 1.45 0.55 1.45 1.18 0.38  0.75 2.9 0.09 0.09 0.04 1.45 1 |                          | all
1 1.02 0.97 1.03 1.04 -0.012 0.75 1   0.01 0.01 0.02 1    1 |                          | fixed right: pushed 1.020, pulled 0.9700, slides 1.030, falls 1.040, first step of a fall -0.01200, stretch 0.02000; fixed bottom: pulled 1.000
9 1    1    1    1    0     0.85 1   0    0    0    1    1 | particles-cross-wall     | passed the wall by 0.8500 times
9 1    1    1    1    0     0    1   0.11 0.08 0    1    1 | wall-moves-under-gravity | by 0.1100 (with half the time step by 0.08000), in units of
3 1    1    1    1    0     0    1   0    0    0    0.45 1 | stress-column            | fixed top: the force of the wall is correct, but the column `stress` next to the wall is 0.4500 of
9 1    1    1    1    0     0    3.1 0    0    0    1    1 | position-limited         | by up to 3.100 of v dt
9 1    1    1    1    0     0    1   0    0    0    1    0 | roller-holds-tangent     | the faces left and right: from
";
    let walls = |numbers: [f64; 13]| {
        move |problem: &LevelProblem, label: Vector3<f64>, step: u64| {
            let ((c, h), body) = (speed_and_cell(), &problem.bodies[0]);
            let face = problem.faces.iter().find(|face| face.condition != "free").expect("a wall");
            let (axis, other) = (face.axis, 1 - face.axis);
            let length = body.to[axis] - body.from[axis];
            let above = label[axis] - body.from[axis];
            let end =
                |i: usize| problem.particles.velocity[problem.particles.velocity.len() - 2 + i];
            let start = |i: usize| problem.particles.velocity[i];
            let is_stretched = start(axis) != end(axis);
            let high = if is_stretched { face.high } else { above > 0.5 * length };
            let number =
                2 * axis + usize::from(high) + if face.condition == "roller" { 4 } else { 0 };
            let sound = [0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0];
            let is_wrong = numbers[0] == 9.0 || numbers[0] == number as f64;
            let [
                _,
                pushed,
                pulled,
                along,
                falls,
                offset,
                through,
                jump,
                sinks,
                halved,
                stretch,
                column,
                slide,
            ] = if is_wrong { numbers } else { sound };
            let (t, sign) = (step as f64 * problem.dt, if high { 1.0 } else { -1.0 });
            let depth = if high { length - above } else { above };
            let (half, run) = (0.5 * length, problem.steps as f64 * problem.dt);
            let mut state = PointState::default();
            if is_stretched {
                // The strain rate is 1e-4 per time in which a wave crosses a cell.
                let strain = 1e-4 * c / h * t;
                state.u[axis] = -sign * strain * (depth + stretch * h);
            } else if !problem.loads.is_empty() {
                let held = offset * h * t + 0.5 * falls * c * t * t;
                state.v[axis] = 1e-3 * (t - held / half);
                let is_halved = problem.steps > 28;
                state.u[axis] = if is_halved { halved } else { sinks } * 1e-3 * run * h / c;
            } else if start(other) != 0.0 && face.condition == "fixed" {
                state.v[other] = start(other) * (1.0 - along * c / libm::sqrt(2.0) * t / half);
            } else if start(other) != 0.0 {
                state.v[other] = start(other) * slide;
                state.u[other] = start(other) * slide * t;
            } else {
                let force = if (start(axis) > 0.0) == high { pushed } else { pulled };
                state.v[axis] = start(axis) * (1.0 - force * c * t / half);
                let first = jump * 1e-3 * c * problem.dt;
                let later = sign * through * 1e-3 * h;
                state.u[axis] = if step < 2 { first } else { later };
                let mut stress = Matrix3::zeros();
                stress[(axis, axis)] = -sign * column * 1e-3 * c * c * 1.7;
                state.tensors = Some([stress, Matrix3::identity()]);
            }
            state
        }
    };
    check(4, "walls", walls, walls_rows);
}
