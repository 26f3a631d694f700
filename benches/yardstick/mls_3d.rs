//! A whole step of MLS-MPM in 3-D: quadratic B-splines, update stress last, neo-Hookean.

/// Particles and grid, with a column for each quantity.
pub(crate) struct Body {
    pub(crate) x: Vec<[f64; 3]>,
    pub(crate) v: Vec<[f64; 3]>,
    /// B_p (m^2/s).
    pub(crate) b: Vec<[[f64; 3]; 3]>,
    /// F_p.
    pub(crate) f: Vec<[[f64; 3]; 3]>,
    /// V_p sigma_p (J).
    pub(crate) flux: Vec<[[f64; 3]; 3]>,
    pub(crate) m: f64,
    pub(crate) volume: f64,
    /// Mass, momentum and force of each node.
    pub(crate) nodes: Vec<[f64; 7]>,
}

/// Returns the first of three nodes on each axis, with their weights and distances (m).
#[inline(always)]
pub(super) fn weights(x: &[f64; 3], h: f64) -> ([usize; 3], [[f64; 3]; 3], [[f64; 3]; 3]) {
    let (mut base, mut w, mut d) = ([0; 3], [[0.0; 3]; 3], [[0.0; 3]; 3]);
    for a in 0..3 {
        let s = x[a] / h;
        base[a] = s as usize;
        let f = s - base[a] as f64;
        w[a] = [0.5 * (1.0 - f) * (1.0 - f), 0.5 + f * (1.0 - f), 0.5 * f * f];
        d[a] = [(-0.5 - f) * h, (0.5 - f) * h, (1.5 - f) * h];
    }
    (base, w, d)
}

/// Makes one step of length `dt` (s) on a grid of cells `h` (m) with `n` nodes along each axis.
#[inline(never)]
pub(crate) fn step(body: &mut Body, (h, n, dt): (f64, [usize; 3], f64), (lambda, mu): (f64, f64)) {
    let inverse = 4.0 / (h * h);
    body.nodes.fill([0.0; 7]);
    for p in 0..body.x.len() {
        let (base, w, d) = weights(&body.x[p], h);
        let (mut c, mut flux) = (body.b[p], body.flux[p]);
        for r in 0..3 {
            for s in 0..3 {
                c[r][s] *= inverse;
                flux[r][s] *= -inverse;
            }
        }
        for k in 0..3 {
            for j in 0..3 {
                for i in 0..3 {
                    let node = base[0] + i + n[0] * (base[1] + j + n[1] * (base[2] + k));
                    let weight = w[0][i] * w[1][j] * w[2][k];
                    let arm = [d[0][i], d[1][j], d[2][k]];
                    let at = &mut body.nodes[node];
                    at[0] += weight * body.m;
                    for r in 0..3 {
                        let (mut value, mut force) = (body.v[p][r], 0.0);
                        for s in 0..3 {
                            value += c[r][s] * arm[s];
                            force += flux[r][s] * arm[s];
                        }
                        at[1 + r] += weight * body.m * value;
                        at[4 + r] += weight * force;
                    }
                }
            }
        }
    }
    for at in &mut body.nodes {
        if at[0] > 0.0 {
            for r in 0..3 {
                at[1 + r] = (at[1 + r] + dt * at[4 + r]) / at[0];
            }
        }
    }
    for p in 0..body.x.len() {
        let (base, w, d) = weights(&body.x[p], h);
        let (mut v, mut b) = ([0.0; 3], [[0.0; 3]; 3]);
        for k in 0..3 {
            for j in 0..3 {
                for i in 0..3 {
                    let node = base[0] + i + n[0] * (base[1] + j + n[1] * (base[2] + k));
                    let weight = w[0][i] * w[1][j] * w[2][k];
                    let arm = [d[0][i], d[1][j], d[2][k]];
                    for r in 0..3 {
                        let value = weight * body.nodes[node][1 + r];
                        v[r] += value;
                        for s in 0..3 {
                            b[r][s] += value * arm[s];
                        }
                    }
                }
            }
        }
        deform(body, p, (dt * inverse, &b), (lambda, mu));
        for r in 0..3 {
            body.x[p][r] += dt * v[r];
        }
        (body.v[p], body.b[p]) = (v, b);
    }
}

/// Updates F and stress of particle `p` for the strain increment `factor` times `rate`.
#[inline(always)]
pub(super) fn deform(
    body: &mut Body,
    p: usize,
    (factor, rate): (f64, &[[f64; 3]; 3]),
    (lambda, mu): (f64, f64),
) {
    let (old, mut f) = (body.f[p], body.f[p]);
    for r in 0..3 {
        for s in 0..3 {
            for q in 0..3 {
                f[r][s] += factor * rate[r][q] * old[q][s];
            }
        }
    }
    let minor = |i: usize, j: usize| f[1][i] * f[2][j] - f[1][j] * f[2][i];
    let j = f[0][0] * minor(1, 2) - f[0][1] * minor(0, 2) + f[0][2] * minor(0, 1);
    let pressure = lambda * libm::log(j) - mu;
    for r in 0..3 {
        for s in 0..3 {
            let mut left = 0.0;
            for q in 0..3 {
                left += f[r][q] * f[s][q];
            }
            let own = if r == s { pressure } else { 0.0 };
            body.flux[p][r][s] = body.volume * (mu * left + own);
        }
    }
    body.f[p] = f;
}
