//! Checks the equation of motion in weak form on random space-time patches.
//!
//! Waves behind a sudden load have kinks, where `u_X` jumps; only the weak form constrains the
//! speed of the front. For any smooth `phi` that vanishes on the boundary of a patch, `int int
//! (rho0 u_t phi_t - P : grad phi + rho0 b phi) dX dt = 0`. For a body of revolution, dX is
//! replaced by `R dX`, and `P_tT phi` is subtracted in the radial component.
//!
//! The motion is evaluated once for points that differ only along axes on which it is constant.

use super::space_time_patch::{AxisPoint, Densities, Raster, SpaceTimePatch, bump, labels};
use super::survey::{Magnitudes, Survey};
use crate::exact::motion::{Derivatives, Motion};
use crate::exact::problem::Problem;
use crate::exact::random::Random;
use crate::exact::violation::Violation;

/// Number of patches if the fields may have kinks at unknown positions.
const PATCHES: usize = 12;

/// Number of patches if the fields are smooth. The pointwise equation then implies the weak form;
/// the patches only detect a front so steep that it contains no random point.
const PATCHES_OF_SMOOTH_FIELDS: usize = 2;

pub(crate) fn patches(smooth: bool) -> usize {
    if smooth { PATCHES_OF_SMOOTH_FIELDS } else { PATCHES }
}

/// Maximum relative imbalance. The quadrature error of a jump oblique to the raster is about 0.001.
const TOLERANCE: f64 = 0.005;

/// Maximum duration of a patch that the raster resolves, in wave transit times through the body.
const WAVES: f64 = 4.0;

/// Returns the transit time of a wave along the longest axis of the body (s).
fn crossing(problem: &Problem) -> f64 {
    let lengths = problem.from.iter().zip(&problem.to).map(|(from, to)| to - from);
    let longest = lengths.fold(0.0, f64::max);
    longest / problem.wave_speed()
}

fn draw(random: &mut Random, problem: &Problem) -> SpaceTimePatch {
    let (from, to) = (&problem.from[..], &problem.to[..]);
    let longest = WAVES * crossing(problem);
    match &problem.outline {
        None => SpaceTimePatch::in_box(random, from, to, problem.until, longest),
        Some(outline) => {
            let (centre, half) = outline.patch(random);
            SpaceTimePatch::over(random, centre, half, problem.until, longest)
        }
    }
}

/// Minimum scale of an imbalance, as a share of the largest terms.
const SMALLEST: f64 = 1e-3;

/// Maximum number of times that an unresolved patch is halved.
const HALVINGS: usize = 12;

/// Checks the momentum balance on random patches, and on patches around the largest stresses.
pub(crate) fn momentum(problem: &Problem, survey: &Survey) -> Result<(), Violation> {
    let mut random = Random::new(6);
    let heat = problem.heat.as_ref();
    let smooth = problem.motion.is_smooth() && heat.is_none_or(|heat| heat.temperature.is_smooth());
    let count = patches(smooth);
    for _ in 0..count {
        balance(problem, draw(&mut random, problem), &survey.largest)?;
    }
    for event in survey.active(count, |sizes| sizes.stress) {
        let (from, to) = (&problem.from[..], &problem.to[..]);
        let longest = WAVES * crossing(problem);
        let whole = match &problem.outline {
            None => SpaceTimePatch::whole(from, to, problem.until, longest, event.t),
            Some(_) => draw(&mut random, problem),
        };
        balance(problem, whole.about(event, &mut random), &survey.largest)?;
    }
    Ok(())
}

