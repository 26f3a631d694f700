//! First-order correction of a linearised motion: the linear response to the residual of the law.
//!
//! A linearised motion u leaves the residual force `r = Div P(u) + rho0 b - rho0 u_tt`, and
//! residual tractions. The true motion is u + d. To first order `rho0 d_tt = M d_XX + r` with the
//! wave modulus M, d = 0 on held faces, and the residual traction on other faces. The motion must
//! vary along one axis only. At rest, d follows by integration; otherwise it is computed with
//! linear elements, a lumped mass matrix and central differences in time.

use super::check::event::Event;
use super::condition::{Face, FacePoint};
use super::formula::Formula;
use super::motion::{Derivatives, Places};
use super::problem::Problem;
use super::violation::Violation;
use mpm_subject::PlaneState;
use std::cell::Cell;

/// Maximum number of residual evaluations.
const EVALUATIONS: f64 = 2e5;

/// Minimum and maximum number of elements.
const ELEMENTS: (f64, f64) = (32.0, 256.0);

/// Time step, relative to the time in which a wave crosses one element.
const COURANT: f64 = 0.9;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Demand {
    /// The displacement or the velocity is prescribed.
    Held,
    /// Prescribed traction minus the traction of the motion (Pa).
    Traction(f64),
    /// Another requirement, for which no correction is computed.
    Other,
}

/// A point of a face that records the requirement of its condition along the normal.
struct DemandPoint<'a> {
    problem: &'a Problem,
    face: &'a Face,
    event: Event,
    now: Derivatives,
    demand: Cell<Demand>,
}

impl DemandPoint<'_> {
    fn record(&self, i: usize, demand: Demand) {
        if i == self.face.axis {
            self.demand.set(demand);
        }
    }
}

impl FacePoint for DemandPoint<'_> {
    fn dimension(&self) -> usize {
        self.problem.dimension()
    }

    fn axis(&self) -> usize {
        self.face.axis
    }

    fn value(&self, formula: &Formula) -> f64 {
        formula.at(&self.event.label, self.event.t)
    }

    fn present_area(&self) -> [f64; 3] {
        self.problem.equation.present_area(&self.now.grad, self.face.axis, self.face.high)
    }

    fn held(&self, i: usize, _: &str) -> Result<(), Violation> {
        self.record(i, Demand::Held);
        Ok(())
    }

    fn velocity(&self, i: usize, _: f64) -> Result<(), Violation> {
        self.record(i, Demand::Held);
        Ok(())
    }

    fn traction(&self, i: usize, _: &str, given: f64) -> Result<(), Violation> {
        let normal = if self.face.high { 1.0 } else { -1.0 };
        let piola = self.problem.piola(&self.event.label, self.event.t, &self.now);
        self.record(i, Demand::Traction(given - normal * piola[i][self.face.axis]));
        Ok(())
    }

    fn friction(&self, _: f64) -> Result<(), Violation> {
        self.record(self.face.axis, Demand::Held);
        Ok(())
    }

    fn continues_on_opposite_face(&self) -> Result<(), Violation> {
        self.record(self.face.axis, Demand::Other);
        Ok(())
    }
}

/// The body, reduced to the axis along which its motion varies.
struct Line<'a> {
    problem: &'a Problem,
    axis: usize,
    elements: usize,
    /// Element length (m).
    h: f64,
    /// Reference positions of the nodes (m).
    labels: Vec<Vec<f64>>,
    motion: Box<dyn Places>,
}

impl<'a> Line<'a> {
    fn new(problem: &'a Problem, axis: usize, elements: usize) -> Self {
        let Problem { from, to, .. } = problem;
        let h = (to[axis] - from[axis]) / elements as f64;
        let label = |node: usize| {
            let mut label: Vec<f64> = from.iter().zip(to).map(|(a, b)| 0.5 * (a + b)).collect();
            label[axis] = from[axis] + h * node as f64;
            label
        };
        let labels: Vec<Vec<f64>> = (0..=elements).map(label).collect();
        let motion =
            problem.motion.at_places(&labels.iter().map(Vec::as_slice).collect::<Vec<_>>());
        Self { problem, axis, elements, h, labels, motion }
    }

    fn at_node(&mut self, node: usize, now: &mut Derivatives) {
        self.motion.derivatives(node, now);
        self.problem.complete(&self.labels[node], now);
    }

    /// Returns the residual force (N/m3) at a node, where `now` is the motion at the time `t`.
    fn residual(&self, node: usize, t: f64, now: &Derivatives) -> f64 {
        let (problem, label, i) = (self.problem, &self.labels[node], self.axis);
        let force = problem.force(label, problem.loaded(t), now)[i];
        problem.divergence(label, t, now)[i]
            + problem.density.at(label) * (force - now.acceleration[i])
    }

    fn demand(&self, high: bool, t: f64, now: &Derivatives) -> Demand {
        let face = |face: &&Face| face.axis == self.axis && face.high == high;
        let Some(face) = self.problem.faces.iter().find(face) else { return Demand::Other };
        let label = self.labels[if high { self.elements } else { 0 }].clone();
        let event = Event { label, t };
        let demand = Cell::new(Demand::Other);
        let point = DemandPoint { problem: self.problem, face, event, now: *now, demand };
        if face.condition.check(&point).is_err() {
            return Demand::Other;
        }
        point.demand.get()
    }

