//! Loads that depend on the displacement: invalid names, and exact solutions for another load.

use super::refuse_all;
use crate::common::{built_in_source, valid_suite};

fn bar() -> String {
    built_in_source("elastic-foundation").text().to_owned()
}

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r#"
@elastic-foundation [▸"v0/omega
"3*E*k^2" → "2*E*k^2"
-kf*ux/rho → -1.01*kf*ux/rho
⇒ equation of motion in X, rho0 u_tt = Div P + rho0 b, solved for b, … m/s2 (off by
-kf*ux/rho → kf*ux/rho ⇒ equation of motion in X … solved for b,
["-kf*ux/rho"] → ["-kf*▸uy/rho"] ⇒ unknown name `uy`
["-kf*ux/rho"] → ["-kf*(ux + ▸uy)/rho"] ⇒ unknown name `uy`
body_force: ["-kf*ux/rho"] → gravity: ["-kf*▸ux/rho"] ⇒ unknown name `ux`
{left: fixed, right: fixed} → {left: fixed}
body_force: ["-kf*ux/rho"] → traction: {on: right, value: ["-kf*▸ux"]}
⇒ unknown name `ux`
v0: 1e-4 → ▸ux: 2\n  v0: 1e-4
⇒ `ux` is a variable of formulas and cannot be declared … rename it; the variables are X, t, ux
"#;

/// If no load uses the name, the suite may declare it like any other name.
#[test]
fn a_suite_without_such_a_load_may_declare_the_name() {
    let text = bar().replace("-kf*ux/rho", "-kf*v0/omega*sin(k*X)*sin(omega*t)/rho");
    let text = text.replace("  v0: 1e-4", "  ux: 2\n  v0: 1e-4");
    let text = text.replace("until: \"pi/omega\"", "until: \"ux/2*pi/omega\"");
    valid_suite(&text);
}
