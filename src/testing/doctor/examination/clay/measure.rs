//! Runs along a path, and the measured state at the end.

use crate::mpm::det_of_rows;
use crate::testing::doctor::examination::{laws::deformation_gradient, paths};
use crate::testing::doctor::prelude::*;
use crate::testing::doctor::scene::{CRITICAL_STATE_SLOPE, OVERCONSOLIDATION, SWELLING_SLOPE};

/// Number of steps. Explicit integration without substeps, drift correction or detection of the
/// yield point is of first order: its error of ln p on a swelling line is at most half the elastic
/// strain of a step over kappa, 0.8 %. A yield point that is passed by a whole step adds up to
/// 2.1 %.
pub(super) const STEPS: u64 = 400;

/// Maximum error of the displacement gradient in the middle of the body, relative to its largest
/// entry. The motion of solvers that average velocities (PIC) is not uniform after 400 steps. With
/// a difference of 5 %, quadratic B-splines in 3-D have an error of 3 % in pc.
const NEAR_IN_MOTION: f64 = 0.06;

/// Initial mean stress (Pa).
const PRESSURE: f64 = 250.0;

/// Name and displacement gradient of each path. Swelling reduces p to 0.6 p0. Compression by 1.2
/// lambda ends within 0.1 % of the K0 line, and shear within 0.2 % of the critical state.
pub(super) const PATHS: [(&str, [[f64; 3]; 3]); 3] = [
    ("swelling", [[0.000_511, 0.0, 0.0], [0.0; 3], [0.0; 3]]),
    ("compression", [[-0.006, 0.0, 0.0], [0.0; 3], [0.0; 3]]),
    ("shear", [[0.0, 0.007, 0.0], [0.0; 3], [0.0; 3]]),
];

/// Measured end of a path. Stresses are Kirchhoff stresses divided by the initial mean stress.
pub(super) struct PathEnd {
    pub(super) path: &'static str,
    pub(super) dimension: usize,
    /// Ratio `G/K` of the shear and bulk modulus.
    pub(super) ratio: f64,
    /// Logarithmic volume strain, positive in compression.
    pub(super) compaction: f64,
    /// Deviatoric logarithmic strain.
    pub(super) shear: f64,
    /// Mean stress, positive in compression.
    pub(super) p: f64,
    /// Deviatoric stress `sqrt(3 J2)`.
    pub(super) q: f64,
}

impl PathEnd {
    /// Computes the values in the middle of the body at the end of `course`, a run of `scene`.
    /// Returns an error if the body has not followed the path.
    pub(super) fn measure(
        path: &'static str,
        scene: &BoxScene,
        course: &Course,
    ) -> Result<Self, Hindrance> {
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
    pub(super) fn plastic_compaction(&self) -> f64 {
        self.compaction - SWELLING_SLOPE * libm::log(self.p)
    }

    /// Returns the preconsolidation pressure of the yield surface through the stress, over p0.
    pub(super) fn consolidation(&self) -> f64 {
        self.p + self.q * self.q / (CRITICAL_STATE_SLOPE * CRITICAL_STATE_SLOPE * self.p)
    }

    /// Returns the hardening slope that follows from the stress, `lambda - kappa` if it is correct.
    pub(super) fn hardening_slope(&self) -> f64 {
        self.plastic_compaction() / libm::log(self.consolidation() / OVERCONSOLIDATION)
    }

    pub(super) fn describe(&self, what: &str) -> String {
        let (Self { dimension, path, .. }, [p, q]) = (self, [self.p, self.q].map(shown));
        format!(
            "cam_clay in {dimension}-D, {path}: in the middle of the body, p/p0 is {p} and q/p0 is \
             {q}; {what}"
        )
    }
}

pub(super) fn path(kind: Kind, gradient: &[[f64; 3]; 3]) -> BoxScene {
    BoxScene { strength: PRESSURE, ..paths::path(kind, gradient, STEPS) }
}
