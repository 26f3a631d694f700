//! Force balance of one load step: basis functions at the start of the step, unknowns, residual and
//! consistent tangent.
//!
//! Let `grad u` be the gradient of the nodal displacement increments u at a particle, with respect
//! to positions at the start of the step. With `F' = (I + grad u) F` and
//! `grad' N = (I + grad u)^-T grad N`,
//!
//! ```text
//! r_i          = sum_p V0 tau(F') grad' N_i - f_ext_i
//! d r_ia/du_jb = sum_p V0 (N_i,c c_acbd N_j,d - tau_ac N_j,c N_i,b)
//! ```
//!
//! where subscripts after a comma are derivatives with respect to positions at the end of the step,
//! and `d tau_ac = c_acbd d(grad' u)_bd` (Charlton, Coombs & Augarde 2017, Comput. Struct. 190).
//!
//! In a body of revolution, `grad u` has the hoop component `sum_i N_i u_ir/r` with the radius r of
//! the particle at the start of the step. The radius at the end is `r' = r (1 + sum_i N_i u_ir/r)`.
//! Volumes are per radian, and the radial components have additional terms:
//!
//! ```text
//! r_ir           += sum_p V0 tau_33 N_i/r'
//! d r_ia/du_jr   += sum_p V0 c_ac33 N_i,c N_j/r'
//! d r_ir/du_jb   += sum_p V0 c_33bd N_i/r' N_j,d
//! d r_ir/du_jr   += sum_p V0 (c_3333 - tau_33) N_i/r' N_j/r'
//! ```

use super::banded::BandedSystem;
use crate::mpm::boundary::Boundary;
use crate::mpm::foundation::algebra::{
    Matrix, Vector, det, dyad, identity, in_body, in_space, inverse, product, times, zeros,
};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use crate::mpm::material::{Material, StressResponse};
use mpm_subject::{Failure, Site};
use std::array;

/// Minimum sum of the functions of a node over all particles. A node with a smaller sum has no
/// unknown, because the tangent would be nearly singular.
const LEAST_WEIGHT: f64 = 1e-12;

/// Maximum number of stored entries of the tangent (4 GB).
const MOST_ENTRIES: usize = 1 << 29;

#[derive(Debug, Clone, Copy)]
pub(super) struct NodeFunction<const D: usize> {
    pub(super) node: usize,
    pub(super) weight: f64,
    /// Gradient of the function (1/m).
    pub(super) gradient: Vector<D>,
    /// Function over the radius of the particle, N_i/r (1/m); zero except in a body of revolution.
    pub(super) hoop: f64,
}

/// Basis functions of all particles at the start of a step, and the unknowns of the step.
pub(super) struct StepEquations<const D: usize> {
    /// Basis functions of all particles, one particle after another.
    functions: Vec<NodeFunction<D>>,
    /// Index at which each particle's functions end.
    ends: Vec<usize>,
    /// Index of the unknown of each component of each node; `None` if the component is fixed, or if
    /// no particle has a function at this node.
    unknowns: Vec<[Option<usize>; D]>,
    /// Node of each unknown.
    nodes: Vec<usize>,
    band: usize,
}

pub(super) struct Iterate<const D: usize> {
    /// Nodal displacement increments (m).
    pub(super) increment: Vec<Vector<D>>,
    /// Residual of each node, including fixed components: internal minus external force (N).
    pub(super) residual: Vec<Vector<D>>,
    /// Norm of the residual over the unknowns (N).
    pub(super) norm: f64,
    responses: Vec<StressResponse>,
    /// Matrix `(I + grad u)^-T` at each particle, by which gradients are multiplied. The hoop
    /// component is `r/r'`.
    push: Vec<Matrix<3>>,
}

