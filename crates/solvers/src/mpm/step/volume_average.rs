//! F-bar: an averaged volume ratio prevents volumetric locking (Zhao, Jiang & Choo 2023, IJNME
//! 124).
//!
//! The law reads a deformation gradient with an averaged volume ratio:
//!
//! ```text
//! Jbar_i = sum_p V0_p J_p N_i(x_p) / sum_p V0_p N_i(x_p)     nodes
//! Jbar_p = sum_i Jbar_i N_i(x_p)                             particles
//! Fbar_p = (Jbar_p/J_p)^(1/D) F_p
//! ```
//!
//! The weights are those at the start of the step, as for forces and velocity gradients; J is the
//! value at the end of the step. The averaging does not change F, J and volume of a particle. The
//! internal force uses the volume `V0 J` and gradients that are not averaged. Both averages have
//! the same weights, which sum to one, so a uniform J is reproduced and Jbar is between the
//! smallest and largest J.
//!
//! A law that stores only J receives Jbar as its volume. With averaged ratios, the internal force
//! is not the derivative of a stored energy.

use crate::mpm::foundation::algebra::{Matrix, Vector, det, identity, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{Kernel, ParticleField};
use crate::mpm::material::{Material, StressUpdate};
use mpm_subject::named;
use mpm_subject::{Column, Failure};

named! {
    /// Volume ratios for which a law can compute its stress.
    pub enum VolumeName {
        /// The volume ratio of the particle itself, as in the original MPM.
        Particle = "particle",
        /// The volume ratio averaged over the nodes of the particle: F-bar, which does not lock
        /// near incompressibility (Zhao, Jiang & Choo 2023, IJNME 124).
        Averaged = "averaged",
    }
}

/// Arrays for averaged volume ratios. Each update writes every entry before reading it.
#[derive(Debug)]
pub(in crate::mpm) struct VolumeAverage<const D: usize> {
    /// J and 1 for each particle; after averaging, the weighted means of J and of 1.
    ratio: Vec<Vector<D>>,
    /// Sums of `V0 J N_i` and `V0 N_i` for each node (m^D); later Jbar_i and 1.
    nodal_ratio: Vec<Vector<D>>,
    /// Volume of each particle without averaging (m^D), stored while the law reads the averaged
    /// volume.
    own_volume: Vec<f64>,
    /// F of each particle without averaging, stored while the law reads Fbar; empty if the law does
    /// not read F.
    own_def_grad: Vec<Matrix<D>>,
}

/// Number of P2G and G2P passes per average.
pub(in crate::mpm) const PASSES: u64 = 2;

impl<const D: usize> VolumeAverage<D> {
    /// Creates the arrays for `particles` on `grid`. The law must either read F
    /// (`reads_deformation`) or store only J. Fails in 1-D.
    pub(in crate::mpm) fn new(
        particles: &Particles<D>,
        grid: &Grid<D>,
        reads_deformation: bool,
    ) -> Result<Self, Failure> {
        if D == 1 {
            return Err(Failure::Solve("in 1-D the volume ratio is not averaged".to_owned()));
        }
        let total = particles.len();
        Ok(Self {
            ratio: vec![zeros(); total],
            nodal_ratio: vec![zeros(); grid.nodes()],
            own_volume: vec![0.0; total],
            own_def_grad: vec![zeros(); if reads_deformation { total } else { 0 }],
        })
    }

    /// Wraps `material` so that it reads averaged volume ratios.
    pub(in crate::mpm) fn law<'a>(
        &'a mut self,
        material: &'a mut dyn Material<D>,
        kernel: &'a dyn Kernel<D>,
        grid: &'a Grid<D>,
    ) -> AveragedLaw<'a, D> {
        AveragedLaw { average: self, material, kernel, grid }
    }

    pub(in crate::mpm) fn columns(&self) -> [Column<'_>; 4] {
        [
            Column::of_particles("average of J", &self.ratio),
            Column::of_nodes("nodal average of J", &self.nodal_ratio),
            Column::of_particles("own V", &self.own_volume),
            Column::of_particles("own F", &self.own_def_grad),
        ]
    }

    /// Returns Jbar of particle `p` with the volume ratio `j`. If the weights do not sum to one,
    /// for example outside the grid, `j` receives the remaining weight.
    fn mean(&self, p: usize, j: f64) -> f64 {
        let ratio = &self.ratio[p];
        ratio[0] + (1.0 - ratio[1]) * j
    }

    /// Averages `own_volume / V0`, with the weights at the current positions.
    fn average(&mut self, kernel: &dyn Kernel<D>, grid: &Grid<D>, particles: &mut Particles<D>) {
        let volumes = self.own_volume.iter().zip(&particles.vol0);
        for (ratio, (volume, vol0)) in self.ratio.iter_mut().zip(volumes) {
            *ratio = Vector::from_fn(|axis, _| if axis == 0 { volume / vol0 } else { 1.0 });
        }
        // P2G of momentum is weighted by mass, so the reference volume temporarily replaces the
        // mass.
        std::mem::swap(&mut particles.mass, &mut particles.vol0);
        let field = ParticleField { v: &self.ratio, affine: None };
        kernel.p2g_momentum(particles, field, grid, &mut self.nodal_ratio);
        std::mem::swap(&mut particles.mass, &mut particles.vol0);
        for ratio in &mut self.nodal_ratio {
            if ratio[1] != 0.0 {
                *ratio /= ratio[1];
            }
        }
        self.ratio.fill(zeros());
        kernel.g2p(grid, &self.nodal_ratio, particles, (0.0, 1.0), &mut self.ratio);
    }

    /// Replaces the volumes by Jbar V0, and F by Fbar if the law reads F.
    fn put_average(&mut self, particles: &mut Particles<D>) {
        for p in 0..particles.len() {
            let (vol0, j) = (particles.vol0[p], self.own_volume[p] / particles.vol0[p]);
            let mean = self.mean(p, j);
            particles.vol[p] = mean * vol0;
            if let Some(own) = self.own_def_grad.get_mut(p) {
                let def_grad = &mut particles.def_grad[p];
                *own = *def_grad;
                *def_grad *= root::<D>(mean / j);
            }
        }
    }

    /// Restores the columns that [`put_average`](Self::put_average) has replaced.
    fn put_back(&mut self, particles: &mut Particles<D>) {
        particles.vol.copy_from_slice(&self.own_volume);
        if !self.own_def_grad.is_empty() {
            std::mem::swap(&mut self.own_def_grad, &mut particles.def_grad);
        }
    }
}

