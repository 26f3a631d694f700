//! Detects formulas without kinks.

use super::bound::Formula;
use super::builtin::Binary;
use super::program::{Action, Operand};
use super::unary::Unary;

impl Formula {
    /// Whether the value is an analytic function of all real variables, without kinks and jumps.
    ///
    /// A quotient counts as smooth only if its divisor is constant: `tanh(1/x)` jumps at zero.
    /// `ln` does not count as smooth: `exp(ln(x^2)/2)` is `abs(x)`.
    pub fn is_smooth(&self) -> bool {
        let varying = self.varying();
        let varies = |operand: &Operand| varies(*operand, &varying);
        self.code.iter().all(|step| match &step.action {
            Action::Copy(_)
            | Action::Negate(_)
            | Action::Next(_)
            | Action::Binary(Binary::Add | Binary::Subtract | Binary::Multiply, ..) => true,
            Action::Powi(a, exponent) => *exponent >= 0 || !varies(a),
            Action::Unary(function, a) => function.is_analytic() || !varies(a),
            Action::Binary(Binary::Divide, _, b) => !varies(b),
            Action::Binary(_, a, b) => !varies(a) && !varies(b),
        })
    }

    /// Returns, for each register, whether its value depends on a variable at some step.
    fn varying(&self) -> Vec<bool> {
        let mut varying = vec![false; self.registers];
        // An iteration of `sum` reads registers of the previous one: repeat until nothing changes.
        loop {
            let before = varying.clone();
            for step in &self.code {
                let varies = step.action.arguments().any(|operand| varies(operand, &varying));
                varying[step.to] |= varies;
            }
            if varying == before {
                return varying;
            }
        }
    }
}

fn varies(operand: Operand, varying: &[bool]) -> bool {
    match operand {
        Operand::Constant(_) => false,
        Operand::Variable(_) => true,
        Operand::Register(register) => varying[register],
    }
}

impl Unary {
    fn is_analytic(self) -> bool {
        matches!(
            self,
            Self::Sin
                | Self::Cos
                | Self::Sinh
                | Self::Cosh
                | Self::Tanh
                | Self::Atan
                | Self::Asinh
                | Self::Exp
                | Self::BesselJ0
                | Self::BesselJ1
        )
    }
}

#[cfg(test)]
mod tests {
    use crate::exact::tests::bind;
    use rstest::rstest;

    #[rstest]
    #[case("3*x^2*sin(t) - exp(-t)/7", true)]
    #[case("sum(n, 1, 4, sin(n*pi*x)*exp(-n^2*t)/n)", true)]
    #[case("sum(n, 1, 4, sqrt(n)*x)", true)]
    #[case("bessel_j1(x)*sin(t)", true)]
    #[case("2^x", false)]
    #[case("step(x - t)*(x - t)", false)]
    #[case("sqrt((x - t)^2)", false)]
    #[case("exp(ln((x - t)^2)/2)", false)]
    #[case("asin(sin(x))", false)]
    #[case("tanh(1/x)", false)]
    #[case("(1 + x^2)^(-1)", false)]
    #[case("((x - t)^2)^0.5", false)]
    #[case("sum(n, 1, 2, x)^(-1)", false)]
    #[case("max(x, t)", false)]
    #[case("atan(tan(x))", false)]
    #[case("1", true)]
    fn smoothness_is_told_from_the_functions_composed(#[case] text: &str, #[case] smooth: bool) {
        assert_eq!(bind(text, &["x", "t"]).is_smooth(), smooth);
    }
}
