//! Whole steps of FLIP in 1-D: hat functions, neo-Hookean law, stress updated last (USL and MUSL).

/// Particles and grid, with a column for each quantity.
pub(crate) struct Body {
    pub(crate) x: Vec<f64>,
    pub(crate) v: Vec<f64>,
    /// F_p.
    pub(crate) f: Vec<f64>,
    /// V_p sigma_p (J).
    pub(crate) flux: Vec<f64>,
    pub(crate) m: f64,
    pub(crate) volume: f64,
    /// Mass, velocity and acceleration of each node.
    pub(crate) nodes: Vec<[f64; 3]>,
}

/// Returns the first of two nodes, and the weights and slopes (1/m) of both.
#[inline(always)]
fn hats(x: f64, h: f64) -> (usize, [f64; 2], [f64; 2]) {
    let s = x / h;
    let base = s as usize;
    let f = s - base as f64;
    (base, [1.0 - f, f], [-1.0 / h, 1.0 / h])
}

/// Makes one step of length `dt` (s) on a grid of cells `h` (m).
#[inline(never)]
pub(crate) fn step(body: &mut Body, (h, dt): (f64, f64), (lambda, mu): (f64, f64)) {
    body.nodes.fill([0.0; 3]);
    for p in 0..body.x.len() {
        let (base, w, slope) = hats(body.x[p], h);
        for i in 0..2 {
            let at = &mut body.nodes[base + i];
            at[0] += w[i] * body.m;
            at[1] += w[i] * body.m * body.v[p];
            at[2] -= slope[i] * body.flux[p];
        }
    }
    for at in &mut body.nodes {
        if at[0] > 0.0 {
            at[2] /= at[0];
            at[1] = at[1] / at[0] + dt * at[2];
        }
    }
    for p in 0..body.x.len() {
        let (base, w, slope) = hats(body.x[p], h);
        let (mut a, mut u, mut gradient) = (0.0, 0.0, 0.0);
        for i in 0..2 {
            a += w[i] * body.nodes[base + i][2];
            u += w[i] * body.nodes[base + i][1];
            gradient += slope[i] * body.nodes[base + i][1];
        }
        body.v[p] += dt * a;
        body.f[p] += dt * gradient * body.f[p];
        let j = body.f[p];
        body.flux[p] = body.volume * (lambda * libm::log(j) - mu + mu * j * j);
        body.x[p] += dt * u;
    }
}

/// Makes one step of MUSL: FLIP with a second map of momentum to the grid.
#[inline(never)]
pub(crate) fn musl_step(body: &mut Body, (h, dt): (f64, f64), (lambda, mu): (f64, f64)) {
    body.nodes.fill([0.0; 3]);
    for p in 0..body.x.len() {
        let (base, w, slope) = hats(body.x[p], h);
        for i in 0..2 {
            let at = &mut body.nodes[base + i];
            at[0] += w[i] * body.m;
            at[2] -= slope[i] * body.flux[p];
        }
    }
    for at in &mut body.nodes {
        if at[0] > 0.0 {
            at[2] /= at[0];
        }
    }
    for p in 0..body.x.len() {
        let (base, w, _) = hats(body.x[p], h);
        let a = w[0] * body.nodes[base][2] + w[1] * body.nodes[base + 1][2];
        body.v[p] += dt * a;
        for i in 0..2 {
            body.nodes[base + i][1] += w[i] * body.m * body.v[p];
        }
    }
    for at in &mut body.nodes {
        if at[0] > 0.0 {
            at[1] /= at[0];
        }
    }
    for p in 0..body.x.len() {
        let (base, w, slope) = hats(body.x[p], h);
        let (mut u, mut gradient) = (0.0, 0.0);
        for i in 0..2 {
            u += w[i] * body.nodes[base + i][1];
            gradient += slope[i] * body.nodes[base + i][1];
        }
        body.f[p] += dt * gradient * body.f[p];
        let j = body.f[p];
        body.flux[p] = body.volume * (lambda * libm::log(j) - mu + mu * j * j);
        body.x[p] += dt * u;
    }
}
