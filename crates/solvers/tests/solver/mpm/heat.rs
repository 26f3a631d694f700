//! Conduction of heat on the grid.

use approx::assert_relative_eq;
use mpm_solvers::mpm::{
    BasisName, Block, Effect, Grid, Heat, HeatSource, Kernel, Particles, Side, Thermal,
    ThermalBoundary, Vector, kernel,
};
use mpm_subject::Failure;
use rstest::rstest;

const H: f64 = 0.25;

fn plate(basis: BasisName) -> (Box<dyn Kernel<2>>, Grid<2>, Particles<2>) {
    let (from, to) = (Vector::zeros(), Vector::<2>::new(1.0, 0.5));
    let kernel = kernel::<2>(basis);
    let mut particles = Particles::fill(&Block { from, to, density: 3.0 }, H, 2);
    particles.track_domains();
    let mut grid = kernel.grid(from, H, [4, 2], [false; 2]);
    kernel.p2g_mass(&particles, &mut grid);
    (kernel, grid, particles)
}

/// The heat of the particles must increase by the inflow: 7 W/m through an edge of 0.5 m, and 5
/// W/kg in 1.5 kg.
#[rstest]
fn heat_is_conserved(
    #[values(BasisName::Linear, BasisName::Cpdi, BasisName::CubicBSpline)] basis: BasisName,
) {
    let (kernel, grid, mut particles) = plate(basis);
    let start = |x: &Vector<2>| (libm::sin(9.0 * x[0]) * x[1], Vector::zeros());
    let heat = Heat::new(0.1, 2.0, &mut particles, start);
    let flux = Thermal::Inflow(Box::new(|_, _, _| 7.0));
    let face = ThermalBoundary::new(&grid, basis, &particles, 0, Side::High, flux);
    let source: HeatSource<2> = Box::new(|_, _, into| into.fill(5.0));
    let mut heat = heat.with_faces(vec![face]).with_source(source);
    let content = |particles: &Particles<2>| -> f64 {
        let all = particles.mass.iter().zip(&particles.temperature);
        all.map(|(m, value)| 2.0 * m * value).sum()
    };
    let before = content(&particles);
    for step in 0..5 {
        let t = 0.01 * f64::from(step);
        heat.integrate_state(t, 0.01, &mut particles, kernel.as_ref(), &grid).unwrap();
    }
    let gained = content(&particles) - before;
    assert_relative_eq!(gained, 0.05 * (7.0 * 0.5 + 5.0 * 1.5), max_relative = 1e-12);
}

/// In a body of uniform temperature there is no flux. Forward Euler must subtract r dt of the
/// temperature in each step.
#[test]
fn source_uses_the_temperature_at_the_start_of_the_step() {
    for &basis in BasisName::ALL {
        let (kernel, grid, mut particles) = plate(basis);
        let (capacity, r, dt) = (2.0, 3.0, 0.1);
        let heat = Heat::new(0.1, capacity, &mut particles, |_| (5.0, Vector::zeros()));
        let mut heat = heat.with_source(Box::new(move |_, particles, into| {
            for (into, value) in into.iter_mut().zip(&particles.temperature) {
                *into = -r * capacity * value;
            }
        }));
        let mut expected = 5.0;
        for _ in 0..4 {
            heat.integrate_state(0.0, dt, &mut particles, kernel.as_ref(), &grid).unwrap();
            expected *= 1.0 - r * dt;
            for value in &particles.temperature {
                assert_relative_eq!(*value, expected, max_relative = 1e-12);
            }
        }
    }
}

#[test]
fn nan_temperature_is_reported() {
    let (kernel, grid, mut particles) = plate(BasisName::Linear);
    let source: HeatSource<2> = Box::new(|_, _, into| into[3] = f64::INFINITY);
    let start = |_: &Vector<2>| (0.0, Vector::zeros());
    let mut heat = Heat::new(1.0, 1.0, &mut particles, start).with_source(source);
    let found = heat.integrate_state(0.0, 0.1, &mut particles, kernel.as_ref(), &grid);
    assert!(matches!(found, Err(Failure::NonFinite { quantity: "temperature", .. })));
}
