//! A wall with unilateral contact and Coulomb friction, `|t| <= mu N`. The wall can push but not
//! pull.
//!
//! At every node of the wall, a trial step without the wall gives `v* = v + dt a`. If the node
//! would enter the wall, or if it already has contact and presses on the wall, the node stays on
//! the wall: `v . n = a . n = 0`, as with a roller. The impulse of the wall, `I = m |v* . n|`,
//! limits the friction. If an impulse of at most `mu I` stops the tangential part of `v*`, the node
//! sticks: `v = a = 0`, as on a fixed wall. Otherwise the node slides, and a friction impulse
//! `mu I` against `v*` reduces the acceleration of the node. If only a pull could keep the node on
//! the wall, the node is free. This is the contact law of Bardenhagen, Brackbill & Sulsky (2000,
//! CMAME 187, section 3) between a body and a fixed wall.
//!
//! Nodes keep their contact state until the next advance. Velocities that are mapped to the grid
//! before then are constrained by this state.

use super::contract::{Advance, Boundary, Side, nodes};
use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::grid::Grid;
use mpm_subject::{Column, Entry};

/// A face of the grid with friction.
#[derive(Debug, Clone)]
pub struct Friction {
    nodes: Vec<(usize, ContactState)>,
    axis: usize,
    /// Sign of the direction from the wall into the grid: 1 at the low end of the axis, -1 at the
    /// high end.
    inwards: f64,
    coefficient: f64,
}

impl Friction {
    /// Applies friction with coefficient mu to the nodes of `grid` on one face. The nodes are free
    /// until the body presses on them.
    pub fn face<const D: usize>(grid: &Grid<D>, axis: usize, side: Side, coefficient: f64) -> Self {
        let nodes =
            nodes(grid, axis, side).into_iter().map(|i| (i, ContactState::Separated)).collect();
        Self { nodes, axis, inwards: -side.sign(), coefficient }
    }

    fn hold<const D: usize>(&self, field: &mut [Vector<D>]) {
        for &(i, state) in &self.nodes {
            match state {
                ContactState::Separated => {}
                ContactState::Slip => field[i][self.axis] = 0.0,
                ContactState::Stick => field[i] = zeros(),
            }
        }
    }
}

impl<const D: usize> Boundary<D> for Friction {
    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_nodes("contact state", &self.nodes)]
    }

    fn reads_velocity(&self) -> bool {
        true
    }

    fn hold_velocity(&self, velocity: &mut [Vector<D>], _: f64) {
        self.hold(velocity);
    }

    fn hold_acceleration(&self, acceleration: &mut [Vector<D>], _: &Advance) {
        self.hold(acceleration);
    }

    fn hold_advance(
        &mut self,
        velocity: &mut [Vector<D>],
        acceleration: &mut [Vector<D>],
        advance: &Advance,
    ) {
        let (axis, dt) = (self.axis, advance.dt);
        for (i, state) in &mut self.nodes {
            let (v, a) = (&mut velocity[*i], &mut acceleration[*i]);
            let mut along = *v + *a * dt;
            let pressed = -self.inwards * along[axis];
            if !(pressed > 0.0) {
                *state = ContactState::Separated;
                continue;
            }
            along[axis] = 0.0;
            (v[axis], a[axis]) = (0.0, 0.0);
            let (speed, most) = (along.norm(), self.coefficient * pressed);
            if speed <= most {
                *state = ContactState::Stick;
                (*v, *a) = (zeros(), zeros());
            } else {
                *state = ContactState::Slip;
                *a -= along * (most / (speed * dt));
            }
        }
    }

    fn clear(&self, field: &mut [Vector<D>]) {
        self.hold(field);
    }
}

/// State of a contact with Coulomb friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::mpm) enum ContactState {
    /// The body does not touch the wall or the other body.
    Separated,
    /// The body slides along the wall or the other body.
    Slip,
    /// The body sticks to the wall or the other body.
    Stick,
}

