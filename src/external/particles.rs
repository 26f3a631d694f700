//! Particles of a problem.

/// Particles at the start: n of them, one after the other.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct ProblemParticles {
    /// Reference positions X (m), n D numbers.
    pub reference_position: Vec<f64>,
    /// Positions (m), n D numbers.
    pub position: Vec<f64>,
    /// Velocities (m/s), n D numbers.
    pub velocity: Vec<f64>,
    /// Masses (kg), n numbers.
    pub mass: Vec<f64>,
    /// Reference volumes (m^D), n numbers.
    pub reference_volume: Vec<f64>,
    /// Volumes (m^D), n numbers.
    pub volume: Vec<f64>,
    /// Deformation gradients F, n D^2 numbers, row after row.
    pub deformation_gradient: Vec<f64>,
    /// Cauchy stresses (Pa), n D^2 numbers, row after row.
    pub stress: Vec<f64>,
    /// Number of the body that each belongs to.
    pub body: Vec<f64>,
    /// Hoop stresses (Pa), n numbers, of bodies of revolution; empty otherwise.
    pub hoop_stress: Vec<f64>,
    /// Stresses of the reference configuration (Pa), n D^2 numbers, row after row; empty if there
    /// is none.
    pub initial_stress: Vec<f64>,
}

impl ProblemParticles {
    /// Names of the columns that not every problem has.
    pub(super) const OPTIONAL: [&str; 2] = ["hoop_stress", "initial_stress"];

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }

    /// Every column with its name, in the order of the protocol; optional columns only if they
    /// are not empty.
    pub fn columns(&self) -> Vec<(&'static str, &[f64])> {
        let mut columns: Vec<(&'static str, &[f64])> = vec![
            ("reference_position", &self.reference_position),
            ("position", &self.position),
            ("velocity", &self.velocity),
            ("mass", &self.mass),
            ("reference_volume", &self.reference_volume),
            ("volume", &self.volume),
            ("deformation_gradient", &self.deformation_gradient),
            ("stress", &self.stress),
            ("body", &self.body),
        ];
        let optional = [&self.hoop_stress, &self.initial_stress];
        for (name, column) in Self::OPTIONAL.into_iter().zip(optional) {
            if !column.is_empty() {
                columns.push((name, column));
            }
        }
        columns
    }
}
