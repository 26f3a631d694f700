//! Functionals of the final state of a run, and the parameters of their derivatives.

use crate::{Samples, named};
use serde::Serialize;

named! {
    /// Parameters of a problem with respect to which functionals are differentiated.
    pub enum GradientParameter {
        /// Young's modulus (Pa).
        Young = "young",
        /// Poisson's ratio.
        Poisson = "poisson",
        /// Reference density (kg/m3). All masses are proportional to the density.
        Density = "density",
        /// Yield stress (Pa).
        Yield = "yield",
        /// Linear hardening modulus (Pa).
        Hardening = "hardening",
        /// Coefficient of friction on faces.
        Friction = "friction",
        /// Factor on the whole initial velocity field; its nominal value is 1.
        InitialVelocity = "initial_velocity",
    }
}

/// A functional of the final state. Sums run over the particles, with masses m, displacements u
/// and velocities v.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(tag = "functional", rename_all = "snake_case")]
pub enum Functional {
    /// `sum m u_axis / sum m` (m).
    MeanDisplacement {
        /// Axis of the displacement.
        axis: usize,
    },
    /// `sum m |u|^2 / sum m` (m2).
    MeanSquareDisplacement,
    /// `sum m |v|^2 / 2` (J), without the affine part of APIC.
    KineticEnergy,
    /// Position of one particle (m).
    PositionOf {
        /// Index of the particle.
        particle: usize,
        /// Axis of the position.
        axis: usize,
    },
}

impl Functional {
    /// Names of the functionals in suite files and messages.
    pub const NAMES: [&'static str; 4] =
        ["mean_displacement", "mean_square_displacement", "kinetic_energy", "position_of"];

    /// Returns the name of the functional in suite files and messages.
    pub fn name(self) -> &'static str {
        let index = match self {
            Self::MeanDisplacement { .. } => 0,
            Self::MeanSquareDisplacement => 1,
            Self::KineticEnergy => 2,
            Self::PositionOf { .. } => 3,
        };
        Self::NAMES[index]
    }

    /// Computes the functional for `samples` of particles with the masses `mass` (kg), and its
    /// rounding error, which grows with the coordinates of the particles. The value is NaN if the
    /// particle or axis does not exist.
    pub fn value(self, mass: &[f64], samples: &Samples) -> FunctionalValue {
        let d = samples.dimension.max(1);
        let square = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>();
        let total: f64 = mass.iter().sum();
        let mean = |term: &dyn Fn(&[f64]) -> f64| {
            let terms = samples.displacement.chunks_exact(d).zip(mass);
            terms.map(|(u, m)| m * term(u)).sum::<f64>() / total
        };
        let positions = samples.label.iter().zip(&samples.displacement).map(|(x, u)| x + u);
        let far = largest(positions);
        let (value, scale) = match self {
            Self::MeanDisplacement { axis } => {
                (mean(&|u| u.get(axis).copied().unwrap_or(f64::NAN)), far)
            }
            Self::MeanSquareDisplacement => {
                (mean(&square), 2.0 * far * largest(samples.displacement.iter().copied()))
            }
            Self::KineticEnergy => {
                let terms = mass.iter().zip(samples.velocity.chunks_exact(d));
                let value = terms.map(|(m, v)| 0.5 * m * square(v)).sum::<f64>();
                (value, value)
            }
            Self::PositionOf { particle, axis } => {
                let index = if axis < d { particle * d + axis } else { usize::MAX };
                let of = |column: &[f64]| column.get(index).copied().unwrap_or(f64::NAN);
                (of(&samples.label) + of(&samples.displacement), far)
            }
        };
        FunctionalValue { value, scale }
    }
}

/// Value of a functional, and the size of its rounding error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FunctionalValue {
    /// The value.
    pub value: f64,
    /// Rounding error of the value, in units of the machine epsilon.
    pub scale: f64,
}

fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    let larger = |a: f64, b: f64| if b <= a || a.is_nan() { a } else { b };
    numbers.map(f64::abs).fold(0.0, larger)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples() -> Samples {
        Samples {
            dimension: 2,
            label: vec![0.0, 0.0, 1.0, 2.0],
            displacement: vec![0.5, 1.0, -0.25, 3.0],
            velocity: vec![1.0, 2.0, 3.0, 4.0],
            ..Samples::default()
        }
    }

    #[test]
    fn functionals_are_sums_over_particles() {
        let value = |of: Functional| of.value(&[1.0, 3.0], &samples()).value;
        assert_eq!(value(Functional::MeanDisplacement { axis: 0 }), (0.5 - 0.75) / 4.0);
        assert_eq!(value(Functional::MeanDisplacement { axis: 1 }), 10.0 / 4.0);
        assert_eq!(value(Functional::MeanSquareDisplacement), (1.25 + 3.0 * 9.0625) / 4.0);
        assert_eq!(value(Functional::KineticEnergy), 0.5 * (5.0 + 75.0));
        assert_eq!(value(Functional::PositionOf { particle: 1, axis: 1 }), 5.0);
    }

    /// The largest coordinate is 5 m, the largest displacement 3 m, and the energy 40 J.
    #[test]
    fn rounding_errors_grow_with_the_largest_terms() {
        let scale = |of: Functional| of.value(&[1.0, 3.0], &samples()).scale;
        assert_eq!(scale(Functional::MeanDisplacement { axis: 0 }), 5.0);
        assert_eq!(scale(Functional::MeanSquareDisplacement), 2.0 * 5.0 * 3.0);
        assert_eq!(scale(Functional::KineticEnergy), 40.0);
        assert_eq!(scale(Functional::PositionOf { particle: 0, axis: 0 }), 5.0);
    }

    #[test]
    fn missing_particle_or_axis_has_no_value() {
        let value = |of: Functional| of.value(&[1.0, 3.0], &samples());
        assert!(value(Functional::PositionOf { particle: 2, axis: 0 }).value.is_nan());
        let beyond = value(Functional::MeanDisplacement { axis: 2 });
        assert!(beyond.value.is_nan());
    }
}
