//! Compiles a spectrum study: waves in a periodic row of cells.

use crate::exact::formula::Formula;
use crate::mpm::input::MpmMethod;
use crate::mpm::{MaterialPlan, Spline, VolumeName, WaveMethod, WaveTransfer, combine};
use crate::suite::compile::expect::assign;
use crate::suite::compile::run::methods::{NamedMethod, methods};
use crate::suite::compile::scene;
use crate::suite::evaluator::{Evaluator, SuitePath, shown, suggestion};
use crate::suite::grammar::{MethodSpec, SpectrumExpectSpec, SpectrumSpec};
use crate::suite::model::Scene;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::spectrum::{SpectrumCase, SpectrumPlan, Wave};
use crate::suite::scene::cell_size;
use crate::suite::yaml::{Diagnostic, NumberText};
use crate::verify::{AMPLITUDE, SpectrumExpectation, steps_of_run};
use std::f64::consts::TAU;

/// Maximum number of cases, and of waves per case.
const MOST: usize = 500;

/// Maximum number of particles per cell: the closed form has one term for each.
const MOST_PPC: u64 = 64;

/// Maximum number of steps of the run of one wave: minutes with a row of a hundred particles.
const MOST_STEPS: f64 = 1e6;

/// Minimum symbol `s` of the mass matrix (docs/glossary.md) for a wave that the grid can represent.
const SMALLEST_MASS: f64 = 1e-9;

/// Maximum imaginary part of the symbol of TPIC that counts as rounding error.
const LARGEST_ASYMMETRY: f64 = 1e-12;

/// Maximum deviation of a number of periods from an integer that counts as rounding error.
const ROUNDING: f64 = 1e-9;

pub(crate) fn plan(
    evaluator: &Evaluator<'_>,
    spec: &SpectrumSpec,
) -> Result<SpectrumPlan, Diagnostic> {
    let scene = scene::scene(evaluator, &spec.scene)?;
    refuse_unfit_scene(evaluator, &scene)?;
    let path = evaluator.top("particles");
    let at = path.then("cells");
    let cells = at.count(&spec.particles.cells, "the number of cells")?;
    let ppc_at = path.then("ppc");
    let ppc = ppc_at.count(&spec.particles.ppc, "the number of particles per cell")?;
    if ppc > MOST_PPC {
        return ppc_at
            .expected(&format!("at most {MOST_PPC}"), &format!("{ppc} particles per cell"));
    }
    let h = cell_size(&scene, cells);
    let level = LevelPlan { cells, h, dt: 0.0, ppc: Some(ppc) };
    if let Some((what, amount)) = level.too_large(&scene) {
        return at.expected("fewer", &format!("{cells} cells make {amount:.1e} {what}"));
    }
    let shift = shift(evaluator, spec, h / ppc as f64)?;
    let waves = waves(evaluator, spec, &scene, cells, h)?;
    let solvers = spec.spectrum.solvers.as_slice().to_vec();
    let mut plan = SpectrumPlan { scene, cells, h, ppc, shift, waves, solvers, cases: Vec::new() };
    plan.cases = cases(evaluator, spec, &plan)?;
    refuse_unknown_cases(evaluator, &plan)?;
    for case in &plan.cases {
        refuse_unfit_waves(evaluator, spec, &plan, case)?;
    }
    Ok(plan)
}

fn needs(path: &SuitePath<'_>, property: &str) -> Diagnostic {
    path.diagnostic(&format!("a spectrum study needs {property}"))
}

fn refuse_unfit_scene(evaluator: &Evaluator<'_>, scene: &Scene) -> Result<(), Diagnostic> {
    let fills = scene.grid.as_ref().is_none_or(|(from, to)| *from == scene.from && *to == scene.to);
    let is_linear = matches!(scene.material, MaterialPlan::LinearElastic { .. });
    let is_periodic = scene.faces.iter().all(|face| face.hold.is_periodic());
    // Without the key `boundary`, all faces are free.
    let is_free = scene.faces.iter().all(|face| face.hold.is_free());
    let boundary = if is_free { "scene" } else { "scene.boundary" };
    let starts_at_rest = scene.initial_displacement.is_empty() && scene.initial_velocity.is_empty();
    let refused = [
        (scene.dimension() != 1, "scene.dimension", "one dimension"),
        (!scene.bodies.is_empty(), "scene.bodies", "one body"),
        (!is_linear, "scene.material", "a linear law: `linear_elastic`"),
        (!is_periodic, boundary, "periodic faces: `{left: periodic, right: periodic}`"),
        (!fills, "scene.grid", "a body that fills the grid"),
        (!scene.loads.is_empty(), "scene.loads", "a body without loads"),
        (!scene.initial_stress.is_none(), "scene.initial_stress", "a body without stress"),
        (!starts_at_rest, "scene", "a body at rest, whose wave the study starts"),
    ];
    evaluator.refuse_first(&refused, |path, property| needs(&path, property))
}

