//! Stress of a problem's body: that of its law, of its expansion by heat and of its start.

use super::expansion::{Swelling, swollen_divergence, swollen_piola};
use super::motion::Derivatives;
use super::problem::Problem;
use super::tensor::{Tensor, tensor};
use crate::subject::PlaneState;

impl Problem {
    /// Stretch by temperature at one point and time.
    pub(super) fn swelling(&self, label: &[f64], t: f64) -> Option<Swelling> {
        let heat = self.heat.as_ref()?;
        let expansion = self.terms.iter().find_map(|term| term.expansion())?;
        Some(expansion.of(&heat.temperature.derivatives(label, t)))
    }

    /// P (Pa), where the motion's derivatives are `now`.
    pub(super) fn piola(&self, label: &[f64], t: f64, now: &Derivatives) -> Tensor<f64> {
        let piola = match self.swelling(label, t) {
            None => self.equation.piola(&now.grad),
            Some(Swelling { theta, .. }) => {
                swollen_piola(&self.equation, self.dimension(), &now.grad, theta)
            }
        };
        if self.initial_stress.is_none() {
            return piola;
        }
        let initial = self.initial_stress.piola(label, &now.grad, self.equation.is_finite());
        tensor(|i, j| piola[i][j] + initial[i][j])
    }

    /// Cauchy stress (Pa) at `label`, a place of this body, where the motion's gradient is `grad`.
    pub(super) fn cauchy(&self, label: &[f64], grad: &Tensor<f64>) -> Tensor<f64> {
        let sigma = self.equation.cauchy(grad);
        if self.initial_stress.is_none() {
            return sigma;
        }
        let initial = self.initial_stress.cauchy(label, grad, self.equation.is_finite());
        tensor(|i, j| sigma[i][j] + initial[i][j])
    }

    /// Div P (N/m3), where the motion's derivatives are `now`.
    pub(super) fn divergence(&self, label: &[f64], t: f64, now: &Derivatives) -> [f64; 3] {
        let slopes = (&now.grad, &now.second);
        let axes = if self.plane == PlaneState::Strain { self.dimension() } else { 3 };
        let force = match self.swelling(label, t) {
            None => self.equation.divergence(axes, slopes.0, slopes.1),
            Some(swelling) => swollen_divergence(&self.equation, axes, slopes, &swelling),
        };
        let hoops = self.hoop_force(label, t, now);
        let force: [f64; 3] = std::array::from_fn(|i| force[i] + hoops[i]);
        if self.initial_stress.is_none() {
            return force;
        }
        let initial = self.initial_stress.divergence(label, slopes, self.equation.is_finite());
        std::array::from_fn(|i| force[i] + initial[i])
    }

    /// The part of Div P (N/m3) of a body of revolution that is no derivative: `((P_rR - P_tT)/R,
    /// P_zR/R)` at the radius R (Malvern 1969, appendix II). None of others.
    pub(super) fn hoop_force(&self, label: &[f64], t: f64, now: &Derivatives) -> [f64; 3] {
        if self.plane != PlaneState::Axisymmetric {
            return [0.0; 3];
        }
        let (radius, piola) = (label[0], self.piola(label, t, now));
        [(piola[0][0] - piola[2][2]) / radius, piola[1][0] / radius, 0.0]
    }

    /// Length (m/rad) of the ring at `label`, one but in a body of revolution, and the hoop
    /// stress that acts against the components of a displacement there (Pa).
    pub(super) fn ring(&self, label: &[f64], piola: &Tensor<f64>) -> (f64, [f64; 3]) {
        match self.plane {
            PlaneState::Axisymmetric => (label[0], [piola[2][2], 0.0, 0.0]),
            PlaneState::Strain | PlaneState::Stress => (1.0, [0.0; 3]),
        }
    }
}
