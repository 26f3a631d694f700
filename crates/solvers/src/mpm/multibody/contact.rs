//! Frictional contact at the interface nodes of bodies (Bardenhagen, Brackbill & Sulsky 2000, CMAME
//! 187, section 3).
//!
//! Each body has its own velocity at an interface node. Two bodies that approach,
//! `(v_a - v_b) . n > 0`, receive equal and opposite impulses that make the normal velocities
//! equal. The impulses also make the tangential velocities equal, unless this requires more than
//! the friction limit, mu times the normal impulse. Separating bodies receive no impulse.
//!
//! The normal is the direction of `grad ln m_a - grad ln m_b`. Bardenhagen et al. use a separate
//! normal for each body, so the impulses are not exactly opposite. With one normal for both bodies,
//! momentum is conserved to rounding, for any number of bodies. Pairs of bodies are processed one
//! after another. The logarithm is used because the mass field of a smooth basis oscillates inside
//! a body, where `grad m_a - grad m_b` may have the wrong sign.
//!
//! Impulses are added to accelerations, `a_i = (v*_i - v_i)/dt`, so that particles receive the
//! complete impulses. The velocities that strain the bodies may be computed before or after the
//! impulses. They are corrected by the same rule, but only for the strain update.

use super::coupling::{Coupling, find_interface};
use crate::mpm::boundary::ContactState;
use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::scheme::SchemeName;
use crate::mpm::step::schedule::CouplingPoint;
use crate::mpm::step::setup::Setup;
use crate::mpm::step::solver::Solver;
use mpm_subject::Column;

/// Contact among all bodies on a grid.
pub(in crate::mpm) struct Contact<const D: usize> {
    friction: f64,
    /// Nodes to which more than one body contributes mass, in ascending order.
    interface: Vec<usize>,
    /// Mass gradient of each body, `sum_p m_p grad N_i` (kg/m), up to date at interface nodes.
    outwards: Vec<Vec<Vector<D>>>,
    pairs: Vec<[usize; 2]>,
    /// Contact state after the last impulse, for each node and pair of bodies.
    states: Vec<ContactState>,
    /// Mapped velocities of each body (m/s), if the scheme is USF.
    mapped: Vec<Vec<Vector<D>>>,
}

impl<const D: usize> Contact<D> {
    pub(in crate::mpm) fn new(bodies: &[Solver<D>], friction: f64) -> Self {
        let column = |body: &Solver<D>| vec![zeros(); body.grid().nodes()];
        let strained_first = |body: &&Solver<D>| body.setup.scheme == SchemeName::Usf;
        let pairs: Vec<[usize; 2]> =
            (1..bodies.len()).flat_map(|b| (0..b).map(move |a| [a, b])).collect();
        let nodes = bodies.first().map_or(0, |body| body.grid().nodes());
        Self {
            friction,
            states: vec![ContactState::Separated; nodes * pairs.len()],
            pairs,
            interface: Vec::with_capacity(nodes),
            outwards: bodies.iter().map(column).collect(),
            mapped: bodies.iter().filter(strained_first).map(column).collect(),
        }
    }

    fn find_normals(&mut self, bodies: &mut [Solver<D>]) {
        for (body, outwards) in bodies.iter_mut().zip(&mut self.outwards) {
            let Setup { kernel, particles, grid, .. } = &body.setup;
            kernel.p2g_mass_gradient(particles, grid, outwards);
            body.count(1);
        }
    }

    /// Applies impulses to approaching bodies over `dt` (s), as nodal accelerations.
    fn push(&mut self, bodies: &mut [Solver<D>], dt: f64) {
        self.states.fill(ContactState::Separated);
        for k in 0..self.interface.len() {
            let i = self.interface[k];
            for pair in 0..self.pairs.len() {
                let Some(meet) = self.meet_at(bodies, i, pair) else { continue };
                let [a, b] = self.pairs[pair].map(|k| &bodies[k].setup.grid);
                let advanced = |grid: &Grid<D>| grid.velocity[i] + grid.acceleration[i] * dt;
                let (state, change) = self.law(&(advanced(a) - advanced(b)), &meet.normal);
                self.states[i * self.pairs.len() + pair] = state;
                let impulse = change * meet.mass;
                for (k, impulse) in self.pairs[pair].into_iter().zip([impulse, -impulse]) {
                    let grid = &mut bodies[k].setup.grid;
                    grid.acceleration[i] += impulse / (grid.mass[i] * dt);
                }
            }
        }
    }

