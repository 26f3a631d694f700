//! A finite element bar: its state, its time step and its sampling points.

use super::Sampling;
use super::mass::{BarMassMatrix, add_nodal_lengths};
use super::mesh::{Element, Mesh, dot};
use super::setup::{BarSetup, ScalarFunction, SetupError};
use mpm_subject::{Failure, RunCounters, Samples, Site, Start, Subject};

/// Evaluates `$body` with the constant `$nodes`, the number of nodes of `$element`, so that the
/// compiler can unroll loops over the nodes.
macro_rules! with_nodes {
    ($element:expr, $nodes:ident => $body:expr) => {
        match $element {
            Element::Linear => {
                const $nodes: usize = 2;
                $body
            }
            Element::Quadratic => {
                const $nodes: usize = 3;
                $body
            }
        }
    };
}

/// State of a finite element bar at one time.
pub struct Bar {
    setup: BarSetup,
    pub(super) mesh: Mesh,
    nodes: Vec<f64>,
    mass: BarMassMatrix,
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    /// Nodal accelerations; before the solve with the mass matrix, the nodal forces.
    acceleration: Vec<f64>,
    /// Deformation gradient F at the quadrature points, element after element.
    def_grad: Vec<f64>,
    /// Reference positions of the quadrature points (m). `displaced` holds the displacements there
    /// (m), and `load` the body force there (m/s2). All three are empty if there is no body force.
    places: Vec<f64>,
    displaced: Vec<f64>,
    load: Vec<f64>,
    time: f64,
    /// Time lag of the velocities behind the displacements (s).
    lag: f64,
    transfers: u64,
    min_j: f64,
}

impl Bar {
    /// Creates the bar in its initial state.
    ///
    /// # Errors
    /// [`SetupError`] names the invalid part of `setup`.
    pub fn new(setup: BarSetup) -> Result<Self, SetupError> {
        setup.check()?;
        let mesh = Mesh::new(setup.from, setup.to, setup.cells, setup.element);
        let mass = BarMassMatrix::new(setup.mass, &mesh, setup.density, setup.fixed)?;
        let nodes: Vec<f64> = (0..mesh.node_count()).map(|i| mesh.node(i)).collect();
        let places = if setup.body_force.is_some() { quadrature(&mesh) } else { Vec::new() };
        let mut bar = Self {
            displacement: interpolant(&nodes, setup.fixed, &setup.initial_displacement),
            velocity: interpolant(&nodes, setup.fixed, &setup.initial_velocity),
            acceleration: vec![0.0; nodes.len()],
            def_grad: vec![1.0; mesh.cells() * mesh.points().len()],
            displaced: vec![0.0; places.len()],
            load: vec![0.0; places.len()],
            places,
            time: 0.0,
            lag: 0.0,
            transfers: 0,
            min_j: f64::INFINITY,
            setup,
            mesh,
            nodes,
            mass,
        };
        all_finite("initial displacement", &bar.displacement)?;
        all_finite("initial velocity", &bar.velocity)?;
        bar.deform()?;
        Ok(bar)
    }

    /// Returns the current time (s).
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Returns the reference positions of the nodes (m).
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Returns the displacements of the nodes (m).
    pub fn nodal_displacements(&self) -> &[f64] {
        &self.displacement
    }

    /// Returns the nodal velocities (m/s). With [`Start::HalfStepBack`] the stored velocities are
    /// half a step old. They are advanced to the current time with the last acceleration, which is
    /// accurate to second order.
    pub fn nodal_velocities(&self) -> impl Iterator<Item = f64> {
        self.velocity.iter().zip(&self.acceleration).map(|(v, a)| v + self.lag * a)
    }

    /// Computes F at every quadrature point. Fails if F is not positive or not finite, as after any
    /// infinite or NaN nodal value.
    fn deform(&mut self) -> Result<(), Failure> {
        with_nodes!(self.mesh.element(), N => self.deform_elements::<N>())?;
        self.count_visits();
        Ok(())
    }

