//! Properties of arbitrary text and of arbitrary formulas.

use proptest::prelude::*;

use super::{bar, bind};
use crate::exact::formula::{Expr, Formula, FormulaError, Jet};

const TOKENS: &[&str] = &[
    "1",
    "2.5",
    "2e-3",
    ".5",
    "x",
    "y",
    "L",
    "E",
    "pi",
    "n",
    "s",
    "wave",
    "sin",
    "max",
    "sum",
    "sum(n,1,3,",
    "s(",
    "sin(",
    "(",
    ")",
    ",",
    "+",
    "-",
    "*",
    "/",
    "^",
    " ",
    ".",
    "é",
];

/// A formula as text, every operation in parentheses, and its value for given `x` and `y`.
#[derive(Debug, Clone)]
enum Tree {
    Number(u8),
    X,
    Y,
    Negate(Box<Tree>),
    Call(&'static str, fn(f64) -> f64, Box<Tree>),
    Operation(char, Box<(Tree, Tree)>),
}

impl Tree {
    fn text(&self) -> String {
        match self {
            Self::Number(value) => value.to_string(),
            Self::X => "x".to_owned(),
            Self::Y => "y".to_owned(),
            Self::Negate(a) => format!("(-{})", a.text()),
            Self::Call(name, _, a) => format!("{name}({})", a.text()),
            Self::Operation(sign, operands) => {
                format!("({}{sign}{})", operands.0.text(), operands.1.text())
            }
        }
    }

    fn value(&self, x: f64, y: f64) -> f64 {
        match self {
            Self::Number(value) => f64::from(*value),
            Self::X => x,
            Self::Y => y,
            Self::Negate(a) => -a.value(x, y),
            Self::Call(_, function, a) => function(a.value(x, y)),
            Self::Operation(sign, operands) => {
                let (a, b) = (operands.0.value(x, y), operands.1.value(x, y));
                match sign {
                    '+' => a + b,
                    '-' => a - b,
                    '*' => a * b,
                    _ => a / b,
                }
            }
        }
    }
}

fn tree() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![any::<u8>().prop_map(Tree::Number), Just(Tree::X), Just(Tree::Y)];
    leaf.prop_recursive(6, 48, 2, |inner| {
        let call = |name, function: fn(f64) -> f64| {
            inner.clone().prop_map(move |a| Tree::Call(name, function, Box::new(a)))
        };
        prop_oneof![
            call("sin", libm::sin),
            call("exp", libm::exp),
            call("sqrt", libm::sqrt),
            call("atan", libm::atan),
            inner.clone().prop_map(|a| Tree::Negate(Box::new(a))),
            (prop::sample::select(vec!['+', '-', '*', '/']), inner.clone(), inner)
                .prop_map(|(sign, a, b)| Tree::Operation(sign, Box::new((a, b)))),
        ]
    })
}

/// Binds `source`, and checks that the span of an error can be shown.
fn digest(source: &str) -> Result<(), FormulaError> {
    let bound = Expr::parse(source).and_then(|expr| Formula::bind(&expr, &bar(), &["x", "y"]));
    if let Err(error) = &bound
        && error.within.is_none()
    {
        assert!(source.get(error.span.clone()).is_some(), "{error:?}");
    }
    let formula = bound?;
    let value = formula.eval(&[0.5, -0.25]);
    let jet = formula.eval(&[Jet::<2>::variable(0.5, 0), Jet::variable(-0.25, 1)]);
    assert!(same(value, jet.value()), "{value} and {jet:?}");
    Ok(())
}

/// Equality of bits, except that one NaN is as good as another.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

proptest! {
    #[test]
    fn text_never_panics(source in any::<String>()) {
        let _ = digest(&source);
    }

    #[test]
    fn token_soup_never_panics(tokens in prop::collection::vec(prop::sample::select(TOKENS), 0..24)) {
        let _ = digest(&tokens.concat());
    }

    #[test]
    fn values_are_those_of_the_tree(tree in tree(), x in -3.0..3.0, y in -3.0..3.0) {
        let formula = bind(&tree.text(), &["x", "y"]).unwrap();
        let value = formula.eval(&[x, y]);
        prop_assert!(same(value, tree.value(x, y)));
        let jet = formula.eval(&[Jet::<2>::variable(x, 0), Jet::variable(y, 1)]);
        prop_assert!(same(value, jet.value()));
    }

    #[test]
    fn folding_is_evaluation(tree in tree(), x in -3.0..3.0, y in 0_u8..4) {
        let folded = tree.text().replace('y', &y.to_string());
        let value = bind(&folded, &["x"]).unwrap().eval(&[x]);
        prop_assert!(same(value, tree.value(x, f64::from(y))));
    }
}