/// Compares gain and loss over a patch by the midpoint rule. If the imbalance changes with twice
/// and four times the points per axis, the check is repeated on the half patch around the largest
/// term.
///
/// `condition` is the beginning of a message and ends with the name of the equation.
pub(crate) fn balances<const N: usize>(
    mut patch: SpaceTimePatch,
    condition: &str,
    largest: &Densities,
    sums_on: impl Fn(&Raster, f64) -> [Sums; N],
) -> Result<(), Violation> {
    let per_axis = [0, 64, 20, 10][patch.dimension()];
    for halving in 0..=HALVINGS {
        let sums_of = |per_axis: usize| {
            let smallest = SMALLEST * patch.largest_sum(largest, per_axis);
            sums_on(&patch.raster(per_axis), smallest)
        };
        let coarse = sums_of(per_axis / 2);
        if coarse.iter().all(|sums| sums.imbalance_within(TOLERANCE / 2.0)) {
            return Ok(());
        }
        let fine = sums_of(per_axis);
        if fine.iter().all(|sums| sums.imbalance_within(TOLERANCE)) {
            return Ok(());
        }
        let settled = |fine: &[Sums; N], coarse: &[Sums; N]| {
            let share = (0..=patch.dimension()).map(|_| 0.5).product();
            let mut pairs = fine.iter().zip(coarse);
            halving == HALVINGS || pairs.any(|(fine, coarse)| fine.has_settled(coarse, share))
        };
        if settled(&fine, &coarse) {
            let finest = sums_of(2 * per_axis);
            if settled(&finest, &fine) {
                return finest.iter().try_for_each(|sums| sums.judge(condition, &patch));
            }
        }
        let peak = fine.iter().max_by(|a, b| a.peak.total_cmp(&b.peak));
        patch = peak.map_or(patch.clone(), |peak| patch.part(&peak.place, 0.5));
    }
    Ok(())
}

/// Sums over a patch of the terms in one component of a balance.
#[derive(Clone, Copy, Default)]
pub(crate) struct Sums {
    pub(crate) gain: f64,
    pub(crate) loss: f64,
    pub(crate) size: f64,
    pub(crate) smallest: f64,
    /// The largest `size` at a point; `place` is the position and time of this point.
    peak: f64,
    place: [f64; 4],
}

impl Sums {
    pub(crate) fn new(smallest: f64) -> Self {
        Self { smallest, ..Self::default() }
    }

    /// Adds gain and loss at a point; `size` is the magnitude of the terms there.
    pub(crate) fn add(&mut self, gain: f64, loss: f64, size: f64, at: &[AxisPoint]) {
        self.gain += gain;
        self.loss += loss;
        self.size += size;
        if size > self.peak {
            self.peak = size;
            for (place, point) in self.place.iter_mut().zip(at) {
                *place = point.at;
            }
        }
    }

    fn imbalance(&self) -> f64 {
        (self.gain - self.loss) / self.size.max(self.smallest)
    }

    /// Whether gain and loss differ by at most `share` of the sum of the magnitudes of all terms.
    fn imbalance_within(&self, share: f64) -> bool {
        (self.gain - self.loss).abs() <= share * self.size.max(self.smallest)
    }

    /// Whether the imbalance exceeds [`TOLERANCE`] and hardly differs from that of a `coarse`
    /// raster with half as many points per axis, a fraction `share` of the fine points.
    fn has_settled(&self, coarse: &Self, share: f64) -> bool {
        let (fine, before) = (self.imbalance(), coarse.imbalance());
        let same_size = (coarse.size - share * self.size).abs() <= 0.05 * coarse.size;
        let same_share = (fine - before).abs() <= 0.3 * fine.abs();
        fine.abs() > TOLERANCE && same_share && same_size
    }

    fn judge(&self, condition: &str, patch: &SpaceTimePatch) -> Result<(), Violation> {
        if self.imbalance_within(TOLERANCE) {
            return Ok(());
        }
        let d = patch.dimension();
        Err(Violation {
            condition: format!(
                "{condition} in weak form; shares of the sum of all terms) is violated"
            ),
            label: patch.centre[..d].to_vec(),
            t: patch.centre[d],
            expected: Some(self.loss / self.size),
            found: self.gain / self.size,
            allowed: None,
            unit: "",
        })
    }
}

