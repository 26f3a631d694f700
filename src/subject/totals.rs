//! Sums over a body.

use serde::{Deserialize, Serialize};

/// Sums over the body, p, of what a motion without outer forces keeps; components beyond the
/// dimension are zero.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Totals {
    /// `sum m_p` (kg).
    pub mass: f64,
    /// `sum m_p v_p` (kg m/s).
    pub momentum: [f64; 3],
    /// `sum m_p |v_p|`, against which a change of the momentum is small or not (kg m/s).
    pub momentum_size: f64,
    /// `sum m_p x_p x v_p` about the origin, and what particles carry within themselves (kg m2/s).
    /// In 2-D the third component only; zero in 1-D.
    pub angular_momentum: [f64; 3],
    /// The sum of the magnitudes of those terms (kg m2/s).
    pub angular_momentum_size: f64,
    /// `sum m_p v_p^2 / 2` (J).
    pub kinetic_energy: f64,
    /// Energy that the material stores (J); `None` if its law has none.
    pub strain_energy: Option<f64>,
}

impl Totals {
    /// Adds a particle of this mass (kg), velocity (m/s) and angular momentum (kg m2/s).
    pub fn add(&mut self, mass: f64, velocity: [f64; 3], spin: [f64; 3]) {
        let speed = velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
        self.mass += mass;
        self.momentum_size += mass * speed;
        self.kinetic_energy += 0.5 * mass * speed * speed;
        self.angular_momentum_size += libm::hypot(libm::hypot(spin[0], spin[1]), spin[2]);
        for i in 0..3 {
            self.momentum[i] += mass * velocity[i];
            self.angular_momentum[i] += spin[i];
        }
    }

    /// Kinetic and stored energy together (J).
    pub fn energy(&self) -> Option<f64> {
        self.strain_energy.map(|stored| self.kinetic_energy + stored)
    }

    /// The sums over two bodies.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        let sum = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| a[i] + b[i]);
        Self {
            mass: self.mass + other.mass,
            momentum: sum(self.momentum, other.momentum),
            momentum_size: self.momentum_size + other.momentum_size,
            angular_momentum: sum(self.angular_momentum, other.angular_momentum),
            angular_momentum_size: self.angular_momentum_size + other.angular_momentum_size,
            kinetic_energy: self.kinetic_energy + other.kinetic_energy,
            strain_energy: self.strain_energy.zip(other.strain_energy).map(|(a, b)| a + b),
        }
    }
}
