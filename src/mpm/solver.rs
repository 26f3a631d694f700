//! The solver: runs the stages of a scheme and keeps the census.

use super::{
    algebra::{Matrix, Vector},
    basis::Domain,
    boundary::Fixed,
    effect::Effect,
    grid::Grid,
    kernel::Kernel,
    material::Material,
    particles::Particles,
    scheme::SchemeName,
    stage::Stage,
};
use crate::subject::{Census, Failure, Samples, Site, Start, Subject};

/// Everything that a solver is made of.
pub struct Setup<const D: usize> {
    /// The background grid.
    pub grid: Grid<D>,
    /// The body, in its initial state.
    pub particles: Particles<D>,
    /// Basis and transfer.
    pub kernel: Box<dyn Kernel<D>>,
    /// The constitutive law.
    pub material: Box<dyn Material<D>>,
    /// What the scene lists, and nothing else.
    pub effects: Vec<Box<dyn Effect<D>>>,
    /// Faces that do not move.
    pub fixed: Vec<Fixed>,
    /// Order of the stages.
    pub scheme: SchemeName,
    /// Treatment of the initial velocity.
    pub start: Start,
}

/// The original MPM at one level of refinement.
pub struct Solver<const D: usize> {
    setup: Setup<D>,
    time: f64,
    started: bool,
    transfers: u64,
    crossings: u64,
    left_domain: u64,
    min_j: f64,
    cells: Vec<[usize; D]>,
}

impl<const D: usize> Solver<D> {
    /// A solver at t = 0.
    ///
    /// # Errors
    /// [`Failure::NonFinite`] if the initial state of a particle is; [`Failure::LeftDomain`] if it
    /// starts outside the grid.
    pub fn new(mut setup: Setup<D>) -> Result<Self, Failure> {
        if setup.kernel.domain() == Domain::Follows {
            setup.particles.track_domains();
        }
        if setup.material.reads_deformation() {
            setup.particles.track_deformation();
        }
        setup.particles.all_finite()?;
        let cells = setup.particles.x.iter().enumerate().map(|(p, x)| {
            setup.grid.cell(x).ok_or_else(|| Failure::LeftDomain {
                site: Site::Particle(p),
                position: x.iter().copied().collect(),
            })
        });
        let cells = cells.collect::<Result<_, _>>()?;
        Ok(Self {
            setup,
            time: 0.0,
            started: false,
            transfers: 0,
            crossings: 0,
            left_domain: 0,
            min_j: 1.0,
            cells,
        })
    }

    /// The particles as they are now.
    pub fn particles(&self) -> &Particles<D> {
        &self.setup.particles
    }

    /// The grid as the last stage left it.
    pub fn grid(&self) -> &Grid<D> {
        &self.setup.grid
    }

