//! Properties of any text and of any formula.

use proptest::prelude::*;

use super::{bar, declare};
use mpm_verify::exact::formula::{Expr, Formula, FormulaError, Jet};

const TOKENS: &str =
    "1 2.5 2e-3 .5 x y L E pi n s wave sin max sum sum(n,1,3, s( sin( ( ) , + - * / ^ . é";

/// A formula, which can be converted to text and to its value for given `x` and `y`.
#[derive(Debug, Clone)]
pub(super) enum Tree {
    Number(u8),
    X,
    Y,
    Negate(Box<Tree>),
    Call(&'static str, fn(f64) -> f64, Box<Tree>),
    Operation(char, Box<(Tree, Tree)>),
    /// A call of the user function `h`.
    User(Box<(Tree, Tree)>),
    /// The sum of n times the term, for n from 1 to 3.
    Sum(Box<Tree>),
}

impl Tree {
    pub(super) fn text(&self) -> String {
        self.nested(0)
    }

    /// Returns the text inside a number of sums, whose indices must have different names.
    fn nested(&self, sums: usize) -> String {
        match self {
            Self::Number(value) => value.to_string(),
            Self::X => "x".to_owned(),
            Self::Y => "y".to_owned(),
            Self::Negate(a) => format!("(-{})", a.nested(sums)),
            Self::Call(name, _, a) => format!("{name}({})", a.nested(sums)),
            Self::Operation(sign, operands) => {
                format!("({}{sign}{})", operands.0.nested(sums), operands.1.nested(sums))
            }
            Self::User(operands) => {
                format!("h({},{})", operands.0.nested(sums), operands.1.nested(sums))
            }
            Self::Sum(term) => format!("sum(n{sums},1,3,n{sums}*{})", term.nested(sums + 1)),
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
            Self::User(operands) => {
                let (a, b) = (operands.0.value(x, y), operands.1.value(x, y));
                b - a * b + a
            }
            Self::Sum(term) => {
                [1.0, 2.0, 3.0].iter().fold(0.0, |sum, n| sum + n * term.value(x, y))
            }
        }
    }
}

pub(super) fn tree() -> impl Strategy<Value = Tree> {
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
            (prop::sample::select(vec!['+', '-', '*', '/']), inner.clone(), inner.clone())
                .prop_map(|(sign, a, b)| Tree::Operation(sign, Box::new((a, b)))),
            (inner.clone(), inner.clone()).prop_map(|operands| Tree::User(Box::new(operands))),
            inner.prop_map(|term| Tree::Sum(Box::new(term))),
        ]
    })
}

/// Parses the text of a tree as a formula of x and y.
pub(super) fn grow(text: &str) -> Formula {
    let mut scope = bar();
    declare(&mut scope, "h", &["a", "b"], "b-a*b+a");
    Formula::bind(&Expr::parse(text).unwrap(), &scope, &["x", "y"]).unwrap()
}

fn soup() -> impl Strategy<Value = Vec<&'static str>> {
    let tokens: Vec<&str> = TOKENS.split(' ').chain([" "]).collect();
    prop::collection::vec(prop::sample::select(tokens), 0..24)
}

/// Parses `source`. Asserts that the span of an error can be shown.
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

/// Whether two numbers have equal bits. All NaN count as equal.
pub(super) fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

proptest! {
    #[test]
    fn text_never_panics(source in any::<String>()) {
        let _ = digest(&source);
    }

    #[test]
    fn token_soup_never_panics(tokens in soup()) {
        let _ = digest(&tokens.concat());
    }

    #[test]
    fn values_agree_with_the_tree(tree in tree(), x in -3.0..3.0, y in -3.0..3.0) {
        let formula = grow(&tree.text());
        let value = formula.eval(&[x, y]);
        prop_assert!(same(value, tree.value(x, y)));
        let jet = formula.eval(&[Jet::<2>::variable(x, 0), Jet::variable(y, 1)]);
        prop_assert!(same(value, jet.value()));
    }

    #[test]
    fn folded_constants_equal_evaluated_ones(tree in tree(), x in -3.0..3.0, y in 0_u8..4) {
        let folded = tree.text().replace('y', &y.to_string());
        let value = grow(&folded).eval(&[x, f64::NAN]);
        prop_assert!(same(value, tree.value(x, f64::from(y))));
    }
}
