//! No theory gate may fail because of changes without effect: other units, axes, positions or
//! orders of the particles, a shifted grid, or a step that is 1 % shorter or longer.

mod known;
mod solver;

use mpm_verify::embedded;
use mpm_verify::external::{LevelProblem, ProblemNeeds, SolverFactory};
use mpm_verify::study::{Runner, lacking};
use mpm_verify::subject::{BodyFields, Failure, RunCounters, Samples, Subject, SubjectError};
use mpm_verify::suite::yaml::Source;
use mpm_verify::suite::{Case, Extent, Suite};
use mpm_verify::testing::{
    Change, Changed, DoctorReport, ExaminationReport, ExaminationResult, FindingWeight,
    SolverFinding, doctor, page,
};
use mpm_verify::verify::CaseOutcome;
use rayon::prelude::*;
use rstest::rstest;
use solver::{ProblemSolver, is_known};

const NONE: Change = Change::NONE;

/// All changes; the first one changes nothing.
const CHANGES: [Change; 13] = [
    NONE,
    Change { name: "length x 4", length: 4.0, ..NONE },
    Change { name: "mass x 4", mass: 4.0, ..NONE },
    Change { name: "time x 4", time: 4.0, ..NONE },
    Change { name: "length x 1000", length: 1e3, ..NONE },
    Change { name: "mass x 1e-6", mass: 1e-6, ..NONE },
    Change { name: "time x 1e3", time: 1e3, ..NONE },
    Change { name: "axes mirrored", mirrored: true, ..NONE },
    Change { name: "axes exchanged", exchanged: true, ..NONE },
    Change { name: "all moved by 12.3 cells", moved: 12.3, ..NONE },
    Change { name: "particles in another order", series: 7, ..NONE },
    Change { name: "the grid 0.3 cells lower", shifted: -0.3, ..NONE },
    Change { name: "the grid 0.45 cells lower", shifted: -0.45, ..NONE },
];

/// Whether results keep their bits, because numbers are multiplied by powers of two only.
fn keeps_bits(change: &Change) -> bool {
    let Change { name, length, mass, time, .. } = *change;
    let power = |scale: f64| scale == 1.0 || scale == 4.0;
    [length, mass, time].into_iter().all(power)
        && *change == Change { name, length, mass, time, ..NONE }
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

fn suite(name: &str) -> Suite {
    let Some(source) = embedded::source(name) else { panic!("no suite `{name}`") };
    Suite::load(&source.expect("a text")).expect("a sound suite")
}

/// Runs the case with this index under a change; `None` if the change is not possible.
fn changed(suite: &Suite, case: usize, change: Change) -> Option<CaseOutcome> {
    let plan = suite.convergence()?;
    let method = plan.cases[case].method;
    let solver = Changed { solver: &ProblemSolver { method }, change };
    if !is_known(method) || !lacking(suite, &solver).is_empty() {
        return None;
    }
    let outcome = Runner::over(suite, Extent::Usual).judging(&solver).case(case, &|| ());
    outcome.lacks.is_empty().then_some(outcome)
}

/// Changes all steps of a case by about 1 %. If the steps of each level divide the run, this
/// remains so, and their ratios from level to level are kept: a claimed order requires dt in
/// proportion to h.
fn stepped(suite: &Suite, case: usize, longer: bool) -> Option<Suite> {
    let mut plan = suite.convergence()?.clone();
    let until = plan.cases[case].until;
    let counts = plan.refine.levels(Extent::Usual).iter().map(|level| until / level.dt);
    let whole = |count: f64| (count - libm::round(count)).abs() < 1e-6;
    let common = counts.clone().map(|count| libm::round(count) as usize).fold(0, gcd);
    let least = if longer { common - 1 } else { common + 1 };
    let factor = match counts.clone().all(whole) && common >= 20 {
        true => common as f64 / least as f64,
        false if longer => 1.01,
        false => 0.99,
    };
    for level in &mut plan.refine.levels {
        level.dt *= factor;
    }
    plan.refine.rule = plan.refine.rule.map(|share| share * factor);
    let mut stepped = suite.clone();
    stepped.study = plan.into();
    Some(stepped)
}

fn errors(outcome: &CaseOutcome) -> Vec<f64> {
    let study = outcome.convergence().expect("a convergence study");
    study.levels.iter().map(|level| level.error).collect()
}

/// The example of the gate is a plane shear wave. Every change is possible for it, except a shift
/// of the grid relative to its walls.
#[test]
fn irrelevant_changes_do_not_affect_a_shear_wave() {
    let suite = suite("shear-wave");
    let case = suite.case_names().iter().position(|name| name.contains("flip")).expect("FLIP");
    let plain = Runner::new(&suite).case(case, &|| ());
    let mut made = 0;
    for change in CHANGES {
        let Some(found) = changed(&suite, case, change) else { continue };
        made += 1;
        assert!(found.passed(), "{}: {:?}", change.name, found.unmet);
        if keeps_bits(&change) {
            assert_eq!(errors(&found), errors(&plain), "{}", change.name);
        }
    }
    assert_eq!(made, CHANGES.len() - 2);
}

/// The built-in solver, for problems of one number of dimensions.
pub(crate) struct BuiltIn {
    solver: ProblemSolver,
    dimension: usize,
}

impl SolverFactory for BuiltIn {
    fn name(&self) -> &'static str {
        "built-in"
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        let mut lacks = self.solver.lacks(needs);
        if needs.dimension != self.dimension {
            lacks.push(format!("dimension: {}", needs.dimension));
        }
        // The laws of the built-in solver are those of finite strains.
        if needs.laws.contains(&"small_strain") {
            lacks.push("laws: small_strain".to_owned());
        }
        lacks
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        self.solver.subject(problem)
    }
}

