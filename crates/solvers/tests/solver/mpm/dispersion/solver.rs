//! Measures trace and determinant of a step of the solver from its nodal velocities.
//!
//! Two starts of a frozen run, one with velocities and one with stresses, give two series of nodal
//! velocities of one wave. Both satisfy `y(k+2) = tr y(k+1) - det y(k)`, which determines trace and
//! determinant.

use crate::common;
use mpm_solvers::mpm::{
    BasisName, Block, FrameName, MassName, Particles, SchemeName, Setup, Solver, Spline,
    TransferName, Vector, WaveMethod, WaveStep, WaveTransfer, combine, mass_matrix, transfer,
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

/// Computes trace and determinant by least squares over real and imaginary parts of all series.
/// Each series is divided by its largest number.
fn fit(series: &[[Amplitude; 3]; 2]) -> (f64, f64) {
    let mut normal = [[0.0; 3]; 2];
    for series in series {
        let size = series.iter().flatten().fold(0.0_f64, |most, y| most.max(y.abs()));
        for part in 0..2 {
            let [y0, y1, y2] = series.map(|y| y[part] / size);
            for (row, factor) in normal.iter_mut().zip([y1, -y0]) {
                for (entry, value) in row.iter_mut().zip([y1, -y0, y2]) {
                    *entry += factor * value;
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

    /// Measures trace and determinant of a frozen run, from the nodal velocities in three steps
    /// after each of two starts: from a wave of velocities (m/s), and from one of stresses (Pa).
    fn measure(&self, periods: usize) -> (f64, f64) {
        let series = [false, true].map(|starts_with_stress| {
            let mut solver = self.solver();
            solver.fix_configuration();
            let (count, mut state) = (solver.particles().len(), Vec::new());
            solver.state(&mut state);
            for (p, x) in solver.particles().x.iter().enumerate() {
                let number = if starts_with_stress { count + p } else { p };
                state[number] = AMPLITUDE * libm::sin(phase(x[0], periods));
            }
            solver.set_state(&state);
            [(); 3].map(|()| {
                solver.step(self.courant * H / SPEED).expect("a step");
                let (grid, mut sum) = (solver.grid(), [0.0; 2]);
                for (node, v) in grid.velocity.iter().enumerate() {
                    let phase = phase(self.method.0.place(grid, node)[0], periods);
                    sum[0] += v[0] * libm::cos(phase) / AMPLITUDE;
                    sum[1] += v[0] * libm::sin(phase) / AMPLITUDE;
                }
                sum
            })
        });
        fit(&series)
    }

    /// Returns trace and determinant by the closed form.
    fn predict(&self, spline: Spline, wave: WaveTransfer, periods: usize) -> WaveStep {
        let (ppc, scheme) = (self.ppc as u32, self.scheme);
        let method = WaveMethod { spline, ppc, shift: self.shift, transfer: wave, scheme };
        method.step(TAU * periods as f64 / CELLS as f64)
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