    /// Returns the contact state, and the change of the relative velocity of two bodies.
    fn law(&self, relative: &Vector<D>, normal: &Vector<D>) -> (ContactState, Vector<D>) {
        let approach = relative.dot(normal);
        if !(approach > 0.0) {
            return (ContactState::Separated, zeros());
        }
        let along = relative - normal * approach;
        let (speed, most) = (along.norm(), self.friction * approach);
        if speed <= most {
            return (ContactState::Stick, -relative);
        }
        (ContactState::Slip, -(normal * approach + along * (most / speed)))
    }

    /// Applies the contact states of the last impulses to velocities that strain the bodies. Normal
    /// velocities of bodies in contact become equal. Tangential velocities also become equal if the
    /// bodies stick.
    fn hold(&self, bodies: &mut [Solver<D>]) {
        for &i in &self.interface {
            for (pair, [a, b]) in self.pairs.iter().copied().enumerate() {
                let state = self.states[i * self.pairs.len() + pair];
                let Some(meet) = self.meet_at(bodies, i, pair) else { continue };
                let relative = bodies[a].setup.grid.velocity[i] - bodies[b].setup.grid.velocity[i];
                let change = match state {
                    ContactState::Separated => continue,
                    ContactState::Slip => meet.normal * -relative.dot(&meet.normal),
                    ContactState::Stick => -relative,
                };
                let impulse = change * meet.mass;
                for (k, impulse) in [(a, impulse), (b, -impulse)] {
                    let grid = &mut bodies[k].setup.grid;
                    grid.velocity[i] += impulse / grid.mass[i];
                }
            }
        }
    }

    /// Returns the normal and the reduced mass of a pair of bodies at node i; `None` unless both
    /// bodies have mass at the node.
    fn meet_at(&self, bodies: &[Solver<D>], i: usize, pair: usize) -> Option<ContactPair<D>> {
        let [(m, out_of_one), (k, out_of_other)] =
            self.pairs[pair].map(|k| (bodies[k].setup.grid.mass[i], &self.outwards[k][i]));
        if !(m > 0.0 && k > 0.0) {
            return None;
        }
        let normal = out_of_one / m - out_of_other / k;
        let size = normal.norm();
        let sound = size > 0.0 && size.is_finite();
        sound.then(|| ContactPair { normal: normal / size, mass: m * k / (m + k) })
    }
}

struct ContactPair<const D: usize> {
    /// Unit normal from the first body to the second.
    normal: Vector<D>,
    /// Reduced mass (kg): impulse divided by the change of the relative velocity.
    mass: f64,
}

impl<const D: usize> Coupling<D> for Contact<D> {
    fn name(&self) -> Option<&'static str> {
        Some("contact")
    }

    fn columns(&self) -> Vec<Column<'_>> {
        let all = |name, columns: &[Vec<Vector<D>>]| {
            let entries = columns.iter().map(Vec::len).sum();
            let mut column = Column::of_nodes::<Vector<D>>(name, &[]);
            column.size.entries = entries;
            column
        };
        vec![
            Column::of_nodes("interface node", &self.interface),
            Column::of_nodes("contact state", &self.states),
            all("normal", &self.outwards),
            all("mapped velocity", &self.mapped),
        ]
    }

    fn reads_velocity(&self) -> bool {
        true
    }

    fn couple(&mut self, at: CouplingPoint, bodies: &mut [Solver<D>], dt: f64) {
        if at == CouplingPoint::Mass {
            find_interface(&mut self.interface, bodies);
        }
        if at == CouplingPoint::StrainVelocity {
            for (body, mapped) in bodies.iter().zip(&mut self.mapped) {
                mapped.copy_from_slice(&body.setup.grid.velocity);
            }
        }
        if at == CouplingPoint::Strained {
            for (body, mapped) in bodies.iter_mut().zip(&self.mapped) {
                body.setup.grid.velocity.copy_from_slice(mapped);
            }
        }
        if self.interface.is_empty() {
            return;
        }
        match at {
            CouplingPoint::Mass => self.find_normals(bodies),
            CouplingPoint::StrainVelocity => {
                self.hold(bodies);
                bodies.iter_mut().for_each(Solver::hold_velocity);
            }
            CouplingPoint::Acceleration => {
                self.push(bodies, dt);
                bodies.iter_mut().for_each(Solver::hold_acceleration);
            }
            CouplingPoint::Velocity | CouplingPoint::Strained => {}
        }
    }
}
