//! The solver as a subject of mpm-verify.

use super::solver::Bar;
use mpm_verify::prelude::*;

/// A bar with its particles as they began.
struct JudgedBar(Bar, ProblemParticles);

impl Subject for JudgedBar {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.0.step(dt).map_err(|p| Failure::External(format!("lost particle {p}")))
    }

    fn sample(&self, samples: &mut Samples) {
        let Self(bar, start) = self;
        samples.restart(1);
        for (p, label) in start.reference_position.iter().enumerate() {
            samples.push(&[*label], &[bar.x[p] - label], &[bar.v[p]], start.reference_volume[p]);
        }
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(self.0.visits)
    }
}

pub(crate) struct OwnSolver;

impl SolverFactory for OwnSolver {
    fn name(&self) -> &'static str {
        "own-solver"
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        Capabilities::of(&[1], &["linear_elastic"], &["free", "fixed"], &[]).lacking(needs)
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        let (grid, start, faces) = (problem.grid, problem.particles, problem.faces);
        let is_held = |name| faces.iter().any(|f| f.name == name && f.condition == "fixed");
        let [young, nu] = ["young", "poisson"].map(|key| problem.materials[0].parameter(key));
        let bar = Bar {
            grid: (grid.origin[0], grid.h, grid.cells[0] as usize),
            held: ["left", "right"].map(is_held),
            modulus: young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)),
            x: start.position.clone(),
            v: start.velocity.clone(),
            mass: start.mass.clone(),
            volume: start.volume.clone(),
            stress: start.stress.clone(),
            visits: 0,
        };
        Ok(Box::new(JudgedBar(bar, start)))
    }
}
