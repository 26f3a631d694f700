//! The text of a new suite.

use super::args::{LawChoice, TruthChoice};
use std::path::Path;

/// Width of what stands before a comment.
const WIDTH: usize = 33;

/// Choices of a new suite, in the words of suites.
pub(super) struct Choices {
    pub(super) name: String,
    pub(super) dimension: String,
    pub(super) law: LawChoice,
    pub(super) basis: NamedChoice,
    pub(super) transfer: NamedChoice,
    pub(super) scheme: NamedChoice,
}

/// A setting of the method.
pub(super) struct NamedChoice {
    pub(super) value: String,
    /// Names that it may have.
    pub(super) known: Vec<&'static str>,
}

/// All that depends on the dimension. Levels run within seconds, in 3-D the coarse ones only; steps
/// divide the time between instants.
struct Shape {
    body: &'static str,
    zeros: &'static str,
    lengths: &'static str,
    boundary: &'static str,
    held: &'static str,
    cells: &'static str,
    ppc: &'static str,
    instants: &'static str,
    /// Axes, and phases of a motion along each: some parts are stretched while others are
    /// compressed.
    axes: &'static [(&'static str, &'static str)],
}

const BAR: Shape = Shape {
    body: "bar",
    zeros: "[0]",
    lengths: "[L]",
    boundary: "{left: fixed, right: fixed}",
    held: "a face that is not named is free",
    cells: "[8, 16, 32, 64]",
    ppc: "4",
    instants: "8",
    axes: &[("X", "")],
};

const SQUARE: Shape = Shape {
    body: "square",
    zeros: "[0, 0]",
    lengths: "[L, L]",
    boundary: "{left: roller, right: roller, bottom: roller, top: roller}",
    held: "a roller holds along its normal; a face that is not named is free",
    cells: "[8, 12, 16, 24]",
    ppc: "4",
    instants: "8",
    axes: &[("X", ""), ("Y", " + pi")],
};

const CUBE: Shape = Shape {
    body: "cube",
    zeros: "[0, 0, 0]",
    lengths: "[L, L, L]",
    boundary: "{left: roller, right: roller, bottom: roller, top: roller, back: roller, front: roller}",
    held: "a roller holds along its normal; a face that is not named is free",
    cells: "[8, 10, 12, 16]",
    ppc: "8",
    instants: "4",
    axes: &[("X", ""), ("Y", " + 2*pi/3"), ("Z", " + 4*pi/3")],
};

/// The suite, with a comment for each key; `path` is where it will be.
pub(super) fn text(choices: &Choices, path: &Path) -> String {
    let shape = match choices.dimension.as_str() {
        "1" => BAR,
        "2" => SQUARE,
        _ => CUBE,
    };
    let wave = choices.law.truth() == TruthChoice::StandingWave;
    let parts = [
        head(choices, &shape, wave),
        parameters(&shape, wave),
        scene(choices, &shape, wave),
        truth(&shape, wave),
        numerics(&shape),
        method(choices),
        next(path),
    ];
    parts.join("\n")
}

/// A line with a comment.
fn line(words: &str, comment: &str) -> String {
    format!("{words:<WIDTH$}  # {comment}\n")
}

fn head(choices: &Choices, shape: &Shape, wave: bool) -> String {
    let (body, law) = (shape.body, choices.law.name());
    let name = serde_json::Value::from(choices.name.as_str());
    let mut text = line(&format!("suite: {name}"), "the name in reports and tests");
    if wave {
        text += &format!(
            "title: Standing wave in a {body} ({law})\n\
             source: \"Achenbach (1973), Wave Propagation in Elastic Solids: dilatational waves\"\n\
             about: >\n  A {body} is stretched and compressed along x, in the lowest mode of waves \
             of compression.\n  Strains are 3e-7: the truth is one of small strain, and no particle \
             changes its cell.\n"
        );
    } else {
        text += &format!(
            "title: Manufactured motion of a {body} ({law})\n\
             source: \"Wallstedt & Guilkey (2008), J. Comput. Phys. 227: manufactured solutions\"\n\
             about: >\n  A {body} follows a stated motion, stretched and compressed along its axes. \
             The body force that\n  drives it is derived from the motion. Strains are 3 %.\n"
        );
    }
    text
}

