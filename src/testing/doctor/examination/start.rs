//! Examination of a body that starts deformed and stressed, and is released.
//!
//! The displacement is a simple shear, so F and the stress are uniform. Until waves arrive from the
//! free faces, component j of the momentum above a reference plane of area A with normal i changes
//! at the rate `-P_ji A`, where P is the initial first Piola-Kirchhoff stress.

use super::start_gradient;
use super::stress::{STEPS, TRAVEL, constant_and_rate, impulses, inside, require_whole_body};
use crate::external::SMALL_STRAIN;
use crate::mpm::det_of_rows;
use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "start",
    expected: "a body that starts with a displacement, F and stress is at the positions of the \
               problem, and the stress accelerates the body from the first step on",
    after: &["translation", "force", "transfer", "stress", "laws"],
    covers: &[
        "initial_deformation",
        "initial_stress",
        "laws: small_strain",
        "laws: linear_elastic",
        "laws: neo_hookean",
        "laws: corotated",
        "laws: hencky",
    ],
    examine,
};

/// Initial shear. A shear of one maps the square lattice to a square lattice, with equally many
/// particles in all cells. Unequal numbers reduce the force by a tenth with linear functions.
const SHEAR: f64 = 1.0;

/// Initial displacement gradient of a one-dimensional body.
const STRETCH: f64 = 0.05;

/// Factor for the initial displacement gradient of a solver with the small-strain law.
const SMALL: f64 = 1e-3;

/// Position of the body. No particle of the deformed lattice is close to a cell face.
#[derive(Clone, Copy)]
struct BodyPlacement {
    /// Offset (cells) of the sheared body from a node.
    sheared: [f64; 3],
    /// Offset (cells) of the stretched body from a node.
    stretched: [f64; 3],
    /// Number of cells along an axis, by dimension.
    cells: [f64; 3],
    steps: u64,
}

const PLACEMENTS: [BodyPlacement; 3] = [
    BodyPlacement {
        sheared: [0.125, 0.0, 0.0],
        stretched: [0.125, 0.0, 0.0],
        cells: [12.0, 12.0, 10.0],
        steps: STEPS,
    },
    // Off the nodes, domains of GIMP do not reach the next nodes with a small weight.
    BodyPlacement {
        sheared: [0.125, 0.625, 0.625],
        stretched: [0.125, 0.625, 0.625],
        cells: [12.0; 3],
        steps: STEPS,
    },
    // Linear functions have the largest weights here at nodes that a single particle reaches. The
    // run is shorter, because errors of these nodes grow from step to step with APIC.
    BodyPlacement { sheared: [0.25, 0.0, 0.0], stretched: [0.0; 3], cells: [12.0; 3], steps: 4 },
];

/// Maximum relative error of the force, which allows for approaching waves.
const NEAR: f64 = 0.12;

/// Maximum force in the first step normal to the expected force, relative to the expected force.
const ACROSS: f64 = 0.15;

const DROPPED: &str = "initial-stress-dropped";

const COMPONENTS: &str = "initial-stress-components";

/// Examines the body at one position, and if this shows a defect, at further positions. At nodes
/// with little mass, a run with linear functions or GIMP may fail although the solver is correct. A
/// defect of the start does not depend on the position, so it must appear at all positions.
fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let first = examine_at(patient, PLACEMENTS[0]);
    let seen = match &first {
        Ok(examined) => examined.findings.first().map(|finding| finding.seen.clone()),
        Err(Hindrance::Broke(failure)) => Some(failure.clone()),
        Err(Hindrance::Lacks(_) | Hindrance::Masked(_)) => None,
    };
    let Some(seen) = seen else {
        let mut all = first?;
        all.add(start_gradient::examine(patient, &undeformed)?);
        return Ok(all);
    };
    for placement in &PLACEMENTS[1..] {
        let Ok(mut later) = examine_at(patient, *placement) else { continue };
        if later.findings.is_empty() {
            later.findings.push(SolverFinding::remark(
                "start-depends-on-position",
                format!("{seen}. At another position of the body, the start is correct"),
                "nodes at the surface of the body have little mass. Their accelerations are large, \
                 and depend on the position of the body relative to the grid",
                "basis functions with continuous gradients (quadratic B-splines) reduce this error",
            ));
            return Ok(later);
        }
    }
    first
}

