//! Examination of one problem in different units of length, time and mass.

use super::faces::position_rounding;
use super::stress::spreading;
use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "units",
    expected: "multiplying all lengths or all times by a thousandth, or all masses by 1e-12, \
               changes only the units of the answer",
    after: &["translation", "faces", "force", "transfer", "stress"],
    covers: &[],
    examine,
};

/// Factor for other units. It is a power of two, so scaling does not even change rounding errors.
const THOUSANDTH: f64 = 1.0 / 1024.0;

/// Maximum ratio of the change of displacements to the rounding errors of positions, if rounding is
/// the cause.
const GROWTH: f64 = 100.0;
const TINY: f64 = THOUSANDTH * THOUSANDTH * THOUSANDTH * THOUSANDTH;

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 3, 1], &ELASTIC, &spreading)?;
    let plain = complete(patient.run(&scene)?)?;
    let most = patient.tolerance(1e-6, 0.02);
    let (mut measured, mut spoiled) = (Vec::new(), Vec::new());
    for (what, length, time, mass) in [
        ("lengths", THOUSANDTH, 1.0, 1.0),
        ("times", 1.0, THOUSANDTH, 1.0),
        ("masses", 1.0, 1.0, TINY),
    ] {
        let other = scene.scaled(length, time, mass);
        let off = match patient.run(&other) {
            Ok(scaled) if scaled.failure.is_none() => difference(&plain, &scaled, length),
            Ok(_) | Err(Hindrance::Broke(_)) => f64::INFINITY,
            Err(lacks) => return Err(lacks),
        };
        measured.push(format!("{what}: {}", shown(off)));
        if off <= most {
            continue;
        }
        let moved = length * plain.farthest(displacement, plain.last(), [0.0; 3]);
        let rounding = position_rounding(patient, &other).unwrap_or(f64::NAN) / moved;
        if !(off <= GROWTH * rounding) {
            let (off, rounding) = (shown(off), shown(rounding));
            spoiled.push(format!("{what} (by {off}; rounding of the positions: {rounding})"));
        }
    }
    let measured =
        format!("relative change of the displacements with small {}", measured.join(", "));
    let finding = (!spoiled.is_empty()).then(|| {
        let names = spoiled.join(" and ");
        SolverFinding::defect(
            "depends-on-units",
            format!("the same problem gives a different motion with small {names}"),
            "the code contains a constant with a unit, such as a threshold on mass, length or time",
            "comparisons with constants like 1e-12 (nodes with little mass, cells, times), which \
             must be relative to a mass, length or time of the problem; constants such as 9.81; \
             output with few digits",
        )
    });
    Ok(Examined::new(measured, finding))
}

/// Returns the largest difference of final displacements, relative to the largest displacement.
fn difference(plain: &Course, scaled: &Course, length: f64) -> f64 {
    let last = plain.last();
    let (a, b) = (&plain.states[last].displacement, &scaled.states[last].displacement);
    let pairs = a.iter().zip(b).map(|(a, b)| (a - b / length).abs());
    pairs.fold(0.0, f64::max) / plain.farthest(displacement, last, [0.0; 3])
}
