//! Quadratic B-splines in 2-D, APIC.

/// Computes mass and momentum of the nodes (`n` along each axis) from particles with the affine
/// field `v + B D^-1 (x_i - x)`.
#[inline(never)]
#[allow(clippy::too_many_arguments)] // as plain as can be
pub(crate) fn p2g(
    h: f64,
    n: [usize; 2],
    x: &[[f64; 2]],
    v: &[[f64; 2]],
    b: &[[[f64; 2]; 2]],
    m: &[f64],
    mass: &mut [f64],
    momentum: &mut [[f64; 2]],
) {
    mass.fill(0.0);
    momentum.fill([0.0; 2]);
    for p in 0..x.len() {
        let (mut base, mut w, mut d) = ([0; 2], [[0.0; 3]; 2], [[0.0; 3]; 2]);
        for a in 0..2 {
            let s = x[p][a] / h;
            base[a] = s as usize;
            let f = s - base[a] as f64;
            w[a] = [0.5 * (1.0 - f) * (1.0 - f), 0.5 + f * (1.0 - f), 0.5 * f * f];
            d[a] = [(-0.5 - f) * h, (0.5 - f) * h, (1.5 - f) * h];
        }
        let mut c = b[p];
        for row in &mut c {
            for value in row {
                *value *= 4.0 / (h * h);
            }
        }
        for j in 0..3 {
            for i in 0..3 {
                let node = base[0] + i + n[0] * (base[1] + j);
                let weight = m[p] * w[0][i] * w[1][j];
                let arm = [d[0][i], d[1][j]];
                mass[node] += weight;
                for r in 0..2 {
                    let mut value = v[p][r];
                    for s in 0..2 {
                        value += c[r][s] * arm[s];
                    }
                    momentum[node][r] += weight * value;
                }
            }
        }
    }
}

/// Computes velocity and first moment of the particles from nodal velocities.
#[inline(never)]
pub(crate) fn g2p(
    h: f64,
    n: [usize; 2],
    x: &[[f64; 2]],
    velocity: &[[f64; 2]],
    v: &mut [[f64; 2]],
    b: &mut [[[f64; 2]; 2]],
) {
    for p in 0..x.len() {
        let (mut base, mut w, mut d) = ([0; 2], [[0.0; 3]; 2], [[0.0; 3]; 2]);
        for a in 0..2 {
            let s = x[p][a] / h;
            base[a] = s as usize;
            let f = s - base[a] as f64;
            w[a] = [0.5 * (1.0 - f) * (1.0 - f), 0.5 + f * (1.0 - f), 0.5 * f * f];
            d[a] = [(-0.5 - f) * h, (0.5 - f) * h, (1.5 - f) * h];
        }
        let (mut new_v, mut new_b) = ([0.0; 2], [[0.0; 2]; 2]);
        for j in 0..3 {
            for i in 0..3 {
                let node = base[0] + i + n[0] * (base[1] + j);
                let weight = w[0][i] * w[1][j];
                let arm = [d[0][i], d[1][j]];
                for r in 0..2 {
                    let value = weight * velocity[node][r];
                    new_v[r] += value;
                    for s in 0..2 {
                        new_b[r][s] += value * arm[s];
                    }
                }
            }
        }
        (v[p], b[p]) = (new_v, new_b);
    }
}
