//! Examination of pairs of problems that differ by a symmetry of the equations and of the grid.
//! The changed problem must have the changed solution, to rounding. No exact solution is needed.

use super::faces::position_rounding;
use crate::subject::Samples;
use crate::testing::change::{Change, Changed};
use crate::testing::doctor::prelude::*;
use rayon::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "symmetry",
    expected: "mirrored, exchanged and turned axes, another place of body and grid, another order \
               of the particles and other units change the answer in the same way",
    after: &[
        "conversation",
        "translation",
        "faces",
        "force",
        "transfer",
        "stress",
        "start",
        "walls",
    ],
    covers: &[],
    examine,
};

/// Factor for other units. It is a power of two, so scaling does not even change rounding errors.
const THOUSANDTH: f64 = 1.0 / 1024.0;

const TINY: f64 = THOUSANDTH * THOUSANDTH * THOUSANDTH * THOUSANDTH;

/// Maximum ratio of a difference to the rounding errors of positions, if rounding is the cause.
const GROWTH: f64 = 100.0;

/// Maximum relative difference of a sound solver that has not the symmetry of the grid, such as a
/// mesh of triangles, which has up to 0.05.
const DISCRETISATION: f64 = 0.1;

/// Maximum relative difference due to iterations that end at a tolerance of 1e-6.
const ITERATIONS: f64 = 1e-3;

/// Changes, each with the index of its finding.
const CHANGES: [(usize, Change); 8] = [
    (0, Change { name: "mirrored axes", mirrored: true, ..Change::NONE }),
    (1, Change { name: "exchanged axes", exchanged: true, ..Change::NONE }),
    (TURNED, Change { name: "turned axes", turned: true, ..Change::NONE }),
    (3, Change { name: "another place", moved: 19.0, ..Change::NONE }),
    (4, Change { name: "another order", series: 7, ..Change::NONE }),
    (UNITS, Change { name: "small lengths", length: THOUSANDTH, ..Change::NONE }),
    (UNITS, Change { name: "small times", time: THOUSANDTH, ..Change::NONE }),
    (UNITS, Change { name: "small masses", mass: TINY, ..Change::NONE }),
];

const TURNED: usize = 2;
const UNITS: usize = 5;
const INEXACT: usize = 6;

/// Name, likely cause, and code to check of each finding.
const FINDINGS: [[&str; 3]; 7] = [
    [
        "mirror-image-differs",
        "the two directions of an axis are treated differently: cells or basis functions that are \
         wrong on one side, a condition at one end of the grid only, a constant acceleration or \
         offset",
        "the search of the cell (`floor`, `round`, casts); the functions to the left and to the \
         right of a particle; the ends of loops over nodes; constants that are added to vectors",
    ],
    [
        "exchanged-axes-differ",
        "one axis is treated differently from the others: a node number that is computed with the \
         extent of another axis, a loop over some axes only, components in the wrong place",
        "strides and limits that are computed from `grid.cells`; loops that end before the last \
         axis; indices that are written as numbers; the order of the components of stress and F",
    ],
    [
        "turned-body-differs",
        "components of vectors or tensors are exchanged, or have a wrong sign",
        "the components of vectors and tensors that are read and written; indices that are written \
         as numbers; rotations and polar decompositions; in 3-D, the third axis",
    ],
    [
        "depends-on-origin",
        "results depend on coordinates: the origin of the grid is not subtracted, positions are \
         limited to a range, or positions are used as displacements",
        "`grid.origin` of the problem; limits of positions; functions of the coordinates",
    ],
    [
        "depends-on-particle-order",
        "the result of a particle depends on its place in the list: it uses results of particles \
         that come earlier, one particle stands for others, or values belong to other particles",
        "loops over particles that read what they change; sums at nodes that are read before they \
         are complete, or overwritten in place of added; columns that are read or written in \
         another order or layout",
    ],
    [
        "depends-on-units",
        "the code contains a constant with a unit, such as a threshold on mass, length or time, or \
         a formula lacks a factor with a unit",
        "comparisons with constants like 1e-12 (nodes with little mass, cells, times), which must \
         be relative to a mass, length or time of the problem; constants such as 9.81; output with \
         few digits",
    ],
    [
        "symmetry-inexact",
        "errors of this size differ between equal problems: iterations that end at a tolerance, or \
         numbers of a lower precision than the solver declares",
        "tolerances of iterations; arrays and constants in single precision",
    ],
];

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let free = able(patient, &[2, 3, 1], &body)?;
    let mut all = compare(patient, &free, &CHANGES)?;
    let held = able(patient, &[2, 3, 1], &held_body).map(|scene| (scene, &CHANGES[..2]));
    let solid = able(patient, &[3], &body).map(|scene| (scene, &CHANGES[2..3]));
    for (scene, changes) in [solid, held].into_iter().flatten() {
        // A broken symmetry of the free body breaks others, too.
        if all.findings.is_empty()
            && let Ok(examined) = compare(patient, &scene, changes)
        {
            all.add(examined);
        }
    }
    Ok(all)
}

