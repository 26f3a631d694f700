//! Measures trace and determinant of a step of the solver from its nodal velocities.
//!
//! Two starts of a frozen run, one with velocities and one with stresses, give two series of nodal
//! velocities of one wave. Both satisfy `y(k+2) = tr y(k+1) - det y(k)`, which determines trace and
//! determinant.

use crate::common;
use mpm_solvers::mpm::{
    BasisName, Block, FrameName, MassName, Particles, SchemeName, Setup, Solver, Spline,
    TransferName, Vector, WaveMethod, WaveStep, WaveSymbols, WaveTransfer, combine, mass_matrix,
    transfer,
};
use mpm_subject::{Perturbable, Subject};
use rstest::rstest;
use std::f64::consts::TAU;

/// Number of cells of the row. It is odd: with an even number, a wave of two cells would make the
/// consistent mass matrix of linear functions singular for one particle per cell.
const CELLS: usize = 9;

/// Cell size (m); Young's modulus (Pa) is 1, density (kg/m3) 4, and the wave speed 1/2 m/s.
const H: f64 = 0.25;
const DENSITY: f64 = 4.0;
const SPEED: f64 = 0.5;

/// Amplitude of velocities (m/s) and stresses (Pa). It is so small that products of two amplitudes
/// vanish by rounding.
const AMPLITUDE: f64 = 1e-30;

/// Maximum error of trace and determinant.
const TOLERANCE: f64 = 1e-12;

/// Maximum logarithm of the factor of a step in a moving run without damping: motions of 1e-6 cells
/// change the symbols by this order.
const UNDAMPED: f64 = 1e-6;

/// Domains of particles. The closed form is that of a mean over a domain.
const DOMAINS: [(BasisName, Spline); 3] = [
    (BasisName::UniformGimp, Spline::Gimp(2)),
    (BasisName::ContiguousGimp, Spline::Gimp(2)),
    (BasisName::Cpdi, Spline::Cpdi(2)),
];

const BASES: [(BasisName, Spline); 3] = [
    (BasisName::Linear, Spline::Linear),
    (BasisName::QuadraticBSpline, Spline::Quadratic),
    (BasisName::CubicBSpline, Spline::Cubic),
];

/// A row of cells with `ppc` particles in each.
struct Row {
    method: (BasisName, TransferName, MassName),
    scheme: SchemeName,
    ppc: usize,
    /// Translation of all particles, in cells.
    shift: f64,
    courant: f64,
}

/// Nodal velocity of a wave in one step: real and imaginary part.
type Amplitude = [f64; 2];

/// Returns the phase (rad) at `x` (m) of a wave with `periods` periods in the row.
fn phase(x: f64, periods: usize) -> f64 {
    TAU * periods as f64 * x / (CELLS as f64 * H)
}

/// Sets the particle velocities (m/s) or stresses (Pa) to a wave with `periods` periods in the row.
fn start(solver: &mut Solver<1>, periods: usize, starts_with_stress: bool, size: f64) {
    let count = solver.particles().len();
    let mut state = Vec::new();
    solver.state(&mut state);
    for p in 0..count {
        let phase = phase(solver.particles().x[p][0], periods);
        let number = if starts_with_stress { count + p } else { p };
        state[number] = size * libm::sin(phase);
    }
    solver.set_state(&state);
}

/// Computes trace and determinant by least squares over real and imaginary parts of all series.
/// Each series is divided by its largest number.
fn fit(series: &[Vec<Amplitude>]) -> (f64, f64) {
    let mut normal = [[0.0; 3]; 2];
    for series in series {
        let size = series.iter().flatten().fold(0.0_f64, |most, y| most.max(y.abs()));
        for part in 0..2 {
            for three in series.windows(3) {
                let [y0, y1, y2] = [0, 1, 2].map(|k| three[k][part] / size);
                for (row, factor) in normal.iter_mut().zip([y1, -y0]) {
                    for (entry, value) in row.iter_mut().zip([y1, -y0, y2]) {
                        *entry += factor * value;
                    }
                }
            }
        }
    }
    let [[a, b, e], [c, d, f]] = normal;
    let scale = a * d - b * c;
    ((e * d - b * f) / scale, (a * f - e * c) / scale)
}

