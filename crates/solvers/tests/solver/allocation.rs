//! The hot loop allocates no memory, and the memory that a solver declares equals its heap use.

use crate::common::effect::add;
use crate::common::{DT, free_body, in_dimension, methods};
use allocation_counter::measure;
use mpm_judge::exact::formula::{Expr, Formula, Scope};
use mpm_judge::exact::heat::{Conduction, HeatForcing, Temperature};
use mpm_judge::exact::{Forcing, InitialStress, Motion, NeoHookeanLaw, Problem};
use mpm_solvers::fem;
use mpm_solvers::fem::{Bar, Element, Mass, Sampling};
use mpm_solvers::mpm::{
    BasisName, Block, Bodies, BodyForce, Damping, Effect, Fixed, Friction, Gravity, Grid, Heat,
    HeatSolver, MaterialPlan, Matrix, Particles, Placement, Prescribed, Pressure, Roller,
    ScalarField, SchemeName, Setup, Side, Solver, Thermal, ThermalBoundary, ThermalExpansion,
    Traction, TransferName, Vector, VelocityField, VolumeName,
};
use mpm_subject::{ColumnSize, Holder, PlaneState, Samples, Start, Subject};
use mpm_suites::suite::EffectName;
use rstest::rstest;

/// Steps `subject` once. Asserts that further steps and samples allocate no memory.
fn holds_its_memory(name: &str, subject: &mut dyn Subject, dt: f64) {
    subject.step(dt).unwrap();
    let stepping = measure(|| (0..20).for_each(|_| subject.step(dt).unwrap()));
    assert_eq!(stepping.count_total, 0, "{name}: twenty steps after the first");

    let mut samples = Samples::default();
    subject.sample(&mut samples);
    let sampling = measure(|| subject.sample(&mut samples));
    assert_eq!(sampling.count_total, 0, "{name}: a sample into columns that have been used");
    assert!(!samples.is_empty(), "{name}: there was something to sample");
}

/// Creates the force of a small manufactured motion with terms of every kind: in X, in t and in
/// both.
fn forcing<const D: usize>(labels: &[Vector<D>]) -> Forcing {
    let names: Vec<&str> = ["X", "Y", "Z"][..D].iter().chain(&["t"]).copied().collect();
    let expr = Expr::parse("sum(n, 1, 3, 1e-5*sin(n*X)*cos(t))*cos(X*t)").unwrap();
    let formula = Formula::bind(&expr, &Scope::new(), &names).unwrap();
    let problem = Problem {
        from: vec![0.0; D],
        to: vec![1.0; D],
        plane: PlaneState::Strain,
        density: 1.0.into(),
        equation: NeoHookeanLaw::new(1.0, 0.3).into(),
        terms: Vec::new(),
        outline: None,
        heat: None,
        at_rest: false,
        follows_motion: true,
        bodies: Vec::new(),
        initial_stress: InitialStress::default(),
        initial_displacement: Vec::new(),
        manufactured: true,
        faces: Vec::new(),
        initial_velocity: Vec::new(),
        until: 1.0,
        motion: Motion::new(vec![formula; D]),
        tolerance: 1e-8,
        linearised: None,
        shared: None,
    };
    Forcing::new(&problem, labels.iter().map(Vector::as_slice))
}

/// Creates conduction with a manufactured source and a condition of every kind, in the particles of
/// a body that may deform.
fn heat<const D: usize>(
    particles: &mut Particles<D>,
    (grid, basis): (&Grid<D>, BasisName),
) -> Heat<D> {
    let names: Vec<&str> = ["X", "Y", "Z"][..D].iter().chain(&["t"]).copied().collect();
    let expr = Expr::parse("1 + sum(n, 1, 3, sin(n*X)*cos(t))*cos(X*t)").unwrap();
    let formula = Formula::bind(&expr, &Scope::new(), &names).unwrap();
    let problem = Conduction {
        from: vec![0.0; D],
        to: vec![1.0; D],
        density: 1.0,
        conductivity: 1.0,
        capacity: 1.0,
        source: None,
        initial: None,
        faces: Vec::new(),
        temperature: Temperature::new(formula.clone(), D),
        motion: Some(Motion::new(vec![formula; D])),
        manufactured: true,
        until: 1.0,
        tolerance: 1e-8,
    };
    let mut forcing = HeatForcing::new(&problem, particles.x0.iter().map(Vector::as_slice));
    let number = || -> ScalarField { Box::new(|x, t| x[0] * t) };
    let heat = Heat::new(0.01, 1.0, particles, |x| (x[0], Vector::zeros()));
    let convection = Thermal::Inflow(Box::new(|x, t, value| 0.1 * (x[0] * t - value)));
    let conditions = [
        ((0, Side::Low), Thermal::Temperature(number())),
        ((0, Side::High), convection),
        ((D - 1, Side::Low), Thermal::Inflow(Box::new(|x, t, _| x[0] * t))),
    ];
    let face = |((axis, side), condition)| {
        ThermalBoundary::new(grid, basis, particles, axis, side, condition)
    };
    heat.with_faces(conditions.map(face).into())
        .with_source(Box::new(move |t, _, into| forcing.at(t, into)))
}

