//! Problems of bodies that start deformed and rotated: initial and exact states, files, and the
//! built-in solver as an external solver.

use crate::common::solver::{NewSubject, Solver, solver};
use crate::common::{built_in_source, valid_suite, vtk};
use mpm_verify::external::{
    BodyForceField, FieldName, FieldPlaces, HandedNumber, LevelProblem, PlacedBodyForce,
    ProblemFace, ProblemFormat,
};
use mpm_verify::mpm::input::{
    BodyInput, EffectInput, FaceInput, ForceAt, GridInput, InitialState, MethodInput, MpmMethod,
    SceneInput, ShapeInput, StateInput, VectorAt, WallCondition, WallInput, subject,
};
use mpm_verify::mpm::{
    BasisName, FrameName, MassName, MaterialPlan, Placement, SchemeName, Side, TransferName,
    VolumeName,
};
use mpm_verify::study::{Runner, exact_state, level_problem, under};
use mpm_verify::subject::{Precision, Start};
use mpm_verify::suite::{Extent, Suite};
use mpm_verify::verify::RunResult;
use rstest::rstest;
use serde_json::{Value, json};
use std::f64::consts::PI;
use std::sync::Arc;

const FROM: [f64; 3] = [0.25, -0.5, 1.0];
const LENGTHS: [f64; 3] = [1.0, 1.5, 0.5];
/// Amplitudes of the displacement at the start (m).
const AMPLITUDES: [f64; 3] = [0.1, -0.06, 0.04];
const YOUNG: f64 = 30.0;
const POISSON: f64 = 0.3;
/// Particles per cell in one, two and three dimensions.
const PER_CELL: [u64; 3] = [2, 4, 8];

/// A box whose motion is manufactured, `u = A sin(k_x x) sin(k_y y) sin(k_z z) (1 + 2 t + 3 t^2)`
/// with the coordinates x, y, z in the box. The gradient of u is not symmetric. The density varies,
/// and the reference configuration is under stress.
pub(super) fn suite(d: usize) -> String {
    let sine = |i: usize| {
        let (name, from, length) = (["X", "Y", "Z"][i], FROM[i], LENGTHS[i]);
        format!("sin(pi*({name} - {from})/{length})")
    };
    let product = (0..d).map(sine).collect::<Vec<_>>().join("*");
    let motion = |i: usize| format!("\"{}*{product}*(1 + 2*t + 3*t^2)\"", AMPLITUDES[i]);
    let motion = (0..d).map(motion).collect::<Vec<_>>().join(", ");
    let density = ["2 + X", "2 + X + 0.5*X*Y", "2 + X + 0.5*X*Y*Z"][d - 1];
    let stress = [
        "{xx: \"0.3 + X\"}",
        "{xx: \"0.3 + X\", xy: \"0.2*Y\", yy: -0.4}",
        "{xx: \"0.3 + X\", xy: \"0.2*Y\", yy: -0.4, xz: 0.15, yz: \"0.1*X\", zz: \"0.25*Z\"}",
    ];
    let walls = ["left", "right", "bottom", "top", "back", "front"][..2 * d].join(": fixed, ");
    let gravity = ["\"5*t\"", "-9.81", "0.75"][..d].join(", ");
    let to: Vec<f64> = (0..d).map(|i| FROM[i] + LENGTHS[i]).collect();
    let (from, stress, ppc) = (&FROM[..d], stress[d - 1], PER_CELL[d - 1]);
    format!(
        "suite: rotated\ntitle: A rotated body\nsource: a test\nscene:\n  dimension: {d}\n  \
         body: {{box: {{from: {from:?}, to: {to:?}}}}}\n  material: {{neo_hookean: {{young: {YOUNG}, \
         poisson: {POISSON}, density: \"{density}\"}}}}\n  boundary: {{{walls}: fixed}}\n  \
         initial_stress: {stress}\n  loads:\n    - gravity: [{gravity}]\n\
         manufactured: {{displacement: [{motion}]}}\n\
         run: {{until: 0.018, dt: 0.003, instants: 3}}\nrefine: {{cells: [2, 4, 6], ppc: {ppc}}}\n\
         methods:\n  - mpm: {{basis: linear, transfer: flip, scheme: musl}}\n\
         expect:\n  - drift: {{mass: 1e-13}}\n    because: masses are constant\n"
    )
}

