//! Whole steps of APIC and FLIP in 3-D, with forces and strains from gradients of quadratic
//! B-splines. The stress is updated last (USL), and the law is neo-Hookean.

use super::mls_3d::{Body, deform, weights};

/// Returns the slopes of the weights on each axis (1/m), from the distances of the nodes (m).
#[inline(always)]
fn slopes(d: &[[f64; 3]; 3], h: f64) -> [[f64; 3]; 3] {
    let mut slopes = [[0.0; 3]; 3];
    for a in 0..3 {
        let f = -0.5 - d[a][0] / h;
        slopes[a] = [(f - 1.0) / h, (1.0 - 2.0 * f) / h, f / h];
    }
    slopes
}

/// Makes one step of APIC or FLIP of length `dt` (s) on a grid of cells `h` (m) with `n` nodes
/// along each axis.
#[inline(never)]
pub(crate) fn step<const APIC: bool>(
    body: &mut Body,
    (h, n, dt): (f64, [usize; 3], f64),
    lame: (f64, f64),
) {
    let inverse = 4.0 / (h * h);
    body.nodes.fill([0.0; 7]);
    for p in 0..body.x.len() {
        let (base, w, d) = weights(&body.x[p], h);
        let (g, mut c) = (slopes(&d, h), body.b[p]);
        for r in 0..3 {
            for s in 0..3 {
                c[r][s] *= inverse;
            }
        }
        for k in 0..3 {
            for j in 0..3 {
                for i in 0..3 {
                    let node = base[0] + i + n[0] * (base[1] + j + n[1] * (base[2] + k));
                    let weight = w[0][i] * w[1][j] * w[2][k];
                    let arm = [d[0][i], d[1][j], d[2][k]];
                    let (x, y) = (g[0][i] * w[1][j] * w[2][k], w[0][i] * g[1][j] * w[2][k]);
                    let slope = [x, y, w[0][i] * w[1][j] * g[2][k]];
                    let at = &mut body.nodes[node];
                    at[0] += weight * body.m;
                    for r in 0..3 {
                        let (mut value, mut force) = (body.v[p][r], 0.0);
                        for s in 0..3 {
                            if APIC {
                                value += c[r][s] * arm[s];
                            }
                            force += body.flux[p][r][s] * slope[s];
                        }
                        at[1 + r] += weight * body.m * value;
                        at[4 + r] -= force;
                    }
                }
            }
        }
    }
    for at in &mut body.nodes {
        if at[0] > 0.0 {
            for r in 0..3 {
                at[4 + r] /= at[0];
                at[1 + r] = at[1 + r] / at[0] + dt * at[4 + r];
            }
        }
    }
    for p in 0..body.x.len() {
        let (base, w, d) = weights(&body.x[p], h);
        let g = slopes(&d, h);
        let (mut v, mut change) = ([0.0; 3], [0.0; 3]);
        let (mut b, mut rate) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
        for k in 0..3 {
            for j in 0..3 {
                for i in 0..3 {
                    let node = base[0] + i + n[0] * (base[1] + j + n[1] * (base[2] + k));
                    let weight = w[0][i] * w[1][j] * w[2][k];
                    let arm = [d[0][i], d[1][j], d[2][k]];
                    let (x, y) = (g[0][i] * w[1][j] * w[2][k], w[0][i] * g[1][j] * w[2][k]);
                    let slope = [x, y, w[0][i] * w[1][j] * g[2][k]];
                    let at = &body.nodes[node];
                    for r in 0..3 {
                        v[r] += weight * at[1 + r];
                        if !APIC {
                            change[r] += weight * at[4 + r];
                        }
                        for s in 0..3 {
                            if APIC {
                                b[r][s] += weight * at[1 + r] * arm[s];
                            }
                            rate[r][s] += at[1 + r] * slope[s];
                        }
                    }
                }
            }
        }
        deform(body, p, (dt, &rate), lame);
        for r in 0..3 {
            body.x[p][r] += dt * v[r];
            body.v[p][r] = if APIC { v[r] } else { body.v[p][r] + dt * change[r] };
        }
        body.b[p] = b;
    }
}
