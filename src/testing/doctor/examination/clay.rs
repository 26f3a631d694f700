//! Examination of modified Cam-clay along three strain paths: swelling, compression, and shear.
//!
//! The body is so heavy that its motion is prescribed. Paths end at states whose mean stress p and
//! deviatoric stress q follow from closed forms (Roscoe & Burland 1968), with the ratio of moduli
//! `r = G/K`:
//!
//! - swelling: `p = p0 exp(eps_v/kappa)` and `q = 2 r |p - p0|`, because G is proportional to p;
//! - every yielding state: `p + q^2/(M^2 p) = pc`, where `pc` has grown by the factor
//!   `exp(eps_p/(lambda - kappa))` and `eps_p = eps_v - kappa ln(p/p0)` is the plastic compaction;
//! - long shear: the critical state `q = M p`;
//! - long uniaxial compression: the constant ratio `q/p` of the K0 line.
//!
//! None of these relations depends on the scheme that integrates the law.

use super::{laws::deformation_gradient, paths};
use crate::exact::law::CamClayLaw;
use crate::mpm::det_of_rows;
use crate::testing::doctor::prelude::*;
use crate::testing::doctor::scene::{
    COMPRESSION_SLOPE, CRITICAL_STATE_SLOPE, OVERCONSOLIDATION, SWELLING_SLOPE,
};

pub(super) const EXAMINATION: Examination = Examination {
    name: "clay",
    expected: "Cam-clay swells along the swelling line with a shear modulus proportional to p; \
               when it yields, the stress is on a yield surface that grows with the plastic \
               compaction, and approaches the critical state in shear and the K0 line in \
               compression",
    after: &["translation", "force", "transfer", "stress", "laws"],
    covers: &["laws: cam_clay"],
    examine,
};

/// Number of steps. Explicit integration without substeps, drift correction or detection of the
/// yield point is of first order: its error of ln p on a swelling line is at most half the elastic
/// strain of a step over kappa, 0.8 %. A yield point that is passed by a whole step adds up to
/// 2.1 %.
const STEPS: u64 = 400;

/// Maximum error of the displacement gradient in the middle of the body, relative to its largest
/// entry. The motion of solvers that average velocities (PIC) is not uniform after 400 steps. With
/// a difference of 5 %, quadratic B-splines in 3-D have an error of 3 % in pc.
const NEAR_IN_MOTION: f64 = 0.06;

/// Initial mean stress (Pa).
const PRESSURE: f64 = 250.0;

/// Name and displacement gradient of each path. Swelling reduces p to 0.6 p0. Compression by 1.2
/// lambda ends within 0.1 % of the K0 line, and shear within 0.2 % of the critical state.
const PATHS: [(&str, [[f64; 3]; 3]); 3] = [
    ("swelling", [[0.000_511, 0.0, 0.0], [0.0; 3], [0.0; 3]]),
    ("compression", [[-0.006, 0.0, 0.0], [0.0; 3], [0.0; 3]]),
    ("shear", [[0.0, 0.007, 0.0], [0.0; 3], [0.0; 3]]),
];

/// Measured end of a path. Stresses are Kirchhoff stresses divided by the initial mean stress.
struct PathEnd {
    path: &'static str,
    dimension: usize,
    /// Ratio `G/K` of the shear and bulk modulus.
    ratio: f64,
    /// Logarithmic volume strain, positive in compression.
    compaction: f64,
    /// Deviatoric logarithmic strain.
    shear: f64,
    /// Mean stress, positive in compression.
    p: f64,
    /// Deviatoric stress `sqrt(3 J2)`.
    q: f64,
}

