//! A whole step of MLS-MPM in 2-D: quadratic B-splines, update stress last, neo-Hookean.

/// Particles and grid, with a column for each quantity.
pub(crate) struct Body {
    pub(crate) x: Vec<[f64; 2]>,
    pub(crate) v: Vec<[f64; 2]>,
    /// B_p (m^2/s).
    pub(crate) b: Vec<[[f64; 2]; 2]>,
    /// F_p.
    pub(crate) f: Vec<[[f64; 2]; 2]>,
    /// V_p sigma_p (J).
    pub(crate) flux: Vec<[[f64; 2]; 2]>,
    pub(crate) m: f64,
    pub(crate) volume: f64,
    /// Mass, momentum and force of each node.
    pub(crate) nodes: Vec<[f64; 5]>,
}

/// Returns the first of three nodes on each axis, with their weights and distances (m).
#[inline(always)]
fn weights(x: &[f64; 2], h: f64) -> ([usize; 2], [[f64; 3]; 2], [[f64; 3]; 2]) {
    let (mut base, mut w, mut d) = ([0; 2], [[0.0; 3]; 2], [[0.0; 3]; 2]);
    for a in 0..2 {
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
pub(crate) fn step(body: &mut Body, (h, n, dt): (f64, [usize; 2], f64), (lambda, mu): (f64, f64)) {
    let inverse = 4.0 / (h * h);
    body.nodes.fill([0.0; 5]);
    for p in 0..body.x.len() {
        let (base, w, d) = weights(&body.x[p], h);
        let (mut c, mut flux) = (body.b[p], body.flux[p]);
        for r in 0..2 {
            for s in 0..2 {
                c[r][s] *= inverse;
                flux[r][s] *= -inverse;
            }
        }
        for j in 0..3 {
            for i in 0..3 {
                let node = base[0] + i + n[0] * (base[1] + j);
                let weight = w[0][i] * w[1][j];
                let arm = [d[0][i], d[1][j]];
                let at = &mut body.nodes[node];
                at[0] += weight * body.m;
                for r in 0..2 {
                    let (mut value, mut force) = (body.v[p][r], 0.0);
                    for s in 0..2 {
                        value += c[r][s] * arm[s];
                        force += flux[r][s] * arm[s];
                    }
                    at[1 + r] += weight * body.m * value;
                    at[3 + r] += weight * force;
                }
            }
        }
    }
    for at in &mut body.nodes {
        if at[0] > 0.0 {
            for r in 0..2 {
                at[1 + r] = (at[1 + r] + dt * at[3 + r]) / at[0];
            }
        }
    }
    for p in 0..body.x.len() {
        let (base, w, d) = weights(&body.x[p], h);
        let (mut v, mut b) = ([0.0; 2], [[0.0; 2]; 2]);
        for j in 0..3 {
            for i in 0..3 {
                let node = base[0] + i + n[0] * (base[1] + j);
                let weight = w[0][i] * w[1][j];
                let arm = [d[0][i], d[1][j]];
                for r in 0..2 {
                    let value = weight * body.nodes[node][1 + r];
                    v[r] += value;
                    for s in 0..2 {
                        b[r][s] += value * arm[s];
                    }
                }
            }
        }
        let (old, mut f) = (body.f[p], body.f[p]);
        for r in 0..2 {
            for s in 0..2 {
                for q in 0..2 {
                    f[r][s] += dt * inverse * b[r][q] * old[q][s];
                }
            }
        }
        let j = f[0][0] * f[1][1] - f[0][1] * f[1][0];
        let pressure = lambda * libm::log(j) - mu;
        for r in 0..2 {
            for s in 0..2 {
                let mut left = 0.0;
                for q in 0..2 {
                    left += f[r][q] * f[s][q];
                }
                let own = if r == s { pressure } else { 0.0 };
                body.flux[p][r][s] = body.volume * (mu * left + own);
            }
            body.x[p][r] += dt * v[r];
        }
        (body.v[p], body.b[p], body.f[p]) = (v, b, f);
    }
}
