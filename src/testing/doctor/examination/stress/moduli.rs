//! Recognises defects from the measured moduli.

use super::measure::{MeasuredModuli, NEAR as NEAR_FACTOR, factor as column_factor, strain_factor};
use crate::testing::doctor::prelude::*;

/// Maximum difference between moduli, relative to the largest modulus.
const NEAR: f64 = 0.03;

/// Value added to [`NEAR`] if averaging transfers as much momentum as stress.
const AVERAGED: f64 = 0.06;

/// A defect: name, moduli that it causes (longitudinal, lateral, shear), cause, and code to check.
type Mistake = (&'static str, [f64; 3], &'static str, &'static str);

pub(super) fn cause(
    course: &Course,
    scene: &BoxScene,
    measured: &MeasuredModuli,
) -> Option<SolverFinding> {
    let (lambda, mu) = scene.lame();
    let whole = lambda + 2.0 * mu;
    let shear = 0.5 * (measured.shear[0] + measured.shear[1]);
    let moduli = [measured.along, measured.across, shear];
    let count = if scene.dimension > 1 { 3 } else { 1 };
    let near = NEAR + AVERAGED * measured.averaged_share + measured.sampling_error;
    let are = |wanted: [f64; 3], scale: f64| {
        (0..count).all(|k| (moduli[k] - wanted[k]).abs() <= near * scale)
    };
    let ratios = (0..count).map(|k| shown(moduli[k] / [whole, lambda, mu][k]));
    let (d, ratios) = (scene.dimension, ratios.collect::<Vec<_>>().join(", "));
    let seen = format!(
        "in {d}-D, the measured moduli divided by those of the law are {ratios} (along the stretch; \
         in 2-D and 3-D also across the stretch and in shear)"
    );
    let report = |name: &'static str, cause: &str, look_at: &str| {
        Some(SolverFinding::defect(name, seen.clone(), cause, look_at))
    };
    if count == 3 && !((measured.shear[0] - measured.shear[1]).abs() <= near * whole) {
        return report(
            "stress-not-symmetric",
            "the shear forces along the two axes differ, so the stress is not symmetric",
            "the strain rate, which is the symmetric part of the velocity gradient, (L + L^T)/2; \
             the order of indices in sigma times the gradient of a weight",
        );
    }
    if are([whole, lambda, mu], whole) {
        return None;
    }
    let factor = moduli[0] / whole;
    let is_scaled = are([whole, lambda, mu].map(|modulus| factor * modulus), factor.abs() * whole);
    if is_scaled && factor.abs() > 1e-7 && factor.abs() <= near {
        return Some(scaled(course, scene, factor, seen));
    }
    if are([0.0; 3], whole) {
        return report(
            "stress-missing",
            "stresses have no effect on the motion",
            "the internal forces at nodes, -V sigma grad N; the update of stress; the law and its \
             parameters",
        );
    }
    let mistakes = mistakes(scene, lambda, mu);
    if let Some((name, _, cause, look_at)) = mistakes.iter().find(|(_, m, ..)| are(*m, whole)) {
        return report(name, cause, look_at);
    }
    if is_scaled {
        return Some(scaled(course, scene, factor, seen));
    }
    report(
        "moduli-differ",
        "the law is different, or its parameters are computed differently",
        "lambda = E nu/((1 + nu)(1 - 2 nu)) and mu = E/(2 (1 + nu)); two dimensions mean plane \
         strain, and one dimension means uniaxial strain",
    )
}

