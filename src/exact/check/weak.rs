//! The equation in weak form, on random patches of space and time.
//!
//! Waves behind a sudden load carry kinks: `u_X` jumps, and the equation holds point by point on
//! both sides whatever the speed of the front. The weak form sees the front: for any smooth `phi`
//! that vanishes on the rim of a patch,
//! `int int (rho0 u_t phi_t - P : grad phi + rho0 b phi) dX dt = 0`; of a body of revolution with
//! `R dX` in the place of dX, and less `P_tT phi` in the radial component.

use super::distinct::DistinctPlaces;
use super::space_time_patch::{Raster, SpaceTimePatch, bump, labels};
use crate::exact::motion::Derivatives;
use crate::exact::problem::Problem;
use crate::exact::random::Random;
use crate::exact::violation::Violation;

/// Patches of a problem whose fields may have kinks, at places that nobody states.
const PATCHES: usize = 12;

/// Patches of a problem whose fields are smooth: what the equation demands point by point, it
/// demands in weak form then, but for a front that is so steep that no random point meets it.
const PATCHES_OF_SMOOTH_FIELDS: usize = 2;

/// How many patches a problem is held to.
pub(crate) fn patches(smooth: bool) -> usize {
    if smooth { PATCHES_OF_SMOOTH_FIELDS } else { PATCHES }
}

/// Largest imbalance, relative to the sum of the magnitudes of the terms. The quadrature of a jump
/// that runs obliquely through the grid of points below is good to about a thousandth.
const TOLERANCE: f64 = 0.005;

/// Longest patch, in times that a wave takes through the body: the points below must resolve it.
const WAVES: f64 = 4.0;

/// Time that a wave takes through the body, on its longest axis.
fn crossing(problem: &Problem) -> f64 {
    let lengths = problem.from.iter().zip(&problem.to).map(|(from, to)| to - from);
    let longest = lengths.fold(0.0, f64::max);
    longest / problem.wave_speed()
}

/// A random patch of the body.
fn draw(random: &mut Random, problem: &Problem) -> SpaceTimePatch {
    let (ends, longest) = ((&problem.from[..], &problem.to[..]), WAVES * crossing(problem));
    match &problem.outline {
        None => SpaceTimePatch::in_box(random, ends, problem.until, longest),
        Some(outline) => {
            let place = outline.patch(random);
            SpaceTimePatch::over(random, place, problem.until, longest)
        }
    }
}

/// Checks the balance of momentum on random patches.
pub(crate) fn momentum(problem: &Problem) -> Result<(), Violation> {
    let mut random = Random::new(6);
    let heat = problem.heat.as_ref();
    let smooth = problem.motion.is_smooth() && heat.is_none_or(|heat| heat.temperature.is_smooth());
    for _ in 0..patches(smooth) {
        balance(problem, &draw(&mut random, problem))?;
    }
    Ok(())
}

/// Sums of the terms over a patch, by the midpoint rule. Where they balance closely on half of the
/// points on each axis, these do; they are the fourth to the sixteenth part.
pub(crate) fn integrate<const N: usize>(
    patch: &SpaceTimePatch,
    sums_on: impl Fn(&Raster) -> [Sums; N],
) -> [Sums; N] {
    let per_axis = [0, 64, 20, 10][patch.dimension()];
    let coarse = sums_on(&patch.raster(per_axis / 2));
    if coarse.iter().all(|sums| sums.imbalance_within(TOLERANCE / 2.0)) {
        return coarse;
    }
    sums_on(&patch.raster(per_axis))
}

/// The sums of one component over a patch.
#[derive(Clone, Copy, Default)]
pub(crate) struct Sums {
    pub(crate) gain: f64,
    pub(crate) loss: f64,
    pub(crate) size: f64,
}

impl Sums {
    /// Whether gain and loss differ by no more than a share of the sum of all terms.
    fn imbalance_within(&self, share: f64) -> bool {
        (self.gain - self.loss).abs() <= share * self.size
    }

    /// Holds gain against loss; `condition` ends with the name of the equation.
    pub(crate) fn judge(
        &self,
        condition: &str,
        (label, t): (&[f64], f64),
    ) -> Result<(), Violation> {
        if self.imbalance_within(TOLERANCE) {
            return Ok(());
        }
        Err(Violation {
            condition: format!("{condition} in weak form; shares of the sum of all terms)"),
            label: label.to_vec(),
            t,
            expected: Some(self.loss / self.size),
            found: self.gain / self.size,
            unit: "",
        })
    }
}

fn balance(problem: &Problem, patch: &SpaceTimePatch) -> Result<(), Violation> {
    let d = problem.dimension();
    let condition = "momentum balance across wave fronts (the equation of motion";
    let centre = (&patch.centre[..d], problem.loaded(patch.centre[d]));
    let only_first = !problem.force_is_of_second_order();
    let mut balances = integrate(patch, |raster| sums(problem, raster, only_first));
    // What is constant where a root has an infinite slope has a derivative in jets only.
    if balances.iter().any(|sums| !sums.size.is_finite()) {
        balances = integrate(patch, |raster| sums(problem, raster, false));
    }
    balances[..d].iter().try_for_each(|sums| sums.judge(condition, centre))
}

/// The balance of every component on a raster of a patch, with first derivatives of the motion only
/// if they are all that the forces take.
fn sums(problem: &Problem, raster: &Raster, only_first: bool) -> [Sums; 3] {
    let d = problem.dimension();
    let Raster { points, times } = raster;
    let labels = labels(points);
    let motion = &problem.motion;
    let distinct = DistinctPlaces::of(motion, points.len(), times.len());
    let at = distinct.first.iter().map(|point| labels[*point].as_slice());
    let mut places = if only_first { motion.slopes_at_places(at) } else { motion.at_places(at) };
    let mut fields = vec![Derivatives::default(); distinct.first.len()];
    let mut all = [Sums::default(); 3];
    for time in times {
        places.set_time(time.at);
        for (place, field) in fields.iter_mut().enumerate() {
            places.derivatives(place, field);
        }
        let loaded = problem.loaded(time.at);
        for (place, point) in points.iter().enumerate() {
            let mut now = fields[distinct.of_point[place]];
            problem.complete(&labels[place], &mut now);
            let mut event = [*time; 4];
            event[..d].copy_from_slice(point);
            let (phi, slope) = bump(&event[..=d]);
            let piola = problem.piola(&labels[place], time.at, &now);
            let force = problem.force(&labels[place], loaded, &now);
            let (ring, hoops) = problem.ring(&labels[place], &piola);
            for (i, sums) in all[..d].iter_mut().enumerate() {
                let inertia = ring * problem.density * now.velocity[i] * slope[d];
                let stress: f64 = (0..d).map(|j| piola[i][j] * slope[j]).sum();
                let stress = ring * stress + hoops[i] * phi;
                let force = ring * problem.density * force[i] * phi;
                sums.gain -= inertia;
                sums.loss += force - stress;
                sums.size += inertia.abs() + stress.abs() + force.abs();
            }
        }
    }
    all
}
