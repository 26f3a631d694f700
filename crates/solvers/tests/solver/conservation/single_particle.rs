//! One free particle at the fraction xi of a linear cell, under the stress sigma, in 1-D.
//!
//! The only velocity on the nodes is that of the particle, so only a scheme that computes strains
//! from *updated* grid velocities changes its stress. With the Courant number C = c dt / h one step
//! of USL gives `sigma <- (1 - C^2 / (xi (1 - xi))) sigma`; under USF and MUSL the stress never
//! changes.

use crate::common::{H, body};
use mpm_solvers::mpm::{
    BasisName, Block, Fixed, Hencky, LinearElastic, Particles, SchemeName, Setup, Side, Solver,
    TransferName, Vector,
};
use mpm_subject::{Start, Subject};
use proptest::prelude::*;

const YOUNG: f64 = 100.0;
const DENSITY: f64 = 4.0;

/// Creates the particle, alone in the middle cell of three.
fn particle(name: TransferName, scheme: SchemeName, xi: f64, sigma: f64) -> Solver<1> {
    let (from, to) = (Vector::<1>::new(H), Vector::<1>::new(2.0 * H));
    let mut particles = Particles::fill(&Block { from, to, density: DENSITY }, H, 1);
    particles.x[0][0] = (1.0 + xi) * H;
    particles.sigma[0][(0, 0)] = sigma;
    let plain = body((BasisName::Linear, name), scheme, particles, (H, 3));
    Solver::new(Setup { material: Box::new(LinearElastic::new(YOUNG, 0.0)), ..plain }).unwrap()
}

/// Returns sigma after each of `steps` steps at the Courant number `courant`, relative to its
/// initial value.
fn ratios(
    (name, scheme): (TransferName, SchemeName),
    xi: f64,
    sigma: f64,
    courant: f64,
    steps: usize,
) -> Vec<f64> {
    let mut solver = particle(name, scheme, xi, sigma);
    let dt = courant * H / libm::sqrt(YOUNG / DENSITY);
    let step = |_| {
        solver.step(dt).unwrap();
        solver.particles().sigma[0][(0, 0)] / sigma
    };
    (0..steps).map(step).collect()
}

/// Transfers without an affine field. They differ by the velocity relative to the grid, which a
/// single particle does not have.
const PLAIN: [TransferName; 2] = [TransferName::Flip, TransferName::Pic];

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(500) })]

    #[test]
    fn stress_growth_of_usl_matches_the_closed_form(
        xi in 0.02..0.98_f64,
        courant in 0.01..1.5_f64,
        sigma in prop_oneof![-0.5..-0.01_f64, 0.01..0.5_f64],
    ) {
        let expected = 1.0 - courant * courant / (xi * (1.0 - xi));
        for name in PLAIN {
            let factor = ratios((name, SchemeName::Usl), xi, sigma, courant, 1)[0];
            let error = (factor - expected).abs() / expected.abs().max(1.0);
            prop_assert!(error <= 1e-13, "{name:?}: {factor}, closed form {expected}");
        }
    }

    #[test]
    fn usf_and_musl_never_change_the_stress(
        xi in 0.02..0.98_f64,
        courant in 0.01..1.5_f64,
        sigma in prop_oneof![-0.5..-0.01_f64, 0.01..0.5_f64],
    ) {
        let schemes = [SchemeName::Usf, SchemeName::Musl];
        for method in PLAIN.into_iter().flat_map(|name| schemes.map(|scheme| (name, scheme))) {
            for ratio in ratios(method, xi, sigma, courant, 100) {
                let error = (ratio - 1.0).abs();
                prop_assert!(error <= 1e-13, "{method:?} changes the stress by {error:.1e}");
            }
        }
    }

    /// The affine field stores the effect of the force. Let `s = C^2 / (xi (1 - xi))`, and g be the
    /// velocity gradient times dt, in units of 1/E. USL and MUSL: `g <- g - s sigma`, then
    /// `sigma <- sigma + g`; USF in the opposite order. These are leapfrogs, in a fixed frame
    /// (sigma is tiny).
    #[test]
    fn apic_follows_the_recursion_of_an_oscillator(
        xi in 0.05..0.95_f64,
        share in 0.05..0.99_f64,
    ) {
        let courant = share * 2.0 * libm::sqrt(xi * (1.0 - xi));
        let s = courant * courant / (xi * (1.0 - xi));
        for &scheme in SchemeName::ALL {
            let found = ratios((TransferName::Apic, scheme), xi, 1e-18, courant, 50);
            let (mut sigma, mut g) = (1.0, 0.0);
            for (step, found) in found.into_iter().enumerate() {
                if scheme == SchemeName::Usf {
                    sigma += g;
                    g -= s * sigma;
                } else {
                    g -= s * sigma;
                    sigma += g;
                }
                let bound = 1.0 / (1.0 - share);
                let error = (found - sigma).abs() / bound;
                prop_assert!(error <= 1e-13, "{scheme:?}, step {step}: {found} against {sigma}");
            }
        }
    }
}

/// One particle is in the middle of one cell, whose left node is fixed. The right node has the
/// velocity of the particle, `x' / x = eps' = v / L`. A law with `sigma V = E eps V0` (Hencky's)
/// gives `v = v0 cos(w t)`, `x = x0 exp(v0/(L w) sin(w t))`, `w = sqrt(E/rho)/L`.
fn swinging(scheme: SchemeName, start: Start, steps: u32) -> f64 {
    let (length, speed, until) = (1.0, 0.8, 1.0);
    let block =
        Block { from: Vector::<1>::zeros(), to: Vector::<1>::new(length), density: DENSITY };
    let mut particles = Particles::fill(&block, length, 1);
    particles.v[0][0] = speed;
    let method = (BasisName::Linear, TransferName::Flip);
    let mut setup = body(method, scheme, particles, (length, 1));
    (setup.material, setup.start) = (Box::new(Hencky::new(YOUNG, 0.0)), start);
    setup.boundary = vec![Box::new(Fixed::face(&setup.grid, 0, Side::Low))];
    let mut solver = Solver::new(setup).unwrap();
    (0..steps).for_each(|_| solver.step(until / f64::from(steps)).unwrap());
    let w = libm::sqrt(YOUNG / DENSITY) / length;
    let exact = 0.5 * length * libm::exp(speed / (length * w) * libm::sin(w * until));
    solver.particles().x[0][0] - exact
}

/// F grows by `1 + dt v/L`, while the solution grows by the exponential. The order is therefore 1,
/// for any start of the velocity.
#[test]
fn particle_in_one_cell_oscillates_with_a_first_order_error() {
    for scheme in [SchemeName::Usf, SchemeName::Usl, SchemeName::Musl] {
        for start in [Start::AtZero, Start::HalfStepBack] {
            let [coarse, fine] = [2000, 4000].map(|steps| swinging(scheme, start, steps));
            let order = libm::log2(coarse / fine);
            assert!((order - 1.0).abs() <= 0.02, "{scheme:?} {start:?}: {coarse:e}, {fine:e}");
            assert!(fine.abs() <= 3e-4, "{scheme:?} {start:?}: {fine:e}");
        }
    }
}
