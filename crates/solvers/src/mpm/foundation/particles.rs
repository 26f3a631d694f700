//! Particles: one column per quantity, and the configuration (current or reference) in which the
//! basis is evaluated.

use super::algebra::{Matrix, Vector, det, identity, inverse, product, zeros};
use mpm_subject::Column;
use mpm_subject::named;

/// The material points as a structure of arrays. A column exists only if some part of the solver
/// reads it.
#[derive(Debug, Clone)]
pub struct Particles<const D: usize> {
    /// Reference positions X (m): the labels at which errors are evaluated.
    pub x0: Vec<Vector<D>>,
    /// Positions at which the basis is evaluated (m): current positions x, or reference positions X
    /// in the total-Lagrangian frame.
    pub x: Vec<Vector<D>>,
    /// Current positions (m) in the total-Lagrangian frame; empty in the updated-Lagrangian frame.
    pub current_position: Vec<Vector<D>>,
    /// Velocities (m/s).
    pub v: Vec<Vector<D>>,
    /// Masses (kg), constant.
    pub mass: Vec<f64>,
    /// Reference volumes (m^D).
    pub vol0: Vec<f64>,
    /// Current volumes (m^D), vol = J vol0.
    pub vol: Vec<f64>,
    /// Cauchy stresses (Pa).
    pub sigma: Vec<Matrix<D>>,
    /// Deformation gradients F; empty unless a basis or a material reads them.
    pub def_grad: Vec<Matrix<D>>,
    /// Out-of-plane stretches F_33 in two dimensions; empty in plane strain, where they are 1.
    pub across: Vec<f64>,
    /// Out-of-plane strain rates D_33 of the current step (1/s); empty except in a body of
    /// revolution.
    pub rate_across: Vec<f64>,
    /// Out-of-plane stresses sigma_33 (Pa); empty except in a body of revolution.
    pub stress_across: Vec<f64>,
    /// Whether samples contain the out-of-plane stress in plane strain and in plane stress.
    pub samples_stress_across: bool,
    /// Domains of the particles at the start of the step; empty unless a basis reads them. The
    /// columns of each matrix, F diag(spacing)/2, are the vectors from the particle to the middles
    /// of the faces of its domain (m). Domains are updated from F only when the particles move.
    /// With an earlier update, nodes without mass could receive forces.
    pub domain: Vec<Matrix<D>>,
    /// Domains in the reference configuration; empty if all are boxes of the size `spacing`.
    pub domain0: Vec<Matrix<D>>,
    /// Velocity gradients of the current step (1/s), which the kernel computes for the material.
    pub grad_v: Vec<Matrix<D>>,
    /// Temperatures (K); empty unless an effect uses them.
    pub temperature: Vec<f64>,
    /// Reference particle spacing on each axis (m); the mean spacing if it is not constant.
    pub spacing: Vector<D>,
}

