//! `explain`: the problem, its source, and what is expected and why.

use super::{BAR, Folder, SOUND};
use rstest::rstest;

#[rstest]
#[case::a_wave_under_gravity("oedometer", &[
    "oedometer: Oedometer at large strain",
    "source            Wobbes & Tielen (2015), Accuracy of original MPM: oedometer",
    "equation          small strain, rho0 u_tt = Div P + rho0 b",
    "c = sqrt(E/rho) = 10.000000",
    "function          fall(tau) = -g/2*max(tau, 0)^2",
    "reference         linear lumped FEM, log_strain, 1280 elements",
    "mpm-linear-flip-usl-vs-exact\n  expected: failed\n  because: a particle that has just entered",
])]
#[case::one_particle("grid-crossing", &[
    "grid-crossing: Grid crossing, the mechanism",
    "prediction        -sigma*Omega*(n_left - n_right)/h N",
    "mpm-linear\n  expected: agrees with the prediction within 1e-14\n  because: the gradients",
])]
fn a_suite_that_is_built_in(#[case] name: &str, #[case] words: &[&str]) {
    let found = Folder::new().call(&["explain", name]);
    assert_eq!((found.code, found.errors.as_str()), (SOUND, ""));
    for words in words {
        assert!(found.out.contains(words), "no `{words}` in\n{}", found.out);
    }
}

#[test]
fn a_suite_of_ones_own() {
    let folder = Folder::new();
    folder.write("bar.yaml", BAR);
    let found = folder.call(&["explain", "bar.yaml"]);
    for words in [
        "source            a textbook",
        "left              fixed",
        "right             free",
        "fem-linear-lumped\n  expected: converging, order within [1.70, 2.30]\n  because: linear basis",
    ] {
        assert!(found.out.contains(words), "no `{words}` in\n{}", found.out);
    }
}