impl Row {
    fn solver(&self) -> Solver<1> {
        let (basis, name, mass) = self.method;
        let to = Vector::<1>::new(CELLS as f64 * H);
        let block = Block { from: Vector::zeros(), to, density: DENSITY };
        let mut particles = Particles::fill(&block, H, self.ppc);
        for x in &mut particles.x {
            x[0] += self.shift * H;
        }
        let setup = common::body((basis, name), self.scheme, particles, (H, CELLS));
        let grid = setup.kernel.grid(Vector::zeros(), H, [CELLS], [true]);
        let parts = Setup {
            grid,
            mass: mass_matrix(mass),
            transfer: transfer(name),
            material: Box::new(mpm_solvers::mpm::LinearElastic::new(1.0, 0.0)),
            ..setup
        };
        Solver::new(parts).expect("a solver")
    }

    /// Returns the nodal velocities of the wave, divided by `size`, after each of `steps` steps.
    fn record(
        &self,
        solver: &mut Solver<1>,
        periods: usize,
        steps: usize,
        size: f64,
    ) -> Vec<Amplitude> {
        let step = |_| {
            solver.step(self.courant * H / SPEED).expect("a step");
            let grid = solver.grid();
            let mut sum = [0.0; 2];
            for (node, v) in grid.velocity.iter().enumerate() {
                let phase = phase(self.method.0.place(grid, node)[0], periods);
                sum[0] += v[0] * libm::cos(phase) / size;
                sum[1] += v[0] * libm::sin(phase) / size;
            }
            sum
        };
        (0..steps).map(step).collect()
    }

    /// Measures trace and determinant of a frozen run, from three steps after each of two starts.
    fn measure(&self, periods: usize) -> (f64, f64) {
        let series = [false, true].map(|starts_with_stress| {
            let mut solver = self.solver();
            solver.fix_configuration();
            start(&mut solver, periods, starts_with_stress, AMPLITUDE);
            self.record(&mut solver, periods, 3, AMPLITUDE)
        });
        fit(&series)
    }

    /// Returns trace and determinant by the closed form.
    fn predict(&self, spline: Spline, wave: WaveTransfer, periods: usize) -> WaveStep {
        let theta = TAU * periods as f64 / CELLS as f64;
        let regular = WaveSymbols::shifted_positions(self.ppc as u32, 0.0);
        let positions: Vec<f64> = regular.iter().map(|xi| xi + self.shift).collect();
        WaveStep::new(wave, self.scheme, &WaveSymbols::new(spline, theta, &positions))
    }

    fn assert_agrees(&self, spline: Spline, wave: WaveTransfer, periods: usize) {
        let (trace, determinant) = self.measure(periods);
        let step = self.predict(spline, wave, periods);
        let errors = [
            (trace - step.trace(self.courant)).abs(),
            (determinant - step.determinant(self.courant)).abs(),
        ];
        let place = format!(
            "{spline:?} {wave:?} {:?}, ppc {}, {periods} periods, shift {}",
            self.scheme, self.ppc, self.shift
        );
        assert!(errors.iter().all(|error| *error <= TOLERANCE), "{place}: {errors:?}");
    }
}

/// Compares waves of 9, 4.5 and 3 cells with the closed form.
fn all_waves(name: TransferName, mass: MassName, wave: WaveTransfer, ppc: usize, shift: f64) {
    let fits = |basis: BasisName| combine(basis, name, mass, FrameName::Updated).is_ok();
    for (basis, spline) in BASES.into_iter().filter(|(basis, _)| fits(*basis)) {
        for scheme in SchemeName::ALL {
            for periods in [1, 2, 3] {
                let method = (basis, name, mass);
                let row = Row { method, scheme: *scheme, ppc, shift, courant: 0.4 };
                row.assert_agrees(spline, wave, periods);
            }
        }
    }
}

/// Every registered transfer of velocity must have a closed form, except Taylor least squares. Only
/// FLIP has one for the consistent mass matrix.
#[rstest]
fn steps_have_the_predicted_trace_and_determinant(#[values(1, 2, 3, 4)] ppc: usize) {
    let methods =
        TransferName::ALL.iter().flat_map(|name| MassName::ALL.iter().map(|m| (*name, *m)));
    for (name, mass) in methods {
        let wave = WaveTransfer::of(name.into(), mass);
        let is_known = match mass {
            MassName::Lumped => name != TransferName::Tls,
            MassName::Consistent => name == TransferName::Flip,
        };
        assert_eq!(wave.is_some(), is_known, "{name:?} {mass:?}");
        if let Some(wave) = wave {
            all_waves(name, mass, wave, ppc, 0.0);
        }
    }
}

/// Returns the closed form of a transfer with the lumped mass matrix.
fn wave_of(name: TransferName) -> WaveTransfer {
    WaveTransfer::of(name.into(), MassName::Lumped).expect("a closed form")
}