/// Compiles the translation of the particles (m), which must keep every particle in its cell.
fn shift(evaluator: &Evaluator<'_>, spec: &SpectrumSpec, spacing: f64) -> Result<f64, Diagnostic> {
    let Some(texts) = &spec.particles.shift else { return Ok(0.0) };
    let path = evaluator.top("particles.shift");
    let shift = path.point(texts, 1)?.iter().sum::<f64>();
    if shift.abs() < 0.5 * spacing {
        return Ok(shift);
    }
    let message = format!("particles {} m apart are shifted by {} m", shown(spacing), shown(shift));
    let label = "expected less than half of their distance";
    Err(path.diagnostic(&message).with_label(label))
}

fn waves(
    evaluator: &Evaluator<'_>,
    spec: &SpectrumSpec,
    scene: &Scene,
    cells: u64,
    h: f64,
) -> Result<Vec<Wave>, Diagnostic> {
    let path = evaluator.top("spectrum");
    let lengths = path.then("cells_per_wavelength");
    let listed = &spec.spectrum.cells_per_wavelength;
    let courants = &spec.spectrum.courant;
    if listed.as_slice().len().saturating_mul(courants.as_slice().len()) > MOST {
        return path.expected(&format!("at most {MOST}"), "too many waves");
    }
    let mut waves = Vec::new();
    for (i, text) in listed.as_slice().iter().enumerate() {
        let at = lengths.alternative(listed, i);
        let length = at.number(text)?;
        if !(length >= 2.0) {
            let label = format!("the wavelength is {}", shown(length));
            return Err(needs(&at, "at least 2 cells per wavelength").with_label(&label));
        }
        let periods = cells as f64 / length;
        if !((periods - libm::round(periods)).abs() <= ROUNDING && periods >= 0.5) {
            let label = format!("the row of {cells} cells has {} wavelengths", shown(periods));
            let property = "a whole number of wavelengths in the row of cells";
            return Err(needs(&at, property).with_label(&label));
        }
        let velocity = velocity(&at, scene, length * h)?;
        for (k, text) in courants.as_slice().iter().enumerate() {
            let at = path.then("courant").alternative(courants, k);
            let courant = at.positive(text, "the Courant number")?;
            let steps = steps_of_run(length, courant, None) as f64;
            if !(steps <= MOST_STEPS) {
                let message = format!("a wave of {} cells needs {steps:.1e} steps", shown(length));
                let label = format!("expected a Courant number for at most {MOST_STEPS:.0e} steps");
                return Err(at.diagnostic(&message).with_label(&label));
            }
            waves.push(Wave { cells: length, courant, velocity: velocity.clone() });
        }
    }
    Ok(waves)
}

/// Returns the initial velocity (m/s) of a standing wave of this `length` (m).
fn velocity(path: &SuitePath<'_>, scene: &Scene, length: f64) -> Result<Formula, Diagnostic> {
    let (size, k, from) = (AMPLITUDE * scene.wave_speed(), TAU / length, scene.from[0]);
    let text = NumberText::Formula(format!("{size:e}*sin({k:e}*(X - ({from:e})))"));
    path.field(&text, 1)
}

fn cases(
    evaluator: &Evaluator<'_>,
    spec: &SpectrumSpec,
    plan: &SpectrumPlan,
) -> Result<Vec<SpectrumCase>, Diagnostic> {
    for (i, spec) in spec.methods.iter().enumerate() {
        if !matches!(spec, MethodSpec::Mpm { .. }) || spec.is_quasi_static() {
            let path = evaluator.top("methods").then(i);
            let help = "an external solver takes part with `run SUITE --solver COMMAND`";
            return Err(needs(&path, "methods of MPM in time").with_help(help));
        }
    }
    let named = methods(evaluator, &spec.methods, &plan.scene.material, MOST, 1)?;
    let curves = named.iter().map(|named| curve(&named.path(evaluator), named.method, plan));
    let curves = curves.collect::<Result<Vec<_>, Diagnostic>>()?;
    let names: Vec<String> = named.iter().map(NamedMethod::name).collect();
    let selectors: Vec<_> = spec.expect.iter().map(|spec| spec.case.as_ref()).collect();
    let owners = assign(evaluator, &selectors, &names)?;
    let expected = spec.expect.iter().enumerate().map(|(i, spec)| expectation(evaluator, i, spec));
    let expected = expected.collect::<Result<Vec<_>, Diagnostic>>()?;
    let case = |((named, curve), owner): ((NamedMethod, WaveMethod), Option<usize>)| {
        let expected = owner.map(|owner| expected[owner].clone());
        let limit = Some(curve.stability_limit());
        let (name, method, curve) = (named.name(), named.method, Some(curve));
        SpectrumCase { name, method, curve, limit, expected, gating: None }
    };
    Ok(named.into_iter().zip(curves).zip(owners).map(case).collect())
}

