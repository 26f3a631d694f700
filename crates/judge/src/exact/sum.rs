//! Exact sums over the body and over its faces.

use super::condition::Face;
use super::gauss::points;
use super::motion::Derivatives;
use super::problem::Problem;

/// Up to three components of a sum, and the scale by which errors of the sum are divided.
type ValueAndSize = ([f64; 3], f64);

/// Returns a quantity per unit of reference volume or face area, and the scale of its errors.
pub type SumDensity = fn(&SumPoint<'_>) -> ([f64; 3], f64);

/// A point of the body or of a face, at one time.
pub struct SumPoint<'a> {
    problem: &'a Problem,
    face: Option<&'a Face>,
    label: &'a [f64],
    t: f64,
    now: Derivatives,
}

impl SumPoint<'_> {
    /// Returns `rho0 |v|^2 / 2` (J/m3).
    pub fn kinetic_energy(&self) -> f64 {
        let square: f64 = self.now.velocity.iter().map(|v| v * v).sum();
        0.5 * self.problem.density.at(self.label) * square
    }

    /// Returns the energy W with derivative P (J/m3); NaN for a law without energy.
    pub fn stored_energy(&self) -> f64 {
        let energy = self.problem.equation.energy(&self.now.grad).unwrap_or(f64::NAN);
        self.problem.factor_at(self.label) * energy
    }

    /// Returns `rho0 v` (kg/(m2 s)).
    pub fn momentum(&self) -> [f64; 3] {
        let density = self.problem.density.at(self.label);
        self.now.velocity.map(|v| density * v)
    }

    /// Returns `rho0 x^2` about the origin, for each axis (kg/m).
    pub fn second_moment(&self) -> [f64; 3] {
        let density = self.problem.density.at(self.label);
        self.position().map(|x| density * x * x)
    }

    /// Returns `rho0 X^2` about the origin, for each axis (kg/m).
    pub fn reference_second_moment(&self) -> [f64; 3] {
        let density = self.problem.density.at(self.label);
        std::array::from_fn(|i| self.label.get(i).map_or(0.0, |x| density * x * x))
    }

    /// Returns the current position x (m); zero on missing axes.
    fn position(&self) -> [f64; 3] {
        std::array::from_fn(|i| self.label.get(i).map_or(0.0, |x| x + self.now.u[i]))
    }

    /// Returns `x cross rho0 v` about the origin (kg/(m s)).
    pub fn angular_momentum(&self) -> [f64; 3] {
        let (x, p) = (self.position(), self.momentum());
        [x[1] * p[2] - x[2] * p[1], x[2] * p[0] - x[0] * p[2], x[0] * p[1] - x[1] * p[0]]
    }

    /// Returns `P N` on a face (Pa); zero inside the body.
    pub fn traction(&self) -> [f64; 3] {
        let Some(face) = self.face else { return [0.0; 3] };
        let outwards = if face.high { 1.0 } else { -1.0 };
        let piola = self.problem.piola(self.label, self.t, &self.now);
        std::array::from_fn(|i| outwards * piola[i][face.axis])
    }
}

/// Region of a sum.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SumRegion {
    /// The whole body.
    Body,
    /// Faces of a box, given by their numbers.
    Faces(Vec<usize>),
}

/// Maximum number of quadrature points after the last refinement.
const MOST_POINTS: usize = 1 << 16;

/// Maximum relative change by the last refinement, between rounding and discretisation errors.
const TOLERANCE: f64 = 1e-10;

/// Number of intervals between the times at which sizes and quadrature errors are computed.
const TIMES: usize = 20;

/// A sum whose exact value is known at any time of the run.
#[derive(Debug)]
pub struct BodySum {
    bodies: Vec<Problem>,
    density: SumDensity,
    sites: Vec<SumSite>,
    size: f64,
}

#[derive(Debug)]
struct SumSite {
    body: usize,
    face: Option<usize>,
    label: Vec<f64>,
    weight: f64,
}

/// Reason why a sum has no exact value; continues a sentence that starts with the sum's name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum SumError {
    /// The sum is zero at all times, so relative errors are undefined.
    #[error("is zero at all times")]
    Zero,
    /// The quadrature error exceeds the tolerance even with the maximum number of points.
    #[error(
        "cannot be integrated to {TOLERANCE:e} with {MOST_POINTS} points: the motion is not smooth \
         enough"
    )]
    NotConverged,
}

