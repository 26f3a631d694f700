//! Mistakes that give certain moduli.

use super::measure::SeenModuli;
use crate::testing::doctor::course::shown;
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::scene::BoxScene;

/// Share of the largest modulus by which one may be off, and that by which it may be off besides
/// where momentum spreads as well.
const NEAR: f64 = 0.03;
const SPREAD: f64 = 0.1;

/// A mistake: its name, the moduli along, across and of shear that it gives, its cause, and where
/// to look.
type Mistake = (&'static str, [f64; 3], &'static str, &'static str);

/// The mistake that gives these moduli, if they are not those of the law.
pub(super) fn cause(scene: &BoxScene, seen: &SeenModuli) -> Option<SolverFinding> {
    let near = NEAR + SPREAD * seen.spread;
    let (lambda, mu) = scene.lame();
    let whole = lambda + 2.0 * mu;
    let shear = 0.5 * (seen.shear[0] + seen.shear[1]);
    let found = [seen.along, seen.across, shear];
    let count = if scene.dimension > 1 { 3 } else { 1 };
    let are = |wanted: [f64; 3], scale: f64| {
        (0..count).all(|k| (found[k] - wanted[k]).abs() <= near * scale)
    };
    let words = format!(
        "moduli are {} of those of the law",
        (0..count).map(|k| shown(found[k] / [whole, lambda, mu][k])).collect::<Vec<_>>().join(", ")
    );
    let report = |name: &'static str, cause: &str, look_at: &str| {
        Some(SolverFinding::defect(name, words.clone(), cause, look_at))
    };
    if count == 3 && !((seen.shear[0] - seen.shear[1]).abs() <= near * whole) {
        return report(
            "stress-not-symmetric",
            "shear forces along the two axes differ",
            "the strain rate is the symmetric part of the velocity gradient, half of it and its \
             transpose; the order of indices in sigma times the gradient of a weight",
        );
    }
    if are([whole, lambda, mu], whole) {
        return None;
    }
    if are([0.0; 3], whole) {
        return report(
            "stress-missing",
            "stresses have no effect on the motion",
            "inner forces -V sigma grad N at nodes; the update of stress; the law and its parameters",
        );
    }
    let mistakes = mistakes(scene.young, scene.poisson, lambda, mu);
    if let Some((name, _, cause, look_at)) = mistakes.iter().find(|(_, m, ..)| are(*m, whole)) {
        return report(name, cause, look_at);
    }
    let factor = found[0] / whole;
    if are([whole, lambda, mu].map(|modulus| factor * modulus), factor.abs() * whole) {
        return Some(scaled(scene, factor, words));
    }
    report(
        "moduli-differ",
        "the law is another one, or its parameters are computed otherwise",
        "lambda = E nu/((1 + nu)(1 - 2 nu)) and mu = E/(2 (1 + nu)); two dimensions mean plane \
         strain, one means uniaxial strain",
    )
}

fn mistakes(young: f64, poisson: f64, lambda: f64, mu: f64) -> Vec<Mistake> {
    let parameters = "the Lame parameters: lambda = E nu/((1 + nu)(1 - 2 nu)), mu = E/(2 (1 + nu)), and \
                      where each of them stands in the law";
    let plane = young / (1.0 - poisson * poisson);
    let bulk = lambda + 2.0 * mu / 3.0;
    vec![
        (
            "plane-stress",
            [plane, poisson * plane, mu],
            "the law is that of plane stress",
            "two dimensions mean plane strain: no strain along the third axis, and stress there",
        ),
        (
            "poisson-ratio-ignored",
            [young, 0.0, mu],
            "Poisson's ratio has no effect: E times strain",
            "one dimension means uniaxial strain: the modulus is lambda + 2 mu and not E",
        ),
        (
            "lame-parameters-exchanged",
            [mu + 2.0 * lambda, mu, lambda],
            "lambda and mu are exchanged",
            parameters,
        ),
        (
            "bulk-modulus-for-lambda",
            [bulk + 2.0 * mu, bulk, mu],
            "the bulk modulus stands where lambda should",
            parameters,
        ),
        ("volume-term-missing", [2.0 * mu, 0.0, mu], "the term with lambda is missing", parameters),
        (
            "shear-doubled",
            [lambda + 2.0 * mu, lambda, 2.0 * mu],
            "shear stress is twice what it should be: 2 mu times the engineering strain",
            "the shear strain is half the sum of the two gradients",
        ),
        (
            "shear-halved",
            [lambda + 2.0 * mu, lambda, 0.5 * mu],
            "shear stress is half what it should be: mu times the tensor's strain",
            "sigma_xy = 2 mu eps_xy = mu (dv_x/dy + dv_y/dx) dt",
        ),
        (
            "mu-doubled",
            [lambda + 4.0 * mu, lambda, 2.0 * mu],
            "mu is twice what it should be: E/(1 + nu) stands for it",
            parameters,
        ),
        ("mu-halved", [lambda + mu, lambda, 0.5 * mu], "mu stands where 2 mu should", parameters),
    ]
}

/// All moduli with the same factor.
fn scaled(scene: &BoxScene, factor: f64, words: String) -> SolverFinding {
    let is = |wanted: f64| (factor / wanted - 1.0).abs() <= NEAR;
    let cell = (0..scene.dimension).fold(1.0, |volume, _| volume * scene.h);
    let particles = f64::from(1_i32 << scene.dimension);
    if is(-1.0) {
        return SolverFinding::defect(
            "stress-sign",
            words,
            "inner forces have the other sign: a body that is stretched flies apart",
            "f = -V sigma grad N; a sign convention in which compression is positive",
        );
    }
    let candidates = [
        (scene.density, "the density is missing in the mass, or taken as one"),
        (1.0 / scene.density, "forces are divided by the density once more"),
        (particles, "each particle has the volume of a whole cell"),
        (1.0 / particles, "volumes are divided by the particles per cell twice"),
        (cell, "volumes or masses have a cell's volume too much"),
        (1.0 / scene.h, "gradients are divided by h once more"),
        (scene.h, "gradients are not divided by h"),
        (2.0, "forces count twice, or the strain rate is not halved"),
        (0.5, "forces count half"),
        (1e3, "a unit is kPa, or g"),
        (1e-3, "a unit is kPa, or g"),
        (1e6, "a unit is MPa, or mm with t"),
        (1e-6, "a unit is MPa, or mm with t"),
    ];
    let known = candidates.into_iter().find(|(wanted, _)| is(*wanted));
    let cause = known.map_or("all of it is multiplied by one number", |(_, cause)| cause);
    SolverFinding::defect(
        "stress-scaled",
        words,
        cause,
        "volumes of particles (those of the problem), masses, the factor h of gradients, units of \
         Young's modulus (Pa)",
    )
}
