//! Truth: a known solution, as the judge reads it.

/// A solution that is known: closed form, manufactured, or a much finer computation.
pub trait Truth: Send + Sync {
    /// Displacement (m) of the point with reference position `label` at time `t` (s), D numbers.
    fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]);

    /// Displacements (m) of the points with reference positions `labels`, D numbers for each.
    fn displacements(&self, d: usize, labels: &[f64], t: f64, into: &mut [f64]) {
        for (label, into) in labels.chunks(d).zip(into.chunks_mut(d)) {
            self.displacement(label, t, into);
        }
    }

    /// Velocity (m/s) of that point, D numbers.
    fn velocity(&self, label: &[f64], t: f64, into: &mut [f64]);

    /// Writes the deformation gradient F, D * D numbers, row after row. Returns false, and writes
    /// nothing, if the solution does not define it.
    fn deformation_gradient(&self, label: &[f64], t: f64, into: &mut [f64]) -> bool {
        let _ = (label, t, into);
        false
    }

    /// Temperature (K); `None` if the solution does not define it.
    fn temperature(&self, label: &[f64], t: f64) -> Option<f64> {
        let _ = (label, t);
        None
    }

    /// Writes the Cauchy stress (Pa), D * D numbers, row after row. Returns false, and writes
    /// nothing, if the solution does not define it.
    fn stress(&self, label: &[f64], t: f64, into: &mut [f64]) -> bool {
        let _ = (label, t, into);
        false
    }
}