/// Returns the scene with gravity, an initial deformation or both, if the solver supports them.
fn able(
    patient: &Patient<'_>,
    dimensions: &[usize],
    make: &dyn Fn(Kind) -> BoxScene,
) -> Result<BoxScene, Hindrance> {
    let scene = |(is_deformed, falls): (bool, bool)| {
        patient.able(dimensions, &ANY_LAW, &|kind| {
            let mut scene = make(kind);
            scene.gravity = falls.then(|| [0.11, -0.53, 0.29][..kind.0].to_vec());
            if is_deformed {
                let formulas = bend(&scene, [0.0; 3], 0.2);
                scene.extras.keys.push(format!("initial_displacement: {formulas:?}"));
            }
            scene
        })
    };
    let richer = [(true, true), (false, true), (true, false)].into_iter();
    richer.map(scene).find(Result::is_ok).unwrap_or_else(|| scene((false, false)))
}

/// Creates a body that moves, spins, stretches and bends. No particle and no face of the body lies
/// on a cell face. The numbers of cells differ between axes, and the body is beyond the extent of
/// the shorter axes.
fn body(kind: Kind) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.0; 3], 4.0, 0.0);
    let cells = |all: [f64; 3]| all[..kind.0].iter().map(|x| x * H).collect::<Vec<f64>>();
    scene.body = (cells([5.293, 2.371, 2.168]), cells([9.293, 5.371, 4.168]));
    scene.grid = (cells([0.0; 3]), cells([12.0, 8.0, 7.0]));
    scene.young = 3.1;
    scene.extras.velocity = Some(bend(&scene, [0.19, 0.13, -0.11], 1.0));
    scene.with_waves(4.0, 24)
}

/// Creates a body of the same kind that one fixed wall and one roller hold.
fn held_body(kind: Kind) -> BoxScene {
    let mut scene = body(kind);
    let cells = |all: [f64; 3]| all[..kind.0].iter().map(|x| x * H).collect::<Vec<f64>>();
    scene.body = (cells([0.0, 2.0, 2.0]), cells([4.0, 5.0, 4.0]));
    scene.grid = (cells([0.0; 3]), cells([6.0, 5.0, 6.0]));
    scene.faces = [("left", "fixed"), ("top", "roller")][..kind.0.min(2)].to_vec();
    scene.extras.velocity = Some(bend(&scene, [0.03, 0.02, -0.02], 1.0));
    scene
}

/// Returns formulas of a vector field with this value at the centre of the body. It is linear and
/// quadratic in position, without any symmetry.
fn bend(scene: &BoxScene, centre: [f64; 3], size: f64) -> Vec<String> {
    let d = scene.dimension;
    let place = |i: usize| format!("({} - {})", ["X", "Y", "Z"][i % d], scene.centre()[i % d]);
    let component = |i: usize| {
        let (own, next, slope) = (place(i), place(i + 1), [0.09, -0.05, 0.07][i]);
        let bending = format!("{slope}*{own} + 0.12*{next} + 0.3*{own}*{next} - 0.2*{next}^2");
        format!("{} + {size}*({bending})", centre[i])
    };
    (0..d).map(component).collect()
}