fn problem(suite: &Suite, level: usize) -> LevelProblem {
    let plan = suite.convergence().expect("a study of an order");
    let level = plan.refine.levels[level];
    level_problem(&suite.name, plan, &plan.cases[0], level).expect("a problem")
}

/// State of a point, with vectors of D numbers and tensors in rows.
#[derive(Debug, Default)]
struct PointState {
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    f: Vec<f64>,
    j: f64,
    cauchy: Vec<f64>,
    initial_stress: Vec<f64>,
    density: f64,
    /// First Piola-Kirchhoff stress (Pa).
    piola: [[f64; 3]; 3],
    acceleration: Vec<f64>,
}

/// Computes the state of the point `label` of the body of [`suite`] at time `t`. The displacement
/// gradient `a g^T` has rank one, so `J = 1 + a.g` and `F^-1 = I - a g^T/J`.
fn state(label: &[f64], t: f64) -> PointState {
    let d = label.len();
    let phase = |i: usize| PI * (label[i] - FROM[i]) / LENGTHS[i];
    let sines = |skipped: usize| -> f64 {
        (0..d).filter(|i| *i != skipped).map(|i| phase(i).sin()).product()
    };
    let shape = sines(d);
    let (q, rate) = (1.0 + 2.0 * t + 3.0 * t * t, 2.0 + 6.0 * t);
    let times = |factor: f64| AMPLITUDES[..d].iter().map(|a| a * factor).collect::<Vec<f64>>();
    let slope = |i: usize| PI / LENGTHS[i] * phase(i).cos() * sines(i) * q;
    let grad = |i: usize, k: usize| if i.max(k) < d { AMPLITUDES[i] * slope(k) } else { 0.0 };
    let unit = |i: usize, k: usize| f64::from(u8::from(i == k));
    let f: [[f64; 3]; 3] = [0, 1, 2].map(|i| [0, 1, 2].map(|k| unit(i, k) + grad(i, k)));
    let j = 1.0 + (0..d).map(|i| grad(i, i)).sum::<f64>();
    let (x, y, z) = (label[0], label.get(1).unwrap_or(&1.0), label.get(2).unwrap_or(&1.0));
    let (xy, xz, yz) = (0.2 * y, 0.15, 0.1 * x);
    let stress = [[0.3 + x, xy, xz], [xy, -0.4, yz], [xz, yz, 0.25 * z]];
    let s0 = |i: usize, k: usize| if i.max(k) < d { stress[i][k] } else { 0.0 };
    let (mu, lambda) = (YOUNG / 2.6, YOUNG * POISSON / (1.3 * 0.4));
    let sum = |term: &dyn Fn(usize) -> f64| [0, 1, 2].into_iter().map(term).sum::<f64>();
    let cauchy = |i: usize, k: usize| {
        let left = sum(&|a| f[i][a] * f[k][a]) - unit(i, k);
        let pushed = sum(&|a| f[i][a] * sum(&|b| s0(a, b) * f[k][b]));
        (mu * left + lambda * j.ln() * unit(i, k) + pushed) / j
    };
    // P = J sigma F^-T
    let back = |i: usize, k: usize| unit(i, k) - grad(i, k) / j;
    let piola = |i: usize, k: usize| j * sum(&|a| cauchy(i, a) * back(k, a));
    let varying = if d == 1 { 0.0 } else { 0.5 * x * y * z };
    let rows = |entry: &dyn Fn(usize, usize) -> f64| -> Vec<f64> {
        (0..d * d).map(|k| entry(k / d, k % d)).collect()
    };
    PointState {
        displacement: times(shape * q),
        velocity: times(shape * rate),
        acceleration: times(shape * 6.0),
        f: rows(&|i, k| f[i][k]),
        j,
        cauchy: rows(&cauchy),
        initial_stress: rows(&s0),
        density: 2.0 + x + varying,
        piola: [0, 1, 2].map(|i| [0, 1, 2].map(|k| piola(i, k))),
    }
}