/// Creates a case for each combination of `methods`, in suite notation.
fn cases(methods: &str) -> Vec<Case> {
    let text = format!(
        "suite: methods\ntitle: All methods\nsource: none\n\
         scene: {{dimension: 2, body: {{box: {{from: [0, 0], to: [1, 1]}}}}, \
         material: {{neo_hookean: {{young: 1, poisson: 0, density: 1}}}}}}\n\
         run: {{until: 1, dt: 0.1}}\nrefine: {{cells: 4, ppc: 4}}\nmethods: [{methods}]\n"
    );
    let source = Source::from_text("methods.yaml", text).expect("a text");
    let suite = Suite::load(&source).unwrap_or_else(|error| panic!("{error}"));
    suite.convergence().expect("a convergence study").cases.clone()
}

pub(crate) fn built_in(dimension: usize, method: &str) -> BuiltIn {
    let [case] = &cases(&format!("{{mpm: {{{method}}}}}"))[..] else { panic!("{method}") };
    BuiltIn { solver: ProblemSolver { method: case.method }, dimension }
}

/// Examines a solver without defects.
fn healthy(solver: &dyn SolverFactory) -> DoctorReport {
    let report = doctor(solver, &|_| ());
    assert_eq!(report.defects(), 0, "{}", page(&report));
    report
}

fn result<'a>(report: &'a DoctorReport, name: &str) -> &'a ExaminationResult {
    let mut examinations = report.examinations.iter();
    &examinations.find(|made| made.examination == name).expect("an examination").result
}

/// Returns what a solver lacks for an examination.
fn lacks<'a>(report: &'a DoctorReport, name: &str) -> &'a str {
    match result(report, name) {
        ExaminationResult::NotApplicable { lacks } => lacks,
        _ => panic!("{}", page(report)),
    }
}

#[rstest]
#[case::quadratic(2, "basis: quadratic_bspline, transfer: flip, scheme: usl")]
#[case::slightly_averaged_motion(2, "basis: linear, transfer: flip_99, scheme: usl")]
#[ignore = "ci/nightly runs it"]
#[case::exact_motion(2, "basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian")]
#[ignore = "ci/nightly runs it"]
#[case::three_dimensions(3, "basis: linear, transfer: flip, scheme: usl")]
fn doctor_finds_no_defect_in_the_built_in_solver(#[case] dimension: usize, #[case] method: &str) {
    let report = healthy(&built_in(dimension, method));
    // `ProblemSolver` has no other loads and conditions; unit tests of the library examine these.
    let beyond = [
        "plane-stress",
        "traction",
        "damping",
        "moving-wall",
        "friction",
        "bodies",
        "contact",
        "load-steps",
    ];
    let is_examined = |made: &ExaminationReport| {
        matches!(made.result, ExaminationResult::Examined { .. })
            || beyond.contains(&made.examination)
    };
    assert!(report.examinations.iter().all(is_examined), "{}", page(&report));
}

