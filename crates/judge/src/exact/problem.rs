//! Continuum problem of an exact solution: geometry, equation of motion, loads and conditions.
//!
//! The stress is the sum of the law's stress (with thermal expansion) and the initial stress.
//!
//! Runs of a study with the same positions and time steps share displacements and forces.

use super::condition::Face;
use super::density::Density;
use super::equation::complete_in_plane;
use super::expansion::{Swelling, swollen_cauchy, swollen_piola};
use super::formula::{Formula, Number, Slope};
use super::heat::Conduction;
use super::initial_stress::InitialStress;
use super::law::Equation;
use super::motion::{Derivatives, Motion, Places, write};
use super::outline::Outline;
use super::shared_values::{SharedQuantity, SharedValues};
use super::tensor::{Tensor, pushed_forward, sum, tensor, vector};
use super::term::Term;
use super::truth::Truth;
use mpm_subject::PlaneState;
use std::sync::Arc;

/// An initial-boundary-value problem on a box or a body of another shape, and its exact solution.
#[derive(Debug, Clone)]
pub struct Problem {
    /// Lowest corner of the body or its bounding box (m).
    pub from: Vec<f64>,
    /// Highest corner of the body or its bounding box (m).
    pub to: Vec<f64>,
    /// Shape of the body, unless it is a box. Only boxes have faces.
    pub outline: Option<Arc<dyn Outline>>,
    /// Problems of the individual bodies, all boxes; empty if there is one body.
    pub bodies: Vec<Self>,
    /// Plane state of a two-dimensional body.
    pub plane: PlaneState,
    /// Reference density.
    pub density: Density,
    /// The equation of motion.
    pub equation: Equation,
    /// Terms of the loads in the equation of motion.
    pub terms: Vec<Arc<dyn Term>>,
    /// Whether the motion is an equilibrium: it does not depend on t, is checked with the loads at
    /// the end of the run, and need not satisfy the initial conditions.
    pub at_rest: bool,
    /// Whether an added body force makes the motion a solution (manufactured, Roache 2002).
    pub manufactured: bool,
    /// The heat problem of a heat-conducting body.
    pub heat: Option<Conduction>,
    /// All faces of the body.
    pub faces: Vec<Face>,
    /// Whether initial conditions that are not prescribed are those of the motion, instead of zero.
    pub follows_motion: bool,
    /// Initial stress of the reference configuration.
    pub initial_stress: InitialStress,
    /// Prescribed initial displacement (m), formulas of the coordinates and t (= 0); may be empty.
    pub initial_displacement: Vec<Formula>,
    /// Prescribed initial velocity (m/s), formulas of the coordinates and t (= 0); may be empty.
    pub initial_velocity: Vec<Formula>,
    /// End of the run (s).
    pub until: f64,
    /// The motion that [`Problem::check`] verifies.
    pub motion: Motion,
    /// Maximum residual of a condition, relative to its terms.
    pub tolerance: f64,
    /// The allowed residual of the law, if the motion solves only the linearised problem.
    pub linearised: Option<Linearised>,
    /// Cache of displacements and manufactured forces for the runs of this problem, if any.
    pub shared: Option<Arc<SharedValues>>,
}

/// The residual that a linearised motion may have in the equation of motion and in tractions.
/// Conditions that are linear in u are checked with the tolerance of the problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearised {
    /// Maximum residual, relative to the terms of the condition.
    pub tolerance: f64,
    /// Reason for accepting a linearised motion.
    pub because: String,
}