/// Columns of vectors, of scalars and of matrices ([`Particles::columns_mut`]).
type ColumnsMut<'a, const D: usize> =
    ([&'a mut Vec<Vector<D>>; 4], [&'a mut Vec<f64>; 7], [&'a mut Vec<Matrix<D>>; 5]);

/// A box-shaped body that can be filled with particles.
#[derive(Debug, Clone, Copy)]
pub struct Block<const D: usize> {
    /// Lowest corner (m).
    pub from: Vector<D>,
    /// Highest corner (m).
    pub to: Vector<D>,
    /// Density in the reference configuration (kg/m3).
    pub density: f64,
}

impl<const D: usize> Block<D> {
    /// Returns the centres of the equal parts of the block, one per particle ([`Particles::fill`]).
    pub fn centres(&self, h: f64, per_axis: usize) -> impl Iterator<Item = Vector<D>> {
        let (length, count) = (self.to - self.from, self.counts(h, per_axis));
        (0..count.iter().product()).map(move |p| centre(p, self, &length, &count))
    }

    /// Returns the particle spacing along each axis (m).
    pub fn spacing(&self, h: f64, per_axis: usize) -> Vector<D> {
        let (length, count) = (self.to - self.from, self.counts(h, per_axis));
        Vector::from_fn(|axis, _| length[axis] / count[axis] as f64)
    }

    /// Returns the number of particles along each axis.
    pub fn counts(&self, h: f64, per_axis: usize) -> [usize; D] {
        std::array::from_fn(|axis| {
            let length = self.to[axis] - self.from[axis];
            libm::round(length * per_axis as f64 / h).max(1.0) as usize
        })
    }
}

impl<const D: usize> Particles<D> {
    /// Divides `block` into equal parts, and places a particle at rest and free of stress at the
    /// centre of each part. Along each axis, the number of particles per cell of size `h` is as
    /// close to `per_axis` as the body length allows. The number is exact if the body is a whole
    /// number of cells long.
    pub fn fill(block: &Block<D>, h: f64, per_axis: usize) -> Self {
        Self::fill_where(block, h, per_axis, |_| true)
    }

    /// Fills `block` like [`Particles::fill`], but only with the particles for which `inside` is
    /// true at the reference position. Each particle has the full volume of its part.
    pub fn fill_where(
        block: &Block<D>,
        h: f64,
        per_axis: usize,
        inside: impl FnMut(&Vector<D>) -> bool,
    ) -> Self {
        let spacing = block.spacing(h, per_axis);
        let volume = spacing.iter().product::<f64>();
        let mut x0: Vec<Vector<D>> = block.centres(h, per_axis).filter(inside).collect();
        x0.shrink_to_fit();
        let total = x0.len();
        Self {
            x: x0.clone(),
            v: vec![zeros(); total],
            mass: vec![block.density * volume; total],
            vol0: vec![volume; total],
            vol: vec![volume; total],
            sigma: vec![zeros(); total],
            current_position: Vec::new(),
            def_grad: Vec::new(),
            across: Vec::new(),
            rate_across: Vec::new(),
            stress_across: Vec::new(),
            samples_stress_across: false,
            domain: Vec::new(),
            domain0: Vec::new(),
            temperature: Vec::new(),
            grad_v: vec![zeros(); total],
            x0,
            spacing,
        }
    }

    /// Adds a particle at `x0` (m), at rest, with the mass and volume of the first particle. Must
    /// be called before the particles are prepared for a solver.
    pub fn add(&mut self, x0: Vector<D>) {
        let (Some(mass), Some(vol0)) = (self.mass.first().copied(), self.vol0.first().copied())
        else {
            return;
        };
        self.x0.push(x0);
        self.x.push(x0);
        self.v.push(zeros());
        self.mass.push(mass);
        self.vol0.push(vol0);
        self.vol.push(vol0);
        self.sigma.push(zeros());
        self.grad_v.push(zeros());
        self.domain0.extend(self.domain0.first().copied());
    }

    /// Adds the column of deformation gradients, with F = I, if it does not exist.
    pub fn track_deformation(&mut self) {
        self.def_grad.resize(self.len(), identity());
    }

    /// Sets an initial deformation: `state` returns the displacement (m) and F of the particle with
    /// a given index. Stresses and domains are computed when the solver is created.
    pub fn deform(&mut self, state: impl Fn(usize) -> (Vector<D>, Matrix<D>)) {
        self.track_deformation();
        for p in 0..self.len() {
            let (u, f) = state(p);
            self.x[p] = self.x0[p] + u;
            self.def_grad[p] = f;
            self.vol[p] = det(&f) * self.vol0[p];
        }
    }

    /// Whether the initial F of any particle differs from the identity or is NaN.
    pub(in crate::mpm) fn is_deformed(&self) -> bool {
        self.def_grad.iter().any(|f| *f != identity::<D>())
    }

    /// Adds the column of domains, or updates the existing column from F.
    pub fn track_domains(&mut self) {
        self.track_deformation();
        self.domain.resize(self.len(), zeros());
        for (domain, f) in self.domain.iter_mut().zip(&self.def_grad) {
            *domain = Matrix::from_fn(|i, axis| 0.5 * self.spacing[axis] * f[(i, axis)]);
        }
        for ((domain, f), own) in self.domain.iter_mut().zip(&self.def_grad).zip(&self.domain0) {
            *domain = product(f, own);
        }
    }

    /// Returns the current position of particle `p` (m), in either frame.
    #[inline]
    pub fn position(&self, p: usize) -> &Vector<D> {
        &self.positions()[p]
    }

    /// Returns the current positions (m), in either frame.
    #[inline(always)]
    pub fn positions(&self) -> &[Vector<D>] {
        if self.current_position.is_empty() { &self.x } else { &self.current_position }
    }

    /// Returns the current positions (m), mutable.
    pub fn positions_mut(&mut self) -> &mut Vec<Vector<D>> {
        if self.current_position.is_empty() { &mut self.x } else { &mut self.current_position }
    }

    /// Deletes the columns that describe motion, for a body that does not move.
    pub(in crate::mpm) fn forget_motion(&mut self) {
        (self.v, self.sigma, self.grad_v) = (Vec::new(), Vec::new(), Vec::new());
        self.def_grad = Vec::new();
    }

    /// Returns all columns of this body.
    pub fn columns(&self) -> Vec<Column<'_>> {
        let all = [
            Column::of_particles("X", &self.x0),
            Column::of_particles("x", &self.x),
            Column::of_particles("current x", &self.current_position),
            Column::of_particles("v", &self.v),
            Column::of_particles("mass", &self.mass),
            Column::of_particles("V0", &self.vol0),
            Column::of_particles("V", &self.vol),
            Column::of_particles("sigma", &self.sigma),
            Column::of_particles("F", &self.def_grad),
            Column::of_particles("F33", &self.across),
            Column::of_particles("D33", &self.rate_across),
            Column::of_particles("sigma33", &self.stress_across),
            Column::of_particles("domain", &self.domain),
            Column::of_particles("domain0", &self.domain0),
            Column::of_particles("grad v", &self.grad_v),
            Column::of_particles("T", &self.temperature),
        ];
        all.into_iter().filter(|column| column.size.entries > 0).collect()
    }

    /// Returns the columns of vectors (first the reference positions), of scalars and of matrices.
    pub(in crate::mpm) fn columns_mut(&mut self) -> ColumnsMut<'_, D> {
        let Self {
            x0,
            x,
            current_position,
            v,
            mass,
            vol0,
            vol,
            sigma,
            def_grad,
            across,
            rate_across,
            stress_across,
            samples_stress_across: _,
            domain,
            domain0,
            grad_v,
            temperature,
            spacing: _,
        } = self;
        let scalars = [mass, vol0, vol, across, rate_across, stress_across, temperature];
        let matrices = [sigma, def_grad, domain, domain0, grad_v];
        ([x0, x, current_position, v], scalars, matrices)
    }

    /// Returns the number of particles.
    #[inline]
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there are no particles.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }
}

