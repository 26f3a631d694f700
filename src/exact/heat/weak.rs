//! The heat equation in weak form, on random patches of space and time: it sees what a kink in the
//! temperature hides from the equation point by point, a source of heat on a surface.
//!
//! For any smooth `phi` that vanishes on the rim of a patch,
//! `int int (rho0 c T phi_t - k J C^-1 Grad T . Grad phi + rho0 s phi) dX dt = 0`.

use super::problem::Conduction;
use crate::exact::check::weak::{PATCHES, SpaceTimePatch, Sums, bump};
use crate::exact::random::Random;
use crate::exact::violation::Violation;

/// Checks the balance of heat.
pub(super) fn balance(problem: &Conduction) -> Result<(), Violation> {
    let mut random = Random::new(6);
    for _ in 0..PATCHES {
        let ends = (&problem.from[..], &problem.to[..]);
        let patch = SpaceTimePatch::in_box(&mut random, ends, problem.until, f64::INFINITY);
        on_patch(problem, &patch)?;
    }
    Ok(())
}

fn on_patch(problem: &Conduction, patch: &SpaceTimePatch) -> Result<(), Violation> {
    let d = problem.dimension();
    let centre = (&patch.centre[..d], patch.centre[d]);
    sums(problem, patch).judge("heat balance across kinks (the heat equation", centre)
}

/// The balance by the midpoint rule on a raster of the patch.
fn sums(problem: &Conduction, patch: &SpaceTimePatch) -> Sums {
    let d = problem.dimension();
    let (points, times) = patch.raster();
    let middle = problem.temperature.at(&patch.centre[..d], patch.centre[d]);
    let mut all = Sums::default();
    for (time, point) in times.iter().flat_map(|t| points.iter().map(move |point| (t, point))) {
        let label: Vec<f64> = point.iter().map(|on_axis| on_axis.at).collect();
        let (motion, now) = problem.now(&label, time.at);
        let (phi, slope) = bump(&[&point[..], &[*time]].concat());
        // A constant temperature stores nothing: without it the terms are those that matter.
        let stored = problem.density * problem.capacity * (now.value - middle) * slope[d];
        let inflow = problem.inflow(&motion, &now);
        let flow: f64 = (0..d).map(|a| inflow[a] * slope[a]).sum();
        let source = problem.density * problem.source(&label, time.at, &motion, &now) * phi;
        all.gain -= stored;
        all.loss += source - flow;
        all.size += stored.abs() + flow.abs() + source.abs();
    }
    all
}