/// Runs a body with the examples of all effects, a manufactured force, a manufactured source of
/// heat, and walls of every kind.
fn mpm_holds_its_memory<const D: usize>(scheme: SchemeName, start: Start) {
    for method in methods() {
        let mut setup = free_body::<D>(method, scheme);
        for &name in EffectName::ALL {
            add(name, &mut setup, method.0, 0.1);
        }
        let (body, surface) = (&setup.particles, Placement::Surface);
        let shear = Traction::at(body, 0, Side::High, surface, Box::new(|x, t| x * (0.1 * t)));
        let pressure = Pressure::at(body, 0, Side::Low, surface, Box::new(|x, t| 0.1 * t * x[0]));
        let drive = || -> VelocityField<D> { Box::new(|x, t| x * t) };
        let mut forcing = forcing(&setup.particles.x0);
        let mut forces = vec![[0.0; 3]; setup.particles.len()];
        let made = BodyForce::new(Box::new(move |t, _, b| {
            forcing.at(t, &mut forces);
            for (b, force) in b.iter_mut().zip(&forces) {
                *b = Vector::<D>::from_fn(|i, _| force[i]);
            }
        }));
        let heat = heat(&mut setup.particles, (&setup.grid, method.0));
        let more: [Box<dyn Effect<D>>; 4] =
            [Box::new(shear), Box::new(pressure), Box::new(made), Box::new(heat)];
        setup.effects.extend(more);
        let (grid, last) = (&setup.grid, D - 1);
        setup.boundary = vec![
            Box::new(Prescribed::face(grid, method.0, last, Side::High, drive())),
            Box::new(Roller::face(grid, last, Side::Low)),
            Box::new(Friction::face(grid, 0, Side::High, 0.3)),
            Box::new(Fixed::face(grid, 0, Side::Low)),
        ];
        setup.start = start;
        let name = format!("{D}-D {method:?} {scheme:?} {start:?}");
        holds_its_memory(&name, &mut Solver::new(setup).unwrap(), DT);
    }
}

#[rstest]
fn an_mpm_step_after_the_first_allocates_nothing(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
    #[values(Start::AtZero, Start::HalfStepBack)] start: Start,
) {
    in_dimension!(dimension, mpm_holds_its_memory(scheme, start));
}

/// Runs three bodies that touch. They are in contact or share one velocity field.
fn bodies_hold_their_memory<const D: usize>(scheme: SchemeName) {
    for friction in [None, Some(0.0), Some(0.4)] {
        let body = |k: usize| {
            let method = (BasisName::QuadraticBSpline, TransferName::Apic);
            let mut setup = free_body::<D>(method, scheme);
            for (x, x0) in setup.particles.x.iter_mut().zip(&mut setup.particles.x0) {
                x[0] = 0.3 + (x[0] - 0.3) / 3.0 + 0.3 * k as f64;
                x0[0] = x[0];
            }
            setup.particles.sigma.fill(Matrix::zeros());
            setup.particles.v.fill(Vector::from_element(0.1 - 0.1 * k as f64));
            setup
        };
        let mut bodies = Bodies::new((0..3).map(body).collect(), friction).unwrap();
        holds_its_memory(&format!("{D}-D {scheme:?} {friction:?}"), &mut bodies, DT);
        let met = |column: &ColumnSize| column.name == "interface node" && column.entries > 0;
        assert!(bodies.profile().columns.iter().any(met), "the bodies do not meet");
    }
}

#[rstest]
fn a_step_of_bodies_after_the_first_allocates_nothing(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
) {
    in_dimension!(dimension, bodies_hold_their_memory(scheme));
}

#[test]
fn a_material_allocates_in_the_first_step_only() {
    let every = MaterialPlan::every(|parameter| match parameter.symbol {
        "nu" => 0.3,
        "Y" => 1e-3,
        "H" => 0.0,
        "eta" => 0.1,
        _ => 1.0,
    });
    let with_volumes = |plan| VolumeName::ALL.iter().map(move |volume| (plan, *volume));
    for (plan, volume) in every.iter().flat_map(with_volumes) {
        if volume == VolumeName::Averaged && plan.properties().takes_averaged_volume().is_err() {
            continue;
        }
        for &basis in BasisName::ALL {
            let mut setup = free_body::<2>((basis, TransferName::Flip), SchemeName::Musl);
            (setup.material, setup.volume) = (plan.build(), volume);
            holds_its_memory(plan.name(), &mut Solver::new(setup).unwrap(), DT);
        }
    }
}