/// Returns the centre of part `p`, computed from its index to avoid accumulated rounding.
fn centre<const D: usize>(
    mut p: usize,
    block: &Block<D>,
    length: &Vector<D>,
    count: &[usize; D],
) -> Vector<D> {
    let mut x = zeros();
    for axis in 0..D {
        let i = p % count[axis];
        p /= count[axis];
        x[axis] = block.from[axis] + length[axis] * (i as f64 + 0.5) / count[axis] as f64;
    }
    x
}

named! {
    /// Names of the frames that suites may choose.
    pub enum FrameName {
        /// Updated Lagrangian: the basis is evaluated at current positions, with the Cauchy stress.
        /// The original MPM.
        Updated = "updated_lagrangian",
        /// Total Lagrangian: the basis is evaluated at reference positions, with the first
        /// Piola-Kirchhoff stress, `f_int_i = - sum_p V0_p P_p grad0 N_i(X_p)`; no particle changes
        /// its cell (de Vaucorbeil, Nguyen & Hutchinson 2020, CMAME 360).
        Total = "total_lagrangian",
    }
}

impl<const D: usize> Particles<D> {
    /// Switches to the total-Lagrangian frame, in which the basis is evaluated at reference
    /// positions.
    pub(in crate::mpm) fn stay_in_reference(&mut self) {
        self.track_deformation();
        self.current_position.clone_from(&self.x);
        self.x.clone_from(&self.x0);
    }

    /// Returns stress times volume (N m) of particle `p`: V sigma, or V0 P = V sigma F^-T in the
    /// total-Lagrangian frame. The internal force is this flux times basis gradients.
    #[inline(always)]
    pub fn flux(&self, p: usize) -> Matrix<D> {
        let flux = self.sigma[p] * self.vol[p];
        if self.current_position.is_empty() { flux } else { self.in_reference(p, &flux) }
    }

    #[inline(never)]
    fn in_reference(&self, p: usize, flux: &Matrix<D>) -> Matrix<D> {
        // If F has no inverse, the particle is inverted. The next stage then reports a failure.
        product(flux, &inverse(&self.def_grad[p]).unwrap_or_else(zeros).transpose())
    }

    /// Converts gradients with respect to X to gradients with respect to x, `grad0 v F^-1`.
    pub(in crate::mpm) fn push_gradients_forward(&mut self) {
        for (grad_v, f) in self.grad_v.iter_mut().zip(&self.def_grad) {
            *grad_v *= inverse(f).unwrap_or_else(Matrix::zeros);
        }
    }
}

#[cfg(test)]
impl<const D: usize> Particles<D> {
    /// Fills a box with `counts` cubes of size 1 m along its axes, each with a particle of 1 kg.
    pub(in crate::mpm) fn cubes(counts: [usize; D]) -> Self {
        let to = Vector::from_fn(|axis, _| counts[axis] as f64);
        Self::fill(&Block { from: zeros(), to, density: 1.0 }, 1.0, 1)
    }
}
