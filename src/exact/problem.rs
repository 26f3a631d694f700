//! Continuum problem of an exact solution: geometry, equation of motion, loads and conditions.
//!
//! The stress is the sum of that of the law, with thermal expansion, and the initial stress.
//!
//! Manufactured forces are shared by runs: the cases of a study differ in their methods, but most
//! have particles at the same places and take the same steps.

use super::condition::Face;
use super::density::Density;
use super::equation::complete_in_plane;
use super::expansion::{Swelling, swollen_cauchy, swollen_divergence, swollen_piola};
use super::formula::{Formula, Number};
use super::heat::Conduction;
use super::initial_stress::InitialStress;
use super::law::Equation;
use super::linearised::Linearised;
use super::motion::{Derivatives, Motion, Places, write};
use super::outline::Outline;
use super::tensor::{Tensor, tensor};
use super::term::Term;
use super::truth::Truth;
use crate::subject::PlaneState;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// An initial-boundary-value problem on a box or a body of another outline, with its stated
/// solution.
#[derive(Debug, Clone)]
pub struct Problem {
    /// Lowest corner of the body, or of the box around it (m).
    pub from: Vec<f64>,
    /// Highest corner (m).
    pub to: Vec<f64>,
    /// The shape of a body that is not a box; such a body has no faces.
    pub outline: Option<Arc<dyn Outline>>,
    /// The problems of the single bodies, which are boxes; empty if there is one body.
    pub bodies: Vec<Self>,
    /// State across the plane of a body in two dimensions.
    pub plane: PlaneState,
    /// Reference density.
    pub density: Density,
    /// The equation of motion.
    pub equation: Equation,
    /// Terms of the loads on the body.
    pub terms: Vec<Arc<dyn Term>>,
    /// Whether the motion is an equilibrium: independent of t, checked with the loads at the end of
    /// the run, and not checked against initial conditions.
    pub at_rest: bool,
    /// Whether an additional body force makes the motion a solution: a manufactured solution
    /// (Roache 2002).
    pub manufactured: bool,
    /// The heat problem of a body that conducts heat.
    pub heat: Option<Conduction>,
    /// Every face of the body.
    pub faces: Vec<Face>,
    /// Whether the body starts as the motion does: then an initial condition that is not stated
    /// follows from the motion, and otherwise it is zero.
    pub follows_motion: bool,
    /// Stress of the reference configuration.
    pub initial_stress: InitialStress,
    /// Initial displacement (m), formulas of the coordinates and t (= 0); empty: not stated.
    pub initial_displacement: Vec<Formula>,
    /// Initial velocity (m/s), formulas of the coordinates and t (= 0); empty: not stated.
    pub initial_velocity: Vec<Formula>,
    /// End of the run (s).
    pub until: f64,
    /// The claimed solution.
    pub motion: Motion,
    /// Largest residual that passes, relative to the terms of the condition.
    pub tolerance: f64,
    /// The residual that the law may leave, if the motion solves the linearised problem only.
    pub linearised: Option<Linearised>,
    /// Cache of manufactured forces for the runs of this problem, if any.
    pub shared_forces: Option<Arc<SharedForces>>,
}

