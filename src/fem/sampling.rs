//! Where the state of a bar is looked at.

use super::mass::add_nodal_lengths;
use super::{Bar, Sampling};
use crate::subject::Samples;

/// Places in an element, 0 to 1: the middles of its quarters, where four particles would start.
///
/// An element of degree k interpolates `u` with an error that, to leading order, is the same
/// polynomial everywhere: `(1 - xi^2) u''` if linear, `xi (1 - xi^2) u'''` if quadratic. At the
/// zeros of that polynomial (the nodes, the midside node included) only the error of the nodal
/// values is left, which may be of a higher order. At `xi = 1/4` and `3/4` the polynomials take
/// 0.94 and 0.44, or 0.23 and 0.33 (their maxima are 1 and 0.38): no place here is privileged.
/// Nor is it one of the points `+-1/sqrt(3)` at which the *strain* of a quadratic element is.
const PLACES: [f64; 4] = [0.125, 0.375, 0.625, 0.875];

impl Bar {
    /// Writes the present state as it is seen at `sampling`, whatever the setup says.
    pub fn sample_as(&self, sampling: Sampling, samples: &mut Samples) {
        samples.clear();
        samples.dimension = 1;
        match sampling {
            Sampling::Inside => self.sample_inside(samples),
            Sampling::Nodes => self.sample_nodes(samples),
        }
    }

    /// Each place stands for its quarter of the element.
    fn sample_inside(&self, samples: &mut Samples) {
        let weight = self.mesh.cell_length() / PLACES.len() as f64;
        for cell in 0..self.mesh.cells() {
            for place in PLACES {
                samples.label.push(self.mesh.position(cell, place));
                samples.displacement.push(self.displacement_in(cell, place));
                samples.velocity.push(self.velocity_in(cell, place));
                samples.weight.push(weight);
            }
        }
    }

    /// Each node stands for the length that lumping gives it.
    fn sample_nodes(&self, samples: &mut Samples) {
        samples.label.extend(self.nodes());
        samples.displacement.extend(self.nodal_displacements());
        samples.velocity.extend(self.nodal_velocities());
        samples.weight.resize(self.nodes().len(), 0.0);
        add_nodal_lengths(&self.mesh, &mut samples.weight);
    }
}