fn examine_at(patient: &Patient<'_>, placement: BodyPlacement) -> Result<Examined, Hindrance> {
    let sheared = |kind| scene(kind, placement.sheared, placement);
    let [one, two, three, four] = FINITE;
    let first = patient.able(&[2, 3, 1], &[one, two, three, four, SMALL_STRAIN], &sheared)?;
    let laws = FINITE.into_iter().chain([SMALL_STRAIN]);
    let laws = laws.filter_map(|law| patient.able(&[first.dimension], &[law], &sheared).ok());
    let mut scenes: Vec<BoxScene> = laws.collect();
    // A shear preserves volumes, so a stretch is needed to reveal wrong masses and volumes.
    if first.dimension > 1 && first.law != SMALL_STRAIN {
        let is_finite = |scene: &&BoxScene| scene.law != SMALL_STRAIN;
        let law = scenes.iter().rfind(is_finite).map_or(first.law, |scene| scene.law);
        scenes.push(stretched((first.dimension, law), placement));
    }
    let courses = patient.run_all(&scenes)?;
    for (scene, course) in scenes.iter().zip(&courses) {
        require_whole_body(course, scene)?;
    }
    let mut all = Examined::default();
    for (scene, course) in scenes.iter().zip(&courses) {
        let forces = Forces::new(course, scene);
        let (law, force, error) = (scene.law, forces.describe(), shown(forces.error));
        let measured = format!("{law}: {force} (relative error of the force vector: {error})");
        all.add(Examined::new(measured, cause(course, scene, &forces)));
    }
    // Wrong components also change the magnitude, or all of the stress of other laws.
    if all.findings.iter().any(|finding| finding.name == COMPONENTS) {
        let is_other = |name: &str| name != COMPONENTS && name.starts_with("initial-stress");
        all.findings.retain(|finding| !is_other(finding.name));
    }
    Ok(all)
}

fn undeformed(kind: Kind) -> BoxScene {
    let displacement = AffineField::default();
    BoxScene { displacement, ..scene(kind, PLACEMENTS[0].sheared, PLACEMENTS[0]) }
}

fn scene(kind: Kind, offset: [f64; 3], placement: BodyPlacement) -> BoxScene {
    let lowest = [0.75, 0.25, 0.5];
    let from = std::array::from_fn(|axis| lowest[axis] + offset[axis] * H);
    let mut scene = BoxScene::of_cells(kind, from, placement.cells[kind.0 - 1], 7.0);
    let factor = if kind.1 == SMALL_STRAIN { SMALL } else { 1.0 };
    scene.displacement = match kind.0 {
        1 => scene.slope((0, 0), factor * STRETCH),
        _ => scene.slope((0, 1), factor * SHEAR),
    };
    scene.young = 3.1;
    scene.with_waves(TRAVEL * placement.steps as f64 / STEPS as f64, placement.steps)
}

/// Creates a body stretched to 1.5 times its length, from three to two particles per cell and axis.
fn stretched(kind: Kind, placement: BodyPlacement) -> BoxScene {
    let mut scene = scene(kind, placement.stretched, placement);
    scene.ppc = 3;
    scene.displacement = scene.slope((0, 0), 0.5);
    scene
}

/// The force through the plane normal to the first axis.
struct Forces {
    /// Component along the expected force, relative to the expected force.
    ratio: f64,
    /// Difference from the expected force, relative to the expected force.
    error: f64,
    /// Delay of the force (steps); NaN without a force.
    late: f64,
    /// Expected force, divided by its magnitude.
    unit: Vector3<f64>,
    /// Force in the first step, relative to the expected force.
    first: Vector3<f64>,
}