    /// Runs one stage of a step of length `dt` (s).
    ///
    /// # Errors
    /// See [`Subject::step`].
    pub fn run(&mut self, stage: Stage, dt: f64) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, .. } = &mut self.setup;
        match stage {
            Stage::Mass => kernel.p2g_mass(particles, grid),
            Stage::Momentum => self.momentum(),
            Stage::Force => self.force(),
            Stage::Acceleration => self.accelerate(),
            Stage::GridVelocity => {
                for (v, a) in grid.velocity.iter_mut().zip(&grid.acceleration) {
                    *v += a * dt;
                }
            }
            Stage::ParticleVelocity => kernel.g2p_velocity(grid, dt, particles),
            Stage::Stress => return self.stress(dt),
            Stage::Position => return self.position(dt),
        }
        if !matches!(stage, Stage::Acceleration | Stage::GridVelocity) {
            self.count_pass();
        }
        Ok(())
    }

    fn momentum(&mut self) {
        let Setup { grid, particles, kernel, fixed, .. } = &mut self.setup;
        kernel.p2g_momentum(particles, grid);
        for (v, m) in grid.velocity.iter_mut().zip(&grid.mass) {
            *v = per_mass(v, *m);
        }
        for face in fixed {
            face.hold(&mut grid.velocity);
        }
    }

    fn force(&mut self) {
        let Setup { grid, particles, kernel, effects, .. } = &mut self.setup;
        kernel.p2g_internal_force(particles, grid);
        for effect in effects {
            self.transfers += effect.add_force(self.time, particles, kernel.as_ref(), grid);
        }
    }

    fn accelerate(&mut self) {
        let Setup { grid, fixed, .. } = &mut self.setup;
        for ((a, f), m) in grid.acceleration.iter_mut().zip(&grid.force).zip(&grid.mass) {
            *a = per_mass(f, *m);
        }
        for face in fixed {
            face.hold(&mut grid.acceleration);
        }
    }

    fn stress(&mut self, dt: f64) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, material, .. } = &mut self.setup;
        kernel.g2p_gradient(grid, particles);
        for (f, grad_v) in particles.def_grad.iter_mut().zip(&particles.grad_v) {
            *f = (Matrix::identity() + grad_v * dt) * *f;
        }
        material.update(dt, particles);
        self.count_pass();
        for (p, (vol, vol0)) in
            self.setup.particles.vol.iter().zip(&self.setup.particles.vol0).enumerate()
        {
            let (j, site) = (vol / vol0, Site::Particle(p));
            if !j.is_finite() {
                return Err(Failure::NonFinite { quantity: "J", site });
            }
            self.min_j = self.min_j.min(j);
            if j <= 0.0 {
                return Err(Failure::Inverted { site, j });
            }
        }
        Ok(())
    }

    fn position(&mut self, dt: f64) -> Result<(), Failure> {
        let Setup { grid, particles, kernel, .. } = &mut self.setup;
        kernel.g2p_position(grid, dt, particles);
        if kernel.domain() == Domain::Follows {
            particles.track_domains();
        }
        self.count_pass();
        self.track_cells()
    }

    /// Counts changes of cell and departures; the first particle without a cell ends the run.
    fn track_cells(&mut self) -> Result<(), Failure> {
        let Setup { grid, particles, .. } = &self.setup;
        let mut first = Ok(());
        for (p, (x, cell)) in particles.x.iter().zip(&mut self.cells).enumerate() {
            let site = Site::Particle(p);
            if let Some(now) = grid.cell(x) {
                self.crossings += u64::from(now != *cell);
                *cell = now;
                continue;
            }
            let finite = x.iter().all(|c| c.is_finite());
            self.left_domain += u64::from(finite);
            first = first.and_then(|()| {
                Err(if finite {
                    let position = x.iter().copied().collect();
                    Failure::LeftDomain { site, position }
                } else {
                    Failure::NonFinite { quantity: "position", site }
                })
            });
        }
        first
    }

    fn count_pass(&mut self) {
        self.transfers += self.setup.particles.len() as u64 * self.setup.kernel.support();
    }

    /// `v(-dt/2) = v(0) - dt/2 a(0)`.
    fn half_step_back(&mut self, dt: f64) -> Result<(), Failure> {
        self.run(Stage::Mass, dt)?;
        self.run(Stage::Force, dt)?;
        self.run(Stage::Acceleration, dt)?;
        self.run(Stage::ParticleVelocity, -0.5 * dt)
    }
}

/// `value / mass`, zero where no particle gives the node any mass.
fn per_mass<const D: usize>(value: &Vector<D>, mass: f64) -> Vector<D> {
    if mass > 0.0 { value / mass } else { Vector::zeros() }
}

impl<const D: usize> Subject for Solver<D> {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        if !self.started && self.setup.start == Start::HalfStepBack {
            self.half_step_back(dt)?;
        }
        self.started = true;
        for &stage in self.setup.scheme.stages() {
            self.run(stage, dt)?;
        }
        self.time += dt;
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        let particles = &self.setup.particles;
        samples.clear();
        samples.dimension = D;
        for (x0, x) in particles.x0.iter().zip(&particles.x) {
            samples.label.extend(x0.iter());
            samples.displacement.extend((x - x0).iter());
        }
        samples.velocity.extend(particles.v.iter().flat_map(|v| v.iter()));
        samples.weight.extend(&particles.vol0);
    }

    fn census(&self) -> Census {
        Census {
            particles: Some(self.setup.particles.len() as u64),
            transfers: self.transfers,
            crossings: Some(self.crossings),
            left_domain: Some(self.left_domain),
            min_j: self.min_j,
        }
    }
}