impl PathEnd {
    /// Measures the end of `course`, a run of `scene`, unless the body has left the path.
    fn measure(path: &'static str, scene: &BoxScene, course: &Course) -> Result<Self, Hindrance> {
        let d = scene.dimension;
        let f = deformation_gradient(course, scene);
        let slopes = scene.velocity.gradient;
        let largest = slopes.iter().flatten().fold(0.0, |most: f64, slope| most.max(slope.abs()));
        let identity = |i: usize, j: usize| f64::from(u8::from(i == j));
        let is_near = |k: usize| {
            let (i, j) = (k / d, k % d);
            (f[k] - identity(i, j) - slopes[i][j]).abs() <= NEAR_IN_MOTION * largest
        };
        if !(0..d * d).all(is_near) {
            return Err(Hindrance::Lacks(format!(
                "a velocity gradient that stays constant for {STEPS} steps (path: {path})"
            )));
        }
        let j = det_of_rows(d, &f);
        let stress = paths::in_middle(course, scene)?;
        let mut tau = [[0.0; 3]; 3];
        for (k, stress) in stress.iter().enumerate() {
            tau[k / d][k % d] = stress * j / scene.strength;
        }
        if d == 2 {
            // By symmetry, the third stress is the lateral one, and in simple shear the mean one.
            tau[2][2] = if path == "shear" { 0.5 * (tau[0][0] + tau[1][1]) } else { tau[1][1] };
        }
        let p = -(tau[0][0] + tau[1][1] + tau[2][2]) / 3.0;
        let mut squares = 0.0;
        for (i, row) in tau.iter().enumerate() {
            for (k, tau) in row.iter().enumerate() {
                let deviator = tau + p * identity(i, k);
                squares += deviator * deviator;
            }
        }
        let (lambda, mu) = scene.lame();
        let compaction = -libm::log(j);
        let shear = if path == "shear" {
            slopes[0][1].abs() / 3.0_f64.sqrt()
        } else {
            2.0 / 3.0 * compaction.abs()
        };
        let (ratio, q) = (mu / (lambda + 2.0 * mu / 3.0), (1.5 * squares).sqrt());
        Ok(Self { path, dimension: d, ratio, compaction, shear, p, q })
    }

    /// Returns the plastic compaction, according to the swelling line.
    fn plastic_compaction(&self) -> f64 {
        self.compaction - SWELLING_SLOPE * libm::log(self.p)
    }

    /// Returns the preconsolidation pressure of the yield surface through the stress, over p0.
    fn consolidation(&self) -> f64 {
        self.p + self.q * self.q / (CRITICAL_STATE_SLOPE * CRITICAL_STATE_SLOPE * self.p)
    }

    /// Returns the hardening slope that follows from the stress, `lambda - kappa` if it is correct.
    fn hardening_slope(&self) -> f64 {
        self.plastic_compaction() / libm::log(self.consolidation() / OVERCONSOLIDATION)
    }

    fn describe(&self, what: &str) -> String {
        let (Self { dimension, path, .. }, [p, q]) = (self, [self.p, self.q].map(shown));
        format!(
            "cam_clay in {dimension}-D, {path}: in the middle of the body, p/p0 is {p} and q/p0 is \
             {q}; {what}"
        )
    }
}

fn path(kind: Kind, gradient: &[[f64; 3]; 3]) -> BoxScene {
    BoxScene { strength: PRESSURE, ..paths::path(kind, gradient, STEPS) }
}

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = |kind: Kind| path(kind, &PATHS[0].1);
    // In one dimension the lateral stress is unknown, and so are p and q.
    let first = patient.able_with(&[2, 3], &["cam_clay"], &scene, &|needs| {
        needs.columns = vec!["stress"];
    })?;
    let scenes = PATHS.map(|(_, gradient)| path((first.dimension, first.law), &gradient));
    let end = |k: usize| {
        let mut problem = scenes[k].problem()?;
        // Only the last of the many states is needed.
        problem.instants = vec![STEPS];
        PathEnd::measure(PATHS[k].0, &scenes[k], &patient.run_problem(&scenes[k], problem)?)
    };
    let ends = [end(0)?, end(1)?, end(2)?];
    let texts = ends
        .each_ref()
        .map(|end| format!("p/p0 {} and q/p0 {} after {}", shown(end.p), shown(end.q), end.path));
    let measured = format!("cam_clay in {}-D: {}", first.dimension, texts.join(", "));
    Ok(Examined::new(measured, finding(&ends)))
}

