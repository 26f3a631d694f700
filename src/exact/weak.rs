//! The equation in weak form, on random patches of space and time.
//!
//! Waves behind a sudden load carry kinks: `u_X` jumps, and the equation holds point by point on
//! both sides whatever the speed of the front. The weak form sees the front: for any smooth `phi`
//! that vanishes on the rim of a patch,
//! `int int (rho0 u_t phi_t - P : grad phi + rho0 b phi) dX dt = 0`.

use super::{motion::Derivatives, problem::Problem, random::Random, violation::Violation};

/// Patches per problem.
const PATCHES: usize = 12;

/// Largest imbalance, relative to the sum of the magnitudes of the terms. The quadrature of a jump
/// that runs obliquely through the grid of points below is good to about a thousandth.
const TOLERANCE: f64 = 0.005;

/// Longest patch, in times that a wave takes through the body: the points below must resolve it.
const WAVES: f64 = 4.0;

/// A box in space and time with the bump `phi = prod (1 - xi^2)^2` on it.
struct Patch {
    centre: Vec<f64>,
    half: Vec<f64>,
}

impl Patch {
    fn draw(random: &mut Random, problem: &Problem) -> Self {
        let low = problem.from.iter().chain([&0.0]);
        let high = problem.to.iter().chain([&problem.until]);
        let longest = problem.to.iter().map(|_| f64::INFINITY).chain([WAVES * crossing(problem)]);
        let (mut centre, mut half) = (Vec::new(), Vec::new());
        for ((low, high), longest) in low.zip(high).zip(longest) {
            let width = (high - low).min(longest) * random.between(0.2, 1.0);
            let start = low + (high - low - width) * random.unit();
            centre.push(start + 0.5 * width);
            half.push(0.5 * width);
        }
        Self { centre, half }
    }

    /// phi and its derivatives with respect to every coordinate and t at `xi` in (-1, 1)^(D+1).
    fn bump(&self, xi: &[f64]) -> (f64, Vec<f64>) {
        let factor = |x: f64| (1.0 - x * x) * (1.0 - x * x);
        let value = xi.iter().map(|x| factor(*x)).product();
        let slope = (0..xi.len()).map(|a| {
            let others: f64 = (0..xi.len()).filter(|b| *b != a).map(|b| factor(xi[b])).product();
            -4.0 * xi[a] * (1.0 - xi[a] * xi[a]) / self.half[a] * others
        });
        (value, slope.collect())
    }
}

/// Time that a wave takes through the body, on its longest axis.
fn crossing(problem: &Problem) -> f64 {
    let lengths = problem.from.iter().zip(&problem.to).map(|(from, to)| to - from);
    let longest = lengths.fold(0.0, f64::max);
    longest / (problem.equation.modulus() / problem.density).sqrt()
}

/// Checks the balance of momentum on [`PATCHES`] patches.
pub(super) fn momentum(problem: &Problem) -> Result<(), Violation> {
    let mut random = Random::new(6);
    for _ in 0..PATCHES {
        let patch = Patch::draw(&mut random, problem);
        for i in 0..problem.dimension() {
            balance(problem, &patch, i)?;
        }
    }
    Ok(())
}

fn balance(problem: &Problem, patch: &Patch, i: usize) -> Result<(), Violation> {
    let d = problem.dimension();
    let per_axis = [0, 64, 20, 10][d];
    let (mut gain, mut loss, mut size) = (0.0, 0.0, 0.0);
    for k in 0..usize::pow(per_axis, d as u32 + 1) {
        let mut rest = k;
        let xi: Vec<f64> = (0..=d)
            .map(|_| {
                let index = rest % per_axis;
                rest /= per_axis;
                (index as f64 + 0.5) / per_axis as f64 * 2.0 - 1.0
            })
            .collect();
        let at = |a: usize| patch.centre[a] + patch.half[a] * xi[a];
        let label: Vec<f64> = (0..d).map(at).collect();
        let now = problem.motion.derivatives(&label, at(d));
        let (inertia, stress, force) =
            integrand(problem, &now, i, (&label, at(d)), &patch.bump(&xi));
        gain -= inertia;
        loss += force - stress;
        size += inertia.abs() + stress.abs() + force.abs();
    }
    if (gain - loss).abs() <= TOLERANCE * size {
        return Ok(());
    }
    Err(Violation {
        condition: "momentum balance across wave fronts (the equation of motion in weak form; \
                    shares of the sum of all terms)"
            .to_owned(),
        label: patch.centre[..d].to_vec(),
        t: patch.centre[d],
        expected: Some(loss / size),
        found: gain / size,
        unit: "",
    })
}

/// The three terms of the weak form at one point.
fn integrand(
    problem: &Problem,
    now: &Derivatives,
    i: usize,
    (label, t): (&[f64], f64),
    (phi, slope): &(f64, Vec<f64>),
) -> (f64, f64, f64) {
    let d = problem.dimension();
    let inertia = problem.density * now.velocity[i] * slope[d];
    let piola = problem.equation.piola(&now.grad);
    let stress = (0..d).map(|j| piola[i][j] * slope[j]).sum();
    (inertia, stress, problem.density * problem.force(label, now, t)[i] * phi)
}
