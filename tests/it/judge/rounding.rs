//! The rounding bound, compared with a one-dimensional MPM in single and in double precision.

use mpm_verify::verify::{NormName, rounding_bound, single_precision_spacing};
use rstest::rstest;

/// Runs a periodic bar on `[origin, origin + 1]` with E = rho = 1 and P = E (F - 1), whose initial
/// velocity is `amplitude sin(2 pi X)`. Returns the final positions and the number of cell changes.
/// Linear basis functions, two particles per cell, FLIP, MUSL, updated Lagrangian, a start at t = 0
/// and the Courant number 0.4. Every operation has the precision of the type.
macro_rules! periodic_bar {
    ($name:ident, $real:ty) => {
        fn $name(origin: f64, cells: usize, amplitude: f64, steps: usize) -> (Vec<f64>, usize) {
            let origin = origin as $real;
            let h = 1.0 / cells as $real;
            let dt = 0.4 * h;
            let label = |p: usize| origin + h * (0.25 + 0.5 * p as $real);
            let mut x: Vec<$real> = (0..2 * cells).map(label).collect();
            let wave = |p: usize| {
                let share = (0.25 + 0.5 * p as f64) / cells as f64;
                (amplitude * libm::sin(2.0 * std::f64::consts::PI * share)) as $real
            };
            let mut v: Vec<$real> = (0..2 * cells).map(wave).collect();
            let mut f: Vec<$real> = vec![1.0; 2 * cells];
            let m = 0.5 * h;
            let cell_of = |x: $real| ((x - origin) / h).floor();
            let mut crossings = 0;
            for _ in 0..steps {
                let places: Vec<(usize, usize, $real)> = x
                    .iter()
                    .map(|x| {
                        let cell = cell_of(*x);
                        let left = (cell as i64).rem_euclid(cells as i64) as usize;
                        (left, (left + 1) % cells, (*x - origin) / h - cell)
                    })
                    .collect();
                let mut mass: Vec<$real> = vec![0.0; cells];
                let mut momentum: Vec<$real> = vec![0.0; cells];
                let mut force: Vec<$real> = vec![0.0; cells];
                for (p, (i, j, s)) in places.iter().enumerate() {
                    mass[*i] += (1.0 - s) * m;
                    mass[*j] += s * m;
                    momentum[*i] += (1.0 - s) * m * v[p];
                    momentum[*j] += s * m * v[p];
                    let pull = m * f[p] * (f[p] - 1.0) / h;
                    force[*i] += pull;
                    force[*j] -= pull;
                }
                for (p, (i, j, s)) in places.iter().enumerate() {
                    let moved = |k: usize| (momentum[k] + dt * force[k]) / mass[k];
                    let pushed = |k: usize| dt * force[k] / mass[k];
                    x[p] += dt * ((1.0 - s) * moved(*i) + s * moved(*j));
                    v[p] += (1.0 - s) * pushed(*i) + s * pushed(*j);
                }
                momentum.fill(0.0);
                for (p, (i, j, s)) in places.iter().enumerate() {
                    momentum[*i] += (1.0 - s) * m * v[p];
                    momentum[*j] += s * m * v[p];
                }
                for (p, (i, j, _)) in places.iter().enumerate() {
                    let gradient = (momentum[*j] / mass[*j] - momentum[*i] / mass[*i]) / h;
                    f[p] += dt * gradient * f[p];
                    let cell = (cell_of(x[p]) as i64).rem_euclid(cells as i64) as usize;
                    crossings += usize::from(cell != *i);
                }
            }
            (x.iter().map(|x| f64::from(*x)).collect(), crossings)
        }
    };
}

periodic_bar!(in_single_precision, f32);
periodic_bar!(in_double_precision, f64);

/// Returns the root mean square and the maximum of the values.
fn norms(values: &[f64]) -> [f64; 2] {
    let squares: f64 = values.iter().map(|x| x * x).sum();
    [(squares / values.len() as f64).sqrt(), values.iter().fold(0.0, |most, x| most.max(x.abs()))]
}

/// If no particle changes its cell and displacements are above 20 times the bound, the rounding
/// error is 0.02 to 1 times the bound in the RMS norm, and below the bound in the maximum norm.
#[rstest]
#[case::first_binade(0.0, &[1e-2, 1e-3, 1e-4])]
#[case::second_binade(1.0, &[1e-2, 1e-3])]
#[case::far_from_the_origin(7.0, &[1e-2, 1e-3])]
fn the_bound_is_above_the_rounding_error(#[case] origin: f64, #[case] amplitudes: &[f64]) {
    let spacing = single_precision_spacing(origin + 1.0).expect("a spacing");
    let mut compared = Vec::new();
    for amplitude in amplitudes {
        for cells in [32, 64, 128] {
            // The run ends at t = 0.25 s.
            let steps = (0.25 / 0.4 * cells as f64).round() as usize;
            let (single, crossings) = in_single_precision(origin, cells, *amplitude, steps);
            let (double, _) = in_double_precision(origin, cells, *amplitude, steps);
            let label = |p: usize| origin + (0.25 + 0.5 * p as f64) / cells as f64;
            let u: Vec<f64> = double.iter().enumerate().map(|(p, x)| x - label(p)).collect();
            let error: Vec<f64> = single.iter().zip(&double).map(|(a, b)| a - b).collect();
            let bound = |norm| rounding_bound(steps as u64, spacing, norm);
            let ([rms, most], [size, _]) = (norms(&error), norms(&u));
            if crossings > 0 || !(size > 20.0 * bound(NormName::Rms)) {
                continue;
            }
            let ratio = rms / bound(NormName::Rms);
            assert!(ratio > 0.02 && ratio < 1.0, "A = {amplitude}, {cells} cells: r = {ratio}");
            assert!(most < bound(NormName::Linf), "A = {amplitude}, {cells} cells: {most}");
            compared.push((*amplitude, cells, ratio));
        }
    }
    assert!(compared.len() >= 4, "{compared:?}");
}
