//! Hat functions in 1-D, FLIP.

/// Computes mass and momentum of the nodes.
#[inline(never)]
pub(crate) fn p2g(h: f64, x: &[f64], v: &[f64], m: &[f64], mass: &mut [f64], momentum: &mut [f64]) {
    mass.fill(0.0);
    momentum.fill(0.0);
    for p in 0..x.len() {
        let s = x[p] / h;
        let base = s as usize;
        let f = s - base as f64;
        let w = [1.0 - f, f];
        for i in 0..2 {
            mass[base + i] += w[i] * m[p];
            momentum[base + i] += w[i] * m[p] * v[p];
        }
    }
}

/// Changes particle velocities by nodal accelerations, and computes positions from nodal
/// velocities.
#[inline(never)]
pub(crate) fn g2p(
    (h, dt): (f64, f64),
    x: &[f64],
    (velocity, acceleration): (&[f64], &[f64]),
    v: &mut [f64],
    carried: &mut [f64],
) {
    for p in 0..x.len() {
        let s = x[p] / h;
        let base = s as usize;
        let f = s - base as f64;
        let w = [1.0 - f, f];
        let (mut a, mut u) = (0.0, 0.0);
        for i in 0..2 {
            a += w[i] * acceleration[base + i];
            u += w[i] * velocity[base + i];
        }
        v[p] += dt * a;
        carried[p] = x[p] + dt * u;
    }
}
