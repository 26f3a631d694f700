//! The heat equation in weak form, on random patches of space and time: it sees what a kink in the
//! temperature hides from the equation point by point, a source of heat on a surface.
//!
//! For any smooth `phi` that vanishes on the rim of a patch,
//! `int int (rho0 c T phi_t - k J C^-1 Grad T . Grad phi + rho0 s phi) dX dt = 0`.

use super::magnitudes::HeatMagnitudes;
use super::problem::Conduction;
use crate::exact::check::space_time_patch::{Densities, Raster, SpaceTimePatch, bump, labels};
use crate::exact::check::weak::{Sums, balances, patches};
use crate::exact::motion::{Derivatives, Motion};
use crate::exact::random::Random;
use crate::exact::violation::Violation;

/// Checks the balance of heat on random patches. Fields far below the `largest` do not count.
pub(super) fn balance(problem: &Conduction, largest: &HeatMagnitudes) -> Result<(), Violation> {
    let densities = Densities {
        stored: problem.density * problem.capacity * largest.range,
        flow: largest.inflow,
        supply: problem.density * largest.terms,
    };
    let mut random = Random::new(6);
    let smooth =
        problem.temperature.is_smooth() && problem.motion.as_ref().is_none_or(Motion::is_smooth);
    for _ in 0..patches(smooth) {
        let ends = (&problem.from[..], &problem.to[..]);
        let patch = SpaceTimePatch::in_box(&mut random, ends, problem.until, f64::INFINITY);
        let d = problem.dimension();
        // A constant temperature stores nothing: without it the terms are those that matter.
        let middle = problem.temperature.at(&patch.centre[..d], patch.centre[d]);
        let condition = "heat balance across kinks (the heat equation";
        balances(patch, condition, &densities, |raster, smallest| {
            [sums(problem, raster, smallest, middle)]
        })?;
    }
    Ok(())
}

/// The balance on a raster of a patch, of the temperature beyond `middle` (K).
fn sums(problem: &Conduction, raster: &Raster, smallest: f64, middle: f64) -> Sums {
    let d = problem.dimension();
    let Raster { points, times } = raster;
    let labels = labels(points);
    let all_labels = || labels.iter().map(Vec::as_slice);
    let mut warm = problem.temperature.at_places(all_labels());
    let mut places = problem.motion.as_ref().map(|motion| motion.at_places(all_labels()));
    let (mut all, mut motion) = (Sums::new(smallest), Derivatives::default());
    for time in times {
        warm.set_time(time.at);
        if let Some(places) = &mut places {
            places.set_time(time.at);
        }
        for (place, point) in points.iter().enumerate() {
            if let Some(places) = &mut places {
                places.derivatives(place, &mut motion);
            }
            let now = warm.derivatives(place);
            let mut event = [*time; 4];
            event[..d].copy_from_slice(point);
            let (phi, slope) = bump(&event[..=d]);
            let stored = problem.density * problem.capacity * (now.value - middle) * slope[d];
            let inflow = problem.inflow(&motion, &now);
            let flow: f64 = (0..d).map(|a| inflow[a] * slope[a]).sum();
            let source = problem.source(&labels[place], time.at, &motion, &now);
            let source = problem.density * source * phi;
            let size = stored.abs() + flow.abs() + source.abs();
            all.add(-stored, source - flow, size, &event[..=d]);
        }
    }
    all
}
