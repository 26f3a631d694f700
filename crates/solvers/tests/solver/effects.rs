//! Only the effects that a scene lists are simulated. Other effects are neither computed nor
//! stored. A listed effect adds exactly the cost in docs/effects.md, and the suites named there
//! verify it.

use crate::common::columns::columns;
use crate::common::effect::add;
use crate::common::{DT, free_body, in_dimension, methods};
use mpm_solvers::mpm::{
    BasisName, Block, Bodies, BodyOnGrid, Boundary, Effect, Fixed, Friction, Grid, Particles,
    Placement, Prescribed, Pressure, PressureField, Roller, SchemeName, Setup, Side, Solver,
    TransferName, Vector, kernel,
};
use mpm_subject::{ColumnSize, Holder, Profile, Subject};
use mpm_suites::study;
use mpm_suites::suite::EffectName;
use rstest::rstest;

/// Returns every column of the particles as bits. 0 and -0 have equal bits, because `f + 0` changes
/// the sign.
fn bits<const D: usize>(particles: &Particles<D>) -> Vec<u64> {
    let (temperature, others) = columns(particles);
    // A missing temperature equals a temperature of zero.
    let warm = temperature.iter().filter(|value| **value != 0.0);
    warm.chain(&others).map(|v| (v + 0.0).to_bits()).collect()
}

fn stepped<const D: usize>(setup: Setup<D>) -> Vec<u64> {
    let mut solver = Solver::new(setup).unwrap();
    (0..20).for_each(|_| solver.step(DT).unwrap());
    bits(solver.particles())
}

/// Compares a body without the effect, with zero strength and with a positive strength.
fn is_absent_or_null<const D: usize>(method: (BasisName, TransferName), scheme: SchemeName) {
    let plain = stepped(free_body::<D>(method, scheme));
    let mut setup = free_body::<D>(method, scheme);
    setup.particles.track_deformation();
    let with_deformation = stepped(setup);
    for &name in EffectName::ALL {
        let with = |size: f64| {
            let mut setup = free_body::<D>(method, scheme);
            add(name, &mut setup, method.0, size);
            let reads_deformation = setup.effects.iter().any(|effect| effect.reads_deformation());
            (stepped(setup), reads_deformation)
        };
        let what = format!("{D}-D {method:?} {scheme:?}: `{}`", name.name());
        let (null, reads_deformation) = with(0.0);
        let without = if reads_deformation { &with_deformation } else { &plain };
        // For a prescribed velocity, zero strength is a velocity of zero, which changes the motion.
        if name != EffectName::PrescribedVelocity {
            assert!(&null == without, "{what} of no strength is not the same as none");
        }
        assert!(&with(0.1).0 != without, "{what} does nothing");
    }
}

#[rstest]
fn an_effect_of_no_strength_is_none_bit_for_bit(
    #[values(1, 2, 3)] dimension: usize,
    #[values(
        (BasisName::Linear, TransferName::Flip),
        (BasisName::ContiguousGimp, TransferName::Apic)
    )]
    method: (BasisName, TransferName),
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
) {
    in_dimension!(dimension, is_absent_or_null(method, scheme));
}

/// Returns the profile of the second step of the free body, with linear functions, FLIP and MUSL.
fn taken(add: impl FnOnce(&mut Setup<2>)) -> Profile {
    let mut setup = free_body::<2>((BasisName::Linear, TransferName::Flip), SchemeName::Musl);
    add(&mut setup);
    let mut solver = Solver::new(setup).unwrap();
    solver.step(DT).unwrap();
    solver.take_visits();
    solver.step(DT).unwrap();
    Profile { passes: solver.passes(), visits: solver.take_visits(), ..solver.profile() }
}

#[test]
fn empty_scene_has_only_the_columns_of_the_original_mpm() {
    let empty = taken(|_| ());
    let named = |holder: Holder| -> Vec<(&str, usize)> {
        let of = empty.columns.iter().filter(|column| column.holder == holder);
        of.map(|column| (column.name, column.bytes)).collect()
    };
    let of_particles = [
        ("X", 16),
        ("x", 16),
        ("v", 16),
        ("mass", 8),
        ("V0", 8),
        ("V", 8),
        ("sigma", 32),
        ("grad v", 32),
        ("cell", 16),
        ("advected x", 16),
    ];
    assert_eq!(named(Holder::Particle), of_particles);
    let of_nodes = [("mass", 8), ("velocity", 16), ("force", 16), ("acceleration", 16)];
    assert_eq!(named(Holder::Node), of_nodes);
    let passes = [
        "P2G(mass, force)",
        "acceleration",
        "G2P(particle velocity)",
        "P2G(momentum)",
        "G2P(stress, position)",
    ];
    assert_eq!(empty.passes, passes);
    let visits = [
        "p2g mass",
        "p2g momentum",
        "p2g internal force",
        "g2p velocity",
        "g2p gradient",
        "g2p position",
    ];
    assert_eq!(empty.visits, visits.map(|name| (name, 36)));
}