impl BodySum {
    /// Creates the sum of `density` over a `region`, with enough points for the whole run.
    ///
    /// # Errors
    /// If the sum is zero throughout the run, or if the quadrature does not converge.
    pub fn new(
        problem: &Problem,
        region: &SumRegion,
        density: SumDensity,
    ) -> Result<Self, SumError> {
        let bodies =
            if problem.bodies.is_empty() { vec![problem.clone()] } else { problem.bodies.clone() };
        let times: Vec<f64> = if problem.at_rest {
            vec![problem.until]
        } else {
            (0..=TIMES).map(|k| problem.until * (k as f64 / TIMES as f64)).collect()
        };
        let mut sum = Self { sites: sites(&bodies, region, 1), bodies, density, size: f64::NAN };
        let mut coarse = sum.with_sizes(&times);
        for refinement in 1_u32.. {
            let sites = sites(&sum.bodies, region, 1 << refinement);
            if sites.len() > MOST_POINTS {
                break;
            }
            sum.sites = sites;
            let fine = sum.with_sizes(&times);
            sum.size = fine.iter().map(|(_, size)| *size).fold(0.0, f64::max);
            if sum.size == 0.0 {
                return Err(SumError::Zero);
            }
            let change = |((a, _), (b, _)): (&ValueAndSize, &ValueAndSize)| {
                (0..3).all(|i| (a[i] - b[i]).abs() <= TOLERANCE * sum.size)
            };
            if fine.iter().zip(&coarse).all(change) {
                return Ok(sum);
            }
            coarse = fine;
        }
        Err(SumError::NotConverged)
    }

    /// Returns the scale of errors: the largest size of the sum during the run.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// Computes the sum at time `t` (s); components on missing axes are zero.
    pub fn at(&self, t: f64) -> [f64; 3] {
        self.with_sizes(&[t])[0].0
    }

    /// Computes the sum and its size at `times` (s). Terms constant in time are computed once.
    fn with_sizes(&self, times: &[f64]) -> Vec<ValueAndSize> {
        let mut sums = vec![([0.0; 3], 0.0); times.len()];
        for sites in self.sites.chunk_by(|a, b| a.body == b.body) {
            let problem = &self.bodies[sites[0].body];
            let labels: Vec<&[f64]> = sites.iter().map(|site| &site.label[..]).collect();
            let mut motion = problem.motion.at_places(&labels);
            for (sum, t) in sums.iter_mut().zip(times) {
                motion.set_time(*t);
                for (place, SumSite { face, label, weight, .. }) in sites.iter().enumerate() {
                    let mut now = Derivatives::default();
                    motion.derivatives(place, &mut now);
                    problem.complete(label, &mut now);
                    let face = face.map(|face| &problem.faces[face]);
                    let point = SumPoint { problem, face, label, t: *t, now };
                    let (value, size) = (self.density)(&point);
                    for (sum, value) in sum.0.iter_mut().zip(value) {
                        *sum += weight * value;
                    }
                    sum.1 += weight * size;
                }
            }
        }
        sums
    }
}

fn sites(bodies: &[Problem], region: &SumRegion, panels: usize) -> Vec<SumSite> {
    let of_body = |(body, problem): (usize, &Problem)| match region {
        SumRegion::Body => inside(problem, panels)
            .into_iter()
            .map(|(label, weight)| SumSite { body, face: None, label, weight })
            .collect::<Vec<_>>(),
        SumRegion::Faces(faces) => {
            let on = |number: &usize| {
                let face = Some(*number);
                let all = on_face(problem, &problem.faces[*number], panels).into_iter();
                all.map(move |(label, weight)| SumSite { body, face, label, weight })
            };
            faces.iter().flat_map(on).collect()
        }
    };
    bodies.iter().enumerate().flat_map(of_body).collect()
}

fn intervals(problem: &Problem) -> Vec<(f64, f64)> {
    problem.from.iter().copied().zip(problem.to.iter().copied()).collect()
}

fn inside(problem: &Problem, panels: usize) -> Vec<(Vec<f64>, f64)> {
    let Some(outline) = &problem.outline else { return points(&intervals(problem), panels) };
    let charts = outline.charts().into_iter().enumerate();
    let on_chart = |(chart, intervals): (usize, Vec<(f64, f64)>)| {
        let place = |(coordinates, weight): (Vec<f64>, f64)| {
            let (label, volume) = outline.place(chart, &coordinates);
            (label, weight * volume)
        };
        points(&intervals, panels).into_iter().map(place).collect::<Vec<_>>()
    };
    charts.flat_map(on_chart).collect()
}