impl Problem {
    /// Returns the number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.from.len()
    }

    /// Returns the maximum residual of a condition that involves the law, relative to its terms.
    pub(super) fn law_tolerance(&self) -> f64 {
        self.linearised.as_ref().map_or(self.tolerance, |linearised| linearised.tolerance)
    }

    /// Whether the body contains `label`, a position (m) in the bounding box.
    pub fn holds(&self, label: &[f64]) -> bool {
        self.outline.as_ref().is_none_or(|outline| outline.holds(label))
    }

    fn body_at(&self, label: &[f64]) -> &Self {
        let inside = |body: &&Self| {
            let ends = body.from.iter().zip(&body.to);
            ends.zip(label).all(|((from, to), x)| from <= x && x <= to)
        };
        self.bodies.iter().find(inside).unwrap_or(self)
    }

    /// Returns the scale of stress per strain (Pa): the largest modulus at rest in the body.
    pub fn modulus(&self) -> f64 {
        self.equation.modulus() * self.equation.density_factor(self.density.largest())
    }

    /// Returns the largest speed (m/s) of a small-strain wave, `sqrt((lambda + 2 mu)/rho0)` for a
    /// solid. Zero density gives infinity, unless the law depends on the density.
    pub fn wave_speed(&self) -> f64 {
        let speed = |density: f64| {
            let modulus = self.equation.modulus() * self.equation.density_factor(density);
            (modulus / density).sqrt()
        };
        speed(self.density.largest()).max(speed(self.density.smallest()))
    }

    /// Returns the time (s) at which loads are evaluated: the end of the run for an equilibrium.
    pub(super) fn loaded(&self, t: f64) -> f64 {
        if self.at_rest { self.until } else { t }
    }

    /// Computes the motion and its derivatives, including out-of-plane derivatives.
    pub fn derivatives(&self, label: &[f64], t: f64) -> Derivatives {
        let mut now = self.motion.derivatives(label, t);
        self.complete(label, &mut now);
        now
    }

    pub(super) fn complete(&self, label: &[f64], now: &mut Derivatives) {
        complete_in_plane(self.plane, &self.equation, label, now);
    }

    /// Computes the manufactured force (m/s2), `b = u_tt - Div P / rho0` minus the loads.
    pub fn manufactured_force(&self, label: &[f64], t: f64) -> [f64; 3] {
        let now = self.derivatives(label, t);
        let balance = self.balance(label, t, &now);
        vector(|i| {
            let stated = self.stated(i, label, t, &now.u);
            balance[i] - stated - self.resistance(i, label, t, &now, stated)
        })
    }

    /// Computes the total body force (m/s2), where `now` contains the motion's derivatives.
    pub(super) fn force(&self, label: &[f64], t: f64, now: &Derivatives) -> [f64; 3] {
        if self.manufactured {
            return self.balance(label, t, now);
        }
        vector(|i| {
            let stated = self.stated(i, label, t, &now.u);
            stated + self.resistance(i, label, t, now, stated)
        })
    }

    /// Computes the body force that the motion requires, `u_tt - Div P / rho0`.
    pub(super) fn balance(&self, label: &[f64], t: f64, now: &Derivatives) -> [f64; 3] {
        let (stress, density) = (self.divergence(label, t, now), self.density.at(label));
        vector(|i| now.acceleration[i] - stress[i] / density)
    }

    /// Whether the total body force depends on second derivatives of the motion.
    pub(super) fn force_is_of_second_order(&self) -> bool {
        self.manufactured || self.terms.iter().any(|term| term.resists_imbalance())
    }

    fn stated(&self, i: usize, label: &[f64], t: f64, u: &[f64; 3]) -> f64 {
        self.uniform(i, t) + self.placed(i, label, t, u)
    }

    /// Returns component i of the prescribed forces that are uniform in space (m/s2).
    pub(super) fn uniform(&self, i: usize, t: f64) -> f64 {
        let uniform = self.terms.iter().filter(|term| term.is_uniform());
        uniform.fold(0.0, |sum, term| sum + term.stated(i, &[], t, &[0.0; 3]))
    }

    /// Returns component i of the prescribed forces (m/s2) that depend on position or displacement.
    pub(super) fn placed(&self, i: usize, label: &[f64], t: f64, u: &[f64; 3]) -> f64 {
        let placed = self.terms.iter().filter(|term| !term.is_uniform());
        placed.fold(0.0, |sum, term| sum + term.stated(i, label, t, u))
    }

    /// Returns component i of the forces that oppose the motion (m/s2); `stated` is the prescribed
    /// force (m/s2).
    pub(super) fn resistance(
        &self,
        i: usize,
        label: &[f64],
        t: f64,
        now: &Derivatives,
        stated: f64,
    ) -> f64 {
        let unbalanced = || self.divergence(label, t, now)[i] / self.density.at(label) + stated;
        let all = self.terms.iter();
        all.fold(0.0, |sum, term| sum + term.resistance(t, now.velocity[i], &unbalanced))
    }

    fn cauchy_at(&self, label: &[f64], t: f64) -> Tensor<f64> {
        let body = self.body_at(label);
        let grad = body.derivatives(label, t).grad;
        match self.swelling(label, t) {
            None => body.cauchy(label, &grad),
            Some(Swelling { theta, .. }) => {
                swollen_cauchy(&self.equation, self.dimension(), &grad, theta)
            }
        }
    }

    pub(super) fn swelling(&self, label: &[f64], t: f64) -> Option<Swelling> {
        let heat = self.heat.as_ref()?;
        let expansion = self.terms.iter().find_map(|term| term.expansion())?;
        Some(expansion.swelling(&heat.temperature.derivatives(label, t)))
    }

    pub(super) fn piola(&self, label: &[f64], t: f64, now: &Derivatives) -> Tensor<f64> {
        if self.starts_strained() {
            return self.piola_from(&now.grad, &self.initial_stress.at(label));
        }
        let piola = match self.swelling(label, t) {
            None => {
                let (piola, factor) = (self.equation.piola(&now.grad), self.factor_at(label));
                tensor(|i, j| factor * piola[i][j])
            }
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

    pub(super) fn cauchy(&self, label: &[f64], grad: &Tensor<f64>) -> Tensor<f64> {
        if self.starts_strained() {
            return pushed_forward(&self.piola_from(grad, &self.initial_stress.at(label)), grad);
        }
        let (sigma, factor) = (self.equation.cauchy(grad), self.factor_at(label));
        let sigma = tensor(|i, j| factor * sigma[i][j]);
        if self.initial_stress.is_none() {
            return sigma;
        }
        let initial = self.initial_stress.cauchy(label, grad, self.equation.is_finite());
        tensor(|i, j| sigma[i][j] + initial[i][j])
    }

    pub(super) fn divergence(&self, label: &[f64], t: f64, now: &Derivatives) -> [f64; 3] {
        let Derivatives { grad, second, .. } = now;
        if self.starts_strained() {
            let varying: Tensor<Slope<3>> = tensor(|i, j| Slope::new(grad[i][j], second[i][j]));
            let piola = self.piola_from(&varying, &self.initial_stress.varying(label));
            return vector(|i| sum::<f64, 3>(|j| piola[i][j].d(j)));
        }
        let axes = if self.plane == PlaneState::Strain { self.dimension() } else { 3 };
        let force = match self.swelling(label, t) {
            None => self.divergence_of_law(axes, label, grad, second),
            swelling => self.equation.divergence(axes, grad, second, swelling.as_ref()),
        };
        let hoops = self.hoop_force(label, t, now);
        let force: [f64; 3] = vector(|i| force[i] + hoops[i]);
        if self.initial_stress.is_none() {
            return force;
        }
        let (is_finite, initial) = (self.equation.is_finite(), &self.initial_stress);
        let initial = initial.divergence(label, grad, second, is_finite);
        vector(|i| force[i] + initial[i])
    }

    /// Whether the initial stress is that of an elastic strain at the start, because the yield
    /// condition of the law limits the total stress. For other laws it is added to the stress.
    pub(super) fn starts_strained(&self) -> bool {
        let zero: Tensor<f64> = [[0.0; 3]; 3];
        !self.initial_stress.is_none() && self.equation.piola_from(&zero, &zero).is_some()
    }

    /// Computes P (Pa) of a body that [starts strained](Self::starts_strained).
    fn piola_from<T: Number>(&self, grad: &Tensor<T>, initial: &Tensor<T>) -> Tensor<T> {
        let uniaxial = self.equation.piola_from(grad, initial);
        let is_deformed = grad.iter().flatten().any(|component| *component != T::from(0.0));
        uniaxial.filter(|_| is_deformed).unwrap_or(*initial)
    }

    /// Computes Div P (N/m3) as `f Div P1 + P1 grad f`, for the density factor f and P1 = P/f.
    fn divergence_of_law(
        &self,
        axes: usize,
        label: &[f64],
        grad: &Tensor<f64>,
        second: &[Tensor<f64>; 3],
    ) -> [f64; 3] {
        let force = self.equation.divergence(axes, grad, second, None);
        if self.density.uniform().is_some() {
            let factor = self.factor_at(label);
            return vector(|i| factor * force[i]);
        }
        let factor = self.equation.density_factor(self.density.with_slopes(label));
        let piola = self.equation.piola(grad);
        vector(|i| {
            let varying = |sum, axis: usize| sum + piola[i][axis] * factor.d(axis);
            (0..label.len()).fold(factor.value() * force[i], varying)
        })
    }

    pub(super) fn factor_at(&self, label: &[f64]) -> f64 {
        self.equation.density_factor(self.density.at(label))
    }

    /// Computes `((P_rR - P_tT)/R, P_zR/R)` in a body of revolution (Malvern 1969); otherwise zero.
    pub(super) fn hoop_force(&self, label: &[f64], t: f64, now: &Derivatives) -> [f64; 3] {
        if self.plane != PlaneState::Axisymmetric {
            return [0.0; 3];
        }
        let (radius, piola) = (label[0], self.piola(label, t, now));
        [(piola[0][0] - piola[2][2]) / radius, piola[1][0] / radius, 0.0]
    }

    /// Returns the circumference per angle (m/rad) at `label`, or 1 if the body is not a body of
    /// revolution. Also returns the hoop stress (Pa) in each component of the equation of motion.
    pub(super) fn ring(&self, label: &[f64], piola: &Tensor<f64>) -> (f64, [f64; 3]) {
        match self.plane {
            PlaneState::Axisymmetric => (label[0], [piola[2][2], 0.0, 0.0]),
            PlaneState::Strain | PlaneState::Stress => (1.0, [0.0; 3]),
        }
    }
}

impl Truth for Problem {
    fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]) {
        self.motion.displacement(label, t, into);
    }

    fn displacements(&self, d: usize, labels: &[f64], t: f64, into: &mut [f64]) {
        let Some(shared) = &self.shared else {
            return self.motion.displacements(d, labels, t, into);
        };
        let places = shared.number_of(labels);
        if let Some(known) = shared.get(SharedQuantity::Displacement, places, t) {
            return into.copy_from_slice(&known);
        }
        self.motion.displacements(d, labels, t, into);
        shared.put(SharedQuantity::Displacement, places, t, into);
    }

    fn velocity(&self, label: &[f64], t: f64, into: &mut [f64]) {
        self.motion.velocity(label, t, into);
    }

    fn deformation_gradient(&self, label: &[f64], t: f64, into: &mut [f64]) -> bool {
        self.motion.deformation_gradient(label, t, into)
    }

    fn temperature(&self, label: &[f64], t: f64) -> Option<f64> {
        self.heat.as_ref()?.temperature(label, t)
    }

    fn stress(&self, label: &[f64], t: f64, into: &mut [f64]) -> bool {
        write(&self.cauchy_at(label, t), self.dimension(), into);
        true
    }

    fn stress_across(&self, label: &[f64], t: f64) -> Option<f64> {
        Some(self.cauchy_at(label, t)[2][2])
    }
}

