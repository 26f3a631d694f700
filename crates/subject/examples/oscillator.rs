//! Runs a solver through the interface that judges use: an oscillator with leapfrog steps.

use mpm_subject::{Failure, RunCounters, Samples, Subject};

/// `u_tt = -u` with `u(0) = 0`. The velocity belongs to the middle of the step.
struct Leapfrog {
    u: f64,
    v: f64,
    steps: u64,
}

impl Subject for Leapfrog {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.u += 0.5 * dt * self.v;
        self.v -= dt * self.u;
        self.u += 0.5 * dt * self.v;
        self.steps += 1;
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        samples.restart(1);
        samples.push(&[0.0], &[self.u], &[self.v], 1.0);
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(self.steps)
    }
}

fn main() -> Result<(), Failure> {
    let mut subject = Leapfrog { u: 0.0, v: 1.0, steps: 0 };
    for _ in 0..100 {
        subject.step(0.01)?;
    }
    let mut samples = Samples::default();
    subject.sample(&mut samples);
    println!("u = {:.6}, exactly {:.6}", samples.displacement[0], libm::sin(1.0));
    Ok(())
}
