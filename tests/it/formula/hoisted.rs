//! Hoisting, and batches of points, change when a value is computed, but not its bits.

use proptest::prelude::*;
use rstest::rstest;

use super::bind;
use super::random::{grow, same, tree};
use mpm_verify::exact::formula::{Formula, Hoisted, Jet, NumberBatch};

/// Number of variables of `grow`. The last one, y, is used as the time.
const VARIABLES: usize = 2;

/// Returns every number of a jet.
fn parts(jet: &Jet<2>) -> [f64; 7] {
    let [second, mixed, last] = [(0, 0), (0, 1), (1, 1)].map(|(i, j)| jet.dd(i, j));
    [jet.value(), jet.d(0), jet.d(1), second, mixed, jet.dd(1, 0), last]
}

/// Compares hoisted formulas with plain ones, bit for bit, at all positions and times.
fn agree(formulas: &[Formula], places: &[f64], times: &[f64]) -> Result<(), TestCaseError> {
    let mut hoisted = Hoisted::new(formulas, VARIABLES);
    for x in places {
        hoisted.add(&[Jet::variable(*x, 0)]);
    }
    for t in times {
        let t = Jet::variable(*t, 1);
        hoisted.set_time(t);
        for (place, x) in places.iter().enumerate() {
            let found: Vec<Jet<2>> = hoisted.eval(place).collect();
            prop_assert_eq!(found.len(), formulas.len());
            for (found, formula) in found.iter().zip(formulas) {
                let plain = formula.eval(&[Jet::variable(*x, 0), t]);
                let same = parts(found).into_iter().zip(parts(&plain)).all(|(a, b)| same(a, b));
                prop_assert!(same, "{found:?} and {plain:?}");
            }
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn hoisted_formulas_have_the_bits_of_plain_ones(
        trees in prop::collection::vec(tree(), 1..4),
        places in prop::collection::vec(-3.0..3.0, 1..4),
        times in prop::collection::vec(-3.0..3.0, 1..4),
    ) {
        let formulas: Vec<Formula> = trees.iter().map(|tree| grow(&tree.text())).collect();
        agree(&formulas, &places, &times)?;
    }
}

/// Only operations that depend on both position and time must run for each of them.
#[rstest]
#[case::nothing("2*pi", 0)]
#[case::place("sin(pi*x)+sqrt(x)", 0)]
#[case::time("E*cos(omega*t)^2", 0)]
#[case::product("2*L*sin(pi*x)*sin(omega*t)", 1)]
#[case::function("wave(x,t)", 1)]
#[case::wave("sin(x-omega*t)", 2)]
#[case::turn("x*cos(t*(1-x^2))-x", 4)]
#[case::sum("sum(n,1,3,sin(n*x)*cos(n*t)/n)", 9)]
fn only_steps_that_depend_on_both_remain(#[case] source: &str, #[case] operations: usize) {
    let formula = bind(source, &["x", "t"]).unwrap();
    assert_eq!(Hoisted::<f64>::new(&[formula], VARIABLES).operations(), operations);
}

/// An operation that two formulas share must run only once. 0 and -0 are different operands.
#[rstest]
#[case("x*sin(x*t)", "t*sin(x*t)", 4)]
#[case("(x*t)/0", "(x*t)/(-0)", 3)]
fn what_is_shared_is_computed_once(#[case] one: &str, #[case] other: &str, #[case] left: usize) {
    let formulas = [one, other].map(|source| bind(source, &["x", "t"]).unwrap());
    assert_eq!(Hoisted::<f64>::new(&formulas, VARIABLES).operations(), left);
    agree(&formulas, &[0.0, -0.3, 1.7], &[0.0, 0.4, -2.0]).unwrap();
}

/// The formulas contain a sum in a sum, a variable that is a result, and a register that is used
/// twice.
#[rstest]
#[case("sum(n,1,3,n*x*sum(m,0,2,cos(m*t)*(m-n)))")]
#[case("sum(n,1,3,sin(n)*t)+sum(n,1,2,cos(n)*x)")]
#[case("t")]
#[case("x")]
#[case("x/t-t/x")]
#[case("(sin(x)*sin(t))*(cos(x)*cos(t))-tan(x)*(x-t)")]
fn hoisting_preserves_the_bits_of(#[case] source: &str) {
    let formula = bind(source, &["x", "t"]).unwrap();
    agree(&[formula.clone(), formula], &[0.0, -0.3, 1.7], &[0.0, 0.4, -2.0]).unwrap();
}

/// Compares the values at eight points together with the values at each of them, bit for bit.
fn agree_in_batches(formula: &Formula, x: &[f64], y: f64) -> Result<(), TestCaseError> {
    let found = formula.eval(&[NumberBatch::new(|lane| x[lane]), NumberBatch::from(y)]);
    for (lane, x) in x.iter().enumerate() {
        let alone = formula.eval(&[*x, y]);
        prop_assert!(same(found.get(lane), alone), "{} and {alone} at {x}", found.get(lane));
    }
    Ok(())
}

proptest! {
    #[test]
    fn batch_is_bit_identical_to_single_values(
        tree in tree(),
        x in prop::collection::vec(-3.0..3.0, NumberBatch::LEN),
        y in -3.0..3.0,
    ) {
        agree_in_batches(&grow(&tree.text()), &x, y)?;
    }
}

/// Some branches differ between the points, others are the same for all.
#[rstest]
#[case("min(x,t)+2*max(x,t)")]
#[case("x^t")]
#[case("x^floor(t*x)")]
#[case("x^3+t^(-2)")]
#[case("atan2(x,t)+atan2(t,-x)")]
#[case("abs(x)*sign(x)+step(x-t)")]
#[case("sum(n,1,4,n*sin(n*x)*sum(m,0,2,cos(m*t)*(m-n)))")]
#[case("max(0/x,1)")]
fn branches_are_selected_for_each_value(#[case] source: &str) {
    let formula = bind(source, &["x", "t"]).unwrap();
    let x = [0.0, -0.0, 1.0, -2.0, 3.5, f64::NAN, f64::INFINITY, -1e300];
    for t in [0.0, 1.0, -2.0, 0.5] {
        agree_in_batches(&formula, &x, t).unwrap();
    }
}