/// Returns the bytes that a solver with `particles` particles along the first axis stores for
/// particles: the declared number, and the number measured on the heap, which includes the grid.
fn kept<const D: usize>(
    method: (BasisName, TransferName),
    particles: usize,
    effects: bool,
) -> (usize, i64) {
    let mut solver = None;
    let heap = measure(|| {
        let mut setup = free_body::<D>(method, SchemeName::Musl);
        let mut to = Vector::<D>::from_element(0.26);
        to[0] = 0.01 * particles as f64 + 0.25;
        let block = Block { from: Vector::from_element(0.25), to, density: 1.0 };
        setup.particles = Particles::fill(&block, 0.01, 1);
        setup.particles.v.fill(Vector::zeros());
        if effects {
            let gravity = Gravity(Box::new(|t| Vector::<D>::from_element(-9.81 * t)));
            let force = BodyForce::pointwise(|x, t| x * t);
            let damping = Damping(Box::new(|t| 0.1 * t));
            let start = |x: &Vector<D>| (x[0], Vector::zeros());
            let heat = Heat::new(0.1, 1.0, &mut setup.particles, start);
            let source = Box::new(|_: f64, _: &Particles<D>, into: &mut [f64]| into.fill(0.1));
            setup.effects = vec![
                Box::new(gravity),
                Box::new(force),
                Box::new(damping),
                Box::new(heat.with_source(source)),
                Box::new(ThermalExpansion::in_rate_form(1e-4, 0.0, 1.0, 0.3)),
            ];
        }
        let mut made = Solver::new(setup).unwrap();
        made.step(1e-6).unwrap();
        solver = Some(made);
    });
    let profile = solver.unwrap().profile();
    assert_eq!(profile.particles, particles);
    let columns = profile.columns.iter().filter(|column| column.holder == Holder::Particle);
    let said = columns.map(|column| column.entries * column.bytes).sum();
    (said, heap.bytes_current)
}

fn says_what_it_keeps<const D: usize>() {
    // Taylor least squares is excluded: it stores points in cells, whose number does not depend on
    // the number of particles alone.
    for method in methods().filter(|(_, transfer)| *transfer != TransferName::Tls) {
        for effects in [false, true] {
            let (few, many) = (kept::<D>(method, 20, effects), kept::<D>(method, 100, effects));
            let (said, held) = (many.0 - few.0, many.1 - few.1);
            assert_eq!(said as i64, held, "{D}-D {method:?}, effects: {effects}, 80 particles");
        }
    }
}

#[rstest]
fn declared_columns_account_for_the_heap(#[values(1, 2, 3)] dimension: usize) {
    in_dimension!(dimension, says_what_it_keeps());
}

fn conductor_holds_its_memory<const D: usize>() {
    for &basis in BasisName::ALL {
        let Setup { kernel, grid, mut particles, .. } =
            free_body::<D>((basis, TransferName::Flip), SchemeName::Musl);
        let heat = heat(&mut particles, (&grid, basis));
        let mut body = HeatSolver::new(kernel, grid, particles, vec![Box::new(heat)]).unwrap();
        holds_its_memory(&format!("{D}-D {basis:?}"), &mut body, DT);
    }
}

#[rstest]
fn a_step_of_heat_in_a_body_at_rest_allocates_nothing(#[values(1, 2, 3)] dimension: usize) {
    in_dimension!(dimension, conductor_holds_its_memory());
}

/// The law uses the whole deformation.
#[test]
fn thermal_expansion_allocates_in_the_first_step_only() {
    let mut setup = free_body::<2>((BasisName::Linear, TransferName::Flip), SchemeName::Musl);
    setup.material = MaterialPlan::Hencky { young: 1.0, poisson: 0.0 }.build();
    let heat = heat(&mut setup.particles, (&setup.grid, BasisName::Linear));
    let expansion = ThermalExpansion::of_deformation(1e-4, 0.0);
    setup.effects = vec![Box::new(heat), Box::new(expansion)];
    holds_its_memory("split", &mut Solver::new(setup).unwrap(), DT);
}

#[test]
fn all_schemes_are_tested() {
    assert_eq!(SchemeName::ALL, [SchemeName::Usf, SchemeName::Usl, SchemeName::Musl]);
}

/// Creates a bar under a body force, fixed on the left and pulled on the right.
fn loaded_bar(element: Element, mass: Mass, start: Start, sampling: Sampling) -> Bar {
    let setup = fem::BarSetup {
        from: 0.0,
        to: 1.0,
        cells: 12,
        element,
        mass,
        density: 1.0,
        law: Box::new(|def_grad| 100.0 * (def_grad - 1.0)),
        fixed: [true, false],
        body_force: Some(fem::pointwise(|x, t| x * t)),
        traction: [None, Some(Box::new(|t| 0.1 * t))],
        initial_displacement: Box::new(|_| 0.0),
        initial_velocity: Box::new(|x| 0.1 * x),
        start,
        sampling,
    };
    Bar::new(setup).unwrap()
}

#[rstest]
fn a_fem_step_after_the_first_allocates_nothing(
    #[values(Start::AtZero, Start::HalfStepBack)] start: Start,
    #[values(Sampling::Inside, Sampling::Nodes)] sampling: Sampling,
) {
    for &element in Element::ALL {
        for &mass in Mass::ALL {
            let name = format!("{element:?} {mass:?} {start:?} {sampling:?}");
            holds_its_memory(&name, &mut loaded_bar(element, mass, start, sampling), 5e-4);
        }
    }
}