impl Problem {
    /// Number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.from.len()
    }

    /// Largest residual that passes of a condition that the law enters, relative to its terms.
    pub(super) fn law_tolerance(&self) -> f64 {
        self.linearised.as_ref().map_or(self.tolerance, |linearised| linearised.tolerance)
    }

    /// Whether the body holds a point of the box around it.
    pub fn holds(&self, label: &[f64]) -> bool {
        self.outline.as_ref().is_none_or(|outline| outline.holds(label))
    }

    /// The problem of the body at `label`.
    fn body_at(&self, label: &[f64]) -> &Self {
        let inside = |body: &&Self| {
            let ends = body.from.iter().zip(&body.to);
            ends.zip(label).all(|((from, to), x)| from <= x && x <= to)
        };
        self.bodies.iter().find(inside).unwrap_or(self)
    }

    /// Stiffest modulus at rest (Pa) in the body: a bound for stresses of a given strain.
    pub fn modulus(&self) -> f64 {
        self.equation.modulus() * self.equation.density_factor(self.density.largest())
    }

    /// Largest speed (m/s) of a wave of small strain in the body: `sqrt((lambda + 2 mu)/rho0)` of a
    /// solid. A density that is zero on the rim gives infinity, unless the law depends on it.
    pub fn wave_speed(&self) -> f64 {
        let speed = |density: f64| {
            let modulus = self.equation.modulus() * self.equation.density_factor(density);
            (modulus / density).sqrt()
        };
        // Without density and pressure the speed is not a number, which `max` ignores.
        speed(self.density.largest()).max(speed(self.density.smallest()))
    }

    /// The time (s) whose loads belong to the motion at time `t`.
    pub(super) fn loaded(&self, t: f64) -> f64 {
        if self.at_rest { self.until } else { t }
    }

    /// All derivatives of the motion, with those across a plane.
    pub fn derivatives(&self, label: &[f64], t: f64) -> Derivatives {
        let mut now = self.motion.derivatives(label, t);
        self.complete(label, &mut now);
        now
    }

    /// Adds the derivatives across a plane to those of the motion in it.
    pub(super) fn complete(&self, label: &[f64], now: &mut Derivatives) {
        complete_in_plane(self.plane, &self.equation, label, now);
    }

    /// The manufactured body force (m/s2): `b = u_tt - Div P / rho0`, less the terms of the loads.
    pub fn manufactured_force(&self, label: &[f64], t: f64) -> [f64; 3] {
        let now = self.derivatives(label, t);
        let balance = self.balance(label, t, &now);
        std::array::from_fn(|i| {
            let stated = self.stated(i, label, t, &now.u);
            balance[i] - stated - self.resistance(i, label, t, &now, stated)
        })
    }

    /// The whole body force (m/s2) at `label` and `t`, where the motion's derivatives are `now`.
    pub(super) fn force(&self, label: &[f64], t: f64, now: &Derivatives) -> [f64; 3] {
        if self.manufactured {
            return self.balance(label, t, now);
        }
        std::array::from_fn(|i| {
            let stated = self.stated(i, label, t, &now.u);
            stated + self.resistance(i, label, t, now, stated)
        })
    }

    /// The body force that the motion needs, `u_tt - Div P / rho0`.
    pub(super) fn balance(&self, label: &[f64], t: f64, now: &Derivatives) -> [f64; 3] {
        let (stress, density) = (self.divergence(label, t, now), self.density.at(label));
        std::array::from_fn(|i| now.acceleration[i] - stress[i] / density)
    }

    /// Whether the whole body force takes second derivatives of the motion.
    pub(super) fn force_is_of_second_order(&self) -> bool {
        self.manufactured || self.terms.iter().any(|term| term.resists_imbalance())
    }

    /// Component i of the stated forces (m/s2).
    fn stated(&self, i: usize, label: &[f64], t: f64, u: &[f64; 3]) -> f64 {
        self.uniform(i, t) + self.placed(i, label, t, u)
    }

    /// Component i of the stated forces that are the same everywhere (m/s2).
    pub(super) fn uniform(&self, i: usize, t: f64) -> f64 {
        let uniform = self.terms.iter().filter(|term| term.is_uniform());
        uniform.fold(0.0, |sum, term| sum + term.stated(i, &[], t, &[0.0; 3]))
    }

    /// Component i of the stated forces (m/s2) that depend on place or displacement `u` (m).
    pub(super) fn placed(&self, i: usize, label: &[f64], t: f64, u: &[f64; 3]) -> f64 {
        let placed = self.terms.iter().filter(|term| !term.is_uniform());
        placed.fold(0.0, |sum, term| sum + term.stated(i, label, t, u))
    }

    /// Component i of the forces against the motion (m/s2); `stated` is the stated force (m/s2).
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
}

/// The motion, with the stress that the law at the place makes of it.
impl Truth for Problem {
    fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]) {
        self.motion.displacement(label, t, into);
    }

    fn displacements(&self, d: usize, labels: &[f64], t: f64, into: &mut [f64]) {
        self.motion.displacements(d, labels, t, into);
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
        let body = self.body_at(label);
        let grad = body.derivatives(label, t).grad;
        let sigma = match self.swelling(label, t) {
            None => body.cauchy(label, &grad),
            Some(Swelling { theta, .. }) => {
                swollen_cauchy(&self.equation, self.dimension(), &grad, theta)
            }
        };
        write(&sigma, self.dimension(), into);
        true
    }
}