#[track_caller]
fn assert_near(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (k, (value, expected)) in found.iter().zip(expected).enumerate() {
        assert!((value - expected).abs() <= tolerance, "{what} {k}: {value}, not {expected}");
    }
}

#[rstest]
fn particles_have_the_state_of_the_motion(
    #[values(1, 2, 3)] d: usize,
    #[values(0.0, 0.013)] t: f64,
) {
    let suite = valid_suite(&suite(d));
    let (plan, start) = (suite.convergence().expect("a study of an order"), problem(&suite, 0));
    let mut particles = start.particles;
    if t > 0.0 {
        particles = exact_state(plan, &particles, t).expect("a state");
    }
    // The cells of 0.5 m contain two particles along each axis.
    let counts: Vec<usize> = LENGTHS[..d].iter().map(|length| (length / 0.25) as usize).collect();
    let n = counts.iter().product();
    let volume = 0.25_f64.powi(d as i32);
    let names = POWERS.map(|(name, _)| name);
    let mut expected = names.map(|_| Vec::new());
    for mut p in 0..n {
        let mut label = Vec::new();
        for (from, count) in FROM.iter().zip(&counts) {
            label.push(from + 0.25 * ((p % count) as f64 + 0.5));
            p /= count;
        }
        let now = state(&label, t);
        let position = label.iter().zip(&now.displacement).map(|(x, u)| x + u).collect();
        let of_particle = [
            label.clone(),
            position,
            now.velocity,
            vec![now.density * volume],
            vec![volume],
            vec![now.j * volume],
            now.f,
            now.cauchy,
            vec![0.0],
            now.initial_stress,
        ];
        expected.iter_mut().zip(of_particle).for_each(|(column, of)| column.extend(of));
    }
    let columns = particles.columns();
    assert!(columns.iter().map(|(name, _)| *name).eq(names));
    for ((name, column), expected) in columns.iter().zip(&expected) {
        assert_near(column, expected, 1e-13 * YOUNG, name);
    }
}

/// The force on a body is `u_tt - Div P/rho0`, for any gravity. Div P is computed from differences.
#[rstest]
fn fields_are_those_of_the_motion(#[values(1, 2, 3)] d: usize) {
    let suite = valid_suite(&suite(d));
    let problem = problem(&suite, 0);
    let (fields, force) = (problem.fields.expect("fields"), problem.body_force.expect("a force"));
    let places = [[0.4, 0.7, 1.15], [1.25, -0.3, 1.0], [0.9, 0.05, 1.4]];
    let labels: Vec<f64> = places.iter().flat_map(|place| &place[..d]).copied().collect();
    let at = FieldPlaces::new(&labels, &[0; 3]);
    let states: Vec<PointState> = labels.chunks_exact(d).map(|label| state(label, 0.0)).collect();
    let of = |column: fn(&PointState) -> &Vec<f64>| {
        states.iter().flat_map(column).copied().collect::<Vec<f64>>()
    };
    for (field, expected) in [
        (FieldName::Displacement, of(|now| &now.displacement)),
        (FieldName::Velocity, of(|now| &now.velocity)),
        (FieldName::DeformationGradient, of(|now| &now.f)),
        (FieldName::Stress, of(|now| &now.cauchy)),
        (FieldName::InitialStress, of(|now| &now.initial_stress)),
    ] {
        let found = fields.values(field, 0.0, &at).expect("values");
        assert_near(&found, &expected, 1e-13 * YOUNG, &format!("{field:?}"));
    }
    let (label, t, step) = (&labels[..d], 0.013, 1e-5);
    let now = state(label, t);
    let shifted = |axis: usize, by: f64| {
        let mut label = label.to_vec();
        label[axis] += by;
        state(&label, t).piola
    };
    let divergence = |i: usize| {
        let along = |k: usize| shifted(k, step)[i][k] - shifted(k, -step)[i][k];
        (0..d).map(along).sum::<f64>() / (2.0 * step)
    };
    let expected: Vec<f64> =
        (0..d).map(|i| now.acceleration[i] - divergence(i) / now.density).collect();
    let mut placed = [[f64::NAN; 3]];
    force.at_places(&[0], &[label])(t, &mut placed);
    for found in [force.at(0, label, t), placed[0]] {
        assert_near(&found[..d], &expected, 1e-6, "body force");
        assert_eq!(found[d..], [0.0; 3][d..]);
    }
}

