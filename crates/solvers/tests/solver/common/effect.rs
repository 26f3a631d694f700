//! Effects of every kind, built from the examples that are registered with their keys.

use super::H;
use mpm_solvers::mpm::{BasisName, Setup};
use mpm_suites::study;
use mpm_suites::suite::yaml::Source;
use mpm_suites::suite::{EffectName, Suite};

/// Adds the example of an effect with strength `size` to a body of [`free_body`](super::free_body)
/// with `basis`, after the effects that it requires. With strength 0 it changes nothing.
pub(crate) fn add<const D: usize>(
    name: EffectName,
    setup: &mut Setup<D>,
    basis: BasisName,
    size: f64,
) {
    let source = Source::from_text("effect.yaml", suite(name, D, size)).unwrap();
    let suite = Suite::load(&source).unwrap_or_else(|diagnostic| panic!("{diagnostic}"));
    for effect in study::effects(&suite).unwrap() {
        let effect = effect.build(&setup.grid, basis, &mut setup.particles);
        setup.effects.push(effect.unwrap());
    }
}

/// Creates a suite of the free body with the example of an effect, and of the effects that it
/// requires.
fn suite(name: EffectName, dimension: usize, size: f64) -> String {
    let corner = |cells: f64| format!("{:?}", vec![cells * H; dimension]);
    let (from, to) = (corner(2.03), corner(5.03));
    let listed = name.needs().iter().chain([&name]);
    let loads: Vec<String> =
        listed.map(|name| format!("    - {}", name.example(dimension))).collect();
    let loads = loads.join("\n");
    let some = corner(2.53);
    let set = format!("  sets: {{some: {{box: {{from: {from}, to: {some}}}}}}}\n");
    let sets = if loads.contains("on: some") { set.as_str() } else { "" };
    format!(
        "suite: effect\ntitle: an effect\nsource: a test\nparameters: {{s: {size}}}\n\
         scene:\n  dimension: {dimension}\n  body: {{box: {{from: {from}, to: {to}}}}}\n  \
         material: {{linear_elastic: {{young: 1, poisson: 0.3, density: 1}}}}\n\
         {sets}  loads:\n{loads}\n\
         run: {{until: 1e-3, dt: 1e-3}}\nrefine: {{cells: 3, ppc: {}}}\n\
         methods:\n  - mpm: {{basis: linear, transfer: flip, scheme: musl}}\n\
         expect:\n  - drift: {{mass: 1e-13}}\n    because: no step is made\n",
        1 << dimension
    )
}