impl<const D: usize> StepEquations<D> {
    /// Creates the equations for `particles` at the start of a step. Fails if no component is free,
    /// if the tangent does not fit into memory, or if a particle of a body of revolution is on the
    /// axis, where the hoop strain is undefined.
    pub(super) fn new(
        grid: &Grid<D>,
        particles: &Particles<D>,
        kernel: &dyn Kernel<D>,
        boundary: &[Box<dyn Boundary<D>>],
    ) -> Result<Self, Failure> {
        let (mut functions, mut ends) = (Vec::new(), Vec::with_capacity(particles.len()));
        let is_revolved = !particles.stress_across.is_empty();
        for p in 0..particles.len() {
            let radius = if is_revolved { particles.x[p][0] } else { f64::INFINITY };
            if !(radius > 0.0) {
                return Err(Failure::NonFinite {
                    quantity: "hoop strain",
                    site: Site::Particle(p),
                });
            }
            kernel.visit(grid, particles, p, &mut |i| {
                let (node, weight, hoop) = (i.node, i.weight, i.weight / radius);
                let gradient = *i.gradient;
                functions.push(NodeFunction { node, weight, gradient, hoop });
            });
            ends.push(functions.len());
        }
        kernel.tally().add("basis functions", particles.len());
        let mut sums = vec![0.0; grid.nodes()];
        for function in &functions {
            sums[function.node] += function.weight;
        }
        let is_used = |sum: &f64| f64::from(u8::from(*sum >= LEAST_WEIGHT));
        let mut free: Vec<Vector<D>> =
            sums.iter().map(|sum| Vector::from_element(is_used(sum))).collect();
        for condition in boundary {
            condition.clear(&mut free);
        }
        let (unknowns, nodes) = number(grid, &free);
        if nodes.is_empty() {
            return Err(Failure::Solve("no node of the body is free to move".to_owned()));
        }
        let mut balance = Self { functions, ends, unknowns, nodes, band: 0 };
        balance.band = balance.widest();
        if BandedSystem::size(balance.nodes.len(), balance.band) > MOST_ENTRIES {
            let (rows, band) = (balance.nodes.len(), balance.band);
            let message =
                format!("the tangent has {rows} unknowns with a band of {band}: too many to solve");
            return Err(Failure::Solve(message));
        }
        Ok(balance)
    }

    pub(super) fn functions_of(&self, p: usize) -> &[NodeFunction<D>] {
        let start = if p == 0 { 0 } else { self.ends[p - 1] };
        &self.functions[start..self.ends[p]]
    }

    pub(super) fn pairs(&self) -> u64 {
        self.functions.len() as u64
    }

    /// Returns `I + grad u` at particle `p` in 3-D. The hoop component of a body of revolution is
    /// `r'/r`.
    pub(super) fn stretch(&self, p: usize, increment: &[Vector<D>]) -> Matrix<3> {
        let (mut stretch, mut hoop) = (identity(), 0.0);
        for function in self.functions_of(p) {
            stretch += dyad(&increment[function.node], &function.gradient);
            hoop += increment[function.node][0] * function.hoop;
        }
        in_space(&stretch, 1.0 + hoop)
    }

    /// Returns the norm of a nodal field over the unknowns.
    pub(super) fn norm(&self, field: &[Vector<D>]) -> f64 {
        self.of_unknowns(field).iter().fold(0.0, |sum, value| libm::hypot(sum, *value))
    }

    /// Returns the norm over the unknowns of the rounding error of the internal forces (N),
    /// `sum_p eps M V0 |grad N_i|`: the rounding eps of strains, which are differences of numbers
    /// of magnitude 1, times the largest modulus M at the start of the step.
    pub(super) fn rounding(&self, particles: &Particles<D>, material: &dyn Material<D>) -> f64 {
        let modulus_of = |(p, f): (usize, &Matrix<D>)| {
            let f = in_space(f, particles.across.get(p).copied().unwrap_or(1.0));
            material.response(p, &f).map_or(0.0, |response| response.largest_modulus())
        };
        let modulus = particles.def_grad.iter().enumerate().map(modulus_of).fold(0.0, f64::max);
        let mut forces = vec![zeros(); self.unknowns.len()];
        for (p, vol0) in particles.vol0.iter().enumerate() {
            for function in self.functions_of(p) {
                let force = f64::EPSILON * modulus * vol0 * function.gradient.norm();
                forces[function.node] += Vector::from_element(force);
            }
        }
        self.norm(&forces)
    }

    /// Returns the node of the unknown with the largest magnitude of a field, and this magnitude.
    pub(super) fn largest(&self, field: &[Vector<D>]) -> (usize, f64) {
        let values = self.of_unknowns(field).into_iter().map(f64::abs);
        let of_nodes = self.nodes.iter().copied().zip(values);
        of_nodes.fold((0, 0.0), |most, next| if next.1 > most.1 { next } else { most })
    }

    fn of_unknowns(&self, field: &[Vector<D>]) -> Vec<f64> {
        let mut values = vec![0.0; self.nodes.len()];
        for (rows, value) in self.unknowns.iter().zip(field) {
            for (row, value) in rows.iter().zip(value) {
                if let Some(row) = row {
                    values[*row] = *value;
                }
            }
        }
        values
    }