/// Width of each column of particles, as powers of D.
const POWERS: [(&str, u32); 10] = [
    ("reference_position", 1),
    ("position", 1),
    ("velocity", 1),
    ("mass", 0),
    ("reference_volume", 0),
    ("volume", 0),
    ("deformation_gradient", 2),
    ("stress", 2),
    ("body", 0),
    ("initial_stress", 2),
];

#[rstest]
fn files_have_the_columns_of_the_particles(#[values(1, 2, 3)] d: usize) {
    let problem = problem(&valid_suite(&suite(d)), 0);
    let (n, columns) = (problem.particles.len(), problem.particles.columns());
    let written = |format| problem.written(format).expect("a file");
    let table = String::from_utf8(written(ProblemFormat::Csv)).expect("text");
    let axes = ["x", "y", "z"];
    let name = |(name, power): (&str, u32)| -> Vec<String> {
        let component = |k: usize| match power {
            0 => name.to_owned(),
            1 => format!("{name}_{}", axes[k]),
            _ => format!("{name}_{}{}", axes[k / d], axes[k % d]),
        };
        (0..d.pow(power)).map(component).collect()
    };
    let head: Vec<String> = POWERS.into_iter().flat_map(name).collect();
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some(head.join(",").as_str()));
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect())
        .collect();
    assert_eq!(rows.len(), n);

    let document: Value = serde_json::from_slice(&written(ProblemFormat::Json)).expect("JSON");
    let (arrays, points) = (written(ProblemFormat::Npz), written(ProblemFormat::Vtu));
    let array = |name: &str| {
        // The name follows the length of the extra fields.
        let head = [&[0; 2], format!("{name}.npy").as_bytes(), b"\x93NUMPY\x01\x00"].concat();
        let at = arrays.windows(head.len()).position(|bytes| bytes == head).expect("an array");
        let text = at + head.len() + 2;
        let length = usize::from(arrays[text - 2]) + 256 * usize::from(arrays[text - 1]);
        assert_eq!((length + 10) % 64, 0, "the numbers are aligned");
        let shape = String::from_utf8_lossy(&arrays[text..text + length]).into_owned();
        let numbers = arrays[text + length..].chunks_exact(8);
        let numbers = numbers.map(|eight| f64::from_le_bytes(eight.try_into().expect("eight")));
        (shape, numbers.collect::<Vec<f64>>())
    };
    let shape =
        |text: &str| format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {text}, }}");
    let mut first = 0;
    for ((known, power), (name, column)) in POWERS.into_iter().zip(&columns) {
        assert_eq!(known, *name);
        let width = d.pow(power);
        let cells = rows.iter().flat_map(|row| &row[first..first + width]);
        assert!(cells.eq(column.iter()), "{name}");
        first += width;
        assert_eq!(document["particles"][name], json!(column), "{name}");
        let (head, numbers) = array(name);
        let text = if width == 1 { format!("({n},)") } else { format!("({n}, {width})") };
        assert_eq!(head.trim_end(), shape(&text), "{name}");
        assert_eq!(numbers[..n * width], **column, "{name}");
        // ParaView has vectors and tensors in three dimensions.
        let padded = column.chunks_exact(width).flat_map(|entry| match power {
            0 => entry.to_vec(),
            1 => [0, 1, 2].map(|i| entry.get(i).copied().unwrap_or(0.0)).to_vec(),
            _ => {
                let inside = |i: usize, k: usize| i.max(k) < d;
                (0..9)
                    .map(|k| if inside(k / 3, k % 3) { entry[k / 3 * d + k % 3] } else { 0.0 })
                    .collect()
            }
        });
        assert_eq!(vtk::numbers(&points, name), padded.collect::<Vec<f64>>(), "{name}");
    }
    assert!(rows.iter().all(|row| row.len() == first));
    let (head, origin) = array("grid_origin");
    assert_eq!((head.trim_end(), &origin[..d]), (shape(&format!("({d},)")).as_str(), &FROM[..d]));
    for (name, value) in [("h", 0.5), ("dt", 0.018 / 6.0), ("until", 0.018)] {
        let (head, number) = array(name);
        assert_eq!((head.trim_end(), number[0]), (shape("()").as_str(), value), "{name}");
    }
    assert_eq!(problem.times(), [0.018 * 2.0 / 6.0, 0.018 * 4.0 / 6.0, 0.018]);
}