fn mistakes(scene: &BoxScene, lambda: f64, mu: f64) -> Vec<Mistake> {
    let (young, poisson) = (scene.young, scene.poisson);
    let parameters = "the Lame parameters, lambda = E nu/((1 + nu)(1 - 2 nu)) and mu = E/(2 (1 + \
                      nu)), and the place of each parameter in the law";
    let plane = young / (1.0 - poisson * poisson);
    let bulk = lambda + 2.0 * mu / 3.0;
    let mut all = vec![
        (
            "plane-stress",
            [plane, poisson * plane, mu],
            "the solver uses the law of plane stress",
            "the plane state: two dimensions mean plane strain. The strain along the third axis is \
             zero, but the stress is not",
        ),
        (
            "poisson-ratio-ignored",
            [young, 0.0, mu],
            "Poisson's ratio has no effect: the stress is E times the strain",
            "the modulus in one dimension, which means uniaxial strain: lambda + 2 mu, not E",
        ),
        (
            "poisson-ratio-ignored",
            [young, 0.0, 0.5 * young],
            "the solver uses zero for Poisson's ratio",
            parameters,
        ),
        (
            "shear-missing",
            [lambda + 2.0 * mu, lambda, 0.0],
            "shear strains cause no stress",
            "the off-diagonal components of the strain rate",
        ),
        (
            "lame-parameters-exchanged",
            [mu + 2.0 * lambda, mu, lambda],
            "lambda and mu are swapped",
            parameters,
        ),
        (
            "bulk-modulus-for-lambda",
            [bulk + 2.0 * mu, bulk, mu],
            "the bulk modulus is used in place of lambda",
            parameters,
        ),
        ("volume-term-missing", [2.0 * mu, 0.0, mu], "the term with lambda is missing", parameters),
        (
            "shear-doubled",
            [lambda + 2.0 * mu, lambda, 2.0 * mu],
            "the shear stress is twice the expected one: 2 mu times the engineering shear strain",
            "the shear strain, which is half the sum of the two gradients",
        ),
        (
            "shear-halved",
            [lambda + 2.0 * mu, lambda, 0.5 * mu],
            "the shear stress is half the expected one: mu times the tensor shear strain",
            "the shear stress: sigma_xy = 2 mu eps_xy = mu (dv_x/dy + dv_y/dx) dt",
        ),
        (
            "mu-doubled",
            [lambda + 4.0 * mu, lambda, 2.0 * mu],
            "mu is twice the expected one: the solver uses E/(1 + nu)",
            parameters,
        ),
        ("mu-halved", [lambda + mu, lambda, 0.5 * mu], "mu is used in place of 2 mu", parameters),
    ];
    if scene.dimension == 2 {
        all.push((
            "plane-deviator",
            [bulk + mu, bulk - mu, mu],
            "the deviator is computed in two dimensions, but the bulk modulus is the \
             three-dimensional one",
            "the deviator, which subtracts a third of the trace of the strain, also in plane \
             strain",
        ));
    }
    all
}

/// Returns the finding for moduli that are all wrong by the same `factor`. The columns `stress` and
/// `deformation_gradient` show whether the modulus, the gradients, or the mass or volume is wrong.
fn scaled(course: &Course, scene: &BoxScene, factor: f64, seen: String) -> SolverFinding {
    let is = |wanted: f64| (factor / wanted - 1.0).abs() <= NEAR;
    if is(-1.0) {
        return SolverFinding::defect(
            "stress-sign",
            seen,
            "the internal forces have the wrong sign: a stretched body flies apart",
            "the internal force f = -V sigma grad N; a sign convention with positive compression",
        );
    }
    let mistake = factors(scene).into_iter().find(|(wanted, _)| is(*wanted));
    let column = column_factor(course, scene);
    let is_right = column.is_some_and(|column| (column - 1.0).abs() <= 0.25 * (factor - 1.0).abs());
    let is_alike = column.is_some_and(|column| (column / factor - 1.0).abs() <= NEAR_FACTOR);
    let strain = strain_factor(course, scene);
    let is_strain = strain.is_some_and(|strain| {
        let is_off = (strain - 1.0).abs() > 0.5 * (factor - 1.0).abs();
        is_off && (strain / factor - 1.0).abs() <= NEAR
    });
    let [shown_factor, inverse] = [factor, 1.0 / factor].map(shown);
    let (name, what, look_at) = if is_alike && is_strain {
        (
            "velocity-gradient-scaled",
            format!(
                "F - I and the stress are {shown_factor} times the expected values: velocity \
                 gradients are wrong by this factor"
            ),
            "the factor 1/h in the gradients of basis functions; in MLS-MPM, the factor of the \
             affine matrix C, which is 4/h^2 for quadratic and 3/h^2 for cubic B-splines; the time \
             step in F <- (I + dt L) F",
        )
    } else if is_right {
        (
            "mass-or-volume-scaled",
            format!(
                "the column `stress` is correct, but accelerations are {shown_factor} times the \
                 expected ones: masses are wrong by a factor of {inverse}, or volumes by a factor \
                 of {shown_factor}"
            ),
            "the masses and volumes of particles, which must be those of the problem, not computed \
             from h or from the number of particles along an edge; the factor 1/h of gradients in \
             forces",
        )
    } else if is_alike {
        (
            "stress-scaled",
            format!(
                "the column `stress` and the accelerations are {shown_factor} times the expected ones"
            ),
            "Young's modulus and its unit (Pa); the strain; the factor 1/h of velocity gradients; \
             if `transfer` reports `momentum-spreads`, the factor of the affine matrix C",
        )
    } else {
        (
            "stress-scaled",
            format!(
                "accelerations due to stress are {shown_factor} times the expected ones: the \
                 modulus or the volumes are wrong by this factor, or the masses by its inverse"
            ),
            "the volumes and masses of particles, which must be those of the problem; the factor \
             1/h of gradients; the unit of Young's modulus (Pa)",
        )
    };
    let mistake = mistake.map(|(_, mistake)| format!(". Possible mistake: {mistake}"));
    SolverFinding::defect(name, seen, &(what + &mistake.unwrap_or_default()), look_at)
}

