//! Time of a step with each material law, divided by the time with neo-Hookean elasticity.
//!
//! `cargo bench --bench laws` times bodies of 1e4 particles at strains of about 1e-4, where no law
//! has plastic flow. A number sets the number of particles, and other arguments select scenes
//! (`-- 1e5 3d/linear`). Each round makes a few steps with each law in turn. The ratio of a law is
//! the median over all rounds. Each law first makes one step to check conservation of momentum.

#[path = "transfer/check.rs"]
#[allow(dead_code, reason = "those of passes are for the bench of transfers")]
mod check;
#[path = "common/one_thread.rs"]
mod one_thread;
#[path = "common/random.rs"]
mod random;
#[path = "transfer/scene.rs"]
#[allow(dead_code, reason = "the passes are for the bench of transfers")]
mod scene;
#[path = "common/words.rs"]
mod words;

use check::checked_solver;
use mpm_verify::mpm::{BasisName, MaterialPlan, SchemeName, TransferName};
use mpm_verify::subject::Subject;
use mpm_verify::verify::Timing;
use one_thread::one_thread;
use scene::{Method, Order, total};
use std::time::Instant;

/// Length of a step (s).
const DT: f64 = 1e-4;

/// Velocities (m/s) of bodies of modulus 1 Pa and density 1 in cells of 1 m. The strain after all
/// rounds is about 1e-4.
const SPEED: f64 = 1e-3;

const ROUNDS: usize = 61;

/// Number of steps with a law in a round, so that its particles are in the cache as in a run.
const STEPS: usize = 5;

/// Law of all ratios.
const REFERENCE: MaterialPlan = MaterialPlan::NeoHookean { young: 1.0, poisson: 0.3 };

/// Returns the reference and all other laws, except laws of bodies at rest.
fn laws() -> Vec<MaterialPlan> {
    let others = MaterialPlan::every(|parameter| match parameter.symbol {
        "nu" => 0.3,
        "Y" | "H" | "eta" | "etab" | "kappa" => 0.1,
        "pc" => 1e3,
        _ => 1.0,
    });
    let is_other =
        |plan: &MaterialPlan| !plan.properties().is_at_rest() && plan.name() != REFERENCE.name();
    [REFERENCE].into_iter().chain(others.into_iter().filter(is_other)).collect()
}

fn compare<const D: usize>(basis: BasisName, count: usize) {
    let id = format!("{D}d/{}", basis.name());
    if !words::selects(&id) {
        return;
    }
    let laws = laws();
    let mut solvers: Vec<_> = laws
        .iter()
        .map(|law| {
            let (method, grid, mut particles) =
                Method::<D>::new((basis, TransferName::Flip), Order::Sorted, count);
            particles.v.iter_mut().for_each(|v| *v *= SPEED);
            let id = format!("{id}/{}", law.name());
            checked_solver(&id, DT, (SchemeName::Usl, *law), method, (grid, particles))
        })
        .collect();
    let mut rounds = vec![Vec::new(); laws.len()];
    for _ in 0..ROUNDS {
        for (solver, times) in solvers.iter_mut().zip(&mut rounds) {
            let start = Instant::now();
            for _ in 0..STEPS {
                solver.step(DT).expect("no particle is inverted");
            }
            times.push(start.elapsed().as_secs_f64() / STEPS as f64);
        }
    }
    let median = |times: &[f64]| Timing::of(times).expect("times are numbers").median;
    for (law, times) in laws.iter().zip(&rounds) {
        let ratios: Vec<f64> = times.iter().zip(&rounds[0]).map(|(a, b)| a / b).collect();
        let per_particle = 1e9 / total::<D>(count) as f64 * median(times);
        println!("{id:<22} {:<16} {per_particle:>8.1} {:>6.2}", law.name(), median(&ratios));
    }
}

fn main() {
    one_thread();
    let count = words::count(1e4) as usize;
    println!("ns per particle, and ratio to {}; {count:e} particles, one thread", REFERENCE.name());
    for basis in [BasisName::Linear, BasisName::QuadraticBSpline] {
        compare::<2>(basis, count);
        compare::<3>(basis, count);
    }
}
