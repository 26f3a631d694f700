//! Trait of the known solutions with which computed results are compared.

/// A known solution: closed form, manufactured, or a much finer computation.
pub trait Truth: Send + Sync {
    /// Writes the D components of the displacement (m) of the point with reference position `label`
    /// at time `t` (s).
    fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]);

    /// Writes the displacements (m) of all points `labels`, with `d` numbers for each point.
    fn displacements(&self, d: usize, labels: &[f64], t: f64, into: &mut [f64]) {
        for (label, into) in labels.chunks(d).zip(into.chunks_mut(d)) {
            self.displacement(label, t, into);
        }
    }

    /// Writes the D components of the velocity (m/s) of the point with reference position `label`.
    fn velocity(&self, label: &[f64], t: f64, into: &mut [f64]);

    /// Writes the deformation gradient F row by row. Returns false, without writing, if undefined.
    fn deformation_gradient(&self, label: &[f64], t: f64, into: &mut [f64]) -> bool {
        let _ = (label, t, into);
        false
    }

    /// Returns the out-of-plane normal component of the Cauchy stress (Pa); `None` if undefined.
    fn stress_across(&self, label: &[f64], t: f64) -> Option<f64> {
        let _ = (label, t);
        None
    }

    /// Returns the temperature (K); `None` if the solution does not define it.
    fn temperature(&self, label: &[f64], t: f64) -> Option<f64> {
        let _ = (label, t);
        None
    }

    /// Writes the Cauchy stress (Pa), row by row, or returns false if it is not defined.
    fn stress(&self, label: &[f64], t: f64, into: &mut [f64]) -> bool {
        let _ = (label, t, into);
        false
    }
}