/// Creates the built-in MPM as an external solver.
fn built_in(basis: BasisName) -> Solver<impl Fn(LevelProblem) -> NewSubject + Sync> {
    solver("built-in", move |problem| {
        let dynamic = MpmMethod {
            basis,
            transfer: TransferName::Flip.into(),
            scheme: SchemeName::Musl,
            start: Start::AtZero,
            mass: MassName::Lumped,
            frame: FrameName::Updated,
            volume: VolumeName::Particle,
            precision: Precision::Double,
        };
        let method = match problem.load_steps {
            Some(load_steps) => MethodInput::QuasiStatic { basis, load_steps },
            None => MethodInput::Dynamic(dynamic),
        };
        subject(scene(&problem), method)
    })
}

/// A body force that is requested from the problem.
struct Requested(Arc<dyn BodyForceField>, Option<PlacedBodyForce>);

impl ForceAt for Requested {
    fn prepare(&mut self, labels: &[&[f64]]) {
        self.1 = Some(self.0.at_places(&vec![0; labels.len()], labels));
    }

    fn write(&mut self, t: f64, _: &dyn Fn(usize) -> [f64; 3], into: &mut [[f64; 3]]) {
        self.1.as_mut().expect("prepared")(t, into);
    }
}

/// Converts a problem with one body to a scene, without use of the suite.
fn scene(problem: &LevelProblem) -> SceneInput<'static> {
    let (d, grid) = (problem.dimension, &problem.grid);
    let wall_of = |face: &ProblemFace| {
        let side = if face.high { Side::High } else { Side::Low };
        FaceInput { axis: face.axis, side }
    };
    let fixed = problem.faces.iter().filter(|face| face.condition == "fixed");
    let wall = |face| WallInput { face: wall_of(face), condition: WallCondition::Fixed };
    let (shape, material) = (&problem.bodies[0], &problem.materials[0]);
    let [young, poisson] = ["young", "poisson"].map(|key| material.parameter(key));
    let [friction_angle, dilation_angle, cohesion] =
        ["friction_angle", "dilation_angle", "cohesion"].map(|key| material.parameter(key));
    let law = match material.law {
        "neo_hookean" => MaterialPlan::NeoHookean { young, poisson },
        _ => MaterialPlan::MohrCoulomb { young, poisson, friction_angle, dilation_angle, cohesion },
    };
    let particles = problem.particles.clone();
    let mass = move |label: &[f64], _: &[f64]| {
        let mut labels = particles.reference_position.chunks_exact(d);
        particles.mass[labels.position(|known| known == label).expect("a particle")]
    };
    let fields = problem.fields.clone().expect("fields");
    let values = move |field, label: &[f64]| {
        fields.values(field, 0.0, &FieldPlaces::new(label, &[0])).expect("values")
    };
    let stress = {
        let values = values.clone();
        move |label: &[f64]| {
            let mut stress = [[0.0; 3]; 3];
            let inside = values(FieldName::InitialStress, label);
            inside.iter().enumerate().for_each(|(k, value)| stress[k / d][k % d] = *value);
            let across = values(FieldName::InitialStressAcross, label);
            across.iter().enumerate().for_each(|(k, value)| stress[d + k][d + k] = *value);
            stress
        }
    };
    let motion = move |label: &[f64]| {
        let mut now = StateInput::default();
        now.u[..d].copy_from_slice(&values(FieldName::Displacement, label));
        now.velocity[..d].copy_from_slice(&values(FieldName::Velocity, label));
        for (k, f) in values(FieldName::DeformationGradient, label).into_iter().enumerate() {
            now.grad[k / d][k % d] = if k / d == k % d { f - 1.0 } else { f };
        }
        now
    };
    let effect = if let Some(load) = problem.loads.first() {
        let face = problem.faces.iter().find(|face| Some(face.name) == load.face);
        let face = wall_of(face.expect("a face"));
        let [("traction", HandedNumber::Vector(value))] = &load.numbers.values[..] else {
            panic!("{load:?}")
        };
        let value = value.clone();
        let value: VectorAt = Box::new(move |_, _, into| into.copy_from_slice(&value));
        EffectInput::Traction { face, placement: Placement::Surface, value }
    } else {
        let force = problem.body_force.clone().expect("a force");
        EffectInput::BodyForce(Box::new(Requested(force, None)))
    };
    let per_cell = problem.particles_per_cell.expect("particles") as f64;
    let body = BodyInput {
        shape: ShapeInput::Box { from: shape.from.clone(), to: shape.to.clone() },
        per_axis: libm::round(per_cell.powf(1.0 / d as f64)) as usize,
        density: material.density,
        mass: Some(Box::new(mass)),
        displace: None,
        extra: Vec::new(),
        material: law,
        effects: vec![effect],
        initial: InitialState {
            motion: Box::new(motion),
            is_displaced: problem.load_steps.is_none(),
            stress: Some(Box::new(stress)),
        },
        stores_deformation: false,
        samples_stress_across: false,
    };
    SceneInput {
        plane: problem.plane,
        grid: GridInput {
            origin: grid.origin.clone(),
            h: grid.h,
            cells: grid.cells.iter().map(|cells| *cells as usize).collect(),
            periodic: grid.periodic.clone(),
        },
        walls: fixed.map(wall).collect(),
        bodies: vec![body],
        contact: None,
    }
}