fn balance(
    problem: &Problem,
    patch: SpaceTimePatch,
    largest: &Magnitudes,
) -> Result<(), Violation> {
    let condition = "momentum balance across wave fronts (the equation of motion";
    let only_first = !problem.force_is_of_second_order();
    let (ring, _) = problem.ring(&problem.to, &[[0.0; 3]; 3]);
    let densities = Densities {
        stored: ring * problem.density.largest() * largest.velocity,
        flow: ring * largest.stress,
        supply: ring * largest.force,
    };
    balances(patch, condition, &densities, |raster, smallest| {
        let all = sums(problem, raster, smallest, only_first);
        // With first derivatives only, the square root of a constant zero has NaN derivatives.
        let is_finite = all.iter().all(|sums| sums.size.is_finite());
        if is_finite { all } else { sums(problem, raster, smallest, false) }
    })
}

/// Sums the terms of the momentum balance, with first derivatives only if `only_first`.
fn sums(problem: &Problem, raster: &Raster, smallest: f64, only_first: bool) -> [Sums; 3] {
    let d = problem.dimension();
    let Raster { points, times } = raster;
    let labels = labels(points);
    let motion = &problem.motion;
    let distinct = DistinctPlaces::new(motion, points.len(), times.len());
    let at: Vec<&[f64]> = distinct.first.iter().map(|point| labels[*point].as_slice()).collect();
    let mut places = if only_first { motion.slopes_at_places(&at) } else { motion.at_places(&at) };
    let mut fields = vec![Derivatives::default(); distinct.first.len()];
    let mut all = [Sums::new(smallest); 3];
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
            let density = problem.density.at(&labels[place]);
            let (ring, hoops) = problem.ring(&labels[place], &piola);
            for (i, sums) in all[..d].iter_mut().enumerate() {
                let inertia = ring * density * now.velocity[i] * slope[d];
                let stress: f64 = (0..d).map(|j| piola[i][j] * slope[j]).sum();
                let stress = ring * stress + hoops[i] * phi;
                let force = ring * density * force[i] * phi;
                let size = inertia.abs() + stress.abs() + force.abs();
                sums.add(-inertia, force - stress, size, &event[..=d]);
            }
        }
    }
    all
}

/// Distinct positions of a raster. Points that differ only along axes on which the motion is
/// constant share a position.
pub(super) struct DistinctPlaces {
    /// The first raster point at each position.
    pub(super) first: Vec<usize>,
    pub(super) of_point: Vec<usize>,
}

impl DistinctPlaces {
    /// Finds the positions of `count` points, `per_axis` on each axis; the first varies fastest.
    pub(super) fn new(motion: &Motion, count: usize, per_axis: usize) -> Self {
        let varying: Vec<bool> =
            (0..motion.dimension()).map(|axis| motion.varies_along(axis)).collect();
        let of_point: Vec<usize> =
            (0..count).map(|point| place(point, per_axis, &varying)).collect();
        let mut first = Vec::new();
        for (point, place) in of_point.iter().enumerate() {
            if *place == first.len() {
                first.push(point);
            }
        }
        Self { first, of_point }
    }
}

/// Returns the index of a point in the raster reduced to the axes along which the motion varies.
fn place(mut point: usize, per_axis: usize, varying: &[bool]) -> usize {
    let (mut place, mut stride) = (0, 1);
    for varies in varying {
        if *varies {
            place += stride * (point % per_axis);
            stride *= per_axis;
        }
        point /= per_axis;
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_differ_along_constant_axes_share_a_place() {
        let of = |varying: &[bool; 3]| (0..27).map(|point| place(point, 3, varying)).collect();
        let all: Vec<usize> = of(&[true, true, true]);
        assert!(all.into_iter().eq(0..27));
        let middle: Vec<usize> = of(&[false, true, false]);
        assert_eq!(middle[..9], [0, 0, 0, 1, 1, 1, 2, 2, 2]);
        assert_eq!(middle[9..18], middle[..9]);
        let ends: Vec<usize> = of(&[true, false, true]);
        assert_eq!((ends[2], ends[5], ends[9], ends[26]), (2, 2, 3, 8));
    }
}