/// Maximum relative error of p, q and pc: the sum of 2.1 % for explicit integration and 4 % for
/// solvers that do not follow the path exactly (`NEAR_IN_MOTION`), and a margin.
const NEAR: f64 = 0.08;

/// Maximum relative error of q/p at the critical state, where errors of the path have no effect.
const NEAR_AT_CRITICAL_STATE: f64 = 0.05;

/// Maximum relative error of pc in shear and of q/p on the K0 line, which are more sensitive to the
/// motion: a volume strain of 0.1 % of the shear strain changes p by 1 %.
const NEAR_ON_PATH: f64 = 0.12;

/// Whether `measured` agrees with `expected`. NaN does not.
fn is_near(measured: f64, expected: f64) -> bool {
    (measured - expected).abs() <= NEAR * expected.abs()
}

/// Computes the preconsolidation pressure over the initial mean stress after a plastic compaction.
fn hardened(compaction: f64, slope: f64) -> f64 {
    OVERCONSOLIDATION * libm::exp(compaction / slope)
}

/// Returns the first finding. Yielding states are examined only if elastic states are correct.
fn finding(ends: &[PathEnd; 3]) -> Option<SolverFinding> {
    let [swelling, compression, shear] = ends;
    of_swelling(swelling)
        .or_else(|| of_shear_modulus(swelling))
        .or_else(|| of_critical_state(shear))
        .or_else(|| of_hardening(compression, shear))
        .or_else(|| of_flow(compression))
}

fn of_swelling(end: &PathEnd) -> Option<SolverFinding> {
    let growth = end.compaction / SWELLING_SLOPE;
    let expected = libm::exp(growth);
    if is_near(end.p, expected) {
        return None;
    }
    let cause = if is_near(end.p, 1.0 + growth) {
        "the bulk modulus is that of the initial mean stress"
    } else if is_near(end.p, libm::exp(end.compaction / COMPRESSION_SLOPE)) {
        "the elastic strain has the slope lambda of the compression line"
    } else {
        "the mean stress does not follow the swelling line: another slope, a logarithm to the base \
         10, or an initial pressure that is ignored"
    };
    let slope = end.compaction / libm::log(end.p);
    let [expected, slope, kappa] = [expected, slope, SWELLING_SLOPE].map(shown);
    Some(SolverFinding::defect(
        "clay-swelling-slope",
        end.describe(&format!(
            "p/p0 = {expected} is expected; the slope of the swelling line is {slope}, expected \
             kappa = {kappa}"
        )),
        cause,
        "the bulk modulus K = p/kappa, with the current mean stress p and the logarithmic volume \
         strain, d eps_v = kappa dp/p",
    ))
}

fn of_shear_modulus(end: &PathEnd) -> Option<SolverFinding> {
    let expected = 2.0 * end.ratio * (end.p - 1.0).abs();
    if is_near(end.q, expected) {
        return None;
    }
    let initial = 3.0 * end.ratio / SWELLING_SLOPE * end.shear;
    let cause = if is_near(end.q, initial) {
        "the shear modulus is that of the initial mean stress"
    } else if is_near(end.q, initial * end.p) {
        "the deviator is the current shear modulus times the total elastic shear strain, instead \
         of the integral of its rate"
    } else {
        "the shear modulus is not the given fraction of the bulk modulus"
    };
    Some(SolverFinding::defect(
        "clay-shear-modulus",
        end.describe(&format!("q/p0 = {} is expected", shown(expected))),
        cause,
        "the shear modulus G = r p/kappa with r = 3 (1 - 2 nu)/(2 (1 + nu)), which follows the \
         current mean stress p",
    ))
}