/// Returns the members of `all` that are not in `some`.
fn added<T: PartialEq + Copy>(all: &[T], some: &[T]) -> Vec<T> {
    all.iter().filter(|one| !some.contains(one)).copied().collect()
}

/// Names of walls in suites. Each wall is on the low face of the second axis.
const WALLS: [&str; 4] = ["fixed", "roller", "velocity", "friction"];

fn wall(name: &str, grid: &Grid<2>) -> Box<dyn Boundary<2>> {
    match name {
        "fixed" => Box::new(Fixed::face(grid, 1, Side::Low)),
        "roller" => Box::new(Roller::face(grid, 1, Side::Low)),
        "friction" => Box::new(Friction::face(grid, 1, Side::Low, 0.3)),
        "velocity" => {
            let still = Box::new(|_: &Vector<2>, _| Vector::zeros());
            Box::new(Prescribed::face(grid, BasisName::Linear, 1, Side::Low, still))
        }
        other => unreachable!("no wall `{other}`"),
    }
}

/// Creates the row of docs/effects.md for an effect. `before` adds the effects that it requires.
fn row(name: &str, before: impl FnOnce(&mut Setup<2>), with: impl FnOnce(&mut Setup<2>)) -> String {
    row_of(name, &taken(before), &taken(with))
}

/// Creates the row for the columns and passes that are in `with` and not in `empty`.
fn row_of(name: &str, empty: &Profile, with: &Profile) -> String {
    let kept = |holder: Holder| {
        let held = |profile: &Profile| -> Vec<ColumnSize> {
            profile.columns.iter().filter(|column| column.holder == holder).copied().collect()
        };
        let text = |column: &ColumnSize| {
            let whole = column.entries == with.holders(holder);
            format!(
                "{} {} B{}",
                column.name,
                column.bytes,
                if whole { "" } else { " where it acts" }
            )
        };
        let columns: Vec<String> = added(&held(with), &held(empty)).iter().map(text).collect();
        if columns.is_empty() { "nothing".to_owned() } else { columns.join(", ") }
    };
    let particles = with.particles as u64;
    let text = |(part, visited): &(&str, u64)| {
        format!("{part}{}", if *visited < particles { " where it acts" } else { "" })
    };
    let visits: Vec<String> = added(&with.visits, &empty.visits).iter().map(text).collect();
    let visits = if visits.is_empty() { "nothing".to_owned() } else { visits.join(", ") };
    let (particle, node) = (kept(Holder::Particle), kept(Holder::Node));
    format!("| `{name}` | {particle} | {node} | {visits} |")
}

/// Whether a case of a suite has the effect. Every case is gated.
fn lists(suite: &str, effect: EffectName) -> bool {
    let suite = crate::common::suite(suite);
    suite.case_names().iter().any(|case| {
        study::profile(&suite, case, None)
            .is_some_and(|profile| profile.effects.contains(&effect.name()))
    })
}

/// Whether a suite has a wall with this name.
fn has_wall(suite: &str, name: &str) -> bool {
    let suite = crate::common::suite(suite);
    let Some(plan) = suite.convergence() else { return false };
    plan.scene.faces.iter().any(|face| face.condition() == name)
}

/// Asserts that docs/effects.md has the `rows`, and that `verifies` returns true for every suite at
/// the end of a row.
fn are_on_the_page(rows: &[(&str, String)], verifies: impl Fn(&str, &str) -> bool) {
    let page = include_str!("../../../../docs/effects.md");
    for (name, row) in rows {
        let found = page.lines().find_map(|line| line.strip_prefix(row.as_str()));
        let suites = found.unwrap_or_else(|| {
            let rows: Vec<&str> = rows.iter().map(|(_, row)| row.as_str()).collect();
            panic!("docs/effects.md: this table must hold\n{} `suite` |", rows.join(" `suite` |\n"))
        });
        let suites: Vec<&str> = suites.split('`').skip(1).step_by(2).collect();
        assert!(!suites.is_empty(), "docs/effects.md: no suite verifies `{name}`");
        for suite in suites {
            assert!(verifies(suite, name), "docs/effects.md: `{suite}` has no `{name}`");
        }
    }
}

