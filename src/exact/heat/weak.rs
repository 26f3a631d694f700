//! The heat equation in weak form, on random patches of space and time: it sees what a kink in the
//! temperature hides from the equation point by point, a source of heat on a surface.
//!
//! For any smooth `phi` that vanishes on the rim of a patch,
//! `int int (rho0 c T phi_t - k J C^-1 Grad T . Grad phi + rho0 s phi) dX dt = 0`.

use super::problem::Conduction;
use crate::exact::check::weak::{PATCHES, SpaceTimePatch, Sums, TOLERANCE, bump};
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
    let (d, sums) = (problem.dimension(), sums(problem, patch));
    if (sums.gain - sums.loss).abs() <= TOLERANCE * sums.size {
        return Ok(());
    }
    Err(Violation {
        condition: "heat balance across kinks (the heat equation in weak form; shares of the sum \
                    of all terms)"
            .to_owned(),
        label: patch.centre[..d].to_vec(),
        t: patch.centre[d],
        expected: Some(sums.loss / sums.size),
        found: sums.gain / sums.size,
        unit: "",
    })
}

/// The balance by the midpoint rule on a raster of the patch.
fn sums(problem: &Conduction, patch: &SpaceTimePatch) -> Sums {
    let d = problem.dimension();
    let per_axis = [0, 64, 20, 10][d];
    let axes: Vec<_> = (0..=d).map(|a| patch.axis(a, per_axis)).collect();
    let middle = problem.temperature.at(&patch.centre[..d], patch.centre[d]);
    let mut all = Sums::default();
    for k in 0..per_axis.pow(d as u32 + 1) {
        let mut rest = k;
        let points: Vec<_> = axes
            .iter()
            .map(|axis| {
                let point = axis[rest % per_axis];
                rest /= per_axis;
                point
            })
            .collect();
        let place: Vec<f64> = points.iter().map(|point| point.at).collect();
        let (label, t) = (&place[..d], place[d]);
        let (motion, now) = problem.now(label, t);
        let (phi, slope) = bump(&points);
        // A constant temperature stores nothing: without it the terms are those that matter.
        let stored = problem.density * problem.capacity * (now.value - middle) * slope[d];
        let inflow = problem.inflow(&motion, &now);
        let flow: f64 = (0..d).map(|a| inflow[a] * slope[a]).sum();
        let source = problem.density * problem.source(label, t, &motion, &now) * phi;
        all.gain -= stored;
        all.loss += source - flow;
        all.size += stored.abs() + flow.abs() + source.abs();
    }
    all
}
