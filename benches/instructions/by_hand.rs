//! The original MPM, written by hand: linear functions, FLIP, MUSL, linear elasticity, 1-D. It is
//! the reference for the overhead of the general solver.
//!
//! The loops are the five steps of Wobbes & Tielen (2015), with the checks of a usable solver: no
//! particle leaves the grid, is inverted or becomes NaN. Changes of cells are counted.

pub(crate) struct ByHand {
    pub(crate) h: f64,
    pub(crate) young: f64,
    pub(crate) x: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) mass: Vec<f64>,
    pub(crate) vol0: Vec<f64>,
    pub(crate) vol: Vec<f64>,
    pub(crate) sigma: Vec<f64>,
    pub(crate) cell: Vec<usize>,
    pub(crate) node_mass: Vec<f64>,
    pub(crate) force: Vec<f64>,
    pub(crate) acceleration: Vec<f64>,
    pub(crate) velocity: Vec<f64>,
    pub(crate) crossings: u64,
    pub(crate) min_j: f64,
}

impl ByHand {
    /// Returns the cell of a particle, and the weights of its two nodes.
    fn seen(&self, p: usize) -> (usize, f64, f64) {
        let s = self.x[p] / self.h;
        let cell = (s as usize).min(self.node_mass.len() - 2);
        let right = s - cell as f64;
        (cell, 1.0 - right, right)
    }

    /// Makes one step of length `dt` (s).
    pub(crate) fn step(&mut self, dt: f64) -> Result<(), String> {
        self.map_mass_and_force();
        for i in 0..self.node_mass.len() {
            let m = self.node_mass[i];
            self.acceleration[i] = if m > 0.0 { self.force[i] / m } else { 0.0 };
        }
        self.advance_velocities(dt);
        for i in 0..self.node_mass.len() {
            let m = self.node_mass[i];
            self.velocity[i] = if m > 0.0 { self.velocity[i] / m } else { 0.0 };
        }
        self.advance_stresses_and_positions(dt)
    }

    fn map_mass_and_force(&mut self) {
        self.node_mass.fill(0.0);
        self.force.fill(0.0);
        for p in 0..self.x.len() {
            let (i, left, right) = self.seen(p);
            self.node_mass[i] += self.mass[p] * left;
            self.node_mass[i + 1] += self.mass[p] * right;
            let flux = self.sigma[p] * self.vol[p] / self.h;
            self.force[i] += flux;
            self.force[i + 1] -= flux;
        }
    }

    /// Accelerates the particles, and maps their new momenta to the nodes.
    fn advance_velocities(&mut self, dt: f64) {
        self.velocity.fill(0.0);
        for p in 0..self.x.len() {
            let (i, left, right) = self.seen(p);
            self.v[p] += (self.acceleration[i] * left + self.acceleration[i + 1] * right) * dt;
            let momentum = self.v[p] * self.mass[p];
            self.velocity[i] += momentum * left;
            self.velocity[i + 1] += momentum * right;
        }
    }

    fn advance_stresses_and_positions(&mut self, dt: f64) -> Result<(), String> {
        let cells = (self.node_mass.len() - 1) as f64;
        for p in 0..self.x.len() {
            let (i, left, right) = self.seen(p);
            let (a, b) = (self.velocity[i], self.velocity[i + 1]);
            let rate = (b - a) / self.h;
            self.sigma[p] += self.young * rate * dt;
            self.vol[p] *= 1.0 + rate * dt;
            let j = self.vol[p] / self.vol0[p];
            self.min_j = self.min_j.min(j);
            if !(j > 0.0 && j.is_finite()) {
                return Err(format!("particle {p} is inverted, J = {j}"));
            }
            self.x[p] += (a * left + b * right) * dt;
            let s = self.x[p] / self.h;
            if !(s >= 0.0 && s <= cells) {
                return Err(format!("particle {p} left the domain"));
            }
            let now = s as usize;
            self.crossings += u64::from(now != self.cell[p]);
            self.cell[p] = now;
        }
        Ok(())
    }
}
