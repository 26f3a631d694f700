//! `explain`: the problem, its source, and the expectations with their reasons.

use super::{BAR, Folder, SOUND, assert_contains};
use crate::common::folder::flat;
use rstest::rstest;

#[rstest]
#[case::a_wave_under_gravity("oedometer", &[
    "oedometer: Oedometer at large strain",
    "source            Wobbes & Tielen (2015), Accuracy of original MPM: oedometer",
    "equation          small strain, rho0 u_tt = Div P + rho0 b",
    "c = sqrt(E/rho) = 10",
    "function          fall(tau) = -g/2*max(tau, 0)^2",
    "reference         linear lumped FEM, log_strain, 640 elements",
    "mpm-linear-flip-usl-vs-exact\n  expected: failed\n  because: a particle that has just entered",
])]
#[case::a_linearised_wave("acoustic-column", &[
    "linearised        the exact solution is approximate: its equations have a residual of 2.0e-6 \
     times their terms (tolerance: 5e-6), which causes an error of about 3e-13 m during the run. \
     Reason for the tolerance: strains are 1e-6",
])]
#[case::one_particle("grid-crossing", &[
    "grid-crossing: Mechanism of grid crossing",
    "prediction        -sigma*Omega*(n_left - n_right)/h [N]",
    "mpm-linear\n  expected: agrees with the prediction within 1e-14\n  because: the gradients",
])]
#[case::a_study_of_stability("courant-limit", &["mpm-linear-flip-usl\n  expected: predictions confirmed by runs; the limit 1/sqrt(2 - short) within"])]
#[case::without_a_force("set-force --without force", &[
    "effects           body_force, force\n",
    "a step            P2G(mass, force), acceleration, G2P(particle velocity), P2G(momentum),\n",
    "particle visits   p2g mass, p2g momentum, p2g internal force, p2g point force at 20 of 16",
    "force share 16 at 4 of 16\n",
    "without           `force` these lines change:\n",
    "    becomes         body_force\n",
])]
#[case::without_contact("two-bar-impact --without contact", &[
    "effects           contact\n", "`contact` these lines change:", "p2g mass gradient",
])]
#[case::without_an_unused_effect("set-force --without gravity", &[
    "`gravity` is not used, so nothing changes"
])]
fn a_suite_that_is_built_in(#[case] arguments: &str, #[case] words: &[&str]) {
    let arguments: Vec<&str> = ["explain"].into_iter().chain(arguments.split(' ')).collect();
    let out = flat(&Folder::new().accepted(&arguments));
    let words: Vec<String> = words.iter().map(|words| flat(words)).collect();
    assert_contains(&out, &words.iter().map(String::as_str).collect::<Vec<_>>());
}

#[test]
fn local_suite_is_explained() {
    let folder = Folder::with("bar.yaml", BAR);
    let found = folder.call(&["explain", "bar.yaml"]).ended(SOUND);
    insta::assert_snapshot!(found.out, @"
    short-bar: Short bar

      levels            all cases
                          cells      h (m)  particles     dt (s)    steps  Courant number
                              4  2.5000e-1         16  1.0000e-3       50   0.0400
                              6  1.6667e-1         24  1.0000e-3       50   0.0600
                              8  1.2500e-1         32  1.0000e-3       50   0.0800
                             12  8.3333e-2         48  1.0000e-3       50   0.1200
      cost              1e4 particle steps, about 3e-3 s of one thread; 5e-3 MB
      source            a textbook
      parameters        omega = 5*pi = 15.70796
      body              0 to 1 m, density 1
      material          linear elastic, E = 100 Pa, nu = 0
                        the solver integrates the plain rate, sigma' = C : D, without the spin terms of
                        an objective rate
      left              fixed
      right             free
      initial velocity  1e-3*sin(pi*X/2)
      exact displacement 1e-3*sin(pi*X/2)*sin(omega*t)/omega
      equation          small strain, rho0 u_tt = Div P + rho0 b, P = C : sym(grad u)
      amplitude         largest |u| 4.502e-5 m, largest |grad u| 7.071e-5
      dt                0.001 s, rounded to whole steps
      instants          50
      particles         4 per cell, equally spaced
      judged            rms error of the displacement
      crossing levels   counted

    mpm-linear-flip-musl
      expected: converging, order within [1.70, 2.30]
      because: linear basis functions have order 2
      effects           none
      a step            P2G(mass, force), acceleration, G2P(particle velocity), P2G(momentum),
                        G2P(stress, position)
      particle visits   p2g mass, p2g momentum, p2g internal force, g2p velocity, g2p gradient, g2p
                        position
      particle memory   80 B: X 8, x 8, v 8, mass 8, V0 8, V 8, sigma 8, grad v 8, cell 8, advected x 8
      node memory       32 B: mass 8, velocity 8, force 8, acceleration 8; fixed 8 at 1 of 8

    fem-linear-lumped
      expected: converging, order within [1.70, 2.30]
      because: linear basis functions have order 2

    next: mpm-verify run short-bar                            verdicts and report
    ");
}

#[test]
fn an_unknown_effect_is_refused_with_a_hint() {
    let refused = |effect| Folder::new().refused(&["explain", "set-force", "--without", effect]);
    let words = ["--without gravty: there is no such effect", "did you mean `gravity`?"];
    assert_contains(&refused("gravty"), &words);
    assert_contains(&refused("colour"), &["help: known effects: gravity, body_force,"]);
}