#[test]
fn page_lists_columns_and_suites_of_each_effect() {
    let row = |&name: &EffectName| {
        let needed = |setup: &mut Setup<2>| {
            name.needs().iter().for_each(|needed| add(*needed, setup, BasisName::Linear, 0.1));
        };
        let with = |setup: &mut Setup<2>| add(name, setup, BasisName::Linear, 0.1);
        (name.name(), row(name.name(), needed, with))
    };
    let rows: Vec<(&str, String)> = EffectName::ALL.iter().map(row).collect();
    let named = |name: &str| *EffectName::ALL.iter().find(|one| one.name() == name).unwrap();
    are_on_the_page(&rows, |suite, name| lists(suite, named(name)));
}

/// Returns the profile of the second step of two bodies that overlap.
fn taken_by_two(friction: Option<f64>) -> Profile {
    let setup = |shift: f64| {
        let method = (BasisName::Linear, TransferName::Flip);
        let mut setup = free_body::<2>(method, SchemeName::Musl);
        setup.particles.x.iter_mut().for_each(|x| x[0] += shift);
        setup
    };
    let mut bodies = Bodies::new(vec![setup(0.0), setup(0.3)], friction).unwrap();
    bodies.step(DT).unwrap();
    bodies.take_visits();
    bodies.step(DT).unwrap();
    Profile { passes: bodies.passes(), visits: bodies.take_visits(), ..bodies.profile() }
}

#[test]
fn page_lists_columns_and_suites_of_contact_and_of_each_wall() {
    let row = row_of("contact", &taken_by_two(None), &taken_by_two(Some(0.3)));
    let has_contact = |suite: &str, _: &str| {
        crate::common::suite(suite).convergence().is_some_and(|plan| plan.scene.contact.is_some())
    };
    are_on_the_page(&[("contact", row)], has_contact);
    let rows = WALLS.map(|name| {
        let key = format!("{name} wall");
        (name, self::row(&key, |_| (), |setup| setup.boundary = vec![wall(name, &setup.grid)]))
    });
    are_on_the_page(&rows, has_wall);
}

/// The number of visits that a kernel counts equals the number of transfers in reports.
#[test]
fn visits_of_a_step_add_up_to_its_transfers() {
    // Taylor least squares sums over points in cells, while the kernel counts particles.
    for method in methods().filter(|(_, transfer)| *transfer != TransferName::Tls) {
        let mut setup = free_body::<2>(method, SchemeName::Musl);
        for name in [EffectName::Gravity, EffectName::BodyForce, EffectName::SetForce] {
            add(name, &mut setup, method.0, 0.1);
        }
        add(EffectName::ThermalExpansion, &mut setup, method.0, 0.1);
        let support = setup.kernel.support();
        let mut solver = Solver::new(setup).unwrap();
        solver.take_visits();
        (0..3).for_each(|_| solver.step(DT).unwrap());
        let visited: u64 = solver.take_visits().iter().map(|(_, visited)| visited).sum();
        assert_eq!(visited * support, solver.counters().transfers, "{method:?}");
    }
}

#[test]
fn missing_required_effect_is_refused() {
    for &effect in EffectName::ALL {
        assert!(!effect.needs().contains(&effect));
        let alone = EffectName::combine(&[effect]).is_ok();
        assert_eq!(alone, effect.needs().is_empty(), "`{}` alone", effect.name());
    }
}

/// A plate has moved to the right. The pressures must be those at the reference positions, X = 1/2
/// and 3/2.
#[test]
fn a_pressure_is_that_of_the_reference_place() {
    let (from, to) = (Vector::zeros(), Vector::<2>::new(2.0, 1.0));
    let mut plate = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, 1);
    plate.track_deformation();
    plate.positions_mut().iter_mut().for_each(|x| x[0] += 0.25);
    let kernel = kernel::<2>(BasisName::Linear);
    let mut grid = kernel.grid(Vector::zeros(), 1.0, [3, 2], [false; 2]);
    let value: PressureField<2> = Box::new(|x, _| x[0]);
    let mut pressure = Pressure::at(&plate, 1, Side::High, Placement::Particles, value);
    let mut body = BodyOnGrid { particles: &plate, kernel: kernel.as_ref(), grid: &mut grid };
    pressure.add_force(0.0, &mut body);
    let sum: Vector<2> = grid.force.iter().sum();
    assert!((sum - Vector::<2>::new(0.0, -2.0)).norm() < 1e-14, "{sum}");
}