fn of_critical_state(end: &PathEnd) -> Option<SolverFinding> {
    let slope = end.q / end.p;
    if (slope / CRITICAL_STATE_SLOPE - 1.0).abs() <= NEAR_AT_CRITICAL_STATE {
        return None;
    }
    let [slope, exact] = [slope, CRITICAL_STATE_SLOPE].map(shown);
    let seen = end.describe(&format!("q/p is {slope}, expected M = {exact} at the critical state"));
    if is_near(end.q, 3.0 * end.ratio / SWELLING_SLOPE * end.shear) {
        return Some(SolverFinding::defect(
            "clay-does-not-yield",
            seen,
            "the stress stays elastic beyond the yield surface",
            "the yield function q^2/M^2 + p (p - pc) with p positive in compression; the units of \
             pc",
        ));
    }
    Some(yield_surface(seen))
}

fn of_hardening(compression: &PathEnd, shear: &PathEnd) -> Option<SolverFinding> {
    let expected_slope = COMPRESSION_SLOPE - SWELLING_SLOPE;
    let expected = |end: &PathEnd| hardened(end.plastic_compaction(), expected_slope);
    let seen = |end: &PathEnd| {
        let [pc, wanted] = [end.consolidation(), expected(end)].map(shown);
        end.describe(&format!(
            "the yield surface through this stress has pc/p0 = {pc}, expected {wanted}"
        ))
    };
    let is_on_path =
        |measured: f64, expected: f64| (measured - expected).abs() <= NEAR_ON_PATH * expected;
    if is_near(compression.consolidation(), expected(compression)) {
        let is_wrong = !is_on_path(shear.consolidation(), expected(shear));
        return is_wrong.then(|| yield_surface(seen(shear)));
    }
    let slope = compression.hardening_slope();
    // The total volume strain may count from the start or from first yield, which is below pc.
    let total = compression.compaction - 0.5 * SWELLING_SLOPE * libm::log(OVERCONSOLIDATION);
    let cause = if is_near(compression.consolidation(), OVERCONSOLIDATION) {
        "the preconsolidation pressure is not updated".to_owned()
    } else if is_near(compression.consolidation(), hardened(total, expected_slope)) {
        "the preconsolidation pressure follows the total volume strain instead of the plastic \
         volume strain"
            .to_owned()
    } else if slope > 0.0
        && is_on_path(shear.consolidation(), hardened(shear.plastic_compaction(), slope))
    {
        let [slope, wanted, lambda, kappa] =
            [slope, expected_slope, COMPRESSION_SLOPE, SWELLING_SLOPE].map(shown);
        format!(
            "the preconsolidation pressure follows the plastic volume strain with the slope {slope} \
             instead of lambda - kappa = {wanted} (lambda = {lambda}, kappa = {kappa})"
        )
    } else {
        return Some(yield_surface(seen(compression)));
    };
    Some(SolverFinding::defect(
        "clay-hardening",
        seen(compression),
        &cause,
        "the hardening rule d pc/pc = d eps_v/(lambda - kappa) with the plastic part of the \
         logarithmic volume strain, applied in every step",
    ))
}

fn yield_surface(seen: String) -> SolverFinding {
    SolverFinding::defect(
        "clay-yield-surface",
        seen,
        "the stress is not on the yield surface: wrong slope M, wrong definition of q, another \
         yield function, or a return mapping that does not end on the surface",
        "the yield function q^2/M^2 + p (p - pc) with q = sqrt(3 J2) and p positive in \
         compression, which must be zero after every yielding step",
    )
}

fn of_flow(end: &PathEnd) -> Option<SolverFinding> {
    let (measured, expected) = (end.q / end.p, k0_ratio(end.ratio));
    if (measured - expected).abs() <= NEAR_ON_PATH * expected {
        return None;
    }
    let [measured, expected] = [measured, expected].map(shown);
    Some(SolverFinding::defect(
        "clay-flow-direction",
        end.describe(&format!("q/p is {measured}, expected {expected} on the K0 line")),
        "the stress is on the yield surface, but at the wrong point: the flow is not associated",
        "the flow direction, the gradient of the yield function: d eps_q/d eps_v = 2 q/(M^2 (2 p - \
         pc))",
    ))
}

