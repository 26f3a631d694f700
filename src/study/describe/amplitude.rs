//! How large an exact solution is.

use crate::exact::{Derivatives, Problem};

/// Largest displacement and displacement gradient of the exact solution, on a raster of the body
/// and the run.
pub(crate) fn amplitude(problem: &Problem) -> String {
    const PER_AXIS: usize = 20;
    let places = raster(problem, PER_AXIS);
    let mut motion = problem.motion.at_places(places.iter().map(Vec::as_slice));
    let (mut displacement, mut gradient) = (0.0_f64, 0.0_f64);
    let mut now = Derivatives::default();
    for step in 0..=PER_AXIS {
        motion.set_time(problem.until * (step as f64 / PER_AXIS as f64));
        for place in 0..places.len() {
            motion.derivatives(place, &mut now);
            displacement = now.u.iter().fold(displacement, |a, b| a.max(b.abs()));
            gradient = now.grad.iter().flatten().fold(gradient, |a, b| a.max(b.abs()));
        }
    }
    format!("largest |u| {displacement:.3e} m, largest |grad u| {gradient:.3e}")
}

/// Points of the body on a raster of its box, with so many intervals along each axis.
pub(crate) fn raster(problem: &Problem, intervals: usize) -> Vec<Vec<f64>> {
    let point = |mut rest: usize| {
        let corners = problem.from.iter().zip(&problem.to);
        let coordinate = |(a, b): (&f64, &f64)| {
            let share = (rest % (intervals + 1)) as f64 / intervals as f64;
            rest /= intervals + 1;
            a + (b - a) * share
        };
        corners.map(coordinate).collect::<Vec<f64>>()
    };
    let points = (intervals + 1).pow(problem.dimension() as u32);
    (0..points).map(point).filter(|place| problem.holds(place)).collect()
}
