//! Examination of two bodies with different laws and densities that do not touch.
//!
//! Each body stretches as in `stress`, and the momentum flux through its middle gives its modulus.

use super::stress::{STEPS, TRAVEL, moduli_by_momentum, spreading};
use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "bodies",
    expected: "two bodies that do not touch have the stresses of their own law and density",
    after: &["translation", "transfer", "stress"],
    covers: &["several_bodies"],
    examine,
};

/// Young's modulus and density of the second body, relative to the first body.
const STIFFER: f64 = 2.6;
const HEAVIER: f64 = 1.5;

/// Moduli are accurate to 3 %, as in `stress`.
const RULES: Rules<2> = Rules {
    quantities: [("modulus of the first body", 1.0, 0.1), ("of the second body", 1.0, 0.1)],
    findings: &[
        (
            "one-law-for-all-bodies",
            [1.0, 1.0 / STIFFER],
            "the second body has the parameters of the first body",
        ),
        (
            "one-law-for-all-bodies",
            [STIFFER, 1.0],
            "the first body has the parameters of the last body",
        ),
        (
            "one-density-for-all-bodies",
            [1.0, HEAVIER],
            "the second body has the density of the first body",
        ),
        (
            "one-density-for-all-bodies",
            [1.0 / HEAVIER, 1.0],
            "the first body has the density of the last body",
        ),
        (
            "one-material-for-all-bodies",
            [1.0, HEAVIER / STIFFER],
            "the second body has the law and the density of the first body",
        ),
        (
            "one-material-for-all-bodies",
            [STIFFER / HEAVIER, 1.0],
            "the first body has the law and the density of the last body",
        ),
        ("bodies-differ", [ANY; 2], "the bodies do not have their own moduli and densities"),
    ],
    look_at: "`materials` of the problem, which has one entry for each body, and `body` of \
              `particles`, the index of the entry; masses are those of `particles`",
};

fn scene(kind: Kind) -> BoxScene {
    let mut first = spreading(kind);
    let mut second = first.clone();
    (second.young, second.density) = (STIFFER * first.young, HEAVIER * first.density);
    let shift = 16.0 * first.h;
    let moved = [&mut second.body.0[0], &mut second.body.1[0], &mut second.velocity.centre[0]];
    moved.into_iter().chain([&mut first.grid.1[0]]).for_each(|x| *x += shift);
    // Waves are faster in the second body.
    first.dt = second.clone().with_waves(TRAVEL, STEPS).dt;
    first.extras.second = Some(Box::new(second));
    first
}

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 1, 3], &ELASTIC, &scene)?;
    let second = scene.extras.second.clone();
    let mut soft = scene.soft();
    soft.extras.second = second.as_ref().map(|second| Box::new(second.soft()));
    let courses = patient.run_all(&[scene.clone(), soft])?;
    let modulus = |body: &BoxScene| {
        let [course, soft] = [0, 1].map(|run| {
            let mut course = courses[run].within(&body.body);
            course.start(&body.displacement, &body.velocity);
            course
        });
        let (lambda, mu) = body.lame();
        let measured = moduli_by_momentum(&course, Some(&soft), body).along;
        Some(measured / (lambda + 2.0 * mu))
    };
    let row: Row<2> = (
        "divided by the moduli of the problem".to_owned(),
        [modulus(&scene), second.and_then(|second| modulus(&second))],
    );
    Ok(RULES.judge(&[row]))
}
