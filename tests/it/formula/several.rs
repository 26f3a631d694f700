//! A formula gives the same values for several points together as for each point alone.

use proptest::prelude::*;
use rstest::rstest;

use super::bind;
use super::random::{grow, same, tree};
use mpm_verify::exact::formula::{Formula, NumberBatch};

/// Compares the values at eight points together with the values at each of them, bit for bit.
fn agree(formula: &Formula, x: &[f64], y: f64) -> Result<(), TestCaseError> {
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
        agree(&grow(&tree.text()), &x, y)?;
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
        agree(&formula, &x, t).unwrap();
    }
}
