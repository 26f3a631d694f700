//! From nodes to particles: velocity, first moment and gradient in one visit.

use super::inertia::inertia;
use crate::mpm::{
    algebra::{Matrix, Vector},
    basis::{Basis, Patch},
    four::{Pass, Width},
    grid::Grid,
    kernel::Takes,
    moments::Inertia,
    packed::View,
    particles::Particles,
};
use std::marker::PhantomData;

/// Takes what `takes` says from two packed fields: velocities, and accelerations.
pub(super) struct Gather<'a, const D: usize, B> {
    pub(super) grid: &'a Grid<D>,
    pub(super) particles: &'a Particles<D>,
    pub(super) takes: Takes<'a, D>,
    pub(super) fields: [View<'a>; 2],
    pub(super) basis: PhantomData<B>,
}

/// The first D of four numbers.
#[inline(always)]
fn vector<const D: usize>(four: impl Into<[f64; 4]>) -> Vector<D> {
    let lanes = four.into();
    let mut vector = Vector::zeros();
    for axis in 0..D {
        vector[axis] = lanes[axis];
    }
    vector
}

/// The matrix with these columns.
#[inline(always)]
fn matrix<const D: usize, F: Into<[f64; 4]> + Copy>(columns: &[F; D]) -> Matrix<D> {
    let mut matrix = Matrix::zeros();
    for axis in 0..D {
        let lanes = columns[axis].into();
        for row in 0..D {
            matrix[(row, axis)] = lanes[row];
        }
    }
    matrix
}

/// What a particle has taken so far.
struct Taken<W: Width, const D: usize> {
    change: W::Four,
    velocity: W::Four,
    moment: [W::Four; D],
    gradient: [W::Four; D],
}

impl<W: Width, const D: usize> Taken<W, D> {
    #[inline(always)]
    fn nothing(width: W) -> Self {
        let zero = width.four([0.0; 4]);
        Self { change: zero, velocity: zero, moment: [zero; D], gradient: [zero; D] }
    }
}

impl<const D: usize, B: Basis> Gather<'_, D, B> {
    /// Adds what the nodes of `patch` give.
    #[inline(always)]
    fn see<W: Width>(
        &self,
        width: W,
        patch: &B::Patch<D>,
        of_all: Option<Inertia<D>>,
        taken: &mut Taken<W, D>,
    ) {
        let ([velocity, acceleration], takes) = (&self.fields, &self.takes);
        if takes.change.is_some() {
            taken.change += patch.gather(width, acceleration);
        }
        let mut sum = None;
        if takes.moment.is_some() {
            let mean = of_all.unwrap_or_else(|| Inertia::diagonal(patch.variance())).mean;
            let (all, moment) = patch.gather_moment(width, &mean, velocity);
            for axis in 0..D {
                taken.moment[axis] += moment[axis];
            }
            sum = Some(all);
        }
        if takes.gradient.is_some() {
            let (all, gradient) = patch.gather_gradient(width, velocity);
            for axis in 0..D {
                taken.gradient[axis] += gradient[axis];
            }
            sum = Some(all);
        }
        if takes.mix.is_some() || takes.carried.is_some() {
            taken.velocity += sum.unwrap_or_else(|| patch.gather(width, velocity));
        }
    }

    /// Gives the particle what it has taken.
    #[inline(always)]
    fn give<W: Width>(&mut self, p: usize, taken: &Taken<W, D>) {
        let takes = &mut self.takes;
        let velocity = vector::<D>(taken.velocity);
        if let Some(value) = &mut takes.value {
            if let Some(dt) = takes.change {
                value[p] += vector::<D>(taken.change) * dt;
            }
            if let Some((keep, factor)) = takes.mix {
                value[p] = value[p] * keep + velocity * factor;
            }
        }
        if let Some(moment) = &mut takes.moment {
            moment[p] = matrix(&taken.moment);
        }
        if let Some(gradient) = &mut takes.gradient {
            gradient[p] = matrix(&taken.gradient);
        }
        if let Some(carried) = &mut takes.carried {
            carried[p] = velocity;
        }
    }
}

impl<const D: usize, B: Basis> Pass for Gather<'_, D, B> {
    #[inline(always)]
    fn run<W: Width>(mut self, width: W) {
        let (grid, particles) = (self.grid, self.particles);
        let of_all = !B::ONE_PATCH && self.takes.moment.is_some();
        for p in 0..particles.len() {
            let of_all = of_all.then(|| inertia::<D, B>(grid, particles, p));
            let mut taken = Taken::nothing(width);
            B::patches(
                grid,
                particles,
                p,
                #[inline(always)]
                |patch| self.see(width, patch, of_all, &mut taken),
            );
            self.give(p, &taken);
        }
    }
}
