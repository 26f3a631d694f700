//! Runs particles of `phyz-particle` for the adapter `phyz.py`. Input and output are little-endian
//! doubles on standard input and output.
//!
//! Input: number of particles, h, dt, size of the box, E, nu, mass and volume of a particle, FLIP
//! fraction; then position and velocity of each particle. After that, each input is a number of
//! steps, and each output the position and velocity of each particle.

use phyz_math::Vec3;
use phyz_particle::{Material, MpmSolver, Particle};
use std::io::{self, Read, Write};

fn read<const N: usize>(input: &mut impl Read) -> io::Result<[f64; N]> {
    let mut numbers = [0.0; N];
    for number in &mut numbers {
        let mut bytes = [0; 8];
        input.read_exact(&mut bytes)?;
        *number = f64::from_le_bytes(bytes);
    }
    Ok(numbers)
}

fn main() -> io::Result<()> {
    let (mut input, mut output) = (io::stdin().lock(), io::BufWriter::new(io::stdout().lock()));
    let [count, h, dt, size, e, nu, mass, volume, flip] = read(&mut input)?;
    let mut particles = Vec::new();
    for _ in 0..count as usize {
        let [x, y, z, u, v, w] = read(&mut input)?;
        let (place, velocity) = (Vec3::new(x, y, z), Vec3::new(u, v, w));
        particles.push(Particle::new(place, velocity, mass, volume, Material::Elastic { e, nu }));
    }
    let mut solver = MpmSolver::new(h, dt, (Vec3::zeros(), Vec3::new(size, size, size)));
    solver.alpha = flip;
    while let Ok([steps]) = read(&mut input) {
        for _ in 0..steps as usize {
            solver.step(&mut particles);
        }
        for number in particles.iter().flat_map(|p| [p.x.x, p.x.y, p.x.z, p.v.x, p.v.y, p.v.z]) {
            output.write_all(&number.to_le_bytes())?;
        }
        output.flush()?;
    }
    Ok(())
}