/// The built-in PIC solver in one dimension, with three shorter steps for each requested step.
struct InThreeSteps;

impl SolverFactory for InThreeSteps {
    fn name(&self) -> &'static str {
        "in-three-steps"
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        built_in(1, PIC).lacks(needs)
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        Ok(Box::new(Divided(built_in(1, PIC).subject(problem)?)))
    }
}

const PIC: &str = "basis: quadratic_bspline, transfer: pic, scheme: usl";

struct Divided(Box<dyn Subject>);

impl Subject for Divided {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        (0..3).try_for_each(|_| self.0.step(dt / 3.0))
    }

    fn sample(&self, samples: &mut Samples) {
        self.0.sample(samples);
    }

    fn counters(&self) -> RunCounters {
        self.0.counters()
    }

    fn fields(&self) -> Vec<BodyFields> {
        self.0.fields()
    }
}

/// Averaging in each of the shorter steps transfers almost four times the momentum of the stress.
#[test]
fn doctor_does_not_examine_a_stress_that_averaging_hides() {
    let report = healthy(&InThreeSteps);
    assert!(lacks(&report, "stress").starts_with("a visible stress: in 1-D, averaging"));
    assert_eq!(lacks(&report, "walls"), "a result of `stress`");
}

/// The motion of a solver that averages velocities is not a path of the examination. Properties of
/// a scheme are remarks.
#[test]
fn doctor_does_not_examine_the_clay_of_an_averaging_solver() {
    let report = healthy(&built_in(2, "basis: linear, transfer: pic, scheme: usl"));
    assert!(lacks(&report, "clay").contains("velocity gradient that stays constant"));
    let remarks: Vec<&str> = report.findings().map(|finding| finding.name).collect();
    assert_eq!(remarks, ["rounding-grows-on-faces", "start-half-a-step-off", "momentum-spreads"]);
}

/// A particle at a corner is inverted at the first position of the body, because the nodes there
/// have little mass.
#[test]
fn defect_at_one_position_of_a_start_is_a_remark() {
    let report = healthy(&built_in(2, "basis: linear, transfer: apic, scheme: musl"));
    let findings = result(&report, "start").findings();
    let names: Vec<&str> = findings.iter().map(|finding| finding.name).collect();
    assert_eq!(names, ["start-depends-on-position"]);
}

/// Runs the first case of every suite for which a change is possible, and prints a line for each
/// change.
#[test]
#[ignore = "more than a thousand runs: some minutes, optimised"]
fn what_must_not_matter_fails_no_gate() {
    let only = std::env::var("FALSE_ALARMS").unwrap_or_default();
    let suites: Vec<Suite> = embedded::names()
        .filter(|name| name.contains(&only))
        .map(suite)
        .filter(|suite| suite.convergence().is_some() && !suite.explores())
        .collect();
    let mut alarms = Vec::new();
    let mut report = |name: &str, found: Vec<(String, CaseOutcome)>| {
        let failed: Vec<_> = found.iter().filter(|(_, outcome)| !outcome.passed()).collect();
        println!("{name}: {} runs, {} fail", found.len(), failed.len());
        for (run, outcome) in failed {
            println!("    {run}: {}", outcome.failure());
            match known::cause(run, name) {
                Some(cause) => println!("        known: {cause}"),
                None => alarms.push(format!("{name}: {run}")),
            }
        }
    };
    for (name, longer) in [("shorter steps", false), ("longer steps", true)] {
        let run = |(suite, case): (&Suite, usize)| {
            let outcome = Runner::new(&stepped(suite, case, longer)?).case(case, &|| ());
            Some((format!("{}::{}", suite.name, outcome.case), outcome))
        };
        let third = |suite: &Suite| (0..suite.case_names().len()).step_by(3).collect::<Vec<_>>();
        let cases =
            suites.iter().flat_map(|suite| third(suite).into_iter().map(move |i| (suite, i)));
        report(name, cases.filter_map(run).collect());
    }
    for change in CHANGES {
        let mut found = Vec::new();
        for suite in &suites {
            let mut kept = 0;
            for (i, case) in suite.case_names().into_iter().enumerate() {
                if kept == 2 {
                    break;
                }
                if let Some(outcome) = changed(suite, i, change) {
                    kept += 1;
                    found.push((format!("{}::{case}", suite.name), outcome));
                }
            }
        }
        report(change.name, found);
    }
    assert!(alarms.is_empty(), "{alarms:#?}");
}

