//! Checks boundary conditions on faces, and prescribed velocities in regions of the body.

use super::event::{AXES, Event, OnFace, SpaceTimeBox, share};
use super::friction;
use super::survey::{self, Magnitudes, Survey};
use crate::exact::condition::{Face, FacePoint};
use crate::exact::formula::Formula;
use crate::exact::motion::Derivatives;
use crate::exact::problem::Problem;
use crate::exact::random::Random;
use crate::exact::violation::{LargestViolation, Violation};
use std::cell::Cell;

/// Checks all faces at random events. Returns the largest traction residual relative to the stress.
pub(crate) fn boundary(problem: &Problem, survey: &Survey) -> Result<f64, Violation> {
    conditions(problem, &problem.faces, survey)
}

pub(super) fn conditions(
    problem: &Problem,
    faces: &[Face],
    survey: &Survey,
) -> Result<f64, Violation> {
    let left = Cell::new(0.0);
    let mut random = Random::new(3);
    for face in faces {
        let on_face = OnFace::new(&problem.from, &problem.to, face.axis, face.high);
        let extent = on_face.extent(&survey::extent(problem));
        let mut found = LargestViolation::default();
        // All axes are sampled: a load may vary along an axis on which the motion is constant.
        for event in extent.spread(survey.face_events, |_| true, &mut random) {
            let now = problem.derivatives(&event.label, event.t);
            let (sizes, left) = (&survey.largest, &left);
            let point = MovingPoint { problem, face, event, now, sizes, left };
            found.add(face.condition.check(&point));
        }
        found.into_result()?;
    }
    Ok(left.get())
}

struct MovingPoint<'a> {
    problem: &'a Problem,
    face: &'a Face,
    event: Event,
    now: Derivatives,
    sizes: &'a Magnitudes,
    left: &'a Cell<f64>,
}

impl FacePoint for MovingPoint<'_> {
    fn dimension(&self) -> usize {
        self.problem.dimension()
    }

    fn axis(&self) -> usize {
        self.face.axis
    }

    fn value(&self, formula: &Formula) -> f64 {
        formula.at(&self.event.label, self.event.t)
    }

    fn present_area(&self) -> [f64; 3] {
        self.problem.equation.present_area(&self.now.grad, self.face.axis, self.face.high)
    }

    fn held(&self, i: usize, what: &str) -> Result<(), Violation> {
        let name = format!("boundary condition: {} is {what}, u_{} = 0", self.face.name, AXES[i]);
        let allowed = self.problem.tolerance * self.sizes.displacement;
        self.event.judge_condition(allowed, name, (0.0, self.now.u[i]), "m")
    }

    fn velocity(&self, i: usize, given: f64) -> Result<(), Violation> {
        let name = format!("boundary condition: velocity of {} in {}", self.face.name, AXES[i]);
        let allowed = self.problem.tolerance * self.sizes.velocity.max(given.abs());
        self.event.judge_condition(allowed, name, (given, self.now.velocity[i]), "m/s")
    }

    fn traction(&self, i: usize, what: &str, given: f64) -> Result<(), Violation> {
        let Self { problem, face, event, .. } = self;
        let normal = if face.high { 1.0 } else { -1.0 };
        let found = normal * problem.piola(&event.label, event.t, &self.now)[i][face.axis];
        let name = format!("boundary condition: {} is {what}, traction in {}", face.name, AXES[i]);
        let size = self.sizes.stress.max(given.abs());
        self.left.set(self.left.get().max(share(found - given, size)));
        event.judge_condition(problem.law_tolerance() * size, name, (given, found), "Pa")
    }

    fn friction(&self, coefficient: f64) -> Result<(), Violation> {
        let Magnitudes { displacement, velocity, stress, .. } = *self.sizes;
        let sizes = [displacement, velocity, stress];
        friction::at_wall(self.problem, self.face, &self.event, coefficient, &self.now, sizes)
    }

    fn continues_on_opposite_face(&self) -> Result<(), Violation> {
        let Self { problem, face, event, now, sizes, .. } = self;
        let opposite = event.opposite(&problem.from, &problem.to, face.axis, face.high);
        let there = problem.derivatives(&opposite, event.t);
        let condition =
            |what: String| format!("boundary condition: {} is periodic, but {what}", face.name);
        let differs =
            |what: String| condition(format!("{what} differs from that on the opposite face"));
        let (high, low) = if face.high { (now, &there) } else { (&there, now) };
        for i in 0..problem.dimension() {
            let allowed = problem.tolerance * sizes.displacement;
            if i == face.axis {
                let length = problem.to[i] - problem.from[i];
                let apart = length + (high.u[i] - low.u[i]);
                let name = condition(format!(
                    "x_{} does not differ by one period from that on the opposite face",
                    AXES[i]
                ));
                let allowed = allowed.max(4.0 * f64::EPSILON * face.period);
                event.judge(allowed, name, (face.period, apart), "m")?;
            } else {
                let name = differs(format!("u_{}", AXES[i]));
                event.judge(allowed, name, (there.u[i], now.u[i]), "m")?;
            }
            for j in 0..problem.dimension() {
                let name = differs(format!("du_{}/d{}", AXES[i], AXES[j]));
                let allowed = problem.tolerance * sizes.gradient;
                event.judge(allowed, name, (there.grad[i][j], now.grad[i][j]), "")?;
            }
        }
        Ok(())
    }
}

/// Checks `u_t = v` in every region with a prescribed velocity v.
pub(crate) fn driven(problem: &Problem, survey: &Survey) -> Result<(), Violation> {
    let speed = survey.largest.velocity;
    let mut random = Random::new(7);
    for (region, velocity) in problem.terms.iter().filter_map(|term| term.driven()) {
        let (from, to) = region.within(&problem.from, &problem.to);
        let part = SpaceTimeBox { from: &from, to: &to, ..survey::extent(problem) };
        let mut found = LargestViolation::default();
        for event in part.spread(survey.face_events, |_| true, &mut random) {
            let now = problem.derivatives(&event.label, event.t);
            for (i, formula) in velocity.iter().enumerate() {
                let given = formula.at(&event.label, event.t);
                let name = format!("given velocity of the set {} in {}", region.name, AXES[i]);
                let allowed = problem.tolerance * speed.max(given.abs());
                found.add(event.judge_condition(allowed, name, (given, now.velocity[i]), "m/s"));
            }
        }
        found.into_result()?;
    }
    Ok(())
}