fn parameters(shape: &Shape, wave: bool) -> String {
    let amplitude = if wave { "1e-7*L" } else { "0.01*L" };
    let speed = "sqrt(E*(1 - nu)/((1 + nu)*(1 - 2*nu)*rho))";
    let mut text = line("parameters:", "numbers, or formulas of the parameters above them");
    text += &line("  L: 1", &format!("edge of the {} (m)", shape.body));
    text += &line("  E: 1e4", "Young's modulus (Pa)");
    text += &line("  nu: 0.3", "Poisson's ratio");
    text += &line("  rho: 1", "density (kg/m3)");
    text += &line(&format!("  A: \"{amplitude}\""), "amplitude (m); strains are pi A/L");
    text += &line(&format!("  c: \"{speed}\""), "speed of waves (m/s)");
    text + &line("  omega: \"pi*c/L\"", "angular frequency (1/s)")
}

fn scene(choices: &Choices, shape: &Shape, wave: bool) -> String {
    let Shape { zeros, lengths, boundary, held, .. } = shape;
    let (dimension, law) = (&choices.dimension, choices.law.name());
    let mut text = line("scene:", "only what is there: loads would stand here too");
    text += &format!(
        "  dimension: {dimension}\n  \
           body: {{box: {{from: {zeros}, to: {lengths}}}}}\n  \
           material: {{{law}: {{young: E, poisson: nu, density: rho}}}}\n  \
           # {held}\n  \
           boundary: {boundary}\n"
    );
    if wave {
        let formulas = along_x(shape, "A*omega*sin(pi*X/L)");
        text +=
            &format!("  # at t = 0, as the truth below has it\n  initial_velocity: {formulas}\n");
    }
    text
}

/// A vector of which only the first component is not zero.
fn along_x(shape: &Shape, formula: &str) -> String {
    let zeros = ", 0".repeat(shape.axes.len() - 1);
    format!("[\"{formula}\"{zeros}]")
}

fn truth(shape: &Shape, wave: bool) -> String {
    if wave {
        let formulas = along_x(shape, "A*sin(pi*X/L)*sin(omega*t)");
        let mut text = line("exact:", "the truth; `check` holds it to its equation");
        text += &line("  equation: small_strain", "rho u_tt = div sigma");
        text += "  # u(X, t), a formula for each axis (m); X is the place before the motion\n";
        return format!("{text}  displacement: {formulas}\n");
    }
    let formula =
        |(x, phase): &(&str, &str)| format!("    - \"A*sin(pi*{x}/L)*sin(omega*t{phase})\"\n");
    let formulas: String = shape.axes.iter().map(formula).collect();
    let mut text = line("manufactured:", "the truth; velocity and body force follow from it");
    text += "  # u(X, t), a formula for each axis (m); X is the place before the motion\n";
    format!("{text}  displacement:\n{formulas}")
}

fn numerics(shape: &Shape) -> String {
    let Shape { cells, ppc, instants, .. } = shape;
    let mut text = "run:\n".to_owned();
    text += &line("  until: \"pi/omega\"", "end (s): half a period");
    text +=
        &line("  dt: \"0.5*h/c\"", "time step (s): a share of what a wave takes to cross a cell h");
    text += &line(&format!("  instants: {instants}"), "at which the error is taken");
    text += "\n";
    text += &line("refine:", "one level for each number of cells, from coarse to fine");
    text += &line(&format!("  cells: {cells}"), "along each axis");
    text += &line(&format!("  ppc: {ppc}"), "particles per cell");
    text += "\n";
    text + &line("judge: {norm: max_rms}", "largest error of all instants, RMS over the particles")
}

fn method(choices: &Choices) -> String {
    let mut text = line("methods:", "lists multiply to cases: `basis: [linear, cpdi]`");
    text += "  - mpm:\n";
    let Choices { basis, transfer, scheme, .. } = choices;
    for (key, setting) in [("basis", basis), ("transfer", transfer), ("scheme", scheme)] {
        let NamedChoice { value, known } = setting;
        text += &format!("      # {}\n      {key}: {value}\n", known.join(", "));
    }
    text += "      # velocities start half a step back; at t = 0 they would leave an error of order 1\n";
    text + "      start: half_step_back\n"
}

fn next(path: &Path) -> String {
    let path = path.display();
    format!(
        "# Nothing is expected yet: a run says what it sees, and is no gate. What comes next:\n\
         #   mpm-verify check {path}        is the suite sound?\n\
         #   mpm-verify run --watch {path}  what is seen; again whenever this file changes\n\
         #   mpm-verify propose {path}      `expect` entries: put them below, for a gate\n"
    )
}