fn compare(
    patient: &Patient<'_>,
    scene: &BoxScene,
    changes: &[(usize, Change)],
) -> Result<Examined, Hindrance> {
    let plain = patient.run(scene)?;
    let run = |(_, change): &(usize, Change)| difference(patient, scene, &plain, *change);
    let differences: Vec<Option<(f64, &str)>> = changes.par_iter().map(run).collect();
    let most = patient.tolerance(1e-6, 0.02);
    let mut rounding = 0.0;
    if differences.iter().flatten().any(|(size, _)| !(*size <= most)) {
        let moved = plain.farthest(displacement, plain.last(), [0.0; 3]);
        rounding = position_rounding(patient, scene).unwrap_or(f64::NAN) / moved;
    }
    // Faults of positions are larger than rounding.
    let growth = if rounding <= most { GROWTH * rounding } else { 0.0 };
    let mut measured = Vec::new();
    let mut broken: Vec<(usize, f64, String)> = Vec::new();
    for ((finding, change), difference) in changes.iter().zip(differences) {
        let Some((size, column)) = difference else { continue };
        measured.push(format!("{} {}", change.name, shown(size)));
        let seen = format!("{} ({column}: {})", change.name, shown(size));
        // Turned axes are reported if the other two changes of axes do not show the cause.
        if size <= most.max(growth / change.length) || *finding == TURNED && !broken.is_empty() {
            continue;
        }
        let is_inexact = *finding != UNITS && size <= ITERATIONS;
        let finding = if is_inexact { &INEXACT } else { finding };
        if let Some((_, largest, all)) = broken.last_mut().filter(|(last, ..)| last == finding) {
            (*largest, *all) = (largest.max(size), format!("{all}, {seen}"));
        } else {
            broken.push((*finding, size, seen));
        }
    }
    if let Some(failure) = plain.failure.filter(|_| broken.is_empty()) {
        return Err(Hindrance::Broke(failure));
    }
    let findings = broken.into_iter().map(|(finding, size, seen)| {
        let is_defect = finding == UNITS || size > DISCRETISATION;
        let [name, cause, look_at] = FINDINGS[finding];
        let seen = format!("relative differences with {seen}");
        if is_defect {
            return SolverFinding::defect(name, seen, cause, look_at);
        }
        let cause = format!("{cause}; or a mesh or particles of the solver lack the symmetry");
        SolverFinding::remark(name, seen, &cause, look_at)
    });
    let (d, measured) = (scene.dimension, measured.join(", "));
    Ok(Examined::new(format!("in {d}-D, relative differences with {measured}"), findings))
}

/// Returns the largest difference of the last states that both runs reach, relative to the largest
/// entry of a column, and the name of this column. `None` if the states cannot be compared.
fn difference(
    patient: &Patient<'_>,
    scene: &BoxScene,
    plain: &Course,
    change: Change,
) -> Option<(f64, &'static str)> {
    let changed = Patient {
        solver: &Changed { solver: patient.solver, change },
        #[cfg(test)]
        built_in: patient.built_in,
    };
    let course = match changed.run(scene) {
        Ok(course) if course.failure.is_none() || plain.failure.is_some() => course,
        Ok(_) | Err(Hindrance::Broke(_)) => return Some((f64::INFINITY, "the run failed")),
        Err(Hindrance::Lacks(_) | Hindrance::Masked(_)) => return None,
    };
    let last = plain.last().min(course.last());
    let (one, other) = (&plain.states[last], &course.states[last]);
    let pairs = pairs(one, other, 1e-6 * scene.h)?;
    let weight = relative(&one.weight, &other.weight, &pairs);
    // Points of a mesh whose image is another mesh have other weights.
    if !(weight <= 1e-6) && [change.length, change.mass, change.time] == [1.0; 3] {
        return None;
    }
    let columns = [
        (&one.displacement, &other.displacement, "displacement"),
        (&one.velocity, &other.velocity, "velocity"),
        (&one.stress, &other.stress, "stress"),
        (&one.deformation_gradient, &other.deformation_gradient, "deformation gradient"),
    ];
    let sizes = columns.map(|(one, other, name)| (relative(one, other, &pairs), name));
    let largest = |a: (f64, &'static str), b: (f64, &'static str)| if b.0 > a.0 { b } else { a };
    Some(sizes.into_iter().fold((weight, "weight"), largest))
}

/// Returns the index in `other` of each point of `one`; `None` if the points differ.
fn pairs(one: &Samples, other: &Samples, near: f64) -> Option<Vec<usize>> {
    let others = other.label.chunks_exact(other.dimension.max(1));
    let labels = one.label.chunks_exact(one.dimension.max(1));
    let pair = |label| others.clone().position(|other| largest_difference(label, other) <= near);
    let pairs: Option<Vec<usize>> = labels.map(pair).collect();
    pairs.filter(|pairs| pairs.len() == others.len())
}

/// Returns the largest difference between the entries of two columns, relative to the largest
/// entry. Point `p` of the first column is point `pairs[p]` of the second one.
fn relative(one: &[f64], other: &[f64], pairs: &[usize]) -> f64 {
    let size = one.len() / pairs.len().max(1);
    let scale = one.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let difference = |k: usize| {
        let off = other.get(pairs[k / size] * size + k % size).map(|other| (one[k] - other).abs());
        off.filter(|off| off.is_finite()).unwrap_or(f64::INFINITY)
    };
    let off = (0..size * pairs.len()).map(difference).fold(0.0, f64::max);
    // The scale may be infinite, too.
    if off == 0.0 || off.is_infinite() { off } else { off / scale }
}