impl Entry for ContactState {}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    const ADVANCE: Advance = Advance { from: 0.0, to: 0.5, dt: 0.5 };

    /// Advances one node of the wall with velocity `v` and acceleration `a`. Returns the velocity
    /// and the acceleration after the advance, and the wall.
    fn advanced(side: Side, v: [f64; 2], a: [f64; 2]) -> (Vector<2>, Vector<2>, Friction) {
        let grid = Grid::new(Vector::zeros(), 1.0, [1; 2], [false; 2], [2; 2]);
        let mut wall = Friction::face(&grid, 1, side, 0.25);
        let node = wall.nodes[0].0;
        let (mut velocity, mut acceleration) = ([Vector::zeros(); 4], [Vector::zeros(); 4]);
        (velocity[node], acceleration[node]) = (v.into(), a.into());
        wall.hold_advance(&mut velocity, &mut acceleration, &ADVANCE);
        (velocity[node], acceleration[node], wall)
    }

    #[rstest]
    #[case::slides([3.0, 0.0], [0.0, -4.0], [3.0, 0.0], [-1.0, 0.0])]
    #[case::slides_back([-3.0, 0.0], [0.0, -4.0], [-3.0, 0.0], [1.0, 0.0])]
    #[case::starts_to_slide([0.0, 0.0], [3.0, -4.0], [0.0, 0.0], [2.0, 0.0])]
    #[case::sticks([0.0, 0.0], [0.9, -4.0], [0.0, 0.0], [0.0, 0.0])]
    #[case::comes_to_rest([0.4, 0.0], [0.0, -4.0], [0.0, 0.0], [0.0, 0.0])]
    #[case::falls_onto_the_wall([3.0, -2.0], [0.0, 0.0], [3.0, 0.0], [-1.0, 0.0])]
    #[case::is_not_pulled([3.0, 0.0], [0.0, 4.0], [3.0, 0.0], [0.0, 4.0])]
    #[case::leaves([3.0, 5.0], [0.0, -4.0], [3.0, 5.0], [0.0, -4.0])]
    fn a_node_at_the_wall(
        #[case] v: [f64; 2],
        #[case] a: [f64; 2],
        #[case] held_v: [f64; 2],
        #[case] held_a: [f64; 2],
    ) {
        let (velocity, acceleration, _) = advanced(Side::Low, v, a);
        assert_relative_eq!(velocity, held_v.into());
        assert_relative_eq!(acceleration, held_a.into());
        let mirrored = |[x, y]: [f64; 2]| [x, -y];
        let (velocity, acceleration, _) = advanced(Side::High, mirrored(v), mirrored(a));
        assert_relative_eq!(velocity, mirrored(held_v).into());
        assert_relative_eq!(acceleration, mirrored(held_a).into());
    }

    /// Velocities mapped after an advance are constrained by the contact state of this advance.
    #[rstest]
    #[case::free([3.0, 5.0], [0.7, 0.2])]
    #[case::slides([3.0, -1.0], [0.7, 0.0])]
    #[case::sticks([0.1, -1.0], [0.0, 0.0])]
    fn mapped_velocities_keep_the_contact_state(#[case] v: [f64; 2], #[case] held: [f64; 2]) {
        let (_, _, wall) = advanced(Side::Low, v, [0.0; 2]);
        let mut mapped = [Vector::<2>::new(0.7, 0.2); 4];
        wall.hold_velocity(&mut mapped, 0.5);
        assert_eq!(mapped[wall.nodes[0].0], Vector::<2>::from(held));
        assert_eq!(mapped[3], Vector::<2>::new(0.7, 0.2), "no node of the wall");
    }

    #[test]
    fn nan_velocities_remain_nan() {
        let (velocity, ..) = advanced(Side::Low, [f64::NAN, f64::NAN], [0.0; 2]);
        assert!(velocity.iter().all(|v| v.is_nan()), "the solver names the particle");
    }
}