    /// Adds to `load` the fraction `share` of the nodal forces (N) that hold the initial `stress`
    /// (Pa) in the undeformed body.
    pub(super) fn add_holding_forces(
        &self,
        stress: &[Matrix<D>],
        particles: &Particles<D>,
        share: f64,
        load: &mut [Vector<D>],
    ) {
        let states = particles.def_grad.iter().zip(&particles.vol0);
        for (p, (s0, (f, vol0))) in stress.iter().zip(states).enumerate() {
            let flux = product(s0, &f.transpose()) * (share * vol0);
            for function in self.functions_of(p) {
                load[function.node] += flux * function.gradient;
            }
        }
    }

    /// Computes stresses and residual for the increments `increment` (m) and external forces `load`
    /// (N). The error names the first particle without a stress.
    pub(super) fn iterate(
        &self,
        particles: &Particles<D>,
        material: &dyn Material<D>,
        load: &[Vector<D>],
        increment: Vec<Vector<D>>,
    ) -> Result<Iterate<D>, Failure> {
        let mut residual: Vec<Vector<D>> = load.iter().map(|force| -force).collect();
        let (mut responses, mut push) = (Vec::new(), Vec::new());
        for (p, (f, vol0)) in particles.def_grad.iter().zip(&particles.vol0).enumerate() {
            let (stretch, site) = (self.stretch(p, &increment), Site::Particle(p));
            let f = in_space(f, particles.across.get(p).copied().unwrap_or(1.0));
            // A particle beyond the axis has a negative hoop stretch. The determinant is positive
            // if such a particle is also inverted in the plane.
            let is_beyond = D == 2 && stretch[(2, 2)] <= 0.0;
            let j = if is_beyond { stretch[(2, 2)] } else { det(&stretch) };
            if !j.is_finite() {
                return Err(Failure::NonFinite { quantity: "J", site });
            }
            let inverse = inverse(&stretch).filter(|_| j > 0.0);
            let inverse = inverse.ok_or(Failure::Inverted { site, j: j * det(&f) })?;
            let response = material.response(p, &(stretch * f));
            let response = response.ok_or_else(|| Failure::Solve(NO_TANGENT.to_owned()))?;
            if !response.kirchhoff.iter().all(|stress| stress.is_finite()) {
                return Err(Failure::NonFinite { quantity: "stress", site });
            }
            let flux = product(&response.kirchhoff, &inverse.transpose()) * *vol0;
            let (in_plane, hoop_flux) = (in_body::<D>(&flux), flux[(2, 2)]);
            for function in self.functions_of(p) {
                let force = &mut residual[function.node];
                *force += times(&in_plane, &function.gradient);
                force[0] += hoop_flux * function.hoop;
            }
            responses.push(response);
            push.push(inverse.transpose());
        }
        let norm = self.norm(&residual);
        Ok(Iterate { increment, residual, norm, responses, push })
    }

    /// Computes the Newton correction of an iterate (m). The error is the node whose row of the
    /// tangent has no pivot.
    pub(super) fn correction(
        &self,
        particles: &Particles<D>,
        iterate: &Iterate<D>,
    ) -> Result<Vec<Vector<D>>, usize> {
        let mut tangent = BandedSystem::zeros(self.nodes.len(), self.band);
        for (p, vol0) in particles.vol0.iter().enumerate() {
            self.add_stiffness(p, *vol0, iterate, &mut tangent);
        }
        let side = self.of_unknowns(&iterate.residual).iter().map(|value| -value).collect();
        let solution = tangent.solve(side).map_err(|row| self.nodes[row])?;
        let of_node = |rows: &[Option<usize>; D]| {
            Vector::from_fn(|a, _| rows[a].map_or(0.0, |row| solution[row]))
        };
        Ok(self.unknowns.iter().map(of_node).collect())
    }