/// The manufactured body force at fixed positions.
pub struct Forcing {
    problem: Problem,
    places: Box<dyn Places>,
    /// The positions (m), if a term, the stress or the density depends on them.
    labels: Vec<Vec<f64>>,
    /// Forces computed by other runs, and the index of the set of positions.
    shared: Option<(Arc<SharedValues>, Option<usize>)>,
}

impl Forcing {
    /// Prepares the force of `problem` at the reference positions `labels` (m).
    pub fn new<'a>(problem: &Problem, labels: impl Iterator<Item = &'a [f64]>) -> Self {
        Self::at_labels(problem, labels.map(<[f64]>::to_vec).collect())
    }

    // Not generic, so the evaluation is compiled only in this package.
    fn at_labels(problem: &Problem, labels: Vec<Vec<f64>>) -> Self {
        let places =
            problem.motion.at_places(&labels.iter().map(Vec::as_slice).collect::<Vec<_>>());
        let varies = problem.terms.iter().any(|term| !term.is_uniform());
        let needed = varies
            || !problem.initial_stress.is_none()
            || problem.density.uniform().is_none()
            || problem.plane == PlaneState::Axisymmetric;
        let number =
            |shared: &Arc<SharedValues>| (shared.clone(), shared.number_of(&labels.concat()));
        let shared = problem.shared.as_ref().map(number);
        let labels = if needed { labels } else { Vec::new() };
        Self { problem: problem.clone(), places, labels, shared }
    }

    /// Writes [`Problem::manufactured_force`] (m/s2) at each position and time `t` (s). Allocates
    /// only for shared forces.
    pub fn at(&mut self, t: f64, into: &mut [[f64; 3]]) {
        let dimension = self.problem.dimension();
        let known =
            |(shared, at): &(Arc<SharedValues>, _)| shared.get(SharedQuantity::Force, *at, t);
        if let Some(known) = self.shared.as_ref().and_then(known) {
            for (force, known) in into.iter_mut().zip(known.chunks_exact(dimension)) {
                *force = std::array::from_fn(|i| known.get(i).copied().unwrap_or(0.0));
            }
            return;
        }
        let mut found = Vec::new();
        let uniform: [f64; 3] = vector(|i| self.problem.uniform(i, t));
        self.places.set_time(t);
        let mut now = Derivatives::default();
        for (place, force) in into.iter_mut().enumerate() {
            self.places.derivatives(place, &mut now);
            let label = self.labels.get(place).map_or(&[][..], Vec::as_slice);
            self.problem.complete(label, &mut now);
            let whole = self.problem.balance(label, t, &now);
            let mut left = [0.0; 3];
            for (i, left) in left.iter_mut().enumerate().take(dimension) {
                let stated = uniform[i] + self.problem.placed(i, label, t, &now.u);
                *left = whole[i] - stated - self.problem.resistance(i, label, t, &now, stated);
            }
            if self.shared.is_some() {
                found.extend_from_slice(&left[..dimension]);
            }
            *force = left;
        }
        if let Some((shared, at)) = &self.shared {
            shared.put(SharedQuantity::Force, *at, t, &found);
        }
    }
}