fn root<const D: usize>(ratio: f64) -> f64 {
    match D {
        1 => ratio,
        2 => ratio.sqrt(),
        _ => libm::cbrt(ratio),
    }
}

/// A law that reads averaged volume ratios during one update.
pub(in crate::mpm) struct AveragedLaw<'a, const D: usize> {
    average: &'a mut VolumeAverage<D>,
    material: &'a mut dyn Material<D>,
    kernel: &'a dyn Kernel<D>,
    grid: &'a Grid<D>,
}

impl<const D: usize> AveragedLaw<'_, D> {
    /// Calls `act` with the law and `particles` at averaged volume ratios. Particle volumes must
    /// already be stored in `own_volume`.
    fn with_average<T>(
        &mut self,
        particles: &mut Particles<D>,
        act: impl FnOnce(&mut dyn Material<D>, &mut Particles<D>) -> T,
    ) -> T {
        let Self { average, material, kernel, grid } = self;
        average.average(*kernel, grid, particles);
        average.put_average(particles);
        let acted = act(*material, particles);
        average.put_back(particles);
        acted
    }
}

impl<const D: usize> Material<D> for AveragedLaw<'_, D> {
    fn reads_deformation(&self) -> bool {
        self.material.reads_deformation()
    }

    fn keeps_stretch_across(&self) -> bool {
        self.material.keeps_stretch_across()
    }

    fn reads_rate(&self) -> bool {
        self.material.reads_rate()
    }

    fn is_stressed_at_rest(&self) -> bool {
        self.material.is_stressed_at_rest()
    }

    fn columns(&self) -> Vec<Column<'_>> {
        self.material.columns()
    }

    /// Uses the particle volumes, which have already been computed from F.
    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        self.average.own_volume.copy_from_slice(&particles.vol);
        self.with_average(particles, |material, particles| material.start_deformed(particles))
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let reads_deformation = self.material.reads_deformation();
        let (dt, particles) = (body.dt(), body.particles());
        let own = self.average.own_volume.iter_mut();
        if reads_deformation {
            for (own, (f, vol0)) in own.zip(particles.def_grad.iter().zip(&particles.vol0)) {
                *own = det(f) * vol0;
            }
        } else {
            for (own, (vol, grad_v)) in own.zip(particles.vol.iter().zip(&particles.grad_v)) {
                *own = vol * det(&(identity() + grad_v * dt));
            }
        }
        // The volume has already advanced, so a law that stores only J must not advance the volume
        // again.
        let rest = if reads_deformation { dt } else { 0.0 };
        self.with_average(particles, |material, particles| {
            material.update(&mut StressUpdate::new(rest, particles));
        });
    }
}
