//! Contact with friction, at the nodes where bodies meet (Bardenhagen, Brackbill & Sulsky 2000,
//! CMAME 187, section 3).
//!
//! Each body has its own velocity at such a node. Two that approach, `(v_a - v_b) . n > 0`, are given
//! equal and opposite impulses, so that they go on with one velocity along the normal and
//! with one along the surface too, or, if that takes more than mu times the normal impulse, with as much
//! as that changes. Bodies that part are left alone.
//!
//! The normal is the direction of `grad ln m_a - grad ln m_b`. Bardenhagen et al. take that of each body's
//! own mass, and two such normals are not opposite: impulses along them would not be either. With one
//! normal for both, momentum is kept to rounding, however many bodies meet, pair after pair. The logarithm,
//! because a smooth basis sees the mass inside a body waver: where one body is there with its last
//! particles and the other with its inside, `grad m_a - grad m_b` may point the wrong way.
//!
//! Impulses go into accelerations, `a_i = (v*_i - v_i)/dt`, so that particles are given all of them.
//! Velocities that strain the bodies before or after are corrected likewise, for the strain alone.

use super::{coupling::Coupling, meeting::Meeting};
use crate::{
    mpm::{algebra::Vector, grid::Grid, scheme::SchemeName, setup::Setup, solver::Solver},
    subject::Column,
};

/// Contact between all bodies of a scene.
pub(super) struct Contact<const D: usize> {
    friction: f64,
    meeting: Meeting,
    /// For each body: `sum_p m_p grad N_i` (kg/m), up to date where bodies meet.
    outwards: Vec<Vec<Vector<D>>>,
    /// For each body: velocities as they were mapped (m/s), if strains are updated first.
    mapped: Vec<Vec<Vector<D>>>,
}

impl<const D: usize> Contact<D> {
    /// Contact between `bodies` with a coefficient of friction.
    pub(super) fn of(bodies: &[Solver<D>], friction: f64) -> Self {
        let column = |body: &Solver<D>| vec![Vector::zeros(); body.grid().nodes()];
        let strained_first = |body: &&Solver<D>| body.setup.scheme == SchemeName::Usf;
        Self {
            friction,
            meeting: Meeting::of(bodies),
            outwards: bodies.iter().map(column).collect(),
            mapped: bodies.iter().filter(strained_first).map(column).collect(),
        }
    }

    /// Pushes apart what approaches at each node: by the accelerations over `dt` (s), or by the
    /// velocities themselves.
    fn push(&self, bodies: &mut [Solver<D>], dt: Option<f64>) {
        for &i in self.meeting.nodes() {
            for b in 1..bodies.len() {
                for a in 0..b {
                    let [one, other] = [a, b].map(|k| (&bodies[k].setup.grid, &self.outwards[k]));
                    let Some(impulse) = self.impulse([one, other], i, dt) else {
                        continue;
                    };
                    give(&mut bodies[a].setup.grid, i, &impulse, dt);
                    give(&mut bodies[b].setup.grid, i, &-impulse, dt);
                }
            }
        }
    }

    /// The momentum (kg m/s) that the first of two bodies is given at node i, if both are there and
    /// approach.
    fn impulse(
        &self,
        [(one, out_of_one), (other, out_of_other)]: [(&Grid<D>, &Vec<Vector<D>>); 2],
        i: usize,
        dt: Option<f64>,
    ) -> Option<Vector<D>> {
        let (m, k) = (one.mass[i], other.mass[i]);
        if !(m > 0.0 && k > 0.0) {
            return None;
        }
        let normal = out_of_one[i] / m - out_of_other[i] / k;
        let size = normal.norm();
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        let normal = normal / size;
        let relative = advanced(one, i, dt) - advanced(other, i, dt);
        let approach = relative.dot(&normal);
        if !(approach > 0.0) {
            return None;
        }
        let along = relative - normal * approach;
        let (speed, most) = (along.norm(), self.friction * approach);
        let share = if speed <= most { 1.0 } else { most / speed };
        Some((normal * approach + along * share) * -(m * k / (m + k)))
    }
}

/// The velocity of node i, after `dt` if that is given.
fn advanced<const D: usize>(grid: &Grid<D>, i: usize, dt: Option<f64>) -> Vector<D> {
    match dt {
        Some(dt) => grid.velocity[i] + grid.acceleration[i] * dt,
        None => grid.velocity[i],
    }
}

fn give<const D: usize>(grid: &mut Grid<D>, i: usize, impulse: &Vector<D>, dt: Option<f64>) {
    let change = impulse / grid.mass[i];
    match dt {
        Some(dt) => grid.acceleration[i] += change / dt,
        None => grid.velocity[i] += change,
    }
}

impl<const D: usize> Coupling<D> for Contact<D> {
    fn name(&self) -> Option<&'static str> {
        Some("contact")
    }

    fn columns(&self) -> Vec<Column> {
        let all = |name, columns: &[Vec<Vector<D>>]| {
            let entries = columns.iter().map(Vec::len).sum();
            Column { entries, ..Column::of_nodes::<Vector<D>>(name, &[]) }
        };
        vec![
            Column::of_nodes("meeting", self.meeting.nodes()),
            all("normal", &self.outwards),
            all("mapped velocity", &self.mapped),
        ]
    }

    fn reads_velocity(&self) -> bool {
        true
    }

    fn meet(&mut self, bodies: &mut [Solver<D>]) {
        self.meeting.find(bodies);
        if self.meeting.nodes().is_empty() {
            return;
        }
        for (body, outwards) in bodies.iter_mut().zip(&mut self.outwards) {
            let Setup { kernel, particles, grid, .. } = &body.setup;
            kernel.p2g_mass_gradient(particles, grid, outwards);
            body.count(1);
        }
    }

    fn nodes(&self) -> &[usize] {
        self.meeting.nodes()
    }

    fn velocity(&mut self, _: &mut [Solver<D>]) {}

    fn straining_velocity(&mut self, bodies: &mut [Solver<D>]) {
        for (body, mapped) in bodies.iter().zip(&mut self.mapped) {
            mapped.copy_from_slice(&body.setup.grid.velocity);
        }
        if self.meeting.nodes().is_empty() {
            return;
        }
        self.push(bodies, None);
        bodies.iter_mut().for_each(Solver::hold_velocity);
    }

    fn strained(&mut self, bodies: &mut [Solver<D>]) {
        for (body, mapped) in bodies.iter_mut().zip(&self.mapped) {
            body.setup.grid.velocity.copy_from_slice(mapped);
        }
    }

    fn acceleration(&mut self, bodies: &mut [Solver<D>], dt: f64) {
        if self.meeting.nodes().is_empty() {
            return;
        }
        self.push(bodies, Some(dt));
        bodies.iter_mut().for_each(Solver::hold_acceleration);
    }
}