fn on_face(problem: &Problem, face: &Face, panels: usize) -> Vec<(Vec<f64>, f64)> {
    let mut axes = intervals(problem);
    let (low, high) = axes.remove(face.axis);
    let mut all = points(&axes, panels);
    for (label, _) in &mut all {
        label.insert(face.axis, if face.high { high } else { low });
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::tests::{bar, bind, fixed, free, held};
    use crate::exact::{Density, Motion, Round};
    use approx::assert_relative_eq;
    use rstest::rstest;
    use std::f64::consts::PI;
    use std::sync::Arc;

    fn energy(point: &SumPoint<'_>) -> ([f64; 3], f64) {
        ([point.kinetic_energy(), point.stored_energy(), 0.0], point.kinetic_energy())
    }

    fn of_vector(value: [f64; 3]) -> ([f64; 3], f64) {
        (value, value.iter().map(|component| component.abs()).sum())
    }

    fn swinging() -> Problem {
        bar("sin(pi*X)*sin(pi*t)/100", fixed())
    }

    #[test]
    fn a_standing_wave_has_its_closed_forms() {
        let problem = swinging();
        let sum = |region, density| BodySum::new(&problem, &region, density).unwrap();
        let energies = sum(SumRegion::Body, energy);
        let momentum = sum(SumRegion::Body, |point| of_vector(point.momentum()));
        let left = sum(SumRegion::Faces(vec![0]), |point| of_vector(point.traction()));
        let both = sum(SumRegion::Faces(vec![0, 1]), |point| of_vector(point.traction()));
        let speed = PI / 100.0;
        assert_relative_eq!(energies.size(), 0.5 * speed * speed, max_relative = 1e-12);
        assert_relative_eq!(both.size(), 4.0 * speed, max_relative = 1e-12);
        for t in [0.0, 0.3, 0.7] {
            let (sin, cos) = (libm::sin(PI * t), libm::cos(PI * t));
            let [kinetic, stored, _] = energies.at(t);
            assert_relative_eq!(kinetic, 0.5 * (speed * cos).powi(2), max_relative = 1e-12);
            assert_relative_eq!(stored, 0.5 * (speed * sin).powi(2), max_relative = 1e-12);
            assert_relative_eq!(momentum.at(t)[0], 4.0 / PI * speed * cos, max_relative = 1e-12);
            assert_relative_eq!(left.at(t)[0], -2.0 * speed * sin, max_relative = 1e-12);
            assert_relative_eq!(both.at(t)[0], -4.0 * speed * sin, max_relative = 1e-12);
        }
    }

    /// With density 2 + X and stretch 1 + t, `sum m x^2` is (1 + t)^2 times
    /// `int (2 + X) X^2 dX` = 11/12.
    #[test]
    fn second_moments_use_the_local_density() {
        let density = Density::of_place(bind("2 + X", &["X"]), &[0.0], &[1.0], None).unwrap();
        let problem = Problem { density, ..bar("X*t", free()) };
        let sum = |density| BodySum::new(&problem, &SumRegion::Body, density).unwrap().at(0.5);
        let found = sum(|point| of_vector(point.second_moment()));
        assert_relative_eq!(found[0], 2.25 * 11.0 / 12.0, max_relative = 1e-12);
        let found = sum(|point| of_vector(point.reference_second_moment()));
        assert_relative_eq!(found[0], 11.0 / 12.0, max_relative = 1e-12);
        let found = sum(|point| of_vector(point.momentum()));
        assert_relative_eq!(found[0], 1.0 + 1.0 / 3.0, max_relative = 1e-12);
    }

    #[test]
    fn each_body_uses_its_own_density() {
        let whole = swinging();
        let half = |from: f64, to: f64, density: f64| Problem {
            from: vec![from],
            to: vec![to],
            density: density.into(),
            ..whole.clone()
        };
        let problem =
            Problem { bodies: vec![half(0.0, 0.5, 2.0), half(0.5, 1.0, 6.0)], ..whole.clone() };
        let density = |point: &SumPoint<'_>| of_vector(point.momentum());
        let of = |problem| BodySum::new(problem, &SumRegion::Body, density).unwrap().at(0.0)[0];
        assert_relative_eq!(of(&problem), 2.0 * of(&whole), max_relative = 1e-12);
    }

    /// A round body of density 2 that rotates about the origin has the angular momentum `w I`.
    #[rstest]
    #[case::disk(2, 0.0, PI / 2.0)]
    #[case::annulus(2, 0.5, PI / 2.0 * (1.0 - 0.0625))]
    #[case::ball(3, 0.0, 8.0 * PI / 15.0)]
    fn a_round_body_turns(#[case] d: usize, #[case] inner: f64, #[case] inertia: f64) {
        let names = [&["X", "Y", "Z"][..d], &["t"]].concat();
        let turned = ["cos(3*t)*X - sin(3*t)*Y - X", "sin(3*t)*X + cos(3*t)*Y - Y", "0"];
        let problem = Problem {
            outline: Some(Arc::new(Round { centre: vec![0.0; d], inner, outer: 1.0 })),
            motion: Motion::new(turned[..d].iter().map(|text| bind(text, &names)).collect()),
            ..held(d)
        };
        let density = |point: &SumPoint<'_>| of_vector(point.angular_momentum());
        let found = BodySum::new(&problem, &SumRegion::Body, density).unwrap().at(0.4);
        assert_relative_eq!(found[2], 2.0 * 3.0 * inertia, max_relative = 1e-10);
        assert!(found[0].abs() + found[1].abs() <= 1e-10, "{found:?}");
    }

    #[rstest]
    #[case::a_body_at_rest("0*X", "is zero at all times")]
    #[case::a_kink("abs(X - 0.3)*sin(t)", "cannot be integrated to 1e-10")]
    fn sums_without_an_exact_value_are_refused(#[case] displacement: &str, #[case] reason: &str) {
        let problem = bar(displacement, fixed());
        let density = |point: &SumPoint<'_>| of_vector(point.momentum());
        let found = BodySum::new(&problem, &SumRegion::Body, density).unwrap_err().to_string();
        assert!(found.starts_with(reason), "{found}");
    }
}
