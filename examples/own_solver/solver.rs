//! A one-dimensional Material Point Method: linear functions, FLIP, MUSL (Sulsky, Zhou & Schreyer
//! 1995). It stands for your own solver and does not depend on mpm-verify.

/// An elastic bar on a grid of equal cells.
pub(crate) struct Bar {
    /// Lowest corner (m), cell size (m), number of cells.
    pub(crate) grid: (f64, f64, usize),
    /// Whether the first and the last node are fixed.
    pub(crate) held: [bool; 2],
    /// Ratio of stress to strain (Pa).
    pub(crate) modulus: f64,
    pub(crate) x: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) mass: Vec<f64>,
    pub(crate) volume: Vec<f64>,
    pub(crate) stress: Vec<f64>,
    /// Number of particle-node pairs that were visited.
    pub(crate) visits: u64,
}

/// The first node of a particle's cell, with the values and slopes of its two functions.
type Cell = (usize, [f64; 2], [f64; 2]);

impl Bar {
    /// Makes one step of length `dt` (s).
    ///
    /// # Errors
    /// The number of a particle that has left the grid.
    pub(crate) fn step(&mut self, dt: f64) -> Result<(), usize> {
        let cells =
            (0..self.x.len()).map(|p| self.cell(p)).collect::<Result<Vec<Cell>, usize>>()?;
        let mass = self.p2g(&cells, |p, value, _| self.mass[p] * value);
        let force = self.p2g(&cells, |p, _, slope| -self.volume[p] * self.stress[p] * slope);
        let acceleration = self.per_mass(&force, &mass);
        for (p, cell) in cells.iter().enumerate() {
            self.v[p] += dt * g2p(&acceleration, cell.0, cell.1);
        }
        let momentum = self.p2g(&cells, |p, value, _| self.mass[p] * self.v[p] * value);
        let velocity = self.per_mass(&momentum, &mass);
        for (p, (node, values, slopes)) in cells.iter().enumerate() {
            let strain = dt * g2p(&velocity, *node, *slopes);
            self.volume[p] *= 1.0 + strain;
            self.stress[p] += self.modulus * strain;
            self.x[p] += dt * g2p(&velocity, *node, *values);
        }
        // Each particle has two nodes and five transfers: mass, force and momentum to the grid;
        // acceleration, and velocity with its gradient, back.
        self.visits += 10 * cells.len() as u64;
        Ok(())
    }

    fn cell(&self, p: usize) -> Result<Cell, usize> {
        let (origin, h, cells) = self.grid;
        let s = (self.x[p] - origin) / h;
        if !(0.0..=cells as f64).contains(&s) {
            return Err(p);
        }
        let node = (s as usize).min(cells - 1);
        let right = s - node as f64;
        Ok((node, [1.0 - right, right], [-1.0 / h, 1.0 / h]))
    }

    /// Sums a term of each particle at its two nodes. `term` gets the particle, and the value and
    /// slope of the function.
    fn p2g(&self, cells: &[Cell], term: impl Fn(usize, f64, f64) -> f64) -> Vec<f64> {
        let mut nodes = vec![0.0; self.grid.2 + 1];
        for (p, (node, values, slopes)) in cells.iter().enumerate() {
            for k in 0..2 {
                nodes[node + k] += term(p, values[k], slopes[k]);
            }
        }
        nodes
    }

    /// Divides nodal sums by nodal masses. The result is zero at empty nodes and at fixed nodes.
    fn per_mass(&self, sums: &[f64], mass: &[f64]) -> Vec<f64> {
        let [left, right] = self.held;
        let is_held = |i: usize| (left && i == 0) || (right && i == self.grid.2);
        let of_node = |i: usize| {
            if is_held(i) || mass[i] == 0.0 { 0.0 } else { sums[i] / mass[i] }
        };
        (0..sums.len()).map(of_node).collect()
    }
}

/// Interpolates a nodal field at a particle.
fn g2p(nodes: &[f64], first: usize, values: [f64; 2]) -> f64 {
    nodes[first] * values[0] + nodes[first + 1] * values[1]
}
