//! Quadratic B-splines in 3-D, APIC.

/// Computes mass and momentum of the nodes (`n` along each axis) from particles with the affine
/// field `v + B D^-1 (x_i - x)`.
#[inline(never)]
#[allow(clippy::too_many_arguments)] // as plain as can be
pub(crate) fn p2g(
    h: f64,
    n: [usize; 3],
    x: &[[f64; 3]],
    v: &[[f64; 3]],
    b: &[[[f64; 3]; 3]],
    m: &[f64],
    mass: &mut [f64],
    momentum: &mut [[f64; 3]],
) {
    mass.fill(0.0);
    momentum.fill([0.0; 3]);
    for p in 0..x.len() {
        let (mut base, mut w, mut d) = ([0; 3], [[0.0; 3]; 3], [[0.0; 3]; 3]);
        for a in 0..3 {
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
        for k in 0..3 {
            for j in 0..3 {
                for i in 0..3 {
                    let node = base[0] + i + n[0] * (base[1] + j + n[1] * (base[2] + k));
                    let weight = m[p] * w[0][i] * w[1][j] * w[2][k];
                    let arm = [d[0][i], d[1][j], d[2][k]];
                    mass[node] += weight;
                    for r in 0..3 {
                        let mut value = v[p][r];
                        for s in 0..3 {
                            value += c[r][s] * arm[s];
                        }
                        momentum[node][r] += weight * value;
                    }
                }
            }
        }
    }
}

/// Computes velocity and first moment of the particles from nodal velocities.
#[inline(never)]
pub(crate) fn g2p(
    h: f64,
    n: [usize; 3],
    x: &[[f64; 3]],
    velocity: &[[f64; 3]],
    v: &mut [[f64; 3]],
    b: &mut [[[f64; 3]; 3]],
) {
    for p in 0..x.len() {
        let (mut base, mut w, mut d) = ([0; 3], [[0.0; 3]; 3], [[0.0; 3]; 3]);
        for a in 0..3 {
            let s = x[p][a] / h;
            base[a] = s as usize;
            let f = s - base[a] as f64;
            w[a] = [0.5 * (1.0 - f) * (1.0 - f), 0.5 + f * (1.0 - f), 0.5 * f * f];
            d[a] = [(-0.5 - f) * h, (0.5 - f) * h, (1.5 - f) * h];
        }
        let (mut new_v, mut new_b) = ([0.0; 3], [[0.0; 3]; 3]);
        for k in 0..3 {
            for j in 0..3 {
                for i in 0..3 {
                    let node = base[0] + i + n[0] * (base[1] + j + n[1] * (base[2] + k));
                    let weight = w[0][i] * w[1][j] * w[2][k];
                    let arm = [d[0][i], d[1][j], d[2][k]];
                    for r in 0..3 {
                        let value = weight * velocity[node][r];
                        new_v[r] += value;
                        for s in 0..3 {
                            new_b[r][s] += value * arm[s];
                        }
                    }
                }
            }
        }
        (v[p], b[p]) = (new_v, new_b);
    }
}
