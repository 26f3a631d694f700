//! A small body with its methods and laws. For any state of the particles, all numbers after a step
//! must be finite, or an error must name the particle. Shared by the fuzz target and the tests.

use mpm_solvers::mpm::{
    BasisName, Block, Damping, Fixed, FrameName, Gravity, MassName, MaterialPlan, Particles,
    Roller, SchemeName, Setup, Side, Solver, TransferName, Vector, VolumeName, combine, kernel,
    mass_matrix, transfer,
};
use mpm_subject::{Failure, Samples, Site, Start, Subject};

/// Basis, transfer, mass matrix and frame of a valid method.
pub(crate) type Method = (BasisName, TransferName, MassName, FrameName);

/// Lists all valid methods.
pub(crate) fn every_method() -> Vec<Method> {
    let mut all = Vec::new();
    for &basis in BasisName::ALL {
        for &transfer in TransferName::ALL {
            for &mass in MassName::ALL {
                for &frame in FrameName::ALL {
                    if combine(basis, transfer, mass, frame).is_ok() {
                        all.push((basis, transfer, mass, frame));
                    }
                }
            }
        }
    }
    all
}

/// Lists one plan for each law of moving bodies.
pub(crate) fn materials() -> Vec<MaterialPlan> {
    let mut all = MaterialPlan::every(|parameter| match parameter.symbol {
        "nu" => 0.3,
        "Y" | "H" | "eta" => 0.1,
        _ => 1.0,
    });
    all.retain(|plan| !plan.properties().is_at_rest());
    all
}

/// Cell size (m).
const H: f64 = 0.5;

/// Creates two cells of material on each axis, a little outside the first cell of the grid. The
/// body moves, shears and starts to stretch.
pub(crate) fn body<const D: usize>() -> Particles<D> {
    let (from, to) = (Vector::from_element(1.06 * H), Vector::from_element(3.06 * H));
    let block = Block { from, to, density: 1.0 };
    let mut particles = Particles::<D>::fill(&block, H, if D == 1 { 3 } else { 1 });
    for p in 0..particles.len() {
        let x = particles.x[p];
        particles.v[p] = Vector::from_fn(|i, _| 0.1 + 0.2 * x[(i + 1) % D]);
    }
    particles
}

/// Conditions and steps of a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scene {
    pub(crate) method: Method,
    pub(crate) scheme: SchemeName,
    pub(crate) material: MaterialPlan,
    pub(crate) start: Start,
    /// Whether the last axis is periodic.
    pub(crate) periodic: bool,
    /// Cells along each axis.
    pub(crate) cells: usize,
    /// Length of a step (s).
    pub(crate) dt: f64,
}

impl Scene {
    /// Creates a solver for the body under gravity and damping. The first face is fixed, and so is
    /// the last one unless its axis is periodic.
    ///
    /// # Errors
    /// Errors of [`Solver::new`].
    pub(crate) fn solver<const D: usize>(
        &self,
        particles: Particles<D>,
    ) -> Result<Solver<D>, Failure> {
        let (basis, name, mass, frame) = self.method;
        let kernel = kernel::<D>(basis);
        let mut periodic = [false; D];
        periodic[D - 1] = self.periodic;
        let grid = kernel.grid(Vector::zeros(), H, [self.cells; D], periodic);
        let mut setup = Setup {
            particles,
            transfer: transfer(name),
            mass: mass_matrix(mass),
            frame,
            volume: VolumeName::Particle,
            material: self.material.build(),
            effects: vec![
                Box::new(Gravity(Box::new(|_| Vector::from_element(-0.1)))),
                Box::new(Damping(Box::new(|_| 0.1))),
            ],
            boundary: vec![Box::new(Fixed::face(&grid, 0, Side::Low))],
            scheme: self.scheme,
            start: self.start,
            kernel,
            grid,
        };
        if !self.periodic {
            setup.boundary.push(Box::new(Roller::face(&setup.grid, D - 1, Side::High)));
        }
        Solver::new(setup)
    }

    /// Creates a solver and runs three steps. After each step, checks the state, or the failure and
    /// its message.
    pub(crate) fn holds<const D: usize>(&self, what: &str, particles: Particles<D>) {
        let count = particles.len();
        self.predicts(what, particles.clone());
        if let Err(failure) = self.run(particles) {
            let named = match failure {
                Failure::NonFinite { site: Site::Particle(p), .. }
                | Failure::Inverted { site: Site::Particle(p), .. }
                | Failure::LeftDomain { site: Site::Particle(p), .. } => p < count,
                Failure::NotOfDeformation => true,
                Failure::Solve(_) => self.method.2 == MassName::Consistent,
                _ => false,
            };
            assert!(named, "{what}: {failure:?} of {self:?}");
        }
    }

    /// Asserts that the stable time step is a number in the requested range, or a failure, for any
    /// state.
    fn predicts<const D: usize>(&self, what: &str, particles: Particles<D>) {
        const LONGEST: f64 = 0.1;
        let Ok(solver) = self.solver(particles) else { return };
        if let Ok(stable) = solver.stable_time_step(LONGEST, 3) {
            assert!(
                (0.0..=LONGEST).contains(&stable),
                "{what}: stable time step {stable} of {self:?}"
            );
        }
    }

    fn run<const D: usize>(&self, particles: Particles<D>) -> Result<(), Failure> {
        let mut solver = self.solver(particles)?;
        let mut samples = Samples::default();
        for _ in 0..3 {
            solver.step(self.dt)?;
            solver.sample(&mut samples);
            self.is_sound(&samples);
            for p in 0..samples.len() {
                let own = solver.transfer().moment(p);
                let sound = own.is_none_or(|own| own.iter().all(|c| c.is_finite()));
                assert!(sound, "a silent moment: {own:?} of {self:?}");
            }
        }
        Ok(())
    }

    fn is_sound(&self, samples: &Samples) {
        let all = [
            ("label", &samples.label),
            ("displacement", &samples.displacement),
            ("velocity", &samples.velocity),
            ("weight", &samples.weight),
            ("stress", &samples.stress),
            ("F", &samples.deformation_gradient),
        ];
        for (name, column) in all {
            assert!(
                column.iter().all(|c| c.is_finite()),
                "a silent {name}: {column:?} of {self:?}"
            );
        }
    }
}
