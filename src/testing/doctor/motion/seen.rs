//! A motion that should be uniform, and its errors.

use crate::testing::doctor::course::{Course, displacement, minus, size, times, velocity};
use crate::testing::doctor::patient::Patient;
use crate::testing::doctor::scene::BoxScene;

/// The body counts as moving as a whole if the motions of points differ from the mean motion by at
/// most this share of the mean error.
const AS_ONE: f64 = 0.05;

pub(super) struct UniformMotion<'a> {
    pub(super) patient: &'a Patient<'a>,
    pub(super) scene: &'a BoxScene,
    pub(super) course: Course,
    /// Expected velocity (m/s).
    pub(super) velocity: [f64; 3],
}

impl UniformMotion<'_> {
    /// Returns the largest errors of displacements and velocities, relative to distance and speed.
    pub(super) fn off(&self) -> (f64, f64) {
        let most = |all: &dyn Fn(usize) -> f64| {
            (0..=self.course.last()).map(all).fold(0.0, f64::max) / size(self.velocity)
        };
        let end = self.course.times[self.course.last()];
        (most(&|k| self.way_off(k)) / end, most(&|k| self.speed_off(k)))
    }

    /// Returns the largest error of a displacement (m) in state `k`.
    pub(super) fn way_off(&self, k: usize) -> f64 {
        let wanted = times(self.course.times[k], self.velocity);
        self.course.farthest(displacement, k, wanted)
    }

    fn speed_off(&self, k: usize) -> f64 {
        self.course.farthest(velocity, k, self.velocity)
    }

    /// Whether all points have about the same error.
    pub(super) fn errs_as_one(&self) -> bool {
        let course = &self.course;
        (1..=course.last()).all(|k| {
            let (u, v) = (course.mean(displacement, k), course.mean(velocity, k));
            let spread = [course.farthest(displacement, k, u), course.farthest(velocity, k, v)];
            let errors = [
                size(minus(u, times(course.times[k], self.velocity))),
                size(minus(v, self.velocity)),
            ];
            // Small differences between points may be rounding errors.
            let small = [
                1e-6 * size(self.velocity) * course.times[course.last()],
                1e-6 * size(self.velocity),
            ];
            (0..2).all(|i| spread[i] <= AS_ONE * errors[i] + small[i])
        })
    }
}
