//! P2G and G2P without a step: particles anywhere in the grid, of any mass, with any stress.

use crate::common::{H, in_dimension, pairs};
use approx::assert_abs_diff_eq;
use mpm_solvers::mpm::{
    Block, Grid, Kernel, Matrix, Particles, Stage, Vector, g2p, kernel, transfer,
};
use proptest::array::uniform3;
use proptest::collection::vec;
use proptest::prelude::*;

const CELLS: usize = 4;

/// Position relative to the length of the grid, velocity (m/s), stress (Pa), mass (kg) and volume
/// (m^D) of a particle.
type Row = ([f64; 3], [f64; 3], [[f64; 3]; 3], f64, f64);

fn rows() -> impl Strategy<Value = Vec<Row>> {
    let place = prop_oneof![3 => 0.0..=1.0_f64, 1 => (0..=CELLS).prop_map(|i| i as f64 / 4.0)];
    let stress = uniform3(uniform3(-1e3..1e3_f64));
    let row = (uniform3(place), uniform3(-9.0..9.0_f64), stress);
    let row = (row, 1e-3..1e3_f64, 1e-3..1e3_f64);
    vec(row.prop_map(|((x, v, sigma), mass, vol)| (x, v, sigma, mass, vol)), 1..40)
}

fn grid<const D: usize>(kernel: &dyn Kernel<D>) -> Grid<D> {
    kernel.grid(Vector::zeros(), H, [CELLS; D], [false; D])
}

fn cloud<const D: usize>(rows: &[Row]) -> Particles<D> {
    let side = H * CELLS as f64;
    let x: Vec<_> = rows.iter().map(|row| Vector::from_fn(|i, _| row.0[i] * side)).collect();
    let vol: Vec<_> = rows.iter().map(|row| row.4).collect();
    let block = Block { from: Vector::zeros(), to: Vector::from_element(H), density: 1.0 };
    Particles {
        x0: x.clone(),
        x,
        v: rows.iter().map(|row| Vector::from_fn(|i, _| row.1[i])).collect(),
        mass: rows.iter().map(|row| row.3).collect(),
        vol0: vol.clone(),
        vol,
        sigma: rows.iter().map(|row| Matrix::from_fn(|i, j| row.2[i.min(j)][i.max(j)])).collect(),
        def_grad: vec![Matrix::identity(); rows.len()],
        domain: vec![Matrix::identity() * (0.5 * H); rows.len()],
        grad_v: vec![Matrix::zeros(); rows.len()],
        ..Particles::fill(&block, H, 1)
    }
}

/// A fit through particles close to one line gives large nodal values of both signs. Rounding is
/// relative to these, not to their sum.
fn p2g_keeps<const D: usize>(rows: &[Row]) {
    let particles = cloud::<D>(rows);
    for (basis, name) in pairs() {
        let (kernel, mut transfer) = (kernel::<D>(basis), transfer::<D>(name));
        let kernel = kernel.as_ref();
        let mut grid = grid(kernel);
        transfer.start(kernel, &grid, &particles);
        transfer.p2g(kernel, &particles, &mut grid, &[Stage::Mass, Stage::Momentum]);
        let (before, after): (f64, f64) = (particles.mass.iter().sum(), grid.mass.iter().sum());
        let of_nodes = grid.mass.iter().map(|mass| mass.abs()).sum();
        assert_abs_diff_eq!(after, before, epsilon = 1e-14 * before.max(of_nodes));

        let each = || particles.v.iter().zip(&particles.mass).map(|(v, m)| v * *m);
        let change = grid.velocity.iter().sum::<Vector<D>>() - each().sum::<Vector<D>>();
        let size: f64 = each().map(|momentum| momentum.norm()).sum();
        let size = size.max(grid.velocity.iter().map(Vector::norm).sum());
        assert_abs_diff_eq!(change.norm(), 0.0, epsilon = 1e-14 * size);

        transfer.p2g(kernel, &particles, &mut grid, &[Stage::Force]);
        let size: f64 =
            particles.sigma.iter().zip(&particles.vol).map(|(s, vol)| s.norm() * vol / H).sum();
        let size = size.max(grid.force.iter().map(Vector::norm).sum());
        let total = grid.force.iter().sum::<Vector<D>>();
        assert_abs_diff_eq!(total.norm(), 0.0, epsilon = 1e-14 * size);
    }
}

fn translation_is_exact<const D: usize>(rows: &[Row]) {
    let mut before = cloud::<D>(rows);
    let velocity = Vector::<D>::from_fn(|i, _| rows[0].1[i]);
    before.v.fill(velocity * 0.5);
    for (basis, name) in pairs() {
        let (kernel, mut transfer) = (kernel::<D>(basis), transfer::<D>(name));
        let kernel = kernel.as_ref();
        let mut grid = grid(kernel);
        let mut after = before.clone();
        transfer.start(kernel, &grid, &after);
        transfer.p2g(kernel, &after, &mut grid, &[Stage::Mass]);
        grid.velocity.fill(velocity);
        grid.acceleration.fill(velocity);
        let mut advected = before.x.clone();
        let stages = [Stage::ParticleVelocity, Stage::Stress, Stage::Position];
        g2p(&mut *transfer, kernel, &grid, 0.5, &mut after, &stages, &mut advected);
        for p in 0..before.len() {
            let dv = after.v[p] - before.v[p] - velocity * 0.5;
            let dx = advected[p] - before.x[p] - velocity * 0.5;
            assert_abs_diff_eq!(dv.norm(), 0.0, epsilon = 1e-14 * 20.0);
            assert_abs_diff_eq!(dx.norm(), 0.0, epsilon = 1e-14 * 20.0);
            assert_abs_diff_eq!(after.grad_v[p].norm(), 0.0, epsilon = 1e-14 * 20.0 / H);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(60) })]

    /// The internal forces of any stress add up to zero.
    #[test]
    fn p2g_conserves_mass_and_linear_momentum(rows in rows(), dimension in 1..=3_usize) {
        in_dimension!(dimension, p2g_keeps(&rows));
    }

    #[test]
    fn g2p_of_a_rigid_translation_is_exact(rows in rows(), dimension in 1..=3_usize) {
        in_dimension!(dimension, translation_is_exact(&rows));
    }
}