/// If particles are shifted by a fraction of a cell, the symbols change but the formulas do not.
#[rstest]
fn shifted_particles_have_the_predicted_trace_and_determinant(
    #[values(TransferName::Flip, TransferName::Apic, TransferName::Fmpm2, TransferName::Mls)]
    name: TransferName,
    #[values(1, 3)] ppc: usize,
) {
    all_waves(name, MassName::Lumped, wave_of(name), ppc, 0.1);
}

/// Runs cover twenty periods of a body whose particles move. A run ends earlier if damping has
/// reduced the amplitude to a millionth.
#[rstest]
#[case::flip_usl(TransferName::Flip, SchemeName::Usl)]
#[case::flip_musl(TransferName::Flip, SchemeName::Musl)]
#[case::pic_musl(TransferName::Pic, SchemeName::Musl)]
#[case::apic_usl(TransferName::Apic, SchemeName::Usl)]
#[case::apic_musl(TransferName::Apic, SchemeName::Musl)]
#[case::xpic_2_usl(TransferName::Xpic2, SchemeName::Usl)]
#[case::fmpm_2_usl(TransferName::Fmpm2, SchemeName::Usl)]
fn moving_particles_have_the_predicted_phase_error_and_damping(
    #[case] name: TransferName,
    #[case] scheme: SchemeName,
    #[values(0, 1, 2)] basis: usize,
) {
    let ((basis, spline), size) = (BASES[basis], 1e-6 * SPEED);
    let row =
        Row { method: (basis, name, MassName::Lumped), scheme, ppc: 2, shift: 0.0, courant: 0.4 };
    let step = row.predict(spline, wave_of(name), 1);
    let (angle, kept) = (TAU / CELLS as f64 * row.courant, step.largest_modulus(row.courant));
    let least = libm::log(1e-6) / libm::log(kept);
    let steps = if kept < 1.0 { least.min(20.0 * TAU / angle) } else { 20.0 * TAU / angle };
    let mut solver = row.solver();
    start(&mut solver, 1, false, size);
    let series = row.record(&mut solver, 1, steps as usize, size);
    let (trace, determinant) = fit(std::slice::from_ref(&series));
    let turned = libm::atan2((4.0 * determinant - trace * trace).sqrt(), trace);
    let (found, expected) = (turned / angle - 1.0, step.phase_error(row.courant).unwrap());
    assert!((found / expected - 1.0).abs() <= 0.02, "phase error {found}, expected {expected}");
    let (found, expected) = (0.5 * libm::log(determinant), libm::log(kept));
    let error = (found - expected).abs();
    assert!(error <= 0.02 * expected.abs() + UNDAMPED, "ln |l| is {found}, expected {expected}");
}

/// Domains of two particles per cell lie inside cells, or extend across their corners.
#[rstest]
fn domains_have_the_predicted_trace_and_determinant(
    #[values(TransferName::Flip, TransferName::Pic, TransferName::Apic)] name: TransferName,
    #[values(0.0, 0.1)] shift: f64,
) {
    for (basis, spline) in DOMAINS {
        for periods in [1, 2, 3] {
            let method = (basis, name, MassName::Lumped);
            let row = Row { method, scheme: SchemeName::Usl, ppc: 2, shift, courant: 0.4 };
            row.assert_agrees(spline, wave_of(name), periods);
        }
    }
}

/// The bases in suites must have the closed forms that are verified above.
#[test]
fn names_of_bases_have_their_closed_forms() {
    for (basis, spline) in BASES.into_iter().chain(DOMAINS) {
        assert_eq!(Spline::of(basis, 2), spline);
    }
}

/// The measurement must detect an error of one part in a thousand in the determinant.
#[test]
fn a_wrong_formula_is_detected() {
    let method = (BasisName::QuadraticBSpline, TransferName::Flip99, MassName::Lumped);
    assert!(combine(method.0, method.1, method.2, FrameName::Updated).is_ok());
    let row = Row { method, scheme: SchemeName::Usl, ppc: 2, shift: 0.0, courant: 0.4 };
    let (_, determinant) = row.measure(1);
    let wrong = row.predict(Spline::Quadratic, WaveTransfer::Flip, 1).determinant(0.4);
    assert!((determinant - wrong).abs() > 1e-3, "{determinant} against {wrong}");
    // The method of the published values must be that of the solver.
    let method = WaveMethod {
        spline: Spline::Quadratic,
        ppc: 2,
        shift: 0.0,
        transfer: WaveTransfer::Blend(0.99),
        scheme: SchemeName::Usl,
    };
    let error = (determinant - method.step(TAU / CELLS as f64).determinant(0.4)).abs();
    assert!(error <= TOLERANCE, "{error:e}");
}