impl Forces {
    fn new(course: &Course, scene: &BoxScene) -> Self {
        let d = scene.dimension;
        let particles = &course.problem.particles;
        let (sigma, f) = (&particles.stress[..d * d], &particles.deformation_gradient[..d * d]);
        // With P = J sigma F^-T, the first column of P is sigma times that of the cofactors of F.
        let cofactor = |k: usize| {
            let mut replaced = f.to_vec();
            (0..d).for_each(|row| replaced[row * d] = f64::from(u8::from(row == k)));
            det_of_rows(d, &replaced)
        };
        let mut expected = Vector3::<f64>::zeros();
        for j in 0..d {
            expected[j] = (0..d).map(|k| sigma[j * d + k] * cofactor(k)).sum();
        }
        let whole = expected.norm();
        let unit = 1.0 / whole * expected;
        let (mut measured, mut first) = (Vector3::zeros(), Vector3::zeros());
        let mut along = vec![0.0; course.states.len()];
        for j in 0..d {
            let impulse = impulses(course, scene, 0, j);
            let [constant, rate] = constant_and_rate(&course.times, &impulse);
            let t = course.times[1];
            (measured[j], first[j]) = (constant, impulse[1] / t - 0.5 * rate * t);
            along.iter_mut().zip(&impulse).for_each(|(sum, impulse)| *sum += unit[j] * impulse);
        }
        let [constant, rate] = constant_and_rate(&course.times, &along);
        let t = course.times[1];
        let start = t - (along[1] - 0.5 * rate * t * t) / constant;
        Self {
            ratio: constant / whole,
            error: (measured - expected).norm() / whole,
            late: start / t,
            unit,
            first: 1.0 / whole * first,
        }
    }

    fn describe(&self) -> String {
        let (force, late) = (shown(self.ratio), libm::round(10.0 * self.late) / 10.0 + 0.0);
        let delay = format!(" and begins {} steps after the start", shown(late));
        let delay = if self.ratio.abs() <= NEAR { "" } else { &delay };
        format!("the force due to the initial stress is {force} of the expected force{delay}")
    }

    /// Names the wrong components of the initial stress if the force in the first step, which is
    /// half as large in a run that starts half a step back, has another direction than expected. In
    /// a sheared body, the force along axis j is `sigma_jx - sigma_jy`.
    fn wrong_components(&self, scene: &BoxScene) -> Option<String> {
        let across = self.first - self.first.dot(&self.unit) * self.unit;
        if across.norm() <= ACROSS {
            return None;
        }
        let name = [1.0, 2.0].into_iter().find_map(|factor| {
            let change = factor * self.first - self.unit;
            let [x, y, z] = change.into();
            let all =
                [("xx", [y, z]), ("yy", [x, z]), ("xy", [x + y, z]), ("of the z axis", [x, y])];
            let is_zero = |a: &f64| a.abs() <= 0.1 * change.norm();
            all.into_iter().find(|(_, others)| others.iter().all(is_zero)).map(|(name, _)| name)
        });
        let name = name
            .map_or("several components are".to_owned(), |name| format!("the component {name} is"));
        let [first, unit] = [self.first, self.unit].map(|f| shown_vector(f, scene.dimension));
        Some(format!(
            "the force in the first step is {first} of the magnitude of the expected force, expected \
             {unit}: {name} wrong"
        ))
    }
}

/// Returns the entries of the column `stress` that differ from the initial stress after one step,
/// and whether the column has a stress. NaN differs. `None` if the solver has no such column.
fn wrong_entries_of_column(course: &Course, scene: &BoxScene) -> Option<(Vec<usize>, bool)> {
    let d = scene.dimension;
    let sigma = &course.problem.particles.stress[..d * d];
    let scale = sigma.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let column = inside(course, scene, &course.states[1].stress)?;
    let is_wrong = |k: &usize| !((column[*k] - sigma[*k]).abs() <= 0.2 * scale);
    let has_stress = column.iter().any(|x| x.abs() > 0.2 * scale);
    Some(((0..d * d).filter(is_wrong).collect(), has_stress))
}