fn curve(
    path: &SuitePath<'_>,
    method: Method,
    plan: &SpectrumPlan,
) -> Result<WaveMethod, Diagnostic> {
    let at = path.then("mpm");
    if method.is_single_precision() {
        let property = "double precision, because the wave is small";
        return Err(needs(&at.then("precision"), property));
    }
    let Method::Mpm(MpmMethod { basis, transfer, scheme, mass, frame, volume, .. }) = method else {
        return Err(needs(path, "methods of MPM in time"));
    };
    combine(basis, transfer, mass, frame).map_err(|reason| {
        let help = "list compatible settings in separate entries of `methods`";
        path.diagnostic(&reason.to_string()).with_help(help)
    })?;
    if volume == VolumeName::Averaged {
        let property = "the volume ratio of each particle: `volume: particle`";
        return Err(needs(&at.then("volume"), property));
    }
    let Some(transfer) = WaveTransfer::of(transfer, mass) else {
        let (name, mass) = (transfer.name(), mass.name());
        let message = format!("`{name}` with a {mass} mass matrix has none");
        let diagnostic = needs(&at.then("transfer"), "a transfer with a closed form");
        return Err(diagnostic.with_label(&message));
    };
    let ppc = plan.ppc as u32;
    let spline = Spline::of(basis, ppc);
    Ok(WaveMethod { spline, ppc, shift: plan.shift / plan.h, transfer, scheme })
}

fn expectation(
    evaluator: &Evaluator<'_>,
    i: usize,
    spec: &SpectrumExpectSpec,
) -> Result<(SpectrumExpectation, String), Diagnostic> {
    let path = evaluator.top("expect").then(i);
    let share = |key: &str, text: &Option<NumberText>| {
        let at = path.then(key);
        text.as_ref().map(|text| at.positive(text, "the deviation")).transpose()
    };
    let phase_within = share("phase_within", &spec.phase_within)?;
    let damping_within = share("damping_within", &spec.damping_within)?;
    if phase_within.is_none() && damping_within.is_none() {
        return path.expected("`phase_within` or `damping_within`", "this expectation is empty");
    }
    let because = path.because("this expectation", &spec.because)?;
    Ok((SpectrumExpectation { phase_within, damping_within }, because))
}

fn refuse_unknown_cases(evaluator: &Evaluator<'_>, plan: &SpectrumPlan) -> Result<(), Diagnostic> {
    let names: Vec<&str> = plan.cases.iter().map(|case| case.name.as_str()).collect();
    let Some((solver, case)) =
        plan.solvers.iter().find(|(_, case)| !names.contains(&case.as_str()))
    else {
        return Ok(());
    };
    let path = evaluator.top("spectrum.solvers").then(solver.as_str());
    path.refuse(&format!("there is no case `{case}`"), &suggestion("cases", case, &names))
}

fn refuse_unfit_waves(
    evaluator: &Evaluator<'_>,
    spec: &SpectrumSpec,
    plan: &SpectrumPlan,
    case: &SpectrumCase,
) -> Result<(), Diagnostic> {
    let (Some(curve), Some(limit)) = (&case.curve, case.limit) else { return Ok(()) };
    let path = evaluator.top("spectrum");
    let (listed, courants) = (&spec.spectrum.cells_per_wavelength, &spec.spectrum.courant);
    for (i, wave) in plan.waves.iter().enumerate() {
        let (length, k) = (i / courants.as_slice().len(), i % courants.as_slice().len());
        let symbols = curve.symbols(TAU / wave.cells);
        if !(symbols.mass > SMALLEST_MASS) {
            let at = path.then("cells_per_wavelength").alternative(listed, length);
            let property = "a wave that the grid represents";
            let label =
                format!("the symbol s of the mass of `{}` is 0 at {} cells", case.name, wave.cells);
            return Err(needs(&at, property).with_label(&label));
        }
        if !matches!(curve.spline, Spline::Quadratic) && wave.cells < 2.0 + ROUNDING {
            let at = path.then("cells_per_wavelength").alternative(listed, length);
            let property = "a wave that is not zero at all nodes";
            let label = format!(
                "the nodes of `{}` are on cell faces, where a sine of 2 cells is 0",
                case.name
            );
            return Err(needs(&at, property).with_label(&label));
        }
        if matches!(curve.transfer, WaveTransfer::Tpic)
            && !(symbols.taylor[1].abs() <= LARGEST_ASYMMETRY)
        {
            let property = "particles that are symmetric in their cells for `tpic`";
            return Err(needs(&evaluator.top("particles.shift"), property));
        }
        if !(wave.courant < limit) {
            let at = path.then("courant").alternative(courants, k);
            let label = format!("the limit of `{}` is {limit:.4}", case.name);
            let property = "a Courant number below the stability limit";
            return Err(needs(&at, property).with_label(&label));
        }
    }
    Ok(())
}