    /// Computes the nodal forces (Pa) of the residual at time `t`, and whether each end is held.
    /// Returns `None` if a condition has no correction.
    fn forces(&mut self, t: f64) -> Option<(Vec<f64>, [bool; 2])> {
        let last = self.elements;
        let weight = |node: usize| if node == 0 || node == last { 0.5 } else { 1.0 };
        self.motion.set_time(t);
        let mut now = Derivatives::default();
        let mut forces = Vec::with_capacity(last + 1);
        for node in 0..=last {
            self.at_node(node, &mut now);
            forces.push(weight(node) * self.h * self.residual(node, t, &now));
        }
        let mut held = [false; 2];
        for (end, node) in [0, last].into_iter().enumerate() {
            self.at_node(node, &mut now);
            match self.demand(end == 1, t, &now) {
                Demand::Held => held[end] = true,
                Demand::Traction(traction) => forces[node] += traction,
                Demand::Other => return None,
            }
        }
        Some((forces, held))
    }

    /// Computes the correction (m) of a state of rest, from equilibrium of the nodal forces.
    fn at_rest(&mut self, t: f64) -> Option<Vec<f64>> {
        let (forces, held) = self.forces(t)?;
        // Without the reaction, the force in an element is minus the sum of all nodal forces below.
        let mut below = 0.0;
        let mut sums = Vec::with_capacity(self.elements);
        for force in &forces[..self.elements] {
            below -= force;
            sums.push(below);
        }
        let reaction = match held {
            [true, true] => -sums.iter().sum::<f64>() / self.elements as f64,
            [true, false] => forces[self.elements] - sums[self.elements - 1],
            [false, true] => 0.0,
            [false, false] => return None,
        };
        let stretch = |sum: &f64| (reaction + sum) * self.h / self.problem.modulus();
        let mut d = vec![0.0];
        for sum in &sums {
            d.push(d[d.len() - 1] + stretch(sum));
        }
        let shift = if held[0] { 0.0 } else { d[self.elements] };
        Some(d.into_iter().map(|d| d - shift).collect())
    }

    /// Computes the correction at time `until`, starting from zero.
    fn in_motion(&mut self, until: f64, steps: usize) -> Option<FirstCorrection> {
        let (problem, last) = (self.problem, self.elements);
        let (dt, stiffness) = (until / steps as f64, problem.modulus() / self.h);
        let mass = |node: usize| {
            let share = if node == 0 || node == last { 0.5 } else { 1.0 };
            share * self.h * problem.density.at(&self.labels[node])
        };
        let masses: Vec<f64> = (0..=last).map(mass).collect();
        let (mut d, mut v) = (vec![0.0; last + 1], vec![0.0; last + 1]);
        let mut largest = 0.0_f64;
        for step in 0..steps {
            let t = dt * step as f64;
            let (mut forces, held) = self.forces(t)?;
            for element in 0..last {
                let pull = stiffness * (d[element + 1] - d[element]);
                forces[element] += pull;
                forces[element + 1] -= pull;
            }
            let rates = problem.terms.iter().map(|term| term.resistance(t, 1.0, &|| 0.0));
            let damping = -rates.sum::<f64>();
            // In the leapfrog scheme, the first step advances velocities by half a step only.
            let share = if step == 0 { 0.5 } else { 1.0 };
            for node in 0..=last {
                let is_held = (node == 0 && held[0]) || (node == last && held[1]);
                let kick = share * dt * (forces[node] / masses[node] - damping * v[node]);
                v[node] = if is_held { 0.0 } else { v[node] + kick };
                d[node] += dt * v[node];
            }
            largest = largest.max(root_mean_square(&d));
        }
        Some(FirstCorrection { at_end: root_mean_square(&d), largest })
    }
}

/// Root mean square (m), over the body, of the first correction of a linearised motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstCorrection {
    /// Value at the end of the run.
    pub at_end: f64,
    /// Largest value during the run.
    pub largest: f64,
}

fn root_mean_square(values: &[f64]) -> f64 {
    let squares: f64 = values.iter().map(|value| value * value).sum();
    (squares / values.len() as f64).sqrt()
}

impl Problem {
    /// Computes the first correction of a linearised motion in a run until `t` (s). Returns `None`
    /// unless the motion varies along exactly one axis of a single box, in 1-D, plane strain or
    /// 3-D, without heat, and if the computation is too expensive.
    pub fn first_correction(&self, t: f64) -> Option<FirstCorrection> {
        let d = self.dimension();
        let varying: Vec<usize> = (0..d).filter(|axis| self.motion.varies_along(*axis)).collect();
        let [axis] = varying[..] else { return None };
        let is_plain = d != 2 || self.plane == PlaneState::Strain;
        if !is_plain || self.outline.is_some() || !self.bodies.is_empty() || self.heat.is_some() {
            return None;
        }
        let length = self.to[axis] - self.from[axis];
        let crossings = t * self.wave_speed() / (COURANT * length);
        let affordable = if self.at_rest { ELEMENTS.1 } else { (EVALUATIONS / crossings).sqrt() };
        let elements = affordable.clamp(ELEMENTS.0, ELEMENTS.1).floor();
        let steps = (crossings * elements).ceil().max(elements);
        if !(elements * steps <= 10.0 * EVALUATIONS) && !self.at_rest {
            return None;
        }
        let mut line = Line::new(self, axis, elements as usize);
        let correction = if self.at_rest {
            let at_end = root_mean_square(&line.at_rest(self.until)?);
            FirstCorrection { at_end, largest: at_end }
        } else {
            line.in_motion(t, steps as usize)?
        };
        Some(correction).filter(|correction| correction.largest.is_finite())
    }
}