    fn add_stiffness(&self, p: usize, vol0: f64, iterate: &Iterate<D>, tangent: &mut BandedSystem) {
        let (response, push) = (&iterate.responses[p], &iterate.push[p]);
        let (tau, tau_hoop) = (in_body::<D>(&response.kirchhoff), response.kirchhoff[(2, 2)]);
        let functions = self.functions_of(p);
        let (push_in_plane, push_hoop) = (in_body::<D>(push), push[(2, 2)]);
        let pushed = |function: &NodeFunction<D>| {
            (times(&push_in_plane, &function.gradient), push_hoop * function.hoop)
        };
        let pushed: Vec<(Vector<D>, f64)> = functions.iter().map(pushed).collect();
        // Change of the stress due to a component of the displacement gradient.
        let change_by = |b: usize, d: usize| {
            let mut direction = zeros();
            direction[(b, d)] = 1.0;
            response.tangent(&direction)
        };
        let changes: [[Matrix<3>; D]; D] = array::from_fn(|b| array::from_fn(|d| change_by(b, d)));
        let change_by_hoop = change_by(2, 2);
        for (j, (of_j, hoop_j)) in functions.iter().zip(&pushed) {
            let pull = times(&tau, of_j);
            for b in 0..D {
                let Some(column) = self.unknowns[j.node][b] else { continue };
                let hoop_j = if b == 0 { *hoop_j } else { 0.0 };
                let start = change_by_hoop * hoop_j;
                let change = (0..D).fold(start, |sum, d| sum + changes[b][d] * of_j[d]);
                let in_plane = in_body::<D>(&change);
                let change_hoop = change[(2, 2)] - tau_hoop * hoop_j;
                for (i, (of_i, hoop_i)) in functions.iter().zip(&pushed) {
                    let mut force = (times(&in_plane, of_i) - pull * of_i[b]) * vol0;
                    force[0] += change_hoop * hoop_i * vol0;
                    for a in 0..D {
                        if let Some(row) = self.unknowns[i.node][a] {
                            tangent.add(row, column, force[a]);
                        }
                    }
                }
            }
        }
    }

    /// Returns the largest difference between the indices of unknowns that share a particle.
    fn widest(&self) -> usize {
        let width = |p: usize| {
            let rows = self.functions_of(p).iter().flat_map(|f| self.unknowns[f.node]).flatten();
            let (low, high) =
                rows.fold((usize::MAX, 0), |(low, high), row| (low.min(row), high.max(row)));
            high.saturating_sub(low)
        };
        (0..self.ends.len()).map(width).max().unwrap_or(0)
    }
}

pub(super) const NO_TANGENT: &str = "the law has no consistent tangent";

/// Numbers the free components. Indices vary slowest along the longest grid axis, so that the band
/// is narrow. Returns the indices, and the node of each index.
fn number<const D: usize>(
    grid: &Grid<D>,
    free: &[Vector<D>],
) -> (Vec<[Option<usize>; D]>, Vec<usize>) {
    let mut axes: [usize; D] = array::from_fn(|axis| axis);
    axes.sort_by_key(|axis| std::cmp::Reverse(grid.counts[*axis]));
    let mut order: Vec<usize> = (0..free.len()).collect();
    order.sort_by_key(|node| axes.map(|axis| grid.index_on_axis(*node, axis)));
    let (mut unknowns, mut nodes) = (vec![[None; D]; free.len()], Vec::new());
    for node in order {
        for (axis, unknown) in unknowns[node].iter_mut().enumerate() {
            if free[node][axis] > 0.0 {
                *unknown = Some(nodes.len());
                nodes.push(node);
            }
        }
    }
    (unknowns, nodes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::basis::BasisName;
    use crate::mpm::foundation::particles::Block;
    use crate::mpm::kernel::kernel;
    use crate::mpm::material::MaterialPlan;
    use mpm_subject::PlaneState;
    use rstest::rstest;

    /// The first increment moves all particles beyond the axis. The second one also inverts them in
    /// the plane, so that J is positive.
    #[rstest]
    #[case::beyond(0.0)]
    #[case::beyond_and_inverted(-2.5)]
    fn particle_beyond_the_axis_is_inverted(#[case] slope: f64) {
        let kernel = kernel::<2>(BasisName::Linear);
        let grid = kernel.grid(Vector::zeros(), 0.5, [2, 2], [false; 2]);
        let block = Block { from: Vector::zeros(), to: Vector::from_element(1.0), density: 1.0 };
        let mut particles = Particles::fill(&block, 0.5, 2);
        particles.revolve();
        particles.track_deformation();
        let plan = MaterialPlan::Hencky { young: 100.0, poisson: 0.3 };
        let law = plan.in_plane::<2>(PlaneState::Axisymmetric).unwrap();
        let equations = StepEquations::new(&grid, &particles, kernel.as_ref(), &[]).unwrap();
        let increment = |i: usize| {
            let z = 0.5 * grid.index_on_axis(i, 1) as f64;
            Vector::<2>::new(-2.0, slope * z)
        };
        let increment = (0..grid.nodes()).map(increment).collect();
        let load = vec![Vector::zeros(); grid.nodes()];
        let failure = equations.iterate(&particles, law.as_ref(), &load, increment).err();
        let Some(Failure::Inverted { site: Site::Particle(0), j }) = failure else {
            panic!("{failure:?}")
        };
        assert!(j < 0.0, "{j}");
    }
}