impl Problem {
    /// Stretch by temperature at one point and time.
    pub(super) fn swelling(&self, label: &[f64], t: f64) -> Option<Swelling> {
        let heat = self.heat.as_ref()?;
        let expansion = self.terms.iter().find_map(|term| term.expansion())?;
        Some(expansion.swelling(&heat.temperature.derivatives(label, t)))
    }

    /// P (Pa), where the motion's derivatives are `now`.
    pub(super) fn piola(&self, label: &[f64], t: f64, now: &Derivatives) -> Tensor<f64> {
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

    /// Cauchy stress (Pa) at `label`, a place of this body, where the motion's gradient is `grad`.
    pub(super) fn cauchy(&self, label: &[f64], grad: &Tensor<f64>) -> Tensor<f64> {
        let (sigma, factor) = (self.equation.cauchy(grad), self.factor_at(label));
        let sigma = tensor(|i, j| factor * sigma[i][j]);
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
            None => self.divergence_of_law(axes, label, slopes),
            Some(swelling) => {
                swollen_divergence(&self.equation, axes, slopes.0, slopes.1, &swelling)
            }
        };
        let hoops = self.hoop_force(label, t, now);
        let force: [f64; 3] = std::array::from_fn(|i| force[i] + hoops[i]);
        if self.initial_stress.is_none() {
            return force;
        }
        let (is_finite, initial) = (self.equation.is_finite(), &self.initial_stress);
        let initial = initial.divergence(label, slopes.0, slopes.1, is_finite);
        std::array::from_fn(|i| force[i] + initial[i])
    }

    /// Div P (N/m3) of the law, `f Div P1 + P1 grad f` with the stress P1 at unit density and the
    /// factor f of the density.
    fn divergence_of_law(
        &self,
        axes: usize,
        label: &[f64],
        (grad, second): (&Tensor<f64>, &[Tensor<f64>; 3]),
    ) -> [f64; 3] {
        let force = self.equation.divergence(axes, grad, second);
        if self.density.uniform().is_some() {
            let factor = self.factor_at(label);
            return force.map(|force| factor * force);
        }
        let factor = self.equation.density_factor(self.density.with_slopes(label));
        let piola = self.equation.piola(grad);
        std::array::from_fn(|i| {
            let varying = |sum, axis: usize| sum + piola[i][axis] * factor.d(axis);
            (0..label.len()).fold(factor.value() * force[i], varying)
        })
    }

    /// Factor of the density at `label` in stresses and energies of the law.
    pub(super) fn factor_at(&self, label: &[f64]) -> f64 {
        self.equation.density_factor(self.density.at(label))
    }

    /// The part of Div P (N/m3) of a body of revolution without a derivative:
    /// `((P_rR - P_tT)/R, P_zR/R)` at the radius R (Malvern 1969, appendix II). Zero for other
    /// bodies.
    pub(super) fn hoop_force(&self, label: &[f64], t: f64, now: &Derivatives) -> [f64; 3] {
        if self.plane != PlaneState::Axisymmetric {
            return [0.0; 3];
        }
        let (radius, piola) = (label[0], self.piola(label, t, now));
        [(piola[0][0] - piola[2][2]) / radius, piola[1][0] / radius, 0.0]
    }

    /// Length (m/rad) of the ring at `label` (1 unless the body is one of revolution), and the hoop
    /// stress (Pa) that acts against each component of a displacement.
    pub(super) fn ring(&self, label: &[f64], piola: &Tensor<f64>) -> (f64, [f64; 3]) {
        match self.plane {
            PlaneState::Axisymmetric => (label[0], [piola[2][2], 0.0, 0.0]),
            PlaneState::Strain | PlaneState::Stress => (1.0, [0.0; 3]),
        }
    }
}

/// Maximum number of stored `f64` (32 MiB). The largest built-in suite needs three quarters of it.
const MOST: usize = 1 << 22;