fn force_of_deformed_body(force: &str, forces: &Forces) -> SolverFinding {
    SolverFinding::defect(
        "force-of-deformed-body",
        format!(
            "{force}; the force vector has an error of {} of the expected force, but the column \
             `stress` has the initial stress",
            shown(forces.error)
        ),
        "the stress of a body that starts deformed is correct, but its force or its mass is not: \
         gradients of the reference configuration with the Cauchy stress, the transposed first \
         Piola-Kirchhoff stress, `reference_volume` in place of `volume`, or masses that are \
         computed from deformed volumes",
        "the internal force: V sigma grad N with present gradients, or V0 P grad N with reference \
         gradients; `particles.mass` and `particles.volume` of the problem",
    )
}

fn cause(course: &Course, scene: &BoxScene, forces: &Forces) -> Option<SolverFinding> {
    let (d, law) = (scene.dimension, scene.law);
    // The motion in the first step is much smaller than the initial displacement, so a wrong start
    // is detected after this step.
    let reach = course.farthest(displacement, 0, [0.0; 3]);
    let off = course.first_motion() / reach;
    if !(off <= 0.2) {
        let share = shown(off);
        return Some(SolverFinding::defect(
            "initial-displacement-ignored",
            format!(
                "{law}: after one step, displacements differ from the initial displacements by \
                 {share} of the largest one"
            ),
            "particles do not start at `position`, or displacements are not measured from \
             `reference_position`",
            "`particles.position` of the problem, which differs from `reference_position` here",
        ));
    }
    let f = &course.problem.particles.deformation_gradient[..d * d];
    let identity: Vec<f64> = (0..d * d).map(|k| f64::from(u8::from(k / d == k % d))).collect();
    let size_of_f = largest_difference(f, &identity);
    let mean = inside(course, scene, &course.states[1].deformation_gradient);
    let differs = |other: &[f64]| mean.as_ref().map(|mean| largest_difference(mean, other));
    let f_is_lost = differs(f).is_some_and(|off| !(off <= 0.5 * size_of_f));
    let force = format!("{law}: {}", forces.describe());
    if f_is_lost && differs(&transposed(f, d)).is_some_and(|off| off <= 0.2 * size_of_f) {
        return Some(SolverFinding::defect(
            "initial-deformation-transposed",
            format!("{force}; after one step, F is the transpose of the initial F"),
            "the solver reads the transpose of the initial F",
            "`particles.deformation_gradient` of the problem, which is stored row after row",
        ));
    }
    if f_is_lost {
        let mean = shown_list(&mean.unwrap_or_default());
        return Some(SolverFinding::defect(
            "initial-deformation-dropped",
            format!("{force}; after one step, F is {mean}"),
            "the solver ignores the initial F and starts with F = I",
            "`particles.deformation_gradient` of the problem; the initialisation of F",
        ));
    }
    let is_wrong = !(forces.error <= NEAR);
    let entries = wrong_entries_of_column(course, scene);
    if is_wrong && entries.as_ref().is_some_and(|(wrong, _)| wrong.is_empty()) {
        return Some(force_of_deformed_body(&force, forces));
    }
    // Laws in rate form keep a wrong initial stress in the column.
    let of_column = entries.filter(|(wrong, has_stress)| *has_stress && !wrong.is_empty());
    let of_column = of_column.map(|(wrong, _)| {
        let axis = ["x", "y", "z"];
        let names = wrong.iter().map(|k| format!("{}{}", axis[k / d], axis[k % d]));
        let names = names.collect::<Vec<_>>().join(", ");
        format!("after one step, the column `stress` has other components {names}")
    });
    if let Some(wrong) = of_column.or_else(|| forces.wrong_components(scene)) {
        return Some(SolverFinding::defect(
            COMPONENTS,
            format!("{law}: {wrong}"),
            "some components of the initial stress are not those of the problem, for example \
             horizontal stresses that the solver computes from the vertical one",
            "`particles.stress` of the problem, which has all d x d components of each particle",
        ));
    }
    if forces.ratio.abs() <= NEAR {
        return Some(SolverFinding::defect(
            DROPPED,
            force,
            "the solver ignores the initial stress, or the initial F from which the law computes \
             the stress",
            "`particles.stress` and `particles.deformation_gradient` of the problem; the \
             initialisation of stress and F",
        ));
    }
    if is_wrong {
        let error = shown(forces.error);
        return Some(SolverFinding::defect(
            "initial-stress-differs",
            format!("{force}; the force vector has an error of {error} of the expected force"),
            "the stress of a body that starts deformed is wrong: the law differs at finite strain, \
             the stress does not rotate with the body (F^T F instead of F F^T), or volumes are not \
             those of the problem",
            "the law as a function of F; `particles.volume` of the problem, which may differ from \
             `reference_volume`",
        ));
    }
    let (name, cause) = if (forces.late - 1.0).abs() <= 0.15 {
        (
            DROPPED,
            "the solver ignores the initial stress: the law computes the stress only at the end of \
             the first step",
        )
    } else {
        (
            "initial-stress-differs",
            "the initial stress has another magnitude until the law computes the stress at the end \
             of the first step",
        )
    };
    let look_at = "`particles.stress` of the problem, which acts in the first step of a scheme that \
                   updates the stress last";
    // A delay of half a step depends on the scheme and is not a defect.
    (!(-0.75..=0.75).contains(&forces.late))
        .then(|| SolverFinding::defect(name, force, cause, look_at))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn force_has_its_cause() {
        let scene = scene((2, "neo_hookean"), PLACEMENTS[0].sheared, PLACEMENTS[0]);
        let run = scene.built_in("basis: quadratic_bspline, transfer: flip, scheme: usl");
        let mut course = run.expect("a complete run");
        course.start(&scene.displacement, &scene.velocity);
        let forces = |ratio, error, late| {
            let unit = Vector3::y();
            Forces { ratio, error, late, unit, first: unit }
        };
        let name = |course: &Course, forces: &Forces| {
            cause(course, &scene, forces).map_or("", |finding| finding.name)
        };
        assert_eq!(name(&course, &forces(1.0, 0.119, 0.0)), "");
        assert_eq!(name(&course, &forces(1.0, 0.121, 0.0)), "force-of-deformed-body");
        let column = &mut course.states[1].stress;
        column.iter_mut().skip(1).step_by(4).for_each(|s| *s += 0.3 * scene.young);
        let finding = cause(&course, &scene, &forces(1.0, 0.2, 0.0)).expect("a finding");
        assert_eq!(finding.name, COMPONENTS);
        assert!(finding.seen.ends_with("has other components xy"), "{}", finding.seen);
        course.states[1].stress.clear();
        for (ratio, error, late, expected) in [
            (1.0, 0.119, 0.74, ""),
            (1.0, 0.119, -0.74, ""),
            (1.0, 0.121, 0.0, "initial-stress-differs"),
            (0.121, 0.879, 0.0, "initial-stress-differs"),
            (0.119, 0.881, f64::NAN, DROPPED),
            (1.0, 0.0, 0.76, "initial-stress-differs"),
            (1.0, 0.0, -0.76, "initial-stress-differs"),
            (1.0, 0.0, 0.86, DROPPED),
            (1.0, 0.0, 1.14, DROPPED),
            (1.0, 0.0, 1.16, "initial-stress-differs"),
            (1.0, f64::NAN, 0.0, "initial-stress-differs"),
        ] {
            assert_eq!(
                name(&course, &forces(ratio, error, late)),
                expected,
                "{ratio} {error} {late}"
            );
        }
        // In a sheared body, a wrong xx changes the force along x only, and a wrong xy both.
        for (first, component) in [
            ([0.14, 1.0], None),
            ([0.16, 1.0], Some("xx")),
            ([0.2, 0.8], Some("xy")),
            ([0.3, 0.7], Some("xy")),
            ([0.3, 0.9], Some("several components are")),
        ] {
            let first = Vector3::new(first[0], first[1], 0.0);
            let wrong = Forces { first, ..forces(1.0, 0.2, 0.0) }.wrong_components(&scene);
            let is_named = |text: &str| text.contains(component.unwrap_or("no"));
            assert_eq!(wrong.as_deref().map(is_named), component.map(|_| true), "{wrong:?}");
        }
    }
}
