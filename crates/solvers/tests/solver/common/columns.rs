//! Lists every number that particles store. If a column is added to particles, this file does not
//! compile without it.

use mpm_solvers::mpm::Particles;

/// Returns the temperatures, and all other numbers.
pub(crate) fn columns<const D: usize>(particles: &Particles<D>) -> (&[f64], Vec<f64>) {
    let Particles {
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
        domain,
        domain0,
        grad_v,
        temperature,
        spacing,
        samples_stress_across: _,
    } = particles;
    let vectors = [x0, x, current_position, v].into_iter().flatten().flatten();
    let matrices = [sigma, def_grad, domain, domain0, grad_v].into_iter().flatten().flatten();
    let scalars = [mass, vol0, vol, across, rate_across, stress_across].into_iter().flatten();
    (temperature, vectors.chain(matrices).chain(scalars).chain(spacing).copied().collect())
}
