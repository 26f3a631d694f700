//! Program for counting instructions: `instructions SCENE STEPS` runs a scene for a number of
//! steps, and `ci/instructions` computes the instructions of a step from two such runs.
//!
//! `minimal` is the general solver on a bar without effects; `by_hand` is a loop written for this
//! bar only. The program first checks that both give the same motion. The other scenes are kernels,
//! whose passes are repeated STEPS times. `kernels` lists the kernels with their numbers of
//! particles. `processor` prints the widest registers that the loops support on this processor.

mod by_hand;
mod kernels;

use by_hand::ByHand;
use mpm_verify::mpm::{
    BasisName, Block, FrameName, LinearElastic, MassName, Particles, SchemeName, Setup, Solver,
    TransferName, Vector, VolumeName, kernel, mass_matrix, transfer,
};
use mpm_verify::subject::{Start, Subject};
use std::process::ExitCode;

const CELLS: usize = 250;
const PER_CELL: usize = 4;
const H: f64 = 0.1;
const DT: f64 = 1e-3;
const YOUNG: f64 = 100.0;

/// Creates a free bar with one empty cell at each end, whose initial velocity is one of its modes.
fn bar() -> Particles<1> {
    let (from, to) = (Vector::<1>::new(H), Vector::<1>::new(H * (1 + CELLS) as f64));
    let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, H, PER_CELL);
    for (v, x) in particles.v.iter_mut().zip(&particles.x0) {
        v[0] = 0.1 * libm::sin(x[0]);
    }
    particles
}

fn minimal() -> Solver<1> {
    let kernel = kernel::<1>(BasisName::Linear);
    let setup = Setup {
        grid: kernel.grid(Vector::zeros(), H, [CELLS + 2], [false]),
        particles: bar(),
        kernel,
        transfer: transfer(TransferName::Flip),
        mass: mass_matrix(MassName::Lumped),
        frame: FrameName::Updated,
        volume: VolumeName::Particle,
        material: Box::new(LinearElastic::new(YOUNG, 0.0)),
        effects: Vec::new(),
        boundary: Vec::new(),
        scheme: SchemeName::Musl,
        start: Start::AtZero,
    };
    Solver::new(setup).expect("a sound bar")
}

fn by_hand() -> ByHand {
    let bar = bar();
    let component = |column: &[Vector<1>]| column.iter().map(|value| value[0]).collect::<Vec<_>>();
    let nodes = || vec![0.0; CELLS + 3];
    ByHand {
        h: H,
        young: YOUNG,
        cell: bar.x.iter().map(|x| (x[0] / H) as usize).collect(),
        x: component(&bar.x),
        v: component(&bar.v),
        sigma: vec![0.0; bar.len()],
        mass: bar.mass,
        vol0: bar.vol0,
        vol: bar.vol,
        node_mass: nodes(),
        force: nodes(),
        acceleration: nodes(),
        velocity: nodes(),
        crossings: 0,
        min_j: 1.0,
    }
}

fn agree() -> bool {
    let (mut general, mut own) = (minimal(), by_hand());
    for _ in 0..100 {
        general.step(DT).expect("a sound step");
        own.step(DT).expect("a sound step");
    }
    let moved = general.particles().x.iter().zip(&own.x);
    moved.into_iter().all(|(a, b)| (a[0] - b).abs() <= 1e-12 * b.abs())
}

/// Returns the widest registers that the loops support on this processor.
fn registers() -> &'static str {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("avx2") {
        return "avx2";
    }
    "plain"
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let steps = words.get(1).and_then(|word| word.parse::<u32>().ok()).unwrap_or(0);
    match words.first() {
        Some(&"minimal") => {
            let mut bar = minimal();
            (0..steps).for_each(|_| bar.step(DT).expect("a sound step"));
        }
        Some(&"by_hand") => {
            let mut bar = by_hand();
            (0..steps).for_each(|_| bar.step(DT).expect("a sound step"));
        }
        Some(&"kernels") => {
            for name in kernels::NAMES {
                println!("{name} {}", kernels::run(name, 1).unwrap_or_default());
            }
        }
        Some(&"processor") => println!("{}", registers()),
        Some(name) if kernels::NAMES.contains(name) => {
            kernels::run(name, steps);
        }
        // `cargo bench` runs this program without a scene, so it only checks the motion.
        _ if agree() => println!("the general solver and the loop by hand agree"),
        _ => {
            println!("the general solver and the loop by hand do NOT agree");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}