    fn deform_elements<const N: usize>(&mut self) -> Result<(), Failure> {
        let (points, mut least) = (self.mesh.points_of::<N>(), self.min_j);
        let elements = self.def_grad.as_chunks_mut::<N>().0.iter_mut().enumerate();
        for (cell, def_grads) in elements {
            let local = Mesh::nodes_of::<N>(cell, &self.displacement);
            for q in 0..N {
                let def_grad = 1.0 + dot(&points[q].gradient, local);
                def_grads[q] = def_grad;
                if !(def_grad > 0.0 && def_grad < f64::INFINITY) {
                    self.min_j = least.min(def_grad);
                    return Err(no_deformation(cell, def_grad));
                }
                if def_grad < least {
                    least = def_grad;
                }
            }
        }
        self.min_j = least;
        Ok(())
    }

    /// Computes the nodal forces per unit area (Pa), and stores them in `acceleration`.
    fn force(&mut self) -> Result<(), Failure> {
        self.acceleration.fill(0.0);
        with_nodes!(self.mesh.element(), N => self.add_stress::<N>());
        self.count_visits();
        self.add_body_force();
        self.add_ends();
        all_finite("force", &self.acceleration)
    }

    /// Adds `-int P dN_i/dX dX` over elements with N nodes and N quadrature points.
    fn add_stress<const N: usize>(&mut self) {
        let points = self.mesh.points_of::<N>();
        let elements = self.def_grad.as_chunks::<N>().0.iter().enumerate();
        for (cell, def_grads) in elements {
            let local = Mesh::nodes_of_mut::<N>(cell, &mut self.acceleration);
            for q in 0..N {
                let piola = (self.setup.law)(def_grads[q]) * points[q].weight;
                for a in 0..N {
                    local[a] -= piola * points[q].gradient[a];
                }
            }
        }
    }

    /// Adds `int rho0 b N_i dX`.
    fn add_body_force(&mut self) {
        let Some(body_force) = &mut self.setup.body_force else { return };
        let points = self.mesh.points();
        for (cell, values) in self.displaced.chunks_exact_mut(points.len()).enumerate() {
            let local = self.mesh.local(cell, &self.displacement);
            for q in 0..points.len() {
                values[q] = dot(&points[q].shape, local);
            }
        }
        body_force(self.time, (&self.places, &self.displaced), &mut self.load);
        for (cell, loads) in self.load.chunks_exact(points.len()).enumerate() {
            let local = self.mesh.local_mut(cell, &mut self.acceleration);
            for q in 0..points.len() {
                let load = self.setup.density * loads[q] * points[q].weight;
                for a in 0..local.len() {
                    local[a] += load * points[q].shape[a];
                }
            }
        }
        self.count_visits();
    }

    /// Adds the end tractions, positive in tension. The force at a fixed end becomes zero.
    fn add_ends(&mut self) {
        let last = self.acceleration.len() - 1;
        for (end, (node, normal)) in [(0, -1.0), (last, 1.0)].into_iter().enumerate() {
            if let Some(traction) = &self.setup.traction[end] {
                self.acceleration[node] += normal * traction(self.time);
            }
            if self.setup.fixed[end] {
                self.acceleration[node] = 0.0;
            }
        }
    }

    /// Increments `transfers` by the number of pairs of a node and a quadrature point.
    fn count_visits(&mut self) {
        self.transfers += (self.def_grad.len() * self.mesh.element().nodes()) as u64;
    }
}

impl Subject for Bar {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.force()?;
        self.mass.solve(&mut self.acceleration);
        let (kick, lag) = match self.setup.start {
            Start::AtZero => (dt, 0.0),
            // The velocity advances from the middle of the previous step to the middle of this
            // step. In the first step the advance begins at t = 0.
            Start::HalfStepBack => (self.lag + 0.5 * dt, 0.5 * dt),
        };
        for i in 0..self.acceleration.len() {
            self.velocity[i] += kick * self.acceleration[i];
            self.displacement[i] += dt * self.velocity[i];
        }
        self.lag = lag;
        self.time += dt;
        self.deform()
    }

    fn sample(&self, samples: &mut Samples) {
        self.sample_as(self.setup.sampling, samples);
    }

    fn counters(&self) -> RunCounters {
        RunCounters {
            particles: None,
            transfers: self.transfers,
            crossings: None,
            left_domain: None,
            min_j: self.min_j,
        }
    }
}