/// Computes the ratio `q/p` of the K0 line from the ratio of moduli.
fn k0_ratio(ratio: f64) -> f64 {
    let poisson = (1.5 - ratio) / (3.0 + ratio);
    let slopes = [CRITICAL_STATE_SLOPE, SWELLING_SLOPE, COMPRESSION_SLOPE];
    let [critical, swelling, compression] = slopes;
    CamClayLaw::new(critical, swelling, compression, poisson, 1.0, OVERCONSOLIDATION).k0_ratio()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::doctor::examination::paths;
    use crate::testing::doctor::tests::{assert_found, rows};
    use approx::assert_relative_eq;

    /// Reference figure of an independent program, for M = 1.2, lambda = 5 kappa and r = 0.6.
    #[test]
    fn ratio_of_the_k0_line_matches_the_reference() {
        assert_relative_eq!(k0_ratio(0.6), 0.468_732_574_577, max_relative = 1e-11);
    }

    #[test]
    fn built_in_solver_approaches_the_critical_state() {
        const METHOD: &str = "basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian";
        let (name, gradient) = &PATHS[2];
        let scene = paths::path((2, "cam_clay"), gradient, STEPS / 10);
        let course = scene.built_in(METHOD).expect("a complete run");
        let Ok(end) = PathEnd::measure(name, &scene, &course) else { panic!("another motion") };
        // The closed form without the measured strain.
        let share = 1.0 - SWELLING_SLOPE / COMPRESSION_SLOPE;
        let critical = libm::pow(0.5 * OVERCONSOLIDATION, share);
        assert_relative_eq!(end.p, critical, max_relative = 0.002);
    }

    /// Integrates the rate equations along a path by the explicit Euler method, without correction
    /// of the drift from the yield surface and without detection of the yield point.
    fn integrate(path: &'static str, compaction: f64, shear: f64) -> PathEnd {
        let (lambda, mu) = paths::path((2, "cam_clay"), &[[0.0; 3]; 3], STEPS).lame();
        let ratio = mu / (lambda + 2.0 * mu / 3.0);
        let (strain, distortion) = (compaction / STEPS as f64, shear / STEPS as f64);
        let (mut p, mut q, mut pc) = (1.0_f64, 0.0_f64, OVERCONSOLIDATION);
        let m2 = CRITICAL_STATE_SLOPE * CRITICAL_STATE_SLOPE;
        for _ in 0..STEPS {
            let (bulk, modulus) = (p / SWELLING_SLOPE, ratio * p / SWELLING_SLOPE);
            // Derivatives of the yield function by p and q.
            let (by_p, by_q) = (2.0 * p - pc, 2.0 * q / m2);
            let load = by_p * bulk * strain + by_q * 3.0 * modulus * distortion;
            let mut multiplier = 0.0;
            if q * q / m2 + p * (p - pc) >= 0.0 && load > 0.0 {
                let elastic = by_p * bulk * by_p + by_q * 3.0 * modulus * by_q;
                let hardening = COMPRESSION_SLOPE - SWELLING_SLOPE;
                multiplier = load / (elastic + p * pc / hardening * by_p);
                pc *= libm::exp(multiplier * by_p / hardening);
            }
            p += bulk * (strain - multiplier * by_p);
            q += 3.0 * modulus * (distortion - multiplier * by_q);
        }
        PathEnd { path, dimension: 2, ratio, compaction, shear: shear.abs(), p, q: q.abs() }
    }

    #[test]
    fn explicit_integration_has_no_finding() {
        let ends = [0, 1].map(|k| {
            let compaction = -libm::log1p(PATHS[k].1[0][0]);
            integrate(PATHS[k].0, compaction, 2.0 / 3.0 * compaction)
        });
        let [swelling, compression] = ends;
        let shear = integrate("shear", 0.0, PATHS[2].1[0][1] / 3.0_f64.sqrt());
        assert_eq!(finding(&[swelling, compression, shear]), None);
    }

    /// Ends with the exact stresses for G/K = 0.75, multiplied by factors: of p and of q after
    /// swelling, of q/p and of pc after compression, and of q/p and of pc after shear.
    fn ends([p, q, k0, yields, slope, hardens]: [f64; 6]) -> [PathEnd; 3] {
        let end = |path, compaction: f64, shear, p, q| PathEnd {
            path,
            dimension: 2,
            ratio: 0.75,
            compaction,
            shear,
            p,
            q,
        };
        // The stress with this ratio q/p on the yield surface of size pc = 1.5 exp(eps_p/0.004).
        let on_surface = |path, compaction: f64, ratio: f64, factor: f64| {
            let mut p = 1.0;
            for _ in 0..100 {
                let plastic = compaction - 0.001 * libm::log(p);
                let pc = 1.5 * libm::exp(plastic / 0.004);
                p = libm::sqrt(p * factor * pc / (1.0 + ratio * ratio / 1.44));
            }
            end(path, compaction, 0.004, p, ratio * p)
        };
        let swelling = libm::exp(-0.511);
        [
            end(
                "swelling",
                -0.000_511,
                0.000_341,
                p * swelling,
                q * 1.5 * (p * swelling - 1.0).abs(),
            ),
            on_surface("compression", 0.006, k0 * k0_ratio(0.75), yields),
            on_surface("shear", 0.0, slope * 1.2, hardens),
        ]
    }

    /// Stresses just inside and just outside of each tolerance, and those of faults: constant
    /// moduli, other slopes, no yield, and hardening by other strains or with the slopes lambda and
    /// kappa.
    #[test]
    fn stresses_have_their_cause() {
        let table = "
1.07  0.93  0.89 0.93  0.96 0.89  |                     |
0.93  1.07  1.11 1.07  1.04 1.11  |                     |
1.09  1     1    1     1    1     | clay-swelling-slope | p/p0 is 0.6539 and
0.815 1     1    1     1    1     | clay-swelling-slope | is that of the initial mean stress
1.505 1     1    1     1    1     | clay-swelling-slope | slope lambda
1     1.09  1    1     1    1     | clay-shear-modulus  | q/p0 = 0.6002 is expected
1     1.277 1    1     1    1     | clay-shear-modulus  | is that of the initial mean stress
1     0.766 1    1     1    1     | clay-shear-modulus  | the total elastic shear strain
1     0.5   1    1     1    1     | clay-shear-modulus  | fraction of the bulk modulus
1     1     1    1     7.5  38.17 | clay-does-not-yield | elastic beyond
1     1     1    1     0.94 1     | clay-yield-surface  | q/p is 1.128, expected M = 1.200
1     1     1    1     1    0.87  | clay-yield-surface  | shear: in the middle
1     1     1    1.09  1    0.8   | clay-yield-surface  | compression: in the middle
1     1     1    1.09  1    1     | clay-hardening      | expected 
1     1     1    0.238 1    1     | clay-hardening      | is not updated
1     1     1    1.459 1    1     | clay-hardening      | total volume strain
1     1     1    0.787 1    0.988 | clay-hardening      | with the slope 0.0050
1     1     1    8.5   1    1.114 | clay-hardening      | with the slope 0.001
1     1     1.13 1     1    1     | clay-flow-direction | on the K0 line. the stress is on
NaN   1     1    1     1    1     | clay-swelling-slope |
1     1     1    NaN   1    1     | clay-yield-surface  |
";
        for (factors, name, text) in rows(table) {
            assert_found(&Examined::new(String::new(), finding(&ends(factors))), name, text);
        }
    }
}