/// Cache of forces by places and time, filled by the first run that needs them. If the cache is
/// full, each run computes its own.
#[derive(Debug, Default)]
pub struct SharedForces(Mutex<Tables>);

#[derive(Debug, Default)]
struct Tables {
    /// The coordinates of places, one after the other.
    places: Vec<Vec<f64>>,
    /// Forces at all places of a set, by the number of the set and the bits of the time.
    forces: BTreeMap<(usize, u64), Arc<[f64]>>,
    /// Number of stored `f64`.
    size: usize,
}

impl SharedForces {
    /// The number of the set `places`: equal for sets with equal bits.
    pub(in crate::exact) fn number_of(&self, places: Vec<f64>) -> usize {
        let mut tables = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let bits = f64::to_bits;
        let is_known =
            |known: &Vec<f64>| known.iter().copied().map(bits).eq(places.iter().copied().map(bits));
        let found = tables.places.iter().position(is_known);
        found.unwrap_or_else(|| {
            tables.size += places.len();
            tables.places.push(places);
            tables.places.len() - 1
        })
    }

    /// The forces at the time `t` (s), if they are known.
    pub(in crate::exact) fn get(&self, places: usize, t: f64) -> Option<Arc<[f64]>> {
        let tables = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        tables.forces.get(&(places, t.to_bits())).cloned()
    }

    /// Stores forces, if the cache is not full.
    pub(in crate::exact) fn put(&self, places: usize, t: f64, forces: Vec<f64>) {
        let mut tables = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if tables.size + forces.len() <= MOST {
            let size = forces.len();
            // Another run may have stored these forces meanwhile.
            if tables.forces.insert((places, t.to_bits()), forces.into()).is_none() {
                tables.size += size;
            }
        }
    }

    /// Clears all forces; they are recomputed if a run needs them again.
    pub fn clear(&self) {
        let mut tables = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // Running studies still use the numbers of their places.
        tables.size = tables.places.iter().map(Vec::len).sum();
        tables.forces.clear();
    }
}

/// The manufactured body force at places that have been given once.
pub struct Forcing {
    problem: Problem,
    places: Box<dyn Places>,
    /// The places (m), if a term, the stress or the density depends on them.
    labels: Vec<Vec<f64>>,
    /// Forces computed by other runs, with the number of the set of places.
    shared: Option<(Arc<SharedForces>, usize)>,
}

impl Forcing {
    /// The force of `problem` at `labels` (m), D numbers each.
    pub fn new<'a>(problem: &Problem, labels: impl Iterator<Item = &'a [f64]>) -> Self {
        let labels: Vec<Vec<f64>> = labels.map(<[f64]>::to_vec).collect();
        let places = problem.motion.at_places(labels.iter().map(Vec::as_slice));
        let varies = problem.terms.iter().any(|term| !term.is_uniform());
        let needed = varies
            || !problem.initial_stress.is_none()
            || problem.density.uniform().is_none()
            || problem.plane == PlaneState::Axisymmetric;
        let number =
            |shared: &Arc<SharedForces>| (shared.clone(), shared.number_of(labels.concat()));
        let shared = problem.shared_forces.as_ref().map(number);
        let labels = if needed { labels } else { Vec::new() };
        Self { problem: problem.clone(), places, labels, shared }
    }

    /// Writes the force (m/s2) at each place at time `t` (s), as given by
    /// [`Problem::manufactured_force`]. Allocates only for shared forces.
    pub fn at<T>(&mut self, t: f64, into: &mut [T], make: impl Fn([f64; 3]) -> T) {
        let dimension = self.problem.dimension();
        if let Some(known) = self.shared.as_ref().and_then(|(forces, at)| forces.get(*at, t)) {
            for (force, known) in into.iter_mut().zip(known.chunks_exact(dimension)) {
                *force = make(std::array::from_fn(|i| known.get(i).copied().unwrap_or(0.0)));
            }
            return;
        }
        let mut found = Vec::new();
        let uniform: [f64; 3] = std::array::from_fn(|i| self.problem.uniform(i, t));
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
            *force = make(left);
        }
        if let Some((forces, at)) = &self.shared {
            forces.put(*at, t, found);
        }
    }
}