fn runs(suite: &Suite, basis: BasisName) -> [Vec<RunResult>; 2] {
    let solver = built_in(basis);
    let external = under(suite, &solver, false).expect("a study of solvers");
    let own = Runner::over(suite, Extent::Usual).case(0, &|| ());
    let external = Runner::over(&external, Extent::Usual).judging(&solver).case(0, &|| ());
    [own, external].map(|found| {
        let study = found.convergence().expect("results");
        study.levels.iter().map(|level| level.run.clone()).collect()
    })
}

/// Errors, drifts and counters of all levels must be bit-identical. Without gravity, the sum of the
/// forces has the bits of the manufactured force.
#[rstest]
fn built_in_solver_has_its_own_results_on_its_problems(#[values(1, 2, 3)] d: usize) {
    let text = suite(d);
    let (before, gravity) = text.split_once("  loads:\n").expect("loads");
    let (_, after) = gravity.split_once('\n').expect("a line of gravity");
    let suite = valid_suite(&format!("{before}{after}"));
    let [own, external] = runs(&suite, BasisName::Linear);
    assert!(own.iter().all(|run| run.failure.is_none() && run.errors.at_end.rms > 0.0));
    assert_eq!(own.len(), 3);
    assert_eq!(external, own);
}

/// The soil starts in a stress with components out of the plane, and yields under the traction.
#[test]
fn built_in_solver_has_its_own_results_in_load_steps() {
    let text = built_in_source("load-steps-stressed-mohr-coulomb").text().to_owned();
    let suite = valid_suite(&text.replace("load_steps: [1, 4]", "load_steps: 4"));
    let [own, external] = runs(&suite, BasisName::ContiguousGimp);
    assert!(own.iter().all(|run| run.counters.min_j < 0.999 && run.steps == 4), "{own:?}");
    assert_eq!(external, own);
}