#[cold]
fn no_deformation(cell: usize, def_grad: f64) -> Failure {
    let site = Site::Element(cell);
    if def_grad.is_finite() {
        Failure::Inverted { site, j: def_grad }
    } else {
        Failure::NonFinite { quantity: "deformation gradient", site }
    }
}

/// Returns the reference positions of all quadrature points, element after element.
fn quadrature(mesh: &Mesh) -> Vec<f64> {
    let inside = |cell| mesh.points().iter().map(move |point| mesh.position(cell, point.place));
    (0..mesh.cells()).flat_map(inside).collect()
}

/// Returns the nodal values of a field; zero at fixed ends.
fn interpolant(nodes: &[f64], fixed: [bool; 2], field: &ScalarFunction) -> Vec<f64> {
    let is_fixed = |i: usize| (fixed[0] && i == 0) || (fixed[1] && i + 1 == nodes.len());
    let value = |(i, &x): (usize, &f64)| if is_fixed(i) { 0.0 } else { field(x) };
    nodes.iter().enumerate().map(value).collect()
}

fn all_finite(quantity: &'static str, nodal: &[f64]) -> Result<(), Failure> {
    // The check has no early exit, so that the compiler can vectorise it.
    if nodal.iter().fold(true, |finite, value| finite & value.is_finite()) {
        return Ok(());
    }
    match nodal.iter().position(|value| !value.is_finite()) {
        Some(node) => Err(Failure::NonFinite { quantity, site: Site::Node(node) }),
        None => Ok(()),
    }
}

/// Sampling positions in an element, from 0 to 1: the centres of its quarters, like the positions
/// of four particles.
///
/// None of these positions is superconvergent. To leading order, the interpolation error is the
/// same polynomial in every element: `(1 - xi^2) u''` if linear, `xi (1 - xi^2) u'''` if quadratic.
/// At the zeros of this polynomial (the nodes, including the midside node), only the error of the
/// nodal values remains, which may be of a higher order. At `xi = 1/4` and `3/4` the linear
/// polynomial has the values 0.94 and 0.44 (maximum 1), and the quadratic one 0.23 and 0.33
/// (maximum 0.38). At the points `+-1/sqrt(3)`, the *strain* of a quadratic element is
/// superconvergent.
const PLACES: [f64; 4] = [0.125, 0.375, 0.625, 0.875];

impl Bar {
    /// Samples the current state as `sampling` specifies. [`BarSetup::sampling`] is ignored.
    pub fn sample_as(&self, sampling: Sampling, samples: &mut Samples) {
        samples.clear();
        samples.dimension = 1;
        match sampling {
            Sampling::Inside => self.sample_inside(samples),
            Sampling::Nodes => self.sample_nodes(samples),
        }
        let density = self.setup.density;
        samples.mass.extend(samples.weight.iter().map(|weight| density * weight));
    }

    fn sample_inside(&self, samples: &mut Samples) {
        let weight = self.mesh.cell_length() / PLACES.len() as f64;
        for cell in 0..self.mesh.cells() {
            for place in PLACES {
                samples.label.push(self.mesh.position(cell, place));
                let at = |nodal: &[f64]| self.mesh.interpolate(cell, place, nodal);
                samples.displacement.push(at(&self.displacement));
                samples.velocity.push(at(&self.velocity) + self.lag * at(&self.acceleration));
                samples.weight.push(weight);
            }
        }
    }

    fn sample_nodes(&self, samples: &mut Samples) {
        samples.label.extend(self.nodes());
        samples.displacement.extend(self.nodal_displacements());
        samples.velocity.extend(self.nodal_velocities());
        samples.weight.resize(self.nodes().len(), 0.0);
        add_nodal_lengths(&self.mesh, &mut samples.weight);
    }
}