/// Returns the factors by which known mistakes change accelerations; no two are equal.
fn factors(scene: &BoxScene) -> Vec<(f64, &'static str)> {
    let d = scene.dimension as u32;
    let (h, particles) = (scene.h, scene.ppc.pow(d) as f64);
    let cell = (0..d).fold(1.0, |volume, _| volume * h);
    let mut factors = vec![
        (scene.density, "the density is missing in the mass, or set to one"),
        (1.0 / scene.density, "forces are divided by the density a second time"),
        (
            particles,
            "each particle has the volume of a whole cell, or its mass is divided by the number of \
             particles per cell",
        ),
        (1.0 / particles, "each particle has the mass of a whole cell"),
        (1.0 / h, "gradients are divided by h twice"),
        (h, "gradients are not divided by h"),
        (2.0, "forces are added twice, or the strain rate is not halved"),
        (0.5, "forces are halved"),
        (10.0, "mass or modulus is wrong by a factor of ten"),
        (0.1, "mass or modulus is wrong by a factor of ten"),
        (1e3, "a stress is in kPa, or a mass in g"),
        (1e-3, "a stress is in kPa, or a mass in g"),
        (1e6, "a stress is in MPa, or lengths are in mm and masses in t"),
        (1e-6, "a stress is in MPa, or lengths are in mm and masses in t"),
    ];
    if d == 2 {
        factors.push((
            cell,
            "volumes are multiplied by the volume of a cell, or gradients in strains and in forces \
             are not divided by h",
        ));
    } else {
        factors.push((h * h, "gradients in strains and in forces are not divided by h"));
    }
    if d == 3 {
        factors.push((cell, "volumes are multiplied by the volume of a cell"));
    }
    if d > 1 {
        factors.push((1.0 / cell, "masses are multiplied by the volume of a cell"));
    }
    factors
}

#[cfg(test)]
mod tests {
    use super::super::spreading;
    use super::*;

    #[test]
    fn no_two_causes_give_the_same_factor() {
        for d in 1..=3 {
            let scene = spreading((d, "neo_hookean"));
            let factors = factors(&scene);
            for (k, (one, _)) in factors.iter().enumerate() {
                for (other, cause) in &factors[..k] {
                    assert!((one / other - 1.0).abs() > 2.0 * NEAR, "{d}-D: {one}, {cause}");
                }
            }
        }
    }

    /// Cells have 0.15 m, and 3 particles along each axis, or 2 in 3-D. The density is 1.7 kg/m3.
    #[test]
    fn factor_has_its_cause() {
        for (d, factor, cause) in [
            (2, 1.7, "the density is missing"),
            (2, 0.588, "divided by the density a second time"),
            (1, 3.0, "the volume of a whole cell"),
            (2, 9.0, "the volume of a whole cell"),
            (3, 8.0, "the volume of a whole cell"),
            (2, 0.111, "the mass of a whole cell"),
            (2, 6.667, "gradients are divided by h twice"),
            (2, 0.15, "gradients are not divided by h"),
            (2, 2.0, "forces are added twice"),
            (2, 0.5, "forces are halved"),
            (2, 10.0, "wrong by a factor of ten"),
            (2, 0.1, "wrong by a factor of ten"),
            (2, 1e3, "in kPa"),
            (2, 1e-3, "in kPa"),
            (2, 1e6, "in MPa"),
            (2, 1e-6, "in MPa"),
            (2, 0.0225, "volumes are multiplied by the volume of a cell, or gradients in strains"),
            (1, 0.0225, "gradients in strains and in forces are not divided by h"),
            (3, 0.0225, "gradients in strains and in forces are not divided by h"),
            (3, 0.003_375, "volumes are multiplied by the volume of a cell"),
            (2, 44.44, "masses are multiplied by the volume of a cell"),
            (3, 296.3, "masses are multiplied by the volume of a cell"),
        ] {
            let all = factors(&spreading((d, "neo_hookean")));
            let found = all.iter().find(|(wanted, _)| (factor / wanted - 1.0).abs() < 0.003);
            let found = found.map(|(_, cause)| *cause).unwrap_or_default();
            assert!(found.contains(cause), "{d}-D, {factor}: {found}");
        }
    }
}