/// Methods with a known finding: XPIC with USF has other forces at walls, and FMPM with linear
/// functions has errors of up to 14 % in the force of `start`, where 12 % are accepted.
const KNOWN: [&str; 8] = [
    "1-D mpm-linear-fmpm-2-musl-at-zero",
    "1-D mpm-linear-fmpm-2-usf-at-zero",
    "1-D mpm-linear-fmpm-2-usl-at-zero",
    "1-D mpm-linear-fmpm-2-usl-half-step-back",
    "2-D mpm-cubic-bspline-xpic-2-usf-at-zero",
    "2-D mpm-cubic-bspline-xpic-2-usf-half-step-back",
    "3-D mpm-cubic-bspline-xpic-2-usf-at-zero",
    "3-D mpm-cubic-bspline-xpic-2-usf-half-step-back",
];

/// Runs all examinations of the doctor on many methods. `FALSE_ALARMS="3-D apic"` limits the test
/// to the names with these parts. Affine transfers start with matrices of zero, as in most codes. A
/// consistent mass matrix is left out: at the rim of a body it is nearly singular, so rounding
/// errors become as large as the velocities.
#[test]
#[ignore = "hundreds of methods: some minutes, optimised"]
fn doctor_finds_no_defect_in_any_method() {
    let only = std::env::var("FALSE_ALARMS").unwrap_or_default();
    let is_chosen = |name: &str| only.split(' ').all(|part| name.contains(part));
    let methods = "
  {mpm: {basis: [linear, ugimp, cpgimp, cpdi, quadratic_bspline, cubic_bspline],
         transfer: [flip, flip_99, pic, apic, tpic, xpic_2, fmpm_2], scheme: [usl, usf, musl],
         start: [at_zero, half_step_back]}},
  {mpm: {basis: [quadratic_bspline, cubic_bspline], transfer: mls, scheme: [usl, usf, musl],
         start: [at_zero, half_step_back]}},
  {mpm: {basis: [linear, ugimp, quadratic_bspline, cubic_bspline],
         transfer: [flip, flip_99, pic, apic], scheme: [usl, usf, musl],
         start: [at_zero, half_step_back], frame: total_lagrangian}}";
    let cases = cases(methods);
    let examined = cases.par_iter().flat_map_iter(|case| {
        [1, 2, 3].map(|dimension| {
            let name = format!("{dimension}-D {}", case.name);
            if !is_chosen(&name) {
                return None;
            }
            let solver = ProblemSolver { method: case.method };
            let report = doctor(&BuiltIn { solver, dimension }, &|_| ());
            let mut defects = Vec::new();
            for made in &report.examinations {
                let all = made.result.findings().iter();
                for finding in all.filter(|finding| finding.weight == FindingWeight::Defect) {
                    let SolverFinding { name, seen, .. } = finding;
                    defects.push(format!("{}: {name}: {seen}", made.examination));
                }
            }
            (!defects.is_empty()).then(|| format!("{name}: {}", defects.join("; ")))
        })
    });
    let mut found: Vec<String> = examined.flatten().collect();
    found.sort();
    let known: Vec<&str> = KNOWN.into_iter().filter(|name| is_chosen(name)).collect();
    let names: Vec<&str> = found.iter().filter_map(|line| line.split(':').next()).collect();
    assert_eq!(names, known, "{found:#?}");
}
